/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The plane graph of the legal edges and its faces.
 *
 * Legal edges are strictly Delaunay for every choice, so for every choice the segments between the points do not cross
 * and hold no third point: the graph is plane, and moves by isotopy when the points move. One choice, the places,
 * shows its faces. Where it is not connected, bridges (strictly Delaunay edges of the places) connect it without
 * cutting a face in two; then every face is one closed walk [CERT-2]. */
#ifndef DYD_CHECKER_GRAPH_H
#define DYD_CHECKER_GRAPH_H

#include "checker/sites.h"

/* Invariant: i < j. */
typedef struct dyd_cert_edge {
  uint32_t i, j;
} dyd_cert_edge;

typedef struct dyd_cert_edges {
  dyd_cert_edge *item;
  size_t count, cap;
} dyd_cert_edges;

/* Half-edge 2 e goes from i to j of edge e, 2 e + 1 back; legal edges come first, then the bridges. */
typedef struct dyd_cert_graph {
  const dyd_cert_sites *sites;           /* borrowed */
  const dyd_cert_edges *legal, *bridges; /* borrowed */
  size_t count;                          /* of both */
  size_t *start;                         /* of each site's half-edges in around[] */
  uint32_t *around;                      /* half-edges by origin, counter-clockwise */
  uint32_t *position;                    /* half-edge -> its place in around[] */
  bool connected;                        /* all sites but aliases are, and joined sites have different places */
  bool redundant;                        /* a bridge joins what is joined already: it could cut a face in two */
} dyd_cert_graph;

/* Legal edges and bridges are sorted and borrowed. */
dyd_status dyd_cert_graph_init(dyd_cert_graph *g, const dyd_cert_sites *s, const dyd_cert_edges *legal,
                               const dyd_cert_edges *bridges);
void dyd_cert_graph_clear(dyd_cert_graph *g);

static inline dyd_cert_edge dyd_cert_edge_of(const dyd_cert_graph *g, uint32_t h) {
  size_t e = h / 2;
  return e < g->legal->count ? g->legal->item[e] : g->bridges->item[e - g->legal->count];
}
static inline bool dyd_cert_is_legal(const dyd_cert_graph *g, uint32_t h) {
  return h / 2 < g->legal->count;
}
static inline uint32_t dyd_cert_origin(const dyd_cert_graph *g, uint32_t h) {
  dyd_cert_edge e = dyd_cert_edge_of(g, h);
  return h & 1 ? e.j : e.i;
}
/* The next half-edge with the same face on its left. */
uint32_t dyd_cert_follow(const dyd_cert_graph *g, uint32_t h);
/* A half-edge with the unbounded face on its left; DYD_CERT_NONE when there is no edge. */
uint32_t dyd_cert_outer(const dyd_cert_graph *g);

/* The representative of v among the united, with the way there shortened. */
static inline uint32_t dyd_cert_root(uint32_t *parent, uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

/* Sorts in place, without memory, ascending by `compare`. */
typedef int dyd_cert_compare(const void *with, uint32_t a, uint32_t b);
void dyd_cert_sort(uint32_t *item, size_t count, dyd_cert_compare *compare, const void *with);

/* Of two dyd_cert_edge, for qsort: by i, then by j. */
int dyd_cert_compare_edges(const void *a, const void *b);
/* Is the sorted list holding the pair i < j? */
bool dyd_cert_edges_have(const dyd_cert_edges *edges, uint32_t i, uint32_t j);
dyd_status dyd_cert_edges_add(dyd_cert_edges *edges, uint32_t i, uint32_t j);

#endif
