/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra.c: names of operations, leaves are in their lists. */
#include "enclosures.h"
#include "polys.h"

typedef const dyd_cert_bracket *bracketed;

/*@ predicate bracket(bracketed r) = \valid(r) && r->count <= 1152921504606846976 &&
      (0 < r->count ==> \valid(r->coeff + (0 .. r->count - 1))) &&
      (\forall integer k; 0 <= k < r->count ==> whole(&r->coeff[k][0])) &&
      (\forall integer k; 0 <= k < 4 ==> whole(&r->end[k][0])) &&
      \separated(r, r->coeff + (0 .. r->count - 1)); */

/*@ requires r == \null || bracket(r);
    assigns r->coeff[0 .. r->count - 1][0], r->end[0 .. 3][0]; exits \false; */
static void root_free(dyd_cert_bracket *r);
/*@ requires \valid(x); assigns *x; exits \false; */
void dyd_cert_quotient_clear(dyd_cert_quotient *x);
/* What has to be there when numbers from k on are cleared. */
/*@ predicate clearable(numbers a, integer k) = \valid(a) && 0 <= k <= a->count <= 4294967295 &&
      (k < a->count ==> \valid(a->number + (k .. a->count - 1))) &&
      (\forall integer j; k <= j < a->count ==> a->number[j].root == \null || bracket(a->number[j].root)) &&
      a->relations.count <= 64 &&
      (\forall integer j; 0 <= j < a->relations.count ==> whole(&a->leaf[j].bound[0])) &&
      (0 < a->cosines ==> \valid(a->cosine + (0 .. a->cosines - 1)) && \separated(a, a->cosine + (0 .. a->cosines - 1))); */
/*@ requires \valid(n) && (n->root == \null || bracket(n->root)); exits \false;
    ensures \forall numbers a, integer k; \old(clearable(a, k) && n == a->number + k && k < a->count) ==>
      clearable(a, k + 1) && a->count == \old(a->count); */
void dyd_cert_number_clear(dyd_cert_number *n);

/*@ requires clearable(a, 0); exits \false; */
void dyd_cert_algebra_clear(dyd_cert_algebra *a);

/*@ requires 0 <= op < 29; assigns \nothing; exits \false; ensures 0 <= \result <= 2;
    ensures \result == (op == DYD_CERT_VALUE || DYD_CERT_PI <= op ? 0 : op <= DYD_CERT_MAX ? 2 : 1); */
int dyd_cert_op_operands(dyd_cert_op op);
/*@ requires 0 <= op < 29; assigns \nothing; exits \false; */
const char *dyd_cert_op_name(dyd_cert_op op);
/*@ requires \valid(a) && a->relations.count <= 64 && a->count < 4294967295; assigns *a; exits \false;
    ensures \result < 64 ==> \result == \old(a->relations.count) && a->relations.count == \result + 1;
    ensures \result <= 64 && a->relations.count <= 64 && a->count == \old(a->count);
    ensures \result == 64 ==> a->relations.count == 64;
    ensures \result < 64 ==> a->leaf[\result].number == a->count && whole(&a->leaf[\result].bound[0]);
    ensures a->number == \old(a->number); */
size_t dyd_cert_algebra_leaf(dyd_cert_algebra *a);

#include "checker/algebra.c"
