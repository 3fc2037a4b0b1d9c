/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading the statuses: pairs, neighbours, triangles, faces, hull. */
#include "base/alloc.h"
#include "delaunay/build.h"
#include "delaunay/certify.h"
#include "delaunay/faces.h"
#include "delaunay/line.h"
#include "delaunay/witness.h"

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

void dyd_delaunay_get_counters(dyd_delaunay_counters *out, const dyd_delaunay *pd) {
  *out = pd->counters;
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
  bytes += pd->faces.face_cap * sizeof(dyd_face) + pd->faces.tri_cap * sizeof(uint32_t);
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
  dyd_pair_status s = status_in_faces(pd, v, w);
  if (s == DYD_ILLEGAL && share_capped_face(pd, v, w)) s = DYD_INDETERMINATE;
  return s;
}

dyd_pair_status dyd_delaunay_status(const dyd_delaunay *pd, uint32_t i, uint32_t j) {
  if (i >= pd->n || j >= pd->n) return DYD_ILLEGAL;
  uint32_t v = pd->vertex[i], w = pd->vertex[j];
  return v == w ? DYD_ILLEGAL : vertex_status(pd, v, w);
}

/* ---- all pairs ---- */

typedef void (*pair_visit)(void *context, uint32_t v, uint32_t w, dyd_pair_status status);

static void each_line_pair(const dyd_delaunay *pd, pair_visit visit, void *context) {
  const dyd_line *l = &pd->line;
  for (uint32_t a = 0; a + 1 < l->count; a++)
    for (uint32_t b = a + 1; b < l->count && (b == a + 1 || !l->capped); b++) {
      dyd_pair_status s = dyd_line_status(l, l->order[a], l->order[b]);
      if (!l->capped || s == DYD_LEGAL) visit(context, l->order[a], l->order[b], s);
    }
}

static void each_pair(const dyd_delaunay *pd, pair_visit visit, void *context) {
  const dyd_mesh *m = &pd->mesh;
  if (m->collinear) {
    each_line_pair(pd, visit, context);
    return;
  }
  for (uint32_t t = 0; t < m->count; t++)
    for (unsigned k = 0; k < 3; k++) {
      uint32_t v = m->tri[t].v[dyd_next(k)], w = m->tri[t].v[dyd_prev(k)];
      if (m->tri[t].n[k] > 4 * t + k && v != m->n && w != m->n && dyd_edge_is_certain(pd, t, k))
        visit(context, v, w, DYD_LEGAL);
    }
  for (size_t f = 0; f < pd->faces.count; f++) {
    const dyd_face *face = &pd->faces.face[f];
    for (uint32_t q = 0; q < face->pairs; q++) {
      dyd_vertex_pair p = pd->faces.pair[face->first_pair + q];
      if (!p.hidden) visit(context, p.i, p.j, dyd_face_open_status(face));
    }
  }
}

/* Counting sort by i, then each short run by j. */
typedef struct pair_sort {
  const dyd_delaunay *pd;
  size_t *start;
  dyd_pair *to;
  size_t total;
} pair_sort;

static void count_pair(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  pair_sort *s = context;
  (void)status;
  uint32_t i = s->pd->reps.site[v], j = s->pd->reps.site[w];
  s->start[i < j ? i : j]++;
  s->total++;
}

static void place_pair(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  pair_sort *s = context;
  uint32_t i = s->pd->reps.site[v], j = s->pd->reps.site[w];
  if (i > j) {
    uint32_t t = i;
    i = j;
    j = t;
  }
  s->to[s->start[i]++] = (dyd_pair){i, j, status};
}

static void starts_from_counts(size_t *start, uint32_t n) {
  size_t sum = 0;
  for (uint32_t i = 0; i < n; i++) {
    size_t c = start[i];
    start[i] = sum;
    sum += c;
  }
}

static int compare_second(const void *a, const void *b) {
  uint32_t x = ((const dyd_pair *)a)->j, y = ((const dyd_pair *)b)->j;
  return (x > y) - (x < y);
}

static void sort_run(dyd_pair *run, size_t count) {
  if (count > 16) {
    qsort(run, count, sizeof *run, compare_second);
    return;
  }
  for (size_t q = 1; q < count; q++) {
    dyd_pair p = run[q];
    size_t r = q;
    for (; r && run[r - 1].j > p.j; r--) run[r] = run[r - 1];
    run[r] = p;
  }
}

dyd_status dyd_delaunay_pairs(dyd_pair_list *out, const dyd_delaunay *pd) {
  pair_sort s = {.pd = pd};
  s.start = calloc(pd->n ? pd->n : 1, sizeof *s.start);
  if (!s.start) return DYD_E_NOMEM;
  each_pair(pd, count_pair, &s);
  s.to = dyd_alloc(s.total, sizeof *s.to);
  if (s.to) {
    starts_from_counts(s.start, pd->n);
    each_pair(pd, place_pair, &s);
    /* each start has moved on to the end of its run */
    for (uint32_t i = 0; i < pd->n; i++) {
      size_t first = i ? s.start[i - 1] : 0;
      sort_run(s.to + first, s.start[i] - first);
    }
    dyd_pair_list_clear(out);
    *out = (dyd_pair_list){s.total, s.to};
  }
  free(s.start);
  return s.to ? DYD_OK : DYD_E_NOMEM;
}

