/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Counting sorts: items are counted by keys, counts are added up, and each list is filled from where it begins, or
 * backwards from where it ends.
 *
 * keys: any sequence of whole numbers k -> key(s, k). Of its first n numbers, having(s, n, v) are v, and before(s, n, v)
 * are neither negative nor v or above: sorted by keys, the list of v is from before(s, n, v) to before(s, n, v + 1).
 * Each axiom is true of any sequence:
 * having_none, having_next: by what `having` counts, of one number more; before_none: none is between 0 and 0.
 * having_more: what is among the first m is among the first n, and no more than n are.
 * before_next: a number below v + 1 is below v, or v.
 * before_rises: what is below u is below v; no more than n are.
 * before_all: every number counts.
 * having_alike: counts of the first n depend on these alone.
 * place: of a place q in the lists below v, list_at(s, n, q) is the one that it is in: there is one, since those from
 * before(s, n, 0), which is 0, to before(s, n, v) follow one another; which, does not depend on v.
 * item: items(list) are the numbers in a list. */
#ifndef DYD_PROOFS_COUNTING_H
#define DYD_PROOFS_COUNTING_H

#include <stdint.h>

/*@ logic integer once(integer key, integer v) = key == v ? 1 : 0;
    axiomatic Counting {
      type keys;
      logic integer key(keys s, integer k);
      logic integer having(keys s, integer n, integer v);
      logic integer before(keys s, integer n, integer v);
      logic integer list_at(keys s, integer n, integer q);
      axiom having_none: \forall keys s, integer v; having(s, 0, v) == 0;
      axiom having_next: \forall keys s, integer k, n, v; 0 <= k && n == k + 1 ==>
        having(s, n, v) == having(s, k, v) + once(key(s, k), v);
      axiom having_more: \forall keys s, integer m, n, v; 0 <= m <= n ==>
        0 <= having(s, m, v) <= having(s, n, v) <= n;
      axiom before_none: \forall keys s, integer n; before(s, n, 0) == 0;
      axiom before_next: \forall keys s, integer n, v, w; 0 <= n && 0 <= v && w == v + 1 ==>
        before(s, n, w) == before(s, n, v) + having(s, n, v);
      axiom before_rises: \forall keys s, integer n, u, v; 0 <= n && 0 <= u <= v ==>
        0 <= before(s, n, u) <= before(s, n, v) <= n;
      axiom before_all: \forall keys s, integer n, v; 0 <= n &&
        (\forall integer k; 0 <= k < n ==> 0 <= key(s, k) < v) ==> before(s, n, v) == n;
      predicate alike(keys s, keys t, integer n) = \forall integer k; 0 <= k < n ==> key(s, k) == key(t, k);
      axiom having_alike: \forall keys s, t, integer n, v; alike(s, t, n) ==> having(s, n, v) == having(t, n, v);
      axiom place: \forall keys s, integer n, v, q; 0 <= n && 0 <= v && 0 <= q < before(s, n, v) ==>
        0 <= list_at(s, n, q) < v &&
        before(s, n, list_at(s, n, q)) <= q < before(s, n, list_at(s, n, q) + 1);
      logic keys items{L}(uint32_t *item) reads item[..];
      axiom item{L}: \forall uint32_t *item, integer k; key(items(item), k) == item[k]; }
    predicate counted(keys s, integer n, integer most) = \forall integer k; 0 <= k < n ==> 0 <= key(s, k) < most; */

#endif
