/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The witness search wholly in doubles. */
#ifndef DYD_LEGAL_WITNESS_FILTER_H
#define DYD_LEGAL_WITNESS_FILTER_H

#include "skeleton/skeleton.h"

/* Returns TRUE if *c is a witness of i, j, proved by distance bounds; FALSE if there is none, proved by three
 * half-planes [WIT-FLT]; UNKNOWN if doubles are too coarse: *c is the last centre tried then. *c is the first guess
 * before. */
dyd_truth dyd_filter_witness(dyd_xy *c, const dyd_rects *rects, const dyd_skeleton *sk, uint32_t i, uint32_t j);

/* Returns true if everything in the box k is certainly farther from all of the box c than everything in the box s. Also
 * where c is far away from both [FLT-FAR]. */
bool dyd_filter_is_farther(const dyd_bbox *c, const dyd_bbox *s, const dyd_bbox *k);

#endif
