/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A number (a + b sqrt(c)) / d, d > 0, c >= 0, against an integer interval. */
#ifndef DYD_PREDICATE_SURD_H
#define DYD_PREDICATE_SURD_H

#include <gmp.h>
#include <stdint.h>

/* Borrowed parts. */
typedef struct dyd_surd {
  mpz_srcptr a, b, c, d;
} dyd_surd;

/* z * 2^e for e > 0; nothing otherwise. */
static inline void dyd_shift_up(mpz_ptr z, int64_t e) {
  if (e > 0) mpz_mul_2exp(z, z, (mp_bitcnt_t)e);
}

/* The end of [lo,hi] closest to s, or NULL when s is strictly within; t is scratch. */
mpz_srcptr dyd_surd_closest(mpz_ptr t, const dyd_surd *s, mpz_srcptr lo, mpz_srcptr hi);
/* The end of [lo,hi] farthest from s (hi at the middle); t, u are scratch. */
mpz_srcptr dyd_surd_farthest(mpz_ptr t, mpz_ptr u, const dyd_surd *s, mpz_srcptr lo, mpz_srcptr hi);

#endif
