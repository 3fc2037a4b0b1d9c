/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/exact.c: exponents as large as these are far from the ends of int64_t. */
#define SPELL_OUT
#include "exact.h"

/*@ requires \valid(out) && exact(x) && exact(y) && beside(out, x) && beside(out, y); assigns PARTS(out); exits \false;
    ensures whole(&out->man[0]) && between(out->exp, \old(x->exp), \old(y->exp)); */
static void exact_combine(dyd_exact *out, const dyd_exact *x, const dyd_exact *y, int sign);
/*@ requires \valid(out) && exact(x) && (den == \null || whole(den) && sign(den) == 1 && \separated(out, den));
    requires -274877906944 <= exp <= 274877906944 && (\separated(out, x) || out == &x->man[0]);
    assigns out->value; exits \false; ensures whole(out); */
static void exact_divide(mpz_ptr out, const dyd_exact *x, mpz_srcptr den, int64_t exp, bool up);

#include "checker/exact.c"
