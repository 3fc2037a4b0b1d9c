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
/* Of the list of all possible pairs. */
uint64_t dyd_pairs_bytes(const dyd_delaunay *pd);

#endif
