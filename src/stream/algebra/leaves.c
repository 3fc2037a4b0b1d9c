/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Leaves: square and cube roots; cosines, sines and free variables; roots of polynomials.
 *
 * A root of a rational number m / d is that of m d^(k-1), divided by d; that integer is a product of powers of the
 * base, so its root is an integer times roots of elements of the base. A root of anything else is a leaf of its own;
 * integer factors of the radicand are taken out first, so that equal radicals are seen to be equal. */
#include "stream/algebra/leaves.h"

#include "base/alloc.h"
#include "base/local.h"
#include "stream/arb.h"

#include <flint/fmpq.h>
#include <flint/fmpz_poly_factor.h>
#include <flint/ulong_extras.h>

enum { MOST_BASES = 64 };

/* ---- the base ---- */

/* n becomes the root of which it is a power. */
static void strip_powers(fmpz_t n) {
  DYD_LOCAL_NUMBERS(fmpz, root);
  while (fmpz_cmp_ui(n, 1) > 0 && fmpz_is_perfect_power(root, n)) fmpz_swap(n, root);
}

static bool base_append(dyd_ring *r, const fmpz_t n) {
  if (fmpz_is_one(n)) return true;
  if (r->bases == r->base_cap) {
    slong cap = 2 * r->base_cap + 8;
    fmpz *more = realloc(r->base, (size_t)cap * sizeof *more);
    if (!more) {
      r->failed = true;
      return false;
    }
    r->base = more;
    r->base_cap = cap;
  }
  fmpz_init_set(r->base + r->bases, n);
  strip_powers(r->base + r->bases++);
  return true;
}

/* Makes the elements from `from` on coprime to all others: a common factor of two becomes an element of its own. The
 * product of all elements shrinks with every split. */
static void base_refine(dyd_ring *r) {
  DYD_LOCAL_NUMBERS(fmpz, g);
  for (slong k = 1; k < r->bases && !r->failed; k++)
    for (slong l = 0; l < k && !r->failed; l++) {
      fmpz_gcd(g, r->base + k, r->base + l);
      if (fmpz_is_one(g)) continue;
      while (fmpz_divisible(r->base + k, g)) fmpz_divexact(r->base + k, r->base + k, g);
      while (fmpz_divisible(r->base + l, g)) fmpz_divexact(r->base + l, r->base + l, g);
      base_append(r, g);
      k = 0; /* begins anew */
      break;
    }
  slong kept = 0;
  for (slong k = 0; k < r->bases; k++) {
    if (fmpz_is_one(r->base + k)) continue;
    strip_powers(r->base + k);
    fmpz_swap(r->base + kept++, r->base + k);
  }
  for (slong k = kept; k < r->bases; k++) fmpz_clear(r->base + k);
  r->bases = kept;
}

/* ---- of numbers ---- */

static slong radical_leaf(dyd_ring *r, dyd_op op, const fmpz_t base, slong k) {
  for (slong l = 0; l < r->leaves; l++)
    if (r->leaf[l].kind == DYD_LEAF_RADICAL && r->leaf[l].op == op && fmpz_equal(r->leaf[l].base, base)) return l;
  slong l = dyd_ring_add_leaf(r, DYD_LEAF_RADICAL, op);
  if (l < 0) return l;
  dyd_leaf *leaf = &r->leaf[l];
  fmpz_set(leaf->base, base);
  dyd_ring_gen(leaf->relation, r, l);
  fmpz_mpoly_pow_ui(leaf->relation, leaf->relation, (ulong)k, r->ctx);
  fmpz_mpoly_sub_fmpz(leaf->relation, leaf->relation, base, r->ctx);
  leaf->degree = k;
  leaf->whole = true;
  mag_set_fmpz(leaf->bound, base);
  mag_root(leaf->bound, leaf->bound, (ulong)k);
  return l;
}

/* Takes k-th powers of primes out of n > 0, and multiplies *root by their roots, so that the base need not
 * hold those primes. Numbers of more than a word are left as they are: their primes may be out of reach. */
static void take_out_powers(fmpz_t root, fmpz_t n, slong k) {
  n_factor_t prime;
  if (!fmpz_abs_fits_ui(n)) return;
  n_factor_init(&prime);
  n_factor(&prime, fmpz_get_ui(n), 0);
  for (int f = 0; f < prime.num; f++)
    for (slong e = prime.exp[f]; e >= k; e -= k) {
      fmpz_mul_ui(root, root, prime.p[f]);
      for (slong m = 0; m < k; m++) fmpz_divexact_ui(n, n, prime.p[f]);
    }
}

