/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/parts.c: positions of the walk are in it; distinct items stay in their list. */
/* Without gather_group_sites: not tried. */
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
    ensures \forall integer k; 0 <= k < count ==> \exists integer l; 0 <= l < count && item[k] == \old(item[l]); */
void sort_indices(uint32_t *item, size_t count);
#define qsort(item, count, size, compare) sort_indices(item, count)

#include "checker/parts.h"

/*@ predicate within_parts(uint32_t *parent, integer parts) = 0 < parts <= 4294967295 &&
      \valid(parent + (0 .. parts - 1)) && below(parent, parts, parts); */
/* What graph.h says of dyd_cert_root, for any number of items. */
/*@ requires within_parts(parent, parts) && v < parts; assigns parent[0 .. parts - 1]; exits \false;
    ensures within_parts(parent, parts) && \result < parts; */
uint32_t root_among(uint32_t *parent, uint32_t v, uint32_t parts);
#define dyd_cert_root(parent, v) root_among(parent, v, part + 1)

/*@ requires \valid_read((const uint32_t *)a) && \valid_read((const uint32_t *)b);
    assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
static int compare_index(const void *a, const void *b);
#include "checker/parts.c"
