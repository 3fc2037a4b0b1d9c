/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* After sites were narrowed: the undecided faces that hold one of them are worked on again, nothing else.
 *
 * Legal edges keep their witnesses and stay; the faces they bound are independent of each other. A face is handled as
 * one step: its new statements replace the old ones only when they are complete. */
#include "delaunay/update.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "delaunay/build.h"
#include "delaunay/faces.h"
#include "delaunay/local_filter.h"
#include "delaunay/splice.h"
#include "legal/certify.h"
#include "legal/witness.h"
#include "skeleton/mesh_invariant.h"

#include <string.h>

/* ---- everything again ---- */

static dyd_status rebuild(dyd_delaunay *pd) {
  dyd_pair_list all = {0};
  dyd_status st = dyd_delaunay_pairs(&all, pd);
  if (st != DYD_OK) return st;
  size_t kept = 0;
  for (size_t q = 0; q < all.count; q++)
    if (all.item[q].status == DYD_LEGAL) all.item[kept++] = all.item[q];
  dyd_delaunay next = {.sites = pd->sites,
                       .n = pd->n,
                       .counters = pd->counters,
                       .options = pd->options,
                       .max_pairs = pd->max_pairs,
                       .err = pd->err};
  st = dyd_build(&next, (dyd_known){all.item, kept});
  if (st == DYD_OK) {
    dyd_build_clear(pd);
    *pd = next;
    pd->mesh.reps = &pd->reps;
    pd->mesh.counters = &pd->counters;
    pd->tree.box = pd->box;
  }
  dyd_pair_list_clear(&all);
  return st;
}

/* ---- what changed ---- */

/* Box, tree and representative of a vertex follow its rectangle. */
static dyd_status refresh(dyd_delaunay *pd, uint32_t v) {
  dyd_sites_get_d(pd->box[v].e, pd->sites, pd->reps.site[v]);
  bool own_number = v < pd->tree.count && pd->tree.item[v] == v; /* no aliases before it */
  dyd_tree_refresh(&pd->tree, own_number ? v : dyd_tree_entry(&pd->tree, v));
  uint32_t k = pd->reps.code && pd->reps.code[v] ? pd->reps.code[v] - 1 : 0;
  return dyd_reps_choose(&pd->reps, v, k);
}

/* One triangle of each face around v that is not listed yet. */
static dyd_status note_faces(uint32_t **seed, size_t *count, size_t *cap, bool *noted, const dyd_delaunay *pd,
                             uint32_t v) {
  uint32_t first = pd->corner[v], h = first;
  do {
    uint32_t f = pd->faces.of[h >> 2];
    if (f != DYD_NONE && !noted[f]) {
      noted[f] = true;
      if (!dyd_reserve((void **)seed, cap, *count + 1, sizeof **seed)) return DYD_E_NOMEM;
      (*seed)[(*count)++] = h >> 2;
    }
    h = dyd_turn(&pd->mesh, h);
  } while (h != first);
  return DYD_OK;
}

