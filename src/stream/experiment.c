/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reals for experiments: a random one, and one that is known slowly. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "base/random.h"
#include "stream/real.h"

/* ---- random: binary digits of a number in [0,1], a function of seed and place, so that they are drawn once ---- */

/* The interval of all numbers with these first digits: 2^-bits wide. */
static dyd_status random_narrow(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  const uint64_t seed = *(const uint64_t *)user;
  const size_t bits = request->bits > 0 ? (size_t)request->bits : 0, words = bits / 64 + 1;
  DYD_FREED uint64_t *digits = dyd_alloc(words, sizeof *digits);
  if (!digits) return dyd_fail_nomem(err);
  for (size_t k = 0; k < words; k++) digits[k] = dyd_random(seed, k + 1);
  DYD_LOCAL_NUMBERS(mpz, first);
  DYD_LOCAL(dyd_dyadic, lo, hi);
  mpz_import(first, words, 1, sizeof *digits, 0, 0, digits);
  mpz_tdiv_q_2exp(first, first, 64 * words - bits);
  dyd_status st = dyd_dyadic_set_z_2exp(&lo, first, -(int64_t)bits);
  mpz_add_ui(first, first, 1);
  if (st == DYD_OK) st = dyd_dyadic_set_z_2exp(&hi, first, -(int64_t)bits);
  if (st == DYD_OK) st = dyd_interval_set_ends(out, &lo, &hi);
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

dyd_status dyd_real_random(dyd_real **out, uint64_t seed) {
  void *user;
  dyd_status st = dyd_real_new_inside(out, &user, sizeof seed, random_narrow, NULL);
  if (st == DYD_OK) *(uint64_t *)user = dyd_random(seed, 0); /* neighbouring seeds begin far apart */
  return st;
}

/* ---- slow: answer number n is about 1/n wide, whatever number of bits a request has ---- */

typedef struct slow_real {
  dyd_real *x;
  uint64_t answers;
} slow_real;

static void slow_release(void *user) {
  dyd_real_free(((slow_real *)user)->x);
}

/* Of x in [lo,hi], at most 1/(4 n) wide, [hi - r, lo + r] with r a little below 1/(2 n): it holds x, and is at most 1/n
 * wide. */
static dyd_status slow_narrow(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  slow_real *s = user;
  const uint64_t n = s->answers + 1;
  int64_t log2 = 0;
  while (log2 < 63 && (uint64_t)1 << log2 < n) log2++;
  dyd_status st = dyd_real_narrow_until(s->x, log2 + 2, request->max_bits, request->stop, err);
  if (dyd_narrow_ended(st)) return st;
  DYD_LOCAL_NUMBERS(mpq, lo, hi, r);
  dyd_interval_get_q(lo, hi, dyd_real_interval(s->x));
  mpz_setbit(mpq_numref(r), (mp_bitcnt_t)log2 + 7);
  mpz_sub_ui(mpq_numref(r), mpq_numref(r), 1);
  mpz_fdiv_q_ui(mpq_numref(r), mpq_numref(r), n);
  mpq_div_2exp(r, r, (mp_bitcnt_t)log2 + 8);
  mpq_sub(hi, hi, r);
  mpq_add(lo, lo, r);
  st = dyd_interval_set_outward(out, hi, lo, -log2 - 70);
  if (st != DYD_OK) return dyd_fail(err, st, "a slow value: %s", dyd_status_text(st));
  s->answers = n;
  return DYD_OK;
}

dyd_status dyd_real_slow(dyd_real **out, dyd_real *x) {
  void *user;
  dyd_status st = dyd_real_new_inside(out, &user, sizeof(slow_real), slow_narrow, slow_release);
  if (st == DYD_OK)
    *(slow_real *)user = (slow_real){x, 0};
  else
    dyd_real_free(x);
  return st;
}
