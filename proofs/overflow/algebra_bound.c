/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra_bound.c: degrees; leaves that are not whole may have none. */
/* Without dyd_cert_poly_bound, dyd_cert_poly_is_null: not tried. */
#include "polys.h"

/*@ predicate leaves(numbers a) = \valid_read(a) && a->relations.count <= 64 &&
      (\forall integer k; 0 <= k < a->relations.count ==>
        (a->leaf[k].whole ==> 1 <= a->relations.leaf[k].degree <= 1024) && poly(&a->relations.leaf[k].rest)); */

/*@ requires leaves(a) && poly(q); assigns \nothing; exits \false; ensures \result <= 16384; */
static unsigned long tower_degree(const dyd_cert_algebra *a, const dyd_cert_poly *q);
/*@ requires \valid_read(x) && whole(&x->lo[0]) && whole(&x->hi[0]) && 0 <= bits <= 16384 && 0 <= p <= 16384;
    assigns \nothing; exits \false; */
static bool enclosure_is_below(const dyd_cert_enclosure *x, long bits, long p);

#include "checker/algebra_bound.c"
