/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Inside the engine: what it holds, and how its files share the work.
 *
 *   points.c     adding points, asking one point to narrow
 *   schedule.c   which points to narrow next, and how far
 *   scout.c      a few points that go ahead of the others
 *   coarse.c     which sites of a face are coarse for their distances
 *   converge.c   tables of runs, stage by stage
 *   goal_voronoi.c  goals on the Voronoi diagram
 *   compose.c    points of the engine as streams
 *   nearest.c    nearest sites of a computable point
 *   watch.c      the clock, and stopping work at a deadline
 *   run.c        the one loop
 *   engine.c     life, counters, results */
#ifndef DYD_ENGINE_ENGINE_H
#define DYD_ENGINE_ENGINE_H

#include "metric/voronoi_bounds.h"
#include <dyadel/engine.h>

/* A site that can be asked to narrow. Everything else about a site is in the table of sites.
 * Invariant: stream is NULL exactly when the site belongs to a source; then `source` is the source's number.
 * bits is the precision last asked, meaningless while calls = 0 and not final; want > bits or calls = 0 when marked. */
typedef struct dyd_refinable {
  uint32_t site, source;
  dyd_stream *stream;
  int64_t bits, want;
  uint64_t calls;    /* how often the engine has asked it */
  bool final;        /* no call can narrow it further */
  bool marked;       /* to be narrowed to `want` in this stage */
  bool held;         /* was marked, and will be again when scouts have gone ahead (scout.h) */
  bool asked;        /* has been brought to `bits` once */
  dyd_reason reason; /* of the mark, with the pair it names */
  uint32_t pair[2];
} dyd_refinable;

/* A source that streams taken out of the engine use as well: released by the last of refs. */
typedef struct dyd_shared_source {
  size_t refs;
  dyd_source source;
} dyd_shared_source;

/* A source and the site that is its point 0. shared: NULL until a stream is taken out; then it owns the source. */
typedef struct dyd_source_use {
  dyd_source source;
  uint32_t first;
  dyd_shared_source *shared;
} dyd_source_use;

/* Invariant: point is sorted by site; changed lists (with repeats) the sites narrowed since pd was last brought up
 * to date; pd = NULL before the first complete stage. Sites of points never asked hold the whole plane. */
struct dyd_engine {
  dyd_sites *sites;
  dyd_refinable *point;
  size_t points, point_cap;
  dyd_source_use *source;
  size_t sources, source_cap;
  dyd_delaunay *pd;
  uint32_t *changed;
  size_t changes, change_cap;
  size_t max_pairs;    /* the cap pd was last worked on with */
  dyd_error cap_error; /* what it said when the cap was met */
  bool started;
  dyd_outcome outcome;
  dyd_goal goal; /* of the last run, with goal_bits */
  int64_t goal_bits;
  dyd_budget spent;
  uint64_t stages, calls;
  double seconds;
  dyd_voronoi_sums *sums; /* between a goal on the Voronoi diagram that does not hold and its plan; else NULL */
  volatile int cancelled; /* set by dyd_engine_cancel; atomic access only, as for stop */
  volatile int stop;      /* set together with cancelled, and at a deadline; read by the triangulation */
};

static inline int dyd_flag_get(const volatile int *flag) {
  return __atomic_load_n(flag, __ATOMIC_SEQ_CST);
}
static inline void dyd_flag_set(volatile int *flag, int value) {
  __atomic_store_n(flag, value, __ATOMIC_SEQ_CST);
}

/* ---- points.c ---- */

/* The refinable point of a site, NULL when the site is fixed. O(log points). */
dyd_refinable *dyd_engine_find(const dyd_engine *e, uint32_t site);
/* Brings one point to precision bits (2^-bits) and its site in the table with it; *calls counts calls made (0 when the
 * point was that narrow before). On failure the site and p->bits are as before, and err names site and stage; so they
 * are for DYD_CANCELLED, which a source returns when it saw e->stop raised. */
dyd_status dyd_engine_narrow(dyd_refinable *p, uint64_t *calls, dyd_engine *e, int64_t bits, int64_t max_bits,
                             dyd_error *err);
/* Tells the sources that want to know which of their points are marked, in the order in which narrowing will come to
 * them, `most` points of such sources at most. */
void dyd_engine_announce(const dyd_engine *e, uint64_t most, int64_t max_bits);
/* Releases streams and sources. */
void dyd_engine_clear_points(dyd_engine *e);

/* ---- compose.c ---- */

void dyd_shared_source_free(dyd_shared_source *s);

/* ---- goal_voronoi.c ---- */

static inline bool dyd_goal_is_voronoi(dyd_goal goal) {
  return goal == DYD_GOAL_VORONOI_AREA || goal == DYD_GOAL_VORONOI_HAUSDORFF;
}
/* Is there a window, of positive area and with dyadic ends? */
bool dyd_engine_window_is_good(const dyd_rect *window);
/* Does the goal, one of those two, hold? Keeps what it found out in e->sums for the plan. */
dyd_status dyd_engine_voronoi_holds(bool *out, dyd_engine *e, const dyd_engine_options *o);
/* What a pair contributes to the bound; infinite when its rectangles meet. After dyd_engine_voronoi_holds. */
dyd_status dyd_engine_voronoi_number(mpfr_ptr out, dyd_engine *e, dyd_measure *m, const dyd_pair *pair,
                                     const dyd_engine_options *o);
/* By how many bits the enclosure of the Voronoi vertex of a sure triangle is wider than 2^-M; at most 0 when it is not,
 * or lies outside of the window. */
dyd_status dyd_engine_vertex_excess(int64_t *out, const dyd_engine *e, const dyd_triangle *t,
                                    const dyd_engine_options *o);
/* Gives back e->sums. */
void dyd_engine_voronoi_forget(dyd_engine *e);

/* ---- schedule.c ---- */

/* Does the goal hold for the current result? */
dyd_status dyd_engine_goal_holds(bool *out, dyd_engine *e, const dyd_engine_options *o);

typedef struct dyd_scouts dyd_scouts;

typedef struct dyd_plan {
  size_t marked;     /* points to narrow */
  bool bits_blocked; /* some point would have been marked, but was asked for max_bits before */
} dyd_plan;

/* Marks the points to narrow next towards a goal that does not hold. Needs a result that is up to date. Adds to
 * *scouts, just initialised, what may go ahead. */
dyd_status dyd_engine_plan(dyd_plan *out, dyd_scouts *scouts, dyd_engine *e, const dyd_engine_options *o);
/* Marks the points never asked, for the first stage. */
void dyd_engine_plan_first(dyd_plan *out, dyd_engine *e, const dyd_engine_options *o);

#endif
