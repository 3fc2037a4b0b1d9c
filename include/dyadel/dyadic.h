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

/* Forms of a number in a text that a place takes, besides decimal digits. */
typedef enum dyd_number_form {
  DYD_NUMBER_MINUS = 1,     /* the sign - in front */
  DYD_NUMBER_PLUS = 2,      /* the sign + in front */
  DYD_NUMBER_POINT = 4,     /* a point within, before or behind the digits */
  DYD_NUMBER_EXPONENT = 8,  /* e-3 or E+3, and p-3 behind hexadecimal digits */
  DYD_NUMBER_HEX = 16,      /* 0x and hexadecimal digits, with a point where DYD_NUMBER_POINT is given, too */
  DYD_NUMBER_QUOTIENT = 32, /* a whole decimal number, / and another one */
  DYD_NUMBER_TWOS = 64,     /* *2^-3 behind the number */
  DYD_NUMBER_INDENT = 128,  /* blanks in front: spaces, tabs, ends of lines */
  DYD_NUMBER_BLANKS = 256,  /* blanks in front and at the end */
  DYD_NUMBER_ANY = 511      /* all of them */
} dyd_number_form;

/* Lossless text "m*2^e" (or a plain integer when 0 <= e <= 64). Owned by the caller, release with free();
 * NULL when memory is exhausted. */
DYD_API char *dyd_dyadic_get_str(const dyd_dyadic *x);
/* Reads a number in any form but a quotient, that is a dyadic ("0.125", "5*2^-20", "0x1.8p-3"). err may be NULL; on
 * DYD_E_PARSE its column names the first bad character. */
DYD_API dyd_status dyd_dyadic_set_str(dyd_dyadic *out, const char *text, dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
