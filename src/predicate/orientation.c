/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Orientation and Con of partial points: filters, then integers.
 *
 * A filter answers when every choice in the outward boxes agrees, or, for boxes that are the rectangles themselves,
 * when two choices certainly differ. Everything else goes to the exact rung [ORI-1] [CON-1]. */
#include "base/local.h"
#include "predicate/circle.h"
#include "predicate/predicate_filter.h"
#include "rect/irect.h"
#include "rect/rect.h"

/* Exact rungs of orientation and Con on integer rectangles.
 *
 * [ORI-1] The determinant is affine in every coordinate, so its extremes over the box of choices are at corners. For
 * fixed q and r it is linear in p with normal (q_y - r_y, r_x - q_x): the signs of these give the extreme corner of p,
 * and 16 corner choices of q and r remain.
 * [CON-1] With the six critical circles of a certainly oriented triple, + iff the three F-once circles enclose r, - iff
 * the three F-twice circles keep away from r. One in-circle sign decides which of the two remains to be tested. */

/* The value of `sign` * det(p,q,r) least over p in a is positive.  */
static bool corners_turn(const dyd_irect *a, mpz_srcptr qx, mpz_srcptr qy, mpz_srcptr rx, mpz_srcptr ry, int sign,
                         mpz_ptr scratch[4]) {
  mpz_ptr nx = scratch[0], ny = scratch[1], s = scratch[2], det = scratch[3];
  mpz_sub(nx, qy, ry);
  mpz_sub(ny, rx, qx);
  mpz_sub(s, sign * mpz_sgn(nx) >= 0 ? a->x0 : a->x1, qx);
  mpz_mul(det, nx, s);
  mpz_sub(s, sign * mpz_sgn(ny) >= 0 ? a->y0 : a->y1, qy);
  mpz_addmul(det, ny, s);
  return sign * mpz_sgn(det) > 0;
}

static bool surely_turns(const dyd_irect *a, const dyd_irect *b, const dyd_irect *c, int sign, mpz_ptr scratch[4]) {
  for (int k = 0; k < 16; k++) {
    if (!corners_turn(a, k & 1 ? b->x1 : b->x0, k & 2 ? b->y1 : b->y0, k & 4 ? c->x1 : c->x0, k & 8 ? c->y1 : c->y0,
                      sign, scratch)) {
      return false;
    }
  }
  return true;
}

dyd_sure dyd_irect_orientation(const dyd_irect *a, const dyd_irect *b, const dyd_irect *c) {
  DYD_LOCAL_ARRAY(mpz_t, t, [4]);
  mpz_ptr scratch[4] = {t[0], t[1], t[2], t[3]};
  return surely_turns(a, b, c, 1, scratch)    ? DYD_SURE_PLUS
         : surely_turns(a, b, c, -1, scratch) ? DYD_SURE_MINUS
                                              : DYD_UNSURE;
}

/* The in-circle determinant of the lower left corners, times the orientation of a, b, c: 1 inside, -1 outside. */
static int corner_in_circle(const dyd_irect *r, const dyd_irect *const abc[3], dyd_sure orientation) {
  mpz_t x[3], y[3], n[3];
  for (int k = 0; k < 3; k++) mpz_inits(x[k], y[k], n[k], NULL);
  DYD_LOCAL_NUMBERS(mpz, det, t);
  for (int k = 0; k < 3; k++) {
    mpz_sub(x[k], abc[k]->x0, r->x0);
    mpz_sub(y[k], abc[k]->y0, r->y0);
    mpz_mul(n[k], x[k], x[k]);
    mpz_addmul(n[k], y[k], y[k]);
  }
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    mpz_mul(t, x[i], y[j]);
    mpz_submul(t, x[j], y[i]);
    mpz_addmul(det, t, n[k]);
  }
  int sign = mpz_sgn(det) * (int)orientation;
  for (int k = 3; k-- > 0;) mpz_clears(x[k], y[k], n[k], NULL);
  return sign;
}

