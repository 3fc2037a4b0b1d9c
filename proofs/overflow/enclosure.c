/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/enclosure.c: arithmetic, roots and series of intervals. */
/* Unproved dyd_cert_enclosure_div_call_mpz_cdiv_q_requires, dyd_cert_enclosure_div_call_mpz_fdiv_q_requires: that no
   end is 0 where the sign is known rests on their order; of integers signs and lengths are seen here. */
#define SPELL_OUT
#include "enclosures.h"

/*@ requires \valid(x) && interval(x) && digits(p); assigns x->known; exits \false; */
static void enclosure_limit(dyd_cert_enclosure *x, long p);
/*@ requires \valid(lo) && \valid(hi) && whole(lo) && whole(hi) && interval(x) && interval(y) &&
      \separated(lo, hi, x) && \separated(lo, hi, y);
    assigns lo->value, hi->value; exits \false;
    ensures whole(lo) && whole(hi); */
static void multiply_ends(mpz_ptr lo, mpz_ptr hi, const dyd_cert_enclosure *x, const dyd_cert_enclosure *y);
/*@ requires \valid(out) && whole(out) && whole(x) && (k == 2 || k == 3) && digits(p) &&
      (x == out || \separated(x, out));
    assigns out->value; exits \false; ensures whole(out); */
static void root_of_end(mpz_ptr out, mpz_srcptr x, unsigned long k, bool up, long p);
/*@ requires \valid(sum) && whole(sum) && \valid(terms) && \separated(sum, terms) && 2 <= n <= 1000 && digits(p);
    assigns sum->value, *terms; exits \false; ensures whole(sum); */
static void inverse_tangent(mpz_ptr sum, unsigned long *terms, unsigned long n, long p);
/*@ requires interval(x) && digits(p); assigns \nothing; exits \false;
    ensures 0 <= \result <= 137438953480; */
static long halvings(const dyd_cert_enclosure *x, long p);
/*@ requires \valid(term) && interval(term) && interval(r) && \separated(term, r) && n != 0 && digits(p);
    assigns ALL_OF(term); exits \false; ensures interval(term); */
static bool taylor_step(dyd_cert_enclosure *term, const dyd_cert_enclosure *r, unsigned long n, long p);
/*@ requires \valid(sum) && interval(sum); assigns ENDS_OF(sum); exits \false; ensures interval(sum); */
static void add_remainder(dyd_cert_enclosure *sum);
/*@ requires \valid(c) && \valid(s) && interval(c) && interval(s) && \separated(c, s) && digits(p);
    assigns ALL_OF(c), ALL_OF(s); exits \false; ensures interval(c) && interval(s); */
static void double_angle(dyd_cert_enclosure *c, dyd_cert_enclosure *s, long p);
/*@ requires \valid(c) && \valid(s) && interval(c) && interval(s) && interval(r) && \separated(c, s, r) && digits(p);
    assigns ALL_OF(c), ALL_OF(s); exits \false; ensures interval(c) && interval(s); */
static void taylor_cos_sin(dyd_cert_enclosure *c, dyd_cert_enclosure *s, const dyd_cert_enclosure *r, long p);

#include "checker/enclosure.c"
