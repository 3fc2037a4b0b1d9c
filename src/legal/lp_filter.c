/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Largest disc inside half-planes, by the dual simplex method.
 *
 * A triple of cuts whose normals hold 0 in their convex hull bounds z from above by its own optimum; the optimum of all
 * cuts is the least of these. Start with a large triangle; while a cut is violated at the triple's optimum, exchange:
 * of the triples with the new cut that are dual feasible take the one with the least optimum. */
#include "legal/lp_filter.h"

#include <math.h>

enum { STEPS = 200 };

static double lp_cross(const dyd_cut *a, const dyd_cut *b) {
  return a->nx * b->ny - a->ny * b->nx;
}

/* The optimum of three cuts: n.x + d = z for all; false when 0 is not in the hull of their normals. */
static bool lp_optimum(dyd_lp_result *r, const dyd_cut *a, const dyd_cut *b, const dyd_cut *c) {
  double la = lp_cross(b, c), lb = lp_cross(c, a), lc = lp_cross(a, b);
  if (la < 0 || lb < 0 || lc < 0) {
    if (la > 0 || lb > 0 || lc > 0) return false;
    la = -la;
    lb = -lb;
    lc = -lc;
  }
  double sum = la + lb + lc;
  if (!(sum > 1e-14)) return false;
  r->z = (la * a->d + lb * b->d + lc * c->d) / sum;
  /* (a - b).x = b.d - a.d, (a - c).x = c.d - a.d; the determinant is +-sum */
  double ux = a->nx - b->nx, uy = a->ny - b->ny, vx = a->nx - c->nx, vy = a->ny - c->ny;
  double p = b->d - a->d, q = c->d - a->d, det = ux * vy - uy * vx;
  r->x = (p * vy - q * uy) / det;
  r->y = (ux * q - vx * p) / det;
  return isfinite(r->x) && isfinite(r->y);
}

/* The cut, or side of the frame, that is violated most; NULL: none. */
static const dyd_cut *lp_most_violated(const dyd_cut *cut, size_t count, const dyd_cut frame[3],
                                       const dyd_lp_result *r) {
  const dyd_cut *worst = NULL;
  double least = r->z - 1e-13 * (fabs(r->z) + fabs(r->x) + fabs(r->y));
  for (size_t k = 0; k < count + 3; k++) {
    const dyd_cut *c = k < count ? &cut[k] : &frame[k - count];
    double value = c->nx * r->x + c->ny * r->y + c->d;
    if (value < least) {
      least = value;
      worst = c;
    }
  }
  return worst;
}

dyd_lp_result dyd_lp_centre(const dyd_cut *cut, size_t count, double bound) {
  const double h = 0.8660254037844386;
  dyd_cut frame[3] = {{0, 1, bound}, {-h, -0.5, bound}, {h, -0.5, bound}};
  const dyd_cut *basis[3] = {&frame[0], &frame[1], &frame[2]};
  dyd_lp_result best = {.z = bound};
  for (int step = 0; step < STEPS; step++) {
    const dyd_cut *k = lp_most_violated(cut, count, frame, &best);
    if (!k) break;
    int leaves = 3;
    dyd_lp_result next = best, r = {0};
    for (int out = 0; out < 3; out++) {
      if (!lp_optimum(&r, k, basis[(out + 1) % 3], basis[(out + 2) % 3])) continue;
      if (leaves < 3 && r.z >= next.z) continue;
      leaves = out;
      next = r;
    }
    if (leaves == 3) break;
    best = next;
    basis[leaves] = k;
  }
  best.bounded = true;
  for (int q = 0; q < 3; q++) {
    if (basis[q] >= frame && basis[q] < frame + 3)
      best.bounded = false;
    else
      best.basis[q] = (int)(basis[q] - cut);
  }
  return best;
}
