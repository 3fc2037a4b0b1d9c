/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Memory budget of lists that are made from a result. */
#ifndef DYD_DELAUNAY_MEMORY_H
#define DYD_DELAUNAY_MEMORY_H

#include "base/local.h"
#include "base/memory.h"
#include <dyadel/delaunay.h>

DYD_OWNERS(dyd_delaunay)

/* For what a call makes of a result: the room that it leaves of what its last call was allowed. */
dyd_memory dyd_delaunay_memory_left(const dyd_delaunay *pd);
/* From now on that is so much; 0: no bound. */
void dyd_delaunay_allow(dyd_delaunay *pd, uint64_t max_bytes);
/* Returns true if a bound is set. Estimates that take a while are made only then. */
bool dyd_delaunay_is_bounded(const dyd_delaunay *pd);
/* Returns DYD_OK when the budget allows that many bytes more, else DYD_E_NOMEM, with `what` named in *err (may be
 * NULL). `what` is static. */
dyd_status dyd_delaunay_grant(const dyd_delaunay *pd, uint64_t bytes, const char *what, dyd_error *err);
/* The least status of the pairs that cells, areas, spanning trees and plans use. Ties of exact points are ignored:
 * the common boundary of two such cells is one point or nothing [GRP-1], and a face of k sites has about k^2 / 2 of
 * them. Ties that were proved count: of arbitrary points in their rectangles they are possible edges. */
dyd_pair_status dyd_least_bounding(const dyd_delaunay *pd);
/* Returns true if a tie of points that are not all exact is proved. Of the true points it bounds nothing either
 * [GRP-2]. */
bool dyd_has_proved_tie(const dyd_delaunay *pd);
/* As dyd_least_bounding, for the true points; dyd_least_at: of the pairs that bound the cell of site i, proved: for the
 * true points. */
dyd_pair_status dyd_least_bounding_true(const dyd_delaunay *pd);
dyd_pair_status dyd_least_at(const dyd_delaunay *pd, uint32_t i, bool proved);
/* Bytes of the list of pairs with at least that status, and of that of the certain triangles while it is made. */
uint64_t dyd_pairs_bytes(const dyd_delaunay *pd, dyd_pair_status least);
uint64_t dyd_triangles_bytes(const dyd_delaunay *pd);
/* As dyd_delaunay_pairs, of the pairs with at least the status `least`; dyd_pairs_list does not ask for a grant: its
 * callers have seen to the memory, as runs have. */
dyd_status dyd_pairs_take(dyd_pair_list *out, const dyd_delaunay *pd, dyd_pair_status least);
dyd_status dyd_pairs_list(dyd_pair_list *out, const dyd_delaunay *pd, dyd_pair_status least);
/* Counts the pairs of the list by status; NULL: those of pd. */
void dyd_pairs_count(size_t count[4], const dyd_pair_list *list, const dyd_delaunay *pd);
/* The partners of each of n sites: partner[start[i] .. start[i + 1] - 1], ascending where the pairs are sorted. Both
 * are owned by the caller, whatever it returns. */
dyd_status dyd_pairs_deal(size_t **start, uint32_t **partner, const dyd_pair_list *l, size_t n);

#endif
