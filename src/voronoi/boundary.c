/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Boundaries: chains of arcs and their memory. */
#include "voronoi/boundary.h"

#include "base/alloc.h"

static void arc_init(dyd_arc *a) {
  *a = (dyd_arc){.kind = DYD_ARC_LINE};
  dyd_surd_point_init(&a->begin.at);
  dyd_surd_point_init(&a->end.at);
}

static void arc_clear(dyd_arc *a) {
  dyd_surd_point_clear(&a->end.at);
  dyd_surd_point_clear(&a->begin.at);
}

dyd_chain *dyd_boundary_add_chain(dyd_boundary *b, size_t arcs) {
  dyd_arc *arc = dyd_alloc(arcs, sizeof *arc);
  if (!arc) return NULL;
  for (size_t k = 0; k < arcs; k++) arc_init(&arc[k]);
  dyd_chain *chain = &b->chain[b->count++];
  *chain = (dyd_chain){.count = arcs, .arc = arc};
  return chain;
}

void dyd_boundary_clear(dyd_boundary *b) {
  for (size_t c = b->count; c-- > 0;) {
    dyd_chain *chain = &b->chain[c];
    for (size_t k = chain->count; k-- > 0;) arc_clear(&chain->arc[k]);
    free(chain->arc);
  }
  free(b->chain);
  *b = (dyd_boundary){0};
}
