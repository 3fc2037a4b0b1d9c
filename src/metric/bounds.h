/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Upper bounds on the undecided part of the triangulation and of the Voronoi diagram, as MPFR numbers: for comparing
 * with a goal without leaving the exponent range of dyadics. */
#ifndef DYD_METRIC_BOUNDS_H
#define DYD_METRIC_BOUNDS_H

#include "voronoi/shape.h"
#include <dyadel/metric.h>
#include <dyadel/sites.h>
#include <mpfr.h>

/* ---- one pair ----
 *
 * Every value given is not below the true value t and not above (1 + 2^-80) t (for t > 0; 0 for t = 0), on both
 * rungs: doubles where they hold the rectangles exactly, rationals and MPFR otherwise. */

/* Precision of the values given and of sums of them; any caller may use another. */
#define DYD_MEASURE_PREC 128

/* A place to measure the pairs of one table of sites in. Borrows the sites. */
typedef struct dyd_measure {
  const dyd_sites *sites;
  bool filter; /* false: exact rung only */
  bool discs;  /* false, as dyd_measure_init leaves it: rectangles; else dyd_voronoi_pair_width is about discs */
  dyd_rect a, b;
  mpq_t end[8], sum, term;
  mpfr_t t;
} dyd_measure;

void dyd_measure_init(dyd_measure *m, const dyd_sites *sites);
void dyd_measure_clear(dyd_measure *m);

/* The box of site i, outward; of its disc, if these count. */
void dyd_measure_box(double out[4], const dyd_sites *sites, uint32_t i, bool discs);
/* Area of Ed(R_i,R_j). out is initialised by the caller; so below. */
dyd_status dyd_measure_area(mpfr_ptr out, dyd_measure *m, size_t i, size_t j);
/* Largest distance of two points of R_i. */
dyd_status dyd_measure_diameter(mpfr_ptr out, dyd_measure *m, size_t i);
/* Half the largest distance of a point of R_i to one of R_j, plus the larger diameter. */
dyd_status dyd_measure_reach(mpfr_ptr out, dyd_measure *m, size_t i, size_t j);

/* ---- tiles ---- */

/* As dyd_voronoi_tiles; *bounds is set as by dyd_metric_voronoi, unless it is NULL. areas_only: out->xy stays NULL.
 * discs: bounds are those of discs. */
dyd_status dyd_tiles_find(dyd_tiles *out, dyd_voronoi_bounds *bounds, const dyd_delaunay *pd, const dyd_rect *window,
                          int64_t bits, bool areas_only, bool discs, const volatile int *cancel);

/* ---- the triangulation ---- */

/* The bounds of metric.h with the list of possible pairs and a place to measure in at hand. out is initialised by
 * the caller at DYD_MEASURE_PREC bits or more. Rounded up by at most 2^-70 of itself. */
dyd_status dyd_bound_area(mpfr_ptr out, dyd_measure *m, const dyd_pair_list *pairs);
dyd_status dyd_bound_hausdorff(mpfr_ptr out, dyd_measure *m, const dyd_pair_list *pairs);

/* As dyd_metric_area or dyd_metric_hausdorff; discs: dyd_disc_pairs of pd, whose edges count, between the squares;
 * NULL: all possible pairs. */
dyd_status dyd_metric_bound(dyd_dyadic *out, const dyd_delaunay *pd, const dyd_pair_list *discs, bool area);

/* The distance bound of one possible pair. */
dyd_status dyd_bound_pair_hausdorff(mpfr_ptr out, dyd_measure *m, const dyd_pair *pair);

/* ---- the Voronoi diagram, cell by cell ---- */

/* Invariant: inner <= the areas of the inner polygons added; reach[i] >= dl_i over Pos_i n W, -1 where that is
 * empty or i was not added; second[i]: the result of dyd_filter_second for `most`
 * (HUGE_VAL: no limit), nothing being enough, -1 until it is computed.
 * cancel: checked by all work on these sums; NULL: never. cut: NULL: a shape that is cancelled ends the walk with
 * DYD_CANCELLED; else it and all later ones become unknown shapes (dyd_shape_set_unknown), counted here. Both are set
 * by the caller after dyd_voronoi_sums_init. */
