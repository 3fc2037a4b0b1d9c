/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The boundary of a region: arcs, cuts, a sample between two cuts, pieces, the chain of them.
 *
 * On the boundary of Int_i some j has dl_i = ds_j <= ds_k for all k; on that of Pos_i some j has dl_j = ds_i <= dl_k.
 * Let D_k = ds_k (Int) or dl_k (Pos), r = dl_i or ds_i. So the boundary consists of those points of the curves r = D_j
 * where no D_k is less than r. Along a curve this can change only where D_k = r too and no other D_l is less: there j
 * and k are both possible at the point, so jk is a possible pair [CELL-2]. Such points are centres of critical circles
 * FCC (Int) or CFF (Pos) of i, j, k [CRIT-1]: where the curves of j and k coincide along a stretch, since both show the
 * same feature, the end of the stretch is in a pane beyond it, in which they show different ones, and different
 * features leave finitely many circles. Between two cuts one sample decides. Of curves that coincide the one with the
 * lowest number counts.
 *
 * [OUTLINE-1] Every true end or meeting point lies in the box of a spot: the formulas are the exact ones in intervals,
 * and where a formula could give a point or none, or an order is not certain, exact numbers decide (outline.c). So the
 * order of cuts along an arc, the sides of samples and the pane of a meeting point are the true ones. More cuts than
 * necessary change nothing, as pieces of one arc are joined. Each finite end of a piece is where exactly one other
 * piece begins; where only one beginning has a box that meets the box of the end, it is that one. */
#include "voronoi/outline_filter.h"

#include "base/alloc.h"
#include "base/flag.h"
#include "base/invariant.h"

/* Returns false, with the status, once the work is cancelled. */
static bool outline_goes_on(dyd_outline *o) {
  if (o->status == DYD_OK && dyd_flag_is_set(o->cancel)) o->status = DYD_CANCELLED;
  return o->status == DYD_OK;
}

static bool outline_has_room(dyd_outline *o, size_t items, size_t size) {
  if (o->memory && !dyd_memory_has(o->memory, dyd_bytes_times(items, size), "the boundary of a cell"))
    o->status = DYD_E_NOMEM;
  return o->status == DYD_OK;
}

/* Makes room for `need` items, growing by half. */
#define OUTLINE_GROW(o, array, cap, need)                                                                              \
  ((need) <= (cap) || (outline_has_room((o), (need) + (need) / 2 + 16, sizeof *(array)) &&                             \
                       (DYD_GROW(array, cap, need) || ((o)->status = DYD_E_NOMEM, false))))

/* ---- the elementary arcs of outline.c in intervals ---- */

/* at: as given; to: relative to the origin. of: rectangles far and near, along an axis. */
typedef struct ruler {
  dyd_iv at[DYD_MARKS], to[DYD_MARKS], far_at[2], far_to[2];
  bool of_window[2];
  dyd_outline *o;
  size_t far, near;
  int axis;
  bool far_thin, near_thin; /* that side of them is one number */
} ruler;

static dyd_iv ruler_at(const ruler *r, int mark) {
  return mark < DYD_MARKS ? r->at[mark] : r->far_at[mark - DYD_MARKS];
}

static int ruler_order(const ruler *r, int a, int b) {
  bool doubt = false;
  int order = a == b ? 0 : dyd_outline_order(&doubt, ruler_at(r, a), ruler_at(r, b));
  if (!doubt) return order;
  return dyd_outline_exact_marks(r->o, r->far, r->near, r->axis, a, b); /* they may be one number */
}

static void ruler_set(ruler *r, dyd_outline *o, size_t far, size_t near, int axis) {
  for (int e = 0; e < 2; e++) {
    r->at[DYD_WINDOW_LO + e] = o->bound[2 * axis + e];
    r->to[DYD_WINDOW_LO + e] = dyd_iv_sub(o->bound[2 * axis + e], dyd_iv_point(o->origin[axis]));
    r->of_window[e] = o->of_window[2 * axis + e];
    r->at[DYD_NEAR_LO + e] = o->item[near].box.end[2 * axis + e];
    r->to[DYD_NEAR_LO + e] = o->item[near].near[2 * axis + e];
    r->far_at[e] = o->item[far].box.end[2 * axis + e];
    r->far_to[e] = o->item[far].near[2 * axis + e];
  }
  r->o = o;
  r->far = far;
  r->near = near;
  r->axis = axis;
  r->far_thin = o->item[far].thin[axis];
  r->near_thin = o->item[near].thin[axis];
  r->at[DYD_MIDDLE] = r->far_thin ? r->far_at[0] : dyd_iv_scale(dyd_iv_add(r->far_at[0], r->far_at[1]), 0.5);
  r->to[DYD_MIDDLE] = r->far_thin ? r->far_to[0] : dyd_iv_scale(dyd_iv_add(r->far_to[0], r->far_to[1]), 0.5);
}

