/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The boundary of a region in doubles: arcs, cuts, a sample between two cuts, pieces, the chain of them. What the exact
 * work does (exact_cell.c), where no comparison is in doubt.
 *
 * [OUTLINE-1] Every true end or meeting point lies in the box of a spot: the formulas are the exact ones in intervals,
 * and a formula that could give a point or none ends the work. So the order of cuts along an arc, the sides of samples
 * and the pane of a meeting point, where certain, are the true ones. More cuts than the exact work makes change
 * nothing, as pieces of one arc are joined. Each finite end of a piece is where exactly one other piece begins; where
 * only one beginning has a box that meets the box of the end, it is that one. */
#include "voronoi/outline_filter.h"

#include "base/local.h"
#include "rect/rect.h"
#include "rect/sites_table.h"

#include <stdlib.h>

enum { STRETCHES = 3 }; /* how often an arc is halved, to find that it is taken */

/* ---- points ---- */

int dyd_outline_order(bool *unsure, dyd_iv a, dyd_iv b) {
  if (a.lo > b.hi) return 1;
  if (a.hi < b.lo) return -1;
  if (!(a.lo == a.hi && b.lo == b.hi)) *unsure = true;
  return 0;
}

/* A lower or upper bound of the squared distance to a box of all points in c. */
static inline double outline_distance2(const dyd_bbox *c, const dyd_outline_rival *r, bool farthest, bool upper) {
  if (farthest) return upper ? dyd_dl2_upper(c, &r->box) : dyd_dl2_lower(c, &r->box, r->slack);
  return upper ? dyd_ds2_upper(c, &r->box, r->slack) : dyd_ds2_lower(c, &r->box);
}

/* Exchanges rivals a and b. */
static void rivals_swap(dyd_outline_rivals *r, size_t a, size_t b) {
  for (int e = 0; e < DYD_RIVAL_PARTS; e++) {
    double part = r->part[e][a];
    r->part[e][a] = r->part[e][b];
    r->part[e][b] = part;
  }
}

/* Only sites other than `own` take points from now on. */
static void rivals_exclude(dyd_outline_rivals *r, size_t own) {
  r->count = r->all;
  for (size_t k = 0; k < r->all && r->count == r->all; k++)
    if (r->part[DYD_RIVAL_NUMBER][k] == (double)own) rivals_swap(r, k, --r->count);
}

/* The first rival, of DYD_OUTLINE_LANES from m on, whose distance is certainly below `least`; r->all: none. */
static inline size_t rivals_nearer(const dyd_outline_rivals *r, size_t m, const dyd_bbox *c, bool farthest,
                                   double least) {
  double upper[DYD_OUTLINE_LANES], below = HUGE_VAL;
  for (int k = 0; k < DYD_OUTLINE_LANES; k++) {
    const dyd_bbox b = {{r->part[0][m + k], r->part[1][m + k], r->part[2][m + k], r->part[3][m + k]}};
    upper[k] = farthest ? dyd_dl2_upper(c, &b) : dyd_ds2_upper(c, &b, r->part[DYD_RIVAL_SLACK][m + k]);
  }
  for (int k = 0; k < DYD_OUTLINE_LANES; k++) below = dyd_min(below, upper[k]);
  if (!(below < least)) return r->all;
  for (int k = 0; k < DYD_OUTLINE_LANES; k++)
    if (upper[k] < least && m + k < r->count) return m + k;
  return r->all;
}

/* Returns true if a site certainly takes all points of the box away from all that are excluded. A site that takes a
 * point likely takes the next, and comes first. */
static bool outline_taken(dyd_outline *o, const dyd_iv at[2]) {
  const dyd_bbox c = {{at[0].lo, at[0].hi, at[1].lo, at[1].hi}};
  dyd_outline_rivals *r = &o->rivals;
  double least = outline_distance2(&c, &o->reach[o->count], !o->outer, false);
  if (!isfinite(c.e[0] + c.e[1] + c.e[2] + c.e[3])) return false;
  for (size_t m = 0; m < r->count; m += DYD_OUTLINE_LANES) {
    size_t k = o->outer ? rivals_nearer(r, m, &c, true, least) : rivals_nearer(r, m, &c, false, least);
    if (k == r->all) continue;
    if (k) rivals_swap(r, k, 0);
    return true;
  }
  return false;
}

/* May one of them take a point of the box? */
static bool outline_may_be_taken(const dyd_outline *o, const dyd_iv at[2]) {
  const dyd_bbox c = {{at[0].lo, at[0].hi, at[1].lo, at[1].hi}};
  double most = outline_distance2(&c, &o->reach[o->count], !o->outer, true);
  for (size_t m = 0; m < o->rivals.count; m++)
    if (!(outline_distance2(&c, &o->reach[(size_t)o->rivals.part[DYD_RIVAL_NUMBER][m]], o->outer, false) > most))
      return true;
  return false;
}

/* ---- the elementary arcs of bisector.c in intervals ---- */

/* at: as given; to: relative to the origin. of: rectangles far and near, along an axis. */
typedef struct ruler {
  dyd_iv at[DYD_MARKS], to[DYD_MARKS], far_at[2], far_to[2];
  bool of_window[2];
  dyd_outline *o;
  size_t far, near;
  int axis;
  dyd_marks marks;
} ruler;

static dyd_iv ruler_at(const ruler *r, int mark) {
  return mark < DYD_MARKS ? r->at[mark] : r->far_at[mark - DYD_MARKS];
}

static int ruler_order(const void *axis, int a, int b) {
  const ruler *r = axis;
  bool doubt = false;
  int order = a == b ? 0 : dyd_outline_order(&doubt, ruler_at(r, a), ruler_at(r, b));
  if (!doubt) return order;
  DYD_LOCAL_NUMBERS(mpq, x, y); /* marks that doubles do not tell apart may be one number */
  dyd_outline_number(x, r->o, r->far, r->near, r->axis, a);
  dyd_outline_number(y, r->o, r->far, r->near, r->axis, b);
  return mpq_cmp(x, y);
}

