/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/chain.c: both lists of a chain grow together. */
/* Without dyd_cert_chain_init, dyd_cert_chain_clear, blocker_is_nearer, blocker_is_farther_out, chain_is_blocked,
   chain_side, segment_is_met, ray_crosses, segment_crosses, chain_separates, dyd_cert_chain_holds: not tried. */
#include "sites.h"

#include "base/alloc.h"
#include "checker/chain.h"

typedef dyd_exact two_numbers[2];
#define ITEM two_numbers
#define RESERVE reserve_points
#define ALLOC alloc_points
#include "lists.h"
#define ITEM uint32_t
#define RESERVE reserve_blockers
#define ALLOC alloc_indices
#include "lists.h"

/*@ requires \valid(c) && c->points <= c->cap <= 1152921504606846976 && points <= 1152921504606846976 &&
      (0 < c->cap ==> \valid(c->point + (0 .. c->cap - 1)) && \valid(c->blocker + (0 .. c->cap)));
    exits \false;
    ensures \result == DYD_OK ==> c->points == points <= c->cap && (0 < c->cap ==>
      \valid(c->point + (0 .. c->cap - 1)) && \valid(c->blocker + (0 .. c->cap))); */
dyd_status dyd_cert_chain_resize(dyd_cert_chain *c, size_t points);

#include "checker/chain.c"
