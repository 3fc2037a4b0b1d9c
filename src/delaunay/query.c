/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading the statuses: pairs, neighbours, triangles, faces, hull. */
#include "base/abi.h"
#include "base/alloc.h"
#include "delaunay/build.h"
#include "delaunay/faces.h"
#include "delaunay/line.h"
#include "delaunay/visit.h"
#include "legal/certify.h"
#include "legal/witness.h"

#include <math.h>
#include <string.h>

void dyd_pair_list_clear(dyd_pair_list *l) {
  free(l->item);
  *l = (dyd_pair_list){0};
}

void dyd_triangle_list_clear(dyd_triangle_list *l) {
  free(l->item);
  *l = (dyd_triangle_list){0};
}

void dyd_index_list_clear(dyd_index_list *l) {
  free(l->item);
  *l = (dyd_index_list){0};
}

const dyd_sites *dyd_delaunay_sites(const dyd_delaunay *pd) {
  return pd->sites;
}

dyd_status dyd_delaunay_get_counters(dyd_delaunay_counters *out, const dyd_delaunay *pd, dyd_error *err) {
  dyd_status st = dyd_abi_check(out, 0, "dyd_delaunay_counters", err);
  if (st == DYD_OK) dyd_abi_give(out, &pd->counters, sizeof pd->counters);
  return st;
}

size_t dyd_delaunay_undecided_faces(const dyd_delaunay *pd) {
  if (pd->mesh.collinear) return dyd_line_open_pairs(&pd->line) ? 1 : 0;
  return pd->faces.count;
}

size_t dyd_delaunay_memory(const dyd_delaunay *pd) {
  size_t n = pd->n, t = pd->mesh.collinear ? 0 : 2 * n + 2, bytes = sizeof *pd;
  bytes += n * (3 * sizeof(uint32_t) + sizeof(dyd_xy)) + t * sizeof(dyd_tri) + pd->mesh.count;
  if (pd->reps.code) bytes += n * sizeof(uint32_t);
  if (pd->box) bytes += n * sizeof(dyd_bbox) + pd->tree.count * sizeof(uint32_t);
  bytes +=
      (pd->tree.level[pd->tree.levels] + pd->blocks.level[pd->blocks.levels] + pd->blocks.count) * sizeof(dyd_bbox);
  bytes += pd->faces.face_cap * sizeof(dyd_face) + (pd->faces.tri_cap + pd->faces.seed_cap) * sizeof(uint32_t);
  bytes += pd->faces.pair_cap * sizeof(dyd_vertex_pair) + (pd->faces.of ? pd->mesh.count * sizeof(uint32_t) : 0);
  return bytes;
}

uint32_t dyd_delaunay_alias(const dyd_delaunay *pd, uint32_t i) {
  return pd->reps.site[pd->vertex[i]];
}

/* ---- one pair ---- */

/* Is the directed edge at corner h (from the corner's vertex to the next one) certain? */
static bool corner_edge_is_certain(const dyd_delaunay *pd, uint32_t h) {
  return dyd_edge_is_certain(pd, h >> 2, dyd_prev(h & 3));
}

