/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Steps of ball arithmetic that may take long: Arb looks at no flag, so those of very many digits are made by a thread
 * of their own, on copies. */
#include "base/parallel.h"
#include "stream/ball.h"

#include <stdlib.h>

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
    return dyd_ball_binary(x, s->op, s->y, s->prec);
  else
    return dyd_ball_unary(x, s->op, s->range, s->exponent, s->prec);
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
  if (!dyd_apart(long_step_run, long_step_drop, l, stop)) return DYD_UNDEFINED_YET;
  dyd_defined result = l->result;
  arb_swap(x, l->x);
  arb_clear(l->y);
  arb_clear(l->x);
  free(l);
  return result;
}