/* x = the k-th root of n > 0, an integer; n becomes what the base does not know. */
static bool radical_over_base(fmpz_mpoly_t x, dyd_ring *r, dyd_op op, fmpz_t n, slong k) {
  bool fits = true;
  fmpz_mpoly_t root;
  DYD_LOCAL_NUMBERS(fmpz, factor);
  fmpz_set_ui(factor, 1);
  DYD_LOCAL_NUMBERS(fmpz, power);
  fmpz_mpoly_init(root, r->ctx);
  fmpz_mpoly_one(x, r->ctx);
  take_out_powers(factor, n, k);
  for (slong b = 0; b < r->bases && fits; b++) {
    slong e = fmpz_remove(n, n, r->base + b), rest = e % k;
    fmpz_pow_ui(power, r->base + b, (ulong)(e / k));
    fmpz_mul(factor, factor, power);
    if (!rest) continue;
    slong l = radical_leaf(r, op, r->base + b, k);
    fits = l >= 0;
    if (!fits) break;
    dyd_ring_gen(root, r, l);
    fmpz_mpoly_pow_ui(root, root, (ulong)rest, r->ctx);
    fmpz_mpoly_mul(x, x, root, r->ctx);
  }
  fmpz_mpoly_scalar_mul_fmpz(x, x, factor, r->ctx);
  fmpz_mpoly_clear(root, r->ctx);
  return fits;
}

/* The same; what the base does not know is put into it. */
static bool radical_of_integer(fmpz_mpoly_t x, dyd_ring *r, dyd_op op, const fmpz_t of, slong k) {
  if (fmpz_bits(of) > DYD_RING_BASE_BITS) return false;
  DYD_LOCAL_NUMBERS(fmpz, n);
  fmpz_set(n, of);
  bool fits = radical_over_base(x, r, op, n, k);
  if (!fmpz_is_one(n)) {
    fits = false;
    if (r->bases < MOST_BASES && base_append(r, n)) {
      base_refine(r);
      r->stale = true;
    }
  }
  return fits;
}

/* ---- of anything ---- */

/* The leaf for the k-th root of the polynomial `key`. */
static slong nested_leaf(dyd_ring *r, dyd_op op, const fmpz_mpoly_t key, slong k) {
  for (slong l = 0; l < r->leaves; l++)
    if (r->leaf[l].kind == DYD_LEAF_NESTED && r->leaf[l].op == op && fmpz_mpoly_equal(r->leaf[l].key.num, key, r->ctx))
      return l;
  slong l = dyd_ring_add_leaf(r, DYD_LEAF_NESTED, op);
  if (l < 0) return l;
  dyd_leaf *leaf = &r->leaf[l];
  fmpz_mpoly_set(leaf->key.num, key, r->ctx);
  dyd_ring_gen(leaf->relation, r, l);
  fmpz_mpoly_pow_ui(leaf->relation, leaf->relation, (ulong)k, r->ctx);
  fmpz_mpoly_sub(leaf->relation, leaf->relation, key, r->ctx);
  leaf->degree = k;
  leaf->whole = dyd_ring_is_whole(r, key);
  if (!leaf->whole) return l;
  dyd_ring_bound(leaf->bound, r, key);
  mag_root(leaf->bound, leaf->bound, (ulong)k);
  return l;
}

/* x->num = the root of key, a polynomial that is not constant. */
static bool radical_of_polynomial(dyd_fraction *x, dyd_ring *r, dyd_op op, fmpz_mpoly_t key, slong k) {
  bool negative = op == DYD_OP_CBRT && fmpz_sgn(key->coeffs) < 0;
  DYD_LOCAL_NUMBERS(fmpz, factor);
  _fmpz_vec_content(factor, key->coeffs, key->length);
  fmpz_mpoly_scalar_divexact_fmpz(key, key, factor, r->ctx);
  if (negative) fmpz_mpoly_neg(key, key, r->ctx);
  bool fits = radical_of_integer(x->num, r, op, factor, k);
  slong l = nested_leaf(r, op, key, k);
  fits = fits && l >= 0;
  if (fits) {
    dyd_ring_gen(key, r, l);
    fmpz_mpoly_mul(x->num, x->num, key, r->ctx);
    if (negative) fmpz_mpoly_neg(x->num, x->num, r->ctx);
  }
  return fits;
}

