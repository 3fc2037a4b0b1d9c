/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/distance.c: what is reckoned on the grid. Areas are numbers of 64 bits here: their values
 * are no part of the proof. */
/* Without dyd_cert_window_init, dyd_cert_window_clear, place_end, root_above, find_diameter, place_site, make_grid,
   mpz_set_area, find_site_gap, are_disjoint, site_gap_below, add_diameters, is_near_bisector, is_near_site, far_root,
   has_two_near_sites, box_pairs_hold, box_keep, is_worth_a_look, box_is_covered, extent_widen, spans_all,
   distance_search_init, distance_search_clear, dyd_cert_distance_holds: not tried. */
#define __int128 long long
#include "sites.h"

#include "base/alloc.h"

#define ITEM uint32_t
#define RESERVE dyd_reserve
#define ALLOC alloc_indices
#include "lists.h"

#include "checker/distance.h"
#include "checker/tree.h"

#undef mpz_inits
#undef mpz_clears
#define mpz_inits(a, b, c, d, end) (mpz_init(a), mpz_init(b), mpz_init(c), mpz_init(d))
#define mpz_clears(a, b, c, d, end) (mpz_clear(a), mpz_clear(b), mpz_clear(c), mpz_clear(d))

/*@ requires -2305843009213693952 <= d <= 2305843009213693952; assigns \nothing; exits \false; */
static inline dyd_cert_area dyd_cert_square(int64_t d);

#include "checker/distance.c"
