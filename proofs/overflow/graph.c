/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/graph.c: sorting stays in the list, the list of pairs grows, walks stay in the graph. */
/* Operands of comparisons are pointers to what is there: WP's memory does not follow casts from pointers to void. */
#define dyd_cert_compare_edges(x, y) dyd_cert_compare_edges(const dyd_cert_edge *a, const dyd_cert_edge *b)
#define compare_angle(x, y, z) compare_angle(const dyd_cert_graph *graph, uint32_t h, uint32_t k)
#include "by_key.h"

#include "base/alloc.h"

#define ITEM dyd_cert_edge
#define RESERVE dyd_reserve
#define ALLOC alloc_edges
#include "lists.h"
#define ITEM uint32_t
#define RESERVE reserve_indices
#define ALLOC alloc_indices
#include "lists.h"
#define dyd_cert_by_key(start, item, keys, entry, count) by_key_below(start, item, keys, entry, count, count)

/*@ requires \valid_read(key) && 0 < count && \valid_read(item + (0 .. count - 1)); assigns \nothing; exits \false; */
const dyd_cert_edge *find_edge(const dyd_cert_edge *key, const dyd_cert_edge *item, size_t count);
#define bsearch(key, item, count, size, compare) find_edge(key, item, count)

/*@ requires a < BOUND && b < BOUND; assigns \nothing; exits \false; */
int compare_any(const void *with, uint32_t a, uint32_t b);
#define compare(with, a, b) compare_any(with, a, b)

/*@ requires \valid(a + (0 .. count - 1)) && 0 < count < 1152921504606846976 && root < count &&
      below(a, count, BOUND);
    assigns a[0 .. count - 1]; exits \false; ensures below(a, count, BOUND); */
static void sift_down(uint32_t *a, size_t root, size_t count, dyd_cert_compare *compare, const void *with);
/*@ requires \valid_read(s) && a < s->count && b < s->count; assigns \nothing; exits \false;
    ensures 0 <= \result <= 1; */
static int half_of_directions(const dyd_cert_sites *s, uint32_t a, uint32_t b);
/*@ requires joined((const dyd_cert_graph *)graph) && h < 2 * ((const dyd_cert_graph *)graph)->count &&
      k < 2 * ((const dyd_cert_graph *)graph)->count;
    assigns \nothing; exits \false; */
static int compare_angle(const void *graph, uint32_t h, uint32_t k);
/*@ requires joined(g); assigns \nothing; exits \false; */
static bool have_directions(const dyd_cert_graph *g);
/*@ requires \valid(g) && joined(g) && (0 < SITES ==> \valid_read(g->sites->site + (0 .. SITES - 1))) &&
      \separated(g, g->sites, g->legal, g->bridges, g->sites->site + (0 .. SITES - 1)) &&
      \separated(g, g->legal->item + (0 .. g->legal->count - 1), g->bridges->item + (0 .. g->bridges->count - 1));
    exits \false; ensures \result == DYD_OK || \result == DYD_E_NOMEM; ensures joined(g);
    ensures g->start == \old(g->start) && g->around == \old(g->around) && g->position == \old(g->position); */
static dyd_status find_connected(dyd_cert_graph *g);
/*@ predicate laid(graph g) = \valid(g) && \valid(g->start + (0 .. SITES)) &&
      (0 < g->count ==> \valid(g->around + (0 .. 2 * g->count - 1)) &&
        \valid(g->position + (0 .. 2 * g->count - 1))) &&
      \separated(g, g->sites, g->legal, g->bridges, g->start + (0 .. SITES), g->around + (0 .. 2 * g->count - 1),
        g->position + (0 .. 2 * g->count - 1), g->legal->item + (0 .. g->legal->count - 1),
        g->bridges->item + (0 .. g->bridges->count - 1)); */
/* What graph.h says of dyd_cert_sort where BOUND is twice the count, of a part of g->around: the rest of it stays.
 * compare_angle is called for half-edges below that. */
/*@ requires joined(g) && 0 <= item - g->around && item == g->around + (item - g->around) &&
      item - g->around + count <= 2 * g->count && count < 1152921504606846976;
    requires 0 < g->count ==> \valid(g->around + (0 .. 2 * g->count - 1));
    requires below(g->around, 2 * g->count, 2 * g->count);
    assigns g->around[0 .. 2 * g->count - 1]; exits \false; ensures below(g->around, 2 * g->count, 2 * g->count); */
void sort_half_edges(uint32_t *item, size_t count, const dyd_cert_graph *g);
/*@ requires joined(g) && laid(g);
    exits \false;
    ensures \valid(g);
    ensures \result == DYD_OK ==> below(g->around, 2 * g->count, 2 * g->count);
    ensures \result == DYD_OK ==> starts(g->start, SITES, 2 * g->count); */
static dyd_status gather_around(dyd_cert_graph *g);

#include "checker/graph.c"
