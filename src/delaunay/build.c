/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From sites to statuses: skeleton, certain edges, undecided faces. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/float_filter.h"
#include "base/invariant.h"
#include "base/local.h"
#include "delaunay/extend.h"
#include "delaunay/faces.h"
#include "delaunay/local_filter.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "delaunay/ties.h"
#include "legal/certify.h"
#include "legal/witness.h"
#include "skeleton/centre_filter.h"
#include "skeleton/mesh_build.h"
#include "skeleton/mesh_filter.h"
#include "skeleton/work.h"

#include <dyadel/delaunay.h>
#include <string.h>

/* ---- building ---- */

/* Legal pairs known from before, as sites; they are in every skeleton and stay legal. */
typedef struct dyd_known {
  const dyd_pair *pair;
  size_t count;
} dyd_known;

static void build_clear(dyd_delaunay *pd) {
  dyd_table_clear(&pd->open);
  dyd_skeleton_clear(&pd->sk);
}

static dyd_status build_statuses(dyd_delaunay *pd, dyd_work *w, dyd_known known) {
  if (pd->open.kind == DYD_LINE) return dyd_line_find(pd, w);
  bool tied = pd->open.kind == DYD_TIED;
  dyd_skeleton *sk = &pd->sk;
  dyd_status st = tied ? dyd_certify_points(sk, w) : dyd_certify_all(sk, w);
  for (size_t q = 0; q < known.count; q++) {
    uint32_t i = sk->vertex[known.pair[q].i], j = sk->vertex[known.pair[q].j];
    dyd_half_edge h = i == j ? DYD_NONE : dyd_find_edge(sk, i, j);
    if (h != DYD_NONE) dyd_set_certain(sk, h, true);
  }
  if (st != DYD_OK) return st;
  return tied ? dyd_ties_find(pd, w) : dyd_faces_find(pd, w, NULL, 0);
}

/* Fills an object that has only options and counters. err may be NULL. On failure it is cleared back to that. */
static dyd_status dyd_build(dyd_delaunay *pd, const dyd_sites *sites, dyd_known known, dyd_error *err) {
  const dyd_skeleton_options o = {pd->options.no_filter, pd->options.threads, pd->options.cancel};
  if (!dyd_memory_has(&pd->memory, dyd_skeleton_bytes(sites), "the triangulation")) return DYD_E_NOMEM;
  dyd_status st = dyd_skeleton_build(&pd->sk, sites, &o);
  if (st != DYD_OK) return st;
  pd->joins = sites->joins;
  const dyd_run run = {
      .cancel = o.cancel, .threads = o.threads, .keep_cut = pd->options.keep_cut, .err = err, .decider = pd->decider};
  dyd_work w;
  dyd_work_init(&w, &pd->sk, &run);
  w.memory = pd->memory;
  w.tally = pd->sk.mesh.tally;
  pd->open.kind = pd->sk.mesh.collinear ? DYD_LINE : pd->sk.all_points ? DYD_TIED : DYD_LISTED;
  st = build_statuses(pd, &w, known);
  dyd_work_count(&pd->counters, &w, &pd->sk);
  dyd_memory_join(&pd->memory, &w.memory);
  dyd_work_clear(&w);
  if (st != DYD_OK)
    build_clear(pd);
  else
    dyd_mesh_trim(&pd->sk.mesh);
  return st;
}

/* ---- new triangles for one face ----
 *
 * The certain edges around (and inside) a face are edges of every skeleton, so they are edges of the Delaunay
 * triangulation of the face's vertices alone, and inside them both triangulations agree: an empty circle of the part,
 * seen from inside the face, is cut off from all other vertices by legal edges [LOC-1]. So the face is triangulated by
 * itself and put back into the same places; the number of triangles of a face is fixed by Euler's formula. */

/* An edge around the spliced triangles, seen from inside, from a to b with the inside on its left: a certain edge, or
 * one of a triangle that stays. Vertices of the whole mesh. */
