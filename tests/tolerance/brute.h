/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* w(ij) of points with small coordinates, by looking at every place where its supremum can be. */
#ifndef DYD_TESTS_TOLERANCE_BRUTE_H
#define DYD_TESTS_TOLERANCE_BRUTE_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

enum { BRUTE_MOST = 12, BRUTE_BITS = 400 };

typedef struct brute_points {
  size_t n;
  double x[BRUTE_MOST], y[BRUTE_MOST];
} brute_points;

/* *out (initialised, BRUTE_BITS) = sup over c of min over k of |c - p_k| - max(|c - p_i|, |c - p_j|), k others than i
 * and j, to some 100 digits; Returns false if no others exist. */
bool brute_width(mpf_ptr out, const brute_points *p, size_t i, size_t j);

#endif
