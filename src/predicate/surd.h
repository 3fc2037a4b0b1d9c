/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A number (a + b sqrt(c)) / d, d > 0, c >= 0, against integers and integer rectangles. */
#ifndef DYD_PREDICATE_SURD_H
#define DYD_PREDICATE_SURD_H

#include "rect/irect.h"
#include <dyadel/predicate.h>

/* Borrowed parts. */
typedef struct dyd_surd {
  mpz_srcptr a, b, c, d;
} dyd_surd;

/* z * 2^e for e > 0; nothing otherwise. */
static inline void dyd_shift_up(mpz_ptr z, int64_t e) {
  if (e > 0) mpz_mul_2exp(z, z, (mp_bitcnt_t)e);
}

/* Sign of s - z; t is scratch. */
int dyd_surd_compare(mpz_ptr t, const dyd_surd *s, mpz_srcptr z);
/* The end of r along the axis closest to s, NULL when s is strictly within; or farthest from s (the upper one at the
 * middle). t, u are scratch. */
mpz_srcptr dyd_surd_end(mpz_ptr t, mpz_ptr u, const dyd_surd *s, const dyd_irect *r, int axis, dyd_touch touch);
/* p + q sqrt(c) += d^2 (distance from the point (x, y) to r)^2, closest or farthest; x, y have one c and one d. */
void dyd_surd_add_distance2(mpz_ptr p, mpz_ptr q, const dyd_surd xy[2], const dyd_irect *r, dyd_touch touch);

#endif
