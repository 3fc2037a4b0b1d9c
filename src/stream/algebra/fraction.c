/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Arithmetic of fractions. Numerators and denominators are reduced; integer factors are divided out, others are not. */
#include "stream/algebra/fraction.h"

#include <flint/fmpz_vec.h>

void dyd_fraction_set(dyd_fraction *x, const dyd_fraction *y, const dyd_ring *r) {
  fmpz_mpoly_set(x->num, y->num, r->ctx);
  fmpz_mpoly_set(x->den, y->den, r->ctx);
}

void dyd_fraction_set_number(dyd_fraction *x, const fmpz_t num, const fmpz_t den, const dyd_ring *r) {
  fmpz_mpoly_set_fmpz(x->num, num, r->ctx);
  fmpz_mpoly_set_fmpz(x->den, den, r->ctx);
  dyd_fraction_lowest(x, r);
}

void dyd_fraction_set_leaf(dyd_fraction *x, slong k, const fmpz_t den, const dyd_ring *r) {
  dyd_ring_gen(x->num, r, k);
  fmpz_mpoly_set_fmpz(x->den, den, r->ctx);
}

void dyd_fraction_lowest(dyd_fraction *x, const dyd_ring *r) {
  fmpz_mpoly_struct *num = x->num, *den = x->den;
  fmpz_t g, h;
  fmpz_init(g);
  fmpz_init(h);
  _fmpz_vec_content(g, num->coeffs, num->length);
  _fmpz_vec_content(h, den->coeffs, den->length);
  fmpz_gcd(g, g, h);
  if (den->length && fmpz_sgn(den->coeffs) < 0) fmpz_neg(g, g);
  if (!fmpz_is_one(g) && !fmpz_is_zero(g)) {
    fmpz_mpoly_scalar_divexact_fmpz(num, num, g, r->ctx);
    fmpz_mpoly_scalar_divexact_fmpz(den, den, g, r->ctx);
  }
  fmpz_clear(h);
  fmpz_clear(g);
}

/* The sum or difference of numerators brought to one denominator, the least for integers. */
static bool fraction_sum(dyd_fraction *x, bool minus, const dyd_fraction *y, const dyd_ring *r) {
  fmpz_mpoly_t t;
  bool fits = true;
  fmpz_mpoly_init(t, r->ctx);
  if (fmpz_mpoly_equal(x->den, y->den, r->ctx)) {
    fmpz_mpoly_set(t, y->num, r->ctx);
  } else if (fmpz_mpoly_is_fmpz(x->den, r->ctx) && fmpz_mpoly_is_fmpz(y->den, r->ctx)) {
    fmpz_t g, p, q; /* p = lcm / den(x), q = lcm / den(y) */
    fmpz_init(g);
    fmpz_init(p);
    fmpz_init(q);
    fmpz_gcd(g, x->den->coeffs, y->den->coeffs);
    fmpz_divexact(p, y->den->coeffs, g);
    fmpz_divexact(q, x->den->coeffs, g);
    fmpz_mpoly_scalar_mul_fmpz(x->num, x->num, p, r->ctx);
    fmpz_mpoly_scalar_mul_fmpz(x->den, x->den, p, r->ctx);
    fmpz_mpoly_scalar_mul_fmpz(t, y->num, q, r->ctx);
    fmpz_clear(q);
    fmpz_clear(p);
    fmpz_clear(g);
  } else {
    fits = dyd_ring_mul(t, r, y->num, x->den) && dyd_ring_mul(x->num, r, x->num, y->den) &&
           dyd_ring_mul(x->den, r, x->den, y->den);
  }
  if (minus)
    fmpz_mpoly_sub(x->num, x->num, t, r->ctx);
  else
    fmpz_mpoly_add(x->num, x->num, t, r->ctx);
  fmpz_mpoly_clear(t, r->ctx);
  return fits;
}

/* x = 1 / x. */
static bool fraction_invert(dyd_fraction *x, const dyd_ring *r) {
  fmpz_mpoly_swap(x->num, x->den, r->ctx);
  return !fmpz_mpoly_is_zero(x->den, r->ctx);
}

bool dyd_fraction_apply(dyd_fraction *x, dyd_op op, const dyd_fraction *y, const dyd_ring *r) {
  bool fits;
  if (op == DYD_OP_ADD || op == DYD_OP_SUB) {
    fits = fraction_sum(x, op == DYD_OP_SUB, y, r);
  } else {
    bool divide = op == DYD_OP_DIV;
    fits = !divide || !fmpz_mpoly_is_zero(y->num, r->ctx);
    fmpz_mpoly_t t; /* x and y may be the same */
    fmpz_mpoly_init(t, r->ctx);
    fits = fits && dyd_ring_mul(t, r, x->num, divide ? y->den : y->num) &&
           dyd_ring_mul(x->den, r, x->den, divide ? y->num : y->den);
    fmpz_mpoly_swap(x->num, t, r->ctx);
    fmpz_mpoly_clear(t, r->ctx);
    fits = fits && !fmpz_mpoly_is_zero(x->den, r->ctx);
  }
  if (fits) dyd_fraction_lowest(x, r);
  return fits;
}

bool dyd_fraction_power(dyd_fraction *x, slong n, const dyd_ring *r) {
  dyd_fraction square = {0};
  bool fits = n >= 0 || fraction_invert(x, r);
  if (n < 0) n = -n;
  fmpz_mpoly_init(square.num, r->ctx);
  fmpz_mpoly_init(square.den, r->ctx);
  dyd_fraction_set(&square, x, r);
  fmpz_mpoly_one(x->num, r->ctx);
  fmpz_mpoly_one(x->den, r->ctx);
  for (; fits && n; n >>= 1) {
    if (n & 1) fits = dyd_fraction_apply(x, DYD_OP_MUL, &square, r);
    if (fits && n > 1) fits = dyd_fraction_apply(&square, DYD_OP_MUL, &square, r);
  }
  fmpz_mpoly_clear(square.den, r->ctx);
  fmpz_mpoly_clear(square.num, r->ctx);
  if (fits) dyd_fraction_lowest(x, r);
  return fits;
}

bool dyd_fraction_equal(const dyd_fraction *x, const dyd_fraction *y, const dyd_ring *r) {
  return fmpz_mpoly_equal(x->num, y->num, r->ctx) && fmpz_mpoly_equal(x->den, y->den, r->ctx);
}

bool dyd_fraction_get_number(fmpz_t num, fmpz_t den, const dyd_fraction *x, const dyd_ring *r) {
  if (!fmpz_mpoly_is_fmpz(x->num, r->ctx) || !fmpz_mpoly_is_fmpz(x->den, r->ctx)) return false;
  fmpz_mpoly_get_fmpz(num, x->num, r->ctx);
  fmpz_mpoly_get_fmpz(den, x->den, r->ctx);
  return true;
}
