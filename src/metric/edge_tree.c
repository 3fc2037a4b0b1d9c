/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The tree is filled once, from its leaves up; parts of it without edges have a box that meets none. */
#include "metric/edge_tree.h"

#include "base/alloc.h"
#include <stdlib.h>

enum { LEAF = 4 };

void dyd_edge_tree_clear(dyd_edge_tree *t) {
  dyd_free_all(t->edge, t->box);
}

static void edge_tree_fill(dyd_edge_tree *t) {
  for (size_t k = 2 * t->leaves; k-- > 1;) {
    memcpy(t->box[k], dyd_no_box, sizeof dyd_no_box);
    if (k < t->leaves) {
      dyd_box_join(t->box[k], t->box[2 * k]);
      dyd_box_join(t->box[k], t->box[2 * k + 1]);
      continue;
    }
    for (size_t e = LEAF * (k - t->leaves); e < t->count && e < LEAF * (k - t->leaves + 1); e++) {
      dyd_box_take(t->box[k], t->edge[e].p);
      dyd_box_take(t->box[k], t->edge[e].q);
    }
  }
}

dyd_status dyd_edge_tree_init(dyd_edge_tree *t, const dyd_area *a) {
  size_t n = a->rings ? a->offset[a->rings] : 0;
  *t = (dyd_edge_tree){.leaves = 1};
  while (LEAF * t->leaves < n) t->leaves *= 2;
  t->edge = dyd_alloc(n, sizeof *t->edge);
  t->box = dyd_alloc(2 * t->leaves, sizeof *t->box);
  if (!t->edge || !t->box) return DYD_E_NOMEM;
  for (size_t r = 0; r < a->rings; r++)
    for (size_t k = a->offset[r]; k < a->offset[r + 1]; k++) {
      const double *p = &a->xy[2 * k], *q = &a->xy[2 * (k + 1 < a->offset[r + 1] ? k + 1 : a->offset[r])];
      t->edge[t->count++] = (dyd_area_edge){{p[0], p[1]}, {q[0], q[1]}, r};
    }
  edge_tree_fill(t);
  return DYD_OK;
}

void dyd_edge_tree_range(size_t *first, size_t *last, const dyd_edge_tree *t, size_t k) {
  size_t end = k;
  while (k < t->leaves) k = 2 * k, end = 2 * end + 1;
  *first = LEAF * (k - t->leaves);
  *last = LEAF * (end - t->leaves + 1) - 1;
  if (*last >= t->count) *last = t->count - 1;
}

const dyd_area_edge *dyd_tree_walk_next(dyd_tree_walk *w) {
  const dyd_edge_tree *t = w->tree;
  double box[4];
  for (;;) {
    while (w->edge < w->end) {
      const dyd_area_edge *e = &t->edge[w->edge++];
      dyd_area_edge_box(box, e);
      if (dyd_boxes_touch(box, w->box)) return e;
    }
    if (!w->depth) return NULL;
    size_t k = w->stack[--w->depth];
    if (!dyd_boxes_touch(t->box[k], w->box)) continue;
    if (k < t->leaves) {
      w->stack[w->depth++] = 2 * k;
      w->stack[w->depth++] = 2 * k + 1;
    } else {
      w->edge = LEAF * (k - t->leaves);
      w->end = w->edge + LEAF < t->count ? w->edge + LEAF : t->count;
    }
  }
}
