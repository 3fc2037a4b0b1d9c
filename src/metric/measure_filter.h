/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Areas and lengths of rectangles with double ends, in double-double arithmetic with proved error bounds.
 *
 * A rectangle is given as a[0..3] = x lower, x upper, y lower, y upper, and must be exactly that. Results are
 * unevaluated sums out[0] + out[1] of two doubles, not below the true value t and not above (1 + 2^-86) t.
 * Every function may decline (false, out undefined): the caller goes to the exact rung. */
#ifndef DYD_METRIC_MEASURE_FILTER_H
#define DYD_METRIC_MEASURE_FILTER_H

#include <stdbool.h>

/* Does the processor round to nearest now? The bounds hold only then; otherwise do not call the rest. */
bool dyd_filter_measure_usable(void);

/* Twice the area of the hull of a and b. */
bool dyd_filter_partial_edge_area2(double out[2], const double a[4], const double b[4]);
/* The largest distance of two points of a. */
bool dyd_filter_diameter(double out[2], const double a[4]);
/* Half the largest distance of a point of a to a point of b, plus the larger of the two diameters. */
bool dyd_filter_reach(double out[2], const double a[4], const double b[4]);

#endif
