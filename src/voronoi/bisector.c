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
#include "base/local.h"

/* ---- marks ---- */

/* The marks of one axis; those of the window are NULL when there is none. _d: the same in doubles. */
typedef struct side_set {
  mpz_srcptr at[DYD_MARKS], far[2];
  dyd_iv at_d[DYD_MARKS], far_d[2];
  dyd_marks marks;
} side_set;

static int side_set_order(const void *axis, int a, int b) {
  const side_set *s = axis;
  if (a == b) return 0;
  if (!s->at[a]) return a == DYD_WINDOW_LO ? -1 : 1;
  if (!s->at[b]) return b == DYD_WINDOW_LO ? 1 : -1;
  return mpz_cmp(s->at[a], s->at[b]);
}

static void side_set_init(side_set *s, const dyd_scaled *far, const dyd_scaled *near, const dyd_scaled *window,
                          int axis, mpz_srcptr middle) {
  for (int e = 0; e < 2; e++) {
    s->far[e] = dyd_irect_end(&far->r, axis, e);
    s->far_d[e] = far->box.end[2 * axis + e];
    s->at[DYD_NEAR_LO + e] = dyd_irect_end(&near->r, axis, e);
    s->at_d[DYD_NEAR_LO + e] = near->box.end[2 * axis + e];
    s->at[DYD_WINDOW_LO + e] = window ? dyd_irect_end(&window->r, axis, e) : NULL;
    s->at_d[DYD_WINDOW_LO + e] = window ? window->box.end[2 * axis + e] : DYD_IV_UNKNOWN;
  }
  s->at[DYD_MIDDLE] = middle;
  s->at_d[DYD_MIDDLE] = dyd_iv_scale(dyd_iv_add(s->far_d[0], s->far_d[1]), 0.5);
  s->marks =
      (dyd_marks){side_set_order, s, !mpz_cmp(s->far[0], s->far[1]), !mpz_cmp(s->at[DYD_NEAR_LO], s->at[DYD_NEAR_HI])};
}

/* ---- points of an arc ---- */

/* The coordinate n_k (2 t - m_k) + n_o (2 v - m_o) = 0 of a line: given t = num / 2^bits along k, v along o. */
static void point_of_line(dyd_surd_point *out, const dyd_elementary *a, int k, mpz_srcptr num, int64_t bits) {
  int o = 1 - k;
  mpz_ptr to[2] = {out->ax, out->ay};
  DYD_LOCAL_NUMBERS(mpz, n, m);
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
  DYD_LOCAL_NUMBERS(mpz, m, t);
  mpz_add(m, a->q[o], a->s[o]);
  bool inside = true;
  for (int e = 0; e < 2 && inside; e++) {
    mpz_srcptr bound = e ? a->hi[o] : a->lo[o];
    if (!bound) continue;
    mpz_mul_2exp(t, bound, 1);
    int beyond = mpz_cmp(m, t) * (e ? 1 : -1), region = side * (mpz_cmp(a->s[o], a->q[o]) > 0 ? 1 : -1);
    inside = beyond < 0 || (beyond == 0 && region == (e ? -1 : 1));
  }
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
  DYD_LOCAL_NUMBERS(mpz, x, y);
  mpz_sub(x, a->q[0], a->s[0]);
  mpz_sub(y, a->q[1], a->s[1]);
  return mpz_cmpabs(x, y) <= 0 ? 0 : 1;
}

/* The arc of the pane of two strips; false: the pane is the near rectangle, or certainly without an arc. The branch is
 * the sign of t - s_k in the pane, which the middle separates from s. */
static bool curve_set_arc(dyd_elementary *a, const side_set s[2], const dyd_strip t[2]) {
  dyd_iv lo[2], hi[2];
  if (!t[0].fixed && !t[1].fixed) return false;
  for (int k = 0; k < 2; k++) {
    a->s[k] = s[k].far[t[k].far_end];
    a->q[k] = t[k].fixed ? s[k].at[t[k].q] : NULL;
    a->lo[k] = s[k].at[t[k].lo];
    a->hi[k] = s[k].at[t[k].hi];
    a->shape.s[k] = s[k].far_d[t[k].far_end];
    a->shape.q[k] = t[k].fixed ? s[k].at_d[t[k].q] : DYD_IV_UNKNOWN;
    lo[k] = s[k].at_d[t[k].lo];
    hi[k] = s[k].at_d[t[k].hi];
  }
  a->corner = (dyd_feature_kind)(t[0].far_end + 2 * t[1].far_end);
  a->feature = dyd_strips_feature(t);
  a->parabola = a->shape.parabola = !t[0].fixed || !t[1].fixed;
  a->axis = arc_choose_axis(a);
  a->branch = !a->parabola ? 0 : t[a->axis].above ? 1 : -1;
  DYD_INVARIANT(a->branch != 1 || mpz_cmp(a->lo[a->axis], a->s[a->axis]) >= 0);
  DYD_INVARIANT(a->branch != -1 || mpz_cmp(a->hi[a->axis], a->s[a->axis]) <= 0);
  int o = 1 - a->axis, across = mpz_cmp(a->s[o], a->q[o]);
  if (!across) return false; /* a focus on the directrix, outside of the pane: the rectangles are disjoint */
  a->direction = (across > 0) == (a->axis == 0) ? 1 : -1;
  return !dyd_filter_no_arc(&a->shape, a->axis, a->branch, lo, hi);
}

size_t dyd_curve_set(dyd_elementary *out, mpz_t middle[2], const dyd_scaled *far, const dyd_scaled *near,
                     const dyd_scaled *window, int side, int64_t shift) {
  dyd_strip x[4], y[4];
  side_set s[2];
  DYD_LOCAL(dyd_surd_point, p);
  for (int k = 0; k < 2; k++) {
    mpz_add(middle[k], dyd_irect_end(&far->r, k, 0), dyd_irect_end(&far->r, k, 1));
    mpz_tdiv_q_2exp(middle[k], middle[k], 1);
    side_set_init(&s[k], far, near, window, k, middle[k]);
  }
  bool near_point = s[0].marks.near_thin && s[1].marks.near_thin;
  size_t columns = dyd_marks_strips(x, &s[0].marks, near_point), rows = dyd_marks_strips(y, &s[1].marks, near_point);
  size_t count = 0;
  for (size_t k = 0; k < columns * rows; k++) {
    dyd_elementary *a = &out[count];
    const dyd_strip t[2] = {x[k / rows], y[k % rows]};
    if (!curve_set_arc(a, s, t) || !clip_arc(a, &p, side)) continue;
    for (int e = 0; e < 2; e++)
      if (!a->end[e].infinite) dyd_filter_spot_box(&a->end[e], shift);
    count++;
  }
  return count;
}

bool dyd_elementary_holds(const dyd_elementary *a, const dyd_spot *p) {
  if (dyd_filter_spot_beside(p, &a->end[0], &a->end[1])) return false;
  for (int k = 0; k < 2; k++) {
    if (a->lo[k] && dyd_surd_point_cmp_z(&p->at, k, a->lo[k]) < 0) return false;
    if (a->hi[k] && dyd_surd_point_cmp_z(&p->at, k, a->hi[k]) > 0) return false;
  }
  return true;
}
