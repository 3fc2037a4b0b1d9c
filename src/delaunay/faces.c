/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Flooding the skeleton over uncertain edges, and the table of what is found. */
#include "delaunay/faces.h"

#include "base/alloc.h"
#include "base/error.h"
#include "delaunay/build.h"
#include "delaunay/closures.h"
#include "delaunay/ties.h"
#include "legal/certify.h"

#include <string.h>

void dyd_faces_clear(dyd_face_table *f) {
  free(f->face);
  free(f->seed);
  free(f->tri);
  free(f->pair);
  free(f->of);
  memset(f, 0, sizeof *f);
}

static bool has_uncertain_edge(const dyd_delaunay *pd, uint32_t t) {
  return (pd->certain[t] & 7) != 7;
}

dyd_status dyd_faces_mark(dyd_delaunay *pd) {
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

/* An entry for the triangles from first_tri on, without pairs. */
static dyd_status add_face(dyd_delaunay *pd, size_t first_tri) {
  dyd_face_table *f = &pd->faces;
  if (!dyd_reserve((void **)&f->face, &f->face_cap, f->count + 1, sizeof *f->face)) return DYD_E_NOMEM;
  f->face[f->count++] =
      (dyd_face){.first_tri = first_tri, .first_pair = f->pair_count, .tris = (uint32_t)(f->tri_count - first_tri)};
  f->live_tris += f->tri_count - first_tri;
  return DYD_OK;
}

static dyd_status store(dyd_delaunay *pd, const dyd_closure *c, size_t g) {
  dyd_face_table *f = &pd->faces;
  dyd_face *face = &f->face[g];
  if (!dyd_reserve((void **)&f->pair, &f->pair_cap, f->pair_count + c->pairs, sizeof *f->pair)) return DYD_E_NOMEM;
  if (c->pairs) memcpy(f->pair + f->pair_count, c->pair, c->pairs * sizeof *c->pair);
  face->first_pair = f->pair_count;
  face->pairs = (uint32_t)c->pairs;
  face->outer = c->outer;
  face->tie = c->all_points;
  face->capped = c->capped;
  face->polygon = c->polygon;
  f->others += !c->polygon;
  f->pair_count += c->pairs;
  f->live_pairs += c->pairs;
  if (c->capped) report_cap(pd, c);
  return DYD_OK;
}

/* Takes back the marks and entries of the triangles from first_tri on. */
static void take_back(dyd_delaunay *pd, size_t first_tri) {
  dyd_face_table *f = &pd->faces;
  for (size_t q = first_tri; q < f->tri_count; q++) f->of[f->tri[q]] = DYD_NONE;
  f->tri_count = first_tri;
}

/* ---- one face for each pair: where the skeleton has it, else in a polygon, else where it was found first ---- */

static dyd_vertex_pair *find_pair(const dyd_face_table *f, const dyd_face *face, dyd_vertex_pair p) {
  return face->pairs ? bsearch(&p, f->pair + face->first_pair, face->pairs, sizeof p, dyd_compare_vertex_pair) : NULL;
}

/* The face inside which the skeleton has the pair as an uncertain edge, or DYD_NONE. */
static uint32_t skeleton_face(const dyd_delaunay *pd, dyd_vertex_pair p) {
  uint32_t h = dyd_find_edge(pd, p.i, p.j);
  return h == DYD_NONE || dyd_edge_is_certain(pd, h >> 2, dyd_prev(h & 3)) ? DYD_NONE : pd->faces.of[h >> 2];
}

/* Another face that lists p, shown or hidden as asked, and where; NULL: none. */
static dyd_vertex_pair *elsewhere(dyd_face **owner, const dyd_delaunay *pd, uint32_t self, dyd_vertex_pair p,
                                  bool hidden) {
  const dyd_face_table *f = &pd->faces;
  uint32_t first = pd->corner[p.i], h = first;
  do {
    uint32_t g = f->of[h >> 2];
    if (g != DYD_NONE && g != self) {
      dyd_vertex_pair *at = find_pair(f, &f->face[g], p);
      *owner = &f->face[g];
      if (at && at->hidden == hidden) return at;
    }
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
  return NULL;
}

static void hide(dyd_face *face, dyd_vertex_pair *at, bool hidden) {
  if (at->hidden == hidden) return;
  at->hidden = hidden;
  if (hidden)
    face->hidden++;
  else
    face->hidden--;
}

/* No two faces share a pair when all are polygons. */
static bool shares_nothing(const dyd_face_table *f, const dyd_face *face) {
  return f->count == 1 || (face->polygon && f->others == 0);
}

/* Hides the pairs of face `self` that belong to other faces, and in those the pairs that belong to it. */
static void share_out(dyd_delaunay *pd, uint32_t self) {
  dyd_face_table *f = &pd->faces;
  dyd_face *face = &f->face[self], *other = NULL;
  if (shares_nothing(f, face)) return;
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair *p = &f->pair[face->first_pair + q], *there;
    while (!p->hidden && (there = elsewhere(&other, pd, self, *p, false))) {
      uint32_t home = skeleton_face(pd, *p);
      bool mine = home == self || (home == DYD_NONE && face->polygon && !other->polygon);
      if (mine)
        hide(other, there, true);
      else
        hide(face, p, true);
    }
  }
}

/* The pairs that face `self` shows are shown by others that list them, for it goes. */
static void bequeath(dyd_delaunay *pd, uint32_t self) {
  dyd_face_table *f = &pd->faces;
  dyd_face *face = &f->face[self], *other = NULL;
  if (shares_nothing(f, face)) return;
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair p = f->pair[face->first_pair + q], *there = NULL;
    if (!p.hidden) there = elsewhere(&other, pd, self, p, true);
    if (there) hide(other, there, false);
  }
}

