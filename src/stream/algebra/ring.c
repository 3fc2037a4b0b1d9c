/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The life of a ring, reduction, and bounds over all conjugates. */
#include "stream/algebra/ring.h"

#include "base/alloc.h"
#include "base/local.h"

#include <flint/fmpz_vec.h>
#include <string.h>

enum { FIRST_ROOM = 8 };

/* ---- life ---- */

dyd_fraction *dyd_fraction_new(dyd_ring *r) {
  dyd_fraction *x = dyd_alloc(1, sizeof *x);
  if (!x) {
    r->failed = true;
    return NULL;
  }
  fmpz_mpoly_init(x->num, r->ctx);
  fmpz_mpoly_init(x->den, r->ctx);
  fmpz_mpoly_one(x->den, r->ctx);
  return x;
}

void dyd_fraction_free(dyd_fraction *x, const dyd_ring *r) {
  if (!x) return;
  fmpz_mpoly_clear(x->num, r->ctx);
  fmpz_mpoly_clear(x->den, r->ctx);
  free(x);
}

static dyd_status ring_open(dyd_ring *r, slong room) {
  r->room = room;
  fmpz_mpoly_ctx_init(r->ctx, room, ORD_LEX);
  r->leaf = dyd_alloc((size_t)room, sizeof *r->leaf);
  r->leaves = 0;
  fmpz_poly_cos_minpoly(r->minimal, r->order);
  return r->leaf ? DYD_OK : DYD_E_NOMEM;
}

static void ring_drop_fractions(dyd_ring *r) {
  for (size_t n = 0; n < r->frac_cap; n++) {
    if (r->frac[n] != r->none) dyd_fraction_free(r->frac[n], r);
    r->frac[n] = NULL;
  }
}

static void leaf_clear(dyd_leaf *l, dyd_ring *r) {
  fmpz_clear(l->base);
  fmpz_mpoly_clear(l->relation, r->ctx);
  fmpz_mpoly_clear(l->key.num, r->ctx);
  fmpz_mpoly_clear(l->key.den, r->ctx);
  mag_clear(l->bound);
}

static void ring_close(dyd_ring *r) {
  ring_drop_fractions(r);
  for (slong k = 0; k < r->leaves; k++) leaf_clear(&r->leaf[k], r);
  free(r->leaf);
  r->leaf = NULL;
  r->leaves = 0;
  fmpz_mpoly_ctx_clear(r->ctx);
}

dyd_status dyd_ring_init(dyd_ring *r, dyd_forms *forms) {
  *r = (dyd_ring){.forms = forms, .order = 1, .next_order = 1};
  fmpz_poly_init(r->minimal);
  dyd_status st = ring_open(r, FIRST_ROOM);
  r->none = dyd_alloc(1, sizeof *r->none); /* an address, nothing else */
  if (st != DYD_OK || !r->none) {
    dyd_ring_clear(r);
    return DYD_E_NOMEM;
  }
  return DYD_OK;
}

void dyd_ring_clear(dyd_ring *r) {
  ring_close(r);
  for (slong k = 0; k < r->bases; k++) fmpz_clear(r->base + k);
  dyd_free_all(r->base, r->frac, r->none);
  fmpz_poly_clear(r->minimal);
}

/* ---- fractions of forms ---- */

bool dyd_ring_hold(dyd_ring *r) {
  size_t before = r->frac_cap;
  if (!DYD_GROW(r->frac, r->frac_cap, r->forms->count)) return false;
  if (r->frac_cap > before) memset(r->frac + before, 0, (r->frac_cap - before) * sizeof *r->frac);
  return true;
}

dyd_status dyd_ring_renew(dyd_ring *r) {
  slong room = r->leaves == r->room && r->room < DYD_RING_LEAVES ? 2 * r->room : r->room;
  ring_close(r);
  r->order = r->next_order;
  return ring_open(r, room);
}

/* ---- leaves ---- */

slong dyd_ring_add_leaf(dyd_ring *r, dyd_leaf_kind kind, dyd_op op) {
  if (r->leaves == r->room) {
    r->stale = r->stale || r->room < DYD_RING_LEAVES;
    return -1;
  }
  dyd_leaf *l = &r->leaf[r->leaves];
  memset(l, 0, sizeof *l);
  l->kind = kind;
  l->op = op;
  l->node = DYD_NONE;
  fmpz_init(l->base);
  fmpz_mpoly_init(l->relation, r->ctx);
  fmpz_mpoly_init(l->key.num, r->ctx);
  fmpz_mpoly_init(l->key.den, r->ctx);
  mag_init(l->bound);
  return r->leaves++;
}

void dyd_ring_gen(fmpz_mpoly_t x, const dyd_ring *r, slong k) {
  fmpz_mpoly_gen(x, dyd_ring_var(r, k), r->ctx);
}

/* ---- reduction ---- */

static slong bits_of(const fmpz_mpoly_t p) {
  return FLINT_ABS(fmpz_mpoly_max_bits(p));
}

