/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The partial Voronoi diagram of a partial Delaunay triangulation (mathematics: sections 2, 8, 9).
 *
 *   Int_i = { c : dl_i(c) < ds_j(c) for all j != i }   certainly nearest to i: convex, open
 *   Pos_i = { c : ds_i(c) <= dl_j(c) for all j }       possibly nearest to i: closed, star-shaped towards R_i
 *
 * They are the intersection and the union of the true cells over all choices of points [CELL-1]; only possible
 * neighbours bound them [CELL-2]. Refinement makes Int_i larger and Pos_i smaller [CELL-3].
 * All functions answer for aliases as for their site, and return DYD_CAPPED (outputs unchanged) when the
 * triangulation is capped, since neighbours are missing then. pd is borrowed for the call and not changed. */
#ifndef DYADEL_VORONOI_H
#define DYADEL_VORONOI_H

#include <dyadel/arc.h>
#include <dyadel/delaunay.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- exact cells ---- */

/* SURE: Int_i. POSSIBLE: Pos_i. */
typedef enum dyd_cell_bound { DYD_CELL_SURE = 0, DYD_CELL_POSSIBLE } dyd_cell_bound;
/* The exact boundary of Int_i or Pos_i with its arcs, counter-clockwise. window NULL: in the whole plane; else the part
 * on this closed window of positive area: all chains are closed. *out is replaced, owned by the caller. Cost: O(K^3)
 * exact steps for K possible neighbours. */
DYD_API dyd_status dyd_voronoi_cell(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, dyd_cell_bound bound,
                                    const dyd_rect *window);

/* Returns TRUE if c is in Int_i, FALSE if c is in Ext_i, UNKNOWN if neither holds, if there is no site i, or if memory
 * is exhausted. Exact. O(K). */
DYD_API dyd_truth dyd_voronoi_side(const dyd_delaunay *pd, uint32_t i, const dyd_point *c);

/* ---- proved polygons on a window ---- */

/* A simple polygon with dyadic vertices, counter-clockwise. */
typedef struct dyd_polygon {
  size_t count;
  dyd_point *vertex;
} dyd_polygon;

/* Several of them; their insides are disjoint. Owned: init with {0}. */
typedef struct dyd_polygon_list {
  size_t count;
  dyd_polygon *item;
} dyd_polygon_list;
DYD_API void dyd_polygon_list_clear(dyd_polygon_list *l);

/* Polygons for Int_i or Pos_i in the window W, a closed rectangle of positive area with dyadic ends (DYD_E_ARG
 * otherwise). *out is replaced.
 *
 * SURE: one convex polygon inside Int_i n W, or none: each vertex lies in W and satisfies dl_i < ds_j for all possible
 * neighbours j [POLY-1]. Every point of Int_i n W is within 2^-bits of it; only where Int_i n W holds no disc of radius
 * 2^-bits there may be none.
 *
 * POSSIBLE: polygons that hold Pos_i n W, one for each part of it: the ends of each edge lie in one convex C_ji, so the
 * edge lies in Ext_i [POLY-2], but where they are cut to W, in which they lie [POLY-3]. They reach at most 2^-bits
 * beyond Pos_i. */
DYD_API dyd_status dyd_voronoi_polygons(dyd_polygon_list *out, const dyd_delaunay *pd, uint32_t i, dyd_cell_bound bound,
                                        const dyd_rect *window, int64_t bits);

/* Sets out to the area of the cell of site i on the window W. *exact = false, and out is unchanged, where the cell
 * depends on a choice: i or one of its possible partners is not an exact point, or partners are undecided (ties apart).
 * The caller initialises out. Cost: O(K^2) exact steps for K legal partners. */
DYD_API dyd_status dyd_voronoi_exact_area(mpq_t out, bool *exact, const dyd_delaunay *pd, uint32_t i,
                                          const dyd_rect *window);

/* ---- vertices ---- */

/* A rectangle that holds the Voronoi vertex of the certain triangle t for every choice, within 2^-bits of the smallest
 * one. DYD_E_ARG when t is not a certain triangle of pd. */
DYD_API dyd_status dyd_voronoi_vertex(dyd_rect *out, const dyd_delaunay *pd, const dyd_triangle *t, int64_t bits);

/* The same for undecided face f (dyd_delaunay_face) where its sites are on one circle, which makes its pairs ties: a
 * rectangle that holds the vertex that they have in common, the centre. *tied = false, and *out is not changed, where
 * they are not known to be; so for faces that are unbounded. DYD_E_ARG when there is no such face; DYD_E_RANGE when the
 * rectangles of the sites are too wide to decide. */
DYD_API dyd_status dyd_voronoi_tied_vertex(dyd_rect *out, bool *tied, const dyd_delaunay *pd, size_t f, int64_t bits);

/* The default window: the bounding box of the sites enlarged by half its size (a quarter of it on each side; by 1 where
 * it has none). DYD_E_RANGE when that leaves the doubles. */
DYD_API dyd_status dyd_voronoi_window(dyd_rect *out, const dyd_sites *sites);

/* A rectangle that holds, for every choice, all Voronoi vertices in the window that come from triangles of the
 * undecided face f (0 <= f < dyd_delaunay_undecided_faces): *any = false when there are none, and out is unchanged
 * [REGION-1]. O(pairs of the face). */
DYD_API dyd_status dyd_voronoi_region(dyd_rect *out, bool *any, const dyd_delaunay *pd, size_t f,
                                      const dyd_rect *window);

/* ---- nearest sites ---- */

/* Which sites are possibly nearest to a point c anywhere in the rectangle q (ds_i(c) <= min_k dl_k(c): q meets Pos_i),
 * ascending; *sure is true when one site is certainly nearest (it is alone in the list, aliases aside, or q lies in
 * Int_i). Exact [NEAR-1]. Cost: O(log N + output) on separated input. */
DYD_API dyd_status dyd_nearest(dyd_index_list *out, bool *sure, const dyd_delaunay *pd, const dyd_rect *q);

/* Sets *out, with its values of `sure`, to the result of dyd_nearest for each place xy[2 k], xy[2 k + 1] (DYD_E_ARG for
 * one that is not finite), by a walk from each to the next, so order them to be near: then a place costs less than a
 * microsecond where its nearest site is in certain triangles only [NEAR-7]. DYD_CANCELLED once *cancel, which may be
 * NULL, is set. On failure *out is unchanged. */
DYD_API dyd_status dyd_nearest_places(dyd_place_list *out, const dyd_delaunay *pd, const double *xy, size_t count,
                                      const volatile int *cancel);

#ifdef __cplusplus
}
#endif
#endif