static bool is_all_points(const dyd_delaunay *pd, const uint32_t *tri, size_t tris) {
  for (size_t q = 0; q < tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t v = pd->mesh.tri[tri[q]].v[k];
      if (v != pd->mesh.n && !dyd_vertex_is_point(pd, v)) return false;
    }
  return true;
}

/* A face of exact points: the triangles at an edge inside are Delaunay triangles for every choice of all points, so the
 * inside of their Voronoi edge consists of witnesses unless it is one point [TIE-2]. The search for witnesses may have
 * missed some. *any: an edge has become certain. */
static void settle_points(bool *any, dyd_delaunay *pd, const uint32_t *tri, size_t tris) {
  *any = false;
  if (!is_all_points(pd, tri, tris)) return;
  for (size_t q = 0; q < tris; q++)
    for (unsigned k = 0; k < 3; k++)
      if (!dyd_edge_is_certain(pd, tri[q], k) && dyd_point_edge_is_certain(pd, tri[q], k)) {
        dyd_set_certain(pd, tri[q], k);
        *any = true;
      }
}

/* The faces among the triangles of one that has fallen apart. */
static dyd_status find_parts(dyd_delaunay *pd, size_t first) {
  dyd_face_table *f = &pd->faces;
  size_t tris = f->tri_count - first;
  uint32_t *tri = dyd_alloc(tris, sizeof *tri);
  if (!tri) return DYD_E_NOMEM;
  memcpy(tri, f->tri + first, tris * sizeof *tri);
  take_back(pd, first);
  dyd_status st = DYD_OK;
  for (size_t q = 0; q < tris && st == DYD_OK; q++) {
    if (!has_uncertain_edge(pd, tri[q]) || f->of[tri[q]] != DYD_NONE) continue;
    size_t start = f->tri_count;
    st = flood(pd, tri[q], (uint32_t)f->count);
    if (st == DYD_OK) st = add_face(pd, start);
  }
  free(tri);
  return st;
}

static dyd_status find_face(dyd_delaunay *pd, uint32_t t) {
  dyd_face_table *f = &pd->faces;
  size_t first = f->tri_count;
  bool apart = false;
  dyd_status st = flood(pd, t, (uint32_t)f->count);
  if (st == DYD_OK) settle_points(&apart, pd, f->tri + first, f->tri_count - first);
  if (st == DYD_OK && apart) return find_parts(pd, first);
  return st == DYD_OK ? add_face(pd, first) : st;
}

static dyd_status find_faces(dyd_delaunay *pd, const uint32_t *tri, size_t all) {
  dyd_status st = DYD_OK;
  for (size_t q = 0; q < all && st == DYD_OK; q++) {
    uint32_t t = tri ? tri[q] : (uint32_t)q;
    if (!has_uncertain_edge(pd, t)) continue;
    st = dyd_faces_mark(pd);
    if (st == DYD_OK && pd->faces.of[t] == DYD_NONE) st = find_face(pd, t);
  }
  return st;
}

/* Room for pairs now: what the faces stored so far leave. */
static size_t room_left(const dyd_delaunay *pd) {
  return pd->max_pairs > pd->faces.live_pairs ? pd->max_pairs - pd->faces.live_pairs : 0;
}