/* Returns true if dividing p, of this degree in leaf k, by the relation stays within the limits. */
static bool reduction_fits(const dyd_ring *r, const fmpz_mpoly_t p, slong k, slong degree) {
  const fmpz_mpoly_struct *f = r->leaf[k].relation;
  slong steps = degree - r->leaf[k].degree + 1, bits = bits_of(p);
  if (p->length > DYD_RING_WORK / 16 / f->length || steps > DYD_RING_WORK / (bits_of(f) + 1)) return false;
  return steps * (bits_of(f) + 1) + bits <= DYD_RING_WORK / f->length;
}

/* *last: the last leaf of which p has a power that is to be replaced; -1: none. false: beyond the limits. */
static bool reduction_begin(slong *last, const dyd_ring *r, const fmpz_mpoly_t p) {
  slong degree[DYD_RING_LEAVES];
  *last = -1;
  if (fmpz_mpoly_is_zero(p, r->ctx)) return true;
  fmpz_mpoly_degrees_si(degree, p, r->ctx);
  for (slong k = 0; k < r->leaves; k++) {
    const dyd_leaf *l = &r->leaf[k];
    slong d = degree[dyd_ring_var(r, k)];
    if (!l->degree || d < l->degree) continue;
    if (!reduction_fits(r, p, k, d)) return false;
    *last = k;
  }
  return true;
}

/* p = p modulo the relations; x = a b. false: beyond the limits. */
static bool ring_reduce(fmpz_mpoly_t p, const dyd_ring *r) {
  fmpz_mpoly_struct quotient[DYD_RING_LEAVES], *q[DYD_RING_LEAVES], *f[DYD_RING_LEAVES];
  slong last, n = 0;
  if (!reduction_begin(&last, r, p)) return false;
  if (last < 0) return true;
  for (slong k = last; k >= 0; k--) {
    if (!r->leaf[k].degree) continue;
    fmpz_mpoly_init(&quotient[n], r->ctx);
    q[n] = &quotient[n];
    f[n++] = (fmpz_mpoly_struct *)r->leaf[k].relation; /* not changed */
  }
  fmpz_mpoly_divrem_ideal(q, p, p, f, n, r->ctx);
  for (slong k = 0; k < n; k++) fmpz_mpoly_clear(q[k], r->ctx);
  return p->length <= DYD_RING_TERMS && bits_of(p) <= DYD_RING_BITS;
}

static bool ring_mul(fmpz_mpoly_t x, const dyd_ring *r, const fmpz_mpoly_t a, const fmpz_mpoly_t b) {
  if (a->length && b->length > DYD_RING_TERMS / a->length) return false;
  if (bits_of(a) + bits_of(b) > DYD_RING_BITS) return false;
  fmpz_mpoly_mul(x, a, b, r->ctx);
  return ring_reduce(x, r);
}

/* ---- bounds ---- */

/* The absolute values of the terms at the bounds of the leaves, every step rounded up. */
void dyd_ring_bound(mag_t out, const dyd_ring *r, const fmpz_mpoly_t p) {
  ulong exponent[DYD_RING_LEAVES];
  DYD_LOCAL_NUMBERS(mag, term, power);
  mag_zero(out);
  for (slong t = 0; t < p->length; t++) {
    fmpz_mpoly_get_term_exp_ui(exponent, p, t, r->ctx);
    mag_set_fmpz(term, p->coeffs + t);
    for (slong k = 0; k < r->leaves; k++) {
      ulong e = exponent[dyd_ring_var(r, k)];
      if (!e) continue;
      mag_pow_ui(power, r->leaf[k].bound, e);
      mag_mul(term, term, power);
    }
    mag_add(out, out, term);
  }
}

bool dyd_ring_is_whole(const dyd_ring *r, const fmpz_mpoly_t p) {
  slong degree[DYD_RING_LEAVES];
  if (fmpz_mpoly_is_zero(p, r->ctx)) return true;
  fmpz_mpoly_degrees_si(degree, p, r->ctx);
  for (slong k = 0; k < r->leaves; k++)
    if (degree[dyd_ring_var(r, k)] > 0 && !r->leaf[k].whole) return false;
  return true;
}

/* Arithmetic of fractions. Numerators and denominators are reduced; integer factors are divided out, others are not. */

void dyd_fraction_set(dyd_fraction *x, const dyd_fraction *y, const dyd_ring *r) {
  fmpz_mpoly_set(x->num, y->num, r->ctx);
  fmpz_mpoly_set(x->den, y->den, r->ctx);
}

void dyd_fraction_set_number(dyd_fraction *x, const fmpz_t num, const fmpz_t den, const dyd_ring *r) {
  fmpz_mpoly_set_fmpz(x->num, num, r->ctx);
  fmpz_mpoly_set_fmpz(x->den, den, r->ctx);
  dyd_fraction_lowest(x, r);
}

void dyd_fraction_set_leaf(dyd_fraction *x, slong k, const fmpz_t den, const dyd_ring *r) {
  dyd_ring_gen(x->num, r, k);
  fmpz_mpoly_set_fmpz(x->den, den, r->ctx);
}

