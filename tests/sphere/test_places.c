/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [SPH-1] [SPH-3] [SPH-4] [SPH-5] Circles of four places, choices within radii, boxes and streams. */
#include <setjmp.h>
#include <stdarg.h>

#include "sphere/state.h"
#include "support/random.h"
#include <cmocka.h>
#include <math.h>
#include <string.h>

static const long double degree = 0.017453292519943295769236907684886L;
static const double earth = 6371008.8;

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
  assert_int_equal(dyd_engine_add_points(*e, n, lon, lat, NULL), DYD_OK);
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
    const char *radius = k % 4 ? NULL : k % 8 ? "1m" : "1/1000deg"; /* then none is surely on a circle with others */
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
  double lon[MOST], lat[MOST], half[MOST]; /* boxes of degrees; half < 0: a stream, of sqrt(2) degrees more each way */
} globe;

typedef struct answer {
  dyd_engine *e;
  dyd_sphere *s;
  dyd_pair_list pairs;
  dyd_triangle_list triangles;
  dyd_outcome outcome;
} answer;

static void add_stream(dyd_engine *e, double lon, double lat) {
  dyd_stream *stream;
  dyd_real *x[2];
  for (int k = 0; k < 2; k++) {
    char text[60];
    int length = snprintf(text, sizeof text, "sqrt(2)+(%.17g)", k ? lat : lon);
    assert_int_equal(dyd_real_parse(&x[k], text, (size_t)length, NULL), DYD_OK);
  }
  assert_int_equal(dyd_stream_from_reals(&stream, x[0], x[1]), DYD_OK);
  assert_int_equal(dyd_engine_add_stream(e, stream, NULL), DYD_OK);
}

/* centre: DYD_NO_PLACE for any. */
static void ask_from(answer *a, const globe *g, const char *radius, uint32_t centre) {
  dyd_sphere_options o = {DYD_SIZED(dyd_sphere_options), .radius = radius};
  dyd_error err;
  memset(a, 0, sizeof *a);
  if (centre != DYD_NO_PLACE) o.centre_set = true, o.centre = centre;
  assert_int_equal(dyd_engine_new(&a->e), DYD_OK);
  for (size_t i = 0; i < g->n; i++) {
    double h = g->half[i], x0 = g->lon[i] - h, x1 = g->lon[i] + h, y0 = g->lat[i] - h, y1 = g->lat[i] + h;
    if (h < 0)
      add_stream(a->e, g->lon[i], g->lat[i]);
    else
      assert_int_equal(dyd_engine_add_boxes(a->e, 1, &x0, &x1, &y0, &y1, NULL), DYD_OK);
  }
  assert_int_equal(dyd_sphere_new(&a->s, a->e, &o, &err), DYD_OK);
  assert_int_equal(dyd_sphere_pairs(&a->pairs, a->s), DYD_E_ARG); /* not before a run */
  assert_int_equal(dyd_sphere_faces(a->s), 0);
  assert_int_equal(dyd_sphere_run(&a->outcome, a->s, NULL, &err), DYD_OK);
  assert_int_equal(dyd_sphere_pairs(&a->pairs, a->s), DYD_OK);
  assert_int_equal(dyd_sphere_triangles(&a->triangles, a->s), DYD_OK);
}

