/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [SPH-1] [SPH-3] [SPH-4] [SPH-5] Radii as text, spots of degrees, circles of four places, choices within radii. */
#include <setjmp.h>
#include <stdarg.h>

#include "sphere/state.h"
#include "sphere/units.h"
#include "support/random.h"
#include <cmocka.h>
#include <math.h>
#include <string.h>

static const long double degree = 0.017453292519943295769236907684886L;
static const double earth = 6371008.8;

/* ---- radii ---- */

static void test_units(void **state) {
  static const struct {
    const char *text;
    bool good, ground;
    unsigned long num, den;
  } tries[] = {{"30m", true, true, 30, 1},     {"2.5km", true, true, 2500, 1},  {"1/4deg", true, false, 1, 4},
               {"0.5", true, false, 1, 2},     {"0", true, false, 0, 1},        {"0m", true, true, 0, 1},
               {"3/1000km", true, true, 3, 1}, {"-1", false, false, 0, 1},      {"-1km", false, false, 0, 1},
               {"m", false, false, 0, 1},      {"km", false, false, 0, 1},      {"deg", false, false, 0, 1},
               {"", false, false, 0, 1},       {"3 miles", false, false, 0, 1}, {"3kmm", false, false, 0, 1},
               {"3degkm", false, false, 0, 1}};
  (void)state;
  mpq_t got, want;
  mpq_inits(got, want, NULL);
  for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
    bool ground = !tries[k].ground;
    dyd_status st = dyd_radius_parse(got, &ground, tries[k].text, strlen(tries[k].text));
    assert_int_equal(st, tries[k].good ? DYD_OK : DYD_E_ARG);
    if (!tries[k].good) continue;
    mpq_set_ui(want, tries[k].num, tries[k].den);
    assert_true(mpq_equal(got, want) && ground == tries[k].ground);
  }
  mpq_clears(got, want, NULL);
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
  mpq_t angle;
  size_t poles = 0;
  (void)state;
  dyd_spot_init(&s);
  mpq_init(angle);
  for (int k = 0; k < 2000; k++) {
    double lat = nearbyint(176 * test_unit(&r) - 88), half_lat = test_chance(&r, 2) ? 0 : ldexp(test_unit(&r), -2),
           half_lon = test_chance(&r, 2) ? 0 : test_unit(&r), a = ldexp(test_unit(&r), -(int)test_below(&r, 20));
    set_spot(&s, 30, lat, half_lon, half_lat);
    mpq_set_d(angle, a);
    dyd_spot_widen(&s, angle);
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
  mpq_clear(angle);
  dyd_spot_clear(&s);
}

/* ---- circles ---- */

static void vector_of(long double v[3], double lon, double lat) {
  v[0] = cosl(lat * degree) * cosl(lon * degree);
  v[1] = cosl(lat * degree) * sinl(lon * degree);
  v[2] = sinl(lat * degree);
}

/* Of vectors from the first: 0 iff the four are on one circle; not small otherwise, whole multiples of 15 degrees. */
static bool on_one_circle(const double lon[4], const double lat[4]) {
  long double v[4][3], w[3][3];
  for (int k = 0; k < 4; k++) vector_of(v[k], lon[k], lat[k]);
  for (int k = 0; k < 3; k++)
    for (int a = 0; a < 3; a++) w[k][a] = v[k + 1][a] - v[0][a];
  long double det = w[0][0] * (w[1][1] * w[2][2] - w[1][2] * w[2][1]) -
                    w[0][1] * (w[1][0] * w[2][2] - w[1][2] * w[2][0]) +
                    w[0][2] * (w[1][0] * w[2][1] - w[1][1] * w[2][0]);
  assert_true(fabsl(det) < 1e-16L || fabsl(det) > 1e-9L);
  return fabsl(det) < 1e-16L;
}

static dyd_sphere *sphere_of(dyd_engine **e, size_t n, const double *lon, const double *lat,
                             const dyd_sphere_options *o) {
  dyd_sphere *s;
  dyd_error err;
  assert_int_equal(dyd_engine_new(e), DYD_OK);
  assert_int_equal(dyd_engine_add_points(*e, n, lon, lat), DYD_OK);
  assert_int_equal(dyd_sphere_new(&s, *e, o, &err), DYD_OK);
  return s;
}

