/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Normal errors: how far regions reach so that all points lie in theirs with a stated probability [CNF-1].
 *
 * All roundings go up, and each function of the chain grows with its argument, so that the result is at least the exact
 * number. */
#include "io/read/confidence.h"

#include "base/abi.h"
#include "base/error.h"
#include "base/local.h"
#include "engine/labels.h"
#include "io/read/coordinate.h"

#include <inttypes.h>
#include <math.h>
#include <mpfr.h>
#include <string.h>

enum { PRECISION = 128 };

double dyd_double_above(mpq_srcptr q) {
  mpfr_t x;
  mpfr_init2(x, PRECISION);
  mpfr_set_q(x, q, MPFR_RNDU);
  double d = mpfr_get_d(x, MPFR_RNDU);
  mpfr_clear(x);
  return d;
}

double dyd_root_above(mpq_srcptr q) {
  mpfr_t x;
  mpfr_init2(x, PRECISION);
  mpfr_set_q(x, q, MPFR_RNDU);
  mpfr_sqrt(x, x, MPFR_RNDU);
  double d = mpfr_get_d(x, MPFR_RNDU);
  mpfr_clear(x);
  return d;
}

double dyd_sigma_round(mpq_t sigma[2], mpq_srcptr rho) {
  if (!mpq_sgn(rho)) return dyd_double_above(sigma[mpq_cmp(sigma[0], sigma[1]) < 0]);
  mpfr_t x;
  DYD_LOCAL_NUMBERS(mpq, a, b, c);
  mpfr_init2(x, PRECISION);
  mpq_mul(a, sigma[0], sigma[0]);
  mpq_mul(b, sigma[1], sigma[1]);
  mpq_mul(c, sigma[0], sigma[1]);
  mpq_mul(c, c, rho);
  mpq_sub(b, a, b);
  mpq_div_2exp(b, b, 1); /* (sx^2 - sy^2) / 2 */
  mpq_sub(a, a, b);      /* (sx^2 + sy^2) / 2 */
  mpq_mul(b, b, b);
  mpq_mul(c, c, c);
  mpq_add(b, b, c);
  mpfr_set_q(x, b, MPFR_RNDU);
  mpfr_sqrt(x, x, MPFR_RNDU);
  mpfr_add_q(x, x, a, MPFR_RNDU);
  mpfr_sqrt(x, x, MPFR_RNDU);
  double d = mpfr_get_d(x, MPFR_RNDU);
  mpfr_clear(x);
  return d;
}

/* Reads a decimal above 0 and below 1: man / 10^places. */
static bool probability_parse(int64_t *man, int *places, const char *text) {
  size_t length = strlen(text);
  dyd_plain p;
  bool percent = length && text[length - 1] == '%';
  length -= percent;
  while (length && text[length - 1] == ' ') length--;
  if (!dyd_plain_scan(&p, text, length) || p.man <= 0) return false;
  if (percent) p.exp -= 2;
  for (; p.man % 10 == 0; p.exp++) p.man /= 10;
  *man = p.man;
  *places = -p.exp;
  char digits[24];
  return snprintf(digits, sizeof digits, "%" PRId64, p.man) <= *places;
}

/* n 10^places / (10^places - man) = n / (1 - probability), rounded up, then k. */
static double k_above(int64_t man, int places, size_t n) {
  mpfr_t x;
  if (!n) return 0;
  DYD_LOCAL_NUMBERS(mpq, q);
  mpfr_init2(x, PRECISION);
  mpz_ui_pow_ui(mpq_numref(q), 10, (unsigned long)places);
  mpz_sub_ui(mpq_denref(q), mpq_numref(q), (unsigned long)man);
  mpz_mul_ui(mpq_numref(q), mpq_numref(q), n);
  mpq_canonicalize(q);
  mpfr_set_q(x, q, MPFR_RNDU);
  mpfr_log(x, x, MPFR_RNDU);
  mpfr_mul_2ui(x, x, 1, MPFR_RNDU);
  mpfr_sqrt(x, x, MPFR_RNDU);
  double k = mpfr_get_d(x, MPFR_RNDU);
  mpfr_clear(x);
  return k;
}

dyd_status dyd_confidence_for(dyd_confidence *out, const dyd_engine *e, const char *probability, size_t n,
                              dyd_error *err) {
  int64_t man;
  int places;
  dyd_confidence before = {DYD_SIZED(dyd_confidence)};
  if (dyd_engine_confidence(&before, e))
    return dyd_fail(err, DYD_E_ARG, "points with a confidence were added before; add all of them at once");
  if (!probability_parse(&man, &places, probability))
    return dyd_fail(err, DYD_E_ARG,
                    "the confidence \"%.40s\" is not a decimal above 0 and below 1; give one such as 95%% or 0.95",
                    probability);
  *out = (dyd_confidence){DYD_SIZED(dyd_confidence), .k = k_above(man, places, n), .n = n};
  static const char zeros[] = "0000000000000000000000000000000000000000000000000000000000000000";
  int digits = snprintf(NULL, 0, "%" PRId64, man); /* at most `places` of at most 62 */
  snprintf(out->probability, sizeof out->probability, "0.%.*s%" PRId64, places - digits, zeros, man);
  return DYD_OK;
}

dyd_status dyd_engine_state_confidence(dyd_confidence *out, dyd_engine *e, const char *probability, size_t n,
                                       dyd_error *err) {
  dyd_confidence c;
  dyd_error own;
  if (!err) err = &own;
  dyd_error_clear(err);
  if (!e || !probability) return dyd_fail_null(err);
  dyd_status st = out ? dyd_abi_check(out, sizeof out->struct_size, "dyd_confidence", err) : DYD_OK;
  if (st == DYD_OK) st = dyd_confidence_for(&c, e, probability, n, err);
  if (st != DYD_OK) return st;
  dyd_engine_give_confidence(e, &c);
  if (out) dyd_abi_give(out, &c, sizeof c);
  return DYD_OK;
}
