/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Voronoi vertices of sure triangles, and default windows. */
#include "delaunay/undecided.h"
#include "voronoi/vertex_filter.h"
#include <dyadel/predicate.h>
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
  if (!pd) return DYD_E_ARG;
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

/* ---- vertices of tied faces ---- */

/* corner[0..2]: sites far apart: the first, who is farthest from it, who is farthest from the line of both. */
static void spread_corners(uint32_t corner[3], const dyd_sites *sites, const dyd_index_list *list) {
  double at[3][2], e[4], best[3] = {0, -1, -1};
  for (int k = 0; k < 3; k++) {
    corner[k] = list->item[0];
    for (size_t q = 0; q < list->count; q++) {
      dyd_sites_get_d(e, sites, list->item[q]);
      double x = e[0] / 2 + e[1] / 2 - (k ? at[0][0] : 0), y = e[2] / 2 + e[3] / 2 - (k ? at[0][1] : 0);
      double size = k == 0 ? -(double)q : k == 1 ? x * x + y * y : fabs(at[1][0] * y - at[1][1] * x);
      if (k == 0 ? q > 0 : size <= best[k]) continue;
      best[k] = size;
      corner[k] = list->item[q];
      at[k][0] = x;
      at[k][1] = y;
    }
  }
}

/* The rectangle of the centre of three sites, which have to be surely oriented. */
static dyd_status enclose_centre(dyd_rect *out, const dyd_sites *sites, const uint32_t corner[3], int64_t bits) {
  dyd_rect r[3];
  dyd_status st = DYD_OK;
  for (int k = 0; k < 3; k++) {
    dyd_rect_init(&r[k]);
    if (st == DYD_OK) st = dyd_sites_get(&r[k], sites, corner[k]);
  }
  dyd_sure turn = st == DYD_OK ? dyd_orientation(&r[0], &r[1], &r[2]) : DYD_UNSURE;
  if (turn == DYD_SURE_MINUS) dyd_rect_swap(&r[1], &r[2]);
  if (st == DYD_OK && turn == DYD_UNSURE) st = DYD_E_RANGE;
  if (st == DYD_OK) st = dyd_partial_centre_enclose(out, &r[0], &r[1], &r[2], bits);
  for (int k = 0; k < 3; k++) dyd_rect_clear(&r[k]);
  return st;
}

dyd_status dyd_voronoi_tied_vertex(dyd_rect *out, bool *tied, const dyd_delaunay *pd, size_t f, int64_t bits) {
  if (!pd) return DYD_E_ARG;
  dyd_index_list sites = {0};
  uint32_t corner[3];
  bool outer;
  if (f >= dyd_delaunay_undecided_faces(pd)) return DYD_E_ARG;
  *tied = !dyd_open_is_outer(pd, f) && dyd_open_status_of(pd, f) == DYD_TIE;
  if (!*tied) return DYD_OK;
  dyd_status st = dyd_delaunay_face(&sites, &outer, pd, f);
  if (st == DYD_OK) {
    spread_corners(corner, pd->sk.rects.sites, &sites);
    st = enclose_centre(out, pd->sk.rects.sites, corner, bits);
  }
  dyd_index_list_clear(&sites);
  return st;
}

/* ---- windows ---- */

/* The margin on each side of an extent: a quarter of it; other, or 1, stands in for nothing. */
static double window_margin(double lo, double hi, double other) {
  double size = hi / 4 - lo / 4;
  return size > 0 ? size : other > 0 ? other : 1;
}

dyd_status dyd_voronoi_window(dyd_rect *out, const dyd_sites *sites) {
  if (!sites) return DYD_E_ARG;
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