/* Four places, or three and the centre: proved as they are. */
static void test_circles(void **state) {
  (void)state;
  test_random r = test_random_start("circles of four places");
  size_t on = 0, by_centre = 0;
  for (int k = 0; k < 20000; k++) {
    dyd_engine *e;
    double lon[5] = {test_chance(&r, 2) ? 7 : 15 * (double)test_between(&r, -12, 11)},
           lat[5] = {15 * (double)test_between(&r, -5, 5)};
    int few = (int)test_between(&r, 1, 24);
    for (int i = 1; i < 5; i++)
      lon[i] = 15 * (double)(test_between(&r, 0, few) - 12), lat[i] = 15 * (double)test_between(&r, -6, 6);
    const char *radius = k % 4 ? NULL : k % 8 ? "1m" : "1/1000"; /* then none is surely on a circle with others */
    const dyd_sphere_options o = {DYD_SIZED(dyd_sphere_options), .radius = radius, .centre_set = true, .centre = 0};
    dyd_sphere *s = sphere_of(&e, 5, lon, lat, &o);
    const uint32_t site[] = {0, 1, 2, 3};
    bool apart = true, proved, line = lon[0] != 7 && k % 2;
    for (uint32_t i = 0; i < 5; i++) apart = apart && dyd_sphere_alias(s, i) == i;
    if (apart) {
      assert_int_equal(dyd_sphere_prove(&proved, s, line ? DYD_COLLINEAR : DYD_COCIRCULAR, site, line ? 3 : 4, NULL),
                       DYD_OK);
      assert_int_equal(proved, !radius && on_one_circle(line ? lon : lon + 1, line ? lat : lat + 1));
      on += proved && !line, by_centre += proved && line;
      assert_int_equal(dyd_sphere_prove(&proved, s, DYD_COINCIDENT, site, 2, NULL), DYD_OK);
      assert_false(proved);
    }
    dyd_sphere_free(s);
    dyd_engine_free(e);
  }
  print_message("%zu circles, %zu with the centre\n", on, by_centre);
  assert_true(on > 100 && by_centre > 15);
}

/* ---- within radii ---- */

enum { MOST = 12 };

typedef struct globe {
  size_t n;
  double lon[MOST], lat[MOST];
} globe;

typedef struct answer {
  dyd_engine *e;
  dyd_sphere *s;
  dyd_pair_list pairs;
  dyd_triangle_list triangles;
  dyd_outcome outcome;
} answer;

static void ask(answer *a, const globe *g, const char *radius) {
  const dyd_sphere_options o = {DYD_SIZED(dyd_sphere_options), .radius = radius};
  dyd_error err;
  memset(a, 0, sizeof *a);
  a->s = sphere_of(&a->e, g->n, g->lon, g->lat, &o);
  assert_int_equal(dyd_sphere_pairs(&a->pairs, a->s), DYD_E_ARG); /* not before a run */
  assert_int_equal(dyd_sphere_faces(a->s), 0);
  assert_int_equal(dyd_sphere_run(&a->outcome, a->s, NULL, &err), DYD_OK);
  assert_int_equal(dyd_sphere_pairs(&a->pairs, a->s), DYD_OK);
  assert_int_equal(dyd_sphere_triangles(&a->triangles, a->s), DYD_OK);
}

static void forget(answer *a) {
  dyd_pair_list_clear(&a->pairs);
  dyd_triangle_list_clear(&a->triangles);
  dyd_sphere_free(a->s);
  dyd_engine_free(a->e);
}

static dyd_pair_status status_in(const answer *a, uint32_t i, uint32_t j) {
  for (size_t k = 0; k < a->pairs.count; k++)
    if (a->pairs.item[k].i == i && a->pairs.item[k].j == j) return a->pairs.item[k].status;
  return DYD_ILLEGAL;
}

/* Anywhere, about a pole, or across 180 degrees; `crowd`: each with another one near. */
static void scatter(globe *g, test_random *r, bool crowd) {
  int kind = (int)test_below(r, 3);
  g->n = 2 + test_below(r, MOST - 1);
  if (crowd) g->n &= ~(size_t)1;
  for (size_t i = 0; i < g->n; i++) {
    g->lon[i] = kind == 2 ? 170 + 20 * test_unit(r) : 360 * test_unit(r) - 180;
    g->lat[i] = kind == 0   ? (double)(asinl(2 * test_unit(r) - 1) / degree)
                : kind == 1 ? 90 - 30 * test_unit(r)
                            : 20 * test_unit(r) - 10;
    if (crowd && i % 2) g->lon[i] = g->lon[i - 1], g->lat[i] = g->lat[i - 1] - copysign(0.5, g->lat[i - 1]);
  }
}

