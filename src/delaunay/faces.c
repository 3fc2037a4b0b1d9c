/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Flooding the skeleton over uncertain edges, and closing the faces found, which are entries of a table. */
#include "delaunay/faces.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "delaunay/closure.h"
#include "delaunay/ties.h"
#include "possible/cover.h"
#include "possible/patches_filter.h"
#include "skeleton/mesh_filter.h"
#include "skeleton/rects_filter.h"

#include <string.h>

/* ---- the table ---- */

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
  DYD_FREED uint32_t *tri = dyd_alloc(tris, sizeof *tri);
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
  w->memory.held = dyd_delaunay_memory(pd);
  return dyd_memory_has(&w->memory, pd->sk.mesh.count * each, "the undecided faces");
}

/* Adds the faces, without pairs, among the triangles tri[0..all-1], or of all triangles (NULL). Exact points that are
 * not tied make edges certain on the way. */
static dyd_status table_find_faces(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t all) {
  dyd_status st = DYD_OK;
  for (size_t q = 0; q < all && st == DYD_OK; q++) {
    uint32_t t = tri ? tri[q] : (uint32_t)q;
    if (dyd_triangle_is_certain(&pd->sk, t)) continue;
    if (!pd->open.of && !table_has_room(pd, w)) return DYD_E_NOMEM;
    st = dyd_table_mark(&pd->open, pd->sk.n);
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
  DYD_FREED uint64_t *key = dyd_alloc(pairs, sizeof *key);
  if (!key) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < pairs; q++) key[q] = (uint64_t)pair[q].j << 32 | q;
  qsort(key, pairs, sizeof *key, compare_turned);
  for (uint32_t q = 0; q < pairs; q++) turned[q] = (uint32_t)key[q];
  return DYD_OK;
}

static bool make_room_for_pairs(dyd_undecided *f, size_t pairs) {
  return DYD_GROW(f->pair, f->pair_cap, f->pair_count + pairs) &&
         DYD_GROW(f->turned, f->turned_cap, f->pair_count + pairs);
}

