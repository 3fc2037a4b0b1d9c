/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/quotient.c: terms stay in their lists. */
/* Without dyd_cert_quotient_set: 6 of 7 goals are proved; Timeout in 12 s: what the second dyd_cert_poly_set
   requires. */
/* Without dyd_cert_quotient_mul: Timeout in 5 s: _ensures. What dyd_cert_poly_mul requires is not said in terms.h. */
/* Without dyd_cert_quotient_add: Timeout in 5 s: _ensures, _ensures_2, _exits and the conditions of
   dyd_cert_poly_add, quotient_shorten and dyd_cert_poly_clear, after calls of dyd_cert_poly_mul, which has no
   contract in terms.h. */
/* Without dyd_cert_quotient_mul_z, dyd_cert_quotient_div, dyd_cert_quotient_power, dyd_cert_quotient_equal: 5 of 8,
   6 of 8, 4 of 11 and 9 of 10 goals are proved in 5 s; open are their ensures and the conditions of quotient_shorten
   and of those before, of which nothing is known. */
#include "terms.h"

#define CHANGES(x) x->num.term, x->num.count, x->den.term, x->den.count

/*@ predicate both(quotient x) = \valid_read(x) && held(&x->num) && held(&x->den);
    predicate both_limited(quotient x) = \valid_read(x) && limited(&x->num) && limited(&x->den);
    predicate elsewhere(quotient x, quotient y) = \separated(x->num.term + (0 .. x->num.count - 1), y) &&
      \separated(x->den.term + (0 .. x->den.count - 1), y);
    predicate unrelated(quotient x, relations r) = \separated(x, r) &&
      \separated(x->num.term + (0 .. x->num.count - 1), r) && \separated(x->den.term + (0 .. x->den.count - 1), r); */

/*@ requires \valid(x) && both(x); assigns owned: CHANGES(x); exits \false; ensures both(x);
    ensures x->num.count == 0 && x->den.count == 0; */
void dyd_cert_quotient_clear(dyd_cert_quotient *x);
/*@ requires \valid(x) && both(x) && both_limited(y) && \valid(r) && \separated(x, y, r) && elsewhere(y, x) &&
      unrelated(y, r);
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures both(x); ensures \result ==> both_limited(x);
    ensures owned: elsewhere(x, x) && elsewhere(x, y) && unrelated(x, r); */
bool dyd_cert_quotient_set(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires parts(x); exits \false; ensures both(x); ensures both_limited{Pre}(x) ==> both_limited(x);
    assigns x->num.term[0 .. x->num.count - 1].c[0].value, x->den.term[0 .. x->den.count - 1].c[0].value; */
static void quotient_shorten(dyd_cert_quotient *x);
/*@ requires \valid(x) && both(x) && whole(num) && whole(den) && sign(den) != 0 && \valid(r) && \separated(x, r, num) &&
      \separated(x, r, den);
    assigns owned: CHANGES(x), r->nomem; exits \false; ensures both(x); ensures \result ==> both_limited(x); */
bool dyd_cert_quotient_set_q(dyd_cert_quotient *x, mpz_srcptr num, mpz_srcptr den, dyd_cert_relations *r);
/*@ requires \valid(x) && both(x) && leaf < 64 && limited(den) && \valid(r) && \separated(x, den, r) &&
      \separated(den->term + (0 .. den->count - 1), x, r);
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures both(x); ensures \result ==> both_limited(x); */
bool dyd_cert_quotient_set_leaf(dyd_cert_quotient *x, size_t leaf, const dyd_cert_poly *den, dyd_cert_relations *r);
/*@ requires \valid(x) && both_limited(x) && both_limited(y) && related(r) && unrelated(x, r) && unrelated(y, r) &&
      (sign == 1 || sign == -1) && \separated(x, y) && elsewhere(x, y) && elsewhere(y, x);
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures both(x); ensures \result ==> both_limited(x); */
bool dyd_cert_quotient_add(dyd_cert_quotient *x, int sign, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires \valid(x) && both_limited(x) && both_limited(y) && related(r) && unrelated(x, r) && unrelated(y, r) &&
      (x == y || \separated(x, y)) && elsewhere(x, y) && elsewhere(y, x);
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures both(x); ensures \result ==> both_limited(x); */
bool dyd_cert_quotient_mul(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires \valid(x) && both_limited(x) && whole(z) && related(r) && unrelated(x, r) && elsewhere(x, x);
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures both(x); ensures \result ==> both_limited(x); */
bool dyd_cert_quotient_mul_z(dyd_cert_quotient *x, mpz_srcptr z, dyd_cert_relations *r);
/*@ requires \valid(x) && both_limited(x) && both_limited(y) && related(r) && unrelated(x, r) && unrelated(y, r) &&
      \separated(x, y) && elsewhere(x, y) && elsewhere(y, x);
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures both(x); */
bool dyd_cert_quotient_div(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires \valid(x) && both_limited(x) && related(r) && unrelated(x, r) && elsewhere(x, x);
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures both(x); ensures \result ==> both_limited(x); */
bool dyd_cert_quotient_power(dyd_cert_quotient *x, unsigned long n, dyd_cert_relations *r);
/*@ requires \valid(equal) && both_limited(x) && both_limited(y) && related(r) && unrelated(x, r) && unrelated(y, r) &&
      \separated(equal, x, r) && \separated(equal, y);
    assigns owned: *equal, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_equal(bool *equal, const dyd_cert_quotient *x, const dyd_cert_quotient *y,
                             dyd_cert_relations *r);
/*@ requires \valid(x) && x->num.count <= 16384 && (0 < x->num.count ==> \valid(x->num.term +
      (0 .. x->num.count - 1))) && (\forall integer k; 0 <= k < x->num.count ==> whole(&x->num.term[k].c[0])) &&
      \separated(x, x->num.term + (0 .. x->num.count - 1));
    assigns x->num.term[0 .. x->num.count - 1].c[0]; exits \false; */
void dyd_cert_quotient_neg(dyd_cert_quotient *x);
/*@ requires \valid(x); assigns *x; exits \false;
    ensures x->num == \old(x->den) && x->den == \old(x->num); */
void dyd_cert_quotient_invert(dyd_cert_quotient *x);

#include "checker/quotient.c"
