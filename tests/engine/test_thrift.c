/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Costs of points: the total spent with and without them, and that nothing else depends on them. */
#include "engine/help.h"
#include <dyadel/io.h>

#include <math.h>
#include <string.h>

enum { CORNERS = 4, POLYGONS = 6, MOST = CORNERS * POLYGONS };

/* What the calls of a run cost, and how many of each point there were. */
typedef struct purse {
  const double *cost;
  double spent;
  unsigned calls[MOST];
} purse;

static void pay(void *user, const dyd_step *step) {
  purse *p = user;
  if (!step->called) return;
  p->spent += p->cost[step->site];
  p->calls[step->site]++;
}

/* Far from one another, quads all but on a circle: how nearly differs. */
static dyd_engine *quads(test_random *r) {
  dyd_engine *e = engine_new();
  for (int q = 0; q < POLYGONS; q++) {
    int bits = 70 + (int)test_below(r, 900), turn = (int)test_below(r, 100), first = (int)test_below(r, CORNERS);
    for (int k = 0; k < CORNERS; k++) {
      char x[120], y[120];
      int weight = (k + first) % CORNERS * (k + first + 1);
      snprintf(x, sizeof x, "%d+(1+%d*2^-%d)*cos(%d+pi*%d/2+%d/16)", 10 * q, weight, bits, turn, k, k);
      snprintf(y, sizeof y, "%d+(1+%d*2^-%d)*sin(%d+pi*%d/2+%d/16)", q * q, weight, bits, turn, k, k);
      engine_add_hidden(e, x, y);
    }
  }
  return e;
}

static double spend(purse *p, dyd_engine *e, const double *cost, const double *told) {
  dyd_engine_options o;
  monotone m;
  dyd_engine_options_init(&o);
  *p = (purse){.cost = cost};
  monotone_init(&m, e);
  o.cost = told;
  o.trace = pay;
  o.trace_user = p;
  o.progress = monotone_progress;
  o.progress_user = &m;
  engine_run(e, &o, DYD_OUTCOME_DECIDED);
  monotone_clear(&m);
  return p->spent;
}

/* Less is spent in all, never much more; the statuses are the same, and a second run asks the same. */
static void test_costs_are_spared(void **state) {
  (void)state;
  test_random r = test_random_start("costs");
  double with = 0, without = 0;
  for (size_t c = 0; c < test_cases_all(60); c++) {
    double cost[MOST];
    purse a, b, again;
    for (int k = 0; k < MOST; k++) cost[k] = test_chance(&r, 3) ? 5 + (double)test_below(&r, 60) : 1;
    test_random same = r, once_more = r;
    dyd_engine *e = quads(&r), *f = quads(&same), *g = quads(&once_more);
    double x = spend(&a, e, cost, cost), y = spend(&b, f, cost, NULL);
    spend(&again, g, cost, cost);
    assert_memory_equal(a.calls, again.calls, sizeof a.calls);
    assert_same_statuses(e, f);
    assert_true(x <= 2 * y);
    with += x, without += y;
    dyd_engine_free(e), dyd_engine_free(f), dyd_engine_free(g);
  }
  print_message("spent %g, %g without costs\n", with, without);
  assert_true(with < 0.8 * without);
}

/* Equal costs, of any size, are none. */
static void test_equal_costs(void **state) {
  (void)state;
  test_random r = test_random_start("equal costs");
  double cost[MOST];
  for (int k = 0; k < MOST; k++) cost[k] = 0.125;
  for (size_t c = 0; c < test_cases_all(10); c++) {
    purse a, b;
    test_random same = r;
    dyd_engine *e = quads(&r), *f = quads(&same);
    spend(&a, e, cost, cost);
    spend(&b, f, cost, NULL);
    assert_memory_equal(a.calls, b.calls, sizeof a.calls);
    dyd_engine_free(e), dyd_engine_free(f);
  }
}

/* One of the four of a quad is dear: it is not asked more often than without costs, and less often in all. */
static void test_dear_one_is_spared(void **state) {
  (void)state;
  test_random r = test_random_start("dear");
  unsigned with = 0, without = 0;
  for (size_t c = 0; c < test_cases_all(30); c++) {
    double cost[MOST];
    purse a, b;
    size_t dear = test_below(&r, CORNERS);
    for (size_t k = 0; k < MOST; k++) cost[k] = k % CORNERS == dear ? 50 : 1;
    test_random same = r;
    dyd_engine *e = quads(&r), *f = quads(&same);
    spend(&a, e, cost, cost);
    spend(&b, f, cost, NULL);
    for (size_t k = dear; k < MOST; k += CORNERS) {
      assert_true(a.calls[k] <= b.calls[k] && a.calls[k] >= 1);
      with += a.calls[k], without += b.calls[k];
    }
    dyd_engine_free(e), dyd_engine_free(f);
  }
  print_message("asked %u times, %u without costs\n", with, without);
  assert_true(with * 5 < without * 4);
}

static void test_costs_that_are_none(void **state) {
  (void)state;
  static const double wrong[] = {0, -1, HUGE_VAL, NAN};
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
    dyd_engine *e = engine_new();
    dyd_engine_options o;
    dyd_outcome outcome;
    dyd_error err;
    const double cost[2] = {1, wrong[k]};
    engine_add_text(e, "sqrt(2)", "0");
    engine_add_text(e, "1", "0");
    dyd_engine_options_init(&o);
    o.cost = cost;
    assert_int_equal(dyd_engine_run(&outcome, e, &o, &err), DYD_E_ARG);
    assert_int_equal(outcome, DYD_OUTCOME_ERROR);
    assert_non_null(strstr(err.message, "cost"));
    dyd_engine_free(e);
  }
}

/* A source may say what its points cost; others cost 1, and rows are counted as before. */
static void test_costs_of_sources(void **state) {
  (void)state;
  faulty f = {.kind = FAULT_NONE}, g = f;
  dyd_source dear = faulty_source(&f), plain = faulty_source(&g), wrong = faulty_source(&g);
  const double x = 9, y = 1, cost[] = {3, 0.5, 1e9}, told[] = {1, 3, 0.5, 1e9, 1, 1}, bad[] = {0, -2, HUGE_VAL, NAN};
  dyd_engine *e = engine_new();
  dyd_error err;
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 1, &x, &y, NULL));
  dear.cost = cost;
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, 3, &dear, &err));
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, 2, &plain, &err));
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    const double costs[2] = {1, bad[k]};
    wrong.cost = costs;
    assert_int_equal(DYD_E_ARG, dyd_engine_add_source(e, 2, &wrong, &err));
    assert_non_null(strstr(err.message, "point 7: its cost is "));
    assert_int_equal(7, err.point);
    assert_int_equal((int)k + 1, g.released);
  }
  assert_int_equal(6, dyd_engine_count(e));
  for (size_t k = 0; k < 6; k++) {
    assert_true(dyd_engine_number(e, k, DYD_ROW_COST) == told[k]);
    assert_int_equal(k, dyd_engine_row(e, k));
    assert_null(dyd_engine_id(e, k));
  }
  dyd_engine_free(e);
  assert_int_equal(1, f.released);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_costs_are_spared),   cmocka_unit_test(test_equal_costs),
      cmocka_unit_test(test_dear_one_is_spared), cmocka_unit_test(test_costs_that_are_none),
      cmocka_unit_test(test_costs_of_sources),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
