/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/fixpoint.c: pairs are of sites that are there. */
#include "faces.h"
#include "by_key.h"

#include "base/alloc.h"
#include <string.h>

#define __int128 long long
#define ITEM uint32_t
#define RESERVE reserve_indices
#define ALLOC alloc_indices
#include "lists.h"
#define ITEM bool
#define ALLOC zeroed_flags
#include "zeroed.h"

#include "checker/checker.h"

#define dyd_cert_by_key(start, item, keys, entry, count) by_key_below(start, item, keys, entry, count, keys)

typedef const dyd_checker *checking;

/*@ predicate checks(checking c) = \valid_read(c) && c->sites.count == SITES && pairs(&c->legal, SITES) &&
      pairs(&c->open, SITES) && indexed(&c->faces) &&
      (0 < SITES ==> \valid_read(c->sites.site + (0 .. SITES - 1))) &&
      (\forall integer i; 0 <= i < SITES ==> c->sites.site[i].alias < SITES) &&
      string((const char *)c->report.goal); */

/*@ requires string(s); assigns \nothing; exits \false; */
int compare_with_literal(const char *s);
#define strcmp(s, literal) compare_with_literal(s)
/*@ requires \valid_read(edges) && pairs(edges, SITES); assigns \nothing; exits \false; */
bool dyd_cert_edges_have(const dyd_cert_edges *edges, uint32_t i, uint32_t j);
/* Without places_stay, dyd_checker_stays: contract of places_stay not written yet. */
/*@ requires \valid(out) && checks(c) && (still == \null || \valid_read(still + (0 .. SITES - 1))) &&
      \separated(out, c, still + (0 .. SITES - 1), c->sites.site + (0 .. SITES - 1));
    exits \false; */
dyd_status dyd_checker_stays(bool *out, const dyd_checker *c, const bool *still);

#include "checker/fixpoint.c"