static void ruler_set(ruler *r, dyd_outline *o, size_t far, size_t near, int axis) {
  for (int e = 0; e < 2; e++) {
    r->at[DYD_WINDOW_LO + e] = o->bound[2 * axis + e];
    r->to[DYD_WINDOW_LO + e] = dyd_iv_sub(o->bound[2 * axis + e], dyd_iv_point(o->origin[axis]));
    r->of_window[e] = o->of_window[2 * axis + e];
    r->at[DYD_NEAR_LO + e] = o->box[near].end[2 * axis + e];
    r->to[DYD_NEAR_LO + e] = o->near[near][2 * axis + e];
    r->far_at[e] = o->box[far].end[2 * axis + e];
    r->far_to[e] = o->near[far][2 * axis + e];
  }
  r->o = o;
  r->far = far;
  r->near = near;
  r->axis = axis;
  r->marks = (dyd_marks){ruler_order, r, o->thin[far][axis], o->thin[near][axis]};
  r->at[DYD_MIDDLE] = r->marks.far_thin ? r->far_at[0] : dyd_iv_scale(dyd_iv_add(r->far_at[0], r->far_at[1]), 0.5);
  r->to[DYD_MIDDLE] = r->marks.far_thin ? r->far_to[0] : dyd_iv_scale(dyd_iv_add(r->far_to[0], r->far_to[1]), 0.5);
}

/* ---- points of an arc ---- */

/* Around both; unknown where an end is not a number. */
static dyd_iv outline_hull(dyd_iv p, dyd_iv q) {
  if (!isfinite(p.lo + p.hi + q.lo + q.hi)) return DYD_IV_UNKNOWN;
  return (dyd_iv){p.lo < q.lo ? p.lo : q.lo, p.hi > q.hi ? p.hi : q.hi};
}

/* The point of an arc at t along its axis. */
static dyd_outline_spot outline_arc_at(const dyd_outline_arc *a, dyd_iv t) {
  dyd_outline_spot p = {.side = {-1, -1}};
  p.at[a->axis] = t;
  p.at[1 - a->axis] = dyd_filter_arc_other(&a->shape, a->axis, t);
  return p;
}

static void outline_set_span(dyd_outline_arc *a) {
  for (int k = 0; k < 2; k++) a->span[k] = outline_hull(a->end[0].at[k], a->end[1].at[k]); /* monotone [ARC-1] */
}

/* Where the other coordinate is `level`; 0: there, else which side of the level the parabola stays on. */
static int arc_across(dyd_iv *t, bool *unsure, const dyd_outline_arc *a, dyd_iv level) {
  int k = a->axis, o = 1 - k;
  const dyd_iv *s = a->shape.s, *q = a->shape.q;
  dyd_iv above = dyd_iv_sub(level, dyd_iv_scale(dyd_iv_add(q[o], s[o]), 0.5));
  if (!a->shape.parabola) {
    dyd_iv slope = dyd_iv_div(dyd_iv_sub(q[o], s[o]), dyd_iv_sub(q[k], s[k]));
    *t = dyd_iv_sub(dyd_iv_scale(dyd_iv_add(q[k], s[k]), 0.5), dyd_iv_mul(slope, above));
    return 0;
  }
  dyd_iv square = dyd_iv_mul(dyd_iv_scale(dyd_iv_sub(s[o], q[o]), 2), above);
  int sign = dyd_iv_sign(square);
  if (!sign) *unsure = true;
  if (sign < 0) return -a->tilt[o];
  dyd_iv root = dyd_iv_sqrt(square);
  *t = a->branch > 0 ? dyd_iv_add(s[k], root) : dyd_iv_sub(s[k], root);
  return 0;
}

/* ---- clipping ---- */

/* Which end of the window the ends of the pane of an arc are, lower and upper along both axes; else -1. */
typedef struct pane_sides {
  int end[2][2];
} pane_sides;

static int window_side(const ruler *r, int mark) {
  return mark == DYD_WINDOW_LO && r->of_window[0] ? 0 : mark == DYD_WINDOW_HI && r->of_window[1] ? 1 : -1;
}

/* Sign of dv/dt. */
static int outline_arc_slope(const dyd_outline_arc *a) {
  int k = a->axis, across = a->tilt[1 - k];
  return a->shape.parabola ? -across * a->branch : -across * a->tilt[k];
}

/* A line along its axis: in the pane? */
static bool level_in_pane(bool *unsure, const dyd_outline_arc *a) {
  int o = 1 - a->axis;
  dyd_iv level = dyd_iv_scale(dyd_iv_add(a->shape.q[o], a->shape.s[o]), 0.5);
  return dyd_outline_order(unsure, level, a->lo[o]) > 0 && dyd_outline_order(unsure, level, a->hi[o]) < 0;
}

static bool outline_clip_across(dyd_outline_arc *a, bool *unsure, const pane_sides *m) {
  int k = a->axis, o = 1 - k, grows = outline_arc_slope(a);
  if (!grows) return level_in_pane(unsure, a);
  for (int e = 0; e < 2; e++) {
    dyd_iv level = e ? a->hi[o] : a->lo[o], t = DYD_IV_UNKNOWN;
    int missed = arc_across(&t, unsure, a, level), to = grows > 0 ? e : 1 - e;
    if (missed && (missed > 0) == (e == 1)) return false;
    if (missed) continue;
    int sign = dyd_outline_order(unsure, t, a->end[to].at[k]);
    if (to ? sign >= 0 : sign <= 0) continue;
    a->end[to].at[k] = t;
    a->end[to].at[o] = level;
    a->end[to].side[k] = -1;
    a->end[to].side[o] = m->end[o][e];
  }
  return true;
}

