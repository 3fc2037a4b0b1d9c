/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Predicates in doubles on boxes: proved answers, or none.
 *
 * A box is {x lower, x upper, y lower, y upper}, a superset of a rectangle (rounded outward; infinite ends allowed).
 * A statement for every choice in the boxes holds in the rectangles. Claims that some choice exists need exact boxes,
 * that is boxes equal to their rectangles. All bounds come from predicate/interval_filter.h; an overflow or an infinite
 * end makes the answer "not known". */
#ifndef DYD_PREDICATE_PREDICATE_FILTER_H
#define DYD_PREDICATE_PREDICATE_FILTER_H

#include "predicate/interval_filter.h"
#include <dyadel/predicate.h>

/* A rectangle in doubles. Invariant: outer contains the rectangle; end[k] encloses its k-th end (x0, x1, y0, y1);
 * exact iff outer is the rectangle. */
typedef struct dyd_box {
  double outer[4];
  dyd_iv end[4];
  bool exact;
} dyd_box;

void dyd_filter_box(dyd_box *out, const dyd_rect *r);
/* Enclosures of both coordinates. */
void dyd_filter_point(dyd_iv out[2], const dyd_point *c);

/* How the choices of corners turn, as far as known. all_*: for every choice in the boxes. some_*: for some choice of
 * corners of the boxes. */
typedef struct dyd_turns {
  bool all_left, all_right, some_left, some_right;
} dyd_turns;

dyd_turns dyd_filter_turns(const double a[4], const double b[4], const double c[4]);

/* PLUS: every choice in the boxes turns left, MINUS: right; UNSURE: not known. */
dyd_sure dyd_filter_orientation(const double a[4], const double b[4], const double c[4]);

/* Sign of the in-circle determinant of every choice: for a, b, c counter-clockwise PLUS means d inside the circle,
 * MINUS outside. UNSURE: not known. */
dyd_sure dyd_filter_incircle(const double a[4], const double b[4], const double c[4], const double d[4]);

/* true: two choices in the boxes have in-circle determinants of opposite signs. a, b, c certainly oriented. */
bool dyd_filter_incircle_mixed(const double a[4], const double b[4], const double c[4], const double d[4]);

/* TRUE: the convex hulls of a u b and of c u d are disjoint; FALSE (exact boxes only): they meet. */
dyd_truth dyd_filter_partial_edges_disjoint(const dyd_box *a, const dyd_box *b, const dyd_box *c, const dyd_box *d);

/* Enclosure of the square of the closest or farthest distance from c to r. */
dyd_iv dyd_filter_distance2(dyd_iv cx, dyd_iv cy, const dyd_box *r, dyd_touch touch);

#endif
