/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra_enclose.c: operations on intervals, precisions up to 2^30. */
/* Unproved enclose_operation_assigns_exit_part5, enclose_operation_assigns_exit_part6,
   enclose_operation_assigns_normal_part5, enclose_operation_assigns_normal_part6: WP counts what `?:` gives, the sign
   handed to dyd_cert_enclosure_extreme, as memory that is assigned. */
#include "enclosures.h"
#include "polys.h"

/*@ requires \valid(x) && interval(x) && few(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
static void enclose_cosine(dyd_cert_enclosure *x, dyd_cert_op op, long p);
/*@ requires \valid(x) && interval(x) && few(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
static void enclose_hyperbolic(dyd_cert_enclosure *x, dyd_cert_op op, long p);
/*@ requires \valid(x) && interval(x) && few(p) && 1 <= n <= 1024; assigns ALL_OF(x); exits \false;
    ensures interval(x); */
static void enclose_cycle(dyd_cert_enclosure *x, long n, long p);
/*@ requires \valid(x) && interval(x) && few(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
static void enclose_e(dyd_cert_enclosure *x, long p);
/*@ requires \valid(x) && interval(x) && few(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
static void enclose_inverse(dyd_cert_enclosure *x, dyd_cert_op op, long p);
/*@ requires \valid(x) && interval(x) && \valid_read(n) && few(p) && (x == &n->now || \separated(n, x));
    assigns ALL_OF(x); exits \false; ensures interval(x); */
static void enclose_function(dyd_cert_enclosure *x, const dyd_cert_number *n, long p);
/*@ requires \valid(x) && interval(x) && interval(y) && alone(x, y) && few(p); assigns ALL_OF(x); exits \false;
    ensures interval(x); */
static void enclose_operation(dyd_cert_enclosure *x, dyd_cert_op op, const dyd_cert_enclosure *y, long p);
/* The block: numbers are made of those before, leaves are of numbers, roots are in brackets. LAST: the last number;
 * while a number is read, this is the one to be added, in its place behind those before. */
/*@ axiomatic Last { logic integer LAST; axiom last: -1 <= LAST <= 4194304; }
    predicate block(numbers a) = \valid(a) && a->relations.count <= 64 && a->count - 1 <= LAST <= a->count &&
      \valid(a->number + (0 .. LAST)) && \separated(a, a->number + (0 .. LAST)) &&
      (\forall integer k; 0 <= k < a->relations.count ==> a->leaf[k].number <= LAST) &&
      (\forall integer k; 0 <= k <= LAST ==> a->number[k].a <= LAST && a->number[k].b <= LAST &&
        interval(&a->number[k].now));
    predicate stays{K, L}(numbers a) = block{L}(a) && \at(a->number, L) == \at(a->number, K) &&
      \at(a->count, L) == \at(a->count, K) && \at(a->relations.count, L) == \at(a->relations.count, K);
    predicate elsewhere(interval_of x, numbers a) = \base_addr(x) != \base_addr(a) &&
      \base_addr(x) != \base_addr(a->number); */
#define NUMBERS_OF(a) a->relations.work, a->number[0 .. LAST].p, a->number[0 .. LAST].now.lo[0].value, \
  a->number[0 .. LAST].now.hi[0].value, a->number[0 .. LAST].now.known

/*@ requires 0 <= op < 29; assigns \nothing; exits \false; ensures 0 <= \result <= 2; */
int dyd_cert_op_operands(dyd_cert_op op);
/*@ requires block(a) && k <= LAST && 64 <= p <= 16384; assigns NUMBERS_OF(a); exits \false;
    ensures stays{Pre, Post}(a); ensures \result == &a->number[k].now && interval(\result); */
const dyd_cert_enclosure *dyd_cert_algebra_enclose(dyd_cert_algebra *a, uint32_t k, long p);
#define SAME_LISTS(a) (a->number == \at(a->number, Pre) && a->count == \at(a->count, Pre) && \
  a->relations.count == \at(a->relations.count, Pre))
