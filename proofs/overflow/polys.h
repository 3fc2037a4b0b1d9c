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
      (\forall integer t; 0 <= t < p->count ==> whole(&p->term[t].c[0]) &&
        \forall integer k; 0 <= k < 64 ==> p->term[t].e[k] <= 4096);
    predicate cosines(numbers a) = \valid_read(a) && 0 <= a->cycle <= 1024 && a->cosines <= a->cycle &&
      (0 < a->cycle ==> \valid(a->cosine + (0 .. a->cycle - 1)) && \min(2, a->cycle) <= a->cosines &&
        \separated(a->cosine + (0 .. a->cycle - 1), a)); */

/*@ requires \valid(p) && \valid_read(q) && \valid(r) && p != q; assigns *p, r->nomem, r->work; exits \false; */
bool dyd_cert_poly_set(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r);
/*@ requires \valid(p) && whole(z) && \valid(r); assigns *p, r->nomem, r->work; exits \false; */
bool dyd_cert_poly_set_z(dyd_cert_poly *p, mpz_srcptr z, dyd_cert_relations *r);
/*@ requires \valid(p) && \valid_read(q) && \valid(r) && (sign == 1 || sign == -1) && p != q;
    assigns *p, r->nomem, r->work; exits \false; */
bool dyd_cert_poly_add(dyd_cert_poly *p, const dyd_cert_poly *q, int sign, dyd_cert_relations *r);
/*@ requires \valid(p) && \valid_read(q) && \valid(r); assigns *p, r->nomem, r->work; exits \false; */
bool dyd_cert_poly_mul(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r);
/*@ requires \valid(x) && whole(z) && \valid(r); assigns *x, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_mul_z(dyd_cert_quotient *x, mpz_srcptr z, dyd_cert_relations *r);

#endif
