/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Ranges of triangles, and the lists of edges between them. */
#include "legal/marks.h"

#include "base/alloc.h"
#include "delaunay/view.h"

#include <string.h>

void dyd_mark_tasks_init(dyd_mark_tasks *tasks, const dyd_delaunay *pd) {
  size_t n = pd->mesh.count;
  memset(tasks, 0, sizeof *tasks);
  tasks->count = dyd_ranges(n);
  for (size_t r = 0; r < tasks->count; r++) {
    tasks->task[r].first = (uint32_t)dyd_range_begin(n, r);
    tasks->task[r].end = (uint32_t)dyd_range_begin(n, r + 1);
    tasks->task[r].status = DYD_OK;
  }
}

void dyd_mark_later(dyd_marks *m, uint32_t edge) {
  if (dyd_reserve((void **)&m->edge, &m->cap, m->count + 1, sizeof *m->edge))
    m->edge[m->count++] = edge;
  else
    m->status = DYD_E_NOMEM;
}

void dyd_mark(dyd_marks *m, dyd_delaunay *pd, uint32_t t, unsigned k) {
  uint32_t other = pd->mesh.tri[t].n[k] >> 2;
  if (other >= m->first && other < m->end)
    dyd_set_certain(pd, t, k);
  else
    dyd_mark_later(m, 4 * t + k);
}

static void clear_certain(dyd_delaunay *pd, uint32_t t, unsigned k) {
  uint32_t twin = pd->mesh.tri[t].n[k];
  pd->certain[t] &= (uint8_t) ~(1u << k);
  pd->certain[twin >> 2] &= (uint8_t) ~(1u << (twin & 3));
}

static dyd_status settle(dyd_mark_tasks *tasks, dyd_delaunay *pd, void apply(dyd_delaunay *, uint32_t, unsigned)) {
  dyd_status st = DYD_OK;
  for (size_t r = 0; r < tasks->count; r++) {
    dyd_marks *m = &tasks->task[r];
    for (size_t q = 0; q < m->count; q++) apply(pd, m->edge[q] >> 2, m->edge[q] & 3);
    dyd_counters_add(&pd->counters, &m->counters);
    if (st == DYD_OK) st = m->status;
    free(m->edge);
  }
  return st;
}

dyd_status dyd_mark_tasks_settle(dyd_mark_tasks *tasks, dyd_delaunay *pd) {
  return settle(tasks, pd, dyd_set_certain);
}

dyd_status dyd_mark_tasks_revoke(dyd_mark_tasks *tasks, dyd_delaunay *pd) {
  return settle(tasks, pd, clear_certain);
}
