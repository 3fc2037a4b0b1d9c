/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Elementary arcs of the boundary of C_ab = { c : dl_a(c) < ds_b(c) }, exactly: one for each pane of the plane in which
 * the farthest corner of a and the closest feature of b stay the same. */
#ifndef DYD_VORONOI_ELEMENTARY_H
#define DYD_VORONOI_ELEMENTARY_H

#include "voronoi/surd_point.h"

/* { c in the pane lo .. hi (NULL: no bound) : |c - s| = distance to q }, q a corner, or the line of coordinate
 * q[1 - axis] (q[axis] = NULL); all borrowed. The coordinate `axis` is strictly monotone along the arc; end[0] is its
 * lower end, if it is not infinite. point: the arc is one point, at which the curve touches the border of the pane. */
typedef struct dyd_elementary {
  bool parabola, point, infinite[2];
  int axis, branch;
  mpz_srcptr s[2], q[2], lo[2], hi[2];
  dyd_surd_point end[2];
} dyd_elementary;
void dyd_elementary_init(dyd_elementary *a);
void dyd_elementary_clear(dyd_elementary *a);

/* Which coordinate to go along: across q - s where it is longer, or along the directrix. */
int dyd_elementary_axis(const dyd_elementary *a);
/* out = the point of the line or branch of parabola whose coordinate a->axis is num / 2^bits. */
void dyd_elementary_at(dyd_surd_point *out, const dyd_elementary *a, mpz_srcptr num, int64_t bits);
/* Sets the ends and `point`; false: nothing in the pane. Of arcs along a side of the pane, the ones with the region
 * inside: C_ab (side = 1), or its complement (-1). */
bool dyd_elementary_clip(dyd_elementary *a, int side);
/* Returns true if a point of the curve is in the closed pane. */
bool dyd_elementary_holds(const dyd_elementary *a, const dyd_surd_point *p);

#endif
