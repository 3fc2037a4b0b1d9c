/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Whose rectangles meet a disc. */
#ifndef DYD_DELAUNAY_DISC_FILTER_H
#define DYD_DELAUNAY_DISC_FILTER_H

#include <dyadel/delaunay.h>

/* The sites whose rectangles meet the closed disc with centre c and squared radius radius2 (canonical), ascending;
 * aliases are not listed. Exact. *out is replaced. O(N) on a line and where all sites are exact. */
dyd_status dyd_delaunay_meet_disc(dyd_index_list *out, const dyd_delaunay *pd, const dyd_point *c, const mpq_t radius2);

#endif
