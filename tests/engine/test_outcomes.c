/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How runs end: decided, fixpoint, budget of bits; schedules agree; statements are never retracted. */
#include "engine/help.h"
#include "rect/rect.h"

static void test_texts(void **state) {
  (void)state;
  assert_string_equal("decided", dyd_outcome_text(DYD_OUTCOME_DECIDED));
  assert_string_equal("cancelled", dyd_outcome_text(DYD_OUTCOME_CANCELLED));
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  assert_int_equal(64, o.start_bits);
  assert_int_equal(4096, o.max_bits);
  assert_int_equal(DYD_GOAL_DECIDED, o.goal);
}

static void test_few(void **state) {
  (void)state;
  for (size_t n = 0; n <= 2; n++) {
    dyd_engine *e = engine_new();
    dyd_dyadic area, hausdorff;
    dyd_dyadic_init(&area);
    dyd_dyadic_init(&hausdorff);
    const double x[2] = {0, 1};
    assert_int_equal(DYD_OK, dyd_engine_add_points(e, n, x, x, NULL));
    assert_int_equal(n, dyd_engine_count(e));
    assert_int_equal(DYD_OUTCOME_NONE, dyd_engine_outcome(e));
    assert_null(dyd_engine_delaunay(e));
    assert_int_equal(DYD_E_ARG, dyd_engine_bounds(&area, &hausdorff, e));
    engine_run(e, NULL, DYD_OUTCOME_DECIDED);
    assert_int_equal(DYD_OK, dyd_engine_bounds(&area, &hausdorff, e));
    assert_int_equal(0, dyd_dyadic_sgn(&area));
    assert_int_equal(0, dyd_dyadic_sgn(&hausdorff));
    dyd_dyadic_clear(&hausdorff);
    dyd_dyadic_clear(&area);
    dyd_engine_free(e);
  }
  dyd_engine_free(NULL);
}

static void test_exact_decided(void **state) {
  (void)state;
  const double x[4] = {0, 4, 5, -1}, y[4] = {0, 1, 5, 3};
  dyd_engine *e = engine_new();
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 4, x, y, NULL));
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  size_t count[4];
  engine_count(count, e);
  assert_int_equal(5, count[DYD_LEGAL]);
  dyd_engine_counters c = engine_counters(e);
  assert_int_equal(1, c.stages);
  assert_int_equal(0, c.calls);
  assert_int_equal(0, c.bits_most);
  assert_int_equal(DYD_BUDGET_NONE, c.spent);
  dyd_engine_free(e);
}

/* A square: its sides are legal, its diagonals tie for ever. */
static void test_tie(void **state) {
  (void)state;
  const double x[4] = {0, 1, 1, 0}, y[4] = {0, 0, 1, 1};
  dyd_engine *e = engine_new();
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 4, x, y, NULL));
  engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
  size_t count[4];
  engine_count(count, e);
  assert_int_equal(4, count[DYD_LEGAL]);
  assert_int_equal(2, count[DYD_TIE]);
  assert_int_equal(0, count[DYD_INDETERMINATE]);
  /* The area bound of exact points is 0, so the area goal holds even here; the Hausdorff bound stays sqrt(2)/2. */
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.goal = DYD_GOAL_AREA;
  o.goal_bits = 1000000;
  engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
  o.goal = DYD_GOAL_HAUSDORFF;
  o.goal_bits = 1;
  engine_run(e, &o, DYD_OUTCOME_FIXPOINT);
  o.goal_bits = 0;
  engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
  dyd_engine_free(e);
}

/* A fixed rectangle that touches the edge: section 10, case 3. Nothing can be refined. */
static void test_fixed_rectangles(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  const double x[4] = {0, 10, 5, 5}, y[4] = {0, 0, 20, -1000};
  const double x0 = 5, y0 = -0.1, y1 = 0.1;
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 2, x, y, NULL));
  assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 1, &x0, &x0, &y0, &y1, NULL));
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 2, x + 2, y + 2, NULL));
  engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
  assert_int_equal(DYD_INDETERMINATE, dyd_delaunay_status(dyd_engine_delaunay(e), 0, 1));
  dyd_engine_free(e);
}

/* Growth is by doubling; probes make adaptive runs shorter. */
static void check_polygon(dyd_schedule schedule) {
  dyd_engine *e = engine_new();
  dyd_engine_options o;
  monotone m;
  engine_add_polygon(e, 12, NULL, 0);
  monotone_init(&m, e);
  dyd_engine_options_init(&o);
  o.schedule = schedule;
  o.max_bits = 512;
  o.progress = monotone_progress;
  o.progress_user = &m;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  size_t count[4];
  engine_count(count, e);
  assert_int_equal(12, count[DYD_LEGAL]);
  assert_int_equal(54, count[DYD_INDETERMINATE]);
  dyd_engine_counters c = engine_counters(e);
  assert_int_equal(DYD_BUDGET_BITS, c.spent);
  assert_int_equal(512, c.bits_most);
  assert_int_equal(c.stages, m.stages);
  if (schedule == DYD_SCHEDULE_UNIFORM)
    assert_int_equal(4, c.stages); /* 64, 128, 256, 512 */
  else
    assert_in_range(c.stages, 2, 4);
  /* Again: no request is possible, and none is made. */
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(c.calls, engine_counters(e).calls);
  /* A run with a larger budget continues from there. */
  o.max_bits = 700;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(700, engine_counters(e).bits_most);
  assert_int_equal(c.stages + 1, m.stages);
  monotone_clear(&m);
  dyd_engine_free(e);
}

