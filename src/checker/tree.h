/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A tree of boxes on the grid: who can be within a distance of a centre. Extents count, not only middles. */
#ifndef DYD_CHECKER_TREE_H
#define DYD_CHECKER_TREE_H

#include "checker/sites.h"

#define DYD_CERT_FANOUT 8
#define DYD_CERT_LEVELS 12

/* item[] in an order that keeps neighbours together; level l has a box for each 8^(l+1) items. */
typedef struct dyd_cert_tree {
  const dyd_cert_box *box; /* borrowed, by site */
  uint32_t *item;
  size_t count;
  dyd_cert_box *node;
  size_t start[DYD_CERT_LEVELS + 1]; /* of the levels, in node[] */
  int levels;
} dyd_cert_tree;

/* Over the sites that are no aliases. */
dyd_status dyd_cert_tree_init(dyd_cert_tree *t, const dyd_cert_sites *s);
void dyd_cert_tree_clear(dyd_cert_tree *t);

/* A centre on the grid, enclosed: [x0,x1] x [y0,y1]; far: beyond 2^60 units, then the grid excludes nobody. */
typedef struct dyd_cert_centre {
  int64_t e[4];
  bool far;
} dyd_cert_centre;
void dyd_cert_centre_set(dyd_cert_centre *out, const dyd_cert_sites *s, const dyd_exact c[2]);

__extension__ typedef unsigned __int128 dyd_cert_area;
static inline dyd_cert_area dyd_cert_square(int64_t d) {
  dyd_cert_area size = (dyd_cert_area)(d < 0 ? -d : d);
  return size * size;
}
/* An upper bound of the squared distance from the centre to the farthest point of the box, in grid units; the centre is
 * not far. */
dyd_cert_area dyd_cert_far_upper(const dyd_cert_centre *c, const dyd_cert_box *b);

/* Calls visit for every item whose near distance may be <= the root of `limit` (all, when the centre is far) until it
 * returns false; returns whether all calls returned true. */
typedef bool dyd_cert_visit(void *context, uint32_t site);
bool dyd_cert_tree_visit(const dyd_cert_tree *t, const dyd_cert_centre *c, dyd_cert_area limit, dyd_cert_visit *visit,
                         void *context);

#endif
