/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Voronoi cells on the sphere as lists of vertices. */
#ifndef DYD_IO_SPHERE_CELLS_H
#define DYD_IO_SPHERE_CELLS_H

#include "io/geodesic.h"
#include "io/output.h"

/* A Voronoi vertex: the triangle that it is dual to, or three sites of a circle of more, and its box of degrees;
 * `at`: where it is in the box when all sites are in the middle of where they may be, so that cells there are convex
 * and fit together. */
typedef struct dyd_sphere_node {
  dyd_triangle of;
  double box[4];
  dyd_lon_lat at;
} dyd_sphere_node;

/* The cell of place i is node[of[first[i] .. first[i+1] - 1]], counter-clockwise from outside: one cycle if closed[i],
 * else chains: where gap[] is set the next one begins, beyond an undecided region; the side behind each is shared with
 * beyond[]. A circle of sites is one vertex. The globe and its halves are closed without a vertex. Aliases have none.
 * Init with {0}. */
typedef struct dyd_sphere_cells {
  size_t places, nodes;
  dyd_sphere_node *node;
  size_t *first;
  uint32_t *of, *beyond;
  bool *gap, *closed;
  dyd_lon_lat *middle; /* of where places may be */
} dyd_sphere_cells;

/* DYD_OK, or a failure with *err (not NULL) filled as far as known. */
dyd_status dyd_sphere_cells_find(dyd_sphere_cells *c, const dyd_sphere *s, dyd_error *err);
void dyd_sphere_cells_clear(dyd_sphere_cells *c);
/* The side behind the k-th vertex of the cell of i, that is of[first[i] + k]. */
dyd_side dyd_sphere_cell_side(const dyd_sphere_cells *c, uint32_t i, size_t k);
/* Is the cell of i half of the globe, and known? Then *out is its side, a whole circle. */
bool dyd_sphere_cell_is_half(dyd_side *out, const dyd_sphere_cells *c, const dyd_sphere *s, uint32_t i);

#endif
