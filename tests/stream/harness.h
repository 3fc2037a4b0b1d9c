/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the stream tests share: parsing shortly, and looking into intervals with exact rationals and MPFR. */
#ifndef DYD_TESTS_STREAM_HARNESS_H
#define DYD_TESTS_STREAM_HARNESS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dyadel/stream.h>
#include <gmp.h>
#include <string.h>
#include <time.h>

#include <mpfr.h>

#include "support/random.h"

static inline dyd_status parse_text(dyd_real **out, const char *text, dyd_error *err) {
  dyd_error_clear(err);
  return dyd_real_parse(out, text, strlen(text), err);
}

/* A real that must parse. */
static inline dyd_real *parsed(const char *text) {
  dyd_real *x = NULL;
  dyd_error err;
  dyd_status st = parse_text(&x, text, &err);
  if (st) fail_msg("%s: status %d, column %zu: %s", text, st, err.column, err.message);
  return x;
}

static inline const dyd_interval *narrowed(dyd_real *x, int64_t bits, int64_t max_bits) {
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status st = dyd_real_narrow(x, bits, max_bits, &err);
  if (st < 0) fail_msg("status %d, column %zu: %s", st, err.column, err.message);
  return dyd_real_interval(x);
}

/* Returns true if the interval contains the MPFR number, up to 2^-slack. */
static inline bool holds(const dyd_interval *a, const mpfr_t v, long slack) {
  mpq_t lo, hi, q, e;
  mpq_inits(lo, hi, q, e, NULL);
  dyd_interval_get_q(lo, hi, a);
  mpfr_get_q(q, v);
  mpq_set_ui(e, 1, 1);
  mpq_div_2exp(e, e, (mp_bitcnt_t)slack);
  mpq_sub(lo, lo, e);
  mpq_add(hi, hi, e);
  bool result = mpq_cmp(lo, q) <= 0 && mpq_cmp(q, hi) <= 0;
  mpq_clears(lo, hi, q, e, NULL);
  return result;
}

static inline bool is_exactly(const dyd_interval *a, const char *rational) {
  mpq_t lo, hi, q;
  mpq_inits(lo, hi, q, NULL);
  mpq_set_str(q, rational, 10);
  mpq_canonicalize(q);
  dyd_interval_get_q(lo, hi, a);
  bool result = mpq_equal(lo, q) && mpq_equal(hi, q);
  mpq_clears(lo, hi, q, NULL);
  return result;
}

static inline double seconds(void) {
  return (double)clock() / CLOCKS_PER_SEC;
}

/* Ends of a test program: caches of FLINT and MPFR are released for the leak checker. */
int release_caches(void **state);

#endif
