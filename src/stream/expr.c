/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Building expressions: a recursive-descent parser that folds rational parts as it goes.
 *
 *   sum     = product { (+|-) product }          product = signed { (*|/) signed }
 *   signed  = { + | - } power                    power   = primary [ ^ signed ]      (so -2^2 = -4, 2^3^2 = 2^9)
 *   primary = literal | pi | e | x | root ( .. ) | function ( sum {, sum} ) | ( sum )
 *
 * "+-" outside parentheses ends an expression: it introduces a radius. */
#include "stream/expr.h"

#include "base/alloc.h"
#include "base/error.h"
#include "stream/number.h"
#include <string.h>

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

static dyd_status push_literal(parser *p, const dyd_literal *l, size_t at) {
  dyd_expr *e = p->e;
  dyd_status st = push_node(p, DYD_OP_CONST, at);
  if (st != DYD_OK) return st;
  if (!dyd_draft_reserve_constant(p->d)) return dyd_fail_nomem(p->err);
  last_node(p)->argument = (int32_t)e->constants;
  e->constant[e->constants++] = (dyd_constant){.den = 1};
  st = dyd_constant_literal(last_constant(p), l);
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

static dyd_status name_fail(parser *p, size_t at, size_t n) {
  int shown = n < 32 ? (int)n : 32;
  if (name_is_infinity(p->text + at, n))
    return FAIL(p, at, DYD_E_PARSE,
                "coordinates are finite, and this is infinite; give a number, or leave the point out");
  if (n == 4 && !memcmp(p->text + at, "root", 4)) {
    return FAIL(p, at, DYD_E_PARSE, "root(polynomial, lo, hi) cannot stand within another root");
  }
  return FAIL(p, at, DYD_E_PARSE,
              "the name '%.*s' is unknown; known are pi e sqrt cbrt exp log sin cos tan asin acos atan "
              "sinh cosh tanh abs min max root",
              shown, p->text + at);
}

/* A root that is rational becomes a constant. */
static dyd_status push_known_root(parser *p, const dyd_real *x, size_t at) {
  mpq_t lo, hi;
  dyd_status st = push_node(p, DYD_OP_CONST, at);
  if (st != DYD_OK) return st;
  if (!dyd_draft_reserve_constant(p->d)) return dyd_fail_nomem(p->err);
  last_node(p)->argument = (int32_t)p->e->constants;
  p->e->constant[p->e->constants++] = (dyd_constant){.den = 1};
  mpq_inits(lo, hi, NULL);
  dyd_interval_get_q(lo, hi, dyd_real_interval(x));
  st = dyd_constant_set(last_constant(p), lo);
  mpq_clears(lo, hi, NULL);
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

/* "root" has been read. */
static dyd_status parse_root(parser *p, size_t at) {
  dyd_real *x = NULL;
  if (peek_char(p) != '(') return FAIL(p, p->pos, DYD_E_PARSE, "a '(' is missing after root");
  p->pos++;
  dyd_status st = p->names.root(&x, &p->pos, p->text, p->length, p->err);
  if (st != DYD_OK) return st;
  bool known = dyd_real_is_final(x);
  st = known ? push_known_root(p, x, at) : push_root(p, x, at);
  if (known || st != DYD_OK) dyd_real_free(x);
  return st;
}

/* Is the name the n letters of the text? */
static bool text_is_name(const char name[5], const char *text, size_t n) {
  return name[0] == *text && n < 5 && name[n] == 0 && !memcmp(name, text, n);
}

static dyd_status parse_name(parser *p) {
  size_t at = p->pos, n = 0, i = 0;
  while (at + n < p->length && (is_letter(p->text[at + n]) || (p->text[at + n] >= '0' && p->text[at + n] <= '9'))) n++;
  while (i < NAME_COUNT && !text_is_name(names[i].name, p->text + at, n)) i++;
  if (i == NAME_COUNT && p->names.root && n == 4 && !memcmp(p->text + at, "root", 4)) {
    p->pos += n;
    return parse_root(p, at);
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
  dyd_literal l;
  if (dyd_literal_scan(&l, p->text, p->length, p->pos)) {
    size_t at = p->pos;
    p->pos = l.end;
    return push_literal(p, &l, at);
  }
  if (c == '(') return parse_group(p, DYD_OP_CONST, p->pos);
  if (is_letter(c)) return parse_name(p);
  if (c < 0) return FAIL(p, p->pos, DYD_E_PARSE, "the expression ends too early; a number, a name or '(' is missing");
  return FAIL(p, p->pos, DYD_E_PARSE, "a number, a name or '(' is missing here");
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
                  "'+-' introduces a radius and can't stand in parentheses; for a sum write 'a - b'");
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
