/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Expressions: their constants and memory, what their form says of their values, exact folding, and a recursive-descent
 * parser that folds rational parts as it goes.
 *
 *   sum     = product { (+|-) product }          product = signed { (*|/) signed }
 *   signed  = { + | - } power                    power   = primary [ ^ signed ]      (so -2^2 = -4, 2^3^2 = 2^9)
 *   primary = literal | pi | e | x | root ( .. ) | function ( sum {, sum} ) | ( sum )
 *
 * "+-" outside parentheses ends an expression: it introduces a radius. */
#include "stream/expr.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "stream/number.h"

#include <string.h>

/* Rational constants of expressions, short ones without memory of their own. */

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

/* The value of a literal, as dyd_literal_value; c is 0/1 before. */
static dyd_status constant_literal(dyd_constant *c, const dyd_numeral *in) {
  uint64_t num, den;
  if (dyd_literal_words(&num, &den, in) && num >> SHORT_BITS == 0 && den >> SHORT_BITS == 0) {
    c->u.num = (int64_t)num;
    c->den = (int64_t)den;
    return DYD_OK;
  }
  DYD_LOCAL_NUMBERS(mpq, q);
  dyd_status st = dyd_literal_value(q, in);
  return st == DYD_OK ? dyd_constant_set(c, q) : st;
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

/* The life of expressions: drafts that grow while they are parsed, and finished ones in one block. */

void dyd_draft_init(dyd_draft *d) {
  d->e = (dyd_expr){.node = d->node, .constant = d->constant};
  d->node_cap = sizeof d->node / sizeof *d->node;
  d->constant_cap = sizeof d->constant / sizeof *d->constant;
  d->root_cap = 0;
}

void dyd_expr_clear(dyd_expr *e) {
  for (size_t i = 0; i < e->constants; i++) dyd_constant_clear(&e->constant[i]);
  for (size_t i = 0; i < e->roots; i++) dyd_real_free(e->root[i]);
  e->count = e->constants = e->roots = 0;
}

void dyd_draft_clear(dyd_draft *d) {
  dyd_expr_clear(&d->e);
  if (d->e.node != d->node) free(d->e.node);
  if (d->e.constant != d->constant) free(d->e.constant);
  free(d->e.root);
  dyd_draft_init(d);
}

/* Room for one more than `count` items of `size` bytes in *array, which is `own` until it has to move. */
static bool draft_reserve(void **array, size_t *cap, size_t count, size_t size, void *own) {
  if (count < *cap) return true;
  void *block = *array == own ? NULL : *array;
  size_t block_cap = block ? *cap : 0;
  if (!dyd_reserve(&block, &block_cap, 2 * count, size)) return false;
  if (*array == own) memcpy(block, own, count * size);
  *array = block;
  *cap = block_cap;
  return true;
}

bool dyd_draft_reserve_node(dyd_draft *d) {
  return draft_reserve((void **)&d->e.node, &d->node_cap, d->e.count, sizeof *d->node, d->node);
}

bool dyd_draft_reserve_constant(dyd_draft *d) {
  return draft_reserve((void **)&d->e.constant, &d->constant_cap, d->e.constants, sizeof *d->constant, d->constant);
}

bool dyd_draft_reserve_root(dyd_draft *d) {
  return DYD_GROW(d->e.root, d->root_cap, d->e.roots + 1);
}

size_t dyd_expr_size(const dyd_expr *e) {
  return e->roots * sizeof *e->root + e->constants * sizeof *e->constant + e->count * sizeof *e->node;
}

void dyd_expr_take(dyd_expr *out, dyd_draft *d) {
  out->count = d->e.count;
  out->constants = d->e.constants;
  out->roots = d->e.roots;
  out->root = (dyd_real **)(void *)(out + 1); /* 8 bytes aligned, as dyd_expr is */
  out->constant = (dyd_constant *)(void *)(out->root + out->roots);
  out->node = (dyd_node *)(void *)(out->constant + out->constants);
  memcpy(out->constant, d->e.constant, out->constants * sizeof *out->constant);
  if (out->roots) memcpy(out->root, d->e.root, out->roots * sizeof *out->root);
  memcpy(out->node, d->e.node, out->count * sizeof *out->node);
  d->e.constants = d->e.roots = 0;
}

const dyd_constant *dyd_expr_rational(const dyd_expr *e) {
  return e->count == 1 && e->node[0].op == DYD_OP_CONST ? &e->constant[e->node[0].argument] : NULL;
}

/* What the form of an expression says about its sign and about the unit interval.
 *
 * [RANGE-1] An interval arithmetic with ends among -1, 0, 1 and "none": if the operands lie in their ranges and
 * the operation is defined, the result lies in the range given here. It makes sqrt(abs(t)) and asin(sin(t))
 * computable at the edge of their domains, where enclosures of t alone would never decide. */

#define NONE DYD_NO_END

static const dyd_range anything = {-NONE, NONE};

static int range_least(int a, int b) {
  return a < b ? a : b;
}

static int range_most(int a, int b) {
  return a > b ? a : b;
}

/* Weakens ends to representable ones: lower ends to -1, 0, 1 from above, upper ends from below. */
static dyd_range range_make(int lo, int hi) {
  int l = lo < -1 ? -NONE : range_least(lo, 1);
  int h = hi > 1 ? NONE : range_most(hi, -1);
  return (dyd_range){(signed char)l, (signed char)h};
}

dyd_range dyd_range_of_constant(const dyd_constant *c) {
  int lo = -NONE, hi = NONE;
  for (int k = -1; k <= 1; k++) {
    if (dyd_constant_cmp(c, k) >= 0) lo = k;
    if (dyd_constant_cmp(c, -k) <= 0) hi = -k;
  }
  return range_make(lo, hi);
}

static dyd_range range_neg(dyd_range a) {
  return range_make(-a.hi, -a.lo);
}

static dyd_range range_add(dyd_range a, dyd_range b) {
  int lo = a.lo == -NONE || b.lo == -NONE ? -NONE : a.lo + b.lo;
  int hi = a.hi == NONE || b.hi == NONE ? NONE : a.hi + b.hi;
  return range_make(lo, hi);
}

static bool range_is_unit(dyd_range a) {
  return a.lo >= -1 && a.hi <= 1;
}

/* The product: corners when both are bounded, signs and |.| >= 1 otherwise. */
static dyd_range range_mul(dyd_range a, dyd_range b) {
  if (range_is_unit(a) && range_is_unit(b)) {
    int p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
    return range_make(range_least(range_least(p, q), range_least(r, s)),
                      range_most(range_most(p, q), range_most(r, s)));
  }
  if (a.hi <= 0 && a.lo < 0) return range_neg(range_mul(range_neg(a), b));
  if (b.hi <= 0 && b.lo < 0) return range_neg(range_mul(a, range_neg(b)));
  if (a.lo >= 0 && b.lo >= 0) return range_make(a.lo * b.lo, NONE);
  return anything;
}

/* The quotient by a number of known sign. */
static dyd_range range_div(dyd_range a, dyd_range b) {
  if (b.hi <= 0 && b.lo < 0) return range_neg(range_div(a, range_neg(b)));
  if (b.lo < 0) return anything;
  bool shrinks = b.lo >= 1;
  int lo = a.lo >= 0 ? 0 : shrinks && a.lo >= -1 ? -1 : -NONE;
  int hi = a.hi <= 0 ? 0 : shrinks && a.hi <= 1 ? 1 : NONE;
  return range_make(lo, hi);
}

static dyd_range range_abs(dyd_range a) {
  if (a.lo >= 0) return a;
  if (a.hi <= 0) return range_neg(a);
  return range_make(0, range_is_unit(a) ? 1 : NONE);
}

static dyd_range range_pow(dyd_range a, long n) {
  if (n == 0) return range_make(1, 1);
  dyd_range base = n % 2 ? a : range_abs(a);
  if (n < 0) return range_div(range_make(1, 1), base);
  return base;
}

/* Odd increasing functions: the sign is kept. */
static dyd_range range_sign(dyd_range a) {
  return range_make(a.lo >= 0 ? 0 : -NONE, a.hi <= 0 ? 0 : NONE);
}

static dyd_range range_meet(dyd_range a, dyd_range b) {
  return range_make(range_most(a.lo, b.lo), range_least(a.hi, b.hi));
}

static dyd_range range_function(dyd_op op, dyd_range a) {
  switch (op) {
  case DYD_OP_SQRT:
    return range_meet(range_make(0, NONE), range_make(a.lo, a.hi >= 0 ? a.hi : 0));
  case DYD_OP_CBRT:
    return a;
  case DYD_OP_EXP: /* monotone, 0 -> 1 */
    return range_make(a.lo >= 0 ? 1 : 0, a.hi <= 0 ? 1 : NONE);
  case DYD_OP_LOG: /* monotone, 1 -> 0 */
    return range_make(a.lo >= 1 ? 0 : -NONE, a.hi <= 1 ? 0 : NONE);
  case DYD_OP_SIN:
  case DYD_OP_COS:
    return range_make(-1, 1);
  case DYD_OP_TANH:
    return range_meet(range_make(-1, 1), range_sign(a));
  case DYD_OP_ASIN:
  case DYD_OP_ATAN:
  case DYD_OP_SINH:
    return range_sign(a);
  case DYD_OP_ACOS:
    return range_make(0, NONE);
  case DYD_OP_COSH:
    return range_make(1, NONE);
  case DYD_OP_ABS:
    return range_abs(a);
  default:
    return anything;
  }
}

dyd_range dyd_range_apply(dyd_op op, dyd_range a, dyd_range b, long exponent) {
  switch (op) {
  case DYD_OP_X:
    return anything;
  case DYD_OP_PI:
  case DYD_OP_E:
    return range_make(1, NONE);
  case DYD_OP_ADD:
    return range_add(a, b);
  case DYD_OP_SUB:
    return range_add(a, range_neg(b));
  case DYD_OP_MUL:
    return range_mul(a, b);
  case DYD_OP_DIV:
    return range_div(a, b);
  case DYD_OP_MIN:
    return range_make(range_least(a.lo, b.lo), range_least(a.hi, b.hi));
  case DYD_OP_MAX:
    return range_make(range_most(a.lo, b.lo), range_most(a.hi, b.hi));
  case DYD_OP_NEG:
    return range_neg(a);
  case DYD_OP_POW:
    return range_pow(a, exponent);
  default:
    return range_function(op, a);
  }
}

/* Exact values of rational expressions: a value with a rational form is never enclosed.
 *
 * Sizes are bounded before a power is computed: |n| (bits(q) - 1) <= bits(q^n). */

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
  DYD_LOCAL_NUMBERS(mpq, r);
  bool done = mpz_root(mpq_numref(r), mpq_numref(x), k) && mpz_root(mpq_denref(r), mpq_denref(x), k);
  if (done) mpq_swap(x, r);
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
  DYD_LOCAL_NUMBERS(mpq, q);
  mpq_set(q, dyd_constant_get(&view, x));
  *done = true;
  dyd_status st = y ? fold_binary(q, op, dyd_constant_get(&view, y)) : fold_unary(q, done, op, exponent);
  if (st == DYD_OK && *done) st = dyd_constant_set(x, q);
  return st;
}

