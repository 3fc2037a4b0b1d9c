/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [SPH-1] [SPH-5] Radii as text, spots of degrees, spots widened by an angle. */
#include <setjmp.h>
#include <stdarg.h>

#include "sphere/state.h"
#include "sphere/units.h"
#include "support/random.h"
#include <cmocka.h>
#include <math.h>
#include <string.h>

static const long double degree = 0.017453292519943295769236907684886L;

/* ---- radii ---- */

static void test_units(void **state) {
  static const struct {
    const char *text, *unit;
    dyd_status status;
    bool ground;
    unsigned long num, den;
  } tries[] = {{"30m", NULL, DYD_OK, true, 30, 1},        {"2.5km", NULL, DYD_OK, true, 2500, 1},
               {"1/4deg", NULL, DYD_OK, false, 1, 4},     {"0.5", "deg", DYD_OK, false, 1, 2},
               {"0", NULL, DYD_OK, false, 0, 1},          {"0m", NULL, DYD_OK, true, 0, 1},
               {"3/1000km", NULL, DYD_OK, true, 3, 1},    {"3 mm", NULL, DYD_OK, true, 3, 1000},
               {"7cm", "km", DYD_OK, true, 7, 100},       {"1ft", NULL, DYD_OK, true, 3048, 10000},
               {"1in", NULL, DYD_OK, true, 254, 10000},   {"6arcmin", NULL, DYD_OK, false, 1, 10},
               {"9arcsec", NULL, DYD_OK, false, 1, 400},  {"5", "ft", DYD_OK, true, 1524, 1000},
               {"5", NULL, DYD_E_DOMAIN, false, 0, 1},    {"0.02", NULL, DYD_E_DOMAIN, false, 0, 1},
               {"-1", "m", DYD_E_ARG, false, 0, 1},       {"-1km", NULL, DYD_E_ARG, false, 0, 1},
               {"m", NULL, DYD_E_ARG, false, 0, 1},       {"km", "m", DYD_E_ARG, false, 0, 1},
               {"deg", NULL, DYD_E_ARG, false, 0, 1},     {"", "m", DYD_E_ARG, false, 0, 1},
               {"3 miles", NULL, DYD_E_ARG, false, 0, 1}, {"3kmm", NULL, DYD_E_ARG, false, 0, 1},
               {"3degkm", NULL, DYD_E_ARG, false, 0, 1},  {"3KM", NULL, DYD_E_ARG, false, 0, 1}};
  (void)state;
  mpq_t got, want;
  mpq_inits(got, want, NULL);
  for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
    bool ground = !tries[k].ground;
    const dyd_unit *unit = tries[k].unit ? dyd_unit_find(tries[k].unit, strlen(tries[k].unit)) : NULL;
    assert_int_equal(dyd_radius_parse(got, &ground, tries[k].text, strlen(tries[k].text), unit), tries[k].status);
    if (tries[k].status != DYD_OK) continue;
    mpq_set_ui(want, tries[k].num, tries[k].den);
    mpq_canonicalize(want);
    assert_true(mpq_equal(got, want) && ground == tries[k].ground);
  }
  mpq_clears(got, want, NULL);
}

static void test_columns(void **state) {
  static const char *const tries[][2] = {{"sde(m)", "m"},
                                         {"s [mm]", "mm"},
                                         {"h_acc (km) ", "km"},
                                         {"coordinateUncertaintyInMeters", "m"},
                                         {"accInMetre", "m"},
                                         {"accuracy in feet", "ft"},
                                         {"rInInches", "in"},
                                         {"err_in_degrees", "deg"},
                                         {"xInArcseconds", "arcsec"},
                                         {"rInKilometers", "km"},
                                         {"r[arcmin]", "arcmin"},
                                         {"acc", NULL},
                                         {"parameters", NULL},
                                         {"diameters", NULL},
                                         {"meters", NULL},
                                         {"s (mean)", NULL},
                                         {"sde(m", NULL},
                                         {"plain meters", NULL},
                                         {"margin meters", NULL},
                                         {"", NULL},
                                         {"()", NULL},
                                         {"m", NULL},
                                         {"acc_m", NULL},
                                         {"sigma (1 m)", NULL}};
  (void)state;
  for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
    const dyd_unit *u = dyd_unit_of_column(tries[k][0], strlen(tries[k][0]));
    assert_true(tries[k][1] ? u && !strcmp(u->name, tries[k][1]) : !u);
  }
}

/* ---- spots ---- */

