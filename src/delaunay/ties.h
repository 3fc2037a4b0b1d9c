/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The undecided faces when all sites are exact points.
 *
 * Each is one polygon of cocircular sites or one chain of collinear sites on the hull, and all its pairs but those of
 * its rim are ties [CLO-2], in no other face [CLO-3]. So nothing is listed: the table holds one triangle of each face,
 * and everything is read off the rim. The rim is walked with the face on the left by corners 4 t + k whose edge from
 * v[k] to v[k+1] is certain; the rim of a chain passes through the ghost. */
#ifndef DYD_DELAUNAY_TIES_H
#define DYD_DELAUNAY_TIES_H

#include "delaunay/state.h"

/* Finds all faces and fills the table; the marks of the table are made when there is a face. On failure the table is
 * empty. */
dyd_status dyd_ties_find(dyd_delaunay *pd);
/* The vertices of face f, ascending, without the ghost; *vertex is owned by the caller. */
dyd_status dyd_tie_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f);
bool dyd_tie_is_outer(const dyd_delaunay *pd, size_t f);
/* Status of two vertices whose pair is not legal. */
dyd_pair_status dyd_tie_status(const dyd_delaunay *pd, uint32_t v, uint32_t w);

static inline bool dyd_tie_is_capped(const dyd_delaunay *pd, size_t f) {
  return pd->faces.seed[f] & DYD_SEED_CAPPED;
}
static inline uint32_t dyd_tie_vertex(const dyd_mesh *m, uint32_t h) {
  return m->tri[h >> 2].v[h & 3];
}
/* The rim's corner at the vertex of corner h, a corner of the face: turns clockwise across uncertain edges. */
static inline uint32_t dyd_tie_rim(const dyd_delaunay *pd, uint32_t h) {
  while (!dyd_edge_is_certain(pd, h >> 2, dyd_prev(h & 3))) {
    uint32_t beyond = pd->mesh.tri[h >> 2].n[dyd_prev(h & 3)];
    h = (beyond & ~3u) | dyd_prev(beyond & 3);
  }
  return h;
}
/* The rim's next corner, counter-clockwise. */
static inline uint32_t dyd_tie_next(const dyd_delaunay *pd, uint32_t h) {
  return dyd_tie_rim(pd, (h & ~3u) | dyd_next(h & 3));
}
/* A corner on the rim of face f. */
static inline uint32_t dyd_tie_start(const dyd_delaunay *pd, size_t f) {
  return dyd_tie_rim(pd, 4 * (pd->faces.seed[f] & ~DYD_SEED_MARKS));
}
/* Vertices on the rim, the ghost counted too. */
static inline uint32_t dyd_tie_size(const dyd_delaunay *pd, uint32_t first) {
  uint32_t h = first, size = 0;
  do size++;
  while ((h = dyd_tie_next(pd, h)) != first);
  return size;
}

#endif
