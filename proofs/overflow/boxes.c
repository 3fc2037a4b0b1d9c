/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/boxes.c: regions, and distances from their corners. Areas are numbers of 64 bits here:
 * their values are no part of the proof. */
/* Without box_height, make_blocker, choose_blockers, is_region_blocked, keep_region_sites, list_region_pairs,
   keep_region_pairs, add_left, look_at_region, cone_region, mark_outer_sites, keep_outer_sites, look_around,
   look_everywhere, compare_partner, index_known, sort_left, dyd_cert_boxes_left: not tried. */
#define __int128 long long
#include "exact.h"

#include "base/alloc.h"
#include "checker/tree.h"
#include <string.h>

typedef const dyd_cert_box *grid_box;
typedef const int64_t *spot;

/*@ predicate box(grid_box b) = \valid_read(b) && (\forall integer k; 0 <= k < 4 ==> 0 <= b->e[k] <= 4294967295);
    predicate near(spot c) = \valid_read(c + (0 .. 1)) &&
      (\forall integer k; 0 <= k < 2 ==> -1152921505143717888 <= c[k] <= 1152921505143717888); */

/*@ requires -2305843009213693952 <= d <= 2305843009213693952; assigns \nothing; exits \false; */
static inline dyd_cert_area dyd_cert_square(int64_t d);
/*@ requires near(&c[0]) && box(b); assigns \nothing; exits \false; */
static dyd_cert_area far_from_corner(const int64_t c[2], const dyd_cert_box *b);
/*@ requires near(&c[0]) && box(b); assigns \nothing; exits \false; */
static dyd_cert_area near_from_corner(const int64_t c[2], const dyd_cert_box *b);

#include "checker/boxes.c"
