/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries of Int_i and Pos_i. */
#ifndef DYD_VORONOI_EXACT_CELL_H
#define DYD_VORONOI_EXACT_CELL_H

#include "base/memory.h"
#include <dyadel/arc.h>
#include <dyadel/delaunay.h>

/* The task: the region of site `site` against `count` others.
 * rect: the rectangle of `site`, of the others, and of the window if there is one; site numbers ascending. outer: Pos,
 * else Int. pd: only pairs of others that it calls possible share a vertex; NULL: all may. keep_all: without
 * [PRUNE-1], for comparison. cancel: the work ends with DYD_CANCELLED once *cancel is set; may be NULL. room:
 * memory budget; NULL: no bound. All borrowed. */
typedef struct dyd_cell_task {
  uint32_t site;
  const uint32_t *other;
  size_t count;
  const dyd_rect *const *rect;
  bool outer, windowed;
  const dyd_delaunay *pd;
  bool keep_all;
  const volatile int *cancel;
  dyd_memory *memory;
} dyd_cell_task;

/* The boundary of Int_i or (outer) Pos_i; window NULL: in the whole plane; proved: as for
 * dyd_least_at. As dyd_voronoi_cell, and
 * DYD_CANCELLED once *cancel, which may be NULL, is set; room may be NULL. */
dyd_status dyd_cell_region(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, bool outer, bool proved,
                           const dyd_rect *window, dyd_memory *memory, const volatile int *cancel);

/* *out is replaced. */
dyd_status dyd_cell_boundary(dyd_boundary *out, const dyd_cell_task *task);

/* dyd_voronoi_side with a status: DYD_E_NOMEM, and DYD_E_ARG when there is no site i, leave *out as it was. */
dyd_status dyd_cell_point_side(dyd_truth *out, const dyd_delaunay *pd, uint32_t i, const dyd_point *c);

#endif
