/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The elementary arcs of voronoi/bisector.c in intervals: the same panes in the same order, each decision certain. */
#include "voronoi/outline_filter.h"
#include <dyadel/voronoi.h>

/* Marks on one axis: ends of the window, the middle of the far rectangle, ends of the near one. */
enum { WINDOW_LO, WINDOW_HI, MIDDLE, NEAR_LO, NEAR_HI, MARKS };

/* at: as given; to: relative to the origin. */
typedef struct ruler {
  dyd_iv at[MARKS], to[MARKS], far_at[2], far_to[2];
  bool far_thin, near_thin, of_window[2];
} ruler;

/* A closed strip between two marks, and what the rectangles show in it: q is a mark, or fixed = false. */
typedef struct strip {
  int lo, hi, q, far_end;
  bool fixed, above, over;
} strip;

static int marks_order(bool *unsure, const ruler *r, int a, int b) {
  return a == b ? 0 : dyd_outline_order(unsure, r->at[a], r->at[b]);
}

static void ruler_set(ruler *r, dyd_outline *o, size_t far, size_t near, int axis) {
  for (int e = 0; e < 2; e++) {
    r->at[WINDOW_LO + e] = o->bound[2 * axis + e];
    r->to[WINDOW_LO + e] = dyd_iv_sub(o->bound[2 * axis + e], dyd_iv_point(o->origin[axis]));
    r->of_window[e] = o->of_window[2 * axis + e];
    r->at[NEAR_LO + e] = o->box[near].end[2 * axis + e];
    r->to[NEAR_LO + e] = o->near[near].end[2 * axis + e];
    r->far_at[e] = o->box[far].end[2 * axis + e];
    r->far_to[e] = o->near[far].end[2 * axis + e];
  }
  r->far_thin = o->thin[far][axis];
  r->near_thin = o->thin[near][axis];
  r->at[MIDDLE] = r->far_thin ? r->far_at[0] : dyd_iv_scale(dyd_iv_add(r->far_at[0], r->far_at[1]), 0.5);
  r->to[MIDDLE] = r->far_thin ? r->far_to[0] : dyd_iv_scale(dyd_iv_add(r->far_to[0], r->far_to[1]), 0.5);
}

static size_t ruler_add_cut(int list[3], size_t n, bool *unsure, const ruler *r, int mark) {
  if (marks_order(unsure, r, mark, WINDOW_LO) <= 0 || marks_order(unsure, r, mark, WINDOW_HI) >= 0) return n;
  size_t k = n;
  while (k > 0 && marks_order(unsure, r, list[k - 1], mark) > 0) k--;
  if (k > 0 && !marks_order(unsure, r, list[k - 1], mark)) return n;
  for (size_t m = n; m > k; m--) list[m] = list[m - 1];
  list[k] = mark;
  return n + 1;
}

static size_t ruler_set_strips(strip out[4], bool *unsure, const ruler *r, bool near_point) {
  int list[3];
  size_t n = 0;
  if (!(r->far_thin && near_point)) n = ruler_add_cut(list, n, unsure, r, MIDDLE);
  if (!r->near_thin) n = ruler_add_cut(list, n, unsure, r, NEAR_LO);
  if (!r->near_thin) n = ruler_add_cut(list, n, unsure, r, NEAR_HI);
  for (size_t k = 0; k <= n; k++) {
    strip *s = &out[k];
    s->lo = k > 0 ? list[k - 1] : WINDOW_LO;
    s->hi = k < n ? list[k] : WINDOW_HI;
    s->above = marks_order(unsure, r, s->lo, MIDDLE) >= 0;
    s->far_end = r->far_thin || s->above ? 0 : 1;
    s->over = marks_order(unsure, r, s->lo, NEAR_HI) >= 0;
    bool under = marks_order(unsure, r, s->hi, NEAR_LO) <= 0;
    s->q = s->over && !r->near_thin ? NEAR_HI : NEAR_LO;
    s->fixed = s->over || under || r->near_thin;
  }
  return n + 1;
}

/* ---- points of an arc ---- */

dyd_outline_spot dyd_outline_arc_at(const dyd_outline_arc *a, dyd_iv t) {
  dyd_outline_spot p = {.side = {-1, -1}};
  p.at[a->axis] = t;
  p.at[1 - a->axis] = dyd_filter_arc_other(&a->shape, a->axis, t);
  return p;
}

