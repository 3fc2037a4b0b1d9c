/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [SPH-2] [FLT-SPH] Images of places, boxes and circles: against the projection in long doubles, and choices within. */
#include <setjmp.h>
#include <stdarg.h>

#include "sphere/state.h"
#include "support/random.h"
#include <cmocka.h>
#include <math.h>

static const long double degree = 0.017453292519943295769236907684886L;

/* A place in degrees that doubles hold. */
typedef struct spot_case {
  double lon, lat, half[2];
} spot_case;

static void make_spot(spot_case *s, test_random *r, bool wide) {
  *s = (spot_case){nearbyint(360 * test_unit(r) - 180), nearbyint(178 * test_unit(r) - 89), {0, 0}};
  bool pole = test_chance(r, 4); /* as an eye it looks along longitude 0 */
  if (pole) s->lon = 0, s->lat = test_chance(r, 2) ? 90 : -90;
  if (!pole && test_chance(r, 2)) s->lon += 0x1p-20, s->lat -= copysign(0x1p-10, s->lat);
  if (wide && !pole)
    s->half[0] = 30 * pow(test_unit(r), 6), s->half[1] = fmin(10 * pow(test_unit(r), 6), 90 - fabs(s->lat));
}

static void set_spot(dyd_spot *out, const spot_case *s) {
  dyd_rect r;
  mpq_t none;
  mpq_init(none);
  dyd_rect_init(&r);
  assert_int_equal(
      dyd_rect_set_d(&r, s->lon - s->half[0], s->lon + s->half[0], s->lat - s->half[1], s->lat + s->half[1]), DYD_OK);
  assert_true(dyd_spot_set(out, &r, none));
  dyd_rect_clear(&r);
  mpq_clear(none);
}

/* The cosine of their angle subtracted from 1 is at least 1e-4 where this is used. */
static long double image_of(long double out[2], const spot_case *s, const spot_case *q) {
  long double d = (s->lon - (long double)q->lon) * degree, f = s->lat * degree, f0 = q->lat * degree;
  long double D = 1 - sinl(f) * sinl(f0) - cosl(f) * cosl(f0) * cosl(d);
  out[0] = cosl(f) * sinl(d) / D;
  out[1] = (sinl(f) * cosl(f0) - cosl(f) * sinl(f0) * cosl(d)) / D;
  return D;
}

static bool ball_holds(const arb_t ball, long double x) {
  arb_t t;
  arb_init(t);
  arf_set_d(arb_midref(t), (double)x);
  mag_set_d(arb_radref(t), 1e-12 * (1 + fabs((double)x)));
  bool meets = arb_overlaps(ball, t);
  arb_clear(t);
  return meets;
}

static spot_case choose_in(const spot_case *s, test_random *r) {
  double a = test_chance(r, 3) ? 1 : 2 * test_unit(r) - 1, b = test_chance(r, 3) ? -1 : 2 * test_unit(r) - 1;
  return (spot_case){s->lon + a * s->half[0], s->lat + b * s->half[1], {0, 0}};
}

/* A place within an angle of s, if it is not a pole. */
static spot_case move_by(const spot_case *s, long double angle, test_random *r) {
  long double lat = s->lat * degree, way = 6.283185307L * test_unit(r),
              far = angle * (test_chance(r, 2) ? 1 : test_unit(r));
  long double z = sinl(lat) * cosl(far) + cosl(lat) * sinl(far) * cosl(way);
  long double east = atan2l(sinl(way) * sinl(far) * cosl(lat), cosl(far) - sinl(lat) * z);
  return (spot_case){(double)(s->lon + east / degree), (double)(asinl(z) / degree), {0, 0}};
}

