/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* All configurations on a tiny grid, in a shuffled order of which a part is run: the n rectangles with corners on
 * {0,1,2}^2 (36 each), and the points of a 3 by 3 and a 4 by 4 grid, with repeats [COV-1] [CLO-1] [CLO-2] [LINE-1]
 * [TIE-1] [HUL-1] [HUL-2] [FLT-SMALL] [FIX-1]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include <cmocka.h>
#include <string.h>

static harness shared;

static bool check(char *message, harness *h, const orc_case *c) {
  orc_table t;
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  orc_statuses(&t, &h->pool, c);
  bool good = pd && same_as_oracle(message, h, c, &t, pd) && queries_agree(message, c, pd) &&
              triangles_right(message, &h->pool, c, pd) && witnesses_hold(message, &h->pool, c, pd);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  return good;
}

static void add_rectangle(orc_case *c, size_t v) {
  static const long side[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  orc_case_add(c, side[v % 6][0], side[v % 6][1], side[v / 6][0], side[v / 6][1], 1);
}

static void add_grid_point(orc_case *c, size_t v, size_t grid) {
  orc_case_add(c, (long)(v % grid), (long)(v % grid), (long)(v / grid), (long)(v / grid), 1);
}

/* Configuration number `index` of n sites, each one of `choices`; grid = 0: rectangles. */
static void configuration(orc_case *c, size_t index, size_t n, size_t choices, size_t grid) {
  c->n = 0;
  strcpy(c->kind, "tiny");
  for (size_t k = 0; k < n; k++, index /= choices) {
    if (grid)
      add_grid_point(c, index % choices, grid);
    else
      add_rectangle(c, index % choices);
  }
}

/* The indices 0, s, 2 s, ... modulo the number of configurations, for a step s prime to it. */
static void sweep(size_t n, size_t choices, size_t grid, size_t cases) {
  size_t total = 1;
  for (size_t k = 0; k < n; k++) total *= choices;
  if (cases > total) cases = total;
  orc_case c;
  orc_case_init(&c);
  uint64_t index = test_below(&shared.random, total);
  for (size_t k = 0; k < cases; k++, index = (index + 1000003) % total) {
    configuration(&c, (size_t)index, n, choices, grid);
    harness_run(&shared, &c, check);
  }
  orc_case_clear(&c);
}

static void test_three_rectangles(void **state) {
  (void)state;
  sweep(3, 36, 0, test_cases(1500));
}

static void test_four_rectangles(void **state) {
  (void)state;
  sweep(4, 36, 0, test_cases(1000));
}

static void test_five_rectangles(void **state) {
  (void)state;
  sweep(5, 36, 0, test_cases(300));
}

static void test_points(void **state) {
  (void)state;
  sweep(3, 9, 3, test_cases(729));
  sweep(4, 9, 3, test_cases(700));
  sweep(5, 16, 4, test_cases(500));
  sweep(6, 16, 4, test_cases(300));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_three_rectangles), cmocka_unit_test(test_four_rectangles),
                                     cmocka_unit_test(test_five_rectangles), cmocka_unit_test(test_points)};
  harness_init(&shared, "exhaustive");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
