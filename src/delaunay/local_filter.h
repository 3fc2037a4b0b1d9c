/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certifying an edge of an undecided face from the faces around its two ends only. */
#ifndef DYD_DELAUNAY_LOCAL_FILTER_H
#define DYD_DELAUNAY_LOCAL_FILTER_H

#include "delaunay/state.h"

/* Returns true if c is certainly a witness of the real edge h, which lies inside an undecided face of the table
 * [LOC-3]. true only if it is; false also where that would take long. Needs boxes (not all sites exact). */
bool dyd_filter_local_witness(const dyd_delaunay *pd, dyd_half_edge h, dyd_xy c);

#endif
