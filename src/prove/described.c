/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Are points what a certificate describes? Number by number, as they are made of others. */
#include "base/alloc.h"
#include "engine/ties.h"
#include "prove/numbers.h"
#include "stream/ball.h"

#include <string.h>

/* line[n]: the number that form n is; form[k]: the form that number k, of which nothing is known, is. */
typedef struct comparison {
  dyd_forms forms;
  const dyd_cert_algebra *numbers;
  uint32_t *line, *form;
  size_t cap;
} comparison;

/* The polynomials are the same up to the sign, and the root is in the bracket, which holds one. */
static bool is_same_root(comparison *c, uint32_t n, const dyd_cert_bracket *r) {
  const dyd_root *root = c->forms.node[n].root;
  if (!r || root->count != r->count) return false;
  int sign = mpz_sgn(root->coeff[root->count - 1]);
  for (size_t k = 0; k < r->count; k++)
    if (mpz_cmpabs(root->coeff[k], r->coeff[k]) || mpz_sgn(root->coeff[k]) != sign * mpz_sgn(r->coeff[k])) return false;
  bool inside = false;
  arb_t x, end;
  mpq_t q;
  arb_init(x);
  arb_init(end);
  mpq_init(q);
  for (slong prec = 64; prec <= 2 * DYD_PROOF_BRACKET && !inside; prec *= 2) {
    inside = true;
    for (int k = 0; k < 2; k++) {
      mpq_set_num(q, r->end[2 * k]);
      mpq_set_den(q, r->end[2 * k + 1]);
      dyd_ball_set_q(end, q, prec + 64);
      arb_set(x, dyd_forms_value(&c->forms, n, prec));
      inside = inside && (k ? arb_lt(x, end) : arb_gt(x, end));
    }
  }
  mpq_clear(q);
  arb_clear(end);
  arb_clear(x);
  return inside;
}

static bool is_same_constant(const comparison *c, uint32_t n, const dyd_cert_number *to) {
  mpq_srcptr q = dyd_form_number(&c->forms, n);
  mpz_srcptr num = dyd_cert_poly_integer(&to->value.num), den = dyd_cert_poly_integer(&to->value.den);
  if (to->op != DYD_CERT_VALUE || !den || mpz_cmp(den, mpq_denref(q))) return false;
  return num ? !mpz_cmp(num, mpq_numref(q)) : dyd_cert_poly_is_zero(&to->value.num) && !mpq_sgn(q);
}

static bool is_same_number(comparison *c, uint32_t n, uint32_t k);

/* The same operation on the same numbers. */
static bool is_same_operation(comparison *c, uint32_t n, const dyd_cert_number *to) {
  const dyd_form f = c->forms.node[n];
  const char *name = dyd_proof_op_text(f.op);
  if (!name || strcmp(name, dyd_cert_op_name(to->op)) != 0) return false;
  if (dyd_op_is_leaf((dyd_op)f.op)) return true;
  if (f.op == DYD_OP_POW && f.exponent != to->exponent) return false;
  return is_same_number(c, f.a, to->a) && (!dyd_op_is_binary((dyd_op)f.op) || is_same_number(c, f.b, to->b));
}

static bool is_same_number(comparison *c, uint32_t n, uint32_t k) {
  const dyd_cert_number *to = &c->numbers->number[k];
  const dyd_form *f = &c->forms.node[n];
  bool same;
  if (c->line[n] == k) return true;
  if (f->op == DYD_FORM_OPAQUE) {
    same = to->op == DYD_CERT_CALLBACK && c->line[n] == DYD_NONE && c->form[k] == DYD_NONE;
    if (same) c->form[k] = n;
  } else if (f->op == DYD_FORM_ROOT) {
    same = to->op == DYD_CERT_ROOT && is_same_root(c, n, to->root);
  } else if (f->op == DYD_OP_CONST) {
    same = is_same_constant(c, n, to);
  } else {
    same = is_same_operation(c, n, to);
  }
  if (same) c->line[n] = k;
  return same;
}

/* Room for the lines of all forms. */
static bool comparison_grow(comparison *c) {
  size_t before = c->cap;
  if (!dyd_reserve((void **)&c->line, &c->cap, c->forms.count, sizeof *c->line)) return false;
  memset(c->line + before, 0xff, (c->cap - before) * sizeof *c->line);
  return true;
}

static dyd_status compare_point(bool *same, comparison *c, const dyd_cert_described *d, const dyd_engine *e) {
  *same = false;
  for (int given = 0; given < 2 && !*same; given++) {
    dyd_form_point at;
    dyd_status st = dyd_ties_describe(&at, &c->forms, e, d->site, given);
    if (st != DYD_OK) return st;
    if (c->forms.failed || !comparison_grow(c)) return DYD_E_NOMEM;
    *same = at.x != DYD_NONE && at.y != DYD_NONE && is_same_number(c, at.x, d->number[0]) &&
            is_same_number(c, at.y, d->number[1]);
  }
  return DYD_OK;
}

/* Of one block. */
static dyd_status compare_points(bool *found, size_t *others, const dyd_cert_block *b, const dyd_engine *e) {
  comparison c = {.numbers = &b->algebra};
  c.form = dyd_alloc(b->algebra.count, sizeof *c.form);
  if (!c.form) return DYD_E_NOMEM;
  memset(c.form, 0xff, b->algebra.count * sizeof *c.form);
  dyd_forms_init(&c.forms);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < b->points && st == DYD_OK; k++) {
    bool same = false;
    st = compare_point(&same, &c, &b->point[k], e);
    if (same)
      found[b->point[k].site] = true;
    else
      ++*others;
  }
  dyd_forms_clear(&c.forms);
  free(c.line);
  free(c.form);
  return st;
}

dyd_status dyd_proof_compare_points(bool *found, size_t *others, const dyd_cert_ties *t, const dyd_engine *e) {
  dyd_status st = DYD_OK;
  *others = 0;
  for (size_t k = 0; k < t->blocks && st == DYD_OK; k++) st = compare_points(found, others, t->block[k], e);
  return st;
}
