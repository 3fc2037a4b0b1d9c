/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Enclosures of points, samples and distances in doubles; interval arithmetic rounds outward throughout. */
#include "voronoi/exact_cell_filter.h"

#include "dyadic/raw.h"
#include "predicate/circle.h"

void dyd_filter_spot_box(dyd_spot *s, int64_t shift) {
  const dyd_surd_point *p = &s->at;
  const dyd_icircle view = {.ax = {p->ax[0]},
                            .bx = {p->bx[0]},
                            .ay = {p->ay[0]},
                            .by = {p->by[0]},
                            .c = {p->c[0]},
                            .d = {p->d[0]}}; /* borrowed limbs */
  dyd_icircle_centre_d(s->box, &view, shift);
}

static dyd_iv enclose_scaled_integer(mpz_srcptr z, int64_t shift) {
  return (dyd_iv){dyd_raw_get_d(z, -shift, DYD_DOWN), dyd_raw_get_d(z, -shift, DYD_UP)};
}

void dyd_filter_irect_box(dyd_box *out, const dyd_irect *r, int64_t shift) {
  mpz_srcptr end[4] = {r->x0, r->x1, r->y0, r->y1};
  out->exact = true;
  for (int k = 0; k < 4; k++) {
    out->end[k] = enclose_scaled_integer(end[k], shift);
    out->outer[k] = k & 1 ? out->end[k].hi : out->end[k].lo;
    if (!(out->end[k].lo == out->end[k].hi)) out->exact = false;
  }
}

static dyd_iv spot_along(const dyd_spot *p, int axis) {
  return (dyd_iv){p->box[2 * axis], p->box[2 * axis + 1]};
}

int dyd_filter_spot_cmp(const dyd_spot *p, const dyd_spot *q, int axis) {
  dyd_iv a = spot_along(p, axis), b = spot_along(q, axis);
  return a.lo > b.hi ? 1 : a.hi < b.lo ? -1 : 0;
}

bool dyd_filter_spot_beside(const dyd_spot *p, const dyd_spot *low, const dyd_spot *high) {
  if (low->infinite || high->infinite) return false;
  for (int axis = 0; axis < 2; axis++) {
    int a = dyd_filter_spot_cmp(p, low, axis), b = dyd_filter_spot_cmp(p, high, axis);
    if (a && a == b) return true;
  }
  return false;
}

int dyd_filter_side(const dyd_spot *p, const dyd_box *a, dyd_touch ta, const dyd_box *b, dyd_touch tb) {
  dyd_iv x = spot_along(p, 0), y = spot_along(p, 1);
  dyd_iv da = dyd_filter_distance2(x, y, a, ta), db = dyd_filter_distance2(x, y, b, tb);
  return da.lo > db.hi ? 1 : da.hi < db.lo ? -1 : 0;
}

/* A finite double strictly between; the box of the other coordinate is set by the caller. */
static bool double_between(double *t, const dyd_spot *low, const dyd_spot *high, int axis) {
  double a = low->infinite ? -INFINITY : low->box[2 * axis + 1], b = high->infinite ? INFINITY : high->box[2 * axis];
  if (low->infinite && high->infinite) {
    *t = 0;
  } else if (low->infinite) {
    *t = b - (fabs(b) / 2 + 1);
  } else if (high->infinite) {
    *t = a + (fabs(a) / 2 + 1);
  } else {
    *t = a / 2 + b / 2;
  }
  return isfinite(*t) && a < *t && *t < b;
}

/* num / 2^bits = t 2^shift */
static void sample_set_parameter(dyd_sample *out, double t, int axis, int64_t shift) {
  int exp;
  double man = frexp(t, &exp);
  mpz_set_d(out->num, ldexp(man, 53));
  int64_t bits = 53 - (int64_t)exp - shift;
  if (bits < 0) {
    mpz_mul_2exp(out->num, out->num, (mp_bitcnt_t)-bits);
    bits = 0;
  }
  out->bits = bits;
  out->known = false;
  out->spot.infinite = false;
  out->spot.box[2 * axis] = out->spot.box[2 * axis + 1] = t;
}

/* Lines: with n = q - s, m = q + s the other coordinate is m_o/2 + (n_k/n_o) (m_k/2 - t). Parabolas: with h = s_o - q_o
 * it is ((t - s_k)^2 / h + q_o + s_o) / 2. */