/* ---- panes: strips of both axes ---- */

/* A closed strip between two marks, and what the rectangles show in it: the far one its end far_end, the near one the
 * mark q, or (fixed = false) the foot of the perpendicular on its side. above: beyond the middle. */
typedef struct strip {
  int lo, hi, q, far_end;
  bool fixed, above;
} strip;

static size_t marks_add_cut(int list[3], size_t n, const ruler *m, int mark) {
  if (ruler_order(m, mark, DYD_WINDOW_LO) <= 0 || ruler_order(m, mark, DYD_WINDOW_HI) >= 0) return n;
  size_t k = n;
  while (k > 0 && ruler_order(m, list[k - 1], mark) > 0) k--;
  if (k > 0 && !ruler_order(m, list[k - 1], mark)) return n;
  for (size_t q = n; q > k; q--) list[q] = list[q - 1];
  list[k] = mark;
  return n + 1;
}

/* The strips of one axis, lowest first; returns how many. near_point: both sides of the near rectangle are thin. */
static size_t ruler_strips(strip out[4], const ruler *m, bool near_point) {
  int list[3];
  size_t n = 0;
  if (!(m->far_thin && near_point)) n = marks_add_cut(list, n, m, DYD_MIDDLE);
  if (!m->near_thin) n = marks_add_cut(list, n, m, DYD_NEAR_LO);
  if (!m->near_thin) n = marks_add_cut(list, n, m, DYD_NEAR_HI);
  for (size_t k = 0; k <= n; k++) {
    strip *s = &out[k];
    s->lo = k > 0 ? list[k - 1] : DYD_WINDOW_LO;
    s->hi = k < n ? list[k] : DYD_WINDOW_HI;
    s->above = ruler_order(m, s->lo, DYD_MIDDLE) >= 0;
    s->far_end = m->far_thin || s->above ? 0 : 1;
    bool over = ruler_order(m, s->lo, DYD_NEAR_HI) >= 0;
    bool under = ruler_order(m, s->hi, DYD_NEAR_LO) <= 0;
    s->q = over && !m->near_thin ? DYD_NEAR_HI : DYD_NEAR_LO;
    s->fixed = over || under || m->near_thin;
  }
  return n + 1;
}

/* What the near rectangle shows in the pane of two strips. */
static dyd_feature_kind strips_feature(const strip s[2]) {
  bool upper[2] = {s[0].q == DYD_NEAR_HI, s[1].q == DYD_NEAR_HI};
  if (!s[0].fixed) return upper[1] ? DYD_SIDE_Y1 : DYD_SIDE_Y0;
  if (!s[1].fixed) return upper[0] ? DYD_SIDE_X1 : DYD_SIDE_X0;
  return (dyd_feature_kind)(upper[0] + 2 * upper[1]);
}

/* ---- points of an arc ---- */

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
    if (!sign) *unsure = true;
    if (to ? sign >= 0 : sign <= 0) continue;
    a->end[to].at[k] = t;
    a->end[to].at[o] = level;
    a->end[to].side[k] = -1;
    a->end[to].side[o] = m->end[o][e];
  }
  return true;
}

static bool outline_clip_filtered(dyd_outline_arc *a, uint32_t number, bool *unsure, const pane_sides *m) {
  int k = a->axis;
  for (int e = 0; e < 2; e++) {
    a->end[e] = dyd_outline_arc_at(a, e ? a->hi[k] : a->lo[k]);
    a->end[e].side[k] = m->end[k][e];
    a->end[e].number = 2 * number + (uint32_t)e;
  }
  if (!outline_clip_across(a, unsure, m)) return false;
  bool closed = false;
  int order = dyd_outline_order(&closed, a->end[0].at[k], a->end[1].at[k]);
  if (closed || !order) *unsure = true;
  return order < 0;
}

