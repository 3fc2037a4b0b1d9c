/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of forms, and their values in balls [ENC-1]. */
#include "stream/algebra/form.h"

#include "base/alloc.h"
#include "base/flag.h"
#include "base/local.h"
#include "stream/ball.h"
#include "stream/real.h"
#include "stream/stream.h"

#include <string.h>

void dyd_forms_init(dyd_forms *f) {
  *f = (dyd_forms){0};
  memset(f->head, 0xff, sizeof f->head);
}

void dyd_forms_clear(dyd_forms *f) {
  for (size_t n = 0; n < f->count; n++) {
    arb_clear(&f->node[n].value);
    dyd_root_free(f->node[n].root);
  }
  for (size_t k = 0; k < f->constants; k++) mpq_clear(f->constant[k]);
  dyd_free_all(f->node, f->constant, f->seen);
  dyd_forms_init(f);
}

/* ---- the table ---- */

static uint32_t form_place(const dyd_form *n) {
  uint64_t h = n->op * UINT64_C(0x9e3779b97f4a7c15) ^ (uintptr_t)n->object;
  if (n->op != DYD_OP_CONST) h = (h ^ n->a) * UINT64_C(0xff51afd7ed558ccd);
  h = (h ^ n->b ^ (uint32_t)n->exponent) * UINT64_C(0xc4ceb9fe1a85ec53);
  return (uint32_t)(h >> 32) % DYD_FORMS_PLACES;
}

static bool forms_are_equal(const dyd_form *x, const dyd_form *y) {
  return x->op == y->op && x->a == y->a && x->b == y->b && x->exponent == y->exponent && x->object == y->object;
}

static uint32_t forms_append(dyd_forms *f, dyd_form n, uint32_t place) {
  if (f->count >= DYD_FORMS_MOST || n.depth > DYD_FORMS_DEPTH) return DYD_NONE;
  if (!DYD_GROW(f->node, f->cap, f->count + 1)) {
    f->failed = true;
    return DYD_NONE;
  }
  n.next = f->head[place];
  arb_init(&n.value);
  f->node[f->count] = n;
  return f->head[place] = (uint32_t)f->count++;
}

static uint32_t forms_find(dyd_forms *f, dyd_form n) {
  uint32_t place = form_place(&n), k = f->head[place];
  while (k != DYD_NONE && !forms_are_equal(&f->node[k], &n)) k = f->node[k].next;
  return k != DYD_NONE ? k : forms_append(f, n, place);
}

/* Numbers are found by their lowest limbs, kept in b. */
static dyd_form form_of_number(mpq_srcptr q) {
  mp_limb_t h = mpz_getlimbn(mpq_numref(q), 0) * 31 + mpz_getlimbn(mpq_denref(q), 0) * 2 + (mpq_sgn(q) < 0);
  return (dyd_form){.op = DYD_OP_CONST, .b = (uint32_t)(h ^ h >> 32)};
}

static bool forms_keep_number(dyd_forms *f, mpq_srcptr q) {
  if (!DYD_GROW(f->constant, f->constant_cap, f->constants + 1)) return false;
  mpq_init(f->constant[f->constants]);
  mpq_set(f->constant[f->constants++], q);
  return true;
}

uint32_t dyd_forms_number(dyd_forms *f, mpq_srcptr q) {
  dyd_form n = form_of_number(q);
  uint32_t place = form_place(&n), k = f->head[place];
  for (; k != DYD_NONE; k = f->node[k].next) {
    const dyd_form *known = &f->node[k];
    if (known->op == DYD_OP_CONST && known->b == n.b && mpq_equal(f->constant[known->a], q)) return k;
  }
  n.a = (uint32_t)f->constants;
  if (forms_keep_number(f, q)) return forms_append(f, n, place);
  f->failed = true;
  return DYD_NONE;
}

uint32_t dyd_forms_leaf(dyd_forms *f, dyd_op op) {
  return forms_find(f, (dyd_form){.op = (unsigned char)op});
}

uint32_t dyd_forms_unary(dyd_forms *f, dyd_op op, uint32_t a, int32_t exponent) {
  if (a == DYD_NONE) return DYD_NONE;
  uint16_t depth = (uint16_t)(f->node[a].depth + 1);
  return forms_find(f, (dyd_form){.op = (unsigned char)op, .a = a, .exponent = exponent, .depth = depth});
}

