/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cosines and sines, and free variables.
 *
 * Of a rational part t = k / N of the full turn: 2 cos(2 pi k / N) = C_k(c) for c = 2 cos(2 pi / N), where C_0 = 2,
 * C_1 = c, C_2k = C_k^2 - 2, C_2k+1 = C_k C_k+1 - c, reduced by the minimal polynomial of c, which is monic; all
 * conjugates of c are cosines doubled, at most 2. sin(2 pi t) = cos(2 pi (t - 1/4)). Of any other angle: two leaves
 * with s^2 + c^2 = 1, the same for the angle and its negative. */
#include "stream/algebra/leaves.h"

#include <flint/fmpq.h>

/* ---- parts of the full turn ---- */

/* a = C_k, b = C_k+1. */
static void dickson_pair(fmpz_poly_t a, fmpz_poly_t b, const fmpz_poly_t minimal, const fmpz_poly_t c, ulong k) {
  fmpz_poly_t t;
  fmpz_poly_init(t);
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
  fmpz_poly_clear(t);
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
  fmpz_poly_t c, a, b;
  bool fits = true;
  fmpz_poly_init(c);
  fmpz_poly_init(a);
  fmpz_poly_init(b);
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
  fmpz_poly_clear(b);
  fmpz_poly_clear(a);
  fmpz_poly_clear(c);
  return fits;
}

/* Is u a rational multiple of pi? *turn = u / (2 pi). */
static bool part_of_turn(fmpq_t turn, const dyd_ring *r, const dyd_fraction *u) {
  slong pi = dyd_leaf_pi(r);
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

static bool keys_are_equal(const dyd_leaf *l, dyd_leaf_kind kind, const dyd_fraction *u, const dyd_ring *r) {
  return l->kind == kind && dyd_fraction_equal(&l->key, u, r);
}

/* The leaf of the cosine of u; the sine follows. */
static slong angle_leaf(dyd_ring *r, const dyd_fraction *u) {
  for (slong l = 0; l < r->leaves; l++)
    if (keys_are_equal(&r->leaf[l], DYD_LEAF_COS, u, r)) return l;
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
  fmpz_t one;
  fmpz_init_set_ui(one, 1);
  fmpz_mpoly_init(angle.num, r->ctx);
  fmpz_mpoly_init(angle.den, r->ctx);
  dyd_fraction_set(&angle, u, r);
  if (negative) fmpz_mpoly_neg(angle.num, angle.num, r->ctx);
  slong l = angle_leaf(r, &angle);
  if (l >= 0) dyd_fraction_set_leaf(x, op == DYD_OP_COS ? l : l + 1, one, r);
  if (negative && op == DYD_OP_SIN) fmpz_mpoly_neg(x->num, x->num, r->ctx);
  fmpz_mpoly_clear(angle.den, r->ctx);
  fmpz_mpoly_clear(angle.num, r->ctx);
  fmpz_clear(one);
  return l >= 0;
}

bool dyd_leaf_cosine(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u) {
  fmpq_t turn, quarter;
  bool far = false, fits;
  ulong k;
  fmpq_init(turn);
  fmpq_init(quarter);
  fmpq_set_si(quarter, 1, 4);
  bool part = part_of_turn(turn, r, u);
  if (part && op == DYD_OP_SIN) fmpq_sub(turn, turn, quarter);
  if (part && place_in_cycle(&k, &far, r, turn))
    fits = cosine_of_part(x, r, k);
  else
    fits = (!part || far) && cosine_of_angle(x, r, op, u);
  fmpq_clear(quarter);
  fmpq_clear(turn);
  return fits;
}

/* ---- free variables ---- */

slong dyd_leaf_pi(const dyd_ring *r) {
  for (slong l = 0; l < r->leaves; l++)
    if (r->leaf[l].kind == DYD_LEAF_FREE && r->leaf[l].op == DYD_OP_PI) return l;
  return -1;
}

static bool is_free_leaf(const dyd_leaf *l, dyd_op op, const dyd_fraction *u, uint32_t node, const dyd_ring *r) {
  if (l->kind != DYD_LEAF_FREE || l->op != op || l->node != node) return false;
  return !u || dyd_fraction_equal(&l->key, u, r);
}

bool dyd_leaf_free(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u, uint32_t node) {
  slong l = 0;
  fmpz_t one;
  while (l < r->leaves && !is_free_leaf(&r->leaf[l], op, u, node, r)) l++;
  if (l == r->leaves) {
    l = dyd_ring_add_leaf(r, DYD_LEAF_FREE, op);
    if (l < 0) return false;
    r->leaf[l].node = node;
    if (u) dyd_fraction_set(&r->leaf[l].key, u, r);
  }
  fmpz_init_set_ui(one, 1);
  dyd_fraction_set_leaf(x, l, one, r);
  fmpz_clear(one);
  return true;
}
