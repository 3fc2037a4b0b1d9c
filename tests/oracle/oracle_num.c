/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rationals in a pool, and exact signs of a + b sqrt(c) by squaring. */
#include "oracle/oracle_num.h"
#include <stdio.h>
#include <stdlib.h>

#define BLOCK 512

void orc_fatal(const char *message) {
  fprintf(stderr, "oracle: %s\n", message);
  abort();
}

void orc_pool_init(orc_pool *p) {
  *p = (orc_pool){0};
}

void orc_pool_clear(orc_pool *p) {
  for (size_t b = 0; b < p->blocks; b++) {
    for (size_t k = 0; k < BLOCK; k++) mpq_clear(p->block[b][k]);
    free(p->block[b]);
  }
  free(p->block);
  *p = (orc_pool){0};
}

size_t orc_mark(const orc_pool *p) {
  return p->used;
}

void orc_release(orc_pool *p, size_t mark) {
  p->used = mark;
}

static void grow(orc_pool *p) {
  p->block = realloc(p->block, (p->blocks + 1) * sizeof *p->block);
  if (!p->block) orc_fatal("memory exhausted");
  mpq_t *fresh = malloc(BLOCK * sizeof *fresh);
  if (!fresh) orc_fatal("memory exhausted");
  for (size_t k = 0; k < BLOCK; k++) mpq_init(fresh[k]);
  p->block[p->blocks++] = fresh;
}

mpq_ptr orc_new(orc_pool *p) {
  if (p->used == p->blocks * BLOCK) grow(p);
  mpq_ptr x = p->block[p->used / BLOCK][p->used % BLOCK];
  p->used++;
  return x;
}

mpq_srcptr orc_si(orc_pool *p, long num, unsigned long den) {
  mpq_ptr r = orc_new(p);
  mpq_set_si(r, num, den);
  mpq_canonicalize(r);
  return r;
}

mpq_srcptr orc_add(orc_pool *p, mpq_srcptr x, mpq_srcptr y) {
  mpq_ptr r = orc_new(p);
  mpq_add(r, x, y);
  return r;
}

mpq_srcptr orc_sub(orc_pool *p, mpq_srcptr x, mpq_srcptr y) {
  mpq_ptr r = orc_new(p);
  mpq_sub(r, x, y);
  return r;
}

mpq_srcptr orc_mul(orc_pool *p, mpq_srcptr x, mpq_srcptr y) {
  mpq_ptr r = orc_new(p);
  mpq_mul(r, x, y);
  return r;
}

mpq_srcptr orc_div(orc_pool *p, mpq_srcptr x, mpq_srcptr y) {
  mpq_ptr r = orc_new(p);
  mpq_div(r, x, y);
  return r;
}

mpq_srcptr orc_sqr(orc_pool *p, mpq_srcptr x) {
  return orc_mul(p, x, x);
}

mpq_srcptr orc_neg(orc_pool *p, mpq_srcptr x) {
  mpq_ptr r = orc_new(p);
  mpq_neg(r, x);
  return r;
}

mpq_srcptr orc_twice(orc_pool *p, mpq_srcptr x) {
  mpq_ptr r = orc_new(p);
  mpq_mul_2exp(r, x, 1);
  return r;
}

mpq_srcptr orc_mid(orc_pool *p, mpq_srcptr x, mpq_srcptr y) {
  mpq_ptr r = orc_new(p);
  mpq_add(r, x, y);
  mpq_div_2exp(r, r, 1);
  return r;
}

orc_alg orc_alg_q(orc_pool *p, mpq_srcptr a) {
  mpq_srcptr zero = orc_si(p, 0, 1);
  return (orc_alg){a, zero, zero};
}

/* The radicand of a result; a rational operand takes that of the other. */
static mpq_srcptr common(orc_alg x, orc_alg y) {
  if (mpq_sgn(x.b) == 0) return y.c;
  if (mpq_sgn(y.b) != 0 && x.c != y.c && !mpq_equal(x.c, y.c)) orc_fatal("different radicands");
  return x.c;
}

orc_alg orc_alg_add(orc_pool *p, orc_alg x, orc_alg y) {
  return (orc_alg){orc_add(p, x.a, y.a), orc_add(p, x.b, y.b), common(x, y)};
}

