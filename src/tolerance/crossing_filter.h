/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The crossing of two lines over a bisector in double-doubles, for where much cancels [FLT-TOL]. */
#ifndef DYD_TOLERANCE_CROSSING_FILTER_H
#define DYD_TOLERANCE_CROSSING_FILTER_H

#include "tolerance/lines_filter.h"

/* The height of the crossing of the lines of vertices a and b, within *relative of itself (not below 2^-30, or NaN: not
 * known), and its place s within es. */
double dyd_filter_crossing(double *s, double *es, double *relative, const dyd_points_d *p, const dyd_lines_d *l,
                           uint32_t a, uint32_t b);

#endif
