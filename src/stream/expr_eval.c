/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Enclosing the value of an expression: ball arithmetic at a working precision that is raised until the width
 * asked for is met.
 *
 * [ENC-1] Each ball contains the value of its node: Arb's operations are inclusion isotonic, and a ball is cut
 * only with a range the value lies in whatever the precision [RANGE-1]. The stack holds one ball per open
 * operand, so memory follows the nesting, not the length. */
#include "stream/ball.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "stream/real.h"

typedef struct machine {
  arb_ptr ball;
  slong top, capacity;
  slong prec;
  slong exponent;    /* every ball so far is below 2^exponent in magnitude */
  dyd_status failed; /* what a root could not be narrowed by, told in *err */
  dyd_error *err;
  const volatile int *stop; /* NULL: nobody can */
} machine;

static slong machine_stack_need(const dyd_expr *e) {
  slong need = 0, now = 0;
  for (size_t i = 0; i < e->count; i++) {
    dyd_op op = (dyd_op)e->node[i].op;
    now += dyd_op_is_leaf(op) ? 1 : dyd_op_is_binary(op) ? -1 : 0;
    if (now > need) need = now;
  }
  return need;
}

/* A root lies in its interval, which is narrowed to about 2^-prec. */
static void machine_push_root(machine *m, arb_ptr out, dyd_real *root, const dyd_node *n) {
  mpq_t end[2];
  arb_t hi;
  dyd_status st = dyd_real_narrow_until(root, m->prec, m->prec, m->stop, m->err);
  if (dyd_narrow_ended(st)) {
    if (m->err) m->err->column = n->column;
    m->failed = st;
    return;
  }
  mpq_inits(end[0], end[1], NULL);
  arb_init(hi);
  dyd_interval_get_q(end[0], end[1], dyd_real_interval(root));
  dyd_ball_set_q(out, end[0], m->prec);
  dyd_ball_set_q(hi, end[1], m->prec);
  arb_union(out, out, hi, m->prec);
  arb_clear(hi);
  mpq_clears(end[0], end[1], NULL);
}

static void machine_push_leaf(machine *m, const dyd_expr *e, const dyd_node *n) {
  arb_ptr out = m->ball + m->top++;
  if (n->op == DYD_OP_PI || n->op == DYD_OP_E) {
    const dyd_ball_step constant = {.op = (dyd_op)n->op, .prec = m->prec};
    dyd_ball_apply(out, &constant, m->stop);
  } else if (n->op == DYD_OP_ROOT) {
    machine_push_root(m, out, e->root[n->argument], n);
  } else {
    dyd_constant_view view;
    dyd_ball_set_q(out, dyd_constant_get(&view, &e->constant[n->argument]), m->prec);
  }
}

/* Applies node i to the top of the stack. The operand just below the top is what node `i - 1` ends. */
static dyd_defined machine_apply(machine *m, const dyd_expr *e, const dyd_range *below, size_t i) {
  const dyd_node *n = &e->node[i];
  if (dyd_op_is_leaf((dyd_op)n->op)) {
    machine_push_leaf(m, e, n);
    return DYD_DEFINED;
  }
  dyd_ball_step step = {.op = (dyd_op)n->op, .range = *below, .exponent = n->argument, .prec = m->prec};
  if (dyd_op_is_binary(step.op)) step.y = m->ball + --m->top;
  return dyd_ball_apply(m->ball + m->top - 1, &step, m->stop);
}

/* Runs all nodes; the value is then m->ball[0]. On failure *culprit is the node; m->failed tells of that of a root. */
static dyd_defined machine_run(machine *m, size_t *culprit, const dyd_expr *e) {
  m->top = 0;
  m->exponent = 0;
  for (size_t i = 0; i < e->count; i++) {
    *culprit = i;
    dyd_defined d = machine_apply(m, e, i ? &e->node[i - 1].range : NULL, i);
    if (dyd_flag_is_set(m->stop)) m->failed = DYD_CANCELLED;
    if (m->failed != DYD_OK) return DYD_UNDEFINED;
    if (d == DYD_DEFINED) d = dyd_ball_check(m->ball + m->top - 1, &m->exponent);
    if (d != DYD_DEFINED) return d;
  }
  return dyd_ball_exceeds(m->ball, (slong)DYD_EXP_LIMIT) ? DYD_TOO_BIG : DYD_DEFINED;
}

