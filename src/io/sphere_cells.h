/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Voronoi cells on the sphere as lists of vertices. */
#ifndef DYD_IO_SPHERE_CELLS_H
#define DYD_IO_SPHERE_CELLS_H

#include "io/output.h"

/* A Voronoi vertex: the triangle that it is dual to, and its box of degrees. */
typedef struct dyd_sphere_node {
  dyd_triangle of;
  double box[4];
} dyd_sphere_node;

/* The cell of place i is node[of[first[i] .. first[i+1] - 1]], counter-clockwise from outside: one cycle if closed[i],
 * else chains: where gap[] is set the next one begins, beyond an undecided region. Aliases have none. Init with {0}. */
typedef struct dyd_sphere_cells {
  size_t places, nodes;
  dyd_sphere_node *node;
  size_t *first;
  uint32_t *of;
  bool *gap, *closed;
} dyd_sphere_cells;

/* DYD_OK, or a failure with *err (not NULL) filled as far as known. */
dyd_status dyd_sphere_cells_find(dyd_sphere_cells *c, const dyd_sphere *s, dyd_error *err);
void dyd_sphere_cells_clear(dyd_sphere_cells *c);

#endif
