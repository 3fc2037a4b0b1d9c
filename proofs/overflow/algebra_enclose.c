/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra_enclose.c: operations on intervals, precisions up to 2^30. */
/* Of those here each was tried once, with numbers made of those before, while other runs had the machine: goals that
   are open ended by Timeout. */
/* Without enclose_hyperbolic: what is called one of two; open in 4 s: function_pointer (WP does not know
   valid_function), that x is an interval after its ends are halved, and what one dyd_cert_enclosure_clear requires. */
/* Without enclose_cosine: open in 4 s: what dyd_cert_enclosure_set and one dyd_cert_enclosure_clear require. */
/* Without enclose_value: open in 4 s: its postcondition, and what dyd_cert_poly_enclose, dyd_cert_enclosure_div and
   dyd_cert_enclosure_clear require. */
/* Without enclose_leaf: open in 4 s: parts of its postcondition, and what enclose_value requires. */
/* Without enclose_variable: 17 of 24 goals are proved in 1 s; the others ended by Timeout. */
/* Without dyd_cert_algebra_enclose: with the block kept by its loop, WP and CVC4 did not end in 150 s. */
/* Without dyd_cert_poly_enclose: with the block kept by its loops, WP and CVC4 did not end in 80 s. */
/* Without dyd_cert_poly_sign: tried; that dyd_cert_poly_integer gives the same twice is not in its contract. */
#include "enclosures.h"
#include "polys.h"

/*@ requires \valid(x) && interval(x) && few(p); assigns *x; exits \false; ensures interval(x); */
static void enclose_cosine(dyd_cert_enclosure *x, dyd_cert_op op, long p);
/*@ requires \valid(x) && interval(x) && few(p); assigns *x; exits \false; ensures interval(x); */
static void enclose_hyperbolic(dyd_cert_enclosure *x, dyd_cert_op op, long p);
/*@ requires \valid(x) && interval(x) && few(p) && 1 <= n <= 1024; assigns *x; exits \false;
    ensures interval(x); */
static void enclose_cycle(dyd_cert_enclosure *x, long n, long p);
/*@ requires \valid(x) && interval(x) && few(p); assigns *x; exits \false; ensures interval(x); */
static void enclose_e(dyd_cert_enclosure *x, long p);
/*@ requires \valid(x) && interval(x) && few(p); assigns *x; exits \false; ensures interval(x); */
static void enclose_inverse(dyd_cert_enclosure *x, dyd_cert_op op, long p);
/*@ requires \valid(x) && interval(x) && \valid_read(n) && few(p) && (x == &n->now || \separated(n, x));
    assigns *x; exits \false; ensures interval(x); */
static void enclose_function(dyd_cert_enclosure *x, const dyd_cert_number *n, long p);
/*@ requires \valid(x) && interval(x) && interval(y) && alone(x, y) && few(p); exits \false; ensures interval(x); */
static void enclose_operation(dyd_cert_enclosure *x, dyd_cert_op op, const dyd_cert_enclosure *y, long p);
/*@ requires \valid(a) && k < a->count && 64 <= p <= 16384;
    assigns a->relations.work, a->number[0 .. a->count]; exits \false;
    ensures \result == &a->number[k].now && interval(\result); */
const dyd_cert_enclosure *dyd_cert_algebra_enclose(dyd_cert_algebra *a, uint32_t k, long p);
/*@ requires \valid(a) && k < a->count && \separated(a, a->number + (0 .. a->count)); exits \false;
    ensures -1 <= \result <= 1; */
int dyd_cert_algebra_sign(dyd_cert_algebra *a, uint32_t k);

#include "checker/algebra_enclose.c"
