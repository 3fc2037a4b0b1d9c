/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Adding counters. */
#include "delaunay/view.h"

void dyd_counters_add(dyd_delaunay_counters *sum, const dyd_delaunay_counters *c) {
  sum->filter += c->filter;
  sum->integer += c->integer;
  sum->exact += c->exact;
  sum->witness_guess += c->witness_guess;
  sum->witness_search += c->witness_search;
  sum->cover_walks += c->cover_walks;
  sum->faces += c->faces;
}

void dyd_view_close(dyd_delaunay_counters *sum, dyd_delaunay *view) {
  dyd_mesh_count(&view->mesh);
  dyd_counters_add(sum, &view->counters);
}
