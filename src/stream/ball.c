/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Steps of ball arithmetic.
 *
 * Functions with an edge in their domain are evaluated at the two ends of the ball, after the ends are cut to the known
 * range of the value [RANGE-1]: all of them are monotone. Where the ball still sticks out of the domain, the result is
 * unknown yet; it is never assumed that the value is inside. */
#include "stream/ball.h"
#include "rect/rect.h"

#include "base/local.h"
#include "base/parallel.h"

#include <stdlib.h>

typedef void (*ball_fn)(arb_t out, const arb_t x, slong prec);

void dyd_ball_set_z_2exp(arb_ptr out, mpz_srcptr man, slong exp) {
  arf_set_mpz(arb_midref(out), man);
  mag_zero(arb_radref(out));
  arb_mul_2exp_si(out, out, exp);
}

void dyd_ball_set_q(arb_ptr out, mpq_srcptr q, slong prec) {
  DYD_LOCAL_NUMBERS(fmpq, f);
  fmpq_set_mpq(f, q);
  arb_set_fmpq(out, f, prec);
}

/* x = [f(l), f(u)] for the ends l <= u of x, cut to the range known. f is monotone there. */
static void ball_monotone(arb_ptr x, ball_fn f, dyd_range cut, slong prec) {
  DYD_LOCAL_NUMBERS(arb, l, u);
  arb_get_lbound_arf(arb_midref(l), x, prec + 32);
  arb_get_ubound_arf(arb_midref(u), x, prec + 32);
  if (cut.lo != -DYD_NO_END && arf_cmp_si(arb_midref(l), cut.lo) < 0) arb_set_si(l, cut.lo);
  if (cut.hi != DYD_NO_END && arf_cmp_si(arb_midref(u), cut.hi) > 0) arb_set_si(u, cut.hi);
  bool point = arb_equal(l, u);
  f(l, l, prec);
  f(u, u, prec);
  if (point) {
    arb_swap(x, l);
  } else {
    arb_union(x, l, u, prec);
  }
}

static void ball_cube_root(arb_t out, const arb_t x, slong prec) {
  if (arf_sgn(arb_midref(x)) < 0) {
    arb_neg(out, x);
    arb_root_ui(out, out, 3, prec);
    arb_neg(out, out);
  } else {
    arb_root_ui(out, x, 3, prec);
  }
}

/* -1: all of x is below the integer lo; 1: all is above hi; 0: neither. */
static int ball_beside(arb_srcptr x, slong lo, slong hi) {
  DYD_LOCAL_NUMBERS(arb, t);
  arb_set_si(t, lo);
  int result = arb_lt(x, t) ? -1 : 0;
  arb_set_si(t, hi);
  if (arb_gt(x, t)) result = 1;
  return result;
}

/* arcsine and arccosine: every end beyond +-1 must be known to be harmless. */
static dyd_defined ball_arc(arb_ptr x, ball_fn f, dyd_range range, slong prec) {
  if (ball_beside(x, -1, 1)) return DYD_UNDEFINED;
  DYD_LOCAL_NUMBERS(arb, one);
  arb_set_si(one, -1);
  bool low = range.lo >= -1 || arb_ge(x, one);
  arb_set_si(one, 1);
  bool high = range.hi <= 1 || arb_le(x, one);
  if (!low || !high) return DYD_UNDEFINED_YET;
  ball_monotone(x, f, (dyd_range){-1, 1}, prec);
  return DYD_DEFINED;
}

static dyd_defined ball_square_root(arb_ptr x, dyd_range range, slong prec) {
  if (arb_is_negative(x)) return DYD_UNDEFINED;
  if (!arb_is_nonnegative(x) && range.lo < 0) return DYD_UNDEFINED_YET;
  ball_monotone(x, arb_sqrt, (dyd_range){0, DYD_NO_END}, prec);
  return DYD_DEFINED;
}

static dyd_defined ball_logarithm(arb_ptr x, slong prec) {
  if (arb_is_nonpositive(x)) return DYD_UNDEFINED;
  if (!arb_is_positive(x)) return DYD_UNDEFINED_YET;
  arb_log(x, x, prec);
  return DYD_DEFINED;
}

