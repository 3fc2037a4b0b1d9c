/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Roots of polynomials, each in a bracket. */
#include "checker/algebra.h"

/* Coefficients times the bits of the longest number: twice what the engine takes, a second or two. */
#define ROOT_BITS ((size_t)1 << 23)

/* The bits of the longest of the ends and, for `all`, of the coefficients. */
static size_t longest_of(const dyd_cert_bracket *r, bool all) {
  size_t most = 0;
  for (size_t k = 0; k < (all ? r->count : 0); k++) {
    size_t bits = mpz_sizeinbase(r->coeff[k], 2);
    if (bits > most) most = bits;
  }
  for (int k = 0; k < 4; k++) {
    size_t bits = mpz_sizeinbase(r->end[k], 2);
    if (bits > most) most = bits;
  }
  return most;
}

/* The sign of f at num / den, den > 0. */
static int sign_at_fraction(const dyd_cert_bracket *f, mpz_srcptr num, mpz_srcptr den) {
  mpz_t sum, power;
  mpz_init(sum);
  mpz_init_set_ui(power, 1);
  for (size_t k = f->count; k-- > 0;) {
    mpz_mul(sum, sum, num);
    mpz_addmul(sum, f->coeff[k], power);
    mpz_mul(power, power, den);
  }
  int sign = mpz_sgn(sum);
  mpz_clears(sum, power, NULL);
  return sign;
}

/* The enclosure of the derivative over the bracket, Horner's rule. */
static int sign_of_derivative(const dyd_cert_bracket *f, long p) {
  dyd_cert_enclosure x, y, c;
  mpz_t k;
  mpz_init(k);
  dyd_cert_enclosure_init(&x);
  dyd_cert_enclosure_init(&y);
  dyd_cert_enclosure_init(&c);
  dyd_cert_enclosure_set_q(&x, f->end[0], f->end[1], p);
  dyd_cert_enclosure_set_q(&c, f->end[2], f->end[3], p);
  mpz_set(x.hi, c.hi);
  for (size_t e = f->count - 1; e > 0; e--) {
    mpz_mul_ui(k, f->coeff[e], e);
    mpz_mul_2exp(c.lo, k, (mp_bitcnt_t)p);
    mpz_set(c.hi, c.lo);
    dyd_cert_enclosure_mul(&y, &x, p);
    dyd_cert_enclosure_add(&y, &c);
  }
  int sign = dyd_cert_enclosure_sign(&y);
  dyd_cert_enclosure_clear(&c);
  dyd_cert_enclosure_clear(&y);
  dyd_cert_enclosure_clear(&x);
  mpz_clear(k);
  return sign;
}

/* Signs differ at the ends, and f is monotonic between them. */
bool dyd_cert_root_is_single(const dyd_cert_bracket *r) {
  mpz_t left, right;
  size_t longest = longest_of(r, true);
  if (longest > DYD_CERT_BITS || longest > ROOT_BITS / r->count) return false;
  mpz_inits(left, right, NULL);
  mpz_mul(left, r->end[0], r->end[3]);
  mpz_mul(right, r->end[2], r->end[1]);
  bool good = mpz_cmp(left, right) < 0;
  mpz_clears(left, right, NULL);
  if (!good || sign_at_fraction(r, r->end[0], r->end[1]) * sign_at_fraction(r, r->end[2], r->end[3]) >= 0) return false;
  long p = 256 + (long)mpz_sizeinbase(r->end[1], 2) + (long)mpz_sizeinbase(r->end[3], 2);
  return p <= DYD_CERT_PRECISION && sign_of_derivative(r, p);
}

/* Words multiplied are about a 2^13th of n^2 m^3 for numbers of m bits: a second or two. */
#define ROOT_WORK ((uint64_t)1 << 46)

/* Bisection on multiples of 2^-p within the bracket; signs are exact. */
void dyd_cert_root_enclose(dyd_cert_enclosure *out, const dyd_cert_bracket *r, long p) {
  dyd_cert_enclosure end;
  mpz_t middle, den;
  uint64_t count = r->count, bits = (uint64_t)p + longest_of(r, false);
  out->known = count * count * bits <= ROOT_WORK / (bits * bits);
  if (!out->known) return;
  dyd_cert_enclosure_init(&end);
  mpz_init(middle);
  mpz_init_set_ui(den, 1);
  mpz_mul_2exp(den, den, (mp_bitcnt_t)p);
  dyd_cert_enclosure_set_q(out, r->end[0], r->end[1], p);
  dyd_cert_enclosure_set_q(&end, r->end[2], r->end[3], p);
  mpz_set(out->hi, end.hi);
  int left = sign_at_fraction(r, r->end[0], r->end[1]);
  for (mpz_sub(middle, out->hi, out->lo); mpz_cmp_ui(middle, 1) > 0; mpz_sub(middle, out->hi, out->lo)) {
    mpz_add(middle, out->lo, out->hi);
    mpz_fdiv_q_2exp(middle, middle, 1);
    int sign = sign_at_fraction(r, middle, den);
    if (sign == left)
      mpz_set(out->lo, middle);
    else
      mpz_set(out->hi, middle);
    if (sign == 0) mpz_set(out->lo, middle);
  }
  mpz_clears(middle, den, NULL);
  dyd_cert_enclosure_clear(&end);
}
