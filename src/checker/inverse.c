/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Intervals of logarithms and inverse circular functions: from a place y near the value the rest is small, and known
 * well by functions that are known [CERT-10]. */
#include "checker/enclosure.h"

/* Bits beyond the precision asked for; steps at most, each of which trebles the digits; bits at which they begin. */
enum { MORE_BITS = 64, MOST_STEPS = 16, FEW_BITS = 256 };

/* What is known of f(x) from y, in units of 2^-p as all else. */
typedef void nearer(dyd_cert_enclosure *out, const dyd_cert_enclosure *x, mpz_srcptr y, long p);

static void enclosure_set_at(dyd_cert_enclosure *x, mpz_srcptr y) {
  mpz_set(x->lo, y);
  mpz_set(x->hi, y);
  x->known = true;
}

static bool is_narrower(const dyd_cert_enclosure *x, const dyd_cert_enclosure *y) {
  mpz_t wide, other;
  mpz_inits(wide, other, NULL);
  mpz_sub(wide, x->hi, x->lo);
  mpz_sub(other, y->hi, y->lo);
  bool narrower = x->known && (!y->known || mpz_cmp(wide, other) < 0);
  mpz_clears(other, wide, NULL);
  return narrower;
}

static void settle_from(dyd_cert_enclosure *x, nearer *f, mpz_ptr y, long p);

/* y becomes what half of the digits give, if that is known to 1/2: a step on all of them costs most. */
static void begin_near(mpz_ptr y, const dyd_cert_enclosure *x, nearer *f, long p) {
  long by = p / 2;
  dyd_cert_enclosure few;
  mpz_t near;
  mpz_init(near);
  dyd_cert_enclosure_init(&few);
  dyd_cert_enclosure_set(&few, x);
  dyd_cert_enclosure_rescale(&few, -by);
  mpz_fdiv_q_2exp(near, y, (mp_bitcnt_t)by);
  settle_from(&few, f, near, p - by);
  mpz_sub(few.hi, few.hi, few.lo);
  if (few.known && (long)mpz_sizeinbase(few.hi, 2) < p - by) mpz_mul_2exp(y, near, (mp_bitcnt_t)by);
  dyd_cert_enclosure_clear(&few);
  mpz_clear(near);
}

/* x = f(x), from the middle of what is known to the next one while that gives more. */
static void settle_from(dyd_cert_enclosure *x, nearer *f, mpz_ptr y, long p) {
  dyd_cert_enclosure now, best;
  dyd_cert_enclosure_init(&now);
  dyd_cert_enclosure_init(&best);
  best.known = false;
  if (p > FEW_BITS) begin_near(y, x, f, p);
  f(&now, x, y, p);
  for (int k = 0; k < MOST_STEPS && is_narrower(&now, &best); k++) {
    dyd_cert_enclosure_set(&best, &now);
    mpz_add(y, now.lo, now.hi);
    mpz_fdiv_q_2exp(y, y, 1);
    f(&now, x, y, p);
  }
  dyd_cert_enclosure_set(x, &best);
  dyd_cert_enclosure_clear(&best);
  dyd_cert_enclosure_clear(&now);
}

/* log x = y + log e for e = x exp(-y), and 1 - 1/e <= log e <= e - 1; e > 0 as x is. */
void dyd_cert_enclosure_log_from(dyd_cert_enclosure *out, const dyd_cert_enclosure *x, mpz_srcptr y, long p) {
  dyd_cert_enclosure e, one;
  dyd_cert_enclosure_init(&e);
  dyd_cert_enclosure_init(&one);
  dyd_cert_enclosure_set_si(&one, 1, p);
  enclosure_set_at(&e, y);
  dyd_cert_enclosure_neg(&e);
  dyd_cert_enclosure_exp(&e, p);
  dyd_cert_enclosure_mul(&e, x, p);
  dyd_cert_enclosure_set(out, &one);
  dyd_cert_enclosure_div(out, &e, p);
  mpz_sub(out->lo, one.lo, out->hi);
  mpz_sub(out->hi, e.hi, one.hi);
  mpz_add(out->lo, out->lo, y);
  mpz_add(out->hi, out->hi, y);
  dyd_cert_enclosure_clear(&one);
  dyd_cert_enclosure_clear(&e);
}