/* -1: x is certainly < -2^20; 1: certainly > 2^20; 0: |x| <= 2^21 for all of the ball; 2: none of these. */
static int against_exponent_limit(arb_srcptr x) {
  int side = ball_beside(x, -(slong)DYD_EXP_LIMIT, (slong)DYD_EXP_LIMIT);
  if (side) return side;
  DYD_LOCAL_NUMBERS(mag, m);
  arb_get_mag(m, x);
  return mag_cmp_2exp_si(m, 21) <= 0 ? 0 : 2;
}

/* x = a ball about 0 that holds all values below 2^-DYD_BALL_LIMIT in magnitude. */
static void ball_set_tiny(arb_ptr x) {
  arf_zero(arb_midref(x));
  mag_set_ui_2exp_si(arb_radref(x), 1, -DYD_BALL_LIMIT);
}

/* exp and the hyperbolic functions grow too fast for arguments beyond 2^20: the result would leave the range. */
static dyd_defined ball_exponential(arb_ptr x, dyd_op op, slong prec) {
  int side = against_exponent_limit(x);
  if (side == 2) return DYD_TOO_BIG_YET;
  if (side > 0 || (side < 0 && op != DYD_OP_EXP)) return DYD_TOO_BIG;
  if (side < 0) {
    arf_zero(arb_midref(x)); /* exp(x) < e^(-2^20) < 2^-(2^20) */
    mag_set_ui_2exp_si(arb_radref(x), 1, -(slong)DYD_EXP_LIMIT);
    return DYD_DEFINED;
  }
  static const ball_fn function[] = {[DYD_OP_EXP] = arb_exp, [DYD_OP_SINH] = arb_sinh, [DYD_OP_COSH] = arb_cosh};
  function[op](x, x, prec);
  return DYD_DEFINED;
}

/* tanh is within 2^-(2^20) of +-1 beyond 2^20; a wide ball gives all of [-1,1]. */
static void ball_hyperbolic_tangent(arb_ptr x, slong prec) {
  int side = against_exponent_limit(x);
  if (!side) {
    arb_tanh(x, x, prec);
    return;
  }
  arb_set_si(x, side == 2 ? 0 : side);
  mag_set_ui_2exp_si(arb_radref(x), 1, side == 2 ? 0 : -(slong)DYD_EXP_LIMIT);
}

static void ball_absolute(arb_ptr x, slong prec) {
  if (!arb_contains_zero(x)) {
    arb_abs(x, x);
    return;
  }
  DYD_LOCAL_NUMBERS(arf, zero, most);
  arb_get_abs_ubound_arf(most, x, prec);
  arb_set_interval_arf(x, zero, most, prec);
}

static dyd_defined ball_power(arb_ptr x, long n, slong prec) {
  if (n < 0 && arb_contains_zero(x)) return arb_is_zero(x) ? DYD_UNDEFINED : DYD_UNDEFINED_YET;
  DYD_LOCAL_NUMBERS(fmpz, k);
  fmpz_set_si(k, n);
  arb_pow_fmpz(x, x, k, prec);
  return DYD_DEFINED;
}

/* Functions that are defined everywhere, or whose poles give a ball that is not finite. */
static void ball_plain_function(arb_ptr x, dyd_op op, slong prec) {
  static const ball_fn function[] = {
      [DYD_OP_SIN] = arb_sin, [DYD_OP_COS] = arb_cos, [DYD_OP_TAN] = arb_tan, [DYD_OP_ATAN] = arb_atan};
  if (op == DYD_OP_NEG)
    arb_neg(x, x);
  else if (op == DYD_OP_TANH)
    ball_hyperbolic_tangent(x, prec);
  else if (op == DYD_OP_CBRT)
    ball_monotone(x, ball_cube_root, (dyd_range){-DYD_NO_END, DYD_NO_END}, prec);
  else if (op == DYD_OP_ABS)
    ball_absolute(x, prec);
  else
    function[op](x, x, prec);
}

