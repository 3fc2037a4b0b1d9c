/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rational constants of expressions, short ones without memory of their own. */
#include "stream/constant.h"

#include "base/alloc.h"

/* One limb, and products with -1, 0, 1 and negation stay within int64_t. */
#define SHORT_BITS (GMP_NUMB_BITS < 64 ? GMP_NUMB_BITS - 2 : 62)

void dyd_constant_clear(dyd_constant *c) {
  if (dyd_constant_is_short(c)) return;
  mpq_clear(c->u.big);
  free(c->u.big);
  *c = (dyd_constant){.den = 1};
}

static bool integer_is_short(mpz_srcptr z) {
  return mpz_sizeinbase(z, 2) <= SHORT_BITS && mpz_fits_slong_p(z);
}

dyd_status dyd_constant_set(dyd_constant *c, mpq_srcptr q) {
  if (integer_is_short(mpq_numref(q)) && integer_is_short(mpq_denref(q))) {
    long num = mpz_get_si(mpq_numref(q)), den = mpz_get_si(mpq_denref(q)); /* q may be the value of c */
    dyd_constant_clear(c);
    c->u.num = num;
    c->den = den;
    return DYD_OK;
  }
  if (dyd_constant_is_short(c)) {
    mpq_ptr big = dyd_alloc(1, sizeof *big);
    if (!big) return DYD_E_NOMEM;
    mpq_init(big);
    *c = (dyd_constant){.u.big = big};
  }
  mpq_set(c->u.big, q);
  return DYD_OK;
}

mpq_srcptr dyd_constant_get(dyd_constant_view *view, const dyd_constant *c) {
  if (!dyd_constant_is_short(c)) return c->u.big;
  view->limb[0] = (mp_limb_t)(c->u.num < 0 ? -c->u.num : c->u.num);
  view->limb[1] = (mp_limb_t)c->den;
  mpz_roinit_n(mpq_numref(view->q), &view->limb[0], c->u.num < 0 ? -1 : 1);
  mpz_roinit_n(mpq_denref(view->q), &view->limb[1], 1);
  return view->q;
}

dyd_status dyd_constant_literal(dyd_constant *c, const dyd_literal *in) {
  uint64_t num, den;
  if (dyd_literal_words(&num, &den, in) && num >> SHORT_BITS == 0 && den >> SHORT_BITS == 0) {
    c->u.num = (int64_t)num;
    c->den = (int64_t)den;
    return DYD_OK;
  }
  mpq_t q;
  mpq_init(q);
  dyd_status st = dyd_literal_value(q, in);
  if (st == DYD_OK) st = dyd_constant_set(c, q);
  mpq_clear(q);
  return st;
}

static size_t bits_of_short(int64_t x) {
  mp_limb_t limb = (mp_limb_t)(x < 0 ? -x : x);
  return limb ? mpn_sizeinbase(&limb, 1, 2) : 1;
}

size_t dyd_constant_bits(const dyd_constant *c) {
  if (dyd_constant_is_short(c)) return bits_of_short(c->u.num) + bits_of_short(c->den);
  return mpz_sizeinbase(mpq_numref(c->u.big), 2) + mpz_sizeinbase(mpq_denref(c->u.big), 2);
}

int dyd_constant_cmp(const dyd_constant *c, int k) {
  if (!dyd_constant_is_short(c)) return mpq_cmp_si(c->u.big, k, 1);
  int64_t right = k * c->den;
  return (c->u.num > right) - (c->u.num < right);
}
