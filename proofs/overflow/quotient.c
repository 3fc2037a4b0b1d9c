/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/quotient.c: terms stay in their lists. */
/* Without dyd_cert_quotient_set, dyd_cert_quotient_set_leaf, quotient_shorten: tried; that one polynomial of the
   quotient is held while the other is set or divided stays unknown (their goals _ensures, _requires). */
/* Without dyd_cert_quotient_set_q, dyd_cert_quotient_add, dyd_cert_quotient_mul, dyd_cert_quotient_mul_z,
   dyd_cert_quotient_div, dyd_cert_quotient_power, dyd_cert_quotient_equal: not tried, they call those. */
#include "terms.h"

/*@ requires parts(x); assigns owned: *x; exits \false; ensures parts(x);
    ensures x->num.count == 0 && x->den.count == 0; */
void dyd_cert_quotient_clear(dyd_cert_quotient *x);
/*@ requires parts(x) && within_limits(y) && \valid(r) && \separated(x, y, r) &&
      \separated(y->num.term + (0 .. y->num.count - 1), x, r) &&
      \separated(y->den.term + (0 .. y->den.count - 1), x, r);
    assigns owned: *x, r->nomem, r->work; exits \false; ensures held(&x->num) && held(&x->den);
    ensures \result ==> limited(&x->num) && limited(&x->den); */
bool dyd_cert_quotient_set(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires parts(x); assigns x->num.term[0 .. x->num.count - 1].c[0], x->den.term[0 .. x->den.count - 1].c[0];
    exits \false; ensures parts(x); */
static void quotient_shorten(dyd_cert_quotient *x);
/*@ requires parts(x) && leaf < 64 && limited(den) && \valid(r) && \separated(x, den, r) &&
      \separated(den->term + (0 .. den->count - 1), x, r);
    assigns owned: *x, r->nomem, r->work; exits \false; ensures held(&x->num) && held(&x->den);
    ensures \result ==> limited(&x->num) && limited(&x->den); */
bool dyd_cert_quotient_set_leaf(dyd_cert_quotient *x, size_t leaf, const dyd_cert_poly *den, dyd_cert_relations *r);
/*@ requires \valid(x) && x->num.count <= 16384 && (0 < x->num.count ==> \valid(x->num.term +
      (0 .. x->num.count - 1))) && (\forall integer k; 0 <= k < x->num.count ==> whole(&x->num.term[k].c[0])) &&
      \separated(x, x->num.term + (0 .. x->num.count - 1));
    assigns x->num.term[0 .. x->num.count - 1].c[0]; exits \false; */
void dyd_cert_quotient_neg(dyd_cert_quotient *x);
/*@ requires \valid(x); assigns *x; exits \false;
    ensures x->num == \old(x->den) && x->den == \old(x->num); */
void dyd_cert_quotient_invert(dyd_cert_quotient *x);

#include "checker/quotient.c"