static void test_polygon(void **state) {
  (void)state;
  check_polygon(DYD_SCHEDULE_UNIFORM);
  check_polygon(DYD_SCHEDULE_ADAPTIVE);
}

static const int weights[12] = {3, 17, 5, 40, 1, 22, 9, 31, 12, 2, 27, 14};

static void test_near_polygon(void **state) {
  (void)state;
  dyd_engine *run[3];
  for (int k = 0; k < 3; k++) {
    dyd_engine_options o;
    monotone m;
    run[k] = engine_new();
    engine_add_polygon(run[k], 12, weights, 2000);
    monotone_init(&m, run[k]);
    dyd_engine_options_init(&o);
    o.schedule = k == 1 ? DYD_SCHEDULE_UNIFORM : DYD_SCHEDULE_ADAPTIVE;
    o.step_bits = k == 2 ? 250 : 0;
    o.progress = monotone_progress;
    o.progress_user = &m;
    o.max_bits = 1900;
    engine_run(run[k], &o, DYD_OUTCOME_BUDGET);
    o.max_bits = 4096;
    engine_run(run[k], &o, DYD_OUTCOME_DECIDED);
    size_t count[4];
    engine_count(count, run[k]);
    assert_int_equal(21, count[DYD_LEGAL]);
    assert_true(m.stages >= (k ? 6 : 2));
    monotone_clear(&m);
  }
  for (int k = 1; k < 3; k++) assert_same_statuses(run[0], run[k]);
  for (int k = 0; k < 3; k++) dyd_engine_free(run[k]);
}

/* Random points by expressions: adaptive, uniform, every kind of first precision, and exact rung only. */
static void test_schedules(void **state) {
  (void)state;
  test_random r = test_random_start("schedules");
  for (size_t k = 0; k < test_cases(6); k++) {
    dyd_engine *run[4];
    test_random same = {test_u64(&r)};
    for (int s = 0; s < 4; s++) {
      test_random again = same;
      dyd_engine_options o;
      run[s] = engine_new();
      engine_add_roots(run[s], &again, 9);
      dyd_engine_options_init(&o);
      o.schedule = s == 1 ? DYD_SCHEDULE_UNIFORM : DYD_SCHEDULE_ADAPTIVE;
      if (s == 2) o.start_bits = 1;
      if (s == 3) o.start_bits = -3, o.no_filter = true;
      monotone m;
      monotone_init(&m, run[s]);
      o.progress = monotone_progress;
      o.progress_user = &m;
      engine_run(run[s], &o, DYD_OUTCOME_DECIDED);
      dyd_engine_counters c = engine_counters(run[s]);
      assert_true(c.bits_least <= c.bits_most && c.bits_total >= (uint64_t)(c.bits_most > 0 ? c.bits_most : 0));
      monotone_clear(&m);
    }
    for (int s = 1; s < 4; s++) assert_same_statuses(run[0], run[s]);
    for (int s = 0; s < 4; s++) dyd_engine_free(run[s]);
  }
}

/* Adaptive asks only for what matters: a far-away cluster that is decided stays at the first precision, which is that
 * of doubles unless another is given. */
static void test_adaptive_is_local(void **state) {
  (void)state;
  for (int64_t start = 0; start <= 64; start += 64) {
    dyd_engine *e = engine_new();
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.start_bits = start;
    engine_add_polygon(e, 4, weights, 300);
    engine_add_text(e, "sqrt(10000)+sqrt(2)", "sqrt(3)");
    engine_add_text(e, "sqrt(10000)+sqrt(5)", "sqrt(7)");
    engine_run(e, &o, DYD_OUTCOME_DECIDED);
    dyd_engine_counters c = engine_counters(e);
    if (start)
      assert_int_equal(64, c.bits_least);
    else
      assert_in_range(c.bits_least, 40, 52);
    assert_int_equal(512, c.bits_most);
    assert_true(c.calls <= 4 * 4 + 2);
    dyd_engine_free(e);
  }
}

/* The rectangles of a first stage in doubles are as narrow as said [FLT-GRID], and narrower ones lie inside, whichever
 * query comes first. */
