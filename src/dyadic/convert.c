/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dyadics to and from coarser dyadics, rationals and doubles, each rounding in a named direction.
 *
 * Rounding down to a grid and then down to a coarser grid that is part of it is rounding down to the coarser one;
 * likewise up. So a quotient cut to 64 bits may be rounded to a double in the same direction. */
#include "dyadic/raw.h"

#include <float.h>
#include <math.h>

enum { DOUBLE_BITS = 53, DOUBLE_LOW = -1074, DOUBLE_TOP = 1024 };

dyd_status dyd_dyadic_set_d(dyd_dyadic *out, double x) {
  if (!isfinite(x)) return DYD_E_ARG;
  int exp;
  mpz_t t;
  mpz_init_set_d(t, ldexp(frexp(x, &exp), DOUBLE_BITS));
  dyd_status st = dyd_dyadic_take(out, t, (int64_t)exp - DOUBLE_BITS);
  mpz_clear(t);
  return st;
}

/* q = floor or ceiling of n / 2^shift. */
static void shift_right_directed(mpz_ptr q, mpz_srcptr n, int64_t shift, dyd_round dir) {
  if (dir == DYD_DOWN) {
    mpz_fdiv_q_2exp(q, n, (mp_bitcnt_t)shift);
  } else {
    mpz_cdiv_q_2exp(q, n, (mp_bitcnt_t)shift);
  }
}

int64_t dyd_q_log2_above(mpq_srcptr q) {
  return dyd_bits(mpq_numref(q)) - dyd_bits(mpq_denref(q)) + 1;
}

static void divide_directed(mpz_ptr q, mpz_srcptr n, mpz_srcptr den, dyd_round dir) {
  if (dir == DYD_DOWN) {
    mpz_fdiv_q(q, n, den);
  } else {
    mpz_cdiv_q(q, n, den);
  }
}

dyd_status dyd_dyadic_round(dyd_dyadic *out, const dyd_dyadic *x, int64_t exp, dyd_round dir) {
  if (!mpz_sgn(x->man) || x->exp >= exp) {
    dyd_dyadic_set(out, x);
    return DYD_OK;
  }
  /* |x| < 2^DYD_EXP_LIMIT: every coarser grid has the same nearest multiples, 0 and one out of range. */
  if (exp > DYD_EXP_LIMIT) exp = DYD_EXP_LIMIT;
  mpz_t t;
  mpz_init(t);
  shift_right_directed(t, x->man, exp - x->exp, dir);
  dyd_status st = dyd_dyadic_take(out, t, exp);
  mpz_clear(t);
  return st;
}

/* The exact value of q when its denominator is a power of two; DYD_E_RANGE otherwise. */
static dyd_status set_dyadic_q(dyd_dyadic *out, const mpq_t q) {
  mp_bitcnt_t k = mpz_scan1(mpq_denref(q), 0);
  if (dyd_bits(mpq_denref(q)) != (int64_t)k + 1) return DYD_E_RANGE;
  return dyd_dyadic_set_z_2exp(out, mpq_numref(q), -(int64_t)k);
}

/* Below 2^(-4 DYD_EXP_LIMIT) only a q that is itself a dyadic is answered: anything else has no room anyway
 * except within 2^exp of a dyadic, and the integers would grow without bound. Likewise above, where only 0 or a
 * q of that size can be meant. */
dyd_status dyd_dyadic_round_q(dyd_dyadic *out, const mpq_t q, int64_t exp, dyd_round dir) {
  if (exp < -4 * DYD_EXP_LIMIT) return set_dyadic_q(out, q);
  int64_t size = dyd_bits(mpq_numref(q));
  if (exp > DYD_EXP_LIMIT + size) exp = DYD_EXP_LIMIT + size; /* |q| < 2^size <= 2^exp as before */
  mpz_t n, d;
  mpz_init_set(n, mpq_numref(q));
  mpz_init_set(d, mpq_denref(q));
  if (exp < 0) mpz_mul_2exp(n, n, (mp_bitcnt_t)-exp);
  if (exp > 0) mpz_mul_2exp(d, d, (mp_bitcnt_t)exp);
  divide_directed(n, n, d, dir);
  dyd_status st = dyd_dyadic_take(out, n, exp);
  mpz_clear(d);
  mpz_clear(n);
  return st;
}

void dyd_dyadic_get_q(mpq_t q, const dyd_dyadic *x) {
  mpq_set_z(q, x->man);
  if (x->exp > 0) mpz_mul_2exp(mpq_numref(q), mpq_numref(q), (mp_bitcnt_t)x->exp);
  if (x->exp < 0) mpz_mul_2exp(mpq_denref(q), mpq_denref(q), (mp_bitcnt_t)-x->exp); /* man is odd: canonical */
}

static double largest_in_direction(int sign, dyd_round dir) {
  double largest = sign == (int)dir ? HUGE_VAL : DBL_MAX;
  return sign > 0 ? largest : -largest;
}

/* The quantum of the result is 2^low; ldexp and mpz_get_d are exact for the integers of at most 53 bits that
 * remain, or 2^53 after rounding away from 0. */
double dyd_raw_get_d(mpz_srcptr man, int64_t exp, dyd_round dir) {
  int64_t bits = dyd_bits(man), top = exp + bits;
  if (!bits) return 0;
  if (top > DOUBLE_TOP) return largest_in_direction(mpz_sgn(man), dir);
  int64_t low = top - DOUBLE_BITS > DOUBLE_LOW ? top - DOUBLE_BITS : DOUBLE_LOW;
  if (exp >= low) return ldexp(mpz_get_d(man), (int)exp);
  mpz_t t;
  mpz_init(t);
  shift_right_directed(t, man, low - exp, dir);
  double x = ldexp(mpz_get_d(t), (int)low);
  mpz_clear(t);
  return x;
}

double dyd_raw_quotient_get_d(mpz_srcptr man, int64_t exp, mpz_srcptr den, dyd_round dir) {
  if (!mpz_cmp_ui(den, 1)) return dyd_raw_get_d(man, exp, dir);
  int64_t shift = 64 + dyd_bits(den) - dyd_bits(man);
  if (shift < 0) shift = 0;
  mpz_t t;
  mpz_init(t);
  mpz_mul_2exp(t, man, (mp_bitcnt_t)shift);
  divide_directed(t, t, den, dir);
  double x = dyd_raw_get_d(t, exp - shift, dir);
  mpz_clear(t);
  return x;
}

double dyd_dyadic_get_d(const dyd_dyadic *x, dyd_round dir) {
  return dyd_raw_get_d(x->man, x->exp, dir);
}

bool dyd_dyadic_is_double(const dyd_dyadic *x) {
  int64_t bits = dyd_bits(x->man);
  return !bits || (bits <= DOUBLE_BITS && x->exp >= DOUBLE_LOW && x->exp + bits <= DOUBLE_TOP);
}
