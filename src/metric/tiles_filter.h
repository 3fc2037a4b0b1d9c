/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rings of doubles on a grid: exact areas in integers, and a quick look at who is near an edge. */
#ifndef DYD_METRIC_TILES_FILTER_H
#define DYD_METRIC_TILES_FILTER_H

#include "voronoi/shape.h"

/* *out = the area of a ring, rounded up. false: its coordinates are no multiples of 2^-grid of few bits. */
bool dyd_filter_grid_area(double *out, const dyd_xy *z, size_t n, int grid);
/* false: v is certainly more than a step of the grid away from the edge from a to b. */
bool dyd_filter_near_edge(dyd_xy a, dyd_xy b, dyd_xy v, int grid);

#endif
