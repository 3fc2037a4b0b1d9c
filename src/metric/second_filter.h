/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How far points of a cell can be from another point than its own. */
#ifndef DYD_METRIC_SECOND_FILTER_H
#define DYD_METRIC_SECOND_FILTER_H

#include "delaunay/state.h"

/* *out = an upper bound, over the points z of Pos_i n W that are not in Int_i, of the distance to a chosen point that
 * differs from p_i, for every choice: the least of dl_k(z), R_k disjoint from R_i, and of max(dl_k, dl_l)(z), R_k
 * disjoint from R_l, among the possible neighbours of i [HAUS-V]; about a sixteenth above the best such bound, 0 when
 * there are no such points. HUGE_VAL: none is known, or it is above `most`, or *cancel (which may be NULL) was set.
 * reach >= dl_i over Pos_i n W; i is no alias. DYD_OK or DYD_E_NOMEM. O(K) for each of the boxes, K possible
 * neighbours. */
dyd_status dyd_filter_second(double *out, const dyd_delaunay *pd, uint32_t i, const dyd_rect *window, double reach,
                             double most, const volatile int *cancel);

#endif
