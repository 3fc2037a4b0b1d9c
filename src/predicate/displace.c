/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The quad rule, and comparison of distances from a dyadic point.
 *
 * [QUAD-1] If ab replaced ij by a flip, the open segments would cross and the circle through i, j, b would hold a, the
 * one through i, j, a would hold b. Disjoint hulls exclude the first, Con = - one of the others. */
#include "predicate/predicate_filter.h"
#include "rect/irect.h"

static bool partial_edges_disjoint(const dyd_rect *const r[4]) {
  dyd_box box[4];
  for (int k = 0; k < 4; k++) dyd_filter_box(&box[k], r[k]);
  dyd_truth answer = dyd_filter_partial_edges_disjoint(&box[0], &box[1], &box[2], &box[3]);
  if (answer != DYD_UNKNOWN) return answer == DYD_TRUE;
  return dyd_partial_edges_disjoint(r[0], r[1], r[2], r[3]);
}

dyd_truth dyd_cannot_displace(const dyd_rect *i, const dyd_rect *j, const dyd_rect *a, const dyd_rect *b) {
  const dyd_rect *const r[4] = {i, j, a, b};
  bool cannot =
      partial_edges_disjoint(r) || dyd_con(a, i, j, b) == DYD_SURE_MINUS || dyd_con(b, i, j, a) == DYD_SURE_MINUS;
  return cannot ? DYD_TRUE : DYD_UNKNOWN;
}

static int compare_distance_exact(const dyd_point *c, const dyd_rect *const in[2], const dyd_touch touch[2]) {
  dyd_irect r[2];
  mpz_t cx, cy, distance[2];
  for (int k = 0; k < 2; k++) {
    dyd_irect_init(&r[k]);
    mpz_init(distance[k]);
  }
  mpz_inits(cx, cy, NULL);
  dyd_irects_scale_point(cx, cy, r, c, in, 2);
  for (int k = 0; k < 2; k++) {
    if (touch[k] == DYD_FARTHEST) {
      dyd_irect_dl2(distance[k], cx, cy, &r[k]);
    } else {
      dyd_irect_ds2(distance[k], cx, cy, &r[k]);
    }
  }
  int order = mpz_cmp(distance[0], distance[1]);
  mpz_clears(cx, cy, NULL);
  for (int k = 2; k-- > 0;) {
    mpz_clear(distance[k]);
    dyd_irect_clear(&r[k]);
  }
  return (order > 0) - (order < 0);
}

int dyd_compare_distance(const dyd_point *c, const dyd_rect *a, dyd_touch ta, const dyd_rect *b, dyd_touch tb) {
  const dyd_rect *const in[2] = {a, b};
  const dyd_touch touch[2] = {ta, tb};
  dyd_iv cx = {dyd_dyadic_get_d(&c->x, DYD_DOWN), dyd_dyadic_get_d(&c->x, DYD_UP)};
  dyd_iv cy = {dyd_dyadic_get_d(&c->y, DYD_DOWN), dyd_dyadic_get_d(&c->y, DYD_UP)};
  dyd_iv distance[2];
  for (int k = 0; k < 2; k++) {
    dyd_box box;
    dyd_filter_box(&box, in[k]);
    distance[k] = dyd_filter_distance2(cx, cy, &box, touch[k]);
  }
  if (distance[0].hi < distance[1].lo) return -1;
  if (distance[0].lo > distance[1].hi) return 1;
  return compare_distance_exact(c, in, touch);
}

dyd_truth dyd_nearer(const dyd_point *c, const dyd_rect *a, const dyd_rect *b) {
  if (dyd_compare_distance(c, a, DYD_FARTHEST, b, DYD_CLOSEST) < 0) return DYD_TRUE;
  if (dyd_compare_distance(c, b, DYD_FARTHEST, a, DYD_CLOSEST) < 0) return DYD_FALSE;
  return DYD_UNKNOWN;
}
