/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which pairs of a face can be possible: the plane is cut into patches until few sites are possibly nearest in each.
 *
 * A quick way for faces in which many rectangles overlap, where closure under flips would look at many quads for every
 * pair. */
#ifndef DYD_POSSIBLE_PATCHES_FILTER_H
#define DYD_POSSIBLE_PATCHES_FILTER_H

#include "possible/pair_map.h"
#include "skeleton/mesh.h"
#include "skeleton/rects.h"

/* Two members, a < b. */
typedef struct dyd_member_pair {
  uint32_t a, b;
} dyd_member_pair;

/* Input: the members' vertices, ascending; the map of pairs, in which only pairs without a state are asked for; found,
 * which gives the state of a pair shown to be possible and sets *enough to end the search. All borrowed.
 * Output, when complete: every possible pair of members that has no state by then is in left[0..count-1]. Init with {0}
 * and release with dyd_patches_clear. */
typedef struct dyd_patches {
  const dyd_rects *rects;
  const volatile int *cancel;
  const uint32_t *vertex;
  uint32_t vertices;
  const dyd_pair_map *map;
  dyd_status (*found)(void *context, bool *enough, uint32_t a, uint32_t b);
  void *context;
  dyd_member_pair *left;
  size_t count, cap;
} dyd_patches;

/* *complete: false when the doubles do not tell enough (or `found` had enough), and left means nothing. */
dyd_status dyd_patches_run(bool *complete, dyd_patches *c);
void dyd_patches_clear(dyd_patches *c);

#endif
