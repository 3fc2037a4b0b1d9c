/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Graphs of neighbours: the public call. */
#include "graph/graph.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/float_filter.h"
#include "delaunay/state.h"

/* Pairs are sorted, so each list comes out ascending. */
static void deal_partners(dyd_graph_work *w) {
  const dyd_pair_list *l = &w->pairs;
  for (size_t k = 0; k < l->count; k++) {
    w->start[l->item[k].i + 2]++;
    w->start[l->item[k].j + 2]++;
  }
  for (size_t i = 2; i <= w->n + 1; i++) w->start[i] += w->start[i - 1];
  for (size_t k = 0; k < l->count; k++) {
    w->partner[w->start[l->item[k].i + 1]++] = l->item[k].j;
    w->partner[w->start[l->item[k].j + 1]++] = l->item[k].i;
  }
}

/* The partners and boxes, and a list of edges that grows. */
static bool graph_has_room(dyd_graph_work *w) {
  uint64_t pairs = dyd_pairs_bytes(w->pd, w->least) / sizeof(dyd_pair);
  uint64_t each = sizeof(dyd_pair) + 2 * sizeof *w->partner + 2 * sizeof *w->out.item;
  uint64_t bytes = dyd_bytes_times(pairs, each) + dyd_bytes_times(w->n, sizeof *w->start + sizeof *w->box);
  if (!dyd_room_has(&w->room, bytes, "the graph")) return false;
  w->room.held += bytes;
  return true;
}

/* What is looked at exactly: rectangles of so many partners. */
static bool partners_have_room(dyd_graph_work *w, size_t most) {
  enum { NUMBERS = 10, BLOCK = 40 };
  uint64_t each = sizeof *w->other + sizeof *w->reach.rect + sizeof *w->reach.grid + NUMBERS * BLOCK;
  return dyd_room_has(&w->room, dyd_bytes_times(most, each), "the partners of a point");
}

static dyd_status graph_prepare(dyd_graph_work *w) {
  if (!graph_has_room(w)) return DYD_E_NOMEM;
  dyd_status st = dyd_pairs_take(&w->pairs, w->pd, w->least);
  if (st != DYD_OK) return st;
  size_t most = 0;
  w->start = calloc(w->n + 2, sizeof *w->start);
  w->partner = dyd_alloc(2 * w->pairs.count, sizeof *w->partner);
  w->box = dyd_alloc(w->n, sizeof *w->box);
  if (!w->start || !w->partner || !w->box) return DYD_E_NOMEM;
  deal_partners(w);
  for (size_t i = 0; i < w->n; i++) {
    dyd_sites_get_d(w->box[i].e, w->sites, i);
    if (w->start[i + 1] - w->start[i] > most) most = w->start[i + 1] - w->start[i];
  }
  if (!partners_have_room(w, most)) return DYD_E_NOMEM;
  w->other = dyd_alloc(most, sizeof *w->other);
  return w->other ? DYD_OK : DYD_E_NOMEM;
}

static void graph_work_clear(dyd_graph_work *w) {
  dyd_reach_clear(&w->reach);
  dyd_pair_list_clear(&w->pairs);
  free(w->start);
  free(w->partner);
  free(w->box);
  free(w->other);
}

dyd_status dyd_graph_edges(dyd_graph_list *out, const dyd_delaunay *pd, dyd_graph graph, const volatile int *cancel,
                           dyd_error *err) {
  if (!pd) return dyd_fail_null(err);
  static dyd_status (*const make[])(dyd_graph_work *) = {dyd_nearest_graph, dyd_gabriel_graph, dyd_spanning_graph};
  if (err) dyd_error_clear(err);
  if (dyd_float_check(err) != DYD_OK) return DYD_E_ARG;
  if ((size_t)graph >= sizeof make / sizeof *make)
    return dyd_fail(err, DYD_E_ARG, "there is no graph number %d", (int)graph);
  if (dyd_delaunay_is_capped(pd))
    return dyd_fail(err, DYD_CAPPED, "there are more pairs than can be stored; raise `max_pairs`");
  dyd_graph_work w = {.pd = pd, .sites = dyd_delaunay_sites(pd), .cancel = cancel, .room = dyd_delaunay_room(pd)};
  w.n = dyd_sites_count(w.sites);
  /* A tied pair of exact points is longer than those between on the rim [GRP-1]; it may be a diameter of its circle. */
  w.least = graph == DYD_GRAPH_GABRIEL && !dyd_is_line(pd) ? DYD_TIE : dyd_least_bounding(pd);
  dyd_reach_init(&w.reach);
  dyd_status st = graph_prepare(&w);
  if (st == DYD_OK) st = make[graph](&w);
  graph_work_clear(&w);
  if (st != DYD_OK) {
    dyd_graph_list_clear(&w.out);
    if (st == DYD_E_NOMEM && w.room.refused) return dyd_fail_room(err, &w.room);
    return dyd_fail(err, st, "%s", dyd_status_text(st));
  }
  dyd_graph_list_clear(out);
  *out = w.out;
  return DYD_OK;
}
