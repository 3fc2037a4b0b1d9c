/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The partial convex hull: directions in which a site can be extreme, quadrant by quadrant. */
#ifndef DYD_DELAUNAY_PARTIAL_HULL_H
#define DYD_DELAUNAY_PARTIAL_HULL_H

#include "delaunay/state.h"
#include "predicate/interval_filter.h"

/* A vertex that may be on the hull: its rectangle x0 x1 y0 y1 mirrored so that the directions considered are u >= 0,
 * exactly and in doubles. chain: the faces that are proved chains of the hull, of which it is a vertex; DYD_NONE: no
 * more of them. True points are on two sides of the hull at most. */
typedef struct dyd_extreme {
  uint32_t vertex, chain[2];
  bool possible, sure;
  mpq_t e[4];
  dyd_iv d[4];
} dyd_extreme;

/* A corner of an extreme's rectangle: the lower left (upper = 0) or the upper right one (upper = 1). */
typedef struct dyd_hull_corner {
  const dyd_extreme *of;
  int upper;
} dyd_hull_corner;

/* ---- partial_hull_filter.c ---- */

/* Sign of the cross product of the vectors a -> b and c -> d. Exact. */
int dyd_hull_cross(dyd_hull_corner a, dyd_hull_corner b, dyd_hull_corner c, dyd_hull_corner d);
/* Compares coordinates; axis 0 is x. Exact. */
int dyd_hull_compare(int axis, dyd_hull_corner a, dyd_hull_corner b);
void dyd_extreme_enclose(dyd_extreme *x);

/* ---- partial_hull.c ---- */

/* Pairs of indices of extremes, i < j. */
typedef struct dyd_hull_pairs {
  dyd_pair *item;
  size_t count, cap, most;
  bool capped; /* there are more than `most` */
} dyd_hull_pairs;

#endif
