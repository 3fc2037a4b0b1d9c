/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What graphs of neighbours are worked out with. All of them have possible pairs of the triangulation only, and who
 * decides about a pair of i is a possible partner of i [NNG-1] [GAB-1].
 *
 *   graph_filter.c   one pair in doubles
 *   reach.c, clip.c  one pair exactly
 *   nearest.c, gabriel.c, spanning.c, lengths_filter.c   the graphs */
#ifndef DYD_GRAPH_GRAPH_H
#define DYD_GRAPH_GRAPH_H

#include "delaunay/memory.h"
#include "graph/reach.h"
#include "skeleton/distance_filter.h"
#include <dyadel/graph.h>

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
  dyd_bbox *box; /* outward; of each site */
  dyd_reach reach;
  dyd_room room;   /* what max_bytes leaves beside the triangulation */
  uint32_t *other; /* scratch, as long as the longest list of partners */
  size_t others;
  dyd_graph_list out;
  size_t cap;
} dyd_graph_work;

/* What is known of a pair. */
typedef enum dyd_graph_status { DYD_GRAPH_NEVER, DYD_GRAPH_POSSIBLE, DYD_GRAPH_SURE } dyd_graph_status;
typedef struct dyd_graph_verdict {
  bool known;
  dyd_graph_status status;
} dyd_graph_verdict;

dyd_status dyd_graph_add(dyd_graph_work *w, uint32_t i, uint32_t j, bool sure);

/* graph_filter.c. w->other becomes the partners of i that may be nearest to it; only they decide [NNG-1]. */
void dyd_filter_nearest_few(dyd_graph_work *w, uint32_t i);
dyd_graph_verdict dyd_filter_nearest(const dyd_graph_work *w, uint32_t i, uint32_t j);
/* Against the partners of i. */
dyd_graph_verdict dyd_filter_gabriel(const dyd_graph_work *w, uint32_t i, uint32_t j);

dyd_status dyd_gabriel_status(dyd_graph_status *out, dyd_graph_work *w, uint32_t i, uint32_t j);

dyd_status dyd_nearest_graph(dyd_graph_work *w);
dyd_status dyd_gabriel_graph(dyd_graph_work *w);
dyd_status dyd_spanning_graph(dyd_graph_work *w);

#endif
