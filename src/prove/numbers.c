/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Writes numbers for the checker: the leaves of the engine's algebra first, in its order, so that they have the same
 * numbers, then the parts of all coordinates. */
#include "prove/numbers.h"

#include "base/alloc.h"
#include "stream/algebra/normal.h"

#include <inttypes.h>
#include <string.h>

/* ---- text ---- */

static void put_integer(FILE *out, const fmpz_t z) {
  char *text = fmpz_get_str(NULL, 10, z);
  fputs(text, out);
  flint_free(text);
}

/* The powers of a term, later leaves last; first: nothing stands before. */
static void put_powers(dyd_proof_block *b, const ulong *exponent, bool first) {
  for (slong k = 0; k < b->ring.leaves; k++) {
    ulong e = exponent[dyd_ring_var(&b->ring, k)];
    if (!e) continue;
    fprintf(b->out, first ? "x%ld" : "*x%ld", (long)k);
    if (e > 1) fprintf(b->out, "^%lu", (unsigned long)e);
    first = false;
  }
}

static void put_polynomial(dyd_proof_block *b, const fmpz_mpoly_t p) {
  ulong exponent[DYD_RING_LEAVES];
  fmpz_t c;
  fmpz_init(c);
  if (!p->length) putc('0', b->out);
  for (slong t = 0; t < p->length; t++) {
    bool constant = true;
    fmpz_mpoly_get_term_exp_ui(exponent, p, t, b->ring.ctx);
    for (slong k = 0; k < b->ring.room; k++) constant = constant && !exponent[k];
    fmpz_abs(c, p->coeffs + t);
    if (fmpz_sgn(p->coeffs + t) < 0)
      putc('-', b->out);
    else if (t)
      putc('+', b->out);
    bool one = fmpz_is_one(c) && !constant;
    if (!one) put_integer(b->out, c);
    put_powers(b, exponent, one);
  }
  fmpz_clear(c);
}

static void put_quotient(dyd_proof_block *b, const dyd_fraction *x) {
  putc(' ', b->out);
  put_polynomial(b, x->num);
  if (fmpz_mpoly_is_one(x->den, b->ring.ctx)) return;
  putc('/', b->out);
  put_polynomial(b, x->den);
}

static uint32_t end_line(dyd_proof_block *b) {
  putc('\n', b->out);
  return b->lines++;
}

/* ---- roots ---- */

/* The bracket of the form's value at `prec`, as dyadic fractions with odd denominators 1. */
static void bracket_from_value(dyd_cert_bracket *r, dyd_proof_block *b, uint32_t node, slong prec) {
  arb_t x;
  arf_t end[2];
  fmpz_t man, exp;
  arb_init(x);
  fmpz_init(man);
  fmpz_init(exp);
  arb_set(x, dyd_forms_value(&b->forms, node, prec));
  for (int k = 0; k < 2; k++) {
    arf_init(end[k]);
    (k ? arb_get_ubound_arf : arb_get_lbound_arf)(end[k], x, prec + 64);
    arf_get_fmpz_2exp(man, exp, end[k]);
    fmpz_get_mpz(r->end[2 * k], man);
    mpz_set_ui(r->end[2 * k + 1], 1);
    mpz_ptr shifted = r->end[2 * k + (fmpz_sgn(exp) < 0)];
    if (fmpz_cmp_si(exp, 1 << 20) < 0 && fmpz_cmp_si(exp, -(1 << 20)) > 0)
      mpz_mul_2exp(shifted, shifted, (mp_bitcnt_t)FLINT_ABS(fmpz_get_si(exp)));
    arf_clear(end[k]);
  }
  fmpz_clear(exp);
  fmpz_clear(man);
  arb_clear(x);
}

static void put_end(FILE *out, mpz_t *end) {
  putc(' ', out);
  mpz_out_str(out, 10, end[0]);
  if (!mpz_cmp_ui(end[1], 1)) return;
  putc('/', out);
  mpz_out_str(out, 10, end[1]);
}

/* Writes "root" with the polynomial of these coefficients, the greatest positive, that vanishes at the form. false: no
 * bracket is seen to hold one root. */
