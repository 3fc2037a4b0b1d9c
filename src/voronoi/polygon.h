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
/* Cuts simple polygons, counter-clockwise, to the window: the new ones lie in it and hold what of the old ones did;
 * where they cross its sides they are rounded outward along them, to multiples of 2^-bits. *simple = false: rounding,
 * or a vertex on a side, has spoiled one, and finer polygons are needed. DYD_CANCELLED once *cancel is set. Cost: a
 * sort of the crossings of each side. */
dyd_status dyd_polygons_clip(bool *simple, dyd_polygon_list *l, const dyd_rect *window, int64_t bits,
                             const volatile int *cancel);
/* A copy; out is empty before. */
dyd_status dyd_polygon_copy(dyd_polygon *out, const dyd_polygon *p);

#endif
