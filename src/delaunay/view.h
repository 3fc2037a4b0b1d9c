/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a task sees: it shares all arrays with the others, and asks and counts for itself. */
#ifndef DYD_DELAUNAY_VIEW_H
#define DYD_DELAUNAY_VIEW_H

#include "delaunay/state.h"
#include "skeleton/mesh_fixed.h"

#include <string.h>

/* Before tasks start: what is made at the first need is made now, so that views do not make it each for themselves. */
static inline void dyd_view_prepare(dyd_delaunay *pd) {
  if (!pd->mesh.fixed && !pd->mesh.no_fixed && !pd->mesh.no_filter) dyd_fixed_prepare(&pd->mesh);
}

/* *view must stay where it is until it is closed. */
static inline void dyd_view_open(dyd_delaunay *view, const dyd_delaunay *pd) {
  *view = *pd;
  memset(&view->counters, 0, sizeof view->counters);
  view->mesh.counters = &view->counters;
  view->mesh.reps = &view->reps;
  view->mesh.asked = view->mesh.beyond = 0;
}

/* Adds what the view has counted to *sum. */
void dyd_view_close(dyd_delaunay_counters *sum, dyd_delaunay *view);
void dyd_counters_add(dyd_delaunay_counters *sum, const dyd_delaunay_counters *c);

#endif
