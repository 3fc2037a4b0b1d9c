/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a partial Delaunay triangulation holds: the skeleton, in which certain edges are legal pairs, and the undecided
 * parts between them. */
#ifndef DYD_DELAUNAY_STATE_H
#define DYD_DELAUNAY_STATE_H

#include "base/memory.h"
#include "skeleton/skeleton.h"
#include "skeleton/work.h"

/* Two vertices, i < j. Two sites on the rims of two faces may make a pair that both closures find; it stays in both
 * lists, since either face may be worked on again alone, and is hidden in all but one. */
typedef struct dyd_vertex_pair {
  uint32_t i;
  uint32_t j : 31, hidden : 1;
} dyd_vertex_pair;

static inline int dyd_compare_vertex_pair(const void *a, const void *b) {
  const dyd_vertex_pair *x = a, *y = b;
  if (x->i != y->i) return x->i < y->i ? -1 : 1;
  return (x->j > y->j) - (x->j < y->j);
}

/* Invariant: tri[first_tri .. first_tri + tris) and pair[first_pair .. + pairs) of the table, pairs sorted;
 * polygon: a cocircular polygon or collinear chain, which shares its pairs with no other polygon; tie: all vertices are
 * exact points, or it is proved; capped: pairs beyond the skeleton are missing;
 * postponed: capped, since its sites can be narrowed. */
typedef struct dyd_face {
  size_t first_tri, first_pair;
  uint32_t tris;
  uint32_t pairs, hidden; /* how many, and how many of them are hidden */
  bool outer, tie, capped, postponed, polygon;
  bool proved; /* a tie of points that are not all exact: ties.c */
} dyd_face;

/* How undecided parts are stored: LISTED, triangles joined by uncertain edges are faces, each with the list of its
 * possible pairs that are not legal; TIED, all sites are exact points: faces are found by walks around their rims
 * (ties.h), and all their pairs are possible; LINE, no triangles: all pairs that are not legal are, as one face. */
typedef enum dyd_undecided_kind { DYD_LISTED, DYD_TIED, DYD_LINE } dyd_undecided_kind;

#define DYD_SEED_QUAD (UINT32_C(1) << 31)

/* LISTED: face, tri and pair. TIED: seed[f] is a triangle of face f, marked if it has two triangles and no ghost; no
 * pair is stored, so the cap on stored pairs counts none of them. */
typedef struct dyd_undecided {
  dyd_undecided_kind kind;
  size_t count;  /* faces */
  size_t capped; /* how many of them miss pairs beyond the skeleton */
  dyd_face *face;
  size_t face_cap;
  uint32_t *seed;
  size_t seed_cap;
  uint64_t tied_pairs; /* of the faces that have seeds */
  uint32_t *tri;
  size_t tri_count, tri_cap;
  dyd_vertex_pair *pair;
  size_t pair_count, pair_cap;
  uint32_t *turned; /* beside pair: the numbers of a face's pairs by j, then i, where it has many (faces.h) */
  size_t turned_cap;
  size_t others;     /* faces that are not polygons */
  size_t live_pairs; /* pairs of the faces there are; the rest of pair[] is left over from faces replaced */
  size_t live_tris;
  uint32_t *of; /* triangle -> face, DYD_NONE: decided; NULL: no face at all */
} dyd_undecided;

struct dyd_delaunay {
  dyd_skeleton sk;
  dyd_undecided open;
  bool line_tie; /* a line whose open pairs are all ties */
  dyd_delaunay_counters counters;
  dyd_delaunay_options options;
  size_t max_pairs;
  dyd_memory memory;          /* of the call at work */
  size_t joins;               /* of sites, when it was built */
  dyd_sites *own;             /* NULL: the sites are the caller's */
  const dyd_decider *decider; /* while it is built; may be NULL */
};

/* Sets *out to the rectangle of site i. */
typedef dyd_status dyd_rect_fn(dyd_rect *out, const void *user, size_t i);
/* As dyd_delaunay_new, of n sites that `rect` makes and *out owns; max_bytes counts them. */
dyd_status dyd_delaunay_made(dyd_delaunay **out, size_t n, dyd_rect_fn *rect, const void *user,
                             const dyd_delaunay_options *options, dyd_error *err);
/* The same with a decider, by one thread: all possible pairs of its regions are among those found [CLO-1]. */
dyd_status dyd_delaunay_decided(dyd_delaunay **out, size_t n, dyd_rect_fn *rect, const void *user,
                                const dyd_decider *decider, const dyd_delaunay_options *options, dyd_error *err);

/* Returns true if no triangles exist, since the points are collinear for every choice, or at most two. */
static inline bool dyd_is_line(const dyd_delaunay *pd) {
  return pd->open.kind == DYD_LINE;
}
/* The face that triangle t belongs to, or DYD_NONE. */
static inline uint32_t dyd_face_of(const dyd_delaunay *pd, uint32_t t) {
  return pd->open.of ? pd->open.of[t] : DYD_NONE;
}

/* Returns true if face f has a triangle at v. */
static inline bool dyd_is_corner_of(const dyd_delaunay *pd, uint32_t v, uint32_t f) {
  dyd_half_edge first = pd->sk.leaving[v], h = first;
  while (h != DYD_NONE && dyd_face_of(pd, dyd_edge_triangle(h)) != f) h = dyd_edge_around(&pd->sk.mesh, h, first);
  return h != DYD_NONE;
}

/* Returns true if triangle t is one for every choice: three legal edges around a face of the skeleton. A point that
 * entered it would first lie on an edge. */
static inline bool dyd_triangle_is_sure(const dyd_delaunay *pd, uint32_t t) {
  return dyd_triangle_is_certain(&pd->sk, t) && !dyd_is_ghost_triangle(&pd->sk.mesh, t) &&
         dyd_face_of(pd, t) == DYD_NONE;
}

/* The sites on the hull of the skeleton's representatives, counter-clockwise. */
dyd_status dyd_delaunay_hull(dyd_index_list *out, const dyd_delaunay *pd);

/* The pairs of face f that are possible and not legal, sorted. */
dyd_status dyd_delaunay_face_pairs(dyd_pair_list *out, const dyd_delaunay *pd, size_t f);

#endif
