/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dyadic points close to exact arcs, and the rectangles of the sites that they are asked about.
 *
 * A chord of a parabola between abscissae at distance h along its directrix is at most h^2 / (8 q) away from it, q the
 * distance of focus and directrix. */
#ifndef DYD_VORONOI_SAMPLE_H
#define DYD_VORONOI_SAMPLE_H

#include "base/memory.h"
#include "predicate/predicate_filter.h"
#include <dyadel/voronoi.h>

/* The cell's own rectangle and those of its possible neighbours, fetched once. */
typedef struct dyd_cell_sites {
  dyd_rect own;
  size_t count;
  uint32_t *site; /* ascending */
  dyd_rect *other;
  dyd_box *box; /* those of `other`, then own, in doubles; dyd_cell_sites_enclose makes it */
} dyd_cell_sites;
/* The neighbours with at least the status `least`. */
dyd_status dyd_cell_sites_init(dyd_cell_sites *s, const dyd_delaunay *pd, uint32_t i, dyd_pair_status least);
/* For dyd_cell_holds. */
dyd_status dyd_cell_sites_enclose(dyd_cell_sites *s);
void dyd_cell_sites_clear(dyd_cell_sites *s);
/* The rectangle of a possible neighbour. */
const dyd_rect *dyd_cell_site(const dyd_cell_sites *s, uint32_t site);
/* Returns true if c is in Int_i; after dyd_cell_sites_enclose. Exact. */
bool dyd_cell_holds(const dyd_cell_sites *s, const dyd_point *c);

/* A point of an arc: its beginning (step = 0), or the point number step of `steps` equal parts along the directrix. */
typedef struct dyd_arc_sample {
  const dyd_arc *arc, *before; /* before: the arc that ends where this one begins, when step = 0 */
  uint32_t step, steps;
} dyd_arc_sample;

/* Owned. most: the largest count allowed, 0: DYD_MOST_SAMPLES. */
enum { DYD_MOST_SAMPLES = 1 << 24 };
typedef struct dyd_arc_samples {
  size_t count, cap, most;
  dyd_arc_sample *item;
} dyd_arc_samples;

/* The samples of a closed chain, so close that every chord is within 2^-bits of its arc. far and near give the
 * rectangles of sites. Appended to *out. DYD_E_RANGE when more than `most` would be needed; DYD_E_NOMEM when *room
 * (NULL: no bound) has none for polygons with corners there. */
dyd_status dyd_chain_samples(dyd_arc_samples *out, const dyd_chain *chain, const dyd_cell_sites *s, uint32_t own,
                             int64_t bits, dyd_memory *memory);
/* The e with 2^(e-1) <= |x| + |y| < 2^e, so that (x, y) is shorter than 2^e; INT64_MIN / 2 where both are 0. */
int64_t dyd_log2_length(const mpq_t x, const mpq_t y);
/* The arcs of parabolas whose focus and directrix are at least 2^-(bits + DYD_NARROW) apart are measured with
 * bits + 4. */
enum { DYD_NARROW = 4 };
/* Into how many parts an arc of a parabola is cut whose ends are `length` 2^-(bits+5) apart along its directrix: the
 * focus is the end far_end of the side across it of site far, the directrix that of site near. */
dyd_status dyd_parabola_steps(uint32_t *out, const dyd_sites *sites, const uint32_t site[2], const int end[2],
                              int across, int64_t length, int64_t bits);
/* A dyadic point within 2^-bits of the sample in each coordinate; a multiple of 2^-(bits+1). */
dyd_status dyd_sample_point(dyd_point *out, const dyd_arc_sample *at, const dyd_cell_sites *s, uint32_t own,
                            int64_t bits);

#endif
