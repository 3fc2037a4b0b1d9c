/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The bounds as MPFR numbers, for comparing with a goal without leaving the exponent range of dyadics. */
#ifndef DYD_METRIC_BOUNDS_H
#define DYD_METRIC_BOUNDS_H

#include "metric/measure.h"
#include <dyadel/metric.h>

/* The bounds of metric.h with the list of possible pairs and a place to measure in at hand. out is initialised by
 * the caller at DYD_MEASURE_PREC bits or more. Rounded up by at most 2^-70 of itself. */
dyd_status dyd_bound_area(mpfr_ptr out, dyd_measure *m, const dyd_pair_list *pairs);
dyd_status dyd_bound_hausdorff(mpfr_ptr out, dyd_measure *m, const dyd_pair_list *pairs);

/* What one possible pair adds to (area) or asks of (Hausdorff) the bound. */
dyd_status dyd_bound_pair_hausdorff(mpfr_ptr out, dyd_measure *m, const dyd_pair *pair);

/* out = x >= 0 rounded up to 64 bits, and up to the least positive dyadic. DYD_E_RANGE when x is too large. */
dyd_status dyd_bound_to_dyadic(dyd_dyadic *out, mpfr_srcptr x);

#endif
