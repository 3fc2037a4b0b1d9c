/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers man * 2^exp without normal form or range: what the exact code passes around between dyadics.
 *
 * Exponents of dyadics are bounded by DYD_EXP_LIMIT, so a raw number made from a few of them has a few million bits
 * at most and an exponent far from the ends of int64_t. */
#ifndef DYD_DYADIC_RAW_H
#define DYD_DYADIC_RAW_H

#include <dyadel/dyadic.h>

/* Length of |man| in bits; 0 for 0. */
int64_t dyd_bits(mpz_srcptr man);

/* Is x in normal form and in range? */
bool dyd_dyadic_is_valid(const dyd_dyadic *x);

/* out = man * 2^exp, man is destroyed. DYD_E_RANGE (out unchanged) when the value leaves the exponent range. */
dyd_status dyd_dyadic_take(dyd_dyadic *out, mpz_ptr man, int64_t exp);

/* man * 2^*exp = x + sign * y, exactly; man must not alias. sign is 1 or -1. */
void dyd_raw_add(mpz_ptr man, int64_t *exp, const dyd_dyadic *x, const dyd_dyadic *y, int sign);

/* Sign of x * p - y * q for positive p, q. */
int dyd_raw_cmp(const dyd_dyadic *x, mpz_srcptr p, const dyd_dyadic *y, mpz_srcptr q);

/* The double nearest to man * 2^exp in the given direction, subnormal and infinite results included. */
double dyd_raw_get_d(mpz_srcptr man, int64_t exp, dyd_round dir);
/* The same for man * 2^exp / den, den > 0. */
double dyd_raw_quotient_get_d(mpz_srcptr man, int64_t exp, mpz_srcptr den, dyd_round dir);

/* The least e with 2^e >= |q|, or one more; q is not 0. (With a and b bits in numerator and denominator, |q| lies
 * strictly between 2^(a-b-1) and 2^(a-b+1).) */
int64_t dyd_q_log2_above(mpq_srcptr q);

#endif
