/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What points are, and what of it proves ties and aliases [CERT-10], in blocks.
 *
 * The checker reads a block before it is written; facts that it rejects are not written. That points are the same is
 * about them as they were given; for other facts exact points are numbers. All facts of one of these two kinds share a
 * block; where that is too much for the checker, each has its own. */
#include "engine/ties.h"
#include "base/alloc.h"
#include "base/local.h"
#include "checker/parts.h"
#include "prove/proof.h"
#include "stream/algebra/ring.h"
#include "stream/algebra/zero.h"
#include "stream/ball.h"

#include <inttypes.h>
#include <string.h>

/* Numbers in the form that the checker of certificates reads. */

/* Bits to which the bracket of a root is narrowed at most. */
#define DYD_PROOF_BRACKET ((slong)4096)

/* A block while it is written. given: points are described as they were given. line[n]: of form n, DYD_NONE: none yet;
 * lines: their count. Invariant: site is ascending, at[k] belongs to site[k]. */
typedef struct dyd_proof_block {
  const dyd_proof *proof;
  dyd_forms forms;
  dyd_ring ring;
  FILE *out;
  uint32_t *site, *line, lines;
  dyd_form_point *at;
  size_t sites;
  bool given;
} dyd_proof_block;

/* Writes numbers for the checker: the leaves of the engine's algebra first, in its order, so that they have the same
 * numbers, then the parts of all coordinates. */

/* ---- text ---- */

static void put_integer(FILE *out, const fmpz_t z) {
  char *text = fmpz_get_str(NULL, 10, z);
  fputs(text, out);
  flint_free(text);
}

/* The powers of a term, later leaves last; first: nothing precedes. */
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
  DYD_LOCAL_NUMBERS(fmpz, c);
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
  DYD_LOCAL_NUMBERS(arb, x);
  DYD_LOCAL_NUMBERS(fmpz, man, exp);
  arb_set(x, dyd_forms_value(&b->forms, node, prec));
  for (int k = 0; k < 2; k++) {
    DYD_LOCAL_NUMBERS(arf, end);
    (k ? arb_get_ubound_arf : arb_get_lbound_arf)(end, x, prec + 64);
    arf_get_fmpz_2exp(man, exp, end);
    fmpz_get_mpz(r->end[2 * k], man);
    mpz_set_ui(r->end[2 * k + 1], 1);
    mpz_ptr shifted = r->end[2 * k + (fmpz_sgn(exp) < 0)];
    if (fmpz_cmp_si(exp, 1 << 20) < 0 && fmpz_cmp_si(exp, -(1 << 20)) > 0)
      mpz_mul_2exp(shifted, shifted, (mp_bitcnt_t)FLINT_ABS(fmpz_get_si(exp)));
  }
}

static void put_end(FILE *out, mpz_t *end) {
  putc(' ', out);
  mpz_out_str(out, 10, end[0]);
  if (!mpz_cmp_ui(end[1], 1)) return;
  putc('/', out);
  mpz_out_str(out, 10, end[1]);
}

/* Writes "root" with the polynomial f, or minus it, the greatest coefficient positive, that vanishes at the form.
 * false: no bracket is seen to hold one root. */
static bool put_root(dyd_proof_block *b, uint32_t node, const fmpz_poly_t f) {
  const size_t count = (size_t)fmpz_poly_length(f);
  dyd_cert_bracket r = {.coeff = dyd_alloc(count, sizeof *r.coeff), .count = count};
  bool single = false;
  if (!r.coeff) return false;
  for (size_t k = 0; k < count; k++) {
    mpz_init(r.coeff[k]);
    fmpz_get_mpz(r.coeff[k], fmpz_poly_get_coeff_ptr(f, (slong)k));
    if (fmpz_sgn(fmpz_poly_lead(f)) < 0) mpz_neg(r.coeff[k], r.coeff[k]);
  }
  mpz_inits(r.end[0], r.end[1], r.end[2], r.end[3], NULL);
  for (slong prec = 32; prec <= DYD_PROOF_BRACKET && !single; prec *= 2) {
    bracket_from_value(&r, b, node, prec);
    single = dyd_cert_root_is_single(&r);
  }
  if (single) {
    fputs("root", b->out);
    put_end(b->out, &r.end[0]);
    put_end(b->out, &r.end[2]);
  }
  for (size_t k = 0; k < count; k++) {
    if (single) putc(k ? ',' : ' ', b->out);
    if (single) mpz_out_str(b->out, 10, r.coeff[k]);
    mpz_clear(r.coeff[k]);
  }
  free(r.coeff);
  mpz_clears(r.end[0], r.end[1], r.end[2], r.end[3], NULL);
  return single;
}

