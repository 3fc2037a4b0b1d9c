/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The first triangle of a skeleton, and what happens when representatives coincide or are collinear. */
#include "skeleton/mesh_start.h"

#include "base/alloc.h"
#include "skeleton/mesh_exact.h"
#include "skeleton/mesh_fixed.h"
#include "skeleton/predicates.h"

#include <math.h>
#include <string.h>

bool dyd_mesh_is_point(const dyd_mesh *m, uint32_t v) {
  return dyd_sites_is_point(m->reps->sites, m->reps->site[dyd_mesh_rep(m, v)]);
}

dyd_status dyd_mesh_set_alias(dyd_mesh *m, uint32_t v, uint32_t of) {
  if (!m->alias) {
    m->alias = dyd_alloc(m->n, sizeof *m->alias);
    if (!m->alias) return DYD_E_NOMEM;
    memset(m->alias, 0xff, m->n * sizeof *m->alias);
  }
  m->alias[v] = of;
  return DYD_OK;
}

/* Representatives stay inside their rectangles, whose extent only shrinks. */
static void set_extent(dyd_mesh *m) {
  for (int a = 0; a < 2; a++) {
    double lo = INFINITY, hi = -INFINITY;
    for (uint32_t v = 0; v < m->n; v++) {
      uint32_t i = m->local ? m->reps->site[m->local[v]] : v; /* all sites: in their own order */
      double l = dyd_sites_lo(m->reps->sites, a, i), h = dyd_sites_hi(m->reps->sites, a, i);
      lo = l < lo ? l : lo;
      hi = h > hi ? h : hi;
    }
    m->extent[a] = m->n ? hi - lo : 0;
  }
}

void dyd_mesh_follow(dyd_mesh *m) {
  m->incircle_delta = m->no_filter ? INFINITY : m->reps->delta;
  m->orient_bound = dyd_filter_orient_bound(m->extent[0], m->extent[1], m->reps->delta);
  if (m->no_filter || isnan(m->orient_bound)) m->orient_bound = INFINITY;
}

dyd_status dyd_mesh_coordinates(dyd_mesh *m) {
  m->xy = m->reps->xy;
  if (m->local) {
    m->own_xy = dyd_alloc((size_t)m->n + 1, sizeof *m->own_xy);
    if (!m->own_xy) return DYD_E_NOMEM;
    for (uint32_t v = 0; v < m->n; v++) m->own_xy[v] = m->reps->xy[m->local[v]];
    m->own_xy[m->n] = (dyd_xy){NAN, NAN};
    m->xy = m->own_xy;
  }
  set_extent(m);
  dyd_mesh_follow(m);
  return DYD_OK;
}

/* A moved point may be inexact: the constants follow, and the grid is made anew. */
dyd_status dyd_mesh_move(dyd_mesh *m, uint32_t v, uint32_t k) {
  if (m->part) return m->stuck = true, DYD_CANCELLED;
  uint32_t r = dyd_mesh_rep(m, v);
  dyd_status st = dyd_reps_choose(m->reps, r, k);
  if (st != DYD_OK) return st;
  if (m->own_xy) m->own_xy[v] = m->reps->xy[r];
  dyd_fixed_free(m->fixed);
  m->fixed = NULL;
  m->no_fixed = ++m->moved > 16; /* the grid costs O(n) each time */
  m->exact_s = m->no_fixed ? -1 : 0;
  dyd_mesh_follow(m);
  return DYD_OK;
}

/* Moves v, or makes it an alias, until it differs from w. *differs: v is a vertex of its own. */
static dyd_status separate(bool *differs, dyd_mesh *m, uint32_t v, uint32_t w) {
  dyd_status st = DYD_OK;
  *differs = true;
  for (uint32_t k = 1; st == DYD_OK && dyd_mesh_same(m, v, w); k++) {
    if (dyd_mesh_is_point(m, v)) {
      *differs = false;
      return dyd_mesh_set_alias(m, v, w);
    }
    st = dyd_mesh_move(m, v, k);
  }
  return st;
}

/* The first two vertices that differ from each other and from `without`; false when there are none. */
static bool two_others(uint32_t pair[2], dyd_mesh *m, uint32_t without) {
  unsigned found = 0;
  for (uint32_t v = m->begin; v < m->end && found < 2; v++) {
    if (v == without || dyd_mesh_alias(m, v) != DYD_NONE) continue;
    if (found == 0 || !dyd_mesh_same(m, pair[0], v)) pair[found++] = v;
  }
  return found == 2;
}

/* Is every choice of points collinear: all rectangles on one vertical or horizontal line, or all of them exact points
 * whose representatives are collinear (as they are when this is asked), or at most two different sites? */
static dyd_status always_collinear(bool *always, dyd_mesh *m) {
  bool vertical = true, horizontal = true, points = true;
  uint32_t alive = 0;
  dyd_rect first, r;
  dyd_rect_init(&first);
  dyd_rect_init(&r);
  dyd_status st = DYD_OK;
  for (uint32_t v = m->begin; v < m->end && st == DYD_OK; v++) {
    if (dyd_mesh_alias(m, v) != DYD_NONE) continue;
    st = dyd_sites_get(alive ? &r : &first, m->reps->sites, m->reps->site[dyd_mesh_rep(m, v)]);
    if (!alive++) dyd_rect_set(&r, &first);
    points = points && dyd_rect_is_point(&r);
    vertical = vertical && dyd_interval_is_point(&r.x) && dyd_interval_contains(&first.x, &r.x);
    horizontal = horizontal && dyd_interval_is_point(&r.y) && dyd_interval_contains(&first.y, &r.y);
  }
  *always = vertical || horizontal || points || alive <= 2;
  dyd_rect_clear(&r);
  dyd_rect_clear(&first);
  return st;
}

