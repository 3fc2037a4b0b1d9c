/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Triangulating one face by itself and putting it back. */
#include "delaunay/splice.h"

#include "base/alloc.h"
#include "skeleton/mesh_build.h"
#include "skeleton/mesh_start.h"
#include "skeleton/predicates.h"

/* An edge around what is spliced, seen from inside, from a to b with the inside on its left: a certain edge, or one of
 * a triangle that stays. Vertices of the whole mesh. */
typedef struct rim {
  uint32_t a, b;
  bool certain;
  dyd_half_edge beyond; /* on the other side; DYD_NONE if that is inside, too */
  dyd_half_edge inside; /* the same in the part's mesh */
  dyd_half_edge placed; /* the same in the whole mesh afterwards */
} rim;

/* Instead of their face, at triangles that are spliced. */
#define SPLICED (DYD_NONE - 1)

/* place[t]: slot of the part's triangle t in tri[], DYD_NONE if outside the face. taken: triangles of the face found so
 * far. */
typedef struct part {
  dyd_delaunay *pd;
  dyd_work *w;
  const uint32_t *tri;
  uint32_t tris;
  rim *rims;
  size_t rim_count, rim_cap;
  uint32_t *vertex; /* of the part, ascending among points and among the rest */
  uint32_t vertices;
  dyd_mesh mesh;
  dyd_half_edge *leaving;
  uint32_t *place, *queue;
  uint32_t taken;
  uint32_t *sorted, *local; /* vertices ascending, and their numbers in the part */
} part;

static int compare_rim(const void *a, const void *b) {
  const rim *x = a, *y = b;
  if (x->a != y->a) return x->a < y->a ? -1 : 1;
  return (x->b > y->b) - (x->b < y->b);
}

static rim *find_rim(const part *p, uint32_t a, uint32_t b) {
  rim key = {.a = a, .b = b};
  return p->rim_count ? bsearch(&key, p->rims, p->rim_count, sizeof key, compare_rim) : NULL;
}

/* ---- what the face looks like ---- */

