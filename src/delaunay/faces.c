/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Flooding the skeleton over uncertain edges, and closing what is found. */
#include "delaunay/faces.h"

#include "base/alloc.h"
#include "delaunay/closures.h"
#include "delaunay/face_table.h"
#include "delaunay/proved.h"
#include "legal/certify.h"
#include "possible/cover.h"

#include <string.h>

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
      if (!dyd_edge_is_certain(sk, h) && dyd_point_edge_is_certain(w, sk, h)) {
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
  dyd_table_take_back(pd, first);
  dyd_status st = DYD_OK;
  for (size_t q = 0; q < tris && st == DYD_OK; q++) {
    if (dyd_triangle_is_certain(&pd->sk, tri[q]) || f->of[tri[q]] != DYD_NONE) continue;
    size_t start = f->tri_count;
    st = dyd_table_flood(pd, tri[q], (uint32_t)f->count);
    if (st == DYD_OK) st = dyd_table_add(pd, start);
  }
  free(tri);
  return st;
}

static dyd_status find_face(dyd_delaunay *pd, dyd_work *w, uint32_t t) {
  dyd_undecided *f = &pd->open;
  size_t first = f->tri_count;
  bool apart = false;
  dyd_status st = dyd_table_flood(pd, t, (uint32_t)f->count);
  if (st == DYD_OK) settle_points(&apart, &pd->sk, w, f->tri + first, f->tri_count - first);
  if (st == DYD_OK && apart) return find_parts(pd, first);
  return st == DYD_OK ? dyd_table_add(pd, first) : st;
}

/* For marks, and for triangles in faces of several each. */
static bool table_has_room(const dyd_delaunay *pd, dyd_work *w) {
  enum { A_FACE = 4 };
  uint64_t each = sizeof *pd->open.of + sizeof *pd->open.tri + sizeof *pd->open.face / A_FACE;
  w->room.held = dyd_delaunay_memory(pd);
  return dyd_room_has(&w->room, pd->sk.mesh.count * each, "the undecided faces");
}

