/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The centre of a circle, enclosed in doubles.
 *
 * b sqrt(c) 2^g lies in [s, s+1] for s = floor(sqrt(b^2 c 4^g)), up to sign. With n = a 2^g + s (b > 0) or a 2^g - s -
 * 1 (b < 0) of at least 64 bits  * the enclosure [n, n+1] / (2^g d) is 2^-62 wide relative to its size, and rounding
 * outward adds one unit in the last place on each side. If n is shorter, g grows; a number that is not 0 has a long n
 * for some g. */
#include "dyadic/raw.h"
#include "predicate/icircle.h"

/* n <= (a + b sqrt c) 2^g <= n + 1 */
static void centre_enclose(mpz_ptr n, mpz_ptr t, mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, int64_t g) {
  mpz_mul(n, b, b);
  mpz_mul(n, n, c);
  mpz_mul_2exp(n, n, (mp_bitcnt_t)(2 * g));
  mpz_sqrt(n, n);
  if (mpz_sgn(b) < 0) {
    mpz_neg(n, n);
    mpz_sub_ui(n, n, 1);
  }
  mpz_mul_2exp(t, a, (mp_bitcnt_t)g);
  mpz_add(n, n, t);
}

/* [n, n + width] 2^-(g + shift) / d */
static void centre_quotient(double out[2], mpz_ptr n, unsigned long width, const dyd_icircle *k, int64_t exp) {
  out[0] = dyd_raw_quotient_get_d(n, exp, k->d, DYD_DOWN);
  mpz_add_ui(n, n, width);
  out[1] = dyd_raw_quotient_get_d(n, exp, k->d, DYD_UP);
}

static void centre_coordinate(double out[2], mpz_srcptr a, mpz_srcptr b, const dyd_icircle *k, int64_t shift) {
  mpz_t n, t;
  mpz_inits(n, t, NULL);
  if (!mpz_sgn(b) || !mpz_sgn(k->c)) {
    mpz_set(n, a);
    centre_quotient(out, n, 0, k, -shift);
  } else if (!dyd_sqrt_sign(a, b, k->c)) {
    out[0] = out[1] = 0;
  } else {
    int64_t size = dyd_bits(b) + dyd_bits(k->c) / 2, g = size > 70 ? 0 : 70 - size;
    centre_enclose(n, t, a, b, k->c, g);
    while (dyd_bits(n) < 64) {
      g = 2 * g + 64;
      centre_enclose(n, t, a, b, k->c, g);
    }
    centre_quotient(out, n, 1, k, -g - shift);
  }
  mpz_clears(n, t, NULL);
}

void dyd_icircle_centre_d(double out[4], const dyd_icircle *k, int64_t shift) {
  centre_coordinate(out, k->ax, k->bx, k, shift);
  centre_coordinate(out + 2, k->ay, k->by, k, shift);
}