/* Returns true if the short positive constant is certainly not a square of a rational. */
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

typedef struct parser {
  dyd_draft *d;
  dyd_expr *e; /* &d->e */
  const char *text;
  size_t length, pos;
  size_t start, start_column; /* all that is part of an expression is ASCII: columns count on from here */
  unsigned depth, parentheses;
  size_t work; /* bits of rationals computed so far */
  dyd_expr_names names;
  dyd_error *err;
} parser;

static const struct {
  char name[5];
  dyd_op op;
} names[] = {{"pi", DYD_OP_PI},     {"e", DYD_OP_E},       {"min", DYD_OP_MIN},   {"max", DYD_OP_MAX},
             {"sqrt", DYD_OP_SQRT}, {"cbrt", DYD_OP_CBRT}, {"exp", DYD_OP_EXP},   {"log", DYD_OP_LOG},
             {"sin", DYD_OP_SIN},   {"cos", DYD_OP_COS},   {"tan", DYD_OP_TAN},   {"asin", DYD_OP_ASIN},
             {"acos", DYD_OP_ACOS}, {"atan", DYD_OP_ATAN}, {"sinh", DYD_OP_SINH}, {"cosh", DYD_OP_COSH},
             {"tanh", DYD_OP_TANH}, {"abs", DYD_OP_ABS},   {"x", DYD_OP_X}};

