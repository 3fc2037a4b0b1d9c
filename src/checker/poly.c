/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Polynomials with integer coefficients in numbered leaves: sums, products, reduction, reading. */
#include "checker/poly.h"

#include "base/alloc.h"
#include "base/invariant.h"

#include <string.h>

void dyd_cert_poly_clear(dyd_cert_poly *p) {
  for (size_t t = 0; t < p->count; t++) mpz_clear(p->term[t].c);
  free(p->term);
  *p = (dyd_cert_poly){0};
}

static int terms_compare(const uint16_t *a, const uint16_t *b) {
  for (size_t k = DYD_CERT_LEAVES; k-- > 0;)
    if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
  return 0;
}

/* Memory for `count` terms, of a polynomial or of two. */
static dyd_cert_term *terms_alloc(size_t count, dyd_cert_relations *r) {
  DYD_INVARIANT(count <= 2 * DYD_CERT_TERMS);
  dyd_cert_term *term = dyd_alloc(count, sizeof *term);
  r->nomem = r->nomem || !term;
  return term;
}

/* Counts the terms of q and their limbs, besides `more`; false: it is too much. */
static bool count_terms_of(dyd_cert_relations *r, const dyd_cert_poly *q, size_t more) {
  for (size_t t = 0; t < q->count; t++) more += 1 + mpz_size(q->term[t].c);
  return dyd_cert_count_work(r, more);
}

bool dyd_cert_poly_set(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r) {
  DYD_INVARIANT(p != q);
  if (!count_terms_of(r, q, 0)) return false;
  dyd_cert_term *term = terms_alloc(q->count, r);
  if (!term) return false;
  dyd_cert_poly_clear(p);
  p->term = term;
  for (; p->count < q->count; p->count++) {
    mpz_init_set(term[p->count].c, q->term[p->count].c);
    memcpy(term[p->count].e, q->term[p->count].e, sizeof term->e);
  }
  return true;
}

/* p = z leaf^e. */
static bool poly_set_term(dyd_cert_poly *p, mpz_srcptr z, size_t leaf, uint16_t e, dyd_cert_relations *r) {
  dyd_cert_term *term = terms_alloc(1, r);
  if (!term) return false;
  memset(term->e, 0, sizeof term->e);
  term->e[leaf] = e;
  mpz_init_set(term->c, z);
  dyd_cert_poly_clear(p);
  p->term = term;
  p->count = 1;
  if (!mpz_sgn(term->c)) dyd_cert_poly_clear(p);
  return true;
}

bool dyd_cert_poly_set_z(dyd_cert_poly *p, mpz_srcptr z, dyd_cert_relations *r) {
  return poly_set_term(p, z, 0, 0, r);
}

bool dyd_cert_poly_set_leaf(dyd_cert_poly *p, size_t leaf, dyd_cert_relations *r) {
  mpz_t one;
  mpz_init_set_ui(one, 1);
  bool fits = poly_set_term(p, one, leaf, 1, r);
  mpz_clear(one);
  return fits;
}

/* ---- sums ---- */

/* out = c m t; its number is initialised. false: an exponent or the number is too large. */
static bool term_scale(dyd_cert_term *out, const dyd_cert_term *t, mpz_srcptr c, const uint16_t *m) {
  bool fits = true;
  mpz_init(out->c);
  mpz_mul(out->c, t->c, c);
  for (size_t k = 0; k < DYD_CERT_LEAVES; k++) {
    out->e[k] = (uint16_t)(t->e[k] + (m ? m[k] : 0));
    fits = fits && out->e[k] <= 2 * DYD_CERT_EXPONENT;
  }
  return fits && mpz_sizeinbase(out->c, 2) <= DYD_CERT_BITS;
}

/* Merges: terms of p move, those of q are made. */
static bool terms_merge(dyd_cert_poly *sum, dyd_cert_poly *p, const dyd_cert_poly *q, mpz_srcptr c, const uint16_t *m) {
  size_t i = 0, j = 0, n = 0;
  bool fits = true, made = false;
  dyd_cert_term *to = sum->term, next;
  while (i < p->count || j < q->count || made) {
    if (!made && j < q->count) {
      fits = term_scale(&next, &q->term[j++], c, m) && fits;
      made = true;
    }
    int order = !made ? 1 : i == p->count ? -1 : terms_compare(p->term[i].e, next.e);
    if (order < 0) {
      to[n++] = next;
      made = false;
    } else if (order > 0) {
      to[n++] = p->term[i++];
    } else {
      mpz_add(next.c, next.c, p->term[i].c);
      mpz_clear(p->term[i++].c);
      if (mpz_sgn(next.c)) {
        to[n++] = next;
      } else {
        mpz_clear(next.c);
      }
      made = false;
    }
  }
  sum->count = n;
  return fits && n <= DYD_CERT_TERMS;
}