typedef struct rim_edge {
  uint32_t a, b;
  bool certain;
  dyd_half_edge beyond; /* on the other side; DYD_NONE if that is inside, too */
  dyd_half_edge inside; /* the same in the part's mesh */
  dyd_half_edge placed; /* the same in the whole mesh afterwards */
} rim_edge;

/* Instead of their face, at triangles that are spliced. */
#define SPLICED (DYD_NONE - 1)

/* place[t]: slot of the part's triangle t in tri[], DYD_NONE if outside the face. taken: triangles of the face found so
 * far. */
typedef struct spliced_part {
  dyd_delaunay *pd;
  dyd_work *w;
  const uint32_t *tri;
  uint32_t tris;
  rim_edge *rims;
  size_t rim_count, rim_cap;
  uint32_t *vertex; /* of the part, ascending among points and among the rest */
  uint32_t vertices;
  dyd_mesh mesh;
  dyd_half_edge *leaving;
  uint32_t *place, *queue;
  uint32_t taken;
  uint32_t *sorted, *local; /* vertices ascending, and their numbers in the part */
} spliced_part;

static int compare_rim(const void *a, const void *b) {
  const rim_edge *x = a, *y = b;
  if (x->a != y->a) return x->a < y->a ? -1 : 1;
  return (x->b > y->b) - (x->b < y->b);
}

static rim_edge *find_rim(const spliced_part *p, uint32_t a, uint32_t b) {
  rim_edge key = {.a = a, .b = b};
  return p->rim_count ? bsearch(&key, p->rims, p->rim_count, sizeof key, compare_rim) : NULL;
}

/* ---- what the face looks like ---- */

static dyd_status gather_rims(spliced_part *p) {
  const dyd_skeleton *sk = &p->pd->sk;
  uint32_t face = dyd_face_of(p->pd, p->tri[0]);
  for (uint32_t q = 0; q < p->tris; q++)
    for (dyd_half_edge h = dyd_edge_of(p->tri[q], 0); h < dyd_edge_end(p->tri[q]); h++) {
      dyd_half_edge beyond = dyd_edge_twin(&sk->mesh, h);
      bool certain = dyd_edge_is_certain(sk, h), same = dyd_face_of(p->pd, dyd_edge_triangle(beyond)) == face;
      if (same && !certain) continue;
      if (!DYD_GROW(p->rims, p->rim_cap, p->rim_count + 1)) return DYD_E_NOMEM;
      p->rims[p->rim_count++] = (rim_edge){dyd_edge_origin(&sk->mesh, h),
                                           dyd_edge_target(&sk->mesh, h),
                                           certain,
                                           same ? DYD_NONE : beyond,
                                           DYD_NONE,
                                           DYD_NONE};
    }
  if (p->rim_count) qsort(p->rims, p->rim_count, sizeof *p->rims, compare_rim);
  return DYD_OK;
}

/* The face's vertices, and those just beyond its rim, so that the part is never collinear. */
static dyd_status gather_vertices(spliced_part *p) {
  const dyd_mesh *m = &p->pd->sk.mesh;
  size_t room = 3 * (size_t)p->tris + p->rim_count;
  uint32_t count = 0;
  if (!DYD_NEW(p->vertex, room) || !DYD_NEW(p->sorted, room) || !DYD_NEW(p->local, room)) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < p->tris; q++)
    for (int k = 0; k < 3; k++) p->sorted[count++] = m->tri[p->tri[q]].v[k];
  for (size_t q = 0; q < p->rim_count; q++)
    if (p->rims[q].beyond != DYD_NONE) p->sorted[count++] = dyd_edge_apex(m, p->rims[q].beyond);
  qsort(p->sorted, count, sizeof *p->sorted, dyd_compare_index);
  for (uint32_t q = 0; q < count; q++) {
    uint32_t v = p->sorted[q];
    if (v != m->n && (p->vertices == 0 || p->sorted[p->vertices - 1] != v)) p->sorted[p->vertices++] = v;
  }
  uint32_t next = 0;
  for (int fat = 0; fat < 2; fat++) /* exact points first, as in the whole */
    for (uint32_t q = 0; q < p->vertices; q++)
      if (dyd_vertex_is_point(&p->pd->sk, p->sorted[q]) == !fat) {
        p->local[q] = next;
        p->vertex[next++] = p->sorted[q];
      }
  return DYD_OK;
}