/* Returns true if r is on the side `sign` of the three circles in which one rectangle has the touch `odd` and the
 * others not. */
static bool beyond_critical_circles(const dyd_irect *r, const dyd_irect *const abc[3], dyd_touch odd, int sign) {
  dyd_touch even = odd == DYD_FARTHEST ? DYD_CLOSEST : DYD_FARTHEST;
  DYD_LOCAL(dyd_icircle, circle);
  bool beyond = true;
  for (int k = 0; k < 3 && beyond; k++) {
    dyd_touch touch[3] = {even, even, even};
    touch[k] = odd;
    beyond = dyd_icircles(&circle, 1, abc, touch) == 1 && dyd_icircle_side(&circle, r, odd) == sign;
  }
  return beyond;
}

dyd_sure dyd_irect_con_oriented(const dyd_irect *r, const dyd_irect *const abc[3], dyd_sure orientation) {
  int sign = corner_in_circle(r, abc, orientation);
  if (sign > 0 && beyond_critical_circles(r, abc, DYD_FARTHEST, -1)) return DYD_SURE_PLUS;
  if (sign < 0 && beyond_critical_circles(r, abc, DYD_CLOSEST, 1)) return DYD_SURE_MINUS;
  return DYD_UNSURE;
}

/* The partial disc of three rectangles, by its six critical circles.
 *
 * I is the interior of the intersection of the three F-once discs, E the complement of the union of the three F-twice
 * discs (mathematics: section 4), so a rectangle is inside I iff its farthest distance from each F-once centre is less
 * than the radius, and inside E iff its closest distance from each F-twice centre is more [CON-1]. */

enum { F_ONCE = 3, CIRCLES = 6 };

/* FCC CFC CCF CFF FCF FFC */
static void circle_labels(dyd_touch out[3], int number) {
  dyd_touch odd = number < F_ONCE ? DYD_FARTHEST : DYD_CLOSEST, even = number < F_ONCE ? DYD_CLOSEST : DYD_FARTHEST;
  for (int k = 0; k < 3; k++) out[k] = k == number % F_ONCE ? odd : even;
}

/* Three rectangles on a common integer scale. */
typedef struct triple {
  dyd_irect r[3];
  mpz_t man;
  int64_t exp;
} triple;

static void triple_init(triple *t, const dyd_rect *const r[3]) {
  for (int k = 0; k < 3; k++) dyd_irect_init(&t->r[k]);
  mpz_init(t->man);
  dyd_irects_scale(t->r, r, 3, t->man, &t->exp);
}

static void triple_clear(triple *t) {
  mpz_clear(t->man);
  for (int k = 3; k-- > 0;) dyd_irect_clear(&t->r[k]);
}

static bool find_critical_circle(dyd_circle *out, const triple *t, const dyd_touch touch[3]) {
  const dyd_irect *r[3] = {&t->r[0], &t->r[1], &t->r[2]};
  DYD_LOCAL(dyd_icircle, k);
  bool found = dyd_icircles(&k, 1, r, touch) == 1;
  if (found) dyd_circle_unscale(out, &k, t->man, t->exp);
  return found;
}

dyd_status dyd_critical_circle(dyd_circle *out, const dyd_rect *const r[3], const dyd_touch touch[3]) {
  if (touch[0] == touch[1] && touch[1] == touch[2]) return DYD_E_ARG;
  if (dyd_orientation(r[0], r[1], r[2]) == DYD_UNSURE) return DYD_E_ARG;
  DYD_SCOPED(triple) t;
  triple_init(&t, r);
  bool found = find_critical_circle(out, &t, touch);
  return found ? DYD_OK : DYD_E_ARG;
}

void dyd_partial_disc_init(dyd_partial_disc *d) {
  d->known = false;
  for (int k = 0; k < CIRCLES; k++) dyd_circle_init(&d->circle[k]);
}

