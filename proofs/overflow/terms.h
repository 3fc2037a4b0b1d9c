/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What poly.c and quotient.c keep of polynomials, and their contracts. Terms that a polynomial had, or gets, are no
 * part of what is said to change: nobody else has them. Where this is said, under the name `owned`, it is not proved:
 * WP does not know that new memory is new, and what is freed is no longer there. */
#ifndef DYD_PROOFS_TERMS_H
#define DYD_PROOFS_TERMS_H

#include "exact.h"

#include "checker/quotient.h"

typedef const dyd_cert_poly *polynomial;
typedef const dyd_cert_quotient *quotient;
typedef const dyd_cert_relations *relations;
typedef const uint16_t *exponents;

/* held: the terms are there, in memory of their own (listed), and are numbers; limited: and no more, nor greater
 * exponents, than sums and products take (low). beside: what counts the work is no part of p, which may be a rest in r.
 * not_in: what is at a base is not among the terms; distinct: two lists of terms are two. NEW: what p has got is not in
 * r, and what else is held stays, as said by `assigns`, in the words that callers need: its parts are named `owned`. */
#define held(p) (listed(p) && numbers_in(p))
#define limited(p) (held(p) && low(p))
#define NEW(p, r) owned: not_in(p, \base_addr(r)); \
  ensures owned: \forall polynomial s; \old(listed(s)) && \separated(s, p) && beside(s, r) ==> listed(s); \
  ensures owned: \forall polynomial s; \old(numbers_in(s)) && \separated(s, p) && beside(s, r) ==> numbers_in(s); \
  ensures owned: \forall polynomial s; \old(low(s)) && \separated(s, p) && beside(s, r) ==> low(s); \
  ensures owned: \forall polynomial s, char *b; \old(not_in(s, b)) && \separated(s, p) && beside(s, r) ==> not_in(s, \
      b); \
  ensures owned: \old(related(r)) && \separated(p, r) ==> related(r)
/*@ predicate few(exponents e) = \forall integer k; 0 <= k < 64 ==> e[k] <= 8192;
    predicate listed(polynomial p) = \valid_read(p) && p->count <= 32768 &&
      (0 < p->count ==> \valid(p->term + (0 .. p->count - 1)) && \base_addr(p->term) != \base_addr(p));
    predicate numbers_in(polynomial p) = \forall integer t; 0 <= t < p->count ==> integer_of(p->term[t].c[0].value);
    predicate low(polynomial p) = p->count <= 16384 &&
      (\forall integer t, k; 0 <= t < p->count && 0 <= k < 64 ==> p->term[t].e[k] <= 8192);
    predicate related(relations r) = \valid(r) && r->count <= 64 &&
      (\forall integer k; 0 <= k < r->count ==> limited(&r->leaf[k].rest));
    predicate beside(polynomial p, relations r) = \separated(p, &r->work) && \separated(p, &r->nomem) &&
      \separated(p, &r->count);
    predicate not_in(polynomial p, char *base) = 0 < p->count ==> \base_addr(p->term) != base;
    predicate distinct(polynomial p, polynomial q) =
      0 < p->count && 0 < q->count ==> \base_addr(p->term) != \base_addr(q->term);
    predicate unlike_rests(polynomial p, relations r) =
      \forall integer k; 0 <= k < r->count ==> distinct(p, &r->leaf[k].rest);
    predicate parts(quotient x) = \valid(x) && held(&x->num) && held(&x->den) && distinct(&x->num, &x->den); */

/*@ requires \valid(p); requires listed(p); requires numbers_in(p); assigns owned: p->term, p->count;
    exits \false; ensures listed(p); ensures numbers_in(p); ensures p->count == 0;
    ensures owned: \forall polynomial s; \old(listed(s)) && \separated(s, p) ==> listed(s);
    ensures owned: \forall polynomial s, char *b; \old(not_in(s, b)) && \separated(s, p) ==> not_in(s, b);
    ensures owned: \forall polynomial s; \old(numbers_in(s)) && \separated(s, p) ==> numbers_in(s);
    ensures owned: \forall polynomial s; \old(low(s)) && \separated(s, p) ==> low(s); */
void dyd_cert_poly_clear(dyd_cert_poly *p);
/*@ requires \valid(p); requires listed(p); requires numbers_in(p); requires listed(q); requires numbers_in(q);
      requires low(q); requires \valid(r) && \separated(p, q);
    requires beside(p, r); requires beside(q, r); requires not_in(q, \base_addr(p)); requires not_in(q, \base_addr(r));
    assigns owned: p->term, p->count, r->nomem, r->work;
    exits \false; ensures listed(p); ensures numbers_in(p); ensures \result ==> low(p); ensures NEW(p, r); */
bool dyd_cert_poly_set(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r);
/*@ requires \valid(p); requires listed(p); requires numbers_in(p); requires whole(z) && \valid(r) && beside(p, r)
      && \separated(p, z) && \separated(r, z);
    assigns owned: p->term, p->count, r->nomem; exits \false; ensures listed(p); ensures numbers_in(p); ensures
      \result ==> low(p);
    ensures NEW(p, r); */
bool dyd_cert_poly_set_z(dyd_cert_poly *p, mpz_srcptr z, dyd_cert_relations *r);
/*@ requires \valid(p); requires listed(p); requires numbers_in(p); requires leaf < 64 && \valid(r) && beside(p, r);
    assigns owned: p->term, p->count, r->nomem; exits \false; ensures listed(p); ensures numbers_in(p); ensures
      \result ==> low(p);
    ensures NEW(p, r); */
