/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Budgets, cancellation, and going on after either. */
#include "engine/help.h"
#include "rect/rect.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <time.h>

static dyd_engine_options options(void) {
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  return o;
}

static void test_stages(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_polygon(e, 6, NULL, 0);
  dyd_engine_options o = options();
  o.max_stages = 2;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(DYD_BUDGET_STAGES, engine_counters(e).spent);
  assert_int_equal(2, engine_counters(e).stages);
  assert_int_equal(128, engine_counters(e).bits_most);
  engine_run(e, &o, DYD_OUTCOME_BUDGET); /* each run has stages of its own */
  assert_int_equal(4, engine_counters(e).stages);
  assert_int_equal(512, engine_counters(e).bits_most);
  dyd_engine_free(e);
}

/* Calls: before the first stage is complete the result does not exist; within a later stage the result is updated with
 * the points narrowed so far. Counters are exact. */
static void test_calls(void **state) {
  (void)state;
  faulty f = {0};
  dyd_source source = faulty_source(&f);
  dyd_engine *e = engine_new();
  const double x[4] = {0, 10, 9, -10}, y[4] = {1000, 1000, 1021, 1015};
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, 4, &source, NULL));
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 4, x, y, NULL));
  for (int k = 0; k < 5; k++) {
    char cx[60], cy[60];
    snprintf(cx, sizeof cx, "100+cos(2*pi*%d/5)", k);
    snprintf(cy, sizeof cy, "sin(2*pi*%d/5)", k);
    engine_add_hidden(e, cx, cy);
  }
  dyd_engine_options o = options();
  o.max_calls = 3;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(DYD_BUDGET_CALLS, engine_counters(e).spent);
  assert_null(dyd_engine_delaunay(e));
  assert_int_equal(3, engine_counters(e).calls);
  assert_int_equal(3, f.calls);
  assert_int_equal(0, engine_counters(e).stages);
  /* The 1 + 5 points left (the polygon's first is exact or not, as the expressions find it). */
  o.max_calls = 0;
  o.max_stages = 1;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(DYD_BUDGET_STAGES, engine_counters(e).spent);
  uint64_t calls = engine_counters(e).calls;
  assert_int_equal(4, f.calls);
  assert_in_range(calls, 8, 9);
  monotone m;
  monotone_init(&m, e);
  monotone_look(&m);
  o.max_stages = 0;
  o.max_calls = 2;
  o.progress = monotone_progress;
  o.progress_user = &m;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(DYD_BUDGET_CALLS, engine_counters(e).spent);
  assert_int_equal(calls + 2, engine_counters(e).calls);
  assert_int_equal(2, engine_counters(e).stages);
  assert_int_equal(1, m.stages);
  monotone_clear(&m);
  dyd_engine_free(e);
  assert_int_equal(1, f.released);
}

static void test_pairs(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_dyadic area, hausdorff;
  dyd_dyadic_init(&area);
  dyd_dyadic_init(&hausdorff);
  const int weight[12] = {3, 17, 5, 40, 1, 22, 9, 31, 12, 2, 27, 14};
  engine_add_polygon(e, 12, weight, 500);
  dyd_engine_options o = options();
  o.max_pairs = 8;
  o.max_bits = 200;
  dyd_outcome outcome;
  dyd_error err;
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, &err));
  assert_int_equal(DYD_OUTCOME_BUDGET, outcome);
  assert_int_equal(DYD_BUDGET_PAIRS, engine_counters(e).spent);
  assert_int_equal(DYD_CAPPED, err.code);
  assert_true(strlen(err.message) > 0);
  assert_true(dyd_delaunay_is_capped(dyd_engine_delaunay(e)));
  assert_int_equal(DYD_CAPPED, dyd_engine_bounds(&area, &hausdorff, e));
  /* A larger cap at the same precision lists all pairs; */
  o.max_pairs = 1000;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(DYD_BUDGET_BITS, engine_counters(e).spent);
  size_t count[4];
  engine_count(count, e);
  assert_int_equal(54, count[DYD_INDETERMINATE]);
  assert_int_equal(DYD_OK, dyd_engine_bounds(&area, &hausdorff, e));
  /* and more precision dissolves the cluster. */
  o.max_bits = 2000;
  engine_run(e, &o, DYD_OUTCOME_DECIDED);
  dyd_engine_free(e);
  dyd_dyadic_clear(&hausdorff);
  dyd_dyadic_clear(&area);
}

