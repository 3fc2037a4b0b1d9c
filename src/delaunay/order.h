/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Spatial order of the sites: near in the plane, near in memory. */
#ifndef DYD_DELAUNAY_ORDER_H
#define DYD_DELAUNAY_ORDER_H

#include "rect/sites_table.h"

/* order[0..n-1] (owned by the caller) becomes a permutation of the sites in the order of insertion: exact points
 * before fat rectangles; within each, two sparse samples first, then the rest; each along a Hilbert curve.
 * Deterministic; only speed depends on it. O(n). */
dyd_status dyd_spatial_order(uint32_t *order, const dyd_sites *sites);

#endif
