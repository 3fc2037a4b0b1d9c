/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Marking certain edges from several tasks.
 *
 * An edge is marked in both its triangles. A task has a range of triangles and marks edges inside of it at once; edges
 * that reach into another range wait in a list until all tasks are done. */
#ifndef DYD_LEGAL_MARKS_H
#define DYD_LEGAL_MARKS_H

#include "base/parallel.h"
#include "delaunay/state.h"

/* What one task has marked and counted. */
typedef struct dyd_marks {
  uint32_t first, end; /* its triangles */
  uint32_t *edge;      /* 4 t + k */
  size_t count, cap;
  dyd_delaunay_counters counters;
  dyd_status status;
} dyd_marks;

/* Tasks over all triangles of pd: one for each range of dyd_ranges(triangles). */
typedef struct dyd_mark_tasks {
  size_t count;
  dyd_marks task[DYD_RANGES_MOST];
} dyd_mark_tasks;

void dyd_mark_tasks_init(dyd_mark_tasks *tasks, const dyd_delaunay *pd);
/* The edge 4 t + k, t in the range, is certain. Sets status on failure. */
void dyd_mark(dyd_marks *marks, dyd_delaunay *pd, uint32_t t, unsigned k);
/* Remembers the edge for later; sets status on failure. */
void dyd_mark_later(dyd_marks *marks, uint32_t edge);
/* Marks what waited, adds the counters to pd's and frees the lists. The first failure of a task. */
dyd_status dyd_mark_tasks_settle(dyd_mark_tasks *tasks, dyd_delaunay *pd);
/* The same, but edges that waited are not certain. */
dyd_status dyd_mark_tasks_revoke(dyd_mark_tasks *tasks, dyd_delaunay *pd);

#endif
