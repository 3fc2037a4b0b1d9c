/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers man * 2^exp of any size, without normal form: the arithmetic of the certificate checker.
 *
 * Inputs have exponents and lengths below DYD_EXP_LIMIT, and a check multiplies a handful of them, so exponents stay
 * far from the ends of int64_t. Nothing here can fail. */
#ifndef DYD_CHECKER_EXACT_H
#define DYD_CHECKER_EXACT_H

#include <gmp.h>
#include <stdbool.h>
#include <stdint.h>

typedef struct dyd_exact {
  mpz_t man;
  int64_t exp;
} dyd_exact;

void dyd_exact_init(dyd_exact *x);
void dyd_exact_clear(dyd_exact *x);
void dyd_exact_set(dyd_exact *out, const dyd_exact *x);
/* Outputs may alias inputs. */
void dyd_exact_add(dyd_exact *out, const dyd_exact *x, const dyd_exact *y);
void dyd_exact_sub(dyd_exact *out, const dyd_exact *x, const dyd_exact *y);
void dyd_exact_mul(dyd_exact *out, const dyd_exact *x, const dyd_exact *y);
void dyd_exact_mul_z(dyd_exact *out, const dyd_exact *x, mpz_srcptr z);
int dyd_exact_cmp(const dyd_exact *x, const dyd_exact *y);
int dyd_exact_sgn(const dyd_exact *x);
/* x < 2^result <= 2 |x| in absolute value; INT64_MIN for 0. */
int64_t dyd_exact_top(const dyd_exact *x);
/* out = floor(x / (den 2^exp)), or the ceiling; den > 0, NULL: 1. */
void dyd_exact_floor(mpz_ptr out, const dyd_exact *x, mpz_srcptr den, int64_t exp);
void dyd_exact_ceil(mpz_ptr out, const dyd_exact *x, mpz_srcptr den, int64_t exp);

#endif
