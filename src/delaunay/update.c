/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* After sites were narrowed: the undecided faces that hold one of them are worked on again, nothing else.
 *
 * Legal edges keep their witnesses and stay; the faces they bound are independent of each other. A face is handled as
 * one step: its new statements replace the old ones only when they are complete. */

#include "delaunay/update.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "base/prefetch.h"
#include "delaunay/build.h"
#include "delaunay/faces.h"
#include "delaunay/local_filter.h"
#include "delaunay/memory.h"
#include "delaunay/splice.h"
#include "legal/certify.h"
#include "legal/witness.h"
#include "skeleton/centre_filter.h"
#include "skeleton/circumcentre.h"
#include "skeleton/mesh_invariant.h"
#include "skeleton/mesh_start.h"

#include <string.h>

/* ---- everything again ---- */

/* What stays beside the new one while it is made: all there is, and the list of its legal pairs. */
static uint64_t rebuild_bytes(const dyd_delaunay *pd) {
  return dyd_bytes_add(dyd_delaunay_memory(pd), dyd_pairs_bytes(pd, DYD_LEGAL));
}

static dyd_status rebuild(dyd_delaunay *pd, dyd_error *err) {
  dyd_pair_list all = {0};
  if (pd->room.most) pd->room.beside = rebuild_bytes(pd);
  if (!dyd_room_has(&pd->room, dyd_skeleton_bytes(pd->sk.rects.sites), "the triangulation made anew"))
    return DYD_E_NOMEM;
  dyd_status st = dyd_pairs_list(&all, pd, DYD_LEGAL);
  if (st != DYD_OK) return st;
  dyd_delaunay next = {.counters = pd->counters, .options = pd->options, .max_pairs = pd->max_pairs, .room = pd->room};
  next.room.held = 0;
  st = dyd_build(&next, pd->sk.rects.sites, (dyd_known){all.item, all.count}, err);
  pd->room = next.room;
  if (st == DYD_OK) {
    dyd_build_clear(pd);
    *pd = next;
    dyd_skeleton_moved(&pd->sk);
  }
  dyd_pair_list_clear(&all);
  return st;
}

/* ---- what changed ---- */

/* One triangle of each face around v that is not listed yet. */
static dyd_status note_faces(uint32_t **seed, size_t *count, size_t *cap, bool *noted, const dyd_delaunay *pd,
                             uint32_t v) {
  dyd_half_edge first = pd->sk.leaving[v], h = first;
  do {
    uint32_t t = dyd_edge_triangle(h), f = pd->open.of[t];
    if (f != DYD_NONE && !noted[f]) {
      noted[f] = true;
      if (!dyd_reserve((void **)seed, cap, *count + 1, sizeof **seed)) return DYD_E_NOMEM;
      (*seed)[(*count)++] = t;
    }
    h = dyd_edge_turn(&pd->sk.mesh, h);
  } while (h != first);
  return DYD_OK;
}

/* The sites are anywhere in memory: asks for what the next ones need, one step after the other. */
static void fetch_ahead(const dyd_delaunay *pd, const uint32_t *changed, size_t left) {
  enum { STEP = 6 };
  const dyd_skeleton *sk = &pd->sk;
  if (left > 3 * STEP) dyd_prefetch(&sk->vertex[changed[3 * STEP]]);
  if (left > 2 * STEP) {
    uint32_t v = sk->vertex[changed[2 * STEP]];
    dyd_prefetch(&sk->leaving[v]);
    dyd_prefetch(&sk->rects.box[v]);
    dyd_prefetch(&sk->reps.xy[v]);
    dyd_sites_fetch(sk->rects.sites, changed[2 * STEP]);
  }
  if (left > STEP) {
    uint32_t t = dyd_edge_triangle(sk->leaving[sk->vertex[changed[STEP]]]);
    dyd_prefetch(&sk->mesh.tri[t]);
    dyd_prefetch(&pd->open.of[t]);
  }
}

static dyd_status affected(uint32_t **seed, size_t *seeds, dyd_delaunay *pd, const uint32_t *changed, size_t count) {
  size_t cap = 0;
  bool *noted = calloc(pd->open.count, sizeof *noted);
  dyd_status st = noted ? DYD_OK : DYD_E_NOMEM;
  for (size_t q = 0; q < count && st == DYD_OK; q++) {
    uint32_t v = pd->sk.vertex[changed[q]];
    fetch_ahead(pd, changed + q, count - q);
    st = dyd_skeleton_refresh(&pd->sk, v);
    if (st == DYD_OK) st = note_faces(seed, seeds, &cap, noted, pd, v);
  }
  free(noted);
  return st;
}

/* ---- one face ---- */

#ifdef DYD_ARMED
/* Is the first guess a witness for an edge among all sites? Exact. */
static bool guess_is_witness(dyd_work *w, const dyd_skeleton *sk, dyd_half_edge h) {
  dyd_point c;
  dyd_point_init(&c);
  dyd_point_set_xy(&c, dyd_edge_centre(sk, h));
  bool good = dyd_witness_check(w, sk, dyd_edge_origin(&sk->mesh, h), dyd_edge_target(&sk->mesh, h), &c);
  dyd_point_clear(&c);
  return good;
}
#endif

