/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Closed intervals with exact ends.
 *
 * The end lo/den is a dyadic over an odd number; ends are compared by cross multiplication, which may leave the
 * exponent range of dyadics and is done on raw integers. */
#include "rect/interval.h"
#include "base/invariant.h"
#include "dyadic/raw.h"

bool dyd_interval_is_valid(const dyd_interval *a) {
  if (!dyd_dyadic_is_valid(&a->lo) || !dyd_dyadic_is_valid(&a->hi)) return false;
  if (mpz_sgn(a->den) <= 0 || !mpz_odd_p(a->den)) return false;
  int order = dyd_dyadic_cmp(&a->lo, &a->hi);
  if (!mpz_cmp_ui(a->den, 1)) return order <= 0;
  mpz_t g;
  mpz_init(g);
  mpz_gcd(g, a->lo.man, a->den);
  bool coprime = !mpz_cmp_ui(g, 1);
  mpz_clear(g);
  return coprime && order == 0;
}

void dyd_interval_init(dyd_interval *a) {
  dyd_dyadic_init(&a->lo);
  dyd_dyadic_init(&a->hi);
  mpz_init_set_ui(a->den, 1);
}

void dyd_interval_clear(dyd_interval *a) {
  mpz_clear(a->den);
  dyd_dyadic_clear(&a->hi);
  dyd_dyadic_clear(&a->lo);
}

void dyd_interval_set(dyd_interval *out, const dyd_interval *a) {
  DYD_INVARIANT(dyd_interval_is_valid(a));
  dyd_dyadic_set(&out->lo, &a->lo);
  dyd_dyadic_set(&out->hi, &a->hi);
  mpz_set(out->den, a->den);
}

void dyd_interval_swap(dyd_interval *a, dyd_interval *b) {
  dyd_dyadic_swap(&a->lo, &b->lo);
  dyd_dyadic_swap(&a->hi, &b->hi);
  mpz_swap(a->den, b->den);
}

dyd_status dyd_interval_set_ends(dyd_interval *out, const dyd_dyadic *lo, const dyd_dyadic *hi) {
  if (dyd_dyadic_cmp(lo, hi) > 0) return DYD_E_ARG;
  dyd_interval t;
  dyd_interval_init(&t);
  dyd_dyadic_set(&t.lo, lo);
  dyd_dyadic_set(&t.hi, hi);
  dyd_interval_swap(out, &t);
  dyd_interval_clear(&t);
  return DYD_OK;
}

dyd_status dyd_interval_set_d(dyd_interval *out, double lo, double hi) {
  if (!(lo <= hi)) return DYD_E_ARG;
  dyd_interval t;
  dyd_interval_init(&t);
  dyd_status st = dyd_dyadic_set_d(&t.lo, lo);
  if (st == DYD_OK) st = dyd_dyadic_set_d(&t.hi, hi);
  if (st == DYD_OK) dyd_interval_swap(out, &t);
  dyd_interval_clear(&t);
  return st;
}

dyd_status dyd_interval_set_q(dyd_interval *out, const mpq_t q) {
  int64_t k = (int64_t)mpz_scan1(mpq_denref(q), 0);
  if (dyd_bits(mpq_denref(q)) - k > DYD_EXP_LIMIT) return DYD_E_RANGE;
  dyd_interval t;
  dyd_interval_init(&t);
  dyd_status st = dyd_dyadic_set_z_2exp(&t.lo, mpq_numref(q), -k);
  if (st == DYD_OK) {
    dyd_dyadic_set(&t.hi, &t.lo);
    mpz_tdiv_q_2exp(t.den, mpq_denref(q), (mp_bitcnt_t)k);
    dyd_interval_swap(out, &t);
    DYD_INVARIANT(dyd_interval_is_valid(out));
  }
  dyd_interval_clear(&t);
  return st;
}

