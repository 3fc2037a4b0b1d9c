/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading the statuses: pairs, neighbours, triangles, faces, hull. */
#include "base/abi.h"
#include "base/alloc.h"
#include "delaunay/index_list.h"
#include "delaunay/undecided.h"

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
  if (!pd) return NULL;
  return pd->sk.rects.sites;
}

dyd_status dyd_delaunay_get_counters(dyd_delaunay_counters *out, const dyd_delaunay *pd, dyd_error *err) {
  dyd_status st = dyd_abi_check(out, 0, "dyd_delaunay_counters", err);
  if (st == DYD_OK) dyd_abi_give(out, &pd->counters, sizeof pd->counters);
  return st;
}

size_t dyd_delaunay_undecided_faces(const dyd_delaunay *pd) {
  if (!pd) return 0;
  return pd->open.count;
}

size_t dyd_delaunay_memory(const dyd_delaunay *pd) {
  if (!pd) return 0;
  const dyd_undecided *f = &pd->open;
  size_t bytes = sizeof *pd + dyd_skeleton_memory(&pd->sk);
  bytes += f->face_cap * sizeof *f->face + (f->tri_cap + f->seed_cap) * sizeof *f->tri;
  return bytes + f->pair_cap * sizeof *f->pair + f->turned_cap * sizeof *f->turned +
         (f->of ? pd->sk.mesh.count * sizeof *f->of : 0);
}

uint32_t dyd_delaunay_alias(const dyd_delaunay *pd, uint32_t i) {
  if (!pd) return 0;
  return pd->sk.mesh.alias ? pd->sk.reps.site[pd->sk.vertex[i]] : i;
}

dyd_pair_status dyd_delaunay_status(const dyd_delaunay *pd, uint32_t i, uint32_t j) {
  if (!pd) return DYD_INDETERMINATE;
  if (i >= pd->sk.n || j >= pd->sk.n) return DYD_ILLEGAL;
  uint32_t v = pd->sk.vertex[i], w = pd->sk.vertex[j];
  if (v == w) return DYD_ILLEGAL;
  return dyd_pair_is_legal(pd, v, w) ? DYD_LEGAL : dyd_open_status(pd, v, w);
}

void dyd_delaunay_count(size_t count[4], const dyd_delaunay *pd) {
  if (!pd) return;
  memset(count, 0, 4 * sizeof *count);
  count[DYD_LEGAL] = dyd_legal_count(pd);
  dyd_open_count(count, pd);
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
static dyd_status deliver(dyd_index_list *out, collector *c) {
  if (c->status != DYD_OK) {
    free(c->item);
    return c->status;
  }
  dyd_index_list_clear(out);
  *out = (dyd_index_list){c->count, c->item};
  dyd_index_list_sort(out);
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

dyd_status dyd_delaunay_neighbours(dyd_index_list *out, const dyd_delaunay *pd, uint32_t i, dyd_pair_status least) {
  if (!pd) return DYD_E_ARG;
  neighbour_filter c = {.site = pd->sk.reps.site, .least = least};
  if (i >= pd->sk.n) return DYD_E_ARG;
  dyd_legal_each_at(pd, pd->sk.vertex[i], collect_neighbour, &c);
  if (least < DYD_LEGAL) dyd_open_each_at(pd, pd->sk.vertex[i], least, collect_neighbour, &c);
  return deliver(out, &c.list);
}

dyd_status dyd_delaunay_face(dyd_index_list *out, bool *outer, const dyd_delaunay *pd, size_t f) {
  if (!pd) return DYD_E_ARG;
  collector c = {0};
  uint32_t *v;
  size_t count;
  if (f >= pd->open.count) return DYD_E_ARG;
  dyd_status st = dyd_open_vertices(&v, &count, pd, f);
  if (st != DYD_OK) return st;
  for (size_t q = 0; q < count; q++) collect(&c, pd->sk.reps.site[v[q]]);
  free(v);
  *outer = dyd_open_is_outer(pd, f);
  return deliver(out, &c);
}

/* For visits: a list of pairs. */
typedef struct pair_collector {
  const uint32_t *site;
  dyd_pair *item;
  size_t count, cap;
  dyd_status status;
} pair_collector;

static void collect_pair(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  pair_collector *c = context;
  uint32_t i = c->site[v], j = c->site[w];
  if (c->status != DYD_OK) return;
  if (!dyd_reserve((void **)&c->item, &c->cap, c->count + 1, sizeof *c->item))
    c->status = DYD_E_NOMEM;
  else
    c->item[c->count++] = (dyd_pair){i < j ? i : j, i < j ? j : i, status};
}

dyd_status dyd_delaunay_face_pairs(dyd_pair_list *out, const dyd_delaunay *pd, size_t f) {
  if (!pd) return DYD_E_ARG;
  pair_collector c = {.site = pd->sk.reps.site};
  if (f >= pd->open.count) return DYD_E_ARG;
  dyd_open_each_in(pd, f, collect_pair, &c);
  if (c.status != DYD_OK) {
    free(c.item);
    return c.status;
  }
  if (c.count) qsort(c.item, c.count, sizeof *c.item, dyd_compare_pair);
  dyd_pair_list_clear(out);
  *out = (dyd_pair_list){c.count, c.item};
  return DYD_OK;
}
