/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Expressions over the computable reals: text -> a short array of nodes in postfix order -> enclosing intervals.
 *
 * Whatever is rational by its form is folded into one exact constant while parsing. No FLINT object outlives a
 * call, so expressions may move between threads and flint_cleanup() may be called at any time. */
#ifndef DYD_STREAM_EXPR_H
#define DYD_STREAM_EXPR_H

#include "stream/number.h"
#include <dyadel/stream.h>

/* Rational constants of expressions: two words where these suffice, a rational of its own otherwise. */

/* den > 0: the value is num / den in lowest terms, |num| and den below 2^62; den = 0: the value is *big, owned. */
typedef struct dyd_constant {
  union {
    int64_t num;
    mpq_ptr big;
  } u;
  int64_t den;
} dyd_constant;

static inline bool dyd_constant_is_short(const dyd_constant *c) {
  return c->den != 0;
}

/* A place in which a short constant looks like a rational. */
typedef struct dyd_constant_view {
  mpq_t q;
  mp_limb_t limb[2];
} dyd_constant_view;

void dyd_constant_clear(dyd_constant *c);
/* c (0/1 or any value before) = q. DYD_OK or DYD_E_NOMEM (c unchanged). */
dyd_status dyd_constant_set(dyd_constant *c, mpq_srcptr q);
/* The value; borrowed from c and *view. */
mpq_srcptr dyd_constant_get(dyd_constant_view *view, const dyd_constant *c);
/* Bits of numerator and denominator together, each at least 1. */
size_t dyd_constant_bits(const dyd_constant *c);
/* Sign of c - k, |k| <= 1. */
int dyd_constant_cmp(const dyd_constant *c, int k);

/* Bounds that keep hostile text cheap: nesting, nodes, roots, and bits of all rationals computed while folding. */
#define DYD_EXPR_DEPTH 200
#define DYD_EXPR_NODES ((size_t)4096)
#define DYD_EXPR_WORK ((size_t)1 << 23)
#define DYD_EXPR_ROOTS ((size_t)64)

typedef enum dyd_op {
  DYD_OP_CONST,
  DYD_OP_X, /* the variable of root(...) */
  DYD_OP_PI,
  DYD_OP_E,
  DYD_OP_ROOT, /* a root of a polynomial, kept as a real of its own */
  DYD_OP_ADD,
  DYD_OP_SUB,
  DYD_OP_MUL,
  DYD_OP_DIV,
  DYD_OP_MIN,
  DYD_OP_MAX,
  DYD_OP_NEG,
  DYD_OP_POW, /* integer exponent, kept in the node */
  DYD_OP_SQRT,
  DYD_OP_CBRT,
  DYD_OP_EXP,
  DYD_OP_LOG,
  DYD_OP_SIN,
  DYD_OP_COS,
  DYD_OP_TAN,
  DYD_OP_ASIN,
  DYD_OP_ACOS,
  DYD_OP_ATAN,
  DYD_OP_SINH,
  DYD_OP_COSH,
  DYD_OP_TANH,
  DYD_OP_ABS
} dyd_op;
static inline bool dyd_op_is_binary(dyd_op op) {
  return op >= DYD_OP_ADD && op <= DYD_OP_MAX;
}
static inline bool dyd_op_is_leaf(dyd_op op) {
  return op <= DYD_OP_ROOT;
}
/* The name users write, for messages. Static storage. */
const char *dyd_op_name(dyd_op op);

/* Range of the value of a node at every precision: it lies in [lo,hi]; the ends are -1, 0, 1 or
 * absent (lo = -DYD_NO_END, hi = DYD_NO_END). */
#define DYD_NO_END 9
typedef struct dyd_range {
  signed char lo, hi;
} dyd_range;

typedef struct dyd_node {
  unsigned char op; /* a dyd_op */
  dyd_range range;
  uint32_t column;  /* of the operator or name in the text, from 1; the largest number means all beyond */
  int32_t argument; /* DYD_OP_POW: the exponent, within +- DYD_EXP_LIMIT; DYD_OP_CONST, DYD_OP_ROOT: index
                     of the constant or root */
} dyd_node;

