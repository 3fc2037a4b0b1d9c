/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points added to an engine that has a result: piece by piece, in random order, against all at once [LOC-5] [LOC-7].
 * Grids, circles, hulls with many points on a line, equal points, points far outside; rectangles and fractions among
 * them. The armed build checks each mesh. Then with memory that ends. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include "delaunay/state.h"
#include "support/failing_memory.h"
#include <cmocka.h>
#include <dyadel/dyadel.h>
#include <string.h>

enum { MOST = 60, KINDS = 6 };

static test_random source;

/* One of the 36 points of the circle of radius 65 about the origin. */
static void on_circle(double *x, double *y) {
  static const double leg[5][2] = {{65, 0}, {63, 16}, {60, 25}, {56, 33}, {52, 39}};
  size_t k = test_below(&source, 5), flip = test_below(&source, 8);
  *x = leg[k][flip & 1] * (flip & 2 ? 1 : -1);
  *y = leg[k][!(flip & 1)] * (flip & 4 ? 1 : -1);
}

static void place(double *x, double *y, size_t kind) {
  size_t side = kind == 0 ? 4 : 9;
  *x = (double)test_below(&source, side);
  *y = (double)test_below(&source, side);
  if (kind == 2) on_circle(x, y);
  if (kind == 3 && test_below(&source, 3)) *y = 0;
  if (kind == 4)
    *x += (double)test_below(&source, 1 << 20) / (1 << 20), *y += (double)test_below(&source, 1 << 20) / (1 << 20);
  if (kind == 5 && !test_below(&source, 4)) *x = *x * 1e9 - 4e9, *y *= 1e-9;
}

static void run(dyd_engine *e) {
  dyd_outcome outcome;
  assert_int_equal(dyd_engine_run(&outcome, e, NULL, NULL), DYD_OK);
}

/* Lists of both are the same, byte for byte. */
static void same_pairs(const dyd_delaunay *a, const dyd_delaunay *b) {
  dyd_pair_list p = {0}, q = {0};
  assert_int_equal(dyd_delaunay_pairs(&p, a), DYD_OK);
  assert_int_equal(dyd_delaunay_pairs(&q, b), DYD_OK);
  assert_int_equal(p.count, q.count);
  for (size_t k = 0; k < p.count; k++)
    assert_true(p.item[k].i == q.item[k].i && p.item[k].j == q.item[k].j && p.item[k].status == q.item[k].status);
  dyd_pair_list_clear(&p);
  dyd_pair_list_clear(&q);
  size_t count[2][4];
  dyd_delaunay_count(count[0], a);
  dyd_delaunay_count(count[1], b);
  assert_memory_equal(count[0], count[1], sizeof count[0]);
  assert_int_equal(dyd_delaunay_undecided_faces(a), dyd_delaunay_undecided_faces(b));
}

static void same_triangles(const dyd_delaunay *a, const dyd_delaunay *b) {
  dyd_triangle_list s = {0}, t = {0}, beyond[2] = {{0}};
  dyd_hull hull[2] = {{.pairs = {0}}};
  assert_int_equal(dyd_delaunay_triangles(&s, &beyond[0], a, 0), DYD_OK);
  assert_int_equal(dyd_delaunay_triangles(&t, &beyond[1], b, 0), DYD_OK);
  assert_int_equal(s.count, t.count);
  assert_true(!s.count || memcmp(s.item, t.item, s.count * sizeof *s.item) == 0);
  assert_true(!s.count || memcmp(beyond[0].item, beyond[1].item, s.count * sizeof *s.item) == 0);
  assert_int_equal(dyd_delaunay_partial_hull(&hull[0], a, false), DYD_OK);
  assert_int_equal(dyd_delaunay_partial_hull(&hull[1], b, false), DYD_OK);
  for (int k = 0; k < 2; k++) {
    const dyd_index_list *p = k ? &hull[0].sure_vertices : &hull[0].possible_vertices;
    const dyd_index_list *q = k ? &hull[1].sure_vertices : &hull[1].possible_vertices;
    assert_int_equal(p->count, q->count);
    assert_true(!p->count || memcmp(p->item, q->item, p->count * sizeof *p->item) == 0);
  }
  for (int k = 0; k < 2; k++) dyd_hull_clear(&hull[k]);
  for (int k = 0; k < 2; k++) dyd_triangle_list_clear(&beyond[k]);
  dyd_triangle_list_clear(&s);
  dyd_triangle_list_clear(&t);
}

