/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The boundary of Int_i or Pos_i at work, and the exact numbers that are made where intervals leave a doubt
 * [OUTLINE-1]. */
#ifndef DYD_VORONOI_OUTLINE_H
#define DYD_VORONOI_OUTLINE_H

#include "base/memory.h"
#include "delaunay/state.h"
#include "predicate/predicate_filter.h"
#include "voronoi/surd_point.h"

/* Marks on one axis: ends of the window, the middle of the far rectangle, ends of the near one. */
enum { DYD_WINDOW_LO, DYD_WINDOW_HI, DYD_MIDDLE, DYD_NEAR_LO, DYD_NEAR_HI, DYD_MARKS };

/* The line or parabola of an arc: |c - s| = |c - q|, or distance to the line of coordinate q[1 - axis]. */
typedef struct dyd_filter_arc {
  dyd_iv s[2], q[2];
  bool parabola;
} dyd_filter_arc;

/* What a point is: end number & 1 of arc number / 2; meet number; corner number of the window. */
typedef enum dyd_outline_kind { DYD_OUTLINE_END, DYD_OUTLINE_MEET, DYD_OUTLINE_CORNER } dyd_outline_kind;

/* A point, relative to the origin, or an end at infinity. at[a] encloses coordinate a. side[a]: which end of the window
 * (0, 1) coordinate a is, exactly; else -1. exact: NULL until it is needed; in the scale of outline.c. */
typedef struct dyd_outline_spot {
  dyd_iv at[2];
  int side[2];
  bool infinite;
  dyd_outline_kind kind;
  uint32_t number;
  const dyd_surd_point *exact;
} dyd_outline_spot;

/* { c in the pane lo .. hi : |c - s| = distance to q }, q a corner or the line of a side (shape). The coordinate `axis`
 * is strictly monotone along the arc; end[0] is its lower end. point: the arc is one point, at which the curve touches
 * the border of the pane. either: the axis may be the other one. tilt[a]: sign of q[a] - s[a]. mark: of the lower and
 * the upper end of the pane along each axis. span encloses the coordinates of all its points. */
typedef struct dyd_outline_arc {
  dyd_filter_arc shape;
  uint32_t curve;
  bool point, either;
  int axis, branch, corner, feature;
  int tilt[2], mark[2][2];
  dyd_iv lo[2], hi[2], span[2];
  dyd_outline_spot end[2];
} dyd_outline_arc;

/* Part of an arc of curve `curve` (or of side curve - count of the window, arc = NULL), with the region on the left. */
typedef struct dyd_outline_piece {
  uint32_t curve;
  const dyd_outline_arc *arc;
  dyd_outline_spot *begin, *end;
} dyd_outline_piece;

/* A point in which two curves meet, on arcs a and b: root number `root` of the `roots` that their lines have in common,
 * ascending along the axis of a. */
typedef struct dyd_outline_meet {
  uint32_t arc[2];
  int root, roots;
  dyd_outline_spot spot;
} dyd_outline_meet;

/* The box of a site relative to the origin, which may be too wide by slack on each side. */
typedef struct dyd_outline_rival {
  dyd_bbox box;
  double slack;
} dyd_outline_rival;

/* Rivals that may take points, the first `count` of `all`, in any order; part: as in outline_sites_filter.c. */
typedef struct dyd_outline_rivals {
  double *part;
  size_t count, all;
} dyd_outline_rivals;

/* A site of the cell: the others in ascending order, its own last. thin: equal ends, though doubles may not hold them.
 * near: its ends relative to the origin. drop: it meets the own one, so does not matter to Pos;
 * else place: its number among the rivals. */
typedef struct dyd_outline_site {
  uint32_t site;
  const dyd_rect *rect; /* NULL: that of the table; borrowed */
  dyd_box box;
  bool thin[2], drop;
  size_t place;
  dyd_iv near[4];
  dyd_outline_rival reach;
} dyd_outline_site;

struct dyd_outline_exact;

/* Loaded once for a site: sites, item, count. The rest is found by dyd_outline_find: piece[0 .. pieces), next[p] and
 * last[p] are the pieces behind and before it, SIZE_MAX at infinity. curve = count + side: of the window. status:
 * DYD_OK until memory or the budget is exhausted, or the work is cancelled. blind: ends beyond doubles, so that only
 * exact numbers decide. Init with {0}, release with dyd_outline_clear. */
