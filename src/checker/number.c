/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What numbers are in leaves [CERT-10]: arithmetic is done, functions are found among the leaves, or make one.
 *
 * Of a root V that is stated, V^k = a and V >= 0, or f(V) = 0 and its place between the ends, are checked: that is what
 * the root is. Leaves are shared by what their operands are in leaves before, so equal ones are equal numbers. */
#include "checker/algebra.h"

/* ---- functions that are known by their operands ---- */

static bool is_circular(dyd_cert_op op) {
  return op == DYD_CERT_COS || op == DYD_CERT_SIN || op == DYD_CERT_TAN;
}
static bool is_exponential(dyd_cert_op op) {
  return op == DYD_CERT_EXP || op == DYD_CERT_E;
}

/* Does leaf k belong to the function `op` of something? */
static bool is_leaf_of(const dyd_cert_algebra *a, size_t k, dyd_cert_op op) {
  dyd_cert_op of = a->number[a->leaf[k].number].op;
  if (a->leaf[k].sine) return false;
  if (is_circular(op)) return is_circular(of);
  return is_exponential(op) ? is_exponential(of) : of == op;
}

/* *sign: the operand of leaf k is u (1) or -u (-1), 0: neither. */
static bool operand_compare(int *sign, dyd_cert_algebra *a, size_t k, const dyd_cert_quotient *u) {
  const dyd_cert_number *n = &a->number[a->leaf[k].number];
  dyd_cert_quotient key = {{0}, {0}};
  mpz_t one;
  bool equal = false;
  mpz_init_set_ui(one, 1);
  bool fits = n->op == DYD_CERT_E ? dyd_cert_quotient_set_q(&key, one, one, &a->relations)
                                  : dyd_cert_quotient_set(&key, &a->number[n->a].value, &a->relations);
  *sign = 0;
  for (int s = 1; s >= -1 && fits && !*sign; s -= 2) {
    fits = dyd_cert_quotient_equal(&equal, &key, u, &a->relations);
    if (equal) *sign = s;
    dyd_cert_quotient_neg(&key);
  }
  dyd_cert_quotient_clear(&key);
  mpz_clear(one);
  return fits;
}

/* *leaf: that of op of u, or of -u where that helps, *sign saying which; DYD_CERT_LEAVES: there is none. */
static bool find_leaf(size_t *leaf, int *sign, dyd_cert_algebra *a, dyd_cert_op op, const dyd_cert_quotient *u) {
  bool fits = true;
  *sign = 0;
  for (*leaf = 0; *leaf < a->relations.count; ++*leaf) {
    if (!is_leaf_of(a, *leaf, op)) continue;
    fits = operand_compare(sign, a, *leaf, u);
    if (!fits || *sign > 0 || (*sign && (is_circular(op) || is_exponential(op)))) return fits;
  }
  *leaf = DYD_CERT_LEAVES;
  return true;
}

/* x = leaf k. */
static bool value_is_leaf(dyd_cert_quotient *x, dyd_cert_algebra *a, size_t k) {
  mpz_t one;
  mpz_init_set_ui(one, 1);
  dyd_cert_poly den = {0};
  bool fits = dyd_cert_poly_set_z(&den, one, &a->relations) && dyd_cert_quotient_set_leaf(x, k, &den, &a->relations);
  dyd_cert_poly_clear(&den);
  mpz_clear(one);
  return fits;
}

/* The leaf that the number to be added is; its value is that. */
static bool value_makes_leaf(dyd_cert_quotient *x, dyd_cert_algebra *a) {
  size_t k = dyd_cert_algebra_leaf(a);
  if (k == DYD_CERT_LEAVES || !value_is_leaf(x, a, k)) return false;
  return dyd_cert_poly_set(&a->leaf[k].den, &x->den, &a->relations);
}

static bool value_set_si(dyd_cert_quotient *x, long z, dyd_cert_algebra *a) {
  mpz_t n, one;
  mpz_init_set_si(n, z);
  mpz_init_set_ui(one, 1);
  bool fits = dyd_cert_quotient_set_q(x, n, one, &a->relations);
  mpz_clear(one);
  mpz_clear(n);
  return fits;
}

/* ---- angles ---- */

