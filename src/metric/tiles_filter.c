/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Coordinates of rings are multiples of 2^-grid below 2^52 of them, but on the sides of a window. */
#include "metric/tiles_filter.h"

#include <math.h>

/* x 2^grid; scaling is exact, and so is the test. */
static bool grid_number(int64_t *out, double x, int grid) {
  double n = ldexp(x, grid);
  if (!(fabs(n) < 0x1p52) || n != nearbyint(n)) return false;
  *out = (int64_t)n;
  return true;
}

/* twice / 2, rounded up to a double, for twice >= 0. */
static double half_rounded_up(dyd_i128 twice) {
  int drop = 0;
  while (twice >> drop >= ((dyd_i128)1 << 53)) drop++;
  bool more = (twice & (((dyd_i128)1 << drop) - 1)) != 0;
  return ldexp((double)(int64_t)(twice >> drop) + more, drop - 1);
}

/* Differences of numbers below 2^52 are below 2^53, products below 2^106; a ring winds once, so that the sum is less
 * than twice the area of a square of 2^53, and what is added on the way stays below 2^127 for 2^20 vertices. */
bool dyd_filter_grid_area(double *out, const dyd_xy *z, size_t n, int grid) {
  dyd_i128 sum = 0;
  int64_t o[2], was[2], at[2];
  if (n < 3 || n > (1u << 20) || !grid_number(&o[0], z[0].x, grid) || !grid_number(&o[1], z[0].y, grid)) return false;
  was[0] = was[1] = 0;
  for (size_t k = 1; k < n; k++) {
    if (!grid_number(&at[0], z[k].x, grid) || !grid_number(&at[1], z[k].y, grid)) return false;
    at[0] -= o[0];
    at[1] -= o[1];
    sum += (dyd_i128)was[0] * at[1] - (dyd_i128)was[1] * at[0];
    was[0] = at[0];
    was[1] = at[1];
  }
  if (sum < 0) return false;
  *out = ldexp(half_rounded_up(sum), -2 * grid);
  return true;
}

/* Boxes, with a step to spare, and the distance from the line: |(b - a) x (v - a)| is compared with twice what a
 * step of the grid allows; its rounding error is below 8 u of the products, which the doubled step covers only where
 * they are small, so it is added. */
bool dyd_filter_near_edge(dyd_xy a, dyd_xy b, dyd_xy v, int grid) {
  double step = ldexp(1, 1 - grid);
  if (v.x < fmin(a.x, b.x) - step || v.x > fmax(a.x, b.x) + step) return false;
  if (v.y < fmin(a.y, b.y) - step || v.y > fmax(a.y, b.y) + step) return false;
  double dx = b.x - a.x, dy = b.y - a.y, p = dx * (v.y - a.y), q = dy * (v.x - a.x);
  return !(fabs(p - q) > 2 * step * (fabs(dx) + fabs(dy)) + 0x1p-49 * (fabs(p) + fabs(q)));
}