void dyd_partial_disc_clear(dyd_partial_disc *d) {
  for (int k = CIRCLES; k-- > 0;) dyd_circle_clear(&d->circle[k]);
}

void dyd_partial_disc_set(dyd_partial_disc *out, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c) {
  const dyd_rect *r[3] = {a, b, c};
  out->known = dyd_orientation(a, b, c) != DYD_UNSURE;
  if (!out->known) return;
  bool exact = dyd_rect_is_point(a) && dyd_rect_is_point(b) && dyd_rect_is_point(c); /* then all six are one */
  DYD_SCOPED(triple) t;
  triple_init(&t, r);
  for (int k = 0; k < CIRCLES && out->known; k++) {
    dyd_touch touch[3];
    if (exact && k) {
      dyd_circle_set(&out->circle[k], &out->circle[0]);
      continue;
    }
    circle_labels(touch, k);
    out->known = find_critical_circle(&out->circle[k], &t, touch);
  }
}

/* Is r on the side `sign` of circles first .. first + 2, in the given sense? */
static bool beyond_circles(const dyd_partial_disc *d, int first, const dyd_rect *r, dyd_touch touch, int sign) {
  for (int k = first; k < first + F_ONCE; k++) {
    if (dyd_circle_side(&d->circle[k], r, touch) != sign) return false;
  }
  return true;
}

dyd_sure dyd_partial_disc_con(const dyd_partial_disc *d, const dyd_rect *r) {
  if (!d->known) return DYD_UNSURE;
  if (beyond_circles(d, 0, r, DYD_FARTHEST, -1)) return DYD_SURE_PLUS;
  if (beyond_circles(d, F_ONCE, r, DYD_CLOSEST, 1)) return DYD_SURE_MINUS;
  return DYD_UNSURE;
}

/* The quad rule, and comparison of distances from a dyadic point.
 *
 * [QUAD-1] If ab replaced ij by a flip, the open segments would cross and the circle through i, j, b would hold a, the
 * one through i, j, a would hold b. Disjoint hulls exclude the first, Con = - one of the others. */

static bool partial_edges_disjoint(const dyd_rect *const r[4]) {
  dyd_box box[4];
  for (int k = 0; k < 4; k++) dyd_filter_box(&box[k], r[k]);
  dyd_truth answer = dyd_filter_partial_edges_disjoint(&box[0], &box[1], &box[2], &box[3]);
  if (answer != DYD_UNKNOWN) return answer == DYD_TRUE;
  return dyd_partial_edges_disjoint(r[0], r[1], r[2], r[3]);
}

dyd_truth dyd_cannot_displace(const dyd_rect *i, const dyd_rect *j, const dyd_rect *a, const dyd_rect *b) {
  const dyd_rect *const r[4] = {i, j, a, b};
  bool cannot =
      partial_edges_disjoint(r) || dyd_con(a, i, j, b) == DYD_SURE_MINUS || dyd_con(b, i, j, a) == DYD_SURE_MINUS;
  return cannot ? DYD_TRUE : DYD_UNKNOWN;
}

static int compare_distance_exact(const dyd_point *c, const dyd_rect *const in[2], const dyd_touch touch[2]) {
  DYD_LOCAL_ARRAY(dyd_irect, r, [2]);
  DYD_LOCAL_ARRAY(mpz_t, distance, [2]);
  DYD_LOCAL_NUMBERS(mpz, cx, cy);
  dyd_irects_scale_with(cx, cy, r, c, in, 2, NULL, NULL);
  for (int k = 0; k < 2; k++) {
    if (touch[k] == DYD_FARTHEST) {
      dyd_irect_dl2(distance[k], cx, cy, &r[k]);
    } else {
      dyd_irect_ds2(distance[k], cx, cy, &r[k]);
    }
  }
  int order = mpz_cmp(distance[0], distance[1]);
  return (order > 0) - (order < 0);
}

