/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From sites to statuses: skeleton, certain edges, undecided faces. */
#include "delaunay/build.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/invariant.h"
#include "base/parallel.h"
#include "delaunay/faces.h"
#include "delaunay/line.h"
#include "legal/certify.h"
#include "skeleton/blocks.h"
#include "skeleton/mesh_invariant.h"
#include "skeleton/order.h"

#include <string.h>

void dyd_build_clear(dyd_delaunay *pd) {
  dyd_faces_clear(&pd->faces);
  dyd_line_clear(&pd->line);
  dyd_tree_clear(&pd->tree);
  dyd_blocks_clear(pd);
  dyd_mesh_clear(&pd->mesh);
  dyd_reps_clear(&pd->reps);
  free(pd->box);
  free(pd->certain);
  free(pd->corner);
  free(pd->vertex);
  pd->box = NULL;
  pd->certain = NULL;
  pd->corner = pd->vertex = NULL;
}

static dyd_status build_skeleton(dyd_delaunay *pd) {
  uint32_t *order = dyd_alloc(pd->n, sizeof *order);
  if (!order) return DYD_E_NOMEM;
  dyd_strips strips;
  dyd_status st = dyd_spatial_order(order, &strips, pd->sites, pd->options.threads);
  if (st != DYD_OK) {
    free(order);
    return st;
  }
  st = dyd_reps_init(&pd->reps, pd->sites, order, pd->n, pd->options.threads);
  if (st == DYD_OK)
    st = dyd_mesh_build_strips(&pd->mesh, &pd->reps, &strips, pd->options.no_filter, &pd->counters, pd->options.cancel,
                               pd->options.threads);
  return st;
}

/* A vertex stands for the lowest of its equal sites: site numbers of a vertex and its aliases are exchanged. */
static void settle_aliases(dyd_delaunay *pd) {
  uint32_t *site = pd->reps.site, *alias = pd->mesh.alias;
  if (alias)
    for (uint32_t v = 0; v < pd->n; v++) {
      uint32_t a = alias[v];
      if (a == DYD_NONE || site[v] > site[a]) continue;
      uint32_t t = site[v];
      site[v] = site[a];
      site[a] = t;
    }
  for (uint32_t v = 0; v < pd->n; v++) pd->vertex[site[v]] = alias && alias[v] != DYD_NONE ? alias[v] : v;
}

/* The corner of a vertex is the last one among the triangles of its strip. */
static void corners_of_strip(void *context, size_t number) {
  dyd_delaunay *pd = context;
  uint32_t begin = pd->mesh.strips.begin[number], end = pd->mesh.strips.begin[number + 1];
  uint32_t last = 2 * end < pd->mesh.count ? 2 * end : pd->mesh.count;
  for (uint32_t t = 2 * begin; t < last; t++)
    for (unsigned k = 0; k < 3; k++) {
      uint32_t v = pd->mesh.tri[t].v[k];
      if (v - begin < end - begin) pd->corner[v] = 4 * t + k;
    }
}

/* A vertex at a seam may have triangles of the other strip only. */
static bool has_lost_vertex(const dyd_delaunay *pd) {
  for (uint32_t v = 0; v < pd->n; v++)
    if (pd->corner[v] == DYD_NONE && !(pd->mesh.alias && pd->mesh.alias[v] != DYD_NONE)) return pd->mesh.count > 0;
  return false;
}

static void find_corners(dyd_delaunay *pd) {
  memset(pd->corner, 0xff, pd->n * sizeof *pd->corner);
  dyd_parallel(pd->options.threads, pd->mesh.strips.count, corners_of_strip, pd);
  if (has_lost_vertex(pd))
    for (uint32_t t = 0; t < pd->mesh.count; t++)
      for (unsigned k = 0; k < 3; k++) {
        uint32_t v = pd->mesh.tri[t].v[k];
        if (v != pd->mesh.n && pd->corner[v] == DYD_NONE) pd->corner[v] = 4 * t + k;
      }
}

static dyd_status build_maps(dyd_delaunay *pd) {
  pd->vertex = dyd_alloc(pd->n, sizeof *pd->vertex);
  pd->corner = dyd_alloc(pd->n, sizeof *pd->corner);
  pd->certain = calloc(pd->mesh.count ? pd->mesh.count : 1, 1);
  if (!pd->vertex || !pd->corner || !pd->certain) return DYD_E_NOMEM;
  settle_aliases(pd);
  find_corners(pd);
  pd->all_points = true;
  for (uint32_t i = 0; i < pd->n && pd->all_points; i++) pd->all_points = dyd_sites_is_point(pd->sites, i);
  return DYD_OK;
}

enum { FETCH_AHEAD = 24 };

