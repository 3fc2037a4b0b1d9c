/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Triangulating one face by itself and putting it back. */
#include "delaunay/splice.h"

#include "base/alloc.h"

#include <string.h>

/* A certain edge seen from inside the face, from a to b with the face on its left. Vertices of the whole mesh. */
typedef struct rim {
  uint32_t a, b;
  uint32_t beyond; /* the edge on the other side, 4 t + k; DYD_NONE if that is this face too */
  uint32_t inside; /* the same edge in the part's mesh, 4 t + k */
  uint32_t placed; /* the same edge in the whole mesh afterwards */
} rim;

/* place[t]: slot of the part's triangle t in tri[], DYD_NONE if outside the face. taken: triangles of the face found so
 * far. */
typedef struct part {
  dyd_delaunay *pd;
  const uint32_t *tri;
  uint32_t tris;
  rim *rims;
  size_t rim_count, rim_cap;
  uint32_t *vertex; /* of the part, ascending among points and among the rest */
  uint32_t vertices;
  dyd_mesh mesh;
  uint32_t *corner, *place, *queue;
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
  const dyd_mesh *m = &p->pd->mesh;
  uint32_t face = p->pd->faces.of[p->tri[0]];
  for (uint32_t q = 0; q < p->tris; q++)
    for (unsigned k = 0; k < 3; k++) {
      uint32_t t = p->tri[q], beyond = m->tri[t].n[k];
      if (!dyd_edge_is_certain(p->pd, t, k)) continue;
      if (!dyd_reserve((void **)&p->rims, &p->rim_cap, p->rim_count + 1, sizeof *p->rims)) return DYD_E_NOMEM;
      bool same = p->pd->faces.of[beyond >> 2] == face;
      p->rims[p->rim_count++] =
          (rim){m->tri[t].v[dyd_next(k)], m->tri[t].v[dyd_prev(k)], same ? DYD_NONE : beyond, DYD_NONE, DYD_NONE};
    }
  if (p->rim_count) qsort(p->rims, p->rim_count, sizeof *p->rims, compare_rim);
  return DYD_OK;
}

/* The face's vertices, and those just beyond its rim, so that the part is never collinear. */
static dyd_status gather_vertices(part *p) {
  const dyd_mesh *m = &p->pd->mesh;
  size_t room = 3 * (size_t)p->tris + p->rim_count;
  uint32_t count = 0;
  p->vertex = dyd_alloc(room, sizeof *p->vertex);
  p->sorted = dyd_alloc(room, sizeof *p->sorted);
  p->local = dyd_alloc(room, sizeof *p->local);
  if (!p->vertex || !p->sorted || !p->local) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < p->tris; q++)
    for (int k = 0; k < 3; k++) p->sorted[count++] = m->tri[p->tri[q]].v[k];
  for (size_t q = 0; q < p->rim_count; q++)
    if (p->rims[q].beyond != DYD_NONE) p->sorted[count++] = m->tri[p->rims[q].beyond >> 2].v[p->rims[q].beyond & 3];
  qsort(p->sorted, count, sizeof *p->sorted, dyd_compare_index);
  for (uint32_t q = 0; q < count; q++) {
    uint32_t v = p->sorted[q];
    if (v != m->n && (p->vertices == 0 || p->sorted[p->vertices - 1] != v)) p->sorted[p->vertices++] = v;
  }
  uint32_t next = 0;
  for (int fat = 0; fat < 2; fat++) /* exact points first, as in the whole */
    for (uint32_t q = 0; q < p->vertices; q++)
      if (dyd_vertex_is_point(p->pd, p->sorted[q]) == !fat) {
        p->local[q] = next;
        p->vertex[next++] = p->sorted[q];
      }
  return DYD_OK;
}

static uint32_t to_local(const part *p, uint32_t v) {
  if (v == p->pd->mesh.n) return p->mesh.n;
  const uint32_t *at = bsearch(&v, p->sorted, p->vertices, sizeof v, dyd_compare_index);
  return p->local[at - p->sorted];
}

static uint32_t to_whole(const part *p, uint32_t v) {
  return v == p->mesh.n ? p->pd->mesh.n : p->vertex[v];
}

/* ---- the part's own skeleton ---- */

static dyd_status triangulate(part *p) {
  dyd_status st = dyd_mesh_build(&p->mesh, &p->pd->reps, p->vertex, p->vertices, p->pd->options.no_filter,
                                 &p->pd->counters, p->pd->options.cancel);
  if (st != DYD_OK) return st;
  p->corner = dyd_alloc((size_t)p->vertices + 1, sizeof *p->corner);
  p->place = dyd_alloc(p->mesh.count, sizeof *p->place);
  p->queue = dyd_alloc(p->tris, sizeof *p->queue);
  if (!p->corner || !p->place || !p->queue) return DYD_E_NOMEM;
  if (p->mesh.count) memset(p->place, 0xff, p->mesh.count * sizeof *p->place);
  for (uint32_t t = 0; t < p->mesh.count; t++)
    for (unsigned k = 0; k < 3; k++) p->corner[p->mesh.tri[t].v[k]] = 4 * t + k;
  return DYD_OK;
}

