/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact bisectors and cells, as asked by callers.
 *
 * [CELL-2] Under every choice the true cell of i is bounded by its Delaunay neighbours, which are possible neighbours.
 * So a point nearer to R_i than to all possible neighbours is in every true cell, hence in Int_i; and a point of Ext_i,
 * under the choice with p_i closest to it and all others farthest, is nearer to some Delaunay neighbour of i, hence in
 * C_ji for a possible neighbour j. No other site matters. */
#include "base/alloc.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "predicate/circle.h"
#include "voronoi/exact_cell.h"
#include "voronoi/sample.h"

#include <dyadel/voronoi.h>

/* *site = the site that i is an alias of, or i. */
static dyd_status find_cell_site(uint32_t *site, const dyd_delaunay *pd, uint32_t i) {
  if (i >= dyd_sites_count(dyd_delaunay_sites(pd))) return DYD_E_ARG;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  *site = dyd_delaunay_alias(pd, i);
  return DYD_OK;
}

static bool window_has_area(const dyd_rect *w) {
  return dyd_dyadic_cmp(&w->x.lo, &w->x.hi) < 0 && dyd_dyadic_cmp(&w->y.lo, &w->y.hi) < 0;
}

/* The region of `site` among the sites s of its cell; window: NULL for the whole plane. */
static dyd_status cell_region_among(dyd_boundary *out, const dyd_delaunay *pd, const dyd_cell_sites *s, uint32_t site,
                                    bool outer, const dyd_rect *window, dyd_room *room, const volatile int *cancel) {
  DYD_FREED const dyd_rect **in = dyd_alloc(s->count + 2, sizeof *in);
  if (!in) return DYD_E_NOMEM;
  in[0] = &s->own;
  for (size_t k = 0; k < s->count; k++) in[k + 1] = &s->other[k];
  in[s->count + 1] = window;
  dyd_cell_task task = {site, s->site, s->count, in, outer, window != NULL, pd, false, cancel, room};
  return dyd_cell_boundary(out, &task);
}

dyd_status dyd_cell_region(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, bool outer, bool proved,
                           const dyd_rect *window, dyd_room *room, const volatile int *cancel) {
  uint32_t site;
  if (window && !window_has_area(window)) return DYD_E_ARG;
  if (dyd_flag_is_set(cancel)) return DYD_CANCELLED;
  dyd_status st = find_cell_site(&site, pd, i);
  if (st != DYD_OK) return st;
  DYD_SCOPED(dyd_cell_sites) s;
  dyd_pair_status least = dyd_least_at(pd, site, proved);
  st = dyd_cell_sites_init(&s, pd, site, least);
  const dyd_delaunay *complete =
      least == dyd_least_bounding(pd) ? pd : NULL; /* of some sites only: all may share one */
  return st == DYD_OK ? cell_region_among(out, complete, &s, site, outer, window, room, cancel) : st;
}

dyd_status dyd_voronoi_cell(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, dyd_cell_bound bound,
                            const dyd_rect *window) {
  if (!pd) return DYD_E_ARG;
  dyd_room room = dyd_delaunay_room(pd);
  return dyd_cell_region(out, pd, i, bound == DYD_CELL_POSSIBLE, false, window, &room, NULL);
}

dyd_status dyd_bisector(dyd_boundary *out, const dyd_rect *a, const dyd_rect *b) {
  const uint32_t other = 1;
  const dyd_rect *in[2] = {a, b};
  dyd_cell_task task = {0, &other, 1, in, false, false, NULL, false, NULL, NULL};
  return dyd_cell_boundary(out, &task);
}

/* ---- points ---- */

/* TRUE unless some neighbour says otherwise. */
static dyd_truth side_of_cell(const dyd_cell_sites *s, const dyd_point *c) {
  dyd_truth answer = DYD_TRUE;
  for (size_t k = 0; k < s->count && answer != DYD_FALSE; k++) {
    dyd_truth one = dyd_nearer(c, &s->own, &s->other[k]);
    if (one != DYD_TRUE) answer = one;
  }
  return answer;
}

dyd_status dyd_cell_point_side(dyd_truth *out, const dyd_delaunay *pd, uint32_t i, const dyd_point *c) {
  uint32_t site;
  dyd_status st = find_cell_site(&site, pd, i);
  if (st != DYD_OK) return st;
  DYD_SCOPED(dyd_cell_sites) s;
  st = dyd_cell_sites_init(&s, pd, site, dyd_least_bounding(pd));
  if (st == DYD_OK) *out = side_of_cell(&s, c);
  return st;
}

dyd_truth dyd_voronoi_side(const dyd_delaunay *pd, uint32_t i, const dyd_point *c) {
  if (!pd) return DYD_UNKNOWN;
  dyd_truth answer = DYD_UNKNOWN;
  return dyd_cell_point_side(&answer, pd, i, c) == DYD_OK ? answer : DYD_UNKNOWN;
}
