/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of forms, and their values in balls [ENC-1]. */
#include "stream/algebra/form.h"

#include "base/alloc.h"
#include "base/flag.h"
#include "stream/ball.h"

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
  free(f->node);
  free(f->constant);
  free(f->seen);
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
  if (!dyd_reserve((void **)&f->node, &f->cap, f->count + 1, sizeof *f->node)) {
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
  if (!dyd_reserve((void **)&f->constant, &f->constant_cap, f->constants + 1, sizeof *f->constant)) return false;
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

uint32_t dyd_forms_root(dyd_forms *f, const dyd_root *r) {
  uint32_t n = forms_find(f, (dyd_form){.op = DYD_FORM_ROOT, .object = r});
  if (n == DYD_NONE || f->node[n].root) return n;
  if (dyd_root_copy(&f->node[n].root, r) == DYD_OK) return n;
  f->failed = true;
  return DYD_NONE;
}

uint32_t dyd_forms_claim(dyd_forms *f, const void *object, uint32_t a) {
  if (a == DYD_NONE) return DYD_NONE;
  return forms_find(f, (dyd_form){.op = DYD_FORM_CLAIM, .a = a, .object = object, .depth = f->node[a].depth});
}

/* The value stays what it is: a callback is not asked. */
uint32_t dyd_forms_opaque(dyd_forms *f, const void *object, uint32_t part, const dyd_interval *now) {
  uint32_t n = forms_find(f, (dyd_form){.op = DYD_FORM_OPAQUE, .object = object, .b = part});
  if (n == DYD_NONE || f->node[n].prec) return n;
  f->opaque = true;
  f->node[n].prec = WORD_MAX;
  arb_indeterminate(&f->node[n].value);
  if (!now || mpz_cmp_ui(now->den, 1)) return n;
  arb_t hi;
  arb_init(hi);
  dyd_ball_set_z_2exp(&f->node[n].value, now->lo.man, (slong)now->lo.exp);
  dyd_ball_set_z_2exp(hi, now->hi.man, (slong)now->hi.exp);
  arb_union(&f->node[n].value, &f->node[n].value, hi, 256);
  arb_clear(hi);
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
  arb_t hi;
  dyd_status st = DYD_OK;
  while (st == DYD_OK && !dyd_root_is_narrow(r, prec)) st = dyd_root_step(r, prec, stop, NULL);
  arb_init(hi);
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
  arb_clear(hi);
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

/* What is stopped counts as not computed. */
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
