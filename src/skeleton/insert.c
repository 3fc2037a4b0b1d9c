/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Point location by walking, insertion by cavities. */
#include "skeleton/insert.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "skeleton/mesh_exact.h"
#include "skeleton/mesh_start.h"
#include "skeleton/predicates.h"

/* The walk goes over an edge only when v is strictly beyond it; it ends since the power of v decreases, or inside
 * one cocircular polygon, whose dual is a tree that is never walked back. */
uint32_t dyd_mesh_locate(dyd_mesh *m, uint32_t v) {
  bool ghost = dyd_is_ghost_triangle(m, m->hint);
  uint32_t start = ghost ? dyd_edge_triangle(dyd_edge_twin(m, dyd_hull_edge(m, m->hint))) : m->hint;
  dyd_half_edge h = dyd_edge_of(start, 0);
  uint32_t a = dyd_edge_origin(m, h), b = dyd_edge_target(m, h), c = a;
  dyd_xy p = m->xy[v];
  dyd_seen sa = dyd_see(m->xy[a], p), sb = dyd_see(m->xy[b], p), sc = sa;
  if (dyd_build_turn(m, dyd_seen_cross(sa, sb), a, b, v) < 0) {
    h = dyd_edge_twin(m, h);
    a = b, sa = sb;
    b = c, sb = sc;
  }
  while ((c = dyd_edge_apex(m, h)) != m->n) { /* the triangle a b c, entered over a b */
    sc = dyd_see(m->xy[c], p);
    if (dyd_build_turn(m, dyd_seen_cross(sb, sc), b, c, v) < 0) {
      h = dyd_edge_twin(m, dyd_edge_next(h));
      a = c, sa = sc;
    } else if (dyd_build_turn(m, dyd_seen_cross(sc, sa), c, a, v) < 0) {
      h = dyd_edge_twin(m, dyd_edge_prev(h));
      b = c, sb = sc;
    } else
      break;
  }
  return dyd_edge_triangle(h);
}

/* An edge of the rim of the cavity, from a to b, counter-clockwise. The rim is a chain: a is the b of the edge before.
 */
struct dyd_rim {
  dyd_half_edge beyond; /* in the triangle beyond */
  uint32_t b;
  dyd_seen seen; /* b from the new vertex */
  double cross;  /* of a and b */
};

/* Room for one more edge of the rim and one more free triangle. */
static inline bool insert_has_room(dyd_mesh *m, size_t edges, size_t spares) {
  return (edges < m->rim_cap || dyd_reserve((void **)&m->rim, &m->rim_cap, edges + 1, sizeof *m->rim)) &&
         (spares < m->spare_cap || dyd_reserve((void **)&m->spare, &m->spare_cap, spares + 1, sizeof *m->spare));
}

/* The rim of the triangle t alone; returns where it begins. The edge to be looked at next is the last one. */
static inline dyd_seen rim_of_triangle(dyd_mesh *m, dyd_xy p, uint32_t t) {
  const dyd_tri *at = &m->tri[t];
  dyd_seen seen[3];
  for (unsigned k = 0; k < 3; k++) seen[k] = dyd_see(m->xy[at->v[k]], p);
  for (unsigned k = 0; k < 3; k++) {
    unsigned a = dyd_next(k), b = dyd_prev(k);
    m->rim[2 - k] = (struct dyd_rim){at->n[k], at->v[b], seen[b], dyd_seen_cross(seen[a], seen[b])};
  }
  return seen[1];
}

/* Triangles around a new vertex, counter-clockwise. */
typedef struct fan {
  uint32_t first, last;
} fan;

/* q becomes the next one: v and the rim's edge from a to b, beyond which is h. */
static inline void fan_add(fan *f, dyd_mesh *m, uint32_t q, uint32_t v, uint32_t a, uint32_t b, dyd_half_edge h) {
  uint32_t before = f->first == DYD_NONE ? q : f->last;
  m->tri[q] = (dyd_tri){{v, a, b}, {h, DYD_NONE, dyd_edge_of(before, 1)}};
  m->tri[before].n[1] = dyd_edge_of(q, 2);
  m->tri[dyd_edge_triangle(h)].n[dyd_edge_corner(h)] = dyd_edge_of(q, 0);
  f->first = f->first == DYD_NONE ? q : f->first;
  f->last = q;
}

