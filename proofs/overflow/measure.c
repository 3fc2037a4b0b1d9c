/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/measure.c: turns reckoned on the grid. */
/* Unproved site_height_loop_invariant_preserved, dyd_cert_cross_loop_invariant_3_preserved,
   dyd_cert_cross_loop_invariant_4_preserved, lifted_set_ensures: that numbers stay while another one is set or cleared takes 8 to 12 s of a
   quiet machine. */
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
    assigns out->den[0].value;
    exits \false; ensures whole(&out->den[0]) && sign(&out->den[0]) == 1; */
static void multiply_dens(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b);

/*@ requires on_grid(s, a) && on_grid(s, b) && on_grid(s, c) && small_site(s->site + a) && small_site(s->site + b) &&
      small_site(s->site + c);
    assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
int dyd_cert_turn(const dyd_cert_sites *s, uint32_t a, uint32_t b, uint32_t c);
/*@ requires \valid(out) && spot(a) && spot(b) && 0 <= axis <= 1 && of_parts(out) && \separated(out, a) &&
      \separated(out, b) && apart_from_spot(out, a) && apart_from_spot(out, b);
    assigns FRACTION(out); exits \false; ensures fraction(out, 1048576); */
static void spot_difference(dyd_cert_fraction *out, const dyd_cert_spot *a, const dyd_cert_spot *b, int axis);
/*@ requires on_grid(s, a) && on_grid(s, b) && small_site(s->site + a) && small_site(s->site + b);
    assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
int dyd_cert_compare_places(const dyd_cert_sites *s, uint32_t a, uint32_t b);
/*@ requires \valid(d) && of_parts(d) && small(c) && small_site(s) && 0 <= axis <= 1 && \separated(d, c) &&
      apart_from_site(d, s);
    assigns FRACTION(d); exits \false; ensures fraction(d, 1048576); */
static void axis_distance(dyd_cert_fraction *d, const dyd_exact *c, const dyd_cert_site *s, int axis,
                          dyd_cert_measure measure);
/*@ requires \valid(out) && fraction(out, 2097152) && small(u) && small(u + 1) && \valid_read(s) &&
      small_side(&s->side[0]) && small_side(&s->side[1]) && \separated(out, u + (0 .. 1)) && \separated(out, s) &&
      apart_from_side(out, &s->side[0]) && apart_from_side(out, &s->side[1]);
    assigns FRACTION(out); exits \false; ensures fraction(out, 2097152); */
static void site_height(dyd_cert_fraction *out, const dyd_exact u[2], const dyd_cert_site *s, bool upper);
/*@ requires \valid(to) && \valid_read(from) && \separated(to, from); assigns FRACTION(to); exits \false;
    ensures to->num.man[0].value == from->num.man[0].value && to->num.exp == from->num.exp;
    ensures to->den[0].value == from->den[0].value && to->whole == from->whole; */
void copy_fraction(dyd_cert_fraction *to, const dyd_cert_fraction *from);

/* Triples of fractions of their own; of the sites of a list, each is there, and small. */
typedef const uint32_t *site_list;
/*@ predicate listed_places(grid s, site_list site, integer count) = \valid_read(site + (0 .. count - 1)) &&
      (\forall integer q; 0 <= q < count ==> on_grid(s, site[q]) && small_site(s->site + site[q])); */
#define LIFTED(v) FRACTION(&(v)->x), FRACTION(&(v)->y), FRACTION(&(v)->square)
#define lifted_parts(v) (\valid_read(v) && of_parts(&(v)->x) && of_parts(&(v)->y) && of_parts(&(v)->square))
#define lifted_within(v, most) (\valid_read(v) && fraction(&(v)->x, most) && fraction(&(v)->y, most) && \
    fraction(&(v)->square, 2 * (most)))
/*@ requires 2 <= count && listed_places(s, site, count); assigns \nothing; exits \false; */
bool dyd_cert_on_line(const dyd_cert_sites *s, const uint32_t *site, size_t count);
/*@ requires \valid(out) && of_parts(out) && fraction(a, 2097152) && fraction(b, 2097152) && fraction(c, 2097152) &&
      fraction(d, 2097152) && \separated(out, a) && \separated(out, b) && \separated(out, c) && \separated(out, d);
    assigns FRACTION(out); exits \false; ensures fraction(out, 4194304); */
static void fraction_cross(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b,
                           const dyd_cert_fraction *c, const dyd_cert_fraction *d);
/*@ requires 3 <= count && listed_places(s, site, count); assigns \nothing; exits \false; */
bool dyd_cert_on_circle(const dyd_cert_sites *s, const uint32_t *site, size_t count);

#include "checker/measure.c"