/* Closes the faces g .. g + count - 1 together. One that found more pairs than the others have left room for is closed
 * again, with that room. */
static dyd_status close_batch(dyd_closure *c, dyd_delaunay *pd, dyd_work *w, size_t g, size_t count) {
  size_t room = room_left(pd);
  dyd_status st = dyd_closures_run(c, pd, w, pd->faces.face + g, count, room);
  if (st != DYD_OK) return st;
  for (size_t k = 0; k < count; k++) {
    dyd_face *face = &pd->faces.face[g + k];
    if (st == DYD_OK && (c[k].capped || c[k].pairs > room_left(pd)) && room_left(pd) < room) {
      dyd_closure_clear(&c[k]);
      st = dyd_closure_run(&c[k], pd, w, pd->faces.tri + face->first_tri, face->tris, room_left(pd));
    }
    if (st == DYD_OK) st = store(pd, &c[k], g + k);
    dyd_closure_clear(&c[k]);
  }
  return st;
}

enum { BATCH = 4096 };

static dyd_status close_faces(dyd_delaunay *pd, dyd_work *w, size_t from) {
  size_t end = pd->faces.count, most = end - from < BATCH ? end - from : BATCH;
  dyd_closure *c = dyd_alloc(most, sizeof *c);
  dyd_status st = c ? DYD_OK : DYD_E_NOMEM;
  for (size_t g = from; g < end && st == DYD_OK; g += most)
    st = close_batch(c, pd, w, g, end - g < most ? end - g : most);
  free(c);
  return st;
}

dyd_status dyd_faces_find(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count) {
  dyd_face_table *f = &pd->faces, before = *f;
  if (pd->all_points) return dyd_ties_find(pd);
  dyd_status st = find_faces(pd, tri, tri ? count : pd->mesh.count);
  if (st == DYD_OK) st = close_faces(pd, w, before.count);
  if (st != DYD_OK) {
    take_back(pd, before.tri_count);
    f->count = before.count;
    f->pair_count = before.pair_count;
    f->others = before.others;
    f->live_pairs = before.live_pairs;
    f->live_tris = before.live_tris;
    return st;
  }
  for (size_t g = before.count; g < f->count; g++) share_out(pd, (uint32_t)g);
  return DYD_OK;
}

/* ---- replacing one face ---- */

static void mark(dyd_face_table *f, const dyd_face *face, uint32_t with) {
  for (uint32_t q = 0; q < face->tris; q++) f->of[f->tri[face->first_tri + q]] = with;
}

/* Takes face g out of the table; the last one gets its number. */
static void take_out(dyd_delaunay *pd, uint32_t g) {
  dyd_face_table *f = &pd->faces;
  bequeath(pd, g);
  dyd_face gone = f->face[g];
  mark(f, &gone, DYD_NONE);
  f->face[g] = f->face[--f->count];
  if (g < f->count) mark(f, &f->face[g], g);
  f->others -= !gone.polygon;
  f->live_pairs -= gone.pairs;
  f->live_tris -= gone.tris;
}

/* There is room for it: it has just been taken out. */
static void put_back(dyd_delaunay *pd, const dyd_face *face) {
  dyd_face_table *f = &pd->faces;
  mark(f, face, (uint32_t)f->count);
  f->face[f->count++] = *face;
  f->others += !face->polygon;
  f->live_pairs += face->pairs;
  f->live_tris += face->tris;
  share_out(pd, (uint32_t)(f->count - 1));
}

/* Drops what replaced faces have left over, once it is more than what is in use. Without memory, later. */
static void compact(dyd_face_table *f) {
  if (f->tri_count + f->pair_count < 2 * (f->live_tris + f->live_pairs) + 4096) return;
  uint32_t *tri = dyd_alloc(f->live_tris, sizeof *tri);
  dyd_vertex_pair *pair = dyd_alloc(f->live_pairs, sizeof *pair);
  if (!tri || !pair) {
    free(tri);
    free(pair);
    return;
  }
  f->tri_count = f->pair_count = 0;
  for (size_t g = 0; g < f->count; g++) {
    dyd_face *face = &f->face[g];
    memcpy(tri + f->tri_count, f->tri + face->first_tri, face->tris * sizeof *tri);
    memcpy(pair + f->pair_count, f->pair + face->first_pair, face->pairs * sizeof *pair);
    face->first_tri = f->tri_count;
    face->first_pair = f->pair_count;
    f->tri_count += face->tris;
    f->pair_count += face->pairs;
  }
  free(f->tri);
  free(f->pair);
  f->tri = tri;
  f->pair = pair;
  f->tri_cap = f->live_tris;
  f->pair_cap = f->live_pairs;
}

