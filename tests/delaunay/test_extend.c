/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points added to an engine that has a result: piece by piece, in random order, against all at once [LOC-5]. Grids,
 * circles, hulls with many points on a line, equal points, points far outside; rectangles and fractions among them.
 * The armed build checks each mesh. Then with memory that ends. */
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
  dyd_index_list hull[4] = {{0}};
  assert_int_equal(dyd_delaunay_triangles(&s, &beyond[0], a, 0), DYD_OK);
  assert_int_equal(dyd_delaunay_triangles(&t, &beyond[1], b, 0), DYD_OK);
  assert_int_equal(s.count, t.count);
  assert_true(!s.count || memcmp(s.item, t.item, s.count * sizeof *s.item) == 0);
  assert_true(!s.count || memcmp(beyond[0].item, beyond[1].item, s.count * sizeof *s.item) == 0);
  assert_int_equal(dyd_delaunay_hull_vertices(&hull[0], &hull[1], a), DYD_OK);
  assert_int_equal(dyd_delaunay_hull_vertices(&hull[2], &hull[3], b), DYD_OK);
  for (int k = 0; k < 2; k++) {
    assert_int_equal(hull[k].count, hull[k + 2].count);
    assert_true(!hull[k].count || memcmp(hull[k].item, hull[k + 2].item, hull[k].count * sizeof *hull[k].item) == 0);
  }
  for (int k = 0; k < 4; k++) dyd_index_list_clear(&hull[k]);
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

static void add(dyd_engine *e, size_t count, const double *x, const double *y, bool wide) {
  double x1 = *x + 0.25, y1 = *y + 0.5;
  dyd_status st = wide ? dyd_engine_add_boxes(e, 1, x, &x1, y, &y1, NULL) : dyd_engine_add_points(e, count, x, y, NULL);
  assert_int_equal(st, DYD_OK);
}

/* wide: the number of a rectangle among the points; MOST: none. */
static void run_case(size_t kind, size_t wide) {
  double x[MOST], y[MOST];
  size_t n = 4 + test_below(&source, MOST - 4), at = 1 + test_below(&source, n);
  dyd_engine *e, *all;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  for (size_t k = 0; k < n; k++) place(&x[k], &y[k], kind);
  for (size_t k = 0; k < at; k++) add(e, 1, &x[k], &y[k], k == wide);
  run(e);
  while (at < n) {
    size_t count = 1 + test_below(&source, 4);
    if (count > n - at) count = n - at;
    if (wide >= at && wide < at + count) count = 1;
    add(e, count, &x[at], &y[at], at == wide);
    at += count;
    if (test_below(&source, 4)) run(e); /* else points come twice before a run */
    if (at < n && test_below(&source, 4)) continue;
    run(e);
    assert_int_equal(dyd_engine_new(&all), DYD_OK);
    for (size_t k = 0; k < at; k++) add(all, 1, &x[k], &y[k], k == wide);
    run(all);
    same(e, all);
    dyd_engine_free(all);
  }
  dyd_engine_free(e);
}

static void test_pieces(void **state) {
  (void)state;
  for (size_t k = 0; k < test_cases(600); k++) run_case(k % KINDS, k % 5 ? MOST : test_below(&source, MOST));
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
    if (step[k]) add(e, step[k], x + at, y + at, false);
    run(e);
    assert_int_equal(dyd_engine_new(&all), DYD_OK);
    add(all, at + step[k], x, y, false);
    run(all);
    same_pairs(dyd_engine_delaunay(e), dyd_engine_delaunay(all));
    same_triangles(dyd_engine_delaunay(e), dyd_engine_delaunay(all));
    dyd_engine_free(all);
  }
  dyd_engine_free(e);
}

/* Where memory ends, the run says so, or does without; the next one is right. */
static void test_memory(void **state) {
  (void)state;
  const double x[] = {0, 4, 0, 4, 2, 2, 1, 7}, y[] = {0, 0, 4, 4, 2, 9, 1, 7};
  dyd_engine *all;
  bool over = false;
  assert_int_equal(dyd_engine_new(&all), DYD_OK);
  add(all, 8, x, y, false);
  run(all);
  for (size_t k = 1; !over; k++) {
    dyd_engine *e;
    dyd_outcome outcome;
    assert_int_equal(dyd_engine_new(&e), DYD_OK);
    add(e, 4, x, y, false);
    run(e);
    add(e, 4, x + 4, y + 4, false);
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_pieces), cmocka_unit_test(test_many),
                                     cmocka_unit_test(test_memory)};
  source = test_random_start("extend");
  return cmocka_run_group_tests(tests, NULL, NULL);
}
