/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Polynomials with integer coefficients in numbered leaves, for identities that a certificate rests on.
 *
 * A leaf may have a relation x^degree = rest, rest a polynomial in lower powers of x and in leaves before: then powers
 * from degree on are replaced. What is reduced to nothing is 0 at the true leaves [CERT-10]. */
#ifndef DYD_CHECKER_POLY_H
#define DYD_CHECKER_POLY_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Leaves, terms of a polynomial, bits of a coefficient, exponents, work: at most. */
#define DYD_CERT_LEAVES 64
#define DYD_CERT_TERMS ((size_t)1 << 14)
#define DYD_CERT_BITS ((size_t)1 << 18)
#define DYD_CERT_EXPONENT 4096
#define DYD_CERT_WORK ((uint64_t)1 << 30)

typedef struct dyd_cert_term {
  mpz_t c;
  uint16_t e[DYD_CERT_LEAVES];
} dyd_cert_term;

/* Invariant: coefficients are not 0; terms descend, exponents of later leaves being compared first. {0} is 0. */
typedef struct dyd_cert_poly {
  dyd_cert_term *term;
  size_t count;
} dyd_cert_poly;

/* degree 0: the leaf is free. */
typedef struct dyd_cert_relation {
  unsigned degree;
  dyd_cert_poly rest;
} dyd_cert_relation;

/* nomem: memory was exhausted, and what returned false for it says nothing. work: terms that sums and products went
 * through, and limbs of their numbers; those of a long product are as many as pairs of terms, and more. */
typedef struct dyd_cert_relations {
  dyd_cert_relation leaf[DYD_CERT_LEAVES];
  size_t count;
  uint64_t work;
  bool nomem;
} dyd_cert_relations;

/* false: it is too much in all, as for all that follows. */
static inline bool dyd_cert_count_work(dyd_cert_relations *r, size_t work) {
  r->work += work;
  return r->work <= DYD_CERT_WORK;
}

/* Where something is beyond the limits, or memory is exhausted, these return false, and the polynomial that they were
 * to change is unspecified. p is not q, but for products. */
void dyd_cert_poly_clear(dyd_cert_poly *p);
bool dyd_cert_poly_set(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r);
bool dyd_cert_poly_set_z(dyd_cert_poly *p, mpz_srcptr z, dyd_cert_relations *r);
bool dyd_cert_poly_set_leaf(dyd_cert_poly *p, size_t leaf, dyd_cert_relations *r);
/* p += c m q; m: exponents, NULL: 1. */
bool dyd_cert_poly_add_scaled(dyd_cert_poly *p, const dyd_cert_poly *q, mpz_srcptr c, const uint16_t *m,
                              dyd_cert_relations *r);
/* p += q or p -= q. */
bool dyd_cert_poly_add(dyd_cert_poly *p, const dyd_cert_poly *q, int sign, dyd_cert_relations *r);
/* p = p q, reduced. */
bool dyd_cert_poly_mul(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r);
bool dyd_cert_poly_reduce(dyd_cert_poly *p, dyd_cert_relations *r);
bool dyd_cert_poly_equal(const dyd_cert_poly *p, const dyd_cert_poly *q);
static inline bool dyd_cert_poly_is_zero(const dyd_cert_poly *p) {
  return p->count == 0;
}
/* The value, where it is an integer; NULL: it is none, or 0. Borrowed. */
mpz_srcptr dyd_cert_poly_integer(const dyd_cert_poly *p);
/* g = the greatest common divisor of g and all coefficients; exact division by z. */
void dyd_cert_poly_content(mpz_ptr g, const dyd_cert_poly *p);
void dyd_cert_poly_divide(dyd_cert_poly *p, mpz_srcptr z);

/* In its only spelling: 0, or terms like -3*x0^2*x4, the sign before, in their order, of leaves below r->count. *end:
 * where reading stopped. */
bool dyd_cert_poly_scan(dyd_cert_poly *p, const char **end, const char *text, dyd_cert_relations *r);

#endif
