/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From what reals and streams are made of to forms, and determinants of points. */
#include "stream/algebra/describe.h"

#include "base/alloc.h"
#include "rect/rect.h"
#include "stream/real.h"
#include "stream/stream.h"

#define NOWHERE ((dyd_form_point){DYD_NONE, DYD_NONE})

/* ---- reals ---- */

static uint32_t form_of_interval(dyd_forms *f, const dyd_interval *a) {
  mpq_t q;
  mpq_init(q);
  dyd_interval_get_q(q, q, a);
  uint32_t n = dyd_forms_number(f, q);
  mpq_clear(q);
  return n;
}

/* Each leaf by what its node holds beside the operation; one of another kind would be the same form everywhere, so it
 * is none. */
static uint32_t form_of_leaf(dyd_forms *f, const dyd_expr *e, const dyd_node *n) {
  dyd_constant_view view;
  switch (n->op) {
  case DYD_OP_CONST:
    return dyd_forms_number(f, dyd_constant_get(&view, &e->constant[n->argument]));
  case DYD_OP_ROOT:
    return dyd_forms_real(f, e->root[n->argument]);
  case DYD_OP_PI:
  case DYD_OP_E:
    return dyd_forms_leaf(f, (dyd_op)n->op);
  default:
    return DYD_NONE;
  }
}

/* Postfix order: operands are on a stack. */
static uint32_t form_of_expr(dyd_forms *f, const dyd_expr *e) {
  uint32_t *stack = dyd_alloc(e->count, sizeof *stack), top = 0;
  if (!stack) {
    f->failed = true;
    return DYD_NONE;
  }
  for (size_t i = 0; i < e->count; i++) {
    const dyd_node *n = &e->node[i];
    dyd_op op = (dyd_op)n->op;
    if (dyd_op_is_leaf(op)) {
      stack[top++] = form_of_leaf(f, e, n);
    } else if (dyd_op_is_binary(op)) {
      top--;
      stack[top - 1] = dyd_forms_binary(f, op, stack[top - 1], stack[top]);
    } else {
      stack[top - 1] = dyd_forms_unary(f, op, stack[top - 1], op == DYD_OP_POW ? n->argument : 0);
    }
  }
  uint32_t out = stack[0];
  free(stack);
  return out;
}

uint32_t dyd_forms_real(dyd_forms *f, const dyd_real *x) {
  const void *object;
  const dyd_interval *now = dyd_real_interval(x);
  if (dyd_real_is_final(x) && dyd_interval_is_point(now)) return form_of_interval(f, now);
  switch (dyd_real_object(&object, x)) {
  case DYD_REAL_EXPR:
    return form_of_expr(f, object);
  case DYD_REAL_ROOT:
    return dyd_forms_root(f, object);
  case DYD_REAL_CLAIMED:
    return dyd_forms_claim(f, x, dyd_forms_real(f, object));
  case DYD_REAL_OPAQUE:
    return dyd_forms_opaque(f, x, 0, now);
  default:
    return DYD_NONE;
  }
}

/* ---- points ---- */

static uint32_t form_add(dyd_forms *f, uint32_t a, uint32_t b) {
  return dyd_forms_binary(f, DYD_OP_ADD, a, b);
}
static uint32_t form_subtract(dyd_forms *f, uint32_t a, uint32_t b) {
  return dyd_forms_binary(f, DYD_OP_SUB, a, b);
}
static uint32_t form_multiply(dyd_forms *f, uint32_t a, uint32_t b) {
  return dyd_forms_binary(f, DYD_OP_MUL, a, b);
}

/* sum += c n. */
static uint32_t add_multiple(dyd_forms *f, uint32_t sum, mpq_srcptr c, uint32_t n) {
  if (!mpq_sgn(c)) return sum;
  return form_add(f, sum, mpq_cmp_ui(c, 1, 1) ? form_multiply(f, dyd_forms_number(f, c), n) : n);
}

static dyd_form_point form_of_image(dyd_forms *f, const dyd_stream_image *image) {
  dyd_form_point sum = {dyd_forms_number(f, image->shift[0]), dyd_forms_number(f, image->shift[1])};
  for (size_t k = 0; k < image->count; k++) {
    const dyd_stream_term *t = &image->term[k];
    dyd_form_point p = dyd_forms_stream(f, t->of);
    if (p.x == DYD_NONE || p.y == DYD_NONE) return NOWHERE;
    sum.x = add_multiple(f, add_multiple(f, sum.x, t->m[0], p.x), t->m[1], p.y);
    sum.y = add_multiple(f, add_multiple(f, sum.y, t->m[2], p.x), t->m[3], p.y);
  }
  return sum;
}

static uint32_t square_of_length(dyd_forms *f, dyd_form_point p) {
  return form_add(f, form_multiply(f, p.x, p.x), form_multiply(f, p.y, p.y));
}

