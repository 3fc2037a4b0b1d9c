/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers man * 2^exp of any size, without normal form: the arithmetic of the certificate checker. */
#include "checker/exact.h"

void dyd_exact_init(dyd_exact *x) {
  mpz_init(x->man);
  x->exp = 0;
}

void dyd_exact_clear(dyd_exact *x) {
  mpz_clear(x->man);
}

void dyd_exact_set(dyd_exact *out, const dyd_exact *x) {
  mpz_set(out->man, x->man);
  out->exp = x->exp;
}

int dyd_exact_sgn(const dyd_exact *x) {
  return mpz_sgn(x->man);
}

int64_t dyd_exact_top(const dyd_exact *x) {
  return mpz_sgn(x->man) ? x->exp + (int64_t)mpz_sizeinbase(x->man, 2) : INT64_MIN;
}

/* out = x + sign * y. */
static void exact_combine(dyd_exact *out, const dyd_exact *x, const dyd_exact *y, int sign) {
  int64_t exp = x->exp;
  if (x->exp == y->exp) {
    sign > 0 ? mpz_add(out->man, x->man, y->man) : mpz_sub(out->man, x->man, y->man);
  } else {
    const dyd_exact *high = x->exp > y->exp ? x : y, *low = high == x ? y : x;
    mpz_t t;
    mpz_init(t);
    mpz_mul_2exp(t, high->man, (mp_bitcnt_t)(high->exp - low->exp));
    exp = low->exp;
    if (sign > 0)
      mpz_add(out->man, t, low->man);
    else if (high == x)
      mpz_sub(out->man, t, low->man);
    else
      mpz_sub(out->man, low->man, t);
    mpz_clear(t);
  }
  out->exp = exp;
}

/* A zero keeps any exponent; it must not force a long shift. */
void dyd_exact_add(dyd_exact *out, const dyd_exact *x, const dyd_exact *y) {
  if (!mpz_sgn(y->man))
    dyd_exact_set(out, x);
  else if (!mpz_sgn(x->man))
    dyd_exact_set(out, y);
  else
    exact_combine(out, x, y, 1);
}

void dyd_exact_sub(dyd_exact *out, const dyd_exact *x, const dyd_exact *y) {
  if (!mpz_sgn(y->man)) {
    dyd_exact_set(out, x);
  } else if (!mpz_sgn(x->man)) {
    mpz_neg(out->man, y->man);
    out->exp = y->exp;
  } else {
    exact_combine(out, x, y, -1);
  }
}

void dyd_exact_mul(dyd_exact *out, const dyd_exact *x, const dyd_exact *y) {
  int64_t exp = x->exp + y->exp;
  mpz_mul(out->man, x->man, y->man);
  out->exp = exp;
}

void dyd_exact_mul_z(dyd_exact *out, const dyd_exact *x, mpz_srcptr z) {
  mpz_mul(out->man, x->man, z);
  out->exp = x->exp;
}

int dyd_exact_cmp(const dyd_exact *x, const dyd_exact *y) {
  int sx = mpz_sgn(x->man), sy = mpz_sgn(y->man);
  if (sx != sy) return sx < sy ? -1 : 1;
  if (sx == 0) return 0;
  if (x->exp == y->exp) {
    int order = mpz_cmp(x->man, y->man); /* any number: callers compare and multiply signs */
    return (order > 0) - (order < 0);
  }
  int64_t tx = dyd_exact_top(x), ty = dyd_exact_top(y);
  if (tx != ty) return (tx < ty) == (sx > 0) ? -1 : 1;
  dyd_exact d;
  dyd_exact_init(&d);
  dyd_exact_sub(&d, x, y);
  int sign = mpz_sgn(d.man);
  dyd_exact_clear(&d);
  return sign;
}

/* Rounding twice to the same side is rounding once. */
static void exact_divide(mpz_ptr out, const dyd_exact *x, mpz_srcptr den, int64_t exp, bool up) {
  if (x->exp >= exp)
    mpz_mul_2exp(out, x->man, mpz_sgn(x->man) ? (mp_bitcnt_t)(x->exp - exp) : 0);
  else if (up)
    mpz_cdiv_q_2exp(out, x->man, (mp_bitcnt_t)(exp - x->exp));
  else
    mpz_fdiv_q_2exp(out, x->man, (mp_bitcnt_t)(exp - x->exp));
  if (den) up ? mpz_cdiv_q(out, out, den) : mpz_fdiv_q(out, out, den);
}

void dyd_exact_floor(mpz_ptr out, const dyd_exact *x, mpz_srcptr den, int64_t exp) {
  exact_divide(out, x, den, exp, false);
}

void dyd_exact_ceil(mpz_ptr out, const dyd_exact *x, mpz_srcptr den, int64_t exp) {
  exact_divide(out, x, den, exp, true);
}
