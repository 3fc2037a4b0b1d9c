/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Whoever comes last, the thread that is done or the caller who leaves, takes care of the job. */
#include "base/apart.h"

#include "base/flag.h"
#include "base/parallel.h"

#include <stdlib.h>
#include <time.h>

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

/* The flag may be set by a signal handler, which can wake nobody: so it is looked at again and again. */
static void errand_wait(const errand *e, const volatile int *stop) {
  struct timespec pause = {.tv_nsec = 20000};
  while (__atomic_load_n(&e->state, __ATOMIC_ACQUIRE) == AT_WORK && !dyd_flag_is_set(stop)) {
    nanosleep(&pause, NULL);
    if (pause.tv_nsec < 5000000) pause.tv_nsec += pause.tv_nsec / 4;
  }
}

bool dyd_apart(void (*work)(void *job), void (*drop)(void *job), void *job, const volatile int *stop) {
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
