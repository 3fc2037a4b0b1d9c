/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Elementary arcs of the boundary of C_ab.
 *
 * [ARC-1] Let s be the far corner of a and q the closest feature of b in a pane. With n = q - s and m = q + s, corners
 * q give the line n_x (2x - m_x) + n_y (2y - m_y) = 0; a side on the line of coordinate L along axis k (o the other
 * one) gives the parabola (t - s_k)^2 = h (2v - L - s_o), h = s_o - L, for the point with coordinates t along k, v
 * along o. The middle line of a through the far corner's axis bounds the pane, and s lies beyond it, so t - s_k has one
 * sign in the pane: the arc is one branch, monotone in both coordinates, and its part in the pane is connected. It
 * cannot run along the border of a pane, since s, the corner q or the corner opposite s would then lie in both
 * rectangles; along a side of the window it can. For singletons a and b no cut is needed. */
#include "voronoi/exact_cell.h"

#include "base/invariant.h"

void dyd_curve_init(dyd_curve *c) {
  c->count = 0;
  mpz_inits(c->middle[0], c->middle[1], NULL);
  for (size_t k = 0; k < DYD_CURVE_ARCS; k++)
    for (int e = 0; e < 2; e++) dyd_surd_point_init(&c->arc[k].end[e].at);
}

void dyd_curve_clear(dyd_curve *c) {
  for (size_t k = DYD_CURVE_ARCS; k-- > 0;)
    for (int e = 2; e-- > 0;) dyd_surd_point_clear(&c->arc[k].end[e].at);
  mpz_clears(c->middle[0], c->middle[1], NULL);
}

/* ---- slabs ---- */

/* A closed strip along one axis: what the rectangles show in it. far_bit, near_bit choose the upper end of the side;
 * near_free: the foot on the side. */
typedef struct slab {
  mpz_srcptr lo, hi, s, q;
  dyd_iv lo_d, hi_d, s_d, q_d;
  int far_bit, near_bit;
} slab;

typedef struct cut {
  mpz_srcptr at;
  dyd_iv near;
} cut;

/* The input of one axis. */
typedef struct side_set {
  mpz_srcptr far[2], near[2], window[2], middle;
  dyd_iv far_d[2], near_d[2], window_d[2], middle_d;
} side_set;

static void side_set_init(side_set *s, const dyd_scaled *far, const dyd_scaled *near, const dyd_scaled *window,
                          int axis, mpz_srcptr middle) {
  for (int e = 0; e < 2; e++) {
    s->far[e] = dyd_irect_end(&far->r, axis, e);
    s->near[e] = dyd_irect_end(&near->r, axis, e);
    s->window[e] = window ? dyd_irect_end(&window->r, axis, e) : NULL;
    s->far_d[e] = far->box.end[2 * axis + e];
    s->near_d[e] = near->box.end[2 * axis + e];
    s->window_d[e] = window ? window->box.end[2 * axis + e] : DYD_IV_UNKNOWN;
  }
  s->middle = middle;
  s->middle_d = dyd_iv_scale(dyd_iv_add(s->far_d[0], s->far_d[1]), 0.5);
}

/* Adds a cut, kept in ascending order without repeats, if it is strictly inside the window. */
static size_t add_slab_cut(cut *list, size_t n, const side_set *s, mpz_srcptr at, dyd_iv near) {
  if (s->window[0] && (mpz_cmp(at, s->window[0]) <= 0 || mpz_cmp(at, s->window[1]) >= 0)) return n;
  size_t k = n;
  while (k > 0 && mpz_cmp(list[k - 1].at, at) > 0) k--;
  if (k > 0 && !mpz_cmp(list[k - 1].at, at)) return n;
  for (size_t m = n; m > k; m--) list[m] = list[m - 1];
  list[k] = (cut){at, near};
  return n + 1;
}

/* What the rectangles show in the slab lo .. hi. */
static void show_slab(slab *out, const side_set *s, bool far_thin, bool near_thin) {
  bool above = out->lo && mpz_cmp(out->lo, s->middle) >= 0;
  out->far_bit = far_thin || above ? 0 : 1;
  out->s = s->far[out->far_bit];
  out->s_d = s->far_d[out->far_bit];
  bool over = out->lo && mpz_cmp(out->lo, s->near[1]) >= 0, under = out->hi && mpz_cmp(out->hi, s->near[0]) <= 0;
  out->near_bit = over && !near_thin;
  bool fixed = over || under || near_thin;
  out->q = fixed ? s->near[out->near_bit] : NULL;
  out->q_d = fixed ? s->near_d[out->near_bit] : DYD_IV_UNKNOWN;
}

