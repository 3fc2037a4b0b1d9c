/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the form of an expression says about its sign and about the unit interval.
 *
 * [RANGE-1] An interval arithmetic with ends among -1, 0, 1 and "none": if the operands lie in their ranges and
 * the operation is defined, the result lies in the range given here. It makes sqrt(abs(t)) and asin(sin(t))
 * computable at the edge of their domains, where enclosures of t alone would never decide. */
#include "stream/expr.h"

#define NONE DYD_NO_END

static const dyd_range anything = {-NONE, NONE};

static int range_least(int a, int b) {
  return a < b ? a : b;
}

static int range_most(int a, int b) {
  return a > b ? a : b;
}

/* Weakens ends to those that can be held: lower ends to -1, 0, 1 from above, upper ends from below. */
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

/* exp and log: monotone, 0 <-> 1. */
static dyd_range range_exp(dyd_range a) {
  return range_make(a.lo >= 0 ? 1 : 0, a.hi <= 0 ? 1 : NONE);
}
static dyd_range range_log(dyd_range a) {
  return range_make(a.lo >= 1 ? 0 : -NONE, a.hi <= 1 ? 0 : NONE);
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
  case DYD_OP_EXP:
    return range_exp(a);
  case DYD_OP_LOG:
    return range_log(a);
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