static void same(const dyd_engine *a, const dyd_engine *b) {
  const dyd_delaunay *p = dyd_engine_delaunay(a), *q = dyd_engine_delaunay(b);
  for (uint32_t k = 0; k < dyd_engine_count(a); k++) {
    assert_int_equal(dyd_delaunay_alias(p, k), dyd_delaunay_alias(q, k));
    const double at[4] = {(double)k, (double)k, 0.5, 0.5};
    dyd_rect r;
    dyd_index_list s = {0}, t = {0};
    bool sure[2];
    dyd_rect_init(&r);
    dyd_rect_set_d(&r, at[0], at[1], at[2], at[3]);
    assert_int_equal(dyd_nearest(&s, &sure[0], p, &r), DYD_OK);
    assert_int_equal(dyd_nearest(&t, &sure[1], q, &r), DYD_OK);
    assert_true(s.count == t.count && memcmp(s.item, t.item, s.count * sizeof *s.item) == 0);
    dyd_rect_clear(&r);
    dyd_index_list_clear(&s);
    dyd_index_list_clear(&t);
  }
  same_pairs(p, q);
  same_triangles(p, q);
}

static void add(dyd_engine *e, size_t count, const double *x, const double *y) {
  assert_int_equal(dyd_engine_add_points(e, count, x, y, NULL), DYD_OK);
}

/* A rectangle, of a third of width: doubles do not hold its ends. */
static void add_third(dyd_engine *e, double x, double y, double width) {
  mpq_t q[4];
  dyd_rect r;
  dyd_rect_init(&r);
  for (int k = 0; k < 4; k++) {
    mpq_init(q[k]);
    mpq_set_d(q[k], k < 2 ? x : y);
    if (k % 2) mpq_set_d(q[k], (k < 2 ? x : y) + width);
    mpz_mul_ui(mpq_denref(q[k]), mpq_denref(q[k]), 3);
    mpq_canonicalize(q[k]);
  }
  assert_int_equal(dyd_rect_narrow_q(&r, (const mpq_t *)q, NULL), DYD_OK);
  assert_int_equal(dyd_engine_add_rect(e, &r, NULL), DYD_OK);
  for (int k = 0; k < 4; k++) mpq_clear(q[k]);
  dyd_rect_clear(&r);
}

/* count places; each a point where width[k] is 0, else a rectangle; below 0: of thirds. */
static void add_places(dyd_engine *e, size_t count, const double *x, const double *y, const double *width) {
  for (size_t k = 0; k < count; k++) {
    double x1 = x[k] + width[k], y1 = y[k] + 2 * width[k];
    if (width[k] < 0)
      add_third(e, x[k], y[k], -3 * width[k]);
    else
      assert_int_equal(dyd_engine_add_boxes(e, 1, x + k, &x1, y + k, &y1, NULL), DYD_OK);
  }
}

/* One place of `wide` has a width; 0: none. */
static double draw_width(size_t wide) {
  static const double width[] = {1e-9, 1.0 / 64, 0.25, 0.25, 1, -0.25, -1e-6};
  return wide && !test_below(&source, wide) ? width[test_below(&source, sizeof width / sizeof *width)] : 0;
}

/* One of the rectangles is measured again, and is half as wide and high. */
static void narrow(dyd_engine *e, size_t count, const double *x, const double *y, double *width) {
  size_t k = test_below(&source, count);
  dyd_rect r;
  if (width[k] <= 0) return;
  width[k] /= 2;
  dyd_rect_init(&r);
  dyd_rect_set_d(&r, x[k], x[k] + width[k], y[k], y[k] + 2 * width[k]);
  assert_int_equal(dyd_engine_remeasure(e, (uint32_t)k, &r, NULL), DYD_OK);
  dyd_rect_clear(&r);
}

static size_t kept;

