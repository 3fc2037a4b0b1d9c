/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The run that questions about a skeleton belong to, and the scratch of one thread.
 *
 * Questions take a const skeleton and a work, write to that work only, and return their findings. */
#ifndef DYD_SKELETON_WORK_H
#define DYD_SKELETON_WORK_H

#include "base/memory.h"
#include "predicate/circle.h"
#include "rect/irect.h"
#include "skeleton/rects_filter.h"
#include "skeleton/skeleton.h"

/* A growing set of vertices with their rectangles as integers in one common scale, for the exact walks.
 *
 * The common factor is lcm * 2^-low. A newcomer may refine it; then all members are multiplied by `growth`, and callers
 * that keep numbers in the old scale multiply them too (dyd_scale_add says so). Directions need no change. */

typedef struct dyd_scale_set {
  const dyd_rects *rects;
  uint32_t *vertex;
  dyd_irect *rect;
  size_t count, made, vertex_cap, rect_cap;
  mpz_t lcm, growth, t;
  int64_t low;
  dyd_rect load;
} dyd_scale_set;

void dyd_scale_set_init(dyd_scale_set *s, const dyd_rects *rects);
void dyd_scale_set_clear(dyd_scale_set *s);
/* Forgets the members. */
void dyd_scale_set_empty(dyd_scale_set *s);
/* Makes v a member; *index is its place. *grown: the scale was refined by the factor s->growth. */
dyd_status dyd_scale_add(size_t *index, bool *grown, dyd_scale_set *s, uint32_t v);
/* Converts a box of doubles enclosing a point in scaled coordinates times 2^-shift into user coordinates, outward. */
int64_t dyd_scale_shift(const dyd_scale_set *s);
void dyd_scale_to_user(dyd_bbox *box, const dyd_scale_set *s);

/* A site has at most this many critical circles with two others [CRIT-1]. */
enum { DYD_CIRCLES = 8 };

/* Decides if sites i and j are possible neighbours for regions in their rectangles; returns false if it cannot. For
 * runs of one thread. */
typedef struct dyd_decider {
  bool (*tell)(bool *possible, void *context, uint32_t i, uint32_t j);
  void *context;
} dyd_decider;

/* Settings that all threads of a run share. */
typedef struct dyd_run {
  const volatile int *cancel; /* NULL: the run cannot be cancelled */
  unsigned threads;           /* for passes over everything */
  bool keep_cut;              /* faces that cancelling leaves open count as met by the cap */
  dyd_error *err;             /* may be NULL */
  const dyd_decider *decider; /* asked first for pairs that are not edges of the skeleton; may be NULL */
} dyd_run;

/* Of one thread. */
typedef struct dyd_work {
  const dyd_run *run;     /* borrowed */
  const dyd_rects *rects; /* of all vertices, or of the few that suffice; borrowed */
  dyd_memory memory;      /* for large allocations */
  dyd_tally tally;        /* of the predicates of the mesh */
  dyd_delaunay_counters counters;
  dyd_scale_set set; /* scratch of the exact walks, reused from question to question */
  dyd_icircle here, next[DYD_CIRCLES];
  mpz_t u[2], h, s, t;
} dyd_work;

/* run NULL: one thread, not cancelled. */
void dyd_work_init(dyd_work *w, const dyd_skeleton *sk, const dyd_run *run);
void dyd_work_clear(dyd_work *w);
/* For the items begin .. end - 1, which are range `number`. */
typedef dyd_status dyd_work_task(void *context, dyd_work *w, size_t number, size_t begin, size_t end);
/* Runs the task for each range of 0 .. count - 1 in the threads of the run: of several, each with a work of its own and
 * its share of the room. Their counters are added to w. Returns the first failure of a range. */
dyd_status dyd_work_ranges(dyd_work *w, const dyd_skeleton *sk, size_t count, dyd_work_task *task, void *context);
/* Adds what w has counted to the public counters: tests that were not passed on were answered by a filter. */
void dyd_work_count(dyd_delaunay_counters *sum, const dyd_work *w, const dyd_skeleton *sk);
static inline bool dyd_work_cancelled(const dyd_work *w) {
  return dyd_flag_is_set(w->run->cancel);
}

#endif
