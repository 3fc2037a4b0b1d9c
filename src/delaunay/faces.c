/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Flooding the skeleton over uncertain edges, and the table of what is found. */
#include "delaunay/faces.h"

#include "base/alloc.h"
#include "base/error.h"
#include "delaunay/build.h"
#include "delaunay/closure.h"

#include <string.h>

void dyd_faces_clear(dyd_face_table *f) {
  free(f->face);
  free(f->tri);
  free(f->pair);
  free(f->of);
  memset(f, 0, sizeof *f);
}

static bool has_uncertain_edge(const dyd_delaunay *pd, uint32_t t) { return (pd->certain[t] & 7) != 7; }

static dyd_status make_marks(dyd_delaunay *pd) {
  if (pd->faces.of) return DYD_OK;
  pd->faces.of = dyd_alloc(pd->mesh.count, sizeof *pd->faces.of);
  if (!pd->faces.of) return DYD_E_NOMEM;
  memset(pd->faces.of, 0xff, pd->mesh.count * sizeof *pd->faces.of);
  return DYD_OK;
}

/* Appends the triangles joined to t and marks them with `face`. */
static dyd_status flood(dyd_delaunay *pd, uint32_t t, uint32_t face) {
  dyd_face_table *f = &pd->faces;
  size_t done = f->tri_count;
  if (!dyd_reserve((void **)&f->tri, &f->tri_cap, f->tri_count + 1, sizeof *f->tri)) return DYD_E_NOMEM;
  f->tri[f->tri_count++] = t;
  f->of[t] = face;
  for (; done < f->tri_count; done++)
    for (unsigned k = 0; k < 3; k++) {
      uint32_t s = f->tri[done], u = pd->mesh.tri[s].n[k] >> 2;
      if (dyd_edge_is_certain(pd, s, k) || f->of[u] != DYD_NONE) continue;
      if (!dyd_reserve((void **)&f->tri, &f->tri_cap, f->tri_count + 1, sizeof *f->tri)) return DYD_E_NOMEM;
      f->tri[f->tri_count++] = u;
      f->of[u] = face;
    }
  return DYD_OK;
}

static void report_cap(dyd_delaunay *pd, const dyd_closure *c) {
  const uint32_t *site = pd->reps.site, *v = c->vertex;
  uint32_t n = c->vertices;
  dyd_fail(pd->err, DYD_CAPPED,
           "more than %zu undecided pairs to store: %u sites around sites %u, %u, %u have too many possible neighbours "
           "(nearly cocircular, collinear or overlapping); raise the cap on pairs, or give narrower rectangles",
           pd->max_pairs, n, site[v[0]], site[v[n / 2]], site[v[n - 1]]);
}

static dyd_status store(dyd_delaunay *pd, const dyd_closure *c, size_t first_tri) {
  dyd_face_table *f = &pd->faces;
  if (!dyd_reserve((void **)&f->face, &f->face_cap, f->count + 1, sizeof *f->face)) return DYD_E_NOMEM;
  if (!dyd_reserve((void **)&f->pair, &f->pair_cap, f->pair_count + c->pairs, sizeof *f->pair)) return DYD_E_NOMEM;
  if (c->pairs) memcpy(f->pair + f->pair_count, c->pair, c->pairs * sizeof *c->pair);
  f->face[f->count++] = (dyd_face){.first_tri = first_tri,
                                   .first_pair = f->pair_count,
                                   .tris = (uint32_t)(f->tri_count - first_tri),
                                   .pairs = (uint32_t)c->pairs,
                                   .outer = c->outer,
                                   .tie = c->all_points,
                                   .capped = c->capped,
                                   .polygon = c->polygon};
  f->others += !c->polygon;
  f->pair_count += c->pairs;
  if (c->capped) report_cap(pd, c);
  return DYD_OK;
}

/* Takes back the marks and entries of the triangles from first_tri on. */
static void take_back(dyd_delaunay *pd, size_t first_tri) {
  dyd_face_table *f = &pd->faces;
  for (size_t q = first_tri; q < f->tri_count; q++) f->of[f->tri[q]] = DYD_NONE;
  f->tri_count = first_tri;
}

/* ---- one face for each pair ----
 *
 * Two sites on the rims of two faces may make a pair that both closures find. It is kept once: in the face where the skeleton has
 * it, else in a polygon, else where it was found first. */

static int compare_pair(const void *a, const void *b) {
  const dyd_vertex_pair *x = a, *y = b;
  if (x->i != y->i) return x->i < y->i ? -1 : 1;
  return (x->j > y->j) - (x->j < y->j);
}

static dyd_vertex_pair *find_pair(const dyd_face_table *f, const dyd_face *face, dyd_vertex_pair p) {
  return face->pairs ? bsearch(&p, f->pair + face->first_pair, face->pairs, sizeof p, compare_pair) : NULL;
}

