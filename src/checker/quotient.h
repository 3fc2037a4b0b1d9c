/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Quotients of polynomials in leaves: the values of numbers that a certificate describes. */
#ifndef DYD_CHECKER_QUOTIENT_H
#define DYD_CHECKER_QUOTIENT_H

#include "checker/poly.h"

/* Invariant: den is not 0 at the true leaves. */
typedef struct dyd_cert_quotient {
  dyd_cert_poly num, den;
} dyd_cert_quotient;

void dyd_cert_quotient_clear(dyd_cert_quotient *x);
/* Operands may be the same; false as for polynomials. Who divides knows that y is not 0. */
bool dyd_cert_quotient_set(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/* x = num / den, den > 0; x = leaf / den, den not 0 at the true leaves. */
bool dyd_cert_quotient_set_q(dyd_cert_quotient *x, mpz_srcptr num, mpz_srcptr den, dyd_cert_relations *r);
bool dyd_cert_quotient_set_leaf(dyd_cert_quotient *x, size_t leaf, const dyd_cert_poly *den, dyd_cert_relations *r);
/* x += sign y. */
bool dyd_cert_quotient_add(dyd_cert_quotient *x, int sign, const dyd_cert_quotient *y, dyd_cert_relations *r);
bool dyd_cert_quotient_mul(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
bool dyd_cert_quotient_mul_z(dyd_cert_quotient *x, mpz_srcptr z, dyd_cert_relations *r);
bool dyd_cert_quotient_div(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
bool dyd_cert_quotient_power(dyd_cert_quotient *x, unsigned long n, dyd_cert_relations *r);
/* *equal: the difference is reduced to 0. */
bool dyd_cert_quotient_equal(bool *equal, const dyd_cert_quotient *x, const dyd_cert_quotient *y,
                             dyd_cert_relations *r);
void dyd_cert_quotient_neg(dyd_cert_quotient *x);
void dyd_cert_quotient_invert(dyd_cert_quotient *x);

#endif