/* In degrees: a box, more on each side; the spot, or none. */
static void test_spots(void **state) {
  static const struct {
    double box[4], more;
    bool good;
    double mid[2], half[2];
  } tries[] = {
      {{10, 10, 20, 20}, 0, true, {10, 20}, {0, 0}},
      {{180, 180, 0, 0}, 0, true, {-180, 0}, {0, 0}},
      {{-180, -180, 0, 0}, 0, true, {-180, 0}, {0, 0}},
      {{540, 540, 1, 1}, 0, true, {-180, 1}, {0, 0}},
      {{-540.5, -540.5, 1, 1}, 0, true, {179.5, 1}, {0, 0}},
      {{179, 181, -1, 3}, 0, true, {-180, 1}, {1, 2}},
      {{-190, -170, 0, 0}, 0, true, {-180, 0}, {10, 0}},
      {{77, 77, 90, 90}, 0, true, {0, 90}, {0, 0}},
      {{77, 77, -90, -90}, 0, true, {0, -90}, {0, 0}},
      {{70, 80, 80, 90}, 0, true, {75, 85}, {5, 5}},
      {{70, 80, -90, -80}, 0, true, {75, -85}, {5, 5}},
      {{70, 80, 80, 91}, 0, true, {0, 85}, {180, 5}},
      {{70, 80, -91, -80}, 0, true, {0, -85}, {180, 5}},
      {{70, 80, -91, 91}, 0, true, {0, 0}, {180, 90}},
      {{70, 80, 90, 91}, 0, true, {0, 90}, {0, 0}},
      {{70, 80, -91, -90}, 0, true, {0, -90}, {0, 0}},
      {{70, 70, 91, 91}, 0, false, {0, 0}, {0, 0}},
      {{70, 70, -91, -91}, 0, false, {0, 0}, {0, 0}},
      {{70, 80, 91, 92}, 0, false, {0, 0}, {0, 0}},
      {{70, 80, -92, -91}, 0, false, {0, 0}, {0, 0}},
      {{10, 12, 20, 22}, 0.5, true, {11, 21}, {1.5, 1.5}},
      {{5, 5, 90, 90}, 0.5, true, {0, 89.75}, {180, 0.25}},
      {{5, 5, -90, -90}, 0.5, true, {0, -89.75}, {180, 0.25}},
      {{5, 5, 89.5, 89.5}, 0.5, true, {5, 89.5}, {0.5, 0.5}},
  };
  dyd_spot spot;
  dyd_rect r;
  mpq_t more;
  (void)state;
  dyd_spot_init(&spot);
  dyd_rect_init(&r);
  mpq_init(more);
  for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
    const double *b = tries[k].box;
    assert_int_equal(dyd_rect_set_d(&r, b[0], b[1], b[2], b[3]), DYD_OK);
    mpq_set_d(more, tries[k].more);
    assert_int_equal(dyd_spot_set(&spot, &r, more), tries[k].good);
    for (int a = 0; a < 2 && tries[k].good; a++)
      assert_true(mpq_get_d(spot.mid[a]) == tries[k].mid[a] && mpq_get_d(spot.half[a]) == tries[k].half[a]);
    if (tries[k].good) assert_int_equal(dyd_spot_is_exact(&spot), tries[k].half[0] == 0 && tries[k].half[1] == 0);
  }
  mpq_clear(more);
  dyd_rect_clear(&r);
  dyd_spot_clear(&spot);
}

static void set_spot(dyd_spot *s, double lon, double lat, double half_lon, double half_lat) {
  mpq_set_d(s->mid[0], lon);
  mpq_set_d(s->mid[1], lat);
  mpq_set_d(s->half[0], half_lon);
  mpq_set_d(s->half[1], half_lat);
}

/* A box of degrees widened by an angle: the least box about the caps, to 2^-40, or all longitudes where a cap holds a
 * pole. */
static void test_widened(void **state) {
  test_random r = test_random_start("widened spots");
  dyd_spot s;
  size_t poles = 0;
  (void)state;
  dyd_spot_init(&s);
  for (int k = 0; k < 2000; k++) {
    double lat = nearbyint(176 * test_unit(&r) - 88), half_lat = test_chance(&r, 2) ? 0 : ldexp(test_unit(&r), -2),
           half_lon = test_chance(&r, 2) ? 0 : test_unit(&r), a = ldexp(test_unit(&r), -(int)test_below(&r, 20));
    set_spot(&s, 30, lat, half_lon, half_lat);
    mpq_set_d(s.angle, a);
    dyd_spot_box(&s);
    assert_int_equal(mpq_sgn(s.angle), 0);
    long double far = (fabs(lat) + half_lat) * degree, up = (lat + half_lat) + a / degree,
                down = (lat - half_lat) - a / degree;
    if (fabsl(far + a - 90 * degree) < 1e-9L) continue;
    bool pole = far + a > 90 * degree;
    long double wide = pole ? 180 : half_lon + asinl(sinl(a) / cosl(far)) / degree, slack = ldexpl(1, -40) * (1 + wide);
    up = fminl(up, 90), down = fmaxl(down, -90);
    double lo = mpq_get_d(s.mid[1]) - mpq_get_d(s.half[1]), hi = mpq_get_d(s.mid[1]) + mpq_get_d(s.half[1]);
    assert_true(hi >= up - 1e-12L && hi <= up + slack && lo <= down + 1e-12L && lo >= down - slack);
    assert_true(mpq_get_d(s.half[0]) >= wide - 1e-12L && mpq_get_d(s.half[0]) <= wide + slack);
    assert_true(mpq_get_d(s.mid[0]) == (pole ? 0 : 30));
    poles += pole;
  }
  assert_true(poles > 20 && poles < 1500);
  dyd_spot_clear(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_units), cmocka_unit_test(test_columns),
                                     cmocka_unit_test(test_spots), cmocka_unit_test(test_widened)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