/* Is u a rational multiple of pi? Then num / den = u / (2 pi). */
static bool is_part_of_turn(mpz_ptr num, mpz_ptr den, const dyd_cert_algebra *a, const dyd_cert_quotient *u) {
  mpz_srcptr d = dyd_cert_poly_integer(&u->den);
  mpz_set_ui(num, 0);
  mpz_set_ui(den, 1);
  if (dyd_cert_poly_is_zero(&u->num)) return true;
  if (!d || u->num.count != 1) return false;
  for (size_t k = 0; k < a->relations.count; k++) {
    unsigned e = u->num.term->e[k];
    if (e && (e != 1 || a->number[a->leaf[k].number].op != DYD_CERT_PI)) return false;
  }
  if (dyd_cert_poly_integer(&u->num)) return false;
  mpz_set(num, u->num.term->c);
  mpz_mul_ui(den, d, 2);
  return true;
}

/* The leaves of the cosine and, after it, the sine of the operand of the number to be added: s^2 = 1 - c^2. */
static size_t make_angle(dyd_cert_algebra *a) {
  size_t c = dyd_cert_algebra_leaf(a), s = dyd_cert_algebra_leaf(a);
  if (s == DYD_CERT_LEAVES) return DYD_CERT_LEAVES;
  dyd_cert_poly square = {0};
  mpz_t one;
  mpz_init_set_ui(one, 1);
  a->leaf[s].sine = true;
  dyd_cert_relation *to = &a->relations.leaf[s];
  bool fits = dyd_cert_poly_set_leaf(&square, c, &a->relations) && dyd_cert_poly_mul(&square, &square, &a->relations) &&
              dyd_cert_poly_set_z(&to->rest, one, &a->relations) &&
              dyd_cert_poly_add(&to->rest, &square, -1, &a->relations);
  to->degree = 2;
  dyd_cert_poly_clear(&square);
  mpz_clear(one);
  return fits ? c : DYD_CERT_LEAVES;
}

/* x = cos u or sin u. */
static bool value_circular(dyd_cert_quotient *x, dyd_cert_algebra *a, dyd_cert_op op, const dyd_cert_quotient *u) {
  mpz_t num, den;
  size_t leaf;
  int sign = 1;
  mpz_inits(num, den, NULL);
  bool part = is_part_of_turn(num, den, a, u), fits = true;
  if (part) {
    mpz_mul_ui(num, num, 4);
    if (op == DYD_CERT_SIN) mpz_sub(num, num, den); /* sin of it: cos of a quarter less */
    mpz_mul_ui(den, den, 4);
    fits = dyd_cert_cycle_cosine(x, a, num, den);
  } else {
    fits = find_leaf(&leaf, &sign, a, op, u);
    if (fits && leaf == DYD_CERT_LEAVES) leaf = make_angle(a), sign = 1;
    fits = fits && leaf != DYD_CERT_LEAVES && value_is_leaf(x, a, op == DYD_CERT_COS ? leaf : leaf + 1);
    if (sign < 0 && op == DYD_CERT_SIN) dyd_cert_quotient_neg(x);
  }
  mpz_clears(num, den, NULL);
  return fits;
}

static bool value_tangent(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_quotient *u) {
  dyd_cert_quotient c = {{0}, {0}};
  bool fits = value_circular(&c, a, DYD_CERT_COS, u) && value_circular(x, a, DYD_CERT_SIN, u) &&
              dyd_cert_poly_sign(a, &c.num) && dyd_cert_quotient_div(x, &c, &a->relations);
  dyd_cert_quotient_clear(&c);
  return fits;
}

/* ---- exponentials ---- */

/* x = exp u, a leaf of u or of -u; `may` make one. */
static bool value_exponential(dyd_cert_quotient *x, dyd_cert_algebra *a, bool may, const dyd_cert_quotient *u) {
  size_t leaf;
  int sign;
  if (dyd_cert_poly_is_zero(&u->num)) return value_set_si(x, 1, a);
  if (!find_leaf(&leaf, &sign, a, DYD_CERT_EXP, u)) return false;
  if (leaf == DYD_CERT_LEAVES) return may && value_makes_leaf(x, a);
  bool fits = value_is_leaf(x, a, leaf);
  if (sign < 0) dyd_cert_quotient_invert(x);
  return fits;
}

