/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/sites.c: the list of sites grows, and numbers are on the grid. */
/* Without dyd_cert_sites_init, clear_side, clear_place, dyd_cert_sites_clear, end_outward, axis_extent,
   place_on_grid, dyd_cert_sites_finish, dyd_cert_is_point, dyd_cert_high, dyd_cert_den, dyd_cert_place: not tried. */
/* Unproved dyd_cert_side_set_den_assigns_exit_part3: WP does not know that new memory is new. */
/* Unproved dyd_cert_side_set_den_assigns_normal_part4: WP does not know that new memory is new. */
/* Unproved dyd_cert_side_set_den_assigns_normal_part5: WP does not know that new memory is new. */
#include "sites.h"

#include "base/alloc.h"

#define ITEM dyd_cert_site
#define RESERVE dyd_reserve
#define ALLOC alloc_sites
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

#include "checker/sites.c"
