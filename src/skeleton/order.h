/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Spatial order of the sites: near in the plane, near in memory. */
#ifndef DYD_SKELETON_ORDER_H
#define DYD_SKELETON_ORDER_H

#include "base/index.h"
#include "rect/sites_table.h"

/* Many sites are divided by vertical lines into strips, which are triangulated one by one and joined. */
enum { DYD_STRIPS = 8 };

/* Strip s has the vertices begin[s] .. begin[s + 1] - 1. Each strip is meant to lie left of the next; whoever relies on
 * it asks the representatives. */
typedef struct dyd_strips {
  unsigned count;
  uint32_t begin[DYD_STRIPS + 1];
} dyd_strips;

/* order[0..n-1] (owned by the caller) becomes a permutation of the sites in the order of insertion: strip by strip;
 * within a strip exact points before fat rectangles; within each, two sparse samples first, then the rest; each along a
 * Hilbert curve. The same for every number of threads; only speed depends on it. O(n). */
dyd_status dyd_spatial_order(uint32_t *order, dyd_strips *strips, const dyd_sites *sites, unsigned threads);

#endif