static bool outline_clip(dyd_outline_arc *a, bool *unsure, const pane_sides *m) {
  int k = a->axis;
  for (int e = 0; e < 2; e++) {
    a->end[e] = outline_arc_at(a, e ? a->hi[k] : a->lo[k]);
    a->end[e].side[k] = m->end[k][e];
  }
  if (!outline_clip_across(a, unsure, m)) return false;
  bool closed = false;
  int order = dyd_outline_order(&closed, a->end[0].at[k], a->end[1].at[k]);
  if (closed || !order) *unsure = true;
  return order < 0;
}

/* ---- arcs ---- */

/* Which coordinate to go along. *either: not known. */
static int outline_axis(bool *either, const dyd_filter_arc *a, bool side_y) {
  if (a->parabola) return side_y ? 0 : 1;
  dyd_iv n[2];
  for (int k = 0; k < 2; k++) {
    dyd_iv d = dyd_iv_sub(a->q[k], a->s[k]);
    n[k] = (dyd_iv){fmax(0, fmax(d.lo, -d.hi)), fmax(-d.lo, d.hi)};
  }
  return dyd_outline_order(either, n[0], n[1]) <= 0 ? 0 : 1;
}

/* As curve_set_arc. */
static bool outline_set_arc(dyd_outline_arc *a, pane_sides *m, const ruler r[2], const dyd_strip s[2]) {
  if (!s[0].fixed && !s[1].fixed) return false;
  for (int k = 0; k < 2; k++) {
    a->shape.s[k] = r[k].far_to[s[k].far_end];
    a->shape.q[k] = s[k].fixed ? r[k].to[s[k].q] : DYD_IV_UNKNOWN;
    a->lo[k] = r[k].to[s[k].lo];
    a->hi[k] = r[k].to[s[k].hi];
    a->tilt[k] = s[k].fixed ? ruler_order(&r[k], s[k].q, DYD_MARKS + s[k].far_end) : 0;
    a->near_side[k] = s[k].over ? 1 : -1;
    for (int e = 0; e < 2; e++) m->end[k][e] = window_side(&r[k], a->mark[k][e] = e ? s[k].hi : s[k].lo);
  }
  a->corner = s[0].far_end + 2 * s[1].far_end;
  a->feature = (int)dyd_strips_feature(s);
  a->shape.parabola = !s[0].fixed || !s[1].fixed;
  a->either = false;
  a->axis = outline_axis(&a->either, &a->shape, !s[0].fixed);
  a->branch = !a->shape.parabola ? 0 : s[a->axis].above ? 1 : -1;
  return a->tilt[1 - a->axis];
}

/* Parts of squared distances along one axis, of a strip, to the far and the near rectangle: at the end where their
 * difference is least, from below and from above; where it is most, from above and from below. none: which end is which
 * is not known. */
typedef struct strip_reach {
  bool none;
  double far_least, near_least, far_most, near_most;
} strip_reach;

/* d^2, or 0 if d is negative. */
static double reach_square(double d) {
  return !(d <= DBL_MAX) ? HUGE_VAL : d > 0 ? d * d : 0;
}

static strip_reach strip_reach_of(const ruler *r, const dyd_strip *s) {
  const dyd_outline_rival *far = &r->o->reach[r->far], *near = &r->o->reach[r->near];
  const double *f = far->box.e + 2 * r->axis, *n = near->box.e + 2 * r->axis;
  dyd_iv q = r->at[s->q], end = r->far_at[s->far_end];
  bool grows = s->fixed ? q.lo > end.hi : s->above;
  dyd_iv least = r->to[grows ? s->lo : s->hi], most = r->to[grows ? s->hi : s->lo];
  return (strip_reach){
      s->fixed && !grows && !(q.hi < end.lo), reach_square(dyd_max(f[1] - least.hi, least.lo - f[0]) - far->slack),
      reach_square(dyd_max(n[0] - least.lo, least.hi - n[1]) + near->slack),
      reach_square(dyd_max(f[1] - most.lo, most.hi - f[0])), reach_square(dyd_max(n[0] - most.hi, most.lo - n[1]))};
}

/* Has the pane certainly no point of the curve? The difference of squares is monotone in each coordinate there [ARC-1];
 * the bounds are those of [FLT-DST]. */
static bool pane_is_clear(const strip_reach *x, const strip_reach *y) {
  if (x->none || y->none) return false;
  return dyd_lower(x->far_least + y->far_least) > dyd_upper(x->near_least + y->near_least) ||
         dyd_upper(x->far_most + y->far_most) < dyd_lower(x->near_most + y->near_most);
}

/* Is all of the arc between p and q taken, whole or in parts? A middle that is not ends it. */
static bool outline_stretch_taken(dyd_outline *o, const dyd_outline_arc *a, const dyd_outline_spot *p,
                                  const dyd_outline_spot *q, int depth) {
  int k = a->axis;
  double t = p->at[k].hi / 2 + q->at[k].lo / 2;
  if (!depth || !(p->at[k].hi < t && t < q->at[k].lo)) return false;
  dyd_outline_spot m = outline_arc_at(a, dyd_iv_point(t));
  if (!outline_taken(o, m.at)) return false;
  for (int part = 0; part < 2; part++) {
    const dyd_outline_spot *from = part ? &m : p, *to = part ? q : &m;
    dyd_iv span[2];
    for (int c = 0; c < 2; c++) span[c] = outline_hull(from->at[c], to->at[c]); /* monotone between them [ARC-1] */
    if (!outline_taken(o, span) && !outline_stretch_taken(o, a, from, to, depth - 1)) return false;
  }
  return true;
}

/* All of it? Its boundary points are boundary of nothing then, and cuts there decide nothing. */
static bool arc_is_taken(dyd_outline *o, const dyd_outline_arc *a) {
  return outline_taken(o, a->span) || outline_stretch_taken(o, a, &a->end[0], &a->end[1], STRETCHES);
}

