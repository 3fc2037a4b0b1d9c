/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rational constants of expressions, short ones without memory of their own. */
#include "stream/constant.h"

#include "base/alloc.h"

/* One limb, and products with -1, 0, 1 and negation stay within int64_t. */
#define SHORT_BITS (GMP_NUMB_BITS < 64 ? GMP_NUMB_BITS - 2 : 62)

void dyd_constant_clear(dyd_constant *c) {
  if (!c->big) return;
  mpq_clear(c->big);
  free(c->big);
  c->big = NULL;
}

static bool is_short(mpz_srcptr z) {
  return mpz_sizeinbase(z, 2) <= SHORT_BITS && mpz_fits_slong_p(z);
}

dyd_status dyd_constant_set(dyd_constant *c, mpq_srcptr q) {
  if (is_short(mpq_numref(q)) && is_short(mpq_denref(q))) {
    dyd_constant_clear(c);
    c->num = mpz_get_si(mpq_numref(q));
    c->den = mpz_get_si(mpq_denref(q));
    return DYD_OK;
  }
  if (!c->big) {
    mpq_ptr big = dyd_alloc(1, sizeof *big);
    if (!big) return DYD_E_NOMEM;
    mpq_init(big);
    c->big = big;
  }
  mpq_set(c->big, q);
  return DYD_OK;
}

mpq_srcptr dyd_constant_get(dyd_constant_view *view, const dyd_constant *c) {
  if (c->big) return c->big;
  view->limb[0] = (mp_limb_t)(c->num < 0 ? -c->num : c->num);
  view->limb[1] = (mp_limb_t)c->den;
  mpz_roinit_n(mpq_numref(view->q), &view->limb[0], c->num < 0 ? -1 : 1);
  mpz_roinit_n(mpq_denref(view->q), &view->limb[1], 1);
  return view->q;
}

dyd_status dyd_constant_literal(dyd_constant *c, const dyd_literal *in) {
  uint64_t num, den;
  if (dyd_literal_words(&num, &den, in) && num >> SHORT_BITS == 0 && den >> SHORT_BITS == 0) {
    c->num = (int64_t)num;
    c->den = (int64_t)den;
    return DYD_OK;
  }
  mpq_t q;
  mpq_init(q);
  dyd_status st = dyd_literal_value(q, in);
  if (!st) st = dyd_constant_set(c, q);
  mpq_clear(q);
  return st;
}

static size_t bits(uint64_t x) {
  size_t n = 1;
  while (x >>= 1) n++;
  return n;
}

size_t dyd_constant_bits(const dyd_constant *c) {
  if (!c->big) return bits((uint64_t)(c->num < 0 ? -c->num : c->num)) + bits((uint64_t)c->den);
  return mpz_sizeinbase(mpq_numref(c->big), 2) + mpz_sizeinbase(mpq_denref(c->big), 2);
}

int dyd_constant_cmp(const dyd_constant *c, int k) {
  if (c->big) return mpq_cmp_si(c->big, k, 1);
  /* k = -1, 0, 1 in all uses: no overflow below 2^62. */
  int64_t right = k * c->den;
  return (c->num > right) - (c->num < right);
}