/* Joins v to the rim of the cavity that grows from t. It takes two triangles more than were there. */
static dyd_status insert_at(dyd_mesh *m, uint32_t v, uint32_t t) {
  dyd_xy p = m->xy[v];
  dyd_seen sa = rim_of_triangle(m, p, t);
  size_t edges = 3, spares = 3;
  uint32_t a = m->tri[t].v[1];
  fan f = {DYD_NONE, DYD_NONE};
  m->spare[0] = m->count + 1;
  m->spare[1] = m->count;
  m->spare[2] = t;
  while (edges) {
    struct dyd_rim *r = &m->rim[edges - 1];
    dyd_half_edge h = r->beyond;
    const dyd_tri *o = &m->tri[dyd_edge_triangle(h)];
    unsigned k = dyd_edge_corner(h);
    uint32_t b = r->b, c = o->v[k];
    dyd_seen sb = r->seen, sc = dyd_see(m->xy[c], p);
    double ac = dyd_seen_cross(sa, sc), cb = dyd_seen_cross(sc, sb);
    dyd_incircle at = {sc.square, sb.square, sa.square, -r->cross, ac, cb}; /* the triangle c b a */
    int inside;
    if (!dyd_incircle_known(&inside, &m->tally, m, at)) inside = dyd_build_incircle_slow(m, c, b, a, v);
    if (inside > 0) { /* a c and c b take the place of a b */
      if (!insert_has_room(m, edges, spares)) return DYD_E_NOMEM;
      r = &m->rim[edges - 1];
      r->beyond = o->n[dyd_prev(k)];
      r->cross = cb;
      m->rim[edges++] = (struct dyd_rim){o->n[dyd_next(k)], c, sc, ac};
      m->spare[spares++] = dyd_edge_triangle(h);
    } else {
      fan_add(&f, m, m->spare[--spares], v, a, b, h);
      a = b;
      sa = sb;
      edges--;
    }
  }
  dyd_edge_join(m, dyd_edge_of(f.first, 2), dyd_edge_of(f.last, 1));
  m->count += 2;
  m->hint = f.last;
  return DYD_OK;
}

/* The vertex of t that has the same representative as v, or DYD_NONE. */
static uint32_t same_vertex(dyd_mesh *m, uint32_t v, uint32_t t) {
  for (unsigned k = 0; k < 3; k++) {
    uint32_t w = m->tri[t].v[k];
    if (w != m->n && m->xy[w].x == m->xy[v].x && m->xy[w].y == m->xy[v].y && dyd_mesh_same(m, v, w)) return w;
  }
  return DYD_NONE;
}

static dyd_status insert_vertex(dyd_mesh *m, uint32_t v) {
  for (;;) {
    uint32_t t = dyd_mesh_locate(m, v);
    uint32_t same = same_vertex(m, v, t);
    if (same == DYD_NONE) return insert_at(m, v, t);
    if (dyd_mesh_is_point(m, v)) {
      DYD_INVARIANT(dyd_mesh_is_point(m, same));
      return dyd_mesh_set_alias(m, v, same);
    }
    dyd_status st = dyd_mesh_move(m, v, m->moved + 1);
    if (st != DYD_OK) return st;
  }
}

static dyd_status insert_all(dyd_mesh *m, const uint32_t first[3], const volatile int *cancel) {
  for (unsigned round = 0; round < m->rounds; round++)
    for (uint32_t v = m->begin; v < m->end; v++) {
      if (v == first[0] || v == first[1] || v == first[2] || dyd_mesh_alias(m, v) != DYD_NONE) continue;
      if (!dyd_mesh_has_turn(m, v, round)) continue;
      if ((v & 1023) == 0 && dyd_flag_is_set(cancel)) return DYD_CANCELLED;
      dyd_status st = insert_vertex(m, v);
      if (st != DYD_OK) return st;
    }
  return DYD_OK;
}

dyd_status dyd_mesh_fill(dyd_mesh *m, const volatile int *cancel) {
  uint32_t first[3];
  dyd_mesh_set_rounds(m);
  dyd_status st = dyd_mesh_first_triangle(first, m);
  if (st != DYD_OK || m->collinear) return st;
  if (!m->tri) m->tri = dyd_alloc(2 * (size_t)m->n + 2, sizeof *m->tri);
  if (!m->tri || !insert_has_room(m, 61, 63)) return DYD_E_NOMEM;
  dyd_mesh_put_first(m, first);
  return insert_all(m, first, cancel);
}
