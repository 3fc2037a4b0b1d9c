/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The undecided faces when all sites are exact points.
 *
 * Each is one polygon of cocircular sites or one chain of collinear sites on the hull, and all its pairs but those of
 * its rim are ties [CLO-2], in no other face [CLO-3]. So nothing is listed: the table holds one triangle of each face,
 * and everything is read off the rim: the certain half-edges with the face on their left; that of a chain passes
 * through the ghost. */
#ifndef DYD_DELAUNAY_TIES_H
#define DYD_DELAUNAY_TIES_H

#include "delaunay/state.h"
#include "skeleton/work.h"

void dyd_table_clear(dyd_undecided *f);
/* Marks all triangles as decided, unless there are marks. n: sites. */
dyd_status dyd_table_mark(dyd_undecided *f, uint32_t n);

/* Finds all faces and fills the table; the marks of the table are made when there is a face. On failure the table is
 * empty. */
dyd_status dyd_ties_find(dyd_delaunay *pd, dyd_work *w);

/* Takes the face that triangle t is in, if there is one, out of the table; the last face gets its number. */
dyd_status dyd_ties_drop(dyd_delaunay *pd, uint32_t t);
/* Adds the face that triangle t is in, if it is undecided and in none yet. */
dyd_status dyd_ties_add(dyd_delaunay *pd, dyd_work *w, uint32_t t);

/* Tied pairs of k sites of one circle, or (chain) of one line. */
static inline uint64_t dyd_group_pairs(uint64_t k, bool chain) {
  return chain ? (k - 1) * (k - 2) / 2 : k * (k - 3) / 2;
}
static inline uint32_t dyd_tie_seed(const dyd_delaunay *pd, size_t f) {
  return pd->open.seed[f] & ~DYD_SEED_QUAD;
}
/* The rim's half-edge out of the origin of h, a half-edge in the face: turns clockwise across uncertain edges. */
static inline dyd_half_edge dyd_tie_rim(const dyd_skeleton *sk, dyd_half_edge h) {
  while (!dyd_edge_is_certain(sk, h)) h = dyd_edge_turn_back(&sk->mesh, h);
  return h;
}
/* The rim's next half-edge, counter-clockwise. */
static inline dyd_half_edge dyd_tie_next(const dyd_skeleton *sk, dyd_half_edge h) {
  return dyd_tie_rim(sk, dyd_edge_next(h));
}
/* A half-edge on the rim of face f. */
static inline dyd_half_edge dyd_tie_start(const dyd_delaunay *pd, size_t f) {
  return dyd_tie_rim(&pd->sk, dyd_edge_of(dyd_tie_seed(pd, f), 2));
}

/* ---- ties because the true points are proved to be on one circle or line ---- */

/* Examines a listed face, which has not been closed, by the callback for proofs. Where it is a tie, *as says so
 * (proved), and *pair, owned by the caller, has its pairs. Does nothing without a callback that proves. DYD_OK or a
 * failure, also of the callback that was asked. */
dyd_status dyd_prove_face(dyd_face *as, dyd_vertex_pair **pair, const dyd_delaunay *pd, dyd_work *w,
                          const dyd_face *face);
/* A half-edge of the rim of listed face `face`, that of the ghost for a chain; DYD_NONE unless the rim is one cycle. */
dyd_half_edge dyd_rim_start(bool *chain, const dyd_delaunay *pd, const dyd_face *face);
/* The same for the sites of a line, pd->line_tie, and their pairs: all are possible, and count as one face. Ties are
 * one group, which the cap does not count. */
dyd_status dyd_line_find(dyd_delaunay *pd, dyd_work *w);

#endif