static void test_images(void **state) {
  test_random r;
  dyd_spot spot;
  dyd_eye eye;
  arb_t x, y;
  size_t seen = 0, tight = 0;
  (void)state;
  r = test_random_start("images of places");
  dyd_spot_init(&spot);
  dyd_eye_init(&eye);
  arb_init(x);
  arb_init(y);
  for (int k = 0; k < 3000; k++) {
    spot_case s, q;
    long double want[2];
    make_spot(&s, &r, test_chance(&r, 2));
    make_spot(&q, &r, test_chance(&r, 3));
    set_spot(&spot, &s);
    mpq_set_d(spot.angle, test_chance(&r, 3) ? ldexp(test_unit(&r), -3) : 0);
    set_spot(&eye.spot, &q);
    eye.prec = 0;
    if (!dyd_project(x, y, &spot, &eye, 128)) continue;
    seen++;
    if (dyd_spot_is_exact(&spot) && dyd_spot_is_exact(&eye.spot))
      assert_true(arb_rel_accuracy_bits(x) > 60 || arb_rel_accuracy_bits(y) > 60);
    for (int l = 0; l < 8; l++) {
      spot_case from = choose_in(&q, &r), at = choose_in(&s, &r);
      if (mpq_sgn(spot.angle)) at = move_by(&at, mpq_get_d(spot.angle), &r);
      if (image_of(want, &at, &from) < 1e-4L) continue;
      assert_true(ball_holds(x, want[0]) && ball_holds(y, want[1]));
      tight++;
    }
  }
  assert_true(seen > 1500 && tight > 10000);
  arb_clear(y);
  arb_clear(x);
  dyd_eye_clear(&eye);
  dyd_spot_clear(&spot);
}

/* The image of a narrow box is about as wide as the slopes say; that of a circle is the disc about it. */
static void test_widths(void **state) {
  dyd_spot spot;
  dyd_eye eye;
  arb_t x, y;
  (void)state;
  dyd_spot_init(&spot);
  dyd_eye_init(&eye);
  arb_init(x);
  arb_init(y);
  set_spot(&eye.spot, &(spot_case){10, 0, {0, 0}});
  set_spot(&spot, &(spot_case){100, 0, {0, 0}}); /* 90 degrees away: the slope is 1 */
  mpq_set_ui(spot.angle, 1, 1024);
  assert_true(dyd_project(x, y, &spot, &eye, 128));
  assert_true(fabs(mag_get_d(arb_radref(x)) - 0x1p-10) < 1e-8 && fabs(mag_get_d(arb_radref(y)) - 0x1p-10) < 1e-8);
  set_spot(&spot, &(spot_case){100, 0, {0x1p-10, 0x1p-12}});
  assert_true(dyd_project(x, y, &spot, &eye, 128));
  assert_true(fabs(mag_get_d(arb_radref(x)) / (0x1p-10 * (double)degree) - 1) < 1e-4);
  assert_true(fabs(mag_get_d(arb_radref(y)) / (0x1p-12 * (double)degree) - 1) < 1e-4);
  set_spot(&spot, &(spot_case){11, 0, {1, 0}}); /* the centre is at its end */
  assert_false(dyd_project(x, y, &spot, &eye, 128));
  arb_clear(y);
  arb_clear(x);
  dyd_eye_clear(&eye);
  dyd_spot_clear(&spot);
}

/* Next to a pole, where boxes of many degrees are thin: from the pole, or from a place or a box on the other side of
 * it. The image is not much wider than that of a disc about the box is. */
static void test_about_poles(void **state) {
  test_random r;
  dyd_spot spot;
  dyd_eye eye;
  arb_t x, y;
  (void)state;
  r = test_random_start("images about poles");
  dyd_spot_init(&spot);
  dyd_eye_init(&eye);
  arb_init(x);
  arb_init(y);
  for (int k = 0; k < 300; k++) {
    double far = pow(0.1, 1 + test_below(&r, 5)), side = test_chance(&r, 2) ? 1 : -1, lon = 360 * test_unit(&r) - 180;
    double eye_far = test_chance(&r, 3) ? 0 : far * test_unit(&r),
           eye_half = test_chance(&r, 2) ? 0 : 5 * test_unit(&r);
    spot_case s = {lon, side * (90 - far), {40 * test_unit(&r), far * test_unit(&r) / 4}};
    spot_case q = {eye_far > 0 ? lon + 180 : 0, side * (90 - eye_far), {0, 0}};
    if (eye_far > 0) q.half[0] = eye_half, q.half[1] = eye_far * eye_half / 90;
    set_spot(&spot, &s);
    set_spot(&eye.spot, &q);
    eye.prec = 0;
    assert_true(dyd_project(x, y, &spot, &eye, 128));
    double apart = (far - s.half[1]) * (double)degree; /* the image is as far as 2 / apart */
    assert_true(mag_get_d(arb_radref(x)) < 3 / apart && mag_get_d(arb_radref(y)) < 3 / apart);
  }
  arb_clear(y);
  arb_clear(x);
  dyd_eye_clear(&eye);
  dyd_spot_clear(&spot);
}

