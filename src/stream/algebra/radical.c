/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Square and cube roots.
 *
 * A root of a rational number m / d is that of m d^(k-1), divided by d; that integer is a product of powers of the
 * base, so its root is an integer times roots of elements of the base. A root of anything else is a leaf of its own;
 * integer factors of the radicand are taken out first, so that equal radicals are seen to be equal. */
#include "stream/algebra/leaves.h"

#include "base/alloc.h"

enum { MOST_BASES = 64 };

/* ---- the base ---- */

/* n becomes the root of which it is a power. */
static void strip_powers(fmpz_t n) {
  fmpz_t root;
  fmpz_init(root);
  while (fmpz_cmp_ui(n, 1) > 0 && fmpz_is_perfect_power(root, n)) fmpz_swap(n, root);
  fmpz_clear(root);
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

/* Makes the elements from `from` on coprime to all others: what two have in common becomes an element of its own. The
 * product of all elements shrinks with every split. */
static void base_refine(dyd_ring *r) {
  fmpz_t g;
  fmpz_init(g);
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
  fmpz_clear(g);
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

/* x = the k-th root of n > 0, an integer; n becomes what the base does not know. */
static bool radical_over_base(fmpz_mpoly_t x, dyd_ring *r, dyd_op op, fmpz_t n, slong k) {
  bool fits = true;
  fmpz_t factor, power;
  fmpz_mpoly_t root;
  fmpz_init_set_ui(factor, 1);
  fmpz_init(power);
  fmpz_mpoly_init(root, r->ctx);
  fmpz_mpoly_one(x, r->ctx);
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
  fmpz_clear(power);
  fmpz_clear(factor);
  return fits;
}

/* The same; what the base does not know is put into it. */
static bool radical_of_integer(fmpz_mpoly_t x, dyd_ring *r, dyd_op op, const fmpz_t of, slong k) {
  fmpz_t n;
  if (fmpz_bits(of) > DYD_RING_BASE_BITS) return false;
  fmpz_init_set(n, of);
  bool fits = radical_over_base(x, r, op, n, k);
  if (!fmpz_is_one(n)) {
    fits = false;
    if (r->bases < MOST_BASES && base_append(r, n)) {
      base_refine(r);
      r->stale = true;
    }
  }
  fmpz_clear(n);
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

/* x->num = the root of key, a polynomial that is no number and not 0. */
static bool radical_of_polynomial(dyd_fraction *x, dyd_ring *r, dyd_op op, fmpz_mpoly_t key, slong k) {
  fmpz_t factor;
  bool negative = op == DYD_OP_CBRT && fmpz_sgn(key->coeffs) < 0;
  fmpz_init(factor);
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
  fmpz_clear(factor);
  return fits;
}

/* The same for an integer that is not 0; square roots are of positive ones. */
static bool radical_of_number(dyd_fraction *x, dyd_ring *r, dyd_op op, fmpz_mpoly_t key, slong k) {
  fmpz_t n;
  fmpz_init(n);
  fmpz_mpoly_get_fmpz(n, key, r->ctx);
  bool negative = fmpz_sgn(n) < 0;
  fmpz_abs(n, n);
  bool fits = !(negative && op == DYD_OP_SQRT) && radical_of_integer(x->num, r, op, n, k);
  if (fits && negative) fmpz_mpoly_neg(x->num, x->num, r->ctx);
  fmpz_clear(n);
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