/* The same for an integer that is not 0; square roots are of positive ones. */
static bool radical_of_number(dyd_fraction *x, dyd_ring *r, dyd_op op, fmpz_mpoly_t key, slong k) {
  DYD_LOCAL_NUMBERS(fmpz, n);
  fmpz_mpoly_get_fmpz(n, key, r->ctx);
  bool negative = fmpz_sgn(n) < 0;
  fmpz_abs(n, n);
  bool fits = !(negative && op == DYD_OP_SQRT) && radical_of_integer(x->num, r, op, n, k);
  if (fits && negative) fmpz_mpoly_neg(x->num, x->num, r->ctx);
  return fits;
}

bool dyd_leaf_radical(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u) {
  slong k = op == DYD_OP_SQRT ? 2 : 3;
  fmpz_mpoly_t key;
  if (fmpz_mpoly_is_zero(u->num, r->ctx)) {
    dyd_fraction_set(x, u, r);
    return true;
  }
  if (!fmpz_mpoly_is_fmpz(u->den, r->ctx)) return dyd_leaf_free(x, r, op, u, DYD_NONE);
  fmpz_mpoly_init(key, r->ctx);
  fmpz_mpoly_scalar_mul_fmpz(key, u->num, u->den->coeffs, r->ctx);
  if (k == 3) fmpz_mpoly_scalar_mul_fmpz(key, key, u->den->coeffs, r->ctx);
  fmpz_mpoly_set(x->den, u->den, r->ctx);
  bool fits =
      fmpz_mpoly_is_fmpz(key, r->ctx) ? radical_of_number(x, r, op, key, k) : radical_of_polynomial(x, r, op, key, k);
  if (fits) dyd_fraction_lowest(x, r);
  fmpz_mpoly_clear(key, r->ctx);
  return fits;
}

/* Roots of polynomials as leaves.
 *
 * Of the polynomial only the irreducible factor counts that the root is a zero of: exactly one, since they are coprime.
 * Degree 1 gives a number, degree 2 a square root. Otherwise the leaf is t = a x, a the leading coefficient: a zero of
 * the monic integer polynomial a^(n-1) f(t / a). Two roots of one f of degree n are different or the same: distinct
 * ones are more than n^-(n+2)/2 |f|^-(n-1) apart (Mahler 1964, f without multiple zeros). */

/* Degree and bits up to which factors are searched for; bits of a relation; bits examined to distinguish roots. */
enum { FACTOR_DEGREE = 32, FACTOR_BITS = 4096, RELATION_BITS = 1 << 20, APART_BITS = 1 << 14 };

/* How many factors may vanish at x, and the last of them. */
static slong count_vanishing(slong *which, const fmpz_poly_factor_t list, const arb_t x, slong prec) {
  slong count = 0;
  DYD_LOCAL_NUMBERS(arb, y);
  for (slong k = 0; k < list->num; k++) {
    arb_fmpz_poly_evaluate_arb(y, list->p + k, x, prec);
    if (!arb_contains_zero(y)) continue;
    count++;
    *which = k;
  }
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
  DYD_LOCAL_NUMBERS(fmpz, minus);
  fmpz_neg(minus, fmpz_poly_get_coeff_ptr(f, 0));
  dyd_fraction_set_number(x, minus, fmpz_poly_get_coeff_ptr(f, 1), r);
  return true;
}

/* The sign of 2 a x + b at the root x; 0: not known. */
static int side_of_middle(dyd_ring *r, const fmpz_poly_t f, uint32_t node) {
  int sign = 0;
  DYD_LOCAL_NUMBERS(arb, y);
  for (slong prec = 128; prec <= APART_BITS && !sign; prec *= 2) {
    arb_mul_fmpz(y, dyd_forms_value(r->forms, node, prec), fmpz_poly_get_coeff_ptr(f, 2), prec);
    arb_mul_2exp_si(y, y, 1);
    arb_add_fmpz(y, y, fmpz_poly_get_coeff_ptr(f, 1), prec);
    if (!arb_contains_zero(y)) sign = arf_sgn(arb_midref(y));
  }
  return sign;
}

