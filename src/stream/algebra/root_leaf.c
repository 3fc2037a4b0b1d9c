/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Roots of polynomials as leaves.
 *
 * Of the polynomial only the irreducible factor counts that the root is a zero of: exactly one, since they are coprime.
 * Degree 1 gives a number, degree 2 a square root. Otherwise the leaf is t = a x, a the leading coefficient: a zero of
 * the monic integer polynomial a^(n-1) f(t / a). Two roots of one f of degree n are different or the same: distinct
 * ones are more than n^-(n+2)/2 |f|^-(n-1) apart (Mahler 1964, f without multiple zeros). */
#include "stream/algebra/leaves.h"

#include "stream/arb.h"
#include <flint/fmpz_poly_factor.h>

/* Degree and bits up to which factors are looked for; bits of a relation; bits looked at to tell roots apart. */
enum { FACTOR_DEGREE = 32, FACTOR_BITS = 4096, RELATION_BITS = 1 << 20, APART_BITS = 1 << 14 };

static void polynomial_of_root(fmpz_poly_t f, const dyd_root *root) {
  fmpz_t c;
  fmpz_init(c);
  for (size_t k = root->count; k-- > 0;) {
    fmpz_set_mpz(c, root->coeff[k]);
    fmpz_poly_set_coeff_fmpz(f, (slong)k, c);
  }
  fmpz_poly_primitive_part(f, f);
  fmpz_clear(c);
}

/* How many factors may vanish at x, and the last of them. */
static slong count_vanishing(slong *which, const fmpz_poly_factor_t list, const arb_t x, slong prec) {
  slong count = 0;
  arb_t y;
  arb_init(y);
  for (slong k = 0; k < list->num; k++) {
    arb_fmpz_poly_evaluate_arb(y, list->p + k, x, prec);
    if (!arb_contains_zero(y)) continue;
    count++;
    *which = k;
  }
  arb_clear(y);
  return count;
}

/* f becomes its irreducible factor that vanishes at the form, or stays as it is. */
static void keep_own_factor(fmpz_poly_t f, dyd_ring *r, uint32_t node) {
  fmpz_poly_factor_t list;
  slong which = -1;
  if (fmpz_poly_degree(f) > FACTOR_DEGREE || FLINT_ABS(fmpz_poly_max_bits(f)) > FACTOR_BITS) return;
  fmpz_poly_factor_init(list);
  fmpz_poly_factor(list, f);
  for (slong prec = 128; prec <= APART_BITS; prec *= 2) {
    if (count_vanishing(&which, list, dyd_forms_value(r->forms, node, prec), prec) != 1) continue;
    fmpz_poly_set(f, list->p + which);
    break;
  }
  fmpz_poly_factor_clear(list);
}

/* ---- degrees 1 and 2 ---- */

static bool root_is_number(dyd_fraction *x, const dyd_ring *r, const fmpz_poly_t f) {
  fmpz_t minus;
  fmpz_init(minus);
  fmpz_neg(minus, fmpz_poly_get_coeff_ptr(f, 0));
  dyd_fraction_set_number(x, minus, fmpz_poly_get_coeff_ptr(f, 1), r);
  fmpz_clear(minus);
  return true;
}

/* The sign of 2 a x + b at the root x; 0: not known. */
static int side_of_middle(dyd_ring *r, const fmpz_poly_t f, uint32_t node) {
  arb_t y;
  int sign = 0;
  arb_init(y);
  for (slong prec = 128; prec <= APART_BITS && !sign; prec *= 2) {
    arb_mul_fmpz(y, dyd_forms_value(r->forms, node, prec), fmpz_poly_get_coeff_ptr(f, 2), prec);
    arb_mul_2exp_si(y, y, 1);
    arb_add_fmpz(y, y, fmpz_poly_get_coeff_ptr(f, 1), prec);
    if (!arb_contains_zero(y)) sign = arf_sgn(arb_midref(y));
  }
  arb_clear(y);
  return sign;
}

/* x = (-b + sign sqrt(b^2 - 4 a c)) / 2 a. */
static bool root_is_quadratic(dyd_fraction *x, dyd_ring *r, const fmpz_poly_t f, uint32_t node) {
  const fmpz *a = fmpz_poly_get_coeff_ptr(f, 2), *b = fmpz_poly_get_coeff_ptr(f, 1), *c = fmpz_poly_get_coeff_ptr(f, 0);
  int sign = side_of_middle(r, f, node);
  dyd_fraction u;
  fmpz_t t;
  fmpz_init(t);
  fmpz_mpoly_init(u.num, r->ctx);
  fmpz_mpoly_init(u.den, r->ctx);
  fmpz_mul(t, a, c);
  fmpz_mul_2exp(t, t, 2);
  fmpz_neg(t, t);
  fmpz_addmul(t, b, b);
  fmpz_mpoly_set_fmpz(u.num, t, r->ctx);
  fmpz_mpoly_one(u.den, r->ctx);
  bool fits = sign && dyd_leaf_radical(x, r, DYD_OP_SQRT, &u);
  if (fits) {
    if (sign < 0) fmpz_mpoly_neg(x->num, x->num, r->ctx);
    fmpz_mpoly_sub_fmpz(x->num, x->num, b, r->ctx);
    fmpz_mul_2exp(t, a, 1);
    fmpz_mpoly_set_fmpz(x->den, t, r->ctx);
    dyd_fraction_lowest(x, r);
  }
  fmpz_mpoly_clear(u.den, r->ctx);
  fmpz_mpoly_clear(u.num, r->ctx);
  fmpz_clear(t);
  return fits;
}

