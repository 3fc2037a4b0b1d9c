/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Representatives: one point of each rectangle, the vertices of the skeleton.
 *
 * Any point of the rectangle will do for the theory; a short one is quick. Vertex v represents site site[v]. Its
 * representative is the double point xy[v] when that lies in the rectangle ("exact"), otherwise the rational point
 * lo + f (hi - lo), f from the dyadic sequence below, of which xy[v] is the nearest double up to `delta`. */
#ifndef DYD_SKELETON_REPS_H
#define DYD_SKELETON_REPS_H

#include "base/index.h"
#include "rect/sites_table.h"
#include "skeleton/rects_filter.h"

typedef struct dyd_xy {
  double x, y;
} dyd_xy;

/* Invariant: xy has n + 1 entries, the last one (the ghost vertex) is NaN. code = NULL: every representative is its
 * double point. code[v] = 0: the double point is exact; code[v] = k > 0: fraction number k - 1 of the rectangle.
 * delta bounds |double - exact representative| per coordinate over all v; 0 when code = NULL. */
typedef struct dyd_reps {
  const dyd_sites *sites;
  uint32_t n;
  uint32_t *site;
  dyd_xy *xy;
  uint32_t *code;
  double delta;
} dyd_reps;

/* Takes over the array site[n]; chooses fraction 0 (the middle) everywhere. box: becomes the sites' boxes in this
 * order; may be NULL. */
dyd_status dyd_reps_init(dyd_reps *r, dyd_bbox *box, const dyd_sites *sites, uint32_t *site, uint32_t n,
                         unsigned threads);
void dyd_reps_clear(dyd_reps *r);
/* Chooses the representative of v anew: the double nearest to fraction k if it lies in the rectangle (k = 0 only),
 * else the exact fraction k. Different k give different points of a rectangle that is not a point. */
dyd_status dyd_reps_choose(dyd_reps *r, uint32_t v, uint32_t k);
/* *stays: it is a double point in the present rectangle of v. */
dyd_status dyd_reps_stay(bool *stays, const dyd_reps *r, uint32_t v);
/* The exact representative of v as a singleton rectangle. */
dyd_status dyd_reps_get(dyd_rect *out, const dyd_reps *r, uint32_t v);
static inline bool dyd_reps_is_double(const dyd_reps *r, uint32_t v) {
  return !r->code || !r->code[v];
}

/* ---- spatial order of the sites: near in the plane, near in memory ---- */

/* Many sites are divided by vertical lines into strips, which are triangulated one by one and joined. */
enum { DYD_STRIPS = 8 };

/* Strip s has the vertices begin[s] .. begin[s + 1] - 1. Each strip is meant to lie left of the next; code that relies
 * on it compares the representatives. */
typedef struct dyd_strips {
  unsigned count;
  uint32_t begin[DYD_STRIPS + 1];
} dyd_strips;

/* order[0..n-1] (owned by the caller) becomes a permutation of the sites in the order of insertion: strip by strip;
 * within a strip exact points before fat rectangles; within each, two sparse samples first, then the rest; each along a
 * Hilbert curve. The same for every number of threads; only speed depends on it. O(n). */
dyd_status dyd_spatial_order(uint32_t *order, dyd_strips *strips, const dyd_sites *sites, unsigned threads);

#endif
