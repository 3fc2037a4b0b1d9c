/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The undecided faces: triangles joined by uncertain edges, with their possible pairs; for exact points see ties.h. */
#ifndef DYD_DELAUNAY_FACES_H
#define DYD_DELAUNAY_FACES_H

#include "possible/cover.h"

/* Finds and closes all undecided faces among the triangles tri[0..count-1] (NULL: all), whose marks are DYD_NONE, and
 * adds them to the table. On failure the faces added so far are taken back. */
dyd_status dyd_faces_find(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count);
/* Puts the faces found among the triangles of one face of the table in its place. *replaced: done, even if a failure
 * afterwards left pairs of other faces listed that are impossible by now; otherwise the old face stays. */
dyd_status dyd_faces_replace(bool *replaced, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count);
/* Marks all triangles DYD_NONE, unless there are marks. */
dyd_status dyd_faces_mark(dyd_delaunay *pd);
void dyd_faces_clear(dyd_face_table *f);
/* Vertices of face f, ascending; *vertex is owned by the caller. */
dyd_status dyd_face_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f);
/* Does it have triangles at the ghost? */
bool dyd_face_is_outer(const dyd_delaunay *pd, size_t f);
/* Are pairs beyond the skeleton missing? */
bool dyd_face_is_capped(const dyd_delaunay *pd, size_t f);
/* The pair (i,j), i < j, in a face's list, or DYD_ILLEGAL. */
dyd_pair_status dyd_face_status(const dyd_delaunay *pd, const dyd_face *f, uint32_t i, uint32_t j);
/* How pairs of this face that are not legal are called. */
static inline dyd_pair_status dyd_face_open_status(const dyd_face *f) {
  return f->tie && !f->capped ? DYD_TIE : DYD_INDETERMINATE;
}

#endif