static uint32_t to_local(const spliced_part *p, uint32_t v) {
  if (v == p->pd->sk.mesh.n) return p->mesh.n;
  const uint32_t *at = bsearch(&v, p->sorted, p->vertices, sizeof v, dyd_compare_index);
  return p->local[at - p->sorted];
}

static uint32_t to_whole(const spliced_part *p, uint32_t v) {
  return v == p->mesh.n ? p->pd->sk.mesh.n : p->vertex[v];
}

/* ---- the part's own skeleton ---- */

static dyd_status part_triangulate(spliced_part *p) {
  dyd_skeleton *sk = &p->pd->sk;
  dyd_status st = dyd_mesh_build(&p->mesh, &sk->reps, p->vertex, p->vertices, sk->mesh.no_filter, p->w->run->cancel);
  if (st != DYD_OK) return st;
  dyd_tally_join(&p->w->tally, &p->mesh.tally);
  if (!DYD_NEW(p->leaving, (size_t)p->vertices + 1) || !DYD_NEW(p->place, p->mesh.count) || !DYD_NEW(p->queue, p->tris))
    return DYD_E_NOMEM;
  for (uint32_t t = 0; t < p->mesh.count; t++) {
    p->place[t] = DYD_NONE;
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++) p->leaving[dyd_edge_origin(&p->mesh, h)] = h;
  }
  return DYD_OK;
}

/* The half-edge from a to b of the part, or DYD_NONE. */
static dyd_half_edge part_find_edge(const spliced_part *p, uint32_t a, uint32_t b) {
  dyd_half_edge first = p->leaving[a], h = first;
  while (dyd_edge_target(&p->mesh, h) != b) {
    h = dyd_edge_turn(&p->mesh, h);
    if (h == first) return DYD_NONE;
  }
  return h;
}

/* Gives the part's triangle t the next slot; false when the face is full. */
static bool part_take(spliced_part *p, uint32_t t) {
  if (p->place[t] != DYD_NONE) return true;
  if (p->taken == p->tris) return false;
  p->queue[p->taken] = t;
  p->place[t] = p->tri[p->taken++];
  return true;
}

static rim_edge *rim_of(const spliced_part *p, dyd_half_edge h) {
  return find_rim(p, to_whole(p, dyd_edge_origin(&p->mesh, h)), to_whole(p, dyd_edge_target(&p->mesh, h)));
}

/* Finds the triangles inside the rim; false if they do not fill the face. */
static bool part_flood(spliced_part *p) {
  for (size_t q = 0; q < p->rim_count; q++) {
    rim_edge *r = &p->rims[q];
    r->inside = part_find_edge(p, to_local(p, r->a), to_local(p, r->b));
    if (r->inside == DYD_NONE || !part_take(p, dyd_edge_triangle(r->inside))) return false;
  }
  if (p->rim_count == 0) /* the face is the whole plane */
    for (uint32_t t = 0; t < p->mesh.count; t++)
      if (!part_take(p, t)) return false;
  for (uint32_t q = 0; q < p->taken; q++)
    for (dyd_half_edge h = dyd_edge_of(p->queue[q], 0), end = dyd_edge_end(p->queue[q]); h < end; h++)
      if (!rim_of(p, h) && !part_take(p, dyd_edge_triangle(dyd_edge_twin(&p->mesh, h)))) return false;
  return p->taken == p->tris;
}

/* ---- back into the whole ---- */

