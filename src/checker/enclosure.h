/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Intervals of fixed point numbers that hold true values: [lo, hi] 2^-p for a precision p that the caller keeps.
 *
 * Every operation rounds outward. Where an operation may be undefined, or too large, nothing is known of its value. */
#ifndef DYD_CHECKER_ENCLOSURE_H
#define DYD_CHECKER_ENCLOSURE_H

#include <gmp.h>
#include <stdbool.h>

/* known false: of the value nothing is known. */
typedef struct dyd_cert_enclosure {
  mpz_t lo, hi;
  bool known;
} dyd_cert_enclosure;

void dyd_cert_enclosure_init(dyd_cert_enclosure *x);
void dyd_cert_enclosure_clear(dyd_cert_enclosure *x);
void dyd_cert_enclosure_set(dyd_cert_enclosure *x, const dyd_cert_enclosure *y);
/* x = z. */
void dyd_cert_enclosure_set_si(dyd_cert_enclosure *x, long z, long p);
/* x = num / den, den > 0. */
void dyd_cert_enclosure_set_q(dyd_cert_enclosure *x, mpz_srcptr num, mpz_srcptr den, long p);
/* The sign; 0: not known, or 0. */
int dyd_cert_enclosure_sign(const dyd_cert_enclosure *x);

/* x = op y, or x op y; operands may be the same. */
void dyd_cert_enclosure_add(dyd_cert_enclosure *x, const dyd_cert_enclosure *y);
void dyd_cert_enclosure_sub(dyd_cert_enclosure *x, const dyd_cert_enclosure *y);
void dyd_cert_enclosure_neg(dyd_cert_enclosure *x);
void dyd_cert_enclosure_mul(dyd_cert_enclosure *x, const dyd_cert_enclosure *y, long p);
void dyd_cert_enclosure_div(dyd_cert_enclosure *x, const dyd_cert_enclosure *y, long p);
void dyd_cert_enclosure_pow(dyd_cert_enclosure *x, long n, long p);
/* The real k-th root, k = 2 or 3, of what is known; the number of which it is the square root is at least 0. */
void dyd_cert_enclosure_root(dyd_cert_enclosure *x, unsigned long k, long p);
void dyd_cert_enclosure_abs(dyd_cert_enclosure *x);
/* The lesser (sign < 0) or the greater. */
void dyd_cert_enclosure_extreme(dyd_cert_enclosure *x, int sign, const dyd_cert_enclosure *y);
void dyd_cert_enclosure_pi(dyd_cert_enclosure *x, long p);
/* From precision p to p + by, outward. */
void dyd_cert_enclosure_rescale(dyd_cert_enclosure *x, long by);
/* Of what is known; the logarithm, where x is positive, the inverse sine and cosine, where x is at most 1 in absolute
 * value. */
void dyd_cert_enclosure_exp(dyd_cert_enclosure *x, long p);
void dyd_cert_enclosure_log(dyd_cert_enclosure *x, long p);
void dyd_cert_enclosure_atan(dyd_cert_enclosure *x, long p);
void dyd_cert_enclosure_asin(dyd_cert_enclosure *x, long p);
void dyd_cert_enclosure_acos(dyd_cert_enclosure *x, long p);
/* out = what is known from y 2^-p, wherever that is, of log x for x > 0, of atan x. */
void dyd_cert_enclosure_log_from(dyd_cert_enclosure *out, const dyd_cert_enclosure *x, mpz_srcptr y, long p);
void dyd_cert_enclosure_atan_from(dyd_cert_enclosure *out, const dyd_cert_enclosure *x, mpz_srcptr y, long p);
/* c = cos x, s = sin x. */
void dyd_cert_enclosure_cos_sin(dyd_cert_enclosure *c, dyd_cert_enclosure *s, const dyd_cert_enclosure *x, long p);

#endif
