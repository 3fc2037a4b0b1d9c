/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Columns of doubles in a caller's table, read as points or as points with a radius.
 *
 * With s the double nearest to a + b, the rest a + b - s is a double, and Knuth's six operations give it exactly where
 * nothing overflows, subnormal numbers included. Its sign shows the side of s on which the sum is: s, or the double
 * next to it on that side, is the outward one. */
#include "rect/columns_filter.h"

#include <math.h>
#include <string.h>

double dyd_column_at(const dyd_column *c, size_t i) {
  double value;
  memcpy(&value, (const char *)c->first + (ptrdiff_t)i * c->step, sizeof value);
  return value;
}

/* The least double that is not below a + b. */
static double sum_up(double a, double b) {
  double s = a + b, of_b = s - a, of_a = s - of_b, rest = (a - of_a) + (b - of_b);
  return rest > 0 ? nextafter(s, INFINITY) : s;
}

/* Infinite sums give a rest that is NaN, and stay infinite. */
bool dyd_widen_d(double *lo, double *hi, double x, double r) {
  if (!isfinite(x) || !isfinite(r) || r < 0) return false;
  *lo = -sum_up(-x, r) + 0.0;
  *hi = sum_up(x, r) + 0.0;
  return isfinite(*lo) && isfinite(*hi);
}
