/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Arithmetic of quotients. Integer factors are divided out, others are not. */
#include "checker/quotient.h"

void dyd_cert_quotient_clear(dyd_cert_quotient *x) {
  dyd_cert_poly_clear(&x->num);
  dyd_cert_poly_clear(&x->den);
}

bool dyd_cert_quotient_set(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r) {
  return dyd_cert_poly_set(&x->num, &y->num, r) && dyd_cert_poly_set(&x->den, &y->den, r);
}

/* Divides out what all coefficients have in common. */
static void quotient_shorten(dyd_cert_quotient *x) {
  mpz_t g;
  mpz_init(g);
  dyd_cert_poly_content(g, &x->den);
  dyd_cert_poly_content(g, &x->num);
  if (mpz_cmp_ui(g, 1) > 0) {
    dyd_cert_poly_divide(&x->num, g);
    dyd_cert_poly_divide(&x->den, g);
  }
  mpz_clear(g);
}

bool dyd_cert_quotient_set_q(dyd_cert_quotient *x, mpz_srcptr num, mpz_srcptr den, dyd_cert_relations *r) {
  bool fits = dyd_cert_poly_set_z(&x->num, num, r) && dyd_cert_poly_set_z(&x->den, den, r);
  if (fits) quotient_shorten(x);
  return fits;
}

bool dyd_cert_quotient_set_leaf(dyd_cert_quotient *x, size_t leaf, const dyd_cert_poly *den, dyd_cert_relations *r) {
  return dyd_cert_poly_set_leaf(&x->num, leaf, r) && dyd_cert_poly_set(&x->den, den, r);
}

bool dyd_cert_quotient_add(dyd_cert_quotient *x, int sign, const dyd_cert_quotient *y, dyd_cert_relations *r) {
  dyd_cert_poly part = {0};
  bool fits = dyd_cert_poly_set(&part, &y->num, r);
  if (fits && !dyd_cert_poly_equal(&x->den, &y->den))
    fits = dyd_cert_poly_mul(&part, &x->den, r) && dyd_cert_poly_mul(&x->num, &y->den, r) &&
           dyd_cert_poly_mul(&x->den, &y->den, r);
  fits = fits && dyd_cert_poly_add(&x->num, &part, sign, r);
  if (fits) quotient_shorten(x);
  dyd_cert_poly_clear(&part);
  return fits;
}

bool dyd_cert_quotient_mul(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r) {
  bool fits = dyd_cert_poly_mul(&x->num, &y->num, r) && dyd_cert_poly_mul(&x->den, &y->den, r);
  if (fits) quotient_shorten(x);
  return fits;
}

bool dyd_cert_quotient_mul_z(dyd_cert_quotient *x, mpz_srcptr z, dyd_cert_relations *r) {
  dyd_cert_poly product = {0};
  bool fits = dyd_cert_poly_add_scaled(&product, &x->num, z, NULL, r);
  dyd_cert_poly_clear(&x->num);
  x->num = product;
  if (fits) quotient_shorten(x);
  return fits;
}

bool dyd_cert_quotient_div(dyd_cert_quotient *x, const dyd_cert_quotient *y, dyd_cert_relations *r) {
  dyd_cert_quotient inverse = {{0}, {0}};
  bool fits = dyd_cert_quotient_set(&inverse, y, r);
  dyd_cert_quotient_invert(&inverse);
  fits = fits && dyd_cert_quotient_mul(x, &inverse, r);
  dyd_cert_quotient_clear(&inverse);
  return fits;
}

bool dyd_cert_quotient_power(dyd_cert_quotient *x, unsigned long n, dyd_cert_relations *r) {
  dyd_cert_quotient square = *x;
  mpz_t one;
  mpz_init_set_ui(one, 1);
  *x = (dyd_cert_quotient){{0}, {0}};
  bool fits = dyd_cert_quotient_set_q(x, one, one, r);
  for (; fits && n; n >>= 1) {
    if (n & 1) fits = dyd_cert_quotient_mul(x, &square, r);
    if (fits && n > 1) fits = dyd_cert_quotient_mul(&square, &square, r);
  }
  dyd_cert_quotient_clear(&square);
  mpz_clear(one);
  return fits;
}

bool dyd_cert_quotient_equal(bool *equal, const dyd_cert_quotient *x, const dyd_cert_quotient *y,
                             dyd_cert_relations *r) {
  dyd_cert_quotient difference = {{0}, {0}};
  bool fits = dyd_cert_quotient_set(&difference, x, r) && dyd_cert_quotient_add(&difference, -1, y, r);
  *equal = fits && dyd_cert_poly_is_zero(&difference.num);
  dyd_cert_quotient_clear(&difference);
  return fits;
}

void dyd_cert_quotient_neg(dyd_cert_quotient *x) {
  for (size_t t = 0; t < x->num.count; t++) mpz_neg(x->num.term[t].c, x->num.term[t].c);
}

void dyd_cert_quotient_invert(dyd_cert_quotient *x) {
  dyd_cert_poly num = x->num;
  x->num = x->den;
  x->den = num;
}
