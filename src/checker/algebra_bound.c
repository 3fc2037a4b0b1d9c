/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Values that are 0 because they are smaller than any that is not [SEP-1]. */
#include "checker/algebra.h"

/* Bits of a bound, at most. One that is longer is of no use: what depends on a root has a degree of 2 or more, and of a
 * radicand that is longer the root is still too long for dyd_cert_poly_is_null. */
#define MOST_BOUND (2 * (size_t)DYD_CERT_PRECISION)

bool dyd_cert_poly_bound(mpz_ptr out, const dyd_cert_algebra *a, const dyd_cert_poly *q) {
  mpz_t term, power;
  bool whole = true;
  mpz_inits(term, power, NULL);
  mpz_set_ui(out, 0);
  for (size_t t = 0; t < q->count && whole; t++) {
    mpz_abs(term, q->term[t].c);
    whole = mpz_sizeinbase(term, 2) <= MOST_BOUND;
    for (size_t k = 0; k < a->relations.count && whole; k++) {
      unsigned long e = q->term[t].e[k];
      if (!e) continue;
      whole = a->leaf[k].whole && mpz_sizeinbase(a->leaf[k].bound, 2) <= MOST_BOUND / e;
      if (!whole) break;
      mpz_pow_ui(power, a->leaf[k].bound, e);
      mpz_mul(term, term, power);
      whole = mpz_sizeinbase(term, 2) <= MOST_BOUND;
    }
    mpz_add(out, out, term);
  }
  mpz_clears(term, power, NULL);
  return whole;
}

/* The degree of all choices of conjugates of what q depends on; 0: too many. Leaves come after those of their
 * relations. */
static unsigned long tower_degree(const dyd_cert_algebra *a, const dyd_cert_poly *q) {
  bool uses[DYD_CERT_LEAVES] = {false};
  unsigned long degree = 1;
  for (size_t t = 0; t < q->count; t++)
    for (size_t k = 0; k < DYD_CERT_LEAVES; k++) uses[k] = uses[k] || q->term[t].e[k];
  for (size_t l = a->relations.count; l-- > 0;) {
    const dyd_cert_relation *r = &a->relations.leaf[l];
    if (!uses[l]) continue;
    if (!a->leaf[l].whole || degree > (unsigned long)DYD_CERT_PRECISION / r->degree) return 0;
    degree *= r->degree;
    for (size_t t = 0; t < r->rest.count; t++)
      for (size_t k = 0; k < l; k++) uses[k] = uses[k] || r->rest.term[t].e[k];
  }
  return degree;
}

/* |x| < 2^-bits. */
static bool enclosure_is_below(const dyd_cert_enclosure *x, long bits, long p) {
  long most = p - bits;
  return x->known && most > 0 && (long)mpz_sizeinbase(x->lo, 2) <= most && (long)mpz_sizeinbase(x->hi, 2) <= most;
}

bool dyd_cert_poly_is_null(dyd_cert_algebra *a, const dyd_cert_poly *q) {
  dyd_cert_enclosure x;
  mpz_t most;
  if (dyd_cert_poly_is_zero(q)) return true;
  unsigned long degree = tower_degree(a, q);
  mpz_init(most);
  bool null = false, whole = degree && dyd_cert_poly_bound(most, a, q);
  size_t bits = mpz_sizeinbase(most, 2) * (degree ? degree - 1 : 0);
  dyd_cert_enclosure_init(&x);
  for (long p = 128; whole && bits < (size_t)DYD_CERT_PRECISION / 2 && p <= DYD_CERT_PRECISION && !null; p *= 2) {
    dyd_cert_poly_enclose(&x, a, q, p);
    if (dyd_cert_enclosure_sign(&x)) break;
    null = enclosure_is_below(&x, (long)bits, p);
  }
  dyd_cert_enclosure_clear(&x);
  mpz_clear(most);
  return null;
}
