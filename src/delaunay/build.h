/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Building everything from the sites, at first or again. */
#ifndef DYD_DELAUNAY_BUILD_H
#define DYD_DELAUNAY_BUILD_H

#include "possible/cover.h"

/* Legal pairs known from before, as sites; they are in every skeleton and stay legal. */
typedef struct dyd_known {
  const dyd_pair *pair;
  size_t count;
} dyd_known;

/* Fills an object that has only sites, options and counters. On failure it is cleared back to that. */
dyd_status dyd_build(dyd_delaunay *pd, dyd_known known);
void dyd_build_clear(dyd_delaunay *pd);
/* The triangle corner of directed edge from v to w: triangle on its left, or DYD_NONE if there is no such edge.
 * w may be the ghost. */
uint32_t dyd_find_edge(const dyd_delaunay *pd, uint32_t v, uint32_t w);

/* How many pairs are legal, that is certain edges that are real. O(n), a byte for each triangle. */
uint64_t dyd_certain_edges(const dyd_delaunay *pd);

/* Are v and w (not the ghost) joined by a certain edge of the skeleton? */
bool dyd_is_legal(const dyd_delaunay *pd, uint32_t v, uint32_t w);

#endif