/* The face inside which the skeleton has the pair as an uncertain edge, or DYD_NONE. */
static uint32_t skeleton_face(const dyd_delaunay *pd, dyd_vertex_pair p) {
  uint32_t h = dyd_find_edge(pd, p.i, p.j);
  return h == DYD_NONE || dyd_edge_is_certain(pd, h >> 2, dyd_prev(h & 3)) ? DYD_NONE : pd->faces.of[h >> 2];
}

/* Another face, already stored, that lists p; NULL: none. */
static dyd_face *other_owner(const dyd_delaunay *pd, uint32_t self, dyd_vertex_pair p) {
  const dyd_face_table *f = &pd->faces;
  uint32_t first = pd->corner[p.i], h = first;
  do {
    uint32_t g = f->of[h >> 2];
    if (g != DYD_NONE && g != self && g < f->count && find_pair(f, &f->face[g], p)) return &f->face[g];
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
  return NULL;
}

static void remove_pair(const dyd_face_table *f, dyd_face *face, dyd_vertex_pair p) {
  dyd_vertex_pair *at = find_pair(f, face, p), *end = f->pair + face->first_pair + face->pairs;
  memmove(at, at + 1, (size_t)(end - at - 1) * sizeof *at);
  face->pairs--;
}

/* Drops from c the pairs that belong to faces found before, and from those the pairs that belong to c. */
static void share_out(dyd_delaunay *pd, dyd_closure *c) {
  dyd_face_table *f = &pd->faces;
  uint32_t self = (uint32_t)f->count;
  size_t kept = 0;
  if (f->count == 0 || (c->polygon && f->others == 0)) return;
  for (size_t q = 0; q < c->pairs; q++) {
    dyd_vertex_pair p = c->pair[q];
    dyd_face *other = other_owner(pd, self, p);
    uint32_t home = other ? skeleton_face(pd, p) : self;
    bool mine = home == self || (home == DYD_NONE && c->polygon && !other->polygon);
    if (other && mine) remove_pair(f, other, p);
    if (mine) c->pair[kept++] = p;
  }
  c->pairs = kept;
}

static dyd_status find_face(dyd_delaunay *pd, dyd_work *w, uint32_t t) {
  dyd_face_table *f = &pd->faces;
  size_t first = f->tri_count;
  dyd_closure c = {0};
  dyd_status st = flood(pd, t, (uint32_t)f->count);
  size_t room = pd->max_pairs > f->pair_count ? pd->max_pairs - f->pair_count : 0;
  if (st == DYD_OK) st = dyd_closure_run(&c, pd, w, f->tri + first, (uint32_t)(f->tri_count - first), room);
  if (st == DYD_OK) {
    share_out(pd, &c);
    st = store(pd, &c, first);
  }
  pd->counters.faces++;
  if (st != DYD_OK) take_back(pd, first);
  dyd_closure_clear(&c);
  return st;
}

dyd_status dyd_faces_find(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count) {
  dyd_face_table *f = &pd->faces, before = *f;
  size_t all = tri ? count : pd->mesh.count;
  dyd_status st = DYD_OK;
  for (size_t q = 0; q < all && st == DYD_OK; q++) {
    uint32_t t = tri ? tri[q] : (uint32_t)q;
    if (!has_uncertain_edge(pd, t)) continue;
    st = make_marks(pd);
    if (st == DYD_OK && f->of[t] == DYD_NONE) st = dyd_cancelled(pd) ? DYD_CANCELLED : find_face(pd, w, t);
  }
  if (st != DYD_OK) {
    take_back(pd, before.tri_count);
    f->count = before.count;
    f->pair_count = before.pair_count;
  }
  return st;
}

static int compare_index(const void *a, const void *b) {
  uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
  return (x > y) - (x < y);
}

dyd_status dyd_face_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, const dyd_face *f) {
  uint32_t *v = dyd_alloc(3 * (size_t)f->tris, sizeof *v);
  size_t all = 0, kept = 0;
  if (!v) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < f->tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t w = pd->mesh.tri[pd->faces.tri[f->first_tri + q]].v[k];
      if (w != pd->mesh.n) v[all++] = w;
    }
  qsort(v, all, sizeof *v, compare_index);
  for (size_t q = 0; q < all; q++)
    if (kept == 0 || v[kept - 1] != v[q]) v[kept++] = v[q];
  *vertex = v;
  *count = kept;
  return DYD_OK;
}

dyd_pair_status dyd_face_status(const dyd_delaunay *pd, const dyd_face *f, uint32_t i, uint32_t j) {
  return find_pair(&pd->faces, f, (dyd_vertex_pair){i, j}) ? dyd_face_open_status(f) : DYD_ILLEGAL;
}