static void outline_add_curve(dyd_outline *o, uint32_t other) {
  size_t far = o->outer ? other : o->count, near = o->outer ? o->count : other;
  ruler r[2];
  dyd_strip x[4], y[4];
  for (int k = 0; k < 2; k++) ruler_set(&r[k], o, far, near, k);
  bool near_point = r[0].marks.near_thin && r[1].marks.near_thin;
  size_t columns = dyd_marks_strips(x, &r[0].marks, near_point), rows = dyd_marks_strips(y, &r[1].marks, near_point);
  strip_reach across[4], up[4];
  for (size_t k = 0; k < columns; k++) across[k] = strip_reach_of(&r[0], &x[k]);
  for (size_t k = 0; k < rows; k++) up[k] = strip_reach_of(&r[1], &y[k]);
  for (size_t k = 0; k < columns * rows && !o->unsure; k++) {
    const dyd_strip s[2] = {x[k / rows], y[k % rows]};
    dyd_outline_arc *a = &o->arc[o->arcs];
    pane_sides m;
    if (pane_is_clear(&across[k / rows], &up[k % rows])) continue;
    if (o->arcs == DYD_OUTLINE_ARCS) {
      o->unsure = true;
    } else if (outline_set_arc(a, &m, r, s) && outline_clip(a, &o->unsure, &m)) {
      a->curve = other;
      outline_set_span(a);
      o->arcs += !arc_is_taken(o, a);
    }
  }
}

/* Finds the arcs of the curves of all others, except arcs that are taken away. Sets o->unsure in doubt. */
static void outline_find_arcs(dyd_outline *o) {
  o->arcs = 0;
  for (uint32_t k = 0; k < o->count && !o->unsure; k++) {
    if (o->drop[k]) continue;
    rivals_exclude(&o->rivals, k);
    outline_add_curve(o, k);
  }
}

/* ---- where the curves of two others cross, arc by arc ----
 *
 * Let a, b be arcs of the curves of j and k. A point of both lies in their boxes, and in panes with the same far corner
 * (Int) or the same near feature (Pos) of the site, or on the border of panes, which is never certain. Relative to the
 * far corner s of a, the point at u along the axis of a has the other coordinate w(u) = w0 + w1 u + w2 u^2, and b
 * demands A u^2 + B u + C = 0:
 *   as far from the point d as from 0 (the near corner of k for Int, the far corner of k for Pos): d.p = |d|^2 / 2;
 *   for Int and a near side of k at D, across the axis of a or along it, with a straight: |p|^2 = (p_o - D)^2;
 *   with a of the near side D' too, where |p| = |w - D'|: w = (D + D') / 2, or +-(u - D) = w - D', the signs being
 *   those of the panes, in which the point is beyond both sides. */

/* Coefficients; degree 1: square means nothing. */
typedef struct quadratic {
  dyd_iv square, line, rest;
  int degree;
} quadratic;

/* w0 + w1 u + w2 u^2 */
typedef struct profile {
  dyd_iv w0, w1, w2;
} profile;

static profile profile_of(const dyd_outline_arc *a) {
  int k = a->axis, o = 1 - k;
  const dyd_iv *s = a->shape.s, *q = a->shape.q;
  dyd_iv n = dyd_iv_sub(q[o], s[o]), zero = dyd_iv_point(0), half = dyd_iv_scale(n, 0.5);
  if (a->shape.parabola) return (profile){half, zero, dyd_iv_div(dyd_iv_point(-0.5), n)};
  dyd_iv m = dyd_iv_sub(q[k], s[k]), slope = dyd_iv_div(m, n);
  return (profile){dyd_iv_add(half, dyd_iv_scale(dyd_iv_mul(slope, m), 0.5)), dyd_iv_neg(slope), zero};
}

/* d.p = |d|^2 / 2 */
static quadratic meet_point(const dyd_outline_arc *a, const profile *w, const dyd_iv d[2]) {
  dyd_iv along = d[a->axis], across = d[1 - a->axis];
  dyd_iv half = dyd_iv_scale(dyd_iv_add(dyd_iv_sqr(along), dyd_iv_sqr(across)), 0.5);
  return (quadratic){.square = dyd_iv_mul(across, w->w2),
                     .line = dyd_iv_add(along, dyd_iv_mul(across, w->w1)),
                     .rest = dyd_iv_sub(dyd_iv_mul(across, w->w0), half),
                     .degree = a->shape.parabola ? 2 : 1};
}

/* a straight, b of a side at D: |p|^2 = (p_o - D)^2, o the axis across the side. */
static quadratic meet_side(const dyd_outline_arc *a, const profile *w, dyd_iv side, int across_side) {
  dyd_iv twice = dyd_iv_scale(side, 2), square = dyd_iv_sqr(side);
  if (across_side != a->axis)
    return (quadratic){dyd_iv_point(1), dyd_iv_mul(twice, w->w1), dyd_iv_sub(dyd_iv_mul(twice, w->w0), square), 2};
  return (quadratic){dyd_iv_sqr(w->w1), dyd_iv_add(dyd_iv_scale(dyd_iv_mul(w->w0, w->w1), 2), twice),
                     dyd_iv_sub(dyd_iv_sqr(w->w0), square), 2};
}

/* Both of sides. */
static quadratic meet_sides(const dyd_outline_arc *a, const dyd_outline_arc *b, const profile *w, dyd_iv own,
                            dyd_iv side) {
  if (a->axis == b->axis)
    return (quadratic){w->w2, dyd_iv_point(0), dyd_iv_sub(w->w0, dyd_iv_scale(dyd_iv_add(own, side), 0.5)), 2};
  int same = a->near_side[1 - a->axis] * b->near_side[1 - b->axis];
  dyd_iv up = dyd_iv_sub(w->w0, own);
  quadratic f = {w->w2, dyd_iv_point(-1), dyd_iv_add(up, side), 2};
  if (same < 0) f = (quadratic){dyd_iv_neg(w->w2), dyd_iv_point(-1), dyd_iv_sub(side, up), 2};
  return f;
}

