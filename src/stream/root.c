/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Computable reals that are roots of polynomials with rational coefficients.
 *
 * [ROOT-2] The square-free factors f_i of p with p = c prod f_i^i: where p changes its sign, the product g of the
 * f_i with odd i changes it too, and conversely; g has simple roots only. So g stands for p from then on. */
#include "stream/root.h"
#include "stream/real.h"

#include "base/error.h"
#include <flint/fmpq.h>
#include <flint/fmpz_poly.h>
#include <flint/fmpz_poly_factor.h>

static void root_release(void *user) {
  dyd_root_free(user);
}

/* The bracket as an interval. */
static dyd_status root_interval(dyd_interval *out, const dyd_root *r, int64_t bits) {
  if (!r->on_grid) return dyd_interval_set_outward(out, r->lo, r->hi, -bits - 2);
  dyd_dyadic lo, hi;
  mpz_t next;
  dyd_dyadic_init(&lo);
  dyd_dyadic_init(&hi);
  mpz_init(next);
  mpz_add_ui(next, r->slot, r->exact ? 0 : 1);
  dyd_status st = dyd_dyadic_set_z_2exp(&lo, r->slot, -r->s);
  if (st == DYD_OK) st = dyd_dyadic_set_z_2exp(&hi, next, -r->s);
  if (st == DYD_OK) st = dyd_interval_set_ends(out, &lo, &hi);
  mpz_clear(next);
  dyd_dyadic_clear(&hi);
  dyd_dyadic_clear(&lo);
  return st;
}

static dyd_status root_narrow(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_root *r = user;
  while (!dyd_root_is_narrow(r, request->bits)) {
    dyd_status st = dyd_root_step(r, request->bits, request->stop, err);
    if (st != DYD_OK) return st;
  }
  dyd_status st = root_interval(out, r, request->bits);
  if (st != DYD_OK) return dyd_fail(err, st, "the interval of a root: %s", dyd_status_text(st));
  return r->exact ? DYD_FIXED : DYD_OK;
}

/* p = the polynomial times the least common multiple of its denominators. */
static void integer_polynomial(fmpz_poly_t p, const mpq_t *coeff, size_t count) {
  mpz_t scale, c;
  fmpz_t f;
  mpz_init_set_ui(scale, 1);
  mpz_init(c);
  fmpz_init(f);
  for (size_t k = 0; k < count; k++) mpz_lcm(scale, scale, mpq_denref(coeff[k]));
  for (size_t k = count; k-- > 0;) {
    mpz_divexact(c, scale, mpq_denref(coeff[k]));
    mpz_mul(c, c, mpq_numref(coeff[k]));
    fmpz_set_mpz(f, c);
    fmpz_poly_set_coeff_fmpz(p, (slong)k, f);
  }
  fmpz_clear(f);
  mpz_clears(scale, c, NULL);
}

/* g = the part of p where its sign changes [ROOT-2]. */
static void odd_part(fmpz_poly_t g, const fmpz_poly_t p) {
  fmpz_poly_factor_t f;
  fmpz_poly_factor_init(f);
  fmpz_poly_factor_squarefree(f, p);
  fmpz_poly_one(g);
  for (slong i = 0; i < f->num; i++) {
    if (f->exp[i] % 2) fmpz_poly_mul(g, g, f->p + i);
  }
  fmpz_poly_factor_clear(f);
}

/* The exact sign at a rational. */
static int sign_at_q(const fmpz_poly_t p, const mpq_t x) {
  fmpq_t a, y;
  fmpq_init(a);
  fmpq_init(y);
  fmpq_set_mpq(a, x);
  fmpz_poly_evaluate_fmpq(y, p, a);
  int sign = fmpq_sgn(y);
  fmpq_clear(y);
  fmpq_clear(a);
  return sign;
}