/* The slabs of one axis, lowest first; points: both rectangles are singletons. */
static size_t curve_set_slabs(slab out[4], const side_set *s, bool near_point) {
  bool far_thin = !mpz_cmp(s->far[0], s->far[1]), near_thin = !mpz_cmp(s->near[0], s->near[1]);
  cut list[3];
  size_t n = 0;
  if (!(far_thin && near_point)) n = add_slab_cut(list, n, s, s->middle, s->middle_d);
  if (!near_thin) {
    n = add_slab_cut(list, n, s, s->near[0], s->near_d[0]);
    n = add_slab_cut(list, n, s, s->near[1], s->near_d[1]);
  }
  for (size_t k = 0; k <= n; k++) {
    out[k].lo = k > 0 ? list[k - 1].at : s->window[0];
    out[k].lo_d = k > 0 ? list[k - 1].near : s->window_d[0];
    out[k].hi = k < n ? list[k].at : s->window[1];
    out[k].hi_d = k < n ? list[k].near : s->window_d[1];
    show_slab(&out[k], s, far_thin, near_thin);
  }
  return n + 1;
}

/* ---- points of an arc ---- */

/* The coordinate n_k (2 t - m_k) + n_o (2 v - m_o) = 0 of a line: given t = num / 2^bits along k, v along o. */
static void point_of_line(dyd_surd_point *out, const dyd_elementary *a, int k, mpz_srcptr num, int64_t bits) {
  int o = 1 - k;
  mpz_ptr to[2] = {out->ax, out->ay};
  mpz_t n, m;
  mpz_inits(n, m, NULL);
  mpz_sub(n, a->q[k], a->s[k]);
  mpz_add(m, a->q[k], a->s[k]);
  mpz_mul(to[o], n, m);
  mpz_sub(out->d, a->q[o], a->s[o]);
  mpz_add(m, a->q[o], a->s[o]);
  mpz_addmul(to[o], out->d, m);
  mpz_mul_2exp(to[o], to[o], (mp_bitcnt_t)bits);
  mpz_mul_2exp(n, n, 1);
  mpz_submul(to[o], n, num); /* 2^bits n.m - 2 n_k num */
  mpz_mul_2exp(out->d, out->d, 1);
  mpz_mul(to[k], num, out->d);
  mpz_mul_2exp(out->d, out->d, (mp_bitcnt_t)bits);
  mpz_clears(n, m, NULL);
}

/* v = ((t - s_k)^2 + h (L + s_o)) / 2h */
static void point_of_parabola(dyd_surd_point *out, const dyd_elementary *a, mpz_srcptr num, int64_t bits) {
  int k = a->axis, o = 1 - k;
  mpz_ptr to[2] = {out->ax, out->ay};
  mpz_mul_2exp(to[k], a->s[k], (mp_bitcnt_t)bits);
  mpz_sub(to[k], num, to[k]);
  mpz_sub(out->d, a->s[o], a->q[o]);
  mpz_add(to[o], a->s[o], a->q[o]);
  mpz_mul(to[o], to[o], out->d);
  mpz_mul_2exp(to[o], to[o], (mp_bitcnt_t)(2 * bits));
  mpz_addmul(to[o], to[k], to[k]);
  mpz_mul_2exp(out->d, out->d, (mp_bitcnt_t)bits + 1);
  mpz_mul(to[k], num, out->d);
  mpz_mul_2exp(out->d, out->d, (mp_bitcnt_t)bits);
}

static void point_make_positive(dyd_surd_point *p) {
  if (mpz_sgn(p->d) > 0) return;
  mpz_neg(p->d, p->d);
  mpz_neg(p->ax, p->ax);
  mpz_neg(p->ay, p->ay);
}

void dyd_elementary_at(dyd_surd_point *out, const dyd_elementary *a, mpz_srcptr num, int64_t bits) {
  dyd_surd_point_drop_root(out);
  if (a->parabola) {
    point_of_parabola(out, a, num, bits);
  } else {
    point_of_line(out, a, a->axis, num, bits);
  }
  point_make_positive(out);
}