const char *const dyd_real_words[DYD_WORDS] = {"root", "random", "slow"};

#define NAME_COUNT (sizeof names / sizeof names[0])

const char *dyd_op_name(dyd_op op) {
  for (size_t i = 0; i < NAME_COUNT; i++) {
    if (names[i].op == op) return names[i].name;
  }
  if (op == DYD_OP_ROOT) return "root";
  return op == DYD_OP_DIV ? "/" : op == DYD_OP_POW ? "^" : op == DYD_OP_MUL ? "*" : op == DYD_OP_ADD ? "+" : "-";
}

static dyd_status parse_sum(parser *p);

static dyd_status parse_signed(parser *p);

#define FAIL(p, at, code, ...) dyd_text_fail((p)->err, (code), (p)->text, (at), __VA_ARGS__)

static int peek_char(parser *p) {
  while (p->pos < p->length && dyd_is_blank(p->text[p->pos])) p->pos++;
  return p->pos < p->length ? (unsigned char)p->text[p->pos] : -1;
}

static dyd_node *last_node(parser *p) {
  return &p->e->node[p->e->count - 1];
}

/* The constant that the last node names. */
static dyd_constant *last_constant(parser *p) {
  return &p->e->constant[last_node(p)->argument];
}

/* Takes the last node, a constant, off the end. */
static void drop_constant(parser *p) {
  dyd_constant_clear(&p->e->constant[--p->e->constants]);
  p->e->count--;
}

