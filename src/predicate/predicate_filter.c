/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Orientation and in-circle signs of boxes in interval arithmetic.
 *
 * Each determinant is evaluated on intervals that contain the coordinates of every choice, so the result contains
 * every value; for points the interval is a few units in the last place wide, for wide boxes the repeated coordinates
 * make it too wide. Orientation then falls back on the corners [ORI-1]: 16 choices for b and c, and the extreme corner
 * of a, each a determinant of points. */
#include "predicate/predicate_filter.h"

#include "dyadic/raw.h"

static dyd_iv end_enclosure(const dyd_dyadic *end, mpz_srcptr den) {
  double lo = dyd_raw_quotient_get_d(end->man, end->exp, den, DYD_DOWN);
  if (!mpz_cmp_ui(den, 1) && dyd_dyadic_is_double(end)) return dyd_iv_point(lo);
  return (dyd_iv){lo, dyd_raw_quotient_get_d(end->man, end->exp, den, DYD_UP)};
}

void dyd_filter_box(dyd_box *out, const dyd_rect *r) {
  out->end[0] = end_enclosure(&r->x.lo, r->x.den);
  out->end[1] = end_enclosure(&r->x.hi, r->x.den);
  out->end[2] = end_enclosure(&r->y.lo, r->y.den);
  out->end[3] = end_enclosure(&r->y.hi, r->y.den);
  out->exact = true;
  for (int k = 0; k < 4; k++) {
    out->outer[k] = k & 1 ? out->end[k].hi : out->end[k].lo;
    if (out->end[k].lo != out->end[k].hi) out->exact = false;
  }
}

static dyd_iv side_x(const double a[4]) {
  return (dyd_iv){a[0], a[1]};
}
static dyd_iv side_y(const double a[4]) {
  return (dyd_iv){a[2], a[3]};
}

/* p q - r s */
static dyd_iv iv_det2(dyd_iv p, dyd_iv q, dyd_iv r, dyd_iv s) {
  return dyd_iv_sub(dyd_iv_mul(p, q), dyd_iv_mul(r, s));
}

static int sign_of_boxes(const double a[4], const double b[4], const double c[4]) {
  dyd_iv ux = dyd_iv_sub(side_x(b), side_x(a)), uy = dyd_iv_sub(side_y(b), side_y(a));
  dyd_iv vx = dyd_iv_sub(side_x(c), side_x(a)), vy = dyd_iv_sub(side_y(c), side_y(a));
  return dyd_iv_sign(iv_det2(ux, vy, uy, vx));
}

static int sign_of_points(double px, double py, double qx, double qy, double rx, double ry) {
  const double p[4] = {px, px, py, py}, q[4] = {qx, qx, qy, qy}, r[4] = {rx, rx, ry, ry};
  return sign_of_boxes(p, q, r);
}

dyd_turns dyd_filter_turns(const double a[4], const double b[4], const double c[4]) {
  int sign = sign_of_boxes(a, b, c);
  if (sign) return (dyd_turns){sign > 0, sign<0, sign> 0, sign < 0};
  dyd_turns t = {true, true, false, false};
  for (int k = 0; k < 16; k++) {
    double qx = b[k & 1], qy = b[2 + (k >> 1 & 1)], rx = c[k >> 2 & 1], ry = c[2 + (k >> 3 & 1)];
    int least_x = qy < ry, least_y = rx < qx; /* the corner of a that turns least to the left */
    int least = sign_of_points(a[least_x], a[2 + least_y], qx, qy, rx, ry);
    int most = sign_of_points(a[!least_x], a[3 - least_y], qx, qy, rx, ry);
    t.all_left = t.all_left && least > 0;
    t.all_right = t.all_right && most < 0;
    t.some_left = t.some_left || most > 0;
    t.some_right = t.some_right || least < 0;
    if (t.some_left && t.some_right) return (dyd_turns){false, false, true, true};
  }
  return t;
}

dyd_sure dyd_filter_orientation(const double a[4], const double b[4], const double c[4]) {
  dyd_turns t = dyd_filter_turns(a, b, c);
  return t.all_left ? DYD_SURE_PLUS : t.all_right ? DYD_SURE_MINUS : DYD_UNSURE;
}

dyd_sure dyd_filter_incircle(const double a[4], const double b[4], const double c[4], const double d[4]) {
  const double *const abc[3] = {a, b, c};
  dyd_iv x[3], y[3], sum = {0, 0};
  for (int k = 0; k < 3; k++) {
    x[k] = dyd_iv_sub(side_x(abc[k]), side_x(d));
    y[k] = dyd_iv_sub(side_y(abc[k]), side_y(d));
  }
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    dyd_iv norm = dyd_iv_add(dyd_iv_sqr(x[k]), dyd_iv_sqr(y[k]));
    sum = dyd_iv_add(sum, dyd_iv_mul(norm, iv_det2(x[i], y[j], x[j], y[i])));
  }
  int sign = dyd_iv_sign(sum);
  return sign > 0 ? DYD_SURE_PLUS : sign < 0 ? DYD_SURE_MINUS : DYD_UNSURE;
}

/* A point of box a: closest to t (far = false) or farthest from it. Any double between the ends is a choice, so t
 * need not be accurate. */
static double choose_end(double t, double lo, double hi, bool far) {
  if (far) return t - lo > hi - t ? lo : hi;
  return t < lo ? lo : t > hi ? hi : t;
}

static void choose_box_point(double out[4], const double t[2], const double a[4], bool far) {
  out[0] = out[1] = choose_end(t[0], a[0], a[1], far);
  out[2] = out[3] = choose_end(t[1], a[2], a[3], far);
}

/* About the centre of the circle through the middles; false when that is not a number. */
static bool guess_centre(double out[2], const double a[4], const double b[4], const double c[4]) {
  double px = a[0] / 2 + a[1] / 2, py = a[2] / 2 + a[3] / 2;
  double qx = b[0] / 2 + b[1] / 2 - px, qy = b[2] / 2 + b[3] / 2 - py;
  double rx = c[0] / 2 + c[1] / 2 - px, ry = c[2] / 2 + c[3] / 2 - py;
  double det = 2 * (qx * ry - qy * rx), s = qx * qx + qy * qy, t = rx * rx + ry * ry;
  out[0] = px + (s * ry - t * qy) / det;
  out[1] = py + (qx * t - rx * s) / det;
  return isfinite(out[0]) && isfinite(out[1]);
}

/* d is moved towards the centre of a large circle and away from the centre of a small one. */
bool dyd_filter_incircle_mixed(const double a[4], const double b[4], const double c[4], const double d[4]) {
  double t[2], p[4][4];
  dyd_sure sign[2];
  if (!guess_centre(t, a, b, c)) return false;
  for (int far = 0; far < 2; far++) {
    choose_box_point(p[0], t, a, far);
    choose_box_point(p[1], t, b, far);
    choose_box_point(p[2], t, c, far);
    choose_box_point(p[3], t, d, !far);
    sign[far] = dyd_filter_incircle(p[0], p[1], p[2], p[3]);
  }
  return (int)sign[0] * (int)sign[1] < 0;
}