typedef struct dyd_outline {
  const dyd_sites *sites;     /* borrowed, as all that follow */
  const dyd_rect *rect;       /* the window, NULL: the plane */
  const dyd_delaunay *pd;     /* only pairs of others that it calls possible share a vertex; NULL: all may */
  const volatile int *cancel; /* may be NULL, as the next */
  dyd_memory *memory;
  dyd_outline_site *item;
  size_t count, item_cap, rival_cap;
  dyd_box window;
  double origin[2];
  bool outer, blind, keep_all; /* keep_all: without [PRUNE-1], for comparison */
  dyd_status status;
  dyd_iv frame[4];               /* the window */
  dyd_outline_rivals rivals;     /* those not dropped */
  double limit[4];               /* lower and upper bounds of all points of Pos, hence of Int */
  dyd_iv bound[4];               /* the window cut down to them, */
  bool bounded[4], of_window[4]; /* where there is one, and where that is an end of the window */
  dyd_outline_arc *arc;
  dyd_outline_meet *meet;
  dyd_outline_spot corner[4];
  dyd_outline_piece *piece;
  size_t *next, *last;
  dyd_outline_spot **cut;
  size_t arcs, arc_cap, meets, meet_cap, pieces, piece_cap, link_cap, cut_cap;
  struct dyd_outline_exact *exact; /* NULL until it is needed */
} dyd_outline;

/* Encloses the point box * 2^exp / unit, relative to the lower corner of the own rectangle; unit encloses the divisor.
 */
static inline void dyd_outline_place_spot(dyd_outline_spot *p, const dyd_outline *o, const double box[4],
                                          const double unit[2], int64_t exp) {
  int e = exp > 4000 ? 4000 : exp < -4000 ? -4000 : (int)exp;
  for (int a = 0; a < 2; a++) {
    dyd_iv x = dyd_iv_div((dyd_iv){box[2 * a], box[2 * a + 1]}, (dyd_iv){unit[0], unit[1]});
    x = (dyd_iv){dyd_down(ldexp(x.lo, e)), dyd_up(ldexp(x.hi, e))};
    p->at[a] = dyd_iv_add(x, o->item[o->count].near[2 * a]);
  }
}

/* How many circles two curves of one rectangle can share, a circle too many included: a convex curve crosses each of
 * the at most ten lines that bound panes of the three rectangles at most twice, so it runs through at most 21 panes,
 * and each holds at most two. */
enum { DYD_OUTLINE_CIRCLES = 43 };

/* ---- exact numbers. Where o->status is not DYD_OK behind a call, its result means nothing ---- */

/* The point in the scale of the cell, borrowed from the outline until the next dyd_outline_find. */
const dyd_surd_point *dyd_outline_exact(dyd_outline *o, dyd_outline_spot *p);
/* Moves a copy of such a point to the caller's coordinates. */
void dyd_outline_unscale(dyd_surd_point *p, const dyd_outline *o);
/* Order of two points along an axis. */
int dyd_outline_exact_order(dyd_outline *o, dyd_outline_spot *p, dyd_outline_spot *q, int axis);
/* Order of two marks of rectangles far and near; DYD_MARKS and the next are the ends of `far`. */
int dyd_outline_exact_marks(dyd_outline *o, size_t far, size_t near, int axis, int a, int b);
/* Which coordinate to go along. */
int dyd_outline_exact_axis(dyd_outline *o, const dyd_outline_arc *a);
/* Sets ends and `point`; false: nothing in the pane. number: of the arc. */
bool dyd_outline_exact_clip(dyd_outline *o, dyd_outline_arc *a, uint32_t number);
/* The points in which arcs a and b meet, but where their curves coincide, in order along a; returns how many. */
size_t dyd_outline_exact_meets(dyd_outline_spot out[DYD_OUTLINE_CIRCLES], dyd_outline *o, uint32_t a, uint32_t b);
/* A point strictly between low and high of an arc, or (NULL) of a side of the window. false: no memory. */
bool dyd_outline_exact_sample(dyd_outline_spot *out, dyd_outline *o, const dyd_outline_arc *a, int side,
                              dyd_outline_spot *low, dyd_outline_spot *high);
/* Sign of (distance of p to other k) - radius. */
int dyd_outline_exact_side(const dyd_outline *o, const dyd_surd_point *p, size_t k);
/* The lowest other site but `curve` that a point is as far from as the radius; o->count: none. */
size_t dyd_outline_exact_third(dyd_outline *o, dyd_outline_spot *p, size_t curve, size_t other);
void dyd_outline_exact_clear(dyd_outline *o);
/* The rectangle of item k; fetched: if it has to come from the table. */
const dyd_rect *dyd_outline_rect(dyd_outline *o, dyd_rect *fetched, size_t k);

#endif
