/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/faces.c: open sets grow in their lists, and are found by sites that are there. */
/* Without dyd_cert_faces_init: its loop over sets writes to a list whose length no contract states yet. */
#include "faces.h"
#include "by_key.h"

#include "base/alloc.h"
#include <string.h>

#define ITEM uint32_t
#define RESERVE reserve_any
#define ALLOC alloc_indices
#include "lists.h"
typedef const dyd_cert_corner *corner_of;

#define ITEM bool
#define RESERVE reserve_flags
#define ALLOC alloc_flags
#include "lists.h"
#define ITEM size_t
#define ALLOC zeroed_sizes
#include "zeroed.h"
#define ITEM uint64_t
#define ALLOC zeroed_pair_counts
#include "zeroed.h"
#define ITEM uint32_t
#define ALLOC zeroed_indices
#include "zeroed.h"
#define ITEM bool
#define ALLOC zeroed_flags
#include "zeroed.h"

#define ITEM uint32_t
#define RESERVE reserve_members
#include "keeps.h"
#define ITEM size_t
#define RESERVE reserve_starts
#include "keeps.h"
#define ITEM dyd_cert_shape
#define RESERVE reserve_shapes
#include "keeps.h"

/*@ requires 0 < n ==> \valid(to + (0 .. n - 1)); assigns to[0 .. n - 1]; exits \false; */
void clear_flags(bool *to, size_t n);
#define memset(to, c, n) clear_flags(to, n)
/*@ requires 0 < n ==> \valid(to + (0 .. n / 4 - 1)) && \valid_read(from + (0 .. n / 4 - 1)) &&
      \separated(to + (0 .. n / 4 - 1), from + (0 .. n / 4 - 1));
    assigns to[0 .. n / 4 - 1]; exits \false;
    ensures \forall integer count, most; 4 * count == n && below{Pre}((uint32_t *)from, count, most) ==>
      below(to, count, most); */
void copy_sites(uint32_t *to, const uint32_t *from, size_t n);
#define memcpy(to, from, n) copy_sites(to, from, n)
#define dyd_cert_distinct(item, count) distinct_sites(item, count)
/* What graph.h says of dyd_cert_sort, of sites. */
/*@ requires 0 < count < 1152921504606846976 && \valid(item + (0 .. count - 1)) && below(item, count, SITES);
    assigns item[0 .. count - 1]; exits \false; ensures below(item, count, SITES); */
void sort_sites(uint32_t *item, size_t count);
#define dyd_cert_sort(item, count, compare, with) sort_sites(item, count)
/*@ requires drawn(g) && h < 2 * g->count && \valid(out) && \valid(count) && \separated(out, count, g, g->sites,
      g->legal, g->bridges, g->start + (0 .. SITES), g->around + (0 .. 2 * g->count - 1),
      g->position + (0 .. 2 * g->count - 1), g->legal->item + (0 .. g->legal->count - 1),
      g->bridges->item + (0 .. g->bridges->count - 1));
    exits \false;
    ensures \result == DYD_OK ==> 0 < *count <= 2 * g->count && \valid(*out + (0 .. *count - 1)) &&
      below(*out, *count, 2 * g->count); */
dyd_status dyd_cert_walk(uint32_t **out, size_t *count, const dyd_cert_graph *g, uint32_t h);
/* Operands of comparisons are pointers to what is there: WP's memory does not follow casts from pointers to void. */
#define compare_place_of(x, y, z) compare_place_of(const dyd_cert_sites *sites, uint32_t a, uint32_t b)
/*@ requires \valid_read(sites) && a < sites->count && b < sites->count; assigns \nothing; exits \false;
    ensures -1 <= \result <= 1; */
static int compare_place_of(x, y, z);
/*@ requires \valid(hull + (0 .. SITES - 1)) && \valid_read(s) && s->count == SITES &&
      \valid_read(s->site + (0 .. SITES - 1)) && 0 < SITES && 0 < count < 4294967295 &&
      \valid(item + (0 .. count - 1)) &&
      below(item, count, SITES) && \separated(hull + (0 .. SITES - 1), item + (0 .. count - 1), s);
    exits \false; */