typedef struct dyd_voronoi_sums {
  const dyd_delaunay *pd;
  const dyd_rect *window;
  mpfr_t inner, term;
  int64_t bits;
  dyd_dyadic area2;
  const volatile int *cancel;
  size_t *cut;
  dyd_memory memory; /* the budget that max_bytes leaves after the triangulation */
  size_t corners;    /* that one polygon may have, as in dyd_window */
  double *reach, *second, most;
  bool discs;  /* cells are those of the discs in the sites' squares; as `cut`, set by the caller */
  bool exact;  /* cells of exact points are not flattened; false: their polygons are proved, vertex by vertex */
  bool proved; /* there are proved ties, and with `exact` they bound nothing [GRP-2] */
  size_t added, inexact; /* shapes; of them, how many are not the whole cell */
} dyd_voronoi_sums;

/* As dyd_metric_voronoi, with corners 0; of rectangles, or of the discs in them. Else DYD_E_RANGE where a polygon would
 * have more than `corners` corners; and of more than DYD_TIGHT_SITES sites, polygons with a vertex for each certain
 * triangle are only within 2^-dyd_metric_coarseness: the width of the rectangles, and not the flattening of arcs, makes
 * them smaller than their cells. That is ten times as fast, and the area up to five times as large. */
enum { DYD_TIGHT_SITES = 512 };
dyd_status dyd_voronoi_bounds_within(dyd_voronoi_bounds *out, const dyd_delaunay *pd, const dyd_rect *window,
                                     int64_t bits, size_t corners, bool discs, const volatile int *cancel);

/* Rates: of any narrower rectangles, at most w wide, the diagram in the window is within 2^*rate w of the true one, and
 * the disc, as both of its parts, within 2^*rate w of the true disc, where that is at most 2^-*from [RATE-1]. *known =
 * false: rectangles of a possible pair meet, or the triple is not certainly oriented. */
dyd_status dyd_metric_voronoi_rate(int64_t *rate, bool *known, const dyd_delaunay *pd, const dyd_rect *window,
                                   const volatile int *cancel);
dyd_status dyd_metric_disc_rate(int64_t *rate, int64_t *from, bool *known, const dyd_rect *a, const dyd_rect *b,
                                const dyd_rect *c);

/* bits: of the polygons to come; sums are kept so precise that rounding does not spoil what these give. */
dyd_status dyd_voronoi_sums_init(dyd_voronoi_sums *s, const dyd_delaunay *pd, const dyd_rect *window, int64_t bits);
void dyd_voronoi_sums_clear(dyd_voronoi_sums *s);

/* reach[0], reach[1]: how far from i and j the points can be that the pair leaves undetermined; -1: there are none. */
void dyd_voronoi_pair_reach(double reach[2], const dyd_voronoi_sums *s, const dyd_pair *pair);

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
/* The same by other points near it; HUGE_VAL: unknown, or above s->most. */
dyd_status dyd_voronoi_pair_second(double *out, dyd_voronoi_sums *s, const dyd_pair *pair);

/* Called for every site that is not an alias, in order, with doubles area[0] <= area of Int_i n W and
 * area[1] >= area of Pos_i n W. */
typedef dyd_status (*dyd_voronoi_visit)(void *context, uint32_t i, const dyd_shape *shape, const double area[2]);
/* Makes the polygons of all cells once, adds them up and shows them to `visit`, whose status ends the walk unless it is
 * DYD_OK. visit may be NULL. */
dyd_status dyd_voronoi_sums_all(dyd_voronoi_sums *s, dyd_voronoi_visit visit, void *context);

/* A choice of bits so that flattening alone adds about 2^-goal_bits / 8 or less to the area. */
int64_t dyd_metric_flattening(const dyd_delaunay *pd, const dyd_rect *window, int64_t goal_bits);
/* An upper bound of the Lebesgue measure of the union of the partial edges Ed(R_i,R_j) over all possible pairs:
 * the sum of the areas of these hulls, rounded up by at most 2^-53 of itself (or to a multiple of 2^-DYD_EXP_LIMIT)
 * [AREA-T]. DYD_CAPPED (out unchanged) when
 * pd is capped, since pairs are missing then. O(pairs). */
dyd_status dyd_metric_area(dyd_dyadic *out, const dyd_delaunay *pd);
/* An upper bound of the Hausdorff distance between the true Delaunay graph (for any choice, as the union of its
 * edges) and the union of the partial edges; rounded up by at most 2^-53 of itself [HAUS-T]. DYD_CAPPED as above.
 * O(pairs). */
dyd_status dyd_metric_hausdorff(dyd_dyadic *out, const dyd_delaunay *pd);

#endif
