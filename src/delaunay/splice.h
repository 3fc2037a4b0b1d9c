/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* New triangles for one undecided face after its rectangles were narrowed.
 *
 * The certain edges around (and inside) a face are edges of every skeleton, so they are edges of the Delaunay
 * triangulation of the face's vertices alone, and inside them both triangulations agree: an empty circle of the part,
 * seen from inside the face, is cut off from all other vertices by legal edges [LOC-1]. So the face is triangulated by
 * itself and put back into the same places; the number of triangles of a face is fixed by Euler's formula. */
#ifndef DYD_DELAUNAY_SPLICE_H
#define DYD_DELAUNAY_SPLICE_H

#include "delaunay/state.h"
#include "skeleton/work.h"

/* Are the triangles of the face Delaunay for the present representatives as they are, so that it may stay [LOC-2]?
 * Exact for bounded faces; false for others. */
bool dyd_splice_is_needless(dyd_work *w, const dyd_skeleton *sk, const uint32_t *tri, uint32_t tris);
/* Replaces the triangles tri[0..tris-1], a whole undecided face, by the skeleton of the present representatives. Edges
 * inside become uncertain; the marks of the face table are not touched. *fits: false if the face cannot be treated
 * alone (two sites have become the same exact point); nothing is changed then, nor on failure. */
dyd_status dyd_splice_face(bool *fits, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, uint32_t tris);

/* The same where only a few of the face's vertices, those listed, have new representatives: what is neither at them nor
 * has one of them in a circle stays [LOC-4]. *fits: false, too, where more has to change; nothing is changed then. */
dyd_status dyd_splice_near(bool *fits, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, uint32_t tris,
                           const uint32_t *vertex, uint32_t count);

#endif
