/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Regions of undecided faces: who can have a Voronoi vertex there, and who can keep it away. */
#include "voronoi/region.h"

#include "base/alloc.h"
#include "delaunay/index_list.h"
#include <dyadel/voronoi.h>

/* The ends of the pairs and all their possible neighbours: nobody else bounds their cells [CELL-2]. */
static dyd_status region_sites(dyd_index_list *out, const dyd_delaunay *pd, const dyd_pair_list *pairs) {
  dyd_index_list near = {0};
  size_t cap = 0;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < pairs->count && st == DYD_OK; k++) {
    const uint32_t end[2] = {pairs->item[k].i, pairs->item[k].j};
    st = dyd_index_list_add(out, &cap, end, 2);
  }
  dyd_index_list_sort(out);
  for (size_t k = 0, ends = out->count; k < ends && st == DYD_OK; k++) {
    st = dyd_delaunay_neighbours(&near, pd, out->item[k], DYD_TIE);
    if (st == DYD_OK) st = dyd_index_list_add(out, &cap, near.item, near.count);
  }
  dyd_index_list_sort(out);
  dyd_index_list_clear(&near);
  return st;
}

static bool box_is_finite(const dyd_bbox *b) {
  return b->e[0] >= -DBL_MAX && b->e[1] <= DBL_MAX && b->e[2] >= -DBL_MAX && b->e[3] <= DBL_MAX;
}

static dyd_status region_find(dyd_rect *out, bool *any, const dyd_delaunay *pd, const dyd_pair_list *pairs,
                              const dyd_rect *window) {
  dyd_index_list sites = {0};
  dyd_bbox box;
  dyd_status st = region_sites(&sites, pd, pairs);
  dyd_interval_get_d(&box.e[0], &box.e[1], &window->x);
  dyd_interval_get_d(&box.e[2], &box.e[3], &window->y);
  if (st == DYD_OK && !box_is_finite(&box)) {
    *any = true;
    dyd_rect_set(out, window);
  } else if (st == DYD_OK) {
    st = dyd_filter_region(&box, any, pd, pairs, &sites);
    if (st == DYD_OK && *any) st = dyd_rect_set_d(out, box.e[0], box.e[1], box.e[2], box.e[3]);
  }
  dyd_index_list_clear(&sites);
  return st;
}

dyd_status dyd_voronoi_region(dyd_rect *out, bool *any, const dyd_delaunay *pd, size_t f, const dyd_rect *window) {
  if (!pd) return DYD_E_ARG;
  dyd_pair_list pairs = {0};
  if (f >= dyd_delaunay_undecided_faces(pd)) return DYD_E_ARG;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  dyd_status st = dyd_delaunay_face_pairs(&pairs, pd, f);
  if (st == DYD_OK) st = region_find(out, any, pd, &pairs, window);
  dyd_pair_list_clear(&pairs);
  return st;
}
