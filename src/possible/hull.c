/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* v is possible on the hull iff the arcs in which others are farther out leave a direction free: walk from arc to arc
 * until the start is passed. */
#include "possible/hull.h"

#include "skeleton/arcs.h"

/* Is `mark` in the half-open arc (u, to]? It is below a half turn, since u is strictly inside the arc found. */
static bool hull_passes(dyd_arcs *t, const dyd_vec *mark) {
  return dyd_arcs_cross(t, &t->u, mark) > 0 && dyd_arcs_cross(t, mark, &t->to) >= 0;
}

dyd_status dyd_hull_possible(bool *possible, dyd_work *w, const dyd_skeleton *sk, uint32_t v) {
  dyd_arcs t;
  dyd_vec start;
  dyd_arcs_init(&t, w, sk, v, v, true);
  dyd_vec_init(&start);
  dyd_scale_set_empty(&w->set);
  mpz_set_si(start.x, 1);
  dyd_vec_set(&t.u, &start);
  for (dyd_arcs_ask(&t); t.status == DYD_OK && t.found != DYD_NONE; dyd_arcs_ask(&t)) {
    if (hull_passes(&t, &start)) break;
    dyd_vec_set(&t.u, &t.to);
  }
  *possible = t.found == DYD_NONE;
  dyd_vec_clear(&start);
  dyd_arcs_clear(&t);
  return t.status;
}
