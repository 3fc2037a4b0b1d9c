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

/* The arcs of disjoint rectangles far, near, borrowed as long as *out is used. With a window (else NULL), their parts
 * in it; of arcs along a side of the window, the ones with the region inside: C_ab (side = 1), or its complement (-1).
 */
void dyd_curve_set(dyd_curve *out, const dyd_scaled *far, const dyd_scaled *near, const dyd_scaled *window, int side,
                   int64_t shift);

/* Is the point p of the curve in the closed pane of the arc? */
bool dyd_elementary_holds(const dyd_elementary *a, const dyd_spot *p);
/* out = the point of the arc's line or branch of parabola whose coordinate a->axis is num / 2^bits. */
void dyd_elementary_at(dyd_surd_point *out, const dyd_elementary *a, mpz_srcptr num, int64_t bits);

/* The task: the region of site `site` against `count` others.
 * rect: the rectangle of `site`, of the others, and of the window if there is one; site numbers ascending. outer: Pos,
 * else Int. pd: only pairs of others that it calls possible share a vertex; NULL: all may. keep_all: without
 * dyd_cell_prune, for comparison. cancel: the work ends with DYD_CANCELLED once *cancel is set; may be NULL. room:
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

/* Part of an arc of curve `curve` (or of side curve - count of the window, arc = NULL), in the direction that has the
 * region on the left. begin, end: borrowed from the curves, the meets or the corners. */
typedef struct dyd_piece {
  size_t curve;
  const dyd_elementary *arc;
  const dyd_spot *begin, *end;
} dyd_piece;

/* Points at which the curves of two others cross. */
typedef struct dyd_meet {
  uint32_t curve[2];
  dyd_spot spot;
} dyd_meet;

/* Shared by all parts of the work on a cell: the rectangles of the site and of the window in one scale. */
typedef struct dyd_cell_frame {
  dyd_touch fixed_touch, other_touch;
  dyd_scaled fixed, window;
  mpz_t man, ox, oy;
  int64_t exp, shift;
  dyd_spot corner[4]; /* of the window: x0 y0, x1 y0, x1 y1, x0 y1 */
} dyd_cell_frame;

/* Coordinates are F (x - o) for the caller's x: F = man * 2^exp, even on rectangles; o = the centre of `fixed`, about.
 * curve[k]: the boundary of C_ik (Int) or C_ki (Pos), count = 0 if the rectangles meet. kept: the rectangles that do
 * not meet `fixed`, the only ones that matter to Pos; Int is empty when there are others. */
typedef struct dyd_exact_cell {
  const dyd_cell_task *task;
  const dyd_cell_frame *frame; /* borrowed */
  size_t count;
  uint32_t *site;
  dyd_scaled *other;
  dyd_curve *curve;
  dyd_meet *meet;
  size_t meets, meet_cap;
  uint64_t bytes; /* of the curves, and of the digits of the meets */
  dyd_piece *piece;
  size_t pieces, piece_cap;
  dyd_sample sample;
  size_t taker;         /* the other that took the last sample: it likely takes the next */
  const dyd_spot **cut; /* scratch: cuts of one arc */
  size_t cut_cap;
} dyd_exact_cell;

/* How many circles two curves of one rectangle can share, a circle too many included: a convex curve crosses each of
 * the at most ten lines that bound panes of the three rectangles at most twice, so it runs through at most 21 panes,
 * and each holds at most two. */
enum { DYD_CELL_CIRCLES = 43 };
/* Sign of (distance of p to other k) - (distance to the fixed rectangle), each closest or farthest as the task has it.
 */
int dyd_cell_spot_side(const dyd_exact_cell *c, const dyd_spot *p, size_t k);
/* Sign of (coordinate of p) - (that of q). */
int dyd_cell_spot_cmp(const dyd_spot *p, const dyd_spot *q, int axis);

/* Side of the window: bottom, right, top, left. Its axis, and the coordinate of the other axis. */
static inline int dyd_window_axis(int side) {
  return side & 1;
}
/* Fills curve, meet, piece, empty before; and their release. */
dyd_status dyd_cell_find_pieces(dyd_exact_cell *c);
void dyd_cell_forget(dyd_exact_cell *c);
/* task and frame are borrowed; the arrays other and site are owned, the numbers in other are not. */
void dyd_cell_init(dyd_exact_cell *c, const dyd_cell_task *task, const dyd_cell_frame *frame);
void dyd_cell_clear(dyd_exact_cell *c);
/* Removes others that certainly do not bound the region, before the search for pieces. [PRUNE-1] */
dyd_status dyd_cell_prune(dyd_exact_cell *c);
/* The boundary of Int_i or (outer) Pos_i; window NULL: in the whole plane. As dyd_voronoi_int and its kin, and
 * DYD_CANCELLED once *cancel, which may be NULL, is set; room may be NULL. */
dyd_status dyd_cell_region(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, bool outer, const dyd_rect *window,
                           dyd_room *room, const volatile int *cancel);

/* *out is replaced. */
dyd_status dyd_cell_boundary(dyd_boundary *out, const dyd_cell_task *task);

/* dyd_voronoi_side with a status: DYD_E_NOMEM, and DYD_E_ARG when there is no site i, leave *out as it was. */
dyd_status dyd_cell_point_side(dyd_truth *out, const dyd_delaunay *pd, uint32_t i, const dyd_point *c);

#endif
