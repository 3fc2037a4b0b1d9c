/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Callbacks that are said to be roots of polynomials. */
#include "stream/real.h"

#include "base/error.h"
#include "stream/root.h"
#include <flint/fmpz_poly.h>

/* p becomes (1 + x)^n p((lo + hi x) / (1 + x)) times a number: its positive zeros are those of p between lo and hi. */
static void zoom_in(fmpz_poly_t p, const mpq_t lo, const mpq_t hi) {
  fmpz_poly_t sum, near, far, power;
  slong n = fmpz_poly_degree(p);
  mpz_t den, z;
  mpz_inits(den, z, NULL);
  fmpz_poly_init(sum);
  fmpz_poly_init(near);
  fmpz_poly_init(far);
  fmpz_poly_init(power);
  mpz_lcm(den, mpq_denref(lo), mpq_denref(hi));
  for (int k = 0; k < 2; k++) { /* near = (lo + hi x) den, far = (1 + x) den */
    mpz_divexact(z, den, mpq_denref(k ? hi : lo));
    mpz_mul(z, z, mpq_numref(k ? hi : lo));
    fmpz_t c;
    fmpz_init(c);
    fmpz_set_mpz(c, z);
    fmpz_poly_set_coeff_fmpz(near, k, c);
    fmpz_set_mpz(c, den);
    fmpz_poly_set_coeff_fmpz(far, k, c);
    fmpz_clear(c);
  }
  fmpz_poly_set_ui(power, 1); /* Horner's rule: the powers of far grow from the highest coefficient down */
  for (slong e = n; e >= 0; e--) {
    fmpz_poly_mul(sum, sum, near);
    fmpz_poly_scalar_addmul_fmpz(sum, power, fmpz_poly_get_coeff_ptr(p, e));
    fmpz_poly_mul(power, power, far);
  }
  fmpz_poly_swap(p, sum);
  fmpz_poly_clear(power);
  fmpz_poly_clear(far);
  fmpz_poly_clear(near);
  fmpz_poly_clear(sum);
  mpz_clears(den, z, NULL);
}

/* Does the root lie alone in (lo, hi)? Its polynomial has simple zeros and is not 0 at the ends; positive zeros of q(x)
 * are half the zeros of q(x^2). */
static bool root_is_alone(const dyd_root *r, const mpq_t lo, const mpq_t hi) {
  fmpz_poly_t p, squared;
  fmpz_t c;
  fmpz_init(c);
  fmpz_poly_init(p);
  fmpz_poly_init(squared);
  for (size_t k = r->count; k-- > 0;) {
    fmpz_set_mpz(c, r->coeff[k]);
    fmpz_poly_set_coeff_fmpz(p, (slong)k, c);
  }
  zoom_in(p, lo, hi);
  fmpz_poly_inflate(squared, p, 2);
  slong roots = fmpz_poly_num_real_roots(squared);
  fmpz_poly_clear(squared);
  fmpz_poly_clear(p);
  fmpz_clear(c);
  return roots == 2;
}

dyd_status dyd_real_claim_root(dyd_real *x, const mpq_t *coeff, size_t count, const mpq_t lo, const mpq_t hi,
                               dyd_error *err) {
  const void *object;
  dyd_real *root = NULL;
  if (!x || dyd_real_is_final(x) || dyd_real_object(&object, x) != DYD_REAL_OPAQUE)
    return dyd_fail(err, DYD_E_ARG,
                    "only what comes from a callback, and is not known to be exact, can be claimed to be "
                    "a root, and once");
  dyd_status st = dyd_real_root(&root, coeff, count, lo, hi, err);
  if (st != DYD_OK) return st;
  if (dyd_real_object(&object, root) == DYD_REAL_ROOT && !root_is_alone(object, lo, hi))
    st = dyd_fail(err, DYD_E_ARG, "the polynomial has several roots in the interval; give a shorter one");
  if (st == DYD_OK) st = dyd_real_set_claim(x, root, err);
  if (st != DYD_OK) dyd_real_free(root);
  return st;
}
