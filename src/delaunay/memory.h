/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Memory for what is made of a result. */
#ifndef DYD_DELAUNAY_MEMORY_H
#define DYD_DELAUNAY_MEMORY_H

#include "base/room.h"
#include <dyadel/delaunay.h>

/* For what a call makes of a result: the room that it leaves of what its last call was allowed. */
dyd_room dyd_delaunay_room(const dyd_delaunay *pd);
/* From now on that is so much; 0: no bound. */
void dyd_delaunay_allow(dyd_delaunay *pd, uint64_t max_bytes);
/* Is there one? Estimates that take a while are made only then. */
bool dyd_delaunay_is_bounded(const dyd_delaunay *pd);
/* DYD_OK when so much may be made of the result at once; else DYD_E_NOMEM, with what took too much in *err (may be
 * NULL). `what` is static. */
dyd_status dyd_delaunay_grant(const dyd_delaunay *pd, uint64_t bytes, const char *what, dyd_error *err);
/* Of the list of all possible pairs, and of that of the sure triangles while it is made. */
uint64_t dyd_pairs_bytes(const dyd_delaunay *pd);
uint64_t dyd_triangles_bytes(const dyd_delaunay *pd);
/* The list of all pairs, for those who have seen to its room, as runs have: dyd_delaunay_pairs without a grant. */
dyd_status dyd_pairs_list(dyd_pair_list *out, const dyd_delaunay *pd);

#endif
