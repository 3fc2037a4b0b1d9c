/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Entries of the table of undecided faces. */
#include "delaunay/face_table.h"

#include "base/alloc.h"
#include "base/error.h"
#include "legal/certify.h"

#include <string.h>

void dyd_table_clear(dyd_undecided *f) {
  dyd_free_all(f->face, f->seed, f->tri, f->pair, f->turned, f->of);
  *f = (dyd_undecided){.kind = f->kind};
}

dyd_status dyd_table_mark(dyd_delaunay *pd) {
  size_t count = 2 * (size_t)pd->sk.n + 2; /* vertices may still come into the mesh */
  if (pd->open.of) return DYD_OK;
  if (!DYD_NEW(pd->open.of, count)) return DYD_E_NOMEM;
  memset(pd->open.of, 0xff, count * sizeof *pd->open.of);
  return DYD_OK;
}

static dyd_status table_append(dyd_undecided *f, uint32_t t, uint32_t face) {
  if (!DYD_GROW(f->tri, f->tri_cap, f->tri_count + 1)) return DYD_E_NOMEM;
  f->tri[f->tri_count++] = t;
  f->of[t] = face;
  return DYD_OK;
}

static dyd_status table_flood(dyd_delaunay *pd, uint32_t t, uint32_t face) {
  dyd_undecided *f = &pd->open;
  size_t done = f->tri_count;
  dyd_status st = table_append(f, t, face);
  for (; done < f->tri_count && st == DYD_OK; done++)
    for (dyd_half_edge h = dyd_edge_of(f->tri[done], 0), end = h + 3; h < end && st == DYD_OK; h++) {
      uint32_t beyond = dyd_edge_triangle(dyd_edge_twin(&pd->sk.mesh, h));
      if (!dyd_edge_is_certain(&pd->sk, h) && f->of[beyond] == DYD_NONE) st = table_append(f, beyond, face);
    }
  return st;
}

static dyd_status table_add(dyd_delaunay *pd, size_t first_tri) {
  dyd_undecided *f = &pd->open;
  if (!DYD_GROW(f->face, f->face_cap, f->count + 1)) return DYD_E_NOMEM;
  f->face[f->count++] =
      (dyd_face){.first_tri = first_tri, .first_pair = f->pair_count, .tris = (uint32_t)(f->tri_count - first_tri)};
  f->live_tris += f->tri_count - first_tri;
  return DYD_OK;
}

static void table_take_back(dyd_delaunay *pd, size_t first_tri) {
  dyd_undecided *f = &pd->open;
  for (size_t q = first_tri; q < f->tri_count; q++) f->of[f->tri[q]] = DYD_NONE;
  f->tri_count = first_tri;
}

size_t dyd_delaunay_memory(const dyd_delaunay *pd) {
  if (!pd) return 0;
  const dyd_undecided *f = &pd->open;
  size_t bytes = sizeof *pd + dyd_skeleton_memory(&pd->sk);
  bytes += f->face_cap * sizeof *f->face + (f->tri_cap + f->seed_cap) * sizeof *f->tri;
  return bytes + f->pair_cap * sizeof *f->pair + f->turned_cap * sizeof *f->turned +
         (f->of ? pd->sk.mesh.count * sizeof *f->of : 0);
}

/* ---- finding ---- */

static bool is_all_points(const dyd_skeleton *sk, const uint32_t *tri, size_t tris) {
  for (size_t q = 0; q < tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t v = sk->mesh.tri[tri[q]].v[k];
      if (v != sk->mesh.n && !dyd_vertex_is_point(sk, v)) return false;
    }
  return true;
}

/* A face of exact points: the triangles at an edge inside are Delaunay triangles for every choice of all points, so the
 * inside of their Voronoi edge consists of witnesses unless it is one point [TIE-2]. The search for witnesses may have
 * missed some. *any: an edge has become certain. */
static void settle_points(bool *any, dyd_skeleton *sk, dyd_work *w, const uint32_t *tri, size_t tris) {
  *any = false;
  if (!is_all_points(sk, tri, tris)) return;
  for (size_t q = 0; q < tris; q++)
    for (dyd_half_edge h = dyd_edge_of(tri[q], 0); h < dyd_edge_end(tri[q]); h++)
      if (!dyd_edge_is_certain(sk, h) && dyd_point_edge_is_certain(&w->tally, &sk->mesh, h)) {
        dyd_set_certain(sk, h, true);
        *any = true;
      }
}