static bool put_root(dyd_proof_block *b, uint32_t node, mpz_t *coeff, size_t count) {
  dyd_cert_bracket r = {.coeff = coeff, .count = count};
  bool single = false;
  mpz_inits(r.end[0], r.end[1], r.end[2], r.end[3], NULL);
  for (slong prec = 32; prec <= DYD_PROOF_BRACKET && !single; prec *= 2) {
    bracket_from_value(&r, b, node, prec);
    single = dyd_cert_root_is_single(&r);
  }
  if (single) {
    fputs("root", b->out);
    put_end(b->out, &r.end[0]);
    put_end(b->out, &r.end[2]);
    for (size_t k = 0; k < count; k++) {
      putc(k ? ',' : ' ', b->out);
      mpz_out_str(b->out, 10, coeff[k]);
    }
  }
  mpz_clears(r.end[0], r.end[1], r.end[2], r.end[3], NULL);
  return single;
}

static mpz_t *coefficients_alloc(size_t count) {
  mpz_t *c = dyd_alloc(count, sizeof *c);
  for (size_t k = 0; c && k < count; k++) mpz_init(c[k]);
  return c;
}

static void coefficients_free(mpz_t *c, size_t count) {
  for (size_t k = 0; c && k < count; k++) mpz_clear(c[k]);
  free(c);
}

/* From the relation t^n + ..., t = a x: the coefficient of t^e is f_e a^(n - 1 - e). */
static bool put_root_leaf(dyd_proof_block *b, slong l) {
  const dyd_leaf *leaf = &b->ring.leaf[l];
  size_t n = (size_t)leaf->degree;
  ulong exponent[DYD_RING_LEAVES];
  mpz_t *f = coefficients_alloc(n + 1);
  if (!f) return false;
  mpz_t power;
  mpz_init_set_ui(power, 1);
  fmpz_get_mpz(f[n], leaf->base);
  for (slong t = 0; t < leaf->relation->length; t++) {
    fmpz_mpoly_get_term_exp_ui(exponent, leaf->relation, t, b->ring.ctx);
    size_t e = exponent[dyd_ring_var(&b->ring, l)];
    if (e == n) continue;
    fmpz_get_mpz(f[e], leaf->relation->coeffs + t);
    mpz_pow_ui(power, f[n], n - 1 - e);
    mpz_divexact(f[e], f[e], power);
  }
  bool written = put_root(b, leaf->node, f, n + 1);
  mpz_clear(power);
  coefficients_free(f, n + 1);
  return written;
}

static bool put_root_form(dyd_proof_block *b, uint32_t node) {
  const dyd_root *root = b->forms.node[node].root;
  mpz_t *f = coefficients_alloc(root->count);
  if (!f) return false;
  for (size_t k = 0; k < root->count; k++) {
    mpz_set(f[k], root->coeff[k]);
    if (mpz_sgn(root->coeff[root->count - 1]) < 0) mpz_neg(f[k], f[k]);
  }
  bool written = put_root(b, node, f, root->count);
  coefficients_free(f, root->count);
  return written;
}

/* ---- lines ---- */

const char *dyd_proof_op_text(unsigned op) {
  switch (op) {
  case DYD_OP_ADD:
    return "+";
  case DYD_OP_SUB:
    return "-";
  case DYD_OP_MUL:
    return "*";
  case DYD_OP_DIV:
    return "/";
  case DYD_OP_NEG:
    return "neg";
  case DYD_OP_POW:
    return "^";
  case DYD_OP_PI:
    return "pi";
  case DYD_FORM_CLAIM:
    return "claim";
  default:
    return op > DYD_OP_X && op <= DYD_OP_ABS && op != DYD_OP_ROOT ? dyd_op_name((dyd_op)op) : NULL;
  }
}

/* "= key", and the function of it. */
static void put_keyed_leaf(dyd_proof_block *b, dyd_op op, const dyd_fraction *key) {
  putc('=', b->out);
  put_quotient(b, key);
  fprintf(b->out, "\n%s %" PRIu32, dyd_proof_op_text(op), b->lines++);
}

static bool put_free_leaf(dyd_proof_block *b, const dyd_leaf *leaf) {
  bool opaque = leaf->node != DYD_NONE && b->forms.node[leaf->node].op == DYD_FORM_OPAQUE;
  if (opaque) {
    fputs("callback", b->out);
    b->line[leaf->node] = b->lines;
  } else if (leaf->op == DYD_OP_PI) {
    fputs("pi", b->out);
  } else if (leaf->op != DYD_OP_CONST) {
    put_keyed_leaf(b, leaf->op, &leaf->key);
  }
  return opaque || leaf->op != DYD_OP_CONST;
}

