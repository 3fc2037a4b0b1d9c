/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A packed tree of boxes over the vertices in spatial order: who can be near, who can lie beyond a line.
 *
 * Every node holds the hull of 8 consecutive vertices or nodes, so extents count, not only centres. Answers are
 * conservative: everybody who might qualify is visited. */
#ifndef DYD_SKELETON_TREE_H
#define DYD_SKELETON_TREE_H

#include "skeleton/distance_filter.h"
#include <dyadel/status.h>
#include <stdbool.h>

enum { DYD_TREE_FANOUT = 8, DYD_TREE_LEVELS = 12 };

/* Invariant: node level[k] .. level[k+1]-1 are the nodes of level k (0: over items); a node's box holds the boxes of
 * its children. item[q] is the vertex of entry q; ascending: they go up. */
typedef struct dyd_tree {
  uint32_t count;
  uint32_t *item;
  const dyd_bbox *box; /* by vertex; borrowed */
  dyd_bbox *node;
  size_t level[DYD_TREE_LEVELS + 1];
  int levels;
  bool ascending;
} dyd_tree;

/* Over the vertices item[0..count-1]; takes over the array. */
dyd_status dyd_tree_init(dyd_tree *t, uint32_t *item, uint32_t count, const dyd_bbox *box);
void dyd_tree_clear(dyd_tree *t);
/* The entry of a vertex, in an ascending tree. */
uint32_t dyd_tree_entry(const dyd_tree *t, uint32_t vertex);
/* Entry q's box has shrunk. */
void dyd_tree_refresh(dyd_tree *t, uint32_t q);

/* Returns false to end the search. */
typedef bool (*dyd_visit)(void *context, uint32_t vertex);
/* Visits every vertex whose box may come within sqrt(*radius2) of a centre in c (closed). The visitor may lower
 * *radius2. */
void dyd_tree_near(const dyd_tree *t, const dyd_bbox *c, const double *radius2, dyd_visit visit, void *context);
/* Visits every vertex whose box may reach u.x >= *height for the direction u = (ux, uy). The visitor may raise *height.
 */
void dyd_tree_beyond(const dyd_tree *t, double ux, double uy, const double *height, dyd_visit visit, void *context);

#endif
