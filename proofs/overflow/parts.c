/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/parts.c: positions of the walk are in it; distinct items stay in their list. */
#include "faces.h"
#include "by_key.h"

#include "base/alloc.h"
#include <string.h>

#define ITEM uint32_t
#define RESERVE reserve_indices
#define ALLOC alloc_indices
#include "lists.h"

#define dyd_cert_by_key(s, i, keys, e, all) by_key_below(s, i, keys, e, all, m->g->sites->count)

/*@ requires 0 < count ==> \valid(item + (0 .. count - 1)); assigns item[0 .. count - 1]; exits \false;
    ensures \forall integer k; 0 <= k < count ==> \exists integer l; 0 <= l < count && item[k] == \old(item[l]);
    ensures below{Pre}(item, count, BOUND) ==> below(item, count, BOUND); */
void sort_indices(uint32_t *item, size_t count);
#define qsort(item, count, size, compare) sort_indices(item, count)

#include "checker/parts.h"

/*@ requires size == 4 * n && (0 < n ==> \valid(to + (0 .. n - 1)) && \valid_read(from + (0 .. n - 1)));
    assigns to[0 .. n - 1]; exits \false;
    ensures \forall integer most; below{Pre}((uint32_t *)from, n, most) ==> below(to, n, most); */
void move_sites(uint32_t *to, const uint32_t *from, size_t n, size_t size);
#define memmove(to, from, size) move_sites(to, from, count, size)
/* What graph.h says of dyd_cert_root, of n numbers. */
/*@ requires \valid(parent + (0 .. n - 1)) && rising(parent, n) && v < n; assigns parent[0 .. n - 1]; exits \false;
    ensures rising(parent, n) && \result <= v; */
uint32_t root_among(uint32_t *parent, uint32_t v, uint32_t n);
#define dyd_cert_root(parent, v) root_among(parent, v, part + 1)

#include "checker/parts.c"
