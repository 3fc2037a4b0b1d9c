/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Expressions in double interval arithmetic: the quick way to a first enclosure. */
#ifndef DYD_STREAM_EXPR_FILTER_H
#define DYD_STREAM_EXPR_FILTER_H

#include "stream/expr.h"

/* Finite doubles lo <= hi. */
typedef struct dyd_double_span {
  double lo, hi;
} dyd_double_span;

/* Encloses the value of e, which is then surely defined [FLT-EXPR]. false: doubles cannot tell, or e has a function
 * that is not computed here (cbrt, exp, log, trigonometric and hyperbolic ones). Ends are never -0. */
bool dyd_filter_expr(dyd_double_span *out, const dyd_expr *e);

/* The greatest b for which dyd_filter_round(., a, b) succeeds; INT64_MIN when there is none, INT64_MAX for a point. */
int64_t dyd_filter_bits(dyd_double_span a);
/* a rounded outward to multiples of 2^-(bits + 2), at most 2^-bits wide [FLT-GRID]; a itself when it is a point. false
 * when that is not so narrow, or bits is not within 0 .. 1000. */
bool dyd_filter_round(dyd_double_span *out, dyd_double_span a, int64_t bits);

#endif
