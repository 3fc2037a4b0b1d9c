/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where the curves of two others cross, arc by arc.
 *
 * Let a, b be arcs of the curves of j and k. A point of both lies in their boxes, and in panes with the same far corner
 * (Int) or the same near feature (Pos) of the site, or on the border of panes, which is never certain. Relative to the
 * far corner s of a, the point at u along the axis of a has the other coordinate w(u) = w0 + w1 u + w2 u^2, and what b
 * asks of it is A u^2 + B u + C = 0:
 *   as far from the point d as from 0 (the near corner of k for Int, the far corner of k for Pos): d.p = |d|^2 / 2;
 *   for Int and a near side of k at D, across the axis of a or along it, with a straight: |p|^2 = (p_o - D)^2;
 *   with a of the near side D' too, where |p| = |w - D'|: w = (D + D') / 2, or +-(u - D) = w - D', the signs being
 *   those of the panes, in which the point is beyond both sides. */
#include "voronoi/outline_filter.h"

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

/* num / den, unless it is surely beyond reach; false: not known. */
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
    dyd_iv p = dyd_outline_arc_span(a, k), q = dyd_outline_arc_span(b, k);
    if (p.hi < q.lo || q.hi < p.lo) return true;
  }
  return false;
}

/* Is the point of arc a in the pane of b? */
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
  dyd_outline_spot spot = dyd_outline_arc_at(p, t);
  if (!pane_holds(&unsure, q, &spot)) return;
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

void dyd_outline_find_meets(dyd_outline *o) {
  o->meets = 0;
  for (uint32_t a = 0; a < o->arcs && !o->unsure; a++) {
    profile w = profile_of(&o->arc[a]);
    for (uint32_t b = a + 1; b < o->arcs && !o->unsure; b++)
      if (o->arc[a].curve != o->arc[b].curve) arcs_meet(o, a, b, &w);
  }
}
