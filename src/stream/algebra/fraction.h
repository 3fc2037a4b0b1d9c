/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Fractions of polynomials in the leaves. */
#ifndef DYD_STREAM_ALGEBRA_FRACTION_H
#define DYD_STREAM_ALGEBRA_FRACTION_H

#include "stream/algebra/ring.h"

void dyd_fraction_set(dyd_fraction *x, const dyd_fraction *y, const dyd_ring *r);
/* x = the rational number num / den, den != 0. */
void dyd_fraction_set_number(dyd_fraction *x, const fmpz_t num, const fmpz_t den, const dyd_ring *r);
/* x = leaf k / den, den > 0. */
void dyd_fraction_set_leaf(dyd_fraction *x, slong k, const fmpz_t den, const dyd_ring *r);
/* x = x op y, op one of + - * /; x = x^n. Operands may be the same. false: beyond the limits, or a division by what is
 * 0 as far as can be seen; x is unspecified then. */
bool dyd_fraction_apply(dyd_fraction *x, dyd_op op, const dyd_fraction *y, const dyd_ring *r);
bool dyd_fraction_power(dyd_fraction *x, slong n, const dyd_ring *r);
/* Divides out common integer factors; the leading coefficient of the denominator becomes positive. */
void dyd_fraction_lowest(dyd_fraction *x, const dyd_ring *r);
bool dyd_fraction_equal(const dyd_fraction *x, const dyd_fraction *y, const dyd_ring *r);
/* Is it a rational number? Then num / den in lowest terms, den > 0. */
bool dyd_fraction_get_number(fmpz_t num, fmpz_t den, const dyd_fraction *x, const dyd_ring *r);
/* Is the leading coefficient of the numerator negative? */
static inline bool dyd_fraction_leads_negative(const dyd_fraction *x) {
  return x->num->length && fmpz_sgn(x->num->coeffs) < 0;
}

#endif