static void test_first_in_doubles(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_stream *s;
  dyd_rect first, later;
  dyd_rect_init(&first);
  dyd_rect_init(&later);
  engine_add_text(e, "sqrt(2)*1e4", "3/7-sqrt(5)");
  engine_add_text(e, "sqrt(3)", "0.5");
  engine_add_text(e, "sqrt(3)", "1/3");
  engine_add_text(e, "sqrt(3)*1e12", "sqrt(7)");
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  const dyd_sites *sites = dyd_delaunay_sites(dyd_engine_delaunay(e));
  dyd_engine_counters c = engine_counters(e);
  assert_in_range(c.bits_least, 30, 40); /* 14142 +- 2^-38 */
  assert_int_equal(64, c.bits_most);     /* 1/3 is not a double, and 1e12 leaves too few bits */
  for (uint32_t i = 0; i < 4; i++) {
    assert_int_equal(DYD_OK, dyd_sites_get(&first, sites, i));
    assert_true(dyd_rect_bits(&first) >= (i < 2 ? 30 : 64));
    assert_int_equal(DYD_OK, dyd_engine_stream(&s, e, i));
    for (int64_t bits = 10; bits <= 640; bits *= 2) {
      assert_int_equal(DYD_OK, dyd_stream_narrow(s, bits, 4096, NULL));
      dyd_rect_set(&later, dyd_stream_rect(s));
      assert_true(dyd_rect_bits(&later) >= bits);
    }
    assert_true(dyd_rect_contains(&first, &later));
    dyd_stream_free(s);
  }
  dyd_rect_clear(&later);
  dyd_rect_clear(&first);
  dyd_engine_free(e);
}

/* After doubles the precisions are those of a run that began with 64 bits. */
static void test_after_doubles(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_text(e, "sqrt(2)", "0");
  engine_add_text(e, "0", "sqrt(2)");
  engine_add_text(e, "-sqrt(2)", "0");
  engine_add_text(e, "0", "-sqrt(2)*(1+2^-50*2^-45)");
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  dyd_engine_counters c = engine_counters(e);
  assert_int_equal(128, c.bits_most);
  assert_int_equal(4 * 128, c.bits_total);
  assert_int_equal(8, c.calls);
  assert_int_equal(2, c.stages);
  dyd_engine_free(e);
}

/* All kinds of points in one engine, numbered in the order added. */
static void test_mixed(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  faulty f = {0};
  dyd_source source = faulty_source(&f);
  dyd_rect r;
  dyd_rect_init(&r);
  const double x[2] = {-5, -7}, y[2] = {11, 2}, x1[2] = {-4.5, -6.5}, y1[2] = {11.5, 2};
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 1, x, y1, NULL));
  engine_add_text(e, "sqrt(2)", "pi");
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, 3, &source, NULL));
  assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 2, x, x1, y, y1, NULL));
  assert_int_equal(DYD_OK, dyd_rect_set_d(&r, 20, 21, 30, 30));
  assert_int_equal(DYD_OK, dyd_engine_add_rect(e, &r, NULL));
  engine_add_text(e, "1/3", "40"); /* exact: no record, no call */
  engine_add_text(e, "sqrt(50)", "e");
  assert_int_equal(10, dyd_engine_count(e));
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.max_stages = 1;
  dyd_outcome outcome;
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
  assert_int_equal(5, engine_counters(e).calls);
  assert_int_equal(3, f.calls);
  const dyd_sites *s = dyd_delaunay_sites(dyd_engine_delaunay(e));
  const double centre[10][2] = {{-5, 11.5},     {1.4142, 3.1416}, {0, 0},     {1. / 7, 1. / 7}, {4. / 7, 8. / 7},
                                {-4.75, 11.25}, {-6.75, 2},       {20.5, 30}, {1. / 3, 40},     {7.0711, 2.7183}};
  for (size_t i = 0; i < 10; i++) {
    double d[4];
    dyd_sites_get_d(d, s, i);
    for (int a = 0; a < 2; a++) assert_true(d[2 * a] <= centre[i][a] + 1e-3 && d[2 * a + 1] >= centre[i][a] - 1e-3);
    if (i < 5 || i > 7) assert_true(d[1] - d[0] < 1e-9);
  }
  dyd_rect_clear(&r);
  dyd_engine_free(e);
  assert_int_equal(1, f.released);
}

/* Streams shared by two sites, equal streams: coincident limits never come apart, and end as a budget. */
static void test_coincident(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_hidden(e, "sqrt(2)", "1");
  engine_add_hidden(e, "sqrt(2)", "1");
  engine_add_text(e, "0", "0");
  engine_add_text(e, "3", "5");
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.max_bits = 200;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(DYD_BUDGET_BITS, engine_counters(e).spent);
  assert_true(dyd_delaunay_status(dyd_engine_delaunay(e), 0, 1) >= DYD_INDETERMINATE);
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_texts),
      cmocka_unit_test(test_few),
      cmocka_unit_test(test_exact_decided),
      cmocka_unit_test(test_tie),
      cmocka_unit_test(test_fixed_rectangles),
      cmocka_unit_test(test_polygon),
      cmocka_unit_test(test_near_polygon),
      cmocka_unit_test(test_schedules),
      cmocka_unit_test(test_adaptive_is_local),
      cmocka_unit_test(test_first_in_doubles),
      cmocka_unit_test(test_after_doubles),
      cmocka_unit_test(test_mixed),
      cmocka_unit_test(test_coincident),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