dyd_iv dyd_outline_arc_span(const dyd_outline_arc *a, int k) {
  dyd_iv p = a->end[0].at[k], q = a->end[1].at[k]; /* monotone between them [ARC-1] */
  if (!isfinite(p.lo + p.hi + q.lo + q.hi)) return DYD_IV_UNKNOWN;
  return (dyd_iv){p.lo < q.lo ? p.lo : q.lo, p.hi > q.hi ? p.hi : q.hi};
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
  return mark == WINDOW_LO && r->of_window[0] ? 0 : mark == WINDOW_HI && r->of_window[1] ? 1 : -1;
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
    a->end[e] = dyd_outline_arc_at(a, e ? a->hi[k] : a->lo[k]);
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

static int outline_feature(const strip s[2]) {
  if (!s[0].fixed) return s[1].q == NEAR_HI ? DYD_SIDE_Y1 : DYD_SIDE_Y0;
  if (!s[1].fixed) return s[0].q == NEAR_HI ? DYD_SIDE_X1 : DYD_SIDE_X0;
  return (s[0].q == NEAR_HI) + 2 * (s[1].q == NEAR_HI);
}

/* As curve_set_arc. */
static bool outline_set_arc(dyd_outline_arc *a, pane_sides *m, bool *unsure, const ruler r[2], const strip s[2]) {
  if (!s[0].fixed && !s[1].fixed) return false;
  for (int k = 0; k < 2; k++) {
    a->shape.s[k] = r[k].far_to[s[k].far_end];
    a->shape.q[k] = s[k].fixed ? r[k].to[s[k].q] : DYD_IV_UNKNOWN;
    a->lo[k] = r[k].to[s[k].lo];
    a->hi[k] = r[k].to[s[k].hi];
    a->tilt[k] = s[k].fixed ? dyd_outline_order(unsure, r[k].at[s[k].q], r[k].far_at[s[k].far_end]) : 0;
    a->near_side[k] = s[k].over ? 1 : -1;
    m->end[k][0] = window_side(&r[k], s[k].lo);
    m->end[k][1] = window_side(&r[k], s[k].hi);
  }
  a->corner = s[0].far_end + 2 * s[1].far_end;
  a->feature = outline_feature(s);
  a->shape.parabola = !s[0].fixed || !s[1].fixed;
  a->either = false;
  a->axis = outline_axis(&a->either, &a->shape, !s[0].fixed);
  a->branch = !a->shape.parabola ? 0 : s[a->axis].above ? 1 : -1;
  return a->tilt[1 - a->axis] && !dyd_filter_no_arc(&a->shape, a->axis, a->branch, a->lo, a->hi);
}

/* All of it? Its boundary points are boundary of nothing then, and cuts there decide nothing. */
static bool arc_is_taken(dyd_outline *o, const dyd_outline_arc *a) {
  const dyd_iv box[2] = {dyd_outline_arc_span(a, 0), dyd_outline_arc_span(a, 1)};
  return dyd_outline_taken(NULL, o, a->curve, box);
}

static void outline_add_curve(dyd_outline *o, uint32_t other) {
  size_t far = o->outer ? other : o->count, near = o->outer ? o->count : other;
  ruler r[2];
  strip x[4], y[4];
  for (int k = 0; k < 2; k++) ruler_set(&r[k], o, far, near, k);
  bool near_point = r[0].near_thin && r[1].near_thin;
  size_t columns = ruler_set_strips(x, &o->unsure, &r[0], near_point),
         rows = ruler_set_strips(y, &o->unsure, &r[1], near_point);
  for (size_t k = 0; k < columns * rows && !o->unsure; k++) {
    const strip s[2] = {x[k / rows], y[k % rows]};
    dyd_outline_arc *a = &o->arc[o->arcs];
    pane_sides m;
    if (o->arcs == DYD_OUTLINE_ARCS) {
      o->unsure = true;
    } else if (outline_set_arc(a, &m, &o->unsure, r, s) && outline_clip(a, &o->unsure, &m)) {
      a->curve = other;
      o->arcs += !arc_is_taken(o, a);
    }
  }
}

void dyd_outline_find_arcs(dyd_outline *o) {
  o->arcs = 0;
  for (uint32_t k = 0; k < o->count && !o->unsure; k++)
    if (!o->drop[k]) outline_add_curve(o, k);
}
