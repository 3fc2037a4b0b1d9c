/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The least and the largest length of a pair, compared exactly. */
#ifndef DYD_GRAPH_LENGTHS_H
#define DYD_GRAPH_LENGTHS_H

#include "graph/graph.h"

/* The squared length of pair number `pair`, least or largest, is in [lo, hi]; lo = hi: it is that. */
typedef struct dyd_length {
  const dyd_graph_work *of;
  double lo, hi;
  uint32_t pair;
  bool largest;
} dyd_length;

/* lengths_filter.c */
dyd_length dyd_filter_length(const dyd_graph_work *w, uint32_t pair, bool largest);

/* Sign of a - b. */
int dyd_length_compare(const dyd_length *a, const dyd_length *b);
/* By length; for qsort. */
int dyd_length_order(const void *a, const void *b);

#endif
