/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Several engines in several threads give the results of one alone. For the thread sanitizer as well. */
#include "engine/help.h"

#include <flint/flint.h>
#include <mpfr.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

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

/* ---- one engine in two threads ---- */

typedef struct gate {
  sem_t inside, open;
} gate;

/* The first answer waits at the gate. */
static dyd_status wait_at_gate(dyd_rect *out, void *user, const dyd_request *q, dyd_error *err) {
  gate *g = user;
  (void)q;
  sem_post(&g->inside);
  sem_wait(&g->open);
  sem_post(&g->open);
  return dyd_rect_set_text(out, "2.5 3.5", 7, err);
}

/* While one thread is in a run, the other one is refused whatever would change the engine, and the run does not notice;
 * afterwards both may use it. */
static void test_entered_twice(void **state) {
  (void)state;
  gate g;
  pthread_t thread;
  dyd_engine *e = make(3), *calm = make(3);
  dyd_source source = {DYD_SIZED(dyd_source), .narrow = wait_at_gate, .user = &g};
  sem_init(&g.inside, 0, 0);
  sem_init(&g.open, 0, 0);
  assert_int_equal(DYD_OK, dyd_engine_add_source(e, 1, &source, NULL));
  assert_int_equal(DYD_OK, dyd_engine_add_text(calm, "2.5 3.5", 7, NULL, NULL));
  job j = {e, DYD_OUTCOME_NONE, DYD_OK};
  assert_int_equal(0, pthread_create(&thread, NULL, run_in_thread, &j));
  sem_wait(&g.inside);
  dyd_outcome outcome;
  dyd_error err;
  dyd_rect r;
  const double at = 1;
  dyd_rect_init(&r);
  for (int k = 0; k < 100; k++) {
    assert_int_equal(DYD_E_ARG, dyd_engine_run(&outcome, e, NULL, &err));
    assert_non_null(strstr(err.message, "no other thread"));
    assert_int_equal(DYD_OUTCOME_ERROR, outcome);
    assert_int_equal(DYD_E_ARG, dyd_engine_add_points(e, 1, &at, &at, &err));
    assert_int_equal(DYD_E_ARG, dyd_engine_remeasure(e, 0, &r, &err));
  }
  sem_post(&g.open);
  pthread_join(thread, NULL);
  assert_int_equal(DYD_OK, j.status);
  engine_run(calm, NULL, j.outcome);
  assert_same_statuses(calm, e);
  engine_run(e, NULL, j.outcome);
  dyd_rect_clear(&r);
  dyd_engine_free(calm);
  dyd_engine_free(e);
}

/* ---- ownership ---- */

static void free_at_work(void *user, const dyd_progress *p) {
  (void)p;
  dyd_engine_free(user);
}

/* The armed library says so at once; what else is used after it was freed, the address sanitizer finds. */
static void test_freed_at_work(void **state) {
  (void)state;
  int status = 0;
  fflush(NULL);
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    dyd_engine *e = make(5);
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.progress = free_at_work;
    o.progress_user = e;
    signal(SIGABRT, SIG_DFL);
    dyd_engine_run(&(dyd_outcome){DYD_OUTCOME_NONE}, e, &o, NULL);
    _exit(0);
  }
  assert_int_equal(child, waitpid(child, &status, 0));
  assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_together), cmocka_unit_test(test_interrupted),
                                     cmocka_unit_test(test_entered_twice), cmocka_unit_test(test_freed_at_work)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
