/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The crossing of two lines in double-doubles.
 *
 * Let u = 2^-53. Sums and products of double-doubles have relative errors below 8 u^2 of the sum of the sizes of what
 * is added, or of the product (Joldes, Muller, Popescu 2017), differences of given coordinates below 4 u^2, beyond
 * slack. Three levels deep (difference, product, sum, product, sum), errors stay below ROUND = 2^-98 of the sum of the
 * sizes of all products; slack s of a difference counts s times the other factors. Products that underflow are off by
 * less than TINY, as in lines_filter.c, which refuses pairs too short for that. */
#include "tolerance/crossing_filter.h"

#include <float.h>
#include <math.h>

#define U 0x1p-53
#define ROUND 0x1p-98
#define TINY 0x1p-900

/* v, and a bound of its error. */
typedef struct dd_bound {
  double h, l, e;
} dd_bound;

static dd_bound dd_two_sum(double a, double b) {
  double s = a + b, t = s - a;
  return (dd_bound){s, (a - (s - t)) + (b - t), 0};
}

static dd_bound dd_renormal(double h, double l, double e) {
  double s = h + l;
  return (dd_bound){s, l - (s - h), e};
}

static dd_bound dd_plus(dd_bound a, dd_bound b, int sign) {
  dd_bound s = dd_two_sum(a.h, sign * b.h);
  return dd_renormal(s.h, s.l + (a.l + sign * b.l), a.e + b.e + ROUND / 16 * (fabs(a.h) + fabs(b.h)));
}

static dd_bound dd_times(dd_bound a, dd_bound b) {
  double p = a.h * b.h, e = fma(a.h, b.h, -p);
  double error = (fabs(a.h) + a.e) * b.e + fabs(b.h) * a.e;
  return dd_renormal(p, e + (a.h * b.l + a.l * b.h), error * (1 + 0x1p-40) + ROUND / 16 * fabs(p) + TINY);
}

static dd_bound dd_between(double a, double b, double low_a, double low_b, double slack) {
  dd_bound d = dd_two_sum(a, -b);
  return dd_renormal(d.h, d.l + (low_a - low_b), slack + ROUND / 16 * fabs(d.h));
}

static void vector_between(dd_bound out[2], const dyd_points_d *p, uint32_t a, uint32_t b) {
  dyd_xy low[2] = {{0, 0}, {0, 0}};
  if (p->low) low[0] = p->low[a], low[1] = p->low[b];
  out[0] = dd_between(p->xy[a].x, p->xy[b].x, low[0].x, low[1].x, p->slack);
  out[1] = dd_between(p->xy[a].y, p->xy[b].y, low[0].y, low[1].y, p->slack);
}

static void line_between(dd_bound *m, dd_bound *n, const dyd_points_d *at, uint32_t k, uint32_t i, uint32_t j) {
  dd_bound p[2], q[2], d[2];
  vector_between(p, at, k, i);
  vector_between(q, at, k, j);
  vector_between(d, at, j, i);
  *m = dd_plus(dd_times(p[0], q[0]), dd_times(p[1], q[1]), 1);
  *n = dd_plus(dd_times(p[1], d[0]), dd_times(p[0], d[1]), -1);
}

double dyd_filter_crossing(double *s, double *es, double *relative, const dyd_points_d *p, const dyd_lines_d *l,
                           uint32_t a, uint32_t b) {
  dd_bound m[2], n[2];
  line_between(&m[0], &n[0], p, a, l->i, l->j);
  line_between(&m[1], &n[1], p, b, l->i, l->j);
  dd_bound num = dd_plus(dd_times(n[1], m[0]), dd_times(n[0], m[1]), -1);
  dd_bound d = dd_plus(m[1], m[0], -1), e = dd_plus(n[1], n[0], -1);
  double ee = e.e + 2 * U * fabs(e.h), ed = d.e + 2 * U * fabs(d.h);
  *relative = (num.e / fabs(num.h) + 2 * U + ee / (fabs(e.h) - ee) + 4 * U) * (1 + 0x1p-20);
  *s = d.h / (2 * e.h);
  *es = (ed + 2 * fabs(*s) * ee + 2 * U * fabs(d.h)) / (2 * (fabs(e.h) - ee)) * (1 + 0x1p-20);
  if (!(ee < 0x1p-30 * fabs(e.h) && *es <= DBL_MAX)) *relative = HUGE_VAL;
  return num.h / e.h;
}
