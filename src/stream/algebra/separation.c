/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Separation bounds [SEP-1].
 *
 * Leaves are algebraic integers with monic relations of degrees d_k, the coefficients polynomials in leaves before. Let
 * D be the product of the d_k of the leaves that P depends on, and U >= 1 a bound of |P| at all D choices of
 * conjugates. The product of T - P(choice) over all choices has integer coefficients, and the last one that is not 0 is
 * the product of all P(choice) that are not 0, up to sign: at least 1. So P = 0 or |P| >= U^-(D - 1).
 *
 * P is not multiplied out: U comes from bounds of its parts. Everything is rounded up. */
#include "stream/algebra/separation.h"

#include "stream/algebra/normal.h"
#include "stream/arb.h"

/* What is known of a form: its value is P / Q; num and den bound P and Q at all choices; whole: Q as an integer where
 * it is one, else 0; uses: the leaves of P and Q. */
typedef struct part {
  mag_t num, den;
  fmpz_t whole;
  bool uses[DYD_RING_LEAVES];
} part;

static void bound_init(part *p) {
  *p = (part){.uses = {false}};
  mag_init(p->num);
  mag_init(p->den);
  fmpz_init(p->whole);
}

static void bound_clear(part *p) {
  fmpz_clear(p->whole);
  mag_clear(p->den);
  mag_clear(p->num);
}

static void note_leaves(part *p, const dyd_ring *r, const fmpz_mpoly_t f) {
  slong degree[DYD_RING_LEAVES];
  if (fmpz_mpoly_is_zero(f, r->ctx)) return;
  fmpz_mpoly_degrees_si(degree, f, r->ctx);
  for (slong k = 0; k < r->leaves; k++) p->uses[k] = p->uses[k] || degree[dyd_ring_var(r, k)] > 0;
}

/* From the polynomials themselves. */
static bool part_of_fraction(part *p, const dyd_ring *r, const dyd_fraction *x) {
  if (!dyd_ring_is_whole(r, x->num) || !dyd_ring_is_whole(r, x->den)) return false;
  dyd_ring_bound(p->num, r, x->num);
  dyd_ring_bound(p->den, r, x->den);
  note_leaves(p, r, x->num);
  note_leaves(p, r, x->den);
  if (fmpz_mpoly_is_fmpz(x->den, r->ctx)) fmpz_set(p->whole, x->den->coeffs);
  return true;
}

static void part_multiply(part *p, const part *q) {
  mag_mul(p->num, p->num, q->num);
  mag_mul(p->den, p->den, q->den);
  fmpz_mul(p->whole, p->whole, q->whole);
}

/* Brings both to one denominator, the least one for integers, and adds. */
static void part_add(part *p, const part *q) {
  mag_t t;
  mag_init(t);
  if (!fmpz_is_zero(p->whole) && !fmpz_is_zero(q->whole)) {
    fmpz_t g;
    fmpz_init(g);
    fmpz_gcd(g, p->whole, q->whole);
    fmpz_divexact(g, q->whole, g); /* by which p is extended */
    mag_mul_fmpz(p->num, p->num, g);
    fmpz_mul(p->whole, p->whole, g);
    fmpz_divexact(g, p->whole, q->whole);
    mag_mul_fmpz(t, q->num, g);
    mag_set_fmpz(p->den, p->whole);
    fmpz_clear(g);
  } else {
    mag_mul(p->num, p->num, q->den);
    mag_mul(t, q->num, p->den);
    mag_mul(p->den, p->den, q->den);
    fmpz_zero(p->whole);
  }
  mag_add(p->num, p->num, t);
  mag_clear(t);
}

static bool part_of_form(part *p, dyd_ring *r, uint32_t n);

static bool part_of_operation(part *p, dyd_ring *r, const dyd_form *n) {
  part q;
  bound_init(&q);
  bool known = part_of_form(p, r, n->a) && part_of_form(&q, r, n->b);
  if (known && n->op == DYD_OP_MUL)
    part_multiply(p, &q);
  else if (known)
    part_add(p, &q);
  for (slong k = 0; k < DYD_RING_LEAVES; k++) p->uses[k] = p->uses[k] || q.uses[k];
  bound_clear(&q);
  return known;
}

/* From the fraction, where it has been made; sums and products of others are not multiplied out. */
static bool part_of_form(part *p, dyd_ring *r, uint32_t n) {
  const dyd_form form = r->forms->node[n];
  bool made = n < r->frac_cap && r->frac[n];
  bool open = form.op == DYD_OP_ADD || form.op == DYD_OP_SUB || form.op == DYD_OP_MUL;
  if (!made && open) return part_of_operation(p, r, &form);
  const dyd_fraction *x = dyd_ring_fraction(r, n);
  return x && part_of_fraction(p, r, x);
}

/* Leaves come after those that their relations are made of. */
static bool degree_of_tower(slong *degree, part *p, const dyd_ring *r) {
  *degree = 1;
  for (slong k = r->leaves - 1; k >= 0; k--) {
    const dyd_leaf *l = &r->leaf[k];
    if (!p->uses[k]) continue;
    if (!l->whole || !l->degree || *degree > WORD_MAX / 64 / l->degree) return false;
    *degree *= l->degree;
    note_leaves(p, r, l->relation);
  }
  return true;
}

/* out >= (degree - 1) log2 u; false: it is more than `most`. */
static bool bits_of_bound(slong *out, const mag_t u, slong degree, slong most) {
  arb_t x, two;
  arf_t upper;
  arb_init(x);
  arb_init(two);
  arf_init(upper);
  arf_set_mag(arb_midref(x), u);
  if (arf_cmp_si(arb_midref(x), 1) < 0) arb_one(x);
  arb_const_log2(two, 64);
  arb_log(x, x, 64);
  arb_div(x, x, two, 64);
  arb_mul_si(x, x, degree - 1, 64);
  arb_get_ubound_arf(upper, x, 64);
  bool small = arf_cmp_si(upper, most) <= 0;
  *out = small ? arf_get_si(upper, ARF_RND_CEIL) : most;
  arf_clear(upper);
  arb_clear(two);
  arb_clear(x);
  return small;
}

bool dyd_separation_find(dyd_separation *s, dyd_ring *r, uint32_t n, slong most) {
  part p;
  bound_init(&p);
  bool known = part_of_form(&p, r, n) && degree_of_tower(&s->degree, &p, r);
  known = known && bits_of_bound(&s->bits, p.num, s->degree, most);
  mag_set(s->den, p.den);
  bound_clear(&p);
  return known;
}
