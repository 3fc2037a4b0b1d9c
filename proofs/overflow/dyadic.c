/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/dyadic/dyadic.c: from numbers in normal form, nothing overflows and results are in normal form. */
#include "contracts.h"

/*@ requires \valid_read(x) && whole(&x->man[0]) && -4611686018427387904 <= x->exp <= 4611686018427387904;
    assigns \nothing; exits \false;
    ensures \result != 0 <==> dyadic(x); */
bool dyd_dyadic_is_valid(const dyd_dyadic *x);
/*@ requires \valid(x); assigns *x; exits \false; ensures dyadic(x); */
void dyd_dyadic_init(dyd_dyadic *x);
/*@ requires \valid(x) && dyadic(x); assigns *x; exits \false; */
void dyd_dyadic_clear(dyd_dyadic *x);
/*@ requires \valid(x) && \valid(y) && dyadic(x) && dyadic(y) && apart(x, y);
    assigns *x, *y; exits \false; ensures dyadic(x) && dyadic(y); */
void dyd_dyadic_swap(dyd_dyadic *x, dyd_dyadic *y);
/*@ requires \valid(out) && dyadic(out); assigns *out; exits \false; ensures dyadic(out); */
dyd_status dyd_dyadic_set_si_2exp(dyd_dyadic *out, long man, int64_t exp);
/*@ requires \valid(man) && whole(man) && \valid(exp) && dyadic(x) && dyadic(y) &&
      \separated(man, x) && \separated(man, y) && \separated(exp, x) && \separated(exp, y) && \separated(exp, man);
    assigns *man, *exp; exits \false; ensures whole(man) && -1048576 <= *exp <= 1048576; */
void dyd_raw_add(mpz_ptr man, int64_t *exp, const dyd_dyadic *x, const dyd_dyadic *y, int sign);
/*@ requires \valid(out) && dyadic(out) && dyadic(x) && dyadic(y);
    assigns *out; exits \false; ensures dyadic(out); */
static dyd_status add_signed(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y, int sign);
/*@ requires \valid(out) && dyadic(out) && dyadic(x) && dyadic(y);
    assigns *out; exits \false; ensures dyadic(out); */
dyd_status dyd_dyadic_add(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y);
/*@ requires \valid(out) && dyadic(out) && dyadic(x) && dyadic(y);
    assigns *out; exits \false; ensures dyadic(out); */
dyd_status dyd_dyadic_sub(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y);
/*@ requires \valid(out) && dyadic(out) && dyadic(x) && dyadic(y);
    assigns *out; exits \false; ensures dyadic(out); */
dyd_status dyd_dyadic_mul(dyd_dyadic *out, const dyd_dyadic *x, const dyd_dyadic *y);
/*@ requires \valid(out) && dyadic(out) && dyadic(x) && apart(out, x);
    assigns *out; exits \false; ensures dyadic(out); */
dyd_status dyd_dyadic_mul_2exp(dyd_dyadic *out, const dyd_dyadic *x, int64_t e);
/*@ requires \valid(out) && dyadic(x) && apart(out, x); assigns *out; exits \false; ensures dyadic(out); */
void dyd_dyadic_neg(dyd_dyadic *out, const dyd_dyadic *x);
/*@ requires dyadic(x); assigns \nothing; exits \false; ensures \result == sign(&x->man[0]); */
int dyd_dyadic_sgn(const dyd_dyadic *x);
/*@ predicate raw(number x) = \valid_read(x) && whole(&x->man[0]) && -1048576 <= x->exp <= 1048576; */
/*@ requires raw(x) && raw(y); assigns \nothing; exits \false; */
static int cmp_aligned(const dyd_dyadic *x, const dyd_dyadic *y);
/*@ requires raw(x) && raw(y); assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
int dyd_dyadic_cmp(const dyd_dyadic *x, const dyd_dyadic *y);
/*@ requires dyadic(x) && dyadic(y) && whole(p) && whole(q); assigns \nothing; exits \false;
    ensures -1 <= \result <= 1; */
int dyd_raw_cmp(const dyd_dyadic *x, mpz_srcptr p, const dyd_dyadic *y, mpz_srcptr q);

#include "dyadic/dyadic.c"
