/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Normal forms: arithmetic is done, functions become leaves or polynomials in leaves.
 *
 * Divisors are not 0, since what the forms describe is defined [ENC-1]. Where a sign has to be known it is read off a
 * ball; a function whose sign stays open is a free variable. */
#include "stream/algebra/normal.h"

#include "base/flag.h"
#include "stream/algebra/leaves.h"

/* Greatest exponent; bits looked at for a sign. */
enum { MOST_EXPONENT = 1 << 12, SIGN_BITS = 1024 };

/* x = op of two other forms, by way of their fractions. */
static bool normal_arithmetic(dyd_fraction *x, dyd_ring *r, const dyd_form *n) {
  const dyd_fraction *a = dyd_ring_fraction(r, n->a), *b = dyd_ring_fraction(r, n->b);
  if (!a || !b) return false;
  dyd_fraction_set(x, a, r);
  return dyd_fraction_apply(x, (dyd_op)n->op, b, r);
}

/* The sign of a - b, or of a where b is DYD_NONE; 0: not known. */
static int sign_of_difference(dyd_ring *r, uint32_t a, uint32_t b) {
  int sign = 0;
  arb_t d;
  arb_init(d);
  for (slong prec = 128; prec <= SIGN_BITS && !sign; prec *= 2) {
    arb_set(d, dyd_forms_value(r->forms, a, prec));
    if (b != DYD_NONE) arb_sub(d, d, dyd_forms_value(r->forms, b, prec), prec);
    if (!arb_contains_zero(d)) sign = arf_sgn(arb_midref(d));
  }
  arb_clear(d);
  return sign;
}

static bool normal_absolute(dyd_fraction *x, dyd_ring *r, const dyd_form *n) {
  const dyd_fraction *a = dyd_ring_fraction(r, n->a);
  if (!a) return false;
  int sign = fmpz_mpoly_is_zero(a->num, r->ctx) ? 1 : sign_of_difference(r, n->a, DYD_NONE);
  if (!sign) return dyd_leaf_free(x, r, DYD_OP_ABS, a, DYD_NONE);
  dyd_fraction_set(x, a, r);
  if (sign < 0) fmpz_mpoly_neg(x->num, x->num, r->ctx);
  return true;
}

/* The lesser or the greater of two; either, where they are the same. */
static bool normal_extreme(dyd_fraction *x, dyd_ring *r, const dyd_form *n, uint32_t self) {
  const dyd_fraction *a = dyd_ring_fraction(r, n->a), *b = dyd_ring_fraction(r, n->b);
  if (!a || !b) return false;
  int sign = dyd_fraction_equal(a, b, r) ? 1 : sign_of_difference(r, n->a, n->b);
  if (!sign) return dyd_leaf_free(x, r, DYD_OP_CONST, NULL, self);
  dyd_fraction_set(x, (sign > 0) == (n->op == DYD_OP_MAX) ? a : b, r);
  return true;
}

static bool normal_power(dyd_fraction *x, dyd_ring *r, const dyd_form *n, uint32_t self) {
  const dyd_fraction *a = dyd_ring_fraction(r, n->a);
  if (!a) return false;
  if (n->exponent > MOST_EXPONENT || n->exponent < -MOST_EXPONENT) return dyd_leaf_free(x, r, DYD_OP_CONST, NULL, self);
  dyd_fraction_set(x, a, r);
  return dyd_fraction_power(x, n->exponent, r);
}

/* x = exp(u), a leaf for one of u and -u. */
static bool normal_exponential(dyd_fraction *x, dyd_ring *r, const dyd_fraction *u) {
  dyd_fraction key;
  bool negative = dyd_fraction_leads_negative(u);
  fmpz_mpoly_init(key.num, r->ctx);
  fmpz_mpoly_init(key.den, r->ctx);
  dyd_fraction_set(&key, u, r);
  if (negative) fmpz_mpoly_neg(key.num, key.num, r->ctx);
  bool fits = true;
  if (fmpz_mpoly_is_zero(u->num, r->ctx)) {
    fmpz_mpoly_one(x->num, r->ctx);
    fmpz_mpoly_one(x->den, r->ctx);
  } else {
    fits = dyd_leaf_free(x, r, DYD_OP_EXP, &key, DYD_NONE) && (!negative || dyd_fraction_power(x, -1, r));
  }
  fmpz_mpoly_clear(key.den, r->ctx);
  fmpz_mpoly_clear(key.num, r->ctx);
  return fits;
}

/* sinh = (p - q) / 2, cosh = (p + q) / 2, tanh = (p - q) / (p + q) for p = exp(u), q = 1 / p. */
static bool normal_hyperbolic(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u) {
  dyd_fraction *p = dyd_fraction_new(r), *q = dyd_fraction_new(r);
  bool fits = p && q && normal_exponential(p, r, u);
  if (fits) {
    dyd_fraction_set(q, p, r);
    fits = dyd_fraction_power(q, -1, r);
  }
  if (fits) {
    dyd_fraction_set(x, p, r);
    fits = dyd_fraction_apply(x, op == DYD_OP_COSH ? DYD_OP_ADD : DYD_OP_SUB, q, r);
  }
  if (fits && op == DYD_OP_TANH) {
    fits = dyd_fraction_apply(p, DYD_OP_ADD, q, r) && dyd_fraction_apply(x, DYD_OP_DIV, p, r);
  } else if (fits) {
    fmpz_mpoly_scalar_mul_ui(x->den, x->den, 2, r->ctx);
    dyd_fraction_lowest(x, r);
  }
  dyd_fraction_free(q, r);
  dyd_fraction_free(p, r);
  return fits;
}

