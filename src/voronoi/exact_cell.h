/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries of Int_i and Pos_i: everything one cell needs, on one integer scale. */
#ifndef DYD_VORONOI_EXACT_CELL_H
#define DYD_VORONOI_EXACT_CELL_H

#include "base/flag.h"
#include "base/room.h"
#include "voronoi/exact_cell_filter.h"
#include <dyadel/delaunay.h>

/* The boundary of C_ab = { c : dl_a(c) < ds_b(c) } cut into elementary arcs, one for each pane of the plane in which
 * the farthest corner of a and the closest feature of b stay the same. */

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

/* Sets out[0 .. DYD_CURVE_ARCS), whose ends are initialised, to the boundary of C_ab, in arcs that meet in end points
 * only; returns how many. far, near are disjoint; middle: initialised. All numbers are borrowed from them. With a
 * window (else NULL), the parts in it; of arcs along a side of the window, the ones with the region inside: C_ab (side
 * = 1), or its complement (-1). */
size_t dyd_curve_set(dyd_elementary *out, mpz_t middle[2], const dyd_scaled *far, const dyd_scaled *near,
                     const dyd_scaled *window, int side, int64_t shift);

/* Returns true if the point p of the curve is in the closed pane of the arc. */
bool dyd_elementary_holds(const dyd_elementary *a, const dyd_spot *p);
/* out = the point of the arc's line or branch of parabola whose coordinate a->axis is num / 2^bits. */
void dyd_elementary_at(dyd_surd_point *out, const dyd_elementary *a, mpz_srcptr num, int64_t bits);

/* The task: the region of site `site` against `count` others.
 * rect: the rectangle of `site`, of the others, and of the window if there is one; site numbers ascending. outer: Pos,
 * else Int. pd: only pairs of others that it calls possible share a vertex; NULL: all may. keep_all: without
 * [PRUNE-1], for comparison. cancel: the work ends with DYD_CANCELLED once *cancel is set; may be NULL. room:
 * memory budget; NULL: no bound. All borrowed. */
typedef struct dyd_cell_task {
  uint32_t site;
  const uint32_t *other;
  size_t count;
  const dyd_rect *const *rect;
  bool outer, windowed;
  const dyd_delaunay *pd;
  bool keep_all;
  const volatile int *cancel;
  dyd_room *room;
} dyd_cell_task;

/* The boundary of Int_i or (outer) Pos_i; window NULL: in the whole plane; proved: as for
 * dyd_least_at. As dyd_voronoi_cell, and
 * DYD_CANCELLED once *cancel, which may be NULL, is set; room may be NULL. */
dyd_status dyd_cell_region(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, bool outer, bool proved,
                           const dyd_rect *window, dyd_room *room, const volatile int *cancel);

/* *out is replaced. */
dyd_status dyd_cell_boundary(dyd_boundary *out, const dyd_cell_task *task);

/* dyd_voronoi_side with a status: DYD_E_NOMEM, and DYD_E_ARG when there is no site i, leave *out as it was. */
dyd_status dyd_cell_point_side(dyd_truth *out, const dyd_delaunay *pd, uint32_t i, const dyd_point *c);

#endif