orc_alg orc_alg_sub(orc_pool *p, orc_alg x, orc_alg y) {
  return (orc_alg){orc_sub(p, x.a, y.a), orc_sub(p, x.b, y.b), common(x, y)};
}

orc_alg orc_alg_sub_q(orc_pool *p, orc_alg x, mpq_srcptr y) {
  return (orc_alg){orc_sub(p, x.a, y), x.b, x.c};
}

orc_alg orc_alg_sqr(orc_pool *p, orc_alg x) {
  if (mpq_sgn(x.b) == 0) return (orc_alg){orc_sqr(p, x.a), x.b, x.c};
  mpq_srcptr a = orc_add(p, orc_sqr(p, x.a), orc_mul(p, orc_sqr(p, x.b), x.c));
  return (orc_alg){a, orc_twice(p, orc_mul(p, x.a, x.b)), x.c};
}

orc_alg orc_alg_affine(orc_pool *p, orc_alg x, mpq_srcptr m, mpq_srcptr y) {
  return (orc_alg){orc_add(p, orc_mul(p, x.a, m), y), orc_mul(p, x.b, m), x.c};
}

/* If a and b have opposite signs, a^2 against b^2 c decides. */
int orc_alg_sgn(orc_pool *p, orc_alg x) {
  int sa = mpq_sgn(x.a), sb = mpq_sgn(x.c) ? mpq_sgn(x.b) : 0;
  if (sb == 0 || sa == sb) return sa;
  if (sa == 0) return sb;
  int bigger = mpq_cmp(orc_sqr(p, x.a), orc_mul(p, orc_sqr(p, x.b), x.c));
  return sa * ((bigger > 0) - (bigger < 0));
}

int orc_alg_cmp_q(orc_pool *p, orc_alg x, mpq_srcptr y) {
  return orc_alg_sgn(p, orc_alg_sub_q(p, x, y));
}

/* Sign of u - v with u = x - y.a in the field of x and v = y.b sqrt(y.c): by the signs of u and v, then by
 * u^2 - v^2, which is again in the field of x. */
int orc_alg_cmp(orc_pool *p, orc_alg x, orc_alg y) {
  orc_alg u = orc_alg_sub_q(p, x, y.a);
  int su = orc_alg_sgn(p, u), sv = mpq_sgn(y.c) ? mpq_sgn(y.b) : 0;
  if (sv == 0) return su;
  if (su == 0) return -sv;
  if (su != sv) return su;
  mpq_srcptr v2 = orc_mul(p, orc_sqr(p, y.b), y.c);
  return su * orc_alg_sgn(p, orc_alg_sub_q(p, orc_alg_sqr(p, u), v2));
}

mpq_srcptr orc_alg_near(orc_pool *p, orc_alg x, size_t bits) {
  if (mpq_sgn(x.b) == 0 || mpq_sgn(x.c) == 0) return x.a;
  /* sqrt(n/d) = sqrt(n d) / d */
  mpz_t s;
  mpz_init(s);
  mpz_mul(s, mpq_numref(x.c), mpq_denref(x.c));
  mpz_mul_2exp(s, s, 2 * bits);
  mpz_sqrt(s, s);
  mpq_ptr root = orc_new(p);
  mpq_set_z(root, s);
  mpz_clear(s);
  mpq_div_2exp(root, root, bits);
  mpq_ptr den = orc_new(p);
  mpq_set_z(den, mpq_denref(x.c));
  mpq_div(root, root, den);
  return orc_add(p, x.a, orc_mul(p, x.b, root));
}

mpq_srcptr orc_alg_between(orc_pool *p, orc_alg x, orc_alg y) {
  if (orc_alg_cmp(p, x, y) >= 0) orc_fatal("no number between");
  for (size_t bits = 8; bits < (size_t)1 << 30; bits *= 2) {
    mpq_srcptr m = orc_mid(p, orc_alg_near(p, x, bits), orc_alg_near(p, y, bits));
    if (orc_alg_cmp_q(p, x, m) < 0 && orc_alg_cmp_q(p, y, m) > 0) return m;
  }
  orc_fatal("no number between");
  return NULL;
}
