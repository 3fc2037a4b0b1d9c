/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The clock of a run, and a helper thread that raises a flag at the deadline. */
#include "engine/watch.h"

#include "base/clock.h"
#include "base/parallel.h"

/* Longer limits than this, about thirty years, are none. */
#define LONGEST 1e9

static void *watch_wait(void *arg) {
  dyd_watch *w = arg;
  int late = 0;
  pthread_mutex_lock(&w->lock);
  while (!w->over && !late) late = pthread_cond_timedwait(&w->bell, &w->lock, &w->deadline);
  if (!w->over) __atomic_store_n(w->flag, 1, __ATOMIC_SEQ_CST);
  pthread_mutex_unlock(&w->lock);
  return NULL;
}

static bool watch_init_bell(pthread_cond_t *bell) {
  pthread_condattr_t attr;
  if (pthread_condattr_init(&attr)) return false;
  bool done = !pthread_condattr_setclock(&attr, CLOCK_MONOTONIC) && !pthread_cond_init(bell, &attr);
  pthread_condattr_destroy(&attr);
  return done;
}

static bool watch_start_helper(dyd_watch *w) {
  if (pthread_mutex_init(&w->lock, NULL)) return false;
  if (watch_init_bell(&w->bell)) {
    if (dyd_start_helpers(&w->thread, 1, watch_wait, w)) return true;
    pthread_cond_destroy(&w->bell);
  }
  pthread_mutex_destroy(&w->lock);
  return false;
}

void dyd_watch_start(dyd_watch *w, double seconds, volatile int *flag) {
  w->start = dyd_seconds();
  w->seconds = seconds;
  w->limited = seconds > 0 && seconds < LONGEST;
  w->running = w->over = false;
  w->flag = flag;
  if (!w->limited) return;
  double end = w->start + seconds;
  w->deadline.tv_sec = (time_t)end;
  w->deadline.tv_nsec = (long)((end - (double)w->deadline.tv_sec) * 1e9);
  w->running = watch_start_helper(w);
}

void dyd_watch_stop(dyd_watch *w) {
  if (!w->running) return;
  pthread_mutex_lock(&w->lock);
  w->over = true;
  pthread_cond_signal(&w->bell);
  pthread_mutex_unlock(&w->lock);
  pthread_join(w->thread, NULL);
  pthread_cond_destroy(&w->bell);
  pthread_mutex_destroy(&w->lock);
  w->running = false;
}

bool dyd_watch_is_late(const dyd_watch *w) {
  return w->limited && dyd_watch_seconds(w) >= w->seconds;
}

double dyd_watch_seconds(const dyd_watch *w) {
  return dyd_seconds() - w->start;
}