/* From y = exp u, z = 1 / y: (y - z) / 2, (y + z) / 2, (y - z) / (y + z), whose divisor is positive. */
static bool value_hyperbolic(dyd_cert_quotient *x, dyd_cert_algebra *a, dyd_cert_op op, const dyd_cert_quotient *u) {
  dyd_cert_quotient y = {{0}, {0}}, z = {{0}, {0}};
  dyd_cert_relations *r = &a->relations;
  bool fits = value_exponential(x, a, false, u) && dyd_cert_quotient_set(&y, x, r) && dyd_cert_quotient_set(&z, x, r);
  if (fits) dyd_cert_quotient_invert(&z);
  fits = fits && dyd_cert_quotient_add(x, op == DYD_CERT_COSH ? 1 : -1, &z, r);
  if (op == DYD_CERT_TANH)
    fits = fits && dyd_cert_quotient_add(&y, 1, &z, r);
  else
    fits = fits && value_set_si(&y, 2, a);
  fits = fits && dyd_cert_quotient_div(x, &y, r);
  dyd_cert_quotient_clear(&z);
  dyd_cert_quotient_clear(&y);
  return fits;
}

/* ---- roots ---- */

/* A leaf t = den u^(1/k) with t^k = num den^(k-1), for u = num / den; the value is t / den. */
static bool value_radical(dyd_cert_quotient *x, dyd_cert_algebra *a, unsigned k, const dyd_cert_quotient *u) {
  if (dyd_cert_poly_is_zero(&u->num)) return dyd_cert_quotient_set(x, u, &a->relations);
  if (k == 2 && dyd_cert_poly_sign(a, &u->num) * dyd_cert_poly_sign(a, &u->den) <= 0) return false;
  size_t l = dyd_cert_algebra_leaf(a);
  if (l == DYD_CERT_LEAVES) return false;
  dyd_cert_relation *to = &a->relations.leaf[l];
  bool fits = dyd_cert_poly_set(&to->rest, &u->num, &a->relations);
  for (unsigned j = 1; j < k && fits; j++) fits = dyd_cert_poly_mul(&to->rest, &u->den, &a->relations);
  fits = fits && dyd_cert_poly_set(&a->leaf[l].den, &u->den, &a->relations) &&
         dyd_cert_quotient_set_leaf(x, l, &u->den, &a->relations);
  to->degree = k;
  a->leaf[l].whole = dyd_cert_poly_bound(a->leaf[l].bound, a, &to->rest);
  if (!mpz_root(a->leaf[l].bound, a->leaf[l].bound, k)) mpz_add_ui(a->leaf[l].bound, a->leaf[l].bound, 1);
  return fits;
}

/* A leaf t = c_n r for a zero r of c_0 + ... + c_n X^n: t^n = - c_n-1 t^n-1 - c_n-2 c_n t^n-2 - ... All zeros are at
 * most 1 + the greatest coefficient. */
static bool value_root(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_bracket *f) {
  size_t n = f->count - 1, l = dyd_cert_algebra_leaf(a);
  if (l == DYD_CERT_LEAVES) return false;
  dyd_cert_relations *r = &a->relations;
  dyd_cert_poly one = {0};
  uint16_t power[DYD_CERT_LEAVES] = {0};
  mpz_t c, lead;
  mpz_init(c);
  mpz_init_set_ui(lead, 1);
  bool fits = dyd_cert_poly_set_z(&one, lead, r);
  for (size_t e = n; e-- > 0 && fits;) {
    mpz_mul(c, f->coeff[e], lead);
    if (mpz_cmpabs(c, a->leaf[l].bound) > 0) mpz_abs(a->leaf[l].bound, c);
    mpz_neg(c, c);
    power[l] = (uint16_t)e;
    fits = dyd_cert_poly_add_scaled(&r->leaf[l].rest, &one, c, power, r);
    mpz_mul(lead, lead, f->coeff[n]);
  }
  mpz_add_ui(a->leaf[l].bound, a->leaf[l].bound, 1);
  r->leaf[l].degree = (unsigned)n;
  a->leaf[l].whole = true;
  fits = fits && dyd_cert_poly_set_z(&one, f->coeff[n], r) && dyd_cert_quotient_set_leaf(x, l, &one, r) &&
         dyd_cert_poly_set(&a->leaf[l].den, &one, r);
  dyd_cert_poly_clear(&one);
  mpz_clears(c, lead, NULL);
  return fits;
}

/* ---- inverse functions ---- */

/* Is u, or -u, at most 1? */
static bool is_up_to_one(dyd_cert_algebra *a, const dyd_cert_quotient *u, int sign) {
  dyd_cert_quotient d = {{0}, {0}};
  bool fits = value_set_si(&d, 1, a) && dyd_cert_quotient_add(&d, -sign, u, &a->relations);
  fits = fits && (dyd_cert_poly_is_zero(&d.num) || dyd_cert_poly_sign(a, &d.num) * dyd_cert_poly_sign(a, &d.den) > 0);
  dyd_cert_quotient_clear(&d);
  return fits;
}

