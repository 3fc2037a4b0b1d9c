/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Before each stage sources receive exactly the requests of that stage, in order; a source that sees the stop
 * flag ends a run as a cancel or the end of time does. */
#include "engine/help.h"

#include <string.h>

enum { MOST = 4000 };

/* Two sources of points (k^2, k^3)/7 by a well-behaved helper; every list and every call is checked. */
typedef struct watched {
  faulty inner;
  dyd_request list[MOST];
  size_t count, next;
  int lists, calls;
  size_t shift; /* its point 0 is point `shift` of the helper */
  dyd_engine *cancel;
  int cancel_at; /* the call that waits for its stop flag */
} watched;

static void note(void *user, const dyd_request *request, size_t count) {
  watched *w = user;
  assert_true(count > 0 && count <= MOST);
  assert_int_equal(w->next, w->count); /* the former list was used up */
  memcpy(w->list, request, count * sizeof *request);
  w->count = count;
  w->next = 0;
  w->lists++;
}

static dyd_status watched_narrow(dyd_rect *out, void *user, const dyd_request *q, dyd_error *err) {
  watched *w = user;
  dyd_source inner = faulty_source(&w->inner);
  assert_true(w->next < w->count);
  const dyd_request *told = &w->list[w->next++];
  assert_int_equal(told->point, q->point);
  assert_int_equal(told->bits, q->bits);
  assert_int_equal(told->max_bits, q->max_bits);
  assert_ptr_equal(told->stop, q->stop);
  assert_non_null(q->stop);
  if (++w->calls == w->cancel_at) {
    assert_false(__atomic_load_n(q->stop, __ATOMIC_SEQ_CST) && !w->cancel);
    if (w->cancel) dyd_engine_cancel(w->cancel);
    while (!__atomic_load_n(q->stop, __ATOMIC_SEQ_CST)) continue;
    return DYD_CANCELLED;
  }
  dyd_request shifted = *q;
  shifted.point += w->shift;
  return inner.narrow(out, inner.user, &shifted, err);
}

static void add(dyd_engine *e, watched *w, size_t n) {
  dyd_source source = {DYD_SIZED(dyd_source), .narrow = watched_narrow, .user = w, .announce = note};
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, n, &source, NULL));
}

static void test_lists(void **state) {
  (void)state;
  for (int uniform = 0; uniform < 2; uniform++)
    for (int64_t goal = 50; goal <= 1000; goal *= 4) {
      watched *a = calloc(1, sizeof *a), *b = calloc(1, sizeof *b);
      dyd_engine *e = engine_new();
      dyd_engine_options o;
      const double x[2] = {-5, 300}, y[2] = {-9, 17};
      engine_add_text(e, "sqrt(2)-40", "pi-50");
      add(e, a, 5);
      assert_int_equal(DYD_OK, dyd_engine_add_points(e, 2, x, y, NULL));
      b->shift = 10;
      add(e, b, 3);
      dyd_engine_options_init(&o);
      o.schedule = uniform ? DYD_SCHEDULE_UNIFORM : DYD_SCHEDULE_ADAPTIVE;
      o.goal = DYD_GOAL_HAUSDORFF;
      o.goal_bits = goal;
      engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
      assert_true(a->lists > 0 && b->lists > 0);
      assert_int_equal(a->next, a->count);
      assert_int_equal(b->next, b->count);
      if (goal > 64) assert_true(a->lists > 1);
      dyd_engine_free(e);
      free(b);
      free(a);
    }
}

/* No more is announced than the budget of calls allows. */
static void test_calls(void **state) {
  (void)state;
  watched *a = calloc(1, sizeof *a);
  dyd_engine *e = engine_new();
  dyd_engine_options o;
  add(e, a, 9);
  dyd_engine_options_init(&o);
  o.max_calls = 4;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(4, a->count);
  assert_int_equal(4, a->calls);
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(8, a->calls);
  o.max_calls = 0;
  engine_run(e, &o, DYD_OUTCOME_DECIDED);
  dyd_engine_free(e);
  free(a);
}

/* A callback that waits until the stop flag is set: by a cancel from inside it, or by the end of time. */
static void test_stop(void **state) {
  (void)state;
  for (int timed = 0; timed < 2; timed++)
    for (int at = 1; at <= 9; at += 4) {
      watched *a = calloc(1, sizeof *a);
      dyd_engine *e = engine_new();
      dyd_engine_options o;
      add(e, a, 5);
      a->cancel_at = at;
      a->cancel = timed ? NULL : e;
      dyd_engine_options_init(&o);
      o.goal = DYD_GOAL_HAUSDORFF;
      o.goal_bits = 300;
      o.seconds = timed ? 0.3 : 0;
      engine_run(e, &o, timed ? DYD_OUTCOME_BUDGET : DYD_OUTCOME_CANCELLED);
      if (timed) assert_int_equal(DYD_BUDGET_SECONDS, engine_counters(e).spent);
      assert_true((dyd_engine_delaunay(e) != NULL) == (at > 5));
      a->next = a->count; /* requests announced and not made are announced again */
      o.seconds = 0;
      engine_run(e, &o, DYD_OUTCOME_CERTIFIED);
      dyd_engine_free(e);
      free(a);
    }
}

/* A callback that says it was cancelled when nothing was: an error like others. */
static dyd_status liar(dyd_rect *out, void *user, const dyd_request *q, dyd_error *err) {
  (void)out, (void)user, (void)q, (void)err;
  return DYD_CANCELLED;
}

static void test_liar(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_source source = {DYD_SIZED(dyd_source), .narrow = liar};
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, 1, &source, NULL));
  engine_run(e, NULL, DYD_OUTCOME_ERROR);
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_lists), cmocka_unit_test(test_calls),
                                     cmocka_unit_test(test_stop), cmocka_unit_test(test_liar)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
