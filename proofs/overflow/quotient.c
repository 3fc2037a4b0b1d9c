/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/quotient.c: terms stay in their lists. */
/* Without dyd_cert_quotient_clear, dyd_cert_quotient_set, quotient_shorten, dyd_cert_quotient_set_q,
   dyd_cert_quotient_set_leaf, dyd_cert_quotient_add, dyd_cert_quotient_mul, dyd_cert_quotient_mul_z,
   dyd_cert_quotient_div, dyd_cert_quotient_power, dyd_cert_quotient_equal: not tried. */
#include "polys.h"

/*@ requires \valid(x) && x->num.count <= 16384 && (0 < x->num.count ==> \valid(x->num.term +
      (0 .. x->num.count - 1))) && (\forall integer k; 0 <= k < x->num.count ==> whole(&x->num.term[k].c[0])) &&
      \separated(x, x->num.term + (0 .. x->num.count - 1));
    assigns x->num.term[0 .. x->num.count - 1].c[0]; exits \false; */
void dyd_cert_quotient_neg(dyd_cert_quotient *x);
/*@ requires \valid(x); assigns *x; exits \false;
    ensures x->num == \old(x->den) && x->den == \old(x->num); */
void dyd_cert_quotient_invert(dyd_cert_quotient *x);

#include "checker/quotient.c"