static bool put_leaf(dyd_proof_block *b, slong l) {
  const dyd_leaf *leaf = &b->ring.leaf[l];
  bool known = true;
  switch (leaf->kind) {
  case DYD_LEAF_SIN: /* comes with the cosine */
    return true;
  case DYD_LEAF_RADICAL:
    fputs("= ", b->out);
    put_integer(b->out, leaf->base);
    fprintf(b->out, "\n%s %" PRIu32, dyd_proof_op_text(leaf->op), b->lines++);
    break;
  case DYD_LEAF_NESTED:
    fputs("= ", b->out);
    put_polynomial(b, leaf->key.num);
    fprintf(b->out, "\n%s %" PRIu32, dyd_proof_op_text(leaf->op), b->lines++);
    break;
  case DYD_LEAF_CYCLE:
    fprintf(b->out, "cycle %lu", (unsigned long)b->ring.order);
    break;
  case DYD_LEAF_ROOT:
    known = put_root_leaf(b, l);
    break;
  case DYD_LEAF_COS:
    put_keyed_leaf(b, DYD_OP_COS, &leaf->key);
    break;
  default:
    known = put_free_leaf(b, leaf);
  }
  if (known) end_line(b);
  return known;
}

/* All leaves; a cycle of which everything used is rational is none, and follows. */
static bool put_leaves(dyd_proof_block *b) {
  bool known = true, cycle = false;
  for (slong l = 0; l < b->ring.leaves && known; l++) {
    cycle = cycle || b->ring.leaf[l].kind == DYD_LEAF_CYCLE;
    known = put_leaf(b, l);
  }
  if (!known || cycle || b->ring.order == 1) return known;
  fprintf(b->out, "cycle %lu", (unsigned long)b->ring.order);
  end_line(b);
  return true;
}

/* What is stated of a root is what the engine found it to be. */
static bool put_form(dyd_proof_block *b, uint32_t n) {
  const dyd_form f = b->forms.node[n];
  bool stated = f.op == DYD_OP_SQRT || f.op == DYD_OP_CBRT || f.op == DYD_FORM_ROOT;
  const dyd_fraction *x = stated ? dyd_ring_fraction(&b->ring, n) : NULL;
  if ((stated && !x) || f.op == DYD_FORM_OPAQUE) return false;
  if (f.op == DYD_FORM_ROOT) {
    if (!put_root_form(b, n)) return false;
  } else if (f.op == DYD_OP_CONST) {
    gmp_fprintf(b->out, "= %Qd", dyd_form_number(&b->forms, n));
  } else {
    fputs(dyd_proof_op_text(f.op), b->out);
    if (!dyd_op_is_leaf((dyd_op)f.op)) fprintf(b->out, " %" PRIu32, b->line[f.a]);
    if (dyd_op_is_binary((dyd_op)f.op)) fprintf(b->out, " %" PRIu32, b->line[f.b]);
    if (f.op == DYD_OP_POW) fprintf(b->out, " %" PRId32, f.exponent);
  }
  if (stated) put_quotient(b, x);
  b->line[n] = end_line(b);
  return true;
}

/* What points are made of: operands are lower. Others have no line; that of an opaque form is its leaf's. */
static bool put_forms(dyd_proof_block *b, size_t count) {
  bool *used = calloc(count ? count : 1, sizeof *used), known = used;
  for (size_t k = 0; k < b->sites && used; k++) used[b->at[k].x] = used[b->at[k].y] = true;
  for (size_t n = count; n-- > 0 && used;) {
    const dyd_form *f = &b->forms.node[n];
    if (!used[n] || dyd_form_is_leaf(f)) continue;
    used[f->a] = true;
    if (dyd_op_is_binary((dyd_op)f->op)) used[f->b] = true;
  }
  for (uint32_t n = 0; n < count && known; n++)
    if (used[n] && b->line[n] == DYD_NONE) known = put_form(b, n);
  free(used);
  return known;
}

bool dyd_proof_put_numbers(dyd_proof_block *b) {
  size_t count = b->forms.count;
  b->line = dyd_alloc(count, sizeof *b->line);
  if (!b->line) return false;
  memset(b->line, 0xff, count * sizeof *b->line);
  return put_leaves(b) && put_forms(b, count);
}
