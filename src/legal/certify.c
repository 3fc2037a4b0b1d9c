/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certain edges: exact points by exact in-circle tests, rectangles by witnesses.
 *
 * When all sites are exact points, an edge of the skeleton is legal iff the two triangles at it are not cocircular
 * (then the inside of its Voronoi edge consists of witnesses), hull edges are always legal, and a hull vertex is
 * certain iff it is not on the line of its two hull neighbours. No exact zero during the construction means: no tie at
 * all [TIE-1]. */
#include "legal/certify.h"

#include "base/local.h"
#include "legal/star_filter.h"
#include "legal/witness.h"
#include "skeleton/centre_filter.h"
#include "skeleton/hull.h"
#include "skeleton/mesh_filter.h"
#include "skeleton/rects_filter.h"

#include <string.h>

/* ---- exact points ---- */

typedef struct edge_pass {
  dyd_skeleton *sk;
  dyd_marks marks[DYD_RANGES_MOST];
} edge_pass;

static dyd_status decide_point_edges(void *context, dyd_work *w, size_t number, size_t begin, size_t end) {
  edge_pass *p = context;
  const dyd_mesh *m = &p->sk->mesh;
  p->marks[number] = (dyd_marks){.first = begin, .end = end};
  for (uint32_t t = (uint32_t)begin; t < end; t++)
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t); h++)
      if (dyd_edge_is_first(m, h) && dyd_point_edge_is_certain(&w->tally, m, h)) dyd_mark(&p->marks[number], p->sk, h);
  return DYD_OK;
}

/* ---- rectangles ---- */

/* Four exact points on a circle: no witness, and no need to look for one. */
static bool is_exact_tie(dyd_work *w, const dyd_skeleton *sk, dyd_half_edge h) {
  const uint32_t *v = sk->mesh.tri[dyd_edge_triangle(h)].v;
  const uint32_t four[4] = {v[0], v[1], v[2], dyd_edge_across(&sk->mesh, h)};
  for (unsigned q = 0; q < 4; q++)
    if (four[q] == sk->mesh.n || !dyd_vertex_is_point(sk, four[q])) return false;
  return dyd_mesh_beyond(&w->tally, &sk->mesh, h) == 0;
}

/* A rectangle that meets R_i or R_j is never outside of a disc that holds both: in a crowd that of a vertex across. */
static bool is_met_across(const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t across[2]) {
  bool met = false;
  for (int k = 0; k < 2 && !met && !sk->mesh.no_filter; k++)
    met = across[k] != sk->mesh.n &&
          (dyd_surely_meet(&sk->rects, across[k], i) || dyd_surely_meet(&sk->rects, across[k], j));
  return met;
}

static dyd_status decide_edge(bool *certain, dyd_work *w, const dyd_skeleton *sk, dyd_half_edge h) {
  const dyd_mesh *m = &sk->mesh;
  uint32_t i = dyd_edge_origin(m, h), j = dyd_edge_target(m, h);
  uint32_t across[2] = {dyd_edge_apex(m, h), dyd_edge_across(m, h)};
  bool hull = across[0] == m->n || across[1] == m->n;
  *certain = false;
  if (i == m->n || j == m->n) return dyd_hull_sure(certain, w, sk, i == m->n ? j : i);
  if (is_met_across(sk, i, j, across) || is_exact_tie(w, sk, h)) return DYD_OK;
  /* On a straight part of the hull circumcentres are far away and decide nothing: the middle of the two sites may. */
  *certain = (hull || dyd_edge_centre_is_far(sk, h)) && dyd_witness_at(w, sk, h, dyd_edge_middle(sk, h));
  if (*certain) return w->counters.witness_guess++, DYD_OK;
  dyd_status st = dyd_witness_search(certain, NULL, w, sk, i, j, dyd_edge_centre(sk, h), hull ? NULL : across);
  if (st == DYD_OK && !*certain && hull) st = dyd_witness_far(certain, NULL, w, sk, i, j);
  if (*certain) w->counters.witness_search++;
  return st;
}

dyd_status dyd_certify_edge(dyd_skeleton *sk, dyd_work *w, dyd_half_edge h) {
  bool certain;
  dyd_status st = decide_edge(&certain, w, sk, h);
  if (st == DYD_OK && certain) dyd_set_certain(sk, h, true);
  return st;
}

static dyd_status decide_edges(void *context, dyd_work *w, size_t number, size_t begin, size_t end) {
  edge_pass *p = context;
  dyd_status st = DYD_OK;
  p->marks[number] = (dyd_marks){.first = begin, .end = end};
  for (uint32_t t = (uint32_t)begin; t < end && st == DYD_OK; t++) {
    if (dyd_work_cancelled(w)) return DYD_CANCELLED;
    if (dyd_triangle_is_certain(p->sk, t)) continue;
    for (dyd_half_edge h = dyd_edge_of(t, 0); h < dyd_edge_end(t) && st == DYD_OK; h++) {
      bool certain = false;
      if (!dyd_edge_is_first(&p->sk->mesh, h) || dyd_edge_is_certain(p->sk, h)) continue;
      st = decide_edge(&certain, w, p->sk, h);
      if (certain) dyd_mark(&p->marks[number], p->sk, h);
    }
  }
  return st;
}

/* ---- the passes ---- */

static dyd_status certify_pass(dyd_skeleton *sk, dyd_work *w, dyd_work_task *task) {
  edge_pass p = {.sk = sk};
  if (sk->all_points || sk->reps.code) dyd_fixed_prepare(&sk->mesh); /* before several ask for it; else few will */
  dyd_status st = dyd_work_ranges(w, sk, sk->mesh.count, task, &p);
  dyd_status marked = dyd_marks_settle(p.marks, DYD_RANGES_MOST, sk, true);
  return st == DYD_OK ? marked : st;
}

dyd_status dyd_certify_points(dyd_skeleton *sk, dyd_work *w) {
  dyd_status st = DYD_OK;
  if (sk->mesh.tally.ties == 0)
    memset(sk->certain, 7, sk->mesh.count);
  else
    st = certify_pass(sk, w, decide_point_edges);
  if (st == DYD_OK) w->counters.witness_guess += dyd_certain_edges(sk); /* the middles of their Voronoi edges */
  return st;
}

dyd_status dyd_certify_all(dyd_skeleton *sk, dyd_work *w) {
  if (!sk->mesh.no_filter) {
    dyd_status st = dyd_certify_stars(sk, w->run->threads);
    if (st != DYD_OK) return st;
    uint64_t edges = dyd_certain_edges(sk);
    w->counters.filter += edges + dyd_certain_corners(sk);
    w->counters.witness_guess += edges;
  }
  return certify_pass(sk, w, decide_edges);
}
