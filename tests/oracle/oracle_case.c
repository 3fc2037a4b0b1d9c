/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cases of the tests: containers and exact text. */
#include "oracle/oracle_case.h"
#include <string.h>

void orc_case_init(orc_case *c) {
  c->n = 0;
  c->kind[0] = 0;
  for (size_t i = 0; i < ORC_MAX; i++)
    for (size_t k = 0; k < 4; k++) mpq_init(c->rect[i].e[k]);
}

void orc_case_clear(orc_case *c) {
  for (size_t i = 0; i < ORC_MAX; i++)
    for (size_t k = 0; k < 4; k++) mpq_clear(c->rect[i].e[k]);
}

static void rect_set(orc_rect *out, const orc_rect *r) {
  for (size_t k = 0; k < 4; k++) mpq_set(out->e[k], r->e[k]);
}

void orc_case_set(orc_case *out, const orc_case *c) {
  out->n = c->n;
  memcpy(out->kind, c->kind, sizeof out->kind);
  for (size_t i = 0; i < c->n; i++) rect_set(&out->rect[i], &c->rect[i]);
}

void orc_case_add_rect(orc_case *c, const orc_rect *r) {
  if (c->n < ORC_MAX) rect_set(&c->rect[c->n++], r);
}

void orc_case_add(orc_case *c, long x0, long x1, long y0, long y1, unsigned long den) {
  if (c->n == ORC_MAX) return;
  long end[4] = {x0, x1, y0, y1};
  for (size_t k = 0; k < 4; k++) {
    mpq_set_si(c->rect[c->n].e[k], end[k], den);
    mpq_canonicalize(c->rect[c->n].e[k]);
  }
  c->n++;
}

void orc_case_drop(orc_case *c, size_t i) {
  for (size_t k = i; k + 1 < c->n; k++) rect_set(&c->rect[k], &c->rect[k + 1]);
  c->n--;
}

void orc_case_permute(orc_case *out, const orc_case *in, const size_t *order, size_t n) {
  memcpy(out->kind, in->kind, sizeof out->kind);
  out->n = n;
  for (size_t k = 0; k < n; k++) rect_set(&out->rect[k], &in->rect[order[k]]);
}

static void mirror(orc_rect *r, size_t axis) {
  mpq_neg(r->e[2 * axis], r->e[2 * axis]);
  mpq_neg(r->e[2 * axis + 1], r->e[2 * axis + 1]);
  mpq_swap(r->e[2 * axis], r->e[2 * axis + 1]);
}

void orc_case_turn(orc_case *c, unsigned symmetry) {
  for (size_t i = 0; i < c->n; i++) {
    orc_rect *r = &c->rect[i];
    if (symmetry & 1) {
      mpq_swap(r->e[0], r->e[2]);
      mpq_swap(r->e[1], r->e[3]);
    }
    if (symmetry & 2) mirror(r, 0);
    if (symmetry & 4) mirror(r, 1);
  }
}

void orc_case_scale(orc_case *c, long e) {
  for (size_t i = 0; i < c->n; i++)
    for (size_t k = 0; k < 4; k++) {
      mpq_ptr x = c->rect[i].e[k];
      if (e >= 0) mpq_mul_2exp(x, x, (mp_bitcnt_t)e);
      if (e < 0) mpq_div_2exp(x, x, (mp_bitcnt_t)-e);
    }
}

bool orc_rect_is_point(const orc_rect *r) {
  return mpq_equal(r->e[0], r->e[1]) && mpq_equal(r->e[2], r->e[3]);
}

bool orc_rect_equal(const orc_rect *r, const orc_rect *s) {
  for (size_t k = 0; k < 4; k++)
    if (!mpq_equal(r->e[k], s->e[k])) return false;
  return true;
}

bool orc_rect_meets(const orc_rect *r, const orc_rect *s) {
  return mpq_cmp(r->e[0], s->e[1]) <= 0 && mpq_cmp(s->e[0], r->e[1]) <= 0 && mpq_cmp(r->e[2], s->e[3]) <= 0 &&
         mpq_cmp(s->e[2], r->e[3]) <= 0;
}

bool orc_case_all_points(const orc_case *c) {
  for (size_t i = 0; i < c->n; i++)
    if (!orc_rect_is_point(&c->rect[i])) return false;
  return true;
}

size_t orc_case_alias(const orc_case *c, size_t i) {
  if (!orc_rect_is_point(&c->rect[i])) return i;
  for (size_t k = 0; k < i; k++)
    if (orc_rect_equal(&c->rect[k], &c->rect[i])) return k;
  return i;
}

/* n, n/d, or m*2^e where that is shorter. */
static void print_end(FILE *f, mpq_srcptr x) {
  mpz_srcptr n = mpq_numref(x), d = mpq_denref(x);
  mp_bitcnt_t up = mpz_sgn(n) ? mpz_scan1(n, 0) : 0, down = mpz_scan1(d, 0);
  bool dyadic = mpz_popcount(d) == 1;
  if (!dyadic || (up < 40 && down == 0)) {
    mpq_out_str(f, 10, x);
    return;
  }
  mpz_t m;
  mpz_init(m);
  mpz_fdiv_q_2exp(m, n, up);
  mpz_out_str(f, 10, m);
  fprintf(f, "*2^%ld", down ? -(long)down : (long)up);
  mpz_clear(m);
}

static void print_side(FILE *f, mpq_srcptr lo, mpq_srcptr hi) {
  if (mpq_equal(lo, hi)) {
    print_end(f, lo);
    return;
  }
  fputc('[', f);
  print_end(f, lo);
  fputc(',', f);
  print_end(f, hi);
  fputc(']', f);
}

void orc_case_print(FILE *f, const orc_case *c) {
  fprintf(f, "# %zu sites, kind %s\n", c->n, c->kind);
  for (size_t i = 0; i < c->n; i++) {
    print_side(f, c->rect[i].e[0], c->rect[i].e[1]);
    fputc(' ', f);
    print_side(f, c->rect[i].e[2], c->rect[i].e[3]);
    fprintf(f, "   # %zu\n", i);
  }
}
