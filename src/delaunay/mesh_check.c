/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checking a skeleton edge by edge with the exact rung. */
#include "delaunay/mesh_check.h"

#include "delaunay/mesh_exact.h"

static bool twins_agree(const dyd_mesh *m, uint32_t t, unsigned k) {
  uint32_t h = m->tri[t].n[k], s = h >> 2;
  unsigned q = h & 3;
  return s < m->count && q < 3 && m->tri[s].n[q] == 4 * t + k && m->tri[s].v[dyd_next(q)] == m->tri[t].v[dyd_prev(k)] &&
         m->tri[s].v[dyd_prev(q)] == m->tri[t].v[dyd_next(k)];
}

static bool edge_is_delaunay(dyd_mesh *m, uint32_t t, unsigned k) {
  const uint32_t *v = m->tri[t].v;
  uint32_t h = m->tri[t].n[k], p = m->tri[h >> 2].v[h & 3];
  if (p == m->n) return true;
  if (!dyd_mesh_is_ghost(m, t)) return dyd_mesh_incircle_exact(m, v[0], v[1], v[2], p) <= 0;
  unsigned g = v[0] == m->n ? 0 : v[1] == m->n ? 1 : 2;
  return dyd_mesh_orient_exact(m, v[dyd_next(g)], v[dyd_prev(g)], p) <= 0;
}

bool dyd_mesh_check(dyd_mesh *m) {
  for (uint32_t t = 0; t < m->count; t++) {
    const uint32_t *v = m->tri[t].v;
    if (!dyd_mesh_is_ghost(m, t) && dyd_mesh_orient_exact(m, v[0], v[1], v[2]) <= 0) return false;
    for (unsigned k = 0; k < 3; k++)
      if (!twins_agree(m, t, k) || !edge_is_delaunay(m, t, k)) return false;
  }
  return true;
}
