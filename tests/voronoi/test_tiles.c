/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyd_voronoi_tiles: arrays as the contract says [PART-1]; the k-th allocation fails, for every k; a refused call
 * leaves the output unchanged. That tiles are cells: tests/cli/test_tiles.py. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include "support/failing_memory.h"
#include <cmocka.h>
#include <dyadel/dyadel.h>
#include <dyadel/metric.h>
#include <math.h>

enum { POINTS, BOXES, STRIPS, KINDS = STRIPS + 60 };

/* A cluster with coincident points and boxes; or points so near on a slanted line that cells are as thin as the grid.
 */
static dyd_sites *sites_of(int kind) {
  dyd_sites *s = NULL;
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  for (int k = 0; k < 14; k++) {
    double x = k * k % 7 / 8.0, y = k % 5 / 8.0, x1 = x + 0.25, y1 = y + 0.125;
    if (kind >= STRIPS && k < 11) { /* many steps, lengths and slopes */
      int m = kind - STRIPS, at = k * (1 + m % 3) + k * k % (1 + m % 4);
      x = ldexp(m * 7 % 11 - 5, -36 - m % 9) * at;
      y = ldexp(1 + m % 5, -36 - m % 9) * at + ldexp(k * m % 17, -60);
    }
    if (kind == BOXES)
      assert_int_equal(dyd_sites_add_boxes(s, 1, &x, &x1, &y, &y1), DYD_OK);
    else
      assert_int_equal(dyd_sites_add_points(s, 1, &x, &y), DYD_OK);
  }
  return s;
}

/* Rings are in order and inside the window, and their areas, in rationals, add up to that of the window. */
static void check_arrays(const dyd_tiles *t, const dyd_rect *window) {
  mpq_t sum, term, x;
  double w[4];
  mpq_inits(sum, term, x, NULL);
  dyd_rect_get_d(w, window);
  for (size_t r = 0; r < t->count; r++) {
    assert_true(r == 0 || t->site[r - 1] <= t->site[r]);
    assert_true(t->offset[r] + 3 <= t->offset[r + 1]);
    assert_true(t->bound[2 * r] <= t->bound[2 * r + 1] && t->area[r] > 0);
    for (size_t k = t->offset[r]; k < t->offset[r + 1]; k++) {
      const double *a = &t->xy[2 * k], *b = &t->xy[2 * (k + 1 < t->offset[r + 1] ? k + 1 : t->offset[r])];
      assert_true(w[0] <= a[0] && a[0] <= w[1] && w[2] <= a[1] && a[1] <= w[3]);
      mpq_set_d(term, a[0]);
      mpq_set_d(x, b[1]);
      mpq_mul(term, term, x);
      mpq_add(sum, sum, term);
      mpq_set_d(term, a[1]);
      mpq_set_d(x, b[0]);
      mpq_mul(term, term, x);
      mpq_sub(sum, sum, term);
    }
  }
  mpq_set_d(term, w[1] - w[0]);
  mpq_set_d(x, 2 * (w[3] - w[2])); /* both are exact */
  mpq_mul(term, term, x);
  assert_true(mpq_equal(sum, term));
  mpq_clears(sum, term, x, NULL);
}

static void test_partition(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    dyd_sites *s = sites_of(kind);
    dyd_delaunay *pd = NULL;
    dyd_tiles t = {0};
    dyd_rect window;
    dyd_rect_init(&window);
    assert_int_equal(dyd_rect_set_d(&window, -1, 2, -1.5, 2), DYD_OK);
    assert_int_equal(dyd_delaunay_new(&pd, s, NULL, NULL), DYD_OK);
    assert_int_equal(dyd_voronoi_tiles(&t, pd, &window, 8, NULL), DYD_OK);
    check_arrays(&t, &window);
    assert_true(kind >= STRIPS || t.count + t.coincident == dyd_sites_count(s));
    size_t count = t.count;
    int cancel = 1;
    assert_int_equal(dyd_voronoi_tiles(&t, pd, &window, 8, &cancel), DYD_CANCELLED);
    assert_int_equal(dyd_voronoi_tiles(&t, pd, NULL, 8, NULL), DYD_E_ARG);
    assert_int_equal(dyd_voronoi_tiles(&t, NULL, &window, 8, NULL), DYD_E_ARG);
    assert_int_equal(dyd_voronoi_tiles(NULL, pd, &window, 8, NULL), DYD_E_ARG);
    dyd_rect_set_d(&window, 0x1p60, 0x1p60 + 0x1p8, 0, 1);
    assert_int_equal(dyd_voronoi_tiles(&t, pd, &window, 8, NULL), DYD_E_RANGE);
    assert_true(t.count == count);
    dyd_tiles_clear(&t);
    assert_true(!t.count && !t.xy);
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
    dyd_rect_clear(&window);
  }
}

static void test_no_memory(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    dyd_sites *s = sites_of(kind);
    dyd_delaunay *pd = NULL;
    dyd_rect window;
    bool over = false;
    dyd_rect_init(&window);
    assert_int_equal(dyd_rect_set_d(&window, -1, 2, -1.5, 2), DYD_OK);
    assert_int_equal(dyd_delaunay_new(&pd, s, NULL, NULL), DYD_OK);
    for (size_t k = 1; !over; k++) {
      dyd_tiles t = {0};
      countdown = k;
      dyd_status st = dyd_voronoi_tiles(&t, pd, &window, 2, NULL);
      over = countdown > 0;
      countdown = 0;
      assert_true(st == DYD_E_NOMEM || st == DYD_OK); /* some filters do without */
      if (st == DYD_OK) check_arrays(&t, &window);
      assert_true(st == DYD_OK || (!t.count && !t.site && !t.xy));
      assert_true(!over || st == DYD_OK);
      dyd_tiles_clear(&t);
    }
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
    dyd_rect_clear(&window);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_partition), cmocka_unit_test(test_no_memory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
