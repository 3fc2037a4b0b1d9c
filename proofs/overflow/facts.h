/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of the facts about sites that a certificate states, and of their blocks. */
#ifndef DYD_PROOFS_FACTS_H
#define DYD_PROOFS_FACTS_H

#include "faces.h"

#include "checker/ties.h"

typedef const dyd_cert_ties *facts_of;

/* stated: facts are about sites of the list of members; listing: that the lists may get longer; blocks are of their
 * own, with room in their list for more. */
/*@ predicate within_members(facts_of t) = \forall integer q; 0 <= q < t->facts ==> 2 <= t->fact[q].count &&
      t->fact[q].first < t->members && t->fact[q].first + t->fact[q].count <= t->members <= 1152921504606846976;
    predicate stated(facts_of t) = \valid_read(t) &&
      (0 < t->facts ==> \valid_read(t->fact + (0 .. t->facts - 1))) &&
      (0 < t->members ==> \valid_read(t->member + (0 .. t->members - 1))) && below(t->member, t->members, SITES) &&
      within_members(t);
    predicate listing(facts_of t) = \valid(t) && t->members <= t->member_cap <= 1152921504606846976 &&
      t->facts <= t->fact_cap <= 1152921504606846976 &&
      (0 < t->member_cap ==> \valid(t->member + (0 .. t->member_cap - 1))) &&
      (0 < t->fact_cap ==> \valid(t->fact + (0 .. t->fact_cap - 1))) && stated(t);
    predicate own_blocks(facts_of t) = \forall integer k; 0 <= k < t->blocks ==> \valid(t->block[k]) &&
      \separated(t, t->block[k]) && \separated(t->block + (0 .. t->block_cap - 1), t->block[k]);
    predicate blocks(facts_of t) = \valid(t) && t->blocks <= t->block_cap <= 1152921504606846976 &&
      (0 < t->block_cap ==> \valid(t->block + (0 .. t->block_cap - 1))) && own_blocks(t); */

#endif
