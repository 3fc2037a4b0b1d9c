/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of the numbers of src/checker, and contracts of src/checker/exact.c. */
#ifndef DYD_PROOFS_EXACT_H
#define DYD_PROOFS_EXACT_H

#include "checker/exact.h"

typedef const dyd_exact *exact_number;

/* PARTS: what changes of a number. */
#ifdef SPELL_OUT
#define exact(x) (\valid_read(x) && whole(&(x)->man[0]) && -274877906944 <= (x)->exp <= 274877906944)
#define beside(x, y) ((x) == (y) || \separated(x, y))
#define PARTS(x) (x)->man[0].value, (x)->exp
#else
#define PARTS(x) *(x)
/*@ predicate exact(exact_number x) = \valid_read(x) && whole(&x->man[0]) && -274877906944 <= x->exp <= 274877906944;
    predicate beside(exact_number x, exact_number y) = x == y || \separated(x, y); */
#endif

/*@ predicate between(integer e, integer a, integer b) = \min(a, b) <= e <= \max(a, b); */

/*@ requires \valid(x); assigns PARTS(x); exits \false; ensures exact(x) && x->exp == 0 && sign(&x->man[0]) == 0; */
void dyd_exact_init(dyd_exact *x);
/*@ requires \valid(x) && whole(&x->man[0]); assigns PARTS(x); exits \false; */
void dyd_exact_clear(dyd_exact *x);
/*@ requires \valid(out) && exact(x) && beside(out, x); assigns PARTS(out); exits \false;
    ensures whole(&out->man[0]) && out->exp == \old(x->exp) && sign(&out->man[0]) == \old(sign(&x->man[0])); */
void dyd_exact_set(dyd_exact *out, const dyd_exact *x);
/*@ requires \valid_read(x) && whole(&x->man[0]); assigns \nothing; exits \false;
    ensures \result == sign(&x->man[0]); */
int dyd_exact_sgn(const dyd_exact *x);
/*@ requires \valid_read(x) && whole(&x->man[0]) && -1000000000000000000 <= x->exp <= 1000000000000000000;
    assigns \nothing; exits \false;
    ensures sign(&x->man[0]) != 0 ==> \result == x->exp + bits(&x->man[0]);
    ensures sign(&x->man[0]) == 0 ==> \result == INT64_MIN; */
int64_t dyd_exact_top(const dyd_exact *x);
/*@ requires \valid(out) && exact(x) && exact(y) && beside(out, x) && beside(out, y); assigns PARTS(out); exits \false;
    ensures whole(&out->man[0]) && between(out->exp, \old(x->exp), \old(y->exp)); */
void dyd_exact_add(dyd_exact *out, const dyd_exact *x, const dyd_exact *y);
/*@ requires \valid(out) && exact(x) && exact(y) && beside(out, x) && beside(out, y); assigns PARTS(out); exits \false;
    ensures whole(&out->man[0]) && between(out->exp, \old(x->exp), \old(y->exp)); */
void dyd_exact_sub(dyd_exact *out, const dyd_exact *x, const dyd_exact *y);
/*@ requires \valid(out) && exact(x) && exact(y) && beside(out, x) && beside(out, y); assigns PARTS(out); exits \false;
    ensures whole(&out->man[0]) && out->exp == \old(x->exp) + \old(y->exp); */
void dyd_exact_mul(dyd_exact *out, const dyd_exact *x, const dyd_exact *y);
/*@ requires \valid(out) && exact(x) && whole(z) && beside(out, x) && \separated(out, z); assigns PARTS(out);
    exits \false;
    ensures whole(&out->man[0]) && out->exp == \old(x->exp); */
void dyd_exact_mul_z(dyd_exact *out, const dyd_exact *x, mpz_srcptr z);
/*@ requires exact(x) && (exact(y) || \valid_read(y) && whole(&y->man[0]) && -1048576 <= x->exp <= 1048576 &&
      bits(&x->man[0]) <= 2097152 && -1000000000000000000 <= y->exp <= 1000000000000000000);
    assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
int dyd_exact_cmp(const dyd_exact *x, const dyd_exact *y);
/*@ requires \valid(out) && exact(x) && (den == \null || whole(den) && sign(den) == 1 && \separated(out, den));
    requires -274877906944 <= exp <= 274877906944 && (\separated(out, x) || out == &x->man[0]);
    assigns out->value; exits \false; ensures whole(out); */
void dyd_exact_floor(mpz_ptr out, const dyd_exact *x, mpz_srcptr den, int64_t exp);
/*@ requires \valid(out) && exact(x) && (den == \null || whole(den) && sign(den) == 1 && \separated(out, den));
    requires -274877906944 <= exp <= 274877906944 && (\separated(out, x) || out == &x->man[0]);
    assigns out->value; exits \false; ensures whole(out); */
void dyd_exact_ceil(mpz_ptr out, const dyd_exact *x, mpz_srcptr den, int64_t exp);

#endif
