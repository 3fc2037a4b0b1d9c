/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Finding the undecided faces: triangles joined by uncertain edges, with their possible pairs. */
#ifndef DYD_DELAUNAY_FACES_H
#define DYD_DELAUNAY_FACES_H

#include "delaunay/narrowed.h"

/* Finds and closes all undecided faces among the triangles tri[0..count-1] (NULL: all), which are marked as decided,
 * and adds them to the table. On failure the faces added so far are taken back. */
dyd_status dyd_faces_find(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count);
/* Puts the faces found among the triangles of one face of the table in its place. *replaced: done, even if a failure
 * afterwards left pairs of other faces listed that are impossible by now; otherwise the old face stays. */
dyd_status dyd_faces_replace(bool *replaced, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count,
                             const dyd_narrowed *narrowed);

#endif