/* A cap that is met at first and dissolved by refinement within the same run. */
static void test_pairs_dissolved(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  const int weight[12] = {3, 17, 5, 40, 1, 22, 9, 31, 12, 2, 27, 14};
  engine_add_polygon(e, 12, weight, 500);
  dyd_engine_options o = options();
  o.max_pairs = 8;
  engine_run(e, &o, DYD_OUTCOME_DECIDED);
  assert_false(dyd_delaunay_is_capped(dyd_engine_delaunay(e)));
  dyd_engine_free(e);
}

/* The cap does not count exact ties: however many there are, nothing is missing, and nothing can be refined.
 */
static void test_pairs_of_ties(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  double x[40], y[40];
  for (int k = 0; k < 40; k++) x[k] = k, y[k] = 0;
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 12, x, y, NULL));
  dyd_engine_options o = options();
  o.max_pairs = 5;
  engine_run(e, &o, DYD_OUTCOME_FIXPOINT);
  size_t count[4];
  dyd_delaunay_count(count, dyd_engine_delaunay(e));
  assert_int_equal(11, count[DYD_LEGAL]);
  assert_int_equal(66 - 11, count[DYD_TIE]);
  o.goal = DYD_GOAL_AREA;
  o.goal_bits = 1;
  engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
  dyd_engine_free(e);
}

static void test_seconds(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_polygon(e, 12, NULL, 0);
  dyd_engine_options o = options();
  o.max_bits = 1000000;
  o.seconds = 0.2;
  struct timespec a, b;
  clock_gettime(CLOCK_MONOTONIC, &a);
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  clock_gettime(CLOCK_MONOTONIC, &b);
  assert_int_equal(DYD_BUDGET_SECONDS, engine_counters(e).spent);
  double took = (double)(b.tv_sec - a.tv_sec) + 1e-9 * (double)(b.tv_nsec - a.tv_nsec);
  assert_true(took >= 0.15 && took < 10);
  assert_true(engine_counters(e).seconds >= 0.15 && engine_counters(e).seconds <= took + 1e-3);
  /* A limit that has passed before the first stage: no result, and no harm. */
  dyd_engine *f = engine_new();
  engine_add_polygon(f, 12, NULL, 0);
  o.seconds = 1e-9;
  engine_run(f, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(DYD_BUDGET_SECONDS, engine_counters(f).spent);
  assert_null(dyd_engine_delaunay(f));
  o.seconds = 1e12;
  o.max_bits = 128;
  engine_run(f, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(DYD_BUDGET_BITS, engine_counters(f).spent);
  dyd_engine_free(f);
  dyd_engine_free(e);
}

/* The deadline stops the triangulation in the middle of its work, where no stream is called. */
static void test_seconds_within(void **state) {
  (void)state;
  enum { COUNT = 1 << 19 };
  test_random r = test_random_start("deadline");
  double *x = malloc(2 * COUNT * sizeof *x);
  assert_non_null(x);
  for (size_t k = 0; k < 2 * COUNT; k++) x[k] = test_unit(&r);
  dyd_engine *e = engine_new();
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, COUNT, x, x + COUNT, NULL));
  free(x);
  dyd_engine_options o = options();
  o.seconds = 0.05;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(DYD_BUDGET_SECONDS, engine_counters(e).spent);
  assert_null(dyd_engine_delaunay(e));
  assert_int_equal(0, engine_counters(e).stages);
  dyd_engine_free(e);
}

static dyd_engine *engine_of_crowd(size_t n) {
  dyd_engine *e = engine_new();
  for (size_t k = 0; k < n; k++) {
    double x0 = fmod((double)k * 0.6180339887, 1), y0 = fmod((double)(k * k) * 0.4142135623, 1);
    double x1 = x0 + 0.25 / sqrt((double)n), y1 = y0 + 0.25 / sqrt((double)n);
    assert_int_equal(DYD_OK, dyd_engine_add_boxes(e, 1, &x0, &x1, &y0, &y1, NULL));
  }
  return e;
}

/* Time that ends while the first faces are closed: those done count, the others as met by the cap, and with more time
 * the result is that of a run which was never stopped. */
static void test_seconds_first(void **state) {
  (void)state;
  size_t count[4], cut[4];
  const size_t n = 4000;
  dyd_engine *e = NULL, *whole = engine_of_crowd(n);
  engine_run(whole, NULL, DYD_OUTCOME_FIXPOINT);
  engine_count(count, whole);
  dyd_engine_options o = options();
  bool was = false;
  for (o.seconds = 16; !was && o.seconds > 0x1p-8; o.seconds /= 1.25) {
    dyd_outcome outcome;
    e = engine_of_crowd(n);
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
    was = dyd_engine_delaunay(e) && dyd_delaunay_is_capped(dyd_engine_delaunay(e));
    if (!was) dyd_engine_free(e);
  }
  assert_true(was);
  assert_int_equal(DYD_BUDGET_SECONDS, engine_counters(e).spent);
  engine_count(cut, e);
  assert_int_equal(count[DYD_LEGAL], cut[DYD_LEGAL]);
  assert_true(cut[DYD_INDETERMINATE] < count[DYD_INDETERMINATE]); /* those of the skeleton are listed */
  engine_run(e, NULL, DYD_OUTCOME_FIXPOINT);
  assert_same_statuses(e, whole);
  dyd_engine_free(e);
  dyd_engine_free(whole);
}