/* The point where coordinate o = 1 - axis is z. -1, 1: there is none, all of the parabola is below, above z. */
static int point_across(dyd_surd_point *out, const dyd_elementary *a, mpz_srcptr z) {
  int k = a->axis, o = 1 - k;
  dyd_surd_point_drop_root(out);
  if (!a->parabola) {
    point_of_line(out, a, o, z, 0);
    point_make_positive(out);
    return 0;
  }
  mpz_ptr to[2] = {out->ax, out->ay}, root[2] = {out->bx, out->by};
  mpz_mul_2exp(out->c, z, 1);
  mpz_sub(out->c, out->c, a->q[o]);
  mpz_sub(out->c, out->c, a->s[o]);
  mpz_sub(out->d, a->s[o], a->q[o]);
  int opens = mpz_sgn(out->d);
  mpz_mul(out->c, out->c, out->d);
  mpz_set_ui(out->d, 1);
  if (mpz_sgn(out->c) < 0) return mpz_set_ui(out->c, 0), opens;
  mpz_set(to[k], a->s[k]);
  mpz_set(to[o], z);
  mpz_set_si(root[k], a->branch);
  return 0;
}

/* ---- clipping ---- */

/* Sign of dv/dt. */
static int arc_slope(const dyd_elementary *a) {
  int k = a->axis, o = 1 - k;
  int across = mpz_cmp(a->q[o], a->s[o]) > 0 ? 1 : -1;
  if (a->parabola) return -across * a->branch;
  int n = mpz_cmp(a->q[k], a->s[k]);
  return n > 0 ? -across : n < 0 ? across : 0;
}

/* end[e] = the tighter of itself and p (swapped in); e = 0: lower end. */
static void tighten_end(dyd_spot *end, dyd_surd_point *p, int axis, int e) {
  int sign = end->infinite ? 0 : dyd_surd_point_cmp(p, &end->at, axis);
  if (!end->infinite && (e ? sign >= 0 : sign <= 0)) return;
  dyd_surd_point t = end->at;
  end->at = *p;
  *p = t;
  end->infinite = false;
}

/* A line along `axis`, v = m/2 everywhere: is it in the pane, and on its border only with the region inside? */
static bool level_is_inside(const dyd_elementary *a, int side) {
  int o = 1 - a->axis;
  mpz_t m, t;
  mpz_inits(m, t, NULL);
  mpz_add(m, a->q[o], a->s[o]);
  bool inside = true;
  for (int e = 0; e < 2 && inside; e++) {
    mpz_srcptr bound = e ? a->hi[o] : a->lo[o];
    if (!bound) continue;
    mpz_mul_2exp(t, bound, 1);
    int beyond = mpz_cmp(m, t) * (e ? 1 : -1), region = side * (mpz_cmp(a->s[o], a->q[o]) > 0 ? 1 : -1);
    inside = beyond < 0 || (beyond == 0 && region == (e ? -1 : 1));
  }
  mpz_clears(m, t, NULL);
  return inside;
}

/* Cuts by the bounds of coordinate o; false: nothing left. */
static bool clip_arc_across(dyd_elementary *a, dyd_surd_point *p, int side) {
  int o = 1 - a->axis, grows = arc_slope(a);
  if (!a->parabola && !grows) return level_is_inside(a, side);
  for (int e = 0; e < 2; e++) {
    mpz_srcptr bound = e ? a->hi[o] : a->lo[o];
    if (!bound) continue;
    int missed = point_across(p, a, bound);
    if (missed && (missed > 0) == (e == 1)) return false;
    if (!missed) tighten_end(&a->end[grows > 0 ? e : 1 - e], p, a->axis, grows > 0 ? e : 1 - e);
  }
  return true;
}

/* Sets the ends and `point`; false: nothing in the pane. */
static bool clip_arc(dyd_elementary *a, dyd_surd_point *p, int side) {
  a->end[0].infinite = a->end[1].infinite = true;
  a->point = false;
  for (int e = 0; e < 2; e++) {
    mpz_srcptr bound = e ? a->hi[a->axis] : a->lo[a->axis];
    if (!bound) continue;
    dyd_elementary_at(&a->end[e].at, a, bound, 0);
    a->end[e].infinite = false;
  }
  if (!clip_arc_across(a, p, side)) return false;
  if (a->end[0].infinite || a->end[1].infinite) return true;
  int order = dyd_surd_point_cmp(&a->end[0].at, &a->end[1].at, a->axis);
  a->point = order == 0;
  return order <= 0;
}

/* ---- arcs ---- */

