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
#include "voronoi/elementary.h"

#include "base/local.h"

void dyd_elementary_init(dyd_elementary *a) {
  *a = (dyd_elementary){.branch = 0};
  for (int e = 0; e < 2; e++) dyd_surd_point_init(&a->end[e]);
}

void dyd_elementary_clear(dyd_elementary *a) {
  for (int e = 2; e-- > 0;) dyd_surd_point_clear(&a->end[e]);
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

/* End e = the tighter of itself and p (swapped in); e = 0: lower end. */
static void tighten_end(dyd_elementary *a, dyd_surd_point *p, int e) {
  int sign = a->infinite[e] ? 0 : dyd_surd_point_cmp(p, &a->end[e], a->axis);
  if (!a->infinite[e] && (e ? sign >= 0 : sign <= 0)) return;
  dyd_surd_point t = a->end[e];
  a->end[e] = *p;
  *p = t;
  a->infinite[e] = false;
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
    if (!missed) tighten_end(a, p, grows > 0 ? e : 1 - e);
  }
  return true;
}

bool dyd_elementary_clip(dyd_elementary *a, int side) {
  a->infinite[0] = a->infinite[1] = true;
  a->point = false;
  for (int e = 0; e < 2; e++) {
    mpz_srcptr bound = e ? a->hi[a->axis] : a->lo[a->axis];
    if (!bound) continue;
    dyd_elementary_at(&a->end[e], a, bound, 0);
    a->infinite[e] = false;
  }
  DYD_LOCAL(dyd_surd_point, p);
  if (!clip_arc_across(a, &p, side)) return false;
  if (a->infinite[0] || a->infinite[1]) return true;
  int order = dyd_surd_point_cmp(&a->end[0], &a->end[1], a->axis);
  a->point = order == 0;
  return order <= 0;
}

int dyd_elementary_axis(const dyd_elementary *a) {
  if (a->parabola) return a->q[0] ? 1 : 0;
  DYD_LOCAL_NUMBERS(mpz, x, y);
  mpz_sub(x, a->q[0], a->s[0]);
  mpz_sub(y, a->q[1], a->s[1]);
  return mpz_cmpabs(x, y) <= 0 ? 0 : 1;
}

bool dyd_elementary_holds(const dyd_elementary *a, const dyd_surd_point *p) {
  for (int k = 0; k < 2; k++) {
    if (a->lo[k] && dyd_surd_point_cmp_z(p, k, a->lo[k]) < 0) return false;
    if (a->hi[k] && dyd_surd_point_cmp_z(p, k, a->hi[k]) > 0) return false;
  }
  return true;
}