/* x = op(x), where the value lies in `range` in any case. x is unspecified unless DYD_DEFINED is returned. */
static dyd_defined ball_unary(arb_ptr x, dyd_op op, dyd_range range, long exponent, slong prec) {
  switch (op) {
  case DYD_OP_SQRT:
    return ball_square_root(x, range, prec);
  case DYD_OP_LOG:
    return ball_logarithm(x, prec);
  case DYD_OP_ASIN:
    return ball_arc(x, arb_asin, range, prec);
  case DYD_OP_ACOS:
    return ball_arc(x, arb_acos, range, prec);
  case DYD_OP_EXP:
  case DYD_OP_SINH:
  case DYD_OP_COSH:
    return ball_exponential(x, op, prec);
  case DYD_OP_POW:
    return ball_power(x, exponent, prec);
  default:
    ball_plain_function(x, op, prec);
    return DYD_DEFINED;
  }
}

/* x = op(x, y). */
static dyd_defined ball_binary(arb_ptr x, dyd_op op, arb_srcptr y, slong prec) {
  static void (*const function[])(arb_t, const arb_t, const arb_t,
                                  slong) = {[DYD_OP_ADD] = arb_add, [DYD_OP_SUB] = arb_sub, [DYD_OP_MUL] = arb_mul,
                                            [DYD_OP_DIV] = arb_div, [DYD_OP_MIN] = arb_min, [DYD_OP_MAX] = arb_max};
  if (op == DYD_OP_DIV && arb_contains_zero(y)) return arb_is_zero(y) ? DYD_UNDEFINED : DYD_UNDEFINED_YET;
  function[op](x, x, y, prec);
  return DYD_DEFINED;
}

bool dyd_ball_exceeds(arb_srcptr x, slong e) {
  DYD_LOCAL_NUMBERS(mag, m);
  arb_get_mag_lower(m, x);
  return mag_cmp_2exp_si(m, e) > 0;
}

dyd_defined dyd_ball_check(arb_ptr x, slong *exponent) {
  if (!arb_is_finite(x)) return DYD_UNDEFINED_YET;
  DYD_LOCAL_NUMBERS(mag, m);
  arb_get_mag(m, x);
  dyd_defined d = DYD_DEFINED;
  if (mag_cmp_2exp_si(m, DYD_BALL_LIMIT) > 0) {
    d = dyd_ball_exceeds(x, DYD_BALL_LIMIT) ? DYD_TOO_BIG : DYD_TOO_BIG_YET;
  } else if (!mag_is_zero(m) && mag_cmp_2exp_si(m, -DYD_BALL_LIMIT) < 0) {
    ball_set_tiny(x);
  } else if (!mag_is_zero(m)) {
    slong e = fmpz_get_si(MAG_EXPREF(m));
    if (e > *exponent) *exponent = e;
  }
  return d;
}

/* Steps of ball arithmetic that may take long: Arb tests no flag, so those of very many digits are made by a thread
 * of their own, on copies. */

/* From these precisions on a step may take a tenth of a second: functions; arithmetic and roots. */
enum { LONG_FUNCTION = 1 << 18, LONG_ARITHMETIC = 1 << 22 };

static bool step_is_long(const dyd_ball_step *s) {
  bool function =
      s->op == DYD_OP_PI || s->op == DYD_OP_E || s->op == DYD_OP_POW || (s->op >= DYD_OP_EXP && s->op <= DYD_OP_TANH);
  return s->prec >= (function ? LONG_FUNCTION : LONG_ARITHMETIC);
}

static dyd_defined step_now(arb_ptr x, const dyd_ball_step *s) {
  if (s->op == DYD_OP_PI)
    arb_const_pi(x, s->prec);
  else if (s->op == DYD_OP_E)
    arb_const_e(x, s->prec);
  else if (dyd_op_is_binary(s->op))
    return ball_binary(x, s->op, s->y, s->prec);
  else
    return ball_unary(x, s->op, s->range, s->exponent, s->prec);
  return DYD_DEFINED;
}

typedef struct long_step {
  dyd_ball_step step;
  arb_t x, y;
  dyd_defined result;
} long_step;