bool dyd_cert_poly_add_scaled(dyd_cert_poly *p, const dyd_cert_poly *q, mpz_srcptr c, const uint16_t *m,
                              dyd_cert_relations *r) {
  dyd_cert_poly sum = {0};
  DYD_INVARIANT(p != q);
  if (!mpz_sgn(c) || !q->count) return true;
  if (!count_terms_of(r, q, p->count + q->count * mpz_size(c))) return false;
  sum.term = terms_alloc(p->count + q->count, r);
  bool fits = sum.term && terms_merge(&sum, p, q, c, m);
  if (sum.term) {
    free(p->term);
    *p = sum;
  }
  return fits;
}

bool dyd_cert_poly_add(dyd_cert_poly *p, const dyd_cert_poly *q, int sign, dyd_cert_relations *r) {
  mpz_t one;
  mpz_init_set_si(one, sign);
  bool fits = dyd_cert_poly_add_scaled(p, q, one, NULL, r);
  mpz_clear(one);
  return fits;
}

/* ---- products ---- */

/* Takes the terms with the greatest power, at least `degree`, of leaf k out of p, divided by leaf^degree. */
static bool terms_take_power(dyd_cert_poly *out, dyd_cert_poly *p, size_t k, unsigned degree, dyd_cert_relations *r) {
  uint16_t most = 0;
  size_t kept = 0;
  for (size_t t = 0; t < p->count; t++)
    if (p->term[t].e[k] > most) most = p->term[t].e[k];
  if (most < degree) return true;
  out->term = terms_alloc(p->count, r);
  if (!out->term) return false;
  for (size_t t = 0; t < p->count; t++) {
    if (p->term[t].e[k] != most) {
      p->term[kept++] = p->term[t];
      continue;
    }
    out->term[out->count] = p->term[t];
    out->term[out->count++].e[k] = (uint16_t)(most - degree);
  }
  p->count = kept;
  return true;
}

/* Rests are reduced, and of lower powers: the power of leaf k sinks with every pass. */
static bool reduce_leaf(dyd_cert_poly *p, size_t k, dyd_cert_relations *r) {
  const dyd_cert_relation *leaf = &r->leaf[k];
  bool fits = true, more = leaf->degree > 0;
  while (fits && more) {
    dyd_cert_poly high = {0};
    fits = terms_take_power(&high, p, k, leaf->degree, r);
    more = high.count > 0;
    for (size_t t = 0; t < high.count && fits; t++)
      fits = dyd_cert_poly_add_scaled(p, &leaf->rest, high.term[t].c, high.term[t].e, r);
    dyd_cert_poly_clear(&high);
  }
  return fits;
}

bool dyd_cert_poly_reduce(dyd_cert_poly *p, dyd_cert_relations *r) {
  bool fits = true;
  for (size_t k = r->count; k-- > 0 && fits;) fits = reduce_leaf(p, k, r);
  for (size_t t = 0; t < p->count && fits; t++)
    for (size_t k = 0; k < r->count && fits; k++) fits = p->term[t].e[k] <= DYD_CERT_EXPONENT;
  return fits;
}

bool dyd_cert_poly_mul(dyd_cert_poly *p, const dyd_cert_poly *q, dyd_cert_relations *r) {
  dyd_cert_poly product = {0};
  bool fits = true;
  if (p->count > q->count) { /* the shorter one is gone through */
    for (size_t t = 0; t < q->count && fits; t++)
      fits = dyd_cert_poly_add_scaled(&product, p, q->term[t].c, q->term[t].e, r);
  } else {
    for (size_t t = 0; t < p->count && fits; t++)
      fits = dyd_cert_poly_add_scaled(&product, q, p->term[t].c, p->term[t].e, r);
  }
  fits = fits && dyd_cert_poly_reduce(&product, r);
  dyd_cert_poly_clear(p);
  *p = product;
  return fits;
}

/* ---- questions ---- */

