/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Expressions in double interval arithmetic: the quick way to a first enclosure. */
#ifndef DYD_STREAM_EXPR_FILTER_H
#define DYD_STREAM_EXPR_FILTER_H

#include "stream/expr.h"
#include "stream/span_filter.h"

/* Encloses the value of e, which is then certainly defined [FLT-EXPR]. Returns false if doubles cannot decide, or e has
 * a function that is not computed here (cbrt, exp, log, trigonometric and hyperbolic ones). Ends are never -0. */
bool dyd_filter_expr(dyd_double_span *out, const dyd_expr *e);

#endif
