/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/cycle.c: orders up to DYD_CERT_ORDER; every cosine is in the list. */
/* Without psi_rest, cycle_relation, dyd_cert_cycle_begin: not tried. */
/* Unproved extend_cosines_assigns_exit_part1: CVC4 does not see that the relations are part of the block. */
/* Unproved extend_cosines_assigns_normal: CVC4 does not see that the relations are part of the block. */
#include "polys.h"

#include "base/alloc.h"
#include "base/invariant.h"
#include <string.h>

/*@ requires 1 <= n <= 1024; assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
static int moebius(long n);
/*@ requires 1 <= n <= 1024; assigns \nothing; exits \false; ensures 1 <= \result <= n; */
static long totient(long n);
/*@ requires 2 <= n <= 1024 && 0 <= m <= 512 && \valid(c + (0 .. m)); assigns c[0 .. m]; exits \false; */
static void cyclotomic(long *c, long m, long n);
/*@ requires \valid(a) && cosines(a) && k < a->cycle; exits \false;
    assigns *a, a->cosine[0 .. 1023];
    ensures cosines(a) && a->cycle == \old(a->cycle) && a->cosine == \old(a->cosine);
    ensures \result ==> k < a->cosines; */
static bool extend_cosines(dyd_cert_algebra *a, size_t k);
/*@ requires \valid(a) && \valid(value) && cosines(a) && whole(num) && whole(den) && den->sign != 0 &&
      \separated(a, value, a->cosine + (0 .. a->cycle - 1), num, den); exits \false; */
bool dyd_cert_cycle_cosine(dyd_cert_quotient *value, dyd_cert_algebra *a, mpz_srcptr num, mpz_srcptr den);

#include "checker/cycle.c"