static void put_triangle(spliced_part *p, uint32_t t) {
  dyd_skeleton *sk = &p->pd->sk;
  uint32_t slot = p->place[t];
  dyd_tri *to = &sk->mesh.tri[slot];
  const dyd_tri *from = &p->mesh.tri[t];
  sk->certain[slot] = 0;
  for (unsigned k = 0; k < 3; k++) {
    rim_edge *r = rim_of(p, dyd_edge_of(t, k));
    to->v[k] = to_whole(p, from->v[k]);
    if (to->v[k] != sk->mesh.n) sk->leaving[to->v[k]] = dyd_edge_of(slot, dyd_prev(k));
    if (r) {
      r->placed = dyd_edge_of(slot, k);
      sk->certain[slot] |= (uint8_t)(r->certain << k);
    } else {
      to->n[k] = dyd_edge_of(p->place[dyd_edge_triangle(from->n[k])], dyd_edge_corner(from->n[k]));
    }
  }
}

static void link_rims(spliced_part *p) {
  for (size_t q = 0; q < p->rim_count; q++) {
    const rim_edge *r = &p->rims[q];
    dyd_edge_join(&p->pd->sk.mesh, r->placed, r->beyond != DYD_NONE ? r->beyond : find_rim(p, r->b, r->a)->placed);
  }
}

static void spliced_part_clear(spliced_part *p) {
  dyd_mesh_clear(&p->mesh);
  dyd_free_all(p->rims, p->vertex, p->sorted, p->local, p->leaving, p->place, p->queue);
}

static bool triangle_stands(dyd_work *w, const dyd_skeleton *sk, uint32_t t) {
  const dyd_mesh *m = &sk->mesh;
  const uint32_t *v = m->tri[t].v;
  if (dyd_is_ghost_triangle(m, t) || dyd_mesh_orient(&w->tally, m, v[0], v[1], v[2]) <= 0) return false;
  for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++) {
    uint32_t across = dyd_edge_across(m, h);
    if (dyd_edge_is_certain(sk, h) || !dyd_edge_is_first(m, h)) continue;
    if (across == m->n || dyd_mesh_incircle(&w->tally, m, v[0], v[1], v[2], across) > 0) return false;
  }
  return true;
}

/* Returns true if the triangles of the face are Delaunay for the present representatives as they are, so that it may
 * stay [LOC-2]. Exact for bounded faces; false for others. */
static bool splice_is_needless(dyd_work *w, const dyd_skeleton *sk, const uint32_t *tri, uint32_t tris) {
  for (uint32_t q = 0; q < tris; q++)
    if (!triangle_stands(w, sk, tri[q])) return false;
  return true;
}

/* Replaces the triangles tri[0..tris-1], a whole undecided face or all of one that is not Delaunay any more, by the
 * skeleton of the present representatives. Edges inside become uncertain; the marks of the face table are not touched.
 * moved: a representative may be moved so that it differs from another one. *fits: false if they cannot be treated
 * alone (two sites have become the same exact point, or more has to change); nothing is changed then, nor on failure.
 */
static dyd_status splice(bool *fits, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, uint32_t tris, bool moved) {
  DYD_SCOPED(spliced_part) p = {.pd = pd, .w = w, .tri = tri, .tris = tris};
  dyd_status st = gather_rims(&p);
  if (st == DYD_OK) st = gather_vertices(&p);
  if (st == DYD_OK) st = part_triangulate(&p);
  *fits = st == DYD_OK && !p.mesh.alias && !p.mesh.collinear && (moved || !p.mesh.moved) && part_flood(&p);
  if (*fits) {
    for (uint32_t q = 0; q < p.taken; q++) put_triangle(&p, p.queue[q]);
    link_rims(&p);
  }
  return st;
}

/* ---- a few vertices ---- */

