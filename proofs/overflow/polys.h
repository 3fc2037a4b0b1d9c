/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of polynomials and of the numbers of a block; contracts of src/checker/poly.h and quotient.h as callers
 * need them: of their callees only what poly.c proves is proved. */
#ifndef DYD_PROOFS_POLYS_H
#define DYD_PROOFS_POLYS_H

#include "read.h"

#include "checker/algebra.h"

typedef const dyd_cert_poly *polynomial;
typedef const dyd_cert_algebra *numbers;

/*@ predicate poly(polynomial p) = \valid_read(p) && p->count <= 16384 &&
      (0 < p->count ==> \valid_read(p->term + (0 .. p->count - 1))) &&
      (\forall integer t; 0 <= t < p->count ==> whole(&p->term[t].c[0])) &&
      (\forall integer t, k; 0 <= t < p->count && 0 <= k < 64 ==> p->term[t].e[k] <= 4096);
    predicate cosines(numbers a) = \valid_read(a) && 0 <= a->cycle <= 1024 && a->cosines <= a->cycle &&
      (0 < a->cycle ==> \valid(a->cosine + (0 .. a->cycle - 1)) && \min(2, a->cycle) <= a->cosines &&
        \separated(a->cosine + (0 .. a->cycle - 1), a)); */

/* Of poly.c and quotient.c, as others call them: that polynomials are what these two files keep (terms.h) is no
 * condition here, nor that terms are there; what they change is. */
/*@ requires \valid(r); assigns r->work; exits \false; */
static inline bool dyd_cert_count_work(dyd_cert_relations *r, size_t work);
/*@ requires \valid(p); assigns *p; exits \false; ensures p->count == 0; */
void dyd_cert_poly_clear(dyd_cert_poly *p);
/*@ requires \valid(p) && \valid_read(q) && \valid(r) && p != q; assigns *p, r->nomem, r->work; exits \false; */
bool dyd_cert_poly_set(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r);
/*@ requires \valid(p) && whole(z) && \valid(r); assigns *p, r->nomem, r->work; exits \false; */
bool dyd_cert_poly_set_z(dyd_cert_poly *p, mpz_srcptr z, dyd_cert_relations *r);
/*@ requires \valid(p) && leaf < 64 && \valid(r); assigns *p, r->nomem; exits \false; */
bool dyd_cert_poly_set_leaf(dyd_cert_poly *p, size_t leaf, dyd_cert_relations *r);
/*@ requires \valid(p) && \valid_read(q) && whole(c) && \valid(r) && p != q && (m == \null ||
      \valid_read(m + (0 .. 63)) && (\forall integer k; 0 <= k < 64 ==> m[k] <= 8192));
    assigns *p, r->nomem, r->work; exits \false; */
bool dyd_cert_poly_add_scaled(dyd_cert_poly *p, const dyd_cert_poly *q, mpz_srcptr c, const uint16_t *m,
                              dyd_cert_relations *r);
/*@ requires \valid(p) && \valid_read(q) && \valid(r) && (sign == 1 || sign == -1) && p != q;
    assigns *p, r->nomem, r->work; exits \false; */
bool dyd_cert_poly_add(dyd_cert_poly *p, const dyd_cert_poly *q, int sign, dyd_cert_relations *r);
/*@ requires \valid(p) && \valid_read(q) && \valid(r); assigns *p, r->nomem, r->work; exits \false; */
bool dyd_cert_poly_mul(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r);
/*@ requires \valid(p) && \valid(r) && r->count <= 64; assigns *p, r->nomem, r->work; exits \false; */
bool dyd_cert_poly_reduce(dyd_cert_poly *p, dyd_cert_relations *r);
/*@ requires \valid_read(p); assigns \nothing; exits \false; ensures \result != 0 <==> p->count == 0; */
static inline bool dyd_cert_poly_is_zero(const dyd_cert_poly *p);
/*@ predicate constant(polynomial p) = p->count == 1 && \forall integer k; 0 <= k < 64 ==> p->term[0].e[k] == 0; */
/*@ requires \valid_read(p); assigns \nothing; exits \false;
    ensures \result != \null <==> constant(p);
    ensures \result != \null ==> p->count == 1 && \result == &p->term[0].c[0] && whole(\result) &&
      sign(\result) != 0; */
mpz_srcptr dyd_cert_poly_integer(const dyd_cert_poly *p);
/*@ requires \valid(p) && \valid(end) && string(text) && \valid(r) && \separated(p, end, r);
    assigns *p, *end, r->nomem; exits \false;
    ensures within(*end, text) && *end - text <= stop(text) + 1; ensures \result ==> string(*end); */
bool dyd_cert_poly_scan(dyd_cert_poly *p, const char **end, const char *text, dyd_cert_relations *r);

/*@ requires \valid(x); assigns *x; exits \false; ensures x->num.count == 0 && x->den.count == 0; */
void dyd_cert_quotient_clear(dyd_cert_quotient *x);
/*@ requires \valid(x) && \valid_read(y) && \valid(r) && x != y; assigns *x, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_set(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires \valid(x) && whole(num) && whole(den) && sign(den) != 0 && \valid(r);
    assigns *x, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_set_q(dyd_cert_quotient *x, mpz_srcptr num, mpz_srcptr den, dyd_cert_relations *r);
/*@ requires \valid(x) && leaf < 64 && \valid_read(den) && \valid(r); assigns *x, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_set_leaf(dyd_cert_quotient *x, size_t leaf, const dyd_cert_poly *den, dyd_cert_relations *r);
/*@ requires \valid(x) && \valid_read(y) && \valid(r) && (sign == 1 || sign == -1) && x != y;
    assigns *x, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_add(dyd_cert_quotient *x, int sign, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires \valid(x) && \valid_read(y) && \valid(r); assigns *x, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_mul(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires \valid(x) && whole(z) && \valid(r); assigns *x, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_mul_z(dyd_cert_quotient *x, mpz_srcptr z, dyd_cert_relations *r);
/*@ requires \valid(x) && \valid_read(y) && \valid(r); assigns *x, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_div(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r);
/*@ requires \valid(x) && \valid(r); assigns *x, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_power(dyd_cert_quotient *x, unsigned long n, dyd_cert_relations *r);
/*@ requires \valid(equal) && \valid_read(x) && \valid_read(y) && \valid(r);
    assigns *equal, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_equal(bool *equal, const dyd_cert_quotient *x, const dyd_cert_quotient *y,
                             dyd_cert_relations *r);
/*@ requires \valid(x); assigns *x; exits \false; */
void dyd_cert_quotient_neg(dyd_cert_quotient *x);
/*@ requires \valid(x); assigns *x; exits \false; ensures x->num == \old(x->den) && x->den == \old(x->num); */
void dyd_cert_quotient_invert(dyd_cert_quotient *x);

#endif
