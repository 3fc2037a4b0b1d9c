/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Graphs of near neighbours: the nearest-neighbour graph, the Gabriel graph, the minimum spanning tree. Which of their
 * edges are certain, and which are possible, for points known as rectangles (mathematics: section 17). */
#ifndef DYADEL_GRAPH_H
#define DYADEL_GRAPH_H

#include <dyadel/delaunay.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum dyd_graph {
  DYD_GRAPH_NEAREST = 0, /* i, j: j is nearest to i. j, i need not be there */
  DYD_GRAPH_GABRIEL,     /* i, j: no site is in the disc that has both as ends of a diameter. i < j */
  DYD_GRAPH_MST          /* i, j: an edge of a minimum spanning tree. i < j */
} dyd_graph;

/* sure: an edge for every choice of points, strictly: no other site is equally near, no site is in the closed disc, no
 * detour is equally short. Otherwise: an edge, or one of several equally good ones, for some choice. Pairs that are not
 * listed are edges for no choice [NNG-1] [GAB-1] [MST-1]. */
typedef struct dyd_graph_edge {
  uint32_t i, j;
  bool sure;
} dyd_graph_edge;

/* Owned by the caller: init with {0}, release with dyd_graph_list_clear. */
typedef struct dyd_graph_list {
  size_t count;
  dyd_graph_edge *item;
} dyd_graph_list;
DYD_API void dyd_graph_list_clear(dyd_graph_list *l);

/* The edges of a graph, sorted by i, then j; aliases take part in nothing. *out is replaced. pairs: NULL for points in
 * the rectangles of pd; or those of dyd_disc_pairs for pd (tolerance.h) for points in the discs in its squares. "Sure"
 * and "not listed" are true for every choice, and narrower rectangles never take them back. Exact for the first two
 * graphs of rectangles. The spanning tree goes by the least and the largest length of each pair, and discs by what
 * squares show and by bounds in doubles [GRD-1]: an edge that is listed may be one for no choice; for exact points
 * there is none such. cancel: as in dyd_delaunay_options, may be NULL. Returns DYD_OK; DYD_E_ARG for an unknown graph,
 * and with pairs for a site that is not a square; DYD_CAPPED when pd is; DYD_CANCELLED; DYD_E_NOMEM. O(pairs log pairs)
 * where rectangles are small; in crowds of d rectangles up to d^3 for a pair. */
DYD_API dyd_status dyd_graph_edges(dyd_graph_list *out, const dyd_delaunay *pd, const dyd_pair_list *pairs,
                                   dyd_graph graph, const volatile int *cancel, dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
