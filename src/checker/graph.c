/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The plane graph of the legal edges: half-edges in angular order around the places of the sites. */
#include "checker/graph.h"
#include "base/alloc.h"
#include "checker/by_key.h"

/* ---- lists ---- */

static void sift_down(uint32_t *a, size_t root, size_t count, dyd_cert_compare *compare, const void *with) {
  for (size_t child; (child = 2 * root + 1) < count; root = child) {
    if (child + 1 < count && compare(with, a[child], a[child + 1]) < 0) child++;
    if (compare(with, a[root], a[child]) >= 0) return;
    uint32_t t = a[root];
    a[root] = a[child];
    a[child] = t;
  }
}

void dyd_cert_sort(uint32_t *item, size_t count, dyd_cert_compare *compare, const void *with) {
  for (size_t q = count / 2; q-- > 0;) sift_down(item, q, count, compare, with);
  for (size_t last = count; last-- > 1;) {
    uint32_t t = item[0];
    item[0] = item[last];
    item[last] = t;
    sift_down(item, 0, last, compare, with);
  }
}

/* ---- edges ---- */

int dyd_cert_compare_edges(const void *a, const void *b) {
  const dyd_cert_edge *x = a, *y = b;
  if (x->i != y->i) return x->i < y->i ? -1 : 1;
  return (x->j > y->j) - (x->j < y->j);
}

bool dyd_cert_edges_have(const dyd_cert_edges *edges, uint32_t i, uint32_t j) {
  dyd_cert_edge key = {i, j};
  return edges->count && bsearch(&key, edges->item, edges->count, sizeof key, dyd_cert_compare_edges);
}

dyd_status dyd_cert_edges_add(dyd_cert_edges *edges, uint32_t i, uint32_t j) {
  if (edges->count >= UINT32_MAX / 4 ||
      !dyd_reserve((void **)&edges->item, &edges->cap, edges->count + 1, sizeof *edges->item))
    return DYD_E_NOMEM;
  edges->item[edges->count++] = (dyd_cert_edge){i, j};
  return DYD_OK;
}

/* ---- angular order ---- */

/* The half-plane of directions from a to b: 0 for angles in (-90, 90] degrees, 1 for the others. */
static int half_of_directions(const dyd_cert_sites *s, uint32_t a, uint32_t b) {
  return dyd_cert_compare_places(s, a, b) < 0 ? 0 : 1;
}

/* Compares the directions of two half-edges of one origin. */
static int compare_angle(const void *graph, uint32_t h, uint32_t k) {
  const dyd_cert_graph *g = graph;
  uint32_t v = dyd_cert_origin(g, h), a = dyd_cert_origin(g, h ^ 1), b = dyd_cert_origin(g, k ^ 1);
  int ha = half_of_directions(g->sites, v, a), hb = half_of_directions(g->sites, v, b);
  if (ha != hb) return ha - hb;
  return -dyd_cert_turn(g->sites, v, a, b);
}

static dyd_status gather_around(dyd_cert_graph *g) {
  size_t n = g->sites->count;
  dyd_cert_entry *entry = dyd_alloc(2 * g->count, sizeof *entry);
  if (!entry) return DYD_E_NOMEM;
  for (uint32_t h = 0; h < 2 * g->count; h++) entry[h] = (dyd_cert_entry){dyd_cert_origin(g, h), h};
  dyd_cert_by_key(g->start, g->around, n, entry, 2 * g->count);
  free(entry);
  for (size_t v = 0; v < n; v++)
    dyd_cert_sort(g->around + g->start[v], g->start[v + 1] - g->start[v], compare_angle, g);
  for (size_t q = 0; q < 2 * g->count; q++) g->position[g->around[q]] = (uint32_t)q;
  return DYD_OK;
}

/* ---- connection ---- */

/* An edge between two sites with one place has no direction: then the faces are not known. */
static bool have_directions(const dyd_cert_graph *g) {
  for (size_t e = 0; e < g->count; e++) {
    dyd_cert_edge edge = dyd_cert_edge_of(g, (uint32_t)(2 * e));
    if (dyd_cert_compare_places(g->sites, edge.i, edge.j) == 0) return false;
  }
  return true;
}

static dyd_status find_connected(dyd_cert_graph *g) {
  size_t n = g->sites->count, parts = 0;
  uint32_t *parent = dyd_alloc(n, sizeof *parent);
  if (!parent) return DYD_E_NOMEM;
  for (size_t v = 0; v < n; v++) {
    parent[v] = (uint32_t)v;
    parts += g->sites->site[v].alias == v;
  }
  for (size_t e = 0; e < g->count; e++) {
    dyd_cert_edge edge = dyd_cert_edge_of(g, (uint32_t)(2 * e));
    uint32_t a = dyd_cert_root(parent, edge.i), b = dyd_cert_root(parent, edge.j);
    g->redundant |= a == b && e >= g->legal->count;
    parts -= a != b;
    parent[a] = b;
  }
  g->connected = parts <= 1 && have_directions(g);
  free(parent);
  return DYD_OK;
}

dyd_status dyd_cert_graph_init(dyd_cert_graph *g, const dyd_cert_sites *s, const dyd_cert_edges *legal,
                               const dyd_cert_edges *bridges) {
  *g = (dyd_cert_graph){.sites = s, .legal = legal, .bridges = bridges, .count = legal->count + bridges->count};
  if (g->count >= UINT32_MAX / 4) return DYD_E_NOMEM;
  g->start = dyd_alloc(s->count + 1, sizeof *g->start);
  g->around = dyd_alloc(2 * g->count, sizeof *g->around);
  g->position = dyd_alloc(2 * g->count, sizeof *g->position);
  dyd_status st = g->start && g->around && g->position ? find_connected(g) : DYD_E_NOMEM;
  if (st == DYD_OK) st = gather_around(g);
  if (st != DYD_OK) dyd_cert_graph_clear(g);
  return st;
}

void dyd_cert_graph_clear(dyd_cert_graph *g) {
  free(g->start);
  free(g->around);
  free(g->position);
  *g = (dyd_cert_graph){0};
}

/* ---- faces ---- */

/* The face left of u -> v goes on along the edge that is next clockwise after v -> u. */
uint32_t dyd_cert_follow(const dyd_cert_graph *g, uint32_t h) {
  uint32_t back = h ^ 1, v = dyd_cert_origin(g, back);
  size_t at = g->position[back];
  return g->around[at == g->start[v] ? g->start[v + 1] - 1 : at - 1];
}

/* All edges of the lowest place (by x, then y) have angles in (-90, 90]: the wedge left of the last one is outside. */
uint32_t dyd_cert_outer(const dyd_cert_graph *g) {
  uint32_t low = DYD_CERT_NONE;
  for (size_t v = 0; v < g->sites->count; v++)
    if (g->start[v] < g->start[v + 1] &&
        (low == DYD_CERT_NONE || dyd_cert_compare_places(g->sites, (uint32_t)v, low) < 0))
      low = (uint32_t)v;
  return low == DYD_CERT_NONE ? DYD_CERT_NONE : g->around[g->start[low + 1] - 1];
}
