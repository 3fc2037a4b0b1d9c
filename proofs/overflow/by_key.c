/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/by_key.c: lists follow one another, and each item has its place. */
#include "by_key.h"
#include "counting.h"

/*@ requires size == 8 * count && 0 < count && \valid(to + (0 .. count - 1)); assigns to[0 .. count - 1]; exits \false;
    ensures \forall integer k; 0 <= k < count ==> to[k] == 0; */
void clear_sizes(size_t *to, size_t count, size_t size);
#define memset(to, c, size) clear_sizes(to, keys + 1, size)

/*@ requires keys <= 4294967295 && count <= 1152921504606846976 && \valid(start + (0 .. keys)) &&
      (0 < count ==> \valid(item + (0 .. count - 1)) && \valid_read(entry + (0 .. count - 1))) &&
      \separated(start + (0 .. keys), item + (0 .. count - 1), entry + (0 .. count - 1)) &&
      entered(entry, count, keys, BOUND);
    assigns start[0 .. keys], item[0 .. count - 1]; exits \false;
    ensures starts(start, keys, count);
    ensures below(item, count, BOUND); */
void dyd_cert_by_key(size_t *start, uint32_t *item, size_t keys, const dyd_cert_entry *entry, size_t count);

#include "checker/by_key.c"
