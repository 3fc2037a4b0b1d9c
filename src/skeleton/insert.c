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
  if (dyd_build_orient(m, a, b, v) < 0) {
    h = dyd_edge_twin(m, h);
    a = b;
    b = c;
  }
  while ((c = dyd_edge_apex(m, h)) != m->n) { /* the triangle a b c, entered over a b */
    if (dyd_build_orient(m, b, c, v) < 0) {
      h = dyd_edge_twin(m, dyd_edge_next(h));
      a = c;
    } else if (dyd_build_orient(m, c, a, v) < 0) {
      h = dyd_edge_twin(m, dyd_edge_prev(h));
      b = c;
    } else
      break;
  }
  return dyd_edge_triangle(h);
}

/* Room for one more stack frame (two edges) and one more free triangle. */
static bool insert_has_room(dyd_mesh *m, size_t stacked, size_t spares) {
  return dyd_reserve((void **)&m->stack, &m->stack_cap, stacked + 3, sizeof *m->stack) &&
         dyd_reserve((void **)&m->spare, &m->spare_cap, spares + 1, sizeof *m->spare);
}

/* Joins v to the rim of the cavity that grows from t. Triangles come out counter-clockwise around v, so each is linked
 * to the one before it. */
static dyd_status insert_at(dyd_mesh *m, uint32_t v, uint32_t t) {
  size_t stacked = 0, spares = 0;
  uint32_t first = DYD_NONE, before = DYD_NONE;
  for (unsigned k = 3; k-- > 0;) m->stack[stacked++] = m->tri[t].n[k];
  m->spare[spares++] = t;
  while (stacked) {
    dyd_half_edge h = m->stack[--stacked];
    dyd_tri *o = &m->tri[dyd_edge_triangle(h)];
    unsigned k = dyd_edge_corner(h);
    uint32_t b = o->v[dyd_next(k)], a = o->v[dyd_prev(k)];
    if (dyd_build_incircle(m, o->v[k], b, a, v) > 0) {
      if (!insert_has_room(m, stacked, spares)) return DYD_E_NOMEM;
      m->stack[stacked++] = o->n[dyd_prev(k)];
      m->stack[stacked++] = o->n[dyd_next(k)];
      m->spare[spares++] = dyd_edge_triangle(h);
      continue;
    }
    uint32_t q = spares ? m->spare[--spares] : m->count++;
    m->tri[q] = (dyd_tri){{v, a, b}, {h, DYD_NONE, dyd_edge_of(before, 1)}};
    o->n[k] = dyd_edge_of(q, 0);
    if (before == DYD_NONE)
      first = q;
    else
      m->tri[before].n[1] = dyd_edge_of(q, 2);
    before = q;
  }
  dyd_edge_join(m, dyd_edge_of(first, 2), dyd_edge_of(before, 1));
  m->hint = before;
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
