/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/parts.c: positions of the walk are in it; distinct items stay in their list. */
/* Without number_groups, gather_group_sites: without contracts 15 of 62 and 20 of 54 goals are proved in 5 s. Open are
   the accesses to lists; with invariants, that positions are in the walk after a list beside them was written. */
/* Without dyd_cert_parts_init: 51 of 61 goals are proved in 5 s. Open: exits, ensures and what is assigned, which
   rest on the two functions before it, and mem_access_9 and 10 in the loop. */
#include "faces.h"

#include "base/alloc.h"
#include <string.h>

#define ITEM uint32_t
#define RESERVE reserve_indices
#define ALLOC alloc_indices
#include "lists.h"

#define ITEM size_t
#define ALLOC zeroed_sizes
#include "zeroed.h"

/*@ requires 0 < count ==> \valid(item + (0 .. count - 1)); assigns item[0 .. count - 1]; exits \false;
    ensures \forall integer k; 0 <= k < count ==> \exists integer l; 0 <= l < count && item[k] == \old(item[l]);
    ensures below{Pre}(item, count, BOUND) ==> below(item, count, BOUND); */
void sort_indices(uint32_t *item, size_t count);
#define qsort(item, count, size, compare) sort_indices(item, count)

#include "checker/parts.h"

/* Operands are pointers to what is there: WP's memory does not follow casts from pointers to void. */
#define compare_index(x, y) compare_index(const uint32_t *a, const uint32_t *b)
/*@ requires \valid_read(a) && \valid_read(b); assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
static int compare_index(x, y);

#include "checker/parts.c"
