/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/number.c: leaves are of numbers that are there, and made where there is room. */
/* Without is_part_of_turn, value_circular: tried; that local numbers stay whole until they are cleared, or integers
   that polynomials are, stays unknown (is_part_of_turn_ensures, value_circular_call_mpz_clear_requires). */
/* Without value_tangent, value_hyperbolic, value_inverse: tried; that the block is still known afterwards stays
   unknown (their goals _ensures). */
/* Without value_extreme, value_operation, side_of_end: tried; CVC4 does not see that the relations are part of what
   changes (their goals _assigns). */
/* Without root_vanishes: tried; that coefficients stay whole in the loop stays unknown. */
/* Without value_power: takes a negative exponent modulo 2^64 where it negates it, on purpose, which is a conversion
   that loses something. */
/* Without value_radical, value_root, value_function, dyd_cert_number_value, is_radical, dyd_cert_number_check: not
   tried. */
#include "polys.h"

/* The number to be added is in its place behind those before. */
/*@ predicate known(numbers a) = \valid(a) && a->relations.count <= 64 && a->count < 4294967295 &&
      \valid(a->number + (0 .. a->count)) && \separated(a, a->number + (0 .. a->count)) &&
      (\forall integer k; 0 <= k < a->relations.count ==> a->leaf[k].number <= a->count) &&
      (\forall integer k; 0 <= k <= a->count ==> a->number[k].a <= a->count);
    predicate stays{K, L}(numbers a) = known{L}(a) && \at(a->number, L) == \at(a->number, K) &&
      \at(a->count, L) == \at(a->count, K); */

/*@ requires \valid(a) && a->relations.count <= 64 && a->count < 4294967295;
    assigns *a; exits \false;
    ensures \result < 64 ==> \result == \old(a->relations.count) && a->relations.count == \result + 1 &&
      a->leaf[\result].number == a->count && whole(&a->leaf[\result].bound[0]);
    ensures \result <= 64 && a->relations.count <= 64;
    ensures a->number == \old(a->number) && a->count == \old(a->count);
    ensures \result == 64 ==> a->relations.count == 64;
    ensures known{Pre}(a) ==> stays{Pre, Post}(a); */
size_t dyd_cert_algebra_leaf(dyd_cert_algebra *a);
/*@ requires known(a) && \valid_read(q); assigns a->number[0 .. a->count].now, a->number[0 .. a->count].p; exits \false;
    ensures \result == -1 || \result == 0 || \result == 1; */
int dyd_cert_poly_sign(dyd_cert_algebra *a, const dyd_cert_poly *q);
/*@ requires known(a) && k < a->count; assigns a->number[0 .. a->count].now, a->number[0 .. a->count].p; exits \false;
    ensures \result == -1 || \result == 0 || \result == 1; */
int dyd_cert_algebra_sign(dyd_cert_algebra *a, uint32_t k);

/*@ assigns \nothing; exits \false; */
static bool is_circular(dyd_cert_op op);
/*@ assigns \nothing; exits \false; */
static bool is_exponential(dyd_cert_op op);
/*@ requires known(a) && k < a->relations.count; assigns \nothing; exits \false; */
static bool is_leaf_of(const dyd_cert_algebra *a, size_t k, dyd_cert_op op);
/*@ requires known(a) && k < a->relations.count && \valid(sign) && \valid_read(u) && \separated(sign, a,
      a->number + (0 .. a->count));
    assigns *sign, a->relations.nomem, a->relations.work; exits \false; ensures -1 <= *sign <= 1; */
static bool operand_compare(int *sign, dyd_cert_algebra *a, size_t k, const dyd_cert_quotient *u);
/*@ requires known(a) && \valid(leaf) && \valid(sign) && \valid_read(u) && \separated(leaf, sign, a,
      a->number + (0 .. a->count));
    assigns *leaf, *sign, a->relations.nomem, a->relations.work; exits \false;
    ensures -1 <= *sign <= 1 && *leaf <= 64;
    ensures \result && *leaf < 64 ==> *leaf < a->relations.count; */
static bool find_leaf(size_t *leaf, int *sign, dyd_cert_algebra *a, dyd_cert_op op, const dyd_cert_quotient *u);
/*@ requires \valid(x) && \valid(a) && k < 64 && \separated(x, a); assigns *x, a->relations.nomem, a->relations.work;
    exits \false; */
static bool value_is_leaf(dyd_cert_quotient *x, dyd_cert_algebra *a, size_t k);
/*@ requires \valid(x) && known(a) && \separated(x, a);
    assigns *x, *a; exits \false; ensures stays{Pre, Post}(a); */
static bool value_makes_leaf(dyd_cert_quotient *x, dyd_cert_algebra *a);
/*@ requires \valid(x) && \valid(a) && \separated(x, a); assigns *x, a->relations.nomem, a->relations.work;
    exits \false; */
static bool value_set_si(dyd_cert_quotient *x, long z, dyd_cert_algebra *a);
/*@ requires \valid(a) && a->relations.count <= 64 && a->count < 4294967295;
    exits \false; ensures \result <= 64; */
static size_t make_angle(dyd_cert_algebra *a);
/*@ requires \valid(x) && known(a) && \valid_read(u) && \separated(x, a);
    assigns *x, *a; exits \false; ensures stays{Pre, Post}(a); */
static bool value_exponential(dyd_cert_quotient *x, dyd_cert_algebra *a, bool may, const dyd_cert_quotient *u);
/*@ requires known(a) && \valid_read(u) && (sign == 1 || sign == -1);
    assigns a->relations.nomem, a->relations.work, a->number[0 .. a->count].now, a->number[0 .. a->count].p;
    exits \false; */
static bool is_up_to_one(dyd_cert_algebra *a, const dyd_cert_quotient *u, int sign);
/*@ requires \valid(x) && known(a) && u < a->count && \separated(x, a);
    assigns *x, a->number[0 .. a->count].now, a->number[0 .. a->count].p; exits \false; */
static bool value_absolute(dyd_cert_quotient *x, dyd_cert_algebra *a, uint32_t u);
/*@ requires \valid(x) && known(a) && \separated(x, a);
    assigns *x, *a; exits \false; ensures stays{Pre, Post}(a); */
static bool value_e(dyd_cert_quotient *x, dyd_cert_algebra *a);
/*@ requires \valid(x) && known(a) && \separated(x, a);
    assigns *x, *a; exits \false; ensures stays{Pre, Post}(a); */
static bool value_pi(dyd_cert_quotient *x, dyd_cert_algebra *a);

#include "checker/number.c"