/* A leaf of which nothing is known but its enclosure, and that equal operands have the same. */
static bool value_inverse(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_number *n) {
  const dyd_cert_quotient *u = &a->number[n->a].value;
  size_t leaf;
  int sign;
  if (n->op == DYD_CERT_LOG && dyd_cert_algebra_sign(a, n->a) <= 0) return false;
  if ((n->op == DYD_CERT_ASIN || n->op == DYD_CERT_ACOS) && !(is_up_to_one(a, u, 1) && is_up_to_one(a, u, -1)))
    return false;
  if (!find_leaf(&leaf, &sign, a, n->op, u)) return false;
  return leaf == DYD_CERT_LEAVES ? value_makes_leaf(x, a) : value_is_leaf(x, a, leaf);
}

/* ---- all ---- */

/* x, the value of u, becomes |x|. */
static bool value_absolute(dyd_cert_quotient *x, dyd_cert_algebra *a, uint32_t u) {
  int sign = dyd_cert_poly_is_zero(&x->num) ? 1 : dyd_cert_algebra_sign(a, u);
  if (sign < 0) dyd_cert_quotient_neg(x);
  return sign != 0;
}

/* x, the value of one, becomes the lesser or greater of it and y. */
static bool value_extreme(dyd_cert_quotient *x, dyd_cert_algebra *a, dyd_cert_op op, const dyd_cert_quotient *y) {
  dyd_cert_quotient d = {{0}, {0}};
  bool fits = dyd_cert_quotient_set(&d, y, &a->relations) && dyd_cert_quotient_add(&d, -1, x, &a->relations);
  bool equal = fits && dyd_cert_poly_is_zero(&d.num);
  int sign = fits ? dyd_cert_poly_sign(a, &d.num) * dyd_cert_poly_sign(a, &d.den) : 0;
  dyd_cert_quotient_clear(&d);
  if (!equal && !sign) return false;
  return (sign > 0) == (op == DYD_CERT_MAX) && sign ? dyd_cert_quotient_set(x, y, &a->relations) : fits;
}

/* x = op of itself and y. */
static bool value_operation(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_number *n) {
  const dyd_cert_quotient *y = &a->number[n->b].value;
  if (!dyd_cert_quotient_set(x, &a->number[n->a].value, &a->relations)) return false;
  switch (n->op) {
  case DYD_CERT_ADD:
  case DYD_CERT_SUB:
    return dyd_cert_quotient_add(x, n->op == DYD_CERT_ADD ? 1 : -1, y, &a->relations);
  case DYD_CERT_MUL:
    return dyd_cert_quotient_mul(x, y, &a->relations);
  case DYD_CERT_DIV:
    return dyd_cert_algebra_sign(a, n->b) && dyd_cert_quotient_div(x, y, &a->relations);
  default:
    return value_extreme(x, a, n->op, y);
  }
}

static bool value_power(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_number *n) {
  if (!dyd_cert_quotient_set(x, &a->number[n->a].value, &a->relations)) return false;
  if (n->exponent >= 0) return dyd_cert_quotient_power(x, (unsigned long)n->exponent, &a->relations);
  if (!dyd_cert_algebra_sign(a, n->a)) return false;
  dyd_cert_quotient_invert(x);
  return dyd_cert_quotient_power(x, (unsigned long)-n->exponent, &a->relations);
}

static bool value_function(dyd_cert_quotient *x, dyd_cert_algebra *a, const dyd_cert_number *n) {
  const dyd_cert_quotient *u = &a->number[n->a].value;
  switch (n->op) {
  case DYD_CERT_CLAIM:
    a->claims++;
    return dyd_cert_quotient_set(x, u, &a->relations);
  case DYD_CERT_NEG:
  case DYD_CERT_ABS:
    if (!dyd_cert_quotient_set(x, u, &a->relations)) return false;
    if (n->op == DYD_CERT_ABS) return value_absolute(x, a, n->a);
    dyd_cert_quotient_neg(x);
    return true;
  case DYD_CERT_SQRT:
  case DYD_CERT_CBRT:
    return value_radical(x, a, n->op == DYD_CERT_SQRT ? 2 : 3, u);
  case DYD_CERT_COS:
  case DYD_CERT_SIN:
    return value_circular(x, a, n->op, u);
  case DYD_CERT_TAN:
    return value_tangent(x, a, u);
  case DYD_CERT_EXP:
    return value_exponential(x, a, true, u);
  case DYD_CERT_SINH:
  case DYD_CERT_COSH:
  case DYD_CERT_TANH:
    return value_hyperbolic(x, a, n->op, u);
  default:
    return value_inverse(x, a, n);
  }
}

