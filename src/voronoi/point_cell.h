/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cells of exact points, exactly: one convex polygon on a window, whose vertices are rounded once.
 *
 * [GRP-1] For exact points Int_i and Pos_i are the inside and the closure of one cell: the intersection of the
 * half-planes of the legal partners of i. A tie adds nothing: k sites on one empty circle have one vertex in common,
 * and the closed cells of two of them that are not neighbours on the circle meet in that vertex alone; those of two
 * sites of a chain on the hull that are not neighbours do not meet. So the cost of a cell does not know how many pairs
 * are ties.
 *
 * Vertices are rounded to the nearest multiple of 2^-grid, halves up, and not beyond the window; points on a side of
 * the window stay there. That depends on the exact vertex alone, so all cells around it get the same numbers. */
#ifndef DYD_VORONOI_POINT_CELL_H
#define DYD_VORONOI_POINT_CELL_H

#include "voronoi/shape.h"
#include <gmp.h>

/* Sets the grid of the window: w->exact = false where doubles do not hold its ends, or multiples of 2^-grid are too
 * coarse for it. */
void dyd_window_set_grid(dyd_window *w);

/* Fills s->fan with the legal partners of vertex v, counter-clockwise, and s->key[k] with a triangle whose
 * circumcentre is the vertex between partners k and k + 1, the same one for all cells of a tie; DYD_NONE: the cell is
 * unbounded there. *known = false unless v and all partners are exact points and nothing around v is undecided but
 * ties. */
dyd_status dyd_point_star(bool *known, uint32_t *degree, dyd_shape *s, const dyd_delaunay *pd, uint32_t v);

/* Makes the shape of site i on W, where the points concerned are exact; else *done = false. */
dyd_status dyd_point_cell(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w);

/* *out = its area, where it is exact; s is scratch. */
dyd_status dyd_point_cell_area(mpq_t out, bool *exact, dyd_shape *s, const dyd_delaunay *pd, uint32_t i,
                               const dyd_window *w);

/* point_cell_filter.c: the same in doubles, of a cell that is surely inside of W, or surely beyond one of its sides;
 * x is NaN of vertices whose rounding is in doubt. */
dyd_status dyd_filter_point_cell(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t v, uint32_t degree,
                                 const dyd_window *w);

#endif
