/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The Gabriel graph [GAB-1]. */
#include "graph/graph.h"

#include "base/flag.h"

static size_t degree_of(const dyd_graph_work *w, uint32_t i) {
  return w->start[i + 1] - w->start[i];
}

static size_t partner_number(const dyd_graph_work *w, uint32_t i, uint32_t j) {
  size_t k = 0;
  while (w->partner[w->start[i] + k] != j) k++;
  return k;
}

dyd_status dyd_gabriel_status(dyd_graph_status *out, dyd_graph_work *w, uint32_t i, uint32_t j) {
  if (degree_of(w, j) < degree_of(w, i)) {
    uint32_t other = i;
    i = j, j = other;
  }
  dyd_graph_verdict v = dyd_filter_gabriel(w, i, j);
  *out = v.status;
  if (v.known) return DYD_OK;
  dyd_status st = dyd_reach_load(&w->reach, w->sites, i, &w->partner[w->start[i]], degree_of(w, i));
  if (st != DYD_OK) return st;
  size_t number = partner_number(w, i, j) + 1;
  if (dyd_reach_is_gabriel(&w->reach, number))
    *out = DYD_GRAPH_SURE;
  else
    *out = dyd_reach_may_be_gabriel(&w->reach, number) ? DYD_GRAPH_POSSIBLE : DYD_GRAPH_NEVER;
  return DYD_OK;
}

dyd_status dyd_gabriel_graph(dyd_graph_work *w) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < w->pairs.count && st == DYD_OK; k++) {
    const dyd_pair *p = &w->pairs.item[k];
    dyd_graph_status status;
    if (dyd_flag_is_set(w->cancel)) return DYD_CANCELLED;
    st = dyd_gabriel_status(&status, w, p->i, p->j);
    if (st == DYD_OK && status != DYD_GRAPH_NEVER) st = dyd_graph_add(w, p->i, p->j, status == DYD_GRAPH_SURE);
  }
  return st;
}