/* x = (-b + sign sqrt(b^2 - 4 a c)) / 2 a. */
static bool root_is_quadratic(dyd_fraction *x, dyd_ring *r, const fmpz_poly_t f, uint32_t node) {
  const fmpz *a = fmpz_poly_get_coeff_ptr(f, 2), *b = fmpz_poly_get_coeff_ptr(f, 1), *c = fmpz_poly_get_coeff_ptr(f, 0);
  int sign = side_of_middle(r, f, node);
  dyd_fraction u;
  DYD_LOCAL_NUMBERS(fmpz, t);
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
  return fits;
}

/* ---- leaves ---- */

/* Bits to which two roots of f have to agree in order to be the same; beyond APART_BITS: too many. */
static slong bits_apart(const fmpz_poly_t f) {
  slong n = fmpz_poly_degree(f), norm = FLINT_ABS(fmpz_poly_max_bits(f)) + (slong)FLINT_BIT_COUNT(n) / 2 + 1;
  return (n + 3) / 2 * (slong)FLINT_BIT_COUNT(n) + (n - 1) * norm + 2;
}

/* Returns true if the values of two forms, zeros of f, are the same. When in doubt they are not taken to be. */
static bool roots_are_same(dyd_ring *r, const fmpz_poly_t f, uint32_t a, uint32_t b) {
  slong bits = bits_apart(f);
  bool apart = a != b && bits > APART_BITS, same = a == b;
  DYD_LOCAL_NUMBERS(arb, d);
  DYD_LOCAL_NUMBERS(mag, most);
  for (slong prec = 64; !apart && !same; prec *= 2) {
    arb_set(d, dyd_forms_value(r->forms, a, prec));
    arb_sub(d, d, dyd_forms_value(r->forms, b, prec), prec + 64);
    arb_get_mag(most, d);
    apart = !arb_contains_zero(d) || prec > 4 * APART_BITS;
    same = !apart && mag_cmp_2exp_si(most, -bits) < 0;
  }
  return same;
}

/* relation = a^(n-1) f(t / a). */
static void monic_relation(fmpz_mpoly_t relation, const dyd_ring *r, const fmpz_poly_t f, slong l) {
  ulong exponent[DYD_RING_LEAVES] = {0};
  slong n = fmpz_poly_degree(f);
  fmpz_mpoly_struct *terms = relation;
  DYD_LOCAL_NUMBERS(fmpz, power);
  fmpz_set_ui(power, 1);
  DYD_LOCAL_NUMBERS(fmpz, c);
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
  DYD_LOCAL_NUMBERS(fmpz, bound);
  fmpz_poly_bound_roots(bound, f);
  fmpz_mul(bound, bound, leaf->base);
  mag_set_fmpz(leaf->bound, bound);
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
  DYD_LOCAL_NUMBERS(fmpz_poly, f);
  fmpz_poly_primitive_part(f, r->forms->node[node].root->poly);
  keep_own_factor(f, r, node);
  if (fmpz_sgn(fmpz_poly_lead(f)) < 0) fmpz_poly_neg(f, f);
  slong n = fmpz_poly_degree(f);
  return n == 1 ? root_is_number(x, r, f) : n == 2 ? root_is_quadratic(x, r, f, node) : root_is_leaf(x, r, f, node);
}

/* Cosines and sines, and free variables.
 *
 * Of a rational part t = k / N of the full turn: 2 cos(2 pi k / N) = C_k(c) for c = 2 cos(2 pi / N), where C_0 = 2,
 * C_1 = c, C_2k = C_k^2 - 2, C_2k+1 = C_k C_k+1 - c, reduced by the minimal polynomial of c, which is monic; all
 * conjugates of c are cosines doubled, at most 2. sin(2 pi t) = cos(2 pi (t - 1/4)). Of any other angle: two leaves
 * with s^2 + c^2 = 1, the same for the angle and its negative. */

/* ---- parts of the full turn ---- */

/* ---- free variables ---- */
static slong leaf_pi(const dyd_ring *r) {
  for (slong l = 0; l < r->leaves; l++)
    if (r->leaf[l].kind == DYD_LEAF_FREE && r->leaf[l].op == DYD_OP_PI) return l;
  return -1;
}

