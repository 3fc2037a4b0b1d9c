/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Interval arithmetic in doubles, rounded outward without touching the rounding mode.
 *
 * For a double c let e = fl(fl(u(1+2u) |c|) + eta), u = 2^-53, eta = 2^-1074. Then fl(c - e) <= pred(c) and
 * succ(c) <= fl(c + e), subnormals included (Rump, Zimmermann, Boldo, Melquiond, "Computing predecessor and
 * successor in rounding to nearest", BIT 2009). A sum, product, quotient or root that rounds to c lies between
 * pred(c) and succ(c). When c is infinite the inner end becomes NaN.
 *
 * Each end is a bound of its own unless it is NaN, which bounds nothing: comparisons with NaN are false, callers
 * conclude from comparisons that are true only, and operations that mix both ends give up unless all is finite. */
#ifndef DYD_PREDICATE_INTERVAL_FILTER_H
#define DYD_PREDICATE_INTERVAL_FILTER_H

#include <math.h>
#include <stdbool.h>

typedef struct dyd_iv {
  double lo, hi;
} dyd_iv;

#define DYD_IV_UNKNOWN ((dyd_iv){(double)NAN, (double)NAN})

static inline double dyd_down(double c) {
  return c - (0x1.0000000000001p-53 * fabs(c) + 0x1p-1074);
}
static inline double dyd_up(double c) {
  return c + (0x1.0000000000001p-53 * fabs(c) + 0x1p-1074);
}

static inline dyd_iv dyd_iv_point(double x) {
  return (dyd_iv){x, x};
}
static inline dyd_iv dyd_iv_neg(dyd_iv a) {
  return (dyd_iv){-a.hi, -a.lo};
}
static inline dyd_iv dyd_iv_add(dyd_iv a, dyd_iv b) {
  return (dyd_iv){dyd_down(a.lo + b.lo), dyd_up(a.hi + b.hi)};
}
static inline dyd_iv dyd_iv_sub(dyd_iv a, dyd_iv b) {
  return (dyd_iv){dyd_down(a.lo - b.hi), dyd_up(a.hi - b.lo)};
}
/* Multiplication by a power of two, exact unless it underflows; f > 0. */
static inline dyd_iv dyd_iv_scale(dyd_iv a, double f) {
  return (dyd_iv){dyd_down(a.lo * f), dyd_up(a.hi * f)};
}

/* Smallest and largest of four numbers, rounded outward; unknown unless all are finite. */
static inline dyd_iv dyd_iv_span4(double p, double q, double r, double s) {
  if (!isfinite(p + q + r + s)) return DYD_IV_UNKNOWN;
  double lo1 = p < q ? p : q, hi1 = p < q ? q : p, lo2 = r < s ? r : s, hi2 = r < s ? s : r;
  return (dyd_iv){dyd_down(lo1 < lo2 ? lo1 : lo2), dyd_up(hi1 > hi2 ? hi1 : hi2)};
}

static inline dyd_iv dyd_iv_mul(dyd_iv a, dyd_iv b) {
  return dyd_iv_span4(a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi);
}

static inline dyd_iv dyd_iv_div(dyd_iv a, dyd_iv b) {
  if (!(b.lo > 0 || b.hi < 0)) return DYD_IV_UNKNOWN;
  return dyd_iv_span4(a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi);
}

/* Squares of the numbers of a. */
static inline dyd_iv dyd_iv_sqr(dyd_iv a) {
  double p = a.lo * a.lo, q = a.hi * a.hi;
  if (!isfinite(p + q)) return DYD_IV_UNKNOWN;
  bool zero_inside = a.lo <= 0 && a.hi >= 0;
  double least = p < q ? p : q;
  double lo = dyd_down(least);
  return (dyd_iv){zero_inside || lo < 0 ? 0 : lo, dyd_up(p < q ? q : p)};
}

/* Roots of the numbers >= 0 of a, where there is one. */
static inline dyd_iv dyd_iv_sqrt(dyd_iv a) {
  if (!(a.hi >= 0) || isnan(a.lo)) return DYD_IV_UNKNOWN;
  double lo = a.lo > 0 ? dyd_down(sqrt(a.lo)) : 0;
  return (dyd_iv){lo < 0 ? 0 : lo, dyd_up(sqrt(a.hi))};
}

/* 1 or -1 when every number of a has that sign, else 0. */
static inline int dyd_iv_sign(dyd_iv a) {
  return a.lo > 0 ? 1 : a.hi < 0 ? -1 : 0;
}

#endif
