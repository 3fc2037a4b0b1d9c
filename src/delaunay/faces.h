/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Finding the undecided faces: triangles joined by uncertain edges, with their possible pairs. */
#ifndef DYD_DELAUNAY_FACES_H
#define DYD_DELAUNAY_FACES_H

#include "delaunay/state.h"
#include "skeleton/work.h"

/* The table of undecided faces: entries come and go, and a pair that several list is shown by one. */

/* Takes face g out; the last one gets its number. */
void dyd_table_take_out(dyd_delaunay *pd, uint32_t g);
/* Drops leftovers of replaced faces once they outnumber the entries in use. Does nothing if memory is exhausted. */
void dyd_table_compact(dyd_undecided *f);

/* Where listed face f has the pair, shown or hidden; NULL: nowhere. */
dyd_vertex_pair *dyd_listed_pair(const dyd_delaunay *pd, size_t f, uint32_t v, uint32_t w);

/* The pairs of faces with more are found by both vertices in O(log pairs), so that going through the neighbours of each
 * vertex stays linear in the number of pairs. In the armed build small faces are, too. */
#ifdef DYD_ARMED
enum { DYD_FEW_PAIRS = 4 };
#else
enum { DYD_FEW_PAIRS = 64 };
#endif

/* A large face few of whose vertices were narrowed: what of it can change, and its pairs after that [LOC-4].
 *
 * A pair of others becomes impossible only when a narrowed vertex was a possible neighbour of both and now blocks them;
 * an edge becomes certain only at a narrowed vertex, or at a possible neighbour of one. So the rest is kept. */

/* Up to this number, narrowed vertices of a face are few. */
enum { DYD_FEW = 16 };

/* mark: of each vertex, the ghost last, what faces.c notes of it; NULL: no notes, all of the face is examined. old: the
 * face as it was; its pairs are in the table. certain: some edge of it has become so. */
typedef struct dyd_narrowed {
  uint32_t vertex[DYD_FEW], count;
  uint8_t *mark;
  dyd_face old;
  bool certain;
} dyd_narrowed;

/* Finds the consequences for face f of the table after the sites listed were narrowed, whose boxes have followed; the
 * skeleton and the pairs are those from before. To be cleared. */
dyd_status dyd_narrowed_init(dyd_narrowed *n, const dyd_delaunay *pd, uint32_t f, const uint32_t *changed,
                             size_t count);
void dyd_narrowed_clear(dyd_narrowed *n);
/* Returns true if an edge of the face can become certain. */
bool dyd_narrowed_reaches(const dyd_narrowed *n, const dyd_mesh *m, dyd_half_edge h);

/* Finds and closes all undecided faces among the triangles tri[0..count-1] (NULL: all), which are marked as decided,
 * and adds them to the table. On failure the faces added so far are taken back. */
dyd_status dyd_faces_find(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count);
/* Puts the faces found among the triangles of one face of the table in its place. *replaced: done, even if a failure
 * afterwards left pairs of other faces listed that are impossible by now; otherwise the old face stays. */
dyd_status dyd_faces_replace(bool *replaced, dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t count,
                             const dyd_narrowed *narrowed);

/* Faces were taken out, those listed, and others found from number `fresh` on: takes pairs that the old ones listed and
 * that are possible no more out of the other faces. */
dyd_status dyd_faces_end_pairs(dyd_delaunay *pd, dyd_work *w, const dyd_face *old, size_t olds, size_t fresh);

#endif