dyd_iv dyd_filter_arc_other(const dyd_filter_arc *arc, int k, dyd_iv at) {
  int o = 1 - k;
  dyd_iv mo = dyd_iv_scale(dyd_iv_add(arc->q[o], arc->s[o]), 0.5);
  if (arc->parabola) {
    dyd_iv h = dyd_iv_sub(arc->s[o], arc->q[o]);
    return dyd_iv_add(dyd_iv_scale(dyd_iv_div(dyd_iv_sqr(dyd_iv_sub(at, arc->s[k])), h), 0.5), mo);
  }
  dyd_iv mk = dyd_iv_scale(dyd_iv_add(arc->q[k], arc->s[k]), 0.5);
  dyd_iv slope = dyd_iv_div(dyd_iv_sub(arc->q[k], arc->s[k]), dyd_iv_sub(arc->q[o], arc->s[o]));
  return dyd_iv_add(mo, dyd_iv_mul(slope, dyd_iv_sub(mk, at)));
}

bool dyd_filter_sample(dyd_sample *out, const dyd_filter_arc *arc, dyd_iv level, int axis, const dyd_spot *low,
                       const dyd_spot *high, int64_t shift) {
  double t;
  if (!double_between(&t, low, high, axis)) return false;
  sample_set_parameter(out, t, axis, shift);
  dyd_iv other = arc ? dyd_filter_arc_other(arc, axis, dyd_iv_point(t)) : level;
  out->spot.box[2 * (1 - axis)] = other.lo;
  out->spot.box[2 * (1 - axis) + 1] = other.hi;
  return true;
}

/* The value of |c - s|^2 - d(c,q)^2 at a point. */
static dyd_iv arc_difference(const dyd_filter_arc *arc, int k, const dyd_iv c[2]) {
  int o = 1 - k;
  dyd_iv sum =
      dyd_iv_mul(dyd_iv_sub(arc->q[o], arc->s[o]), dyd_iv_sub(dyd_iv_scale(c[o], 2), dyd_iv_add(arc->q[o], arc->s[o])));
  if (arc->parabola) return dyd_iv_add(sum, dyd_iv_sqr(dyd_iv_sub(c[k], arc->s[k])));
  return dyd_iv_add(sum, dyd_iv_mul(dyd_iv_sub(arc->q[k], arc->s[k]),
                                    dyd_iv_sub(dyd_iv_scale(c[k], 2), dyd_iv_add(arc->q[k], arc->s[k]))));
}

bool dyd_filter_no_arc(const dyd_filter_arc *arc, int axis, int branch, const dyd_iv lo[2], const dyd_iv hi[2]) {
  int grows[2];
  for (int a = 0; a < 2; a++)
    grows[a] = arc->parabola && a == axis ? branch : dyd_iv_sign(dyd_iv_sub(arc->q[a], arc->s[a]));
  if (!grows[0] || !grows[1]) return false;
  dyd_iv least[2], most[2];
  for (int a = 0; a < 2; a++) {
    least[a] = grows[a] > 0 ? lo[a] : hi[a];
    most[a] = grows[a] > 0 ? hi[a] : lo[a];
  }
  return arc_difference(arc, axis, least).lo > 0 || arc_difference(arc, axis, most).hi < 0;
}

/* ---- arcs that others take ---- */

/* A lower bound, over c in `at`, of (the largest (c - p)^2 of ends p) - (the least (c - q)^2 of q between ends): that
 * of one p and q, chosen at a place of `at`. */
static double gain_chosen_at(double place, dyd_iv at, const dyd_iv p[2], const dyd_iv q[2]) {
  dyd_iv far = p[place - p[0].lo < p[1].hi - place];
  dyd_iv near = place < q[0].hi ? q[0] : place > q[1].lo ? q[1] : dyd_iv_point(place);
  return dyd_iv_mul(dyd_iv_sub(near, far), dyd_iv_sub(dyd_iv_scale(at, 2), dyd_iv_add(near, far))).lo;
}

static double axis_gain(dyd_iv at, const dyd_iv p[2], const dyd_iv q[2]) {
  double low = gain_chosen_at(at.lo, at, p, q), high = gain_chosen_at(at.hi, at, p, q);
  return fmax(fmax(low, high), gain_chosen_at(at.lo / 2 + at.hi / 2, at, p, q));
}

/* Returns true if k is nearer than the radius in all of a box: r^2 - D_k^2 is a sum of one function of each coordinate,
 * both convex where r is a distance to farthest points, else both concave and so least at a corner [PRUNE-1]. */
static bool takes_box(const dyd_takers *t, const dyd_box *k, const dyd_iv at[2]) {
  const dyd_box *fixed = &t->fixed->box;
  if (t->fixed_touch == DYD_FARTHEST)
    return dyd_down(axis_gain(at[0], fixed->end, k->end) + axis_gain(at[1], fixed->end + 2, k->end + 2)) > 0;
  for (int corner = 0; corner < 4; corner++) {
    dyd_iv x = dyd_iv_point(corner & 1 ? at[0].hi : at[0].lo), y = dyd_iv_point(corner & 2 ? at[1].hi : at[1].lo);
    if (!(dyd_filter_distance2(x, y, k, t->other_touch).hi < dyd_filter_distance2(x, y, fixed, t->fixed_touch).lo))
      return false;
  }
  return true;
}

