/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* 2 cos(2 pi / N) and all 2 cos(2 pi k / N).
 *
 * The cyclotomic polynomial Phi_N, of degree 2m, is palindromic: z^-m Phi_N(z) is a sum of its coefficients times C_j,
 * C_j(z + 1/z) = z^j + z^-j: for z = exp(2 pi i / N) the polynomial Psi_N in 2 cos(2 pi / N), which is 0. C_0 = 2, C_1
 * = x, C_j+1 = x C_j - C_j-1. */
#include "checker/algebra.h"

#include "base/alloc.h"
#include "base/invariant.h"

#include <string.h>

/* ---- the polynomial of the cycle ---- */

static int moebius(long n) {
  int sign = 1;
  for (long q = 2; q <= n; q++) {
    if (n % q) continue;
    n /= q;
    if (n % q == 0) return 0;
    sign = -sign;
  }
  return sign;
}

static long totient(long n) {
  long count = n;
  for (long q = 2, rest = n; q <= rest; q++) {
    if (rest % q) continue;
    count -= count / q;
    while (rest % q == 0) rest /= q;
  }
  return count;
}

/* c[0 .. m]: the lower half of the coefficients of Phi_n, n > 1: the product of (1 - x^d)^moebius(n / d). */
static void cyclotomic(long *c, long m, long n) {
  for (long k = 0; k <= m; k++) c[k] = k == 0;
  for (long d = 1; d <= m; d++) {
    int sign = n % d ? 0 : moebius(n / d);
    for (long k = m; sign > 0 && k >= d; k--) c[k] -= c[k - d];
    for (long k = d; sign < 0 && k <= m; k++) c[k] += c[k - d];
  }
}

/* rest += z C_j(leaf) for the coefficients z = c[m - j] of Psi, without the power m, all signs changed. */
static bool psi_rest(dyd_cert_poly *rest, dyd_cert_algebra *a, size_t leaf, const long *c, long m) {
  dyd_cert_relations *r = &a->relations;
  uint16_t step[DYD_CERT_LEAVES] = {0};
  dyd_cert_poly now = {0}, last = {0}, next = {0};
  mpz_t z;
  mpz_init_set_si(z, -c[m]);
  step[leaf] = 1;
  bool fits = dyd_cert_poly_set_z(rest, z, r);
  mpz_set_ui(z, 2);
  fits = fits && dyd_cert_poly_set_z(&last, z, r) && dyd_cert_poly_set_leaf(&now, leaf, r);
  for (long j = 1; j <= m && fits; j++) {
    mpz_set_si(z, -c[m - j]);
    fits = dyd_cert_poly_add_scaled(rest, &now, z, NULL, r);
    mpz_set_ui(z, 1);
    dyd_cert_poly_clear(&next);
    fits = fits && dyd_cert_poly_add_scaled(&next, &now, z, step, r) && dyd_cert_poly_add(&next, &last, -1, r);
    dyd_cert_poly spare = last;
    last = now;
    now = next;
    next = spare;
  }
  if (fits) { /* the power itself, -1 */
    DYD_INVARIANT(rest->count && rest->term->e[leaf] == m && mpz_cmp_si(rest->term->c, -1) == 0);
    mpz_clear(rest->term->c);
    memmove(rest->term, rest->term + 1, --rest->count * sizeof *rest->term);
  }
  dyd_cert_poly_clear(&next);
  dyd_cert_poly_clear(&last);
  dyd_cert_poly_clear(&now);
  mpz_clear(z);
  return fits;
}

/* Psi has degree 1 or more; one of degree 1 is a relation like others. */
static bool cycle_relation(dyd_cert_number *n, dyd_cert_algebra *a, size_t leaf) {
  long order = n->exponent, m = order < 3 ? 1 : totient(order) / 2;
  long *c = dyd_alloc((size_t)m + 1, sizeof *c);
  if (!c) a->relations.nomem = true;
  if (!c) return false;
  dyd_cert_relation *to = &a->relations.leaf[leaf];
  mpz_t z;
  mpz_init_set_si(z, order == 1 ? 2 : -2);
  bool fits = true;
  if (order < 3) {
    fits = dyd_cert_poly_set_z(&to->rest, z, &a->relations);
  } else {
    cyclotomic(c, m, order);
    fits = psi_rest(&to->rest, a, leaf, c, m);
  }
  to->degree = (unsigned)m;
  a->leaf[leaf].whole = true;
  mpz_set_ui(a->leaf[leaf].bound, 2);
  mpz_set_ui(z, 1);
  fits = fits && dyd_cert_poly_set_z(&a->leaf[leaf].den, z, &a->relations) &&
         dyd_cert_quotient_set_leaf(&n->value, leaf, &a->leaf[leaf].den, &a->relations) &&
         dyd_cert_poly_reduce(&n->value.num, &a->relations);
  mpz_clear(z);
  free(c);
  return fits;
}

bool dyd_cert_cycle_begin(dyd_cert_number *n, dyd_cert_algebra *a) {
  if (a->cycle || n->exponent < 1 || n->exponent > DYD_CERT_ORDER) return false;
  size_t leaf = dyd_cert_algebra_leaf(a);
  if (leaf == DYD_CERT_LEAVES || !cycle_relation(n, a, leaf)) return false;
  a->cycle = n->exponent;
  a->cosine = dyd_alloc((size_t)a->cycle, sizeof *a->cosine);
  if (!a->cosine) a->relations.nomem = true;
  if (!a->cosine) return false;
  a->cosine[0] = a->cosine[1 % a->cycle] = (dyd_cert_poly){0};
  a->cosines = 1;
  mpz_t two;
  mpz_init_set_ui(two, 2);
  bool fits = dyd_cert_poly_set_z(&a->cosine[0], two, &a->relations);
  mpz_clear(two);
  if (a->cycle > 1 && fits) a->cosines = 2;
  return fits && (a->cycle == 1 || dyd_cert_poly_set(&a->cosine[1], &n->value.num, &a->relations));
}

/* All of them up to k. */
static bool extend_cosines(dyd_cert_algebra *a, size_t k) {
  bool fits = true;
  while (a->cosines <= k && fits) {
    dyd_cert_poly *next = &a->cosine[a->cosines++];
    *next = (dyd_cert_poly){0};
    fits = dyd_cert_poly_set(next, &next[-1], &a->relations) && dyd_cert_poly_mul(next, &a->cosine[1], &a->relations) &&
           dyd_cert_poly_add(next, &next[-2], -1, &a->relations);
  }
  return fits;
}

bool dyd_cert_cycle_cosine(dyd_cert_quotient *value, dyd_cert_algebra *a, mpz_srcptr num, mpz_srcptr den) {
  mpz_t k, two;
  long order = a->cycle ? a->cycle : 1;
  mpz_init(k);
  mpz_init_set_ui(two, 2);
  mpz_mul_si(k, num, order);
  bool fits = mpz_divisible_p(k, den);
  mpz_fdiv_q(k, k, den);
  long at = (long)mpz_fdiv_ui(k, (unsigned long)order);
  if (order - at < at) at = order - at;
  if (!a->cycle)
    fits = fits && dyd_cert_poly_set_z(&value->num, two, &a->relations);
  else
    fits = fits && extend_cosines(a, (size_t)at) && dyd_cert_poly_set(&value->num, &a->cosine[at], &a->relations);
  fits = fits && dyd_cert_poly_set_z(&value->den, two, &a->relations);
  mpz_set_ui(two, 1);
  fits = fits && dyd_cert_quotient_mul_z(value, two, &a->relations); /* in lowest terms */
  mpz_clear(two);
  mpz_clear(k);
  return fits;
}
