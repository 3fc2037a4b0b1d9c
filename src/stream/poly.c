/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Expanding expressions in x to coefficients: the expression is run over the ring of polynomials.
 *
 * Degrees add and bits add up in products, so both are bounded before a product is formed. */
#include "stream/poly.h"

#include "base/alloc.h"
#include "base/error.h"
#include "stream/root.h"
#include <flint/fmpq_poly.h>
#include <flint/fmpz_vec.h>

void dyd_poly_clear(dyd_poly *p) {
  for (size_t k = 0; k < p->count; k++) mpq_clear(p->coeff[k]);
  free(p->coeff);
  *p = (dyd_poly){0};
}

typedef struct ring {
  fmpq_poly_struct *value; /* a stack */
  size_t top, capacity;
} ring;

static void poly_set_leaf(fmpq_poly_t out, const dyd_expr *e, const dyd_node *n) {
  if (n->op == DYD_OP_X) {
    fmpq_poly_zero(out);
    fmpq_poly_set_coeff_ui(out, 1, 1);
  } else {
    fmpq_t c;
    dyd_constant_view view;
    fmpq_init(c);
    fmpq_set_mpq(c, dyd_constant_get(&view, &e->constant[n->argument]));
    fmpq_poly_set_fmpq(out, c);
    fmpq_clear(c);
  }
}

/* A bound of the bits of one coefficient. */
static size_t poly_height(const fmpq_poly_t p) {
  slong bits = FLINT_ABS(_fmpz_vec_max_bits(p->coeffs, p->length));
  return (size_t)bits + fmpz_bits(p->den) + 1;
}

static size_t poly_degree(const fmpq_poly_t p) {
  return p->length ? (size_t)p->length - 1 : 0;
}

/* Do degree and size of a product of these stay within bounds? */
static bool poly_product_fits(size_t degree_a, size_t height_a, size_t degree_b, size_t height_b) {
  size_t d = degree_a + degree_b, h = height_a + height_b + 16;
  return d <= DYD_ROOT_DEGREE && h <= DYD_ROOT_WORK / (d + 1);
}

static dyd_status poly_too_large(dyd_error *err, const dyd_node *n) {
  if (err) err->column = n->column;
  return dyd_fail(err, DYD_E_RANGE, "the polynomial becomes too large here: degree at most %zu, %zu bits in all",
                  DYD_ROOT_DEGREE, DYD_ROOT_WORK);
}

static dyd_status no_polynomial(dyd_error *err, const dyd_node *n, const char *why) {
  if (err) err->column = n->column;
  return dyd_fail(err, DYD_E_PARSE, "'%s' does not give a polynomial with rational coefficients%s",
                  dyd_op_name((dyd_op)n->op), why);
}

static dyd_status poly_raise_power(fmpq_poly_t x, const dyd_node *n, dyd_error *err) {
  if (n->argument < 0) return no_polynomial(err, n, ": the exponent is negative");
  size_t k = (size_t)n->argument, d = poly_degree(x), h = poly_height(x);
  if (k > DYD_ROOT_DEGREE || (k && !poly_product_fits(d * k, h * k, 0, k))) return poly_too_large(err, n);
  fmpq_poly_pow(x, x, (ulong)k);
  return DYD_OK;
}

/* x = x op y. */
static dyd_status poly_combine(fmpq_poly_t x, const dyd_node *n, const fmpq_poly_t y, dyd_error *err) {
  size_t a = poly_degree(x), b = poly_degree(y);
  bool sum = n->op == DYD_OP_ADD || n->op == DYD_OP_SUB;
  if (!poly_product_fits(sum && b > a ? b : a, poly_height(x), sum ? 0 : b, poly_height(y)))
    return poly_too_large(err, n);
  switch (n->op) {
  case DYD_OP_ADD:
    fmpq_poly_add(x, x, y);
    return DYD_OK;
  case DYD_OP_SUB:
    fmpq_poly_sub(x, x, y);
    return DYD_OK;
  case DYD_OP_MUL:
    fmpq_poly_mul(x, x, y);
    return DYD_OK;
  case DYD_OP_DIV:
    if (y->length > 1) return no_polynomial(err, n, ": the divisor contains x");
    if (!y->length) return no_polynomial(err, n, ": the divisor is 0");
    fmpq_poly_div(x, x, y);
    return DYD_OK;
  default:
    return no_polynomial(err, n, "");
  }
}

static dyd_status poly_apply(ring *r, const dyd_expr *e, const dyd_node *n, dyd_error *err) {
  if (n->op == DYD_OP_PI || n->op == DYD_OP_E) return no_polynomial(err, n, "");
  if (dyd_op_is_leaf((dyd_op)n->op)) {
    poly_set_leaf(&r->value[r->top++], e, n);
    return DYD_OK;
  }
  fmpq_poly_struct *x = &r->value[r->top - 1];
  if (dyd_op_is_binary((dyd_op)n->op)) {
    r->top--;
    return poly_combine(x - 1, n, x, err);
  }
  if (n->op == DYD_OP_POW) return poly_raise_power(x, n, err);
  if (n->op != DYD_OP_NEG) return no_polynomial(err, n, "");
  fmpq_poly_neg(x, x);
  return DYD_OK;
}

static dyd_status poly_copy_coefficients(dyd_poly *out, const fmpq_poly_t p, dyd_error *err) {
  out->coeff = dyd_alloc((size_t)p->length, sizeof *out->coeff);
  if (!out->coeff) return dyd_fail_nomem(err);
  fmpq_t c;
  fmpq_init(c);
  for (out->count = 0; out->count < (size_t)p->length; out->count++) {
    fmpq_poly_get_coeff_fmpq(c, p, (slong)out->count);
    mpq_init(out->coeff[out->count]);
    fmpq_get_mpq(out->coeff[out->count], c);
  }
  fmpq_clear(c);
  return DYD_OK;
}

/* The number of values held at once is at most the number of leaves. */
static bool ring_init(ring *r, const dyd_expr *e) {
  r->top = r->capacity = 0;
  for (size_t i = 0; i < e->count; i++) r->capacity += dyd_op_is_leaf((dyd_op)e->node[i].op);
  r->value = dyd_alloc(r->capacity, sizeof *r->value);
  if (!r->value) return false;
  for (size_t i = 0; i < r->capacity; i++) fmpq_poly_init(&r->value[i]);
  return true;
}

static void ring_clear(ring *r) {
  for (size_t i = 0; i < r->capacity; i++) fmpq_poly_clear(&r->value[i]);
  free(r->value);
}

dyd_status dyd_poly_expand(dyd_poly *out, const dyd_expr *e, dyd_error *err) {
  ring r;
  dyd_status st = DYD_OK;
  if (!ring_init(&r, e)) return dyd_fail_nomem(err);
  for (size_t i = 0; i < e->count && st == DYD_OK; i++) st = poly_apply(&r, e, &e->node[i], err);
  if (st == DYD_OK) st = poly_copy_coefficients(out, &r.value[0], err);
  ring_clear(&r);
  return st;
}
