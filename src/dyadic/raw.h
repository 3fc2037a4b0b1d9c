/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Arithmetic of dyadics, and numbers man * 2^exp without normal form or range that exact code passes around between
 * them.
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

/* ---- arithmetic ---- */

void dyd_dyadic_swap(dyd_dyadic *x, dyd_dyadic *y);
/* Exact. Outputs may alias inputs. DYD_E_RANGE when the result leaves the exponent range. */
dyd_status dyd_dyadic_set_si_2exp(dyd_dyadic *out, long man, int64_t exp);
dyd_status dyd_dyadic_add(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y);
dyd_status dyd_dyadic_sub(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y);
dyd_status dyd_dyadic_mul(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y);
dyd_status dyd_dyadic_mul_2exp(dyd_dyadic *out, const dyd_dyadic *x, int64_t e);
void dyd_dyadic_neg(dyd_dyadic *out, const dyd_dyadic *x);
/* The nearest multiple of 2^exp that is <= x (DYD_DOWN) or >= x (DYD_UP). */
dyd_status dyd_dyadic_round(dyd_dyadic *out, const dyd_dyadic *x, int64_t exp, dyd_round dir);
/* The same for a rational. q must be canonical. */
dyd_status dyd_dyadic_round_q(dyd_dyadic *out, const mpq_t q, int64_t exp, dyd_round dir);
/* Does x fit a double without rounding? */
bool dyd_dyadic_is_double(const dyd_dyadic *x);
/* Sign of a + b sqrt(c) for integers, c >= 0 [SQR-1]. Exact. */
int dyd_sqrt_sign(const mpz_t a, const mpz_t b, const mpz_t c);
/* Sign of a + b sqrt(c) + d sqrt(e) for integers, c, e >= 0 [SQR-2]. Exact. */
int dyd_sqrt2_sign(const mpz_t a, const mpz_t b, const mpz_t c, const mpz_t d, const mpz_t e);

#endif