static dyd_status root_new(dyd_real **out, const fmpz_poly_t g, const mpq_t lo, const mpq_t hi) {
  dyd_root *r = dyd_root_alloc((size_t)fmpz_poly_length(g));
  fmpz_t c;
  if (!r) return DYD_E_NOMEM;
  fmpz_init(c);
  for (size_t k = 0; k < r->count; k++) {
    fmpz_poly_get_coeff_fmpz(c, g, (slong)k);
    fmpz_get_mpz(r->coeff[k], c);
  }
  fmpz_clear(c);
  r->sign_left = sign_at_q(g, lo);
  mpq_set(r->lo, lo);
  mpq_set(r->hi, hi);
  dyd_status st = dyd_real_new_enclosing(out, root_narrow, root_release, r);
  if (st == DYD_OK) dyd_real_set_object(*out, DYD_REAL_ROOT, r);
  return st;
}

/* The root -c0/c1 of a polynomial of degree one. */
static dyd_status linear_root(dyd_real **out, const fmpz_poly_t g) {
  fmpq_t f;
  mpq_t q;
  fmpq_init(f);
  mpq_init(q);
  fmpq_set_fmpz_frac(f, fmpz_poly_get_coeff_ptr(g, 0), fmpz_poly_get_coeff_ptr(g, 1));
  fmpq_neg(f, f);
  fmpq_get_mpq(q, f);
  dyd_status st = dyd_real_from_q(out, q);
  mpq_clear(q);
  fmpq_clear(f);
  return st;
}

static dyd_status root_of_polynomial(dyd_real **out, const fmpz_poly_t p, const mpq_t lo, const mpq_t hi,
                                     dyd_error *err) {
  int left = sign_at_q(p, lo), right = sign_at_q(p, hi);
  if (!left) return dyd_real_from_q(out, lo);
  if (!right) return dyd_real_from_q(out, hi);
  if (left == right) {
    return dyd_fail(err, DYD_E_ARG,
                    "the polynomial is %s at both ends of the interval; give ends where its signs differ",
                    left < 0 ? "negative" : "positive");
  }
  fmpz_poly_t g;
  fmpz_poly_init(g);
  odd_part(g, p);
  dyd_status st = fmpz_poly_degree(g) == 1 ? linear_root(out, g) : root_new(out, g, lo, hi);
  fmpz_poly_clear(g);
  return st;
}

static size_t bits_of_rational(const mpq_t q) {
  return mpz_sizeinbase(mpq_numref(q), 2) + mpz_sizeinbase(mpq_denref(q), 2);
}

/* The bounds that keep every step cheap. */
static dyd_status root_check_size(const mpq_t *coeff, size_t count, const mpq_t lo, const mpq_t hi, dyd_error *err) {
  size_t most = bits_of_rational(lo) > bits_of_rational(hi) ? bits_of_rational(lo) : bits_of_rational(hi), sum = 0;
  for (size_t k = 0; k < count && k <= DYD_ROOT_DEGREE; k++) sum += bits_of_rational(coeff[k]);
  if (count <= DYD_ROOT_DEGREE + 1 && count * most <= DYD_ROOT_WORK && sum <= DYD_ROOT_WORK) return DYD_OK;
  return dyd_fail(err, DYD_E_RANGE, "the polynomial or its interval is too large: degree at most %zu, %zu bits in all",
                  DYD_ROOT_DEGREE, DYD_ROOT_WORK);
}

dyd_status dyd_real_root(dyd_real **out, const mpq_t *coeff, size_t count, const mpq_t lo, const mpq_t hi,
                         dyd_error *err) {
  while (count && !mpq_sgn(coeff[count - 1])) count--;
  if (!count)
    return dyd_fail(err, DYD_E_ARG, "the polynomial is zero everywhere; give one with a coefficient other than 0");
  if (mpq_cmp(lo, hi) > 0) return dyd_fail(err, DYD_E_ARG, "the interval is empty: its ends are in the wrong order");
  dyd_status st = root_check_size(coeff, count, lo, hi, err);
  if (st != DYD_OK) return st;
  fmpz_poly_t p;
  fmpz_poly_init(p);
  integer_polynomial(p, coeff, count);
  st = root_of_polynomial(out, p, lo, hi, err);
  fmpz_poly_clear(p);
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st == DYD_E_RANGE) return dyd_fail(err, st, "the root leaves the range of numbers; scale the input");
  return st;
}
