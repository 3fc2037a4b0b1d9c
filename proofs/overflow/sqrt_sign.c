/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/dyadic/sqrt_sign.c. */
#define SPELL_OUT
#include "contracts.h"

/*@ requires whole(a) && whole(b) && whole(c); assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
static int compare_squares(mpz_srcptr a, mpz_srcptr b, mpz_srcptr c);
/*@ requires whole(a) && whole(b) && whole(c); assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
int dyd_sqrt_sign(const mpz_t a, const mpz_t b, const mpz_t c);
/*@ requires whole(a) && whole(b) && whole(c) && whole(d) && whole(e); assigns \nothing; exits \false;
    ensures -1 <= \result <= 1; */
int dyd_sqrt2_sign(const mpz_t a, const mpz_t b, const mpz_t c, const mpz_t d, const mpz_t e);

#include "dyadic/sqrt_sign.c"
