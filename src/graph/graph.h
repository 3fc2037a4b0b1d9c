/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Graphs of neighbours. All of them consist of possible pairs of the triangulation, and only possible partners of i
 * decide a pair of i [NNG-1] [GAB-1].
 *
 *   graph_filter.c   one pair in doubles
 *   reach.c          whether one pair is possible, exactly
 *   graph.c          the graphs */
#ifndef DYD_GRAPH_GRAPH_H
#define DYD_GRAPH_GRAPH_H

#include "delaunay/memory.h"
#include "predicate/interval_filter.h"
#include "rect/irect.h"
#include "skeleton/rects_filter.h"
#include <dyadel/graph.h>

/* Rectangles that are compared exactly. Invariant: rect and grid are initialised up to made; grid[0 .. count-1] are in
 * use, all multiplied by one factor, so that all ends are multiples of 4. */
typedef struct dyd_reach {
  dyd_rect *rect;
  const dyd_rect **in;
  dyd_irect *grid;
  bool *mark;
  size_t count, made;
  mpz_t rho, d, e; /* scratch */
} dyd_reach;

/* Is there a place x in the box with dl_k(x)^2 >= rho(x) for all k? rho: of the sides of number j, and of those of
 * number 0 where `both`. true as well when memory is exhausted. */
bool dyd_reach_has_place(dyd_reach *r, size_t j, bool both, const dyd_irect *box);

/* pairs: the possible ones, of at least the status `least`. partner[start[i] .. start[i + 1] - 1]: those of site i,
 * ascending. */
typedef struct dyd_graph_work {
  const dyd_delaunay *pd;
  const dyd_sites *sites;
  const volatile int *cancel;
  size_t n;
  dyd_pair_status least;
  dyd_pair_list pairs;
  size_t *start;
  uint32_t *partner;
  dyd_bbox *box;              /* outward; of each site */
  const dyd_pair_list *discs; /* dyd_disc_pairs: edges are about the discs in the squares of sites; NULL: rectangles */
  dyd_iv (*ball)[3];          /* with discs: centre and radius, of each site */
  dyd_reach reach;
  dyd_memory memory; /* what the triangulation leaves of max_bytes */
  uint32_t *other;   /* scratch, as long as the longest list of partners */
  size_t others;
  dyd_graph_list out;
  size_t cap;
} dyd_graph_work;

/* The verdict on a pair, if it is known. */
typedef enum dyd_graph_status { DYD_GRAPH_NEVER, DYD_GRAPH_POSSIBLE, DYD_GRAPH_SURE } dyd_graph_status;
typedef struct dyd_graph_verdict {
  bool known;
  dyd_graph_status status;
} dyd_graph_verdict;

/* The squared length of pair number `pair`, least or largest, is in [lo, hi]; lo = hi: it is that. */
typedef struct dyd_length {
  const dyd_graph_work *of;
  double lo, hi;
  uint32_t pair;
  bool largest;
} dyd_length;

/* graph_filter.c. w->other becomes the partners of i that may be nearest to it; only they decide [NNG-1]. */
void dyd_filter_nearest_few(dyd_graph_work *w, uint32_t i);
dyd_graph_verdict dyd_filter_nearest(const dyd_graph_work *w, uint32_t i, uint32_t j);
/* Against the partners of i. */
dyd_graph_verdict dyd_filter_gabriel(const dyd_graph_work *w, uint32_t i, uint32_t j);
/* With discs: an end of the enclosed lengths themselves, which is known. */
dyd_length dyd_filter_length(const dyd_graph_work *w, uint32_t pair, bool largest);

/* The status of what its squares leave possible, for discs [GRD-1]: as nearest, against w->other; in the Gabriel graph,
 * against the partners of i. */
dyd_graph_status dyd_filter_ball_nearest(const dyd_graph_work *w, uint32_t i, uint32_t j);
dyd_graph_status dyd_filter_ball_gabriel(const dyd_graph_work *w, uint32_t i, uint32_t j);

/* dyd_graph_edges where pairs and balls are those of discs in the squares of sites [GRD-1]; both NULL: of rectangles.
 */
dyd_status dyd_graph_of_discs(dyd_graph_list *out, const dyd_delaunay *pd, const dyd_pair_list *discs,
                              dyd_iv (*ball)[3], dyd_graph graph, const volatile int *cancel, dyd_error *err);

#endif
