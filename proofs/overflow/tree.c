/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/tree.c: what is reckoned on the grid. Areas are numbers of 64 bits here, since Frama-C has
 * none of 128; they are unsigned, and their values are no part of the proof. */
#define __int128 long long
#include "exact.h"

#include "checker/tree.h"

typedef const dyd_cert_box *grid_box;
typedef const dyd_cert_centre *grid_centre;

/*@ predicate box(grid_box b) = \valid_read(b) && (\forall integer k; 0 <= k < 4 ==> 0 <= b->e[k]);
    predicate centre(grid_centre c) = \valid_read(c) &&
      (\forall integer k; 0 <= k < 4 ==> -1152921504606846976 <= c->e[k] <= 1152921504606846976); */

/*@ assigns \nothing; exits \false; */
static uint64_t spread_bits(uint64_t v);
/*@ requires box(b); assigns \nothing; exits \false; */
static uint64_t key_of_box(const dyd_cert_box *b);
/*@ requires \valid(out) && box(b) && \separated(out, b); assigns *out; exits \false; */
static void enclose_child(dyd_cert_box *out, const dyd_cert_box *b, bool first);
/*@ requires -2305843009213693952 <= d <= 2305843009213693952; assigns \nothing; exits \false; */
static inline dyd_cert_area dyd_cert_square(int64_t d);
/*@ requires centre(c) && box(b); assigns \nothing; exits \false; */
dyd_cert_area dyd_cert_far_upper(const dyd_cert_centre *c, const dyd_cert_box *b);
/*@ requires centre(c) && box(b); assigns \nothing; exits \false; */
static dyd_cert_area near_lower(const dyd_cert_centre *c, const dyd_cert_box *b);

#include "checker/tree.c"
