/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers that are not rational in their operands: radicals, cosines and sines, roots of polynomials, free variables.
 *
 * All set x, an initialised fraction, and return false when the value is beyond the limits, or the ring became stale.
 */
#ifndef DYD_STREAM_ALGEBRA_LEAVES_H
#define DYD_STREAM_ALGEBRA_LEAVES_H

#include "stream/algebra/ring.h"

/* x = the real root of u, op DYD_OP_SQRT (u >= 0) or DYD_OP_CBRT. */
bool dyd_leaf_radical(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u);
/* x = cos u or sin u. */
bool dyd_leaf_cosine(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u);
/* x = the value of the form `node`, a root of a polynomial. */
bool dyd_leaf_root(dyd_fraction *x, dyd_ring *r, uint32_t node);
/* x = a free variable: op of u (which may be NULL) for equal operands the same, or the form `node`, if op is
 * DYD_OP_CONST. */
bool dyd_leaf_free(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u, uint32_t node);

#endif
