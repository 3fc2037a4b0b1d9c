/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Expressions in double interval arithmetic.
 *
 * [FLT-EXPR] + - * / and sqrt of doubles are rounded to nearest, so a finite result and the double next to it, below
 * or above, have the exact result between them, whatever its size: lower ends are taken one double down, upper ends one
 * double up. The value of an operation on intervals lies between its values at corners: a product or quotient (by an
 * interval without 0) at the least and the greatest of four, sums, differences and roots by monotony. Negation,
 * absolute value, minimum and maximum are exact. Whatever is not finite, or may be undefined, gives no answer.
 */
#include "stream/expr_filter.h"

#include <math.h>

/* Operands open at one time; deeper expressions are left to the exact rungs. */
#define OPEN 16

/* The next double above x; infinite or NaN where there is none. */
static double next_above(double x) {
  if (x > 0) return dyd_double_of_pattern(dyd_pattern_of(x) + (x < INFINITY));
  if (x < 0) return dyd_double_of_pattern(dyd_pattern_of(x) - 1);
  return x == 0 ? dyd_double_of_pattern(1) : x;
}
static double next_below(double x) {
  return -next_above(-x);
}

static bool glance_is_good(dyd_double_span a) {
  return isfinite(a.lo) && isfinite(a.hi);
}

/* Words below 2^53 are doubles. */
static bool glance_set_constant(dyd_double_span *out, const dyd_constant *c) {
  const int64_t limit = (int64_t)1 << 53;
  if (!dyd_constant_is_short(c) || c->u.num > limit || c->u.num < -limit || c->den > limit) return false;
  double q = (double)c->u.num / (double)c->den;
  *out = c->den == 1 ? (dyd_double_span){q, q} : (dyd_double_span){next_below(q), next_above(q)};
  return true;
}

static dyd_double_span glance_add(dyd_double_span a, dyd_double_span b) {
  return (dyd_double_span){next_below(a.lo + b.lo), next_above(a.hi + b.hi)};
}

static dyd_double_span glance_negated(dyd_double_span a) {
  return (dyd_double_span){-a.hi, -a.lo};
}

/* From the least to the greatest of four rounded corners; NaN when one of them is. */
static dyd_double_span glance_corners(double p, double q, double r, double s) {
  if (isnan(p + q + r + s)) return (dyd_double_span){NAN, NAN};
  return (dyd_double_span){next_below(fmin(fmin(p, q), fmin(r, s))), next_above(fmax(fmax(p, q), fmax(r, s)))};
}

static dyd_double_span glance_multiply(dyd_double_span a, dyd_double_span b) {
  if (a.lo >= 0 && b.lo >= 0) return (dyd_double_span){next_below(a.lo * b.lo), next_above(a.hi * b.hi)};
  return glance_corners(a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi);
}

static dyd_double_span glance_divide(dyd_double_span a, dyd_double_span b) {
  if (b.lo <= 0 && b.hi >= 0) return (dyd_double_span){NAN, NAN};
  return glance_corners(a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi);
}

/* The range known from the form may cut the lower end [RANGE-1]. */
static dyd_double_span glance_square_root(dyd_double_span a, dyd_range range) {
  if (a.lo < 0 && range.lo < 0) return (dyd_double_span){NAN, NAN};
  double lo = a.lo > 0 ? next_below(sqrt(a.lo)) : 0;
  return (dyd_double_span){lo, next_above(sqrt(a.hi))};
}

static dyd_double_span glance_absolute(dyd_double_span a) {
  if (a.lo >= 0) return a;
  if (a.hi <= 0) return glance_negated(a);
  return (dyd_double_span){0, fmax(-a.lo, a.hi)};
}

static dyd_double_span glance_power(dyd_double_span a, int32_t n) {
  dyd_double_span result = {1, 1};
  const dyd_double_span nothing = {NAN, NAN};
  if (n < 0) {
    a = glance_power(a, -n);
    return glance_is_good(a) ? glance_divide(result, a) : nothing;
  }
  if (n % 2 == 0) a = glance_absolute(a);
  for (; n; n /= 2) {
    if (n % 2) result = glance_multiply(result, a);
    a = glance_multiply(a, a);
    if (!glance_is_good(a) && n > 1) return nothing;
  }
  return result;
}

static bool glance_leaf(dyd_double_span *out, const dyd_expr *e, const dyd_node *n) {
  switch (n->op) {
  case DYD_OP_CONST:
    return glance_set_constant(out, &e->constant[n->argument]);
  case DYD_OP_PI:
    *out = (dyd_double_span){0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1};
    return true;
  case DYD_OP_E:
    *out = (dyd_double_span){0x1.5bf0a8b145769p+1, 0x1.5bf0a8b14576ap+1};
    return true;
  default:
    return false;
  }
}

/* a = op(a), where a lies in `range` by its form. */
static bool glance_unary(dyd_double_span *a, const dyd_node *n, dyd_range range) {
  switch (n->op) {
  case DYD_OP_NEG:
    *a = glance_negated(*a);
    return true;
  case DYD_OP_ABS:
    *a = glance_absolute(*a);
    return true;
  case DYD_OP_SQRT:
    *a = glance_square_root(*a, range);
    return glance_is_good(*a);
  case DYD_OP_POW:
    *a = glance_power(*a, n->argument);
    return glance_is_good(*a);
  default:
    return false;
  }
}

static dyd_double_span glance_subtract(dyd_double_span a, dyd_double_span b) {
  return glance_add(a, glance_negated(b));
}

static dyd_double_span glance_min(dyd_double_span a, dyd_double_span b) {
  return (dyd_double_span){fmin(a.lo, b.lo), fmin(a.hi, b.hi)};
}

static dyd_double_span glance_max(dyd_double_span a, dyd_double_span b) {
  return (dyd_double_span){fmax(a.lo, b.lo), fmax(a.hi, b.hi)};
}

static bool glance_binary(dyd_double_span *a, dyd_op op, dyd_double_span b) {
  static dyd_double_span (*const function[])(dyd_double_span, dyd_double_span) = {
      [DYD_OP_ADD] = glance_add,    [DYD_OP_SUB] = glance_subtract, [DYD_OP_MUL] = glance_multiply,
      [DYD_OP_DIV] = glance_divide, [DYD_OP_MIN] = glance_min,      [DYD_OP_MAX] = glance_max};
  *a = function[op](*a, b);
  return glance_is_good(*a);
}

/* Applies node i to the stack of *top operands. */
static bool glance_apply(dyd_double_span *stack, size_t *top, const dyd_expr *e, size_t i) {
  const dyd_node *n = &e->node[i];
  dyd_op op = (dyd_op)n->op;
  if (dyd_op_is_leaf(op)) return *top < OPEN && glance_leaf(&stack[(*top)++], e, n);
  if (!dyd_op_is_binary(op)) return glance_unary(&stack[*top - 1], n, e->node[i - 1].range);
  --*top;
  return glance_binary(&stack[*top - 1], op, stack[*top]);
}

bool dyd_filter_expr(dyd_double_span *out, const dyd_expr *e) {
  dyd_double_span stack[OPEN];
  size_t top = 0;
  for (size_t i = 0; i < e->count; i++)
    if (!glance_apply(stack, &top, e, i)) return false;
  *out = (dyd_double_span){stack[0].lo + 0.0, stack[0].hi + 0.0};
  return true;
}
