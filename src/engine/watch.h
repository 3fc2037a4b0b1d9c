/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The clock of a run, and a helper thread that raises a flag at the deadline. */
#ifndef DYD_ENGINE_WATCH_H
#define DYD_ENGINE_WATCH_H

#include <pthread.h>
#include <stdbool.h>
#include <time.h>

/* Invariant: thread, lock and bell are live exactly when running; over is guarded by lock. */
typedef struct dyd_watch {
  double start, seconds;    /* of dyd_seconds; the limit, where there is one */
  struct timespec deadline; /* for the helper */
  bool limited, running, over;
  volatile int *flag;
  pthread_t thread;
  pthread_mutex_t lock;
  pthread_cond_t bell;
} dyd_watch;

/* Starts the clock. seconds > 0: *flag is set to 1 (atomically) when they have passed; where no thread can be had,
 * only dyd_watch_is_late tells. *w must not move until dyd_watch_stop. */
void dyd_watch_start(dyd_watch *w, double seconds, volatile int *flag);
/* After this *flag is not touched any more. */
void dyd_watch_stop(dyd_watch *w);
/* Is there a deadline, and has it passed? */
bool dyd_watch_is_late(const dyd_watch *w);
/* Wall-clock seconds since the start. */
double dyd_watch_seconds(const dyd_watch *w);

#endif
