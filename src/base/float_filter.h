/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checks that the caller's floating point is the one the filters were proved for. */
#ifndef DYD_BASE_FLOAT_FILTER_H
#define DYD_BASE_FLOAT_FILTER_H

#include <dyadel/status.h>

/* DYD_E_ARG, with a message that says what to do, when this thread flushes subnormal numbers to zero, takes them for
 * zero, or does not round to nearest, or traps floating-point exceptions: then comparisons of doubles would call
 * different points equal; or when products and sums were fused by the compiler. */
dyd_status dyd_float_check(dyd_error *err);

#endif
