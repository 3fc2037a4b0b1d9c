/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Expressions as exact objects: what coordinates are made of, each part once.
 *
 * A form is a node of a graph without circles: a number, pi, e, a root of a polynomial, something of which nothing but
 * its identity is known, or an operation on forms. Equal forms are one node. Forms describe a coordinate;
 * dyd_forms_value encloses its value in balls. */
#ifndef DYD_STREAM_ALGEBRA_FORM_H
#define DYD_STREAM_ALGEBRA_FORM_H

#include "base/index.h"
#include "stream/arb.h"
#include "stream/expr.h"
#include "stream/root.h"
#include <dyadel/stream.h>

/* Operations beside those of expressions. ROOT: object is the dyd_root; OPAQUE: object and b say whose value it is;
 * CLAIM: the value of `object` is that of a, as the caller says. */
enum { DYD_FORM_ROOT = DYD_OP_ABS + 1, DYD_FORM_OPAQUE, DYD_FORM_CLAIM };

/* The greatest number of forms, and the longest path from one to a leaf. */
#define DYD_FORMS_MOST ((size_t)1 << 18)
#define DYD_FORMS_DEPTH 5000

/* Invariant: a and b, where the operation has them, are lower numbers; DYD_OP_CONST: a is the place of the
 * constant, b a digest of it;
 * root: a copy of the root with a bracket of its own. value is known to `prec` bits, 0: not yet. */
typedef struct dyd_form {
  unsigned char op;
  uint16_t depth;
  int32_t exponent; /* DYD_OP_POW */
  uint32_t a, b;
  const void *object;
  dyd_root *root;
  uint32_t next; /* with the same place in the table */
  slong prec;
  arb_struct value;
} dyd_form;

enum { DYD_FORMS_PLACES = 1024 };

typedef struct dyd_form_point {
  uint32_t x, y;
} dyd_form_point;

/* A point made of others, whose forms are known. */
typedef struct dyd_form_seen {
  const void *object;
  dyd_form_point at;
} dyd_form_seen;

/* Init with dyd_forms_init. What objects point to is borrowed. */
typedef struct dyd_forms {
  dyd_form *node;
  size_t count, cap;
  mpq_t *constant;
  size_t constants, constant_cap;
  uint32_t head[DYD_FORMS_PLACES];
  dyd_form_seen *seen;
  size_t seen_count, seen_cap;
  bool opaque;              /* one is, of which more may be known later */
  const volatile int *stop; /* NULL, or once it is set values end as not known */
  bool failed;              /* memory is exhausted: the forms asked for are missing */
} dyd_forms;

void dyd_forms_init(dyd_forms *f);
void dyd_forms_clear(dyd_forms *f);
/* The number of a form, new or known. DYD_NONE: the value is unknown; so it is where an operand is DYD_NONE,
 * where forms are too many or too deep, and where memory is exhausted. */
uint32_t dyd_forms_number(dyd_forms *f, mpq_srcptr q);
uint32_t dyd_forms_leaf(dyd_forms *f, dyd_op op);
uint32_t dyd_forms_unary(dyd_forms *f, dyd_op op, uint32_t a, int32_t exponent);
uint32_t dyd_forms_binary(dyd_forms *f, dyd_op op, uint32_t a, uint32_t b);

/* Returns true if it contains no other form. */
static inline bool dyd_form_is_leaf(const dyd_form *n) {
  return dyd_op_is_leaf((dyd_op)n->op) || n->op == DYD_FORM_ROOT || n->op == DYD_FORM_OPAQUE;
}
static inline mpq_srcptr dyd_form_number(const dyd_forms *f, uint32_t n) {
  return f->constant[f->node[n].a];
}

/* A ball that holds the value of n, computed to about prec bits; not finite where the value is unknown. Every operation
 * in it is taken to be defined. Borrowed until the next call. */
arb_srcptr dyd_forms_value(dyd_forms *f, uint32_t n, slong prec);

/* Reals and points as forms. */

/* The form of x; DYD_NONE where it is not one number. x is borrowed for the life of f. */
uint32_t dyd_forms_real(dyd_forms *f, const dyd_real *x);
/* The forms of both coordinates of a stream, or of the point r, a rectangle that is a point; DYD_NONE for one that is
 * unknown. */
dyd_form_point dyd_forms_stream(dyd_forms *f, const dyd_stream *s);
dyd_form_point dyd_forms_rect(dyd_forms *f, const dyd_rect *r);
/* The centre of the region that all rectangles of s hold, s not final, and of the rectangle r; half its sides. */
dyd_form_point dyd_forms_region(dyd_forms *f, mpq_t half[2], const dyd_stream *s);
dyd_form_point dyd_forms_middle(dyd_forms *f, mpq_t half[2], const dyd_rect *r);

/* Forms that are 0 where three points are on one line, where four are on one circle or line. */
uint32_t dyd_forms_collinear(dyd_forms *f, const dyd_form_point p[3]);
uint32_t dyd_forms_cocircular(dyd_forms *f, const dyd_form_point p[4]);
/* The square of the distance of two points. */
uint32_t dyd_forms_distance2(dyd_forms *f, dyd_form_point p, dyd_form_point q);

#endif