uint32_t dyd_forms_binary(dyd_forms *f, dyd_op op, uint32_t a, uint32_t b) {
  if (a == DYD_NONE || b == DYD_NONE) return DYD_NONE;
  uint16_t depth = f->node[a].depth > f->node[b].depth ? f->node[a].depth : f->node[b].depth;
  return forms_find(f, (dyd_form){.op = (unsigned char)op, .a = a, .b = b, .depth = (uint16_t)(depth + 1)});
}

static uint32_t forms_root(dyd_forms *f, const dyd_root *r) {
  uint32_t n = forms_find(f, (dyd_form){.op = DYD_FORM_ROOT, .object = r});
  if (n == DYD_NONE || f->node[n].root) return n;
  if (dyd_root_copy(&f->node[n].root, r) == DYD_OK) return n;
  f->failed = true;
  return DYD_NONE;
}

static uint32_t forms_claim(dyd_forms *f, const void *object, uint32_t a) {
  if (a == DYD_NONE) return DYD_NONE;
  return forms_find(f, (dyd_form){.op = DYD_FORM_CLAIM, .a = a, .object = object, .depth = f->node[a].depth});
}

/* now: where the value lies; NULL: anywhere. */
/* The value does not change: the callback is not called. */
static uint32_t forms_opaque(dyd_forms *f, const void *object, uint32_t part, const dyd_interval *now) {
  uint32_t n = forms_find(f, (dyd_form){.op = DYD_FORM_OPAQUE, .object = object, .b = part});
  if (n == DYD_NONE || f->node[n].prec) return n;
  f->opaque = true;
  f->node[n].prec = WORD_MAX;
  arb_indeterminate(&f->node[n].value);
  if (!now) return n;
  DYD_LOCAL_NUMBERS(arb, hi);
  DYD_LOCAL_NUMBERS(fmpz, den);
  fmpz_set_mpz(den, now->den);
  dyd_ball_set_z_2exp(&f->node[n].value, now->lo.man, (slong)now->lo.exp);
  dyd_ball_set_z_2exp(hi, now->hi.man, (slong)now->hi.exp);
  arb_union(&f->node[n].value, &f->node[n].value, hi, 256);
  arb_div_fmpz(&f->node[n].value, &f->node[n].value, den, 256);
  return n;
}

/* ---- values ---- */

/* Where the operand of op lies, since the operation is defined. */
static dyd_range form_domain(dyd_op op) {
  if (op == DYD_OP_SQRT) return (dyd_range){0, DYD_NO_END};
  if (op == DYD_OP_ASIN || op == DYD_OP_ACOS) return (dyd_range){-1, 1};
  return (dyd_range){-DYD_NO_END, DYD_NO_END};
}

static void value_of_root(arb_ptr out, dyd_root *r, slong prec, const volatile int *stop) {
  dyd_status st = DYD_OK;
  while (st == DYD_OK && !dyd_root_is_narrow(r, prec)) st = dyd_root_step(r, prec, stop, NULL);
  DYD_LOCAL_NUMBERS(arb, hi);
  if (r->on_grid) {
    dyd_ball_set_z_2exp(out, r->slot, 0);
    arb_add_ui(hi, out, r->exact ? 0 : 1, ARF_PREC_EXACT);
    arb_mul_2exp_si(out, out, (slong)-r->s);
    arb_mul_2exp_si(hi, hi, (slong)-r->s);
  } else {
    dyd_ball_set_q(out, r->lo, prec);
    dyd_ball_set_q(hi, r->hi, prec);
  }
  arb_union(out, out, hi, prec + 64);
}

static dyd_defined value_of_leaf(arb_ptr out, dyd_forms *f, const dyd_form *n, slong prec) {
  const dyd_ball_step constant = {.op = (dyd_op)n->op, .prec = prec};
  switch (n->op) {
  case DYD_OP_CONST:
    dyd_ball_set_q(out, f->constant[n->a], prec);
    return DYD_DEFINED;
  case DYD_OP_PI:
  case DYD_OP_E:
    return dyd_ball_apply(out, &constant, f->stop);
  case DYD_FORM_ROOT:
    value_of_root(out, n->root, prec, f->stop);
    return DYD_DEFINED;
  default:
    return DYD_UNDEFINED_YET;
  }
}

