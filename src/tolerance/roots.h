/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers sqrt(plus) - sqrt(minus), plus and minus rationals that are not negative: compared exactly, enclosed by
 * doubles. */
#ifndef DYD_TOLERANCE_ROOTS_H
#define DYD_TOLERANCE_ROOTS_H

#include <gmp.h>

/* Sign of (sqrt(p) - sqrt(m)) - (sqrt(q) - sqrt(n)). Exact [SQR-2]. */
int dyd_roots_compare(mpq_srcptr p, mpq_srcptr m, mpq_srcptr q, mpq_srcptr n);
/* Doubles around half of |sqrt(p) - sqrt(m)|, rounded down and up: a unit in the last place apart, or two. Both are 0
 * where it is 0; beyond the range of doubles they are the nearest ones on their side, infinite ones included. */
void dyd_roots_half(double *lo, double *hi, mpq_srcptr p, mpq_srcptr m);
/* q rounded to a double, down (up = 0) or up (1). */
double dyd_q_double(mpq_srcptr q, int up);

#endif