static void fetch(const void *address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

/* The sites are anywhere in memory: asks for what the next ones need, one step after the other. */
static void fetch_ahead(const dyd_delaunay *pd, const uint32_t *changed, size_t left) {
  enum { STEP = 6 };
  if (left > 3 * STEP) fetch(&pd->vertex[changed[3 * STEP]]);
  if (left > 2 * STEP) {
    uint32_t v = pd->vertex[changed[2 * STEP]];
    fetch(&pd->corner[v]);
    fetch(&pd->box[v]);
    fetch(&pd->reps.xy[v]);
    dyd_sites_fetch(pd->sites, changed[2 * STEP]);
  }
  if (left > STEP) {
    uint32_t t = pd->corner[pd->vertex[changed[STEP]]] >> 2;
    fetch(&pd->mesh.tri[t]);
    fetch(&pd->faces.of[t]);
  }
}

static dyd_status affected(uint32_t **seed, size_t *seeds, dyd_delaunay *pd, const uint32_t *changed, size_t count) {
  size_t cap = 0;
  bool *noted = calloc(pd->faces.count, sizeof *noted);
  dyd_status st = noted ? DYD_OK : DYD_E_NOMEM;
  for (size_t q = 0; q < count && st == DYD_OK; q++) {
    uint32_t v = pd->vertex[changed[q]];
    fetch_ahead(pd, changed + q, count - q);
    st = refresh(pd, v);
    if (st == DYD_OK) st = note_faces(seed, seeds, &cap, noted, pd, v);
  }
  free(noted);
  return st;
}

/* ---- one face ---- */

#ifdef DYD_ARMED
/* Is the first guess a witness for edge k of t among all sites? Exact; true where memory is exhausted. */
static bool is_witness(const dyd_delaunay *pd, uint32_t t, unsigned k) {
  const uint32_t *v = pd->mesh.tri[t].v;
  dyd_xy guess = dyd_edge_centre(pd, t, k);
  dyd_point c;
  bool good = false;
  dyd_point_init(&c);
  dyd_status st = dyd_dyadic_set_d(&c.x, guess.x);
  if (st == DYD_OK) st = dyd_dyadic_set_d(&c.y, guess.y);
  if (st == DYD_OK) st = dyd_witness_check(&good, pd, v[dyd_next(k)], v[dyd_prev(k)], &c);
  dyd_point_clear(&c);
  return good || st == DYD_E_NOMEM;
}
#endif

/* Decides edge k of t. Most are certain by their first guess; it is looked at nearby first. */
static dyd_status certify(dyd_delaunay *pd, dyd_work *w, uint32_t t, unsigned k) {
  if (pd->options.no_filter || !dyd_filter_local_witness(pd, t, k, dyd_edge_centre(pd, t, k)))
    return dyd_certify_edge(pd, w, t, k);
  DYD_INVARIANT(is_witness(pd, t, k));
  dyd_set_certain(pd, t, k);
  pd->counters.filter++;
  pd->counters.witness_guess++;
  return DYD_OK;
}

static dyd_status certify_inside(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, uint32_t tris) {
  dyd_status st = DYD_OK;
  for (uint32_t q = 0; q < tris && st == DYD_OK; q++) {
    if (dyd_cancelled(pd)) return DYD_CANCELLED;
    for (unsigned k = 0; k < 3 && st == DYD_OK; k++)
      if (pd->mesh.tri[tri[q]].n[k] > 4 * tri[q] + k && !dyd_edge_is_certain(pd, tri[q], k))
        st = certify(pd, w, tri[q], k);
  }
  return st;
}

/* Which edges of the face are certain, to be put back after a failure. */
static void restore(dyd_delaunay *pd, const uint8_t *certain, const uint32_t *tri, uint32_t tris) {
  for (uint32_t q = 0; q < tris; q++) pd->certain[tri[q]] = certain[q];
}

static dyd_status decide(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, uint32_t tris) {
  uint8_t *before = dyd_alloc(tris, 1);
  if (!before) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < tris; q++) before[q] = pd->certain[tri[q]];
  dyd_status st = certify_inside(pd, w, tri, tris);
  bool replaced = false;
  if (st == DYD_OK) st = dyd_faces_replace(&replaced, pd, w, tri, tris);
  if (!replaced) restore(pd, before, tri, tris);
  free(before);
  return st;
}

/* *fits as for dyd_splice_face. */
static dyd_status work_on(bool *fits, dyd_delaunay *pd, dyd_work *w, uint32_t seed) {
  const dyd_face *face = &pd->faces.face[pd->faces.of[seed]];
  uint32_t tris = face->tris, *tri = dyd_alloc(tris, sizeof *tri);
  if (!tri) return DYD_E_NOMEM;
  memcpy(tri, pd->faces.tri + face->first_tri, tris * sizeof *tri);
  dyd_status st = DYD_OK;
  *fits = dyd_splice_is_needless(pd, tri, tris);
  if (!*fits) st = dyd_splice_face(fits, pd, tri, tris);
  if (st == DYD_OK && *fits) st = decide(pd, w, tri, tris);
  free(tri);
  return st;
}

dyd_status dyd_update(dyd_delaunay *pd, const uint32_t *changed, size_t count) {
  if (pd->mesh.collinear) return count ? rebuild(pd) : DYD_OK;
  if (count == 0 || pd->faces.count == 0 || pd->all_points) return DYD_OK;
  uint32_t *seed = NULL;
  size_t seeds = 0;
  bool fits = true;
  dyd_work w;
  dyd_work_init(&w, pd);
  dyd_status st = affected(&seed, &seeds, pd, changed, count);
  dyd_mesh_follow(&pd->mesh);
  for (size_t q = 0; q < seeds && st == DYD_OK && fits; q++) {
    st = dyd_cancelled(pd) ? DYD_CANCELLED : work_on(&fits, pd, &w, seed[q]);
  }
  dyd_work_clear(&w);
  free(seed);
  if (st == DYD_OK && !fits) return rebuild(pd);
  if (st == DYD_OK) DYD_INVARIANT(dyd_mesh_check(&pd->mesh));
  return st;
}
