/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Double-doubles with bounds of their errors.
 *
 * Let u = 2^-53. Sums and products of double-doubles have relative errors below 8 u^2 of the sum of the sizes of what
 * is added, or of the product (Joldes, Muller, Popescu 2017), differences of given coordinates below 4 u^2, beyond
 * slack. Products that underflow are off by less than DYD_DD_TINY. One step of Newton makes a root of a double one with
 * a relative error below 8 u^2. */
#ifndef DYD_TOLERANCE_DD_FILTER_H
#define DYD_TOLERANCE_DD_FILTER_H

#include "tolerance/lines.h"

#include <math.h>

#define DYD_DD_ROUND 0x1p-98
#define DYD_DD_TINY 0x1p-900

/* v, and a bound of its error. */
typedef struct dyd_dd_bounded {
  double h, l, e;
} dyd_dd_bounded;

static inline dyd_dd_bounded dyd_dd_two_sum(double a, double b) {
  double s = a + b, t = s - a;
  return (dyd_dd_bounded){s, (a - (s - t)) + (b - t), 0};
}

static inline dyd_dd_bounded dyd_dd_renormal(double h, double l, double e) {
  double s = h + l;
  return (dyd_dd_bounded){s, l - (s - h), e};
}

static inline dyd_dd_bounded dyd_dd_plus(dyd_dd_bounded a, dyd_dd_bounded b, int sign) {
  dyd_dd_bounded s = dyd_dd_two_sum(a.h, sign * b.h);
  return dyd_dd_renormal(s.h, s.l + (a.l + sign * b.l), a.e + b.e + DYD_DD_ROUND / 16 * (fabs(a.h) + fabs(b.h)));
}

static inline dyd_dd_bounded dyd_dd_times(dyd_dd_bounded a, dyd_dd_bounded b) {
  double p = a.h * b.h, e = fma(a.h, b.h, -p);
  double error = (fabs(a.h) + a.e) * b.e + fabs(b.h) * a.e;
  return dyd_dd_renormal(p, e + (a.h * b.l + a.l * b.h),
                         error * (1 + 0x1p-40) + DYD_DD_ROUND / 16 * fabs(p) + DYD_DD_TINY);
}

static inline dyd_dd_bounded dyd_dd_between(double a, double b, double low_a, double low_b, double slack) {
  dyd_dd_bounded d = dyd_dd_two_sum(a, -b);
  return dyd_dd_renormal(d.h, d.l + (low_a - low_b), slack + DYD_DD_ROUND / 16 * fabs(d.h));
}

/* The place of vertex a as seen from b. */
static inline void dyd_dd_vector(dyd_dd_bounded out[2], const dyd_points_d *p, uint32_t a, uint32_t b) {
  dyd_xy low[2] = {{0, 0}, {0, 0}};
  if (p->low) low[0] = p->low[a], low[1] = p->low[b];
  out[0] = dyd_dd_between(p->xy[a].x, p->xy[b].x, low[0].x, low[1].x, p->slack);
  out[1] = dyd_dd_between(p->xy[a].y, p->xy[b].y, low[0].y, low[1].y, p->slack);
}

static inline dyd_dd_bounded dyd_dd_square_sum(dyd_dd_bounded x, dyd_dd_bounded y) {
  return dyd_dd_plus(dyd_dd_times(x, x), dyd_dd_times(y, y), 1);
}

/* m and n of the line of vertex k, lines.h, for i and j. j_from_i: dyd_dd_vector of these. */
static inline void dyd_dd_line(dyd_dd_bounded *m, dyd_dd_bounded *n, const dyd_points_d *at, uint32_t k, uint32_t i,
                               uint32_t j, const dyd_dd_bounded j_from_i[2]) {
  dyd_dd_bounded p[2], q[2];
  dyd_dd_vector(p, at, k, i);
  dyd_dd_vector(q, at, k, j);
  *m = dyd_dd_plus(dyd_dd_times(p[0], q[0]), dyd_dd_times(p[1], q[1]), 1);
  *n = dyd_dd_plus(dyd_dd_times(p[1], j_from_i[0]), dyd_dd_times(p[0], j_from_i[1]), -1);
}

static inline dyd_dd_bounded dyd_dd_root(dyd_dd_bounded a) {
  double s = sqrt(a.h), r = s > 0 ? (fma(-s, s, a.h) + a.l) / (2 * s) : 0;
  return dyd_dd_renormal(s, r, a.e / s + DYD_DD_ROUND / 16 * s);
}

static inline dyd_dd_bounded dyd_dd_of(double a) {
  return (dyd_dd_bounded){a, 0, 0};
}

/* 1, -1; 0: not certain. */
static inline int dyd_dd_sign(dyd_dd_bounded a) {
  return fabs(a.h) > a.e * (1 + 0x1p-20) ? (a.h > 0 ? 1 : -1) : 0;
}

#endif