/* A face numbered at least `from` and below `to` that lists p, shown or hidden, and where; NULL: none. */
static dyd_vertex_pair *listed(dyd_face **owner, const dyd_delaunay *pd, dyd_vertex_pair p, size_t from, size_t to) {
  const dyd_face_table *f = &pd->faces;
  uint32_t first = pd->corner[p.i], h = first;
  do {
    uint32_t g = f->of[h >> 2];
    dyd_vertex_pair *at = g != DYD_NONE && g >= from && g < to ? find_pair(f, &f->face[g], p) : NULL;
    if (at) {
      *owner = &f->face[g];
      return at;
    }
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
  return NULL;
}

static void delete_pair(dyd_face_table *f, dyd_face *face, dyd_vertex_pair *at) {
  dyd_vertex_pair *end = f->pair + face->first_pair + face->pairs;
  hide(face, at, false);
  memmove(at, at + 1, (size_t)(end - at - 1) * sizeof *at);
  face->pairs--;
  f->live_pairs--;
}

/* A pair of the face replaced that a face before `fresh` lists, but none of the new ones, may have become legal or
 * impossible by what changed here. */
static dyd_status recheck_shared(dyd_delaunay *pd, dyd_work *w, const dyd_face *old, size_t fresh) {
  static const uint32_t no_hint[2] = {DYD_NONE, DYD_NONE};
  dyd_face_table *f = &pd->faces;
  dyd_status st = DYD_OK;
  if (f->count == 0 || (old->polygon && f->others == 0)) return st;
  for (uint32_t q = 0; q < old->pairs && st == DYD_OK; q++) {
    dyd_vertex_pair p = f->pair[old->first_pair + q], *at;
    dyd_face *owner = NULL;
    bool possible = true;
    if (!listed(&owner, pd, p, 0, fresh) || listed(&owner, pd, p, fresh, f->count)) continue;
    bool legal = dyd_is_legal(pd, p.i, p.j);
    if (!legal) st = dyd_cover_possible(&possible, w, pd, p.i, p.j, no_hint);
    while ((legal || !possible) && (at = listed(&owner, pd, p, 0, fresh))) delete_pair(f, owner, at);
  }
  return st;
}

dyd_status dyd_faces_replace(bool *replaced, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count) {
  dyd_face_table *f = &pd->faces;
  uint32_t g = f->of[tri[0]];
  dyd_face old = f->face[g];
  take_out(pd, g);
  size_t fresh = f->count;
  dyd_status st = dyd_faces_find(pd, w, tri, count);
  *replaced = st == DYD_OK;
  if (!*replaced) {
    put_back(pd, &old);
    return st;
  }
  st = recheck_shared(pd, w, &old, fresh);
  compact(f);
  return st;
}

dyd_status dyd_face_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f) {
  if (pd->all_points) return dyd_tie_vertices(vertex, count, pd, f);
  const dyd_face *face = &pd->faces.face[f];
  uint32_t *v = dyd_alloc(3 * (size_t)face->tris, sizeof *v);
  size_t all = 0, kept = 0;
  if (!v) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < face->tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t w = pd->mesh.tri[pd->faces.tri[face->first_tri + q]].v[k];
      if (w != pd->mesh.n) v[all++] = w;
    }
  qsort(v, all, sizeof *v, dyd_compare_index);
  for (size_t q = 0; q < all; q++)
    if (kept == 0 || v[kept - 1] != v[q]) v[kept++] = v[q];
  *vertex = v;
  *count = kept;
  return DYD_OK;
}

bool dyd_face_is_outer(const dyd_delaunay *pd, size_t f) {
  return pd->all_points ? dyd_tie_is_outer(pd, f) : pd->faces.face[f].outer;
}

bool dyd_face_is_capped(const dyd_delaunay *pd, size_t f) {
  return pd->all_points ? dyd_tie_is_capped(pd, f) : pd->faces.face[f].capped;
}

dyd_pair_status dyd_face_status(const dyd_delaunay *pd, const dyd_face *f, uint32_t i, uint32_t j) {
  const dyd_vertex_pair *p = find_pair(&pd->faces, f, (dyd_vertex_pair){i, j, 0});
  return p && !p->hidden ? dyd_face_open_status(f) : DYD_ILLEGAL;
}
