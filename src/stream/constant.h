/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rational constants of expressions: two words where these suffice, a rational of its own otherwise. */
#ifndef DYD_STREAM_CONSTANT_H
#define DYD_STREAM_CONSTANT_H

#include "stream/number.h"

/* den > 0: the value is num / den in lowest terms, |num| and den below 2^62; den = 0: the value is *big, owned. */
typedef struct dyd_constant {
  union {
    int64_t num;
    mpq_ptr big;
  } u;
  int64_t den;
} dyd_constant;

static inline bool dyd_constant_is_short(const dyd_constant *c) {
  return c->den != 0;
}

/* A place in which a short constant looks like a rational. */
typedef struct dyd_constant_view {
  mpq_t q;
  mp_limb_t limb[2];
} dyd_constant_view;

void dyd_constant_clear(dyd_constant *c);
/* c (0/1 or any value before) = q. DYD_OK or DYD_E_NOMEM (c unchanged). */
dyd_status dyd_constant_set(dyd_constant *c, mpq_srcptr q);
/* The value; borrowed from c and *view. */
mpq_srcptr dyd_constant_get(dyd_constant_view *view, const dyd_constant *c);
/* The value of a literal, as dyd_literal_value; c is 0/1 before. */
dyd_status dyd_constant_literal(dyd_constant *c, const dyd_literal *in);
/* Bits of numerator and denominator together, each at least 1. */
size_t dyd_constant_bits(const dyd_constant *c);
/* Sign of c - k, |k| <= 1. */
int dyd_constant_cmp(const dyd_constant *c, int k);

#endif
