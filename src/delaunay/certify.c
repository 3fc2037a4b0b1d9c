/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certain edges: exact points by exact in-circle tests, rectangles by witnesses.
 *
 * When all sites are exact points, an edge of the skeleton is legal iff the two triangles at it are not cocircular
 * (then the inside of its Voronoi edge consists of witnesses), hull edges are always legal, and a hull vertex is sure
 * iff it is not on the line of its two hull neighbours. No exact zero during the construction means: no tie at all
 * [TIE-1]. */
#include "delaunay/certify.h"

#include "delaunay/hull.h"
#include "delaunay/witness.h"

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

/* Certain edges that are real: their witness is the middle of the skeleton's Voronoi edge. */
static uint64_t certain_real_edges(const dyd_delaunay *pd) {
  uint64_t twice = 0;
  for (uint32_t t = 0; t < pd->mesh.count; t++) {
    const uint32_t *v = pd->mesh.tri[t].v;
    for (unsigned k = 0; k < 3; k++)
      twice += v[dyd_next(k)] != pd->mesh.n && v[dyd_prev(k)] != pd->mesh.n && dyd_edge_is_certain(pd, t, k);
  }
  return twice / 2;
}

static void certify_points(dyd_delaunay *pd) {
  if (pd->mesh.ties == 0) memset(pd->certain, 7, pd->mesh.count);
  for (uint32_t t = 0; t < pd->mesh.count; t++)
    for (unsigned k = 0; k < 3; k++)
      if (pd->mesh.tri[t].n[k] > 4 * t + k && !dyd_edge_is_certain(pd, t, k) && dyd_point_edge_is_certain(pd, t, k))
        dyd_set_certain(pd, t, k);
  pd->counters.witness_guess += certain_real_edges(pd);
}

/* Four exact points on a circle: no witness, and no need to look for one. */
static bool is_exact_tie(dyd_delaunay *pd, uint32_t t, unsigned k) {
  const uint32_t *v = pd->mesh.tri[t].v;
  uint32_t twin = pd->mesh.tri[t].n[k], across = pd->mesh.tri[twin >> 2].v[twin & 3];
  for (unsigned q = 0; q < 3; q++)
    if (v[q] == pd->mesh.n || !dyd_vertex_is_point(pd, v[q])) return false;
  return across != pd->mesh.n && dyd_vertex_is_point(pd, across) && beyond_sign(pd, t, k) == 0;
}

dyd_status dyd_certify_edge(dyd_delaunay *pd, dyd_work *w, uint32_t t, unsigned k) {
  uint32_t g = pd->mesh.n, i = pd->mesh.tri[t].v[dyd_next(k)], j = pd->mesh.tri[t].v[dyd_prev(k)];
  uint32_t twin = pd->mesh.tri[t].n[k], across[2] = {pd->mesh.tri[t].v[k], pd->mesh.tri[twin >> 2].v[twin & 3]};
  bool certain = false, hull = across[0] == g || across[1] == g;
  dyd_status st = DYD_OK;
  if (i == g || j == g)
    st = dyd_hull_sure(&certain, w, pd, i == g ? j : i);
  else if (!is_exact_tie(pd, t, k)) {
    st = dyd_witness_search(&certain, NULL, pd, i, j, dyd_edge_centre(pd, t, k), hull ? NULL : across);
    if (st == DYD_OK && !certain && hull) st = dyd_witness_far(&certain, NULL, w, pd, i, j);
    if (certain) pd->counters.witness_search++;
  }
  if (st == DYD_OK && certain) dyd_set_certain(pd, t, k);
  return st;
}

dyd_status dyd_certify_all(dyd_delaunay *pd, dyd_work *w) {
  if (pd->all_points) {
    certify_points(pd);
    return DYD_OK;
  }
  dyd_status st = pd->options.no_filter ? DYD_OK : dyd_certify_stars(pd);
  for (uint32_t t = 0; t < pd->mesh.count && st == DYD_OK; t++) {
    if (dyd_cancelled(pd)) return DYD_CANCELLED;
    for (unsigned k = 0; k < 3 && st == DYD_OK; k++)
      if (pd->mesh.tri[t].n[k] > 4 * t + k && !dyd_edge_is_certain(pd, t, k)) st = dyd_certify_edge(pd, w, t, k);
  }
  return st;
}
