/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Polynomials in x, from expressions. */
#ifndef DYD_STREAM_POLY_H
#define DYD_STREAM_POLY_H

#include "stream/expr.h"

/* Coefficients, lowest degree first; a plain struct: init with {0}. */
typedef struct dyd_poly {
  mpq_t *coeff;
  size_t count;
} dyd_poly;

void dyd_poly_clear(dyd_poly *p);
/* Expands an expression in x. *out is empty before. DYD_E_PARSE when it is no polynomial with rational
 * coefficients, DYD_E_RANGE when it is too large; with column. */
dyd_status dyd_poly_expand(dyd_poly *out, const dyd_expr *e, dyd_error *err);

#endif
