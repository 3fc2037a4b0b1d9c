/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Streams made of streams, as programs make them. */
#ifndef TEST_SUPPORT_COMPOSE_H
#define TEST_SUPPORT_COMPOSE_H

#include <dyadel/dyadel.h>

/* (a + b) / 2; takes over both, also on failure. */
static inline dyd_status test_midpoint(dyd_stream **out, dyd_stream *a, dyd_stream *b) {
  dyd_stream *const of[2] = {a, b};
  mpq_t half[2];
  for (int k = 0; k < 2; k++) {
    mpq_init(half[k]);
    mpq_set_ui(half[k], 1, 2);
  }
  dyd_status st = dyd_stream_combination(out, 2, of, (const mpq_t *)half, NULL);
  mpq_clears(half[0], half[1], NULL);
  return st;
}

/* The centre of the circle through the corners of t, points of e. */
static inline dyd_status test_vertex(dyd_stream **out, dyd_engine *e, const dyd_triangle *t) {
  dyd_stream *corner[3] = {NULL, NULL, NULL};
  dyd_status st = DYD_OK;
  for (int k = 0; k < 3 && st == DYD_OK; k++) st = dyd_engine_stream(&corner[k], e, t->v[k]);
  if (st == DYD_OK) return dyd_stream_voronoi_vertex(out, corner[0], corner[1], corner[2]);
  for (int k = 0; k < 3; k++) dyd_stream_free(corner[k]);
  return st;
}

#endif
