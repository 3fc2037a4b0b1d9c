/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Undecided faces, their vertices and pairs, in any storage; and the walk over all possible pairs.
 *
 * The walks are inline, so that visitors are. */
#ifndef DYD_DELAUNAY_UNDECIDED_H
#define DYD_DELAUNAY_UNDECIDED_H

#include "delaunay/ties.h"

/* v and w in any order. */
typedef void (*dyd_pair_visit)(void *context, uint32_t v, uint32_t w, dyd_pair_status status);

/* Vertices of face f, ascending; *vertex is owned by the caller. */
dyd_status dyd_open_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f);
/* Returns true if it has triangles at the ghost. */
bool dyd_open_is_outer(const dyd_delaunay *pd, size_t f);
/* Returns true if pairs of face f beyond the skeleton are missing, and if that is so since the face was postponed. */
bool dyd_open_is_capped(const dyd_delaunay *pd, size_t f);
bool dyd_open_is_postponed(const dyd_delaunay *pd, size_t f);
/* The pairs of vertex v that are not legal, each once; ties of exact points only if `least` is at most DYD_TIE. */
void dyd_open_each_at(const dyd_delaunay *pd, uint32_t v, dyd_pair_status least, dyd_pair_visit visit, void *context);

bool dyd_pair_is_legal(const dyd_delaunay *pd, uint32_t v, uint32_t w);
/* Returns true if v is a corner of the hull for every choice. Is vw an edge of the hull of the representatives (of two
 * sites, too)? */
bool dyd_corner_is_sure(const dyd_delaunay *pd, uint32_t v);
bool dyd_is_hull_edge(const dyd_delaunay *pd, uint32_t v, uint32_t w);
/* The legal pairs of vertex v. */
void dyd_legal_each_at(const dyd_delaunay *pd, uint32_t v, dyd_pair_visit visit, void *context);

static inline dyd_pair_status dyd_listed_status(const dyd_face *face) {
  return face->tie && !face->capped ? DYD_TIE : DYD_INDETERMINATE;
}
/* How pairs of face f that are not legal are called. */
static inline dyd_pair_status dyd_open_status_of(const dyd_delaunay *pd, size_t f) {
  switch (pd->open.kind) {
  case DYD_LINE:
    return pd->line_tie ? DYD_TIE : DYD_INDETERMINATE;
  case DYD_TIED:
    return DYD_TIE;
  default:
    return dyd_listed_status(&pd->open.face[f]);
  }
}

static inline void dyd_each_listed(const dyd_delaunay *pd, size_t f, dyd_pair_visit visit, void *context) {
  const dyd_face *face = &pd->open.face[f];
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair p = pd->open.pair[face->first_pair + q];
    if (!p.hidden) visit(context, p.i, p.j, dyd_listed_status(face));
  }
}

/* Number of vertices of a rim that are paired with the later ones in one walk; in the armed build small faces need
 * several. */
#ifdef DYD_ARMED
enum { DYD_RIM_PART = 3 };
#else
enum { DYD_RIM_PART = 64 };
#endif

/* Vertices on the rim, the ghost counted too. */
static inline uint32_t dyd_tie_size(const dyd_skeleton *sk, dyd_half_edge first) {
  dyd_half_edge h = first;
  uint32_t size = 0;
  do size++;
  while ((h = dyd_tie_next(sk, h)) != first);
  return size;
}

static inline void dyd_each_tied(const dyd_delaunay *pd, size_t f, dyd_pair_visit visit, void *context) {
  const dyd_skeleton *sk = &pd->sk;
  uint32_t v[DYD_RIM_PART], ghost = sk->mesh.n;
  dyd_half_edge from = dyd_tie_start(pd, f);
  uint32_t size = dyd_tie_size(sk, from);
  for (uint32_t base = 0; base < size; base += DYD_RIM_PART) {
    dyd_half_edge h = from;
    for (uint32_t q = base; q < size; q++, h = dyd_tie_next(sk, h)) {
      uint32_t w = dyd_edge_origin(&sk->mesh, h);
      for (uint32_t p = base; w != ghost && p + 1 < q && p < base + DYD_RIM_PART; p++)
        if (v[p - base] != ghost && (p > 0 || q + 1 < size)) visit(context, v[p - base], w, DYD_TIE);
      if (q < base + DYD_RIM_PART) v[q - base] = w;
      if (q == base + DYD_RIM_PART) from = h;
    }
  }
}