static bool outline_clip(dyd_outline *o, dyd_outline_arc *a, uint32_t number, const pane_sides *m) {
  bool unsure = false;
  a->point = false;
  for (int k = 0; k < 2; k++) unsure = unsure || !(isfinite(a->lo[k].lo) && isfinite(a->hi[k].hi));
  bool some = !unsure && outline_clip_filtered(a, number, &unsure, m);
  return unsure ? dyd_outline_exact_clip(o, a, number) : some;
}

/* ---- arcs ---- */

/* Which coordinate to go along. *either: not known. */
static int outline_axis(bool *either, const dyd_filter_arc *a, bool side_y) {
  if (a->parabola) return side_y ? 0 : 1;
  dyd_iv n[2];
  for (int k = 0; k < 2; k++) {
    dyd_iv d = dyd_iv_sub(a->q[k], a->s[k]);
    n[k] = (dyd_iv){fmax(0, fmax(d.lo, -d.hi)), fmax(-d.lo, d.hi)};
    if (!isfinite(d.lo + d.hi)) *either = true;
  }
  return dyd_outline_order(either, n[0], n[1]) <= 0 ? 0 : 1;
}

/* The arc of the pane of two strips; false: the pane is the near rectangle. The branch is the sign of t - s_k in the
 * pane, which the middle separates from s. */