/* The edge from a to b of the part, as 4 t + k, or DYD_NONE. */
static uint32_t find_edge(const part *p, uint32_t a, uint32_t b) {
  uint32_t first = p->corner[a], h = first;
  do {
    if (p->mesh.tri[h >> 2].v[dyd_next(h & 3)] == b) return (h & ~3u) | dyd_prev(h & 3);
    h = dyd_turn(&p->mesh, h);
  } while (h != first);
  return DYD_NONE;
}

/* Gives the part's triangle t the next slot; false when the face is full. */
static bool take(part *p, uint32_t t) {
  if (p->place[t] != DYD_NONE) return true;
  if (p->taken == p->tris) return false;
  p->queue[p->taken] = t;
  p->place[t] = p->tri[p->taken++];
  return true;
}

static rim *rim_of(const part *p, uint32_t t, unsigned k) {
  const uint32_t *v = p->mesh.tri[t].v;
  return find_rim(p, to_whole(p, v[dyd_next(k)]), to_whole(p, v[dyd_prev(k)]));
}

/* Finds the triangles inside the rim; false if they do not fill the face. */
static bool flood(part *p) {
  for (size_t q = 0; q < p->rim_count; q++) {
    rim *r = &p->rims[q];
    r->inside = find_edge(p, to_local(p, r->a), to_local(p, r->b));
    if (r->inside == DYD_NONE || !take(p, r->inside >> 2)) return false;
  }
  if (p->rim_count == 0) /* the face is the whole plane */
    for (uint32_t t = 0; t < p->mesh.count; t++)
      if (!take(p, t)) return false;
  for (uint32_t q = 0; q < p->taken; q++)
    for (unsigned k = 0; k < 3; k++) {
      uint32_t t = p->queue[q];
      if (!rim_of(p, t, k) && !take(p, p->mesh.tri[t].n[k] >> 2)) return false;
    }
  return p->taken == p->tris;
}

/* ---- back into the whole ---- */

static void put_triangle(part *p, uint32_t t) {
  dyd_delaunay *pd = p->pd;
  uint32_t slot = p->place[t];
  dyd_tri *to = &pd->mesh.tri[slot];
  const dyd_tri *from = &p->mesh.tri[t];
  pd->certain[slot] = 0;
  for (unsigned k = 0; k < 3; k++) {
    rim *r = rim_of(p, t, k);
    to->v[k] = to_whole(p, from->v[k]);
    if (to->v[k] != pd->mesh.n) pd->corner[to->v[k]] = 4 * slot + k;
    if (r) {
      r->placed = 4 * slot + k;
      pd->certain[slot] |= (uint8_t)(1u << k);
    } else {
      to->n[k] = 4 * p->place[from->n[k] >> 2] + (from->n[k] & 3);
    }
  }
}

static void link_rims(part *p) {
  dyd_tri *tri = p->pd->mesh.tri;
  for (size_t q = 0; q < p->rim_count; q++) {
    const rim *r = &p->rims[q];
    uint32_t beyond = r->beyond != DYD_NONE ? r->beyond : find_rim(p, r->b, r->a)->placed;
    tri[r->placed >> 2].n[r->placed & 3] = beyond;
    tri[beyond >> 2].n[beyond & 3] = r->placed;
  }
}

static void part_clear(part *p) {
  dyd_mesh_clear(&p->mesh);
  free(p->rims);
  free(p->vertex);
  free(p->sorted);
  free(p->local);
  free(p->corner);
  free(p->place);
  free(p->queue);
}

static bool triangle_stands(dyd_delaunay *pd, uint32_t t) {
  dyd_mesh *m = &pd->mesh;
  const uint32_t *v = m->tri[t].v;
  if (dyd_mesh_is_ghost(m, t) || dyd_mesh_orient(m, v[0], v[1], v[2]) <= 0) return false;
  for (unsigned k = 0; k < 3; k++) {
    uint32_t beyond = m->tri[t].n[k];
    if (dyd_edge_is_certain(pd, t, k) || beyond < 4 * t + k) continue;
    uint32_t across = m->tri[beyond >> 2].v[beyond & 3];
    if (across == m->n || dyd_mesh_incircle(m, v[0], v[1], v[2], across) > 0) return false;
  }
  return true;
}

bool dyd_splice_is_needless(dyd_delaunay *pd, const uint32_t *tri, uint32_t tris) {
  for (uint32_t q = 0; q < tris; q++)
    if (!triangle_stands(pd, tri[q])) return false;
  return true;
}

dyd_status dyd_splice_face(bool *fits, dyd_delaunay *pd, const uint32_t *tri, uint32_t tris) {
  part p = {.pd = pd, .tri = tri, .tris = tris};
  dyd_status st = gather_rims(&p);
  if (st == DYD_OK) st = gather_vertices(&p);
  if (st == DYD_OK) st = triangulate(&p);
  *fits = st == DYD_OK && !p.mesh.alias && !p.mesh.collinear && flood(&p);
  if (*fits) {
    for (uint32_t q = 0; q < p.taken; q++) put_triangle(&p, p.queue[q]);
    link_rims(&p);
  }
  part_clear(&p);
  return st;
}
