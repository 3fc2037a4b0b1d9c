/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/still.c: pairs are of sites that are there. */
/* Without movers_clear, movers_fill, movers_list, open_pair_stays, open_pairs_stay, dyd_checker_stays: not tried. */
#include "faces.h"

#include "base/alloc.h"
#include <string.h>

#define __int128 long long
#define ITEM uint32_t
#define RESERVE reserve_indices
#define ALLOC alloc_indices
#include "lists.h"

#include "checker/checker.h"

/*@ requires \valid_read(edges) && pairs(edges, SITES); assigns \nothing; exits \false; */
bool dyd_cert_edges_have(const dyd_cert_edges *edges, uint32_t i, uint32_t j);

#include "checker/still.c"
