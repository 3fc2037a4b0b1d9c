/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading the numbers of a certificate, line by line. */
#include "base/alloc.h"
#include "base/error.h"
#include "checker/algebra.h"

#include <string.h>

static dyd_status read_operand(uint32_t *out, const dyd_cert_algebra *a, dyd_cert_reader *in) {
  if (!a->count) return dyd_cert_reject(in, "there is no number before");
  return dyd_cert_read_index(out, in, a->count - 1);
}

/* V: P or P/Q, Q not 0 at the true leaves. */
static dyd_status read_value(dyd_cert_quotient *out, dyd_cert_algebra *a, dyd_cert_reader *in) {
  char *word = NULL;
  const char *end = NULL;
  mpz_t one;
  dyd_status st = dyd_cert_word(&word, in);
  if (st != DYD_OK) return st;
  mpz_init_set_ui(one, 1);
  bool good = dyd_cert_poly_scan(&out->num, &end, word, &a->relations);
  if (good && *end == '/')
    good = dyd_cert_poly_scan(&out->den, &end, end + 1, &a->relations) &&
           !(dyd_cert_poly_integer(&out->den) && mpz_cmp_ui(dyd_cert_poly_integer(&out->den), 1) <= 0);
  else if (good)
    good = dyd_cert_poly_set_z(&out->den, one, &a->relations);
  good = good && *end == 0 && dyd_cert_poly_reduce(&out->num, &a->relations) &&
         dyd_cert_poly_reduce(&out->den, &a->relations);
  mpz_clear(one);
  if (!good) return dyd_cert_reject(in, "\"%.40s\" is no quotient of polynomials in leaves before", word);
  if (!dyd_cert_poly_sign(a, &out->den)) return dyd_cert_reject(in, "a denominator is not seen not to be 0");
  return DYD_OK;
}

/* A fraction m or m/d, d > 1. */
static bool scan_fraction(mpz_ptr num, mpz_ptr den, char *text) {
  char *slash = strchr(text, '/');
  mpz_t g;
  if (slash) *slash++ = 0;
  mpz_set_ui(den, 1);
  if (!dyd_cert_scan_integer(num, text) || (slash && !dyd_cert_scan_integer(den, slash))) return false;
  if (slash && mpz_cmp_ui(den, 1) <= 0) return false;
  mpz_init(g);
  mpz_gcd(g, num, den);
  bool lowest = mpz_cmp_ui(g, 1) == 0;
  mpz_clear(g);
  return lowest;
}

/* c0,c1,...,cn with cn > 0, n >= 1. */
static bool scan_coefficients(dyd_cert_bracket *r, char *text, dyd_cert_relations *relations) {
  size_t count = 1;
  bool good = true;
  for (const char *c = text; *c; c++) count += *c == ',';
  if (count < 2 || count > DYD_CERT_DEGREE + 1) return false;
  r->coeff = dyd_alloc(count, sizeof *r->coeff);
  relations->nomem = !r->coeff;
  if (!r->coeff) return false;
  for (char *next; r->count < count; text = next) {
    next = strchr(text, ',');
    if (next) *next++ = 0;
    mpz_init(r->coeff[r->count]);
    good = dyd_cert_scan_integer(r->coeff[r->count++], text) && good;
  }
  return good && mpz_sgn(r->coeff[count - 1]) > 0;
}

static dyd_status read_bracket(dyd_cert_bracket **out, dyd_cert_relations *relations, dyd_cert_reader *in) {
  dyd_cert_bracket *r = dyd_alloc(1, sizeof *r);
  if (!r) return dyd_fail_nomem(in->err);
  *r = (dyd_cert_bracket){0};
  mpz_inits(r->end[0], r->end[1], r->end[2], r->end[3], NULL);
  *out = r;
  char *word = NULL;
  dyd_status st = DYD_OK;
  for (int k = 0; k < 3 && st == DYD_OK; k++) {
    st = dyd_cert_word(&word, in);
    if (st != DYD_OK) break;
    if (!(k < 2 ? scan_fraction(r->end[2 * k], r->end[2 * k + 1], word) : scan_coefficients(r, word, relations)))
      st = dyd_cert_reject(in, "\"%.40s\" is no end of a bracket, or no polynomial", word);
  }
  if (st == DYD_OK && !dyd_cert_root_is_single(r))
    st = dyd_cert_reject(in, "the bracket is not seen to hold one root of the polynomial");
  return st;
}

