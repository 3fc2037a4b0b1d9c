/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers as text for output: decimals rounded in a known direction, exact ends of intervals. */
#ifndef DYD_IO_DECIMAL_H
#define DYD_IO_DECIMAL_H

#include "io/sink.h"
#include "rect/sites_table.h"
#include <dyadel/arc.h>

/* Sign, 17 digits, point, exponent or zeros, terminator. */
#define DYD_DECIMAL_SIZE 32

/* The decimal of at most `digits` (2..17) significant digits next to x in direction dir; "inf", "-inf". A reader
 * that takes it for a double, in any rounding that is monotone, stays on that side of x. Returns its length. */
size_t dyd_decimal_directed(char out[DYD_DECIMAL_SIZE], double x, int digits, dyd_round dir);
/* A short decimal for some double r in [lo,hi] (finite): r is the nearest double to the decimal. *error is an upper
 * bound of the distance from the decimal to any number in [lo,hi]. Returns its length. */
size_t dyd_decimal_within(char out[DYD_DECIMAL_SIZE], double *error, double lo, double hi);
/* The decimal "d.ddde-61" of 2..17 significant digits next to x in direction dir, however small or large x is. */
void dyd_decimal_dyadic(char out[DYD_DECIMAL_SIZE], const dyd_dyadic *x, int digits, dyd_round dir);
/* Puts the decimal of 17 digits next to x, or `otherwise` for infinities and NaN. */
void dyd_sink_decimal(dyd_sink *s, double x, dyd_round dir, const char *otherwise);
/* The same to a file. */
void dyd_decimal_put(FILE *out, double x, dyd_round dir, const char *otherwise);
/* Prints a short decimal whose nearest double is the finite x. */
void dyd_decimal_put_near(FILE *out, double x);
/* The exact lower (upper) end: "m*2^e", an integer, or a rational "p/q"; a coordinate that the reader takes.
 * Release with free(); NULL when memory is exhausted. */
char *dyd_end_text(const dyd_interval *a, bool upper);
/* The same text of a number of single words, without a terminator; returns its end, NULL where it is too long for this
 * quick way: where it is an integer above 2^64, or has a denominator above 2^126. */
enum { DYD_WORDS_SIZE = 64 };
char *dyd_words_put(char to[DYD_WORDS_SIZE], const dyd_words *w);

/* The powers of five that are single words: 5^27 < 2^63 < 5^28. */
enum { DYD_MOST_FIVES = 27 };
extern const uint64_t dyd_power_of_five[DYD_MOST_FIVES + 1];

/* ---- numbers (a + b sqrt(c)) / d ---- */

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
