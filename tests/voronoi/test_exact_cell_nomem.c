/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exhausted memory: the k-th allocation of a call fails, for every k. The call says so, leaks nothing (run under a leak
 * checker), leaves its output as it was, and can be repeated. Capped triangulations: outputs stay too. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include "support/failing_memory.h"
#include <cmocka.h>
#include <dyadel/voronoi.h>

enum { CALLS = 4 };

static dyd_status call(dyd_boundary *out, int which, const dyd_delaunay *pd, uint32_t i, const dyd_rect *w) {
  switch (which) {
  case 0:
    return dyd_voronoi_cell(out, pd, i, DYD_CELL_SURE, NULL);
  case 1:
    return dyd_voronoi_cell(out, pd, i, DYD_CELL_POSSIBLE, NULL);
  case 2:
    return dyd_voronoi_cell(out, pd, i, DYD_CELL_SURE, w);
  default:
    return dyd_voronoi_cell(out, pd, i, DYD_CELL_POSSIBLE, w);
  }
}

static size_t check_call(int which, const dyd_delaunay *pd, uint32_t i, const dyd_rect *w) {
  dyd_boundary b = {.whole = true};
  dyd_status status = DYD_E_NOMEM;
  size_t k = 0;
  while (status != DYD_OK) {
    countdown = ++k;
    status = call(&b, which, pd, i, w);
    bool over = countdown > 0;
    countdown = 0;
    assert_int_equal(status, over ? DYD_OK : DYD_E_NOMEM);
    if (!over) assert_true(b.whole && !b.count && !b.chain);
  }
  dyd_boundary_clear(&b);
  return k;
}

static void every_allocation(void **state) {
  (void)state;
  test_random r = test_random_start("exact nomem");
  orc_case c;
  orc_case_init(&c);
  dyd_rect w;
  dyd_rect_init(&w);
  size_t failures = 0;
  for (size_t n = 0; n < test_cases(8); n++) {
    orc_generate(&c, &r, (size_t)test_below(&r, ORC_KINDS), 6);
    char message[MESSAGE_SIZE] = "";
    dyd_sites *s = harness_sites(&c);
    dyd_delaunay *pd = harness_engine(message, s, NULL);
    assert_non_null(pd);
    assert_int_equal(dyd_rect_set_d(&w, 0, 1 + (double)test_below(&r, 20), 0, 5), DYD_OK);
    for (uint32_t i = 0; i < c.n; i++)
      for (int which = 0; which < CALLS; which++) failures += check_call(which, pd, i, &w) - 1;
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
  }
  assert_true(failures > 100);
  dyd_rect_clear(&w);
  orc_case_clear(&c);
}

/* Many neighbours, most of which are pruned beforehand. */
static void many_neighbours(void **state) {
  (void)state;
  static const long leg[5][2] = {{16, 63}, {25, 60}, {33, 56}, {39, 52}, {52, 39}};
  orc_case c;
  orc_case_init(&c);
  for (long k = 0; k < 20; k++)
    orc_case_add(&c, (k & 1 ? 1 : -1) * leg[k / 4][0], (k & 1 ? 1 : -1) * leg[k / 4][0] + 1,
                 (k & 2 ? 1 : -1) * leg[k / 4][1], (k & 2 ? 1 : -1) * leg[k / 4][1] + 1, 1);
  char message[MESSAGE_SIZE] = "";
  dyd_sites *s = harness_sites(&c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  assert_non_null(pd);
  dyd_rect w;
  dyd_rect_init(&w);
  assert_int_equal(dyd_rect_set_d(&w, -99, 99, -99, 99), DYD_OK);
  assert_true(check_call(2, pd, 0, &w) + check_call(3, pd, 0, &w) > 40);
  dyd_rect_clear(&w);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  orc_case_clear(&c);
}

static void capped(void **state) {
  (void)state;
  orc_case c;
  orc_case_init(&c);
  for (long k = 0; k < 6; k++) orc_case_add(&c, k, k + 9, -k, 9 - k, 1);
  dyd_sites *s = harness_sites(&c);
  dyd_delaunay *pd = NULL;
  dyd_error err;
  const dyd_delaunay_options options = {DYD_SIZED(dyd_delaunay_options), .max_pairs = 1};
  dyd_rect w;
  dyd_point p;
  dyd_rect_init(&w);
  dyd_point_init(&p);
  assert_int_equal(dyd_rect_set_d(&w, 0, 1, 0, 1), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, s, &options, &err), DYD_CAPPED);
  dyd_boundary b = {.whole = true};
  for (int which = 0; which < CALLS; which++) assert_int_equal(call(&b, which, pd, 0, &w), DYD_CAPPED);
  assert_true(b.whole);
  assert_int_equal(dyd_voronoi_side(pd, 0, &p), DYD_UNKNOWN);
  dyd_point_clear(&p);
  dyd_rect_clear(&w);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  orc_case_clear(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation), cmocka_unit_test(many_neighbours),
                                     cmocka_unit_test(capped)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
