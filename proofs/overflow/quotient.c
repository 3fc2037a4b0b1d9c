/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/quotient.c: terms stay in their lists. */
#include "terms.h"

#define HELD(x) listed(&x->num); ensures listed(&x->den); ensures numbers_in(&x->num); ensures numbers_in(&x->den)
#define LIMITED(x) \result ==> low(&x->num); ensures \result ==> low(&x->den)
#define both(x) (held(&(x)->num) && held(&(x)->den))
#define both_limited(x) (\valid_read(x) && limited(&(x)->num) && limited(&(x)->den))
#define both_not_in(x, base) (not_in(&(x)->num, base) && not_in(&(x)->den, base))
#define NEW_BOTH(x, r) owned: both_not_in(x, \base_addr(r)); \
  ensures owned: \forall polynomial s; \old(listed(s)) && \separated(s, x) && beside(s, r) ==> listed(s); \
  ensures owned: \forall polynomial s; \old(numbers_in(s)) && \separated(s, x) && beside(s, r) ==> numbers_in(s); \
  ensures owned: \forall polynomial s; \old(low(s)) && \separated(s, x) && beside(s, r) ==> low(s); \
  ensures owned: \forall polynomial s, char *b; \old(not_in(s, b)) && \separated(s, x) && beside(s, r) ==> not_in(s, \
      b); \
  ensures owned: \old(related(r)) && \separated(x, r) ==> related(r)
#define LOW(x) listed(&x->num); requires listed(&x->den); requires numbers_in(&x->num); \
  requires numbers_in(&x->den); requires low(&x->num); requires low(&x->den)
#define unlike(x, r) (\base_addr(x) != \base_addr(r))
#define CHANGES(x) (x)->num.term, (x)->num.count, (x)->den.term, (x)->den.count

/*@ requires \valid(x) && both(x); assigns owned: CHANGES(x); exits \false; ensures HELD(x);
    ensures x->num.count == 0 && x->den.count == 0;
    ensures owned: \forall polynomial s; \old(listed(s)) && \separated(s, x) ==> listed(s);
    ensures owned: \forall polynomial s, char *b; \old(not_in(s, b)) && \separated(s, x) ==> not_in(s, b);
    ensures owned: \forall polynomial s; \old(numbers_in(s)) && \separated(s, x) ==> numbers_in(s);
    ensures owned: \forall polynomial s; \old(low(s)) && \separated(s, x) ==> low(s); */
void dyd_cert_quotient_clear(dyd_cert_quotient *x);
/*@ requires \valid(x) && both(x); requires both_limited(y); requires \valid(r) && \separated(x, y) && unlike(x, r)
      && unlike(y, r);
    requires both_not_in(y, \base_addr(x)); requires both_not_in(y, \base_addr(r));
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures HELD(x); ensures LIMITED(x);
    ensures NEW_BOTH(x, r); */