static void long_step_run(void *job) {
  long_step *l = job;
  l->result = step_now(l->x, &l->step);
  flint_cleanup(); /* the caches of this thread */
}

static void long_step_drop(void *job) {
  long_step *l = job;
  arb_clear(l->y);
  arb_clear(l->x);
  free(l);
  flint_cleanup();
}

static long_step *long_step_new(arb_srcptr x, const dyd_ball_step *s) {
  long_step *l = malloc(sizeof *l);
  if (!l) return NULL;
  l->step = *s;
  arb_init(l->x);
  arb_init(l->y);
  arb_set(l->x, x);
  if (s->y) arb_set(l->y, s->y);
  l->step.y = l->y;
  return l;
}

dyd_defined dyd_ball_apply(arb_ptr x, const dyd_ball_step *s, const volatile int *stop) {
  long_step *l = stop && step_is_long(s) ? long_step_new(x, s) : NULL;
  if (!l) return step_now(x, s);
  if (!dyd_run_detached(long_step_run, long_step_drop, l, stop)) return DYD_UNDEFINED_YET;
  dyd_defined result = l->result;
  arb_swap(x, l->x);
  arb_clear(l->y);
  arb_clear(l->x);
  free(l);
  return result;
}

/* From balls to intervals with short dyadic ends.
 *
 * [ENC-2] The ends are the floor of the lower and the ceiling of the upper bound on the grid of multiples of
 * 2^exp; the bounds themselves are exact, so the ball lies inside. */

slong dyd_ball_radius_exponent(arb_srcptr x) {
  if (mag_is_zero(arb_radref(x))) return -4 * DYD_BALL_LIMIT;
  if (fmpz_cmp_si(MAG_EXPREF(arb_radref(x)), -4 * DYD_BALL_LIMIT) < 0) return -4 * DYD_BALL_LIMIT;
  return fmpz_get_si(MAG_EXPREF(arb_radref(x))); /* a radius is below 2^its exponent */
}

/* out = x rounded to the grid. */
static dyd_status ball_grid_end(dyd_dyadic *out, arf_t x, int64_t exp, dyd_round dir) {
  DYD_LOCAL_NUMBERS(fmpz, f);
  DYD_LOCAL_NUMBERS(mpz, z);
  arf_mul_2exp_si(x, x, (slong)-exp);
  arf_get_fmpz(f, x, dir == DYD_DOWN ? ARF_RND_FLOOR : ARF_RND_CEIL);
  fmpz_get_mpz(z, f);
  return dyd_dyadic_set_z_2exp(out, z, exp);
}

/* The point itself when the ball is exact and within range. */
static dyd_status ball_exact_point(dyd_dyadic *out, arb_srcptr x) {
  DYD_LOCAL_NUMBERS(fmpz, man, exp);
  DYD_LOCAL_NUMBERS(mpz, z);
  arf_get_fmpz_2exp(man, exp, arb_midref(x));
  fmpz_get_mpz(z, man);
  return fmpz_fits_si(exp) ? dyd_dyadic_set_z_2exp(out, z, (int64_t)fmpz_get_si(exp)) : DYD_E_RANGE;
}

dyd_status dyd_ball_interval(dyd_interval *out, arb_srcptr x, int64_t exp) {
  DYD_LOCAL(dyd_dyadic, lo, hi);
  DYD_LOCAL_NUMBERS(arf, end);
  dyd_status st = DYD_E_RANGE;
  if (arb_is_exact(x)) st = ball_exact_point(&lo, x);
  if (st == DYD_OK) {
    dyd_dyadic_set(&hi, &lo);
  } else {
    arb_get_lbound_arf(end, x, ARF_PREC_EXACT);
    st = ball_grid_end(&lo, end, exp, DYD_DOWN);
    arb_get_ubound_arf(end, x, ARF_PREC_EXACT);
    if (st == DYD_OK) st = ball_grid_end(&hi, end, exp, DYD_UP);
  }
  return st == DYD_OK ? dyd_interval_set_ends(out, &lo, &hi) : st;
}
