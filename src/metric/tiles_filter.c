/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Coordinates of rings are multiples of 2^-grid below 2^52 of them, but on the sides of a window. */
#include "metric/tiles_filter.h"

#include "base/float_filter.h"

#include <math.h>

/* x scale, a power of two; that is exact, and so is the test. */
static bool grid_number(int64_t *out, double x, double scale) {
  double n = x * scale;
  if (!(fabs(n) < 0x1p52)) return false;
  *out = (int64_t)n;
  return (double)*out == n;
}

/* twice / 2, rounded up to a double, for twice >= 0. */
static double half_rounded_up(dyd_i128 twice) {
  int drop = 0;
  while (twice >> drop >= ((dyd_i128)1 << 53)) drop++;
  bool more = (twice & (((dyd_i128)1 << drop) - 1)) != 0;
  return ldexp((double)(int64_t)(twice >> drop) + more, drop - 1);
}

/* Differences of numbers below 2^52 are below 2^53, products below 2^106; a ring winds once, so that the sum is less
 * than twice the area of a square of 2^53, and the partial sums stay below 2^127 for 2^20 vertices. */
bool dyd_filter_grid_area(double *out, const dyd_xy *z, size_t n, int grid) {
  dyd_i128 sum = 0;
  int64_t o[2], was[2], at[2];
  double scale = ldexp(1, grid);
  if (n < 3 || n > (1u << 20) || !grid_number(&o[0], z[0].x, scale) || !grid_number(&o[1], z[0].y, scale)) return false;
  was[0] = was[1] = 0;
  for (size_t k = 1; k < n; k++) {
    if (!grid_number(&at[0], z[k].x, scale) || !grid_number(&at[1], z[k].y, scale)) return false;
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

/* floor(x scale + 1/2) / scale, not beyond the window. */
static double tile_coordinate(double x, double scale, const double side[2]) {
  double a = x * scale + 0.5;
  int64_t n = (int64_t)a;
  n -= (double)n > a;
  return dyd_nearest_in((double)n / scale, side[0], side[1]);
}

/* Vertices that are off by at most e_k in each coordinate change twice the area by at most the sum of
 * e_k (|x_k+1 - x_k-1| + |y_k+1 - y_k-1|) + 2 e_k e_k+1. Differences from the first vertex, products and sums of n
 * terms are off by less than (n + 8) u of the sum of the products' absolute values. */
size_t dyd_filter_tile(dyd_xy *ring, double bound[2], const dyd_grid_centre *const *c, size_t n, const dyd_window *w,
                       double scale) {
  double sum = 0, size = 0, off = 0;
  dyd_xy o = c[0]->z;
  size_t kept = 0;
  for (size_t k = 0; k < n; k++) {
    const dyd_grid_centre *a = c[k ? k - 1 : n - 1], *z = c[k], *b = c[k + 1 < n ? k + 1 : 0];
    double p = (z->z.x - o.x) * (b->z.y - o.y), q = (z->z.y - o.y) * (b->z.x - o.x);
    sum += p - q;
    size += fabs(p) + fabs(q);
    off += z->error * (fabs(b->z.x - a->z.x) + fabs(b->z.y - a->z.y) + 2 * b->error);
    dyd_xy to = {tile_coordinate(z->z.x, scale, w->d), tile_coordinate(z->z.y, scale, w->d + 2)};
    if (!kept || to.x != ring[kept - 1].x || to.y != ring[kept - 1].y) ring[kept++] = to;
  }
  while (kept > 1 && ring[kept - 1].x == ring[0].x && ring[kept - 1].y == ring[0].y) kept--;
  off = (off + size * (double)(n + 8) * 0x1p-52) * (1 + 0x1p-30) + 0x1p-1000;
  bound[0] = fmax(nextafter((sum - off) / 2, -HUGE_VAL), 0);
  bound[1] = nextafter((sum + off) / 2, HUGE_VAL);
  return kept;
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

/* With e = 2^-52 m + 2^-1074, m the largest coordinate, true coordinates are up to e above the given ones: then
 * differences are off by e and their rounding u, products by 3 u of themselves, e times the sum of their factors, and
 * e^2. Twice that covers second orders and the rounding of the bound. */
int dyd_filter_low_turn(const double a[2], const double b[2], const double c[2]) {
  double m = 0, d[4] = {b[0] - a[0], c[1] - a[1], b[1] - a[1], c[0] - a[0]}, p = d[0] * d[1], q = d[2] * d[3];
  for (int k = 0; k < 2; k++) m = fmax(fmax(m, fabs(a[k])), fmax(fabs(b[k]), fabs(c[k])));
  double e = m * 0x1p-52 + 0x1p-1000;
  double off =
      0x1p-50 * (fabs(p) + fabs(q)) + 2 * e * (fabs(d[0]) + fabs(d[1]) + fabs(d[2]) + fabs(d[3]) + 2 * e) + 0x1p-1000;
  return p - q > off ? 1 : p - q < -off ? -1 : 0;
}
