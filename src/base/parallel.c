/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tasks are taken from one counter; helper threads live as long as one call. */
#include "base/parallel.h"

#include "base/flag.h"

#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>
#include <time.h>

/* ---- work apart: the last owner, the thread that is done or the caller that leaves, frees the job ---- */

enum { AT_WORK, DONE, LEFT };

typedef struct errand {
  void (*work)(void *), (*drop)(void *);
  void *job;
  int state;
} errand;

static void *errand_run(void *arg) {
  errand *e = arg;
  e->work(e->job);
  if (__atomic_exchange_n(&e->state, DONE, __ATOMIC_ACQ_REL) == LEFT) {
    e->drop(e->job);
    free(e);
  }
  return NULL;
}

/* A signal handler, which cannot wake a thread, may set the flag: so it is polled. */
static void errand_wait(const errand *e, const volatile int *stop) {
  struct timespec pause = {.tv_nsec = 20000};
  while (__atomic_load_n(&e->state, __ATOMIC_ACQUIRE) == AT_WORK && !dyd_flag_is_set(stop)) {
    nanosleep(&pause, NULL);
    if (pause.tv_nsec < 5000000) pause.tv_nsec += pause.tv_nsec / 4;
  }
}

bool dyd_run_detached(void (*work)(void *job), void (*drop)(void *job), void *job, const volatile int *stop) {
  pthread_t thread;
  errand *e = stop ? malloc(sizeof *e) : NULL;
  if (e) *e = (errand){work, drop, job, AT_WORK};
  if (!e || !dyd_start_helpers(&thread, 1, errand_run, e)) {
    free(e);
    work(job);
    return true;
  }
  errand_wait(e, stop);
  bool done = __atomic_exchange_n(&e->state, LEFT, __ATOMIC_ACQ_REL) == DONE;
  if (!done) return pthread_detach(thread), false;
  pthread_join(thread, NULL);
  free(e);
  return true;
}

enum { MOST_THREADS = 64 };

typedef struct crew {
  dyd_task *task;
  void *context;
  size_t tasks, next;
} crew;

static void *work_on_tasks(void *arg) {
  crew *c = arg;
  for (;;) {
    size_t k = __atomic_fetch_add(&c->next, 1, __ATOMIC_RELAXED);
    if (k >= c->tasks) return NULL;
    c->task(c->context, k);
  }
}

unsigned dyd_start_helpers(pthread_t *helper, unsigned want, void *(*work)(void *), void *context) {
  sigset_t all, before;
  unsigned started = 0;
  sigfillset(&all);
  if (want == 0 || pthread_sigmask(SIG_SETMASK, &all, &before)) return 0;
  while (started < want && pthread_create(&helper[started], NULL, work, context) == 0) started++;
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  return started;
}

void dyd_parallel(unsigned threads, size_t tasks, dyd_task *task, void *context) {
  pthread_t helper[MOST_THREADS];
  crew c = {task, context, tasks, 0};
  size_t want = threads < 1 ? 1 : threads > MOST_THREADS ? MOST_THREADS : threads;
  if (want > tasks) want = tasks;
  unsigned started = dyd_start_helpers(helper, want ? (unsigned)want - 1 : 0, work_on_tasks, &c);
  work_on_tasks(&c);
  while (started) pthread_join(helper[--started], NULL);
}

#ifdef DYD_ARMED
enum { RANGE_LEAST = 5 };
#else
enum { RANGE_LEAST = 1 << 13 };
#endif

size_t dyd_ranges(size_t count) {
  size_t n = count / RANGE_LEAST;
  return n < 1 ? 1 : n > DYD_RANGES_MOST ? DYD_RANGES_MOST : n;
}

size_t dyd_range_begin(size_t count, size_t number) {
  size_t n = dyd_ranges(count);
  return count / n * number + (number < count % n ? number : count % n);
}

typedef struct range_crew {
  dyd_range_task *task;
  void *context;
  size_t count;
} range_crew;

static void work_on_range(void *context, size_t number) {
  const range_crew *c = context;
  c->task(c->context, number, dyd_range_begin(c->count, number), dyd_range_begin(c->count, number + 1));
}

size_t dyd_parallel_ranges(unsigned threads, size_t count, dyd_range_task *task, void *context) {
  range_crew c = {task, context, count};
  dyd_parallel(threads, dyd_ranges(count), work_on_range, &c);
  return dyd_ranges(count);
}
