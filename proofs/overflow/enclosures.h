/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of intervals, and contracts of src/checker/enclosure.h: ends are whole numbers, whatever is known.
 *
 * Precisions are at most 2^39, of what works with more digits inside 2^38; 2^30 where as many as the argument has
 * before its point are added. */
#ifndef DYD_PROOFS_ENCLOSURES_H
#define DYD_PROOFS_ENCLOSURES_H

#include "exact.h"

#include "checker/enclosure.h"

typedef const dyd_cert_enclosure *interval_of;

/* Members by name: as a whole they would be any memory after a call, which costs CVC4 much. */
#define ENDS_OF(x) x->lo[0].value, x->hi[0].value
#define ALL_OF(x) ENDS_OF(x), x->known

#ifdef SPELL_OUT
#define interval(x) (\valid_read(x) && whole(&(x)->lo[0]) && whole(&(x)->hi[0]))
#define alone(x, y) ((x) == (y) || \separated(x, y))
#else
/*@ predicate interval(interval_of x) = \valid_read(x) && whole(&x->lo[0]) && whole(&x->hi[0]);
    predicate alone(interval_of x, interval_of y) = x == y || \separated(x, y); */
#endif

/*@ predicate digits(integer p) = 0 <= p <= 549755813888;
    predicate fewer(integer p) = 0 <= p <= 274877906944;
    predicate few(integer p) = 0 <= p <= 1073741824; */

/*@ requires \valid(x); assigns ALL_OF(x); exits \false; ensures interval(x) && x->known; */
void dyd_cert_enclosure_init(dyd_cert_enclosure *x);
/*@ requires \valid(x) && interval(x); assigns ALL_OF(x); exits \false; */
void dyd_cert_enclosure_clear(dyd_cert_enclosure *x);
/*@ requires \valid(x) && interval(y) && alone(x, y); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_set(dyd_cert_enclosure *x, const dyd_cert_enclosure *y);
/*@ requires \valid(x) && whole(num) && whole(den) && sign(den) != 0 && digits(p) && \separated(x, num, den);
    assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_set_q(dyd_cert_enclosure *x, mpz_srcptr num, mpz_srcptr den, long p);
/*@ requires interval(x); assigns \nothing; exits \false; ensures -1 <= \result <= 1;
    ensures \result == 1 ==> 0 < sign(&x->lo[0]); ensures \result == -1 ==> sign(&x->hi[0]) < 0; */
int dyd_cert_enclosure_sign(const dyd_cert_enclosure *x);
/*@ requires \valid(x) && interval(x) && digits(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_set_si(dyd_cert_enclosure *x, long z, long p);

/*@ requires \valid(x) && interval(x) && interval(y) && alone(x, y);
    assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_add(dyd_cert_enclosure *x, const dyd_cert_enclosure *y);
/*@ requires \valid(x) && interval(x) && interval(y) && alone(x, y);
    assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_sub(dyd_cert_enclosure *x, const dyd_cert_enclosure *y);
/*@ requires \valid(x) && interval(x); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_neg(dyd_cert_enclosure *x);
/*@ requires \valid(x) && interval(x); requires interval(y); requires alone(x, y); requires digits(p);
    assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_mul(dyd_cert_enclosure *x, const dyd_cert_enclosure *y, long p);
/*@ requires \valid(x) && interval(x) && interval(y) && alone(x, y) && digits(p); assigns ALL_OF(x); exits \false;
    ensures interval(x); */
void dyd_cert_enclosure_div(dyd_cert_enclosure *x, const dyd_cert_enclosure *y, long p);
/*@ requires \valid(x) && interval(x) && digits(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_pow(dyd_cert_enclosure *x, long n, long p);
/*@ requires \valid(x) && interval(x) && digits(p) && (k == 2 || k == 3); assigns ENDS_OF(x); exits \false;
    ensures interval(x); */
void dyd_cert_enclosure_root(dyd_cert_enclosure *x, unsigned long k, long p);
/*@ requires \valid(x) && interval(x); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_abs(dyd_cert_enclosure *x);
/*@ requires \valid(x) && interval(x) && interval(y) && alone(x, y) && (sign == 1 || sign == -1);
    assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_extreme(dyd_cert_enclosure *x, int sign, const dyd_cert_enclosure *y);
/*@ requires \valid(x) && interval(x) && fewer(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_pi(dyd_cert_enclosure *x, long p);
/*@ requires \valid(x) && interval(x) && -1099511627776 <= by <= 1099511627776; assigns ENDS_OF(x);
    exits \false; ensures interval(x); */
void dyd_cert_enclosure_rescale(dyd_cert_enclosure *x, long by);
/*@ requires \valid(x) && interval(x) && fewer(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_exp(dyd_cert_enclosure *x, long p);
/*@ requires \valid(x) && interval(x) && few(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_log(dyd_cert_enclosure *x, long p);
/*@ requires \valid(x) && interval(x) && few(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_atan(dyd_cert_enclosure *x, long p);
/*@ requires \valid(x) && interval(x) && few(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_asin(dyd_cert_enclosure *x, long p);
/*@ requires \valid(x) && interval(x) && few(p); assigns ALL_OF(x); exits \false; ensures interval(x); */
void dyd_cert_enclosure_acos(dyd_cert_enclosure *x, long p);
/*@ requires \valid(out) && interval(out) && interval(x) && whole(y) && fewer(p) && \separated(out, x) &&
      \separated(out, y);
    assigns ALL_OF(out); exits \false; ensures interval(out); */
void dyd_cert_enclosure_log_from(dyd_cert_enclosure *out, const dyd_cert_enclosure *x, mpz_srcptr y, long p);
/*@ requires \valid(out) && interval(out) && interval(x) && whole(y) && fewer(p) && \separated(out, x) &&
      \separated(out, y);
    assigns ALL_OF(out); exits \false; ensures interval(out); */
void dyd_cert_enclosure_atan_from(dyd_cert_enclosure *out, const dyd_cert_enclosure *x, mpz_srcptr y, long p);
/*@ requires \valid(c) && \valid(s) && interval(c) && interval(s) && interval(x) && fewer(p) && \separated(c, s, x);
    assigns ALL_OF(c), ALL_OF(s); exits \false; ensures interval(c) && interval(s); */
void dyd_cert_enclosure_cos_sin(dyd_cert_enclosure *c, dyd_cert_enclosure *s, const dyd_cert_enclosure *x, long p);

#endif
