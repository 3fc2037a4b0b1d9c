/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rectangles for the tests of predicates: small integer ones, and doubles near ties at every scale. */
#ifndef DYD_TESTS_SHAPES_H
#define DYD_TESTS_SHAPES_H

#include <math.h>

#include "predicate/oracle.h"
#include "rect/irect.h"
#include "rect/rect.h"
#include "support/random.h"

static inline small_rect random_small(test_random *r, int grid) {
  small_rect s;
  for (int axis = 0; axis < 2; axis++) {
    int a = (int)test_between(r, 0, grid), b = test_chance(r, 3) ? a : (int)test_between(r, 0, grid);
    if (grid > 4 && b > a + 2) b = a + 2;
    if (grid > 4 && a > b + 2) a = b + 2;
    s.end[2 * axis] = a < b ? a : b;
    s.end[2 * axis + 1] = a < b ? b : a;
  }
  return s;
}

static inline bool small_meets(const small_rect *a, const small_rect *b) {
  return a->end[0] <= b->end[1] && b->end[0] <= a->end[1] && a->end[2] <= b->end[3] && b->end[2] <= a->end[3];
}

static inline void small_irect(dyd_irect *out, const small_rect *r) {
  mpz_set_si(out->x0, r->end[0]);
  mpz_set_si(out->x1, r->end[1]);
  mpz_set_si(out->y0, r->end[2]);
  mpz_set_si(out->y1, r->end[3]);
}

/* A rectangle inside r. */
static inline small_rect shrink_small(test_random *rnd, const small_rect *r) {
  small_rect s = *r;
  for (int axis = 0; axis < 2; axis++) {
    int *lo = &s.end[2 * axis], *hi = lo + 1;
    *lo = (int)test_between(rnd, *lo, *hi);
    *hi = (int)test_between(rnd, *lo, *hi);
  }
  return s;
}

/* Turned by 90 degrees; mirrored in the y-axis. */
static inline small_rect turn_small(const small_rect *r) {
  return (small_rect){{-r->end[3], -r->end[2], r->end[0], r->end[1]}};
}
static inline small_rect mirror_small(const small_rect *r) {
  return (small_rect){{-r->end[1], -r->end[0], r->end[2], r->end[3]}};
}

/* A few steps of nextafter. */
static inline double jitter(test_random *r, double x) {
  for (int64_t k = test_between(r, -2, 2); k != 0; k += k < 0 ? 1 : -1) x = nextafter(x, k < 0 ? -HUGE_VAL : HUGE_VAL);
  return x;
}

static inline double shape_scale(test_random *r) {
  static const double scale[] = {1, 1, 0x1p-1074, 0x1p-1030, 0x1p-600, 0x1p-300, 0x1p300, 0x1p600, 0x1.8p1016, 0x1p-30};
  return scale[test_below(r, sizeof scale / sizeof *scale)];
}

/* out = {x0, x1, y0, y1} on a small grid of cocircular and collinear points, scaled and jittered. */
static inline void random_box(double out[4], test_random *r, double scale, bool tie) {
  for (int axis = 0; axis < 2; axis++) {
    double a = scale * (double)test_between(r, -50, 50) / (tie ? 1 : 7), w = 0;
    if (test_chance(r, 3)) w = fabs(scale) * test_unit(r) * (test_chance(r, 2) ? 10 : 1e-12);
    if (!tie || test_chance(r, 4)) a = jitter(r, a);
    out[2 * axis] = a;
    out[2 * axis + 1] = a + w;
  }
}

/* A rational point within 6 of (2^52, -2^52): its outward box in doubles is a unit square there, so filters see wide
 * boxes where there are points. */
static inline void random_far_point(dyd_rect *out, test_random *r) {
  mpq_t q[2], t;
  mpq_inits(q[0], q[1], t, NULL);
  for (int axis = 0; axis < 2; axis++) {
    mpq_set_si(q[axis], (long)test_between(r, 0, 42), 7);
    mpq_canonicalize(q[axis]);
    mpq_set_si(t, 1, 1);
    mpq_mul_2exp(t, t, 52);
    (axis ? mpq_sub : mpq_add)(q[axis], q[axis], t);
  }
  (void)dyd_rect_set_q(out, q[0], q[1]);
  mpq_clears(q[0], q[1], t, NULL);
}

static inline void box_rect(dyd_rect *out, const double box[4]) {
  (void)dyd_rect_set_d(out, box[0], box[1], box[2], box[3]);
}

#endif
