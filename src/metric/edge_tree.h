/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The edges of an area in a tree of boxes. */
#ifndef DYD_METRIC_EDGE_TREE_H
#define DYD_METRIC_EDGE_TREE_H

#include <dyadel/metric.h>
#include <math.h>
#include <string.h>

typedef struct dyd_area_edge {
  double p[2], q[2];
  size_t ring;
} dyd_area_edge;

/* Edges follow each other along rings. box[k]: xlo, xhi, ylo, yhi of the edges of leaf k - leaves, or of the boxes 2 k
 * and 2 k + 1. */
typedef struct dyd_edge_tree {
  dyd_area_edge *edge;
  size_t count, leaves;
  double (*box)[4];
} dyd_edge_tree;

static const double dyd_no_box[4] = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};

static inline void dyd_box_join(double box[4], const double other[4]) {
  for (int k = 0; k < 4; k++)
    if (k & 1 ? other[k] > box[k] : other[k] < box[k]) box[k] = other[k];
}
static inline void dyd_box_take(double box[4], const double p[2]) {
  dyd_box_join(box, (const double[]){p[0], p[0], p[1], p[1]});
}
static inline bool dyd_boxes_touch(const double a[4], const double b[4]) {
  return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3];
}
static inline void dyd_area_edge_box(double box[4], const dyd_area_edge *e) {
  memcpy(box, dyd_no_box, sizeof dyd_no_box);
  dyd_box_take(box, e->p);
  dyd_box_take(box, e->q);
}

/* DYD_OK or DYD_E_NOMEM; release with dyd_edge_tree_clear in either case. O(edges). */
dyd_status dyd_edge_tree_init(dyd_edge_tree *t, const dyd_area *a);
void dyd_edge_tree_clear(dyd_edge_tree *t);
/* The edges of node k, from edge[*first] to edge[*last]; it has some. */
void dyd_edge_tree_range(size_t *first, size_t *last, const dyd_edge_tree *t, size_t k);

/* A walk over the edges whose boxes meet `box`. */
typedef struct dyd_tree_walk {
  const dyd_edge_tree *tree;
  double box[4];
  size_t stack[64], depth, edge, end;
} dyd_tree_walk;

static inline dyd_tree_walk dyd_tree_walk_begin(const dyd_edge_tree *t, const double box[4]) {
  return (dyd_tree_walk){.tree = t, .box = {box[0], box[1], box[2], box[3]}, .stack = {1}, .depth = 1};
}
/* The next one; NULL: that was all. */
const dyd_area_edge *dyd_tree_walk_next(dyd_tree_walk *w);

#endif
