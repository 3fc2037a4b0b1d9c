/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checking a skeleton edge by edge with the exact rung. */
#include "skeleton/mesh_invariant.h"

#include "dyadic/raw.h"
#include "skeleton/mesh_exact.h"

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
  unsigned g = dyd_mesh_ghost_corner(m, t);
  return dyd_mesh_orient_exact(m, v[dyd_next(g)], v[dyd_prev(g)], p) <= 0;
}

/* In the order of x, then y; exactly. */
static bool comes_before(const dyd_mesh *m, uint32_t v, uint32_t w) {
  dyd_rect p, q;
  dyd_rect_init(&p);
  dyd_rect_init(&q);
  (void)dyd_reps_get(&p, m->reps, dyd_mesh_rep(m, v));
  (void)dyd_reps_get(&q, m->reps, dyd_mesh_rep(m, w));
  int c = dyd_raw_cmp(&p.x.lo, q.x.den, &q.x.lo, p.x.den);
  if (c == 0) c = dyd_raw_cmp(&p.y.lo, q.y.den, &q.y.lo, p.y.den);
  dyd_rect_clear(&q);
  dyd_rect_clear(&p);
  return c < 0;
}

/* All hull edges are in one cycle, and it goes to the right once and back once: a cycle that is convex everywhere could
 * wind twice around overlapping parts. */
static bool hull_turns_once(const dyd_mesh *m) {
  uint32_t ghosts = 0, met = 0, turns = 0, first = DYD_NONE;
  for (uint32_t t = 0; t < m->count; t++)
    if (dyd_mesh_is_ghost(m, t)) {
      ghosts++;
      first = t;
    }
  if (first == DYD_NONE) return false;
  uint32_t t = first;
  bool before = false;
  do {
    const uint32_t *v = m->tri[t].v;
    unsigned g = dyd_mesh_ghost_corner(m, t);
    bool right = comes_before(m, v[dyd_prev(g)], v[dyd_next(g)]);
    turns += met && right != before;
    before = right;
    t = m->tri[t].n[dyd_prev(g)] >> 2;
  } while (++met <= ghosts && t != first);
  return met == ghosts && turns <= 2;
}

bool dyd_mesh_check(dyd_mesh *m) {
  if (m->count == 0) return true; /* all on one line */
  if (!hull_turns_once(m)) return false;
  for (uint32_t t = 0; t < m->count; t++) {
    const uint32_t *v = m->tri[t].v;
    if (!dyd_mesh_is_ghost(m, t) && dyd_mesh_orient_exact(m, v[0], v[1], v[2]) <= 0) return false;
    for (unsigned k = 0; k < 3; k++)
      if (!twins_agree(m, t, k) || !edge_is_delaunay(m, t, k)) return false;
  }
  return true;
}
