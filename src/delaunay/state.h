/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a partial Delaunay triangulation holds.
 *
 * Vertices are the sites in spatial order. The skeleton's edges carry one flag, "certain": a real edge is legal, an
 * edge to the ghost says that its vertex is surely on the hull. Triangles joined by uncertain edges form the undecided
 * faces; each keeps the list of its possible pairs that are not legal. If the true points are always collinear (or
 * there are at most two sites) there are no triangles, and the line order says everything. */
#ifndef DYD_DELAUNAY_STATE_H
#define DYD_DELAUNAY_STATE_H

#include "skeleton/mesh.h"
#include "skeleton/tree.h"

/* Two vertices, i < j. Two sites on the rims of two faces may make a pair that both closures find; it stays in both
 * lists, since either face may be worked on again alone, and is hidden in all but one. */
typedef struct dyd_vertex_pair {
  uint32_t i;
  uint32_t j : 31, hidden : 1;
} dyd_vertex_pair;

/* Invariant: tri[first_tri .. first_tri + tris) and pair[first_pair .. + pairs) of the face table, pairs sorted;
 * polygon: a cocircular polygon or collinear chain of exact points; tie: all vertices are exact points; capped: pairs
 * beyond the skeleton are missing. */
typedef struct dyd_face {
  size_t first_tri, first_pair;
  uint32_t tris;
  uint32_t pairs, hidden; /* how many, and how many of them are hidden */
  bool outer, tie, capped, polygon;
} dyd_face;

#define DYD_SEED_CAPPED (UINT32_C(1) << 31)
#define DYD_SEED_QUAD (UINT32_C(1) << 30)
#define DYD_SEED_MARKS (DYD_SEED_CAPPED | DYD_SEED_QUAD)

/* When all sites are exact points face, tri and pair are empty, and seed[f] is a triangle of face f (ties.h), with a
 * mark if pairs beyond the skeleton are missing, and else one if it has two triangles and no ghost. Otherwise seed is
 * empty. */
typedef struct dyd_face_table {
  dyd_face *face;
  size_t count, face_cap;
  uint32_t *seed;
  size_t seed_cap, capped_pairs; /* live pairs of capped faces, while there are seeds */
  uint32_t *tri;
  size_t tri_count, tri_cap;
  dyd_vertex_pair *pair;
  size_t pair_count, pair_cap;
  size_t others;     /* faces that are not polygons */
  size_t live_pairs; /* pairs of the faces there are; the rest of pair[] is left over from faces replaced */
  size_t live_tris;
  uint32_t *of; /* triangle -> face, DYD_NONE: decided; NULL: no face at all */
} dyd_face_table;

/* The line order: alive vertices along the common line; legal[q]: order[q], order[q+1] is legal. */
typedef struct dyd_line {
  uint32_t count;
  uint32_t *order, *rank;
  bool *legal;
  bool all_points, capped;
} dyd_line;

struct dyd_delaunay {
  const dyd_sites *sites;
  uint32_t n;
  dyd_reps reps;
  dyd_mesh mesh;
  uint32_t *vertex; /* site -> its vertex, of the site it stands for if it is an alias */
  uint32_t *corner; /* vertex -> 4 t + k with tri[t].v[k] = vertex; DYD_NONE: alias or line */
  uint8_t *certain; /* triangle -> bit k: edge k is certain */
  bool all_points;  /* every site is an exact point */
  dyd_bbox *box;    /* vertex -> outward box; NULL when all_points */
  dyd_tree tree;    /* over all vertices in the skeleton; empty when all_points */
  dyd_bbox *block;  /* when tree is empty: boxes of blocks of vertices (skeleton/blocks.h), and the tree over them */
  dyd_tree blocks;
  dyd_line line;
  dyd_face_table faces;
  dyd_delaunay_counters counters;
  dyd_delaunay_options options;
  size_t max_pairs;
  dyd_error *err; /* during a call */
};

static inline bool dyd_cancelled(const dyd_delaunay *pd) {
  return dyd_flag_is_set(pd->options.cancel);
}
static inline bool dyd_edge_is_certain(const dyd_delaunay *pd, uint32_t t, unsigned k) {
  return pd->certain[t] >> k & 1;
}
static inline void dyd_set_certain(dyd_delaunay *pd, uint32_t t, unsigned k) {
  uint32_t twin = pd->mesh.tri[t].n[k];
  pd->certain[t] |= (uint8_t)(1u << k);
  pd->certain[twin >> 2] |= (uint8_t)(1u << (twin & 3));
}
static inline bool dyd_vertex_is_point(const dyd_delaunay *pd, uint32_t v) {
  return dyd_sites_is_point(pd->sites, pd->reps.site[v]);
}
/* For qsort and bsearch: vertex or site numbers; pairs. */
static inline int dyd_compare_index(const void *a, const void *b) {
  uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
  return (x > y) - (x < y);
}
static inline int dyd_compare_vertex_pair(const void *a, const void *b) {
  const dyd_vertex_pair *x = a, *y = b;
  if (x->i != y->i) return x->i < y->i ? -1 : 1;
  return (x->j > y->j) - (x->j < y->j);
}
/* Next triangle corner counter-clockwise around the vertex at corner h = 4 t + k. */
static inline uint32_t dyd_turn(const dyd_mesh *m, uint32_t h) {
  uint32_t beyond = m->tri[h >> 2].n[dyd_next(h & 3)];
  return (beyond & ~3u) | dyd_next(beyond & 3);
}

#endif
