/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Several engines in several threads give what one gives alone. Made for a run under the thread sanitizer as well. */
#include "engine/help.h"

#include <flint/flint.h>
#include <mpfr.h>
#include <pthread.h>

typedef struct job {
  dyd_engine *e;
  dyd_outcome outcome;
  dyd_status status;
} job;

static dyd_engine *make(uint64_t seed) {
  test_random r = {seed};
  const int weight[6] = {3, 17, 5, 40, 1, 22};
  dyd_engine *e = engine_new();
  engine_add_polygon(e, 6, weight, 200);
  engine_add_roots(e, &r, 3);
  return e;
}

static void *run(void *arg) {
  job *j = arg;
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.seconds = 100;
  j->status = dyd_engine_run(&j->outcome, j->e, &o, NULL);
  return NULL;
}

/* FLINT and MPFR keep caches for each thread, which end with the thread only when asked to. */
static void *run_in_thread(void *arg) {
  run(arg);
  flint_cleanup();
  mpfr_free_cache();
  return NULL;
}

static void test_together(void **state) {
  (void)state;
  enum { COUNT = 4 };
  job alone[COUNT], together[COUNT];
  pthread_t thread[COUNT];
  for (int k = 0; k < COUNT; k++) {
    alone[k] = (job){make((uint64_t)k), DYD_OUTCOME_NONE, DYD_OK};
    together[k] = (job){make((uint64_t)k), DYD_OUTCOME_NONE, DYD_OK};
    run(&alone[k]);
  }
  for (int k = 0; k < COUNT; k++) assert_int_equal(0, pthread_create(&thread[k], NULL, run_in_thread, &together[k]));
  for (int k = 0; k < COUNT; k++) {
    pthread_join(thread[k], NULL);
    assert_int_equal(DYD_OK, together[k].status);
    assert_int_equal(DYD_OUTCOME_DECIDED, together[k].outcome);
    assert_same_statuses(alone[k].e, together[k].e);
    assert_int_equal(engine_counters(alone[k].e).calls, engine_counters(together[k].e).calls);
    dyd_engine_free(alone[k].e);
    dyd_engine_free(together[k].e);
  }
}

/* Cancelled again and again from another thread, and run on until it is done: the end is the same. */
static void *keep_cancelling(void *arg) {
  for (int k = 0; k < 200; k++) dyd_engine_cancel(arg);
  return NULL;
}

static void test_interrupted(void **state) {
  (void)state;
  dyd_engine *e = make(7), *calm = make(7);
  pthread_t thread;
  engine_run(calm, NULL, DYD_OUTCOME_DECIDED);
  assert_int_equal(0, pthread_create(&thread, NULL, keep_cancelling, e));
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  for (int k = 0; k < 1000 && outcome != DYD_OUTCOME_DECIDED; k++) {
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, NULL, NULL));
  }
  pthread_join(thread, NULL);
  assert_int_equal(DYD_OUTCOME_DECIDED, outcome);
  assert_same_statuses(calm, e);
  dyd_engine_free(calm);
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_together), cmocka_unit_test(test_interrupted)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