/* The faces among the triangles of one that has fallen apart. */
static dyd_status find_parts(dyd_delaunay *pd, size_t first) {
  dyd_undecided *f = &pd->open;
  size_t tris = f->tri_count - first;
  uint32_t *tri = dyd_alloc(tris, sizeof *tri);
  if (!tri) return DYD_E_NOMEM;
  memcpy(tri, f->tri + first, tris * sizeof *tri);
  table_take_back(pd, first);
  dyd_status st = DYD_OK;
  for (size_t q = 0; q < tris && st == DYD_OK; q++) {
    if (dyd_triangle_is_certain(&pd->sk, tri[q]) || f->of[tri[q]] != DYD_NONE) continue;
    size_t start = f->tri_count;
    st = table_flood(pd, tri[q], (uint32_t)f->count);
    if (st == DYD_OK) st = table_add(pd, start);
  }
  free(tri);
  return st;
}

static dyd_status find_face(dyd_delaunay *pd, dyd_work *w, uint32_t t) {
  dyd_undecided *f = &pd->open;
  size_t first = f->tri_count;
  bool apart = false;
  dyd_status st = table_flood(pd, t, (uint32_t)f->count);
  if (st == DYD_OK) settle_points(&apart, &pd->sk, w, f->tri + first, f->tri_count - first);
  if (st == DYD_OK && apart) return find_parts(pd, first);
  return st == DYD_OK ? table_add(pd, first) : st;
}

/* For marks, and for triangles in faces of several each. */
static bool table_has_room(const dyd_delaunay *pd, dyd_work *w) {
  enum { A_FACE = 4 };
  uint64_t each = sizeof *pd->open.of + sizeof *pd->open.tri + sizeof *pd->open.face / A_FACE;
  w->room.held = dyd_delaunay_memory(pd);
  return dyd_room_has(&w->room, pd->sk.mesh.count * each, "the undecided faces");
}

dyd_status dyd_table_find(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t all) {
  dyd_status st = DYD_OK;
  for (size_t q = 0; q < all && st == DYD_OK; q++) {
    uint32_t t = tri ? tri[q] : (uint32_t)q;
    if (dyd_triangle_is_certain(&pd->sk, t)) continue;
    if (!pd->open.of && !table_has_room(pd, w)) return DYD_E_NOMEM;
    st = dyd_table_mark(pd);
    if (st == DYD_OK && pd->open.of[t] == DYD_NONE) st = find_face(pd, w, t);
  }
  return st;
}

/* ---- pairs of a face ---- */

static int compare_turned(const void *a, const void *b) {
  uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
  return (x > y) - (x < y);
}

/* The numbers of the pairs by j, then i: they are sorted by i. */
static dyd_status turn_pairs(uint32_t *turned, const dyd_vertex_pair *pair, uint32_t pairs) {
  if (pairs <= DYD_FEW_PAIRS) return DYD_OK;
  uint64_t *key = dyd_alloc(pairs, sizeof *key);
  if (!key) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < pairs; q++) key[q] = (uint64_t)pair[q].j << 32 | q;
  qsort(key, pairs, sizeof *key, compare_turned);
  for (uint32_t q = 0; q < pairs; q++) turned[q] = (uint32_t)key[q];
  free(key);
  return DYD_OK;
}

static bool make_room_for_pairs(dyd_undecided *f, size_t pairs) {
  return DYD_GROW(f->pair, f->pair_cap, f->pair_count + pairs) &&
         DYD_GROW(f->turned, f->turned_cap, f->pair_count + pairs);
}

dyd_status dyd_table_store(dyd_delaunay *pd, size_t g, dyd_face as, const dyd_vertex_pair *pair) {
  dyd_undecided *f = &pd->open;
  if (!make_room_for_pairs(f, as.pairs)) return DYD_E_NOMEM;
  if (turn_pairs(f->turned + f->pair_count, pair, as.pairs) != DYD_OK) return DYD_E_NOMEM;
  if (as.pairs) memcpy(f->pair + f->pair_count, pair, as.pairs * sizeof *pair);
  as.first_tri = f->face[g].first_tri;
  as.tris = f->face[g].tris;
  as.first_pair = f->pair_count;
  f->face[g] = as;
  f->others += !as.polygon;
  f->capped += as.capped;
  f->pair_count += as.pairs;
  f->live_pairs += as.pairs;
  return DYD_OK;
}

void dyd_table_roll_back(dyd_delaunay *pd, const dyd_undecided *before) {
  dyd_undecided *f = &pd->open;
  table_take_back(pd, before->tri_count);
  f->count = before->count;
  f->pair_count = before->pair_count;
  f->others = before->others;
  f->capped = before->capped;
  f->live_pairs = before->live_pairs;
  f->live_tris = before->live_tris;
}

/* ---- one face for each pair ---- */

