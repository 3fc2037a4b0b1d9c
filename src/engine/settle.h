/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs that no refinement decides, since that hangs on where points are in their cores [SET-1] [SET-2]. */
#ifndef DYD_ENGINE_SETTLE_H
#define DYD_ENGINE_SETTLE_H

#include "engine/plan.h"
#include "engine/settle_face.h"

/* What is known about pairs, for ever unless points are measured again. Init with {0}. Invariant: item is
 * sorted by i, j, without repeats; next: from so many bits on it is worth trying again. */
typedef struct dyd_settled {
  dyd_settled_pair *item;
  size_t count, cap;
  int64_t next;
  uint64_t random;
} dyd_settled;

void dyd_settled_clear(dyd_settled *s);
/* Is the pair indeterminate for good? */
bool dyd_is_settled(const dyd_settled *s, const dyd_pair *pair);
/* Looks at pairs in undecided faces with cores and points that can be narrowed, when these are known to more
 * bits than most pairs need, and again each time they are known to four times as many. DYD_CANCELLED when e->stop was
 * seen. Bounded: about as long as a few first stages of the sites. */
dyd_status dyd_settle(dyd_settled *s, const dyd_plan *plan);

#endif
