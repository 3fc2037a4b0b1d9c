/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Ranges of triangles, and the lists of edges between them. */
#include "legal/marks.h"

#include "base/alloc.h"

dyd_status dyd_mark_tasks_init(dyd_mark_tasks *tasks, dyd_skeleton *sk, dyd_work *w) {
  size_t n = sk->mesh.count;
  *tasks = (dyd_mark_tasks){.sk = sk, .w = w, .count = dyd_ranges(n)};
  tasks->task = dyd_alloc(tasks->count, sizeof *tasks->task);
  if (!tasks->task) return DYD_E_NOMEM;
  for (size_t r = 0; r < tasks->count; r++) {
    tasks->task[r] = (dyd_marks){.first = (uint32_t)dyd_range_begin(n, r), .end = (uint32_t)dyd_range_begin(n, r + 1)};
    dyd_work_fork(&tasks->task[r].work, w, sk);
  }
  return DYD_OK;
}

void dyd_mark_later(dyd_marks *m, dyd_half_edge h) {
  if (dyd_reserve((void **)&m->edge, &m->cap, m->count + 1, sizeof *m->edge))
    m->edge[m->count++] = h;
  else
    m->status = DYD_E_NOMEM;
}

void dyd_mark(dyd_marks *m, dyd_skeleton *sk, dyd_half_edge h) {
  uint32_t other = dyd_edge_triangle(dyd_edge_twin(&sk->mesh, h));
  if (other >= m->first && other < m->end)
    dyd_set_certain(sk, h, true);
  else
    dyd_mark_later(m, h);
}

dyd_status dyd_mark_tasks_settle(dyd_mark_tasks *tasks, bool certain) {
  dyd_status st = DYD_OK;
  for (size_t r = 0; r < tasks->count; r++) {
    dyd_marks *m = &tasks->task[r];
    for (size_t q = 0; q < m->count; q++) dyd_set_certain(tasks->sk, m->edge[q], certain);
    dyd_work_join(tasks->w, &m->work);
    if (st == DYD_OK) st = m->status;
    free(m->edge);
  }
  free(tasks->task);
  return st;
}
