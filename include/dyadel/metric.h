/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certified upper bounds on what the partial triangulation leaves open (mathematics: section 8). */
#ifndef DYADEL_METRIC_H
#define DYADEL_METRIC_H

#include <dyadel/delaunay.h>

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

#ifdef __cplusplus
}
#endif
#endif