dyd_vertex_pair *dyd_listed_pair(const dyd_delaunay *pd, size_t f, uint32_t v, uint32_t w) {
  const dyd_face *face = &pd->open.face[f];
  dyd_vertex_pair key = {v < w ? v : w, v < w ? w : v, 0};
  if (!face->pairs) return NULL;
  return bsearch(&key, pd->open.pair + face->first_pair, face->pairs, sizeof key, dyd_compare_vertex_pair);
}

/* A face but `self` that lists p, numbered at least `from` and below `to`, and where; hidden: 1 only where it is
 * hidden, 0 only where it is shown, -1 both. */
static dyd_vertex_pair *table_find(dyd_face **owner, const dyd_delaunay *pd, dyd_vertex_pair p, size_t from, size_t to,
                                   uint32_t self, int hidden) {
  dyd_half_edge first = pd->sk.leaving[p.i];
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(&pd->sk.mesh, h, first)) {
    uint32_t g = pd->open.of[dyd_edge_triangle(h)];
    bool asked = g != DYD_NONE && g != self && g >= from && g < to;
    dyd_vertex_pair *at = asked ? dyd_listed_pair(pd, g, p.i, p.j) : NULL;
    if (at && (hidden < 0 || at->hidden == (unsigned)hidden)) {
      *owner = &pd->open.face[g];
      return at;
    }
  }
  return NULL;
}

bool dyd_table_may_list(dyd_table_star *s, const dyd_delaunay *pd, uint32_t v) {
  if (v == s->v) return s->others;
  dyd_half_edge first = pd->sk.leaving[v];
  s->v = v;
  s->others = false;
  for (dyd_half_edge h = first; h != DYD_NONE && !s->others; h = dyd_edge_around(&pd->sk.mesh, h, first)) {
    uint32_t g = pd->open.of[dyd_edge_triangle(h)];
    s->others = g != DYD_NONE && g != s->self && g >= s->from && g < s->to;
  }
  return s->others;
}

dyd_vertex_pair *dyd_table_listed(dyd_face **owner, const dyd_delaunay *pd, dyd_vertex_pair p, size_t from, size_t to) {
  return table_find(owner, pd, p, from, to, DYD_NONE, -1);
}

static dyd_vertex_pair *elsewhere(dyd_face **owner, const dyd_delaunay *pd, uint32_t self, dyd_vertex_pair p,
                                  bool hidden) {
  return table_find(owner, pd, p, 0, pd->open.count, self, hidden);
}

/* The face inside which the skeleton has the pair as an uncertain edge, or DYD_NONE. */
static uint32_t skeleton_face(const dyd_delaunay *pd, dyd_vertex_pair p) {
  dyd_half_edge h = dyd_find_edge(&pd->sk, p.i, p.j);
  return h == DYD_NONE || dyd_edge_is_certain(&pd->sk, h) ? DYD_NONE : pd->open.of[dyd_edge_triangle(h)];
}

static void table_hide(dyd_face *face, dyd_vertex_pair *at, bool hidden) {
  if (at->hidden == hidden) return;
  at->hidden = hidden;
  face->hidden = hidden ? face->hidden + 1 : face->hidden - 1;
}

/* No two faces share a pair when all are polygons. */
static bool shares_nothing(const dyd_undecided *f, const dyd_face *face) {
  return f->count == 1 || (face->polygon && f->others == 0);
}

void dyd_table_share_out(dyd_delaunay *pd, uint32_t self) {
  dyd_undecided *f = &pd->open;
  dyd_face *face = &f->face[self], *other = NULL;
  dyd_table_star star = {.from = 0, .to = f->count, .self = self, .v = DYD_NONE};
  if (shares_nothing(f, face)) return;
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair *p = &f->pair[face->first_pair + q], *there;
    if (!dyd_table_may_list(&star, pd, p->i)) continue;
    while (!p->hidden && (there = elsewhere(&other, pd, self, *p, false))) {
      uint32_t home = skeleton_face(pd, *p);
      bool mine = home == self || (home == DYD_NONE && face->polygon && !other->polygon);
      if (mine)
        table_hide(other, there, true);
      else
        table_hide(face, p, true);
    }
  }
}

/* The pairs that face `self` shows are shown by others that list them, for it goes. */
static void bequeath(dyd_delaunay *pd, uint32_t self) {
  dyd_undecided *f = &pd->open;
  dyd_face *face = &f->face[self], *other = NULL;
  dyd_table_star star = {.from = 0, .to = f->count, .self = self, .v = DYD_NONE};
  if (shares_nothing(f, face)) return;
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair p = f->pair[face->first_pair + q], *there = NULL;
    if (!dyd_table_may_list(&star, pd, p.i)) continue;
    if (!p.hidden) there = elsewhere(&other, pd, self, p, true);
    if (there) table_hide(other, there, false);
  }
}

