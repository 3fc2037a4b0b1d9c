/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact bisectors and cells, as asked by callers.
 *
 * [CELL-2] Under every choice the true cell of i is bounded by its Delaunay neighbours, which are possible neighbours.
 * So a point nearer to R_i than to all possible neighbours is in every true cell, hence in Int_i; and a point of Ext_i,
 * under the choice with p_i closest to it and all others farthest, is nearer to some Delaunay neighbour of i, hence in
 * C_ji for a possible neighbour j. Nobody else needs to be looked at. */
#include "base/alloc.h"
#include "predicate/predicate_filter.h"
#include "voronoi/exact_cell.h"
#include <dyadel/voronoi.h>

/* Rectangles of a site, its possible neighbours, and a window. */
typedef struct neighbourhood {
  uint32_t site;
  dyd_index_list others;
  dyd_rect *rect;
  const dyd_rect **in;
  size_t count;
} neighbourhood;

static void neighbourhood_clear(neighbourhood *n) {
  for (size_t k = n->count; k-- > 0;) dyd_rect_clear(&n->rect[k]);
  free(n->rect);
  free(n->in);
  dyd_index_list_clear(&n->others);
}

static dyd_status fetch(neighbourhood *n, const dyd_delaunay *pd) {
  size_t room = n->others.count + 1;
  n->rect = dyd_alloc(room, sizeof *n->rect);
  n->in = dyd_alloc(room + 1, sizeof *n->in);
  if (!n->rect || !n->in) return DYD_E_NOMEM;
  for (; n->count < room; n->count++) {
    dyd_rect_init(&n->rect[n->count]);
    n->in[n->count] = &n->rect[n->count];
  }
  dyd_status st = dyd_sites_get(&n->rect[0], dyd_delaunay_sites(pd), n->site);
  for (size_t k = 1; k < room && st == DYD_OK; k++)
    st = dyd_sites_get(&n->rect[k], dyd_delaunay_sites(pd), n->others.item[k - 1]);
  return st;
}

static dyd_status neighbourhood_set(neighbourhood *n, const dyd_delaunay *pd, uint32_t i) {
  *n = (neighbourhood){0};
  if (i >= dyd_sites_count(dyd_delaunay_sites(pd))) return DYD_E_ARG;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  n->site = dyd_delaunay_alias(pd, i);
  dyd_status st = dyd_delaunay_neighbours(&n->others, pd, n->site, DYD_TIE);
  return st == DYD_OK ? fetch(n, pd) : st;
}

static bool has_area(const dyd_rect *w) {
  return dyd_dyadic_cmp(&w->x.lo, &w->x.hi) < 0 && dyd_dyadic_cmp(&w->y.lo, &w->y.hi) < 0;
}

static dyd_status region(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, bool outer, const dyd_rect *window) {
  if (window && !has_area(window)) return DYD_E_ARG;
  neighbourhood n;
  dyd_status st = neighbourhood_set(&n, pd, i);
  if (st == DYD_OK) {
    if (window) n.in[n.count] = window;
    dyd_cell_task task = {n.site, n.others.item, n.others.count, n.in, outer, window != NULL, pd, false};
    st = dyd_cell_boundary(out, &task);
  }
  neighbourhood_clear(&n);
  return st;
}

dyd_status dyd_voronoi_int(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i) {
  return region(out, pd, i, false, NULL);
}

dyd_status dyd_voronoi_pos(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i) {
  return region(out, pd, i, true, NULL);
}

dyd_status dyd_voronoi_int_on(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, const dyd_rect *window) {
  return window ? region(out, pd, i, false, window) : DYD_E_ARG;
}

dyd_status dyd_voronoi_pos_on(dyd_boundary *out, const dyd_delaunay *pd, uint32_t i, const dyd_rect *window) {
  return window ? region(out, pd, i, true, window) : DYD_E_ARG;
}

dyd_status dyd_bisector(dyd_boundary *out, const dyd_rect *a, const dyd_rect *b) {
  const uint32_t other = 1;
  const dyd_rect *in[2] = {a, b};
  dyd_cell_task task = {0, &other, 1, in, false, false, NULL, false};
  return dyd_cell_boundary(out, &task);
}

/* ---- points ---- */

/* TRUE unless some neighbour says otherwise. */
static dyd_truth side_of(const neighbourhood *n, const dyd_point *c) {
  dyd_truth answer = DYD_TRUE;
  for (size_t k = 1; k < n->count && answer != DYD_FALSE; k++) {
    dyd_truth one = dyd_nearer(c, &n->rect[0], &n->rect[k]);
    if (one != DYD_TRUE) answer = one;
  }
  return answer;
}

dyd_truth dyd_voronoi_side(const dyd_delaunay *pd, uint32_t i, const dyd_point *c) {
  neighbourhood n;
  dyd_truth answer = DYD_UNKNOWN;
  if (neighbourhood_set(&n, pd, i) == DYD_OK) answer = side_of(&n, c);
  neighbourhood_clear(&n);
  return answer;
}
