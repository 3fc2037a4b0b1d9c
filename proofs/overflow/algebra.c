/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra.c: names of operations, leaves are in their lists. */
/* Without root_free, dyd_cert_number_clear, dyd_cert_algebra_clear: not tried. */
#include "polys.h"

/*@ requires 0 <= op < 29; assigns \nothing; exits \false; ensures 0 <= \result <= 2; */
int dyd_cert_op_operands(dyd_cert_op op);
/*@ requires 0 <= op < 29; assigns \nothing; exits \false; */
const char *dyd_cert_op_name(dyd_cert_op op);
/*@ requires \valid(a) && a->relations.count <= 64 && a->count <= 4294967295; assigns *a; exits \false;
    ensures \result < 64 ==> \result == \old(a->relations.count) && a->relations.count == \result + 1;
    ensures \result <= 64 && a->relations.count <= 64 && a->count == \old(a->count);
    ensures \result == 64 ==> a->relations.count == 64; */
size_t dyd_cert_algebra_leaf(dyd_cert_algebra *a);

#include "checker/algebra.c"
