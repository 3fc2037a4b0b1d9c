/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The skeleton: the Delaunay triangulation of the representatives, with a ghost vertex outside the hull.
 *
 * Triangle t has vertices v[0..2], counter-clockwise; edge k of t is opposite v[k] and runs from v[k+1] to v[k+2];
 * n[k] = 4 * t' + k' names the same edge in the triangle beyond it. Each hull edge has a ghost triangle beyond it,
 * whose third vertex is the ghost (number n). There are 2 n - 2 triangles for n inserted vertices.
 *
 * The vertices of a large mesh come in strips, each left of the next: every strip is triangulated by itself, in any
 * thread, and neighbours are joined (join.h). A mesh that is a part of another works on the vertices begin .. end - 1
 * and on the triangles from 2 begin on of an array that it shares; names of vertices and the ghost are those of the
 * whole.
 *
 * Insertion removes the triangles whose circle holds the new point (a disc without inner vertices, so its dual is a
 * tree and each edge is tested once) and joins the point to the rim. All decisions are exact: doubles with a proved
 * bound, then 64-bit integers, then GMP. Exact ties count as "not inside", so any weakly Delaunay triangulation
 * may come out at ties. */
#ifndef DYD_SKELETON_MESH_H
#define DYD_SKELETON_MESH_H

#include "skeleton/order.h"
#include "skeleton/reps.h"
#include <dyadel/delaunay.h>

typedef struct dyd_tri {
  uint32_t v[3], n[3];
} dyd_tri;

static inline unsigned dyd_next(unsigned k) {
  return (9u >> (2 * k)) & 3u;
}
static inline unsigned dyd_prev(unsigned k) {
  return (18u >> (2 * k)) & 3u;
}

/* Another thread or a signal handler may set the flag at any time. */
static inline bool dyd_flag_is_set(const volatile int *flag) {
  return flag && __atomic_load_n(flag, __ATOMIC_RELAXED);
}

typedef struct dyd_fixed dyd_fixed;

/* Invariant: every twin's twin is the edge itself, twins share their two vertices in opposite order, every real
 * triangle turns left and no vertex lies inside its circle (checked by dyd_mesh_check in the armed build). */
typedef struct dyd_mesh {
  dyd_reps *reps;        /* borrowed */
  const uint32_t *local; /* mesh vertex -> vertex of reps; NULL: the same. Borrowed. */
  uint32_t n;            /* vertices; also the number of the ghost */
  uint32_t begin, end;   /* those it works on; 0 and n, but for a part */
  dyd_strips strips; /* what it was joined from: most triangles from 2 begin to 2 end of a strip are its own; or one */
  const dyd_xy *xy;  /* n + 1 points, NaN last: of reps, or own_xy for a part */
  dyd_xy *own_xy;
  dyd_tri *tri;
  uint32_t count;   /* triangles, that is the number after the last one */
  uint32_t *alias;  /* alias[v]: the vertex with the same exact point, DYD_NONE if v is in the mesh; NULL: no aliases */
  bool collinear;   /* every choice of points is collinear: no triangles */
  uint64_t asked;   /* in-circle tests and location steps so far */
  uint64_t beyond;  /* answers of the later rungs when counting began */
  uint64_t ties;    /* exact zeros met in in-circle and hull tests: 0 means no tie anywhere [TIE-1] */
  double extent[2]; /* of all points any representative may be; x, y */
  double orient_bound, incircle_delta; /* filter constants */
  double exact_s; /* in-circle in doubles is exact up to this sum of lifts; -1: never; 0: not known yet */
  bool no_filter;
  bool part, stuck; /* a part cannot move representatives and needs a triangle: where it would have to, it is stuck */
  dyd_fixed *fixed; /* scaled 64-bit coordinates, made at the first need; NULL before */
  bool no_fixed;    /* they do not exist */
  uint32_t moved;   /* moves of representatives so far; a coincidence takes the next fraction */
  dyd_delaunay_counters *counters; /* borrowed */
  uint32_t hint;                   /* where the next search starts; of a mesh of several strips: a ghost triangle */
  uint32_t *stack, *spare;
  size_t stack_cap, spare_cap;
} dyd_mesh;

/* The skeleton of the n vertices of reps listed in local (NULL: all). Representatives that coincide are moved within
 * their rectangles; equal exact points become aliases; if all representatives are collinear they are moved too,
 * unless every choice is collinear. cancel may be NULL. *m is cleared on failure. */
dyd_status dyd_mesh_build(dyd_mesh *m, dyd_reps *reps, const uint32_t *local, uint32_t n, bool no_filter,
                          dyd_delaunay_counters *counters, const volatile int *cancel);
/* From strips, if there are several and that is possible: no representative has to be moved, strips are divided by
 * vertical lines and none is collinear; else as dyd_mesh_build. Which of several skeletons comes out at exact ties
 * depends on the strips, not on the number of threads. */
dyd_status dyd_mesh_build_strips(dyd_mesh *m, dyd_reps *reps, const dyd_strips *strips, bool no_filter,
                                 dyd_delaunay_counters *counters, const volatile int *cancel, unsigned threads);
/* Triangulates the vertices from begin to end; used on parts. DYD_CANCELLED also when a part is stuck. */
dyd_status dyd_mesh_fill(dyd_mesh *m, const volatile int *cancel);
void dyd_mesh_clear(dyd_mesh *m);
/* Representatives have been chosen anew: the filter constants follow. */
void dyd_mesh_follow(dyd_mesh *m);
/* Brings the counters up to date. */
void dyd_mesh_count(dyd_mesh *m);
/* Gives back what only building needs. */
void dyd_mesh_trim(dyd_mesh *m);

static inline bool dyd_mesh_is_ghost(const dyd_mesh *m, uint32_t t) {
  const uint32_t *v = m->tri[t].v;
  return v[0] == m->n || v[1] == m->n || v[2] == m->n;
}

/* A triangle whose circle holds v, which is no vertex: the real triangle around it, or a ghost triangle whose hull edge
 * it is beyond. */
uint32_t dyd_mesh_locate(dyd_mesh *m, uint32_t v);
/* Which corner of the ghost triangle t is the ghost. */
static inline unsigned dyd_mesh_ghost_corner(const dyd_mesh *m, uint32_t t) {
  const uint32_t *v = m->tri[t].v;
  return v[0] == m->n ? 0 : v[1] == m->n ? 1 : 2;
}

/* Exact sign of the orientation of three real vertices: > 0 left turn. */
int dyd_mesh_orient(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c);
/* Exact sign: > 0 iff p lies strictly inside the circle of the counter-clockwise triangle abc; for a ghost triangle:
 * strictly beyond the hull edge or on it between its ends. p is real; 0 also at ties. */
int dyd_mesh_incircle(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p);

#endif
