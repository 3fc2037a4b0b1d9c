/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The skeleton: the Delaunay triangulation of the representatives, with a ghost vertex outside the hull.
 *
 * Triangle t has vertices v[0..2], counter-clockwise; half-edges are named as below. Each hull edge has a
 * ghost triangle beyond it, whose third vertex is the ghost (number n). There are 2 n - 2 triangles for n inserted
 * vertices.
 *
 * The vertices of a large mesh come in strips, each left of the next: every strip is triangulated separately, in any
 * thread, and neighbours are joined. A mesh that is a part of another works on the vertices begin .. end - 1 and on the
 * triangles from 2 begin on of an array that it shares; names of vertices and the ghost are those of the whole.
 *
 * Insertion removes the triangles whose circle holds the new point (a disc without inner vertices, so its dual is a
 * tree and each edge is tested once) and joins the point to the rim. All decisions are exact: doubles with a proved
 * bound, then 64-bit integers, then GMP. Exact ties count as "not inside", so any weakly Delaunay triangulation
 * may come out at ties. */
#ifndef DYD_SKELETON_MESH_H
#define DYD_SKELETON_MESH_H

#include "base/flag.h"
#include "skeleton/reps.h"
#include <dyadel/delaunay.h>

typedef uint32_t dyd_half_edge;

typedef struct dyd_tri {
  uint32_t v[3];
  dyd_half_edge n[3]; /* n[k]: the twin of half-edge k */
} dyd_tri;

typedef struct dyd_fixed dyd_fixed;

/* What predicates were asked, and what the rungs beyond doubles answered. */
typedef struct dyd_tally {
  uint64_t asked, integer, exact;
  uint64_t ties; /* exact zeros met in in-circle and hull tests: 0 means no tie anywhere [TIE-1] */
} dyd_tally;

static inline void dyd_tally_join(dyd_tally *sum, const dyd_tally *more) {
  sum->asked += more->asked;
  sum->integer += more->integer;
  sum->exact += more->exact;
  sum->ties += more->ties;
}

/* Invariant: every twin's twin is the edge itself, twins share their two vertices in opposite order, every real
 * triangle turns left and no vertex lies inside its circle (checked by dyd_mesh_is_valid in the armed build). */
typedef struct dyd_mesh {
  dyd_reps *reps;        /* borrowed */
  const uint32_t *local; /* mesh vertex -> vertex of reps; NULL: the same. Borrowed. */
  uint32_t n;            /* vertices; also the number of the ghost */
  uint32_t begin, end;   /* those it works on; 0 and n, but for a part */
  unsigned rounds;       /* of insertion: 1, or 2 with points first */
  dyd_strips strips;     /* its strips: most triangles from 2 begin to 2 end of a strip are its own; or one */
  const dyd_xy *xy;      /* n + 1 points, NaN last: of reps, or own_xy for a part */
  dyd_xy *own_xy;
  dyd_tri *tri;
  uint32_t count;   /* triangles, that is the number after the last one */
  uint32_t *alias;  /* alias[v]: the vertex with the same exact point, DYD_NONE if v is in the mesh; NULL: no aliases.
                       While points come in, it is there. */
  bool collinear;   /* every choice of points is collinear: no triangles */
  dyd_tally tally;  /* of its construction */
  double extent[2]; /* of all points any representative may be; x, y */
  double orient_bound, incircle_delta; /* filter constants; infinite: nothing is certain */
  double exact_s; /* in-circle in doubles is exact up to this sum of lifts; -1: never; 0: not known yet */
  bool no_filter;
  bool part, stuck; /* a part cannot move representatives and needs a triangle: where it would have to, it is stuck */
  dyd_fixed *fixed; /* scaled 64-bit coordinates; NULL: none (yet) */
  bool no_fixed;    /* they do not exist */
  uint32_t moved;   /* moves of representatives so far; a coincidence takes the next fraction */
  uint32_t hint;    /* where the next search starts; of a mesh of several strips: a ghost triangle */
  struct dyd_cavity_edge *rim; /* scratch of insertion */
  uint32_t *spare;
  size_t rim_cap, spare_cap;
} dyd_mesh;

/* Vertex of reps behind mesh vertex v. */
static inline uint32_t dyd_mesh_rep(const dyd_mesh *m, uint32_t v) {
  return m->local ? m->local[v] : v;
}
static inline uint32_t dyd_mesh_alias(const dyd_mesh *m, uint32_t v) {
  return m->alias ? m->alias[v] : DYD_NONE;
}

/* Half-edges: the one name for a place in a triangulation.
 *
 * Half-edge 4 t + k of triangle t is opposite v[k] and runs from v[k+1] to v[k+2], counter-clockwise, t on its left.
 * Its twin runs back, in the triangle beyond. Of two twins the one with the smaller number is "first". No other code
 * takes half-edges apart. */

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
/* The next one of a round that began at `first`; DYD_NONE: it is over. */
static inline dyd_half_edge dyd_edge_around(const dyd_mesh *m, dyd_half_edge h, dyd_half_edge first) {
  return dyd_edge_turn(m, h) == first ? DYD_NONE : dyd_edge_turn(m, h);
}
static inline void dyd_edge_join(dyd_mesh *m, dyd_half_edge h, dyd_half_edge twin) {
  m->tri[h >> 2].n[h & 3] = twin, m->tri[twin >> 2].n[twin & 3] = h;
}

static inline bool dyd_is_ghost_triangle(const dyd_mesh *m, uint32_t t) {
  return m->tri[t].v[0] == m->n || m->tri[t].v[1] == m->n || m->tri[t].v[2] == m->n;
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
  return dyd_edge_of(t, m->tri[t].v[0] == m->n ? 0 : m->tri[t].v[1] == m->n ? 1 : 2);
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
/* The hull edge of the lowest number; DYD_NONE without triangles. */
static inline dyd_half_edge dyd_hull_first(const dyd_mesh *m) {
  for (uint32_t t = 0; t < m->count; t++)
    if (dyd_is_ghost_triangle(m, t)) return dyd_hull_edge(m, t);
  return DYD_NONE;
}

#endif
