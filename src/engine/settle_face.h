/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs of one undecided face, looked at one by one [SET-1]. */
#ifndef DYD_ENGINE_SETTLE_FACE_H
#define DYD_ENGINE_SETTLE_FACE_H

#include "engine/settle_firm.h"

/* possible: the pair is an edge for some choice of places in cores, wherever points are along the others;
 * unsure: it is not legal wherever they are narrowed to. */
typedef struct dyd_settled_pair {
  uint32_t i, j;
  bool possible, unsure;
} dyd_settled_pair;

static inline bool dyd_pair_is_settled(const dyd_settled_pair *p) {
  return p->possible && p->unsure;
}

/* Looks at open pairs of a face with the given sites, and writes down what is found. *work, in sites looked at, becomes
 * less; at 0 no more is done. DYD_CANCELLED when e->stop was seen. Nothing is found where no side has a core. */
dyd_status dyd_settle_face(dyd_settled_pair *pair, uint64_t *random, size_t *work, const dyd_engine *e, size_t pairs,
                           const dyd_index_list *face);

#endif
