/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact signs of numbers with one and with two square roots.
 *
 * [SQR-1] If a and b sqrt(c) have opposite signs, the sign of a + b sqrt(c) is that of a times that of a^2 - b^2 c.
 * [SQR-2] If X = a + b sqrt(c) and Y = d sqrt(e) have opposite signs, the sign of X + Y is that of X times that of
 * X^2 - Y^2 = (a^2 + b^2 c - d^2 e) + 2 a b sqrt(c), which has one root only. */
#include "base/invariant.h"
#include "dyadic/raw.h"

/* Sign of a^2 - b^2 c for nonzero a, b and c > 0. An integer of n bits lies in [2^(n-1), 2^n). */
static int compare_squares(mpz_srcptr a, mpz_srcptr b, mpz_srcptr c) {
  int64_t na = 2 * dyd_bits(a), nb = 2 * dyd_bits(b) + dyd_bits(c);
  if (na - 2 >= nb) return 1;
  if (nb - 3 >= na) return -1;
  mpz_t s, t;
  mpz_init(s);
  mpz_init(t);
  mpz_mul(s, a, a);
  mpz_mul(t, b, b);
  mpz_mul(t, t, c);
  int order = mpz_cmp(s, t);
  mpz_clear(t);
  mpz_clear(s);
  return (order > 0) - (order < 0);
}

int dyd_sqrt_sign(const mpz_t a, const mpz_t b, const mpz_t c) {
  DYD_INVARIANT(mpz_sgn(c) >= 0);
  int sa = mpz_sgn(a), sb = mpz_sgn(c) ? mpz_sgn(b) : 0;
  if (!sb || sa == sb) return sa;
  if (!sa) return sb;
  return sa * compare_squares(a, b, c);
}

int dyd_sqrt2_sign(const mpz_t a, const mpz_t b, const mpz_t c, const mpz_t d, const mpz_t e) {
  DYD_INVARIANT(mpz_sgn(e) >= 0);
  int sx = dyd_sqrt_sign(a, b, c), sy = mpz_sgn(e) ? mpz_sgn(d) : 0;
  if (!sy || sx == sy) return sx;
  if (!sx) return sy;
  mpz_t p, q, t;
  mpz_init(p);
  mpz_init(q);
  mpz_init(t);
  mpz_mul(p, a, a);
  mpz_mul(t, b, b);
  mpz_addmul(p, t, c);
  mpz_mul(t, d, d);
  mpz_submul(p, t, e);
  mpz_mul(q, a, b);
  mpz_mul_2exp(q, q, 1);
  int sign = sx * dyd_sqrt_sign(p, q, c);
  mpz_clear(t);
  mpz_clear(q);
  mpz_clear(p);
  return sign;
}