/* Each at most so far away, some as far as possible. */
static void choose(globe *out, const globe *g, double metres, test_random *r) {
  *out = *g;
  for (size_t i = 0; i < g->n; i++) {
    long double lat = g->lat[i] * degree, way = 6.283185307L * test_unit(r),
                far = metres / earth * (test_chance(r, 2) ? 1 - 1e-9L : sqrtl(test_unit(r)));
    long double z = sinl(lat) * cosl(far) + cosl(lat) * sinl(far) * cosl(way);
    out->lon[i] = (double)(g->lon[i] + atan2l(sinl(way) * sinl(far) * cosl(lat), cosl(far) - sinl(lat) * z) / degree);
    out->lat[i] = (double)(asinl(z) / degree);
  }
}

static bool turn_within(double lo, double hi, const double box[2]) {
  for (int turn = -720; turn <= 720; turn += 360)
    if (box[0] <= lo + turn + 1e-9 && hi + turn - 1e-9 <= box[1]) return true;
  return false;
}

/* The vertex of a triangle of a choice: as far from all its corners; within the vertex stated, if it is. */
static void check_vertex(const answer *stated, const answer *exact, const globe *g, const dyd_triangle *t) {
  double box[4], wide[4];
  long double n[3], v[3], d[3] = {0};
  assert_int_equal(dyd_sphere_vertex(box, exact->s, t, NULL), DYD_OK);
  vector_of(n, (box[0] + box[1]) / 2, (box[2] + box[3]) / 2);
  for (int k = 0; k < 3; k++) {
    vector_of(v, g->lon[t->v[k]], g->lat[t->v[k]]);
    for (int a = 0; a < 3; a++) d[k] += n[a] * v[a];
  }
  assert_true(fabsl(d[0] - d[1]) < 1e-9L && fabsl(d[0] - d[2]) < 1e-9L && box[3] - box[2] < 1e-9);
  for (uint32_t i = 0; i < g->n; i++) { /* on the side that is empty */
    long double far = 0;
    vector_of(v, g->lon[i], g->lat[i]);
    for (int a = 0; a < 3; a++) far += n[a] * v[a];
    assert_true(far <= d[0] + 1e-9L);
  }
  for (size_t k = 0; k < stated->triangles.count; k++) {
    if (memcmp(stated->triangles.item[k].v, t->v, sizeof t->v) != 0) continue;
    assert_int_equal(dyd_sphere_vertex(wide, stated->s, t, NULL), DYD_OK);
    assert_true(wide[2] <= box[2] + 1e-9 && wide[3] >= box[3] - 1e-9 && turn_within(box[0], box[1], wide));
  }
}

/* What is stated is so for the choice. */
static void check_choice(const answer *stated, const globe *choice) {
  answer exact;
  ask(&exact, choice, NULL);
  for (size_t k = 0; k < stated->pairs.count; k++) {
    const dyd_pair *p = &stated->pairs.item[k];
    if (p->status == DYD_LEGAL) assert_int_equal(status_in(&exact, p->i, p->j), DYD_LEGAL);
  }
  for (size_t k = 0; k < exact.pairs.count; k++)
    assert_true(status_in(stated, exact.pairs.item[k].i, exact.pairs.item[k].j) != DYD_ILLEGAL);
  for (size_t k = 0; k < stated->triangles.count; k++) {
    bool found = false;
    for (size_t l = 0; l < exact.triangles.count; l++)
      found =
          found || !memcmp(exact.triangles.item[l].v, stated->triangles.item[k].v, sizeof stated->triangles.item->v);
    assert_true(found);
  }
  for (size_t k = 0; k < exact.triangles.count; k++) check_vertex(stated, &exact, choice, &exact.triangles.item[k]);
  forget(&exact);
}