dyd_status dyd_cert_hull(bool *hull, const dyd_cert_sites *s, uint32_t *item, size_t count);
/*@ predicate corner_list(corner_of c, integer count) = count <= 1152921504606846976 &&
      (0 < count ==> \valid_read(c + (0 .. count - 1))) && (\forall integer k; 0 <= k < count ==> c[k].i < SITES) &&
      (\forall integer k, l; 0 <= k < l < count ==> c[k].i < c[l].i); */
/*@ requires \valid_read(key) && corner_list(item, count); assigns \nothing; exits \false;
    ensures (\exists integer k; 0 <= k < count && item[k].i == *key) ==>
      \exists integer k; 0 <= k < count && \result == item + k; */
const dyd_cert_corner *find_corner(const uint32_t *key, const dyd_cert_corner *item, size_t count);
#define bsearch(key, item, count, size, compare) find_corner(key, item, count)
#define compare_with_corner(x, y) compare_with_corner(const uint32_t *a, const dyd_cert_corner *b)
/*@ requires \valid_read(a) && \valid_read(b); assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
static int compare_with_corner(x, y);
/*@ requires \valid(f); assigns *f; exits \false; */
void dyd_cert_faces_clear(dyd_cert_faces *f);
/*@ requires indexed(f) && i < SITES && j < SITES && \valid(a) && \valid(b);
    requires \separated(a, b, f, f->first + (0 .. SITES), f->of + (0 .. f->members - 1));
    assigns *a, *b; exits \false; ensures \result == DYD_CERT_NONE || \result < f->sets; */
static uint32_t next_common_set(const dyd_cert_faces *f, size_t *a, size_t *b, uint32_t i, uint32_t j);
/*@ requires \valid_read(item + (0 .. count - 1)) && 0 < count < 4294967295 && \valid(stack + (0 .. count - 1)) &&
      \valid(hull + (0 .. SITES - 1)) && (\forall integer k; 0 <= k < count ==> item[k] < SITES) &&
      \separated(stack + (0 .. count - 1), item + (0 .. count - 1), hull + (0 .. SITES - 1), s);
    requires \valid_read(s) && s->count == SITES && \valid_read(s->site + (0 .. SITES - 1));
    assigns hull[0 .. SITES - 1], stack[0 .. count - 1]; exits \false; */
static void mark_hull_chain(bool *hull, uint32_t *stack, const dyd_cert_sites *s, const uint32_t *item, size_t count,
                            bool back);

/* Open sets that are added, in their lists; of the two, outside: no list of f is one of the other's. */
/*@ predicate filling(open_sets f) = \valid(f) && f->members <= f->member_cap <= 1152921504606846976 &&
      f->set_cap <= 1152921504606846976 && f->sets <= f->shape_cap <= 1152921504606846976 &&
      (0 < f->sets ==> f->sets < f->set_cap) && f->sets <= 4294967290 &&
      (0 < f->member_cap ==> \valid(f->member + (0 .. f->member_cap - 1))) &&
      (0 < f->set_cap ==> \valid(f->start + (0 .. f->set_cap - 1))) &&
      (0 < f->shape_cap ==> \valid(f->shape + (0 .. f->shape_cap - 1))) &&
      \separated(f, f->member + (0 .. f->member_cap - 1), f->start + (0 .. f->set_cap - 1),
        f->shape + (0 .. f->shape_cap - 1)) &&
      below(f->member, f->members, SITES);
    // Each set begins where the one before ends.
    predicate listed(open_sets f) = (f->sets == 0 ==> f->members == 0) && (0 < f->sets ==> f->start[0] == 0 &&
      f->start[f->sets] == f->members &&
      (\forall integer k; 0 <= k <= f->sets ==> f->start[k] <= f->members)); */