/* Returns true if one of the vertices is a corner of t, or in or on its circle. */
static bool is_upset(dyd_work *w, const dyd_mesh *m, uint32_t t, const uint32_t *vertex, uint32_t count) {
  const uint32_t *v = m->tri[t].v;
  bool corner = false, inside = false;
  for (uint32_t q = 0; q < count; q++) corner = corner || v[0] == vertex[q] || v[1] == vertex[q] || v[2] == vertex[q];
  for (uint32_t q = 0; q < count && !corner && !inside; q++)
    inside = dyd_mesh_incircle(&w->tally, m, v[0], v[1], v[2], vertex[q]) >= 0;
  return corner || inside;
}

static void mark_upset(dyd_delaunay *pd, const uint32_t *tri, uint32_t tris, uint32_t face) {
  for (uint32_t q = 0; q < tris; q++) pd->open.of[tri[q]] = face;
}

/* The same where only a few of the face's vertices, those listed, have new representatives: triangles that are not at
 * them and have none of them in their circle stay [LOC-4]. *fits is false also if more has to change; nothing is
 * changed then. */
static dyd_status splice_near(bool *fits, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, uint32_t tris,
                              const uint32_t *vertex, uint32_t count) {
  uint32_t face = dyd_face_of(pd, tri[0]), upset = 0;
  DYD_FREED uint32_t *list = dyd_alloc(tris, sizeof *list);
  if (!list) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < tris; q++)
    if (is_upset(w, &pd->sk.mesh, tri[q], vertex, count)) list[upset++] = tri[q];
  mark_upset(pd, list, upset, SPLICED);
  dyd_status st = splice(fits, pd, w, list, upset, false);
  mark_upset(pd, list, upset, face);
  return st;
}

/* ---- bringing up to date ---- */

/* After sites were narrowed: the undecided faces that hold one of them are worked on again, nothing else.
 *
 * Legal edges keep their witnesses and stay; the faces they bound are independent of each other. A face is handled as
 * one step: its new statements replace the old ones only when they are complete. */

/* Bytes held next to the new triangulation while it is built: all of the old one, and the list of its legal pairs. */
static uint64_t rebuild_bytes(const dyd_delaunay *pd) {
  return dyd_bytes_add(dyd_delaunay_memory(pd), dyd_pairs_bytes(pd, DYD_LEGAL));
}

static dyd_status rebuild(dyd_delaunay *pd, dyd_error *err) {
  DYD_SCOPED(dyd_pair_list) all = {0};
  if (pd->memory.most) pd->memory.beside = rebuild_bytes(pd);
  if (!dyd_memory_has(&pd->memory, dyd_skeleton_bytes(pd->sk.rects.sites), "the triangulation made anew"))
    return DYD_E_NOMEM;
  dyd_status st = dyd_pairs_list(&all, pd, DYD_LEGAL);
  if (st != DYD_OK) return st;
  dyd_delaunay next = {
      .counters = pd->counters, .options = pd->options, .max_pairs = pd->max_pairs, .memory = pd->memory};
  next.memory.held = 0;
  st = dyd_build(&next, pd->sk.rects.sites, (dyd_known){all.item, all.count}, err);
  pd->memory = next.memory;
  if (st == DYD_OK) {
    build_clear(pd);
    *pd = next;
    dyd_skeleton_moved(&pd->sk);
  }
  return st;
}

/* ---- what changed ---- */

/* One triangle of each face around v that is not listed yet. */
static dyd_status note_faces(uint32_t **seed, size_t *count, size_t *cap, bool *noted, const dyd_delaunay *pd,
                             uint32_t v) {
  dyd_half_edge first = pd->sk.leaving[v];
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(&pd->sk.mesh, h, first)) {
    uint32_t t = dyd_edge_triangle(h), f = pd->open.of[t];
    if (f == DYD_NONE || noted[f]) continue;
    noted[f] = true;
    if (!dyd_reserve((void **)seed, cap, *count + 1, sizeof **seed)) return DYD_E_NOMEM;
    (*seed)[(*count)++] = t;
  }
  return DYD_OK;
}

