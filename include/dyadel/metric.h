/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certified upper bounds on the undecided part of the partial triangulation (mathematics: section 8). */
#ifndef DYADEL_METRIC_H
#define DYADEL_METRIC_H

#include <dyadel/voronoi.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- T as a region ----
 *
 * T = (empty, E), where E is the complement of the union of the partial edges of all possible pairs: no choice has an
 * edge that meets E. */

/* The hull of `count` rectangles, 1 to 3: of two the partial edge, of three the partial triangle. Its vertices are
 * out[2 k], out[2 k + 1] for k below the result, counter-clockwise; two of a segment, one of a point. out is
 * initialised by the caller. 0 for other counts. Exact. */
DYD_API size_t dyd_rect_hull(mpq_t out[24], const dyd_rect *const *r, size_t count);

/* The components of E. Ring r has the vertices xy[2 k], xy[2 k + 1] for offset[r] <= k < offset[r + 1], with the
 * component on its left, from its least vertex in x, then y; the first is not repeated. Ring 0 is that of the unbounded
 * component, clockwise around the union, and may go along a segment twice; each other one is the boundary of a bounded
 * component, counter-clockwise. No ring: no pair, E is the plane [EXT-1]. Owned: init with {0}. */
typedef struct dyd_exterior {
  size_t rings, *offset;
  mpq_t *xy;
} dyd_exterior;
DYD_API void dyd_exterior_clear(dyd_exterior *e);
/* *out is replaced. cancel may be NULL. DYD_CAPPED, DYD_CANCELLED, DYD_E_RANGE for 2^32 pairs and DYD_E_NOMEM leave
 * *out as it was. Exact. Cost: for each pair exact steps with each pair whose box meets its own; numbers have the
 * digits of the common denominator of all coordinates. */
DYD_API dyd_status dyd_delaunay_exterior(dyd_exterior *out, const dyd_delaunay *pd, const volatile int *cancel);

/* Bounds on the partial Voronoi diagram on a window W (dyadic ends, positive area). The undecided set U is W minus
 * the union of all Int_i; it holds the true diagram (the union of the boundaries of the true cells) inside W.
 *
 * area       an upper bound of the Lebesgue measure of U: the area of W minus the areas of inner polygons [AREA-V]
 * hausdorff  an upper bound of the distance of any point of U to the true diagram, for any choice [HAUS-V]; it takes
 *            disjoint rectangles, also where nothing is decided (cocircular points)
 * finite     false: no bound is known, as no two rectangles are disjoint or distances are beyond doubles; then
 * hausdorff is 0 and means nothing
 *
 * Both are rounded up by at most 2^-53 of themselves. bits: the polygons are within 2^-bits of their cells, which adds
 * at most the perimeter of all cells in W times 2^-bits to the area; cells of exact points are exact, and add nothing.
 */
typedef struct dyd_voronoi_bounds {
  size_t struct_size; /* set by dyd_voronoi_bounds_init */
  dyd_dyadic area, hausdorff;
  bool finite;
} dyd_voronoi_bounds;
static inline void dyd_voronoi_bounds_init(dyd_voronoi_bounds *b) {
  b->struct_size = sizeof *b;
  dyd_dyadic_init(&b->area);
  dyd_dyadic_init(&b->hausdorff);
  b->finite = false;
}
static inline void dyd_voronoi_bounds_clear(dyd_voronoi_bounds *b) {
  dyd_dyadic_clear(&b->hausdorff);
  dyd_dyadic_clear(&b->area);
}
/* out is initialised by the caller. cancel as in dyd_delaunay_options, may be NULL. DYD_CAPPED, DYD_CANCELLED (out
 * unchanged), DYD_E_ARG for a wrong window. O(N + pairs) for separated thin rectangles. */
DYD_API dyd_status dyd_metric_voronoi(dyd_voronoi_bounds *out, const dyd_delaunay *pd, const dyd_rect *window,
                                      int64_t bits, const volatile int *cancel);
/* A choice of bits so that polygons follow cells of mean size in W to about a sixteenth of their size: enough for the
 * Hausdorff bound, which only needs to know how far cells reach. */
DYD_API int64_t dyd_metric_coarseness(const dyd_delaunay *pd, const dyd_rect *window);