/* From the relation t^n + ..., t = a x: the coefficient of t^e is f_e a^(n - 1 - e). */
static bool put_root_leaf(dyd_proof_block *b, slong l) {
  const dyd_leaf *leaf = &b->ring.leaf[l];
  ulong exponent[DYD_RING_LEAVES];
  DYD_LOCAL_NUMBERS(fmpz_poly, f);
  DYD_LOCAL_NUMBERS(fmpz, power);
  fmpz_poly_set_coeff_fmpz(f, leaf->degree, leaf->base);
  for (slong t = 0; t < leaf->relation->length; t++) {
    fmpz_mpoly_get_term_exp_ui(exponent, leaf->relation, t, b->ring.ctx);
    slong e = (slong)exponent[dyd_ring_var(&b->ring, l)];
    if (e == leaf->degree) continue;
    fmpz_pow_ui(power, leaf->base, (ulong)(leaf->degree - 1 - e));
    fmpz_divexact(power, leaf->relation->coeffs + t, power);
    fmpz_poly_set_coeff_fmpz(f, e, power);
  }
  return put_root(b, leaf->node, f);
}

/* The checker's name of an operation on forms; NULL: it has none. */
/* ---- lines ---- */
static const char *proof_op_text(unsigned op) {
  if (op == DYD_OP_NEG) return "neg";
  if (op == DYD_FORM_CLAIM) return "claim";
  return op > DYD_OP_ABS || op == DYD_OP_CONST || op == DYD_OP_X || op == DYD_OP_ROOT ? NULL : dyd_op_name((dyd_op)op);
}

