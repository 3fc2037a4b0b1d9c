/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sites as lines over the bisector of a pair, in integers: what tolerances are made of (mathematics: section 12).
 *
 * Let i be the origin, J = p_j - p_i, J' its left turn. A centre on the bisector is c(s) = J/2 + s J', its squared
 * distance to i and j is r^2 = |J|^2 (1/4 + s^2). For another site at P,
 *     |c - P|^2 - |c|^2 = D(s) = m - 2 n s,     m = P.(P - J),  n = J'.P:
 * a line. So the site nearest to c is the lowest line at s, whatever r is, and f(s) = min |c - P| - |c|
 * = sqrt(r^2 + E(s)) - r with E the lower envelope: the supremum of f is w(ij) [TOL-1]. */
#ifndef DYD_TOLERANCE_LINES_H
#define DYD_TOLERANCE_LINES_H

#include "rect/irect.h"
#include "skeleton/skeleton.h"

/* along: P.J; m, n as above. All in integers: coordinates multiplied by a common factor. */
typedef struct dyd_line_over {
  uint32_t vertex;
  mpz_t m, n, along;
} dyd_line_over;

/* Invariant: item, rect and grid are initialised up to made; item[0 .. count-1] are in use, no vertex twice.
 * Coordinates were multiplied by factor > 0; (ix, iy) is p_i then. */
typedef struct dyd_lines {
  mpz_t ix, iy, jx, jy, jj;
  mpq_t factor;
  dyd_line_over *item;
  dyd_rect *rect;
  dyd_irect *grid;
  size_t count, made;
  mpz_t u, v, x, y; /* scratch */
} dyd_lines;

/* s = p / (2 q), q > 0; q = 0, p = 1 or -1: the end of the bisector at infinity. */
typedef struct dyd_bisector_place {
  mpz_t p, q;
} dyd_bisector_place;

/* What limits f at its supremum: TWO lines that cross, ONE line at its own summit (a disc touches that of i or j), or
 * one line at the END of the bisector (a half-plane). a, b: numbers in item[]; a = b unless TWO. w = sqrt(plus) -
 * sqrt(minus). */
typedef enum dyd_binding { DYD_BINDING_NONE, DYD_BINDING_TWO, DYD_BINDING_ONE, DYD_BINDING_END } dyd_binding;
typedef struct dyd_summit {
  dyd_binding binding;
  size_t a, b;
  dyd_bisector_place at;
  mpq_t plus, minus;
} dyd_summit;

void dyd_lines_init(dyd_lines *l);
void dyd_lines_clear(dyd_lines *l);
void dyd_summit_init(dyd_summit *s);
void dyd_summit_clear(dyd_summit *s);

/* The lines of the vertices k[0 .. count-1], others than i and j, over the bisector of the vertices i and j, which are
 * different exact points. A vertex that is named twice counts once. */
dyd_status dyd_lines_load(dyd_lines *l, const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t *k,
                          size_t count);

/* Which of two lines is lower at a place: the sign of D_a - D_b; at an end, of that near it. */
int dyd_line_compare(dyd_lines *l, const dyd_bisector_place *at, size_t a, size_t b);
/* The lowest line there, the first of several. There must be lines. */
size_t dyd_line_lowest(dyd_lines *l, const dyd_bisector_place *at);
/* Sign of D_k there; at an end, near it. */
int dyd_line_height(dyd_lines *l, const dyd_bisector_place *at, size_t k);
/* Does g = sqrt(r^2 + D_k) - r rise or fall as s grows: 1, -1; 0 at its summit. */
int dyd_line_trend(dyd_lines *l, const dyd_bisector_place *at, size_t k);
/* The summit of g, where the disc of k touches that of i or j; false: g has none. */
bool dyd_line_summit(dyd_bisector_place *at, dyd_lines *l, size_t k);
/* Where lines a and b cross; false: they are parallel. */
bool dyd_line_cross(dyd_bisector_place *at, const dyd_lines *l, size_t a, size_t b);

/* The supremum of f where it is positive somewhere (a pair that is strictly Delaunay for these sites): O(count) for
 * each line that comes to bind. NONE when there are no lines: there is no bound. */
void dyd_lines_death(dyd_summit *out, dyd_lines *l);
/* The supremum of f where it is nowhere positive: the best corner of the envelope, or end. O(count^2). */
void dyd_lines_birth(dyd_summit *out, dyd_lines *l);
/* The summit where the two lines, or the end where the one line, are known to bind. */
void dyd_lines_birth_by(dyd_summit *out, dyd_lines *l);
/* About s at the place; 0 at an end. */
double dyd_summit_place(const dyd_summit *s);
/* A box of doubles around the centre at s->at, and an upper bound of its squared distance to line s->a; false at an
 * end, where there is none. */
bool dyd_summit_disc(double box[4], double *radius2, const dyd_summit *s, dyd_lines *l);

#endif