/* Bounds on the partial disc D(a,b,c) = (I,E) (predicate.h): for every choice of points the disc inside their circle
 * lies between I and the complement of E.
 *
 * area       an upper bound of the area between the two
 * hausdorff  an upper bound of their Hausdorff distance, so that each is at most that far from the true disc [AREA-D]
 * finite     false: no bound is known, as the triple is not certainly oriented (a line meets all three), or I is empty
 * or so small compared with the circles that it holds no centre of one; the others are 0 then
 *
 * Both are 0 for three exact points, and otherwise exceed the true values by a few hundredths of them where these are
 * small compared with the radius. out is initialised by the caller. DYD_E_ARG for NULL. O(1) steps with about twice the
 * digits of the circles. */
DYD_API dyd_status dyd_metric_disc(dyd_voronoi_bounds *out, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c);

/* ---- tiles ----
 *
 * A partition of a window, one polygon for each site, to be drawn and joined to tables: the Voronoi diagram of one
 * point of each rectangle, its centre, which for an exact point is that point.
 *
 * Each vertex of that diagram on the window is rounded once, by at most half of a step of a grid in each coordinate,
 * and all polygons around it have the same two doubles; crossings with the window's sides stay on them. So the areas
 * of the polygons, as rationals, have exactly the window's area as their sum. Each polygon is simple and
 * counter-clockwise [PART-1].
 *
 * Ring r, for r < count, is the polygon of site[r]: its vertices are xy[2 k], xy[2 k + 1] for
 * offset[r] <= k < offset[r + 1], and the first is not repeated. Rings are in the order of the sites. A site has no
 * ring where its cell has no area on the window, or none on the grid, or where its point is also that of a site of a
 * lower number: `coincident` counts the latter, aliases included. Where a cell is as thin as the grid, it may have more
 * rings than one.
 *
 * area[r] is the area of ring r, rounded up; bound[2 r] <= the area of the site's true cell on the window, wherever the
 * points are, <= bound[2 r + 1]: the areas of its inner and its outer polygons. Owned: init with {0}. */
typedef struct dyd_tiles {
  size_t count, coincident;
  uint32_t *site;
  size_t *offset;
  double *xy, *area, *bound;
  double rounding; /* the most that a coordinate of a vertex was rounded by */
} dyd_tiles;
DYD_API void dyd_tiles_clear(dyd_tiles *t);

/* Polygons, with holes and of several parts: ring r has the vertices xy[2 k], xy[2 k + 1] for offset[r] <= k <
 * offset[r + 1], at least three, the first not repeated. A place is inside if an odd number of rings surrounds it.
 * Owned by the caller: init with {0}. */
typedef struct dyd_area {
  size_t rings, *offset;
  double *xy;
} dyd_area;
DYD_API void dyd_area_clear(dyd_area *a);
/* Turns the rings of an area so that its inside is on their left, as dyd_tiles_clip takes it. DYD_E_ARG: edges cross,
 * or have a piece in common, or a ring touches itself within an edge; bad[0] and bad[1] are the first vertices of two
 * such edges, in xy; or this vertex, twice, is not finite. Exact. O(n log n) for n edges of borders as they are in
 * maps. */
DYD_API dyd_status dyd_area_orient(dyd_area *a, size_t bad[2]);
/* Cuts tiles to an area. The areas of the parts, as rationals, have exactly the area's as their sum, as far as it is in
 * the window. Vertices are those of tiles and of the area, and crossings of their edges, each rounded to the nearest
 * double; t->rounding becomes the most that any was rounded by. A site may have several rings. A ring of area[r] = 0 is
 * a hole of the last ring before it that is none, whose area[] is that without the holes, rounded up. bound[] is of
 * the part of the site's cell in the area. DYD_E_ARG (the area has a vertex that is not finite), DYD_E_NOMEM,
 * DYD_CANCELLED and DYD_E_RANGE, doubles are too coarse for the parts, leave *t as it was. cancel may be NULL. O(log n)
 * for each tile and each edge of the area in its box. */
DYD_API dyd_status dyd_tiles_clip(dyd_tiles *t, const dyd_area *area, const volatile int *cancel);
/* *out is replaced. window as above, with doubles as its ends; bits: of the polygons that bound the areas, as in
 * dyd_metric_voronoi. cancel may be NULL. DYD_CAPPED, DYD_CANCELLED, DYD_E_ARG, DYD_E_NOMEM leave *out as it was; so
 * does DYD_E_RANGE: doubles do not hold the window's ends, or the window is so small and so far from the origin that
 * they are too coarse for it. Cost: O(N) for exact points; else that of dyd_metric_voronoi, and a triangulation of the
 * centres. */
DYD_API dyd_status dyd_voronoi_tiles(dyd_tiles *out, const dyd_delaunay *pd, const dyd_rect *window, int64_t bits,
                                     const volatile int *cancel);

#ifdef __cplusplus
}
#endif
#endif
