/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The skeleton of a set of sites, and facts about its edges.
 *
 * Vertices are the sites in spatial order. The edges carry one flag, "certain": a real edge is legal, an edge to the
 * ghost says that its vertex is certainly on the hull. If the true points are always collinear (or there are at most
 * two sites) triangles do not exist. */
#ifndef DYD_SKELETON_SKELETON_H
#define DYD_SKELETON_SKELETON_H

#include "skeleton/mesh.h"
#include "skeleton/rects_filter.h"

/* The path that replaces triangles when every choice of points is collinear, or there are at most two sites.
 * The vertices without aliases, along the common line. legal[q]: order[q], order[q+1] is legal. rank[order[q]] is
 * q. is_end[0], is_end[1]: the first, the last is certainly an end of the line, alone. count = 0: no line. */
typedef struct dyd_line {
  uint32_t count;
  uint32_t *order, *rank;
  bool *legal, is_end[2];
} dyd_line;

/* Returns true if these neighbours are on the line, and legal. */
bool dyd_line_is_legal(const dyd_line *l, uint32_t v, uint32_t w);
/* Returns true if v is an end of the line, and apart from all others, for every choice. */
bool dyd_line_is_end(const dyd_line *l, uint32_t v);
size_t dyd_line_legal_pairs(const dyd_line *l);
/* Number of pairs that are possible and not legal. */
size_t dyd_line_open_pairs(const dyd_line *l);

typedef struct dyd_skeleton {
  uint32_t n, built; /* all sites; sites of the first construction, the others were inserted later */
  dyd_reps reps;
  dyd_mesh mesh;
  dyd_line line;          /* instead of triangles, if mesh.collinear */
  uint32_t *vertex;       /* site -> its vertex; of an alias, the vertex of its original */
  dyd_half_edge *leaving; /* vertex -> a half-edge out of it; DYD_NONE: alias or line */
  uint8_t *certain;       /* triangle -> bit k: half-edge k is certain */
  bool all_points;        /* every site is an exact point */
  dyd_rects rects;        /* of the vertices in the mesh; neither boxes nor tree when all_points or on a line */
  dyd_bbox *block;        /* then: boxes of blocks of DYD_BLOCK vertices, and the tree over them */
  dyd_tree blocks;
} dyd_skeleton;

typedef struct dyd_skeleton_options {
  bool no_filter;
  unsigned threads;
  const volatile int *cancel;
} dyd_skeleton_options;

/* The skeleton of all sites, nothing certain yet. On failure *sk is cleared. */
dyd_status dyd_skeleton_build(dyd_skeleton *sk, const dyd_sites *sites, const dyd_skeleton_options *o);
void dyd_skeleton_clear(dyd_skeleton *sk);
/* It has moved in memory: what points into it follows. */
void dyd_skeleton_moved(dyd_skeleton *sk);
/* Box and tree follow the rectangle of a vertex; its representative, too. */
void dyd_skeleton_set_box(dyd_skeleton *sk, uint32_t v);
dyd_status dyd_skeleton_refresh(dyd_skeleton *sk, uint32_t v);
/* Makes room for the sites from sk->n on; those of a skeleton of exact points are points of doubles. order[0..count-1]
 * are the sites of the new vertices, which are not in the mesh yet. ghost: a ghost triangle. On failure only clearing
 * is allowed. */
dyd_status dyd_skeleton_grow(dyd_skeleton *sk, const uint32_t *order, uint32_t count, uint32_t ghost);
/* Bytes allocated, of everything that stays; an estimate of what a skeleton of these sites will take while it is made.
 */
size_t dyd_skeleton_memory(const dyd_skeleton *sk);
uint64_t dyd_skeleton_bytes(const dyd_sites *sites);

static inline bool dyd_vertex_is_point(const dyd_skeleton *sk, uint32_t v) {
  return sk->all_points || dyd_site_is_point(sk->rects.sites, sk->rects.site[v]);
}
static inline bool dyd_edge_is_certain(const dyd_skeleton *sk, dyd_half_edge h) {
  return sk->certain[dyd_edge_triangle(h)] >> dyd_edge_corner(h) & 1;
}
static inline bool dyd_triangle_is_certain(const dyd_skeleton *sk, uint32_t t) {
  return (sk->certain[t] & 7) == 7;
}
static inline void dyd_set_certain(dyd_skeleton *sk, dyd_half_edge h, bool certain) {
  dyd_half_edge both[2] = {h, dyd_edge_twin(&sk->mesh, h)};
  for (int q = 0; q < 2; q++) {
    uint8_t bit = (uint8_t)(1u << dyd_edge_corner(both[q])), *at = &sk->certain[dyd_edge_triangle(both[q])];
    *at = certain ? *at | bit : *at & (uint8_t)~bit;
  }
}

/* The half-edge from v to w, or DYD_NONE. w may be the ghost. O(degree of v). */
dyd_half_edge dyd_find_edge(const dyd_skeleton *sk, uint32_t v, uint32_t w);
/* Returns true if v and w (not the ghost) are joined by a certain edge. */
bool dyd_is_legal(const dyd_skeleton *sk, uint32_t v, uint32_t w);
/* How many pairs are legal, that is certain edges that are real. O(n), a byte for each triangle. */
uint64_t dyd_certain_edges(const dyd_skeleton *sk);
/* How many edges to the ghost are certain. A walk around the hull. */
uint64_t dyd_certain_corners(const dyd_skeleton *sk);
/* The neighbours of i and of j, without repeats, the ghost, i and j. At most `room`; returns how many. */
int dyd_neighbours(uint32_t *out, int room, const dyd_skeleton *sk, uint32_t i, uint32_t j);

enum { DYD_BLOCK = 32 };
/* One beyond the last vertex of block b. */
static inline uint32_t dyd_block_end(const dyd_skeleton *sk, uint32_t b) {
  return sk->n - b * DYD_BLOCK < DYD_BLOCK ? sk->n : (b + 1) * DYD_BLOCK;
}
/* An outward box of the rectangle of v. */
void dyd_vertex_box(dyd_bbox *out, const dyd_skeleton *sk, uint32_t v);

#endif
