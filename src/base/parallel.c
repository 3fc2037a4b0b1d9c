/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tasks are taken from one counter; helper threads live as long as one call. */
#include "base/parallel.h"

#include <signal.h>
#include <stdbool.h>

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