/* Gives face g its pairs, copied, and what `as` says of them. */
static dyd_status table_store(dyd_delaunay *pd, size_t g, dyd_face as, const dyd_vertex_pair *pair) {
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

/* Back to what the table was before faces were added. */
static void table_roll_back(dyd_delaunay *pd, const dyd_undecided *before) {
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

/* A search for faces but `self`, numbered at least `from` and below `to`, with triangles at v. The result for the last
 * vertex is kept: pairs come sorted. Begin with v = DYD_NONE. */
typedef struct table_star {
  size_t from, to;
  uint32_t self, v;
  bool others;
} table_star;

static bool table_may_list(table_star *s, const dyd_delaunay *pd, uint32_t v) {
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

static dyd_vertex_pair *table_listed(dyd_face **owner, const dyd_delaunay *pd, dyd_vertex_pair p, size_t from,
                                     size_t to) {
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

/* Hides the pairs of face g that belong to other faces, and in those the pairs that belong to it: each is shown where
 * the skeleton has it, else in a polygon, else where it was found first. */
static void table_share_out(dyd_delaunay *pd, uint32_t self) {
  dyd_undecided *f = &pd->open;
  dyd_face *face = &f->face[self], *other = NULL;
  table_star star = {.from = 0, .to = f->count, .self = self, .v = DYD_NONE};
  if (shares_nothing(f, face)) return;
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair *p = &f->pair[face->first_pair + q], *there;
    if (!table_may_list(&star, pd, p->i)) continue;
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
  table_star star = {.from = 0, .to = f->count, .self = self, .v = DYD_NONE};
  if (shares_nothing(f, face)) return;
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair p = f->pair[face->first_pair + q], *there = NULL;
    if (!table_may_list(&star, pd, p.i)) continue;
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

/* Puts it in again: there is room for it. */
static void table_put_back(dyd_delaunay *pd, const dyd_face *face) {
  dyd_undecided *f = &pd->open;
  mark_face(f, face, (uint32_t)f->count);
  f->face[f->count++] = *face;
  f->others += !face->polygon;
  f->capped += face->capped;
  f->live_pairs += face->pairs;
  f->live_tris += face->tris;
  table_share_out(pd, (uint32_t)(f->count - 1));
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

static void table_delete(dyd_undecided *f, dyd_face *face, dyd_vertex_pair *at) {
  dyd_vertex_pair *first = f->pair + face->first_pair;
  dyd_vertex_pair *end = first + face->pairs;
  table_hide(face, at, false);
  if (face->pairs > DYD_FEW_PAIRS) turned_delete(f->turned + face->first_pair, face->pairs, (uint32_t)(at - first));
  memmove(at, at + 1, (size_t)(end - at - 1) * sizeof *at);
  face->pairs--;
  f->live_pairs--;
}

/* Reports the n vertices v that have too many possible neighbours. */
static void report_cap(dyd_work *w, const dyd_delaunay *pd, const uint32_t *v, size_t n) {
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

/* ---- keeping what cannot have changed ---- */

/* CROWD: least triangles of a face that is worth it. Pairs are found anew where more than one of SHARE may end. In the
 * armed build small faces take part, too. */
#ifdef DYD_ARMED

enum { CROWD = 4, SHARE = 1 };

#else

enum { CROWD = 64, SHARE = 4 };

#endif

/* CHANGED: narrowed. NEAR: was a possible neighbour of a changed one. FREE: also, does not meet that one any more,
 * which may block it. MEMBER: of the face in work; of these, DOUBT: in a pair that may have become impossible; SHOWN:
 * proved possibly nearest at the centre examined. */
enum { CHANGED = 1, NEAR = 2, FREE = 4, MEMBER = 8, DOUBT = 16, SHOWN = 32 };

void dyd_narrowed_clear(dyd_narrowed *n) {
  free(n->mark);
  n->mark = NULL;
}

/* ---- vertices that may be concerned ---- */

/* false: they are too many. */
static bool note_changed(dyd_narrowed *n, const dyd_delaunay *pd, uint32_t f, const uint32_t *changed, size_t count) {
  for (size_t q = 0; q < count; q++) {
    uint32_t v = pd->sk.vertex[changed[q]];
    if (n->mark[v] || !dyd_is_corner_of(pd, v, f)) continue;
    if (n->count == DYD_FEW) return false;
    n->mark[v] = CHANGED;
    n->vertex[n->count++] = v;
  }
  return true;
}

static void note_near(dyd_narrowed *n, const dyd_delaunay *pd, uint32_t changed, uint32_t v) {
  n->mark[v] |= dyd_surely_meet(&pd->sk.rects, changed, v) ? NEAR : NEAR | FREE;
}

/* The possible neighbours of those narrowed: by pairs of the face, and by legal ones. */
static void note_neighbours(dyd_narrowed *n, const dyd_delaunay *pd) {
  const dyd_vertex_pair *p = pd->open.pair + n->old.first_pair, *end = p + n->old.pairs;
  const dyd_mesh *m = &pd->sk.mesh;
  for (; p < end; p++) {
    if (n->mark[p->i] & CHANGED) note_near(n, pd, p->i, p->j);
    if (n->mark[p->j] & CHANGED) note_near(n, pd, p->j, p->i);
  }
  for (uint32_t q = 0; q < n->count; q++) {
    dyd_half_edge first = pd->sk.leaving[n->vertex[q]];
    for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(m, h, first)) {
      uint32_t v = dyd_edge_target(m, h);
      if (dyd_edge_is_certain(&pd->sk, h) && v != m->n) note_near(n, pd, n->vertex[q], v);
    }
  }
}

dyd_status dyd_narrowed_init(dyd_narrowed *n, const dyd_delaunay *pd, uint32_t f, const uint32_t *changed,
                             size_t count) {
  *n = (dyd_narrowed){.old = pd->open.face[f]};
  bool large = n->old.tris >= CROWD && !n->old.capped && !n->old.tie;
  if (!large || count > n->old.tris) return DYD_OK;
  if (!DYD_ZEROED(n->mark, (size_t)pd->sk.mesh.n + 1)) return DYD_E_NOMEM;
  if (note_changed(n, pd, f, changed, count))
    note_neighbours(n, pd);
  else
    dyd_narrowed_clear(n);
  return DYD_OK;
}

bool dyd_narrowed_reaches(const dyd_narrowed *n, const dyd_mesh *m, dyd_half_edge h) {
  return !n->mark || ((n->mark[dyd_edge_origin(m, h)] | n->mark[dyd_edge_target(m, h)]) & (CHANGED | NEAR));
}

/* ---- pairs ---- */

/* Pairs that may have become impossible: places in the old list, and their vertices. gone: by place in the old list. */
typedef struct doubt {
  uint32_t *pair, *vertex;
  size_t pairs, all, vertices, pair_cap, vertex_cap;
  bool *gone, *near;
} doubt;

static void doubt_clear(doubt *d) {
  dyd_free_all(d->pair, d->vertex, d->gone, d->near);
}

/* Rectangles that meet are a possible pair [POS-1]. */
static bool may_end(const dyd_narrowed *n, const dyd_delaunay *pd, dyd_vertex_pair p) {
  uint8_t a = n->mark[p.i], b = n->mark[p.j];
  return (((a | b) & CHANGED) || (a & b & FREE)) && !dyd_surely_meet(&pd->sk.rects, p.i, p.j);
}

static bool doubt_vertex(doubt *d, const dyd_narrowed *n, uint32_t v) {
  if (n->mark[v] & DOUBT) return true;
  if (!DYD_GROW(d->vertex, d->vertex_cap, d->vertices + 1)) return false;
  n->mark[v] |= DOUBT;
  d->vertex[d->vertices++] = v;
  return true;
}

/* Pairs of members that have become legal are gone, others are in doubt. */
static dyd_status find_doubts(doubt *d, const dyd_narrowed *n, const dyd_delaunay *pd) {
  const dyd_vertex_pair *p = pd->open.pair + n->old.first_pair;
  if (!DYD_ZEROED(d->gone, n->old.pairs ? n->old.pairs : 1)) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < n->old.pairs; q++, p++) {
    uint8_t a = n->mark[p->i], b = n->mark[p->j];
    if (!(a & b & MEMBER)) continue;
    d->all++;
    d->gone[q] = n->certain && ((a | b) & (CHANGED | NEAR)) && dyd_is_legal(&pd->sk, p->i, p->j);
    if (d->gone[q] || !may_end(n, pd, *p)) continue;
    if (!DYD_GROW(d->pair, d->pair_cap, d->pairs + 1) || !doubt_vertex(d, n, p->i) || !doubt_vertex(d, n, p->j))
      return DYD_E_NOMEM;
    d->pair[d->pairs++] = q;
  }
  d->near = dyd_alloc(d->vertices, sizeof *d->near);
  return d->near ? DYD_OK : DYD_E_NOMEM;
}

/* The centre shows some of those left to be possible: they are in doubt no longer. */
static void clear_doubts(doubt *d, const dyd_narrowed *n, const dyd_delaunay *pd, dyd_xy centre) {
  const dyd_vertex_pair *old = pd->open.pair + n->old.first_pair;
  size_t kept = 0;
  dyd_filter_clique(d->near, &pd->sk.rects, centre, d->vertex, d->vertices);
  for (size_t k = 0; k < d->vertices; k++)
    if (d->near[k]) n->mark[d->vertex[k]] |= SHOWN;
  for (size_t k = 0; k < d->pairs; k++) {
    dyd_vertex_pair p = old[d->pair[k]];
    if (!(n->mark[p.i] & n->mark[p.j] & SHOWN)) d->pair[kept++] = d->pair[k];
  }
  for (size_t k = 0; k < d->vertices; k++) n->mark[d->vertex[k]] &= (uint8_t)~SHOWN;
  d->pairs = kept;
}

static dyd_status settle_doubts(doubt *d, const dyd_narrowed *n, dyd_work *w, const dyd_delaunay *pd) {
  dyd_status st = DYD_OK;
  while (d->pairs && st == DYD_OK) {
    uint32_t q = d->pair[--d->pairs];
    dyd_vertex_pair p = pd->open.pair[n->old.first_pair + q];
    bool of_others = !((n->mark[p.i] | n->mark[p.j]) & CHANGED);
    dyd_cover found;
    const uint32_t hint[2] = {of_others ? n->vertex[0] : DYD_NONE, DYD_NONE};
    if (dyd_work_cancelled(w)) return DYD_CANCELLED;
    st = dyd_cover_possible(&found, w, &pd->sk, p.i, p.j, hint);
    d->gone[q] = !found.possible;
    if (found.possible && !found.walked) clear_doubts(d, n, pd, (dyd_xy){found.place.e[0], found.place.e[2]});
  }
  return st;
}

/* Marks the vertices of face g as members, or no longer. Says whether it is outer, and of exact points only. */
static void mark_members(dyd_face *as, const dyd_narrowed *n, const dyd_delaunay *pd, size_t g, bool member) {
  const dyd_face *face = &pd->open.face[g];
  const dyd_mesh *m = &pd->sk.mesh;
  as->tie = true;
  for (uint32_t q = 0; q < face->tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t v = m->tri[pd->open.tri[face->first_tri + q]].v[k];
      n->mark[v] = (uint8_t)(member ? n->mark[v] | MEMBER : n->mark[v] & ~MEMBER);
      if (v == m->n)
        as->outer = true;
      else
        as->tie = as->tie && dyd_vertex_is_point(&pd->sk, v);
    }
}

/* The pairs of members that are not gone, in their order, become those of face g. */
static dyd_status store_rest(dyd_face as, const doubt *d, const dyd_narrowed *n, dyd_delaunay *pd, size_t g) {
  const dyd_vertex_pair *old = pd->open.pair + n->old.first_pair;
  DYD_FREED dyd_vertex_pair *pair = dyd_alloc(d->all, sizeof *pair);
  if (!pair) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < n->old.pairs; q++)
    if (!d->gone[q] && (n->mark[old[q].i] & n->mark[old[q].j] & MEMBER))
      pair[as.pairs++] = (dyd_vertex_pair){old[q].i, old[q].j, 0};
  return table_store(pd, g, as, pair);
}

/* Gives face g, which was a part of the old one or all of it, those of the old pairs that are open still. *closed:
 * done; false where it is as well to find its pairs anew, and nothing is changed. The old face is not in the table. */
static dyd_status narrowed_close(bool *closed, dyd_delaunay *pd, dyd_work *w, const dyd_narrowed *n, size_t g) {
  dyd_face as = {0};
  DYD_SCOPED(doubt) d = {0};
  size_t stored = pd->open.live_pairs;
  dyd_status st = DYD_OK;
  *closed = false;
  if (!n->mark || pd->open.face[g].tris < CROWD || stored > pd->max_pairs || n->old.pairs > pd->max_pairs - stored)
    return DYD_OK;
  mark_members(&as, n, pd, g, true);
  if (!as.tie) st = find_doubts(&d, n, pd);
  *closed = !as.tie && st == DYD_OK && d.pairs <= d.all / SHARE;
  if (*closed) st = settle_doubts(&d, n, w, pd);
  if (*closed && st == DYD_OK) st = store_rest(as, &d, n, pd, g);
  for (size_t k = 0; k < d.vertices; k++) n->mark[d.vertex[k]] &= (uint8_t)~DOUBT;
  mark_members(&as, n, pd, g, false);
  if (*closed) w->counters.faces++;
  return st;
}

/* ---- closing ---- */

typedef struct batch {
  dyd_closure *out;
  const dyd_delaunay *pd;
  size_t first, room;
} batch;

/* Least number of triangles of a face that can be postponed; in the armed build small faces are, too. */
#ifdef DYD_ARMED

enum { MANY_TRIANGLES = 16 };

#else

enum { MANY_TRIANGLES = 64 };

#endif

/* Returns true if all corners of many triangles are points or can be narrowed. Not all are points: no cover walk is
 * needed for those. */
static bool face_is_postponed(const dyd_delaunay *pd, const dyd_face *face) {
  const dyd_delaunay_options *o = &pd->options;
  bool any = false;
  if (!o->narrows || face->tris < MANY_TRIANGLES) return false;
  for (uint32_t q = 0; q < face->tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t v = pd->sk.mesh.tri[pd->open.tri[face->first_tri + q]].v[k];
      if (v == pd->sk.mesh.n || dyd_vertex_is_point(&pd->sk, v)) continue;
      if (!o->narrows(o->narrows_user, pd->sk.reps.site[v])) return false;
      any = true;
    }
  return any;
}

static dyd_status closures_run_one(dyd_closure *out, const dyd_delaunay *pd, dyd_work *w, const dyd_face *face,
                                   size_t room) {
  return dyd_closure_run(out, w, &pd->sk, pd->open.tri + face->first_tri, face->tris, room,
                         face_is_postponed(pd, face));
}

/* Closures of one range; those after a failure stay empty. */
static dyd_status close_range(void *context, dyd_work *w, size_t number, size_t begin, size_t end) {
  const batch *b = context;
  dyd_status st = DYD_OK;
  (void)number;
  for (size_t k = begin; k < end && st == DYD_OK; k++) {
    const dyd_face *f = &b->pd->open.face[b->first + k];
    if (f->proved) continue;
    st = DYD_CANCELLED;
    if (w->run->keep_cut || !dyd_work_cancelled(w)) st = closures_run_one(&b->out[k], b->pd, w, f, b->room);
    w->counters.faces++;
  }
  return st;
}

static dyd_status closures_run(dyd_closure *out, const dyd_delaunay *pd, dyd_work *w, size_t first, size_t count,
                               size_t room) {
  batch b = {out, pd, first, room};
  memset(out, 0, count * sizeof *out);
  dyd_status st = dyd_work_ranges(w, &pd->sk, count, close_range, &b);
  for (size_t k = 0; k < count && st != DYD_OK; k++) dyd_closure_clear(&out[k]);
  return st;
}

static dyd_status store(dyd_delaunay *pd, dyd_work *w, const dyd_closure *c, size_t g) {
  dyd_face as = {.pairs = (uint32_t)c->pairs,
                 .outer = c->outer,
                 .tie = c->all_points,
                 .capped = c->capped,
                 .postponed = c->postponed,
                 .polygon = c->polygon};
  uint64_t pairs = dyd_bytes_times(pd->open.pair_count + as.pairs, sizeof *c->pair);
  if (!dyd_memory_has(&w->memory, pairs / 2 * 3, "the possible pairs")) return DYD_E_NOMEM;
  dyd_status st = table_store(pd, g, as, c->pair);
  if (st == DYD_OK && c->capped) report_cap(w, pd, c->vertex, c->vertices);
  return st;
}

/* Room for pairs now: what the faces stored so far leave. */
static size_t room_left(const dyd_delaunay *pd) {
  return pd->max_pairs > pd->open.live_pairs ? pd->max_pairs - pd->open.live_pairs : 0;
}

/* Closes the faces g .. g + count - 1 together. One that found more pairs than the others have left room for is closed
 * again, with that room. */
static dyd_status close_batch(dyd_closure *c, dyd_delaunay *pd, dyd_work *w, size_t g, size_t count) {
  size_t room = room_left(pd);
  w->memory.held = dyd_delaunay_memory(pd);
  dyd_status st = closures_run(c, pd, w, g, count, room);
  if (st != DYD_OK) return st;
  for (size_t k = 0; k < count; k++) {
    dyd_face *face = &pd->open.face[g + k];
    if (st == DYD_OK && !face->proved && (c[k].capped || c[k].pairs > room_left(pd)) && room_left(pd) < room) {
      dyd_closure_clear(&c[k]);
      st = closures_run_one(&c[k], pd, w, face, room_left(pd));
    }
    if (st == DYD_OK && !face->proved) st = store(pd, w, &c[k], g + k);
    dyd_closure_clear(&c[k]);
  }
  return st;
}

enum { BATCH = 4096 };

static dyd_status close_faces(dyd_delaunay *pd, dyd_work *w, size_t from) {
  size_t end = pd->open.count, most = end - from < BATCH ? end - from : BATCH;
  DYD_FREED dyd_closure *c = dyd_alloc(most, sizeof *c);
  dyd_status st = c ? DYD_OK : DYD_E_NOMEM;
  for (size_t g = from; g < end && st == DYD_OK; g += most)
    st = close_batch(c, pd, w, g, end - g < most ? end - g : most);
  return st;
}

static dyd_status prove_one(dyd_delaunay *pd, dyd_work *w, size_t g) {
  dyd_face as = {0};
  DYD_FREED dyd_vertex_pair *pair = NULL;
  dyd_status st = dyd_prove_face(&as, &pair, pd, w, &pd->open.face[g]);
  return st == DYD_OK && as.proved ? table_store(pd, g, as, pair) : st;
}

/* Faces after those there are, and which of them are proved ties. */
static dyd_status find_and_prove(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count) {
  size_t first = pd->open.count;
  dyd_status st = table_find_faces(pd, w, tri, count);
  for (size_t g = first; g < pd->open.count && st == DYD_OK; g++) st = prove_one(pd, w, g);
  return st == DYD_CANCELLED && w->run->keep_cut ? DYD_OK : st;
}

static void share_out_from(dyd_delaunay *pd, size_t first) {
  for (size_t g = first; g < pd->open.count; g++) table_share_out(pd, (uint32_t)g);
}

dyd_status dyd_faces_find(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count) {
  const dyd_undecided before = pd->open;
  dyd_status st = find_and_prove(pd, w, tri, tri ? count : pd->sk.mesh.count);
  if (st == DYD_OK) st = close_faces(pd, w, before.count);
  if (st == DYD_OK)
    share_out_from(pd, before.count);
  else
    table_roll_back(pd, &before);
  return st;
}

/* ---- replacing one face ---- */

/* Closes the faces from `from` on, the remaining parts of an old one. */
static dyd_status close_parts(dyd_delaunay *pd, dyd_work *w, size_t from, const dyd_narrowed *narrowed) {
  dyd_closure c;
  dyd_status st = DYD_OK;
  for (size_t g = from; g < pd->open.count && st == DYD_OK; g++) {
    bool closed = pd->open.face[g].proved;
    if (!closed) st = narrowed_close(&closed, pd, w, narrowed, g);
    if (!closed && st == DYD_OK) st = close_batch(&c, pd, w, g, 1);
  }
  return st;
}

/* Pairs of the face replaced, which is not in the table, that a face before `fresh` lists, but none of the new ones: by
 * what changed here they may have become legal or impossible. Pairs that have are put into *ended. */
static dyd_status find_ended(dyd_vertex_pair **ended, size_t *count, dyd_delaunay *pd, dyd_work *w, const dyd_face *old,
                             size_t fresh) {
  static const uint32_t no_hint[2] = {DYD_NONE, DYD_NONE};
  const dyd_undecided *f = &pd->open;
  size_t cap = 0;
  dyd_status st = DYD_OK;
  if (f->count == 0 || (old->polygon && f->others == 0)) return st;
  table_star star = {.from = 0, .to = fresh, .self = DYD_NONE, .v = DYD_NONE};
  for (uint32_t q = 0; q < old->pairs && st == DYD_OK; q++) {
    dyd_vertex_pair p = f->pair[old->first_pair + q];
    dyd_face *owner = NULL;
    dyd_cover found = {0};
    if (!table_may_list(&star, pd, p.i)) continue;
    if (!table_listed(&owner, pd, p, 0, fresh) || table_listed(&owner, pd, p, fresh, f->count)) continue;
    if (!dyd_is_legal(&pd->sk, p.i, p.j)) st = dyd_cover_possible(&found, w, &pd->sk, p.i, p.j, no_hint);
    if (st != DYD_OK || found.possible) continue;
    if (!dyd_reserve((void **)ended, &cap, *count + 1, sizeof **ended)) return DYD_E_NOMEM;
    (*ended)[(*count)++] = p;
  }
  return st;
}

/* Takes pairs out of the faces before `fresh`. */
static void delete_ended(dyd_delaunay *pd, const dyd_vertex_pair *ended, size_t count, size_t fresh) {
  for (size_t q = 0; q < count; q++) {
    dyd_face *owner = NULL;
    dyd_vertex_pair *at;
    while ((at = table_listed(&owner, pd, ended[q], 0, fresh))) table_delete(&pd->open, owner, at);
  }
}

dyd_status dyd_faces_end_pairs(dyd_delaunay *pd, dyd_work *w, const dyd_face *old, size_t olds, size_t fresh) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < olds && st == DYD_OK; k++) {
    DYD_FREED dyd_vertex_pair *ended = NULL;
    size_t count = 0;
    st = find_ended(&ended, &count, pd, w, &old[k], fresh);
    if (st == DYD_OK) delete_ended(pd, ended, count, fresh);
  }
  return st;
}

/* All that can fail comes before the first change that cannot be taken back. */
dyd_status dyd_faces_replace(bool *replaced, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count,
                             const dyd_narrowed *narrowed) {
  dyd_undecided *f = &pd->open;
  uint32_t g = f->of[tri[0]];
  dyd_face old = f->face[g];
  dyd_table_take_out(pd, g);
  dyd_undecided before = *f;
  DYD_FREED dyd_vertex_pair *ended = NULL;
  size_t ended_count = 0;
  dyd_status st = find_and_prove(pd, w, tri, count);
  if (st == DYD_OK) st = close_parts(pd, w, before.count, narrowed);
  if (st == DYD_OK) st = find_ended(&ended, &ended_count, pd, w, &old, before.count);
  *replaced = st == DYD_OK;
  if (*replaced) {
    share_out_from(pd, before.count);
    delete_ended(pd, ended, ended_count, before.count);
    dyd_table_compact(f);
  } else {
    table_roll_back(pd, &before);
    table_put_back(pd, &old);
  }
  return st;
}