static dyd_status find_faces(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t all) {
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

/* ---- closing ---- */

static dyd_status store(dyd_delaunay *pd, dyd_work *w, const dyd_closure *c, size_t g) {
  dyd_face as = {.pairs = (uint32_t)c->pairs,
                 .outer = c->outer,
                 .tie = c->all_points,
                 .capped = c->capped,
                 .postponed = c->postponed,
                 .polygon = c->polygon};
  uint64_t pairs = dyd_bytes_times(pd->open.pair_count + as.pairs, sizeof *c->pair);
  if (!dyd_room_has(&w->room, pairs / 2 * 3, "the possible pairs")) return DYD_E_NOMEM;
  dyd_status st = dyd_table_store(pd, g, as, c->pair);
  if (st == DYD_OK && c->capped) dyd_report_cap(w, pd, c->vertex, c->vertices);
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
  w->room.held = dyd_delaunay_memory(pd);
  dyd_status st = dyd_closures_run(c, pd, w, g, count, room);
  if (st != DYD_OK) return st;
  for (size_t k = 0; k < count; k++) {
    dyd_face *face = &pd->open.face[g + k];
    if (st == DYD_OK && !face->proved && (c[k].capped || c[k].pairs > room_left(pd)) && room_left(pd) < room) {
      dyd_closure_clear(&c[k]);
      st = dyd_closures_run_one(&c[k], pd, w, face, room_left(pd));
    }
    if (st == DYD_OK && !face->proved) st = store(pd, w, &c[k], g + k);
    dyd_closure_clear(&c[k]);
  }
  return st;
}

enum { BATCH = 4096 };

static dyd_status close_faces(dyd_delaunay *pd, dyd_work *w, size_t from) {
  size_t end = pd->open.count, most = end - from < BATCH ? end - from : BATCH;
  dyd_closure *c = dyd_alloc(most, sizeof *c);
  dyd_status st = c ? DYD_OK : DYD_E_NOMEM;
  for (size_t g = from; g < end && st == DYD_OK; g += most)
    st = close_batch(c, pd, w, g, end - g < most ? end - g : most);
  free(c);
  return st;
}

/* The faces from `from` on are what is left of an old one. */
static dyd_status close_parts(dyd_delaunay *pd, dyd_work *w, size_t from, const dyd_narrowed *narrowed) {
  dyd_closure c;
  dyd_status st = DYD_OK;
  for (size_t g = from; g < pd->open.count && st == DYD_OK; g++) {
    bool closed = pd->open.face[g].proved;
    if (!closed) st = dyd_narrowed_close(&closed, pd, w, narrowed, g);
    if (!closed && st == DYD_OK) st = close_batch(&c, pd, w, g, 1);
  }
  return st;
}

/* narrowed: NULL unless they are what is left of an old face. */
static dyd_status find_and_close(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count,
                                 const dyd_narrowed *narrowed) {
  dyd_undecided before = pd->open;
  dyd_status st = find_faces(pd, w, tri, tri ? count : pd->sk.mesh.count);
  for (size_t g = before.count; g < pd->open.count && st == DYD_OK; g++) st = dyd_prove_face(pd, w, g);
  if (st == DYD_CANCELLED && w->keep_cut) st = DYD_OK;
  if (st == DYD_OK) st = narrowed ? close_parts(pd, w, before.count, narrowed) : close_faces(pd, w, before.count);
  if (st != DYD_OK) dyd_table_roll_back(pd, &before);
  return st;
}

static void share_out_from(dyd_delaunay *pd, size_t first) {
  for (size_t g = first; g < pd->open.count; g++) dyd_table_share_out(pd, (uint32_t)g);
}

dyd_status dyd_faces_find(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count) {
  size_t first = pd->open.count;
  dyd_status st = find_and_close(pd, w, tri, count, NULL);
  if (st == DYD_OK) share_out_from(pd, first);
  return st;
}

/* ---- replacing one face ---- */

/* Pairs of the face replaced, which is not in the table, that a face before `fresh` lists, but none of the new ones: by
 * what changed here they may have become legal or impossible. Those that have are put into *ended. */
static dyd_status find_ended(dyd_vertex_pair **ended, size_t *count, dyd_delaunay *pd, dyd_work *w, const dyd_face *old,
                             size_t fresh) {
  static const uint32_t no_hint[2] = {DYD_NONE, DYD_NONE};
  const dyd_undecided *f = &pd->open;
  size_t cap = 0;
  dyd_status st = DYD_OK;
  if (f->count == 0 || (old->polygon && f->others == 0)) return st;
  dyd_table_star star = {.from = 0, .to = fresh, .self = DYD_NONE, .v = DYD_NONE};
  for (uint32_t q = 0; q < old->pairs && st == DYD_OK; q++) {
    dyd_vertex_pair p = f->pair[old->first_pair + q];
    dyd_face *owner = NULL;
    bool possible = false;
    if (!dyd_table_may_list(&star, pd, p.i)) continue;
    if (!dyd_table_listed(&owner, pd, p, 0, fresh) || dyd_table_listed(&owner, pd, p, fresh, f->count)) continue;
    if (!dyd_is_legal(&pd->sk, p.i, p.j)) st = dyd_cover_possible(&possible, w, &pd->sk, p.i, p.j, no_hint);
    if (st != DYD_OK || possible) continue;
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
    while ((at = dyd_table_listed(&owner, pd, ended[q], 0, fresh))) dyd_table_delete(&pd->open, owner, at);
  }
}

/* All that can fail comes before the first change that cannot be taken back. */
dyd_status dyd_faces_replace(bool *replaced, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count,
                             const dyd_narrowed *narrowed) {
  dyd_undecided *f = &pd->open;
  uint32_t g = f->of[tri[0]];
  dyd_face old = f->face[g];
  dyd_table_take_out(pd, g);
  dyd_undecided before = *f;
  dyd_vertex_pair *ended = NULL;
  size_t ended_count = 0;
  dyd_status st = find_and_close(pd, w, tri, count, narrowed);
  if (st == DYD_OK) {
    st = find_ended(&ended, &ended_count, pd, w, &old, before.count);
    if (st != DYD_OK) dyd_table_roll_back(pd, &before);
  }
  *replaced = st == DYD_OK;
  if (*replaced) {
    share_out_from(pd, before.count);
    delete_ended(pd, ended, ended_count, before.count);
    dyd_table_compact(f);
  } else {
    dyd_table_put_back(pd, &old);
  }
  free(ended);
  return st;
}
