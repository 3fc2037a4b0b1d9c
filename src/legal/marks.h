/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Marking certain edges from several tasks.
 *
 * An edge is marked in both its triangles. A task has a range of triangles and marks edges inside of it at once; edges
 * that reach into another range wait in a list until all tasks are done. */
#ifndef DYD_LEGAL_MARKS_H
#define DYD_LEGAL_MARKS_H

#include "base/parallel.h"
#include "skeleton/work.h"

/* One task: its triangles, what it works with, which edges wait. */
typedef struct dyd_marks {
  uint32_t first, end;
  dyd_half_edge *edge;
  size_t count, cap;
  dyd_work work;
  dyd_status status;
} dyd_marks;

/* Tasks over all triangles of the skeleton: one for each range of dyd_ranges(triangles). */
typedef struct dyd_mark_tasks {
  dyd_skeleton *sk;
  dyd_work *w;
  size_t count;
  dyd_marks *task;
} dyd_mark_tasks;

/* Settling releases it. */
dyd_status dyd_mark_tasks_init(dyd_mark_tasks *tasks, dyd_skeleton *sk, dyd_work *w);
/* Half-edge h, of a triangle in the range, is certain. Sets status on failure. */
void dyd_mark(dyd_marks *marks, dyd_skeleton *sk, dyd_half_edge h);
/* Remembers the edge for later; sets status on failure. */
void dyd_mark_later(dyd_marks *marks, dyd_half_edge h);
/* Edges that waited become certain, or uncertain. Counters are added up in w, lists freed. The first failure of a task.
 */
dyd_status dyd_mark_tasks_settle(dyd_mark_tasks *tasks, bool certain);

#endif
