/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certified upper bounds on what the partial triangulation leaves open (mathematics: section 8). */
#ifndef DYADEL_METRIC_H
#define DYADEL_METRIC_H

#include <dyadel/voronoi.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An upper bound of the Lebesgue measure of the union of the partial edges Ed(R_i,R_j) over all possible pairs:
 * the sum of the areas of these hulls, rounded up by at most 2^-53 of itself (or to a multiple of 2^-DYD_EXP_LIMIT)
 * [AREA-T]. DYD_CAPPED (out unchanged) when
 * pd is capped, since pairs are missing then. O(pairs). */
DYD_API dyd_status dyd_metric_area(dyd_dyadic *out, const dyd_delaunay *pd);

/* An upper bound of the Hausdorff distance between the true Delaunay graph (for any choice, as the union of its
 * edges) and the union of the partial edges; rounded up by at most 2^-53 of itself [HAUS-T]. DYD_CAPPED as above.
 * O(pairs). */
DYD_API dyd_status dyd_metric_hausdorff(dyd_dyadic *out, const dyd_delaunay *pd);

/* Bounds on the partial Voronoi diagram on a window W (dyadic ends, positive area). The undetermined set U is W minus
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
/* A choice of bits so that flattening alone adds about 2^-goal_bits / 8 or less to the area. */
DYD_API int64_t dyd_metric_flattening(const dyd_delaunay *pd, const dyd_rect *window, int64_t goal_bits);
/* A choice of bits so that polygons follow cells of mean size in W to about a sixteenth of their size: enough for the
 * Hausdorff bound, which only needs to know how far cells reach. */
DYD_API int64_t dyd_metric_coarseness(const dyd_delaunay *pd, const dyd_rect *window);

#ifdef __cplusplus
}
#endif
#endif
