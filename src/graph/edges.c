/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lists of edges. */
#include "graph/graph.h"

#include "base/alloc.h"

void dyd_graph_list_clear(dyd_graph_list *l) {
  free(l->item);
  *l = (dyd_graph_list){0};
}

dyd_status dyd_graph_add(dyd_graph_work *w, uint32_t i, uint32_t j, bool sure) {
  if (!dyd_reserve((void **)&w->out.item, &w->cap, w->out.count + 1, sizeof *w->out.item)) return DYD_E_NOMEM;
  w->out.item[w->out.count++] = (dyd_graph_edge){i, j, sure};
  return DYD_OK;
}
