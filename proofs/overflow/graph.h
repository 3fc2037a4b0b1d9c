/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of graphs, and contracts of src/checker/graph.h. */
#ifndef DYD_PROOFS_GRAPH_H
#define DYD_PROOFS_GRAPH_H

#include "sites.h"

/* SITES: how many there are; BOUND: items that are sorted are below it. */
/*@ axiomatic Sizes { logic integer SITES; axiom sites: 0 <= SITES <= 4294967294;
      logic integer BOUND; axiom bound: 0 <= BOUND <= 4294967295; }
    predicate below(uint32_t *item, integer count, integer most) =
      \forall integer k; 0 <= k < count ==> item[k] < most;
    predicate rising(uint32_t *parent, integer n) = \forall integer k; 0 <= k < n ==> parent[k] <= k;
    predicate forest(uint32_t *parent) = \valid(parent + (0 .. SITES - 1)) && below(parent, SITES, SITES); */

#include "checker/graph.h"

typedef const dyd_cert_edges *edges;
typedef const dyd_cert_graph *graph;

/*@ predicate pairs(edges e, integer sites) = \valid_read(e) && e->count <= 1073741823 &&
      (0 < e->count ==> \valid_read(e->item + (0 .. e->count - 1))) &&
      (\forall integer k; 0 <= k < e->count ==> e->item[k].i < sites && e->item[k].j < sites);
    logic integer from(graph g, integer h) = h / 2 < g->legal->count ?
      (h % 2 == 0 ? g->legal->item[h / 2].i : g->legal->item[h / 2].j) :
      (h % 2 == 0 ? g->bridges->item[h / 2 - g->legal->count].i : g->bridges->item[h / 2 - g->legal->count].j);
    predicate joined(graph g) = \valid_read(g) && \valid_read(g->sites) && g->sites->count == SITES &&
      pairs(g->legal, g->sites->count) && pairs(g->bridges, g->sites->count) &&
      g->count == g->legal->count + g->bridges->count && g->count < 1073741823; */

/*@ requires joined(g) && h < 2 * g->count; assigns \nothing; exits \false;
    ensures \result.i < g->sites->count && \result.j < g->sites->count;
    ensures from(g, h) == (h % 2 == 0 ? \result.i : \result.j); */
static inline dyd_cert_edge dyd_cert_edge_of(const dyd_cert_graph *g, uint32_t h);
/*@ requires joined(g) && h < 2 * g->count; assigns \nothing; exits \false; */
static inline bool dyd_cert_is_legal(const dyd_cert_graph *g, uint32_t h);
/*@ requires joined(g) && h < 2 * g->count; assigns \nothing; exits \false;
    ensures \result < g->sites->count && \result == from(g, h); */
static inline uint32_t dyd_cert_origin(const dyd_cert_graph *g, uint32_t h);

/*@ predicate drawn(graph g) = joined(g) && \valid_read(g->start + (0 .. SITES)) &&
      (0 < g->count ==> \valid_read(g->around + (0 .. 2 * g->count - 1)) &&
        \valid_read(g->position + (0 .. 2 * g->count - 1))) &&
      below(g->around, 2 * g->count, 2 * g->count) && below(g->position, 2 * g->count, 2 * g->count) &&
      (\forall integer v; 0 <= v <= SITES ==> g->start[v] <= 2 * g->count) &&
      (\forall integer h; 0 <= h < 2 * g->count ==>
        g->start[from(g, h)] <= g->position[h] < g->start[from(g, h) + 1]); */
/*@ requires forest(parent) && v < SITES; assigns parent[0 .. SITES - 1]; exits \false;
    ensures forest(parent) && \result < SITES;
    ensures \old(rising(parent, SITES)) ==> rising(parent, SITES) && \result <= v; */
static inline uint32_t dyd_cert_root(uint32_t *parent, uint32_t v);

/*@ requires (0 < count ==> \valid(item + (0 .. count - 1))) && count < 1152921504606846976 &&
      below(item, count, BOUND);
    assigns item[0 .. count - 1]; exits \false; ensures below(item, count, BOUND); */
void dyd_cert_sort(uint32_t *item, size_t count, dyd_cert_compare *compare, const void *with);
/*@ requires \valid_read((const dyd_cert_edge *)a) && \valid_read((const dyd_cert_edge *)b);
    assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
int dyd_cert_compare_edges(const void *a, const void *b);
/*@ requires pairs(edges, 4294967295); assigns \nothing; exits \false; */
bool dyd_cert_edges_have(const dyd_cert_edges *edges, uint32_t i, uint32_t j);
/*@ requires \valid(edges) && edges->count <= edges->cap <= 1152921504606846976 &&
      (0 < edges->cap ==> \valid(edges->item + (0 .. edges->cap - 1)) &&
        \separated(edges->item + (0 .. edges->cap - 1), edges));
    exits \false;
    ensures \result == DYD_OK ==> edges->count == \old(edges->count) + 1 <= edges->cap &&
      edges->count <= 1073741823 &&
      edges->item[edges->count - 1].i == i && edges->item[edges->count - 1].j == j; */
dyd_status dyd_cert_edges_add(dyd_cert_edges *edges, uint32_t i, uint32_t j);
/*@ requires \valid_read(s) && a < s->count && b < s->count; assigns \nothing; exits \false;
    ensures -1 <= \result <= 1; */
int dyd_cert_compare_places(const dyd_cert_sites *s, uint32_t a, uint32_t b);
/*@ requires \valid_read(s) && a < s->count && b < s->count && c < s->count; assigns \nothing; exits \false;
    ensures -1 <= \result <= 1; */
int dyd_cert_turn(const dyd_cert_sites *s, uint32_t a, uint32_t b, uint32_t c);
/*@ requires \valid(g); assigns *g; exits \false; */
void dyd_cert_graph_clear(dyd_cert_graph *g);
/*@ requires drawn(g) && h < 2 * g->count; assigns \nothing; exits \false; ensures \result < 2 * g->count; */
uint32_t dyd_cert_follow(const dyd_cert_graph *g, uint32_t h);
/*@ requires drawn(g); assigns \nothing; exits \false;
    ensures \result == DYD_CERT_NONE || \result < 2 * g->count; */
uint32_t dyd_cert_outer(const dyd_cert_graph *g);
/*@ requires \valid(g) && \valid_read(s) && s->count == SITES && pairs(legal, SITES) && pairs(bridges, SITES) &&
      (0 < SITES ==> \valid_read(s->site + (0 .. SITES - 1))) && \separated(g, s, legal, bridges,
      s->site + (0 .. SITES - 1), legal->item + (0 .. legal->count - 1), bridges->item + (0 .. bridges->count - 1));
    exits \false; */
dyd_status dyd_cert_graph_init(dyd_cert_graph *g, const dyd_cert_sites *s, const dyd_cert_edges *legal,
                               const dyd_cert_edges *bridges);

#endif