static void boxes_of_range(void *context, size_t number) {
  dyd_delaunay *pd = context;
  size_t end = dyd_range_begin(pd->n, number + 1);
  for (size_t v = dyd_range_begin(pd->n, number); v < end; v++) {
    if (v + FETCH_AHEAD < end) dyd_sites_fetch(pd->sites, pd->reps.site[v + FETCH_AHEAD]);
    dyd_sites_get_d(pd->box[v].e, pd->sites, pd->reps.site[v]);
  }
}

static dyd_status build_boxes(dyd_delaunay *pd) {
  if (pd->all_points || pd->mesh.collinear) return dyd_blocks_build(pd);
  pd->box = dyd_alloc(pd->n, sizeof *pd->box);
  uint32_t *item = dyd_alloc(pd->n, sizeof *item), count = 0;
  if (!pd->box || !item) return free(item), DYD_E_NOMEM;
  dyd_parallel(pd->options.threads, dyd_ranges(pd->n), boxes_of_range, pd);
  for (uint32_t v = 0; v < pd->n; v++)
    if (pd->corner[v] != DYD_NONE) item[count++] = v;
  return dyd_tree_init(&pd->tree, item, count, pd->box);
}

/* Some ghost triangle: that of the last seam if it is still one, or any. */
static uint32_t ghost_triangle(const dyd_mesh *m) {
  if (dyd_mesh_is_ghost(m, m->hint)) return m->hint;
  for (uint32_t t = 0; t < m->count; t++)
    if (dyd_mesh_is_ghost(m, t)) return t;
  return DYD_NONE;
}

/* Bits of certain[] are halves of edges; edges to the ghost are told apart by a walk around the hull. */
uint64_t dyd_certain_edges(const dyd_delaunay *pd) {
  const dyd_mesh *m = &pd->mesh;
  uint64_t halves = 0, ghosts = 0;
  if (m->count == 0) return 0;
  for (uint32_t t = 0; t < m->count; t++) halves += 0x32212110u >> 4 * (pd->certain[t] & 7) & 7;
  uint32_t first = ghost_triangle(m), t = first;
  do {
    unsigned g = dyd_mesh_ghost_corner(m, t);
    ghosts += dyd_edge_is_certain(pd, t, dyd_prev(g));
    t = m->tri[t].n[dyd_prev(g)] >> 2;
  } while (t != first);
  return halves / 2 - ghosts;
}

uint32_t dyd_find_edge(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  uint32_t first = pd->corner[v], h = first;
  if (first == DYD_NONE) return DYD_NONE;
  do {
    if (pd->mesh.tri[h >> 2].v[dyd_next(h & 3)] == w) return h;
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
  return DYD_NONE;
}

bool dyd_is_legal(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  uint32_t h = dyd_find_edge(pd, v, w);
  return h != DYD_NONE && dyd_edge_is_certain(pd, h >> 2, dyd_prev(h & 3));
}

static void mark_known(dyd_delaunay *pd, dyd_known known) {
  for (size_t q = 0; q < known.count; q++) {
    uint32_t v = pd->vertex[known.pair[q].i], w = pd->vertex[known.pair[q].j];
    uint32_t h = v == w ? DYD_NONE : dyd_find_edge(pd, v, w);
    if (h != DYD_NONE) dyd_set_certain(pd, h >> 2, dyd_prev(h & 3));
  }
}

static dyd_status build_statuses(dyd_delaunay *pd, dyd_known known) {
  dyd_work w;
  dyd_work_init(&w, pd);
  dyd_status st = dyd_certify_all(pd);
  mark_known(pd, known);
  if (st == DYD_OK) st = dyd_faces_find(pd, &w, NULL, 0);
  dyd_work_clear(&w);
  return st;
}

static dyd_status build_line(dyd_delaunay *pd) {
  dyd_status st = dyd_line_build(pd);
  if (st == DYD_OK && dyd_line_open_pairs(&pd->line) > pd->max_pairs) {
    pd->line.capped = true;
    dyd_fail(
        pd->err, DYD_CAPPED,
        "%zu collinear sites (%u, %u, ...) have %zu possible pairs, more than the cap of %zu; raise the cap on pairs",
        (size_t)pd->line.count, pd->reps.site[pd->line.order[0]], pd->reps.site[pd->line.order[1]],
        dyd_line_open_pairs(&pd->line), pd->max_pairs);
  }
  return st;
}

dyd_status dyd_build(dyd_delaunay *pd, dyd_known known) {
  dyd_status st = build_skeleton(pd);
  if (st == DYD_OK && pd->mesh.collinear) st = build_line(pd);
  if (st == DYD_OK) st = build_maps(pd);
  if (st == DYD_OK) st = build_boxes(pd);
  if (st == DYD_OK) DYD_INVARIANT(dyd_mesh_check(&pd->mesh));
  if (st == DYD_OK) st = pd->mesh.collinear ? DYD_OK : build_statuses(pd, known);
  if (st != DYD_OK)
    dyd_build_clear(pd);
  else
    dyd_mesh_trim(&pd->mesh);
  return st;
}
