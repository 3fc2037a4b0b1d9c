/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The skeleton: the Delaunay triangulation of the representatives, with a ghost vertex outside the hull.
 *
 * Triangle t has vertices v[0..2], counter-clockwise; half-edges are named as in half_edge.h. Each hull edge has a
 * ghost triangle beyond it, whose third vertex is the ghost (number n). There are 2 n - 2 triangles for n inserted
 * vertices.
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

#include "base/flag.h"
#include "skeleton/order.h"
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

/* Invariant: every twin's twin is the edge itself, twins share their two vertices in opposite order, every real
 * triangle turns left and no vertex lies inside its circle (checked by dyd_mesh_is_valid in the armed build). */
typedef struct dyd_mesh {
  dyd_reps *reps;        /* borrowed */
  const uint32_t *local; /* mesh vertex -> vertex of reps; NULL: the same. Borrowed. */
  uint32_t n;            /* vertices; also the number of the ghost */
  uint32_t begin, end;   /* those it works on; 0 and n, but for a part */
  unsigned rounds;       /* of insertion: see dyd_mesh_set_rounds */
  dyd_strips strips; /* what it was joined from: most triangles from 2 begin to 2 end of a strip are its own; or one */
  const dyd_xy *xy;  /* n + 1 points, NaN last: of reps, or own_xy for a part */
  dyd_xy *own_xy;
  dyd_tri *tri;
  uint32_t count;   /* triangles, that is the number after the last one */
  uint32_t *alias;  /* alias[v]: the vertex with the same exact point, DYD_NONE if v is in the mesh; NULL: no aliases */
  bool collinear;   /* every choice of points is collinear: no triangles */
  dyd_tally tally;  /* of its construction */
  double extent[2]; /* of all points any representative may be; x, y */
  double orient_bound, incircle_delta; /* filter constants; infinite: nothing is sure */
  double exact_s; /* in-circle in doubles is exact up to this sum of lifts; -1: never; 0: not known yet */
  bool no_filter;
  bool part, stuck; /* a part cannot move representatives and needs a triangle: where it would have to, it is stuck */
  dyd_fixed *fixed; /* scaled 64-bit coordinates; NULL: none (yet) */
  bool no_fixed;    /* they do not exist */
  uint32_t moved;   /* moves of representatives so far; a coincidence takes the next fraction */
  uint32_t hint;    /* where the next search starts; of a mesh of several strips: a ghost triangle */
  struct dyd_rim *rim; /* scratch of insert.c */
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

#endif
