/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checking a skeleton edge by edge with the exact rung. */
#include "skeleton/mesh_invariant.h"

#include "dyadic/raw.h"
#include "skeleton/half_edge.h"
#include "skeleton/mesh_exact.h"

static bool twins_agree(const dyd_mesh *m, dyd_half_edge h) {
  dyd_half_edge twin = dyd_edge_twin(m, h);
  return dyd_edge_triangle(twin) < m->count && dyd_edge_corner(twin) < 3 && dyd_edge_twin(m, twin) == h &&
         dyd_edge_origin(m, twin) == dyd_edge_target(m, h) && dyd_edge_target(m, twin) == dyd_edge_origin(m, h);
}

static bool edge_is_delaunay(const dyd_mesh *m, dyd_half_edge h) {
  uint32_t t = dyd_edge_triangle(h), p = dyd_edge_across(m, h);
  const uint32_t *v = m->tri[t].v;
  if (p == m->n) return true;
  if (!dyd_is_ghost_triangle(m, t)) return dyd_mesh_incircle_exact(m, v[0], v[1], v[2], p) <= 0;
  dyd_half_edge hull = dyd_hull_edge(m, t);
  return dyd_mesh_orient_exact(m, dyd_edge_origin(m, hull), dyd_edge_target(m, hull), p) <= 0;
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
  uint32_t ghosts = 0, met = 0, turns = 0;
  for (uint32_t t = 0; t < m->count; t++) ghosts += dyd_is_ghost_triangle(m, t);
  if (!ghosts) return false;
  dyd_half_edge first = dyd_hull_first(m), h = first;
  bool before = false;
  do {
    bool right = comes_before(m, dyd_hull_origin(m, h), dyd_hull_target(m, h));
    turns += met && right != before;
    before = right;
    h = dyd_hull_following(m, h);
  } while (++met <= ghosts && h != first);
  return met == ghosts && turns <= 2;
}

bool dyd_mesh_is_valid(const dyd_mesh *m) {
  if (m->count == 0) return true; /* all on one line */
  if (!hull_turns_once(m)) return false;
  for (uint32_t t = 0; t < m->count; t++) {
    const uint32_t *v = m->tri[t].v;
    if (!dyd_is_ghost_triangle(m, t) && dyd_mesh_orient_exact(m, v[0], v[1], v[2]) <= 0) return false;
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++)
      if (!twins_agree(m, h) || !edge_is_delaunay(m, h)) return false;
  }
  return true;
}
