/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checks that the caller's floating point is the one the filters were proved for; places in an interval of doubles. */
#ifndef DYD_BASE_FLOAT_FILTER_H
#define DYD_BASE_FLOAT_FILTER_H

#include <dyadel/status.h>

/* DYD_E_ARG, with a message that says what to do, when this thread flushes subnormal numbers to zero, takes them for
 * zero, or does not round to nearest, or traps floating-point exceptions: then comparisons of doubles would call
 * different points equal; or when products and sums were fused by the compiler. */
dyd_status dyd_float_check(dyd_error *err);

/* The place of [lo, hi] that is nearest to x. */
static inline double dyd_nearest_in(double x, double lo, double hi) {
  return x < lo ? lo : x > hi ? hi : x;
}
/* The end that is farther from x. */
static inline double dyd_farther_end(double x, double lo, double hi) {
  return x - lo > hi - x ? lo : hi;
}

#endif
