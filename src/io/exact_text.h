/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers (a + b sqrt(c)) / d as text: exactly, and enclosed by decimals. */
#ifndef DYD_IO_EXACT_TEXT_H
#define DYD_IO_EXACT_TEXT_H

#include <dyadel/arc.h>
#include <stdio.h>

/* "7", "-3/4", "(3-2*sqrt(5))/7": a coordinate that the reader of points takes. */
void dyd_exact_text(FILE *out, mpz_srcptr a, mpz_srcptr b, mpz_srcptr c, mpz_srcptr d);
/* x lower, x upper, y lower, y upper, rounded down and up; -inf, inf beyond the largest double. */
void dyd_exact_enclose(double box[4], const dyd_surd_point *p);
/* The same for the square root of the x coordinate, which is not negative. */
void dyd_exact_enclose_root(double *lo, double *hi, const dyd_surd_point *p);
/* "LO<between>HI" as directed decimals. */
void dyd_exact_decimals(FILE *out, double lo, double hi, const char *between);
/* The middle of the coordinates' decimals, for drawing. */
void dyd_exact_middle(double out[2], const dyd_surd_point *p);
/* A circle as points in lowest terms: its centre, and (radius^2, 0). Copied. */
void dyd_exact_circle(dyd_surd_point *centre, dyd_surd_point *radius2, const dyd_circle *k);

#endif
