/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lengths, areas and upper bounds in doubles. */
#ifndef DYD_METRIC_BOUNDS_FILTER_H
#define DYD_METRIC_BOUNDS_FILTER_H

#include "metric/bounds.h"

/* *out = an upper bound, over the points z of Pos_i n W that are not in Int_i, of the distance to a chosen point that
 * differs from p_i, for every choice (discs: in the squares around the discs): the least of dl_k(z), R_k disjoint from
 * R_i, and of max(dl_k, dl_l)(z), R_k disjoint from R_l, among the possible neighbours of i [HAUS-V]; about a sixteenth
 * above the best such bound, 0 when there are no such points; `enough` where it is not above that. HUGE_VAL: none is
 * known, or it is above sums->most, or *sums->cancel was set. i is not an alias and has been added to the sums. DYD_OK
 * or DYD_E_NOMEM. O(K) for each of the boxes, K possible neighbours. */
dyd_status dyd_filter_second(double *out, const dyd_voronoi_sums *sums, uint32_t i, double enough);

/* ---- Areas and lengths of rectangles with double ends, in double-double arithmetic with proved error bounds.
 *
 * A rectangle is given as a[0..3] = x lower, x upper, y lower, y upper, and must be exactly that. Results are
 * unevaluated sums out[0] + out[1] of two doubles, not below the true value t and not above (1 + 2^-86) t.
 * Every function may decline (false, out undefined): the caller goes to the exact rung. */

/* Returns true if the processor rounds to nearest now. The bounds hold only then; otherwise do not call the rest. */
bool dyd_filter_measure_usable(void);

/* Twice the area of the hull of a and b. */
bool dyd_filter_partial_edge_area2(double out[2], const double a[4], const double b[4]);
/* The largest distance of two points of a. */
bool dyd_filter_diameter(double out[2], const double a[4]);
/* Half the largest distance of a point of a to a point of b, plus the larger of the two diameters. */
bool dyd_filter_reach(double out[2], const double a[4], const double b[4]);

/* ---- Upper bounds that spare exact work ---- */

/* An upper bound of dl_i over the outer polygons of the shape; negative when there is none (Pos_i does not meet W). */
double dyd_filter_reach_of_shape(const dyd_shape *s, const double box[4]);
/* An upper bound of (diam a + diam b) (ra + rb) / (2 dist(a,b)); HUGE_VAL when doubles cannot decide. */
double dyd_filter_voronoi_pair(const double a[4], const double b[4], double ra, double rb);
/* r[k]: upper bounds of dl over the outer polygons of a and b, negative: there are none. Both become one of the
 * distances of z from both points, z being undetermined in the cell of either, and bounded by the other [GRP-2]. */
void dyd_filter_proved_reach(double r[2], const double a[4], const double b[4]);
/* An upper bound of the diameter of W and all sites together; and whether two of the boxes are certainly disjoint. */
double dyd_filter_extent(bool *disjoint, const dyd_sites *s, const dyd_rect *window);

#endif