void dyd_delaunay_count(size_t count[4], const dyd_delaunay *pd) {
  memset(count, 0, 4 * sizeof *count);
  if (pd->mesh.collinear) {
    count[DYD_LEGAL] = dyd_line_legal_pairs(&pd->line);
    if (!pd->line.capped) count[pd->line.all_points ? DYD_TIE : DYD_INDETERMINATE] = dyd_line_open_pairs(&pd->line);
    return;
  }
  const dyd_mesh *m = &pd->mesh;
  for (uint32_t t = 0; t < m->count; t++)
    for (unsigned k = 0; k < 3; k++)
      count[DYD_LEGAL] += m->tri[t].n[k] > 4 * t + k && m->tri[t].v[dyd_next(k)] != m->n &&
                          m->tri[t].v[dyd_prev(k)] != m->n && dyd_edge_is_certain(pd, t, k);
  for (size_t f = 0; f < pd->faces.count; f++)
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

static void face_neighbours(collector *c, const dyd_delaunay *pd, uint32_t v, uint32_t f, dyd_pair_status least) {
  const dyd_face *face = &pd->faces.face[f];
  if (dyd_face_open_status(face) < least) return;
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair p = pd->faces.pair[face->first_pair + q];
    if (p.hidden) continue;
    if (p.i == v) collect(c, pd->reps.site[p.j]);
    if (p.j == v) collect(c, pd->reps.site[p.i]);
  }
}

dyd_status dyd_delaunay_neighbours(dyd_index_list *out, const dyd_delaunay *pd, uint32_t i, dyd_pair_status least) {
  collector c = {0};
  if (i >= pd->n) return DYD_E_ARG;
  uint32_t v = pd->vertex[i], before = DYD_NONE;
  if (pd->mesh.collinear) {
    for (uint32_t q = 0; q < pd->line.count; q++) {
      uint32_t w = pd->line.order[q];
      if (w != v && dyd_line_status(&pd->line, v, w) >= least) collect(&c, pd->reps.site[w]);
    }
    return deliver(out, &c, true);
  }
  uint32_t first = pd->corner[v], h = first;
  do {
    uint32_t w = pd->mesh.tri[h >> 2].v[dyd_next(h & 3)], f = pd->faces.of ? pd->faces.of[h >> 2] : DYD_NONE;
    if (w != pd->mesh.n && corner_edge_is_certain(pd, h)) collect(&c, pd->reps.site[w]);
    if (f != DYD_NONE && f != before) face_neighbours(&c, pd, v, f, least);
    before = f;
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
  return deliver(out, &c, true);
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
  dyd_status st = dyd_face_vertices(&v, &count, pd, &pd->faces.face[f]);
  if (st != DYD_OK) return st;
  for (size_t q = 0; q < count; q++) collect(&c, pd->reps.site[v[q]]);
  free(v);
  *outer = pd->faces.face[f].outer;
  return deliver(out, &c, true);
}

static int compare_pair(const void *a, const void *b) {
  const dyd_pair *x = a, *y = b;
  if (x->i != y->i) return x->i < y->i ? -1 : 1;
  return (x->j > y->j) - (x->j < y->j);
}

dyd_status dyd_delaunay_face_pairs(dyd_pair_list *out, const dyd_delaunay *pd, size_t f) {
  if (f >= dyd_delaunay_undecided_faces(pd)) return DYD_E_ARG;
  if (pd->mesh.collinear) {
    dyd_pair_list all = {0};
    dyd_status st = dyd_delaunay_pairs(&all, pd);
    size_t kept = 0;
    for (size_t q = 0; q < all.count; q++)
      if (all.item[q].status != DYD_LEGAL) all.item[kept++] = all.item[q];
    if (st != DYD_OK) return st;
    dyd_pair_list_clear(out);
    *out = (dyd_pair_list){kept, all.item};
    return DYD_OK;
  }
  const dyd_face *face = &pd->faces.face[f];
  dyd_pair *p = dyd_alloc(face->pairs, sizeof *p);
  if (!p) return DYD_E_NOMEM;
  size_t count = 0;
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair s = pd->faces.pair[face->first_pair + q];
    uint32_t i = pd->reps.site[s.i], j = pd->reps.site[s.j];
    if (!s.hidden) p[count++] = (dyd_pair){i < j ? i : j, i < j ? j : i, dyd_face_open_status(face)};
  }
  qsort(p, count, sizeof *p, compare_pair);
  dyd_pair_list_clear(out);
  *out = (dyd_pair_list){count, p};
  return DYD_OK;
}