/* log x = log z + k log 2 for z = x 2^-k, which is below 1; log 2 = -log (1/2). */
void dyd_cert_enclosure_log(dyd_cert_enclosure *x, long p) {
  long k = (long)mpz_sizeinbase(x->hi, 2) - p, q = p + MORE_BITS;
  dyd_cert_enclosure two, times;
  mpz_t y;
  x->known = x->known && mpz_sgn(x->lo) > 0;
  if (!x->known) return;
  mpz_init(y);
  dyd_cert_enclosure_init(&two);
  dyd_cert_enclosure_init(&times);
  dyd_cert_enclosure_rescale(x, MORE_BITS - k);
  settle_from(x, dyd_cert_enclosure_log_from, y, q);
  mpz_set_ui(y, 0);
  dyd_cert_enclosure_set_si(&two, 1, q - 1);
  settle_from(&two, dyd_cert_enclosure_log_from, y, q);
  dyd_cert_enclosure_set_si(&times, -k, q);
  dyd_cert_enclosure_mul(&two, &times, q);
  dyd_cert_enclosure_add(x, &two);
  dyd_cert_enclosure_rescale(x, -MORE_BITS);
  dyd_cert_enclosure_clear(&times);
  dyd_cert_enclosure_clear(&two);
  mpz_clear(y);
}

/* atan x = y + atan r for r = (x cos y - sin y) / (cos y + x sin y), and |atan r - r| <= r^2. */
void dyd_cert_enclosure_atan_from(dyd_cert_enclosure *out, const dyd_cert_enclosure *x, mpz_srcptr y, long p) {
  dyd_cert_enclosure c, s, d;
  dyd_cert_enclosure_init(&c);
  dyd_cert_enclosure_init(&s);
  dyd_cert_enclosure_init(&d);
  enclosure_set_at(&d, y);
  dyd_cert_enclosure_cos_sin(&c, &s, &d, p);
  dyd_cert_enclosure_set(&d, &s);
  dyd_cert_enclosure_mul(&d, x, p);
  dyd_cert_enclosure_add(&d, &c);
  dyd_cert_enclosure_mul(&c, x, p);
  dyd_cert_enclosure_sub(&c, &s);
  dyd_cert_enclosure_div(&c, &d, p); /* r */
  dyd_cert_enclosure_set(&s, &c);
  dyd_cert_enclosure_mul(&s, &s, p);
  dyd_cert_enclosure_set(out, &c);
  out->known = s.known && mpz_sgn(d.lo) > 0 && (long)mpz_sizeinbase(y, 2) <= p + 1;
  mpz_sub(out->lo, out->lo, s.hi);
  mpz_add(out->hi, out->hi, s.hi);
  mpz_add(out->lo, out->lo, y);
  mpz_add(out->hi, out->hi, y);
  dyd_cert_enclosure_clear(&d);
  dyd_cert_enclosure_clear(&s);
  dyd_cert_enclosure_clear(&c);
}

/* What x is multiplied with is known to as many bits more as x has before its point. */
void dyd_cert_enclosure_atan(dyd_cert_enclosure *x, long p) {
  size_t lo = mpz_sizeinbase(x->lo, 2), hi = mpz_sizeinbase(x->hi, 2);
  long bits = (long)(lo > hi ? lo : hi) - p, more = MORE_BITS + (bits > 0 ? bits : 0);
  mpz_t y;
  mpz_init(y);
  if (bits > 0 && mpz_sgn(x->lo) == mpz_sgn(x->hi)) mpz_set_si(y, mpz_sgn(x->lo));
  mpz_mul_2exp(y, y, (mp_bitcnt_t)(p + more));
  dyd_cert_enclosure_rescale(x, more);
  settle_from(x, dyd_cert_enclosure_atan_from, y, p + more);
  dyd_cert_enclosure_rescale(x, -more);
  mpz_clear(y);
}

/* asin x = 2 atan(x / (1 + sqrt(1 - x^2))), at -1 and 1 as well. */
void dyd_cert_enclosure_asin(dyd_cert_enclosure *x, long p) {
  dyd_cert_enclosure c, one;
  dyd_cert_enclosure_init(&c);
  dyd_cert_enclosure_init(&one);
  dyd_cert_enclosure_set_si(&one, 1, p);
  dyd_cert_enclosure_set(&c, x);
  dyd_cert_enclosure_mul(&c, &c, p);
  dyd_cert_enclosure_neg(&c);
  dyd_cert_enclosure_add(&c, &one);
  if (c.known) dyd_cert_enclosure_root(&c, 2, p);
  dyd_cert_enclosure_add(&c, &one);
  dyd_cert_enclosure_div(x, &c, p);
  dyd_cert_enclosure_atan(x, p);
  dyd_cert_enclosure_add(x, x);
  dyd_cert_enclosure_clear(&one);
  dyd_cert_enclosure_clear(&c);
}

void dyd_cert_enclosure_acos(dyd_cert_enclosure *x, long p) {
  dyd_cert_enclosure turn;
  dyd_cert_enclosure_init(&turn);
  dyd_cert_enclosure_pi(&turn, p);
  dyd_cert_enclosure_rescale(&turn, -1);
  dyd_cert_enclosure_asin(x, p);
  dyd_cert_enclosure_neg(x);
  dyd_cert_enclosure_add(x, &turn);
  dyd_cert_enclosure_clear(&turn);
}
