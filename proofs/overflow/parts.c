/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/parts.c: positions of the walk are in it; distinct items stay in their list. */
/* Without compare_index, number_groups, gather_group_sites, dyd_cert_parts_init, dyd_cert_parts_clear: not tried. */
#include "graph.h"

#include "base/alloc.h"
#include <string.h>

#define ITEM uint32_t
#define RESERVE reserve_indices
#define ALLOC alloc_indices
#include "lists.h"

/*@ requires 0 < count ==> \valid(item + (0 .. count - 1)); assigns item[0 .. count - 1]; exits \false;
    ensures \forall integer k; 0 <= k < count ==> \exists integer l; 0 <= l < count && item[k] == \old(item[l]); */
void sort_indices(uint32_t *item, size_t count);
#define qsort(item, count, size, compare) sort_indices(item, count)

#include "checker/parts.h"

/*@ requires count < 1152921504606846976 && (0 < count ==> \valid(item + (0 .. count - 1)));
    assigns item[0 .. count - 1]; exits \false; ensures \result <= count && (0 < count ==> 0 < \result); */
size_t dyd_cert_distinct(uint32_t *item, size_t count);

#include "checker/parts.c"
