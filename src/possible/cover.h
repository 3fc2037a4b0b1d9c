/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Is a pair possible? Decided exactly, by covering the curve of its centres (mathematics: section 5). */
#ifndef DYD_POSSIBLE_COVER_H
#define DYD_POSSIBLE_COVER_H

#include "predicate/icircle.h"
#include "skeleton/scale_set.h"

/* A blocker has at most this many critical circles [CRIT-1]. */
enum { DYD_CIRCLES = 8 };

/* Scratch of one thread, reused from pair to pair. */
typedef struct dyd_work {
  dyd_scale_set set;
  dyd_icircle here, next[DYD_CIRCLES];
  mpz_t u[2], h, s, t;
  bool walked; /* the last pair was decided by the exact walk */
} dyd_work;

void dyd_work_init(dyd_work *w, const dyd_delaunay *pd);
void dyd_work_clear(dyd_work *w);

/* *possible: is the pair of vertices i, j possible [POS-1]? Exact; in doubles where they tell. hint: two vertices that
 * are likely to block it (DYD_NONE: no idea); they only save steps. */
dyd_status dyd_cover_possible(bool *possible, dyd_work *w, dyd_delaunay *pd, uint32_t i, uint32_t j,
                              const uint32_t hint[2]);

#endif