/* What is made may be one of the block's numbers, or is apart from it. */
#define OF_BLOCK(x, a) (elsewhere(x, a) || \exists integer k; 0 <= k <= LAST && x == &a->number[k].now)
/*@ requires \valid(out) && interval(out) && block(a) && OF_BLOCK(out, a) && \valid_read(q) && 64 <= p <= 16384;
    assigns ALL_OF(out), NUMBERS_OF(a); exits \false; ensures interval(out); ensures stays{Pre, Post}(a); */
void dyd_cert_poly_enclose(dyd_cert_enclosure *out, dyd_cert_algebra *a, const dyd_cert_poly *q, long p);
/*@ requires \valid(x) && interval(x) && block(a) && \valid_read(v) &&
      (\exists integer k; 0 <= k <= LAST && x == &a->number[k].now) && 64 <= p <= 16384;
    assigns ALL_OF(x), NUMBERS_OF(a); exits \false; ensures interval(x); ensures stays{Pre, Post}(a); */
static void enclose_value(dyd_cert_enclosure *x, dyd_cert_algebra *a, const dyd_cert_quotient *v, long p);
/*@ requires \valid(out) && interval(out) && elsewhere(out, a) && block(a) && k < a->relations.count &&
      64 <= p <= 16384;
    assigns ALL_OF(out), NUMBERS_OF(a); exits \false; ensures interval(out); ensures stays{Pre, Post}(a); */
static void enclose_variable(dyd_cert_enclosure *out, dyd_cert_algebra *a, size_t k, long p);
typedef const dyd_cert_bracket *bracketed;
/*@ predicate bracket(bracketed r) = \valid_read(r) && 2 <= r->count <= 1001 &&
      \valid_read(r->coeff + (0 .. r->count - 1)) &&
      (\forall integer k; 0 <= k < r->count ==> whole(&r->coeff[k][0])) &&
      (\forall integer k; 0 <= k < 4 ==> whole(&r->end[k][0]) && bits(&r->end[k][0]) <= 262144) &&
      sign(&r->end[1][0]) != 0 && sign(&r->end[3][0]) != 0; */
/*@ requires \valid(out) && interval(out) && bracket(r) && 0 <= p <= 16384 &&
      \separated(out, r, r->coeff + (0 .. r->count - 1));
    assigns ALL_OF(out); exits \false; ensures interval(out); */
void dyd_cert_root_enclose(dyd_cert_enclosure *out, const dyd_cert_bracket *r, long p);
/*@ requires \valid(x) && interval(x) && block(a) && \valid_read(n) && 64 <= p <= 16384;
    requires n->op == DYD_CERT_CYCLE ==> 1 <= n->exponent <= 1024;
    requires n->op == DYD_CERT_ROOT ==> bracket(n->root) &&
      \separated(x, n->root, n->root->coeff + (0 .. n->root->count - 1));
    requires \exists integer k; 0 <= k <= LAST && x == &a->number[k].now;
    assigns ALL_OF(x), NUMBERS_OF(a); exits \false; ensures interval(x); ensures stays{Pre, Post}(a); */
static void enclose_leaf(dyd_cert_enclosure *x, dyd_cert_algebra *a, const dyd_cert_number *n, long p);

/*@ requires block(a) && k < a->count; assigns NUMBERS_OF(a); exits \false;
    ensures -1 <= \result <= 1; */
int dyd_cert_algebra_sign(dyd_cert_algebra *a, uint32_t k);
/*@ requires block(a) && \valid_read(q) && (q->count == 1 ==> \valid_read(q->term)); assigns NUMBERS_OF(a);
    exits \false; ensures -1 <= \result <= 1; */
int dyd_cert_poly_sign(dyd_cert_algebra *a, const dyd_cert_poly *q);

#include "checker/algebra_enclose.c"