static dyd_status read_op(dyd_cert_op *op, dyd_cert_reader *in) {
  char *word = NULL;
  int k = 0;
  dyd_status st = dyd_cert_word(&word, in);
  if (st != DYD_OK) return st;
  while (k < DYD_CERT_OPS && strcmp(word, dyd_cert_op_name((dyd_cert_op)k))) k++;
  *op = (dyd_cert_op)k;
  return k < DYD_CERT_OPS ? DYD_OK : dyd_cert_reject(in, "\"%.40s\" is no operation", word);
}

static dyd_status read_exponent(long *out, dyd_cert_reader *in) {
  long long value = 0;
  dyd_status st = dyd_cert_read_integer(&value, in);
  if (st != DYD_OK) return st;
  if (value > DYD_CERT_EXPONENT || value < -DYD_CERT_EXPONENT) return dyd_cert_reject(in, "%lld is too large", value);
  *out = (long)value;
  return DYD_OK;
}

/* Everything of the line but V. */
static dyd_status read_operation(dyd_cert_number *n, dyd_cert_algebra *a, dyd_cert_reader *in) {
  dyd_status st = read_op(&n->op, in);
  if (st == DYD_OK && dyd_cert_op_operands(n->op) > 0) st = read_operand(&n->a, a, in);
  if (st == DYD_OK && dyd_cert_op_operands(n->op) > 1) st = read_operand(&n->b, a, in);
  if (st == DYD_OK && (n->op == DYD_CERT_POW || n->op == DYD_CERT_CYCLE)) st = read_exponent(&n->exponent, in);
  if (st == DYD_OK && n->op == DYD_CERT_ROOT) st = read_bracket(&n->root, &a->relations, in);
  return st;
}

/* May a line state what the number is? */
static bool has_value(const dyd_cert_number *n, const dyd_cert_reader *in) {
  bool may = n->op == DYD_CERT_SQRT || n->op == DYD_CERT_CBRT || n->op == DYD_CERT_ROOT;
  return n->op == DYD_CERT_VALUE || (may && dyd_cert_line_has_more(in));
}

static dyd_status read_number(dyd_cert_number *n, dyd_cert_algebra *a, dyd_cert_reader *in) {
  dyd_status st = read_operation(n, a, in);
  if (st == DYD_OK && has_value(n, in)) {
    st = read_value(&n->value, a, in);
    if (st == DYD_OK && n->op != DYD_CERT_VALUE && !dyd_cert_number_check(n, a))
      st = dyd_cert_reject(in, "the number is not seen to be what the line says");
  } else if (st == DYD_OK && !dyd_cert_number_value(n, a)) {
    st = dyd_cert_reject(in, "the number is not seen to be defined, or beyond the limits");
  }
  if (a->relations.nomem) return dyd_fail_nomem(in->err);
  return st == DYD_OK ? dyd_cert_line_done(in) : st;
}

/* The number is in its place while it is read, since leaves may be made of it. */
dyd_status dyd_cert_algebra_read(dyd_cert_algebra *a, dyd_cert_reader *in) {
  if (!dyd_reserve((void **)&a->number, &a->cap, a->count + 1, sizeof *a->number)) return dyd_fail_nomem(in->err);
  dyd_cert_number *n = &a->number[a->count];
  *n = (dyd_cert_number){.p = 0};
  dyd_cert_enclosure_init(&n->now);
  dyd_status st = read_number(n, a, in);
  if (st == DYD_OK)
    a->count++;
  else
    dyd_cert_number_clear(n);
  return st;
}