int dyd_compare_distance(const dyd_point *c, const dyd_rect *a, dyd_touch ta, const dyd_rect *b, dyd_touch tb) {
  const dyd_rect *const in[2] = {a, b};
  const dyd_touch touch[2] = {ta, tb};
  dyd_iv at[2], distance[2];
  dyd_filter_point(at, c);
  for (int k = 0; k < 2; k++) {
    dyd_box box;
    dyd_filter_box(&box, in[k]);
    distance[k] = dyd_filter_distance2(at[0], at[1], &box, touch[k]);
  }
  if (distance[0].hi < distance[1].lo) return -1;
  if (distance[0].lo > distance[1].hi) return 1;
  return compare_distance_exact(c, in, touch);
}

dyd_truth dyd_nearer(const dyd_point *c, const dyd_rect *a, const dyd_rect *b) {
  if (dyd_compare_distance(c, a, DYD_FARTHEST, b, DYD_CLOSEST) < 0) return DYD_TRUE;
  if (dyd_compare_distance(c, b, DYD_FARTHEST, a, DYD_CLOSEST) < 0) return DYD_FALSE;
  return DYD_UNKNOWN;
}

/* The four rectangles on a common integer scale. */
static void irects_scaled(dyd_irect *out, const dyd_rect *const *in, size_t n) {
  for (size_t k = 0; k < n; k++) dyd_irect_init(&out[k]);
  dyd_irects_scale(out, in, n, NULL, NULL);
}

static void irects_release(dyd_irect *r, size_t n) {
  while (n-- > 0) dyd_irect_clear(&r[n]);
}

static dyd_sure orient_boxes(const dyd_rect *const abc[3], const dyd_box box[3]) {
  dyd_turns t = dyd_filter_turns(box[0].outer, box[1].outer, box[2].outer);
  if (t.all_left) return DYD_SURE_PLUS;
  if (t.all_right) return DYD_SURE_MINUS;
  if (t.some_left && t.some_right && box[0].exact && box[1].exact && box[2].exact) return DYD_UNSURE;
  dyd_irect r[3];
  irects_scaled(r, abc, 3);
  dyd_sure answer = dyd_irect_orientation(&r[0], &r[1], &r[2]);
  irects_release(r, 3);
  return answer;
}

dyd_sure dyd_orientation(const dyd_rect *a, const dyd_rect *b, const dyd_rect *c) {
  const dyd_rect *abc[3] = {a, b, c};
  dyd_box box[3];
  for (int k = 0; k < 3; k++) dyd_filter_box(&box[k], abc[k]);
  return orient_boxes(abc, box);
}

/* in[0..2]: certainly oriented triple, in[3]: the rectangle asked about. */
static dyd_sure con_exact(const dyd_rect *const in[4], dyd_sure orientation) {
  dyd_irect r[4];
  irects_scaled(r, in, 4);
  const dyd_irect *abc[3] = {&r[0], &r[1], &r[2]};
  dyd_sure answer = dyd_irect_con_oriented(&r[3], abc, orientation);
  irects_release(r, 4);
  return answer;
}

dyd_sure dyd_con(const dyd_rect *r, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c) {
  const dyd_rect *in[4] = {a, b, c, r};
  dyd_box box[4];
  bool exact = true;
  for (int k = 0; k < 4; k++) {
    dyd_filter_box(&box[k], in[k]);
    exact = exact && box[k].exact;
  }
  dyd_sure orientation = orient_boxes(in, box);
  if (orientation == DYD_UNSURE) return DYD_UNSURE;
  const double *o[4] = {box[0].outer, box[1].outer, box[2].outer, box[3].outer};
  int sign = (int)dyd_filter_incircle(o[0], o[1], o[2], o[3]) * (int)orientation;
  if (sign) return sign > 0 ? DYD_SURE_PLUS : DYD_SURE_MINUS;
  if (exact && dyd_filter_incircle_mixed(o[0], o[1], o[2], o[3])) return DYD_UNSURE;
  return con_exact(in, orientation);
}