/* Visits the faces around v; a pair of v lies in one of them. */
static dyd_pair_status status_in_faces(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  uint32_t first = pd->corner[v], h = first;
  do {
    uint32_t f = pd->faces.of ? pd->faces.of[h >> 2] : DYD_NONE;
    if (f != DYD_NONE) {
      dyd_pair_status s = dyd_face_status(pd, &pd->faces.face[f], v < w ? v : w, v < w ? w : v);
      if (s != DYD_ILLEGAL) return s;
    }
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
  return DYD_ILLEGAL;
}

/* Do v and w share a face that met the cap? */
static bool share_capped_face(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  uint32_t first = pd->corner[v], h = first;
  do {
    uint32_t f = pd->faces.of ? pd->faces.of[h >> 2] : DYD_NONE, g = w == DYD_NONE ? h : pd->corner[w], start = g;
    if (f != DYD_NONE && pd->faces.face[f].capped) do {
        if (pd->faces.of[g >> 2] == f) return true;
        g = dyd_turn(&pd->mesh, g);
      } while (g != start);
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
  return false;
}

static dyd_pair_status vertex_status(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  if (pd->mesh.collinear) return dyd_line_status(&pd->line, v, w);
  uint32_t h = dyd_find_edge(pd, v, w);
  if (h != DYD_NONE && corner_edge_is_certain(pd, h)) return DYD_LEGAL;
  if (pd->all_points) return dyd_tie_status(pd, v, w);
  dyd_pair_status s = status_in_faces(pd, v, w);
  if (s == DYD_ILLEGAL && share_capped_face(pd, v, w)) s = DYD_INDETERMINATE;
  return s;
}

dyd_pair_status dyd_delaunay_status(const dyd_delaunay *pd, uint32_t i, uint32_t j) {
  if (i >= pd->n || j >= pd->n) return DYD_ILLEGAL;
  uint32_t v = pd->vertex[i], w = pd->vertex[j];
  return v == w ? DYD_ILLEGAL : vertex_status(pd, v, w);
}

/* ---- counts ---- */

void dyd_delaunay_count(size_t count[4], const dyd_delaunay *pd) {
  memset(count, 0, 4 * sizeof *count);
  if (pd->mesh.collinear) {
    count[DYD_LEGAL] = dyd_line_legal_pairs(&pd->line);
    if (!pd->line.capped) count[pd->line.all_points ? DYD_TIE : DYD_INDETERMINATE] = dyd_line_open_pairs(&pd->line);
    return;
  }
  count[DYD_LEGAL] = dyd_certain_edges(pd);
  count[DYD_INDETERMINATE] = pd->faces.capped_pairs;
  if (pd->all_points) count[DYD_TIE] = pd->faces.live_pairs - pd->faces.capped_pairs;
  for (size_t f = 0; f < pd->faces.count && !pd->all_points; f++)
    count[dyd_face_open_status(&pd->faces.face[f])] += pd->faces.face[f].pairs - pd->faces.face[f].hidden;
}

/* ---- index lists ---- */

typedef struct collector {
  uint32_t *item;
  size_t count, cap;
  dyd_status status;
} collector;

static void collect(collector *c, uint32_t i) {
  if (c->status != DYD_OK) return;
  if (!dyd_reserve((void **)&c->item, &c->cap, c->count + 1, sizeof *c->item))
    c->status = DYD_E_NOMEM;
  else
    c->item[c->count++] = i;
}

/* Sorts, drops repeats, and hands over. */
static dyd_status deliver(dyd_index_list *out, collector *c, bool sort) {
  if (c->status != DYD_OK) {
    free(c->item);
    return c->status;
  }
  size_t kept = 0;
  if (sort && c->count) qsort(c->item, c->count, sizeof *c->item, dyd_compare_index);
  for (size_t q = 0; q < c->count; q++)
    if (!sort || kept == 0 || c->item[kept - 1] != c->item[q]) c->item[kept++] = c->item[q];
  dyd_index_list_clear(out);
  *out = (dyd_index_list){kept, c->item};
  return DYD_OK;
}

/* For visits: those with at least the status asked for. */
typedef struct neighbour_filter {
  collector list;
  const uint32_t *site;
  dyd_pair_status least;
} neighbour_filter;

static void collect_neighbour(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  neighbour_filter *f = context;
  (void)v;
  if (status >= f->least) collect(&f->list, f->site[w]);
}

static void face_neighbours(neighbour_filter *c, const dyd_delaunay *pd, uint32_t v, uint32_t f) {
  const dyd_face *face = &pd->faces.face[f];
  if (dyd_face_open_status(face) < c->least) return;
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair p = pd->faces.pair[face->first_pair + q];
    if (p.hidden) continue;
    if (p.i == v) collect(&c->list, pd->reps.site[p.j]);
    if (p.j == v) collect(&c->list, pd->reps.site[p.i]);
  }
}

/* Neighbours of v by ties of the face on the left of the rim's corner h. */
static void tied_neighbours(neighbour_filter *c, const dyd_delaunay *pd, uint32_t h, uint32_t f) {
  const dyd_mesh *m = &pd->mesh;
  uint32_t v = dyd_tie_vertex(m, h);
  if (!dyd_tie_is_capped(pd, f)) {
    dyd_each_tie_of(pd, h, h, collect_neighbour, c);
    return;
  }
  for (; !dyd_edge_is_certain(pd, h >> 2, dyd_next(h & 3)); h = dyd_turn(m, h)) {
    uint32_t w = m->tri[h >> 2].v[dyd_prev(h & 3)];
    if (w != m->n) collect_neighbour(c, v, w, DYD_INDETERMINATE);
  }
}

/* Neighbours by legal edges and through the faces around v. */
static void neighbours_around(neighbour_filter *c, const dyd_delaunay *pd, uint32_t v) {
  uint32_t first = pd->corner[v], h = first, before = DYD_NONE;
  do {
    uint32_t w = pd->mesh.tri[h >> 2].v[dyd_next(h & 3)], f = pd->faces.of ? pd->faces.of[h >> 2] : DYD_NONE;
    bool certain = corner_edge_is_certain(pd, h);
    if (w != pd->mesh.n && certain) collect_neighbour(c, v, w, DYD_LEGAL);
    if (f != DYD_NONE && pd->all_points && certain) tied_neighbours(c, pd, h, f);
    if (f != DYD_NONE && !pd->all_points && f != before) face_neighbours(c, pd, v, f);
    before = f;
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
}

dyd_status dyd_delaunay_neighbours(dyd_index_list *out, const dyd_delaunay *pd, uint32_t i, dyd_pair_status least) {
  neighbour_filter c = {.site = pd->reps.site, .least = least};
  if (i >= pd->n) return DYD_E_ARG;
  uint32_t v = pd->vertex[i];
  if (pd->mesh.collinear) {
    for (uint32_t q = 0; q < pd->line.count; q++) {
      uint32_t w = pd->line.order[q];
      if (w != v) collect_neighbour(&c, v, w, dyd_line_status(&pd->line, v, w));
    }
  } else {
    neighbours_around(&c, pd, v);
  }
  return deliver(out, &c.list, true);
}

dyd_status dyd_delaunay_face(dyd_index_list *out, bool *outer, const dyd_delaunay *pd, size_t f) {
  collector c = {0};
  if (f >= dyd_delaunay_undecided_faces(pd)) return DYD_E_ARG;
  if (pd->mesh.collinear) {
    for (uint32_t q = 0; q < pd->line.count; q++) collect(&c, pd->reps.site[pd->line.order[q]]);
    *outer = true;
    return deliver(out, &c, true);
  }
  uint32_t *v;
  size_t count;
  dyd_status st = dyd_face_vertices(&v, &count, pd, f);
  if (st != DYD_OK) return st;
  for (size_t q = 0; q < count; q++) collect(&c, pd->reps.site[v[q]]);
  free(v);
  *outer = dyd_face_is_outer(pd, f);
  return deliver(out, &c, true);
}

static int compare_pair(const void *a, const void *b) {
  const dyd_pair *x = a, *y = b;
  if (x->i != y->i) return x->i < y->i ? -1 : 1;
  return (x->j > y->j) - (x->j < y->j);
}

/* For visits: a list of pairs that are not legal. */
typedef struct pair_collector {
  const uint32_t *site;
  dyd_pair *item;
  size_t count, cap;
  dyd_status status;
} pair_collector;

static void collect_pair(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  pair_collector *c = context;
  uint32_t i = c->site[v], j = c->site[w];
  if (status == DYD_LEGAL || c->status != DYD_OK) return;
  if (!dyd_reserve((void **)&c->item, &c->cap, c->count + 1, sizeof *c->item))
    c->status = DYD_E_NOMEM;
  else
    c->item[c->count++] = (dyd_pair){i < j ? i : j, i < j ? j : i, status};
}

/* The edges of the skeleton inside a capped face that lists none, from one vertex of the rim after the other. */
static void capped_face_pairs(pair_collector *c, const dyd_delaunay *pd, size_t f) {
  const dyd_mesh *m = &pd->mesh;
  uint32_t first = dyd_tie_start(pd, f), h = first;
  do {
    uint32_t v = dyd_tie_vertex(m, h), g = h;
    for (; v != m->n && !dyd_edge_is_certain(pd, g >> 2, dyd_next(g & 3)); g = dyd_turn(m, g)) {
      uint32_t w = m->tri[g >> 2].v[dyd_prev(g & 3)];
      if (w != m->n && v < w) collect_pair(c, v, w, DYD_INDETERMINATE);
    }
    h = dyd_tie_next(pd, h);
  } while (h != first);
}

dyd_status dyd_delaunay_face_pairs(dyd_pair_list *out, const dyd_delaunay *pd, size_t f) {
  pair_collector c = {.site = pd->reps.site};
  if (f >= dyd_delaunay_undecided_faces(pd)) return DYD_E_ARG;
  if (pd->mesh.collinear)
    dyd_each_line_pair(pd, collect_pair, &c);
  else if (!pd->all_points)
    dyd_each_listed_pair(pd, f, collect_pair, &c);
  else if (dyd_tie_is_capped(pd, f))
    capped_face_pairs(&c, pd, f);
  else
    dyd_each_tie(pd, f, collect_pair, &c);
  if (c.status != DYD_OK) {
    free(c.item);
    return c.status;
  }
  if (c.count) qsort(c.item, c.count, sizeof *c.item, compare_pair);
  dyd_pair_list_clear(out);
  *out = (dyd_pair_list){c.count, c.item};
  return DYD_OK;
}
