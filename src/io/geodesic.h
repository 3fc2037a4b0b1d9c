/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Great circles as lines and polygons of longitude and latitude, for maps: in doubles, nothing is decided by them. */
#ifndef DYD_IO_GEODESIC_H
#define DYD_IO_GEODESIC_H

#include "io/table.h"

/* Places in degrees, longitudes within -180 and 180. */
typedef struct dyd_lon_lat {
  double lon, lat;
} dyd_lon_lat;

/* The middle of a box of longitudes and latitudes. */
dyd_lon_lat dyd_lon_lat_of(const double box[4]);
/* Is the triangle, counter-clockwise from outside, about less than half of the sphere? */
bool dyd_turns_left(const dyd_lon_lat corner[3]);
/* Where all on the circle through the corners, counter-clockwise from outside, are equally far. */
dyd_lon_lat dyd_circle_centre(const dyd_lon_lat corner[3]);

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

#endif
