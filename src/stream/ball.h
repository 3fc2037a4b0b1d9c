/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Single steps of ball arithmetic with domains and size limits that keep Arb far from its own limits. */
#ifndef DYD_STREAM_BALL_H
#define DYD_STREAM_BALL_H

#include "stream/arb.h"
#include "stream/expr.h"

/* Whether the value of a node is defined. The _YET answers may change at a higher precision. */
typedef enum dyd_defined {
  DYD_DEFINED,
  DYD_UNDEFINED_YET, /* the ball meets a point outside the domain */
  DYD_UNDEFINED,     /* the whole ball lies outside the domain */
  DYD_TOO_BIG_YET,
  DYD_TOO_BIG
} dyd_defined;

/* Intermediate values are kept below 2^DYD_BALL_LIMIT; values below 2^-DYD_BALL_LIMIT are held as a ball about 0. */
#define DYD_BALL_LIMIT ((slong)1 << 21)

void dyd_ball_set_q(arb_ptr out, mpq_srcptr q, slong prec);
/* One step: a function of x, an operation on x and y, or pi or e, to `prec` bits; range and exponent as above. */
typedef struct dyd_ball_step {
  dyd_op op;
  dyd_range range;
  long exponent;
  arb_srcptr y; /* NULL: there is none */
  slong prec;
} dyd_ball_step;
/* x = the result. A step that may take long ends early once *stop is set (NULL: no flag): DYD_UNDEFINED_YET, and x
 * is as it was. */
dyd_defined dyd_ball_apply(arb_ptr x, const dyd_ball_step *s, const volatile int *stop);
/* Returns true if |x| is certainly beyond 2^e. */
bool dyd_ball_exceeds(arb_srcptr x, slong e);
/* Finite and not too big? Raises *exponent to a bound of its binary exponent. */
dyd_defined dyd_ball_check(arb_ptr x, slong *exponent);
/* The least e with radius <= 2^e; for an exact ball a very small number. */
slong dyd_ball_radius_exponent(arb_srcptr x);
/* out = an interval containing the ball, with ends that are multiples of 2^exp, or the point when the ball is
 * exact [ENC-2]. DYD_E_RANGE when it leaves the range. */
dyd_status dyd_ball_interval(dyd_interval *out, arb_srcptr x, int64_t exp);
/* out = man * 2^exp, exactly. */
void dyd_ball_set_z_2exp(arb_ptr out, mpz_srcptr man, slong exp);

#endif