static dyd_status gather_rims(part *p) {
  const dyd_skeleton *sk = &p->pd->sk;
  uint32_t face = dyd_face_of(p->pd, p->tri[0]);
  for (uint32_t q = 0; q < p->tris; q++)
    for (dyd_half_edge h = dyd_edge_of(p->tri[q], 0); h < dyd_edge_end(p->tri[q]); h++) {
      dyd_half_edge beyond = dyd_edge_twin(&sk->mesh, h);
      bool certain = dyd_edge_is_certain(sk, h), same = dyd_face_of(p->pd, dyd_edge_triangle(beyond)) == face;
      if (same && !certain) continue;
      if (!dyd_reserve((void **)&p->rims, &p->rim_cap, p->rim_count + 1, sizeof *p->rims)) return DYD_E_NOMEM;
      p->rims[p->rim_count++] = (rim){dyd_edge_origin(&sk->mesh, h),
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
static dyd_status gather_vertices(part *p) {
  const dyd_mesh *m = &p->pd->sk.mesh;
  size_t room = 3 * (size_t)p->tris + p->rim_count;
  uint32_t count = 0;
  p->vertex = dyd_alloc(room, sizeof *p->vertex);
  p->sorted = dyd_alloc(room, sizeof *p->sorted);
  p->local = dyd_alloc(room, sizeof *p->local);
  if (!p->vertex || !p->sorted || !p->local) return DYD_E_NOMEM;
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

static uint32_t to_local(const part *p, uint32_t v) {
  if (v == p->pd->sk.mesh.n) return p->mesh.n;
  const uint32_t *at = bsearch(&v, p->sorted, p->vertices, sizeof v, dyd_compare_index);
  return p->local[at - p->sorted];
}

static uint32_t to_whole(const part *p, uint32_t v) {
  return v == p->mesh.n ? p->pd->sk.mesh.n : p->vertex[v];
}

/* ---- the part's own skeleton ---- */

static dyd_status part_triangulate(part *p) {
  dyd_skeleton *sk = &p->pd->sk;
  dyd_status st = dyd_mesh_build(&p->mesh, &sk->reps, p->vertex, p->vertices, sk->mesh.no_filter, p->w->cancel);
  if (st != DYD_OK) return st;
  dyd_tally_add(&p->w->counters, &p->mesh.tally, sk->mesh.no_filter);
  p->leaving = dyd_alloc((size_t)p->vertices + 1, sizeof *p->leaving);
  p->place = dyd_alloc(p->mesh.count, sizeof *p->place);
  p->queue = dyd_alloc(p->tris, sizeof *p->queue);
  if (!p->leaving || !p->place || !p->queue) return DYD_E_NOMEM;
  for (uint32_t t = 0; t < p->mesh.count; t++) {
    p->place[t] = DYD_NONE;
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++) p->leaving[dyd_edge_origin(&p->mesh, h)] = h;
  }
  return DYD_OK;
}

/* The half-edge from a to b of the part, or DYD_NONE. */
static dyd_half_edge part_find_edge(const part *p, uint32_t a, uint32_t b) {
  dyd_half_edge first = p->leaving[a], h = first;
  while (dyd_edge_target(&p->mesh, h) != b) {
    h = dyd_edge_turn(&p->mesh, h);
    if (h == first) return DYD_NONE;
  }
  return h;
}

/* Gives the part's triangle t the next slot; false when the face is full. */
static bool part_take(part *p, uint32_t t) {
  if (p->place[t] != DYD_NONE) return true;
  if (p->taken == p->tris) return false;
  p->queue[p->taken] = t;
  p->place[t] = p->tri[p->taken++];
  return true;
}

static rim *rim_of(const part *p, dyd_half_edge h) {
  return find_rim(p, to_whole(p, dyd_edge_origin(&p->mesh, h)), to_whole(p, dyd_edge_target(&p->mesh, h)));
}

/* Finds the triangles inside the rim; false if they do not fill the face. */
static bool part_flood(part *p) {
  for (size_t q = 0; q < p->rim_count; q++) {
    rim *r = &p->rims[q];
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

static void put_triangle(part *p, uint32_t t) {
  dyd_skeleton *sk = &p->pd->sk;
  uint32_t slot = p->place[t];
  dyd_tri *to = &sk->mesh.tri[slot];
  const dyd_tri *from = &p->mesh.tri[t];
  sk->certain[slot] = 0;
  for (unsigned k = 0; k < 3; k++) {
    rim *r = rim_of(p, dyd_edge_of(t, k));
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

static void link_rims(part *p) {
  for (size_t q = 0; q < p->rim_count; q++) {
    const rim *r = &p->rims[q];
    dyd_edge_join(&p->pd->sk.mesh, r->placed, r->beyond != DYD_NONE ? r->beyond : find_rim(p, r->b, r->a)->placed);
  }
}

static void part_clear(part *p) {
  dyd_mesh_clear(&p->mesh);
  free(p->rims);
  free(p->vertex);
  free(p->sorted);
  free(p->local);
  free(p->leaving);
  free(p->place);
  free(p->queue);
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

bool dyd_splice_is_needless(dyd_work *w, const dyd_skeleton *sk, const uint32_t *tri, uint32_t tris) {
  for (uint32_t q = 0; q < tris; q++)
    if (!triangle_stands(w, sk, tri[q])) return false;
  return true;
}

/* moved: a representative may be moved so that it differs from another one. */
static dyd_status splice(bool *fits, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, uint32_t tris, bool moved) {
  part p = {.pd = pd, .w = w, .tri = tri, .tris = tris};
  dyd_status st = gather_rims(&p);
  if (st == DYD_OK) st = gather_vertices(&p);
  if (st == DYD_OK) st = part_triangulate(&p);
  *fits = st == DYD_OK && !p.mesh.alias && !p.mesh.collinear && (moved || !p.mesh.moved) && part_flood(&p);
  if (*fits) {
    for (uint32_t q = 0; q < p.taken; q++) put_triangle(&p, p.queue[q]);
    link_rims(&p);
  }
  part_clear(&p);
  return st;
}

dyd_status dyd_splice_face(bool *fits, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, uint32_t tris) {
  return splice(fits, pd, w, tri, tris, true);
}

/* ---- a few vertices ---- */

/* Is one of the vertices a corner of t, or in or on its circle? */
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

dyd_status dyd_splice_near(bool *fits, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, uint32_t tris,
                           const uint32_t *vertex, uint32_t count) {
  uint32_t face = dyd_face_of(pd, tri[0]), upset = 0, *list = dyd_alloc(tris, sizeof *list);
  if (!list) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < tris; q++)
    if (is_upset(w, &pd->sk.mesh, tri[q], vertex, count)) list[upset++] = tri[q];
  mark_upset(pd, list, upset, SPLICED);
  dyd_status st = splice(fits, pd, w, list, upset, false);
  mark_upset(pd, list, upset, face);
  free(list);
  return st;
}
