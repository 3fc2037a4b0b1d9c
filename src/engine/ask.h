/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The loop of all questions. */
#ifndef DYD_ENGINE_ASK_H
#define DYD_ENGINE_ASK_H

#include "engine/state.h"
#include "engine/wants.h"
#include "metric/bounds.h"

#include <pthread.h>
#include <stdbool.h>
#include <time.h>

/* The clock of a run, and a helper thread that raises a flag at the deadline. */

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

/* Starts the clock. seconds > 0: *flag is set to 1 (atomically) when they have passed; where no thread can be started,
 * only watch_is_late shows it. *w must not move until dyd_watch_stop. */
void dyd_watch_start(dyd_watch *w, double seconds, volatile int *flag);
/* After this *flag is not touched any more. */
void dyd_watch_stop(dyd_watch *w);

/* The precision at which to give up, unless options say otherwise. */
enum { DYD_BITS_ENOUGH = 4096 };
/* Fills in defaults. Returns NULL, or which option that every question heeds is out of its range. */
const char *dyd_ask_options(dyd_engine_options *o);
/* DYD_E_ARG, with a message, when the loop is at work and the call comes from one of its callbacks. */
dyd_status dyd_ask_may_begin(const dyd_engine *e, dyd_error *err);
/* dyd_engine_ask; *spent: the budget that was reached. *err, which may be NULL, is clear unless the call failed or the
 * budget of pairs was met. */
dyd_status dyd_ask(dyd_outcome *outcome, dyd_budget *spent, dyd_engine *e, const dyd_question *question,
                   const dyd_engine_options *options, dyd_error *err);

static inline bool dyd_goal_is_voronoi(dyd_goal goal) {
  return goal == DYD_GOAL_VORONOI_AREA || goal == DYD_GOAL_VORONOI_HAUSDORFF;
}
/* Sets *out to whether the other goals hold for pd; m: of its sites. */
dyd_status dyd_goal_of_pairs_holds(bool *out, dyd_measure *m, const dyd_delaunay *pd, const dyd_engine_options *o);

#endif