/* The sites are anywhere in memory: asks for what the next ones need, one step after the other. */
static void fetch_ahead(const dyd_delaunay *pd, const uint32_t *changed, size_t left) {
  enum { STEP = 6 };
  const dyd_skeleton *sk = &pd->sk;
  if (left > 3 * STEP) __builtin_prefetch(&sk->vertex[changed[3 * STEP]]);
  if (left > 2 * STEP) {
    uint32_t v = sk->vertex[changed[2 * STEP]];
    __builtin_prefetch(&sk->leaving[v]);
    __builtin_prefetch(&sk->rects.box[v]);
    __builtin_prefetch(&sk->reps.xy[v]);
    dyd_sites_fetch(sk->rects.sites, changed[2 * STEP]);
  }
  if (left > STEP) {
    uint32_t t = dyd_edge_triangle(sk->leaving[sk->vertex[changed[STEP]]]);
    __builtin_prefetch(&sk->mesh.tri[t]);
    __builtin_prefetch(&pd->open.of[t]);
  }
}

static dyd_status affected(uint32_t **seed, size_t *seeds, dyd_delaunay *pd, const uint32_t *changed, size_t count) {
  size_t cap = 0;
  DYD_FREED bool *noted = calloc(pd->open.count, sizeof *noted);
  dyd_status st = noted ? DYD_OK : DYD_E_NOMEM;
  for (size_t q = 0; q < count && st == DYD_OK; q++) {
    uint32_t v = pd->sk.vertex[changed[q]];
    fetch_ahead(pd, changed + q, count - q);
    st = dyd_skeleton_refresh(&pd->sk, v);
    if (st == DYD_OK) st = note_faces(seed, seeds, &cap, noted, pd, v);
  }
  return st;
}

/* ---- one face ---- */

/* Certifies an edge. The first guess of a witness proves most edges; it is tested against nearby sites first. */
static dyd_status recertify(dyd_delaunay *pd, dyd_work *w, dyd_half_edge h) {
  if (pd->sk.mesh.no_filter || !dyd_filter_local_witness(pd, h, dyd_edge_centre(&pd->sk, h)))
    return dyd_certify_edge(&pd->sk, w, h);
  DYD_INVARIANT(dyd_witness_at(w, &pd->sk, h, dyd_edge_centre(&pd->sk, h)));
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
  DYD_FREED uint8_t *before = dyd_alloc(tris, 1);
  if (!before) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < tris; q++) before[q] = pd->sk.certain[tri[q]];
  dyd_status st = recertify_inside(narrowed, pd, w, tri, tris);
  bool replaced = false;
  if (st == DYD_OK) st = dyd_faces_replace(&replaced, pd, w, tri, tris, narrowed);
  if (!replaced) restore_certain(pd, before, tri, tris);
  return st;
}

/* New triangles where they are needed; *fits as for splice. */
static dyd_status retriangulate(bool *fits, dyd_delaunay *pd, dyd_work *w, const dyd_narrowed *narrowed,
                                const uint32_t *tri, uint32_t tris) {
  dyd_status st = DYD_OK;
  *fits = false;
  if (narrowed->mark) st = splice_near(fits, pd, w, tri, tris, narrowed->vertex, narrowed->count);
  if (st != DYD_OK || *fits) return st;
  *fits = splice_is_needless(w, &pd->sk, tri, tris);
  return *fits ? DYD_OK : splice(fits, pd, w, tri, tris, true);
}

