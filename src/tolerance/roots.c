/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Differences of two square roots. */
#include "tolerance/roots.h"

#include <dyadel/dyadic.h>
#include <mpfr.h>

enum { ROOT_BITS = 128 };

/* The sign of e + 2 sqrt(f) - 2 sqrt(g) for rationals: all over one denominator d, e + 2 sqrt(f d^2) / d ... */
static int sign_of_roots(mpq_srcptr e, mpq_srcptr f, mpq_srcptr g) {
  mpz_t d, a, c, h, two, minus_two;
  mpz_inits(d, a, c, h, NULL);
  mpz_init_set_si(two, 2);
  mpz_init_set_si(minus_two, -2);
  mpz_lcm(d, mpq_denref(e), mpq_denref(f));
  mpz_lcm(d, d, mpq_denref(g));
  mpz_divexact(a, d, mpq_denref(e));
  mpz_mul(a, a, mpq_numref(e));
  mpz_divexact(c, d, mpq_denref(f));
  mpz_mul(c, c, mpq_numref(f));
  mpz_mul(c, c, d);
  mpz_divexact(h, d, mpq_denref(g));
  mpz_mul(h, h, mpq_numref(g));
  mpz_mul(h, h, d);
  int sign = dyd_sqrt2_sign(a, two, c, minus_two, h);
  mpz_clears(d, a, c, h, two, minus_two, NULL);
  return sign;
}

/* sqrt(p) + sqrt(n) against sqrt(q) + sqrt(m): both are squared. */
int dyd_roots_compare(mpq_srcptr p, mpq_srcptr m, mpq_srcptr q, mpq_srcptr n) {
  mpq_t e, f, g;
  mpq_inits(e, f, g, NULL);
  mpq_add(e, p, n);
  mpq_sub(e, e, q);
  mpq_sub(e, e, m);
  mpq_mul(f, p, n);
  mpq_mul(g, q, m);
  int sign = sign_of_roots(e, f, g);
  mpq_clears(e, f, g, NULL);
  return sign;
}

/* out = |p - m| / (sqrt(p) + sqrt(m)) / 2, every step rounded so that the whole is: no digits cancel. */
static double half_rounded(mpq_srcptr difference, mpq_srcptr p, mpq_srcptr m, mpfr_rnd_t way) {
  mpfr_rnd_t against = way == MPFR_RNDD ? MPFR_RNDU : MPFR_RNDD;
  mpfr_t x, y;
  mpfr_inits2(ROOT_BITS, x, y, (mpfr_ptr)0);
  mpfr_set_q(x, p, against);
  mpfr_sqrt(x, x, against);
  mpfr_set_q(y, m, against);
  mpfr_sqrt(y, y, against);
  mpfr_add(y, x, y, against);
  mpfr_set_q(x, difference, way);
  mpfr_div(x, x, y, way);
  mpfr_div_2ui(x, x, 1, way);
  double out = mpfr_get_d(x, way);
  mpfr_clears(x, y, (mpfr_ptr)0);
  return out;
}

void dyd_roots_half(double *lo, double *hi, mpq_srcptr p, mpq_srcptr m) {
  mpq_t difference;
  mpq_init(difference);
  mpq_sub(difference, p, m);
  mpq_abs(difference, difference);
  bool zero = mpq_sgn(difference) == 0;
  *lo = zero ? 0 : half_rounded(difference, p, m, MPFR_RNDD);
  *hi = zero ? 0 : half_rounded(difference, p, m, MPFR_RNDU);
  mpq_clear(difference);
}

double dyd_q_double(mpq_srcptr q, int up) {
  mpfr_t x;
  mpfr_init2(x, 53);
  mpfr_rnd_t way = up ? MPFR_RNDU : MPFR_RNDD;
  mpfr_set_q(x, q, way);
  double out = mpfr_get_d(x, way);
  mpfr_clear(x);
  return out;
}