/* The message names the option. */
static void check_refused(dyd_engine *e, const dyd_engine_options *o, const char *name) {
  dyd_outcome outcome;
  dyd_error err;
  assert_int_equal(DYD_E_ARG, dyd_engine_run(&outcome, e, o, &err));
  assert_int_equal(DYD_OUTCOME_ERROR, outcome);
  if (!strstr(err.message, name)) fail_msg("no %s in: %s", name, err.message);
}

static void test_bad_options(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_engine_options o = options();
  o.seconds = -1;
  check_refused(e, &o, "`seconds` is below 0");
  o.seconds = (double)NAN;
  check_refused(e, &o, "`seconds`");
  o = options();
  o.goal = (dyd_goal)9;
  check_refused(e, &o, "`goal`");
  o = options();
  o.schedule = (dyd_schedule)9;
  check_refused(e, &o, "`schedule`");
  o = options();
  o.goal_bits = INT64_MAX;
  check_refused(e, &o, "`goal_bits`");
  o = options();
  o.goal = DYD_GOAL_VORONOI_AREA;
  check_refused(e, &o, "`window`");
  o = options();
  o.tie_bits = -1;
  check_refused(e, &o, "`tie_bits`");
  o = options();
  o.step_bits = -1;
  check_refused(e, &o, "`step_bits`");
  o = options();
  o.start_bits = -DYD_EXP_LIMIT - 1;
  check_refused(e, &o, "`start_bits`");
  /* The engine has not started by any of these. */
  const double x = 1;
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 1, &x, &x, NULL));
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  dyd_engine_free(e);
}

/* ---- cancellation ---- */

static void test_cancel_before(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_polygon(e, 6, NULL, 0);
  dyd_engine_cancel(e);
  engine_run(e, NULL, DYD_OUTCOME_CANCELLED);
  assert_null(dyd_engine_delaunay(e));
  assert_int_equal(0, engine_counters(e).calls);
  dyd_engine_options o = options();
  o.max_bits = 128;
  engine_run(e, &o, DYD_OUTCOME_BUDGET); /* it was sticky for one run only */
  dyd_engine_cancel(e);
  engine_run(e, &o, DYD_OUTCOME_CANCELLED); /* earlier statements stay */
  size_t count[4];
  engine_count(count, e);
  assert_int_equal(6, count[DYD_LEGAL]);
  assert_int_equal(9, count[DYD_INDETERMINATE]);
  dyd_engine_free(e);
}

/* From inside a callback, at every call in turn: the run stops after that call, later runs continue to the same end. */
static void test_cancel_inside(void **state) {
  (void)state;
  for (uint64_t at = 1;; at++) {
    faulty f = {.cancel_at = at};
    dyd_source source = faulty_source(&f);
    dyd_engine *e = engine_new();
    f.cancel = e;
    assert_int_equal(DYD_OK, dyd_engine_add_source(e, 6, &source, NULL));
    dyd_engine_options o = options();
    o.start_bits = 2;
    dyd_outcome outcome;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
    if (outcome == DYD_OUTCOME_CANCELLED)
      assert_int_equal(at, f.calls);
    else
      assert_true(f.calls < at);
    bool done = outcome != DYD_OUTCOME_CANCELLED;
    if (!done) {
      if (at < 6) assert_null(dyd_engine_delaunay(e));
      engine_run(e, &o, DYD_OUTCOME_DECIDED);
    }
    assert_int_equal(DYD_OUTCOME_DECIDED, dyd_engine_outcome(e));
    dyd_engine_free(e);
    assert_int_equal(1, f.released);
    if (done) {
      assert_true(at > 6);
      break;
    }
  }
}

static void *cancel_soon(void *arg) {
  nanosleep(&(struct timespec){0, 50000000}, NULL);
  dyd_engine_cancel(arg);
  return NULL;
}

static void test_cancel_thread(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_polygon(e, 12, NULL, 0);
  dyd_engine_options o = options();
  o.max_bits = 1000000;
  o.seconds = 100;
  pthread_t thread;
  assert_int_equal(0, pthread_create(&thread, NULL, cancel_soon, e));
  engine_run(e, &o, DYD_OUTCOME_CANCELLED);
  pthread_join(thread, NULL);
  dyd_engine_free(e);
}