void dyd_fraction_lowest(dyd_fraction *x, const dyd_ring *r) {
  fmpz_mpoly_struct *num = x->num, *den = x->den;
  DYD_LOCAL_NUMBERS(fmpz, g, h);
  _fmpz_vec_content(g, num->coeffs, num->length);
  _fmpz_vec_content(h, den->coeffs, den->length);
  fmpz_gcd(g, g, h);
  if (den->length && fmpz_sgn(den->coeffs) < 0) fmpz_neg(g, g);
  if (!fmpz_is_one(g) && !fmpz_is_zero(g)) {
    fmpz_mpoly_scalar_divexact_fmpz(num, num, g, r->ctx);
    fmpz_mpoly_scalar_divexact_fmpz(den, den, g, r->ctx);
  }
}

/* The sum or difference of numerators brought to one denominator, the least for integers. */
static bool fraction_sum(dyd_fraction *x, bool minus, const dyd_fraction *y, const dyd_ring *r) {
  fmpz_mpoly_t t;
  bool fits = true;
  fmpz_mpoly_init(t, r->ctx);
  if (fmpz_mpoly_equal(x->den, y->den, r->ctx)) {
    fmpz_mpoly_set(t, y->num, r->ctx);
  } else if (fmpz_mpoly_is_fmpz(x->den, r->ctx) && fmpz_mpoly_is_fmpz(y->den, r->ctx)) {
    fmpz_t g, p, q; /* p = lcm / den(x), q = lcm / den(y) */
    fmpz_init(g);
    fmpz_init(p);
    fmpz_init(q);
    fmpz_gcd(g, x->den->coeffs, y->den->coeffs);
    fmpz_divexact(p, y->den->coeffs, g);
    fmpz_divexact(q, x->den->coeffs, g);
    fmpz_mpoly_scalar_mul_fmpz(x->num, x->num, p, r->ctx);
    fmpz_mpoly_scalar_mul_fmpz(x->den, x->den, p, r->ctx);
    fmpz_mpoly_scalar_mul_fmpz(t, y->num, q, r->ctx);
    fmpz_clear(q);
    fmpz_clear(p);
    fmpz_clear(g);
  } else {
    fits = ring_mul(t, r, y->num, x->den) && ring_mul(x->num, r, x->num, y->den) && ring_mul(x->den, r, x->den, y->den);
  }
  if (minus)
    fmpz_mpoly_sub(x->num, x->num, t, r->ctx);
  else
    fmpz_mpoly_add(x->num, x->num, t, r->ctx);
  fmpz_mpoly_clear(t, r->ctx);
  return fits;
}

bool dyd_fraction_apply(dyd_fraction *x, dyd_op op, const dyd_fraction *y, const dyd_ring *r) {
  bool fits;
  if (op == DYD_OP_ADD || op == DYD_OP_SUB) {
    fits = fraction_sum(x, op == DYD_OP_SUB, y, r);
  } else {
    bool divide = op == DYD_OP_DIV;
    fits = !divide || !fmpz_mpoly_is_zero(y->num, r->ctx);
    fmpz_mpoly_t t; /* x and y may be the same */
    fmpz_mpoly_init(t, r->ctx);
    fits = fits && ring_mul(t, r, x->num, divide ? y->den : y->num) &&
           ring_mul(x->den, r, x->den, divide ? y->num : y->den);
    fmpz_mpoly_swap(x->num, t, r->ctx);
    fmpz_mpoly_clear(t, r->ctx);
    fits = fits && !fmpz_mpoly_is_zero(x->den, r->ctx);
  }
  if (fits) dyd_fraction_lowest(x, r);
  return fits;
}

bool dyd_fraction_power(dyd_fraction *x, slong n, const dyd_ring *r) {
  dyd_fraction square = {0};
  if (n < 0) {
    fmpz_mpoly_swap(x->num, x->den, r->ctx);
    n = -n;
  }
  bool fits = !fmpz_mpoly_is_zero(x->den, r->ctx);
  fmpz_mpoly_init(square.num, r->ctx);
  fmpz_mpoly_init(square.den, r->ctx);
  dyd_fraction_set(&square, x, r);
  fmpz_mpoly_one(x->num, r->ctx);
  fmpz_mpoly_one(x->den, r->ctx);
  for (; fits && n; n >>= 1) {
    if (n & 1) fits = dyd_fraction_apply(x, DYD_OP_MUL, &square, r);
    if (fits && n > 1) fits = dyd_fraction_apply(&square, DYD_OP_MUL, &square, r);
  }
  fmpz_mpoly_clear(square.den, r->ctx);
  fmpz_mpoly_clear(square.num, r->ctx);
  if (fits) dyd_fraction_lowest(x, r);
  return fits;
}

bool dyd_fraction_equal(const dyd_fraction *x, const dyd_fraction *y, const dyd_ring *r) {
  return fmpz_mpoly_equal(x->num, y->num, r->ctx) && fmpz_mpoly_equal(x->den, y->den, r->ctx);
}
