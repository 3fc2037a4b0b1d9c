/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The squares of a few sites at one t, and their skeleton. */
#include "tolerance/squares.h"

#include <math.h>

dyd_status dyd_square_of(dyd_rect *out, dyd_squares *q, uint32_t v) {
  const dyd_sites *nominal = q->t->sk->reps.sites;
  dyd_status st = dyd_sites_get(out, nominal, q->t->sk->reps.site[v]);
  for (int axis = 0; axis < 2 && st == DYD_OK; axis++) {
    dyd_interval *side = axis ? &out->y : &out->x;
    dyd_interval_get_q(q->end[0], q->end[1], side);
    mpq_sub(q->end[0], q->end[0], q->half);
    mpq_add(q->end[1], q->end[1], q->half);
    st = dyd_interval_set_outward(side, q->end[0], q->end[1], q->exp);
  }
  return st;
}

void dyd_squares_unbuild(dyd_squares *q) {
  if (!q->sites) return;
  dyd_work_clear(&q->work);
  dyd_skeleton_clear(&q->sk);
  dyd_sites_free(q->sites);
  q->sites = NULL;
}

dyd_status dyd_squares_build(dyd_squares *q, double t) {
  const dyd_skeleton_options o = {.no_filter = q->t->options.no_filter, .threads = 1};
  dyd_sites *sites = NULL;
  dyd_rect r;
  q->now = t;
  q->exp = ilogb(t) - DYD_SQUARE_BITS;
  mpq_set_d(q->half, t);
  dyd_rect_init(&r);
  dyd_status st = dyd_sites_new(&sites);
  for (size_t k = 0; k < q->seen.count + 2 && st == DYD_OK; k++) {
    st = dyd_square_of(&r, q, k == 0 ? q->i : k == 1 ? q->j : q->seen.vertex[k - 2]);
    if (st == DYD_OK) st = dyd_sites_add_rect(sites, &r);
  }
  dyd_rect_clear(&r);
  if (st == DYD_OK) st = dyd_skeleton_build(&q->sk, sites, &o);
  if (st != DYD_OK) {
    dyd_sites_free(sites);
    return st;
  }
  q->sites = sites;
  dyd_work_init(&q->work, &q->sk, NULL);
  return DYD_OK;
}
