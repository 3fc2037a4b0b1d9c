/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certain edges: exact points by exact in-circle tests, rectangles by witnesses.
 *
 * When all sites are exact points, an edge of the skeleton is legal iff the two triangles at it are not cocircular
 * (then the inside of its Voronoi edge consists of witnesses), hull edges are always legal, and a hull vertex is sure
 * iff it is not on the line of its two hull neighbours. No exact zero during the construction means: no tie at all
 * [TIE-1]. */
#include "legal/certify.h"

#include "base/alloc.h"
#include "delaunay/build.h"
#include "delaunay/view.h"
#include "legal/marks.h"
#include "legal/witness.h"
#include "possible/hull.h"

#include <string.h>

/* Sign of the vertex beyond edge k of t against the circle of t: < 0 strictly outside. */
static int beyond_sign(dyd_delaunay *pd, uint32_t t, unsigned k) {
  dyd_mesh *m = &pd->mesh;
  const uint32_t *v = m->tri[t].v;
  uint32_t twin = m->tri[t].n[k];
  return dyd_mesh_incircle(m, v[0], v[1], v[2], m->tri[twin >> 2].v[twin & 3]);
}

bool dyd_point_edge_is_certain(dyd_delaunay *pd, uint32_t t, unsigned k) {
  uint32_t twin = pd->mesh.tri[t].n[k];
  bool here = dyd_mesh_is_ghost(&pd->mesh, t), there = dyd_mesh_is_ghost(&pd->mesh, twin >> 2);
  if (here != there) return true; /* a hull edge */
  return beyond_sign(pd, t, k) < 0;
}

/* ---- tasks ---- */

typedef struct pass {
  dyd_delaunay *pd;
  dyd_mark_tasks tasks;
} pass;

typedef void range_task(dyd_delaunay *view, dyd_marks *range);

static void run_on_view(pass *p, size_t number, range_task *task) {
  dyd_delaunay view;
  dyd_marks *range = &p->tasks.task[number];
  dyd_view_open(&view, p->pd);
  task(&view, range);
  dyd_view_close(&range->counters, &view);
}

static dyd_status run(dyd_delaunay *pd, dyd_task *task) {
  pass *p = dyd_alloc(1, sizeof *p);
  if (!p) return DYD_E_NOMEM;
  dyd_view_prepare(pd);
  p->pd = pd;
  dyd_mark_tasks_init(&p->tasks, pd);
  dyd_parallel(pd->options.threads, p->tasks.count, task, p);
  dyd_status st = dyd_mark_tasks_settle(&p->tasks, pd);
  free(p);
  return st;
}

/* ---- exact points ---- */

static void decide_point_edges(dyd_delaunay *view, dyd_marks *range) {
  for (uint32_t t = range->first; t < range->end; t++)
    for (unsigned k = 0; k < 3; k++)
      if (view->mesh.tri[t].n[k] > 4 * t + k && dyd_point_edge_is_certain(view, t, k)) dyd_mark(range, view, t, k);
}

static void point_edges_of_range(void *context, size_t number) {
  run_on_view(context, number, decide_point_edges);
}

static dyd_status certify_points(dyd_delaunay *pd) {
  dyd_status st = DYD_OK;
  if (pd->mesh.ties == 0)
    memset(pd->certain, 7, pd->mesh.count);
  else
    st = run(pd, point_edges_of_range);
  if (st == DYD_OK) pd->counters.witness_guess += dyd_certain_edges(pd); /* the middles of their Voronoi edges */
  return st;
}

/* ---- rectangles ---- */

/* Four exact points on a circle: no witness, and no need to look for one. */
static bool is_exact_tie(dyd_delaunay *pd, uint32_t t, unsigned k) {
  const uint32_t *v = pd->mesh.tri[t].v;
  uint32_t twin = pd->mesh.tri[t].n[k], across = pd->mesh.tri[twin >> 2].v[twin & 3];
  for (unsigned q = 0; q < 3; q++)
    if (v[q] == pd->mesh.n || !dyd_vertex_is_point(pd, v[q])) return false;
  return across != pd->mesh.n && dyd_vertex_is_point(pd, across) && beyond_sign(pd, t, k) == 0;
}

static dyd_status decide_edge(bool *certain, dyd_delaunay *pd, dyd_work *w, uint32_t t, unsigned k) {
  uint32_t g = pd->mesh.n, i = pd->mesh.tri[t].v[dyd_next(k)], j = pd->mesh.tri[t].v[dyd_prev(k)];
  uint32_t twin = pd->mesh.tri[t].n[k], across[2] = {pd->mesh.tri[t].v[k], pd->mesh.tri[twin >> 2].v[twin & 3]};
  bool hull = across[0] == g || across[1] == g;
  dyd_status st = DYD_OK;
  *certain = false;
  if (i == g || j == g)
    st = dyd_hull_sure(certain, w, pd, i == g ? j : i);
  else if (!is_exact_tie(pd, t, k)) {
    st = dyd_witness_search(certain, NULL, pd, i, j, dyd_edge_centre(pd, t, k), hull ? NULL : across);
    if (st == DYD_OK && !*certain && hull) st = dyd_witness_far(certain, NULL, w, pd, i, j);
    if (*certain) pd->counters.witness_search++;
  }
  return st;
}

dyd_status dyd_certify_edge(dyd_delaunay *pd, dyd_work *w, uint32_t t, unsigned k) {
  bool certain;
  dyd_status st = decide_edge(&certain, pd, w, t, k);
  if (st == DYD_OK && certain) dyd_set_certain(pd, t, k);
  return st;
}

static void decide_edges(dyd_delaunay *view, dyd_marks *range) {
  dyd_work w;
  dyd_work_init(&w, view);
  for (uint32_t t = range->first; t < range->end && range->status == DYD_OK; t++) {
    if (dyd_cancelled(view)) range->status = DYD_CANCELLED;
    for (unsigned k = 0; k < 3 && range->status == DYD_OK; k++) {
      bool certain = false;
      if (view->mesh.tri[t].n[k] < 4 * t + k || dyd_edge_is_certain(view, t, k)) continue;
      range->status = decide_edge(&certain, view, &w, t, k);
      if (certain) dyd_mark(range, view, t, k);
    }
  }
  dyd_work_clear(&w);
}

static void edges_of_range(void *context, size_t number) {
  run_on_view(context, number, decide_edges);
}

dyd_status dyd_certify_all(dyd_delaunay *pd) {
  if (pd->all_points) return certify_points(pd);
  dyd_status st = pd->options.no_filter ? DYD_OK : dyd_certify_stars(pd);
  return st == DYD_OK ? run(pd, edges_of_range) : st;
}
