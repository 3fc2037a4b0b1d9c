/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What an engine holds, for the files of this folder:
 *
 *   engine.c        life, counters, results, and what points are called where they were read; adding points;
 *                   points of the engine as streams
 *   points.c        asking one point to narrow, measuring one again; answers of an earlier run; the statuses of
 *                   each stage
 *   wants.c          which points to narrow, and how far: a value
 *   ask.c           the loop: a question, its wants, narrowing, triangulating, until it is answered;
 *                   wants changed by a callback or a program
 *   run.c           the question of a run: does the goal hold, also one on the Voronoi diagram, and what to narrow
 *                   where it does not
 *   probe.c         a few points that go ahead of the others
 *   settle.c        pairs that no refinement decides
 *   nearest.c       the question after the nearest sites of a computable point
 *   ties.c          proofs about true points: ties, and points that are the same place
 *   converge.c      tables of runs, stage by stage, and the best choice, once all is known
 *   check.c         the harness of monotone refinement */
#ifndef DYD_ENGINE_STATE_H
#define DYD_ENGINE_STATE_H

#include "base/memory.h"
#include "engine/labels.h"
#include "rect/rect.h"

DYD_OWNERS(dyd_engine)

/* Bits for a proof that true points are the same, on one line or circle, unless others are given. */
#define DYD_TIE_BITS ((int64_t)1 << 17)

/* A point that can be asked to narrow. Everything else about a site is in the table of sites.
 * Invariant: stream is NULL exactly when the site belongs to a source; then `source` is the source's number.
 * bits is the precision last asked, meaningless before the first. */
typedef struct dyd_refinable {
  uint32_t site, source; /* guests of a question are numbered on from the sites */
  dyd_stream *stream;
  int64_t bits;
  int64_t needed; /* bits at which it showed that a tie with others is none (ties.c); 0: none was tried */
  uint64_t calls; /* how often the engine has asked it */
  bool final;     /* no call can narrow it further */
  bool asked;     /* has been brought to `bits` once */
  bool measured;  /* its rectangle has come to be narrower than what its stream or source gave: it was measured, or is
                     joined with another site */
} dyd_refinable;

/* A source that streams taken out of the engine use as well: released by the last of refs. */
typedef struct dyd_shared_source {
  size_t refs;
  dyd_source source;
} dyd_shared_source;

/* A first answer of a source in finite doubles, without -0, about as narrow as asked for; false: ask it as usual. */
typedef bool (*dyd_glance_fn)(double box[4], void *user, size_t point, int64_t bits);

/* A source and the site that is its point 0. shared: NULL until a stream is taken out; then it owns the source. glance:
 * may be NULL. */
typedef struct dyd_source_use {
  dyd_source source;
  dyd_glance_fn glance;
  uint32_t first;
  dyd_shared_source *shared;
} dyd_source_use;

/* A site at a place that stays in its rectangle: its true point, or where it has a region for good, number `place` of
 * these: the middle (0), a corner (1 to 4). */
enum { DYD_REGION_PLACES = 5 };
typedef struct dyd_site_place {
  uint32_t site;
  unsigned place;
} dyd_site_place;

/* Callbacks about the true points, and such places. prove_places: as prove, which is NULL where nothing is proved;
 * false where two places are the same. place: sets *out, the rectangle of the site, to one that holds the place. meet:
 * the regions that two sites keep, or the discs in them, have a point in common. */
typedef struct dyd_prover {
  dyd_prove_fn prove;
  dyd_status (*prove_places)(bool *proved, void *user, dyd_relation relation, const dyd_site_place *at, size_t count);
  dyd_status (*place)(dyd_rect *out, void *user, const dyd_site_place *at);
  dyd_status (*meet)(bool *proved, void *user, const uint32_t site[2], bool discs);
  void *user;
} dyd_prover;

typedef struct dyd_ties dyd_ties;
typedef struct dyd_recall dyd_recall;
typedef struct dyd_recalled dyd_recalled;

/* Invariant: point is sorted by site; changed lists (with repeats) the sites narrowed since pd was last brought up
 * to date; pd = NULL before the first complete stage. Sites of points never asked hold the whole plane.
 * Only engine.c, points.c and ask.c write here once the engine has been started: functions that choose or judge take it
 * const. */
struct dyd_engine {
  dyd_sites *sites;
  dyd_labels labels;
  dyd_confidence confidence; /* no probability: none was stated */
  dyd_refinable *point;
  size_t points, point_cap;
  dyd_source_use *source;
  size_t sources, source_cap;
  dyd_delaunay *pd;
  dyd_delaunay *former; /* the result before points came that can be put into it; NULL: none */
  uint32_t *changed;
  size_t changes, change_cap;
  size_t max_pairs;           /* the cap pd was last worked on with */
  bool cut;                   /* pd is capped since it was stopped, or since faces were postponed */
  bool postpones;             /* the question at work needs no pairs of faces whose sites can be narrowed */
  dyd_error cap_error;        /* its message when the cap was reached */
  dyd_delaunay_counters past; /* of results that points added later have ended */
  bool started;
  int busy; /* 1 while the loop is at work: neither callbacks nor other threads may enter it; only by atomic access */
  dyd_outcome outcome;
  dyd_goal goal; /* of the last run, with goal_bits */
  int64_t goal_bits;
  dyd_budget spent;
  uint64_t stages, calls;
  double seconds;
  dyd_recall *recall; /* answers known before the first run; NULL: none */
  dyd_ties *ties;     /* proofs requested about true points; NULL: none yet */
  int64_t tie_bits;
  int64_t proof_bits; /* the tie_bits pd was last worked on with; 0: no ties were looked for */
  dyd_tie_counters tie_counters;
  bool nearest_tied;      /* what the last question after nearest sites listed is a tie */
  dyd_prover prover;      /* asked instead of ties.c; nothing in it: none is */
  dyd_memory *memory;     /* of the question at work; NULL: none is */
  uint64_t bytes_most;    /* what rooms have seen */
  volatile int cancelled; /* set by dyd_engine_cancel; atomic access only, as for stop */
  volatile int stop;      /* set together with cancelled, and at a deadline; read by the triangulation */
  dyd_engine *follower;   /* cancelled together with this one; atomic access only; NULL: none */
};

static inline int dyd_flag_get(const volatile int *flag) {
  return __atomic_load_n(flag, __ATOMIC_SEQ_CST);
}
static inline void dyd_flag_set(volatile int *flag, int value) {
  __atomic_store_n(flag, value, __ATOMIC_SEQ_CST);
}

static inline bool dyd_engine_is_busy(const dyd_engine *e) {
  return dyd_flag_get(&e->busy);
}

#endif
