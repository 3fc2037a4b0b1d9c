/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/number.c: leaves are of numbers that are there, and made where there is room. */
/* Without operand_compare, find_leaf, value_set_si, is_part_of_turn, value_circular, value_tangent,
   value_exponential, value_hyperbolic, value_radical, value_root, is_up_to_one, value_inverse, value_absolute,
   value_extreme, value_operation, value_power, value_function, value_e, value_pi, dyd_cert_number_value, is_radical,
   root_vanishes, side_of_end, dyd_cert_number_check: not tried. */
#include "polys.h"

/* The number to be added is in its place behind those before. */
/*@ predicate known(numbers a) = \valid(a) && a->relations.count <= 64 && a->count < 4294967295 &&
      \valid_read(a->number + (0 .. a->count)) && \separated(a, a->number + (0 .. a->count)) &&
      (\forall integer k; 0 <= k < a->relations.count ==> a->leaf[k].number <= a->count); */

/*@ requires \valid(a) && a->relations.count <= 64 && a->count < 4294967295; assigns *a; exits \false;
    ensures \result < 64 ==> \result == \old(a->relations.count) && a->relations.count == \result + 1;
    ensures \result <= 64 && a->relations.count <= 64 && a->count == \old(a->count);
    ensures \result == 64 ==> a->relations.count == 64; */
size_t dyd_cert_algebra_leaf(dyd_cert_algebra *a);
/*@ requires \valid(p); assigns *p; exits \false; */
void dyd_cert_poly_clear(dyd_cert_poly *p);
/*@ requires \valid(p) && leaf < 64 && \valid(r); assigns *p, r->nomem; exits \false; */
bool dyd_cert_poly_set_leaf(dyd_cert_poly *p, size_t leaf, dyd_cert_relations *r);
/*@ requires \valid(x) && leaf < 64 && \valid_read(den) && \valid(r); assigns *x, r->nomem, r->work; exits \false; */
bool dyd_cert_quotient_set_leaf(dyd_cert_quotient *x, size_t leaf, const dyd_cert_poly *den, dyd_cert_relations *r);

/*@ assigns \nothing; exits \false; */
static bool is_circular(dyd_cert_op op);
/*@ assigns \nothing; exits \false; */
static bool is_exponential(dyd_cert_op op);
/*@ requires known(a) && k < a->relations.count; assigns \nothing; exits \false; */
static bool is_leaf_of(const dyd_cert_algebra *a, size_t k, dyd_cert_op op);
/*@ requires \valid(x) && \valid(a) && k < 64 && \separated(x, a); assigns *x, a->relations.nomem, a->relations.work;
    exits \false; */
static bool value_is_leaf(dyd_cert_quotient *x, dyd_cert_algebra *a, size_t k);
/*@ requires \valid(x) && \valid(a) && \separated(x, a) && a->relations.count <= 64 && a->count < 4294967295;
    exits \false; */
static bool value_makes_leaf(dyd_cert_quotient *x, dyd_cert_algebra *a);
/*@ requires \valid(a) && a->relations.count <= 64 && a->count < 4294967295;
    exits \false; ensures \result <= 64; */
static size_t make_angle(dyd_cert_algebra *a);

#include "checker/number.c"
