/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The boundary of C_ab = { c : dl_a(c) < ds_b(c) } cut into elementary arcs, one for each pane of the plane in which
 * the farthest corner of a and the closest feature of b stay the same. */
#ifndef DYD_VORONOI_BISECTOR_H
#define DYD_VORONOI_BISECTOR_H

#include "voronoi/exact_cell_filter.h"

enum { DYD_CURVE_ARCS = 16 };

/* { c in the pane lo .. hi (NULL: no bound) : |c - s| = distance to q }, q a corner, or the line of coordinate
 * q[1 - axis] (q[axis] = NULL). The coordinate `axis` is strictly monotone along the arc; end[0] is its lower end.
 * direction = 1: C_ab is on the left when that coordinate grows. shape: the same in doubles. point: the arc is one
 * point, at which the curve touches the border of the pane. */
typedef struct dyd_elementary {
  bool parabola, point;
  int axis, direction, branch;
  dyd_feature_kind corner, feature;
  mpz_srcptr s[2], q[2], lo[2], hi[2];
  dyd_filter_arc shape;
  dyd_spot end[2];
} dyd_elementary;

/* Invariant: arc[0 .. count) meet in end points only; together they are the boundary of C_ab
 * (within the window, if there is one). All numbers are borrowed from the rectangles, and from middle. */
typedef struct dyd_curve {
  mpz_t middle[2];
  size_t count;
  dyd_elementary arc[DYD_CURVE_ARCS];
} dyd_curve;

void dyd_curve_init(dyd_curve *c);
void dyd_curve_clear(dyd_curve *c);

/* A rectangle with its doubles. Invariant: all ends are even, so that middles are integers. */
typedef struct dyd_scaled {
  dyd_irect r;
  dyd_box box;
} dyd_scaled;

/* The arcs of disjoint rectangles far, near, borrowed as long as *out is used. With a window (else NULL), what lies in
 * it; of arcs along a side of the window those that have the region inside: C_ab (side = 1), or its complement (-1). */
void dyd_curve_set(dyd_curve *out, const dyd_scaled *far, const dyd_scaled *near, const dyd_scaled *window, int side,
                   int64_t shift);

/* Is the point p of the curve in the closed pane of the arc? */
bool dyd_elementary_holds(const dyd_elementary *a, const dyd_spot *p);
/* out = the point of the arc's line or branch of parabola whose coordinate a->axis is num / 2^bits. */
void dyd_elementary_at(dyd_surd_point *out, const dyd_elementary *a, mpz_srcptr num, int64_t bits);

#endif
