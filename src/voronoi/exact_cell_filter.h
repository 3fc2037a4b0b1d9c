/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points A + B sqrt(C) with enclosures in doubles, and the quick answers that these give.
 *
 * Boxes are in scaled coordinates times 2^-shift, the same for all points and rectangles of one cell; an end may be
 * infinite. Every enclosure is rounded outward, and every answer comes from comparisons of enclosures that hold; where
 * they overlap, or a number is infinite or NaN, the answer is "not known" (predicate/interval_filter.h). */
#ifndef DYD_VORONOI_EXACT_CELL_FILTER_H
#define DYD_VORONOI_EXACT_CELL_FILTER_H

#include "predicate/predicate_filter.h"
#include "voronoi/surd_point.h"

/* A point, or an end at infinity (then at and box mean nothing).
 * Invariant: box = xlo, xhi, ylo, yhi encloses the point. */
typedef struct dyd_spot {
  dyd_surd_point at;
  double box[4];
  bool infinite;
} dyd_spot;

/* A sample point on an arc: coordinate `axis` is num / 2^bits exactly; box as above.
 * Invariant: at is the point when `known`; it is made only when the filter is unsure. */
typedef struct dyd_sample {
  dyd_spot spot;
  mpz_t num;
  int64_t bits;
  bool known;
} dyd_sample;

void dyd_filter_spot_box(dyd_spot *s, int64_t shift);
/* The rectangle in doubles. */
void dyd_filter_irect_box(dyd_box *out, const dyd_irect *r, int64_t shift);
/* 1, -1: the coordinate of p is certainly more, less than that of q; 0: not known. */
int dyd_filter_spot_cmp(const dyd_spot *p, const dyd_spot *q, int axis);
/* The box of p is certainly not met by the smallest box around both ends (infinite ones included). */
bool dyd_filter_spot_beside(const dyd_spot *p, const dyd_spot *low, const dyd_spot *high);
/* Sign of (distance of p to a) - (distance of p to b), 0: not known. */
int dyd_filter_side(const dyd_spot *p, const dyd_box *a, dyd_touch ta, const dyd_box *b, dyd_touch tb);

/* The line or parabola of an arc in doubles: |c - s| = |c - q|, or distance to the line of coordinate q[1 - axis]. */
typedef struct dyd_filter_arc {
  dyd_iv s[2], q[2];
  bool parabola;
} dyd_filter_arc;

/* The other coordinate where coordinate k is t. */
dyd_iv dyd_filter_arc_other(const dyd_filter_arc *arc, int k, dyd_iv t);

/* A sample whose coordinate `axis` lies strictly between the points (infinite ends allowed), with its box; the other
 * coordinate follows from the arc, or is `level` on an axis-parallel segment (arc = NULL). false: not found in doubles.
 */
bool dyd_filter_sample(dyd_sample *out, const dyd_filter_arc *arc, dyd_iv level, int axis, const dyd_spot *low,
                       const dyd_spot *high, int64_t shift);

/* Do the conditions |c - s| = distance to q certainly have no solution in the closed pane lo .. hi (an infinite
 * interval where there is no bound)? The difference of squares is monotone in each coordinate there [ARC-1], so its
 * extremes are at corners. branch: sign of (coordinate along the directrix) - (that of s) in the pane (parabolas). */
bool dyd_filter_no_arc(const dyd_filter_arc *arc, int axis, int branch, const dyd_iv lo[2], const dyd_iv hi[2]);

/* A rectangle with its doubles. Invariant: all ends are even, so that middles are integers. */
typedef struct dyd_scaled {
  dyd_irect r;
  dyd_box box;
} dyd_scaled;

/* The rectangles of a cell: the radius is the distance to `fixed`; another takes a point if it is nearer. taker: the
 * one that took the last, likely takes the next. */
typedef struct dyd_takers {
  const dyd_scaled *other, *fixed;
  size_t count, taker;
  dyd_touch other_touch, fixed_touch;
} dyd_takers;
/* Returns true if others than `own` certainly take all of an arc along `axis`, cut in boxes where need be [PRUNE-1]. */
bool dyd_filter_arc_taken(dyd_takers *t, size_t own, const dyd_filter_arc *arc, int axis, const dyd_spot end[2]);

/* ---- panes: strips of both axes ---- */

/* Marks on one axis: ends of the window, the middle of the far rectangle, ends of the near one. */
enum { DYD_WINDOW_LO, DYD_WINDOW_HI, DYD_MIDDLE, DYD_NEAR_LO, DYD_NEAR_HI, DYD_MARKS };

/* A closed strip between two marks, and what the rectangles show in it: the far one its end far_end, the near one the
 * mark q, or (fixed = false) the foot of the perpendicular on its side. above: beyond the middle; over: beyond the near
 * rectangle. */
typedef struct dyd_strip {
  int lo, hi, q, far_end;
  bool fixed, above, over;
} dyd_strip;

/* The marks of one axis. order: of two of them. thin: the side of the far, of the near rectangle is one number. */
typedef struct dyd_marks {
  int (*order)(const void *axis, int a, int b);
  const void *axis;
  bool far_thin, near_thin;
} dyd_marks;
/* The strips of one axis, lowest first; returns how many. near_point: both sides of the near rectangle are thin. */
size_t dyd_marks_strips(dyd_strip out[4], const dyd_marks *m, bool near_point);
/* What the near rectangle shows in the pane of two strips. */
dyd_feature_kind dyd_strips_feature(const dyd_strip s[2]);

#endif