static dyd_form_point point_difference(dyd_forms *f, dyd_form_point p, dyd_form_point q) {
  return (dyd_form_point){form_subtract(f, p.x, q.x), form_subtract(f, p.y, q.y)};
}

/* p.x q.y - p.y q.x. */
static uint32_t point_cross(dyd_forms *f, dyd_form_point p, dyd_form_point q) {
  return form_subtract(f, form_multiply(f, p.x, q.y), form_multiply(f, p.y, q.x));
}

/* From a: (c.y b^2 - b.y c^2, b.x c^2 - c.x b^2) / 2 (b x c) for the differences b, c. The divisor is not 0: three
 * points that have a centre are not on one line. */
static dyd_form_point form_of_centre(dyd_forms *f, dyd_stream *const of[3]) {
  dyd_form_point a = dyd_forms_stream(f, of[0]);
  dyd_form_point b = point_difference(f, dyd_forms_stream(f, of[1]), a),
                 c = point_difference(f, dyd_forms_stream(f, of[2]), a);
  uint32_t bb = square_of_length(f, b), cc = square_of_length(f, c), area = point_cross(f, b, c),
           twice = form_add(f, area, area);
  uint32_t x = form_subtract(f, form_multiply(f, c.y, bb), form_multiply(f, b.y, cc));
  uint32_t y = form_subtract(f, form_multiply(f, b.x, cc), form_multiply(f, c.x, bb));
  return (dyd_form_point){form_add(f, a.x, dyd_forms_binary(f, DYD_OP_DIV, x, twice)),
                          form_add(f, a.y, dyd_forms_binary(f, DYD_OP_DIV, y, twice))};
}

/* The same streams are met again and again where points are made of points. */
static dyd_form_point form_of_composed(dyd_forms *f, dyd_stream_kind kind, const void *object) {
  for (size_t k = f->seen_count; k-- > 0;)
    if (f->seen[k].object == object) return f->seen[k].at;
  dyd_form_point at = kind == DYD_STREAM_IMAGE ? form_of_image(f, object) : form_of_centre(f, object);
  if (!dyd_reserve((void **)&f->seen, &f->seen_cap, f->seen_count + 1, sizeof *f->seen)) {
    f->failed = true;
    return NOWHERE;
  }
  f->seen[f->seen_count++] = (dyd_form_seen){object, at};
  return at;
}

dyd_form_point dyd_forms_rect(dyd_forms *f, const dyd_rect *r) {
  return (dyd_form_point){form_of_interval(f, &r->x), form_of_interval(f, &r->y)};
}

dyd_form_point dyd_forms_stream(dyd_forms *f, const dyd_stream *s) {
  const void *object;
  const dyd_stream_pair *pair;
  const dyd_rect *r;
  if (dyd_stream_is_final(s)) {
    r = dyd_stream_rect(s);
    return dyd_rect_is_point(r) ? dyd_forms_rect(f, r) : NOWHERE;
  }
  dyd_stream_kind kind = dyd_stream_object(&object, s);
  switch (kind) {
  case DYD_STREAM_PAIR:
    pair = object;
    return (dyd_form_point){dyd_forms_real(f, pair->x), dyd_forms_real(f, pair->y)};
  case DYD_STREAM_IMAGE:
  case DYD_STREAM_CENTRE:
    return form_of_composed(f, kind, object);
  default:
    r = dyd_stream_rect(s);
    return (dyd_form_point){dyd_forms_opaque(f, s, 0, r ? &r->x : NULL), dyd_forms_opaque(f, s, 1, r ? &r->y : NULL)};
  }
}

/* ---- determinants ---- */

uint32_t dyd_forms_collinear(dyd_forms *f, const dyd_form_point p[3]) {
  return point_cross(f, point_difference(f, p[1], p[0]), point_difference(f, p[2], p[0]));
}

/* With the differences b, c, d from p[0]: b^2 (c x d) - c^2 (b x d) + d^2 (b x c), as a linear form in d.x, d.y, d^2,
 * whose coefficients many d have in common. */
uint32_t dyd_forms_cocircular(dyd_forms *f, const dyd_form_point p[4]) {
  dyd_form_point b = point_difference(f, p[1], p[0]), c = point_difference(f, p[2], p[0]),
                 d = point_difference(f, p[3], p[0]);
  uint32_t bb = square_of_length(f, b), cc = square_of_length(f, c), dd = square_of_length(f, d);
  uint32_t along_x = form_subtract(f, form_multiply(f, cc, b.y), form_multiply(f, bb, c.y));
  uint32_t along_y = form_subtract(f, form_multiply(f, bb, c.x), form_multiply(f, cc, b.x));
  return form_add(f, form_add(f, form_multiply(f, along_x, d.x), form_multiply(f, along_y, d.y)),
                  form_multiply(f, point_cross(f, b, c), dd));
}

uint32_t dyd_forms_distance2(dyd_forms *f, dyd_form_point p, dyd_form_point q) {
  return square_of_length(f, point_difference(f, p, q));
}
