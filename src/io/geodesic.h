/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The sphere on maps: great circles as lines and polygons of longitude and latitude, and Voronoi cells as lists of
 * vertices. Places are in doubles; nothing is decided by them. */
#ifndef DYD_IO_GEODESIC_H
#define DYD_IO_GEODESIC_H

#include "io/table.h"

/* Places in degrees, longitudes within -180 and 180. */
typedef struct dyd_lon_lat {
  double lon, lat;
} dyd_lon_lat;

/* The middle of a box of longitudes and latitudes. */
dyd_lon_lat dyd_lon_lat_of(const double box[4]);
/* Returns true if the triangle, counter-clockwise from outside, is about less than half of the sphere. */
bool dyd_turns_left(const dyd_lon_lat corner[3]);

/* A side: the shorter way; or, between two places, the way on the great circle between them with one on its left. */
typedef struct dyd_side {
  dyd_lon_lat from, to;
  bool between;
  dyd_lon_lat left, right;
} dyd_side;
/* The way along a side, or all around the circle: a place at every two degrees at most, the ends included. out: *count
 * places, released with free(). DYD_E_NOMEM. */
dyd_status dyd_side_places(dyd_lon_lat **out, size_t *count, const dyd_side *side, bool whole);

/* The way from the middle of one box to that of another as the parts of a row of DYD_GEOMETRY_LINES. */
dyd_status dyd_row_arc(dyd_table *t, const double a[4], const double b[4]);
/* The convex region on the left of sides that follow each other, as the parts of a row of
 * DYD_GEOMETRY_POLYGONS: valid polygons, with a place at every `most` degrees (above 0, at most 90). One side, which is
 * between places, is the whole circle; none are about the globe. */
dyd_status dyd_row_around(dyd_table *t, const dyd_side *side, size_t sides, double most);

/* ---- Voronoi cells as lists of vertices ---- */

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
/* Returns true if the cell of i is half of the globe, and known. Then *out is its side, a whole circle. */
bool dyd_sphere_cell_is_half(dyd_side *out, const dyd_sphere_cells *c, const dyd_sphere *s, uint32_t i);

#endif
