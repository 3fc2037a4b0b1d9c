/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A counting sort: items are counted by keys, counts are added up, and each list is filled backwards from where it
 * ends.
 *
 * row: any sequence of whole numbers k -> key(s, k). Of its first n numbers, having(s, n, v) are v, and before(s, n, v)
 * are neither negative nor v or above: sorted by keys, the list of v is from before(s, n, v) to before(s, n, v + 1).
 * Each axiom is true of any sequence:
 * having_none, having_next: by what `having` counts, of one number more; before_none: none is between 0 and 0.
 * having_more: what is among the first m is among the first n, and no more than n are.
 * before_next: a number below v + 1 is below v, or v.
 * before_rises: what is below u is below v; no more than n are.
 * before_all: every number counts.
 * place: of a place q in the lists below v, list_at(s, n, q) is the one that it is in: there is one, since those from
 * before(s, n, 0), which is 0, to before(s, n, v) follow one another; which, does not depend on v.
 * entry: keyed(e) are the keys in a list of entries. */
#ifndef DYD_PROOFS_COUNTING_H
#define DYD_PROOFS_COUNTING_H

#include "by_key.h"

/*@ logic integer once(integer key, integer v) = key == v ? 1 : 0;
    axiomatic Counting {
      type row;
      logic integer key(row s, integer k);
      logic integer having(row s, integer n, integer v);
      logic integer before(row s, integer n, integer v);
      logic integer list_at(row s, integer n, integer q);
      axiom having_none: \forall row s, integer v; having(s, 0, v) == 0;
      axiom having_next: \forall row s, integer k, n, v; 0 <= k && n == k + 1 ==>
        having(s, n, v) == having(s, k, v) + once(key(s, k), v);
      axiom having_more: \forall row s, integer m, n, v; 0 <= m <= n ==>
        0 <= having(s, m, v) <= having(s, n, v) <= n;
      axiom before_none: \forall row s, integer n; before(s, n, 0) == 0;
      axiom before_next: \forall row s, integer n, v, w; 0 <= n && 0 <= v && w == v + 1 ==>
        before(s, n, w) == before(s, n, v) + having(s, n, v);
      axiom before_rises: \forall row s, integer n, u, v; 0 <= n && 0 <= u <= v ==>
        0 <= before(s, n, u) <= before(s, n, v) <= n;
      axiom before_all: \forall row s, integer n, v; 0 <= n &&
        (\forall integer k; 0 <= k < n ==> 0 <= key(s, k) < v) ==> before(s, n, v) == n;
      axiom place: \forall row s, integer n, v, q; 0 <= n && 0 <= v && 0 <= q < before(s, n, v) ==>
        0 <= list_at(s, n, q) < v &&
        before(s, n, list_at(s, n, q)) <= q < before(s, n, list_at(s, n, q) + 1);
      logic row keyed{L}(entry_list e) reads e[..];
      axiom entry{L}: \forall entry_list e, integer k; key(keyed(e), k) == e[k].key; }
    predicate counted(row s, integer n, integer most) = \forall integer k; 0 <= k < n ==> 0 <= key(s, k) < most; */

#endif
