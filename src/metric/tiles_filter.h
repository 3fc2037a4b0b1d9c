/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rings of doubles on a grid: exact areas in integers, and a quick search for vertices near an edge. */
#ifndef DYD_METRIC_TILES_FILTER_H
#define DYD_METRIC_TILES_FILTER_H

#include "voronoi/shape.h"

/* *out = the area of a ring, rounded up. Returns false if its coordinates are not multiples of 2^-grid of few bits. */
bool dyd_filter_grid_area(double *out, const dyd_xy *z, size_t n, int grid);
/* The polygon of a cell by its n vertices, counter-clockwise: ring[0 .. returned) are their rounded places, repeated
 * ones dropped, for a window w of doubles; bound[] encloses the area of the true polygon. */
size_t dyd_filter_tile(dyd_xy *ring, double bound[2], const dyd_grid_centre *const *c, size_t n, const dyd_window *w,
                       double scale);
/* false: v is certainly more than a step of the grid away from the edge from a to b. */
bool dyd_filter_near_edge(dyd_xy a, dyd_xy b, dyd_xy v, int grid);
/* Sign of the turn of three places, of which only the largest doubles not above each coordinate are given; 0: not
 * certain. */
int dyd_filter_low_turn(const double a[2], const double b[2], const double c[2]);

#endif
