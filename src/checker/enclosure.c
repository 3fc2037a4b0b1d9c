/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Intervals of fixed point numbers: arithmetic, roots, exp, cos, sin, pi. */
#include "checker/enclosure.h"

#include "base/invariant.h"

/* Bits before the point that numbers may have; bits of the arguments of exp, cos, sin. */
enum { MOST_WHOLE = 1 << 15, MOST_ARGUMENT = 24 };

void dyd_cert_enclosure_init(dyd_cert_enclosure *x) {
  mpz_inits(x->lo, x->hi, NULL);
  x->known = true;
}

void dyd_cert_enclosure_clear(dyd_cert_enclosure *x) {
  mpz_clears(x->lo, x->hi, NULL);
}

void dyd_cert_enclosure_set(dyd_cert_enclosure *x, const dyd_cert_enclosure *y) {
  mpz_set(x->lo, y->lo);
  mpz_set(x->hi, y->hi);
  x->known = y->known;
}

void dyd_cert_enclosure_set_q(dyd_cert_enclosure *x, mpz_srcptr num, mpz_srcptr den, long p) {
  mpz_mul_2exp(x->lo, num, (mp_bitcnt_t)p);
  mpz_cdiv_q(x->hi, x->lo, den);
  mpz_fdiv_q(x->lo, x->lo, den);
  x->known = true;
}

int dyd_cert_enclosure_sign(const dyd_cert_enclosure *x) {
  if (!x->known) return 0;
  return mpz_sgn(x->lo) > 0 ? 1 : mpz_sgn(x->hi) < 0 ? -1 : 0;
}

void dyd_cert_enclosure_set_si(dyd_cert_enclosure *x, long z, long p) {
  mpz_set_si(x->lo, z);
  mpz_mul_2exp(x->lo, x->lo, (mp_bitcnt_t)p);
  mpz_set(x->hi, x->lo);
  x->known = true;
}

/* What has grown too large is not known any more. */
static void enclosure_limit(dyd_cert_enclosure *x, long p) {
  size_t most = (size_t)p + MOST_WHOLE;
  x->known = x->known && mpz_sizeinbase(x->lo, 2) <= most && mpz_sizeinbase(x->hi, 2) <= most;
}

/* ---- arithmetic ---- */

void dyd_cert_enclosure_add(dyd_cert_enclosure *x, const dyd_cert_enclosure *y) {
  mpz_add(x->lo, x->lo, y->lo);
  mpz_add(x->hi, x->hi, y->hi);
  x->known = x->known && y->known;
}

void dyd_cert_enclosure_neg(dyd_cert_enclosure *x) {
  mpz_swap(x->lo, x->hi);
  mpz_neg(x->lo, x->lo);
  mpz_neg(x->hi, x->hi);
}

void dyd_cert_enclosure_sub(dyd_cert_enclosure *x, const dyd_cert_enclosure *y) {
  dyd_cert_enclosure minus;
  dyd_cert_enclosure_init(&minus);
  dyd_cert_enclosure_set(&minus, y);
  dyd_cert_enclosure_neg(&minus);
  dyd_cert_enclosure_add(x, &minus);
  dyd_cert_enclosure_clear(&minus);
}

/* The least and the greatest product of ends, not yet divided by 2^p. */
static void multiply_ends(mpz_ptr lo, mpz_ptr hi, const dyd_cert_enclosure *x, const dyd_cert_enclosure *y) {
  mpz_t t;
  mpz_init(t);
  for (int k = 0; k < 4; k++) {
    mpz_mul(t, k & 1 ? x->hi : x->lo, k & 2 ? y->hi : y->lo);
    if (k == 0 || mpz_cmp(t, lo) < 0) mpz_set(lo, t);
    if (k == 0 || mpz_cmp(t, hi) > 0) mpz_set(hi, t);
  }
  mpz_clear(t);
}

void dyd_cert_enclosure_mul(dyd_cert_enclosure *x, const dyd_cert_enclosure *y, long p) {
  mpz_t lo, hi;
  mpz_inits(lo, hi, NULL);
  multiply_ends(lo, hi, x, y);
  mpz_fdiv_q_2exp(x->lo, lo, (mp_bitcnt_t)p);
  mpz_cdiv_q_2exp(x->hi, hi, (mp_bitcnt_t)p);
  x->known = x->known && y->known;
  enclosure_limit(x, p);
  mpz_clears(lo, hi, NULL);
}

void dyd_cert_enclosure_div(dyd_cert_enclosure *x, const dyd_cert_enclosure *y, long p) {
  dyd_cert_enclosure inverse;
  dyd_cert_enclosure_init(&inverse);
  if (!dyd_cert_enclosure_sign(y)) {
    inverse.known = false;
  } else {
    mpz_set_ui(inverse.lo, 1);
    mpz_mul_2exp(inverse.lo, inverse.lo, 2 * (mp_bitcnt_t)p);
    mpz_cdiv_q(inverse.hi, inverse.lo, y->lo);
    mpz_fdiv_q(inverse.lo, inverse.lo, y->hi);
  }
  dyd_cert_enclosure_mul(x, &inverse, p);
  dyd_cert_enclosure_clear(&inverse);
}