/* false: not a finite number of points, for all that is known. */
static bool meet_equation(quadratic *out, const dyd_outline *o, const dyd_outline_arc *a, const dyd_outline_arc *b,
                          const profile *w) {
  const dyd_iv *s = a->shape.s, *to = o->outer ? b->shape.s : b->shape.q;
  if (o->outer || !b->shape.parabola) {
    const dyd_iv d[2] = {dyd_iv_sub(to[0], s[0]), dyd_iv_sub(to[1], s[1])};
    *out = meet_point(a, w, d);
    return true;
  }
  int across = 1 - b->axis;
  dyd_iv side = dyd_iv_sub(to[across], s[across]);
  if (!a->shape.parabola) {
    *out = meet_side(a, w, side, across);
    return true;
  }
  dyd_iv own = dyd_iv_sub(a->shape.q[1 - a->axis], s[1 - a->axis]);
  *out = meet_sides(a, b, w, own, side);
  return a->axis != b->axis || dyd_iv_sign(dyd_iv_sub(own, side)) != 0;
}

/* ---- roots ---- */

static double iv_least(dyd_iv a) {
  return a.lo > 0 ? a.lo : a.hi < 0 ? -a.hi : 0;
}

static double iv_most(dyd_iv a) {
  return isfinite(a.lo + a.hi) ? fmax(fabs(a.lo), fabs(a.hi)) : HUGE_VAL;
}

/* num / den, unless it is certainly beyond reach; false: not known. */
static bool add_quotient(dyd_iv root[2], int *count, dyd_iv num, dyd_iv den, double reach) {
  if (dyd_iv_sign(den)) {
    root[(*count)++] = dyd_iv_div(num, den);
    return true;
  }
  return iv_least(num) > dyd_up(dyd_up(iv_most(den) * reach));
}

/* Roots of absolute value up to reach; false: not known. */
static bool find_roots(dyd_iv root[2], int *count, const quadratic *f, double reach) {
  *count = 0;
  if (f->degree == 1) return add_quotient(root, count, dyd_iv_neg(f->rest), f->line, reach);
  dyd_iv d = dyd_iv_sub(dyd_iv_sqr(f->line), dyd_iv_scale(dyd_iv_mul(f->square, f->rest), 4));
  int sign = dyd_iv_sign(d), turn = dyd_iv_sign(f->line);
  if (sign <= 0) return sign < 0;
  dyd_iv s = dyd_iv_sqrt(d);
  if (!turn) {
    dyd_iv twice = dyd_iv_scale(f->square, 2), minus = dyd_iv_neg(f->line);
    return add_quotient(root, count, dyd_iv_add(minus, s), twice, reach) &&
           add_quotient(root, count, dyd_iv_sub(minus, s), twice, reach);
  }
  dyd_iv q = dyd_iv_scale(dyd_iv_neg(turn > 0 ? dyd_iv_add(f->line, s) : dyd_iv_sub(f->line, s)), 0.5);
  return add_quotient(root, count, f->rest, q, reach) && add_quotient(root, count, q, f->square, reach);
}

/* ---- meets ---- */

static bool boxes_apart(const dyd_outline_arc *a, const dyd_outline_arc *b) {
  for (int k = 0; k < 2; k++) {
    if (a->span[k].hi < b->span[k].lo || b->span[k].hi < a->span[k].lo) return true;
  }
  return false;
}

/* Returns true if the point of arc a is in the pane of b. */
static bool pane_holds(bool *unsure, const dyd_outline_arc *b, const dyd_outline_spot *p) {
  for (int k = 0; k < 2; k++)
    if (dyd_outline_order(unsure, p->at[k], b->lo[k]) < 0 || dyd_outline_order(unsure, p->at[k], b->hi[k]) > 0)
      return false;
  return true;
}

static void add_meet(dyd_outline *o, uint32_t a, uint32_t b, dyd_iv u) {
  const dyd_outline_arc *p = &o->arc[a], *q = &o->arc[b];
  dyd_iv t = dyd_iv_add(p->shape.s[p->axis], u);
  bool unsure = false;
  if (dyd_outline_order(&unsure, t, p->end[0].at[p->axis]) < 0) return;
  if (dyd_outline_order(&unsure, t, p->end[1].at[p->axis]) > 0) return;
  dyd_outline_spot spot = outline_arc_at(p, t);
  if (!pane_holds(&unsure, q, &spot) || outline_taken(o, spot.at)) return;
  if (unsure && dyd_outline_needs_no_cut(o, a, b)) return;
  if (unsure || o->meets == DYD_OUTLINE_MEETS)
    o->unsure = true;
  else
    o->meet[o->meets++] = (dyd_outline_meet){{a, b}, spot};
}

static void arcs_meet(dyd_outline *o, uint32_t a, uint32_t b, const profile *w) {
  const dyd_outline_arc *p = &o->arc[a], *q = &o->arc[b];
  dyd_iv root[2], range = dyd_iv_sub((dyd_iv){p->end[0].at[p->axis].lo, p->end[1].at[p->axis].hi}, p->shape.s[p->axis]);
  quadratic f;
  int count;
  if (o->outer ? p->feature != q->feature : p->corner != q->corner) return;
  if (boxes_apart(p, q)) return;
  if (!meet_equation(&f, o, p, q, w) || !find_roots(root, &count, &f, iv_most(range))) {
    o->unsure = true;
    return;
  }
  for (int k = 0; k < count; k++) add_meet(o, a, b, root[k]);
}

