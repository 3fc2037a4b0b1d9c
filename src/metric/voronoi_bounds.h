/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The bounds on the Voronoi diagram, added up cell by cell. */
#ifndef DYD_METRIC_VORONOI_BOUNDS_H
#define DYD_METRIC_VORONOI_BOUNDS_H

#include "metric/measure.h"
#include "voronoi/shape.h"
#include <dyadel/metric.h>

/* Invariant: inner <= the areas of the inner polygons added; reach[i] >= dl_i over Pos_i n W, -1 where that is
 * empty or i was not added; second[i]: what dyd_filter_second gives for `most`
 * (HUGE_VAL: always what is known), -1 as long as nobody asked. */
/* cancel: checked by all work on these sums; NULL: never. cut: NULL: a shape that is cancelled ends the walk with
 * DYD_CANCELLED; else dyd_shape_set_unknown stands for it and those after it, and they are counted here. Both are set
 * by the caller after dyd_voronoi_sums_init. */
typedef struct dyd_voronoi_sums {
  const dyd_delaunay *pd;
  const dyd_rect *window;
  mpfr_t inner, term;
  int64_t bits;
  dyd_dyadic area2;
  const volatile int *cancel;
  size_t *cut;
  dyd_room room; /* what max_bytes leaves beside the triangulation */
  double *reach, *second, most;
  bool exact; /* cells of exact points are not flattened; false: their polygons are proved, vertex by vertex */
  size_t added, inexact; /* shapes; those that are not the whole cell */
} dyd_voronoi_sums;

/* bits: of the polygons to come; sums are kept so precise that rounding does not spoil what these give. */
dyd_status dyd_voronoi_sums_init(dyd_voronoi_sums *s, const dyd_delaunay *pd, const dyd_rect *window, int64_t bits);
void dyd_voronoi_sums_clear(dyd_voronoi_sums *s);

/* After all sites: initialised by the caller at DYD_MEASURE_PREC bits or more. */
void dyd_voronoi_area(mpfr_ptr out, const dyd_voronoi_sums *s);
/* *finite as in dyd_voronoi_bounds. */
dyd_status dyd_voronoi_hausdorff(mpfr_ptr out, bool *finite, dyd_voronoi_sums *s, const dyd_pair_list *pairs);

/* Both as dyadics; *out is initialised by the caller. */
dyd_status dyd_voronoi_sums_bounds(dyd_voronoi_bounds *out, dyd_voronoi_sums *s);

/* How far off points of the strip in which a possible pair is undetermined can be, by its width; *finite = false when
 * the rectangles meet. */
dyd_status dyd_voronoi_pair_width(mpfr_ptr out, bool *finite, const dyd_voronoi_sums *s, dyd_measure *m,
                                  const dyd_pair *pair);
/* The same by other points near it; HUGE_VAL: nothing is known, or it is above s->most. */
dyd_status dyd_voronoi_pair_second(double *out, dyd_voronoi_sums *s, const dyd_pair *pair);

/* Called for every site that stands for itself, in order, with doubles area[0] <= area of Int_i n W and
 * area[1] >= area of Pos_i n W. */
typedef dyd_status (*dyd_voronoi_visit)(void *context, uint32_t i, const dyd_shape *shape, const double area[2]);
/* Makes the polygons of all cells once, adds them up and shows them to `visit`, whose status ends the walk unless it is
 * DYD_OK. visit may be NULL. */
dyd_status dyd_voronoi_sums_all(dyd_voronoi_sums *s, dyd_voronoi_visit visit, void *context);

#endif