bool dyd_cert_quotient_set(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires parts(x); exits \false; ensures HELD(x);
    assigns x->num.term[0 .. x->num.count - 1].c[0].value, x->den.term[0 .. x->den.count - 1].c[0].value; */
static void quotient_shorten(dyd_cert_quotient *x);
/*@ requires \valid(x) && both(x) && whole(num) && whole(den) && sign(den) != 0 && \valid(r) && \separated(x, num)
      && \separated(r, num) && unlike(x, r) &&
      \separated(x, den) && \separated(r, den);
    assigns owned: CHANGES(x), r->nomem; exits \false; ensures HELD(x); ensures LIMITED(x);
    ensures NEW_BOTH(x, r); */
bool dyd_cert_quotient_set_q(dyd_cert_quotient *x, mpz_srcptr num, mpz_srcptr den, dyd_cert_relations *r);
/*@ requires \valid(x) && both(x) && leaf < 64 && limited(den) && \valid(r) && \separated(x, den) && unlike(x, r) &&
      beside(den, r) &&
      not_in(den, \base_addr(x)) && not_in(den, \base_addr(r));
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures HELD(x); ensures LIMITED(x); */
bool dyd_cert_quotient_set_leaf(dyd_cert_quotient *x, size_t leaf, const dyd_cert_poly *den, dyd_cert_relations *r);
/*@ requires \valid(x) && \valid_read(y); requires LOW(x); requires LOW(y); requires related(r) && (sign == 1 ||
      sign == -1);
    requires \separated(x, y) && unlike(x, r) && unlike(y, r); requires both_not_in(x, \base_addr(r)); requires
      both_not_in(y, \base_addr(r));
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures HELD(x); ensures LIMITED(x);
    ensures NEW_BOTH(x, r); */
bool dyd_cert_quotient_add(dyd_cert_quotient *x, int sign, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires \valid(x) && \valid_read(y); requires LOW(x); requires LOW(y); requires related(r);
    requires (x == y || \separated(x, y)) && unlike(x, r) && unlike(y, r);
    requires both_not_in(x, \base_addr(r)); requires both_not_in(y, \base_addr(r));
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures HELD(x); ensures LIMITED(x);
    ensures NEW_BOTH(x, r); */
bool dyd_cert_quotient_mul(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires \valid(x); requires LOW(x); requires \valid(r) && whole(z) && \separated(x, z) && \separated(r, z) &&
      unlike(x, r);
    requires both_not_in(x, \base_addr(r));
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures HELD(x); ensures LIMITED(x); */
bool dyd_cert_quotient_mul_z(dyd_cert_quotient *x, mpz_srcptr z, dyd_cert_relations *r);
/*@ requires \valid(x) && \valid_read(y); requires LOW(x); requires LOW(y); requires related(r);
    requires \separated(x, y) && unlike(x, r) && unlike(y, r); requires both_not_in(x, \base_addr(r)); requires
      both_not_in(y, \base_addr(r));
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures HELD(x); ensures LIMITED(x); */
bool dyd_cert_quotient_div(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires \valid(x); requires LOW(x); requires related(r); requires unlike(x, r);
    requires both_not_in(x, \base_addr(r));
    assigns owned: CHANGES(x), r->nomem, r->work; exits \false; ensures HELD(x); ensures LIMITED(x); */
bool dyd_cert_quotient_power(dyd_cert_quotient *x, unsigned long n, dyd_cert_relations *r);
/*@ requires \valid(equal) && both_limited(x); requires both_limited(y); requires related(r);
    requires \separated(equal, x, r) && \separated(equal, y) && unlike(x, r) && unlike(y, r);
    requires both_not_in(x, \base_addr(r)); requires both_not_in(y, \base_addr(r));
    assigns owned: *equal, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_equal(bool *equal, const dyd_cert_quotient *x, const dyd_cert_quotient *y,
                             dyd_cert_relations *r);
/*@ requires \valid(x) && x->num.count <= 16384 && (0 < x->num.count ==> \valid(x->num.term +
      (0 .. x->num.count - 1))) && (\forall integer k; 0 <= k < x->num.count ==> whole(&x->num.term[k].c[0])) &&
      \separated(x, x->num.term + (0 .. x->num.count - 1));
    assigns x->num.term[0 .. x->num.count - 1].c[0]; exits \false; */
void dyd_cert_quotient_neg(dyd_cert_quotient *x);
/*@ requires \valid(x); assigns x->num, x->den; exits \false;
    ensures x->num == \old(x->den) && x->den == \old(x->num);
    ensures \old(listed(&x->den)) ==> listed(&x->num); ensures \old(listed(&x->num)) ==> listed(&x->den);
    ensures \old(numbers_in(&x->den)) ==> numbers_in(&x->num);
    ensures \old(numbers_in(&x->num)) ==> numbers_in(&x->den);
    ensures \old(low(&x->den)) ==> low(&x->num); ensures \old(low(&x->num)) ==> low(&x->den);
    ensures \forall polynomial s; \old(listed(s)) && \separated(s, x) ==> listed(s);
    ensures \forall polynomial s; \old(numbers_in(s)) && \separated(s, x) ==> numbers_in(s);
    ensures \forall polynomial s, char *b; \old(not_in(s, b)) && \separated(s, x) ==> not_in(s, b);
    ensures \forall polynomial s; \old(low(s)) && \separated(s, x) ==> low(s);
    ensures \forall char *base; \old(both_not_in(x, base)) ==> both_not_in(x, base);
    ensures \forall relations r; \old(related(r)) && \separated(x, r) ==> related(r); */
void dyd_cert_quotient_invert(dyd_cert_quotient *x);
/*@ requires \valid(to) && \valid_read(from) && \separated(to, from); assigns CHANGES(to); exits \false;
    ensures to->num.term == from->num.term && to->num.count == from->num.count;
    ensures to->den.term == from->den.term && to->den.count == from->den.count;
    ensures listed(&from->num) && not_in(&from->num, \base_addr(to)) ==> listed(&to->num);
    ensures numbers_in(&from->num) ==> numbers_in(&to->num); ensures low(&from->num) ==> low(&to->num);
    ensures listed(&from->den) && not_in(&from->den, \base_addr(to)) ==> listed(&to->den);
    ensures numbers_in(&from->den) ==> numbers_in(&to->den); ensures low(&from->den) ==> low(&to->den);
    ensures \forall char *b; both_not_in(from, b) ==> both_not_in(to, b);
    ensures \forall polynomial s; \old(listed(s)) && \separated(s, to) ==> listed(s);
    ensures \forall polynomial s; \old(numbers_in(s)) && \separated(s, to) ==> numbers_in(s);
    ensures \forall polynomial s; \old(low(s)) && \separated(s, to) ==> low(s);
    ensures \forall polynomial s, char *b; \old(not_in(s, b)) && \separated(s, to) ==> not_in(s, b);
    ensures \forall relations r; \old(related(r)) && \separated(to, r) ==> related(r); */
void copy_quotient(dyd_cert_quotient *to, const dyd_cert_quotient *from);

#include "checker/quotient.c"
