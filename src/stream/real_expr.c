/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reals given by expressions: read from text, or made of other reals by one operation. */
#include "stream/expr.h"
#include "stream/real.h"

#include "base/error.h"

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

/* Is the value an interval for good: no operand can be narrowed, and not all are points? */
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
  dyd_status st = dyd_expr_enclose(out, &c->extra, &c->expr, request, err);
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
  mpq_t q;
  mpq_init(q);
  dyd_interval_get_q(q, q, now);
  d->e.constant[d->e.constants] = (dyd_constant){.den = 1};
  dyd_status st = dyd_constant_set(&d->e.constant[d->e.constants++], q);
  n->range = dyd_range_of_constant(&d->e.constant[n->argument]);
  mpq_clear(q);
  dyd_real_free(x);
  return st;
}

/* What is rational by its form becomes one constant. *done: it is. */
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
  dyd_draft d;
  dyd_op op = op_of_operation[operation];
  int left = real_depth(x), right = y ? real_depth(y) : 0, depth = 1 + (left > right ? left : right);
  dyd_draft_init(&d);
  dyd_status st = draft_push_real(&d, x);
  if (y) {
    dyd_status second = draft_push_real(&d, y);
    if (st == DYD_OK) st = second;
  }
  if (st == DYD_OK && depth > MOST_DEPTH) st = DYD_E_RANGE;
  if (st == DYD_OK) st = real_from_operation(out, &d, op, depth);
  dyd_draft_clear(&d);
  return st;
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
