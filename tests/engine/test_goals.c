/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The area and Hausdorff goals, and going on from one to the next. */
#include "engine/help.h"

static double log2_of(const dyd_dyadic *x) {
  return (double)((int64_t)mpz_sizeinbase(x->man, 2) + x->exp);
}

static void bounds_of(double out[2], const dyd_engine *e) {
  dyd_dyadic area, hausdorff;
  dyd_dyadic_init(&area);
  dyd_dyadic_init(&hausdorff);
  assert_int_equal(DYD_OK, dyd_engine_bounds(&area, &hausdorff, e));
  out[0] = log2_of(&area);
  out[1] = log2_of(&hausdorff);
  dyd_dyadic_clear(&hausdorff);
  dyd_dyadic_clear(&area);
}

/* One engine, growing goals, both kinds in turn: certified each time, monotone throughout. */
static void test_growing_goals(void **state) {
  (void)state;
  test_random r = test_random_start("goals");
  for (size_t k = 0; k < test_cases(4); k++) {
    dyd_engine *e = engine_new();
    engine_add_roots(e, &r, 9);
    dyd_engine_options o;
    monotone m;
    monotone_init(&m, e);
    dyd_engine_options_init(&o);
    o.start_bits = 3;
    o.schedule = test_chance(&r, 3) ? DYD_SCHEDULE_UNIFORM : DYD_SCHEDULE_ADAPTIVE;
    o.progress = monotone_progress;
    o.progress_user = &m;
    for (int64_t bits = 0; bits <= 600; bits += 1 + bits / 2) {
      o.goal_bits = bits;
      double bound[2];
      o.goal = DYD_GOAL_AREA;
      engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
      bounds_of(bound, e);
      assert_true(bound[0] <= (double)-bits + 1);
      o.goal = DYD_GOAL_HAUSDORFF;
      engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
      bounds_of(bound, e);
      assert_true(bound[1] <= (double)-bits + 1);
    }
    o.goal = DYD_GOAL_DECIDED;
    engine_run(e, &o, DYD_OUTCOME_DECIDED);
    /* Not much more than needed was asked for: at most the double of the last goal and what area needs besides. */
    assert_true(engine_counters(e).bits_most <= 2 * 600 + 64);
    monotone_clear(&m);
    dyd_engine_free(e);
  }
}

/* A decided triangulation continues to refine until the bound holds. */
static void test_beyond_decided(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_text(e, "sqrt(2)", "sqrt(3)");
  engine_add_text(e, "-sqrt(2)", "0");
  engine_add_text(e, "pi", "-1");
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  engine_run(e, &o, DYD_OUTCOME_DECIDED);
  uint64_t stages = engine_counters(e).stages;
  o.goal = DYD_GOAL_HAUSDORFF;
  o.goal_bits = 1000;
  engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
  /* Straight to 1001 bits. */
  assert_int_equal(stages + 1, engine_counters(e).stages);
  assert_int_equal(1001, engine_counters(e).bits_most);
  dyd_engine_free(e);
}

/* Bounds fall by one bit for each bit asked for. */
static void test_rate(void **state) {
  (void)state;
  test_random r = test_random_start("rate");
  dyd_engine *e = engine_new();
  engine_add_roots(e, &r, 10);
  double before[2] = {0, 0};
  for (int64_t bits = 100; bits <= 400; bits += 100) {
    dyd_engine_options o;
    double now[2];
    dyd_engine_options_init(&o);
    o.schedule = DYD_SCHEDULE_UNIFORM;
    o.goal = DYD_GOAL_HAUSDORFF;
    o.goal_bits = 100000;
    o.start_bits = o.max_bits = bits;
    engine_run(e, &o, DYD_OUTCOME_BUDGET);
    assert_int_equal(bits, engine_counters(e).bits_least);
    bounds_of(now, e);
    for (int k = 0; bits > 100 && k < 2; k++) {
      double fell = before[k] - now[k];
      assert_true(fell > 85 && fell < 115);
    }
    before[0] = now[0];
    before[1] = now[1];
  }
  dyd_engine_free(e);
}

/* Near ties: the Hausdorff bound needs the diagonals decided, the area bound does not. */
static void test_ties(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_polygon(e, 8, NULL, 0);
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.goal = DYD_GOAL_AREA;
  o.goal_bits = 200;
  engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
  assert_true(engine_counters(e).bits_most < 500);
  o.goal = DYD_GOAL_HAUSDORFF;
  o.max_bits = 512;
  o.goal_bits = 5;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(DYD_BUDGET_BITS, engine_counters(e).spent);
  o.goal_bits = -1; /* half of the diameter is 1 */
  engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
  dyd_engine_free(e);
}

/* Fixed boxes: a goal that no refinement can reach ends as a fixpoint; points next to them are refined as far as it
 * helps. */
static void test_fixed(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  const double x0[3] = {0, 10, 3}, x1[3] = {0.5, 10.5, 3.5}, y0[3] = {0, 0, 9}, y1[3] = {0.5, 0.5, 9.5};
  assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 3, x0, x1, y0, y1, NULL));
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  for (int goal = DYD_GOAL_AREA; goal <= DYD_GOAL_HAUSDORFF; goal++) {
    o.goal = (dyd_goal)goal;
    o.goal_bits = 10;
    engine_run(e, &o, DYD_OUTCOME_FIXPOINT);
    o.goal_bits = -6;
    engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
  }
  dyd_engine_free(e);
  e = engine_new();
  assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 3, x0, x1, y0, y1, NULL));
  engine_add_text(e, "sqrt(9)", "sqrt(11)");
  o.goal = DYD_GOAL_HAUSDORFF;
  o.goal_bits = 10;
  engine_run(e, &o, DYD_OUTCOME_FIXPOINT);
  assert_true(engine_counters(e).bits_most <= 64);
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_growing_goals), cmocka_unit_test(test_beyond_decided), cmocka_unit_test(test_rate),
      cmocka_unit_test(test_ties),          cmocka_unit_test(test_fixed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