/* Invariant: node[0..count-1] is a complete expression in postfix order, constants and roots are used in order, each
 * once; a rational expression is the single node DYD_OP_CONST. Roots are one reference each; evaluating narrows them.
 */
typedef struct dyd_expr {
  dyd_node *node;
  dyd_constant *constant;
  dyd_real **root;
  size_t count, constants, roots;
} dyd_expr;

/* An expression while it is parsed: short ones without roots need no memory of their own.
 * Invariant: e.node = node or a block of node_cap nodes, the same for constants; roots are a block. Stays where it was
 * initialised. */
typedef struct dyd_draft {
  dyd_expr e;
  size_t node_cap, constant_cap, root_cap;
  dyd_node node[16];
  dyd_constant constant[8];
} dyd_draft;

void dyd_draft_init(dyd_draft *d);
void dyd_draft_clear(dyd_draft *d);
/* The words that a reader of roots takes. */
typedef enum dyd_real_word { DYD_WORD_ROOT, DYD_WORD_RANDOM, DYD_WORD_SLOW, DYD_WORDS } dyd_real_word;
extern const char *const dyd_real_words[DYD_WORDS];
/* Reads a root, or what another word begins, *pos being behind its "root(", and moves *pos behind the closing
 * parenthesis. Errors have a column. */
typedef dyd_status dyd_root_reader(dyd_real **out, dyd_real_word word, size_t *pos, const char *text, size_t length,
                                   dyd_error *err);
/* Which names are known besides those of numbers and functions. */
typedef struct dyd_expr_names {
  bool x;
  dyd_root_reader *root; /* NULL: root is not */
} dyd_expr_names;
/* Parses the longest expression at text[*pos] and moves *pos behind it and the blanks that follow. d was just
 * initialised. Errors have column and message; d can only be cleared then. */
dyd_status dyd_expr_parse(dyd_draft *d, size_t *pos, const char *text, size_t length, dyd_expr_names names,
                          dyd_error *err);
/* Bytes that follow a dyd_expr into which dyd_expr_take moves e. */
size_t dyd_expr_size(const dyd_expr *e);
/* Moves the parsed expression to *out and the dyd_expr_size bytes that follow it in the same block; the constants and
 * roots leave the draft. Release with dyd_expr_clear, which leaves the block. */
void dyd_expr_take(dyd_expr *out, dyd_draft *d);
void dyd_expr_clear(dyd_expr *e);
/* The value when the expression is rational, else NULL. Borrowed. */
const dyd_constant *dyd_expr_rational(const dyd_expr *e);
/* The range of op applied to known ranges (b: binary operators; exponent: DYD_OP_POW) [RANGE-1]. */
dyd_range dyd_range_apply(dyd_op op, dyd_range a, dyd_range b, long exponent);
dyd_range dyd_range_of_constant(const dyd_constant *c);

/* Room for one more node, constant or root; false: memory is exhausted. */
bool dyd_draft_reserve_node(dyd_draft *d);
bool dyd_draft_reserve_root(dyd_draft *d);
bool dyd_draft_reserve_constant(dyd_draft *d);

/* Exact folding: x = op(x) or x = op(x, y). *done: the result is rational and now in x.
 * DYD_E_DOMAIN when op is undefined there, DYD_E_RANGE when the result is too large, DYD_E_NOMEM. */
dyd_status dyd_fold_unary(dyd_constant *x, bool *done, dyd_op op, long exponent);
dyd_status dyd_fold_binary(dyd_constant *x, dyd_op op, const dyd_constant *y);

/* An interval that contains the value of e, of width at most 2^-bits if the precision needed stays below a cap
 * that follows from max_bits and the size of the numbers; its ends are multiples of 2^-(bits + 2) unless it is a
 * point. *extra is the precision beyond bits that sufficed last time (start: DYD_EXPR_EXTRA).
 * DYD_E_DOMAIN when a function stays undefined, DYD_E_RANGE when a number leaves the range; with column. */
#define DYD_EXPR_EXTRA 48
/* Tells at low precision whether the expression is certainly undefined or out of range. Errors as above. */
dyd_status dyd_expr_probe(const dyd_expr *e, dyd_error *err);

#endif
