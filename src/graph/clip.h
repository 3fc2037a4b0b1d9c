/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points in a box, and a level: is there a place from which all of them are at least so far? */
#ifndef DYD_GRAPH_CLIP_H
#define DYD_GRAPH_CLIP_H

#include "rect/irect.h"

typedef struct dyd_clip_point {
  mpz_t at[2];
} dyd_clip_point;

/* level^2 (x, y) is the sum of (x - level[0])^2, unless flat[0], and the like of y. */
typedef struct dyd_clip {
  const dyd_irect *box; /* borrowed */
  mpz_t level[2];
  bool flat[2];
  dyd_clip_point *point;
  size_t count, cap;
} dyd_clip;

void dyd_clip_init(dyd_clip *c, const dyd_irect *box);
void dyd_clip_clear(dyd_clip *c);
/* NULL: this coordinate does not count. */
void dyd_clip_level(dyd_clip *c, int axis, mpz_srcptr at);
/* One point more; a point that is far enough from everywhere in the box is left out. false: memory is exhausted. */
bool dyd_clip_add(dyd_clip *c, mpz_srcptr x, mpz_srcptr y);
/* *room: somewhere in the box all points are at least as far as the level there. O(count^2). false: memory is
 * exhausted. */
bool dyd_clip_has_room(bool *room, const dyd_clip *c);

#endif