/* Where the curves cross. What a third takes away begins and ends no piece. */
static void outline_find_meets(dyd_outline *o) {
  o->meets = 0;
  for (uint32_t a = 0; a < o->arcs && !o->unsure; a++) {
    profile w = profile_of(&o->arc[a]);
    rivals_exclude(&o->rivals, o->arc[a].curve);
    for (uint32_t b = a + 1; b < o->arcs && !o->unsure; b++)
      if (o->arc[a].curve != o->arc[b].curve) arcs_meet(o, a, b, &w);
  }
}

/* ---- the site and the others ---- */

/* Sides of the rectangle that are one number, where outward doubles leave it open. */
static dyd_status box_find_thin(bool thin[2], const dyd_box *b, const dyd_sites *s, uint32_t i) {
  bool open[2];
  for (int a = 0; a < 2; a++) {
    thin[a] = b->outer[2 * a] == b->outer[2 * a + 1];
    open[a] = !thin[a] && b->end[2 * a].hi >= b->end[2 * a + 1].lo;
  }
  if (!open[0] && !open[1]) return DYD_OK;
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sites_get(&r, s, i);
  for (int a = 0; a < 2; a++) {
    const dyd_interval *side = a ? &r.y : &r.x;
    if (open[a]) thin[a] = !dyd_dyadic_cmp(&side->lo, &side->hi);
  }
  return st;
}

/* The ends of the box, each within the last place of an outward double if doubles do not hold it. */
static bool box_load(dyd_box *out, const dyd_sites *s, uint32_t i) {
  dyd_sites_get_d(out->outer, s, i);
  out->exact = dyd_sites_in_doubles(s, i);
  for (int k = 0; k < 4; k++) {
    double e = out->outer[k], inward = out->exact ? e : nextafter(e, k & 1 ? -INFINITY : INFINITY);
    if (!isfinite(e)) return false;
    out->end[k] = (dyd_iv){fmin(e, inward), fmax(e, inward)};
  }
  return true;
}

dyd_status dyd_outline_load(bool *done, dyd_outline *o, const dyd_delaunay *pd, uint32_t i, dyd_pair_status least) {
  DYD_SCOPED(dyd_index_list) list = {0};
  const dyd_sites *s = dyd_delaunay_sites(pd);
  dyd_status st = dyd_delaunay_neighbours(&list, pd, i, least);
  *done = st == DYD_OK && list.count <= DYD_OUTLINE_OTHERS;
  if (*done) {
    o->count = list.count;
    o->sites = s;
    for (size_t k = 0; k <= list.count && *done && st == DYD_OK; k++) {
      uint32_t site = k < list.count ? list.item[k] : i;
      o->site[k] = site;
      *done = box_load(&o->box[k], s, site);
      if (*done) st = box_find_thin(o->thin[k], &o->box[k], s, site);
    }
    o->origin[0] = o->box[list.count].outer[0];
    o->origin[1] = o->box[list.count].outer[2];
    for (int k = 0; k < 4; k++) o->limit[k] = k & 1 ? INFINITY : -INFINITY;
  }
  return st;
}

static void ends_place(dyd_iv out[4], const dyd_box *b, const double origin[2]) {
  for (int k = 0; k < 4; k++) out[k] = dyd_iv_sub(b->end[k], dyd_iv_point(origin[k >> 1]));
}

static void outline_place_site(dyd_outline *o, uint32_t k) {
  dyd_outline_rival *r = &o->reach[k];
  const dyd_iv *end = o->near[k];
  ends_place(o->near[k], &o->box[k], o->origin);
  *r = (dyd_outline_rival){{{end[0].lo, end[1].hi, end[2].lo, end[3].hi}}, 0};
  for (int e = 0; e < 4; e++) r->slack = dyd_max(r->slack, dyd_up(end[e].hi - end[e].lo));
}

/* Returns true if the closed rectangles of sites a and b meet. */
static bool outline_rects_meet(dyd_outline *o, size_t a, size_t b) {
  bool doubt = false;
  const dyd_iv *p = o->box[a].end, *q = o->box[b].end;
  for (int k = 0; k < 4; k += 2)
    if (dyd_outline_order(&doubt, p[k], q[k + 1]) > 0 || dyd_outline_order(&doubt, q[k], p[k + 1]) > 0) return false;
  if (!doubt) return true;
  DYD_LOCAL_ARRAY(dyd_rect, r, [2]);
  return dyd_outline_rect(&r[0], o, a) && dyd_outline_rect(&r[1], o, b) && dyd_rect_meets(&r[0], &r[1]);
}

/* Relative to the origin; false: some other meets the site. */
static bool outline_place(dyd_outline *o, const dyd_rect *window) {
  bool free = true;
  dyd_filter_box(&o->window, window);
  o->rect = window;
  ends_place(o->frame, &o->window, o->origin);
  for (uint32_t k = 0; k <= o->count; k++) outline_place_site(o, k);
  dyd_outline_rivals *v = &o->rivals;
  v->all = 0;
  for (uint32_t k = 0; k < o->count; k++) {
    o->drop[k] = outline_rects_meet(o, k, o->count);
    free = free && !o->drop[k];
    if (o->drop[k]) continue;
    for (int e = 0; e < 4; e++) v->part[e][v->all] = o->reach[k].box.e[e];
    v->part[DYD_RIVAL_SLACK][v->all] = o->reach[k].slack;
    v->part[DYD_RIVAL_NUMBER][v->all++] = k;
  }
  for (size_t k = v->all; k % DYD_OUTLINE_LANES; k++) /* never nearer */
    for (int e = 0; e <= DYD_RIVAL_SLACK; e++) v->part[e][k] = HUGE_VAL;
  v->count = v->all;
  for (int k = 0; k < 4; k++) {
    int side[2] = {k == 1 || k == 2, k >= 2};
    o->corner[k] = (dyd_outline_spot){{o->frame[side[0]], o->frame[2 + side[1]]}, {side[0], side[1]}};
  }
  return free;
}

