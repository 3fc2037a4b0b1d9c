/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The proved polygons of one cell on a window, in doubles where doubles do, else in dyadics.
 *
 * Both rungs leave an inner polygon in Int_i n W [POLY-1] and outer polygons round Pos_i n W [POLY-2].
 *
 * [GRP-1] For exact points Int_i and Pos_i are the inside and the closure of one cell: the intersection of the
 * half-planes of the legal partners of i. A tie adds nothing: k sites on one empty circle have one vertex in common,
 * and the closed cells of two of them that are not neighbours on the circle meet in that vertex alone; those of two
 * sites of a chain on the hull that are not neighbours do not meet. So the cost of a cell does not depend on how many
 * pairs are ties. Such a cell is one convex polygon on the window. Its vertices are rounded to the nearest multiple of
 * 2^-grid, halves up, and not beyond the window; points on a side of the window stay there. That depends on the exact
 * vertex alone, so all cells around it get the same numbers. */
#ifndef DYD_VORONOI_SHAPE_H
#define DYD_VORONOI_SHAPE_H

#include "delaunay/memory.h"
#include "delaunay/state.h"
#include <dyadel/voronoi.h>

/* The window W. Invariant: dyadic ends, positive area; d[] are doubles within W: xlo, xhi, ylo, yhi. cancel: work on a
 * shape ends with DYD_CANCELLED once *cancel is set; NULL, as dyd_window_init leaves it: never. room: memory
 * budget; NULL, as above: no bound. exact: false, as dyd_window_init leaves it, wherever polygons have to be proved. */
typedef struct dyd_window {
  const dyd_rect *rect;
  double d[4];
  bool discs;  /* the discs in the squares of sites count, not the squares; false, as below */
  bool exact;  /* cells of exact points are made exactly and rounded to multiples of 2^-grid */
  bool proved; /* proved ties bound nothing: polygons of the true points [GRP-2]; false, as dyd_window_init leaves it */
  int grid;
  const volatile int *cancel;
  dyd_memory *memory;
  size_t most;      /* corners that one polygon may have; 0: DYD_MOST_SAMPLES */
  int64_t fan_bits; /* a polygon with a vertex for each certain triangle suffices within 2^-fan_bits; INT64_MAX, as
                       dyd_window_init leaves it: it has to be as near as the others */
} dyd_window;
/* Returns DYD_E_ARG unless W is as it has to be. */
dyd_status dyd_window_init(dyd_window *w, const dyd_rect *rect);
/* Sets the grid of the window, finer where the window is far from the origin: w->exact = false where doubles do not
 * hold its ends, or its shorter side has less than 2^fine multiples of 2^-grid. */
enum { DYD_GRID_FINE = 20 };
void dyd_window_set_grid(dyd_window *w, int fine);

__extension__ typedef __int128 dyd_i128;
/* twice * 2^(-2 scale) */
typedef struct dyd_grid_area {
  dyd_i128 twice;
  int scale;
} dyd_grid_area;

struct dyd_outline;

/* Invariant: in_doubles: inner[inner_count], outer[outer_count] are the polygons (at most one outer part),
 * counter-clockwise, and the areas of the polygons lie within area[]: inner from below, outer from above; or on_grid:
 * they are those of grid_area[], twice; or exact: both are the true cell, its vertices rounded by at most `rounding` in
 * each coordinate, and area[] encloses the area of the true one. Otherwise the exact ones. loose: they are as near to
 * the true cell as those of dyd_exact_polygons, but some vertices may be others. The arrays behind are scratch, kept
 * from cell to cell. */
typedef struct dyd_shape {
  bool in_doubles, on_grid, exact, loose;
  double rounding;
  uint32_t inner_count, outer_count;
  dyd_xy *inner, *outer;
  double area[2];
  dyd_grid_area grid_area[2];
  dyd_polygon inner_exact;
  dyd_polygon_list outer_exact;
  uint32_t *fan;    /* vertices round the site */
  uint32_t *key;    /* triangles that name the vertices of its cell */
  uint32_t *across; /* see dyd_shape_edges */
  dyd_bbox *fan_box;
  struct dyd_outline *outline;
  size_t inner_cap, outer_cap, fan_cap, box_cap, key_cap, across_cap;
} dyd_shape;
/* Release with dyd_shape_clear; init with {0}. */
void dyd_shape_clear(dyd_shape *s);

/* The shape of the cell of site i (not an alias): every point of Int_i n W is within 2^-bits of the inner polygon, the
 * outer ones reach at most 2^-bits beyond Pos_i. pd is not capped. */
dyd_status dyd_shape_find(dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w, int64_t bits);
/* The cell of site i, an exact point with exact partners, in exact arithmetic: s->inner, in which repeated vertices are
 * dropped, be it to less than three; the edge from s->inner[k] on is on the bisector with site s->across[k], DYD_NONE:
 * on a side of W. DYD_E_RANGE where the cell is not exact. */
