/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The nearest-neighbour graph [NNG-1]. */
#include "graph/graph.h"

#include "base/flag.h"
#include "rect/sites_table.h"

/* Only for exact points i, which have one distance to each: the least of the largest distances of all but one decides
 * about that one, so a hub takes time by its degree. */
static dyd_status nearest_of_point(dyd_graph_work *w, uint32_t i) {
  dyd_reach *r = &w->reach;
  mpz_t least[2], own; /* the two least of dl^2 */
  size_t who = 0;
  mpz_inits(least[0], least[1], own, NULL);
  dyd_status st = DYD_OK;
  for (size_t k = 1; k < r->count; k++) {
    dyd_irect_dl2(own, r->grid[0].x0, r->grid[0].y0, &r->grid[k]);
    bool first = !who || mpz_cmp(own, least[0]) < 0;
    if (first) mpz_swap(least[0], least[1]);
    if (first || k == 2 || mpz_cmp(own, least[1]) < 0) mpz_set(least[first ? 0 : 1], own);
    if (first) who = k;
  }
  for (size_t k = 1; k < r->count && st == DYD_OK; k++) {
    dyd_irect_ds2(own, r->grid[0].x0, r->grid[0].y0, &r->grid[k]);
    if (r->count > 2 && mpz_cmp(own, least[who == k]) > 0) continue;
    bool sure = who == k && dyd_reach_is_nearest(r, k);
    st = dyd_graph_add(w, i, w->other[k - 1], sure);
  }
  mpz_clears(least[0], least[1], own, NULL);
  return st;
}

/* Of w->other[number] as the nearest one to i. *loaded: w->reach holds i and all others. */
static dyd_status status_as_nearest(dyd_graph_status *out, dyd_graph_work *w, bool *loaded, uint32_t i, size_t number) {
  dyd_graph_verdict v = dyd_filter_nearest(w, i, w->other[number]);
  *out = v.status;
  if (v.known) return DYD_OK;
  if (!*loaded) {
    dyd_status st = dyd_reach_load(&w->reach, w->sites, i, w->other, w->others);
    if (st != DYD_OK) return st;
    *loaded = true;
  }
  if (dyd_reach_is_nearest(&w->reach, number + 1))
    *out = DYD_GRAPH_SURE;
  else
    *out = dyd_reach_may_be_nearest(&w->reach, number + 1) ? DYD_GRAPH_POSSIBLE : DYD_GRAPH_NEVER;
  return DYD_OK;
}

/* So many candidates of an exact point are compared by their distances at once. */
enum { NEAREST_MANY = 8 };

static dyd_status nearest_of(dyd_graph_work *w, uint32_t i) {
  bool loaded = false;
  dyd_status st = DYD_OK;
  dyd_filter_nearest_few(w, i);
  if (w->others > NEAREST_MANY && dyd_sites_is_point(w->sites, i)) {
    st = dyd_reach_load(&w->reach, w->sites, i, w->other, w->others);
    return st == DYD_OK ? nearest_of_point(w, i) : st;
  }
  for (size_t k = 0; k < w->others && st == DYD_OK; k++) {
    dyd_graph_status status;
    st = status_as_nearest(&status, w, &loaded, i, k);
    if (st == DYD_OK && status != DYD_GRAPH_NEVER) st = dyd_graph_add(w, i, w->other[k], status == DYD_GRAPH_SURE);
  }
  return st;
}

dyd_status dyd_nearest_graph(dyd_graph_work *w) {
  dyd_status st = DYD_OK;
  for (uint32_t i = 0; i < w->n && st == DYD_OK; i++)
    st = dyd_flag_is_set(w->cancel) ? DYD_CANCELLED : nearest_of(w, i);
  return st;
}