/*@ requires filling(f) && listed(f) && joined(g) && f->sets < 4294967290 && count <= 8589934592 &&
      (0 < count ==> \valid_read(site + (0 .. count - 1))) && below((uint32_t *)site, count, SITES);
    requires \separated(f, site + (0 .. count - 1), g, g->legal, g->bridges, g->sites) &&
      \separated(f, g->legal->item + (0 .. g->legal->count - 1), g->bridges->item + (0 .. g->bridges->count - 1));
    exits \false;
    ensures \result == DYD_OK ==> filling(f);
    ensures \result == DYD_OK ==> listed(f);
    ensures \result == DYD_OK ==> \old(f->sets) <= f->sets <= \old(f->sets) + 1; */
static dyd_status faces_add_set(dyd_cert_faces *f, const dyd_cert_graph *g, const uint32_t *site, size_t count,
                                dyd_cert_shape shape);

/*@ requires filling(f) && listed(f) && joined(g) && f->sets < 4294967290 &&
      (0 < SITES ==> \valid_read(g->sites->site + (0 .. SITES - 1)));
    requires \separated(f, g, g->legal, g->bridges, g->sites) && \separated(f, g->sites->site + (0 .. SITES - 1)) &&
      \separated(f, g->legal->item + (0 .. g->legal->count - 1), g->bridges->item + (0 .. g->bridges->count - 1));
    exits \false;
    ensures \result == DYD_OK ==> filling(f);
    ensures \result == DYD_OK ==> listed(f);
    ensures \result == DYD_OK ==> \old(f->sets) <= f->sets <= \old(f->sets) + 1; */
static dyd_status faces_add_all_sites(dyd_cert_faces *f, const dyd_cert_graph *g);
/*@ requires filling(f) && listed(f) && drawn(g) && f->sets < 4294967290 && h < 2 * g->count &&
      \valid(seen + (0 .. 2 * g->count - 1));
    requires \separated(f, seen + (0 .. 2 * g->count - 1), g, g->legal, g->bridges, g->sites) &&
      \separated(f, g->legal->item + (0 .. g->legal->count - 1), g->bridges->item + (0 .. g->bridges->count - 1)) &&
      \separated(g, g->sites, g->legal, g->bridges, g->start + (0 .. SITES), g->around + (0 .. 2 * g->count - 1),
        g->position + (0 .. 2 * g->count - 1), g->legal->item + (0 .. g->legal->count - 1),
        g->bridges->item + (0 .. g->bridges->count - 1));
    exits \false;
    ensures \result == DYD_OK ==> filling(f);
    ensures \result == DYD_OK ==> listed(f);
    ensures \result == DYD_OK ==> \old(f->sets) <= f->sets <= \old(f->sets) + 1; */
static dyd_status add_bounded_face(dyd_cert_faces *f, bool *seen, const dyd_cert_graph *g, uint32_t h);
#define dyd_cert_by_key(start, item, keys, entry, count) by_key_below(start, item, keys, entry, count, f->sets)
/*@ requires filling(f) && listed(f) && \valid_read(s) && s->count == SITES &&
      (0 < SITES ==> \valid_read(s->site + (0 .. SITES - 1)));
    requires \separated(f, s);
    exits \false; ensures \result == DYD_OK ==> indexed(f); */
static dyd_status faces_index_sites(dyd_cert_faces *f, const dyd_cert_sites *s);
/* What measure.c promises of them, of lists of sites that are there. */
typedef const dyd_cert_sites *places_of;
/*@ predicate listed_places(places_of s, uint32_t *site, integer count) = \valid_read(site + (0 .. count - 1)) &&
      \valid_read(s) && s->count == SITES && \valid_read(s->site + (0 .. SITES - 1)) &&
      (\forall integer q; 0 <= q < count ==> site[q] < SITES && small_site(s->site + site[q])); */
/*@ requires 2 <= count && listed_places(s, (uint32_t *)site, count); assigns \nothing; exits \false; */
bool dyd_cert_on_line(const dyd_cert_sites *s, const uint32_t *site, size_t count);
/*@ requires 3 <= count && listed_places(s, (uint32_t *)site, count); assigns \nothing; exits \false; */
bool dyd_cert_on_circle(const dyd_cert_sites *s, const uint32_t *site, size_t count);

#include "checker/faces.c"
