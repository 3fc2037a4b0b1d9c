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

/* held: the terms are there; limited: and no more of them, nor greater exponents, than sums and products take. */
/*@ predicate few(exponents e) = \forall integer k; 0 <= k < 64 ==> e[k] <= 8192;
    predicate held(polynomial p) = \valid_read(p) && p->count <= 32768 &&
      (0 < p->count ==> \valid(p->term + (0 .. p->count - 1)) && \separated(p->term + (0 .. p->count - 1), p)) &&
      (\forall integer t; 0 <= t < p->count ==> whole(&p->term[t].c[0]));
    predicate limited(polynomial p) = held(p) && p->count <= 16384 &&
      (\forall integer t, k; 0 <= t < p->count && 0 <= k < 64 ==> p->term[t].e[k] <= 8192);
    predicate related(relations r) = \valid(r) && r->count <= 64 &&
      (\forall integer k; 0 <= k < r->count ==> limited(&r->leaf[k].rest));
    predicate apart(polynomial p, relations r) = \separated(p, r) && \separated(p->term + (0 .. p->count - 1), r);
    predicate parts(quotient x) = \valid(x) && held(&x->num) && held(&x->den) &&
      \separated(x->num.term + (0 .. x->num.count - 1), x) && \separated(x->den.term + (0 .. x->den.count - 1), x) &&
      (0 < x->num.count && 0 < x->den.count ==>
        \separated(x->num.term + (0 .. x->num.count - 1), x->den.term + (0 .. x->den.count - 1)));
    predicate within_limits(quotient x) = parts(x) && limited(&x->num) && limited(&x->den); */

/*@ requires \valid(p) && held(p); assigns owned: p->term, p->count;
    exits \false; ensures held(p); ensures p->count == 0; */
void dyd_cert_poly_clear(dyd_cert_poly *p);
/*@ requires \valid(p) && held(p) && limited(q) && \valid(r) && \separated(p, q, r) &&
      \separated(q->term + (0 .. q->count - 1), p, r);
    assigns owned: p->term, p->count, r->nomem, r->work;
    exits \false; ensures held(p); ensures \result ==> limited(p); */
bool dyd_cert_poly_set(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r);
/*@ requires \valid(p) && held(p) && whole(z) && \valid(r) && \separated(p, r, z);
    assigns owned: p->term, p->count, r->nomem; exits \false; ensures held(p); ensures \result ==> limited(p); */
bool dyd_cert_poly_set_z(dyd_cert_poly *p, mpz_srcptr z, dyd_cert_relations *r);
/*@ requires \valid(p) && held(p) && leaf < 64 && \valid(r) && \separated(p, r);
    assigns owned: p->term, p->count, r->nomem; exits \false; ensures held(p); ensures \result ==> limited(p); */
bool dyd_cert_poly_set_leaf(dyd_cert_poly *p, size_t leaf, dyd_cert_relations *r);
/*@ requires held(p) && held(q); assigns \nothing; exits \false; */
bool dyd_cert_poly_equal(const dyd_cert_poly *p, const dyd_cert_poly *q);
/*@ requires \valid_read(p); assigns \nothing; exits \false; ensures \result != 0 <==> p->count == 0; */
static inline bool dyd_cert_poly_is_zero(const dyd_cert_poly *p);
/*@ requires \valid(r); assigns r->work; exits \false; */
static inline bool dyd_cert_count_work(dyd_cert_relations *r, size_t work);
/*@ requires held(p); assigns \nothing; exits \false;
    ensures \result != \null ==> p->count == 1 && \result == &p->term[0].c[0];
    ensures p->count == 1 ==> (\result != \null <==> \forall integer k; 0 <= k < 64 ==> p->term[0].e[k] == 0); */
mpz_srcptr dyd_cert_poly_integer(const dyd_cert_poly *p);
/*@ requires \valid(g) && whole(g) && held(p) && \separated(g, p, p->term + (0 .. p->count - 1));
    assigns *g; exits \false; ensures whole(g); */
void dyd_cert_poly_content(mpz_ptr g, const dyd_cert_poly *p);
/*@ requires \valid(p) && held(p) && whole(z) && sign(z) != 0 && \separated(z, p, p->term + (0 .. p->count - 1));
    assigns p->term[0 .. p->count - 1].c[0]; exits \false; ensures held(p); */
void dyd_cert_poly_divide(dyd_cert_poly *p, mpz_srcptr z);
/*@ requires \valid(p) && held(p) && limited(q) && whole(c) && \valid(r) && \separated(p, q) && \separated(p, r) &&
      \separated(q, &r->work) && \separated(q, &r->nomem) && \separated(q->term + (0 .. q->count - 1), p, &r->work) &&
      \separated(q->term + (0 .. q->count - 1), &r->nomem) && \separated(p->term + (0 .. p->count - 1), q) &&
      (0 < p->count && 0 < q->count ==> \separated(p->term + (0 .. p->count - 1), q->term + (0 .. q->count - 1)));
    requires p->count <= 16384 && (m == \null || \valid_read(m + (0 .. 63)) && few(m));
    assigns owned: p->term, p->count, r->nomem, r->work; exits \false; ensures held(p);
    ensures \result && limited{Pre}(p) ==> limited(p); */
bool dyd_cert_poly_add_scaled(dyd_cert_poly *p, const dyd_cert_poly *q, mpz_srcptr c, const uint16_t *m,
                              dyd_cert_relations *r);
/*@ requires \valid(p) && limited(p) && limited(q) && \valid(r) && \separated(p, q, r) && (sign == 1 || sign == -1) &&
      \separated(q->term + (0 .. q->count - 1), p, r) && \separated(p->term + (0 .. p->count - 1), q) &&
      (0 < p->count && 0 < q->count ==> \separated(p->term + (0 .. p->count - 1), q->term + (0 .. q->count - 1)));
    assigns owned: p->term, p->count, r->nomem, r->work;
    exits \false; ensures held(p); ensures \result ==> limited(p); */
bool dyd_cert_poly_add(dyd_cert_poly *p, const dyd_cert_poly *q, int sign, dyd_cert_relations *r);

#endif
