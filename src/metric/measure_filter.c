/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Areas and lengths of rectangles with double ends, in double-double arithmetic with proved error bounds.
 *
 * Let u = 2^-53. All numbers here are >= 0, and only differences of given doubles are subtracted, each exactly:
 * two_sum has no error, in the subnormal range too. The other operations have these relative errors (Joldes, Muller,
 * Popescu 2017, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic"):
 *   sum of two non-negative double-doubles    3 u^2     (their SloppyDWPlusDW, equal signs)
 *   product                                   7 u^2     (their DWTimesDW1)
 *   square root                               8 u^2     (below)
 * provided nothing over- or underflows. leads_in_range makes sure of that: every non-zero leading part is between
 * 2^-400 and 2^400, so products are between 2^-802 and 2^802; the trailing parts of products are then off by at most
 * a few 2^-1074, which is less than 2^-270 of the product.
 *
 * Square root of x = h + l with s = RN(sqrt(h)): r = h - s^2 is a double, found by one fma. With d = r + l,
 * |d| <= 2.1 u x, and sqrt(x) = s + d / (s + sqrt(x)). The quotient is computed as RN(RN(r + l) / (2 s)): replacing
 * sqrt(x) by s changes it by less than 1.1 u of itself, the two roundings by 2.1 u, and |d| / (2 s) <= 1.1 u s: in
 * all less than 4 u^2 s. The last fast_two_sum is exact, since the quotient is below s.
 *
 * The deepest expression, reach, is one square and one sum of squares (7 + 3), a root (half of that, plus 8), and a
 * sum (3): below 32 u^2 = 2^-101; twice an area is a sum of at most four products of sums: 3 + 7 + 9 < 32 as well.
 * inflate adds 2^-87 of the leading part, computed with an error below 2^-105 of it: the result is an upper
 * bound, and exceeds the truth by less than 2^-86 of it. */
#include "metric/bounds_filter.h"

#include <fenv.h>
#include <math.h>

bool dyd_filter_measure_usable(void) {
  return fegetround() == FE_TONEAREST;
}

/* h + l. Invariant: h = RN(h + l); h >= 0. */
typedef struct dd {
  double h, l;
} dd;

static dd two_sum(double a, double b) {
  double s = a + b, t = s - a;
  return (dd){s, (a - (s - t)) + (b - t)};
}

/* Needs |a| >= |b| or a = 0. */
static dd fast_two_sum(double a, double b) {
  double s = a + b;
  return (dd){s, b - (s - a)};
}

static dd dd_sub_d(double a, double b) {
  return two_sum(a, -b);
}

static dd dd_add(dd x, dd y) {
  dd s = two_sum(x.h, y.h);
  return fast_two_sum(s.h, s.l + (x.l + y.l));
}

static dd dd_mul(dd x, dd y) {
  double p = x.h * y.h, e = fma(x.h, y.h, -p);
  return fast_two_sum(p, e + (x.h * y.l + x.l * y.h));
}

static dd dd_sqrt(dd x) {
  if (x.h == 0) return x;
  double s = sqrt(x.h), r = fma(-s, s, x.h);
  return fast_two_sum(s, (r + x.l) / (2 * s));
}

static bool dd_lead_in_range(dd x) {
  return x.h == 0 || (x.h >= 0x1p-400 && x.h <= 0x1p400);
}

static void dd_inflate(double out[2], dd x) {
  out[0] = x.h;
  out[1] = x.l + x.h * 0x1p-87;
}

/* One axis of two intervals [a0,a1], [b0,b1]. Invariant: all in range.
 *   wa, wb  widths;   b_low: b0 < a0;   b_high: b1 > a1 (b sticks out there)
 *   low = |b0 - a0|, high = |b1 - a1| */
typedef struct hull_axis {
  dd wa, wb, low, high;
  bool b_low, b_high;
} hull_axis;

static bool area2_axis_set(hull_axis *out, const double a[2], const double b[2]) {
  out->b_low = b[0] < a[0];
  out->b_high = b[1] > a[1];
  out->wa = dd_sub_d(a[1], a[0]);
  out->wb = dd_sub_d(b[1], b[0]);
  out->low = out->b_low ? dd_sub_d(a[0], b[0]) : dd_sub_d(b[0], a[0]);
  out->high = out->b_high ? dd_sub_d(b[1], a[1]) : dd_sub_d(a[1], b[1]);
  return dd_lead_in_range(out->wa) && dd_lead_in_range(out->wb) && dd_lead_in_range(out->low) &&
         dd_lead_in_range(out->high);
}

/* b sticks out of a on one side of x only, by p: 2 wa ha + p (ha + hb). */
static dd area2_one(const hull_axis *x, const hull_axis *y) {
  dd p = x->b_low ? x->low : x->high;
  dd whole = dd_mul(x->wa, y->wa), part = dd_mul(p, dd_add(y->wa, y->wb));
  return dd_add(dd_add(whole, whole), part);
}

/* b sticks out on one side of x, by p, and one of y, by s; a on the two others, by r in x:
 * wa H + p hb + wb H + r ha with H = ha + s. */
static dd area2_corner(const hull_axis *x, const hull_axis *y) {
  dd p = x->b_low ? x->low : x->high, r = x->b_low ? x->high : x->low;
  dd tall = dd_add(y->wa, y->b_low ? y->low : y->high);
  dd left = dd_add(dd_mul(x->wa, tall), dd_mul(p, y->wb));
  return dd_add(left, dd_add(dd_mul(x->wb, tall), dd_mul(r, y->wa)));
}

/* b sticks out on both sides of x, a on both sides of y, by q and s: wb (ha + hb) + wa (q + s). */
static dd area2_cross(const hull_axis *x, const hull_axis *y) {
  return dd_add(dd_mul(x->wb, dd_add(y->wa, y->wb)), dd_mul(x->wa, dd_add(y->low, y->high)));
}

/* The hull is the bounding box W x H less a triangle at each corner where the two rectangles own one side each:
 * 2 area = 2 W H - sum of the products of the legs. The forms above are this, written without a subtraction:
 * for the corner case with W = wa + p = wb + r, H = ha + s = hb + q it is 2 W H - p q - r s, where
 * W H - p q = wa H + p hb and W H - r s = wb H + r ha; the others likewise. */
bool dyd_filter_partial_edge_area2(double out[2], const double a[4], const double b[4]) {
  hull_axis x, y;
  if (!area2_axis_set(&x, a, b) || !area2_axis_set(&y, a + 2, b + 2)) return false;
  int in_x = x.b_low + x.b_high, in_y = y.b_low + y.b_high;
  if (in_x + in_y > 2) {
    /* Seen from b, at most 4 - 3 sides are the other's; ties count for the first. */
    return dyd_filter_partial_edge_area2(out, b, a);
  }
  dd sum;
  if (in_x + in_y == 0) {
    sum = dd_mul(x.wa, y.wa);
    sum = dd_add(sum, sum);
  } else if (in_x == 1 && in_y == 1) {
    sum = area2_corner(&x, &y);
  } else if (in_x + in_y == 1) {
    sum = in_x ? area2_one(&x, &y) : area2_one(&y, &x);
  } else {
    sum = in_x ? area2_cross(&x, &y) : area2_cross(&y, &x);
  }
  dd_inflate(out, sum);
  return true;
}

static dd dd_norm(dd x, dd y) {
  return dd_sqrt(dd_add(dd_mul(x, x), dd_mul(y, y)));
}

static dd dd_max(dd x, dd y) {
  return x.h > y.h || (x.h == y.h && x.l > y.l) ? x : y;
}

static bool dd_diameter(dd *out, const double a[4]) {
  dd w = dd_sub_d(a[1], a[0]), h = dd_sub_d(a[3], a[2]);
  if (!dd_lead_in_range(w) || !dd_lead_in_range(h)) return false;
  *out = dd_norm(w, h);
  return true;
}

bool dyd_filter_diameter(double out[2], const double a[4]) {
  dd d;
  if (!dd_diameter(&d, a)) return false;
  dd_inflate(out, d);
  return true;
}

/* The largest distance of a point of [a0,a1] to one of [b0,b1]. It is never negative:
 * (a1 - b0) + (b1 - a0) is the sum of the widths. */
static dd dd_farthest(const double a[2], const double b[2]) {
  return dd_max(dd_sub_d(a[1], b[0]), dd_sub_d(b[1], a[0]));
}

bool dyd_filter_reach(double out[2], const double a[4], const double b[4]) {
  dd da, db, x = dd_farthest(a, b), y = dd_farthest(a + 2, b + 2);
  if (!dd_diameter(&da, a) || !dd_diameter(&db, b) || !dd_lead_in_range(x) || !dd_lead_in_range(y)) return false;
  dd length = dd_norm(x, y), half = {length.h / 2, length.l / 2};
  dd_inflate(out, dd_add(half, dd_max(da, db)));
  return true;
}
