/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The proved polygons of one cell on a window, in doubles where doubles do, else in dyadics.
 *
 * Both rungs leave an inner polygon in Int_i n W [POLY-1] and outer polygons round Pos_i n W [POLY-2]. */
#ifndef DYD_VORONOI_SHAPE_H
#define DYD_VORONOI_SHAPE_H

#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "voronoi/grid_polygon.h"
#include <dyadel/voronoi.h>

/* The window W. Invariant: dyadic ends, positive area; d[] are doubles within W: xlo, xhi, ylo, yhi. cancel: work on a
 * shape ends with DYD_CANCELLED once *cancel is set; NULL, as dyd_window_init leaves it: never. room: for what is
 * large; NULL, as above: no bound. exact: false, as dyd_window_init leaves it, wherever polygons have to be proved. */
typedef struct dyd_window {
  const dyd_rect *rect;
  double d[4];
  bool exact; /* cells of exact points are made exactly, see point_cell.h, and rounded to multiples of 2^-grid */
  int grid;
  const volatile int *cancel;
  dyd_room *room;
} dyd_window;
/* DYD_E_ARG unless W is as it has to be. */
dyd_status dyd_window_init(dyd_window *w, const dyd_rect *rect);

struct dyd_outline;

/* Invariant: in_doubles: inner[inner_count], outer[outer_count] are the polygons (at most one outer part),
 * counter-clockwise, and the areas of the polygons lie within area[]: inner from below, outer from above; or on_grid:
 * they are those of grid_area[], twice; or exact: both are the true cell, its vertices rounded by at most `rounding` in
 * each coordinate, and area[] encloses the area of the true one. Otherwise the exact ones. The arrays behind are
 * scratch, kept from cell to cell. */
typedef struct dyd_shape {
  bool in_doubles, on_grid, exact;
  double rounding;
  uint32_t inner_count, outer_count;
  dyd_xy *inner, *outer;
  double area[2];
  dyd_grid_area grid_area[2];
  dyd_polygon inner_exact;
  dyd_polygon_list outer_exact;
  uint32_t *fan; /* vertices round the site */
  uint32_t *key; /* triangles that name the vertices of its cell */
  dyd_bbox *fan_box;
  struct dyd_outline *outline;
  size_t inner_cap, outer_cap, fan_cap, box_cap, key_cap;
} dyd_shape;
/* Release with dyd_shape_clear; init with {0}. */
void dyd_shape_clear(dyd_shape *s);

/* The shape of the cell of site i (not an alias): every point of Int_i n W is within 2^-bits of the inner polygon, the
 * outer ones reach at most 2^-bits beyond Pos_i. pd is not capped. */
dyd_status dyd_shape_find(dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w, int64_t bits);
/* What is true of any cell: nothing is surely in it, all of W possibly. */
dyd_status dyd_shape_set_unknown(dyd_shape *s, const dyd_rect *window);
/* Twice the area of the inner polygon, or of all outer ones together. Exact. */
dyd_status dyd_shape_area2(dyd_dyadic *out, const dyd_shape *s, bool outer);
/* Copies of the polygons as dyadics. */
dyd_status dyd_shape_inner(dyd_polygon *out, const dyd_shape *s);
dyd_status dyd_shape_outer(dyd_polygon_list *out, const dyd_shape *s);

/* shape_filter.c: the rung in doubles. DYD_OK with *done telling whether it succeeded, or DYD_E_NOMEM. */
dyd_status dyd_filter_shape(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t v, const dyd_window *w,
                            int64_t bits);

/* polygon_filter.c: the polygons of the rung in dyadics, from boundaries in doubles. As dyd_filter_shape. */
dyd_status dyd_filter_polygons(bool *done, dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w,
                               int64_t bits);

/* Cuts the outer polygon of a shape in doubles to W; where it reaches beyond, all become exact ones, as those of
 * polygon_exact.c are: crossings are multiples of 2^-(bits + DYD_CLIP_EXTRA). *done = false: finer ones are needed. */
enum { DYD_CLIP_EXTRA = 8 };
dyd_status dyd_shape_clip(bool *done, dyd_shape *s, const dyd_window *w, int64_t bits);

/* polygon_exact.c: the rung in dyadics, from the exact boundaries. */
dyd_status dyd_exact_inner(dyd_polygon *out, const dyd_delaunay *pd, uint32_t i, const dyd_window *w, int64_t bits);
dyd_status dyd_exact_outer(dyd_polygon_list *out, const dyd_delaunay *pd, uint32_t i, const dyd_window *w,
                           int64_t bits);
/* W enlarged by 2^-(bits+1) on each side, so that its boundary and all within 2^-(bits+2) of it is outside of W. */
dyd_status dyd_window_enlarge(dyd_rect *out, const dyd_rect *window, int64_t bits);

#endif