static dyd_status push_node(parser *p, dyd_op op, size_t at) {
  if (p->e->count >= DYD_EXPR_NODES) {
    return FAIL(p, at, DYD_E_RANGE, "the expression is too long: at most %zu operations; split it", DYD_EXPR_NODES);
  }
  if (!dyd_draft_reserve_node(p->d)) return dyd_fail_nomem(p->err);
  size_t column = p->start_column + (at - p->start);
  p->e->node[p->e->count++] =
      (dyd_node){.op = (unsigned char)op, .column = column < UINT32_MAX ? (uint32_t)column : UINT32_MAX};
  return DYD_OK;
}

/* A failure of exact arithmetic, in words. */
static dyd_status fold_fail(parser *p, dyd_status st, dyd_op op, size_t at) {
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(p->err);
  if (st == DYD_E_RANGE) {
    return FAIL(p, at, st,
                "the number here is too large or too fine: numbers reach from 2^-%lld to 2^%lld; scale the input",
                (long long)DYD_EXP_LIMIT, (long long)DYD_EXP_LIMIT);
  }
  if (op == DYD_OP_DIV || op == DYD_OP_POW) return FAIL(p, at, st, "division by zero; the divisor here is exactly 0");
  return FAIL(p, at, st, "%s is undefined here: its argument is %s; correct the argument", dyd_op_name(op),
              op == DYD_OP_SQRT  ? "negative"
              : op == DYD_OP_LOG ? "not positive"
                                 : "outside [-1,1]");
}

/* Charges the last constant to the budget of exact arithmetic. */
static dyd_status charge_constant(parser *p, size_t at) {
  const dyd_constant *c = last_constant(p);
  p->work += dyd_constant_bits(c);
  last_node(p)->range = dyd_range_of_constant(c);
  if (p->work <= DYD_EXPR_WORK) return DYD_OK;
  return FAIL(p, at, DYD_E_RANGE, "the exact numbers of this expression are too long; shorten it");
}

static dyd_status push_literal(parser *p, const dyd_numeral *l, size_t at) {
  dyd_expr *e = p->e;
  dyd_status st = push_node(p, DYD_OP_CONST, at);
  if (st != DYD_OK) return st;
  if (!dyd_draft_reserve_constant(p->d)) return dyd_fail_nomem(p->err);
  last_node(p)->argument = (int32_t)e->constants;
  e->constant[e->constants++] = (dyd_constant){.den = 1};
  st = constant_literal(last_constant(p), l);
  if (st != DYD_OK) return fold_fail(p, st, DYD_OP_CONST, at);
  return charge_constant(p, at);
}

