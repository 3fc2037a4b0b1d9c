/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The first pass over the edges of thin rectangles: most are certain by the two triangles beside them [WIT-NEAR]. Those
 * whose triangles a fat one meets are left to the next pass [WIT-FAT].
 *
 * The distance m to the nearest representatives is first bounded for all vertices at once: `most` for vertices that
 * have no shorter skeleton edge (found by one pass over the edges), the least edge of all for the others. */
#include "legal/near_filter.h"

#include "base/alloc.h"
#include "base/prefetch.h"
#include "legal/marks.h"

#include <float.h>

enum { BATCH = 240 };

typedef struct near_pass {
  dyd_skeleton *sk;
  dyd_work *w;
  double reach, least, most;
  const uint32_t *met; /* triangles whose edges are left to later passes: not 0. NULL: none */
  uint8_t *close;      /* of each vertex: it has an edge shorter than `most` */
  dyd_mark_tasks tasks;
  double shortest2[DYD_RANGES_MOST]; /* in each range */
} near_pass;

double dyd_short_edge(const dyd_mesh *m) {
  enum { SAMPLE = 4096, SHARE = 200 };
  double shortest2[SAMPLE / SHARE + 1]; /* ascending */
  uint32_t sample = m->count < SAMPLE ? m->count : SAMPLE, rank = sample / SHARE, found = 0;
  for (uint32_t s = 0; s < sample; s++) {
    const uint32_t *v = m->tri[(uint64_t)s * m->count / sample].v;
    double d = dyd_square_distance(m->xy[v[s % 3]], m->xy[v[dyd_next(s % 3)]]);
    if (!(d < DBL_MAX) || (found > rank && d >= shortest2[rank])) continue; /* a ghost edge, or a longer one */
    uint32_t at = found <= rank ? found++ : rank;
    for (; at && shortest2[at - 1] > d; at--) shortest2[at] = shortest2[at - 1];
    shortest2[at] = d;
  }
  return found ? sqrt(shortest2[found - 1]) : 0;
}

/* Several tasks may say the same of one vertex at once. */
static void set_close(const near_pass *p, uint32_t v) {
  if (!__atomic_load_n(&p->close[v], __ATOMIC_RELAXED)) __atomic_store_n(&p->close[v], 1, __ATOMIC_RELAXED);
}

/* Least edge, and the vertices that have a short one. Ghost edges are NaN and change nothing. */
static void measure_range(void *context, size_t number) {
  near_pass *p = context;
  const dyd_mesh *m = &p->sk->mesh;
  const dyd_marks *range = &p->tasks.task[number];
  double least2 = DBL_MAX, most2 = p->most * p->most;
  for (uint32_t t = range->first; t < range->end; t++) {
    const uint32_t *v = m->tri[t].v;
    for (unsigned k = 0; k < 3; k++) {
      uint32_t a = v[k], b = v[dyd_next(k)];
      double d = dyd_square_distance(m->xy[a], m->xy[b]);
      if (d < least2) least2 = d;
      if (d < most2) set_close(p, a), set_close(p, b);
    }
  }
  p->shortest2[number] = least2;
}

static void measure_edges(near_pass *p) {
  double least2 = DBL_MAX;
  dyd_parallel(p->w->threads, p->tasks.count, measure_range, p);
  for (size_t r = 0; r < p->tasks.count; r++)
    if (p->shortest2[r] < least2) least2 = p->shortest2[r];
  p->least = sqrt(least2);
  if (p->most < p->least) p->most = p->least;
}

static bool is_near(const near_pass *p, dyd_half_edge h) {
  const dyd_mesh *m = &p->sk->mesh;
  dyd_half_edge twin = dyd_edge_twin(m, h);
  uint32_t u = dyd_edge_apex(m, h), a = dyd_edge_apex(m, twin), i = dyd_edge_origin(m, h), j = dyd_edge_target(m, h);
  if (i == m->n || j == m->n) return false;
  if (p->met && (p->met[dyd_edge_triangle(h)] || p->met[dyd_edge_triangle(twin)])) return false;
  const dyd_xy *xy = m->xy;
  double nearest = p->close[i] || p->close[j] ? p->least : p->most;
  if (dyd_filter_edge_near(xy[i], xy[j], xy[u], xy[a], p->reach, nearest)) return true;
  if (u == m->n) return dyd_filter_hull_edge_near(xy[j], xy[i], xy[a], p->reach, nearest);
  return a == m->n && dyd_filter_hull_edge_near(xy[i], xy[j], xy[u], p->reach, nearest);
}

/* Three loops, so that memory answers in time: triangles, then points, then the decision. */
static void decide_batch(const near_pass *p, dyd_marks *range, const dyd_half_edge *edge, unsigned count) {
  const dyd_mesh *m = &p->sk->mesh;
  for (unsigned q = 0; q < count; q++) {
    dyd_prefetch(&m->xy[dyd_edge_origin(m, edge[q])]);
    dyd_prefetch(&m->xy[dyd_edge_target(m, edge[q])]);
    dyd_prefetch(&m->xy[dyd_edge_apex(m, edge[q])]);
    dyd_prefetch(&m->xy[dyd_edge_across(m, edge[q])]);
  }
  for (unsigned q = 0; q < count; q++)
    if (is_near(p, edge[q])) dyd_mark(range, p->sk, edge[q]);
}

static void near_of_range(void *context, size_t number) {
  near_pass *p = context;
  const dyd_mesh *m = &p->sk->mesh;
  dyd_marks *range = &p->tasks.task[number];
  dyd_half_edge edge[BATCH + 3];
  for (uint32_t t = range->first; t < range->end;) {
    unsigned count = 0;
    for (; t < range->end && count < BATCH; t++)
      for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++) {
        dyd_half_edge twin = dyd_edge_twin(m, h);
        dyd_prefetch(&m->tri[dyd_edge_triangle(twin)]);
        edge[count] = h;
        count += twin > h;
      }
    decide_batch(p, range, edge, count);
  }
}

dyd_status dyd_certify_near(dyd_skeleton *sk, dyd_work *w, double reach, const uint32_t *met, double most) {
  near_pass p = {.sk = sk, .w = w, .met = met, .most = most, .reach = reach > 0x1p-300 ? reach : 0x1p-300};
  p.close = calloc((size_t)sk->mesh.n + 1, 1);
  if (!p.close) return DYD_E_NOMEM;
  dyd_status st = dyd_mark_tasks_init(&p.tasks, sk, w);
  if (st == DYD_OK) {
    measure_edges(&p);
    dyd_parallel(w->threads, p.tasks.count, near_of_range, &p);
    st = dyd_mark_tasks_settle(&p.tasks, true);
  }
  free(p.close);
  return st;
}
