/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/dyadic/convert.c. */
#define SPELL_OUT
#include "contracts.h"

#include <math.h>

/*@ requires \valid(out) && dyadic(out); assigns *out; exits \false; ensures dyadic(out); */
dyd_status dyd_dyadic_set_d(dyd_dyadic *out, double x);
/*@ requires \valid(q) && whole(n) && 0 <= shift <= 4611686018427387904; assigns *q; exits \false; ensures whole(q);
    ensures bits(q) <= \max(1, \old(bits(n)) - shift + 1); */
static void shift_right_directed(mpz_ptr q, mpz_srcptr n, int64_t shift, dyd_round dir);
/*@ requires rational(q); assigns \nothing; exits \false; */
int64_t dyd_q_log2_above(mpq_srcptr q);
/*@ requires \valid(q) && whole(n) && whole(den) && sign(den) > 0; assigns *q; exits \false; ensures whole(q);
    ensures bits(q) <= \old(bits(n)) + 1; */
static void divide_directed(mpz_ptr q, mpz_srcptr n, mpz_srcptr den, dyd_round dir);
/*@ requires \valid(out) && dyadic(out) && dyadic(x) && apart(out, x);
    assigns *out; exits \false; ensures dyadic(out); */
dyd_status dyd_dyadic_round(dyd_dyadic *out, const dyd_dyadic *x, int64_t exp, dyd_round dir);
/*@ requires \valid(out) && dyadic(out) && rational(q); assigns *out; exits \false; ensures dyadic(out); */
static dyd_status set_dyadic_q(dyd_dyadic *out, const mpq_t q);
/*@ requires \valid(out) && dyadic(out) && rational(q); assigns *out; exits \false; ensures dyadic(out); */
dyd_status dyd_dyadic_round_q(dyd_dyadic *out, const mpq_t q, int64_t exp, dyd_round dir);
/*@ requires \valid(q) && dyadic(x) && \separated(q, x); assigns *q; exits \false; */
void dyd_dyadic_get_q(mpq_t q, const dyd_dyadic *x);
/*@ assigns \nothing; exits \false; */
static double largest_in_direction(int sign, dyd_round dir);
/*@ requires whole(man) && -1099511627776 <= exp <= 1099511627776; assigns \nothing; exits \false; */
double dyd_raw_get_d(mpz_srcptr man, int64_t exp, dyd_round dir);
/*@ requires whole(man) && whole(den) && sign(den) > 0 && -137438953472 <= exp <= 137438953472;
    assigns \nothing; exits \false; */
double dyd_raw_quotient_get_d(mpz_srcptr man, int64_t exp, mpz_srcptr den, dyd_round dir);
/*@ requires dyadic(x); assigns \nothing; exits \false; */
double dyd_dyadic_get_d(const dyd_dyadic *x, dyd_round dir);
/*@ requires dyadic(x); assigns \nothing; exits \false; */
bool dyd_dyadic_is_double(const dyd_dyadic *x);

#include "dyadic/convert.c"
