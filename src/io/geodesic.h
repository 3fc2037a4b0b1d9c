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
/* A way along great circles, shorter ones, past all corners: a place at every two degrees at most. out: *count places,
 * released with free(). DYD_E_NOMEM. */
dyd_status dyd_great_circles(dyd_lon_lat **out, size_t *count, const dyd_lon_lat *corner, size_t corners);

/* The way from the middle of one box to that of another as the parts of a row of DYD_GEOMETRY_LINES. */
dyd_status dyd_row_arc(dyd_table *t, const double a[4], const double b[4]);
/* What is on the left of the closed way around the corners, as the parts of a row of DYD_GEOMETRY_POLYGONS. */
dyd_status dyd_row_around(dyd_table *t, const dyd_lon_lat *corner, size_t corners);

#endif