static dyd_status undefined_fail(dyd_error *err, const dyd_expr *e, size_t culprit, dyd_defined d, slong prec) {
  const dyd_node *n = &e->node[culprit];
  const char *name = dyd_op_name((dyd_op)n->op);
  if (err) err->column = n->column;
  if (d == DYD_TOO_BIG || d == DYD_TOO_BIG_YET) {
    return dyd_fail(err, DYD_E_RANGE,
                    "the result of '%s' leaves the range of numbers (2^-%lld to 2^%lld); scale the input", name,
                    (long long)DYD_EXP_LIMIT, (long long)DYD_EXP_LIMIT);
  }
  if (d == DYD_UNDEFINED) {
    return dyd_fail(err, DYD_E_DOMAIN,
                    "'%s' is undefined here: its argument lies outside its domain; correct the argument", name);
  }
  return dyd_fail(
      err, DYD_E_DOMAIN,
      "'%s' stays undefined: its argument can't be told from a point where it has no value, up to %ld bits; "
      "rewrite the expression or allow more bits",
      name, (long)prec);
}

/* The precision at which to give up: what the caller allows, beyond the places that large numbers take before the
 * binary point (twice, for a large number subtracted from another); a defined value gets as much again. */
static slong precision_cap(const dyd_request *rq, dyd_defined d, slong exponent) {
  int64_t most = rq->max_bits > rq->bits ? rq->max_bits : rq->bits;
  if (most < 0) most = 0;
  slong cap = (slong)most + 64 + 2 * exponent;
  return d == DYD_DEFINED ? cap + (slong)most : cap;
}

static slong next_precision(const machine *m, const dyd_request *rq, dyd_defined d) {
  slong next = 2 * m->prec;
  if (d == DYD_DEFINED) {
    slong missing = dyd_ball_radius_exponent(m->ball) + (slong)rq->bits + 2;
    next = m->prec + missing + 16;
    if (next < m->prec + m->prec / 4) next = m->prec + m->prec / 4;
  }
  return next;
}

/* Raises the precision until the radius is at most 2^-(bits + 2) or the cap is met. */
static dyd_status machine_refine(machine *m, int64_t *extra, const dyd_expr *e, const dyd_request *rq, dyd_error *err) {
  int64_t base = rq->bits > 0 ? rq->bits : 0;
  m->prec = (slong)(base + *extra);
  for (;;) {
    size_t culprit = 0;
    dyd_defined d = machine_run(m, &culprit, e);
    if (m->failed != DYD_OK) return m->failed;
    if (d == DYD_DEFINED && dyd_ball_radius_exponent(m->ball) <= -(slong)rq->bits - 2) {
      *extra = m->prec - base;
      return DYD_OK;
    }
    slong cap = precision_cap(rq, d, m->exponent);
    if (d == DYD_UNDEFINED || d == DYD_TOO_BIG) return undefined_fail(err, e, culprit, d, m->prec);
    if (m->prec >= cap) return d == DYD_DEFINED ? DYD_OK : undefined_fail(err, e, culprit, d, m->prec);
    slong next = next_precision(m, rq, d);
    m->prec = next < cap ? next : cap;
  }
}

static bool machine_init(machine *m, const dyd_expr *e, dyd_error *err) {
  m->failed = DYD_OK;
  m->err = err;
  m->stop = NULL;
  m->capacity = machine_stack_need(e);
  m->ball = dyd_alloc((size_t)m->capacity, sizeof *m->ball);
  if (!m->ball) return false;
  for (slong i = 0; i < m->capacity; i++) arb_init(m->ball + i);
  return true;
}

static void machine_clear(machine *m) {
  for (slong i = 0; i < m->capacity; i++) arb_clear(m->ball + i);
  free(m->ball);
}

dyd_status dyd_expr_enclose(dyd_interval *out, int64_t *extra, const dyd_expr *e, const dyd_request *request,
                            dyd_error *err) {
  machine m;
  if (!machine_init(&m, e, err)) return dyd_fail_nomem(err);
  m.stop = request->stop;
  dyd_status st = machine_refine(&m, extra, e, request, err);
  if (st == DYD_OK) {
    st = dyd_ball_interval(out, m.ball, -request->bits - 2);
    if (st == DYD_E_RANGE) undefined_fail(err, e, e->count - 1, DYD_TOO_BIG, m.prec);
    if (st == DYD_E_NOMEM) dyd_fail_nomem(err);
  }
  machine_clear(&m);
  return st;
}

dyd_status dyd_expr_probe(const dyd_expr *e, dyd_error *err) {
  machine m;
  size_t culprit = 0;
  if (!machine_init(&m, e, err)) return dyd_fail_nomem(err);
  m.prec = 64;
  dyd_defined d = machine_run(&m, &culprit, e);
  machine_clear(&m);
  if (m.failed != DYD_OK) return m.failed;
  return d == DYD_UNDEFINED || d == DYD_TOO_BIG ? undefined_fail(err, e, culprit, d, 64) : DYD_OK;
}
