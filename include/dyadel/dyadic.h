/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact dyadic numbers m * 2^e. For arithmetic take their rationals (dyd_dyadic_get_q) and GMP. */
#ifndef DYADEL_DYADIC_H
#define DYADEL_DYADIC_H

#include <dyadel/status.h>
#include <gmp.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Every bit of a dyadic lies between 2^-DYD_EXP_LIMIT and 2^DYD_EXP_LIMIT, so that the span of any two
 * numbers, hence the size of every intermediate integer, is bounded and GMP cannot overflow. */
#define DYD_EXP_LIMIT ((int64_t)1 << 20)

/* The number man * 2^exp.
 * Invariant: man is odd, or man = 0 and exp = 0; exp >= -DYD_EXP_LIMIT; exp + bits(man) <= DYD_EXP_LIMIT.
 * A plain struct: init before use, clear after. */
typedef struct dyd_dyadic {
  mpz_t man;
  int64_t exp;
} dyd_dyadic;

/* Direction of a rounding. */
typedef enum dyd_round { DYD_DOWN = -1, DYD_UP = 1 } dyd_round;

DYD_API void dyd_dyadic_init(dyd_dyadic *x);
DYD_API void dyd_dyadic_clear(dyd_dyadic *x);
DYD_API void dyd_dyadic_set(dyd_dyadic *out, const dyd_dyadic *x);

/* DYD_E_ARG for infinities and NaN; DYD_E_RANGE when the value leaves the exponent range. */
DYD_API dyd_status dyd_dyadic_set_d(dyd_dyadic *out, double x);
DYD_API dyd_status dyd_dyadic_set_z_2exp(dyd_dyadic *out, const mpz_t man, int64_t exp);

/* -1, 0 or 1. */
DYD_API int dyd_dyadic_sgn(const dyd_dyadic *x);
DYD_API int dyd_dyadic_cmp(const dyd_dyadic *x, const dyd_dyadic *y);

/* The exact value as a canonical rational; q is initialised by the caller. */
DYD_API void dyd_dyadic_get_q(mpq_t q, const dyd_dyadic *x);
/* The nearest double in the given direction: -inf / +inf beyond the largest double, subnormals included. */
DYD_API double dyd_dyadic_get_d(const dyd_dyadic *x, dyd_round dir);

/* Lossless text "m*2^e" (or a plain integer when 0 <= e <= 64). Owned by the caller, release with free();
 * NULL when memory is exhausted. */
DYD_API char *dyd_dyadic_get_str(const dyd_dyadic *x);
/* Reads an integer, "m*2^e", a hexadecimal float or a decimal that is a dyadic ("0.125"), surrounding blanks
 * allowed. err may be NULL; on DYD_E_PARSE its column names the first bad character. */
DYD_API dyd_status dyd_dyadic_set_str(dyd_dyadic *out, const char *text, dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
