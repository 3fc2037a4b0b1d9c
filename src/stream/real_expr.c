/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reals given by expressions: their values, and reals made of other reals by one operation. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/local.h"
#include "stream/ball.h"
#include "stream/expr.h"
#include "stream/real.h"

/* Enclosing the value of an expression: ball arithmetic at a working precision that is raised until the width
 * asked for is met.
 *
 * [ENC-1] Each ball contains the value of its node: Arb's operations are inclusion isotonic, and a ball is cut
 * only with a range the value lies in whatever the precision [RANGE-1]. The stack holds one ball per open
 * operand, so memory follows the nesting, not the length. */

typedef struct machine {
  arb_ptr ball;
  slong top, capacity;
  slong prec;
  slong exponent;    /* every ball so far is below 2^exponent in magnitude */
  dyd_status failed; /* failure of a root, with its reason in *err */
  dyd_error *err;
  const volatile int *stop; /* NULL: no flag */
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
  dyd_status st = dyd_real_narrow_until(root, m->prec, m->prec, m->stop, m->err);
  if (dyd_narrow_ended(st)) {
    if (m->err) m->err->column = n->column;
    m->failed = st;
    return;
  }
  DYD_LOCAL_ARRAY(mpq_t, end, [2]);
  DYD_LOCAL_NUMBERS(arb, hi);
  dyd_interval_get_q(end[0], end[1], dyd_real_interval(root));
  dyd_ball_set_q(out, end[0], m->prec);
  dyd_ball_set_q(hi, end[1], m->prec);
  arb_union(out, out, hi, m->prec);
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

/* Runs all nodes; the value is then m->ball[0]. On failure *culprit is the node; m->failed: details of the failure of a
 * root. */
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
  return dyd_fail(err, DYD_E_DOMAIN,
                  "'%s' stays undefined: up to %ld bits its argument may be a point where it has no value; "
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

static dyd_status expr_enclose(dyd_interval *out, int64_t *extra, const dyd_expr *e, const dyd_request *request,
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

/* Operations above one another at most: narrowing goes down all of them. */
enum { MOST_DEPTH = 1000 };

/* The expression comes last: its nodes follow. depth: of operations of dyd_real_op. */
typedef struct computed {
  int64_t extra;
  int depth;
  dyd_expr expr;
} computed;

static void computed_release(void *user) {
  computed *c = user;
  dyd_expr_clear(&c->expr);
}

/* Returns true if the value is an interval for good: no operand can be narrowed, and not all are points. */
static bool computed_is_vague(const dyd_expr *e) {
  bool vague = false;
  for (size_t k = 0; k < e->roots; k++) {
    if (!dyd_real_is_final(e->root[k])) return false;
    vague = vague || !dyd_interval_is_point(dyd_real_interval(e->root[k]));
  }
  return vague;
}

static dyd_status computed_narrow(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  computed *c = user;
  dyd_status st = expr_enclose(out, &c->extra, &c->expr, request, err);
  return st == DYD_OK && computed_is_vague(&c->expr) ? DYD_FIXED : st;
}

dyd_status dyd_real_new_expr(dyd_real **out, dyd_draft *d) {
  void *inside;
  size_t size = sizeof(computed) + dyd_expr_size(&d->e);
  dyd_status st = dyd_real_new_inside(out, &inside, size, computed_narrow, computed_release);
  if (st != DYD_OK) return st;
  computed *c = inside;
  c->extra = DYD_EXPR_EXTRA;
  c->depth = 0;
  dyd_expr_take(&c->expr, d);
  dyd_real_set_object(*out, DYD_REAL_EXPR, &c->expr);
  return DYD_OK;
}

/* ---- one operation ---- */

static const dyd_op op_of_operation[] = {
    [DYD_REAL_ADD] = DYD_OP_ADD,   [DYD_REAL_SUB] = DYD_OP_SUB,   [DYD_REAL_MUL] = DYD_OP_MUL,
    [DYD_REAL_DIV] = DYD_OP_DIV,   [DYD_REAL_MIN] = DYD_OP_MIN,   [DYD_REAL_MAX] = DYD_OP_MAX,
    [DYD_REAL_NEG] = DYD_OP_NEG,   [DYD_REAL_ABS] = DYD_OP_ABS,   [DYD_REAL_SQRT] = DYD_OP_SQRT,
    [DYD_REAL_CBRT] = DYD_OP_CBRT, [DYD_REAL_EXP] = DYD_OP_EXP,   [DYD_REAL_LOG] = DYD_OP_LOG,
    [DYD_REAL_SIN] = DYD_OP_SIN,   [DYD_REAL_COS] = DYD_OP_COS,   [DYD_REAL_TAN] = DYD_OP_TAN,
    [DYD_REAL_ASIN] = DYD_OP_ASIN, [DYD_REAL_ACOS] = DYD_OP_ACOS, [DYD_REAL_ATAN] = DYD_OP_ATAN,
    [DYD_REAL_SINH] = DYD_OP_SINH, [DYD_REAL_COSH] = DYD_OP_COSH, [DYD_REAL_TANH] = DYD_OP_TANH};

static int real_depth(const dyd_real *x) {
  const computed *c = dyd_real_user(x, computed_narrow);
  return c ? c->depth : 0;
}

/* An exact operand is a constant; any other one is narrowed where the value is needed, and the draft's from now on. */
static dyd_status draft_push_real(dyd_draft *d, dyd_real *x) {
  const dyd_interval *now = dyd_real_interval(x);
  bool exact = dyd_real_is_final(x) && dyd_interval_is_point(now);
  if (!dyd_draft_reserve_node(d) || !(exact ? dyd_draft_reserve_constant(d) : dyd_draft_reserve_root(d))) {
    dyd_real_free(x);
    return DYD_E_NOMEM;
  }
  dyd_node *n = &d->e.node[d->e.count++];
  *n = (dyd_node){.op = exact ? DYD_OP_CONST : DYD_OP_ROOT, .range = {-DYD_NO_END, DYD_NO_END}};
  n->argument = (int32_t)(exact ? d->e.constants : d->e.roots);
  if (!exact) {
    d->e.root[d->e.roots++] = x;
    return DYD_OK;
  }
  DYD_LOCAL_NUMBERS(mpq, q);
  dyd_interval_get_q(q, q, now);
  d->e.constant[d->e.constants] = (dyd_constant){.den = 1};
  dyd_status st = dyd_constant_set(&d->e.constant[d->e.constants++], q);
  n->range = dyd_range_of_constant(&d->e.constant[n->argument]);
  dyd_real_free(x);
  return st;
}

/* Folds an expression that is rational by its form into one constant. *done: it was folded. */
static dyd_status draft_fold(dyd_draft *d, bool *done, dyd_op op) {
  *done = d->e.constants == d->e.count;
  if (!*done) return DYD_OK;
  if (!dyd_op_is_binary(op)) return dyd_fold_unary(&d->e.constant[0], done, op, 0);
  dyd_status st = dyd_fold_binary(&d->e.constant[0], op, &d->e.constant[1]);
  if (st != DYD_OK) return st;
  dyd_constant_clear(&d->e.constant[--d->e.constants]);
  d->e.count--;
  return DYD_OK;
}

static dyd_status draft_push_operation(dyd_draft *d, dyd_op op) {
  if (!dyd_draft_reserve_node(d)) return DYD_E_NOMEM;
  dyd_node *last = &d->e.node[d->e.count - 1];
  dyd_range a = dyd_op_is_binary(op) ? last[-1].range : last->range;
  last[1] = (dyd_node){.op = (unsigned char)op, .range = dyd_range_apply(op, a, last->range, 0)};
  d->e.count++;
  return DYD_OK;
}

static dyd_status real_from_operation(dyd_real **out, dyd_draft *d, dyd_op op, int depth) {
  bool rational;
  dyd_constant_view view;
  dyd_status st = draft_fold(d, &rational, op);
  if (st == DYD_OK && rational) return dyd_real_from_q(out, dyd_constant_get(&view, &d->e.constant[0]));
  if (st == DYD_OK) st = draft_push_operation(d, op);
  if (st == DYD_OK) st = dyd_real_new_expr(out, d);
  if (st != DYD_OK) return st;
  computed *c = dyd_real_user(*out, computed_narrow);
  c->depth = depth;
  return DYD_OK;
}

static const char *operation_text(dyd_status st) {
  if (st == DYD_E_ARG) return "an operation has one operand or two, none of them NULL";
  if (st == DYD_E_DOMAIN) return "the operation is not defined for this exact operand";
  return st == DYD_E_RANGE ? "operations are too many above one another, or the exact result is too large"
                           : dyd_status_text(st);
}

/* Takes over x and y. */
static dyd_status operation_make(dyd_real **out, dyd_real_operation operation, dyd_real *x, dyd_real *y) {
  dyd_op op = op_of_operation[operation];
  int left = real_depth(x), right = y ? real_depth(y) : 0, depth = 1 + (left > right ? left : right);
  DYD_LOCAL(dyd_draft, d);
  dyd_status st = draft_push_real(&d, x);
  if (y) {
    dyd_status second = draft_push_real(&d, y);
    if (st == DYD_OK) st = second;
  }
  if (st == DYD_OK && depth > MOST_DEPTH) st = DYD_E_RANGE;
  return st == DYD_OK ? real_from_operation(out, &d, op, depth) : st;
}

dyd_status dyd_real_op(dyd_real **out, dyd_real *x, dyd_real *y, dyd_real_operation operation, dyd_error *err) {
  bool known = operation >= DYD_REAL_ADD && operation <= DYD_REAL_TANH;
  bool fits = known && out && x && dyd_op_is_binary(op_of_operation[operation]) == (y != NULL);
  dyd_status st = DYD_E_ARG;
  if (fits) {
    st = operation_make(out, operation, x, y);
  } else {
    dyd_real_free(x);
    dyd_real_free(y);
  }
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", operation_text(st));
}
