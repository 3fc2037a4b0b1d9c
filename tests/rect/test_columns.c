/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Columns of doubles as points and as boxes: wherever they lie in memory, rounded outward to the next double only. */
#include <setjmp.h>
#include <stdarg.h>

#include "rect/sites_table.h"
#include "support/random.h"
#include <cmocka.h>
#include <dyadel/sites.h>
#include <float.h>
#include <math.h>
#include <string.h>

enum { MOST = 40 };

/* A double of any size: sums of two such are exact, lose a bit, or lose all of the smaller one. */
static double random_double(test_random *r) {
  static const int exps[] = {-1074, -1060, -1022, -60, -53, -1, 0, 0, 0, 0, 1, 53, 900, 1019};
  double x = test_chance(r, 3) ? (double)test_between(r, -9, 9) : test_unit(r) - 0.5;
  return ldexp(x, exps[test_below(r, sizeof exps / sizeof *exps)]);
}

/* side -1: is `end` the largest double <= x - by; 1: the smallest one >= x + by? */
static void assert_outward(double end, double x, double by, int side) {
  mpq_t want, got;
  mpq_inits(want, got, NULL);
  mpq_set_d(want, x);
  mpq_set_d(got, side * by);
  mpq_add(want, want, got);
  mpq_set_d(got, end);
  assert_true(side * mpq_cmp(got, want) >= 0);
  mpq_set_d(got, nextafter(end, -side * INFINITY));
  assert_true(side * mpq_cmp(got, want) < 0 || (end == 0 && mpq_sgn(want) == 0));
  assert_false(end == 0 && signbit(end));
  mpq_clears(want, got, NULL);
}

/* Puts doubles into bytes, `step` apart, not aligned. */
static dyd_column scatter(char *bytes, const double *from, size_t n, ptrdiff_t step) {
  char *first = bytes + (step < 0 ? (ptrdiff_t)(n - 1) * -step : 0);
  for (size_t k = 0; k < n; k++) memcpy(first + (ptrdiff_t)k * step, &from[k], sizeof *from);
  return (dyd_column){(const double *)(const void *)first, step};
}

static void test_boxes(void **state) {
  (void)state;
  test_random r = test_random_start("rect columns");
  for (size_t k = 0; k < test_cases(300); k++) {
    static char bytes[4][MOST * 40 + 8];
    double from[4][MOST], box[4 * MOST];
    dyd_column column[4];
    dyd_sites *s = NULL;
    size_t n = (size_t)test_between(&r, 1, MOST);
    bool points = test_chance(&r, 3), same = test_chance(&r, 2);
    for (int c = 0; c < 4; c++) {
      for (size_t i = 0; i < n; i++) from[c][i] = c < 2 ? random_double(&r) : fabs(from[c - 2][i] / (double)(i + 1));
      ptrdiff_t step = (c < 2 || !same ? 1 : 0) * test_between(&r, 8, 40) * (test_chance(&r, 2) ? 1 : -1);
      if (!step) from[c][0] = 0.3;
      column[c] = scatter(bytes[c] + test_between(&r, 0, 7), from[c], step ? n : 1, step);
    }
    assert_int_equal(DYD_OK, dyd_sites_new(&s));
    assert_int_equal(DYD_OK, dyd_sites_add_points(s, 1, from[0], from[1]));
    assert_int_equal(DYD_OK, dyd_sites_add_columns(s, n, column, points ? NULL : column + 2));
    assert_int_equal(n + 1, dyd_sites_count(s));
    for (size_t i = 0; i < n; i++) {
      dyd_sites_get_d(box + 4 * i, s, i + 1);
      for (int e = 0; e < 4; e++) {
        double by = points ? 0 : from[2 + e / 2][same ? 0 : i];
        assert_outward(box[4 * i + (size_t)e], from[e / 2][i], by, e % 2 ? 1 : -1);
      }
    }
    dyd_sites_free(s);
  }
}

static void test_refused(void **state) {
  (void)state;
  const double good[3] = {0, 1, 2}, bad[3] = {0, NAN, 2}, large[3] = {0, 0, DBL_MAX}, minus[3] = {1, 1, -DBL_MIN};
  const dyd_column fine[2] = {{good, 8}, {good, 8}}, wrong[2] = {{good, 8}, {bad, 8}}, far[2] = {{large, 8}, {good, 8}},
                   none[2] = {{good, 8}, {minus, 8}};
  dyd_sites *s = NULL;
  double e[4];
  assert_int_equal(DYD_OK, dyd_sites_new(&s));
  assert_int_equal(DYD_E_ARG, dyd_sites_add_columns(s, 3, wrong, NULL));
  assert_int_equal(DYD_E_ARG, dyd_sites_add_columns(s, 3, fine, wrong));
  assert_int_equal(DYD_E_ARG, dyd_sites_add_columns(s, 3, fine, none));
  assert_int_equal(DYD_E_ARG, dyd_sites_add_columns(s, 3, far, far));
  assert_int_equal(0, dyd_sites_count(s));
  assert_int_equal(DYD_E_ARG, dyd_sites_add_columns(s, 3, far, fine)); /* beyond the largest double, by 2 */
  const double none_at_all = 0;
  const dyd_column zero[2] = {{&none_at_all, 0}, {&none_at_all, 0}};
  assert_int_equal(DYD_OK, dyd_sites_add_columns(s, 3, far, zero));
  dyd_sites_get_d(e, s, 2);
  assert_true(e[0] == DBL_MAX && e[1] == DBL_MAX);
  dyd_sites_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_boxes), cmocka_unit_test(test_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