/* Applies a unary operator to the last operand. */
static dyd_status emit_unary(parser *p, dyd_op op, long exponent, size_t at) {
  dyd_status st;
  dyd_range a = last_node(p)->range;
  if (last_node(p)->op == DYD_OP_CONST) {
    bool done;
    st = dyd_fold_unary(last_constant(p), &done, op, exponent);
    if (st != DYD_OK) return fold_fail(p, st, op, at);
    if (done) return charge_constant(p, at);
  }
  st = push_node(p, op, at);
  if (st != DYD_OK) return st;
  last_node(p)->argument = (int32_t)exponent;
  last_node(p)->range = dyd_range_apply(op, a, a, exponent);
  return DYD_OK;
}

/* Applies a binary operator to the operand whose last node is `left`, and the one behind it. */
static dyd_status emit_binary(parser *p, dyd_op op, size_t left, size_t at) {
  dyd_expr *e = p->e;
  const dyd_node *a = &e->node[left], *b = last_node(p);
  bool both = a->op == DYD_OP_CONST && b->op == DYD_OP_CONST;
  if (op == DYD_OP_DIV && b->op == DYD_OP_CONST && dyd_constant_cmp(&e->constant[b->argument], 0) == 0) {
    return fold_fail(p, DYD_E_DOMAIN, op, at);
  }
  if (both) {
    dyd_status st = dyd_fold_binary(&e->constant[a->argument], op, &e->constant[b->argument]);
    drop_constant(p);
    return st != DYD_OK ? fold_fail(p, st, op, at) : charge_constant(p, at);
  }
  dyd_range range = dyd_range_apply(op, a->range, b->range, 0);
  dyd_status st = push_node(p, op, at);
  if (st == DYD_OK) last_node(p)->range = range;
  return st;
}

/* Takes the exponent, which must be an integer, off the end and applies it. */
static dyd_status emit_power(parser *p, size_t left, size_t at) {
  dyd_constant_view view;
  mpq_srcptr q = last_node(p)->op == DYD_OP_CONST ? dyd_constant_get(&view, last_constant(p)) : NULL;
  if (p->e->count != left + 2 || !q || mpz_cmp_ui(mpq_denref(q), 1)) {
    return FAIL(p, at, DYD_E_PARSE, "only integer powers are known; write sqrt(a), cbrt(a) or exp(b*log(a))");
  }
  if (mpz_cmpabs_ui(mpq_numref(q), (unsigned long)DYD_EXP_LIMIT) > 0) return fold_fail(p, DYD_E_RANGE, DYD_OP_POW, at);
  long exponent = mpz_get_si(mpq_numref(q));
  drop_constant(p);
  return emit_unary(p, DYD_OP_POW, exponent, at);
}

/* The arguments of a function and its closing parenthesis; the opening one has been read. */
static dyd_status parse_arguments(parser *p, dyd_op op, size_t at) {
  bool many = dyd_op_is_binary(op);
  dyd_status st = parse_sum(p);
  size_t count = 1;
  while (st == DYD_OK && many && peek_char(p) == ',') {
    size_t left = p->e->count - 1;
    p->pos++;
    st = parse_sum(p);
    if (st == DYD_OK) st = emit_binary(p, op, left, at);
    count++;
  }
  if (st != DYD_OK) return st;
  if (peek_char(p) == ',') return FAIL(p, p->pos, DYD_E_PARSE, "%s takes one argument", dyd_op_name(op));
  if (peek_char(p) != ')') return FAIL(p, p->pos, DYD_E_PARSE, "a ')' or an operator is missing here");
  if (many && count < 2) return FAIL(p, p->pos, DYD_E_PARSE, "%s takes two or more arguments", dyd_op_name(op));
  p->pos++;
  return many ? DYD_OK : emit_unary(p, op, 0, at);
}

static dyd_status parse_group(parser *p, dyd_op op, size_t at) {
  p->pos++;
  p->parentheses++;
  dyd_status st;
  if (op == DYD_OP_CONST) {
    st = parse_sum(p);
    if (st == DYD_OK && peek_char(p) != ')') st = FAIL(p, p->pos, DYD_E_PARSE, "a ')' or an operator is missing here");
    if (st == DYD_OK) p->pos++;
  } else {
    st = parse_arguments(p, op, at);
  }
  p->parentheses--;
  return st;
}

