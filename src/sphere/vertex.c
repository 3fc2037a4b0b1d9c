/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Voronoi vertices on the sphere.
 *
 * [SPH-4] The circle through the corners of a certain triangle, counter-clockwise from outside, has no point on the
 * side away from the others, which is where (b - a) x (c - a) points to: its direction is the vertex. In balls, the
 * corners anywhere in their boxes, from axes near the vertex: east, north and up. There corners are about equally high,
 * and heights hardly change with where they are in their boxes, so that the box of the vertex is about as wide as
 * theirs. With the axes of the globe it would be wider by as much as the globe is larger than the triangle. Longitudes
 * are measured from a place near, so that none is cut at 180 degrees. */
#include "base/error.h"
#include "base/local.h"
#include "sphere/state.h"
#include "stream/ball.h"
#include <math.h>

enum { PREC = 128 };

/* x = degrees, half: off by so many, and shifted by those of `from` (NULL: none), in units of pi. */
static void half_turns(arb_ptr x, mpq_srcptr degrees, mpq_srcptr half, mpq_srcptr from) {
  DYD_LOCAL_NUMBERS(mpq, shifted);
  DYD_LOCAL_NUMBERS(mag, error);
  dyd_ball_set_q(x, half, PREC);
  arb_get_mag(error, x);
  mpq_set(shifted, degrees);
  if (from) mpq_sub(shifted, shifted, from);
  dyd_ball_set_q(x, shifted, PREC);
  arb_add_error_mag(x, error);
  arb_div_ui(x, x, 180, PREC);
}

/* v = the vector of all places of the spot. */
static void spot_vector(arb_ptr v, const dyd_spot *spot) {
  DYD_LOCAL_ARRAY(arb_struct, angle, [4]);
  arb_ptr sin = angle + 2, cos = angle + 3;
  for (int a = 0; a < 2; a++) half_turns(angle + a, spot->mid[a], spot->half[a], NULL);
  arb_sin_cos_pi(v + 2, cos, angle + 1, PREC);
  arb_sin_cos_pi(sin, v, angle, PREC);
  arb_mul(v + 1, sin, cos, PREC);
  arb_mul(v, v, cos, PREC);
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
  DYD_LOCAL_ARRAY(arb_struct, pi, [2]);
  arb_ptr t = pi + 1;
  arb_const_pi(pi, PREC);
  arb_mul_ui(t, angle, 180, PREC);
  arb_div(t, t, pi, PREC);
  arb_set_d(pi, shift);
  arb_add(t, t, pi, PREC);
  const dyd_iv ends = dyd_ball_ends(t);
  out[0] = ends.lo;
  out[1] = ends.hi;
}

/* Turns the direction n about the axis by a whole number of degrees, so that it is near longitude 0; *shift: these. */
static void turn_near(double *shift, arb_ptr n) {
  DYD_LOCAL_ARRAY(arb_struct, s, [3]);
  arb_ptr c = s + 1, x = s + 2;
  double lon = atan2(arf_get_d(arb_midref(n + 1), ARF_RND_NEAR), arf_get_d(arb_midref(n), ARF_RND_NEAR));
  *shift = nearbyint(lon * 57.29577951308232);
  arb_set_d(x, *shift);
  arb_div_ui(x, x, 180, PREC);
  arb_sin_cos_pi(s, c, x, PREC);
  arb_mul(x, n, c, PREC);
  arb_addmul(x, n + 1, s, PREC);
  arb_mul(n + 1, n + 1, c, PREC);
  arb_submul(n + 1, n, s, PREC);
  arb_swap(n, x);
}

/* The box of the direction n. Where it may be along the axis, all longitudes. */
static void box_of_direction(double box[4], arb_ptr n) {
  DYD_LOCAL_ARRAY(arb_struct, lon, [2]);
  arb_ptr lat = lon + 1;
  double shift;
  turn_near(&shift, n);
  arb_atan2(lon, n + 1, n, PREC);
  degrees_out(&box[0], lon, shift);
  arb_hypot(lat, n, n + 1, PREC);
  arb_nonnegative_part(lat, lat);
  arb_atan2(lat, n + 2, lat, PREC);
  degrees_out(&box[2], lat, 0);
  if (!(box[1] - box[0] < 360)) box[0] = -180, box[1] = 180;
  box[2] = fmax(box[2], -90); /* NaN, too, where unknown */
  box[3] = fmin(box[3], 90);
}

/* Axes at a place: where it is, in degrees, and cosine and sine of its longitude and of its latitude. */
typedef struct axes {
  mpq_t at[2];
  arb_struct turn[4];
} axes;

static void axes_init(axes *f) {
  mpq_inits(f->at[0], f->at[1], NULL);
  for (int k = 0; k < 4; k++) arb_init(&f->turn[k]);
}

static void axes_clear(axes *f) {
  for (int k = 0; k < 4; k++) arb_clear(&f->turn[k]);
  mpq_clears(f->at[0], f->at[1], NULL);
}

/* About where n points to, to 7 mm on the earth, so that whatever is wrong with axes shows. */
static void axes_set(axes *f, arb_srcptr n) {
  double d[3];
  DYD_LOCAL_NUMBERS(arb, angle);
  for (int a = 0; a < 3; a++) d[a] = arf_get_d(arb_midref(n + a), ARF_RND_NEAR);
  const double at[2] = {atan2(d[1], d[0]), atan2(d[2], hypot(d[0], d[1]))};
  for (int a = 0; a < 2; a++) {
    mpq_set_d(f->at[a], isfinite(at[a]) ? nearbyint(at[a] * 57.29577951308232 * 0x1p24) * 0x1p-24 : 0);
    dyd_ball_set_q(angle, f->at[a], PREC);
    arb_div_ui(angle, angle, 180, PREC);
    arb_sin_cos_pi(&f->turn[2 * a + 1], &f->turn[2 * a], angle, PREC);
  }
}

