/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Bounds of ds^2 and dl^2 in doubles [FLT-DST].
 *
 * A centre is known by an enclosing box C of doubles (a point when it is a double), a site by its outward box b. Each
 * difference, product and the sum carry a relative error u = 2^-53, (1+u)^4 in all, (1+u)^6 where slack is added;
 * 1 +- 10u covers that and the rounding of the bound itself; underflow of a square is at most 2^-1075 and covered by
 * 2^-1000. An overflowing lower bound is cut to DBL_MAX/4, an overflowing upper bound is infinite, and NaN compares
 * false: never certain. */
#ifndef DYD_SKELETON_DISTANCE_FILTER_H
#define DYD_SKELETON_DISTANCE_FILTER_H

#include <float.h>
#include <math.h>

/* xlo, xhi, ylo, yhi. */
typedef struct dyd_bbox {
  double e[4];
} dyd_bbox;

#define DYD_DOWN_FACTOR (1 - 10 * 0x1p-53)
#define DYD_UP_FACTOR (1 + 10 * 0x1p-53)
#define DYD_TINY 0x1p-1000

static inline double dyd_max(double a, double b) {
  return a > b ? a : b;
}
static inline double dyd_min(double a, double b) {
  return a < b ? a : b;
}
static inline double dyd_lower(double x) {
  double y = x * DYD_DOWN_FACTOR - DYD_TINY;
  return y > DBL_MAX / 4 ? DBL_MAX / 4 : y;
}
static inline double dyd_upper(double x) {
  return x * DYD_UP_FACTOR + DYD_TINY;
}

/* *h becomes the box around both. */
static inline void dyd_box_widen(dyd_bbox *h, const dyd_bbox *b) {
  h->e[0] = dyd_min(h->e[0], b->e[0]);
  h->e[1] = dyd_max(h->e[1], b->e[1]);
  h->e[2] = dyd_min(h->e[2], b->e[2]);
  h->e[3] = dyd_max(h->e[3], b->e[3]);
}

/* Lower bound of ds^2 over the centres in C; negative only by the margin of underflow. */
static inline double dyd_ds2_lower(const dyd_bbox *c, const dyd_bbox *b) {
  double dx = dyd_max(dyd_max(b->e[0] - c->e[1], c->e[0] - b->e[1]), 0);
  double dy = dyd_max(dyd_max(b->e[2] - c->e[3], c->e[2] - b->e[3]), 0);
  return dyd_lower(dx * dx + dy * dy);
}

/* Upper bound of dl^2. */
static inline double dyd_dl2_upper(const dyd_bbox *c, const dyd_bbox *b) {
  double dx = dyd_max(b->e[1] - c->e[0], c->e[1] - b->e[0]);
  double dy = dyd_max(b->e[3] - c->e[2], c->e[3] - b->e[2]);
  return dyd_upper(dx * dx + dy * dy);
}

/* Upper bound of ds^2 for the rectangle: the outward box is at most as far as the rectangle, so this needs the inner
 * side: `slack` bounds by how much an end of the box may lie outside the rectangle. */
static inline double dyd_ds2_upper(const dyd_bbox *c, const dyd_bbox *b, double slack) {
  double dx = dyd_max(b->e[0] - c->e[0], c->e[1] - b->e[1]) + slack;
  double dy = dyd_max(b->e[2] - c->e[2], c->e[3] - b->e[3]) + slack;
  if (!(dx <= DBL_MAX && dy <= DBL_MAX)) return HUGE_VAL; /* infinite ends, or NaN of them */
  dx = dyd_max(dx, 0);
  dy = dyd_max(dy, 0);
  return dyd_upper(dx * dx + dy * dy);
}

/* Lower bound of dl^2 for the rectangle; slack as above. */
static inline double dyd_dl2_lower(const dyd_bbox *c, const dyd_bbox *b, double slack) {
  double dx = dyd_max(dyd_max(b->e[1] - c->e[1], c->e[0] - b->e[0]) - slack, 0);
  double dy = dyd_max(dyd_max(b->e[3] - c->e[3], c->e[2] - b->e[2]) - slack, 0);
  return dyd_lower(dx * dx + dy * dy);
}

#endif