static bool is_letter(int c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/* "inf" or "infinity", in capitals or not, as programs write them. */
static bool name_is_infinity(const char *name, size_t n) {
  static const char whole[] = "infinity";
  if (n != 3 && n != 8) return false;
  for (size_t k = 0; k < n; k++)
    if ((name[k] | 0x20) != whole[k]) return false;
  return true;
}

/* The word that these n letters are, or DYD_WORDS. */
static dyd_real_word real_word_at(const char *text, size_t n) {
  unsigned k = 0;
  while (k < DYD_WORDS && (strlen(dyd_real_words[k]) != n || memcmp(text, dyd_real_words[k], n) != 0)) k++;
  return (dyd_real_word)k;
}

static dyd_status name_fail(parser *p, size_t at, size_t n) {
  int shown = n < 32 ? (int)n : 32;
  if (name_is_infinity(p->text + at, n))
    return FAIL(p, at, DYD_E_PARSE,
                "coordinates are finite, and this is infinite; give a number, or leave the point out");
  if (real_word_at(p->text + at, n) < DYD_WORDS)
    return FAIL(p, at, DYD_E_PARSE, "%.*s cannot stand within root(polynomial, lo, hi)", shown, p->text + at);
  return FAIL(p, at, DYD_E_PARSE,
              "the name '%.*s' is unknown; known are pi e sqrt cbrt exp log sin cos tan asin acos atan "
              "sinh cosh tanh abs min max root random slow",
              shown, p->text + at);
}

/* A root that is rational becomes a constant. */
static dyd_status push_known_root(parser *p, const dyd_real *x, size_t at) {
  dyd_status st = push_node(p, DYD_OP_CONST, at);
  if (st != DYD_OK) return st;
  if (!dyd_draft_reserve_constant(p->d)) return dyd_fail_nomem(p->err);
  last_node(p)->argument = (int32_t)p->e->constants;
  p->e->constant[p->e->constants++] = (dyd_constant){.den = 1};
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_interval_get_q(lo, hi, dyd_real_interval(x));
  st = dyd_constant_set(last_constant(p), lo);
  return st == DYD_OK ? charge_constant(p, at) : fold_fail(p, st, DYD_OP_ROOT, at);
}

/* Takes over x on success. */
static dyd_status push_root(parser *p, dyd_real *x, size_t at) {
  if (p->e->roots >= DYD_EXPR_ROOTS)
    return FAIL(p, at, DYD_E_RANGE, "the expression has more than %zu roots; split it", DYD_EXPR_ROOTS);
  dyd_status st = push_node(p, DYD_OP_ROOT, at);
  if (st != DYD_OK) return st;
  if (!dyd_draft_reserve_root(p->d)) return dyd_fail_nomem(p->err);
  last_node(p)->argument = (int32_t)p->e->roots;
  last_node(p)->range = (dyd_range){-DYD_NO_END, DYD_NO_END};
  p->e->root[p->e->roots++] = x;
  return DYD_OK;
}

/* The word has been read. */
static dyd_status parse_root(parser *p, dyd_real_word word, size_t at) {
  dyd_real *x = NULL;
  if (peek_char(p) != '(') return FAIL(p, p->pos, DYD_E_PARSE, "a '(' is missing after %s", dyd_real_words[word]);
  p->pos++;
  dyd_status st = p->names.root(&x, word, &p->pos, p->text, p->length, p->err);
  if (st != DYD_OK) return st;
  bool known = dyd_real_is_final(x);
  st = known ? push_known_root(p, x, at) : push_root(p, x, at);
  if (known || st != DYD_OK) dyd_real_free(x);
  return st;
}

/* Returns true if the name is the n letters of the text. */
static bool text_is_name(const char name[5], const char *text, size_t n) {
  return name[0] == *text && n < 5 && name[n] == 0 && !memcmp(name, text, n);
}

static dyd_status parse_name(parser *p) {
  size_t at = p->pos, n = 0, i = 0;
  while (at + n < p->length && (is_letter(p->text[at + n]) || (p->text[at + n] >= '0' && p->text[at + n] <= '9'))) n++;
  while (i < NAME_COUNT && !text_is_name(names[i].name, p->text + at, n)) i++;
  const dyd_real_word word = i == NAME_COUNT && p->names.root ? real_word_at(p->text + at, n) : DYD_WORDS;
  if (word < DYD_WORDS) {
    p->pos += n;
    return parse_root(p, word, at);
  }
  if (i == NAME_COUNT) return name_fail(p, at, n);
  dyd_op op = names[i].op;
  p->pos += n;
  if (op == DYD_OP_X && !p->names.x) {
    return FAIL(p, at, DYD_E_PARSE, "x has a meaning only in root(polynomial, lo, hi)");
  }
  if (dyd_op_is_leaf(op)) {
    dyd_status st = push_node(p, op, at);
    if (st == DYD_OK) last_node(p)->range = dyd_range_apply(op, (dyd_range){0, 0}, (dyd_range){0, 0}, 0);
    return st;
  }
  if (peek_char(p) != '(') return FAIL(p, p->pos, DYD_E_PARSE, "a '(' is missing after %s", names[i].name);
  return parse_group(p, op, at);
}

static dyd_status parse_primary(parser *p) {
  int c = peek_char(p);
  dyd_numeral l;
  if (dyd_literal_scan(&l, p->text, p->length, p->pos, DYD_NUMBER_LITERAL)) {
    size_t at = p->pos;
    p->pos = l.end;
    return push_literal(p, &l, at);
  }
  if (c == '(') return parse_group(p, DYD_OP_CONST, p->pos);
  if (is_letter(c)) return parse_name(p);
  if (c < 0) return FAIL(p, p->pos, DYD_E_PARSE, "the expression ends too early; a number, a name or '(' is missing");
  return dyd_text_unexpected(p->err, p->text, p->length, p->pos, "; a number, a name or '(' is expected");
}

static dyd_status parse_power(parser *p) {
  if (p->depth >= DYD_EXPR_DEPTH) {
    return FAIL(p, p->pos, DYD_E_RANGE, "the expression is nested too deeply: at most %d levels; split it",
                DYD_EXPR_DEPTH);
  }
  p->depth++;
  dyd_status st = parse_primary(p);
  if (st == DYD_OK && peek_char(p) == '^') {
    size_t at = p->pos++, left = p->e->count - 1;
    st = parse_signed(p);
    if (st == DYD_OK) st = emit_power(p, left, at);
  }
  p->depth--;
  return st;
}

static dyd_status parse_signed(parser *p) {
  bool negative = false;
  size_t at = 0;
  for (int c = peek_char(p); c == '-' || c == '+'; c = peek_char(p)) {
    at = p->pos++;
    negative ^= c == '-';
  }
  dyd_status st = parse_power(p);
  return st || !negative ? st : emit_unary(p, DYD_OP_NEG, 0, at);
}

static dyd_status parse_product(parser *p) {
  dyd_status st = parse_signed(p);
  for (int c; st == DYD_OK && ((c = peek_char(p)) == '*' || c == '/');) {
    size_t at = p->pos++, left = p->e->count - 1;
    st = parse_signed(p);
    if (st == DYD_OK) st = emit_binary(p, c == '*' ? DYD_OP_MUL : DYD_OP_DIV, left, at);
  }
  return st;
}

static dyd_status parse_sum(parser *p) {
  dyd_status st = parse_product(p);
  for (int c; st == DYD_OK && ((c = peek_char(p)) == '+' || c == '-');) {
    if (c == '+' && p->pos + 1 < p->length && p->text[p->pos + 1] == '-') {
      if (!p->parentheses) break;
      return FAIL(p, p->pos, DYD_E_PARSE,
                  "'+-' introduces a radius and is not allowed in parentheses; for a sum write 'a - b'");
    }
    size_t at = p->pos++, left = p->e->count - 1;
    st = parse_product(p);
    if (st == DYD_OK) st = emit_binary(p, c == '+' ? DYD_OP_ADD : DYD_OP_SUB, left, at);
  }
  return st;
}

dyd_status dyd_expr_parse(dyd_draft *d, size_t *pos, const char *text, size_t length, dyd_expr_names known,
                          dyd_error *err) {
  parser p = {
      .d = d, .e = &d->e, .text = text, .length = length, .pos = *pos, .start = *pos, .names = known, .err = err};
  p.start_column = dyd_text_column(text, *pos);
  dyd_status st = parse_sum(&p);
  if (st != DYD_OK) return st;
  peek_char(&p);
  *pos = p.pos;
  return DYD_OK;
}
