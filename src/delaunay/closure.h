/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* All possible pairs inside one undecided face, by closure under flips (mathematics: section 6). */
#ifndef DYD_DELAUNAY_CLOSURE_H
#define DYD_DELAUNAY_CLOSURE_H

#include "delaunay/state.h"
#include "skeleton/work.h"

/* What a face holds. Owned by the caller, released with dyd_closure_clear. */
typedef struct dyd_closure {
  uint32_t *vertex; /* its sites' vertices, ascending */
  uint32_t vertices;
  dyd_vertex_pair *pair; /* possible and not legal, sorted */
  size_t pairs, pair_cap;
  bool outer, all_points, capped, postponed;
  bool polygon; /* one cocircular polygon or collinear chain of exact points */
} dyd_closure;

/* Finds the pairs of the face made of the triangles tri[0..tris-1], joined by uncertain edges. At most `room` pairs are
 * kept; beyond that, where the face is postponed, or where work is stopped and w->run->keep_cut, only skeleton edges
 * and `capped`. */
dyd_status dyd_closure_run(dyd_closure *out, dyd_work *w, const dyd_skeleton *sk, const uint32_t *tri, uint32_t tris,
                           size_t room, bool postponed);
void dyd_closure_clear(dyd_closure *c);

#endif