static bool normal_tangent(dyd_fraction *x, dyd_ring *r, const dyd_fraction *u) {
  dyd_fraction *c = dyd_fraction_new(r);
  /* both are looked at, so that the order of the cycle grows at once */
  bool cosine = c && dyd_leaf_cosine(c, r, DYD_OP_COS, u), sine = dyd_leaf_cosine(x, r, DYD_OP_SIN, u);
  bool fits = cosine && sine && dyd_fraction_apply(x, DYD_OP_DIV, c, r);
  dyd_fraction_free(c, r);
  return fits;
}

/* Of an operation that is not listed, no more is known than that each form is one number. */
static bool normal_function(dyd_fraction *x, dyd_ring *r, const dyd_form *n, uint32_t self) {
  const dyd_fraction *u = dyd_ring_fraction(r, n->a);
  dyd_op op = (dyd_op)n->op;
  if (!u) return false;
  switch (n->op) {
  case DYD_FORM_CLAIM:
    dyd_fraction_set(x, u, r);
    return true;
  case DYD_OP_NEG:
    dyd_fraction_set(x, u, r);
    fmpz_mpoly_neg(x->num, x->num, r->ctx);
    return true;
  case DYD_OP_SQRT:
  case DYD_OP_CBRT:
    return dyd_leaf_radical(x, r, op, u);
  case DYD_OP_COS:
  case DYD_OP_SIN:
    return dyd_leaf_cosine(x, r, op, u);
  case DYD_OP_TAN:
    return normal_tangent(x, r, u);
  case DYD_OP_EXP:
    return normal_exponential(x, r, u);
  case DYD_OP_SINH:
  case DYD_OP_COSH:
  case DYD_OP_TANH:
    return normal_hyperbolic(x, r, op, u);
  case DYD_OP_LOG:
  case DYD_OP_ASIN:
  case DYD_OP_ACOS:
  case DYD_OP_ATAN:
    return dyd_leaf_free(x, r, op, u, DYD_NONE);
  default:
    return dyd_leaf_free(x, r, DYD_OP_CONST, NULL, self);
  }
}

static void normal_number(dyd_fraction *x, const dyd_ring *r, mpq_srcptr q) {
  fmpz_t num, den;
  fmpz_init(num);
  fmpz_init(den);
  fmpz_set_mpz(num, mpq_numref(q));
  fmpz_set_mpz(den, mpq_denref(q));
  dyd_fraction_set_number(x, num, den, r);
  fmpz_clear(den);
  fmpz_clear(num);
}

/* x = e, exp of 1. */
static bool normal_e(dyd_fraction *x, dyd_ring *r) {
  dyd_fraction *one = dyd_fraction_new(r);
  if (!one) return false;
  fmpz_mpoly_one(one->num, r->ctx);
  bool fits = normal_exponential(x, r, one);
  dyd_fraction_free(one, r);
  return fits;
}

static bool normal_make(dyd_fraction *x, dyd_ring *r, uint32_t self) {
  const dyd_form n = r->forms->node[self];
  switch (n.op) {
  case DYD_OP_CONST:
    normal_number(x, r, dyd_form_number(r->forms, self));
    return true;
  case DYD_OP_PI:
    return dyd_leaf_free(x, r, DYD_OP_PI, NULL, DYD_NONE);
  case DYD_OP_E:
    return normal_e(x, r);
  case DYD_FORM_ROOT:
    return dyd_leaf_root(x, r, self);
  case DYD_FORM_OPAQUE:
    return dyd_leaf_free(x, r, DYD_OP_CONST, NULL, self);
  case DYD_OP_POW:
    return normal_power(x, r, &n, self);
  case DYD_OP_ABS:
    return normal_absolute(x, r, &n);
  case DYD_OP_MIN:
  case DYD_OP_MAX:
    return normal_extreme(x, r, &n, self);
  case DYD_OP_ADD:
  case DYD_OP_SUB:
  case DYD_OP_MUL:
  case DYD_OP_DIV:
    return normal_arithmetic(x, r, &n);
  default:
    return normal_function(x, r, &n, self);
  }
}

static dyd_fraction *normal_form(dyd_ring *r, uint32_t n) {
  dyd_fraction *x = dyd_fraction_new(r);
  if (!x || normal_make(x, r, n)) return x;
  dyd_fraction_free(x, r);
  return NULL;
}

const dyd_fraction *dyd_ring_fraction(dyd_ring *r, uint32_t n) {
  if (dyd_flag_is_set(r->forms->stop)) {
    r->stale = true;
    return NULL;
  }
  if (!dyd_ring_hold(r)) {
    r->failed = true;
    return NULL;
  }
  if (!r->frac[n]) {
    dyd_fraction *made = normal_form(r, n);
    r->frac[n] = made ? made : r->none;
  }
  return r->frac[n] == r->none ? NULL : r->frac[n];
}

/* Room, base and order grow, each a few times at most. */
dyd_status dyd_ring_settle(dyd_ring *r, const uint32_t *node, size_t count) {
  enum { PASSES = 24 };
  for (int pass = 0; pass < PASSES; pass++) {
    r->stale = false;
    for (size_t k = 0; k < count; k++) dyd_ring_fraction(r, node[k]);
    if (r->failed) return DYD_E_NOMEM;
    if (!r->stale || dyd_flag_is_set(r->forms->stop)) return DYD_OK;
    dyd_status st = dyd_ring_renew(r);
    if (st != DYD_OK) return st;
  }
  return DYD_OK;
}