dyd_status dyd_shape_edges(dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w);
/* Sets the shape valid for any cell: no point is certainly in it, all of W possibly. */
dyd_status dyd_shape_set_unknown(dyd_shape *s, const dyd_rect *window);
/* Twice the area of the inner polygon, or of all outer ones together. Exact. */
dyd_status dyd_shape_area2(dyd_dyadic *out, const dyd_shape *s, bool outer);
/* Copies of the polygons as dyadics. */
dyd_status dyd_shape_inner(dyd_polygon *out, const dyd_shape *s);
dyd_status dyd_shape_outer(dyd_polygon_list *out, const dyd_shape *s);

/* ---- rungs ---- */

/* shape_filter.c: the rung in doubles. DYD_OK with *done telling whether it succeeded, or DYD_E_NOMEM. */
dyd_status dyd_filter_shape(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t v, const dyd_window *w,
                            int64_t bits);
/* The same for a cell of exact points that is certainly inside W, or certainly beyond one of its sides; x is NaN at
 * vertices whose rounding is in doubt. */
dyd_status dyd_filter_point_cell(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t v, uint32_t degree,
                                 const dyd_window *w);

/* A point near the circumcentre of a triangle of exact points: off by at most `error` in each coordinate, NaN: not
 * known, or not certainly inside W. Both round to the same multiples of 2^-grid, halves up. */
typedef struct dyd_grid_centre {
  dyd_xy z;
  double error;
} dyd_grid_centre;
/* false: the circumcentre of triangle t is inside W, and its rounding in doubt. scale = 2^grid. */
bool dyd_filter_grid_centre(dyd_grid_centre *c, const dyd_delaunay *pd, uint32_t t, const dyd_window *w, double scale);
/* The same exactly, of a vertex that is inside W. */
dyd_status dyd_shape_centre(dyd_xy *z, const dyd_delaunay *pd, uint32_t t, const dyd_window *w);
/* Returns true if all edges of the ring turn left for certain, once round. */
bool dyd_filter_is_convex(const dyd_xy *z, size_t n);

/* polygon_filter.c: the polygons of the rung in dyadics, from boundaries in doubles. As dyd_filter_shape. */
dyd_status dyd_filter_polygons(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w,
                               int64_t bits);

/* disc_cell_filter.c: the polygons of the cell of a disc, as dyd_exact_polygons, but coarser than 2^-bits where doubles
 * are too coarse, or cutting to W spoils finer ones; *done = false: nothing is proved. s is empty. */
dyd_status dyd_disc_shape(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w,
                          int64_t bits);

/* Cuts the outer polygon of a shape in doubles to W; where it reaches beyond, all become exact ones, as those of
 * polygon.c are: crossings are multiples of 2^-(bits + DYD_CLIP_EXTRA). *done = false: finer ones are needed. */
enum { DYD_CLIP_EXTRA = 8 };
dyd_status dyd_shape_clip(bool *done, dyd_shape *s, const dyd_window *w, int64_t bits);

/* polygon.c: the rung in dyadics, from the exact boundaries. Both are empty before; on failure the caller clears them.
 */
dyd_status dyd_exact_polygons(dyd_polygon *inner, dyd_polygon_list *outer, const dyd_delaunay *pd, uint32_t i,
                              const dyd_window *w, int64_t bits);
/* W enlarged by 2^-(bits+1) on each side, so that its boundary and all within 2^-(bits+2) of it is outside of W. */
dyd_status dyd_window_enlarge(dyd_rect *out, const dyd_rect *window, int64_t bits);

/* ---- polygon.c: exact work on polygons with dyadic vertices ---- */

/* The vertices become those of their convex hull, counter-clockwise; none when they lie on a line. O(n log n). */
dyd_status dyd_polygon_make_convex(dyd_polygon *p);
/* Sets *out to whether no edge meets another one but in the common vertex of neighbours. Repeated consecutive vertices
 * are taken out first. About O(n log n) comparisons of doubles where the curve is smooth, exact steps only where boxes
 * of edges meet. DYD_CANCELLED once *cancel, which may be NULL, is set. */
dyd_status dyd_polygon_is_simple(bool *out, dyd_polygon *p, const volatile int *cancel);
/* Cuts simple polygons, counter-clockwise, to the window: the new ones lie in it and hold what of the old ones did;
 * where they cross its sides they are rounded outward along them, to multiples of 2^-bits. *simple = false: rounding,
 * or a vertex on a side, has spoiled one, and finer polygons are needed. DYD_CANCELLED once *cancel is set. Cost: a
 * sort of the crossings of each side. */
dyd_status dyd_polygons_clip(bool *simple, dyd_polygon_list *l, const dyd_rect *window, int64_t bits,
                             const volatile int *cancel);
/* A copy; out is empty before. */
dyd_status dyd_polygon_copy(dyd_polygon *out, const dyd_polygon *p);
void dyd_polygon_clear(dyd_polygon *p);

/* Twice the area. Exact, initialised by the caller. */
dyd_status dyd_polygon_area2(dyd_dyadic *out, const dyd_polygon *p);

#endif