/* ---- leaves ---- */

/* Bits to which two roots of f have to agree in order to be the same; beyond APART_BITS: too many. */
static slong bits_apart(const fmpz_poly_t f) {
  slong n = fmpz_poly_degree(f), norm = FLINT_ABS(fmpz_poly_max_bits(f)) + (slong)FLINT_BIT_COUNT(n) / 2 + 1;
  return (n + 3) / 2 * (slong)FLINT_BIT_COUNT(n) + (n - 1) * norm + 2;
}

/* Are the values of two forms, zeros of f, the same? When in doubt they are not taken to be. */
static bool roots_are_same(dyd_ring *r, const fmpz_poly_t f, uint32_t a, uint32_t b) {
  slong bits = bits_apart(f);
  bool apart = a != b && bits > APART_BITS, same = a == b;
  arb_t d;
  mag_t most;
  arb_init(d);
  mag_init(most);
  for (slong prec = 64; !apart && !same; prec *= 2) {
    arb_set(d, dyd_forms_value(r->forms, a, prec));
    arb_sub(d, d, dyd_forms_value(r->forms, b, prec), prec + 64);
    arb_get_mag(most, d);
    apart = !arb_contains_zero(d) || prec > 4 * APART_BITS;
    same = !apart && mag_cmp_2exp_si(most, -bits) < 0;
  }
  mag_clear(most);
  arb_clear(d);
  return same;
}

/* relation = a^(n-1) f(t / a). */
static void monic_relation(fmpz_mpoly_t relation, const dyd_ring *r, const fmpz_poly_t f, slong l) {
  ulong exponent[DYD_RING_LEAVES] = {0};
  slong n = fmpz_poly_degree(f);
  fmpz_mpoly_struct *terms = relation;
  fmpz_t power, c;
  fmpz_init_set_ui(power, 1);
  fmpz_init(c);
  fmpz_mpoly_zero(terms, r->ctx);
  for (slong e = n; e >= 0; e--) {
    exponent[dyd_ring_var(r, l)] = (ulong)e;
    if (e == n)
      fmpz_one(c);
    else
      fmpz_mul(c, fmpz_poly_get_coeff_ptr(f, e), power);
    if (!fmpz_is_zero(c)) fmpz_mpoly_push_term_fmpz_ui(terms, c, exponent, r->ctx);
    if (e < n) fmpz_mul(power, power, fmpz_poly_get_coeff_ptr(f, n));
  }
  fmpz_clear(c);
  fmpz_clear(power);
}

static bool is_root_leaf(dyd_ring *r, slong l, const fmpz_poly_t f, uint32_t node) {
  const dyd_leaf *leaf = &r->leaf[l];
  if (leaf->kind != DYD_LEAF_ROOT || leaf->degree != fmpz_poly_degree(f)) return false;
  fmpz_mpoly_t relation;
  fmpz_mpoly_init(relation, r->ctx);
  monic_relation(relation, r, f, l);
  bool equal = fmpz_equal(leaf->base, fmpz_poly_lead(f)) && fmpz_mpoly_equal(leaf->relation, relation, r->ctx);
  fmpz_mpoly_clear(relation, r->ctx);
  return equal && roots_are_same(r, f, leaf->node, node);
}

static slong root_leaf(dyd_ring *r, const fmpz_poly_t f, uint32_t node) {
  for (slong l = 0; l < r->leaves; l++)
    if (is_root_leaf(r, l, f, node)) return l;
  slong l = dyd_ring_add_leaf(r, DYD_LEAF_ROOT, DYD_OP_CONST);
  if (l < 0) return l;
  dyd_leaf *leaf = &r->leaf[l];
  leaf->node = node;
  fmpz_set(leaf->base, fmpz_poly_lead(f));
  monic_relation(leaf->relation, r, f, l);
  leaf->degree = fmpz_poly_degree(f);
  leaf->whole = true;
  fmpz_t bound;
  fmpz_init(bound);
  fmpz_poly_bound_roots(bound, f);
  fmpz_mul(bound, bound, leaf->base);
  mag_set_fmpz(leaf->bound, bound);
  fmpz_clear(bound);
  return l;
}

static bool root_is_leaf(dyd_fraction *x, dyd_ring *r, const fmpz_poly_t f, uint32_t node) {
  slong n = fmpz_poly_degree(f), bits = FLINT_ABS(fmpz_poly_max_bits(f));
  bool monic = fmpz_is_one(fmpz_poly_lead(f));
  if ((monic ? 1 : n) * (n + 1) > RELATION_BITS / (bits + 1)) return dyd_leaf_free(x, r, DYD_OP_CONST, NULL, node);
  slong l = root_leaf(r, f, node);
  if (l >= 0) dyd_fraction_set_leaf(x, l, fmpz_poly_lead(f), r);
  return l >= 0;
}

bool dyd_leaf_root(dyd_fraction *x, dyd_ring *r, uint32_t node) {
  fmpz_poly_t f;
  fmpz_poly_init(f);
  polynomial_of_root(f, r->forms->node[node].root);
  keep_own_factor(f, r, node);
  if (fmpz_sgn(fmpz_poly_lead(f)) < 0) fmpz_poly_neg(f, f);
  slong n = fmpz_poly_degree(f);
  bool fits = n == 1   ? root_is_number(x, r, f)
              : n == 2 ? root_is_quadratic(x, r, f, node)
                       : root_is_leaf(x, r, f, node);
  fmpz_poly_clear(f);
  return fits;
}
