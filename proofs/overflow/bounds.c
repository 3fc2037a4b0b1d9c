/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/bounds.c: gaps between sides, a sum of areas that stays a number. */
/* Without side_reach, side_span, bounds_cut_corner, bounds_add_area, site_reach2, site_diameter2,
   half_and_diameter_fit, hausdorff_fits, dyd_cert_bounds_add: not tried. */
#define SPELL_OUT
#include "sites.h"

#undef mpz_inits
#undef mpz_clears
#define mpz_inits(...) ((void)0) /* of many numbers, in half_and_diameter_fit, which is not proved */
#define mpz_clears(...) ((void)0)

#include "checker/bounds.h"

/*@ requires \valid(b); assigns *b; exits \false; ensures fraction(&b->area2, 0); */
void dyd_cert_bounds_init(dyd_cert_bounds *b);
/*@ requires \valid(b) && of_parts(&b->area2); assigns b->area2; exits \false; */
void dyd_cert_bounds_clear(dyd_cert_bounds *b);
/*@ requires small_side(s); assigns \nothing; exits \false; ensures small(\result);
    ensures \result == &s->lo || \result == &s->hi; */
static const dyd_exact *side_end(const dyd_cert_side *s, int upper);
/*@ requires \valid(out) && of_parts(out) && small_side(a) && small_side(b) && apart_from_side(out, a) &&
      apart_from_side(out, b);
    assigns FRACTION(out); exits \false; ensures fraction(out, 1048576); */
static void side_gap(dyd_cert_fraction *out, const dyd_cert_side *a, int ua, const dyd_cert_side *b, int ub);
/*@ requires \valid(f) && fraction(f, 4194304); assigns FRACTION(f); exits \false;
    ensures fraction(f, 274877906944); */
static void fraction_make_whole(dyd_cert_fraction *f);
/*@ requires \valid(man) && exact(x) && \separated(man, x);
    requires x->man[0].sign != 0 ==> 0 <= x->exp + s <= 1099511627776;
    requires -1099511627776 <= s <= 1099511627776;
    assigns man->sign, man->length, man->zeros; exits \false; ensures whole(man); */
static void set_scaled(mpz_ptr man, const dyd_exact *x, int64_t s);
/*@ requires -4611686018427387904 <= e <= 4611686018427387904; assigns \nothing; exits \false;
    ensures e <= 2 * \result <= e + 1; */
static int64_t half_up(int64_t e);
/*@ assigns \nothing; exits \false; ensures \result == \max(a, b); */
static int64_t larger_exponent(int64_t a, int64_t b);
/*@ requires \valid_read(b) && exact(&b->area2.num) && small(area); assigns \nothing; exits \false; */
bool dyd_cert_bounds_area_holds(const dyd_cert_bounds *b, const dyd_exact *area);

#include "checker/bounds.c"
