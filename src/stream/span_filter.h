/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Intervals of doubles. */
#ifndef DYD_STREAM_SPAN_FILTER_H
#define DYD_STREAM_SPAN_FILTER_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* Finite doubles lo <= hi. */
typedef struct dyd_double_span {
  double lo, hi;
} dyd_double_span;

/* The greatest b for which dyd_filter_round(., a, b) succeeds; INT64_MIN when there is none, INT64_MAX for a point. */
int64_t dyd_filter_bits(dyd_double_span a);
/* a rounded outward to multiples of 2^-(bits + 2), at most 2^-bits wide [FLT-GRID]; a itself when it is a point. false
 * when that is not so narrow, or bits is not within 0 .. 1000. */
bool dyd_filter_round(dyd_double_span *out, dyd_double_span a, int64_t bits);

/* IEEE doubles of one sign are ordered as their patterns: for x > 0 the next double is the next pattern. Beyond the
 * largest is infinity, before infinity the largest; NaN stays. */
static inline double dyd_double_of_pattern(uint64_t pattern) {
  double x;
  memcpy(&x, &pattern, sizeof x);
  return x;
}
static inline uint64_t dyd_pattern_of(double x) {
  uint64_t pattern;
  memcpy(&pattern, &x, sizeof pattern);
  return pattern;
}

#endif
