/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Voronoi vertices of sure triangles, and default windows. */
#include "voronoi/vertex_filter.h"
#include <dyadel/voronoi.h>

#include <math.h>

/* Is t a sure triangle of pd? v becomes its vertices. */
static bool triangle_is_sure(const dyd_delaunay *pd, const dyd_triangle *t, uint32_t v[3]) {
  for (int k = 0; k < 3; k++) {
    if (t->v[k] >= pd->sk.n) return false;
    v[k] = pd->sk.vertex[t->v[k]];
  }
  dyd_half_edge h = dyd_find_edge(&pd->sk, v[0], v[1]);
  return h != DYD_NONE && dyd_edge_apex(&pd->sk.mesh, h) == v[2] && dyd_triangle_is_sure(pd, dyd_edge_triangle(h));
}

dyd_status dyd_voronoi_vertex(dyd_rect *out, const dyd_delaunay *pd, const dyd_triangle *t, int64_t bits) {
  uint32_t v[3];
  dyd_bbox box;
  if (!triangle_is_sure(pd, t, v)) return DYD_E_ARG;
  if (!pd->sk.mesh.no_filter && bits > -1000 && bits < 1000 && dyd_filter_vertex(&box, pd, v)) {
    double limit = ldexp(1, (int)-bits);
    if (box.e[1] - box.e[0] < limit && box.e[3] - box.e[2] < limit)
      return dyd_rect_set_d(out, box.e[0], box.e[1], box.e[2], box.e[3]);
  }
  dyd_rect r[3];
  dyd_status st = DYD_OK;
  for (int k = 0; k < 3; k++) {
    dyd_rect_init(&r[k]);
    if (st == DYD_OK) st = dyd_sites_get(&r[k], pd->sk.rects.sites, t->v[k]);
  }
  if (st == DYD_OK) st = dyd_partial_centre_enclose(out, &r[0], &r[1], &r[2], bits);
  for (int k = 0; k < 3; k++) dyd_rect_clear(&r[k]);
  return st;
}

/* ---- windows ---- */

/* The margin on each side of an extent: a quarter of it; other, or 1, stands in for nothing. */
static double window_margin(double lo, double hi, double other) {
  double size = hi / 4 - lo / 4;
  return size > 0 ? size : other > 0 ? other : 1;
}

dyd_status dyd_voronoi_window(dyd_rect *out, const dyd_sites *sites) {
  double e[4] = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL}, b[4];
  size_t n = dyd_sites_count(sites);
  for (size_t i = 0; i < n; i++) {
    dyd_sites_get_d(b, sites, i);
    for (int k = 0; k < 4; k += 2) {
      e[k] = dyd_min(e[k], b[k]);
      e[k + 1] = dyd_max(e[k + 1], b[k + 1]);
    }
  }
  if (!n) e[0] = e[1] = e[2] = e[3] = 0;
  double mx = window_margin(e[0], e[1], e[3] / 4 - e[2] / 4), my = window_margin(e[2], e[3], mx);
  double w[4] = {e[0] - mx, e[1] + mx, e[2] - my, e[3] + my};
  for (int k = 0; k < 4; k++)
    if (!(fabs(w[k]) <= DBL_MAX)) return DYD_E_RANGE;
  if (!(w[0] < w[1] && w[2] < w[3])) return DYD_E_RANGE;
  return dyd_rect_set_d(out, w[0], w[1], w[2], w[3]);
}
