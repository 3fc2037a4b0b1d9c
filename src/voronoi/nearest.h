/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Nearest sites: candidates, and tests in doubles on a side of the query. */
#ifndef DYD_VORONOI_NEAREST_H
#define DYD_VORONOI_NEAREST_H

#include "delaunay/state.h"
#include "skeleton/skeleton.h"

/* Finds vertices, among them all that are possibly nearest to some point of q. Up to rounding, none is among them that
 * certainly nearer sites rule out. *vertex is owned by the caller. */
dyd_status dyd_near_candidates(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, const dyd_rect *q);

/* Walks from vertex *v towards z. True: *v is the only vertex that is nearest to z for some choice [NEAR-7]. False:
 * that is not seen. */
bool dyd_filter_near_walk(uint32_t *v, const dyd_delaunay *pd, dyd_xy z);

/* A rational rectangle x0 x1 y0 y1, its outward box, and by how much that may be too large. */
typedef struct dyd_near_site {
  mpq_t e[4];
  dyd_bbox box;
  double slack;
} dyd_near_site;

/* A side of the query: the points with coordinate `across` on the other axis and lo <= coordinate <= hi on `axis`. */
typedef struct dyd_near_side {
  int axis;
  mpq_srcptr lo, hi, across;
} dyd_near_side;

/* Doubles around the place at + sqrt(root) of a side. */
void dyd_filter_place(dyd_bbox *c, const dyd_near_side *side, const mpq_t at, const mpq_t root);
/* Decides if dl(k) < ds(i) at the centre in c. */
dyd_truth dyd_filter_blocks(const dyd_bbox *c, const dyd_near_site *k, const dyd_near_site *i);
/* The site of least dl at the centre in c, if that is certainly below ds(i); otherwise count. */
size_t dyd_filter_blocker(const dyd_bbox *c, const dyd_near_site *site, size_t count, size_t i);
/* The slack of a site whose outward box is b: 0 when doubles hold it. */
double dyd_filter_slack(const dyd_bbox *b, bool in_doubles);

#endif
