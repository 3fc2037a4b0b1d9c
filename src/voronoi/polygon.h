/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact work on polygons with dyadic vertices. */
#ifndef DYD_VORONOI_POLYGON_H
#define DYD_VORONOI_POLYGON_H

#include <dyadel/voronoi.h>

/* The vertices become those of their convex hull, counter-clockwise; none when they lie on a line. O(n log n). */
dyd_status dyd_polygon_make_convex(dyd_polygon *p);
/* Does no edge meet another one but in the common vertex of neighbours? Repeated consecutive vertices are taken out
 * first. O(n^2) comparisons of doubles, exact steps only where boxes of edges meet. DYD_CANCELLED once *cancel, which
 * may be NULL, is set. */
dyd_status dyd_polygon_is_simple(bool *out, dyd_polygon *p, const volatile int *cancel);
/* A copy; out is empty before. */
dyd_status dyd_polygon_copy(dyd_polygon *out, const dyd_polygon *p);

#endif