/* An edge of the skeleton inside a tied face: both diagonals of a quad; larger ones are walked around. */
static inline void dyd_each_inside(const dyd_delaunay *pd, dyd_half_edge h, dyd_pair_visit visit, void *context) {
  const dyd_mesh *m = &pd->sk.mesh;
  uint32_t seed = pd->open.seed[pd->open.of[dyd_edge_triangle(h)]];
  uint32_t v = dyd_edge_origin(m, h), w = dyd_edge_target(m, h);
  if (!(seed & DYD_SEED_QUAD)) return;
  visit(context, v, w, DYD_TIE);
  visit(context, dyd_edge_apex(m, h), dyd_edge_across(m, h), DYD_TIE);
}

/* Edges of the skeleton: legal ones, and those inside tied faces. Loops over bits: which edges qualify is as good as
 * random, and branches on it would be guessed wrongly. */
static inline void dyd_each_edge(const dyd_delaunay *pd, bool ties, dyd_pair_visit visit, void *context) {
  const dyd_mesh *m = &pd->sk.mesh;
  const unsigned lowest = 0x1210; /* two bits for each value of three bits: its lowest bit */
  for (uint32_t t = 0; t < m->count; t++) {
    const uint32_t *v = m->tri[t].v;
    unsigned named = dyd_edges_first_named(m, t), legal = named & pd->sk.certain[t];
    unsigned inside = ties && pd->open.kind == DYD_TIED ? named & ~legal : 0;
    for (; legal; legal &= legal - 1) {
      unsigned k = lowest >> 2 * legal & 3;
      visit(context, v[dyd_next(k)], v[dyd_prev(k)], DYD_LEGAL);
    }
    for (; inside; inside &= inside - 1) dyd_each_inside(pd, dyd_edge_of(t, lowest >> 2 * inside & 3), visit, context);
  }
}

/* Pairs of a line with at least that status; of a capped one only the legal ones. */
static inline void dyd_each_on_line(const dyd_delaunay *pd, dyd_pair_status least, dyd_pair_visit visit,
                                    void *context) {
  const dyd_line *l = &pd->sk.line;
  bool open = !pd->open.capped && dyd_open_status_of(pd, 0) >= least;
  for (uint32_t a = 0; a + 1 < l->count; a++)
    for (uint32_t b = a + 1; b < l->count && (b == a + 1 || open); b++) {
      bool legal = b == a + 1 && l->legal[a];
      if (legal || open) visit(context, l->order[a], l->order[b], legal ? DYD_LEGAL : dyd_open_status_of(pd, 0));
    }
}

/* Every pair with at least that status once; of capped faces only those of the skeleton. Without ties the time does not
 * depend on how many there are. */
static inline void dyd_each_pair(const dyd_delaunay *pd, dyd_pair_status least, dyd_pair_visit visit, void *context) {
  bool tied = pd->open.kind == DYD_TIED;
  if (pd->open.kind == DYD_LINE) {
    dyd_each_on_line(pd, least, visit, context);
    return;
  }
  dyd_each_edge(pd, least <= DYD_TIE, visit, context);
  for (size_t f = 0; f < pd->open.count && !(tied && least > DYD_TIE); f++) {
    if (!tied && dyd_listed_status(&pd->open.face[f]) >= least)
      dyd_each_listed(pd, f, visit, context);
    else if (tied && !(pd->open.seed[f] & DYD_SEED_QUAD))
      dyd_each_tied(pd, f, visit, context);
  }
}

#endif
