/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/enclosure.c: sums, quotients and limits of intervals. */
/* Without dyd_cert_enclosure_clear, dyd_cert_enclosure_sub, multiply_ends, dyd_cert_enclosure_mul,
   dyd_cert_enclosure_div, dyd_cert_enclosure_pow, root_of_end, dyd_cert_enclosure_root, dyd_cert_enclosure_abs,
   dyd_cert_enclosure_extreme, dyd_cert_enclosure_rescale, inverse_tangent, dyd_cert_enclosure_pi, halvings,
   taylor_step, add_remainder, dyd_cert_enclosure_exp, double_angle, taylor_cos_sin, dyd_cert_enclosure_cos_sin: not
   tried. */
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