/* a = C_k, b = C_k+1. */
static void dickson_pair(fmpz_poly_t a, fmpz_poly_t b, const fmpz_poly_t minimal, const fmpz_poly_t c, ulong k) {
  DYD_LOCAL_NUMBERS(fmpz_poly, t);
  fmpz_poly_set_si(a, 2);
  fmpz_poly_set(b, c);
  for (int bit = (int)FLINT_BIT_COUNT(k) - 1; bit >= 0; bit--) {
    fmpz_poly_mul(t, a, b);
    fmpz_poly_sub(t, t, c);
    fmpz_poly_rem(t, t, minimal);
    fmpz_poly_struct *doubled = k >> bit & 1 ? b : a;
    fmpz_poly_sqr(doubled, doubled);
    fmpz_poly_sub_si(doubled, doubled, 2);
    fmpz_poly_rem(doubled, doubled, minimal);
    fmpz_poly_swap(k >> bit & 1 ? a : b, t);
  }
}

/* x = p(leaf l). */
static void polynomial_in_leaf(fmpz_mpoly_t x, const dyd_ring *r, const fmpz_poly_t p, slong l) {
  ulong exponent[DYD_RING_LEAVES] = {0};
  fmpz_mpoly_zero(x, r->ctx);
  for (slong e = fmpz_poly_degree(p); e >= 0; e--) {
    if (l >= 0) exponent[dyd_ring_var(r, l)] = (ulong)e;
    if (!fmpz_is_zero(fmpz_poly_get_coeff_ptr(p, e)))
      fmpz_mpoly_push_term_fmpz_ui(x, fmpz_poly_get_coeff_ptr(p, e), exponent, r->ctx);
  }
}

static slong cycle_leaf(dyd_ring *r) {
  for (slong l = 0; l < r->leaves; l++)
    if (r->leaf[l].kind == DYD_LEAF_CYCLE) return l;
  slong l = dyd_ring_add_leaf(r, DYD_LEAF_CYCLE, DYD_OP_COS);
  if (l < 0) return l;
  dyd_leaf *leaf = &r->leaf[l];
  polynomial_in_leaf(leaf->relation, r, r->minimal, l);
  leaf->degree = fmpz_poly_degree(r->minimal);
  leaf->whole = true;
  mag_set_ui(leaf->bound, 2);
  return l;
}

/* x = cos(2 pi k / order). */
static bool cosine_of_part(dyd_fraction *x, dyd_ring *r, ulong k) {
  bool fits = true;
  DYD_LOCAL_NUMBERS(fmpz_poly, c, a, b);
  fmpz_poly_set_coeff_ui(c, 1, 1);
  fmpz_poly_rem(c, c, r->minimal);
  dickson_pair(a, b, r->minimal, c, k);
  fmpz_poly_rem(a, a, r->minimal);
  slong l = fmpz_poly_degree(a) > 0 ? cycle_leaf(r) : -1;
  if (fmpz_poly_degree(a) > 0 && l < 0) fits = false;
  if (fits) {
    polynomial_in_leaf(x->num, r, a, l);
    fmpz_mpoly_set_ui(x->den, 2, r->ctx);
    dyd_fraction_lowest(x, r);
  }
  return fits;
}

/* Returns true if u is a rational multiple of pi. *turn = u / (2 pi). */
static bool part_of_turn(fmpq_t turn, const dyd_ring *r, const dyd_fraction *u) {
  slong pi = leaf_pi(r);
  fmpz_mpoly_t gen;
  if (fmpz_mpoly_is_zero(u->num, r->ctx)) {
    fmpq_zero(turn);
    return true;
  }
  if (pi < 0 || u->num->length != 1 || !fmpz_mpoly_is_fmpz(u->den, r->ctx)) return false;
  fmpz_mpoly_init(gen, r->ctx);
  dyd_ring_gen(gen, r, pi);
  fmpz_mpoly_scalar_mul_fmpz(gen, gen, u->num->coeffs, r->ctx);
  bool is = fmpz_mpoly_equal(gen, u->num, r->ctx);
  fmpz_mpoly_clear(gen, r->ctx);
  fmpq_set_fmpz_frac(turn, u->num->coeffs, u->den->coeffs);
  fmpq_div_2exp(turn, turn, 1);
  return is;
}