/* "= key", and the function of it. */
static void put_keyed_leaf(dyd_proof_block *b, dyd_op op, const dyd_fraction *key) {
  putc('=', b->out);
  put_quotient(b, key);
  fprintf(b->out, "\n%s %" PRIu32, proof_op_text(op), b->lines++);
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
    fprintf(b->out, "\n%s %" PRIu32, proof_op_text(leaf->op), b->lines++);
    break;
  case DYD_LEAF_NESTED:
    fputs("= ", b->out);
    put_polynomial(b, leaf->key.num);
    fprintf(b->out, "\n%s %" PRIu32, proof_op_text(leaf->op), b->lines++);
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

/* A root is stated to be the fraction that the engine found. */
static bool put_form(dyd_proof_block *b, uint32_t n) {
  const dyd_form f = b->forms.node[n];
  bool stated = f.op == DYD_OP_SQRT || f.op == DYD_OP_CBRT || f.op == DYD_FORM_ROOT;
  const dyd_fraction *x = stated ? dyd_ring_fraction(&b->ring, n) : NULL;
  if ((stated && !x) || f.op == DYD_FORM_OPAQUE) return false;
  if (f.op == DYD_FORM_ROOT) {
    if (!put_root(b, n, b->forms.node[n].root->poly)) return false;
  } else if (f.op == DYD_OP_CONST) {
    gmp_fprintf(b->out, "= %Qd", dyd_form_number(&b->forms, n));
  } else {
    fputs(proof_op_text(f.op), b->out);
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

/* Lines of all leaves and of what points are made of. Forms made from now on belong to no point. false: of something
 * the checker has no form, or memory is exhausted. */
static bool proof_put_numbers(dyd_proof_block *b) {
  size_t count = b->forms.count;
  b->line = dyd_alloc(count, sizeof *b->line);
  if (!b->line) return false;
  memset(b->line, 0xff, count * sizeof *b->line);
  return put_leaves(b) && put_forms(b, count);
}

/* Checks that points are as a certificate describes them, number by number, as they are made of others. */

/* line[n]: the number that form n is; form[k]: the form that number k, from a callback, is. */
typedef struct comparison {
  dyd_forms forms;
  const dyd_cert_algebra *numbers;
  uint32_t *line, *form;
  size_t cap;
} comparison;

/* The polynomials are the same up to the sign, and the root is in the bracket, which holds one. */
static bool is_same_root(comparison *c, uint32_t n, const dyd_cert_bracket *r) {
  const fmpz_poly_struct *f = c->forms.node[n].root->poly;
  if (!r || (size_t)f->length != r->count) return false;
  bool inside = true;
  DYD_LOCAL_NUMBERS(fmpz, given);
  for (size_t k = 0; k < r->count; k++) {
    fmpz_set_mpz(given, r->coeff[k]);
    if (fmpz_sgn(fmpz_poly_lead(f)) < 0) fmpz_neg(given, given);
    inside = inside && fmpz_equal(given, f->coeffs + k);
  }
  if (!inside) return false;
  inside = false;
  DYD_LOCAL_NUMBERS(arb, x, end);
  DYD_LOCAL_NUMBERS(mpq, q);
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
  const char *name = proof_op_text(f.op);
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
  if (!DYD_GROW(c->line, c->cap, c->forms.count)) return false;
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
  dyd_free_all(c.line, c.form);
  return st;
}

dyd_status dyd_proof_compare_points(bool *found, size_t *others, const dyd_cert_ties *t, const dyd_engine *e) {
  dyd_status st = DYD_OK;
  *others = 0;
  for (size_t k = 0; k < t->blocks && st == DYD_OK; k++) st = compare_points(found, others, t->block[k], e);
  return st;
}

#define _POSIX_C_SOURCE 200809L /* open_memstream, fmemopen */

/* Sites of one block at most. */
enum { BLOCK_SITES = 1 << 13 };

/* A fact of the engine; member is borrowed. */
typedef struct fact {
  dyd_relation relation;
  const uint32_t *member;
  size_t count;
} fact;

/* ---- blocks ---- */

static void block_clear(dyd_proof_block *b) {
  dyd_ring_clear(&b->ring);
  dyd_forms_clear(&b->forms);
  dyd_free_all(b->site, b->line, b->at);
}

/* The sites of the facts, each once. */
static dyd_status block_gather(dyd_proof_block *b, const fact *list, size_t count) {
  size_t n = 0;
  for (size_t q = 0; q < count; q++) n += list[q].count;
  if (!DYD_NEW(b->site, n) || !DYD_NEW(b->at, n)) return DYD_E_NOMEM;
  for (size_t q = 0; q < count; q++)
    for (size_t k = 0; k < list[q].count; k++) b->site[b->sites++] = list[q].member[k];
  b->sites = dyd_cert_distinct(b->site, b->sites);
  return DYD_OK;
}

/* *known: all sites are described, and their leaves settled. */
static dyd_status block_describe(bool *known, dyd_proof_block *b) {
  dyd_status st = DYD_OK;
  *known = b->sites <= BLOCK_SITES;
  for (size_t k = 0; k < b->sites && st == DYD_OK && *known; k++) {
    st = dyd_ties_describe(&b->at[k], &b->forms, b->proof->engine, b->site[k], b->given);
    *known = b->at[k].x != DYD_NONE && b->at[k].y != DYD_NONE;
  }
  if (st == DYD_OK && *known) st = dyd_ring_settle(&b->ring, &b->at->x, 2 * b->sites);
  *known = *known && !b->ring.stale;
  return b->forms.failed || b->ring.failed ? DYD_E_NOMEM : st;
}

/* Lines of numbers and points. */
static bool block_put(dyd_proof_block *b) {
  if (!proof_put_numbers(b)) return false;
  fprintf(b->out, "points %zu\n", b->sites);
  for (size_t k = 0; k < b->sites; k++)
    fprintf(b->out, "%" PRIu32 " %" PRIu32 " %" PRIu32 "\n", b->site[k], b->line[b->at[k].x], b->line[b->at[k].y]);
  return true;
}

/* *text: the lines, owned by the caller; NULL: there are none. */
static dyd_status block_text(char **text, size_t *size, uint32_t *lines, const dyd_proof *p, const fact *list,
                             size_t count) {
  dyd_proof_block b = {.proof = p, .given = list->relation == DYD_COINCIDENT};
  bool known = false;
  *text = NULL;
  b.out = open_memstream(text, size);
  if (!b.out) return DYD_E_NOMEM;
  dyd_forms_init(&b.forms);
  dyd_status st = dyd_ring_init(&b.ring, &b.forms);
  if (st == DYD_OK) st = block_gather(&b, list, count);
  if (st == DYD_OK) st = block_describe(&known, &b);
  known = st == DYD_OK && known && block_put(&b);
  *lines = b.lines;
  block_clear(&b);
  if (fclose(b.out) && st == DYD_OK) st = DYD_E_NOMEM;
  if (st == DYD_OK && known) return DYD_OK;
  free(*text);
  *text = NULL;
  return st;
}

/* The block as the checker sees it, without facts; *taken: it takes it. */
static dyd_status block_check(bool *taken, dyd_cert_ties *t, const char *text, size_t size, uint32_t lines,
                              const dyd_proof *p) {
  DYD_FREED char *whole = dyd_alloc(size + 64, 1);
  dyd_error err;
  *taken = false;
  if (!whole) return DYD_E_NOMEM;
  size_t length = (size_t)snprintf(whole, 64, "algebra %" PRIu32 "\n", lines);
  memcpy(whole + length, text, size);
  length += size;
  length += (size_t)snprintf(whole + length, 16, "facts 0\n");
  dyd_cert_reader in = {.in = fmemopen(whole, length, "r"), .err = &err};
  dyd_error_clear(&err);
  dyd_status st = in.in ? dyd_cert_next_line(&in) : DYD_E_NOMEM;
  if (st == DYD_OK) st = dyd_cert_ties_read(t, &in, &p->sites);
  *taken = st == DYD_OK;
  dyd_cert_reader_clear(&in);
  if (in.in) fclose(in.in);
  return st == DYD_E_NOMEM ? st : DYD_OK;
}

/* ---- facts ---- */

/* The base points first: the ends of a line, three points far apart of a circle. */
static void base_first(uint32_t *to, const fact *f) {
  size_t base[3] = {0, f->relation == DYD_COCIRCULAR ? f->count / 3 : f->count - 1, 2 * f->count / 3};
  size_t n = f->relation == DYD_COCIRCULAR ? 3 : 2, at = n;
  for (size_t k = 0; k < f->count; k++) {
    size_t q = 0;
    while (q < n && base[q] != k) q++;
    to[q < n ? q : at++] = f->member[k];
  }
}

static dyd_status put_fact(bool *written, FILE *out, dyd_cert_ties *t, const fact *f) {
  static const char *const name[] = {[DYD_COINCIDENT] = "same", [DYD_COLLINEAR] = "line", [DYD_COCIRCULAR] = "circle"};
  static const dyd_cert_relation_kind kind[] = {
      [DYD_COINCIDENT] = DYD_CERT_SAME, [DYD_COLLINEAR] = DYD_CERT_LINE, [DYD_COCIRCULAR] = DYD_CERT_CIRCLE};
  dyd_cert_block *b = t->block[t->blocks - 1];
  DYD_FREED uint32_t *site = dyd_alloc(f->count, sizeof *site);
  if (!site) return DYD_E_NOMEM;
  base_first(site, f);
  bool identity = dyd_cert_fact_holds(b, kind[f->relation], site, f->count, false);
  *written = identity || dyd_cert_fact_holds(b, kind[f->relation], site, f->count, true);
  if (*written) {
    fputs(name[f->relation], out);
    for (size_t k = 0; k < f->count; k++) fprintf(out, " %" PRIu32, site[k]);
    fputs(identity ? " identity\n" : " bound\n", out);
  }
  return b->algebra.relations.nomem ? DYD_E_NOMEM : DYD_OK;
}

/* *text: the lines of the facts that the checker takes, *count of them. */
static dyd_status facts_text(char **text, size_t *taken, dyd_cert_ties *t, const fact *list, size_t count) {
  size_t size;
  FILE *out = open_memstream(text, &size);
  dyd_status st = out ? DYD_OK : DYD_E_NOMEM;
  *taken = 0;
  for (size_t q = 0; q < count && st == DYD_OK; q++) {
    bool written = false;
    st = put_fact(&written, out, t, &list[q]);
    *taken += written;
  }
  if (out && fclose(out) && st == DYD_OK) st = DYD_E_NOMEM;
  return st;
}

/* Writes one block for these facts; *taken: how many of them it has. *work: that of the blocks written. */
static dyd_status put_block(FILE *out, size_t *taken, uint64_t *work, const dyd_proof *p, const fact *list,
                            size_t count) {
  DYD_SCOPED(dyd_cert_ties) t = {.work = *work};
  DYD_FREED char *text = NULL, *facts = NULL;
  size_t size;
  uint32_t lines;
  bool good = false;
  *taken = 0;
  dyd_status st = block_text(&text, &size, &lines, p, list, count);
  if (st == DYD_OK && text) st = block_check(&good, &t, text, size, lines, p);
  if (st == DYD_OK && good) st = facts_text(&facts, taken, &t, list, count);
  if (st == DYD_OK && *taken) fprintf(out, "algebra %" PRIu32 "\n%sfacts %zu\n%s", lines, text, *taken, facts);
  if (*taken) *work = t.block[0]->algebra.relations.work;
  return st;
}

/* Of points that are sites of their own, or the same site now. */
static bool fact_counts(const dyd_proof *p, const fact *f) {
  const dyd_cert_site *s = p->sites.site;
  if (f->relation == DYD_COINCIDENT) return s[f->member[0]].alias == s[f->member[1]].alias;
  for (size_t k = 0; k < f->count; k++)
    if (s[f->member[k]].alias != f->member[k]) return false;
  return true;
}

/* The facts about the same place, or the others. */
static dyd_status facts_gather(fact **list, size_t *count, const dyd_proof *p, bool same) {
  fact f;
  size_t cap = 0;
  for (size_t k = 0; dyd_ties_proved(&f.relation, &f.member, &f.count, p->engine, k); k++) {
    if ((f.relation == DYD_COINCIDENT) != same || !fact_counts(p, &f)) continue;
    if (!dyd_reserve((void **)list, &cap, *count + 1, sizeof **list)) return DYD_E_NOMEM;
    (*list)[(*count)++] = f;
  }
  return DYD_OK;
}

static dyd_status put_facts(FILE *out, uint64_t *work, const dyd_proof *p, bool same) {
  DYD_FREED fact *list = NULL;
  size_t count = 0, taken = 0;
  dyd_status st = facts_gather(&list, &count, p, same);
  if (st == DYD_OK && count) st = put_block(out, &taken, work, p, list, count);
  for (size_t q = 0; q < count && st == DYD_OK && !taken && count > 1; q++) {
    size_t one;
    st = put_block(out, &one, work, p, &list[q], 1);
  }
  return st;
}

dyd_status dyd_proof_put_ties(FILE *out, const dyd_proof *p) {
  uint64_t work = 0;
  dyd_status st = put_facts(out, &work, p, true);
  return st == DYD_OK ? put_facts(out, &work, p, false) : st;
}