static dyd_engine *signalled;
static void on_alarm(int number) {
  (void)number;
  dyd_engine_cancel(signalled);
}

static void test_cancel_signal(void **state) {
  (void)state;
  struct sigaction action = {.sa_handler = on_alarm}, before;
  timer_t timer;
  signalled = engine_new();
  engine_add_polygon(signalled, 12, NULL, 0);
  dyd_engine_options o = options();
  o.max_bits = 1000000;
  sigaction(SIGALRM, &action, &before);
  assert_int_equal(0, timer_create(CLOCK_MONOTONIC, NULL, &timer));
  struct itimerspec soon = {.it_value = {0, 50000000}};
  timer_settime(timer, 0, &soon, NULL);
  engine_run(signalled, &o, DYD_OUTCOME_CANCELLED);
  timer_delete(timer);
  sigaction(SIGALRM, &before, NULL);
  dyd_engine_free(signalled);
}

/* sqrt(3); its call number `at` cancels the engine, and answers all the same. */
typedef struct canceller {
  dyd_engine *e;
  dyd_real *of;
  uint64_t calls, at;
} canceller;

static dyd_status narrow_and_cancel(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  canceller *c = user;
  dyd_status st = dyd_real_narrow(c->of, request->bits, request->max_bits, err);
  if (st >= 0) dyd_interval_set(out, dyd_real_interval(c->of));
  if (++c->calls == c->at) dyd_engine_cancel(c->e);
  return st;
}

static dyd_real *parsed(const char *text) {
  dyd_real *x = NULL;
  assert_int_equal(DYD_OK, dyd_real_parse(&x, text, strlen(text), NULL));
  return x;
}

/* A cancel within an expression is seen before the next of its nodes: the point stays as it was, so does the result,
 * and the next run asks again. */
static void test_cancel_within_an_expression(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  canceller c = {.e = e, .of = parsed("sqrt(3)"), .at = 2};
  dyd_real *opaque = NULL, *sum = NULL;
  dyd_stream *s = NULL;
  assert_int_equal(DYD_OK, dyd_real_new(&opaque, narrow_and_cancel, NULL, &c));
  assert_int_equal(DYD_OK, dyd_real_op(&sum, opaque, parsed("log(2)"), DYD_REAL_ADD, NULL));
  assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, sum, parsed("1")));
  assert_int_equal(DYD_OK, dyd_engine_add_stream(e, s, NULL));
  engine_add_hidden(e, "1", "0");
  engine_add_hidden(e, "cos(2*pi/5)", "sin(2*pi/5)");
  engine_add_hidden(e, "cos(4*pi/5)", "sin(4*pi/5)");
  engine_add_hidden(e, "cos(6*pi/5)", "sin(6*pi/5)");
  dyd_engine_options o = options();
  o.schedule = DYD_SCHEDULE_UNIFORM;
  o.max_stages = 1;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  const dyd_delaunay *result = dyd_engine_delaunay(e);
  dyd_rect before, after;
  dyd_rect_init(&before);
  dyd_rect_init(&after);
  assert_int_equal(DYD_OK, dyd_sites_get(&before, dyd_engine_sites(e), 0));
  assert_int_equal(1, c.calls);
  engine_run(e, &o, DYD_OUTCOME_CANCELLED);
  assert_int_equal(DYD_OK, dyd_sites_get(&after, dyd_engine_sites(e), 0));
  assert_int_equal(2, c.calls);
  assert_true(dyd_rect_equal(&before, &after));
  assert_ptr_equal(result, dyd_engine_delaunay(e));
  assert_int_equal(1, engine_counters(e).stages);
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(2, engine_counters(e).stages);
  assert_int_equal(128, engine_counters(e).bits_most);
  dyd_rect_clear(&after);
  dyd_rect_clear(&before);
  dyd_engine_free(e);
  dyd_real_free(c.of);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_stages),
      cmocka_unit_test(test_calls),
      cmocka_unit_test(test_pairs),
      cmocka_unit_test(test_pairs_dissolved),
      cmocka_unit_test(test_pairs_of_ties),
      cmocka_unit_test(test_seconds),
      cmocka_unit_test(test_seconds_within),
      cmocka_unit_test(test_seconds_first),
      cmocka_unit_test(test_bad_options),
      cmocka_unit_test(test_cancel_before),
      cmocka_unit_test(test_cancel_inside),
      cmocka_unit_test(test_cancel_thread),
      cmocka_unit_test(test_cancel_within_an_expression),
      cmocka_unit_test(test_cancel_signal),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