/* ---- coming and going ---- */

static void mark_face(dyd_undecided *f, const dyd_face *face, uint32_t with) {
  for (uint32_t q = 0; q < face->tris; q++) f->of[f->tri[face->first_tri + q]] = with;
}

void dyd_table_take_out(dyd_delaunay *pd, uint32_t g) {
  dyd_undecided *f = &pd->open;
  bequeath(pd, g);
  dyd_face gone = f->face[g];
  mark_face(f, &gone, DYD_NONE);
  f->face[g] = f->face[--f->count];
  if (g < f->count) mark_face(f, &f->face[g], g);
  f->others -= !gone.polygon;
  f->capped -= gone.capped;
  f->live_pairs -= gone.pairs;
  f->live_tris -= gone.tris;
}

void dyd_table_put_back(dyd_delaunay *pd, const dyd_face *face) {
  dyd_undecided *f = &pd->open;
  mark_face(f, face, (uint32_t)f->count);
  f->face[f->count++] = *face;
  f->others += !face->polygon;
  f->capped += face->capped;
  f->live_pairs += face->pairs;
  f->live_tris += face->tris;
  dyd_table_share_out(pd, (uint32_t)(f->count - 1));
}

/* LEFT_OVER: entries that are not worth it. In the armed build tables of small faces are compacted, too. */
#ifdef DYD_ARMED
enum { LEFT_OVER = 64 };
#else
enum { LEFT_OVER = 4096 };
#endif

void dyd_table_compact(dyd_undecided *f) {
  if (f->tri_count + f->pair_count < 2 * (f->live_tris + f->live_pairs) + LEFT_OVER) return;
  uint32_t *tri = dyd_alloc(f->live_tris, sizeof *tri);
  uint32_t *turned = dyd_alloc(f->live_pairs, sizeof *turned);
  dyd_vertex_pair *pair = dyd_alloc(f->live_pairs, sizeof *pair);
  if (!tri || !turned || !pair) {
    dyd_free_all(tri, turned, pair);
    return;
  }
  f->tri_count = f->pair_count = 0;
  for (size_t g = 0; g < f->count; g++) {
    dyd_face *face = &f->face[g];
    memcpy(tri + f->tri_count, f->tri + face->first_tri, face->tris * sizeof *tri);
    memcpy(pair + f->pair_count, f->pair + face->first_pair, face->pairs * sizeof *pair);
    if (face->pairs > DYD_FEW_PAIRS)
      memcpy(turned + f->pair_count, f->turned + face->first_pair, face->pairs * sizeof *turned);
    face->first_tri = f->tri_count;
    face->first_pair = f->pair_count;
    f->tri_count += face->tris;
    f->pair_count += face->pairs;
  }
  dyd_free_all(f->tri, f->turned, f->pair);
  f->tri = tri;
  f->turned = turned;
  f->pair = pair;
  f->tri_cap = f->live_tris;
  f->turned_cap = f->pair_cap = f->live_pairs;
}

/* Drops number `gone` of so many. */
static void turned_delete(uint32_t *turned, uint32_t pairs, uint32_t gone) {
  uint32_t kept = 0;
  for (uint32_t q = 0; q < pairs; q++)
    if (turned[q] != gone) turned[kept++] = turned[q] - (turned[q] > gone);
}

void dyd_table_delete(dyd_undecided *f, dyd_face *face, dyd_vertex_pair *at) {
  dyd_vertex_pair *first = f->pair + face->first_pair;
  dyd_vertex_pair *end = first + face->pairs;
  table_hide(face, at, false);
  if (face->pairs > DYD_FEW_PAIRS) turned_delete(f->turned + face->first_pair, face->pairs, (uint32_t)(at - first));
  memmove(at, at + 1, (size_t)(end - at - 1) * sizeof *at);
  face->pairs--;
  f->live_pairs--;
}

void dyd_report_cap(dyd_work *w, const dyd_delaunay *pd, const uint32_t *v, size_t n) {
  const uint32_t *site = pd->sk.reps.site;
  if (w->run->keep_cut && dyd_work_cancelled(w)) {
    dyd_fail(w->run->err, DYD_CAPPED, "work was stopped before all undecided faces were closed");
    return;
  }
  dyd_fail(
      w->run->err, DYD_CAPPED,
      "more than %zu undecided pairs to store: %zu sites around sites %u, %u, %u have too many possible neighbours "
      "(nearly cocircular, collinear or overlapping); raise the cap on pairs, or give narrower rectangles",
      pd->max_pairs, n, site[v[0]], site[v[n / 2]], site[v[n - 1]]);
}
