/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Polynomials in the leaves of some forms, modulo relations that the true values of the leaves satisfy.
 *
 * Leaves are shared by value: square and cube roots of rational numbers are products of those of a coprime base; all
 * cosines and sines of rational multiples of pi are polynomials in one 2 cos(2 pi / N). A leaf that is known only by
 * its identity is a free variable. The relation of leaf k is monic in it, and its other coefficients are polynomials in
 * leaves before k: so leading monomials are powers of different variables, and reduced polynomials are unique. A
 * reduced polynomial that is 0 has the value 0 [IDN-1].
 *
 * A form is a fraction of two such polynomials; the true value of the denominator is not 0. */
#ifndef DYD_STREAM_ALGEBRA_RING_H
#define DYD_STREAM_ALGEBRA_RING_H

#include "stream/algebra/form.h"
#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_poly.h>

/* Leaves at most; N of 2 cos(2 pi / N) at most; bits of an element of the base; terms and bits of a product; terms
 * times terms of a reduction; bits of all that a reduction may write. */
#define DYD_RING_LEAVES ((slong)64)
#define DYD_RING_ORDER ((ulong)4096)
#define DYD_RING_BASE_BITS ((flint_bitcnt_t)1 << 14)
#define DYD_RING_TERMS ((slong)1 << 20)
#define DYD_RING_BITS ((slong)1 << 18)
#define DYD_RING_WORK ((slong)1 << 26)

typedef struct dyd_fraction {
  fmpz_mpoly_t num, den;
} dyd_fraction;

/* RADICAL: the op-th root of `base`; NESTED: that of key; CYCLE: 2 cos(2 pi / order); ROOT: leading coefficient times
 * the root of form `node`; COS, SIN: of the angle key / key_den; FREE: op of key / key_den, or form `node`. */
typedef enum dyd_leaf_kind {
  DYD_LEAF_RADICAL,
  DYD_LEAF_NESTED,
  DYD_LEAF_CYCLE,
  DYD_LEAF_ROOT,
  DYD_LEAF_COS,
  DYD_LEAF_SIN,
  DYD_LEAF_FREE
} dyd_leaf_kind;

/* Invariant: degree > 0: relation = x^degree + (lower powers of x, coefficients in leaves before); whole: an algebraic
 * integer, as are all its conjugates over those before; then bound is at least the absolute value of all of them. */
typedef struct dyd_leaf {
  dyd_leaf_kind kind;
  dyd_op op;
  uint32_t node;
  fmpz_t base;
  fmpz_mpoly_t relation;
  dyd_fraction key;
  slong degree;
  bool whole;
  mag_t bound;
} dyd_leaf;

/* stale: room, base or order had to grow: all fractions have to be made again. frac[n]: NULL: not yet made; `none`:
 * the form is unknown. Invariant: base is coprime, greater than 1, without perfect powers. */
typedef struct dyd_ring {
  dyd_forms *forms;
  fmpz_mpoly_ctx_t ctx;
  slong room;
  dyd_leaf *leaf;
  slong leaves;
  fmpz *base;
  slong bases, base_cap;
  ulong order, next_order; /* of the cycle: now, and as far as is known */
  fmpz_poly_t minimal;     /* of 2 cos(2 pi / order) */
  dyd_fraction **frac, *none;
  size_t frac_cap;
  bool stale, failed; /* failed: memory is exhausted */
} dyd_ring;

dyd_status dyd_ring_init(dyd_ring *r, dyd_forms *forms);
void dyd_ring_clear(dyd_ring *r);
/* Drops all leaves and fractions, and gives room for more leaves where these did not suffice. */
dyd_status dyd_ring_renew(dyd_ring *r);
/* Room for the fractions of all forms; false: memory is exhausted. */
bool dyd_ring_hold(dyd_ring *r);
/* 0 / 1; NULL: memory is exhausted, which the ring notes. */
dyd_fraction *dyd_fraction_new(dyd_ring *r);
void dyd_fraction_free(dyd_fraction *x, const dyd_ring *r);

/* Variable of leaf k: later leaves are greater. */
static inline slong dyd_ring_var(const dyd_ring *r, slong k) {
  return r->room - 1 - k;
}
/* A leaf for more; *leaf is {0} but for its polynomials, which are 0. -1: there is no room (stale, or the limit). */
slong dyd_ring_add_leaf(dyd_ring *r, dyd_leaf_kind kind, dyd_op op);
/* x = the leaf. */
void dyd_ring_gen(fmpz_mpoly_t x, const dyd_ring *r, slong k);
/* out >= |p| for all conjugates of its leaves, all of which are whole. */
void dyd_ring_bound(mag_t out, const dyd_ring *r, const fmpz_mpoly_t p);
/* Returns true if it is a polynomial in algebraic integers. */
bool dyd_ring_is_whole(const dyd_ring *r, const fmpz_mpoly_t p);

/* Fractions of polynomials in the leaves. */

void dyd_fraction_set(dyd_fraction *x, const dyd_fraction *y, const dyd_ring *r);
/* x = the rational number num / den, den != 0. */
void dyd_fraction_set_number(dyd_fraction *x, const fmpz_t num, const fmpz_t den, const dyd_ring *r);
/* x = leaf k / den, den > 0. */
void dyd_fraction_set_leaf(dyd_fraction *x, slong k, const fmpz_t den, const dyd_ring *r);
/* x = x op y, op one of + - * /; x = x^n. Operands may be the same. false: beyond the limits, or a division by a form
 * that is 0 or not proved different from 0; x is unspecified then. */
bool dyd_fraction_apply(dyd_fraction *x, dyd_op op, const dyd_fraction *y, const dyd_ring *r);
bool dyd_fraction_power(dyd_fraction *x, slong n, const dyd_ring *r);
/* Divides out common integer factors; the leading coefficient of the denominator becomes positive. */
void dyd_fraction_lowest(dyd_fraction *x, const dyd_ring *r);
bool dyd_fraction_equal(const dyd_fraction *x, const dyd_fraction *y, const dyd_ring *r);
/* Returns true if the leading coefficient of the numerator is negative. */
static inline bool dyd_fraction_leads_negative(const dyd_fraction *x) {
  return x->num->length && fmpz_sgn(x->num->coeffs) < 0;
}

#endif