/* *fits as for splice. */
static dyd_status work_on(bool *fits, dyd_delaunay *pd, dyd_work *w, uint32_t seed, const uint32_t *changed,
                          size_t count) {
  DYD_SCOPED(dyd_narrowed) narrowed = {0};
  const dyd_face *face = &pd->open.face[pd->open.of[seed]];
  const uint32_t tris = face->tris;
  DYD_FREED uint32_t *tri = dyd_alloc(tris, sizeof *tri);
  if (!tri) return DYD_E_NOMEM;
  memcpy(tri, pd->open.tri + face->first_tri, tris * sizeof *tri);
  dyd_status st = dyd_narrowed_init(&narrowed, pd, pd->open.of[seed], changed, count);
  if (st == DYD_OK) st = retriangulate(fits, pd, w, &narrowed, tri, tris);
  if (st == DYD_OK && *fits) st = redo_face(pd, w, &narrowed, tri, tris);
  return st;
}

static dyd_status update_faces(bool *fits, dyd_delaunay *pd, dyd_work *w, const uint32_t *changed, size_t count) {
  DYD_FREED uint32_t *seed = NULL;
  size_t seeds = 0;
  dyd_status st = affected(&seed, &seeds, pd, changed, count);
  dyd_mesh_follow(&pd->sk.mesh);
  for (size_t q = 0; q < seeds && st == DYD_OK && *fits; q++)
    st = dyd_work_cancelled(w) ? DYD_CANCELLED : work_on(fits, pd, w, seed[q], changed, count);
  return st;
}

/* As dyd_delaunay_update. */
static dyd_status dyd_update(dyd_delaunay *pd, const uint32_t *changed, size_t count, dyd_error *err) {
  if (pd->joins != pd->sk.rects.sites->joins) return rebuild(pd, err);
  if (pd->open.kind == DYD_LINE) return count ? rebuild(pd, err) : DYD_OK;
  if (count == 0 || pd->open.count == 0 || pd->open.kind == DYD_TIED) return DYD_OK;
  bool fits = true;
  const dyd_run run = {.cancel = pd->options.cancel, .threads = pd->options.threads, .err = err};
  dyd_work w;
  dyd_work_init(&w, &pd->sk, &run);
  w.memory = pd->memory;
  w.memory.held = dyd_delaunay_memory(pd);
  dyd_status st = update_faces(&fits, pd, &w, changed, count);
  dyd_memory_join(&pd->memory, &w.memory);
  dyd_work_count(&pd->counters, &w, &pd->sk);
  dyd_work_clear(&w);
  if (st == DYD_OK && !fits) return rebuild(pd, err);
  if (st == DYD_OK) DYD_INVARIANT(dyd_mesh_is_valid(&pd->sk.mesh));
  return st;
}

/* ---- made, brought up to date, freed ---- */

/* Links between pairs are 32-bit numbers, two for each. */
#define MOST_PAIRS ((size_t)1 << 30)

static void set_options(dyd_delaunay *pd, const dyd_delaunay_options *options, size_t n) {
  pd->options = *options;
  pd->memory = (dyd_memory){.most = options->max_bytes, .held = sizeof *pd};
  pd->max_pairs = pd->options.max_pairs ? pd->options.max_pairs : 4000000 + 16 * n;
  if (pd->max_pairs > MOST_PAIRS) pd->max_pairs = MOST_PAIRS;
}

static dyd_status finish(dyd_delaunay *pd, dyd_status st, dyd_error *err) {
  pd->options.cancel = NULL;
  pd->options.prove = NULL;
  pd->options.narrows = NULL;
  pd->decider = NULL;
  if (pd->memory.peak > pd->counters.bytes_most) pd->counters.bytes_most = pd->memory.peak;
  if (st == DYD_E_NOMEM && pd->memory.refused) return dyd_fail_memory(err, &pd->memory);
  if (st == DYD_OK) return dyd_delaunay_is_capped(pd) ? DYD_CAPPED : DYD_OK;
  return dyd_fail(err, st, "%s", dyd_status_text(st));
}