bool dyd_cert_poly_equal(const dyd_cert_poly *p, const dyd_cert_poly *q) {
  if (p->count != q->count) return false;
  for (size_t t = 0; t < p->count; t++)
    if (mpz_cmp(p->term[t].c, q->term[t].c) || terms_compare(p->term[t].e, q->term[t].e)) return false;
  return true;
}

mpz_srcptr dyd_cert_poly_integer(const dyd_cert_poly *p) {
  static const uint16_t none[DYD_CERT_LEAVES] = {0};
  return p->count == 1 && !terms_compare(p->term->e, none) ? p->term->c : NULL;
}

void dyd_cert_poly_content(mpz_ptr g, const dyd_cert_poly *p) {
  for (size_t t = 0; t < p->count && mpz_cmp_ui(g, 1); t++) mpz_gcd(g, g, p->term[t].c);
}

void dyd_cert_poly_divide(dyd_cert_poly *p, mpz_srcptr z) {
  for (size_t t = 0; t < p->count; t++) mpz_divexact(p->term[t].c, p->term[t].c, z);
}

/* ---- reading ---- */

/* A number without sign and leading zeros, 1 .. most; 0: there is none. */
static unsigned scan_unsigned(const char **text, unsigned most) {
  unsigned n = 0;
  if (**text == '0') return 0;
  for (; **text >= '0' && **text <= '9'; ++*text) {
    n = 10 * n + (unsigned)(**text - '0');
    if (n > most) return 0;
  }
  return n;
}

/* x3 or x3^2, leaves in ascending order, each once. */
static bool scan_power(dyd_cert_term *t, const char **text, const dyd_cert_relations *r) {
  unsigned leaf = 0, e = 1;
  if (*(*text)++ != 'x') return false;
  if (**text == '0')
    ++*text;
  else if (!(leaf = scan_unsigned(text, DYD_CERT_LEAVES - 1)))
    return false;
  if (**text == '^') {
    ++*text;
    e = scan_unsigned(text, DYD_CERT_EXPONENT);
    if (e < 2) return false;
  }
  if (leaf >= r->count) return false;
  for (size_t k = leaf; k < DYD_CERT_LEAVES; k++)
    if (t->e[k]) return false;
  t->e[leaf] = (uint16_t)e;
  return true;
}

/* The number of a term: 1 is left out before leaves. */
static bool scan_coefficient(mpz_ptr c, const char **text, dyd_cert_relations *r) {
  size_t length = strspn(*text, "0123456789");
  mpz_set_ui(c, 1);
  if (!length) return **text == 'x';
  if (**text == '0' || length > DYD_CERT_BITS / 4) return false;
  char *digits = dyd_alloc(length + 1, 1);
  r->nomem = r->nomem || !digits;
  if (!digits) return false;
  memcpy(digits, *text, length);
  digits[length] = 0;
  mpz_set_str(c, digits, 10);
  free(digits);
  *text += length;
  return **text != 'x' && (**text != '*' || mpz_cmp_ui(c, 1));
}

/* A term without its sign; its number is initialised. */
static bool scan_term(dyd_cert_term *t, const char **text, dyd_cert_relations *r) {
  memset(t->e, 0, sizeof t->e);
  bool good = scan_coefficient(t->c, text, r);
  if (good && **text == 'x') good = scan_power(t, text, r);
  while (good && **text == '*') {
    ++*text;
    good = scan_power(t, text, r);
  }
  return good;
}

static size_t count_terms(const char *text) {
  size_t n = 1;
  for (const char *c = text + 1; *text && *c; c++) n += *c == '+' || *c == '-';
  return n;
}

bool dyd_cert_poly_scan(dyd_cert_poly *p, const char **end, const char *text, dyd_cert_relations *r) {
  bool good = true;
  dyd_cert_poly_clear(p);
  *end = text + 1;
  if (*text == '0') return true;
  if (count_terms(text) > DYD_CERT_TERMS || !(p->term = terms_alloc(count_terms(text), r))) return false;
  do {
    dyd_cert_term *t = &p->term[p->count];
    bool minus = *text == '-';
    if (minus || p->count) text++;
    mpz_init(t->c);
    p->count++;
    good = scan_term(t, &text, r);
    if (minus) mpz_neg(t->c, t->c);
    if (good && p->count > 1) good = terms_compare(t[-1].e, t->e) > 0;
  } while (good && (*text == '+' || *text == '-'));
  *end = text;
  return good;
}
