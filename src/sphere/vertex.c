/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Voronoi vertices on the sphere.
 *
 * [SPH-4] The circle through the corners of a sure triangle, counter-clockwise from outside, has no point on the side
 * away from the others, which is where (b - a) x (c - a) points to: its direction is the vertex. In balls, the corners
 * anywhere in their boxes; longitudes are measured from a place near, so that none is cut at 180 degrees. */
#include "base/error.h"
#include "sphere/state.h"
#include "stream/ball.h"
#include <math.h>

enum { PREC = 128 };

/* v = the vector of all places of the spot. */
static void spot_vector(arb_ptr v, const dyd_spot *spot) {
  arb_t angle[2], sin, cos;
  mag_t half;
  arb_init(sin);
  arb_init(cos);
  mag_init(half);
  for (int a = 0; a < 2; a++) {
    arb_init(angle[a]);
    dyd_ball_set_q(angle[a], spot->half[a], PREC);
    arb_get_mag(half, angle[a]);
    dyd_ball_set_q(angle[a], spot->mid[a], PREC);
    arb_add_error_mag(angle[a], half);
    arb_div_ui(angle[a], angle[a], 180, PREC);
  }
  arb_sin_cos_pi(v + 2, cos, angle[1], PREC);
  arb_sin_cos_pi(sin, v, angle[0], PREC);
  arb_mul(v + 1, sin, cos, PREC);
  arb_mul(v, v, cos, PREC);
  for (int a = 0; a < 2; a++) arb_clear(angle[a]);
  mag_clear(half);
  arb_clear(cos);
  arb_clear(sin);
}

/* n = (b - a) x (c - a); v: a, b, c, of which b and c are lost. */
static void normal_set(arb_ptr n, arb_ptr v) {
  for (int k = 0; k < 3; k++) {
    arb_sub(v + 3 + k, v + 3 + k, v + k, PREC);
    arb_sub(v + 6 + k, v + 6 + k, v + k, PREC);
  }
  for (int k = 0; k < 3; k++) {
    int l = (k + 1) % 3, m = (k + 2) % 3;
    arb_mul(n + k, v + 3 + l, v + 6 + m, PREC);
    arb_submul(n + k, v + 3 + m, v + 6 + l, PREC);
  }
}

/* Lower and upper ends of an angle, in degrees, shifted by so many. */
static void degrees_out(double out[2], arb_t angle, double shift) {
  arb_t pi, t;
  arf_t end;
  arb_init(pi);
  arb_init(t);
  arf_init(end);
  arb_const_pi(pi, PREC);
  arb_mul_ui(t, angle, 180, PREC);
  arb_div(t, t, pi, PREC);
  arb_set_d(pi, shift);
  arb_add(t, t, pi, PREC);
  arb_get_lbound_arf(end, t, PREC);
  out[0] = arf_get_d(end, ARF_RND_FLOOR);
  arb_get_ubound_arf(end, t, PREC);
  out[1] = arf_get_d(end, ARF_RND_CEIL);
  arf_clear(end);
  arb_clear(t);
  arb_clear(pi);
}

/* Turns the direction n about the axis by a whole number of degrees, so that it is near longitude 0; *shift: these. */
static void turn_near(double *shift, arb_ptr n) {
  arb_t s, c, x;
  double lon = atan2(arf_get_d(arb_midref(n + 1), ARF_RND_NEAR), arf_get_d(arb_midref(n), ARF_RND_NEAR));
  *shift = nearbyint(lon * 57.29577951308232);
  arb_init(s);
  arb_init(c);
  arb_init(x);
  arb_set_d(x, *shift);
  arb_div_ui(x, x, 180, PREC);
  arb_sin_cos_pi(s, c, x, PREC);
  arb_mul(x, n, c, PREC);
  arb_addmul(x, n + 1, s, PREC);
  arb_mul(n + 1, n + 1, c, PREC);
  arb_submul(n + 1, n, s, PREC);
  arb_swap(n, x);
  arb_clear(x);
  arb_clear(c);
  arb_clear(s);
}