static dyd_status build_new(dyd_delaunay **out, const dyd_sites *sites, const dyd_decider *decider,
                            const dyd_delaunay_options *options, dyd_error *err) {
  dyd_delaunay_options o;
  *out = NULL;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_delaunay_options", err) != DYD_OK) return DYD_E_ARG;
  if (dyd_float_check(err) != DYD_OK) return DYD_E_ARG;
  if (dyd_sites_count(sites) > DYD_MAX_SITES) return dyd_fail(err, DYD_E_RANGE, "too many sites");
  dyd_delaunay *pd = calloc(1, sizeof *pd);
  if (!pd) return dyd_fail_nomem(err);
  set_options(pd, &o, dyd_sites_count(sites));
  pd->decider = decider;
  dyd_status st = finish(pd, dyd_build(pd, sites, (dyd_known){NULL, 0}, err), err);
  if (dyd_failed(st) || st == DYD_CANCELLED)
    free(pd);
  else
    *out = pd;
  return st;
}

dyd_status dyd_delaunay_new(dyd_delaunay **out, const dyd_sites *sites, const dyd_delaunay_options *options,
                            dyd_error *err) {
  return build_new(out, sites, NULL, options, err);
}

dyd_status dyd_delaunay_made(dyd_delaunay **out, size_t n, dyd_rect_fn *rect, const void *user,
                             const dyd_delaunay_options *options, dyd_error *err) {
  return dyd_delaunay_decided(out, n, rect, user, NULL, options, err);
}

dyd_status dyd_delaunay_decided(dyd_delaunay **out, size_t n, dyd_rect_fn *rect, const void *user,
                                const dyd_decider *decider, const dyd_delaunay_options *options, dyd_error *err) {
  dyd_delaunay_options o = *options;
  dyd_sites *sites = NULL;
  DYD_LOCAL(dyd_rect, r);
  *out = NULL;
  dyd_status st = dyd_sites_new(&sites);
  for (size_t i = 0; i < n && st == DYD_OK; i++) {
    st = rect(&r, user, i);
    if (st == DYD_OK) st = dyd_sites_add_rect(sites, &r);
  }
  dyd_memory memory = {.most = o.max_bytes, .beside = o.max_bytes && sites ? dyd_sites_memory(sites) : 0};
  o.max_bytes = dyd_memory_left(&memory);
  st = st == DYD_OK ? build_new(out, sites, decider, &o, err) : dyd_fail(err, st, "%s", dyd_status_text(st));
  if (*out)
    (*out)->own = sites;
  else
    dyd_sites_free(sites);
  return st;
}

void dyd_delaunay_free(dyd_delaunay *pd) {
  if (!pd) return;
  build_clear(pd);
  dyd_sites_free(pd->own);
  free(pd);
}

dyd_status dyd_delaunay_update(dyd_delaunay *pd, const uint32_t *changed, size_t count,
                               const dyd_delaunay_options *options, dyd_error *err) {
  dyd_delaunay_options o;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_delaunay_options", err) != DYD_OK) return DYD_E_ARG;
  if (dyd_float_check(err) != DYD_OK) return DYD_E_ARG;
  for (size_t q = 0; q < count; q++)
    if (changed[q] >= pd->sk.n) return dyd_fail(err, DYD_E_ARG, "site %u does not exist", changed[q]);
  if (dyd_sites_count(pd->sk.rects.sites) != pd->sk.n)
    return dyd_fail(err, DYD_E_ARG, "sites were added after the triangulation");
  set_options(pd, &o, pd->sk.n);
  return finish(pd, dyd_update(pd, changed, count, err), err);
}

dyd_status dyd_delaunay_extend(bool *fits, dyd_delaunay *pd, const dyd_delaunay_options *options, dyd_error *err) {
  *fits = false;
  if (dyd_float_check(err) != DYD_OK) return DYD_E_ARG;
  set_options(pd, options, dyd_sites_count(pd->sk.rects.sites));
  return finish(pd, dyd_extend(fits, pd, err), err);
}

bool dyd_delaunay_is_capped(const dyd_delaunay *pd) {
  return pd ? pd->open.capped > 0 : false;
}
