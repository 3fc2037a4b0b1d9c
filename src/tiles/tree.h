/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Finding own sites by place: a tree of boxes, split at medians. */
#ifndef TILES_TREE_H
#define TILES_TREE_H

#include "reach.h"

/* Invariant: node 1 holds all sites; node k its half-ranges of order as 2k and 2k + 1, ranges of a few sites are
 * leaves; box[k] holds the sites of node k. */
typedef struct tiles_tree {
  uint32_t *order;
  tiles_box *box;
  size_t count;
} tiles_tree;
/* false: memory is exhausted. O(n log n). */
bool tiles_tree_make(tiles_tree *t, const tiles_sites *s);
void tiles_tree_clear(tiles_tree *t);

/* The sites that may meet `disc`, without those of `skip`; no more than `most` of them, those with the least scores. */
typedef struct tiles_search {
  const tiles_disc *disc;
  const tiles_set *skip;
  const bool *alias; /* which others to leave out; NULL: none */
  size_t most;
  /* The answer, ascending by score; cleared by the caller. */
  size_t count, room_site, room_score;
  uint32_t *site;
  double *score;
} tiles_search;
/* Replaces the answer. false: memory is exhausted. */
bool tiles_tree_search(tiles_search *q, const tiles_tree *t, const tiles_sites *s);
void tiles_search_clear(tiles_search *q);

#endif
