/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The unbounded face cut into parts at sure corners of the hull.
 *
 * The walk of the face is cut at its corners. A bridge is no border: where it has two parts on its sides, the two are
 * one group. A group is what is left of the face between the rays out of corners. */
#ifndef DYD_CHECKER_PARTS_H
#define DYD_CHECKER_PARTS_H

#include "checker/graph.h"

/* Invariant: position q of the walk belongs to group[q]; the sites of group r are site[start[r] .. start[r+1]),
 * distinct, ascending, the corners at its ends among them. */
typedef struct dyd_cert_parts {
  uint32_t *group; /* by position of the walk */
  size_t groups;
  size_t *start;
  uint32_t *site;
} dyd_cert_parts;

/* walk: the half-edges of the face; corner[v]: is site v a corner? At least one is, and occurs once in the walk. */
dyd_status dyd_cert_parts_init(dyd_cert_parts *p, const dyd_cert_graph *g, const uint32_t *walk, size_t count,
                               const bool *corner);
void dyd_cert_parts_clear(dyd_cert_parts *p);
/* Sorts, drops repeats, returns how many are left. */
size_t dyd_cert_distinct(uint32_t *item, size_t count);

#endif
