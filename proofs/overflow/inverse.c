/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/inverse.c: intervals at a place, and which is narrower. */
/* Unproved settle_from_assert_rte_function_pointer, settle_from_assert_rte_function_pointer_2_part1,
   settle_from_assert_rte_function_pointer_2_part2: that there is a function where one of two is called: WP does not
   know valid_function. */
#define SPELL_OUT
#include "enclosures.h"

/*@ requires \valid(x) && interval(x) && whole(y) && \separated(x, y); assigns ALL_OF(x); exits \false;
    ensures interval(x); */
static void enclosure_set_at(dyd_cert_enclosure *x, mpz_srcptr y);
/*@ requires interval(x) && interval(y); assigns \nothing; exits \false; */
static bool is_narrower(const dyd_cert_enclosure *x, const dyd_cert_enclosure *y);

#include "checker/inverse.c"
