/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Scouts: a few points of a crowded face go ahead, to learn how far the others must go. */
#ifndef DYD_ENGINE_SCOUT_H
#define DYD_ENGINE_SCOUT_H

#include "engine/plan.h"

#define DYD_SCOUT_QUADS 4

/* Pairs (v[0], v[1]) and (v[2], v[3]) for which the quad rule could not prove that one cannot displace the other. */
typedef struct dyd_quad_sites {
  uint32_t v[4];
} dyd_quad_sites;

/* The scouts of one face. over: no quad can be taken further; bits > 0: a quad is decided, and about that many bits of
 * its points were needed for it.
 * Invariant: quads >= 2, no site twice. */
typedef struct dyd_race {
  dyd_quad_sites quad[DYD_SCOUT_QUADS];
  size_t quads;
  int64_t bits;
  bool over;
} dyd_race;

/* Init with {0}. Invariant: of = NULL or of[k] is 1 + the number of the last race added whose face has point k as an
 * end that is to be narrowed, 0 when there is none. */
typedef struct dyd_scouts {
  dyd_race *item;
  size_t count, cap;
  uint32_t *of;
} dyd_scouts;

void dyd_scouts_clear(dyd_scouts *s);
/* Looks for quads among the indeterminate pairs of a face with ends in the plan; adds a race when there are two or
 * more. */
dyd_status dyd_scouts_add(dyd_scouts *s, const dyd_plan *plan, const dyd_pair_list *pairs);
/* Judges the quads of all races; *out, empty, becomes the scouts of races that continue, which are narrowed further,
 * while all else in `held` waits. Nothing in *out: all races are over. */
dyd_status dyd_scouts_next(dyd_plan *out, dyd_scouts *s, dyd_plan *held);
/* *out, empty, becomes the wants that have waited, with more bits for the ends of decided races. */
void dyd_scouts_finish(dyd_plan *out, const dyd_scouts *s, const dyd_plan *held);

#endif