/* Pairs sorted, the lower end first; each open one in a face, whose sites ascend; faces as many as are told. */
static void check_form(const answer *a) {
  size_t faces = dyd_sphere_faces(a->s), open = 0, within = 0, legal = 0;
  bool tie;
  dyd_index_list face = {0};
  for (size_t k = 0; k < a->pairs.count; k++) {
    const dyd_pair *p = &a->pairs.item[k], *q = k ? p - 1 : NULL;
    bool found = false;
    assert_true(p->i < p->j && (!q || q->i < p->i || (q->i == p->i && q->j < p->j)));
    legal += p->status == DYD_LEGAL;
    if (p->status == DYD_LEGAL) continue;
    open++;
    for (size_t f = 0; f < faces && !found; f++) {
      bool i = false, j = false;
      assert_int_equal(dyd_sphere_face(&face, &tie, a->s, f), DYD_OK);
      for (size_t l = 0; l < face.count; l++) {
        assert_true(!l || face.item[l - 1] < face.item[l]);
        i = i || face.item[l] == p->i, j = j || face.item[l] == p->j;
      }
      found = i && j;
      if (found) assert_true(!tie || p->status == DYD_TIE);
    }
    within += found;
  }
  assert_int_equal(within, open);
  assert_int_equal(a->outcome, legal == a->pairs.count ? DYD_OUTCOME_DECIDED : DYD_OUTCOME_FIXPOINT);
  assert_int_equal(dyd_sphere_outcome(a->s), a->outcome);
  assert_int_equal(dyd_sphere_face(&face, &tie, a->s, faces), DYD_E_ARG);
  dyd_index_list_clear(&face);
}

/* Where each is told to be: the circle's box. */
static void check_rects(const answer *a, const globe *choice) {
  dyd_rect r;
  double box[4], v[6];
  dyd_rect_init(&r);
  for (uint32_t i = 0; i < choice->n; i++) {
    long double at[3];
    assert_int_equal(dyd_sphere_rect(&r, a->s, i), DYD_OK);
    dyd_rect_get_d(box, &r);
    assert_true(box[2] <= choice->lat[i] + 1e-9 && choice->lat[i] - 1e-9 <= box[3]);
    assert_true(turn_within(choice->lon[i], choice->lon[i], box));
    assert_int_equal(dyd_sphere_vector(v, a->s, i, NULL), DYD_OK);
    vector_of(at, choice->lon[i], choice->lat[i]);
    for (int k = 0; k < 3; k++) assert_true(v[2 * k] <= at[k] + 1e-12L && at[k] - 1e-12L <= v[2 * k + 1]);
  }
  assert_int_equal(dyd_sphere_rect(&r, a->s, (uint32_t)choice->n), DYD_E_ARG);
  assert_int_equal(dyd_sphere_vector(v, a->s, (uint32_t)choice->n, NULL), DYD_E_ARG);
  dyd_rect_clear(&r);
}

/* Choices within radii never contradict; also where no place is apart from all others, so that none is the centre. */
static void test_choices(void **state) {
  (void)state;
  test_random r = test_random_start("choices within radii");
  size_t gaps = 0, open = 0, legal = 0;
  for (size_t k = 0; k < test_cases_all(120); k++) {
    static const struct {
      const char *text;
      double metres;
    } radii[] = {{"1km", 1000}, {"100km", 1e5}, {"30000m", 3e4}, {"300km", 3e5}};
    globe g, c;
    answer a;
    bool crowd = test_chance(&r, 2);
    int which = crowd ? 1 : (int)test_below(&r, 4);
    scatter(&g, &r, crowd);
    ask(&a, &g, radii[which].text);
    check_form(&a);
    gaps += dyd_sphere_centre(a.s) == DYD_NO_PLACE;
    for (size_t p = 0; p < a.pairs.count; p++) *(a.pairs.item[p].status == DYD_LEGAL ? &legal : &open) += 1;
    for (int l = 0; l < 4; l++) {
      choose(&c, &g, radii[which].metres, &r);
      check_choice(&a, &c);
      check_rects(&a, &c);
    }
    forget(&a);
  }
  print_message("%zu without a centre, %zu pairs legal, %zu open\n", gaps, legal, open);
  assert_true(gaps > 20 && open > 200 && legal > 500);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_units), cmocka_unit_test(test_spots),
                                     cmocka_unit_test(test_widened), cmocka_unit_test(test_circles),
                                     cmocka_unit_test(test_choices)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