void dyd_cert_enclosure_pow(dyd_cert_enclosure *x, long n, long p) {
  dyd_cert_enclosure power;
  dyd_cert_enclosure_init(&power);
  dyd_cert_enclosure_set_si(&power, 1, p);
  for (unsigned long k = n < 0 ? (unsigned long)-(n + 1) + 1 : (unsigned long)n; k && x->known; k >>= 1) {
    if (k & 1) dyd_cert_enclosure_mul(&power, x, p);
    if (k > 1) dyd_cert_enclosure_mul(x, x, p);
  }
  power.known = power.known && x->known;
  dyd_cert_enclosure_set_si(x, 1, p);
  if (n < 0)
    dyd_cert_enclosure_div(x, &power, p);
  else
    dyd_cert_enclosure_set(x, &power);
  dyd_cert_enclosure_clear(&power);
}

/* out = the k-th root of x 2^-p, rounded down or up. */
static void root_of_end(mpz_ptr out, mpz_srcptr x, unsigned long k, bool up, long p) {
  bool negative = mpz_sgn(x) < 0, exact;
  mpz_mul_2exp(out, x, (k - 1) * (mp_bitcnt_t)p);
  mpz_abs(out, out);
  exact = mpz_root(out, out, k);
  if (!exact && up != negative) mpz_add_ui(out, out, 1);
  if (negative) mpz_neg(out, out);
}

void dyd_cert_enclosure_root(dyd_cert_enclosure *x, unsigned long k, long p) {
  DYD_INVARIANT(x->known && (k != 2 || mpz_sgn(x->hi) >= 0));
  if (k == 2 && mpz_sgn(x->lo) < 0) mpz_set_ui(x->lo, 0); /* the root is defined */
  root_of_end(x->lo, x->lo, k, false, p);
  root_of_end(x->hi, x->hi, k, true, p);
}

void dyd_cert_enclosure_abs(dyd_cert_enclosure *x) {
  if (mpz_sgn(x->lo) >= 0) return;
  bool both = mpz_sgn(x->hi) > 0;
  if (both && mpz_cmpabs(x->hi, x->lo) > 0)
    mpz_set_ui(x->lo, 0);
  else
    dyd_cert_enclosure_neg(x);
  if (both) mpz_set_ui(x->lo, 0);
}

void dyd_cert_enclosure_extreme(dyd_cert_enclosure *x, int sign, const dyd_cert_enclosure *y) {
  if (mpz_cmp(y->lo, x->lo) * sign > 0) mpz_set(x->lo, y->lo);
  if (mpz_cmp(y->hi, x->hi) * sign > 0) mpz_set(x->hi, y->hi);
  x->known = x->known && y->known;
}

/* ---- functions ---- */

void dyd_cert_enclosure_rescale(dyd_cert_enclosure *x, long by) {
  if (by >= 0) {
    mpz_mul_2exp(x->lo, x->lo, (mp_bitcnt_t)by);
    mpz_mul_2exp(x->hi, x->hi, (mp_bitcnt_t)by);
  } else {
    mpz_fdiv_q_2exp(x->lo, x->lo, (mp_bitcnt_t)-by);
    mpz_cdiv_q_2exp(x->hi, x->hi, (mp_bitcnt_t)-by);
  }
}

/* sum = floor terms of arctan(1/n) 2^p; each of *terms terms, and what follows them, is off by less than 1. */
static void inverse_tangent(mpz_ptr sum, unsigned long *terms, unsigned long n, long p) {
  mpz_t power, term;
  mpz_inits(power, term, NULL);
  mpz_set_ui(power, 1);
  mpz_mul_2exp(power, power, (mp_bitcnt_t)p);
  mpz_fdiv_q_ui(power, power, n);
  mpz_set_ui(sum, 0);
  for (*terms = 0; mpz_sgn(power); ++*terms) {
    mpz_fdiv_q_ui(term, power, 2 * *terms + 1);
    (*terms & 1 ? mpz_sub : mpz_add)(sum, sum, term);
    mpz_fdiv_q_ui(power, power, n * n);
  }
  mpz_clears(term, power, NULL);
}

/* Machin: pi = 16 arctan(1/5) - 4 arctan(1/239). */
void dyd_cert_enclosure_pi(dyd_cert_enclosure *x, long p) {
  enum { MORE = 32 };
  unsigned long terms, few;
  mpz_t part;
  mpz_init(part);
  inverse_tangent(x->lo, &terms, 5, p + MORE);
  inverse_tangent(part, &few, 239, p + MORE);
  mpz_mul_ui(x->lo, x->lo, 16);
  mpz_submul_ui(x->lo, part, 4);
  mpz_add_ui(x->hi, x->lo, 20 * (terms + few + 2));
  mpz_sub_ui(x->lo, x->lo, 20 * (terms + few + 2));
  x->known = true;
  dyd_cert_enclosure_rescale(x, -MORE);
  mpz_clear(part);
}