static void ask(answer *a, const globe *g, const char *radius) {
  ask_from(a, g, radius, DYD_NO_PLACE);
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
  *g = (globe){0};
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

/* Checks the statements for the choice. */
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

/* Pairs sorted, the lower end first; each open one in a face, whose sites ascend; their number is that reported. */
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

/* The box reported for each: that of the circle. */
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

/* Boxes, points and streams far from each other, seen from one of them, whichever: choices never contradict. */
static void test_sources(void **state) {
  (void)state;
  test_random r = test_random_start("boxes, points and streams");
  for (size_t k = 0; k < test_cases_all(100); k++) {
    globe g = {.n = 4 + test_below(&r, MOST - 3)}, c;
    answer a;
    double most = test_chance(&r, 3) ? 0 : 1;
    for (size_t i = 0; i < g.n; i++) {
      g.lon[i] = 360 * ((double)i + test_unit(&r) / 2) / (double)g.n - 180;
      g.lat[i] = 120 * test_unit(&r) - 60;
      g.half[i] = test_chance(&r, 2) ? 0 : test_chance(&r, 3) ? -1 : most * test_unit(&r);
    }
    ask_from(&a, &g, NULL, (uint32_t)test_below(&r, g.n));
    check_form(&a);
    for (int l = 0; l < 3; l++) {
      c = g;
      for (size_t i = 0; i < g.n; i++) {
        double h = g.half[i], more = sqrt(2);
        c.lon[i] += h < 0 ? more : h * (2 * test_unit(&r) - 1);
        c.lat[i] += h < 0 ? more : h * (2 * test_unit(&r) - 1);
        c.half[i] = 0;
      }
      check_choice(&a, &c);
    }
    forget(&a);
  }
}

/* Three places about (lon, lat), `size` degrees away from it, each in a box of degrees, and one on the other side. */
static void set_triangle(globe *g, double lon, double lat, double size, double half, test_random *r) {
  double turn = 360 * test_unit(r), cos_lat = cos(lat * (double)degree);
  *g = (globe){.n = 4};
  for (int k = 0; k < 3; k++) {
    double way = (turn + 120 * k + 40 * test_unit(r)) * (double)degree;
    g->lat[k] = lat + size * sin(way);
    g->lon[k] = lon + size * cos(way) / cos_lat;
    g->half[k] = half;
  }
  g->lon[3] = lon - 180;
  g->lat[3] = -lat;
}

/* The boxes of vertices of triangles of all sizes hold those of choices, and are about as wide as those of corners. */
static void test_vertex_width(void **state) {
  (void)state;
  test_random r = test_random_start("widths of vertices");
  for (size_t k = 0; k < test_cases_all(200); k++) {
    double size = ldexp(5, -(int)test_below(&r, 16)), half = size / 64, lat = 140 * test_unit(&r) - 70, box[4];
    globe g, c;
    answer a;
    size_t seen = 0;
    set_triangle(&g, 400 * test_unit(&r) - 200, lat, size, half, &r);
    ask_from(&a, &g, NULL, 3);
    for (size_t t = 0; t < a.triangles.count; t++) {
      const uint32_t *v = a.triangles.item[t].v;
      if (v[0] == 3 || v[1] == 3 || v[2] == 3) continue;
      seen++;
      assert_int_equal(dyd_sphere_vertex(box, a.s, &a.triangles.item[t], NULL), DYD_OK);
      assert_true(box[3] - box[2] >= 2 * half && box[3] - box[2] <= 16 * half);
      assert_true(box[1] - box[0] >= 2 * half && (box[1] - box[0]) * cos(lat * (double)degree) <= 20 * half);
    }
    assert_int_equal(seen, 1);
    for (int l = 0; l < 4; l++) {
      c = g;
      for (int i = 0; i < 3; i++) {
        c.lon[i] += half * (double)test_between(&r, -1, 1);
        c.lat[i] += half * (double)test_between(&r, -1, 1);
        c.half[i] = 0;
      }
      check_choice(&a, &c);
    }
    forget(&a);
  }
}

/* Boxes that are wider one way than the other hold the vertices of their corners; exact places give the vertex to many
 * digits: as far from all three. */
static void test_vertex_corners(void **state) {
  (void)state;
  test_random r = test_random_start("vertices of corners");
  for (size_t k = 0; k < test_cases_all(200); k++) {
    double size = ldexp(5, -(int)test_below(&r, 10)), lat = 140 * test_unit(&r) - 70, box[4], one[4];
    double half[2] = {k % 2 ? 0 : size / 8 / cos(lat * (double)degree), k % 2 ? size / 8 : 0};
    const dyd_triangle corner = {{0, 1, 2}};
    globe g;
    set_triangle(&g, 400 * test_unit(&r) - 200, lat, size, 0, &r);
    for (int l = 0; l < 9; l++) { /* all, then each of their corners */
      double x0[4], x1[4], y0[4], y1[4];
      dyd_engine *e;
      dyd_sphere *s;
      for (int i = 0; i < 4; i++) {
        double end = i == 3 ? 0 : (l - 1) >> i & 1 ? 1 : -1, dx = end * half[0], dy = end * half[1];
        x0[i] = g.lon[i] - (l ? -dx : fabs(dx)), x1[i] = l ? x0[i] : g.lon[i] + fabs(dx);
        y0[i] = g.lat[i] - (l ? -dy : fabs(dy)), y1[i] = l ? y0[i] : g.lat[i] + fabs(dy);
      }
      assert_int_equal(dyd_engine_new(&e), DYD_OK);
      assert_int_equal(dyd_engine_add_boxes(e, 4, x0, x1, y0, y1, NULL), DYD_OK);
      assert_int_equal(dyd_sphere_new(&s, e, NULL, NULL), DYD_OK);
      assert_int_equal(dyd_sphere_vertex(l ? one : box, s, &corner, NULL), DYD_OK);
      dyd_sphere_free(s);
      dyd_engine_free(e);
      if (!l) continue;
      long double n[3], v[3], d[3] = {0};
      assert_true(one[1] - one[0] < 1e-12 && one[3] - one[2] < 1e-12);
      vector_of(n, one[0] / 2 + one[1] / 2, one[2] / 2 + one[3] / 2);
      for (int i = 0; i < 3; i++) {
        vector_of(v, x0[i], y0[i]);
        for (int a = 0; a < 3; a++) d[i] += (n[a] - v[a]) * (n[a] - v[a]);
      }
      for (int i = 1; i < 3; i++) assert_true(fabsl(sqrtl(d[i]) - sqrtl(d[0])) < 1e-13L);
      assert_true(box[2] <= one[2] && one[3] <= box[3] && turn_within(one[0] + 2e-9, one[1] - 2e-9, box));
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_circles), cmocka_unit_test(test_choices),
                                     cmocka_unit_test(test_sources), cmocka_unit_test(test_vertex_width),
                                     cmocka_unit_test(test_vertex_corners)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