/* v = how far east, north and above the place of the axes all places of the spot are: with d of longitude, f and f0 of
 * latitude and h = 2 cos f sin^2(d/2), these are cos f sin d, sin(f - f0) + h sin f0, -2 sin^2((f - f0)/2) - h cos f0.
 */
static void axes_see(arb_ptr v, const axes *f, const dyd_spot *spot) {
  DYD_LOCAL_ARRAY(arb_struct, d, [4]);
  arb_ptr u = d + 1, across = d + 2, cos = d + 3;
  half_turns(d, spot->mid[0], spot->half[0], f->at[0]);
  half_turns(u, spot->mid[1], spot->half[1], NULL);
  arb_cos_pi(cos, u, PREC);
  half_turns(u, spot->mid[1], spot->half[1], f->at[1]);
  arb_sin_pi(v, d, PREC);
  arb_mul(v, v, cos, PREC);
  arb_mul_2exp_si(d, d, -1);
  arb_sin_pi(across, d, PREC);
  arb_sqr(across, across, PREC);
  arb_mul(across, across, cos, PREC);
  arb_mul_2exp_si(across, across, 1);
  arb_sin_pi(v + 1, u, PREC);
  arb_addmul(v + 1, across, &f->turn[3], PREC);
  arb_mul_2exp_si(u, u, -1);
  arb_sin_pi(v + 2, u, PREC);
  arb_sqr(v + 2, v + 2, PREC);
  arb_mul_2exp_si(v + 2, v + 2, 1);
  arb_addmul(v + 2, across, &f->turn[2], PREC);
  arb_neg(v + 2, v + 2);
}

/* n, from these axes, becomes a direction from those of the globe. Of length about 1 if possible: else the uncertainty
 * of its length would add to that of its direction. */
static void axes_leave(arb_ptr n, const axes *f) {
  arb_srcptr cl = &f->turn[0], sl = &f->turn[1], cf = &f->turn[2], sf = &f->turn[3];
  DYD_LOCAL_ARRAY(arb_struct, w, [2]);
  if (arb_is_positive(n + 2)) {
    arb_div(n, n, n + 2, PREC);
    arb_div(n + 1, n + 1, n + 2, PREC);
    arb_one(n + 2);
  }
  arb_mul(w, n + 2, cf, PREC); /* away from the axis of the globe */
  arb_submul(w, n + 1, sf, PREC);
  arb_mul(n + 2, n + 2, sf, PREC);
  arb_addmul(n + 2, n + 1, cf, PREC);
  arb_set(w + 1, n); /* east */
  arb_mul(n, w, cl, PREC);
  arb_submul(n, w + 1, sl, PREC);
  arb_mul(n + 1, w, sl, PREC);
  arb_addmul(n + 1, w + 1, cl, PREC);
}

/* A point within an angle of a place is within it of its vector. */
static dyd_status place_vector(arb_ptr v, const dyd_sphere *s, uint32_t i, dyd_error *err) {
  DYD_LOCAL(dyd_spot, spot);
  DYD_LOCAL_NUMBERS(arb, reach);
  DYD_LOCAL_NUMBERS(mag, error);
  dyd_status st = dyd_sphere_spot(&spot, s, i, err);
  dyd_ball_set_q(reach, spot.angle, PREC);
  arb_get_mag(error, reach);
  if (st == DYD_OK) spot_vector(v, &spot);
  for (int a = 0; a < 3; a++) arb_add_error_mag(v + a, error);
  return st;
}

dyd_status dyd_sphere_vector(double box[6], const dyd_sphere *s, uint32_t i, dyd_error *err) {
  if (!s) return dyd_fail_null(err);
  if (i >= s->count) return dyd_fail(err, DYD_E_ARG, "there is no point %lu", (unsigned long)i);
  DYD_LOCAL_ARRAY(arb_struct, v, [3]);
  dyd_status st = place_vector(v, s, i, err);
  for (int a = 0; a < 3 && st == DYD_OK; a++) {
    const dyd_iv ends = dyd_ball_ends(v + a);
    box[2 * a] = fmax(ends.lo, -1);
    box[2 * a + 1] = fmin(ends.hi, 1);
  }
  return st;
}

static dyd_status triangle_spots(dyd_spot spot[3], const dyd_sphere *s, const dyd_triangle *t, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (int k = 0; k < 3 && st == DYD_OK; k++) {
    st = t->v[k] < s->count ? dyd_sphere_spot(&spot[k], s, t->v[k], err)
                            : dyd_fail(err, DYD_E_ARG, "there is no point %lu", (unsigned long)t->v[k]);
    if (st == DYD_OK) dyd_spot_box(&spot[k]);
  }
  return st;
}

dyd_status dyd_sphere_vertex(double box[4], const dyd_sphere *s, const dyd_triangle *t, dyd_error *err) {
  if (!s) return dyd_fail_null(err);
  DYD_LOCAL_ARRAY(arb_struct, v, [9]);
  arb_ptr n = _arb_vec_init(3);
  DYD_LOCAL(axes, f);
  DYD_LOCAL_ARRAY(dyd_spot, spot, [3]);
  dyd_status st = triangle_spots(spot, s, t, err);
  if (st == DYD_OK) {
    for (int k = 0; k < 3; k++) spot_vector(v + 3 * k, &spot[k]);
    normal_set(n, v);
    axes_set(&f, n);
    for (int k = 0; k < 3; k++) axes_see(v + 3 * k, &f, &spot[k]);
    normal_set(n, v);
    axes_leave(n, &f);
    box_of_direction(box, n);
  }
  _arb_vec_clear(n, 3);
  return st;
}
