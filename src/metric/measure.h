/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What one pair of sites adds to the bounds: area, length and diameter, rounded up.
 *
 * Every value given is not below the true value t and not above (1 + 2^-80) t (for t > 0; 0 for t = 0), on both
 * rungs: doubles where they hold the rectangles exactly, rationals and MPFR otherwise. */
#ifndef DYD_METRIC_MEASURE_H
#define DYD_METRIC_MEASURE_H

#include <dyadel/sites.h>

#include <mpfr.h>

/* Precision of the values given and of sums of them; any caller may use another. */
#define DYD_MEASURE_PREC 128

/* A place to measure the pairs of one table of sites in. Borrows the sites. */
typedef struct dyd_measure {
  const dyd_sites *sites;
  bool filter; /* false: exact rung only */
  dyd_rect a, b;
  mpq_t end[8], sum, term;
  mpfr_t t;
} dyd_measure;

void dyd_measure_init(dyd_measure *m, const dyd_sites *sites);
void dyd_measure_clear(dyd_measure *m);

/* Area of Ed(R_i,R_j). out is initialised by the caller; so below. */
dyd_status dyd_measure_area(mpfr_ptr out, dyd_measure *m, size_t i, size_t j);
/* Largest distance of two points of R_i. */
dyd_status dyd_measure_diameter(mpfr_ptr out, dyd_measure *m, size_t i);
/* Half the largest distance of a point of R_i to one of R_j, plus the larger diameter. */
dyd_status dyd_measure_reach(mpfr_ptr out, dyd_measure *m, size_t i, size_t j);

/* The smallest distance of a point of R_i to one of R_j, rounded down: not above the true value t and not below
 * (1 - 2^-80) t. */
dyd_status dyd_measure_gap(mpfr_ptr out, dyd_measure *m, size_t i, size_t j);

#endif
