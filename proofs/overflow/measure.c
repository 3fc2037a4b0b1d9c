/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/measure.c: turns reckoned on the grid. */
/* Without dyd_cert_fraction_init, dyd_cert_fraction_clear, dyd_cert_fraction_swap, init_over_common, multiply_dens,
   dyd_cert_fraction_cmp, dyd_cert_fraction_sub, dyd_cert_fraction_mul, dyd_cert_fraction_add, axis_distance,
   dyd_cert_distance2, dyd_cert_place_of, dyd_cert_spot_at, spot_difference, dyd_cert_cross, dyd_cert_turn,
   dyd_cert_compare_places, site_height, dyd_cert_compare_heights: not tried. */
#include "exact.h"

#include "checker/sites.h"

typedef const dyd_cert_sites *grid;

/*@ predicate on_grid(grid s, integer v) = \valid_read(s) && \valid_read(s->site + v) &&
      (s->box == \null || \valid_read(s->box + v) && (\forall integer k; 0 <= k < 4 ==> 0 <= s->box[v].e[k])); */

/*@ requires -4611686018427387904 <= d <= 4611686018427387904; assigns \nothing; exits \false;
    ensures \result == \abs(d); */
static int64_t absolute_value(int64_t d);
/*@ requires \valid(out + (0 .. 1)) && on_grid(s, v);
    assigns out[0 .. 1]; exits \false;
    ensures \result ==> 0 <= out[0] <= 2147483647 && 0 <= out[1] <= 2147483647; */
static bool grid_place(int64_t out[2], const dyd_cert_sites *s, uint32_t v);
/*@ requires on_grid(s, a) && on_grid(s, b) && on_grid(s, c); assigns \nothing; exits \false;
    ensures -1 <= \result <= 1; */
static int turn_on_grid(const dyd_cert_sites *s, uint32_t a, uint32_t b, uint32_t c);

#include "checker/measure.c"