/* The box of the direction n. Where it may be along the axis, all longitudes. */
static void box_of_direction(double box[4], arb_ptr n) {
  arb_t lon, lat;
  double shift;
  arb_init(lon);
  arb_init(lat);
  turn_near(&shift, n);
  arb_atan2(lon, n + 1, n, PREC);
  degrees_out(&box[0], lon, shift);
  arb_hypot(lat, n, n + 1, PREC);
  arb_nonnegative_part(lat, lat);
  arb_atan2(lat, n + 2, lat, PREC);
  degrees_out(&box[2], lat, 0);
  if (!(box[1] - box[0] < 360)) box[0] = -180, box[1] = 180;
  box[2] = fmax(box[2], -90); /* NaN, too, where nothing is known */
  box[3] = fmin(box[3], 90);
  arb_clear(lat);
  arb_clear(lon);
}

static dyd_status corner_set(arb_ptr v, const dyd_sphere *s, uint32_t i, dyd_error *err) {
  dyd_spot spot;
  dyd_spot_init(&spot);
  dyd_status st = dyd_sphere_wide_spot(&spot, s, i, err);
  if (st == DYD_OK) spot_vector(v, &spot);
  dyd_spot_clear(&spot);
  return st;
}

/* Who is within an angle of a place is within it of its vector. */
static dyd_status place_vector(arb_ptr v, const dyd_sphere *s, uint32_t i, dyd_error *err) {
  dyd_spot spot;
  mpq_t angle;
  arb_t reach;
  mag_t error;
  dyd_spot_init(&spot);
  mpq_init(angle);
  arb_init(reach);
  mag_init(error);
  dyd_status st = dyd_sphere_spot(&spot, s, i, err);
  dyd_sphere_angle(angle, s, i);
  dyd_ball_set_q(reach, angle, PREC);
  arb_get_mag(error, reach);
  if (st == DYD_OK) spot_vector(v, &spot);
  for (int a = 0; a < 3; a++) arb_add_error_mag(v + a, error);
  mag_clear(error);
  arb_clear(reach);
  mpq_clear(angle);
  dyd_spot_clear(&spot);
  return st;
}

dyd_status dyd_sphere_vector(double box[6], const dyd_sphere *s, uint32_t i, dyd_error *err) {
  if (i >= s->count) return dyd_fail(err, DYD_E_ARG, "there is no point %lu", (unsigned long)i);
  arb_ptr v = _arb_vec_init(3);
  arf_t end;
  arf_init(end);
  dyd_status st = place_vector(v, s, i, err);
  for (int a = 0; a < 3 && st == DYD_OK; a++) {
    arb_get_lbound_arf(end, v + a, PREC);
    box[2 * a] = fmax(arf_get_d(end, ARF_RND_FLOOR), -1);
    arb_get_ubound_arf(end, v + a, PREC);
    box[2 * a + 1] = fmin(arf_get_d(end, ARF_RND_CEIL), 1);
  }
  arf_clear(end);
  _arb_vec_clear(v, 3);
  return st;
}

dyd_status dyd_sphere_vertex(double box[4], const dyd_sphere *s, const dyd_triangle *t, dyd_error *err) {
  arb_ptr v = _arb_vec_init(9), n = _arb_vec_init(3);
  dyd_status st = DYD_OK;
  for (int k = 0; k < 3 && st == DYD_OK; k++)
    st = t->v[k] < s->count ? corner_set(v + 3 * k, s, t->v[k], err)
                            : dyd_fail(err, DYD_E_ARG, "there is no point %lu", (unsigned long)t->v[k]);
  if (st == DYD_OK) {
    normal_set(n, v);
    box_of_direction(box, n);
  }
  _arb_vec_clear(n, 3);
  _arb_vec_clear(v, 9);
  return st;
}
