/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which pairs of a face can be possible, in doubles: the plane is cut into patches until few sites are possibly nearest
 * in each: a quick way for faces in which many rectangles overlap, where closure under flips would examine many quads
 * for every pair. */
#ifndef DYD_POSSIBLE_PATCHES_FILTER_H
#define DYD_POSSIBLE_PATCHES_FILTER_H

#include "possible/pair_map.h"
#include "skeleton/mesh.h"
#include "skeleton/rects_filter.h"
#include "skeleton/reps.h"
#include "skeleton/work.h"

/* The members' vertices, ascending; the map of pairs, in which only pairs without a state are looked up; found sets the
 * state of a pair shown to be possible, decide sets that of a pair for which patches do not suffice; both set *enough
 * to end the search. All borrowed. */
typedef struct dyd_patches {
  const dyd_rects *rects;
  const volatile int *cancel;
  const uint32_t *vertex;
  uint32_t vertices;
  const dyd_pair_map *map;
  dyd_status (*found)(void *context, bool *enough, uint32_t a, uint32_t b);
  dyd_status (*decide)(void *context, bool *enough, uint32_t a, uint32_t b);
  void *context;
} dyd_patches;

/* *complete: every possible pair of members has its state. Else doubles do not decide enough, or *enough was set. */
dyd_status dyd_patches_run(bool *complete, const dyd_patches *c);

/* Certainly kl cannot displace ij: their hulls' boxes are disjoint, or l is certainly outside the circle of i, j, k
 * [QUAD-1].
 */
bool dyd_surely_not_displaced(const dyd_skeleton *sk, uint32_t i, uint32_t j, uint32_t k, uint32_t l);

/* near[k]: vertex[k] is proved possibly nearest at c; all such vertices make possible pairs [POS-1]. */
void dyd_filter_clique(bool *near, const dyd_rects *r, dyd_xy c, const uint32_t *vertex, size_t count);

#endif