bool dyd_cert_poly_set_leaf(dyd_cert_poly *p, size_t leaf, dyd_cert_relations *r);
/*@ requires held(p) && held(q); assigns \nothing; exits \false; */
bool dyd_cert_poly_equal(const dyd_cert_poly *p, const dyd_cert_poly *q);
/*@ requires \valid_read(p); assigns \nothing; exits \false; ensures \result != 0 <==> p->count == 0; */
static inline bool dyd_cert_poly_is_zero(const dyd_cert_poly *p);
/*@ requires \valid(r); assigns r->work; exits \false; */
static inline bool dyd_cert_count_work(dyd_cert_relations *r, size_t work);
/*@ requires listed(p); requires numbers_in(p); assigns \nothing; exits \false;
    ensures \result != \null ==> p->count == 1 && \result == &p->term[0].c[0];
    ensures p->count == 1 ==> (\result != \null <==> \forall integer k; 0 <= k < 64 ==> p->term[0].e[k] == 0); */
mpz_srcptr dyd_cert_poly_integer(const dyd_cert_poly *p);
/*@ requires \valid(g) && whole(g) && held(p) && \separated(g, p) && not_in(p, \base_addr(g));
    assigns *g; exits \false; ensures whole(g); */
void dyd_cert_poly_content(mpz_ptr g, const dyd_cert_poly *p);
/*@ requires \valid(p); requires listed(p); requires numbers_in(p); requires whole(z) && sign(z) != 0 &&
      \separated(z, p) && not_in(p, \base_addr(z));
    assigns p->term[0 .. p->count - 1].c[0]; exits \false; ensures listed(p); ensures numbers_in(p); */
void dyd_cert_poly_divide(dyd_cert_poly *p, mpz_srcptr z);
/* c and m may be of a third polynomial. */
/*@ requires \valid(p); requires listed(p); requires numbers_in(p); requires p->count <= 16384; requires listed(q);
      requires numbers_in(q); requires low(q); requires \valid(r);
    requires \separated(p, q); requires beside(p, r); requires beside(q, r);
    requires distinct(p, q); requires not_in(p, \base_addr(q)); requires not_in(q, \base_addr(p));
    requires not_in(q, \base_addr(r)); requires not_in(p, \base_addr(r));
    requires whole(c); requires \separated(p, c); requires not_in(p, \base_addr(c));
    requires m != \null ==> \valid_read(m + (0 .. 63)); requires m != \null ==> few(m);
    requires m != \null ==> not_in(p, \base_addr(m));
    assigns owned: p->term, p->count, r->nomem, r->work; exits \false; ensures listed(p); ensures numbers_in(p);
    ensures \result && low{Pre}(p) ==> low(p); ensures NEW(p, r); */
bool dyd_cert_poly_add_scaled(dyd_cert_poly *p, const dyd_cert_poly *q, mpz_srcptr c, const uint16_t *m,
                              dyd_cert_relations *r);
/*@ requires \valid(p); requires listed(p); requires numbers_in(p); requires low(p); requires listed(q); requires
      numbers_in(q); requires low(q); requires \valid(r) && (sign == 1 || sign == -1);
    requires \separated(p, q); requires beside(p, r); requires beside(q, r);
    requires distinct(p, q); requires not_in(p, \base_addr(q)); requires not_in(q, \base_addr(p));
    requires not_in(q, \base_addr(r)); requires not_in(p, \base_addr(r));
    assigns owned: p->term, p->count, r->nomem, r->work;
    exits \false; ensures listed(p); ensures numbers_in(p); ensures \result ==> low(p); ensures NEW(p, r); */
bool dyd_cert_poly_add(dyd_cert_poly *p, const dyd_cert_poly *q, int sign, dyd_cert_relations *r);
/*@ requires \valid(p); requires listed(p); requires numbers_in(p); requires low(p); requires listed(q); requires
      numbers_in(q); requires low(q); requires related(r); requires p == q || \separated(p, q);
    requires beside(p, r); requires beside(q, r); requires not_in(p, \base_addr(r)); requires not_in(q, \base_addr(r));
    assigns owned: p->term, p->count, r->nomem, r->work;
    exits \false; ensures listed(p); ensures numbers_in(p); ensures \result ==> low(p); ensures NEW(p, r); */
bool dyd_cert_poly_mul(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r);

/* An assignment: see `copy` in overflow.py. */
/*@ requires \valid(to) && \valid_read(from) && \separated(to, from); assigns to->term, to->count; exits \false;
    ensures to->term == from->term && to->count == from->count;
    ensures \old(listed(from)) && \old(not_in(from, \base_addr(to))) ==> listed(to);
    ensures \old(numbers_in(from)) ==> numbers_in(to); ensures \old(low(from)) ==> low(to);
    ensures \forall char *b; \old(not_in(from, b)) ==> not_in(to, b);
    ensures \forall polynomial s; \old(listed(s)) && \separated(s, to) ==> listed(s);
    ensures \forall polynomial s; \old(numbers_in(s)) && \separated(s, to) ==> numbers_in(s); */
void copy_poly(dyd_cert_poly *to, const dyd_cert_poly *from);

#endif
