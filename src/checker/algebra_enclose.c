/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Enclosures of numbers and of polynomials in leaves, and their signs. */
#include "checker/algebra.h"

static void enclose_cosine(dyd_cert_enclosure *x, dyd_cert_op op, long p) {
  dyd_cert_enclosure c, s;
  dyd_cert_enclosure_init(&c);
  dyd_cert_enclosure_init(&s);
  dyd_cert_enclosure_cos_sin(&c, &s, x, p);
  if (op == DYD_CERT_TAN) dyd_cert_enclosure_div(&s, &c, p);
  dyd_cert_enclosure_set(x, op == DYD_CERT_COS ? &c : &s);
  dyd_cert_enclosure_clear(&s);
  dyd_cert_enclosure_clear(&c);
}

/* From y = exp(x), z = 1 / y: (y - z) / 2, (y + z) / 2, (y - z) / (y + z). */
static void enclose_hyperbolic(dyd_cert_enclosure *x, dyd_cert_op op, long p) {
  dyd_cert_enclosure y, z;
  dyd_cert_enclosure_init(&y);
  dyd_cert_enclosure_init(&z);
  dyd_cert_enclosure_exp(x, p);
  dyd_cert_enclosure_set(&y, x);
  dyd_cert_enclosure_set(&z, x);
  dyd_cert_enclosure_pow(&z, -1, p);
  (op == DYD_CERT_COSH ? dyd_cert_enclosure_add : dyd_cert_enclosure_sub)(x, &z);
  dyd_cert_enclosure_add(&y, &z);
  if (op == DYD_CERT_TANH) {
    dyd_cert_enclosure_div(x, &y, p);
  } else {
    mpz_fdiv_q_2exp(x->lo, x->lo, 1);
    mpz_cdiv_q_2exp(x->hi, x->hi, 1);
  }
  dyd_cert_enclosure_clear(&z);
  dyd_cert_enclosure_clear(&y);
}

/* 2 cos(2 pi / n). */
static void enclose_cycle(dyd_cert_enclosure *x, long n, long p) {
  dyd_cert_enclosure_pi(x, p);
  mpz_mul_2exp(x->lo, x->lo, 1);
  mpz_mul_2exp(x->hi, x->hi, 1);
  mpz_fdiv_q_ui(x->lo, x->lo, (unsigned long)n);
  mpz_cdiv_q_ui(x->hi, x->hi, (unsigned long)n);
  enclose_cosine(x, DYD_CERT_COS, p);
  dyd_cert_enclosure_add(x, x);
}

static void enclose_e(dyd_cert_enclosure *x, long p) {
  mpz_set_ui(x->lo, 1);
  mpz_mul_2exp(x->lo, x->lo, (mp_bitcnt_t)p);
  mpz_set(x->hi, x->lo);
  x->known = true;
  dyd_cert_enclosure_exp(x, p);
}

static void enclose_inverse(dyd_cert_enclosure *x, dyd_cert_op op, long p) {
  switch (op) {
  case DYD_CERT_LOG:
    dyd_cert_enclosure_log(x, p);
    return;
  case DYD_CERT_ASIN:
    dyd_cert_enclosure_asin(x, p);
    return;
  case DYD_CERT_ACOS:
    dyd_cert_enclosure_acos(x, p);
    return;
  case DYD_CERT_ATAN:
    dyd_cert_enclosure_atan(x, p);
    return;
  default:
    x->known = false;
  }
}

/* x = op x. */
static void enclose_function(dyd_cert_enclosure *x, const dyd_cert_number *n, long p) {
  switch (n->op) {
  case DYD_CERT_POW:
    dyd_cert_enclosure_pow(x, n->exponent, p);
    return;
  case DYD_CERT_NEG:
    dyd_cert_enclosure_neg(x);
    return;
  case DYD_CERT_CLAIM:
    return;
  case DYD_CERT_ABS:
    dyd_cert_enclosure_abs(x);
    return;
  case DYD_CERT_SQRT:
  case DYD_CERT_CBRT:
    dyd_cert_enclosure_root(x, n->op == DYD_CERT_SQRT ? 2 : 3, p);
    return;
  case DYD_CERT_COS:
  case DYD_CERT_SIN:
  case DYD_CERT_TAN:
    enclose_cosine(x, n->op, p);
    return;
  case DYD_CERT_EXP:
    dyd_cert_enclosure_exp(x, p);
    return;
  case DYD_CERT_SINH:
  case DYD_CERT_COSH:
  case DYD_CERT_TANH:
    enclose_hyperbolic(x, n->op, p);
    return;
  default:
    enclose_inverse(x, n->op, p);
  }
}

static void enclose_operation(dyd_cert_enclosure *x, dyd_cert_op op, const dyd_cert_enclosure *y, long p) {
  switch (op) {
  case DYD_CERT_ADD:
    dyd_cert_enclosure_add(x, y);
    return;
  case DYD_CERT_SUB:
    dyd_cert_enclosure_sub(x, y);
    return;
  case DYD_CERT_MUL:
    dyd_cert_enclosure_mul(x, y, p);
    return;
  case DYD_CERT_DIV:
    dyd_cert_enclosure_div(x, y, p);
    return;
  default:
    dyd_cert_enclosure_extreme(x, op == DYD_CERT_MAX ? 1 : -1, y);
  }
}

