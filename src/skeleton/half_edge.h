/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Half-edges: the one name for a place in a triangulation.
 *
 * Half-edge 4 t + k of triangle t is opposite v[k] and runs from v[k+1] to v[k+2], counter-clockwise, t on its left.
 * Its twin runs back, in the triangle beyond. Of two twins the one with the smaller number is "first". Nobody else
 * takes half-edges apart. */
#ifndef DYD_SKELETON_HALF_EDGE_H
#define DYD_SKELETON_HALF_EDGE_H

#include "skeleton/mesh.h"

/* Corner after, before corner k of a triangle. */
static inline unsigned dyd_next(unsigned k) {
  return (9u >> (2 * k)) & 3u;
}
static inline unsigned dyd_prev(unsigned k) {
  return (18u >> (2 * k)) & 3u;
}

static inline dyd_half_edge dyd_edge_of(uint32_t t, unsigned k) {
  return 4 * t + k;
}
/* The triangle on its left, and which of its corners it is opposite to. */
static inline uint32_t dyd_edge_triangle(dyd_half_edge h) {
  return h >> 2;
}
static inline unsigned dyd_edge_corner(dyd_half_edge h) {
  return h & 3;
}
/* The three half-edges of t: from dyd_edge_of(t, 0) to below this. */
static inline dyd_half_edge dyd_edge_end(uint32_t t) {
  return 4 * t + 3;
}
/* Around its triangle. */
static inline dyd_half_edge dyd_edge_next(dyd_half_edge h) {
  return (h & ~3u) | dyd_next(h & 3);
}
static inline dyd_half_edge dyd_edge_prev(dyd_half_edge h) {
  return (h & ~3u) | dyd_prev(h & 3);
}

static inline dyd_half_edge dyd_edge_twin(const dyd_mesh *m, dyd_half_edge h) {
  return m->tri[h >> 2].n[h & 3];
}
static inline bool dyd_edge_is_first(const dyd_mesh *m, dyd_half_edge h) {
  return h < dyd_edge_twin(m, h);
}
static inline uint32_t dyd_edge_origin(const dyd_mesh *m, dyd_half_edge h) {
  return m->tri[h >> 2].v[dyd_next(h & 3)];
}
static inline uint32_t dyd_edge_target(const dyd_mesh *m, dyd_half_edge h) {
  return m->tri[h >> 2].v[dyd_prev(h & 3)];
}
/* The third vertex of its triangle; of the triangle beyond. */
static inline uint32_t dyd_edge_apex(const dyd_mesh *m, dyd_half_edge h) {
  return m->tri[h >> 2].v[h & 3];
}
static inline uint32_t dyd_edge_across(const dyd_mesh *m, dyd_half_edge h) {
  return dyd_edge_apex(m, dyd_edge_twin(m, h));
}
/* The next half-edge out of the same origin, counter-clockwise; clockwise. */
static inline dyd_half_edge dyd_edge_turn(const dyd_mesh *m, dyd_half_edge h) {
  return dyd_edge_twin(m, dyd_edge_prev(h));
}
static inline dyd_half_edge dyd_edge_turn_back(const dyd_mesh *m, dyd_half_edge h) {
  return dyd_edge_next(dyd_edge_twin(m, h));
}
/* Is one of its ends the ghost? */
static inline bool dyd_edge_meets_ghost(const dyd_mesh *m, dyd_half_edge h) {
  return dyd_edge_origin(m, h) == m->n || dyd_edge_target(m, h) == m->n;
}
static inline void dyd_edge_join(dyd_mesh *m, dyd_half_edge h, dyd_half_edge twin) {
  m->tri[h >> 2].n[h & 3] = twin;
  m->tri[twin >> 2].n[twin & 3] = h;
}

static inline bool dyd_is_ghost_triangle(const dyd_mesh *m, uint32_t t) {
  const uint32_t *v = m->tri[t].v;
  return v[0] == m->n || v[1] == m->n || v[2] == m->n;
}

/* The half-edges of t that are first and real, as bits. */
static inline unsigned dyd_edges_first_named(const dyd_mesh *m, uint32_t t) {
  const dyd_tri *at = &m->tri[t];
  unsigned first =
      (unsigned)(at->n[0] > 4 * t) | (unsigned)(at->n[1] > 4 * t + 1) << 1 | (unsigned)(at->n[2] > 4 * t + 2) << 2;
  if (!dyd_is_ghost_triangle(m, t)) return first;
  return first & (at->v[0] == m->n ? 1u : at->v[1] == m->n ? 2u : 4u);
}

/* ---- along the hull ----
 *
 * A hull edge is named by its half-edge in the ghost triangle beyond it: opposite the ghost, so that it runs from
 * target to origin when the inside is on the left. */

/* The hull edge of the ghost triangle t. */
static inline dyd_half_edge dyd_hull_edge(const dyd_mesh *m, uint32_t t) {
  const uint32_t *v = m->tri[t].v;
  return dyd_edge_of(t, v[0] == m->n ? 0 : v[1] == m->n ? 1 : 2);
}
static inline uint32_t dyd_hull_origin(const dyd_mesh *m, dyd_half_edge h) {
  return dyd_edge_target(m, h);
}
static inline uint32_t dyd_hull_target(const dyd_mesh *m, dyd_half_edge h) {
  return dyd_edge_origin(m, h);
}
/* The hull edge that begins where h ends, the one that ends where h begins. */
static inline dyd_half_edge dyd_hull_following(const dyd_mesh *m, dyd_half_edge h) {
  return dyd_edge_prev(dyd_edge_twin(m, dyd_edge_prev(h)));
}
static inline dyd_half_edge dyd_hull_preceding(const dyd_mesh *m, dyd_half_edge h) {
  return dyd_edge_next(dyd_edge_twin(m, dyd_edge_next(h)));
}
/* The hull edge of the lowest number; DYD_NONE when there is no triangle. */
static inline dyd_half_edge dyd_hull_first(const dyd_mesh *m) {
  for (uint32_t t = 0; t < m->count; t++)
    if (dyd_is_ghost_triangle(m, t)) return dyd_hull_edge(m, t);
  return DYD_NONE;
}

#endif