static bool outline_set_arc(dyd_outline_arc *a, pane_sides *m, const ruler r[2], const strip s[2]) {
  if (!s[0].fixed && !s[1].fixed) return false;
  for (int k = 0; k < 2; k++) {
    a->shape.s[k] = r[k].far_to[s[k].far_end];
    a->shape.q[k] = s[k].fixed ? r[k].to[s[k].q] : DYD_IV_UNKNOWN;
    a->lo[k] = r[k].to[s[k].lo];
    a->hi[k] = r[k].to[s[k].hi];
    a->tilt[k] = s[k].fixed ? ruler_order(&r[k], s[k].q, DYD_MARKS + s[k].far_end) : 0;
    for (int e = 0; e < 2; e++) m->end[k][e] = window_side(&r[k], a->mark[k][e] = e ? s[k].hi : s[k].lo);
  }
  a->corner = s[0].far_end + 2 * s[1].far_end;
  a->feature = (int)strips_feature(s);
  a->shape.parabola = !s[0].fixed || !s[1].fixed;
  a->either = false;
  a->axis = outline_axis(&a->either, &a->shape, !s[0].fixed);
  if (a->either && !(a->tilt[0] && a->tilt[1])) a->axis = a->tilt[0] ? 1 : 0;
  a->branch = !a->shape.parabola ? 0 : s[a->axis].above ? 1 : -1;
  return a->tilt[1 - a->axis] != 0;
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

static strip_reach strip_reach_of(const ruler *r, const strip *s) {
  const dyd_outline_rival *far = &r->o->item[r->far].reach, *near = &r->o->item[r->near].reach;
  const double *f = far->box.e + 2 * r->axis, *n = near->box.e + 2 * r->axis;
  dyd_iv q = r->at[s->q], end = r->far_at[s->far_end];
  bool grows = s->fixed ? q.lo > end.hi : s->above;
  dyd_iv least = r->to[grows ? s->lo : s->hi], most = r->to[grows ? s->hi : s->lo];
  return (strip_reach){(s->fixed && !grows && !(q.hi < end.lo)) || !isfinite(least.lo + least.hi + most.lo + most.hi),
                       reach_square(dyd_max(f[1] - least.hi, least.lo - f[0]) - far->slack),
                       reach_square(dyd_max(n[0] - least.lo, least.hi - n[1]) + near->slack),
                       reach_square(dyd_max(f[1] - most.lo, most.hi - f[0])),
                       reach_square(dyd_max(n[0] - most.hi, most.lo - n[1]))};
}

/* Has the pane certainly no point of the curve? The difference of squares is monotone in each coordinate there [ARC-1];
 * the bounds are those of [FLT-DST]. */
static bool pane_is_clear(const strip_reach *x, const strip_reach *y) {
  if (x->none || y->none) return false;
  return dyd_lower(x->far_least + y->far_least) > dyd_upper(x->near_least + y->near_least) ||
         dyd_upper(x->far_most + y->far_most) < dyd_lower(x->near_most + y->near_most);
}

static void outline_add_curve(dyd_outline *o, uint32_t other) {
  size_t far = o->outer ? other : o->count, near = o->outer ? o->count : other;
  ruler r[2];
  strip x[4], y[4];
  for (int k = 0; k < 2; k++) ruler_set(&r[k], o, far, near, k);
  bool near_point = r[0].near_thin && r[1].near_thin;
  size_t columns = ruler_strips(x, &r[0], near_point), rows = ruler_strips(y, &r[1], near_point);
  strip_reach across[4], up[4];
  for (size_t k = 0; k < columns; k++) across[k] = strip_reach_of(&r[0], &x[k]);
  for (size_t k = 0; k < rows; k++) up[k] = strip_reach_of(&r[1], &y[k]);
  for (size_t k = 0; k < columns * rows && o->status == DYD_OK; k++) {
    const strip s[2] = {x[k / rows], y[k % rows]};
    pane_sides m;
    if (pane_is_clear(&across[k / rows], &up[k % rows]) || !OUTLINE_GROW(o, o->arc, o->arc_cap, o->arcs + 1)) continue;
    dyd_outline_arc *a = &o->arc[o->arcs];
    a->curve = other;
    if (!outline_set_arc(a, &m, r, s) || !outline_clip(o, a, (uint32_t)o->arcs, &m)) continue;
    o->arcs += !dyd_outline_arc_taken(o, a);
  }
}

/* Finds the arcs of the curves of all others, except arcs that are taken away [PRUNE-1]. */
static void outline_find_arcs(dyd_outline *o) {
  o->arcs = 0;
  for (uint32_t k = 0; k < o->count && outline_goes_on(o); k++) {
    if (o->item[k].drop) continue;
    dyd_outline_exclude(o, k);
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
 *   with a of the near side D' too, where |p| = |w - D'|: w = (D + D') / 2, or +-(u - D) = w - D', the point being on
 *   the side of the focus of both. */

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
  int same = a->tilt[1 - a->axis] * b->tilt[1 - b->axis];
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

static bool outline_add_meet(dyd_outline *o, const dyd_outline_meet *m) {
  if (!OUTLINE_GROW(o, o->meet, o->meet_cap, o->meets + 1)) return false;
  o->meet[o->meets] = *m;
  o->meet[o->meets].spot.number = (uint32_t)o->meets;
  o->meets++;
  return true;
}

/* The meet at u, if there is one. false: not known. */
static bool add_root(dyd_outline *o, dyd_outline_meet *m, dyd_iv u) {
  const dyd_outline_arc *p = &o->arc[m->arc[0]], *q = &o->arc[m->arc[1]];
  dyd_iv t = dyd_iv_add(p->shape.s[p->axis], u);
  bool unsure = false;
  for (int e = 0; e < 2; e++)
    if (!p->end[e].infinite && dyd_outline_order(&unsure, t, p->end[e].at[p->axis]) == (e ? 1 : -1)) return true;
  m->spot = dyd_outline_arc_at(p, t);
  m->spot.kind = DYD_OUTLINE_MEET;
  if (!pane_holds(&unsure, q, &m->spot) || dyd_outline_taken(o, m->spot.at)) return true;
  if (!unsure) outline_add_meet(o, m);
  return !unsure;
}

/* In intervals; false: not known. */
static bool arcs_meet_filtered(dyd_outline *o, uint32_t a, uint32_t b, const profile *w) {
  const dyd_outline_arc *p = &o->arc[a], *q = &o->arc[b];
  dyd_iv root[2], range = dyd_iv_sub((dyd_iv){p->end[0].at[p->axis].lo, p->end[1].at[p->axis].hi}, p->shape.s[p->axis]);
  quadratic f;
  int count;
  bool sure = !p->point && !q->point && meet_equation(&f, o, p, q, w) && find_roots(root, &count, &f, iv_most(range));
  if (!sure) return false;
  int lower = count == 2 && dyd_outline_order(&(bool){false}, root[0], root[1]) > 0;
  if (count == 2 && !(root[lower].hi < root[1 - lower].lo)) return false;
  for (int k = 0; k < count && sure; k++) {
    dyd_outline_meet m = {.arc = {a, b}, .root = k, .roots = count};
    sure = add_root(o, &m, root[k ^ lower]);
  }
  return sure;
}

static void arcs_meet(dyd_outline *o, uint32_t a, uint32_t b, const profile *w) {
  const dyd_outline_arc *p = &o->arc[a], *q = &o->arc[b];
  size_t before = o->meets;
  if (o->outer ? p->feature != q->feature : p->corner != q->corner) return;
  if (boxes_apart(p, q) || arcs_meet_filtered(o, a, b, w)) return;
  dyd_outline_spot at[DYD_OUTLINE_CIRCLES];
  size_t count = dyd_outline_exact_meets(at, o, a, b);
  o->meets = before;
  for (size_t k = 0; k < count; k++) {
    dyd_outline_meet m = {{a, b}, (int)k, (int)count, at[k]};
    if (!dyd_outline_taken(o, at[k].at)) outline_add_meet(o, &m);
  }
}

/* Where the curves cross. What a third takes away begins and ends no piece. */
static void outline_find_meets(dyd_outline *o) {
  o->meets = 0;
  for (uint32_t a = 0; a < o->arcs && outline_goes_on(o); a++) {
    profile w = profile_of(&o->arc[a]);
    dyd_outline_exclude(o, o->arc[a].curve);
    for (uint32_t b = a + 1; b < o->arcs && o->status == DYD_OK; b++)
      if (o->arc[a].curve != o->arc[b].curve) arcs_meet(o, a, b, &w);
  }
}

/* ---- samples ---- */

/* A double certainly between; false: not found. */
static bool coordinate_between(dyd_iv *out, dyd_iv a, dyd_iv b) {
  double t = a.hi / 2 + b.lo / 2;
  *out = dyd_iv_point(t);
  return a.hi < t && t < b.lo;
}

/* Of curves that coincide the one with the lowest number counts. */
static bool sample_is_kept(const dyd_outline *o, const dyd_outline_spot *p, size_t curve) {
  for (size_t k = 0; k < o->count; k++) {
    if (k == curve || o->item[k].drop || !dyd_outline_may_take(o, k, p->at)) continue;
    int sign = dyd_outline_exact_side(o, p->exact, k);
    if (sign < 0 || (!sign && k < curve)) return false;
  }
  return true;
}

/* Is the stretch between two cuts of an arc, or (NULL) of a side of the window, on the boundary? */
static bool stretch_is_kept(dyd_outline *o, const dyd_outline_arc *a, int side, dyd_outline_spot *low,
                            dyd_outline_spot *high) {
  int axis = a ? a->axis : side & 1;
  dyd_iv t;
  if (!low->infinite && !high->infinite && coordinate_between(&t, low->at[axis], high->at[axis])) {
    dyd_outline_spot sample = a ? dyd_outline_arc_at(a, t) : o->corner[side];
    sample.at[axis] = t;
    if (dyd_outline_taken(o, sample.at)) return false;
    if (!dyd_outline_may_be_taken(o, sample.at)) return true;
  }
  dyd_outline_spot p;
  return dyd_outline_exact_sample(&p, o, a, side, low, high) && sample_is_kept(o, &p, a ? a->curve : o->count);
}

/* ---- cuts and pieces ---- */

/* Of finite ones. */
static int spot_order(dyd_outline *o, dyd_outline_spot *p, dyd_outline_spot *q, int axis) {
  bool unsure = false;
  int order = dyd_outline_order(&unsure, p->at[axis], q->at[axis]);
  return unsure ? dyd_outline_exact_order(o, p, q, axis) : order;
}

/* Sorts the cuts between the first and the last along an axis, drops repeats and cuts that are not between them;
 * returns how many are left with both. Few. */
static size_t sort_spots(dyd_outline *o, size_t count, int axis) {
  dyd_outline_spot **cut = o->cut, *last = cut[count - 1];
  size_t kept = 1;
  for (size_t k = 1; k + 1 < count && o->status == DYD_OK; k++) {
    dyd_outline_spot *p = cut[k];
    size_t m = kept;
    int order = 1;
    if (!cut[0]->infinite && spot_order(o, p, cut[0], axis) <= 0) continue;
    if (!last->infinite && spot_order(o, p, last, axis) >= 0) continue;
    while (m > 1 && (order = spot_order(o, p, cut[m - 1], axis)) < 0) m--;
    if (m > 1 && !order) continue;
    for (size_t q = kept++; q > m; q--) cut[q] = cut[q - 1];
    cut[m] = p;
  }
  cut[kept++] = last;
  return kept;
}

static void add_piece(dyd_outline *o, size_t curve, const dyd_outline_arc *arc, bool grows, size_t k) {
  dyd_outline_spot *low = o->cut[k], *high = o->cut[k + 1];
  if (!OUTLINE_GROW(o, o->piece, o->piece_cap, o->pieces + 1)) return;
  o->piece[o->pieces++] = (dyd_outline_piece){(uint32_t)curve, arc, grows ? low : high, grows ? high : low};
}

/* In the order along the axis that exact numbers choose, so that no rounding decides where a chain begins. */
static void order_pieces(dyd_outline *o, const dyd_outline_arc *a, size_t from) {
  if (!a->either || o->pieces < from + 2 || outline_arc_slope(a) > 0 || dyd_outline_exact_axis(o, a) == a->axis) return;
  for (size_t k = from, m = o->pieces - 1; k < m; k++, m--) {
    dyd_outline_piece t = o->piece[k];
    o->piece[k] = o->piece[m];
    o->piece[m] = t;
  }
}

/* cut[0 .. count) are the ends of the arc and the meets on it. */
static void outline_arc_pieces(dyd_outline *o, uint32_t a) {
  dyd_outline_arc *p = &o->arc[a];
  size_t count = 1;
  if (p->point || !OUTLINE_GROW(o, o->cut, o->cut_cap, o->meets + 2)) return;
  dyd_outline_exclude(o, p->curve);
  o->cut[0] = &p->end[0];
  for (size_t m = 0; m < o->meets; m++)
    if (o->meet[m].arc[0] == a || o->meet[m].arc[1] == a) o->cut[count++] = &o->meet[m].spot;
  o->cut[count++] = &p->end[1];
  count = sort_spots(o, count, p->axis);
  int across = p->axis == 0 ? p->tilt[1] : p->tilt[0]; /* of the near feature, seen from the far corner */
  bool grows = ((across < 0) == (p->axis == 0)) != o->outer;
  size_t before = o->pieces;
  for (size_t k = 0; k + 1 < count && o->status == DYD_OK; k++)
    if (stretch_is_kept(o, p, 0, o->cut[k], o->cut[k + 1])) add_piece(o, p->curve, p, grows, k);
  order_pieces(o, p, before);
}

/* Sides of the window: bottom, right, top, left, as in outline.c.
 *
 * Inside W the boundary of the region consists of pieces of the curves, and of points at which a curve touches W from
 * outside. So along a side the region can begin or end only at an end of an arc on that side (arcs that are one point
 * included, so that no sample meets a touching point). Between two such ends a sample decides; a stretch that lies on
 * the boundary of the region itself does not count as a piece of the window (the curve's arc is one, if it has the
 * region on the side of W). */
static void outline_side_pieces(dyd_outline *o, int side) {
  int axis = side & 1, end = side == 1 || side == 2;
  bool grows = side < 2;
  size_t count = 1;
  dyd_outline_spot *first = &o->corner[side], *last = &o->corner[(side + 1) & 3];
  if (!o->of_window[2 * (1 - axis) + end]) return; /* out of reach */
  if (!OUTLINE_GROW(o, o->cut, o->cut_cap, 2 * o->arcs + 2)) return;
  dyd_outline_exclude(o, o->count);
  o->cut[0] = grows ? first : last;
  for (size_t a = 0; a < o->arcs; a++)
    for (int e = 0; e < 2; e++) {
      dyd_outline_spot *p = &o->arc[a].end[e];
      if (!p->infinite && p->side[1 - axis] == end && p->side[axis] < 0) o->cut[count++] = p;
    }
  o->cut[count++] = grows ? last : first;
  count = sort_spots(o, count, axis);
  for (size_t k = 0; k + 1 < count && o->status == DYD_OK; k++)
    if (stretch_is_kept(o, NULL, side, o->cut[k], o->cut[k + 1])) add_piece(o, o->count + (size_t)side, NULL, grows, k);
}

/* ---- chains ----
 *
 * Each piece ends where exactly one other begins, since the region has no pinched point in the plane: Int_i is convex,
 * and near a point outside R_i the segments towards R_i, all in Pos_i, run in nearly one direction. A curve may touch
 * a side of the window; there each continues alone, so a piece is first joined to the next one of its own curve. */

static bool spots_meet(const dyd_outline_spot *p, const dyd_outline_spot *q) {
  for (int a = 0; a < 2; a++)
    if (p->at[a].lo > q->at[a].hi || q->at[a].lo > p->at[a].hi) return false;
  return true;
}

static bool same_spot(dyd_outline *o, dyd_outline_spot *p, dyd_outline_spot *q) {
  if (p == q) return true;
  return spots_meet(p, q) && !dyd_outline_exact_order(o, p, q, 0) && !dyd_outline_exact_order(o, p, q, 1);
}

/* The piece that begins where p ends, which has no successor yet. */
static size_t find_next(dyd_outline *o, size_t p, bool own) {
  for (size_t q = 0; q < o->pieces; q++) {
    const dyd_outline_piece *a = &o->piece[p], *b = &o->piece[q];
    if (o->last[q] != SIZE_MAX || b->begin->infinite || (own && a->curve != b->curve)) continue;
    if (same_spot(o, a->end, b->begin)) return q;
  }
  return SIZE_MAX;
}

/* The only piece that can begin where p ends; SIZE_MAX: there are several. */
static size_t only_next(const dyd_outline *o, size_t p) {
  size_t found = SIZE_MAX;
  for (size_t q = 0; q < o->pieces; q++) {
    const dyd_outline_spot *from = o->piece[p].end, *to = o->piece[q].begin;
    if (to->infinite || (from != to && !spots_meet(from, to))) continue;
    if (found != SIZE_MAX) return SIZE_MAX;
    found = q;
  }
  return found;
}

/* next[p], last[p]: the pieces behind and before p; SIZE_MAX: p ends or begins at infinity. */
static void outline_join(dyd_outline *o) {
  size_t cap = o->link_cap;
  if (!OUTLINE_GROW(o, o->next, cap, o->pieces) || !OUTLINE_GROW(o, o->last, o->link_cap, o->pieces)) return;
  for (size_t p = 0; p < o->pieces; p++) o->next[p] = o->last[p] = SIZE_MAX;
  for (int pass = 0; pass < 3; pass++) /* certain ones, those of the same curve, others */
    for (size_t p = 0; p < o->pieces && o->status == DYD_OK; p++) {
      if (o->piece[p].end->infinite || o->next[p] != SIZE_MAX) continue;
      size_t q = pass ? find_next(o, p, pass == 1) : only_next(o, p);
      if (q != SIZE_MAX && o->last[q] != SIZE_MAX) q = SIZE_MAX;
      if (q != SIZE_MAX) o->next[o->last[q] = p] = q;
      DYD_INVARIANT(pass < 2 || q != SIZE_MAX || o->status != DYD_OK);
    }
}

bool dyd_outline_smooth(const dyd_outline *o, size_t p) {
  size_t n = o->next[p];
  if (n == SIZE_MAX || o->piece[p].curve != o->piece[n].curve) return false;
  const dyd_outline_arc *a = o->piece[p].arc, *b = o->piece[n].arc;
  return a == b || (a && b && a->corner == b->corner && a->feature == b->feature);
}

size_t dyd_outline_start(const dyd_outline *o, size_t p) {
  size_t start = p;
  while (o->last[start] != SIZE_MAX && o->last[start] != p) start = o->last[start];
  if (o->last[start] == SIZE_MAX) return start;
  size_t q = p;
  while (dyd_outline_smooth(o, o->last[q]) && o->last[q] != p) q = o->last[q];
  return q;
}

dyd_status dyd_outline_find(dyd_outline *o, const dyd_rect *window, bool outer) {
  dyd_outline_exact_clear(o);
  o->outer = outer;
  o->status = DYD_OK;
  o->arcs = o->meets = o->pieces = 0;
  bool free = dyd_outline_place(o, window);
  if (!free && !outer) return o->status;
  if (outer && !o->blind) dyd_outline_limit_by_box(o);
  dyd_outline_set_bounds(o);
  outline_find_arcs(o);
  outline_find_meets(o);
  for (uint32_t a = 0; a < o->arcs && outline_goes_on(o); a++) outline_arc_pieces(o, a);
  for (int side = 0; side < 4 && window && outline_goes_on(o); side++) outline_side_pieces(o, side);
  if (o->status == DYD_OK) outline_join(o);
  if (o->status == DYD_OK && outer && !o->blind) dyd_outline_limit_by_parts(o);
  return o->status;
}