/* ---- in doubles ---- */

/* Anywhere, at whole quarters of a turn, next to a pole; `at`: next to that, at times after many turns. */
static void make_place(double p[4], test_random *r, const double *at) {
  static const double quarter[] = {-180, -135, -90, -45, 0, 45, 90, 135, 180};
  double near = ldexp(test_unit(r) - 0.5, -(int)test_below(r, 50));
  p[0] = test_chance(r, 3) ? quarter[test_below(r, 9)] : 360 * test_unit(r) - 180;
  p[2] = test_chance(r, 3) ? quarter[2 + test_below(r, 5)] : 180 * test_unit(r) - 90;
  if (at && test_chance(r, 2)) p[0] = at[0] + near, p[2] = at[2] - near;
  if (test_chance(r, 2)) p[0] += near, p[2] -= near;
  if (at && test_chance(r, 5)) p[0] += ldexp(test_chance(r, 2) ? 360 : -360, (int)test_below(r, 50));
  p[2] = fmin(fmax(p[2], -90), 90);
  p[1] = test_chance(r, 2) ? p[0] : nextafter(p[0], HUGE_VAL);
  p[3] = test_chance(r, 2) ? p[2] : fmin(nextafter(p[2], HUGE_VAL), 90);
}

static void set_corner(dyd_spot *out, const double p[4], int corner) {
  set_spot(out, &(spot_case){p[corner & 1], p[2 + corner / 2], {0, 0}});
}

static bool is_between(const arb_t x, const double end[2]) {
  arb_t side;
  arb_init(side);
  arb_set_d(side, end[0]);
  bool good = arb_le(side, x);
  arb_set_d(side, end[1]);
  good = good && arb_ge(side, x);
  arb_clear(side);
  return good;
}

/* The image of every corner of a narrow box is in what doubles say, and that is narrow where the place is far. */
static void test_doubles(void **state) {
  test_random r;
  dyd_spot spot;
  dyd_eye eye;
  arb_t x, y;
  size_t seen = 0, fine = 0;
  (void)state;
  r = test_random_start("images in doubles");
  dyd_spot_init(&spot);
  dyd_eye_init(&eye);
  arb_init(x), arb_init(y);
  for (int k = 0; k < 20000; k++) {
    double q[4], got[4];
    dyd_spot_d region = {.angle = 0};
    double *p = region.box;
    dyd_eye_d in_doubles;
    make_place(q, &r, NULL);
    make_place(p, &r, q);
    bool wide = test_chance(&r, 5);
    if (wide) p[1] += ldexp(test_unit(&r), -(int)test_below(&r, 40)), p[3] = fmin(90, p[3] + p[1] - p[0]);
    set_corner(&eye.spot, q, 0);
    eye.prec = 0;
    dyd_eye_enclose(&in_doubles, &eye);
    bool known = dyd_filter_image(got, &region, &in_doubles, 0);
    for (int corner = 0; corner < 4 && known; corner++) {
      set_corner(&spot, p, corner);
      assert_true(dyd_project(x, y, &spot, &eye, 200));
      assert_true(is_between(x, got) && is_between(y, got + 2));
    }
    for (int a = 0; a < 4 && known; a++) assert_true(isfinite(got[a]));
    region.angle = 0x1p-60;
    assert_false(dyd_filter_image(got, &region, &in_doubles, 0)); /* the box alone is not the region */
    region.angle = 0;
    seen += known;
    double far = known ? hypot(got[0], got[2]) : HUGE_VAL;
    if (far > 200 || wide) continue;
    fine++;
    assert_true(dyd_filter_image(got, &region, &in_doubles, 40));
    assert_true(fmax(got[1] - got[0], got[3] - got[2]) <= 0x1p-41 * (1 + 1e-3) * (1 + far * far));
  }
  assert_true(seen > 10000 && fine > 5000);
  arb_clear(y), arb_clear(x);
  dyd_eye_clear(&eye);
  dyd_spot_clear(&spot);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_images), cmocka_unit_test(test_widths),
                                     cmocka_unit_test(test_about_poles), cmocka_unit_test(test_doubles)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