/* Most edges are certain by their first guess; it is looked at nearby first. */
static dyd_status recertify(dyd_delaunay *pd, dyd_work *w, dyd_half_edge h) {
  if (pd->sk.mesh.no_filter || !dyd_filter_local_witness(pd, h, dyd_edge_centre(&pd->sk, h)))
    return dyd_certify_edge(&pd->sk, w, h);
  DYD_INVARIANT(guess_is_witness(w, &pd->sk, h));
  dyd_set_certain(&pd->sk, h, true);
  w->counters.filter++;
  w->counters.witness_guess++;
  return DYD_OK;
}

static dyd_status recertify_inside(dyd_narrowed *narrowed, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri,
                                   uint32_t tris) {
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_status st = DYD_OK;
  for (uint32_t q = 0; q < tris && st == DYD_OK; q++) {
    if (dyd_work_cancelled(w)) return DYD_CANCELLED;
    for (dyd_half_edge h = dyd_edge_of(tri[q], 0); h < dyd_edge_end(tri[q]) && st == DYD_OK; h++) {
      if (!dyd_edge_is_first(m, h) || dyd_edge_is_certain(&pd->sk, h) || !dyd_narrowed_reaches(narrowed, m, h))
        continue;
      st = recertify(pd, w, h);
      narrowed->certain = narrowed->certain || dyd_edge_is_certain(&pd->sk, h);
    }
  }
  return st;
}

/* Which edges of the face are certain, to be put back after a failure. */
static void restore_certain(dyd_delaunay *pd, const uint8_t *certain, const uint32_t *tri, uint32_t tris) {
  for (uint32_t q = 0; q < tris; q++) pd->sk.certain[tri[q]] = certain[q];
}

static dyd_status redo_face(dyd_delaunay *pd, dyd_work *w, dyd_narrowed *narrowed, const uint32_t *tri, uint32_t tris) {
  uint8_t *before = dyd_alloc(tris, 1);
  if (!before) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < tris; q++) before[q] = pd->sk.certain[tri[q]];
  dyd_status st = recertify_inside(narrowed, pd, w, tri, tris);
  bool replaced = false;
  if (st == DYD_OK) st = dyd_faces_replace(&replaced, pd, w, tri, tris, narrowed);
  if (!replaced) restore_certain(pd, before, tri, tris);
  free(before);
  return st;
}

/* New triangles where they are needed; *fits as for dyd_splice_face. */
static dyd_status retriangulate(bool *fits, dyd_delaunay *pd, dyd_work *w, const dyd_narrowed *narrowed,
                                const uint32_t *tri, uint32_t tris) {
  dyd_status st = DYD_OK;
  *fits = false;
  if (narrowed->mark) st = dyd_splice_near(fits, pd, w, tri, tris, narrowed->vertex, narrowed->count);
  if (st != DYD_OK || *fits) return st;
  *fits = dyd_splice_is_needless(w, &pd->sk, tri, tris);
  return *fits ? DYD_OK : dyd_splice_face(fits, pd, w, tri, tris);
}

/* *fits as for dyd_splice_face. */
static dyd_status work_on(bool *fits, dyd_delaunay *pd, dyd_work *w, uint32_t seed, const uint32_t *changed,
                          size_t count) {
  dyd_narrowed narrowed;
  const dyd_face *face = &pd->open.face[pd->open.of[seed]];
  uint32_t tris = face->tris, *tri = dyd_alloc(tris, sizeof *tri);
  if (!tri) return DYD_E_NOMEM;
  memcpy(tri, pd->open.tri + face->first_tri, tris * sizeof *tri);
  dyd_status st = dyd_narrowed_init(&narrowed, pd, pd->open.of[seed], changed, count);
  if (st == DYD_OK) st = retriangulate(fits, pd, w, &narrowed, tri, tris);
  if (st == DYD_OK && *fits) st = redo_face(pd, w, &narrowed, tri, tris);
  dyd_narrowed_clear(&narrowed);
  free(tri);
  return st;
}

static dyd_status update_faces(bool *fits, dyd_delaunay *pd, dyd_work *w, const uint32_t *changed, size_t count) {
  uint32_t *seed = NULL;
  size_t seeds = 0;
  dyd_status st = affected(&seed, &seeds, pd, changed, count);
  dyd_mesh_follow(&pd->sk.mesh);
  for (size_t q = 0; q < seeds && st == DYD_OK && *fits; q++)
    st = dyd_work_cancelled(w) ? DYD_CANCELLED : work_on(fits, pd, w, seed[q], changed, count);
  free(seed);
  return st;
}

dyd_status dyd_update(dyd_delaunay *pd, const uint32_t *changed, size_t count, dyd_error *err) {
  if (pd->joins != pd->sk.rects.sites->joins) return rebuild(pd, err);
  if (pd->open.kind == DYD_LINE) return count ? rebuild(pd, err) : DYD_OK;
  if (count == 0 || pd->open.count == 0 || pd->open.kind == DYD_TIED) return DYD_OK;
  bool fits = true;
  dyd_work w;
  dyd_work_init(&w, &pd->sk, pd->options.cancel);
  w.threads = pd->options.threads;
  w.err = err;
  w.room = pd->room;
  w.room.held = dyd_delaunay_memory(pd);
  dyd_status st = update_faces(&fits, pd, &w, changed, count);
  dyd_room_join(&pd->room, &w.room);
  dyd_work_count(&pd->counters, &w, &pd->sk);
  dyd_work_clear(&w);
  if (st == DYD_OK && !fits) return rebuild(pd, err);
  if (st == DYD_OK) DYD_INVARIANT(dyd_mesh_is_valid(&pd->sk.mesh));
  return st;
}