/* ---- limits ---- */

/* How far the others are from the origin, at most, in one coordinate. */
static double outline_reach(const dyd_outline *o) {
  double most = 0;
  for (size_t k = 0; k < o->count; k++)
    for (int e = 0; e < 4; e++) most = fmax(most, fabs(o->reach[k].box.e[e]));
  return most;
}

/* Is all of side k of the box taken away, whole or in parts, from `from` to `to` along it? A middle that is not ends
 * it.
 */
static bool side_is_taken(dyd_outline *o, const double box[4], int k, double from, double to, int depth) {
  int across = k >> 1;
  double middle = from / 2 + to / 2;
  dyd_iv at[2];
  at[across] = dyd_iv_point(box[k]);
  at[1 - across] = (dyd_iv){from, to};
  if (outline_taken(o, at)) return true;
  at[1 - across] = dyd_iv_point(middle);
  return depth > 0 && outline_taken(o, at) && side_is_taken(o, box, k, from, middle, depth - 1) &&
         side_is_taken(o, box, k, middle, to, depth - 1);
}

/* Is the site inside of the box, and is that side of it taken away? */
static bool box_has_side(dyd_outline *o, const double box[4], int k) {
  const double *own = o->reach[o->count].box.e, *along = box + (k < 2 ? 2 : 0);
  for (int e = 0; e < 4; e++)
    if (e & 1 ? !(own[e] < box[e]) : !(box[e] < own[e])) return false;
  return side_is_taken(o, box, k, along[0], along[1], STRETCHES + 1);
}

/* Draws side k nearer to the site as long as it is taken away. Other sides become shorter, so they stay so. */
static void draw_side(dyd_outline *o, double box[4], int k) {
  for (int step = 0; step < 4; step++) {
    double old = box[k];
    box[k] = o->reach[o->count].box.e[k] * 0.25 + old * 0.75;
    if (!box_has_side(o, box, k)) box[k] = old;
  }
}

/* A box whose border is taken away around the site has Pos, which is connected and holds the site, inside. */
static void limit_by_box(dyd_outline *o) {
  static const double share[] = {0.4, 0.6, 0.8, 1.25, 2, 4};
  double reach = outline_reach(o), box[4];
  size_t shares = sizeof share / sizeof *share, m = 0;
  for (int sides = 0; m < shares && sides < 4; m += sides < 4) {
    for (int k = 0; k < 4; k++) box[k] = o->reach[o->count].box.e[k] + (k & 1 ? reach : -reach) * share[m];
    for (sides = 0; sides < 4 && box_has_side(o, box, sides);) sides++;
  }
  if (m == shares) return;
  for (int k = 0; k < 4; k++) draw_side(o, box, k);
  for (int k = 0; k < 4; k++) {
    double at = o->origin[k >> 1] + box[k];
    o->limit[k] = k & 1 ? dyd_up(at) : dyd_down(at);
  }
}

/* Int is in Pos, whose arcs are in the boxes of their ends. A little more, so that nothing ends at a limit. */
static void limit_by_parts(dyd_outline *o) {
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (size_t p = 0; p < o->pieces; p++)
    for (int e = 0; e < 2; e++)
      for (int k = 0; k < 4; k++) {
        dyd_iv at = dyd_outline_coordinate(o, e ? o->piece[p].end : o->piece[p].begin, k >> 1);
        box[k] = k & 1 ? dyd_max(box[k], at.hi) : dyd_min(box[k], at.lo);
      }
  for (int k = 0; k < 4 && o->pieces; k++) {
    double more = 0x1p-10 * (box[k | 1] - box[k & 2]);
    o->limit[k] = k & 1 ? fmin(o->limit[k], box[k] + more) : fmax(o->limit[k], box[k] - more);
  }
}

static void set_bounds(dyd_outline *o) {
  for (int k = 0; k < 4; k++) {
    dyd_iv end = o->window.end[k];
    o->of_window[k] = !(k & 1 ? o->limit[k] < end.lo : o->limit[k] > end.hi);
    o->bound[k] = o->of_window[k] ? end : dyd_iv_point(o->limit[k]);
  }
}

dyd_iv dyd_outline_coordinate(const dyd_outline *o, const dyd_outline_spot *p, int a) {
  if (p->side[a] >= 0) return o->window.end[2 * a + p->side[a]];
  return dyd_iv_add(p->at[a], dyd_iv_point(o->origin[a]));
}

/* ---- samples ---- */

static bool point_is_taken(dyd_outline *o, const dyd_iv at[2]) {
  bool taken = outline_taken(o, at);
  if (!taken && outline_may_be_taken(o, at)) o->unsure = true;
  return taken;
}

/* A double certainly between. */
static dyd_iv coordinate_between(dyd_outline *o, dyd_iv a, dyd_iv b) {
  double t = a.hi / 2 + b.lo / 2;
  if (!(a.hi < t && t < b.lo)) o->unsure = true;
  return dyd_iv_point(t);
}

/* ---- cuts and pieces ---- */

/* Sorts the cuts along an axis: few. */
static void sort_spots(dyd_outline *o, size_t count, int axis) {
  for (size_t k = 1; k < count; k++)
    for (size_t m = k; m > 0; m--) {
      const dyd_outline_spot *p = o->cut[m - 1], *q = o->cut[m];
      int order = dyd_outline_order(&o->unsure, p->at[axis], q->at[axis]);
      if (!order) o->unsure = true;
      if (order <= 0) break;
      o->cut[m - 1] = q;
      o->cut[m] = p;
    }
}

