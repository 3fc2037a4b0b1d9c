/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/measure.c: turns reckoned on the grid. */
/* Without dyd_cert_fraction_swap: structures with arrays in them are copied as one; what comes of their parts stays
   unknown. */
/* Without dyd_cert_fraction_sub: of two denominators each may be absent; that numbers stay whole while others change
   stays unknown, with the numbers between admitted as well. */
/* Without axis_distance, dyd_cert_distance2: that the numbers of the site stay whole while the distance changes stays
   unknown, where dyd_cert_fraction_sub, mul and add are called. */
/* Without dyd_cert_turn: not tried with its conditions. */
/* Without dyd_cert_cross, dyd_cert_compare_places, site_height, dyd_cert_compare_heights: CVC4 did not finish: numbers
   in lists and in local variables change by turns. */
#define SPELL_OUT
#include "sites.h"

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
/*@ requires \valid(x) && \valid(y) && \separated(x, y) && fraction(a, 274877906944) && fraction(b, 274877906944) &&
      \separated(x, a) && \separated(x, b) && \separated(y, a) && \separated(y, b);
    assigns PARTS(x), PARTS(y); exits \false;
    ensures exact(x) && exact(y) && x->exp == \old(a->num.exp) && y->exp == \old(b->num.exp); */
static void init_over_common(dyd_exact *x, dyd_exact *y, const dyd_cert_fraction *a, const dyd_cert_fraction *b);
/*@ requires \valid(out) && of_parts(a) && of_parts(b) && !(a->whole && b->whole) && same_or_apart(out, a) &&
      same_or_apart(out, b);
    assigns out->den[0].sign, out->den[0].length, out->den[0].zeros;
    exits \false; ensures whole(&out->den[0]) && out->den[0].sign == 1; */
static void multiply_dens(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b);

/*@ requires on_grid(s, a) && on_grid(s, b) && on_grid(s, c) && small_site(s->site + a) && small_site(s->site + b) &&
      small_site(s->site + c);
    assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
int dyd_cert_turn(const dyd_cert_sites *s, uint32_t a, uint32_t b, uint32_t c);
/*@ requires \valid(out) && spot(a) && spot(b) && 0 <= axis <= 1 && of_parts(out) && \separated(out, a) &&
      \separated(out, b) && apart_from_spot(out, a) && apart_from_spot(out, b);
    assigns FRACTION(out); exits \false; ensures fraction(out, 1048576); */
static void spot_difference(dyd_cert_fraction *out, const dyd_cert_spot *a, const dyd_cert_spot *b, int axis);

#include "checker/measure.c"
