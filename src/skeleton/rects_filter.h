/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which vertices can block a centre: distance bounds in doubles. */
#ifndef DYD_SKELETON_RECTS_FILTER_H
#define DYD_SKELETON_RECTS_FILTER_H

#include "skeleton/rects.h"

/* By how much an end of v's outward box can lie outside its rectangle: 0 when doubles hold it, else one unit in the
 * last place of the largest end, at most 2^-52 of it (or 2^-1074). */
static inline double dyd_box_slack(const dyd_rects *r, uint32_t v) {
  if (dyd_rects_in_doubles(r, v)) return 0;
  const double *e = r->box[v].e;
  double m = dyd_max(dyd_max(fabs(e[0]), fabs(e[1])), dyd_max(fabs(e[2]), fabs(e[3])));
  return m * 0x1p-52 + 0x1p-1074;
}
/* An enclosure of c in doubles. */
dyd_bbox dyd_point_box(const dyd_point *c);
/* Upper bound of max(dl_i, dl_j)^2 over the centres in c. */
double dyd_pair_dl2_upper(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j);
/* Upper bound of max(ds_i, ds_j)^2 over the centres in c. */
double dyd_pair_ds2_upper(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j);
/* Returns true if dl_k^2 >= bound for all centres in c, certainly. */
bool dyd_surely_not_nearer(const dyd_rects *r, const dyd_bbox *c, uint32_t k, double bound);
/* A vertex certainly nearer than i and j to all centres in c, dl_k < ds_i, ds_j: the one of least dl_k by its upper
 * bound. DYD_NONE: not known. */
uint32_t dyd_surely_nearest(const dyd_rects *r, const dyd_bbox *c, uint32_t i, uint32_t j);
/* Returns true if the boxes of i and j certainly do not meet. */
static inline bool dyd_boxes_disjoint(const dyd_bbox *a, const dyd_bbox *b) {
  return a->e[1] < b->e[0] || b->e[1] < a->e[0] || a->e[3] < b->e[2] || b->e[3] < a->e[2];
}
/* Returns true if the rectangles of i and j certainly meet. An end of a box is outside by the slack at most; twice that
 * covers the rounding here. A box with an infinite end gives no answer. */
static inline bool dyd_surely_meet(const dyd_rects *r, uint32_t i, uint32_t j) {
  const dyd_bbox *a = &r->box[i], *b = &r->box[j];
  double slack = 2 * (dyd_box_slack(r, i) + dyd_box_slack(r, j));
  return slack <= DBL_MAX && a->e[0] + slack <= b->e[1] && b->e[0] + slack <= a->e[1] && a->e[2] + slack <= b->e[3] &&
         b->e[2] + slack <= a->e[3];
}
/* The direction (x,y) != 0 in doubles, scaled to at most 1; each component off by at most 2^-52 of itself or 2^-900. */
void dyd_direction_d(double u[2], const mpz_t x, const mpz_t y);
/* A lower bound of max u.x over the rectangle in the box p, for u as dyd_direction_d gives it, minus what
 * dyd_tree_beyond may lose by the error of u: a height for it. */
double dyd_height_lower(const dyd_rects *r, double ux, double uy, const dyd_bbox *p);

#endif