static void value_compute(dyd_forms *f, uint32_t k, slong prec);

/* By way of the operands. */
static dyd_defined value_of_operation(dyd_forms *f, dyd_form *n, slong prec) {
  dyd_ball_step s = {.op = (dyd_op)n->op, .range = form_domain((dyd_op)n->op), .exponent = n->exponent, .prec = prec};
  value_compute(f, n->a, prec);
  if (dyd_op_is_binary(s.op)) {
    value_compute(f, n->b, prec);
    s.y = &f->node[n->b].value;
  }
  arb_set(&n->value, &f->node[n->a].value);
  if (!arb_is_finite(&n->value)) return DYD_UNDEFINED_YET;
  return n->op == DYD_FORM_CLAIM ? DYD_DEFINED : dyd_ball_apply(&n->value, &s, f->stop);
}

/* A stopped value counts as not computed. */
static void value_compute(dyd_forms *f, uint32_t k, slong prec) {
  dyd_form *n = &f->node[k];
  dyd_defined d = DYD_UNDEFINED_YET;
  slong exponent = 0;
  if (n->prec >= prec) return;
  if (!dyd_flag_is_set(f->stop))
    d = dyd_form_is_leaf(n) ? value_of_leaf(&n->value, f, n, prec) : value_of_operation(f, n, prec);
  bool stopped = dyd_flag_is_set(f->stop);
  if (d == DYD_DEFINED && !stopped) d = dyd_ball_check(&n->value, &exponent);
  if (d != DYD_DEFINED || stopped) arb_indeterminate(&n->value);
  n->prec = stopped ? 0 : prec;
}

arb_srcptr dyd_forms_value(dyd_forms *f, uint32_t n, slong prec) {
  value_compute(f, n, prec);
  return &f->node[n].value;
}

/* From what reals and streams are made of to forms, and determinants of points. */

#define NOWHERE ((dyd_form_point){DYD_NONE, DYD_NONE})

/* ---- reals ---- */

static uint32_t form_of_interval(dyd_forms *f, const dyd_interval *a) {
  DYD_LOCAL_NUMBERS(mpq, q);
  dyd_interval_get_q(q, q, a);
  return dyd_forms_number(f, q);
}

/* Finds each leaf by the contents of its node without the operation; a node of another kind would be the same form
 * everywhere, so it is not a leaf. */
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
    return forms_root(f, object);
  case DYD_REAL_CLAIMED:
    return forms_claim(f, x, dyd_forms_real(f, object));
  case DYD_REAL_OPAQUE:
    return forms_opaque(f, x, 0, now);
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
  if (!DYD_GROW(f->seen, f->seen_cap, f->seen_count + 1)) {
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
    return (dyd_form_point){forms_opaque(f, s, 0, r ? &r->x : NULL), forms_opaque(f, s, 1, r ? &r->y : NULL)};
  }
}

static uint32_t form_of_middle(dyd_forms *f, mpq_t half, const dyd_interval *a) {
  DYD_LOCAL_NUMBERS(mpq, lo);
  dyd_interval_get_q(lo, half, a);
  mpq_sub(half, half, lo);
  mpq_div_2exp(half, half, 1);
  mpq_add(lo, lo, half);
  return dyd_forms_number(f, lo);
}

dyd_form_point dyd_forms_middle(dyd_forms *f, mpq_t half[2], const dyd_rect *r) {
  return (dyd_form_point){form_of_middle(f, half[0], &r->x), form_of_middle(f, half[1], &r->y)};
}

static uint32_t form_of_side(dyd_forms *f, mpq_t half, const dyd_real *x) {
  if (dyd_real_is_final(x)) return form_of_middle(f, half, dyd_real_interval(x));
  dyd_real_radius(half, x);
  return dyd_forms_real(f, dyd_real_centre(x));
}

dyd_form_point dyd_forms_region(dyd_forms *f, mpq_t half[2], const dyd_stream *s) {
  const void *object;
  if (dyd_stream_object(&object, s) != DYD_STREAM_PAIR) {
    mpq_set_ui(half[0], 0, 1);
    mpq_set_ui(half[1], 0, 1);
    return dyd_forms_stream(f, s);
  }
  const dyd_stream_pair *pair = object;
  return (dyd_form_point){form_of_side(f, half[0], pair->x), form_of_side(f, half[1], pair->y)};
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