static bool box_is_taken(dyd_takers *t, size_t own, const dyd_iv at[2]) {
  for (size_t m = 0; m <= t->count; m++) {
    size_t k = m ? m - 1 : t->taker;
    if (k < t->count && k != own && takes_box(t, &t->other[k].box, at)) return t->taker = k, true;
  }
  return false;
}

/* The part of the arc between two points; it lies in the box of both [ARC-1]. */
static bool stretch_is_taken(dyd_takers *t, size_t own, const dyd_filter_arc *arc, int axis, const dyd_iv low[2],
                             const dyd_iv high[2], int depth) {
  dyd_iv at[2], middle[2];
  for (int k = 0; k < 2; k++) {
    if (!isfinite(low[k].lo + low[k].hi + high[k].lo + high[k].hi)) return false;
    at[k] = (dyd_iv){fmin(low[k].lo, high[k].lo), fmax(low[k].hi, high[k].hi)};
  }
  if (box_is_taken(t, own, at)) return true;
  double mid = low[axis].hi / 2 + high[axis].lo / 2;
  if (!depth || !(low[axis].hi < mid && mid < high[axis].lo)) return false;
  middle[axis] = dyd_iv_point(mid);
  middle[1 - axis] = dyd_filter_arc_other(arc, axis, middle[axis]);
  return stretch_is_taken(t, own, arc, axis, low, middle, depth - 1) &&
         stretch_is_taken(t, own, arc, axis, middle, high, depth - 1);
}

bool dyd_filter_arc_taken(dyd_takers *t, size_t own, const dyd_filter_arc *arc, int axis, const dyd_spot end[2]) {
  enum { DEPTH = 3 };
  if (end[0].infinite || end[1].infinite) return false;
  const dyd_iv low[2] = {spot_along(&end[0], 0), spot_along(&end[0], 1)},
               high[2] = {spot_along(&end[1], 0), spot_along(&end[1], 1)};
  return stretch_is_taken(t, own, arc, axis, low, high, DEPTH);
}

/* ---- panes ---- */

static size_t marks_add_cut(int list[3], size_t n, const dyd_marks *m, int mark) {
  if (m->order(m->axis, mark, DYD_WINDOW_LO) <= 0 || m->order(m->axis, mark, DYD_WINDOW_HI) >= 0) return n;
  size_t k = n;
  while (k > 0 && m->order(m->axis, list[k - 1], mark) > 0) k--;
  if (k > 0 && !m->order(m->axis, list[k - 1], mark)) return n;
  for (size_t q = n; q > k; q--) list[q] = list[q - 1];
  list[k] = mark;
  return n + 1;
}

size_t dyd_marks_strips(dyd_strip out[4], const dyd_marks *m, bool near_point) {
  int list[3];
  size_t n = 0;
  if (!(m->far_thin && near_point)) n = marks_add_cut(list, n, m, DYD_MIDDLE);
  if (!m->near_thin) n = marks_add_cut(list, n, m, DYD_NEAR_LO);
  if (!m->near_thin) n = marks_add_cut(list, n, m, DYD_NEAR_HI);
  for (size_t k = 0; k <= n; k++) {
    dyd_strip *s = &out[k];
    s->lo = k > 0 ? list[k - 1] : DYD_WINDOW_LO;
    s->hi = k < n ? list[k] : DYD_WINDOW_HI;
    s->above = m->order(m->axis, s->lo, DYD_MIDDLE) >= 0;
    s->far_end = m->far_thin || s->above ? 0 : 1;
    s->over = m->order(m->axis, s->lo, DYD_NEAR_HI) >= 0;
    bool under = m->order(m->axis, s->hi, DYD_NEAR_LO) <= 0;
    s->q = s->over && !m->near_thin ? DYD_NEAR_HI : DYD_NEAR_LO;
    s->fixed = s->over || under || m->near_thin;
  }
  return n + 1;
}

dyd_feature_kind dyd_strips_feature(const dyd_strip s[2]) {
  bool upper[2] = {s[0].q == DYD_NEAR_HI, s[1].q == DYD_NEAR_HI};
  if (!s[0].fixed) return upper[1] ? DYD_SIDE_Y1 : DYD_SIDE_Y0;
  if (!s[1].fixed) return upper[0] ? DYD_SIDE_X1 : DYD_SIDE_X0;
  return (dyd_feature_kind)(upper[0] + 2 * upper[1]);
}
