/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/cycle.c: orders up to DYD_CERT_ORDER; every cosine is in the list. */
#include "polys.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include <string.h>

#undef DYD_INVARIANT
#define DYD_INVARIANT(holds) ((void)0)
#define ITEM long
#define RESERVE reserve_coefficients
#define ALLOC alloc_coefficients
#include "lists.h"
#define ITEM dyd_cert_poly
#define RESERVE reserve_cosines
#define ALLOC alloc_cosines
#include "lists.h"

/*@ requires 0 < n ==> \valid(to + (0 .. n - 1)) && \valid_read(from + (0 .. n - 1));
    assigns to[0 .. n - 1]; exits \false; */
void move_terms(dyd_cert_term *to, const dyd_cert_term *from, size_t n);
#define memmove(to, from, n) move_terms(to, from, (n) / sizeof *(to))

/*@ requires \valid(a) && a->relations.count <= 64; exits \false; ensures \result <= 64;
    assigns a->relations.count, a->leaf[0 .. 63]; */
size_t dyd_cert_algebra_leaf(dyd_cert_algebra *a);
/*@ requires \valid(rest) && \valid(a) && leaf < 64 && 0 <= m <= 512 && \valid_read(c + (0 .. m)) &&
      (\forall integer k; 0 <= k <= m ==> -1048576 <= c[k] <= 1048576) && \separated(c + (0 .. m), rest, a);
    exits \false; */
static bool psi_rest(dyd_cert_poly *rest, dyd_cert_algebra *a, size_t leaf, const long *c, long m);
/*@ requires \valid(n) && \valid(a) && leaf < 64 && 1 <= n->exponent <= 1024 && a->relations.count <= 64 &&
      \separated(n, a); exits \false; */
static bool cycle_relation(dyd_cert_number *n, dyd_cert_algebra *a, size_t leaf);
/*@ requires \valid(n) && \valid(a) && a->relations.count <= 64 && \separated(n, a); exits \false; */
bool dyd_cert_cycle_begin(dyd_cert_number *n, dyd_cert_algebra *a);
/*@ requires 1 <= n <= 1024; assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
static int moebius(long n);
/*@ requires 1 <= n <= 1024; assigns \nothing; exits \false; ensures 1 <= \result <= n; */
static long totient(long n);
/*@ requires 2 <= n <= 1024 && 0 <= m <= 512 && \valid(c + (0 .. m)); assigns c[0 .. m]; exits \false; */
static void cyclotomic(long *c, long m, long n);
/*@ requires \valid(a) && cosines(a) && k < a->cycle; exits \false;
    assigns a->relations.nomem, a->relations.work, a->cosines, a->cosine[0 .. a->cycle - 1];
    ensures cosines(a) && a->cycle == \old(a->cycle) && a->cosine == \old(a->cosine);
    ensures \result ==> k < a->cosines; */
static bool extend_cosines(dyd_cert_algebra *a, size_t k);
/*@ requires \valid(a) && \valid(value) && cosines(a) && whole(num) && whole(den) && sign(den) != 0 &&
      \separated(a, value, a->cosine + (0 .. a->cycle - 1), num, den);
    assigns *value, a->relations.nomem, a->relations.work, a->cosines, a->cosine[0 .. a->cycle - 1]; exits \false;
    ensures cosines(a); */
bool dyd_cert_cycle_cosine(dyd_cert_quotient *value, dyd_cert_algebra *a, mpz_srcptr num, mpz_srcptr den);

#include "checker/cycle.c"
