/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Upper bounds in doubles that spare the exact work for pairs that do not count. */
#ifndef DYD_METRIC_VORONOI_FILTER_H
#define DYD_METRIC_VORONOI_FILTER_H

#include "voronoi/shape.h"

/* An upper bound of dl_i over the outer polygons of the shape; negative when there is none (Pos_i does not meet W). */
double dyd_filter_reach_of_shape(const dyd_shape *s, const double box[4]);
/* An upper bound of (diam a + diam b) (ra + rb) / (2 dist(a,b)); HUGE_VAL when doubles cannot tell. */
double dyd_filter_voronoi_pair(const double a[4], const double b[4], double ra, double rb);
/* An upper bound of the diameter of W and all sites together; and whether two of the boxes are surely disjoint. */
double dyd_filter_extent(bool *disjoint, const dyd_sites *s, const dyd_rect *window);

#endif
