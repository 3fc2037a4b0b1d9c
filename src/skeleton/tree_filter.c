/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The packed box tree; its pruning tests are the bounds of distance_filter.h and [FLT-DIR] below. */
#include "skeleton/tree.h"

#include "base/alloc.h"
#include "base/invariant.h"

#include <math.h>
#include <string.h>

static void hull(dyd_bbox *h, const dyd_bbox *b) {
  h->e[0] = dyd_min(h->e[0], b->e[0]);
  h->e[1] = dyd_max(h->e[1], b->e[1]);
  h->e[2] = dyd_min(h->e[2], b->e[2]);
  h->e[3] = dyd_max(h->e[3], b->e[3]);
}

/* Children of node q on level k: entries [first, end) of the level below (items for k = 0). */
static void children(size_t *first, size_t *end, const dyd_tree *t, int k, size_t q) {
  size_t below = k == 0 ? t->count : t->level[k] - t->level[k - 1];
  *first = q * DYD_TREE_FANOUT;
  *end = *first + DYD_TREE_FANOUT < below ? *first + DYD_TREE_FANOUT : below;
}

static const dyd_bbox *child_box(const dyd_tree *t, int k, size_t entry) {
  return k == 0 ? &t->box[t->item[entry]] : &t->node[t->level[k - 1] + entry];
}

static void fill_node(dyd_tree *t, int k, size_t q) {
  size_t first, end;
  children(&first, &end, t, k, q);
  dyd_bbox h = *child_box(t, k, first);
  for (size_t e = first + 1; e < end; e++) hull(&h, child_box(t, k, e));
  t->node[t->level[k] + q] = h;
}

dyd_status dyd_tree_init(dyd_tree *t, uint32_t *item, uint32_t count, const dyd_bbox *box) {
  *t = (dyd_tree){.count = count, .item = item, .box = box, .ascending = true};
  for (uint32_t q = 1; q < count && t->ascending; q++) t->ascending = item[q - 1] < item[q];
  size_t width = count;
  while (count && (t->levels == 0 || width > 1)) {
    width = (width + DYD_TREE_FANOUT - 1) / DYD_TREE_FANOUT;
    t->level[t->levels + 1] = t->level[t->levels] + width;
    t->levels++;
  }
  t->node = dyd_alloc(t->level[t->levels], sizeof *t->node);
  if (!t->node) return DYD_E_NOMEM;
  for (int k = 0; k < t->levels; k++)
    for (size_t q = 0; q < t->level[k + 1] - t->level[k]; q++) fill_node(t, k, q);
  return DYD_OK;
}

void dyd_tree_clear(dyd_tree *t) {
  free(t->item);
  free(t->node);
  memset(t, 0, sizeof *t);
}

uint32_t dyd_tree_entry(const dyd_tree *t, uint32_t vertex) {
  uint32_t lo = 0, hi = t->count;
  while (hi - lo > 1) {
    uint32_t mid = lo + (hi - lo) / 2;
    if (t->item[mid] <= vertex)
      lo = mid;
    else
      hi = mid;
  }
  return lo;
}

void dyd_tree_refresh(dyd_tree *t, uint32_t q) {
  size_t entry = q;
  for (int k = 0; k < t->levels; k++) fill_node(t, k, entry /= DYD_TREE_FANOUT);
}

/* A depth-first search; at most 7 waiting siblings on each level. value: distance or height of the node when it was
 * put aside; the limit may have moved meanwhile. */
typedef struct frame {
  int level;
  size_t node;
  double value;
} frame;
enum { STACK = DYD_TREE_LEVELS * DYD_TREE_FANOUT };

/* The distance across of the centre from each box, along x (k = 0) or y (k = 2), as in dyd_ds2_lower. */
static void gaps(double gap[DYD_TREE_FANOUT], const dyd_bbox *box, const dyd_bbox *c, int k) {
  double lo = c->e[k], hi = c->e[k + 1];
  for (size_t e = 0; e < DYD_TREE_FANOUT; e++) {
    double g = dyd_max(box[e].e[k] - hi, lo - box[e].e[k + 1]);
    gap[e] = dyd_max(g, 0);
  }
}

/* dyd_ds2_lower for the children of a node; in loops without branches where their boxes lie side by side. Not to be
 * inlined: the compiler would unroll the loops before it could use vectors. */
#if defined(__GNUC__)
__attribute__((noinline))
#endif
static void
distances(double value[DYD_TREE_FANOUT], const dyd_tree *t, int level, size_t first, size_t end, const dyd_bbox *c) {
  size_t count = end - first;
  bool side_by_side = level > 0 || (t->ascending && t->item[end - 1] - t->item[first] == count - 1);
  if (count == DYD_TREE_FANOUT && side_by_side) {
    double dx[DYD_TREE_FANOUT], dy[DYD_TREE_FANOUT];
    gaps(dx, child_box(t, level, first), c, 0);
    gaps(dy, child_box(t, level, first), c, 2);
    for (size_t e = 0; e < DYD_TREE_FANOUT; e++) value[e] = dyd_lower(dx[e] * dx[e] + dy[e] * dy[e]);
  } else {
    for (size_t e = 0; e < count; e++) value[e] = dyd_ds2_lower(c, child_box(t, level, first + e));
  }
  for (size_t e = 0; e < count; e++) DYD_INVARIANT(value[e] == dyd_ds2_lower(c, child_box(t, level, first + e)));
}

void dyd_tree_near(const dyd_tree *t, const dyd_bbox *c, const double *radius2, dyd_visit visit, void *context) {
  frame stack[STACK];
  double value[DYD_TREE_FANOUT];
  int depth = 0;
  if (t->levels) stack[depth++] = (frame){t->levels - 1, 0, 0};
  while (depth) {
    frame f = stack[--depth];
    size_t first, end;
    if (f.value > *radius2) continue;
    children(&first, &end, t, f.level, f.node);
    distances(value, t, f.level, first, end, c);
    for (size_t e = first; e < end; e++) {
      if (value[e - first] > *radius2) continue;
      if (f.level > 0)
        stack[depth++] = (frame){f.level - 1, e, value[e - first]};
      else if (!visit(context, t->item[e]))
        return;
    }
  }
}

/* Upper bound of max u.x over a box [FLT-DIR]: two products and a sum of relative error u, and the
 * bound's own rounding: below 8u(|ux x| + |uy
 * y|). */
static double reach(const dyd_bbox *b, double ux, double uy) {
  double px = ux * (ux > 0 ? b->e[1] : b->e[0]), py = uy * (uy > 0 ? b->e[3] : b->e[2]);
  double r = px + py + 8 * 0x1p-53 * (fabs(px) + fabs(py)) + DYD_TINY;
  return isnan(r) ? INFINITY : r;
}

void dyd_tree_beyond(const dyd_tree *t, double ux, double uy, const double *height, dyd_visit visit, void *context) {
  frame stack[STACK];
  int depth = 0;
  if (t->levels) stack[depth++] = (frame){t->levels - 1, 0, INFINITY};
  while (depth) {
    frame f = stack[--depth];
    size_t first, end;
    if (f.value < *height) continue;
    children(&first, &end, t, f.level, f.node);
    for (size_t e = first; e < end; e++) {
      double value = reach(child_box(t, f.level, e), ux, uy);
      if (value < *height) continue;
      if (f.level > 0)
        stack[depth++] = (frame){f.level - 1, e, value};
      else if (!visit(context, t->item[e]))
        return;
    }
  }
}
