/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra_enclose.c: operations on intervals, precisions up to 2^30. */
/* Without enclose_hyperbolic: it calls through a pointer to a function, and WP does not know valid_function. */
/* Without enclose_cosine: tried; that x stays an interval after two local ones were begun is not proved in 3 s. */
/* Without dyd_cert_poly_sign: tried; that dyd_cert_poly_integer gives the same twice is not in its contract. */
/* Without enclose_leaf, enclose_value, dyd_cert_algebra_enclose, enclose_variable, dyd_cert_poly_enclose: not tried;
   they call each other, and change numbers that others are made of. */
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
/*@ requires \valid(a) && 64 <= p <= 16384;
    assigns a->relations.work, a->number[0 .. a->count]; exits \false;
    ensures \result == &a->number[k].now && interval(\result); */
const dyd_cert_enclosure *dyd_cert_algebra_enclose(dyd_cert_algebra *a, uint32_t k, long p);
/*@ requires \valid(a) && \separated(a, a->number + (0 .. a->count)); exits \false;
    ensures -1 <= \result <= 1; */
int dyd_cert_algebra_sign(dyd_cert_algebra *a, uint32_t k);

#include "checker/algebra_enclose.c"
