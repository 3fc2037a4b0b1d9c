/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a thread needs beside the skeleton that it asks about: scratch, counters, when to stop.
 *
 * Questions take a const skeleton and a work; nothing that only asks writes anywhere else. */
#ifndef DYD_SKELETON_WORK_H
#define DYD_SKELETON_WORK_H

#include "base/room.h"
#include "predicate/circle.h"
#include "skeleton/scale_set.h"
#include "skeleton/skeleton.h"

/* A site has at most this many critical circles with two others [CRIT-1]. */
enum { DYD_CIRCLES = 8 };

typedef struct dyd_work {
  const dyd_rects *rects;     /* who is asked: everybody, unless fewer will do; borrowed */
  const volatile int *cancel; /* NULL: nobody can */
  unsigned threads;           /* for passes over everything */
  bool keep_cut;              /* what is stopped while faces are closed counts as met by the cap */
  dyd_error *err;             /* NULL: nobody asks */
  dyd_room room;              /* for what is large */
  dyd_tally tally;            /* of the predicates of the mesh */
  dyd_delaunay_counters counters;
  dyd_scale_set set; /* scratch of the exact walks, reused from question to question */
  dyd_icircle here, next[DYD_CIRCLES];
  mpz_t u[2], h, s, t;
  /* The last pair was decided by the exact walk; if it is possible, that is seen in `place`, or, far, at infinity in
   * the direction u. Else it is seen at `centre`. */
  bool walked, far;
  dyd_bbox place;
  dyd_xy centre;
} dyd_work;

void dyd_work_init(dyd_work *w, const dyd_skeleton *sk, const volatile int *cancel);
/* For one task of a pass: as w, with counters of its own. */
void dyd_work_fork(dyd_work *task, const dyd_work *w, const dyd_skeleton *sk);
/* Adds what the task has counted to w, and clears it. */
void dyd_work_join(dyd_work *w, dyd_work *task);
void dyd_work_clear(dyd_work *w);
/* Adds what w has counted to the public counters. */
void dyd_work_count(dyd_delaunay_counters *sum, const dyd_work *w, const dyd_skeleton *sk);
static inline bool dyd_work_cancelled(const dyd_work *w) {
  return dyd_flag_is_set(w->cancel);
}

#endif