/* *k = turn N modulo N, if the order N suffices; otherwise it grows, or *far: it would be too large. */
static bool place_in_cycle(ulong *k, bool *far, dyd_ring *r, fmpq_t turn) {
  fmpz_mod(fmpq_numref(turn), fmpq_numref(turn), fmpq_denref(turn));
  *far = fmpz_cmp_ui(fmpq_denref(turn), DYD_RING_ORDER) > 0;
  if (*far) return false;
  ulong n = fmpz_get_ui(fmpq_denref(turn));
  ulong order = r->next_order / n_gcd(r->next_order, n) * n;
  *far = order > DYD_RING_ORDER;
  if (*far) return false;
  if (r->order % n == 0) {
    *k = fmpz_get_ui(fmpq_numref(turn)) * (r->order / n);
    return true;
  }
  r->next_order = order;
  r->stale = true;
  return false;
}

/* ---- other angles ---- */

/* The leaf of the cosine of u; the sine follows. */
static slong angle_leaf(dyd_ring *r, const dyd_fraction *u) {
  for (slong l = 0; l < r->leaves; l++)
    if (r->leaf[l].kind == DYD_LEAF_COS && dyd_fraction_equal(&r->leaf[l].key, u, r)) return l;
  slong c = dyd_ring_add_leaf(r, DYD_LEAF_COS, DYD_OP_COS), s = dyd_ring_add_leaf(r, DYD_LEAF_SIN, DYD_OP_SIN);
  if (c < 0 || s < 0) return -1;
  dyd_fraction_set(&r->leaf[c].key, u, r);
  fmpz_mpoly_t square;
  fmpz_mpoly_init(square, r->ctx);
  dyd_ring_gen(square, r, c);
  fmpz_mpoly_pow_ui(square, square, 2, r->ctx);
  fmpz_mpoly_struct *relation = r->leaf[s].relation;
  dyd_ring_gen(relation, r, s);
  fmpz_mpoly_pow_ui(relation, relation, 2, r->ctx);
  fmpz_mpoly_add(relation, relation, square, r->ctx);
  fmpz_mpoly_sub_ui(relation, relation, 1, r->ctx);
  r->leaf[s].degree = 2;
  fmpz_mpoly_clear(square, r->ctx);
  return c;
}

static bool cosine_of_angle(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u) {
  bool negative = dyd_fraction_leads_negative(u);
  dyd_fraction angle;
  DYD_LOCAL_NUMBERS(fmpz, one);
  fmpz_set_ui(one, 1);
  fmpz_mpoly_init(angle.num, r->ctx);
  fmpz_mpoly_init(angle.den, r->ctx);
  dyd_fraction_set(&angle, u, r);
  if (negative) fmpz_mpoly_neg(angle.num, angle.num, r->ctx);
  slong l = angle_leaf(r, &angle);
  if (l >= 0) dyd_fraction_set_leaf(x, op == DYD_OP_COS ? l : l + 1, one, r);
  if (negative && op == DYD_OP_SIN) fmpz_mpoly_neg(x->num, x->num, r->ctx);
  fmpz_mpoly_clear(angle.den, r->ctx);
  fmpz_mpoly_clear(angle.num, r->ctx);
  return l >= 0;
}

bool dyd_leaf_cosine(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u) {
  bool far = false, fits;
  ulong k;
  DYD_LOCAL_NUMBERS(fmpq, turn, quarter);
  fmpq_set_si(quarter, 1, 4);
  bool part = part_of_turn(turn, r, u);
  if (part && op == DYD_OP_SIN) fmpq_sub(turn, turn, quarter);
  if (part && place_in_cycle(&k, &far, r, turn))
    fits = cosine_of_part(x, r, k);
  else
    fits = (!part || far) && cosine_of_angle(x, r, op, u);
  return fits;
}

/* The leaf pi; -1: there is none yet. */
static bool is_free_leaf(const dyd_leaf *l, dyd_op op, const dyd_fraction *u, uint32_t node, const dyd_ring *r) {
  if (l->kind != DYD_LEAF_FREE || l->op != op || l->node != node) return false;
  return !u || dyd_fraction_equal(&l->key, u, r);
}

bool dyd_leaf_free(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u, uint32_t node) {
  slong l = 0;
  while (l < r->leaves && !is_free_leaf(&r->leaf[l], op, u, node, r)) l++;
  if (l == r->leaves) {
    l = dyd_ring_add_leaf(r, DYD_LEAF_FREE, op);
    if (l < 0) return false;
    r->leaf[l].node = node;
    if (u) dyd_fraction_set(&r->leaf[l].key, u, r);
  }
  DYD_LOCAL_NUMBERS(fmpz, one);
  fmpz_set_ui(one, 1);
  dyd_fraction_set_leaf(x, l, one, r);
  return true;
}