dyd_status dyd_interval_set_outward(dyd_interval *out, const mpq_t lo, const mpq_t hi, int64_t exp) {
  if (mpq_cmp(lo, hi) > 0) return DYD_E_ARG;
  dyd_interval t;
  dyd_interval_init(&t);
  dyd_status st = dyd_dyadic_round_q(&t.lo, lo, exp, DYD_DOWN);
  if (st == DYD_OK) st = dyd_dyadic_round_q(&t.hi, hi, exp, DYD_UP);
  if (st == DYD_OK) dyd_interval_swap(out, &t);
  dyd_interval_clear(&t);
  return st;
}

bool dyd_interval_is_point(const dyd_interval *a) {
  return dyd_dyadic_cmp(&a->lo, &a->hi) == 0;
}

/* Sign of the end x of a minus the end y of b. */
static int interval_cmp_ends(const dyd_dyadic *x, const dyd_interval *a, const dyd_dyadic *y, const dyd_interval *b) {
  return dyd_raw_cmp(x, b->den, y, a->den);
}

bool dyd_interval_contains(const dyd_interval *outer, const dyd_interval *inner) {
  return interval_cmp_ends(&outer->lo, outer, &inner->lo, inner) <= 0 &&
         interval_cmp_ends(&inner->hi, inner, &outer->hi, outer) <= 0;
}

bool dyd_interval_meets(const dyd_interval *a, const dyd_interval *b) {
  return interval_cmp_ends(&a->lo, a, &b->hi, b) <= 0 && interval_cmp_ends(&b->lo, b, &a->hi, a) <= 0;
}

dyd_status dyd_interval_intersect(dyd_interval *out, const dyd_interval *a, const dyd_interval *b) {
  if (!dyd_interval_meets(a, b)) return DYD_E_ARG;
  /* A rational point that meets the other set is the intersection; so is any set inside the other. */
  if (dyd_interval_contains(a, b)) {
    dyd_interval_set(out, b);
  } else if (dyd_interval_contains(b, a)) {
    dyd_interval_set(out, a);
  } else {
    bool a_is_lower = dyd_dyadic_cmp(&a->lo, &b->lo) < 0;
    return dyd_interval_set_ends(out, a_is_lower ? &b->lo : &a->lo, a_is_lower ? &a->hi : &b->hi);
  }
  return DYD_OK;
}

static void interval_end_get_q(mpq_t out, const dyd_dyadic *end, const dyd_interval *a) {
  dyd_dyadic_get_q(out, end);
  mpz_mul(mpq_denref(out), mpq_denref(out), a->den);
}

void dyd_interval_get_q(mpq_t lo, mpq_t hi, const dyd_interval *a) {
  interval_end_get_q(lo, &a->lo, a);
  interval_end_get_q(hi, &a->hi, a);
}

/* A width w with highest bit 2^(top-1) is at most 2^(top-1) if it is that power, else less than 2^top. */
int64_t dyd_interval_bits(const dyd_interval *a) {
  mpz_t width;
  int64_t exp, bits = INT64_MAX;
  mpz_init(width);
  dyd_raw_add(width, &exp, &a->hi, &a->lo, -1);
  if (mpz_sgn(width)) {
    int64_t size = dyd_bits(width);
    bool power = (int64_t)mpz_scan1(width, 0) == size - 1;
    bits = -(exp + size) + (power ? 1 : 0);
  }
  mpz_clear(width);
  return bits;
}

void dyd_interval_get_d(double *lo, double *hi, const dyd_interval *a) {
  *lo = dyd_raw_quotient_get_d(a->lo.man, a->lo.exp, a->den, DYD_DOWN);
  *hi = dyd_raw_quotient_get_d(a->hi.man, a->hi.exp, a->den, DYD_UP);
}

bool dyd_interval_get_exact_d(double *lo, double *hi, const dyd_interval *a) {
  if (mpz_cmp_ui(a->den, 1) || !dyd_dyadic_is_double(&a->lo) || !dyd_dyadic_is_double(&a->hi)) return false;
  dyd_interval_get_d(lo, hi, a);
  return true;
}
