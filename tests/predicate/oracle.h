/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Slow literal oracle for critical circles, in rationals with one square root.
 *
 * Shares nothing with the library but the number types. A critical circle passes through a corner P of each choice;
 * every combination of a corner of each F-rectangle and a corner or side of each C-rectangle is solved by walking
 * along a line of possible centres O + t D (rational O, D) and solving a quadratic in t, and every root is checked
 * against the definition of ds and dl: all four corners, all feet. */
#ifndef DYD_TESTS_ORACLE_H
#define DYD_TESTS_ORACLE_H

#include <dyadel/predicate.h>

/* a + b sqrt(c), c >= 0 shared by the numbers that meet. */
typedef struct root_number {
  mpq_t a, b;
} root_number;

typedef struct oracle_circle {
  root_number x, y, r2;
  mpq_t c;
} oracle_circle;

void oracle_circle_init(oracle_circle *k);
void oracle_circle_clear(oracle_circle *k);

/* Small rectangles: integer corners, each below 1000 in absolute value: x0, x1, y0, y1. */
typedef struct small_rect {
  int end[4];
} small_rect;

/* Sign of (distance from the centre to r, closest or farthest)^2 - radius^2. */
int oracle_side(const oracle_circle *k, const small_rect *r, dyd_touch touch);

/* All critical circles with positive radius, without repeats; at most `room` are stored. Returns how many. */
size_t oracle_circles(oracle_circle *out, size_t room, const small_rect r[3], const dyd_touch touch[3]);

/* The common sign of the determinant over the 64 choices of corners. */
dyd_sure oracle_orientation(const small_rect *a, const small_rect *b, const small_rect *c);

/* Con by the definition: I and E of the six circles. */
dyd_sure oracle_con(const small_rect *r, const small_rect abc[3]);

/* Returns true if the circle is the same: equal centre coordinates (ax + bx sqrt c) / d. */
bool oracle_same_centre(const oracle_circle *k, const dyd_circle *c);

void small_rect_get(dyd_rect *out, const small_rect *r);

#endif