static void run_case(size_t kind, size_t wide) {
  double x[MOST], y[MOST], width[MOST];
  size_t n = 4 + test_below(&source, MOST - 4), at = 1 + test_below(&source, n);
  dyd_engine *e, *all;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  for (size_t k = 0; k < n; k++) place(&x[k], &y[k], kind);
  for (size_t k = 0; k < n; k++) width[k] = draw_width(wide);
  add_places(e, at, x, y, width);
  run(e);
  while (at < n) {
    const dyd_delaunay *before = dyd_engine_delaunay(e);
    size_t count = 1 + test_below(&source, 4);
    if (count > n - at) count = n - at;
    if (!test_below(&source, 4)) narrow(e, at, x, y, width);
    add_places(e, count, &x[at], &y[at], &width[at]);
    at += count;
    if (!test_below(&source, 8)) narrow(e, at, x, y, width);
    if (test_below(&source, 4)) run(e); /* else points come twice before a run */
    kept += wide && dyd_engine_delaunay(e) == before;
    if (at < n && test_below(&source, 4)) continue;
    run(e);
    assert_int_equal(dyd_engine_new(&all), DYD_OK);
    add_places(all, at, x, y, width);
    run(all);
    same(e, all);
    dyd_engine_free(all);
  }
  dyd_engine_free(e);
}

static void test_pieces(void **state) {
  (void)state;
  static const size_t wide[] = {0, 1, 1, 2, 8, 30};
  const size_t cases = test_cases(900);
  for (size_t k = 0; k < cases; k++) run_case(k % KINDS, wide[k / KINDS % (sizeof wide / sizeof *wide)]);
  assert_true(kept > cases);
}

/* A point far outside of many, whose hull it replaces; more points than are put in one by one; none at all. */
static void test_many(void **state) {
  (void)state;
  enum { N = 4000 };
  static double x[N + 2], y[N + 2];
  dyd_engine *e, *all;
  for (size_t k = 0; k < N; k++) x[k] = (double)(k % 64), y[k] = (double)(k / 64);
  x[N] = 1e6, y[N] = -3e5, x[N + 1] = 31.5, y[N + 1] = 30.5;
  const size_t step[] = {2000, 10, 0, 1500, N - 3510, 1, 1};
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  for (size_t k = 0, at = 0; k < sizeof step / sizeof *step; at += step[k++]) {
    if (step[k]) add(e, step[k], x + at, y + at);
    run(e);
    assert_int_equal(dyd_engine_new(&all), DYD_OK);
    add(all, at + step[k], x, y);
    run(all);
    same_pairs(dyd_engine_delaunay(e), dyd_engine_delaunay(all));
    same_triangles(dyd_engine_delaunay(e), dyd_engine_delaunay(all));
    dyd_engine_free(all);
  }
  dyd_engine_free(e);
}

/* Where memory ends, the run says so, or does without; the next one is right. */
static void memory_case(const double *width) {
  const double x[] = {0, 4, 0, 4, 2, 2, 1, 7}, y[] = {0, 0, 4, 4, 2, 9, 1, 7};
  dyd_engine *all;
  bool over = false;
  assert_int_equal(dyd_engine_new(&all), DYD_OK);
  add_places(all, 8, x, y, width);
  run(all);
  for (size_t k = 1; !over; k++) {
    dyd_engine *e;
    dyd_outcome outcome;
    assert_int_equal(dyd_engine_new(&e), DYD_OK);
    add_places(e, 4, x, y, width);
    run(e);
    add_places(e, 4, x + 4, y + 4, width + 4);
    countdown = k;
    dyd_status st = dyd_engine_run(&outcome, e, NULL, NULL);
    over = countdown > 0;
    countdown = 0;
    assert_true(st == DYD_OK || (st == DYD_E_NOMEM && !over));
    run(e);
    same(e, all);
    dyd_engine_free(e);
  }
  dyd_engine_free(all);
}

static void test_memory(void **state) {
  (void)state;
  const double point[8] = {0}, wide[8] = {0, 0.5, 0.5, 0.5, 0.5, 0, 1, 0.5};
  memory_case(point);
  memory_case(wide);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_pieces), cmocka_unit_test(test_many),
                                     cmocka_unit_test(test_memory)};
  source = test_random_start("extend");
  return cmocka_run_group_tests(tests, NULL, NULL);
}
