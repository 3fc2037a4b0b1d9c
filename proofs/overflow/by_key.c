/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/by_key.c: lists follow one another, and each item has its place. */
#include "by_key.h"
#include "counting.h"

/*@ requires size == 8 * count && 0 < count && \valid(to + (0 .. count - 1)); assigns to[0 .. count - 1]; exits \false;
    ensures \forall integer k; 0 <= k < count ==> to[k] == 0; */
void clear_sizes(size_t *to, size_t count, size_t size);
#define memset(to, c, size) clear_sizes(to, keys + 1, size)

/*@ SORTS(BOUND) exits \false; */
void dyd_cert_by_key(size_t *start, uint32_t *item, size_t keys, const dyd_cert_entry *entry, size_t count);

#include "checker/by_key.c"
