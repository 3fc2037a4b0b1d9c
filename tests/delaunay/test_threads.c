/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Whatever the number of threads: the same pairs, the same counters, triangle by triangle the same skeleton. The verify
 * build cuts short loops, too, so that small cases meet many ranges. Made for a run under the thread sanitizer as well.
 */
#include <setjmp.h>
#include <stdarg.h>

#include "base/parallel.h"
#include "delaunay/state.h"
#include "support/random.h"

#include <cmocka.h>
#include <math.h>
#include <string.h>

static test_random shared;

/* ---- dyd_parallel ---- */

enum { TASKS = 1000 };

static void note(void *context, size_t number) {
  unsigned *done = context;
  done[number]++;
}

static void test_each_once(void **state) {
  (void)state;
  for (unsigned threads = 0; threads < 100; threads = threads < 5 ? threads + 1 : threads * 3)
    for (size_t tasks = 0; tasks <= TASKS; tasks = tasks < 4 ? tasks + 1 : tasks * 5) {
      unsigned done[TASKS + 1] = {0};
      dyd_parallel(threads, tasks, note, done);
      for (size_t k = 0; k <= TASKS; k++) assert_int_equal(done[k], k < tasks);
    }
}

static void test_ranges_cover(void **state) {
  (void)state;
  for (size_t n = 0; n < 3000000; n = n < 700 ? n + 1 : n * 3 + 1) {
    assert_int_equal(dyd_range_begin(n, 0), 0);
    assert_in_range(dyd_ranges(n), 1, DYD_RANGES_MOST);
    for (size_t r = 0; r < dyd_ranges(n); r++) assert_true(dyd_range_begin(n, r) <= dyd_range_begin(n, r + 1));
    assert_int_equal(dyd_range_begin(n, dyd_ranges(n)), n);
  }
}

/* ---- the engine ---- */

typedef struct cloud {
  size_t n;
  double lo[2][1200], hi[2][1200];
} cloud;

static cloud boxes;

/* Corners on a grid of `grid` steps or anywhere; half-widths up to `width`, one in `fat` ten times as wide. */
static void fill(size_t n, unsigned grid, double width, unsigned fat) {
  boxes.n = n;
  for (size_t i = 0; i < n; i++) {
    double w = width * (fat && test_chance(&shared, fat) ? 10 : 1);
    for (int a = 0; a < 2; a++) {
      double c = grid ? (double)test_below(&shared, grid) : 16 * test_unit(&shared);
      boxes.lo[a][i] = c - w * test_unit(&shared);
      boxes.hi[a][i] = c + w * test_unit(&shared);
    }
  }
}

static dyd_sites *make_sites(void) {
  dyd_sites *s = NULL;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  assert_int_equal(dyd_sites_add_boxes(s, boxes.n, boxes.lo[0], boxes.hi[0], boxes.lo[1], boxes.hi[1]), DYD_OK);
  return s;
}

static void narrow(dyd_sites *s, uint32_t i) {
  dyd_rect r;
  dyd_rect_init(&r);
  double lo[2] = {boxes.lo[0][i], boxes.lo[1][i]}, hi[2] = {boxes.hi[0][i], boxes.hi[1][i]};
  for (int a = 0; a < 2; a++) lo[a] += (hi[a] - lo[a]) / 2;
  assert_int_equal(dyd_rect_set_d(&r, lo[0], hi[0], lo[1], hi[1]), DYD_OK);
  assert_int_equal(dyd_sites_narrow(s, i, &r), DYD_OK);
  dyd_rect_clear(&r);
}

static void compare(const dyd_delaunay *a, const dyd_delaunay *b) {
  dyd_pair_list p = {0}, q = {0};
  dyd_delaunay_counters c = {DYD_SIZED(dyd_delaunay_counters)}, d = c;
  const dyd_skeleton *x = &a->sk, *y = &b->sk;
  assert_int_equal(x->mesh.count, y->mesh.count);
  assert_memory_equal(x->certain, y->certain, x->mesh.count);
  if (x->mesh.count) assert_memory_equal(x->mesh.tri, y->mesh.tri, x->mesh.count * sizeof *x->mesh.tri);
  assert_memory_equal(x->leaving, y->leaving, x->n * sizeof *x->leaving);
  assert_int_equal(dyd_delaunay_pairs(&p, a), DYD_OK);
  assert_int_equal(dyd_delaunay_pairs(&q, b), DYD_OK);
  assert_int_equal(p.count, q.count);
  for (size_t k = 0; k < p.count; k++)
    assert_true(p.item[k].i == q.item[k].i && p.item[k].j == q.item[k].j && p.item[k].status == q.item[k].status);
  dyd_delaunay_get_counters(&c, a, NULL);
  dyd_delaunay_get_counters(&d, b, NULL);
  assert_memory_equal(&c, &d, sizeof c);
  dyd_pair_list_clear(&q);
  dyd_pair_list_clear(&p);
}

static void one_case(bool no_filter) {
  static const unsigned counts[] = {2, 3, 8};
  dyd_sites *s = make_sites(), *t = make_sites();
  dyd_delaunay *one = NULL, *many = NULL;
  dyd_delaunay_options alone = {DYD_SIZED(dyd_delaunay_options), .threads = 1, .no_filter = no_filter};
  dyd_delaunay_options together = {DYD_SIZED(dyd_delaunay_options), .threads = counts[test_below(&shared, 3)],
                                   .no_filter = no_filter};
  uint32_t changed[12];
  assert_int_equal(dyd_delaunay_new(&one, s, &alone, NULL), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&many, t, &together, NULL), DYD_OK);
  compare(one, many);
  for (unsigned k = 0; k < 12; k++) {
    changed[k] = (uint32_t)test_below(&shared, boxes.n);
    narrow(s, changed[k]);
    narrow(t, changed[k]);
  }
  assert_int_equal(dyd_delaunay_update(one, changed, 12, &alone, NULL), DYD_OK);
  assert_int_equal(dyd_delaunay_update(many, changed, 12, &together, NULL), DYD_OK);
  compare(one, many);
  dyd_delaunay_free(many);
  dyd_delaunay_free(one);
  dyd_sites_free(t);
  dyd_sites_free(s);
}

static void test_same_statements(void **state) {
  (void)state;
  static const double widths[] = {0, 0x1p-40, 1e-3, 0.02};
  for (size_t q = 0; q < test_cases(60); q++) {
    size_t n = 20 + test_below(&shared, q % 12 == 0 ? 1000 : 150);
    fill(n, test_chance(&shared, 3) ? 6 + (unsigned)test_below(&shared, 30) : 0, widths[q % 4], (unsigned)(q % 3) * 9);
    one_case(q % 10 == 9 && n < 120);
  }
}

int main(void) {
  shared = test_random_start("threads");
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_once), cmocka_unit_test(test_ranges_cover),
                                     cmocka_unit_test(test_same_statements)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
