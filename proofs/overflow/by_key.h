/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What src/checker/by_key.h promises: lists follow one another, and hold what was in entries. */
#ifndef DYD_PROOFS_BY_KEY_H
#define DYD_PROOFS_BY_KEY_H

#include <stddef.h>
#include <stdint.h>

/* Items are below BOUND. */
#ifndef DYD_PROOFS_GRAPH_H
/*@ axiomatic Bounds { logic integer BOUND; axiom bound: 0 <= BOUND <= 4294967295; }
    predicate below(uint32_t *item, integer count, integer most) =
      \forall integer k; 0 <= k < count ==> item[k] < most; */
#endif

#include "checker/by_key.h"

typedef const dyd_cert_entry *entry_list;
/*@ predicate entered(entry_list e, integer count, integer keys, integer most) =
      \forall integer k; 0 <= k < count ==> e[k].key < keys && e[k].item < most;
    predicate starts(size_t *start, integer keys, integer count) = start[0] == 0 && start[keys] == count &&
      (\forall integer v; 0 <= v <= keys ==> start[v] <= count) &&
      (\forall integer v; 0 <= v < keys ==> start[v] <= start[v + 1]); */

/* What by_key.c proves, where items are below `most`. */
/*@ requires keys <= 4294967295 && count <= 1152921504606846976 && most <= 4294967295 && \valid(start + (0 .. keys)) &&
      (0 < count ==> \valid(item + (0 .. count - 1)) && \valid_read(entry + (0 .. count - 1))) &&
      \separated(start + (0 .. keys), item + (0 .. count - 1), entry + (0 .. count - 1)) &&
      entered(entry, count, keys, most);
    assigns start[0 .. keys], item[0 .. count - 1]; exits \false;
    ensures starts(start, keys, count);
    ensures below(item, count, most); */
void by_key_below(size_t *start, uint32_t *item, size_t keys, const dyd_cert_entry *entry, size_t count, size_t most);

#endif