static bool value_e(dyd_cert_quotient *x, dyd_cert_algebra *a) {
  dyd_cert_quotient one = {{0}, {0}};
  bool fits = value_set_si(&one, 1, a) && value_exponential(x, a, true, &one);
  dyd_cert_quotient_clear(&one);
  return fits;
}

static bool value_pi(dyd_cert_quotient *x, dyd_cert_algebra *a) {
  for (size_t k = 0; k < a->relations.count; k++)
    if (a->number[a->leaf[k].number].op == DYD_CERT_PI) return value_is_leaf(x, a, k);
  return value_makes_leaf(x, a);
}

bool dyd_cert_number_value(dyd_cert_number *n, dyd_cert_algebra *a) {
  switch (n->op) {
  case DYD_CERT_PI:
    return value_pi(&n->value, a);
  case DYD_CERT_E:
    return value_e(&n->value, a);
  case DYD_CERT_CYCLE:
    return dyd_cert_cycle_begin(n, a);
  case DYD_CERT_ROOT:
    return value_root(&n->value, a, n->root);
  case DYD_CERT_CALLBACK:
    return value_makes_leaf(&n->value, a);
  case DYD_CERT_POW:
    return value_power(&n->value, a, n);
  default:
    if (n->op >= DYD_CERT_ADD && n->op <= DYD_CERT_MAX) return value_operation(&n->value, a, n);
    return value_function(&n->value, a, n);
  }
}

/* ---- what is stated ---- */

/* V^k = u, and V >= 0 where k = 2. */
static bool is_radical(const dyd_cert_quotient *v, dyd_cert_algebra *a, unsigned k, const dyd_cert_quotient *u) {
  dyd_cert_quotient power = {{0}, {0}};
  bool equal = false;
  bool fits = dyd_cert_quotient_set(&power, v, &a->relations) && dyd_cert_quotient_power(&power, k, &a->relations) &&
              dyd_cert_quotient_equal(&equal, &power, u, &a->relations);
  dyd_cert_quotient_clear(&power);
  if (!fits || !equal) return false;
  return k == 3 || dyd_cert_poly_is_zero(&v->num) ||
         dyd_cert_poly_sign(a, &v->num) * dyd_cert_poly_sign(a, &v->den) > 0;
}

/* *zero: f(v) = 0, by Horner's rule. */
static bool root_vanishes(bool *zero, const dyd_cert_bracket *f, dyd_cert_algebra *a, const dyd_cert_quotient *v) {
  dyd_cert_quotient sum = {{0}, {0}}, c = {{0}, {0}};
  mpz_t one;
  mpz_init_set_ui(one, 1);
  bool fits = value_set_si(&sum, 0, a);
  for (size_t k = f->count; k-- > 0 && fits;)
    fits = dyd_cert_quotient_mul(&sum, v, &a->relations) &&
           dyd_cert_quotient_set_q(&c, f->coeff[k], one, &a->relations) &&
           dyd_cert_quotient_add(&sum, 1, &c, &a->relations);
  *zero = fits && dyd_cert_poly_is_zero(&sum.num);
  dyd_cert_quotient_clear(&c);
  dyd_cert_quotient_clear(&sum);
  mpz_clear(one);
  return fits;
}

/* The sign of v - num / den; 0: not known. */
static int side_of_end(const dyd_cert_quotient *v, dyd_cert_algebra *a, mpz_srcptr num, mpz_srcptr den) {
  dyd_cert_quotient end = {{0}, {0}};
  bool fits =
      dyd_cert_quotient_set_q(&end, num, den, &a->relations) && dyd_cert_quotient_add(&end, -1, v, &a->relations);
  int sign = fits ? -dyd_cert_poly_sign(a, &end.num) * dyd_cert_poly_sign(a, &end.den) : 0;
  dyd_cert_quotient_clear(&end);
  return sign;
}

bool dyd_cert_number_check(dyd_cert_number *n, dyd_cert_algebra *a) {
  bool zero = false;
  if (n->op != DYD_CERT_ROOT) return is_radical(&n->value, a, n->op == DYD_CERT_SQRT ? 2 : 3, &a->number[n->a].value);
  return root_vanishes(&zero, n->root, a, &n->value) && zero &&
         side_of_end(&n->value, a, n->root->end[0], n->root->end[1]) > 0 &&
         side_of_end(&n->value, a, n->root->end[2], n->root->end[3]) < 0;
}
