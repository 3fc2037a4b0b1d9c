/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Work on a thread of its own: it is done once, a caller that leaves returns at once, and the last owner frees the job.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include "base/clock.h"
#include "base/parallel.h"

/* Works until the flag allows it to end. */
typedef struct job {
  int may_end, begun, done, dropped;
  pthread_t by;
} job;

static void pause_a_little(void) {
  const struct timespec little = {.tv_nsec = 1000000};
  nanosleep(&little, NULL);
}

static void job_work(void *arg) {
  job *j = arg;
  j->by = pthread_self();
  __atomic_store_n(&j->begun, 1, __ATOMIC_SEQ_CST);
  while (!__atomic_load_n(&j->may_end, __ATOMIC_SEQ_CST)) pause_a_little();
  __atomic_fetch_add(&j->done, 1, __ATOMIC_SEQ_CST);
}

static void job_drop(void *arg) {
  job *j = arg;
  __atomic_fetch_add(&j->dropped, 1, __ATOMIC_SEQ_CST);
}

static void test_done(void **state) {
  (void)state;
  volatile int stop = 0;
  for (int k = 0; k < 200; k++) {
    job j = {.may_end = 1};
    assert_true(dyd_run_detached(job_work, job_drop, &j, &stop));
    assert_int_equal(1, j.done);
    assert_int_equal(0, j.dropped);
    assert_false(pthread_equal(pthread_self(), j.by));
  }
}

/* The caller cannot leave, so the job runs on its own thread. */
static void test_nobody_waits(void **state) {
  (void)state;
  job j = {.may_end = 1};
  assert_true(dyd_run_detached(job_work, job_drop, &j, NULL));
  assert_int_equal(1, j.done);
  assert_int_equal(0, j.dropped);
  assert_true(pthread_equal(pthread_self(), j.by));
}

typedef struct stopper {
  volatile int stop;
  job *of;
} stopper;

static void *stop_when_begun(void *arg) {
  stopper *s = arg;
  while (!__atomic_load_n(&s->of->begun, __ATOMIC_SEQ_CST)) pause_a_little();
  __atomic_store_n(&s->stop, 1, __ATOMIC_SEQ_CST);
  return NULL;
}

static void test_left(void **state) {
  (void)state;
  static job j;
  stopper s = {.of = &j};
  pthread_t thread;
  j = (job){.may_end = 0};
  assert_int_equal(0, pthread_create(&thread, NULL, stop_when_begun, &s));
  assert_false(dyd_run_detached(job_work, job_drop, &j, &s.stop));
  assert_int_equal(0, pthread_join(thread, NULL));
  assert_int_equal(0, __atomic_load_n(&j.done, __ATOMIC_SEQ_CST));
  assert_int_equal(0, __atomic_load_n(&j.dropped, __ATOMIC_SEQ_CST));
  __atomic_store_n(&j.may_end, 1, __ATOMIC_SEQ_CST);
  double begun = dyd_seconds();
  while (!__atomic_load_n(&j.dropped, __ATOMIC_SEQ_CST) && dyd_seconds() - begun < 60) pause_a_little();
  assert_int_equal(1, __atomic_load_n(&j.done, __ATOMIC_SEQ_CST));
  assert_int_equal(1, __atomic_load_n(&j.dropped, __ATOMIC_SEQ_CST));
}

/* Both at the same time: either the caller has the job, or the thread drops it; never both, never neither. */
static void test_at_once(void **state) {
  (void)state;
  enum { TRIES = 300 };
  static job j[TRIES];
  for (int k = 0; k < TRIES; k++) {
    stopper s = {.of = &j[k]};
    pthread_t thread;
    j[k] = (job){.may_end = 1};
    assert_int_equal(0, pthread_create(&thread, NULL, stop_when_begun, &s));
    bool done = dyd_run_detached(job_work, job_drop, &j[k], &s.stop);
    assert_int_equal(0, pthread_join(thread, NULL));
    double begun = dyd_seconds();
    while (!done && !__atomic_load_n(&j[k].dropped, __ATOMIC_SEQ_CST) && dyd_seconds() - begun < 60) pause_a_little();
    assert_int_equal(!done, __atomic_load_n(&j[k].dropped, __ATOMIC_SEQ_CST));
    assert_int_equal(1, __atomic_load_n(&j[k].done, __ATOMIC_SEQ_CST));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_done), cmocka_unit_test(test_nobody_waits),
                                     cmocka_unit_test(test_left), cmocka_unit_test(test_at_once)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
