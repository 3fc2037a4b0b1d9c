/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/bounds.c: gaps between sides, a sum of areas that stays a number. */
#define SPELL_OUT
#include "sites.h"

#undef mpz_inits
#undef mpz_clears
#define mpz_inits(a, b, c, end) (mpz_init(a), mpz_init(b), mpz_init(c))
#define mpz_clears(a, b, c, d, e, end) (mpz_clear(a), mpz_clear(b), mpz_clear(c), mpz_clear(d), mpz_clear(e))

#include "checker/bounds.h"
#include <dyadel/dyadic.h>

/*@ requires whole(a) && whole(b) && whole(c) && whole(d) && whole(e); assigns \nothing; exits \false;
    ensures -1 <= \result <= 1; */
int dyd_sqrt2_sign(const mpz_t a, const mpz_t b, const mpz_t c, const mpz_t d, const mpz_t e);

/* Of sites their places are no part. */
#define rectangle(s) (\valid_read(s) && small_side(&(s)->side[0]) && small_side(&(s)->side[1]))
#define apart_from_rectangle(x, s) (\separated(x, s) && apart_from_side(x, &(s)->side[0]) && \
    apart_from_side(x, &(s)->side[1]))

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
    requires sign(&x->man[0]) != 0 ==> 0 <= x->exp + s <= 1099511627776;
    requires -1099511627776 <= s <= 1099511627776;
    assigns man->value; exits \false; ensures whole(man); */
static void set_scaled(mpz_ptr man, const dyd_exact *x, int64_t s);
/*@ requires -4611686018427387904 <= e <= 4611686018427387904; assigns \nothing; exits \false;
    ensures e <= 2 * \result <= e + 1; */
static int64_t half_up(int64_t e);
/*@ assigns \nothing; exits \false; ensures \result == \max(a, b); */
static int64_t larger_exponent(int64_t a, int64_t b);
/*@ requires \valid_read(b) && exact(&b->area2.num) && small(area); assigns \nothing; exits \false; */
bool dyd_cert_bounds_area_holds(const dyd_cert_bounds *b, const dyd_exact *area);
/*@ requires \valid(out) && of_parts(out) && small_side(a) && small_side(b) && apart_from_side(out, a) &&
      apart_from_side(out, b);
    assigns FRACTION(out); exits \false; ensures fraction(out, 1048576); */
static void side_reach(dyd_cert_fraction *out, const dyd_cert_side *a, const dyd_cert_side *b);
/*@ requires \valid(out) && of_parts(out) && small_side(a) && small_side(b) && apart_from_side(out, a) &&
      apart_from_side(out, b);
    assigns FRACTION(out); exits \false; ensures fraction(out, 1048576); */
static void side_span(dyd_cert_fraction *out, const dyd_cert_side *a, const dyd_cert_side *b);
/*@ requires \valid(out) && of_parts(out) && rectangle(a) && rectangle(b) && apart_from_rectangle(out, a) &&
      apart_from_rectangle(out, b);
    assigns FRACTION(out); exits \false; ensures fraction(out, 2097152); */
static void site_reach2(dyd_cert_fraction *out, const dyd_cert_site *a, const dyd_cert_site *b);
/*@ requires \valid(out) && of_parts(out) && rectangle(a) && rectangle(b) && apart_from_rectangle(out, a) &&
      apart_from_rectangle(out, b);
    assigns FRACTION(out); exits \false; ensures fraction(out, 2097152); */
static void site_diameter2(dyd_cert_fraction *out, const dyd_cert_site *a, const dyd_cert_site *b);
/*@ requires \valid(out) && fraction(out, 2097153) && rectangle(a) && rectangle(b) && apart_from_rectangle(out, a) &&
      apart_from_rectangle(out, b);
    assigns FRACTION(out); exits \false; ensures fraction(out, 2097153); */
static void bounds_cut_corner(dyd_cert_fraction *out, const dyd_cert_site *a, const dyd_cert_site *b, int ux, int uy);
/*@ requires \valid(b) && fraction(&b->area2, 274877906944) && rectangle(i) && rectangle(j) &&
      apart_from_rectangle(b, i) && apart_from_rectangle(b, j);
    assigns FRACTION(&b->area2); exits \false; ensures fraction(&b->area2, 274877906944); */
static void bounds_add_area(dyd_cert_bounds *b, const dyd_cert_site *i, const dyd_cert_site *j);
/*@ requires fraction(l, 2097152) && fraction(d, 2097152) && small(h); assigns \nothing; exits \false; */
static bool half_and_diameter_fit(const dyd_cert_fraction *l, const dyd_cert_fraction *d, const dyd_exact *h);
/*@ requires \valid_read(b) && small(b->hausdorff) && rectangle(i) && rectangle(j); assigns \nothing; exits \false; */
static bool hausdorff_fits(const dyd_cert_bounds *b, const dyd_cert_site *i, const dyd_cert_site *j, bool legal);
/*@ requires \valid(b) && fraction(&b->area2, 274877906944) && (b->hausdorff == \null || small(b->hausdorff) &&
      \separated(b, b->hausdorff)) && \valid_read(s) && \separated(b, s) && rectangle(s->site + i) &&
      rectangle(s->site + j) && apart_from_rectangle(b, s->site + i) && apart_from_rectangle(b, s->site + j);
    assigns FRACTION(&b->area2), b->exceeded; exits \false; ensures fraction(&b->area2, 274877906944); */
void dyd_cert_bounds_add(dyd_cert_bounds *b, const dyd_cert_sites *s, uint32_t i, uint32_t j, bool legal);

#include "checker/bounds.c"
