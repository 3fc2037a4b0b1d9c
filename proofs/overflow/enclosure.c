/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/enclosure.c: sums, quotients and limits of intervals. */
#include "enclosures.h"

/*@ requires \valid(x); assigns *x; exits \false; ensures interval(x); */
void dyd_cert_enclosure_init(dyd_cert_enclosure *x);
/*@ requires \valid(x) && interval(y) && (x == y || \separated(x, y)); assigns *x; exits \false; ensures interval(x); */
void dyd_cert_enclosure_set(dyd_cert_enclosure *x, const dyd_cert_enclosure *y);
/*@ requires \valid(x) && whole(num) && whole(den) && den->sign != 0 && 0 <= p <= 1073741824 &&
      \separated(x, num, den); assigns *x; exits \false; ensures interval(x); */
void dyd_cert_enclosure_set_q(dyd_cert_enclosure *x, mpz_srcptr num, mpz_srcptr den, long p);
/*@ requires interval(x); assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
int dyd_cert_enclosure_sign(const dyd_cert_enclosure *x);
/*@ requires \valid(x) && interval(x) && 0 <= p <= 1073741824; assigns *x; exits \false; ensures interval(x); */
void dyd_cert_enclosure_set_si(dyd_cert_enclosure *x, long z, long p);
/*@ requires \valid(x) && interval(x) && 0 <= p <= 1073741824; assigns x->known; exits \false; */
static void enclosure_limit(dyd_cert_enclosure *x, long p);
/*@ requires \valid(x) && interval(x) && interval(y) && (x == y || \separated(x, y)); assigns *x; exits \false;
    ensures interval(x); */
void dyd_cert_enclosure_add(dyd_cert_enclosure *x, const dyd_cert_enclosure *y);
/*@ requires \valid(x) && interval(x); assigns *x; exits \false; ensures interval(x); */
void dyd_cert_enclosure_neg(dyd_cert_enclosure *x);

#include "checker/enclosure.c"
