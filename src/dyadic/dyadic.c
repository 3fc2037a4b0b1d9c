/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dyadic numbers: life, normal form and exact arithmetic.
 *
 * Sums and products of dyadics are dyadic; a result is refused, not rounded, when a bit of it would lie outside
 * [2^-DYD_EXP_LIMIT, 2^DYD_EXP_LIMIT). */
#include "base/invariant.h"
#include "dyadic/raw.h"

int64_t dyd_bits(mpz_srcptr man) {
  return mpz_sgn(man) ? (int64_t)mpz_sizeinbase(man, 2) : 0;
}

bool dyd_dyadic_is_valid(const dyd_dyadic *x) {
  if (!mpz_sgn(x->man)) return x->exp == 0;
  return mpz_odd_p(x->man) && x->exp >= -DYD_EXP_LIMIT && x->exp + dyd_bits(x->man) <= DYD_EXP_LIMIT;
}

void dyd_dyadic_init(dyd_dyadic *x) {
  mpz_init(x->man);
  x->exp = 0;
}

void dyd_dyadic_clear(dyd_dyadic *x) {
  mpz_clear(x->man);
}

void dyd_dyadic_set(dyd_dyadic *out, const dyd_dyadic *x) {
  DYD_INVARIANT(dyd_dyadic_is_valid(x));
  mpz_set(out->man, x->man);
  out->exp = x->exp;
}

void dyd_dyadic_swap(dyd_dyadic *x, dyd_dyadic *y) {
  int64_t exp = x->exp;
  mpz_swap(x->man, y->man);
  x->exp = y->exp;
  y->exp = exp;
}

dyd_status dyd_dyadic_take(dyd_dyadic *out, mpz_ptr man, int64_t exp) {
  if (!mpz_sgn(man)) {
    exp = 0;
  } else {
    /* The first comparison also keeps the sums below from overflowing. */
    if (exp > DYD_EXP_LIMIT || exp + dyd_bits(man) > DYD_EXP_LIMIT) return DYD_E_RANGE;
    mp_bitcnt_t zeros = mpz_scan1(man, 0);
    if (exp + (int64_t)zeros < -DYD_EXP_LIMIT) return DYD_E_RANGE;
    if (zeros) mpz_tdiv_q_2exp(man, man, zeros);
    exp += (int64_t)zeros;
  }
  mpz_swap(out->man, man);
  out->exp = exp;
  DYD_INVARIANT(dyd_dyadic_is_valid(out));
  return DYD_OK;
}

dyd_status dyd_dyadic_set_z_2exp(dyd_dyadic *out, const mpz_t man, int64_t exp) {
  mpz_t t;
  mpz_init_set(t, man);
  dyd_status st = dyd_dyadic_take(out, t, exp);
  mpz_clear(t);
  return st;
}

dyd_status dyd_dyadic_set_si_2exp(dyd_dyadic *out, long man, int64_t exp) {
  mpz_t t;
  mpz_init_set_si(t, man);
  dyd_status st = dyd_dyadic_take(out, t, exp);
  mpz_clear(t);
  return st;
}

void dyd_raw_add(mpz_ptr man, int64_t *exp, const dyd_dyadic *x, const dyd_dyadic *y, int sign) {
  const dyd_dyadic *high = x->exp >= y->exp ? x : y, *low = high == x ? y : x;
  mpz_mul_2exp(man, high->man, (mp_bitcnt_t)(high->exp - low->exp));
  if (sign > 0) {
    mpz_add(man, man, low->man);
  } else if (high == x) {
    mpz_sub(man, man, low->man);
  } else {
    mpz_sub(man, low->man, man);
  }
  *exp = low->exp;
}

static dyd_status add_signed(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y, int sign) {
  DYD_INVARIANT(dyd_dyadic_is_valid(x) && dyd_dyadic_is_valid(y));
  mpz_t t;
  int64_t exp;
  mpz_init(t);
  dyd_raw_add(t, &exp, x, y, sign);
  dyd_status st = dyd_dyadic_take(out, t, exp);
  mpz_clear(t);
  return st;
}

dyd_status dyd_dyadic_add(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y) {
  return add_signed(out, x, y, 1);
}

dyd_status dyd_dyadic_sub(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y) {
  return add_signed(out, x, y, -1);
}

dyd_status dyd_dyadic_mul(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y) {
  DYD_INVARIANT(dyd_dyadic_is_valid(x) && dyd_dyadic_is_valid(y));
  mpz_t t;
  mpz_init(t);
  mpz_mul(t, x->man, y->man);
  dyd_status st = dyd_dyadic_take(out, t, x->exp + y->exp);
  mpz_clear(t);
  return st;
}

dyd_status dyd_dyadic_mul_2exp(dyd_dyadic *out, const dyd_dyadic *x, int64_t e) {
  int64_t exp = 0;
  if (mpz_sgn(x->man)) {
    if (e > 2 * DYD_EXP_LIMIT || e < -2 * DYD_EXP_LIMIT) return DYD_E_RANGE;
    exp = x->exp + e;
    if (exp < -DYD_EXP_LIMIT || exp + dyd_bits(x->man) > DYD_EXP_LIMIT) return DYD_E_RANGE;
  }
  mpz_set(out->man, x->man);
  out->exp = exp;
  return DYD_OK;
}

void dyd_dyadic_neg(dyd_dyadic *out, const dyd_dyadic *x) {
  mpz_neg(out->man, x->man);
  out->exp = x->exp;
}

int dyd_dyadic_sgn(const dyd_dyadic *x) {
  return mpz_sgn(x->man);
}

/* x against y when both have the same sign and their highest bits the same place. */
static int cmp_aligned(const dyd_dyadic *x, const dyd_dyadic *y) {
  if (x->exp == y->exp) return mpz_cmp(x->man, y->man);
  mpz_t t;
  mpz_init(t);
  bool shift_x = x->exp > y->exp;
  const dyd_dyadic *high = shift_x ? x : y, *low = shift_x ? y : x;
  mpz_mul_2exp(t, high->man, (mp_bitcnt_t)(high->exp - low->exp));
  int order = shift_x ? mpz_cmp(t, low->man) : mpz_cmp(low->man, t);
  mpz_clear(t);
  return order;
}

int dyd_dyadic_cmp(const dyd_dyadic *x, const dyd_dyadic *y) {
  int sx = mpz_sgn(x->man), sy = mpz_sgn(y->man);
  if (sx != sy) return sx < sy ? -1 : 1;
  if (!sx) return 0;
  int64_t top_x = x->exp + dyd_bits(x->man), top_y = y->exp + dyd_bits(y->man);
  if (top_x != top_y) return (top_x < top_y) == (sx > 0) ? -1 : 1;
  int order = cmp_aligned(x, y);
  return (order > 0) - (order < 0);
}

int dyd_raw_cmp(const dyd_dyadic *x, mpz_srcptr p, const dyd_dyadic *y, mpz_srcptr q) {
  if (!mpz_cmp(p, q)) return dyd_dyadic_cmp(x, y);
  dyd_dyadic s, t; /* not in normal form, which a comparison does not need */
  mpz_init(s.man);
  mpz_init(t.man);
  mpz_mul(s.man, x->man, p);
  mpz_mul(t.man, y->man, q);
  s.exp = x->exp, t.exp = y->exp;
  int order = dyd_dyadic_cmp(&s, &t);
  mpz_clear(t.man);
  mpz_clear(s.man);
  return order;
}
