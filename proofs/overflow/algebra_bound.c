/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra_bound.c: degrees; leaves that are not whole may have none. */
#include "enclosures.h"
#include "polys.h"

/*@ predicate leaves(numbers a) = \valid_read(a) && a->relations.count <= 64 &&
      (\forall integer k; 0 <= k < a->relations.count ==>
        (a->leaf[k].whole ==> 1 <= a->relations.leaf[k].degree <= 1024) && poly(&a->relations.leaf[k].rest));
    predicate bounded(numbers a) = \valid_read(a) && a->relations.count <= 64 &&
      (\forall integer k; 0 <= k < a->relations.count ==> whole(&a->leaf[k].bound[0])); */

/*@ requires leaves(a) && poly(q); assigns \nothing; exits \false; ensures \result <= 16384; */
static unsigned long tower_degree(const dyd_cert_algebra *a, const dyd_cert_poly *q);
/*@ requires \valid_read(x) && whole(&x->lo[0]) && whole(&x->hi[0]) && 0 <= bits <= 16384 && 0 <= p <= 16384;
    assigns \nothing; exits \false; */
static bool enclosure_is_below(const dyd_cert_enclosure *x, long bits, long p);
/*@ requires \valid(out) && whole(out) && bounded(a) && poly(q) && \separated(out, a) &&
      \separated(out, q, q->term + (0 .. q->count - 1));
    assigns out->value;
    exits \false; ensures whole(out); */
bool dyd_cert_poly_bound(mpz_ptr out, const dyd_cert_algebra *a, const dyd_cert_poly *q);
/*@ requires \valid_read(p); assigns \nothing; exits \false; */
static inline bool dyd_cert_poly_is_zero(const dyd_cert_poly *p);
/*@ requires \valid(a) && \valid(out) && interval(out) && \valid_read(q) && 64 <= p <= 16384 && \separated(out, a, q);
    assigns *out, a->relations.work, a->number[0 .. a->count]; exits \false; ensures interval(out); */
void dyd_cert_poly_enclose(dyd_cert_enclosure *out, dyd_cert_algebra *a, const dyd_cert_poly *q, long p);
/*@ requires \valid(a) && leaves(a) && bounded(a) && poly(q) &&
      \separated(a, q, a->number + (0 .. a->count)); exits \false; */
bool dyd_cert_poly_is_null(dyd_cert_algebra *a, const dyd_cert_poly *q);

#include "checker/algebra_bound.c"
