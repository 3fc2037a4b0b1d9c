/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/sites.c: the list of sites grows, and numbers are on the grid. */
/* Without place_on_grid: that coordinates are below 2^31 follows from how the unit was chosen, and GMP is seen here as
   signs and lengths: four conversions to int32_t stay unknown, and conditions of calls. */
/* Unproved dyd_cert_side_set_den_assigns_exit_part3: WP does not know that new memory is new. */
/* Unproved dyd_cert_side_set_den_assigns_normal_part4: WP does not know that new memory is new. */
/* Unproved dyd_cert_side_set_den_assigns_normal_part5: WP does not know that new memory is new. */
#include "sites.h"

#include "base/alloc.h"

#define ITEM dyd_cert_site
#define RESERVE dyd_reserve
#define ALLOC alloc_sites
#include "lists.h"
#define ITEM dyd_cert_box
#define RESERVE reserve_boxes
#define ALLOC alloc_boxes
#include "lists.h"
#define ITEM mpz_t
#define RESERVE reserve_numbers
#define ALLOC alloc_numbers
#include "lists.h"
#define ITEM dyd_exact
#define RESERVE reserve_places
#define ALLOC alloc_places
#include "lists.h"

typedef const dyd_cert_sites *list_of_sites;
typedef const dyd_cert_site *site_of;

/*@ predicate room(list_of_sites s) = \valid(s) && s->count <= s->cap <= 1152921504606846976 &&
      (0 < s->cap ==> \valid(s->site + (0 .. s->cap - 1)) && \separated(s->site + (0 .. s->cap - 1), s)); */

/*@ requires room(s) && s->count <= 4294967295; exits \false;
    ensures \result != \null ==> room(s) && s->count == \old(s->count) + 1 <= 4294967295;
    ensures \result != \null ==> \result == s->site + \old(s->count); */
dyd_cert_site *dyd_cert_sites_add(dyd_cert_sites *s);
/*@ requires \valid(site) && exact(at) && exact(at + 1) && \separated(site, at + (0 .. 1));
    requires site->place == \null || \valid(site->place + (0 .. 1)) && exact(site->place) && exact(site->place + 1) &&
      \separated(site->place + (0 .. 1), site, at + (0 .. 1));
    exits \false;
    ensures \result == DYD_OK ==> \valid(site->place + (0 .. 1)) && whole(&site->place[0].man[0]) &&
      whole(&site->place[1].man[0]); */
dyd_status dyd_cert_site_set_place(dyd_cert_site *site, const dyd_exact at[2]);

/*@ requires \valid(s); assigns *s; exits \false; */
void dyd_cert_sites_init(dyd_cert_sites *s);
/*@ requires \valid(s) && whole(&s->lo.man[0]) && whole(&s->hi.man[0]);
    requires s->den == \null || \valid(s->den) && whole(&(*s->den)[0]) && \separated(&(*s->den)[0], s);
    assigns s->lo, s->hi, (*s->den)[0]; exits \false; */
static void clear_side(dyd_cert_side *s);
/*@ requires \valid(s);
    requires s->place == \null || \valid(s->place + (0 .. 1)) && whole(&s->place[0].man[0]) &&
      whole(&s->place[1].man[0]) && \separated(s->place + (0 .. 1), s);
    assigns s->place, s->place[0 .. 1]; exits \false; */
static void clear_place(dyd_cert_site *s);
/*@ requires \valid(out) && small_side(s) && apart_from_side(out, s) && exact(out);
    assigns *out; exits \false; ensures exact(out) && -137440002112 <= out->exp <= 1048576; */
static void end_outward(dyd_exact *out, const dyd_cert_side *s, bool upper);
/*@ predicate sides(list_of_sites s, integer axis) = \forall integer k; 0 <= k < s->count ==>
      small_side(&s->site[k].side[axis]);
    predicate end(exact_number x) = exact(x) && -137440002112 <= x->exp <= 1048576;
    predicate apart_from_sides(exact_number x, list_of_sites s, integer axis) = \forall integer k; 0 <= k < s->count ==>
      apart_from_side(x, &s->site[k].side[axis]);
    predicate clearable(side_of s) = \valid(s) && whole(&s->lo.man[0]) && whole(&s->hi.man[0]) &&
      (s->den == \null || \valid(s->den) && whole(&(*s->den)[0]) && \separated(&(*s->den)[0], s));
    predicate place_clearable(site_of s) = \valid(s) && (s->place == \null || \valid(s->place + (0 .. 1)) &&
      whole(&s->place[0].man[0]) && whole(&s->place[1].man[0]) && \separated(s->place + (0 .. 1), s)); */
/*@ requires \valid(s) && whole(&s->origin[0][0]) && whole(&s->origin[1][0]) && s->count <= 4294967295 &&
      (0 < s->count ==> \valid(s->site + (0 .. s->count - 1)) && \separated(s, s->site + (0 .. s->count - 1))) &&
      (\forall integer k; 0 <= k < s->count ==> clearable(&s->site[k].side[0]) && clearable(&s->site[k].side[1]) &&
        place_clearable(&s->site[k]));
    exits \false; */
void dyd_cert_sites_clear(dyd_cert_sites *s);
/*@ requires \valid(range + (0 .. 1)) && end(range) && end(range + 1) && \valid_read(s) && 0 <= axis <= 1 &&
      sides(s, axis) && \separated(range + (0 .. 1), s) && apart_from_sides(range, s, axis) &&
      apart_from_sides(range + 1, s, axis);
    assigns range[0 .. 1]; exits \false; ensures end(range) && end(range + 1); */
static void axis_extent(dyd_exact range[2], const dyd_cert_sites *s, int axis);
/*@ requires \valid(box) && \valid_read(s) && i < s->count && -274877906944 <= s->unit <= 274877906944 &&
      whole(&s->origin[0][0]) && whole(&s->origin[1][0]) && small_side(&s->site[i].side[0]) &&
      small_side(&s->site[i].side[1]);
    assigns *box; exits \false; */
static void place_on_grid(dyd_cert_box *box, const dyd_cert_sites *s, size_t i);
/*@ predicate beside_sides(list_of_sites s) = \separated(s, s->site + (0 .. s->count - 1)) &&
      (\forall integer k; 0 <= k < s->count ==> apart_from_side(s, &s->site[k].side[0]) &&
        apart_from_side(s, &s->site[k].side[1]));
    predicate boxes_apart(list_of_sites s) =
      \separated(s->box + (0 .. s->count - 1), s, s->site + (0 .. s->count - 1)) &&
      (\forall integer k; 0 <= k < s->count ==>
        apart_from_side(s->box + (0 .. s->count - 1), &s->site[k].side[0]) &&
        apart_from_side(s->box + (0 .. s->count - 1), &s->site[k].side[1])); */
/*@ requires \valid(s) && sides(s, 0) && sides(s, 1) && s->count <= 4294967295 && whole(&s->origin[0][0]) &&
      whole(&s->origin[1][0]) && beside_sides(s);
    exits \false; */
dyd_status dyd_cert_sites_finish(dyd_cert_sites *s);

#include "checker/sites.c"