static void add_part(dyd_outline *o, size_t curve, const dyd_outline_arc *arc, bool grows, size_t k) {
  const dyd_outline_spot *low = o->cut[k], *high = o->cut[k + 1];
  if (o->pieces == DYD_OUTLINE_PIECES)
    o->unsure = true;
  else
    o->piece[o->pieces++] = (dyd_outline_piece){(uint32_t)curve, arc, grows ? low : high, grows ? high : low};
}

/* cut[0 .. count) are the ends of the arc and the meets on it. */
static void outline_arc_pieces(dyd_outline *o, uint32_t a) {
  const dyd_outline_arc *p = &o->arc[a];
  size_t count = 2;
  rivals_exclude(&o->rivals, p->curve);
  o->cut[0] = &p->end[0];
  o->cut[1] = &p->end[1];
  for (size_t m = 0; m < o->meets; m++)
    if (o->meet[m].arc[0] == a || o->meet[m].arc[1] == a) o->cut[count++] = &o->meet[m].spot;
  sort_spots(o, count, p->axis);
  int across = p->axis == 0 ? p->tilt[1] : p->tilt[0]; /* of the near feature, seen from the far corner */
  bool grows = ((across < 0) == (p->axis == 0)) != o->outer;
  size_t before = o->pieces;
  for (size_t k = 0; k + 1 < count && !o->unsure; k++) {
    dyd_iv t = coordinate_between(o, o->cut[k]->at[p->axis], o->cut[k + 1]->at[p->axis]);
    dyd_outline_spot sample = outline_arc_at(p, t);
    if (!point_is_taken(o, sample.at)) add_part(o, p->curve, p, grows, k);
  }
  if (p->either && o->pieces > before + 1) o->unsure = true; /* in which order? */
}

/* Sides of the window: bottom, right, top, left, as in exact_cell.h. */
static void outline_side_pieces(dyd_outline *o, int side) {
  int axis = side & 1, end = side == 1 || side == 2;
  bool grows = side < 2;
  size_t count = 2;
  if (!o->of_window[2 * (1 - axis) + end]) return; /* out of reach */
  rivals_exclude(&o->rivals, o->count);
  o->cut[0] = &o->corner[side];
  o->cut[1] = &o->corner[(side + 1) & 3];
  for (size_t a = 0; a < o->arcs; a++)
    for (int e = 0; e < 2; e++) {
      const dyd_outline_spot *p = &o->arc[a].end[e];
      if (p->side[1 - axis] != end) continue;
      if (count == DYD_OUTLINE_MEETS || p->side[axis] >= 0) o->unsure = true;
      if (!o->unsure) o->cut[count++] = p;
    }
  sort_spots(o, count, axis);
  for (size_t k = 0; k + 1 < count && !o->unsure; k++) {
    dyd_iv at[2];
    at[axis] = coordinate_between(o, o->cut[k]->at[axis], o->cut[k + 1]->at[axis]);
    at[1 - axis] = o->corner[side].at[1 - axis];
    if (!point_is_taken(o, at)) add_part(o, o->count + (size_t)side, NULL, grows, k);
  }
}

/* ---- the chain ---- */

static bool spots_meet(const dyd_outline_spot *p, const dyd_outline_spot *q) {
  for (int a = 0; a < 2; a++)
    if (!(p->at[a].lo <= q->at[a].hi && q->at[a].lo <= p->at[a].hi)) return false;
  return true;
}

/* next[p]: the only piece that can begin where p ends. */
static bool pieces_join(size_t next[DYD_OUTLINE_PIECES], size_t last[DYD_OUTLINE_PIECES], const dyd_outline *o) {
  for (size_t p = 0; p < o->pieces; p++) last[p] = SIZE_MAX;
  for (size_t p = 0; p < o->pieces; p++) {
    size_t found = 0;
    for (size_t q = 0; q < o->pieces; q++)
      if (o->piece[p].end == o->piece[q].begin || spots_meet(o->piece[p].end, o->piece[q].begin)) {
        next[p] = q;
        found++;
      }
    if (found != 1 || last[next[p]] != SIZE_MAX) return false;
    last[next[p]] = p;
  }
  return true;
}

static bool pieces_smooth(const dyd_outline_piece *p, const dyd_outline_piece *q) {
  if (p->curve != q->curve) return false;
  return p->arc == q->arc ||
         (p->arc && q->arc && p->arc->corner == q->arc->corner && p->arc->feature == q->arc->feature);
}

/* One chain of everything, begun where the exact work begins it: at the break before the first piece. */
static bool outline_link(dyd_outline *o) {
  size_t next[DYD_OUTLINE_PIECES], last[DYD_OUTLINE_PIECES], start = 0, p, seen = 0;
  if (!pieces_join(next, last, o)) return false;
  while (pieces_smooth(&o->piece[last[start]], &o->piece[start]) && last[start]) start = last[start];
  if (pieces_smooth(&o->piece[last[start]], &o->piece[start])) return false;
  p = start;
  do {
    if (p == start || !pieces_smooth(&o->piece[last[p]], &o->piece[p])) o->part[o->parts++] = o->piece[p];
    o->part[o->parts - 1].end = o->piece[p].end;
    p = next[p];
    seen++;
  } while (p != start);
  return seen == o->pieces;
}

bool dyd_filter_outline(dyd_outline *o, const dyd_rect *window, bool outer) {
  o->outer = outer;
  o->unsure = false;
  o->arcs = o->meets = o->pieces = o->parts = 0;
  if (!outline_place(o, window) && !outer) return !o->unsure;
  if (outer) limit_by_box(o);
  set_bounds(o);
  outline_find_arcs(o);
  if (!o->unsure) outline_find_meets(o);
  for (uint32_t a = 0; a < o->arcs && !o->unsure; a++) outline_arc_pieces(o, a);
  for (int side = 0; side < 4 && !o->unsure; side++) outline_side_pieces(o, side);
  if (o->unsure) return false;
  if (outer) limit_by_parts(o);
  return !o->pieces || outline_link(o);
}
