/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Coordinates as text: finds the form of the points file that a text has, and the real it describes.
 *
 *   coordinate = number | sum | sum (+-|±) radius | [ lo , hi ]       root = root ( sum in x , lo , hi )
 *
 * lo, hi and radius are sums whose value is rational by form. random ( seed ) and slow ( sum ) are like roots. A root
 * may be part of a sum; a root alone is a real. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "base/random.h"
#include "stream/arb.h"
#include "stream/degrees.h"
#include "stream/expr.h"
#include "stream/expr_filter.h"
#include "stream/number.h"
#include "stream/real.h"
#include "stream/root.h"

#include <flint/fmpq_poly.h>
#include <flint/fmpz_vec.h>
#include <string.h>

/* ---- random, for experiments: binary digits of a number in [0,1], a function of seed and place, so that they are
 * drawn once ---- */

/* The interval of all numbers with these first digits: 2^-bits wide. */
static dyd_status random_narrow(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  const uint64_t seed = *(const uint64_t *)user;
  const size_t bits = request->bits > 0 ? (size_t)request->bits : 0, words = bits / 64 + 1;
  DYD_FREED uint64_t *digits = dyd_alloc(words, sizeof *digits);
  if (!digits) return dyd_fail_nomem(err);
  for (size_t k = 0; k < words; k++) digits[k] = dyd_random(seed, k + 1);
  DYD_LOCAL_NUMBERS(mpz, first);
  DYD_LOCAL(dyd_dyadic, lo, hi);
  mpz_import(first, words, 1, sizeof *digits, 0, 0, digits);
  mpz_tdiv_q_2exp(first, first, 64 * words - bits);
  dyd_status st = dyd_dyadic_set_z_2exp(&lo, first, -(int64_t)bits);
  mpz_add_ui(first, first, 1);
  if (st == DYD_OK) st = dyd_dyadic_set_z_2exp(&hi, first, -(int64_t)bits);
  if (st == DYD_OK) st = dyd_interval_set_ends(out, &lo, &hi);
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

/* The number in [0,1] whose binary digits `seed` draws. */
static dyd_status real_random(dyd_real **out, uint64_t seed) {
  void *user;
  dyd_status st = dyd_real_new_inside(out, &user, sizeof seed, random_narrow, NULL);
  if (st == DYD_OK) *(uint64_t *)user = dyd_random(seed, 0); /* neighbouring seeds begin far apart */
  return st;
}

/* ---- slow, for experiments: answer number n is about 1/n wide, whatever number of bits a request has ---- */

typedef struct slow_real {
  dyd_real *x;
  uint64_t answers;
} slow_real;

static void slow_release(void *user) {
  dyd_real_free(((slow_real *)user)->x);
}

/* Of x in [lo,hi], at most 1/(4 n) wide, [hi - r, lo + r] with r a little below 1/(2 n): it holds x, and is at most 1/n
 * wide. */
static dyd_status slow_narrow(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  slow_real *s = user;
  const uint64_t n = s->answers + 1;
  int64_t log2 = 0;
  while (log2 < 63 && (uint64_t)1 << log2 < n) log2++;
  dyd_status st = dyd_real_narrow_until(s->x, log2 + 2, request->max_bits, request->stop, err);
  if (dyd_narrow_ended(st)) return st;
  DYD_LOCAL_NUMBERS(mpq, lo, hi, r);
  dyd_interval_get_q(lo, hi, dyd_real_interval(s->x));
  mpz_setbit(mpq_numref(r), (mp_bitcnt_t)log2 + 7);
  mpz_sub_ui(mpq_numref(r), mpq_numref(r), 1);
  mpz_fdiv_q_ui(mpq_numref(r), mpq_numref(r), n);
  mpq_div_2exp(r, r, (mp_bitcnt_t)log2 + 8);
  mpq_sub(hi, hi, r);
  mpq_add(lo, lo, r);
  st = dyd_interval_set_outward(out, hi, lo, -log2 - 70);
  if (st != DYD_OK) return dyd_fail(err, st, "a slow value: %s", dyd_status_text(st));
  s->answers = n;
  return DYD_OK;
}

/* x, taken over also on failure, known to about 1/n by answer number n, whatever the request. */
static dyd_status real_slow(dyd_real **out, dyd_real *x) {
  void *user;
  dyd_status st = dyd_real_new_inside(out, &user, sizeof(slow_real), slow_narrow, slow_release);
  if (st == DYD_OK)
    *(slow_real *)user = (slow_real){x, 0};
  else
    dyd_real_free(x);
  return st;
}

/* Polynomials in x, from expressions. */

/* Coefficients, lowest degree first; a plain struct: init with {0}. */
typedef struct dyd_poly {
  mpq_t *coeff;
  size_t count;
} dyd_poly;

/* Expanding expressions in x to coefficients: the expression is run over the ring of polynomials.
 *
 * Degrees add and bits add up in products, so both are bounded before a product is formed. */

static void poly_clear(dyd_poly *p) {
  for (size_t k = 0; k < p->count; k++) mpq_clear(p->coeff[k]);
  free(p->coeff);
  *p = (dyd_poly){0};
}

typedef struct poly_stack {
  fmpq_poly_struct *value; /* a stack */
  size_t top, capacity;
} poly_stack;

static void poly_set_leaf(fmpq_poly_t out, const dyd_expr *e, const dyd_node *n) {
  if (n->op == DYD_OP_X) {
    fmpq_poly_zero(out);
    fmpq_poly_set_coeff_ui(out, 1, 1);
  } else {
    dyd_constant_view view;
    DYD_LOCAL_NUMBERS(fmpq, c);
    fmpq_set_mpq(c, dyd_constant_get(&view, &e->constant[n->argument]));
    fmpq_poly_set_fmpq(out, c);
  }
}

/* A bound of the bits of one coefficient. */
static size_t poly_height(const fmpq_poly_t p) {
  slong bits = FLINT_ABS(_fmpz_vec_max_bits(p->coeffs, p->length));
  return (size_t)bits + fmpz_bits(p->den) + 1;
}

static size_t poly_degree(const fmpq_poly_t p) {
  return p->length ? (size_t)p->length - 1 : 0;
}

/* Returns true if degree and size of a product of these stay within bounds. */
static bool poly_product_fits(size_t degree_a, size_t height_a, size_t degree_b, size_t height_b) {
  size_t d = degree_a + degree_b, h = height_a + height_b + 16;
  return d <= DYD_ROOT_DEGREE && h <= DYD_ROOT_WORK / (d + 1);
}

static dyd_status poly_too_large(dyd_error *err, const dyd_node *n) {
  if (err) err->column = n->column;
  return dyd_fail(err, DYD_E_RANGE, "the polynomial becomes too large here: degree at most %zu, %zu bits in all",
                  DYD_ROOT_DEGREE, DYD_ROOT_WORK);
}

static dyd_status no_polynomial(dyd_error *err, const dyd_node *n, const char *why) {
  if (err) err->column = n->column;
  return dyd_fail(err, DYD_E_PARSE, "'%s' does not give a polynomial with rational coefficients%s",
                  dyd_op_name((dyd_op)n->op), why);
}

static dyd_status poly_raise_power(fmpq_poly_t x, const dyd_node *n, dyd_error *err) {
  if (n->argument < 0) return no_polynomial(err, n, ": the exponent is negative");
  size_t k = (size_t)n->argument, d = poly_degree(x), h = poly_height(x);
  if (k > DYD_ROOT_DEGREE || (k && !poly_product_fits(d * k, h * k, 0, k))) return poly_too_large(err, n);
  fmpq_poly_pow(x, x, (ulong)k);
  return DYD_OK;
}

/* x = x op y. */
static dyd_status poly_combine(fmpq_poly_t x, const dyd_node *n, const fmpq_poly_t y, dyd_error *err) {
  size_t a = poly_degree(x), b = poly_degree(y);
  bool sum = n->op == DYD_OP_ADD || n->op == DYD_OP_SUB;
  if (!poly_product_fits(sum && b > a ? b : a, poly_height(x), sum ? 0 : b, poly_height(y)))
    return poly_too_large(err, n);
  switch (n->op) {
  case DYD_OP_ADD:
    fmpq_poly_add(x, x, y);
    return DYD_OK;
  case DYD_OP_SUB:
    fmpq_poly_sub(x, x, y);
    return DYD_OK;
  case DYD_OP_MUL:
    fmpq_poly_mul(x, x, y);
    return DYD_OK;
  case DYD_OP_DIV:
    if (y->length > 1) return no_polynomial(err, n, ": the divisor contains x");
    if (!y->length) return no_polynomial(err, n, ": the divisor is 0");
    fmpq_poly_div(x, x, y);
    return DYD_OK;
  default:
    return no_polynomial(err, n, "");
  }
}

static dyd_status poly_apply(poly_stack *r, const dyd_expr *e, const dyd_node *n, dyd_error *err) {
  if (n->op == DYD_OP_PI || n->op == DYD_OP_E) return no_polynomial(err, n, "");
  if (dyd_op_is_leaf((dyd_op)n->op)) {
    poly_set_leaf(&r->value[r->top++], e, n);
    return DYD_OK;
  }
  fmpq_poly_struct *x = &r->value[r->top - 1];
  if (dyd_op_is_binary((dyd_op)n->op)) {
    r->top--;
    return poly_combine(x - 1, n, x, err);
  }
  if (n->op == DYD_OP_POW) return poly_raise_power(x, n, err);
  if (n->op != DYD_OP_NEG) return no_polynomial(err, n, "");
  fmpq_poly_neg(x, x);
  return DYD_OK;
}

static dyd_status poly_copy_coefficients(dyd_poly *out, const fmpq_poly_t p, dyd_error *err) {
  out->coeff = dyd_alloc((size_t)p->length, sizeof *out->coeff);
  if (!out->coeff) return dyd_fail_nomem(err);
  DYD_LOCAL_NUMBERS(fmpq, c);
  for (out->count = 0; out->count < (size_t)p->length; out->count++) {
    fmpq_poly_get_coeff_fmpq(c, p, (slong)out->count);
    mpq_init(out->coeff[out->count]);
    fmpq_get_mpq(out->coeff[out->count], c);
  }
  return DYD_OK;
}

/* The number of values held at once is at most the number of leaves. */
static bool poly_stack_init(poly_stack *r, const dyd_expr *e) {
  r->top = r->capacity = 0;
  for (size_t i = 0; i < e->count; i++) r->capacity += dyd_op_is_leaf((dyd_op)e->node[i].op);
  r->value = dyd_alloc(r->capacity, sizeof *r->value);
  if (!r->value) return false;
  for (size_t i = 0; i < r->capacity; i++) fmpq_poly_init(&r->value[i]);
  return true;
}

static void poly_stack_clear(poly_stack *r) {
  for (size_t i = 0; i < r->capacity; i++) fmpq_poly_clear(&r->value[i]);
  free(r->value);
}

/* Expands an expression in x. *out is empty before. DYD_E_PARSE when it is not a polynomial with rational
 * coefficients, DYD_E_RANGE when it is too large; with column. */
static dyd_status poly_expand(dyd_poly *out, const dyd_expr *e, dyd_error *err) {
  poly_stack r;
  dyd_status st = DYD_OK;
  if (!poly_stack_init(&r, e)) return dyd_fail_nomem(err);
  for (size_t i = 0; i < e->count && st == DYD_OK; i++) st = poly_apply(&r, e, &e->node[i], err);
  if (st == DYD_OK) st = poly_copy_coefficients(out, &r.value[0], err);
  poly_stack_clear(&r);
  return st;
}

typedef struct expr_reader {
  const char *text;
  size_t length, pos;
  dyd_error *err;
} expr_reader;

#define FAIL(r, at, code, ...) dyd_text_fail((r)->err, (code), (r)->text, (at), __VA_ARGS__)

/* A constructor without error record failed. */
static dyd_status plain_fail(expr_reader *r, size_t at, dyd_status st) {
  return st != DYD_OK ? FAIL(r, at, st, "%s", dyd_status_text(st)) : st;
}

static void skip_blanks(expr_reader *r) {
  while (r->pos < r->length && dyd_is_blank(r->text[r->pos])) r->pos++;
}

/* Returns true if the literal text `word` is next. Moves behind it. */
static bool take_word(expr_reader *r, const char *word) {
  size_t n = strlen(word);
  skip_blanks(r);
  if (r->length - r->pos < n || memcmp(r->text + r->pos, word, n)) return false;
  r->pos += n;
  return true;
}

/* ---- expressions as reals ---- */

/* A value finite in doubles is defined; undecided ones are probed. */
static dyd_status real_from_draft(dyd_real **out, expr_reader *r, size_t at, dyd_draft *d) {
  const dyd_constant *rational = dyd_expr_rational(&d->e);
  dyd_constant_view view;
  dyd_double_span span;
  if (rational) return plain_fail(r, at, dyd_real_from_q(out, dyd_constant_get(&view, rational)));
  bool spans = dyd_filter_expr(&span, &d->e);
  dyd_status st = spans ? DYD_OK : dyd_expr_probe(&d->e, r->err);
  if (st != DYD_OK) return st;
  st = dyd_real_new_expr(out, d);
  if (st != DYD_OK) return plain_fail(r, at, st);
  if (spans) dyd_real_set_span(*out, span);
  return DYD_OK;
}

/* ---- rational parts ---- */

/* An expression that must be rational; what names it in messages. */
static dyd_status read_rational(mpq_t out, expr_reader *r, const char *what) {
  dyd_constant_view view;
  skip_blanks(r);
  size_t at = r->pos;
  DYD_LOCAL(dyd_draft, d);
  dyd_status st = dyd_expr_parse(&d, &r->pos, r->text, r->length, (dyd_expr_names){0}, r->err);
  const dyd_constant *q = st != DYD_OK ? NULL : dyd_expr_rational(&d.e);
  if (st == DYD_OK && !q) st = FAIL(r, at, DYD_E_PARSE, "%s must be rational: numbers and + - * / ^ only", what);
  if (st == DYD_OK) mpq_set(out, dyd_constant_get(&view, q));
  return st;
}

/* "lo , hi" up to the closing bracket. */
static dyd_status read_interval_ends(mpq_t lo, mpq_t hi, expr_reader *r, const char *close) {
  dyd_status st = read_rational(lo, r, "the lower end");
  if (st == DYD_OK && !take_word(r, ","))
    st = FAIL(r, r->pos, DYD_E_PARSE, "a ',' is missing between the ends of the interval");
  if (st == DYD_OK) st = read_rational(hi, r, "the upper end");
  if (st == DYD_OK && !take_word(r, close)) st = FAIL(r, r->pos, DYD_E_PARSE, "a '%s' is missing here", close);
  return st;
}

static dyd_status read_interval(dyd_real **out, expr_reader *r) {
  size_t at = r->pos;
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_status st = read_interval_ends(lo, hi, r, "]");
  if (st == DYD_OK && mpq_cmp(lo, hi) > 0) {
    st = FAIL(r, at, DYD_E_PARSE, "the lower end of the interval is above the upper end; exchange them");
  }
  return st == DYD_OK ? plain_fail(r, at, dyd_real_from_interval(out, lo, hi)) : st;
}

/* ---- roots ---- */

static dyd_status read_polynomial(dyd_poly *out, expr_reader *r) {
  DYD_LOCAL(dyd_draft, d);
  dyd_status st = dyd_expr_parse(&d, &r->pos, r->text, r->length, (dyd_expr_names){.x = true}, r->err);
  if (st == DYD_OK) st = poly_expand(out, &d.e, r->err);
  if (st == DYD_OK && !take_word(r, ",")) st = FAIL(r, r->pos, DYD_E_PARSE, "a ',' is missing after the polynomial");
  return st;
}

/* Behind "root(". */
static dyd_status read_root(dyd_real **out, expr_reader *r) {
  dyd_poly p = {0};
  size_t at = r->pos;
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_status st = read_polynomial(&p, r);
  if (st == DYD_OK) {
    skip_blanks(r);
    if (p.count) at = r->pos;
    st = read_interval_ends(lo, hi, r, ")");
  }
  if (st == DYD_OK) {
    st = dyd_real_root(out, (const mpq_t *)p.coeff, p.count, lo, hi, r->err);
    if (st != DYD_OK && r->err) r->err->column = dyd_text_column(r->text, at);
    if (st == DYD_E_ARG) st = DYD_E_PARSE;
    if (st != DYD_OK && r->err) r->err->code = st;
  }
  poly_clear(&p);
  return st;
}

/* Behind "random(". */
static dyd_status read_random(dyd_real **out, expr_reader *r) {
  size_t at = r->pos;
  DYD_LOCAL_NUMBERS(mpq, seed);
  dyd_status st = read_rational(seed, r, "the seed");
  if (st == DYD_OK && (mpz_cmp_ui(mpq_denref(seed), 1) != 0 || !mpz_fits_ulong_p(mpq_numref(seed))))
    st = FAIL(r, at, DYD_E_PARSE, "the seed is a whole number from 0 on, below 2^64");
  if (st == DYD_OK && !take_word(r, ")")) st = FAIL(r, r->pos, DYD_E_PARSE, "a ')' is missing here");
  return st == DYD_OK ? plain_fail(r, at, real_random(out, mpz_get_ui(mpq_numref(seed)))) : st;
}

/* A sum that may have parts which `within` reads. */
static dyd_status read_sum(dyd_real **out, expr_reader *r, dyd_root_reader *within) {
  size_t at = r->pos;
  DYD_LOCAL(dyd_draft, d);
  dyd_status st = dyd_expr_parse(&d, &r->pos, r->text, r->length, (dyd_expr_names){.root = within}, r->err);
  return st == DYD_OK ? real_from_draft(out, r, at, &d) : st;
}

static dyd_status read_within_slow(dyd_real **out, dyd_real_word word, size_t *pos, const char *text, size_t length,
                                   dyd_error *err) {
  expr_reader r = {.text = text, .length = length, .pos = *pos, .err = err};
  if (word == DYD_WORD_SLOW) return FAIL(&r, *pos, DYD_E_PARSE, "slow cannot stand within slow");
  dyd_status st = word == DYD_WORD_ROOT ? read_root(out, &r) : read_random(out, &r);
  *pos = r.pos;
  return st;
}

/* Behind "slow(". */
static dyd_status read_slow(dyd_real **out, expr_reader *r) {
  dyd_real *x = NULL;
  size_t at = r->pos;
  dyd_status st = read_sum(&x, r, read_within_slow);
  if (st == DYD_OK && !take_word(r, ")")) {
    dyd_real_free(x);
    return FAIL(r, r->pos, DYD_E_PARSE, "a ')' is missing here");
  }
  return st == DYD_OK ? plain_fail(r, at, real_slow(out, x)) : st;
}

static dyd_status read_root_of(dyd_real **out, dyd_real_word word, expr_reader *r) {
  return word == DYD_WORD_ROOT ? read_root(out, r) : word == DYD_WORD_RANDOM ? read_random(out, r) : read_slow(out, r);
}

static dyd_status read_root_within(dyd_real **out, dyd_real_word word, size_t *pos, const char *text, size_t length,
                                   dyd_error *err) {
  expr_reader r = {.text = text, .length = length, .pos = *pos, .err = err};
  dyd_status st = read_root_of(out, word, &r);
  *pos = r.pos;
  return st;
}

/* Returns the word if it is "root(..)" alone, or with a radius, else DYD_WORDS. Moves behind "root(" then. */
static dyd_real_word starts_root(expr_reader *r) {
  size_t start = r->pos, end;
  unsigned word = 0;
  while (word < DYD_WORDS && !take_word(r, dyd_real_words[word])) word++;
  if (word < DYD_WORDS && take_word(r, "(")) {
    int depth = 1;
    for (end = r->pos; end < r->length && depth; end++) depth += (r->text[end] == '(') - (r->text[end] == ')');
    while (end < r->length && dyd_is_blank(r->text[end])) end++;
    if (end == r->length || depth || !memchr("+-*/^", r->text[end], 5)) return (dyd_real_word)word;
    if (r->length - end > 1 && memcmp(r->text + end, "+-", 2) == 0) return (dyd_real_word)word;
  }
  r->pos = start;
  return DYD_WORDS;
}

/* ---- the whole coordinate ---- */

/* Behind "+-". Widens *x, which is released on failure. */
static dyd_status read_real_radius(dyd_real **x, expr_reader *r) {
  size_t at = r->pos;
  DYD_LOCAL_NUMBERS(mpq, radius);
  dyd_status st = read_rational(radius, r, "the radius");
  if (st == DYD_OK && mpq_sgn(radius) < 0)
    st = FAIL(r, at, DYD_E_PARSE, "the radius is negative; give one that is 0 or more");
  if (st != DYD_OK) {
    dyd_real_free(*x);
  } else {
    st = plain_fail(r, at, dyd_real_widen(x, *x, radius));
  }
  return st;
}

static dyd_status trailing_fail(expr_reader *r) {
  char c = r->text[r->pos];
  bool operand = c == '(' || c == '.' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return dyd_text_unexpected(r->err, r->text, r->length, r->pos,
                             operand ? " behind a number; between factors write *" : " in a number");
}

/* *out is set on success only. */
static dyd_status read_real_coordinate(dyd_real **out, expr_reader *r) {
  dyd_real *x = NULL;
  dyd_status st;
  if (take_word(r, "[")) {
    st = read_interval(&x, r);
  } else {
    const dyd_real_word word = starts_root(r);
    st = word < DYD_WORDS ? read_root_of(&x, word, r) : read_sum(&x, r, read_root_within);
    if (st == DYD_OK && (take_word(r, "+-") || take_word(r, "\xC2\xB1"))) st = read_real_radius(&x, r);
  }
  if (st != DYD_OK) return st;
  skip_blanks(r);
  if (r->pos < r->length) {
    dyd_real_free(x);
    return trailing_fail(r);
  }
  *out = x;
  return DYD_OK;
}

static dyd_status read_plain_number(dyd_real **out, expr_reader *r) {
  DYD_LOCAL_NUMBERS(mpq, q);
  dyd_status st = dyd_parse_number(q, r->text, r->length, DYD_NUMBER_ANY, r->err);
  return st == DYD_OK ? plain_fail(r, 0, dyd_real_from_q(out, q)) : st;
}

/* DYD_E_ARG: it is of another form. */
static dyd_status read_degrees(dyd_real **out, expr_reader *r) {
  char letter;
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_status st = dyd_degrees_read(lo, hi, &letter, r->text, r->length, false, r->err);
  return st == DYD_OK ? plain_fail(r, 0, dyd_real_from_q(out, lo)) : st;
}

dyd_status dyd_real_parse(dyd_real **out, const char *text, size_t length, dyd_error *err) {
  expr_reader r = {.text = text, .length = length, .err = err};
  if (!text && length) return dyd_fail(err, DYD_E_ARG, "no text was given");
  if (dyd_is_plain_number(text, length)) return read_plain_number(out, &r);
  dyd_status st = read_degrees(out, &r);
  return st == DYD_E_ARG ? read_real_coordinate(out, &r) : st;
}

dyd_status dyd_interval_set_text(dyd_interval *out, const char *text, size_t length, dyd_error *err) {
  DYD_OWNED(dyd_real) *x = NULL;
  dyd_status st = dyd_real_parse(&x, text, length, err);
  if (st != DYD_OK) return st;
  if (dyd_real_is_final(x))
    dyd_interval_set(out, dyd_real_interval(x));
  else
    st = dyd_text_fail(err, DYD_E_PARSE, text, 0, "this has to be refined to be known; give a number or an interval");
  return st;
}

dyd_status dyd_real_parse_exact(mpq_t out, const char *text, size_t length) {
  DYD_LOCAL(dyd_interval, a);
  dyd_status st = dyd_interval_set_text(&a, text, length, NULL);
  if (st == DYD_OK && !dyd_interval_is_point(&a)) st = DYD_E_PARSE;
  if (st == DYD_OK) dyd_interval_get_q(out, out, &a);
  return st;
}