/* How often x has to be halved to be at most 2^-8 in absolute value. */
static long halvings(const dyd_cert_enclosure *x, long p) {
  size_t lo = mpz_sizeinbase(x->lo, 2), hi = mpz_sizeinbase(x->hi, 2);
  long bits = (long)(lo > hi ? lo : hi) + 8 - p;
  return bits > 0 ? bits : 0;
}

/* term *= r / n; false: it has become smaller than a unit. */
static bool taylor_step(dyd_cert_enclosure *term, const dyd_cert_enclosure *r, unsigned long n, long p) {
  dyd_cert_enclosure_mul(term, r, p);
  mpz_fdiv_q_ui(term->lo, term->lo, n);
  mpz_cdiv_q_ui(term->hi, term->hi, n);
  return mpz_cmpabs_ui(term->lo, 1) > 0 || mpz_cmpabs_ui(term->hi, 1) > 0;
}

/* Terms sink by a factor of 2^8 at least: those left out are less than the last one, a unit, together. */
static void add_remainder(dyd_cert_enclosure *sum) {
  mpz_sub_ui(sum->lo, sum->lo, 2);
  mpz_add_ui(sum->hi, sum->hi, 2);
}

void dyd_cert_enclosure_exp(dyd_cert_enclosure *x, long p) {
  long halved = halvings(x, p), more = 2 * halved + 64, q = p + more;
  dyd_cert_enclosure sum, term;
  DYD_INVARIANT(x->known);
  x->known = halved <= MOST_ARGUMENT - 8;
  if (!x->known) return;
  dyd_cert_enclosure_init(&sum);
  dyd_cert_enclosure_init(&term);
  dyd_cert_enclosure_rescale(x, more);
  dyd_cert_enclosure_rescale(x, -halved);
  dyd_cert_enclosure_set_si(&sum, 1, q);
  dyd_cert_enclosure_set_si(&term, 1, q);
  for (unsigned long n = 1; taylor_step(&term, x, n, q); n++) dyd_cert_enclosure_add(&sum, &term);
  add_remainder(&sum);
  for (long k = 0; k < halved; k++) dyd_cert_enclosure_mul(&sum, &sum, q);
  dyd_cert_enclosure_set(x, &sum);
  dyd_cert_enclosure_rescale(x, -more);
  dyd_cert_enclosure_clear(&term);
  dyd_cert_enclosure_clear(&sum);
}

/* c, s of twice the angle: c = 2 c^2 - 1, s = 2 s c. */
static void double_angle(dyd_cert_enclosure *c, dyd_cert_enclosure *s, long p) {
  dyd_cert_enclosure one;
  dyd_cert_enclosure_init(&one);
  dyd_cert_enclosure_set_si(&one, 1, p);
  dyd_cert_enclosure_mul(s, c, p);
  dyd_cert_enclosure_add(s, s);
  dyd_cert_enclosure_mul(c, c, p);
  dyd_cert_enclosure_add(c, c);
  dyd_cert_enclosure_sub(c, &one);
  dyd_cert_enclosure_extreme(c, -1, &one);
  dyd_cert_enclosure_extreme(s, -1, &one);
  dyd_cert_enclosure_neg(&one);
  dyd_cert_enclosure_extreme(c, 1, &one);
  dyd_cert_enclosure_extreme(s, 1, &one);
  dyd_cert_enclosure_clear(&one);
}

/* Both series of the small angle r. */
static void taylor_cos_sin(dyd_cert_enclosure *c, dyd_cert_enclosure *s, const dyd_cert_enclosure *r, long p) {
  dyd_cert_enclosure term;
  dyd_cert_enclosure_init(&term);
  dyd_cert_enclosure_set_si(c, 1, p);
  dyd_cert_enclosure_set_si(s, 0, p);
  dyd_cert_enclosure_set_si(&term, 1, p);
  for (unsigned long n = 1; taylor_step(&term, r, n, p); n++) {
    dyd_cert_enclosure *sum = n & 1 ? s : c;
    (n & 2 ? dyd_cert_enclosure_sub : dyd_cert_enclosure_add)(sum, &term);
  }
  add_remainder(c);
  add_remainder(s);
  dyd_cert_enclosure_clear(&term);
}

void dyd_cert_enclosure_cos_sin(dyd_cert_enclosure *c, dyd_cert_enclosure *s, const dyd_cert_enclosure *x, long p) {
  long halved = halvings(x, p), more = 2 * halved + 64;
  dyd_cert_enclosure r;
  DYD_INVARIANT(x->known);
  c->known = s->known = halved <= MOST_ARGUMENT + 8;
  if (!c->known) return;
  dyd_cert_enclosure_init(&r);
  dyd_cert_enclosure_set(&r, x);
  dyd_cert_enclosure_rescale(&r, more);
  dyd_cert_enclosure_rescale(&r, -halved);
  taylor_cos_sin(c, s, &r, p + more);
  for (long k = 0; k < halved; k++) double_angle(c, s, p + more);
  dyd_cert_enclosure_rescale(c, -more);
  dyd_cert_enclosure_rescale(s, -more);
  dyd_cert_enclosure_clear(&r);
}
