/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of dyadics, and contracts of functions of src/dyadic/dyadic.c that others call. */
#ifndef DYD_PROOFS_CONTRACTS_H
#define DYD_PROOFS_CONTRACTS_H

#include "dyadic/raw.h"

typedef const dyd_dyadic *number;

/*@ predicate dyadic(number x) = \valid_read(x) && whole(&x->man[0]) && -1048576 <= x->exp <= 1048576 &&
      (sign(&x->man[0]) == 0 ==> x->exp == 0) &&
      (sign(&x->man[0]) != 0 ==> zeros(&x->man[0]) == 0 && x->exp + bits(&x->man[0]) <= 1048576);
    predicate apart(number x, number y) = x == y || \separated(x, y); */

/*@ requires whole(man); assigns \nothing; exits \false; ensures \result == bits(man); */
int64_t dyd_bits(mpz_srcptr man);
/*@ requires \valid(out) && dyadic(x) && apart(out, x); assigns *out; exits \false; ensures dyadic(out); */
void dyd_dyadic_set(dyd_dyadic *out, const dyd_dyadic *x);
/*@ requires \valid(out) && dyadic(out) && \valid(man) && whole(man) && \separated(out, man);
    assigns *out, *man; exits \false;
    ensures dyadic(out) && whole(man); ensures \result == DYD_OK || \result == DYD_E_RANGE; */
dyd_status dyd_dyadic_take(dyd_dyadic *out, mpz_ptr man, int64_t exp);
/*@ requires \valid(out) && dyadic(out) && whole(man); assigns *out; exits \false; ensures dyadic(out); */
dyd_status dyd_dyadic_set_z_2exp(dyd_dyadic *out, const mpz_t man, int64_t exp);

/*@ predicate rational(mpq_srcptr q) = \valid_read(q) && whole(&q->num) && whole(&q->den) && sign(&q->den) == 1; */

#endif
