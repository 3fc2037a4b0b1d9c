/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of undecided faces: entries come and go, and a pair that several list is shown by one. */
#ifndef DYD_DELAUNAY_FACE_TABLE_H
#define DYD_DELAUNAY_FACE_TABLE_H

#include "delaunay/state.h"
#include "skeleton/work.h"

void dyd_table_clear(dyd_undecided *f);
/* Marks all triangles as decided, unless there are marks. */
dyd_status dyd_table_mark(dyd_delaunay *pd);
/* Adds the faces, without pairs, among the triangles tri[0..all-1], or of all triangles (NULL). Exact points that are
 * not tied make edges certain on the way. */
dyd_status dyd_table_find(dyd_delaunay *pd, dyd_work *w, const uint32_t *tri, size_t all);
/* Gives face g its pairs, copied, and what `as` says of them. */
dyd_status dyd_table_store(dyd_delaunay *pd, size_t g, dyd_face as, const dyd_vertex_pair *pair);
/* Back to what the table was before faces were added. */
void dyd_table_roll_back(dyd_delaunay *pd, const dyd_undecided *before);
/* Hides the pairs of face g that belong to other faces, and in those the pairs that belong to it: each is shown where
 * the skeleton has it, else in a polygon, else where it was found first. */
void dyd_table_share_out(dyd_delaunay *pd, uint32_t g);
/* Takes face g out; the last one gets its number. Puts it in again: there is room for it. */
void dyd_table_take_out(dyd_delaunay *pd, uint32_t g);
void dyd_table_put_back(dyd_delaunay *pd, const dyd_face *face);
/* Drops leftovers of replaced faces once they outnumber the entries in use. Does nothing if memory is exhausted. */
void dyd_table_compact(dyd_undecided *f);
/* A search for faces but `self`, numbered at least `from` and below `to`, with triangles at v. The result for the last
 * vertex is kept: pairs come sorted. Begin with v = DYD_NONE. */
typedef struct dyd_table_star {
  size_t from, to;
  uint32_t self, v;
  bool others;
} dyd_table_star;
bool dyd_table_may_list(dyd_table_star *s, const dyd_delaunay *pd, uint32_t v);
/* A face numbered at least `from` and below `to` that lists p, shown or hidden, and where; NULL: none. */
dyd_vertex_pair *dyd_table_listed(dyd_face **owner, const dyd_delaunay *pd, dyd_vertex_pair p, size_t from, size_t to);
void dyd_table_delete(dyd_undecided *f, dyd_face *face, dyd_vertex_pair *at);

/* Where listed face f has the pair, shown or hidden; NULL: nowhere. */
dyd_vertex_pair *dyd_listed_pair(const dyd_delaunay *pd, size_t f, uint32_t v, uint32_t w);

/* The pairs of faces with more are found by both vertices in O(log pairs), so that going through the neighbours of each
 * vertex stays linear in the number of pairs. In the armed build small faces are, too. */
#ifdef DYD_ARMED
enum { DYD_FEW_PAIRS = 4 };
#else
enum { DYD_FEW_PAIRS = 64 };
#endif

/* Reports the n vertices v that have too many possible neighbours. */
void dyd_report_cap(dyd_work *w, const dyd_delaunay *pd, const uint32_t *v, size_t n);

#endif
