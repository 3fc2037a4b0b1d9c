/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Visiting the pairs that are possible: all of them, those of a face, those of a vertex. Inline, so that visitors are.
 */
#ifndef DYD_DELAUNAY_VISIT_H
#define DYD_DELAUNAY_VISIT_H

#include "delaunay/faces.h"
#include "delaunay/line.h"
#include "delaunay/ties.h"

/* v and w in any order. */
typedef void (*dyd_pair_visit)(void *context, uint32_t v, uint32_t w, dyd_pair_status status);

/* Pairs of a line; of a capped one only the legal ones. */
static inline void dyd_each_line_pair(const dyd_delaunay *pd, dyd_pair_visit visit, void *context) {
  const dyd_line *l = &pd->line;
  for (uint32_t a = 0; a + 1 < l->count; a++)
    for (uint32_t b = a + 1; b < l->count && (b == a + 1 || !l->capped); b++) {
      dyd_pair_status s = dyd_line_status(l, l->order[a], l->order[b]);
      if (!l->capped || s == DYD_LEGAL) visit(context, l->order[a], l->order[b], s);
    }
}

static inline void dyd_each_listed_pair(const dyd_delaunay *pd, size_t f, dyd_pair_visit visit, void *context) {
  const dyd_face *face = &pd->faces.face[f];
  for (uint32_t q = 0; q < face->pairs; q++) {
    dyd_vertex_pair p = pd->faces.pair[face->first_pair + q];
    if (!p.hidden) visit(context, p.i, p.j, dyd_face_open_status(face));
  }
}

/* Ties of the vertex at the rim's corner h with those between its two neighbours on the rim, before that at `end`. */
static inline void dyd_each_tie_of(const dyd_delaunay *pd, uint32_t h, uint32_t end, dyd_pair_visit visit,
                                   void *context) {
  uint32_t v = dyd_tie_vertex(&pd->mesh, h), ghost = pd->mesh.n, at = dyd_tie_next(pd, h), next;
  if (v == ghost || at == end) return;
  for (at = dyd_tie_next(pd, at); at != end; at = next) {
    uint32_t w = dyd_tie_vertex(&pd->mesh, at);
    next = dyd_tie_next(pd, at);
    if (w != ghost && next != h) visit(context, v, w, DYD_TIE);
  }
}

/* So many vertices of a rim are paired with the later ones in one walk; in the armed build small faces need several.
 */
#ifdef DYD_ARMED
enum { DYD_RIM_PART = 3 };
#else
enum { DYD_RIM_PART = 64 };
#endif

/* Pairs of a face that lists none, each once. */
static inline void dyd_each_tie(const dyd_delaunay *pd, size_t f, dyd_pair_visit visit, void *context) {
  uint32_t v[DYD_RIM_PART], ghost = pd->mesh.n, first = dyd_tie_start(pd, f), from = first,
                            size = dyd_tie_size(pd, first);
  for (uint32_t base = 0; base < size; base += DYD_RIM_PART) {
    for (uint32_t q = base, h = from; q < size; q++, h = dyd_tie_next(pd, h)) {
      uint32_t w = dyd_tie_vertex(&pd->mesh, h);
      for (uint32_t p = base; w != ghost && p + 1 < q && p < base + DYD_RIM_PART; p++)
        if (v[p - base] != ghost && (p > 0 || q + 1 < size)) visit(context, v[p - base], w, DYD_TIE);
      if (q < base + DYD_RIM_PART) v[q - base] = w;
      if (q == base + DYD_RIM_PART) from = h;
    }
  }
}

/* An edge of the skeleton inside a face that lists no pairs: itself, if the face is capped, or both diagonals of a
 * quad. */
static inline void dyd_each_inner(const dyd_delaunay *pd, uint32_t t, unsigned k, dyd_pair_visit visit, void *context) {
  const dyd_tri *here = &pd->mesh.tri[t], *there = &pd->mesh.tri[here->n[k] >> 2];
  uint32_t seed = pd->faces.seed[pd->faces.of[t]], v = here->v[dyd_next(k)], w = here->v[dyd_prev(k)];
  if (seed & DYD_SEED_CAPPED) visit(context, v, w, DYD_INDETERMINATE);
  if (!(seed & DYD_SEED_QUAD)) return;
  visit(context, v, w, DYD_TIE);
  visit(context, here->v[k], there->v[here->n[k] & 3], DYD_TIE);
}

/* The real edges of t that t names before its neighbours do, as bits. */
static inline unsigned dyd_edges_first_named(const dyd_mesh *m, uint32_t t) {
  const dyd_tri *at = &m->tri[t];
  unsigned later =
      (unsigned)(at->n[0] > 4 * t) | (unsigned)(at->n[1] > 4 * t + 1) << 1 | (unsigned)(at->n[2] > 4 * t + 2) << 2;
  if (!dyd_mesh_is_ghost(m, t)) return later;
  return later & (at->v[0] == m->n ? 1u : at->v[1] == m->n ? 2u : 4u);
}

/* Edges of the skeleton: legal ones, and those inside faces that list none. Loops over bits: which edges qualify is as
 * good as random, and branches on it would be guessed wrongly. */
static inline void dyd_each_edge(const dyd_delaunay *pd, dyd_pair_visit visit, void *context) {
  const unsigned lowest = 0x1210; /* two bits for each value of three bits: its lowest bit */
  for (uint32_t t = 0; t < pd->mesh.count; t++) {
    const uint32_t *v = pd->mesh.tri[t].v;
    unsigned named = dyd_edges_first_named(&pd->mesh, t), legal = named & pd->certain[t];
    unsigned inner = pd->all_points ? named & ~legal : 0;
    for (; legal; legal &= legal - 1) {
      unsigned k = lowest >> 2 * legal & 3;
      visit(context, v[dyd_next(k)], v[dyd_prev(k)], DYD_LEGAL);
    }
    for (; inner; inner &= inner - 1) dyd_each_inner(pd, t, lowest >> 2 * inner & 3, visit, context);
  }
}

/* Every pair once; of capped faces only those of the skeleton. */
static inline void dyd_each_pair(const dyd_delaunay *pd, dyd_pair_visit visit, void *context) {
  if (pd->mesh.collinear) {
    dyd_each_line_pair(pd, visit, context);
    return;
  }
  dyd_each_edge(pd, visit, context);
  for (size_t f = 0; f < pd->faces.count; f++) {
    if (!pd->all_points)
      dyd_each_listed_pair(pd, f, visit, context);
    else if (!(pd->faces.seed[f] & DYD_SEED_MARKS))
      dyd_each_tie(pd, f, visit, context);
  }
}

#endif