/* Moves v off the line of two others, if it can; *done: first is a triangle. */
static dyd_status step_aside(bool *done, uint32_t first[3], dyd_mesh *m, uint32_t v, uint32_t k) {
  uint32_t pair[2];
  *done = false;
  if (dyd_mesh_alias(m, v) != DYD_NONE || dyd_mesh_is_point(m, v) || !two_others(pair, m, v)) return DYD_OK;
  for (uint32_t last = k + 4; k < last; k++) {
    dyd_status st = dyd_mesh_move(m, v, k);
    if (st != DYD_OK) return st;
    if (dyd_build_orient(m, pair[0], pair[1], v) == 0) continue;
    first[0] = pair[0];
    first[1] = pair[1];
    first[2] = v;
    *done = true;
    break;
  }
  return DYD_OK;
}

/* All representatives are collinear: a fat rectangle that reaches off their line gives the triangle. Three different
 * fractions of a rectangle are never collinear, unless it is a segment, and a segment meets a line once or lies in it.
 * A vertex that has to wait until two others have moved apart is reached in a later round; fractions differ from vertex
 * to vertex. */
static dyd_status leave_line(uint32_t first[3], dyd_mesh *m) {
  dyd_status st = always_collinear(&m->collinear, m);
  bool done = m->collinear;
  for (uint32_t round = 0; !done && st == DYD_OK; round++)
    for (uint32_t v = m->begin; v < m->end && !done && st == DYD_OK; v++)
      st = step_aside(&done, first, m, v, 1 + 4 * (v % 1024) + round % 1024);
  return st;
}

void dyd_mesh_set_rounds(dyd_mesh *m) {
  enum { FETCH_AHEAD = 24 };
  const dyd_sites *s = m->reps->sites;
  bool fat = false;
  m->rounds = 1;
  if (m->part || dyd_sites_are_double_points(m->reps->sites)) return; /* one strip: points come first */
  for (uint32_t v = m->begin; v < m->end && m->rounds == 1; v++) {
    if (m->end - v > FETCH_AHEAD) dyd_sites_fetch(s, m->reps->site[dyd_mesh_rep(m, v + FETCH_AHEAD)]);
    if (m->end - v > FETCH_AHEAD / 2) dyd_sites_fetch_exact(s, m->reps->site[dyd_mesh_rep(m, v + FETCH_AHEAD / 2)]);
    bool point = dyd_mesh_is_point(m, v);
    if (point && fat) m->rounds = 2;
    fat = fat || !point;
  }
}

bool dyd_mesh_has_turn(const dyd_mesh *m, uint32_t v, unsigned round) {
  return m->rounds == 1 || dyd_mesh_is_point(m, v) == (round == 0);
}

/* Takes v into first[found] if it makes a triangle. */
static dyd_status take_first(unsigned *found, uint32_t first[3], dyd_mesh *m, uint32_t v) {
  bool differs = true;
  dyd_status st = *found >= 1 ? separate(&differs, m, v, first[0]) : DYD_OK;
  if (st != DYD_OK || !differs) return st;
  if (*found < 2 || dyd_build_orient(m, first[0], first[1], v)) first[(*found)++] = v;
  return DYD_OK;
}

dyd_status dyd_mesh_first_triangle(uint32_t first[3], dyd_mesh *m) {
  unsigned found = 0;
  dyd_status st = DYD_OK;
  for (unsigned round = 0; round < m->rounds; round++)
    for (uint32_t v = m->begin; v < m->end && found < 3 && st == DYD_OK; v++)
      if (dyd_mesh_has_turn(m, v, round) && dyd_mesh_alias(m, v) == DYD_NONE) st = take_first(&found, first, m, v);
  if (st == DYD_OK && found < 3 && m->part) return m->stuck = true, DYD_CANCELLED;
  if (st == DYD_OK && found < 3) st = leave_line(first, m);
  if (st == DYD_OK && !m->collinear && dyd_build_orient(m, first[0], first[1], first[2]) < 0) {
    uint32_t t = first[0];
    first[0] = first[1];
    first[1] = t;
  }
  return st;
}

void dyd_mesh_put_first(dyd_mesh *m, const uint32_t first[3]) {
  uint32_t t = 2 * m->begin;
  m->tri[t] = (dyd_tri){{first[0], first[1], first[2]}, {0, 0, 0}};
  for (unsigned k = 0; k < 3; k++) m->tri[t + 1 + k] = (dyd_tri){{first[dyd_next(k)], first[k], m->n}, {0, 0, 0}};
  for (unsigned k = 0; k < 3; k++) {
    dyd_edge_join(m, dyd_edge_of(t, dyd_prev(k)), dyd_edge_of(t + 1 + k, 2));
    dyd_edge_join(m, dyd_edge_of(t + 1 + k, 0), dyd_edge_of(t + 1 + dyd_prev(k), 1));
  }
  m->count = t + 4;
  m->hint = t;
}

void dyd_mesh_trim(dyd_mesh *m) {
  dyd_fixed_free(m->fixed);
  free(m->rim);
  free(m->spare);
  m->fixed = NULL;
  m->exact_s = -1;
  m->no_fixed = true; /* later questions are few, and the grid would cost O(n) */
  m->rim = NULL;
  m->spare = NULL;
  m->rim_cap = m->spare_cap = 0;
}

void dyd_mesh_clear(dyd_mesh *m) {
  dyd_mesh_trim(m);
  free(m->own_xy);
  free(m->tri);
  free(m->alias);
  memset(m, 0, sizeof *m);
}