static void enclose_value(dyd_cert_enclosure *x, dyd_cert_algebra *a, const dyd_cert_quotient *v, long p) {
  dyd_cert_enclosure den;
  dyd_cert_enclosure_init(&den);
  dyd_cert_poly_enclose(x, a, &v->num, p);
  dyd_cert_poly_enclose(&den, a, &v->den, p);
  dyd_cert_enclosure_div(x, &den, p);
  dyd_cert_enclosure_clear(&den);
}

static void enclose_leaf(dyd_cert_enclosure *x, dyd_cert_algebra *a, const dyd_cert_number *n, long p) {
  switch (n->op) {
  case DYD_CERT_PI:
    dyd_cert_enclosure_pi(x, p);
    return;
  case DYD_CERT_E:
    enclose_e(x, p);
    return;
  case DYD_CERT_CYCLE:
    enclose_cycle(x, n->exponent, p);
    return;
  case DYD_CERT_ROOT:
    dyd_cert_root_enclose(x, n->root, p);
    return;
  case DYD_CERT_VALUE:
    enclose_value(x, a, &n->value, p);
    return;
  default:
    x->known = false;
  }
}

/* Numbers are made of lower ones; the way down is as long as there are numbers at most, and those before are known. */
const dyd_cert_enclosure *dyd_cert_algebra_enclose(dyd_cert_algebra *a, uint32_t k, long p) {
  for (uint32_t j = 0; j <= k; j++) {
    dyd_cert_number *n = &a->number[j];
    if (n->p == p) continue;
    n->p = p;
    if (!dyd_cert_op_operands(n->op)) {
      enclose_leaf(&n->now, a, n, p);
      continue;
    }
    dyd_cert_enclosure_set(&n->now, &a->number[n->a].now);
    if (!n->now.known) continue;
    if (dyd_cert_op_operands(n->op) == 1)
      enclose_function(&n->now, n, p);
    else if (a->number[n->b].now.known)
      enclose_operation(&n->now, n->op, &a->number[n->b].now, p);
    else
      n->now.known = false; /* what is not known may be long, and would grow from line to line */
  }
  return &a->number[k].now;
}

static void enclose_variable(dyd_cert_enclosure *out, dyd_cert_algebra *a, size_t k, long p) {
  const dyd_cert_leaf *l = &a->leaf[k];
  const dyd_cert_number *n = &a->number[l->number];
  if (l->sine || n->op == DYD_CERT_COS || n->op == DYD_CERT_SIN || n->op == DYD_CERT_TAN) {
    dyd_cert_enclosure_set(out, dyd_cert_algebra_enclose(a, n->a, p));
    if (out->known) enclose_cosine(out, l->sine ? DYD_CERT_SIN : DYD_CERT_COS, p);
    return;
  }
  dyd_cert_poly_enclose(out, a, &l->den, p);
  dyd_cert_enclosure_mul(out, dyd_cert_algebra_enclose(a, l->number, p), p);
}

/* Leaves of q are numbers of before, whose enclosures are known when this is called for one of them. */
void dyd_cert_poly_enclose(dyd_cert_enclosure *out, dyd_cert_algebra *a, const dyd_cert_poly *q, long p) {
  dyd_cert_enclosure term, power;
  dyd_cert_enclosure_init(&term);
  dyd_cert_enclosure_init(&power);
  mpz_set_ui(out->lo, 0);
  mpz_set_ui(out->hi, 0);
  out->known = dyd_cert_count_work(&a->relations, q->count * (1 + (size_t)p / GMP_NUMB_BITS));
  for (size_t t = 0; t < q->count && out->known; t++) {
    mpz_mul_2exp(term.lo, q->term[t].c, (mp_bitcnt_t)p);
    mpz_set(term.hi, term.lo);
    term.known = true;
    for (size_t k = 0; k < a->relations.count; k++) {
      if (!q->term[t].e[k]) continue;
      enclose_variable(&power, a, k, p);
      dyd_cert_enclosure_pow(&power, q->term[t].e[k], p);
      dyd_cert_enclosure_mul(&term, &power, p);
    }
    dyd_cert_enclosure_add(out, &term);
  }
  dyd_cert_enclosure_clear(&power);
  dyd_cert_enclosure_clear(&term);
}

int dyd_cert_algebra_sign(dyd_cert_algebra *a, uint32_t k) {
  int sign = 0;
  for (long p = 64; p <= DYD_CERT_SIGN_PRECISION && !sign; p *= 2)
    sign = dyd_cert_enclosure_sign(dyd_cert_algebra_enclose(a, k, p));
  return sign;
}

int dyd_cert_poly_sign(dyd_cert_algebra *a, const dyd_cert_poly *q) {
  int sign = 0;
  dyd_cert_enclosure x;
  if (dyd_cert_poly_is_zero(q)) return 0;
  if (dyd_cert_poly_integer(q)) return mpz_sgn(dyd_cert_poly_integer(q));
  dyd_cert_enclosure_init(&x);
  for (long p = 64; p <= DYD_CERT_SIGN_PRECISION && !sign; p *= 2) {
    dyd_cert_poly_enclose(&x, a, q, p);
    sign = dyd_cert_enclosure_sign(&x);
  }
  dyd_cert_enclosure_clear(&x);
  return sign;
}
