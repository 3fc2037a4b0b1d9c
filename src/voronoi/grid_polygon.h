/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Polygons whose vertices are integers of few bits, so that turns and areas fit into 128 bits; each function does what
 * the one of its name does for exact polygons. */
#ifndef DYD_VORONOI_GRID_POLYGON_H
#define DYD_VORONOI_GRID_POLYGON_H

#include <dyadel/status.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { DYD_GRID_BITS = 50 };

__extension__ typedef __int128 dyd_i128;
/* twice * 2^(-2 scale) */
typedef struct dyd_grid_area {
  dyd_i128 twice;
  int scale;
} dyd_grid_area;

/* A point times 2^scale. */
typedef struct dyd_grid_point {
  int64_t at[2];
  int scale;
} dyd_grid_point;

typedef struct dyd_grid_polygon {
  dyd_grid_point *vertex;
  size_t count, cap;
} dyd_grid_polygon;

/* All vertices on the finest of their grids; false: they do not fit there. */
bool dyd_grid_align(dyd_grid_polygon *p);
/* As dyd_polygon_make_convex. */
dyd_status dyd_grid_make_convex(dyd_grid_polygon *p);
/* Does no edge meet another but in the common vertex of neighbours? *known = false: edges only seem to meet, by a turn
 * that is 0. O(n^2). */
bool dyd_grid_is_simple(bool *known, const dyd_grid_polygon *p);
/* As dyd_polygon_is_simple takes out repeats. */
void dyd_grid_drop_repeats(dyd_grid_polygon *p);
/* Twice the area, with its sign, of an aligned one. */
dyd_i128 dyd_grid_area2(const dyd_grid_polygon *p);

#endif
