/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Building a skeleton: its coordinates, then its strips or all vertices. */
#include "skeleton/mesh_build.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include "base/local.h"
#include "base/parallel.h"
#include "rect/rect.h"
#include "rect/sites_table.h"
#include "skeleton/mesh.h"
#include "skeleton/mesh_filter.h"

#include <math.h>
#include <string.h>

/* ---- the first triangle; representatives that coincide or are collinear ---- */

/* Returns true if the site of v is an exact point. */
static bool mesh_is_point(const dyd_mesh *m, uint32_t v) {
  return dyd_site_is_point(m->reps->sites, m->reps->site[dyd_mesh_rep(m, v)]);
}

static void no_aliases(dyd_mesh *m, uint32_t from, uint32_t end) {
  for (uint32_t v = from; v < end; v++) m->alias[v] = DYD_NONE;
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

void dyd_mesh_coordinates(dyd_mesh *m) {
  m->xy = m->own_xy ? m->own_xy : m->reps->xy;
  for (uint32_t v = 0; v < m->n && m->own_xy; v++) m->own_xy[v] = m->reps->xy[m->local[v]];
  if (m->own_xy) m->own_xy[m->n] = (dyd_xy){NAN, NAN};
  set_extent(m);
  dyd_mesh_follow(m);
}

/* Moves the representative of v to fraction k of its rectangle. A moved point may be inexact: the constants follow, and
 * the grid is made anew. */
static dyd_status mesh_move(dyd_mesh *m, uint32_t v, uint32_t k) {
  if (m->part) return m->stuck = true, DYD_CANCELLED;
  uint32_t r = dyd_mesh_rep(m, v);
  dyd_status st = dyd_reps_choose(m->reps, r, k);
  if (st != DYD_OK) return st;
  if (m->own_xy) m->own_xy[v] = m->reps->xy[r];
  m->no_fixed = ++m->moved > 16; /* the grid costs O(n) each time */
  m->exact_s = m->no_fixed ? -1 : 0;
  dyd_mesh_follow(m);
  return DYD_OK;
}

bool dyd_mesh_same(const dyd_mesh *m, uint32_t a, uint32_t b) {
  if (m->xy[a].x != m->xy[b].x || m->xy[a].y != m->xy[b].y) return false;
  if (dyd_reps_is_double(m->reps, dyd_mesh_rep(m, a)) && dyd_reps_is_double(m->reps, dyd_mesh_rep(m, b))) return true;
  DYD_LOCAL(dyd_rect, p, q);
  return dyd_mesh_get(&p, m, a) == DYD_OK && dyd_mesh_get(&q, m, b) == DYD_OK && dyd_rect_equal(&p, &q);
}

/* Moves v, or makes it an alias, until it differs from w. *differs: v is a vertex of its own. */
static dyd_status separate(bool *differs, dyd_mesh *m, uint32_t v, uint32_t w) {
  dyd_status st = DYD_OK;
  *differs = true;
  for (uint32_t k = 1; st == DYD_OK && dyd_mesh_same(m, v, w); k++) {
    if (mesh_is_point(m, v)) {
      *differs = false;
      m->alias[v] = w;
      return DYD_OK;
    }
    st = mesh_move(m, v, k);
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

/* Sets *always to whether every choice of points is collinear: all rectangles on one vertical or horizontal line, or
 * all of them exact points whose representatives are collinear (as they are when this is asked), or at most two
 * different sites. */
static dyd_status always_collinear(bool *always, dyd_mesh *m) {
  bool vertical = true, horizontal = true, points = true;
  uint32_t alive = 0;
  DYD_LOCAL(dyd_rect, first, r);
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
  return st;
}

/* Moves v off the line of two others, if it can; *done: first is a triangle. */
static dyd_status step_aside(bool *done, uint32_t first[3], dyd_mesh *m, uint32_t v, uint32_t k) {
  uint32_t pair[2];
  *done = false;
  if (dyd_mesh_alias(m, v) != DYD_NONE || mesh_is_point(m, v) || !two_others(pair, m, v)) return DYD_OK;
  for (uint32_t last = k + 4; k < last; k++) {
    dyd_status st = mesh_move(m, v, k);
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

/* A point that coincides with a vertex becomes its alias, anything else gives way; so points have to come first. Where
 * the order is another one, as that of several strips is, vertices are taken in two rounds. */
static void set_rounds(dyd_mesh *m) {
  enum { FETCH_AHEAD = 24 };
  const dyd_sites *s = m->reps->sites;
  bool fat = false;
  m->rounds = 1;
  if (m->part || dyd_sites_are_double_points(m->reps->sites)) return; /* one strip: points come first */
  for (uint32_t v = m->begin; v < m->end && m->rounds == 1; v++) {
    bool point = mesh_is_point(m, v);
    if (m->end - v > FETCH_AHEAD) dyd_sites_fetch(s, m->reps->site[dyd_mesh_rep(m, v + FETCH_AHEAD)]);
    if (m->end - v > FETCH_AHEAD / 2) dyd_sites_fetch_exact(s, m->reps->site[dyd_mesh_rep(m, v + FETCH_AHEAD / 2)]);
    if (point && fat) m->rounds = 2;
    fat = fat || !point;
  }
}

static bool mesh_has_turn(const dyd_mesh *m, uint32_t v, unsigned round) {
  return m->rounds == 1 || mesh_is_point(m, v) == (round == 0);
}

/* Takes v into first[found] if it makes a triangle. */
static dyd_status take_first(unsigned *found, uint32_t first[3], dyd_mesh *m, uint32_t v) {
  bool differs = true;
  dyd_status st = *found >= 1 ? separate(&differs, m, v, first[0]) : DYD_OK;
  if (st != DYD_OK || !differs) return st;
  if (*found < 2 || dyd_build_orient(m, first[0], first[1], v)) first[(*found)++] = v;
  return DYD_OK;
}

/* Finds three vertices that make a triangle, counter-clockwise; moves representatives where that is needed and
 * possible; sets m->collinear when every choice is collinear (or there are fewer than three distinct sites). */
static dyd_status mesh_first_triangle(uint32_t first[3], dyd_mesh *m) {
  unsigned found = 0;
  dyd_status st = DYD_OK;
  for (unsigned round = 0; round < m->rounds; round++)
    for (uint32_t v = m->begin; v < m->end && found < 3 && st == DYD_OK; v++)
      if (mesh_has_turn(m, v, round) && dyd_mesh_alias(m, v) == DYD_NONE) st = take_first(&found, first, m, v);
  if (st == DYD_OK && found < 3 && m->part) return m->stuck = true, DYD_CANCELLED;
  if (st == DYD_OK && found < 3) st = leave_line(first, m);
  if (st == DYD_OK && !m->collinear && dyd_build_orient(m, first[0], first[1], first[2]) < 0) {
    uint32_t t = first[0];
    first[0] = first[1];
    first[1] = t;
  }
  return st;
}

/* The first triangle and its three ghost triangles. */
static void mesh_put_first(dyd_mesh *m, const uint32_t first[3]) {
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
  dyd_free_all(m->fixed, m->rim, m->spare);
  m->fixed = NULL;
  m->exact_s = -1;
  m->no_fixed = true; /* later questions are few, and the grid would cost O(n) */
  m->rim = NULL;
  m->spare = NULL;
  m->rim_cap = m->spare_cap = 0;
}

void dyd_mesh_clear(dyd_mesh *m) {
  dyd_mesh_trim(m);
  dyd_free_all(m->own_xy, m->tri, m->alias);
  memset(m, 0, sizeof *m);
}

/* ---- insertion ---- */

/* A triangle whose circle holds v, which is not a vertex: the real triangle around it, or a ghost triangle whose hull
 * edge it is beyond. The walk goes over an edge only when v is strictly beyond it; it ends since the power of v
 * decreases, or inside one cocircular polygon, whose dual is a tree that is never walked back. */
static uint32_t mesh_locate(dyd_mesh *m, uint32_t v) {
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
struct dyd_cavity_edge {
  dyd_half_edge beyond; /* in the triangle beyond */
  uint32_t b;
  dyd_seen seen; /* b from the new vertex */
  double cross;  /* of a and b */
};

/* Room for one more edge of the rim and one more free triangle. */
static inline bool insert_has_room(dyd_mesh *m, size_t edges, size_t spares) {
  return (edges < m->rim_cap || DYD_GROW(m->rim, m->rim_cap, edges + 1)) &&
         (spares < m->spare_cap || DYD_GROW(m->spare, m->spare_cap, spares + 1));
}

/* The rim of the triangle t alone; returns where it begins. The edge to be examined next is the last one. */
static inline dyd_seen rim_of_triangle(dyd_mesh *m, dyd_xy p, uint32_t t) {
  const dyd_tri *at = &m->tri[t];
  dyd_seen seen[3];
  for (unsigned k = 0; k < 3; k++) seen[k] = dyd_see(m->xy[at->v[k]], p);
  for (unsigned k = 0; k < 3; k++) {
    unsigned a = dyd_next(k), b = dyd_prev(k);
    m->rim[2 - k] = (struct dyd_cavity_edge){at->n[k], at->v[b], seen[b], dyd_seen_cross(seen[a], seen[b])};
  }
  return seen[1];
}

/* Triangles around a new vertex, counter-clockwise. */
typedef struct triangle_fan {
  uint32_t first, last;
} triangle_fan;

/* q becomes the next one: v and the rim's edge from a to b, beyond which is h. */
static inline void fan_add(triangle_fan *f, dyd_mesh *m, uint32_t q, uint32_t v, uint32_t a, uint32_t b,
                           dyd_half_edge h) {
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
  triangle_fan f = {DYD_NONE, DYD_NONE};
  m->spare[0] = m->count + 1;
  m->spare[1] = m->count;
  m->spare[2] = t;
  while (edges) {
    struct dyd_cavity_edge *r = &m->rim[edges - 1];
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
      m->rim[edges++] = (struct dyd_cavity_edge){o->n[dyd_next(k)], c, sc, ac};
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
    uint32_t t = mesh_locate(m, v);
    uint32_t same = same_vertex(m, v, t);
    if (same == DYD_NONE) return insert_at(m, v, t);
    if (mesh_is_point(m, v)) {
      DYD_INVARIANT(mesh_is_point(m, same));
      m->alias[v] = same;
      return DYD_OK;
    }
    dyd_status st = mesh_move(m, v, m->moved + 1);
    if (st != DYD_OK) return st;
  }
}

void dyd_mesh_find(uint32_t *t, uint32_t *same, dyd_mesh *m, uint32_t v) {
  *t = mesh_locate(m, v);
  *same = same_vertex(m, v, *t);
}

dyd_status dyd_mesh_put(dyd_mesh *m, uint32_t v, uint32_t t) {
  return insert_has_room(m, 61, 63) ? insert_at(m, v, t) : DYD_E_NOMEM;
}

dyd_status dyd_mesh_grow(dyd_mesh *m, uint32_t n, uint32_t ghost, const double width[2]) {
  size_t cap = 0;
  const dyd_half_edge first = dyd_hull_edge(m, ghost);
  dyd_half_edge h = first;
  if (!DYD_GROW(m->tri, cap, 2 * (size_t)n + 2)) return DYD_E_NOMEM;
  cap = 0;
  uint32_t before = m->alias ? m->n : 0;
  if (!DYD_GROW(m->alias, cap, n)) return DYD_E_NOMEM;
  no_aliases(m, before, n);
  do m->tri[dyd_edge_triangle(h)].v[dyd_edge_corner(h)] = n;
  while ((h = dyd_hull_following(m, h)) != first);
  m->n = m->end = m->strips.begin[m->strips.count] = n;
  m->xy = m->reps->xy;
  for (int a = 0; a < 2; a++) m->extent[a] = width[a];
  dyd_mesh_follow(m);
  return DYD_OK;
}

static dyd_status insert_all(dyd_mesh *m, const uint32_t first[3], const volatile int *cancel) {
  for (unsigned round = 0; round < m->rounds; round++)
    for (uint32_t v = m->begin; v < m->end; v++) {
      if (v == first[0] || v == first[1] || v == first[2] || dyd_mesh_alias(m, v) != DYD_NONE) continue;
      if (!mesh_has_turn(m, v, round)) continue;
      if ((v & 1023) == 0 && dyd_flag_is_set(cancel)) return DYD_CANCELLED;
      dyd_status st = insert_vertex(m, v);
      if (st != DYD_OK) return st;
    }
  return DYD_OK;
}

/* Triangulates the vertices from begin to end; used on parts. DYD_CANCELLED also when a part is stuck. */
static dyd_status mesh_fill(dyd_mesh *m, const volatile int *cancel) {
  uint32_t first[3];
  set_rounds(m);
  dyd_status st = mesh_first_triangle(first, m);
  if (st != DYD_OK || m->collinear) return st;
  if (!insert_has_room(m, 61, 63)) return DYD_E_NOMEM;
  mesh_put_first(m, first);
  return insert_all(m, first, cancel);
}

/* ---- parts side by side, then seams in rounds: 0 with 1, 2 with 3, ...; then 0 with 2, ... ----
 *
 * Two meshes left and right of a vertical line are two spheres, each with the ghost. They are glued along the lower
 * common tangent of their hulls, where both are cut open from the hull to the ghost; then the seam is zipped upwards,
 * as in Guibas and Stolfi (1985), every step being one flip of an edge: deleting an inner edge next to the seam flips
 * it with its ghost triangle, adding an edge across flips the edge between two ghost triangles.
 *
 * [JOIN-1] The result is a Delaunay triangulation of the union, and every exact zero among the quads and hull corners
 * of its seam was met, so that [TIE-1] holds for joined meshes too. */

/* Some hull edge: the ghost triangle beyond which v lies. */
static dyd_half_edge hull_towards(dyd_mesh *m, uint32_t v) {
  return dyd_hull_edge(m, mesh_locate(m, v));
}

/* The hull edge that begins at the last (right) or first vertex in the order of x, then y; that order rises and falls
 * once around the hull. */
static dyd_half_edge seam_extreme(const dyd_mesh *m, dyd_half_edge h, bool right) {
  int way = right ? 1 : -1;
  while (way * dyd_mesh_compare(m, dyd_hull_target(m, h), dyd_hull_origin(m, h)) > 0) h = dyd_hull_following(m, h);
  while (way * dyd_mesh_compare(m, dyd_hull_origin(m, dyd_hull_preceding(m, h)), dyd_hull_origin(m, h)) > 0)
    h = dyd_hull_preceding(m, h);
  return h;
}

/* ---- the seam ---- */

/* Exact zeros are counted: the quad or corner may stay. */
static int seam_side(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p) {
  int sign = dyd_build_orient(m, a, b, p);
  if (!sign) m->tally.ties++;
  return sign;
}

/* Hull edges that begin at the ends a (left part) and b of the lower tangent: nothing lies below the line ab, nothing
 * on the segment between them. */
static void lower_tangent(dyd_half_edge *at_a, dyd_half_edge *at_b, dyd_mesh *m) {
  dyd_half_edge a = *at_a, b = *at_b;
  for (bool moved = true; moved;) {
    moved = false;
    while (seam_side(m, dyd_hull_origin(m, a), dyd_hull_origin(m, b), dyd_hull_origin(m, dyd_hull_preceding(m, a))) < 0)
      a = dyd_hull_preceding(m, a);
    for (; seam_side(m, dyd_hull_origin(m, a), dyd_hull_origin(m, b), dyd_hull_target(m, b)) < 0; moved = true)
      b = dyd_hull_following(m, b);
  }
  *at_a = a;
  *at_b = b;
}

/* The triangles (p i j) and (o j i) at edge h = i j become t = (p i o) and s = (o j p), vertices in this order. */
static void seam_flip(dyd_mesh *m, dyd_half_edge h) {
  dyd_half_edge twin = dyd_edge_twin(m, h);
  uint32_t t = dyd_edge_triangle(h), s = dyd_edge_triangle(twin);
  dyd_half_edge ij[2] = {dyd_edge_twin(m, dyd_edge_next(h)), dyd_edge_twin(m, dyd_edge_prev(h))};
  dyd_half_edge ji[2] = {dyd_edge_twin(m, dyd_edge_next(twin)), dyd_edge_twin(m, dyd_edge_prev(twin))};
  uint32_t p = dyd_edge_apex(m, h), i = dyd_edge_origin(m, h), j = dyd_edge_target(m, h), o = dyd_edge_apex(m, twin);
  m->tri[t] = (dyd_tri){{p, i, o}, {0, 0, 0}};
  m->tri[s] = (dyd_tri){{o, j, p}, {0, 0, 0}};
  dyd_edge_join(m, dyd_edge_of(t, 0), ji[0]);
  dyd_edge_join(m, dyd_edge_of(t, 1), dyd_edge_of(s, 1));
  dyd_edge_join(m, dyd_edge_of(t, 2), ij[1]);
  dyd_edge_join(m, dyd_edge_of(s, 0), ij[0]);
  dyd_edge_join(m, dyd_edge_of(s, 2), ji[1]);
}

/* Cuts both spheres open at a and b and puts two ghost triangles between, t and t + 1: of the hull edge a b, below, and
 * of b a, the seam's upper end, which is returned. */
static dyd_half_edge seam_glue(dyd_mesh *m, dyd_half_edge at_a, dyd_half_edge at_b, uint32_t t) {
  uint32_t a = dyd_hull_origin(m, at_a), b = dyd_hull_origin(m, at_b);
  dyd_half_edge after_a = dyd_edge_next(at_a), before_a = dyd_edge_twin(m, after_a);
  dyd_half_edge after_b = dyd_edge_next(at_b), before_b = dyd_edge_twin(m, after_b);
  m->tri[t] = (dyd_tri){{b, a, m->n}, {0, 0, 0}};
  m->tri[t + 1] = (dyd_tri){{a, b, m->n}, {0, 0, 0}};
  dyd_edge_join(m, dyd_edge_of(t, 2), dyd_edge_of(t + 1, 2));
  dyd_edge_join(m, dyd_edge_of(t, 0), before_a);
  dyd_edge_join(m, dyd_edge_of(t, 1), after_b);
  dyd_edge_join(m, dyd_edge_of(t + 1, 0), before_b);
  dyd_edge_join(m, dyd_edge_of(t + 1, 1), after_a);
  return dyd_edge_of(t + 1, 2);
}

/* The candidate on the left: the hull vertex q after a, once all edges a q whose inner triangle's apex is inside the
 * circle a b q are deleted; on the right: that before b. false: q is not above the base. */
static bool seam_candidate(uint32_t *q, dyd_mesh *m, dyd_half_edge top, bool left) {
  uint32_t a = dyd_hull_target(m, top), b = dyd_hull_origin(m, top);
  for (;;) {
    dyd_half_edge edge = left ? dyd_hull_following(m, top) : dyd_hull_preceding(m, top);
    uint32_t r = dyd_edge_across(m, edge);
    *q = left ? dyd_hull_target(m, edge) : dyd_hull_origin(m, edge);
    if (seam_side(m, a, b, *q) <= 0) return false;
    if (r == m->n || dyd_build_incircle(m, a, b, *q, r) <= 0) return true;
    seam_flip(m, edge);
  }
}

/* One edge across; *top follows. false: the base is the upper tangent. Were the triangle below on one circle with the
 * new one, a zero would have been met when it was made [JOIN-1]. */
static bool zip_one(dyd_half_edge *top, dyd_mesh *m) {
  uint32_t a = dyd_hull_target(m, *top), b = dyd_hull_origin(m, *top), p = DYD_NONE, q = DYD_NONE;
  bool left = seam_candidate(&q, m, *top, true), right = seam_candidate(&p, m, *top, false);
  if (!left && !right) return false;
  if (left && right) left = dyd_build_incircle(m, a, b, q, p) <= 0;
  dyd_half_edge at = left ? dyd_edge_prev(*top) : dyd_edge_next(*top), beyond = dyd_edge_twin(m, at);
  seam_flip(m, at); /* left: its triangle becomes (b, ghost, q); else the one beyond becomes (p, ghost, a) */
  *top = dyd_edge_of(dyd_edge_triangle(left ? at : beyond), 1);
  return true;
}

/* The part m grows by its right neighbour, whose predicates know too little; triangles m->count and m->count + 1 are
 * free. */
static void seam_join(dyd_mesh *m, const dyd_mesh *right) {
  dyd_fixed_join(m, right);
  m->end = right->end;
  dyd_half_edge at_a = seam_extreme(m, hull_towards(m, right->begin), true);
  m->hint = right->hint;
  dyd_half_edge at_b = seam_extreme(m, hull_towards(m, m->begin), false);
  lower_tangent(&at_a, &at_b, m);
  dyd_half_edge top = seam_glue(m, at_a, at_b, m->count);
  while (zip_one(&top, m)) continue;
  m->hint = dyd_edge_triangle(top);
  m->count = right->count;
}

/* ---- the parts ---- */

/* Triangles from .. to - 1 are free: aliases have none. */
typedef struct gap {
  uint32_t from, to;
} gap;

typedef struct seams {
  dyd_mesh part[DYD_STRIPS];
  dyd_status status[DYD_STRIPS];
  gap gap[DYD_STRIPS]; /* before part k */
  const volatile int *cancel;
  unsigned parts, stride;
} seams;

static void fill_part(void *context, size_t k) {
  seams *s = context;
  s->status[k] = mesh_fill(&s->part[k], s->cancel);
}

static void join_pair(void *context, size_t k) {
  seams *s = context;
  size_t left = 2 * k * s->stride, right = left + s->stride;
  if (right >= s->parts) return;
  dyd_mesh *m = &s->part[left], *r = &s->part[right];
  s->gap[right] = (gap){m->count + 2, 2 * r->begin};
  seam_join(m, r);
}

bool dyd_strips_are_apart(const dyd_reps *reps, const dyd_strips *strips) {
  double last = -INFINITY;
  if (strips->count < 2) return false;
  for (unsigned s = 0; s < strips->count; s++) {
    double lo = INFINITY, hi = -INFINITY;
    for (uint32_t v = strips->begin[s]; v < strips->begin[s + 1]; v++) {
      double x = reps->xy[v].x;
      if (x < lo) lo = x;
      if (x > hi) hi = x;
    }
    if (!(lo - last > 4 * reps->delta)) return false; /* an empty strip: lo is infinite */
    last = hi > last ? hi : last;
  }
  return true;
}

static void make_parts(seams *s, const dyd_mesh *m, const dyd_strips *strips) {
  for (unsigned k = 0; k < strips->count; k++) {
    uint32_t begin = strips->begin[k], end = strips->begin[k + 1];
    if (begin == end) continue;
    dyd_mesh *p = &s->part[s->parts];
    *p = *m;
    p->begin = begin;
    p->end = end;
    p->part = true;
    s->parts++;
  }
}

/* Fills the parts and joins them to the first one; *stuck: one of them was, none are joined. */
static dyd_status fill_and_join(bool *stuck, seams *s, unsigned threads) {
  dyd_status st = DYD_OK;
  dyd_parallel(threads, s->parts, fill_part, s);
  *stuck = false;
  for (unsigned k = 0; k < s->parts; k++) {
    *stuck = *stuck || s->part[k].stuck;
    if (st == DYD_OK && !s->part[k].stuck) st = s->status[k];
  }
  for (s->stride = 1; st == DYD_OK && !*stuck && s->stride < s->parts; s->stride *= 2)
    dyd_parallel(threads, (s->parts + 2 * s->stride - 1) / (2 * s->stride), join_pair, s);
  return st;
}

/* Triangles from the end move into the gaps. */
static void close_gaps(dyd_mesh *m, gap *gaps, unsigned count) {
  unsigned first = 0;
  while (first < count) {
    gap *low = &gaps[first], *high = &gaps[count - 1];
    if (low->from == low->to)
      first++;
    else if (high->to == m->count) {
      m->count = high->from;
      count--;
    } else {
      uint32_t t = low->from++;
      m->tri[t] = m->tri[--m->count];
      if (m->hint == m->count) m->hint = t;
      for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++) dyd_edge_join(m, h, dyd_edge_twin(m, h));
    }
  }
}

/* Triangulates m, which has its coordinates and no triangles. *joined = false: some part was stuck, m is as it was. */
static dyd_status mesh_join_strips(bool *joined, dyd_mesh *m, const dyd_strips *strips, const volatile int *cancel,
                                   unsigned threads) {
  bool stuck = false;
  seams *s = calloc(1, sizeof *s);
  *joined = false;
  if (!s) return DYD_E_NOMEM;
  s->cancel = cancel;
  make_parts(s, m, strips);
  dyd_status st = fill_and_join(&stuck, s, threads);
  if (st == DYD_OK && !stuck) {
    dyd_fixed_take(m, &s->part[0]);
    for (unsigned k = 0; k < s->parts; k++) dyd_tally_join(&m->tally, &s->part[k].tally);
    m->count = s->part[0].count;
    m->hint = s->part[0].hint;
    close_gaps(m, s->gap + 1, s->parts - 1);
    *joined = true;
    m->strips = *strips;
  } else
    no_aliases(m, 0, m->n);
  for (unsigned k = 0; k < s->parts; k++) dyd_mesh_trim(&s->part[k]);
  free(s);
  return st;
}

static dyd_status mesh_init(dyd_mesh *m, dyd_reps *reps, const uint32_t *local, uint32_t n, bool no_filter) {
  *m = (dyd_mesh){.reps = reps, .local = local, .n = n, .end = n, .strips = {1, {0, n}}, .no_filter = no_filter};
  if (!DYD_NEW(m->tri, 2 * (size_t)n + 2) || !DYD_NEW(m->alias, n) || (local && !DYD_NEW(m->own_xy, (size_t)n + 1)))
    return DYD_E_NOMEM;
  no_aliases(m, 0, n);
  dyd_mesh_coordinates(m);
  return DYD_OK;
}

static bool has_aliases(const dyd_mesh *m) {
  for (uint32_t v = 0; v < m->n; v++)
    if (m->alias[v] != DYD_NONE) return true;
  return false;
}

/* What building leaves. A line has no triangles, and finds its aliases later. */
static dyd_status mesh_finish(dyd_mesh *m, dyd_status st) {
  if (st != DYD_OK) return dyd_mesh_clear(m), st;
  if (m->collinear) {
    free(m->tri);
    m->tri = NULL;
  } else if (!has_aliases(m)) {
    free(m->alias);
    m->alias = NULL;
  }
  return st;
}

/* Sites joined with a lower one are aliases from the start. */
static void mesh_put_joined(dyd_mesh *m, const uint32_t *vertex) {
  for (uint32_t v = 0; v < m->n; v++) {
    uint32_t of = vertex[dyd_site_joined(m->reps->sites, m->reps->site[v])];
    if (of != v) m->alias[v] = of;
  }
}

dyd_status dyd_mesh_build(dyd_mesh *m, dyd_reps *reps, const uint32_t *local, uint32_t n, bool no_filter,
                          const volatile int *cancel) {
  dyd_status st = mesh_init(m, reps, local, n, no_filter);
  if (st == DYD_OK) st = mesh_fill(m, cancel);
  return mesh_finish(m, st);
}

dyd_status dyd_mesh_build_strips(dyd_mesh *m, dyd_reps *reps, const dyd_strips *strips, const uint32_t *vertex,
                                 bool no_filter, const volatile int *cancel, unsigned threads) {
  bool joined = false;
  dyd_status st = mesh_init(m, reps, NULL, reps->n, no_filter);
  if (st == DYD_OK && vertex)
    mesh_put_joined(m, vertex);
  else if (st == DYD_OK && dyd_strips_are_apart(reps, strips))
    st = mesh_join_strips(&joined, m, strips, cancel, threads);
  if (st == DYD_OK && !joined) st = mesh_fill(m, cancel);
  return mesh_finish(m, st);
}