/* Which coordinate to go along: across n where n is longer, or along the directrix. */
static int arc_choose_axis(const dyd_elementary *a) {
  if (a->parabola) return a->q[0] ? 1 : 0;
  mpz_t x, y;
  mpz_inits(x, y, NULL);
  mpz_sub(x, a->q[0], a->s[0]);
  mpz_sub(y, a->q[1], a->s[1]);
  int axis = mpz_cmpabs(x, y) <= 0 ? 0 : 1;
  mpz_clears(x, y, NULL);
  return axis;
}

/* Sign of t - s_k in the pane. */
static int arc_choose_branch(const dyd_elementary *a) {
  int k = a->axis;
  if (a->lo[k] && mpz_cmp(a->lo[k], a->s[k]) >= 0) return 1;
  DYD_INVARIANT(a->hi[k] && mpz_cmp(a->hi[k], a->s[k]) <= 0);
  return -1;
}

static dyd_feature_kind feature_name(const slab *x, const slab *y) {
  if (!x->q) return y->near_bit ? DYD_SIDE_Y1 : DYD_SIDE_Y0;
  if (!y->q) return x->near_bit ? DYD_SIDE_X1 : DYD_SIDE_X0;
  return (dyd_feature_kind)(x->near_bit + 2 * y->near_bit);
}

/* The arc of the pane x times y; false: the pane is the near rectangle, or surely without an arc. */
static bool curve_set_arc(dyd_elementary *a, const slab *x, const slab *y) {
  const slab *pane[2] = {x, y};
  dyd_iv lo[2], hi[2];
  if (!x->q && !y->q) return false;
  for (int k = 0; k < 2; k++) {
    a->s[k] = pane[k]->s;
    a->q[k] = pane[k]->q;
    a->lo[k] = pane[k]->lo;
    a->hi[k] = pane[k]->hi;
    a->shape.s[k] = pane[k]->s_d;
    a->shape.q[k] = pane[k]->q_d;
    lo[k] = pane[k]->lo_d;
    hi[k] = pane[k]->hi_d;
  }
  a->corner = (dyd_feature_kind)(x->far_bit + 2 * y->far_bit);
  a->feature = feature_name(x, y);
  a->parabola = a->shape.parabola = !x->q || !y->q;
  a->axis = arc_choose_axis(a);
  a->branch = a->parabola ? arc_choose_branch(a) : 0;
  int o = 1 - a->axis, across = mpz_cmp(a->s[o], a->q[o]);
  if (!across) return false; /* a focus on the directrix, outside of the pane: the rectangles are disjoint */
  a->direction = (across > 0) == (a->axis == 0) ? 1 : -1;
  return !dyd_filter_no_arc(&a->shape, a->axis, a->branch, lo, hi);
}

void dyd_curve_set(dyd_curve *out, const dyd_scaled *far, const dyd_scaled *near, const dyd_scaled *window, int side,
                   int64_t shift) {
  slab x[4], y[4];
  side_set s[2];
  dyd_surd_point p;
  dyd_surd_point_init(&p);
  bool near_point = !mpz_cmp(near->r.x0, near->r.x1) && !mpz_cmp(near->r.y0, near->r.y1);
  for (int k = 0; k < 2; k++) {
    mpz_add(out->middle[k], dyd_irect_end(&far->r, k, 0), dyd_irect_end(&far->r, k, 1));
    mpz_tdiv_q_2exp(out->middle[k], out->middle[k], 1);
    side_set_init(&s[k], far, near, window, k, out->middle[k]);
  }
  size_t columns = curve_set_slabs(x, &s[0], near_point), rows = curve_set_slabs(y, &s[1], near_point);
  out->count = 0;
  for (size_t c = 0; c < columns; c++)
    for (size_t r = 0; r < rows; r++) {
      dyd_elementary *a = &out->arc[out->count];
      if (!curve_set_arc(a, &x[c], &y[r]) || !clip_arc(a, &p, side)) continue;
      for (int e = 0; e < 2; e++)
        if (!a->end[e].infinite) dyd_filter_spot_box(&a->end[e], shift);
      out->count++;
    }
  dyd_surd_point_clear(&p);
}

bool dyd_elementary_holds(const dyd_elementary *a, const dyd_spot *p) {
  if (dyd_filter_spot_beside(p, &a->end[0], &a->end[1])) return false;
  for (int k = 0; k < 2; k++) {
    if (a->lo[k] && dyd_surd_point_cmp_z(&p->at, k, a->lo[k]) < 0) return false;
    if (a->hi[k] && dyd_surd_point_cmp_z(&p->at, k, a->hi[k]) > 0) return false;
  }
  return true;
}
