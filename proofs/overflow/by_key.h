/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What src/checker/by_key.h promises: lists follow one another, and hold what was in entries; memory for them. */
#ifndef DYD_PROOFS_BY_KEY_H
#define DYD_PROOFS_BY_KEY_H

#include "graph.h"

#include "checker/by_key.h"

#define ITEM size_t
#define RESERVE reserve_sizes
#define ALLOC alloc_sizes
#include "lists.h"
#define ITEM dyd_cert_entry
#define RESERVE reserve_entries
#define ALLOC alloc_entries
#include "lists.h"

typedef const dyd_cert_entry *entry_list;
/*@ predicate entered(entry_list e, integer count, integer keys, integer most) =
      \forall integer k; 0 <= k < count ==> e[k].key < keys && e[k].item < most;
    predicate starts(size_t *start, integer keys, integer count) = start[0] == 0 && start[keys] == count &&
      (\forall integer v; 0 <= v <= keys ==> start[v] <= count) &&
      (\forall integer v; 0 <= v < keys ==> start[v] <= start[v + 1]); */

/* Of items below `most`. */
#define SORTS(most) requires keys <= 4294967295 && count <= 1152921504606846976 && (most) <= 4294967295 && \
    \valid(start + (0 .. keys)) && \
    (0 < count ==> \valid(item + (0 .. count - 1)) && \valid_read(entry + (0 .. count - 1))) && \
    \separated(start + (0 .. keys), item + (0 .. count - 1), entry + (0 .. count - 1)) && \
    entered(entry, count, keys, most); \
  assigns start[0 .. keys], item[0 .. count - 1]; \
  ensures starts(start, keys, count); \
  ensures below(item, count, most);

/* dyd_cert_by_key, which by_key.c proves of any bound. */
/*@ SORTS(most) exits \false; */
void by_key_below(size_t *start, uint32_t *item, size_t keys, const dyd_cert_entry *entry, size_t count, size_t most);

#endif
