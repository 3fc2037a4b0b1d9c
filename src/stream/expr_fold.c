/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact values of rational expressions: what can be said in rationals is never enclosed.
 *
 * Sizes are bounded before a power is computed: |n| (bits(q) - 1) <= bits(q^n). */
#include "stream/expr.h"
#include "stream/number.h"

static dyd_status fold_power(mpq_ptr x, long n) {
  if (!mpq_sgn(x) && n < 0) return DYD_E_DOMAIN;
  unsigned long k = n < 0 ? -(unsigned long)n : (unsigned long)n;
  size_t bits = mpz_sizeinbase(mpq_numref(x), 2), den_bits = mpz_sizeinbase(mpq_denref(x), 2);
  if (den_bits > bits) bits = den_bits;
  if (bits > 1 && k > (size_t)DYD_EXP_LIMIT / (bits - 1)) return DYD_E_RANGE;
  if (bits == 1) k = k ? 2 - k % 2 : 0; /* -1, 0, 1 */
  mpz_pow_ui(mpq_numref(x), mpq_numref(x), k);
  mpz_pow_ui(mpq_denref(x), mpq_denref(x), k);
  if (n < 0) mpq_inv(x, x);
  return dyd_rational_fits(x);
}

/* x = its square or cube root when numerator and denominator are perfect powers. */
static bool fold_root(mpq_ptr x, unsigned long k) {
  mpq_t r;
  mpq_init(r);
  bool done = mpz_root(mpq_numref(r), mpq_numref(x), k) && mpz_root(mpq_denref(r), mpq_denref(x), k);
  if (done) mpq_swap(x, r);
  mpq_clear(r);
  return done;
}

/* The functions with a rational value at 0 or 1 that is not a limit: f(at) = value. */
static bool fold_special(mpq_ptr x, dyd_op op) {
  bool at_one = op == DYD_OP_LOG || op == DYD_OP_ACOS;
  bool gives_one = op == DYD_OP_EXP || op == DYD_OP_COS || op == DYD_OP_COSH;
  if (mpq_cmp_ui(x, at_one ? 1 : 0, 1)) return false;
  mpq_set_ui(x, gives_one ? 1 : 0, 1);
  return true;
}

static dyd_status fold_unary(mpq_ptr x, bool *done, dyd_op op, long exponent) {
  *done = true;
  switch (op) {
  case DYD_OP_NEG:
    mpq_neg(x, x);
    return DYD_OK;
  case DYD_OP_ABS:
    mpq_abs(x, x);
    return DYD_OK;
  case DYD_OP_POW:
    return fold_power(x, exponent);
  case DYD_OP_SQRT:
    if (mpq_sgn(x) < 0) return DYD_E_DOMAIN;
    *done = fold_root(x, 2);
    return DYD_OK;
  case DYD_OP_CBRT:
    *done = fold_root(x, 3);
    return DYD_OK;
  case DYD_OP_LOG:
    if (mpq_sgn(x) <= 0) return DYD_E_DOMAIN;
    break;
  case DYD_OP_ASIN:
  case DYD_OP_ACOS:
    if (mpq_cmp_si(x, 1, 1) > 0 || mpq_cmp_si(x, -1, 1) < 0) return DYD_E_DOMAIN;
    break;
  default:
    break;
  }
  *done = fold_special(x, op);
  return DYD_OK;
}

static dyd_status fold_binary(mpq_ptr x, dyd_op op, mpq_srcptr y) {
  static void (*const function[])(mpq_ptr, mpq_srcptr, mpq_srcptr) = {
      [DYD_OP_ADD] = mpq_add, [DYD_OP_SUB] = mpq_sub, [DYD_OP_MUL] = mpq_mul, [DYD_OP_DIV] = mpq_div};
  if (op == DYD_OP_DIV && !mpq_sgn(y)) return DYD_E_DOMAIN;
  if (op != DYD_OP_MIN && op != DYD_OP_MAX)
    function[op](x, x, y);
  else if ((mpq_cmp(y, x) < 0) == (op == DYD_OP_MIN))
    mpq_set(x, y);
  return dyd_rational_fits(x);
}

/* x = op of a copy of x, where that is rational. */
static dyd_status with_rational(dyd_constant *x, bool *done, dyd_op op, long exponent, const dyd_constant *y) {
  dyd_constant_view view;
  mpq_t q;
  mpq_init(q);
  mpq_set(q, dyd_constant_get(&view, x));
  *done = true;
  dyd_status st = y ? fold_binary(q, op, dyd_constant_get(&view, y)) : fold_unary(q, done, op, exponent);
  if (st == DYD_OK && *done) st = dyd_constant_set(x, q);
  mpq_clear(q);
  return st;
}

/* Is the short positive constant surely no square of a rational? */
static bool is_no_square(const dyd_constant *x) {
  if (!dyd_constant_is_short(x) || x->u.num <= 0) return false;
  mp_limb_t num = (mp_limb_t)x->u.num, den = (mp_limb_t)x->den;
  return !mpn_perfect_square_p(&num, 1) || !mpn_perfect_square_p(&den, 1);
}

dyd_status dyd_fold_unary(dyd_constant *x, bool *done, dyd_op op, long exponent) {
  *done = op == DYD_OP_NEG;
  if (op == DYD_OP_SQRT && is_no_square(x)) return DYD_OK;
  if (op != DYD_OP_NEG || !dyd_constant_is_short(x)) return with_rational(x, done, op, exponent, NULL);
  x->u.num = -x->u.num;
  return DYD_OK;
}

dyd_status dyd_fold_binary(dyd_constant *x, dyd_op op, const dyd_constant *y) {
  bool done;
  return with_rational(x, &done, op, 0, y);
}
