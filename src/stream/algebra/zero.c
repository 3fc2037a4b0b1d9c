/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The zero test, cheapest first: a ball at 128 bits; the separation bound where few bits do; the identity; the
 * separation bound up to the cap, doubling, and leaving as soon as the ball excludes 0. */
#include "stream/algebra/zero.h"

#include "base/flag.h"
#include "base/local.h"
#include "stream/algebra/leaves.h"
#include "stream/algebra/ring.h"
#include "stream/arb.h"

/* How small a value can be without being 0. */

/* For a form n with numerator P and denominator Q, polynomials in algebraic integers: P = 0 or |P| > 2^-bits, and
 * |Q| <= den. degree: of the product over all conjugates. */
typedef struct dyd_separation {
  slong bits, degree;
  mag_t den;
} dyd_separation;

/* Normal forms: arithmetic is done, functions become leaves or polynomials in leaves.
 *
 * Divisors are not 0, since what the forms describe is defined [ENC-1]. Where a sign has to be known it is read off a
 * ball; a function whose sign stays open is a free variable. */

/* Greatest exponent; bits examined for a sign. */
enum { MOST_EXPONENT = 1 << 12, SIGN_BITS = 1024 };

/* x = op of two other forms, by way of their fractions. */
static bool normal_arithmetic(dyd_fraction *x, dyd_ring *r, const dyd_form *n) {
  const dyd_fraction *a = dyd_ring_fraction(r, n->a), *b = dyd_ring_fraction(r, n->b);
  if (!a || !b) return false;
  dyd_fraction_set(x, a, r);
  return dyd_fraction_apply(x, (dyd_op)n->op, b, r);
}

/* The sign of a - b, or of a where b is DYD_NONE; 0: not known. */
static int sign_of_difference(dyd_ring *r, uint32_t a, uint32_t b) {
  int sign = 0;
  DYD_LOCAL_NUMBERS(arb, d);
  for (slong prec = 128; prec <= SIGN_BITS && !sign; prec *= 2) {
    arb_set(d, dyd_forms_value(r->forms, a, prec));
    if (b != DYD_NONE) arb_sub(d, d, dyd_forms_value(r->forms, b, prec), prec);
    if (!arb_contains_zero(d)) sign = arf_sgn(arb_midref(d));
  }
  return sign;
}

static bool normal_absolute(dyd_fraction *x, dyd_ring *r, const dyd_form *n) {
  const dyd_fraction *a = dyd_ring_fraction(r, n->a);
  if (!a) return false;
  int sign = fmpz_mpoly_is_zero(a->num, r->ctx) ? 1 : sign_of_difference(r, n->a, DYD_NONE);
  if (!sign) return dyd_leaf_free(x, r, DYD_OP_ABS, a, DYD_NONE);
  dyd_fraction_set(x, a, r);
  if (sign < 0) fmpz_mpoly_neg(x->num, x->num, r->ctx);
  return true;
}

/* The lesser or the greater of two; either, where they are the same. */
static bool normal_extreme(dyd_fraction *x, dyd_ring *r, const dyd_form *n, uint32_t self) {
  const dyd_fraction *a = dyd_ring_fraction(r, n->a), *b = dyd_ring_fraction(r, n->b);
  if (!a || !b) return false;
  int sign = dyd_fraction_equal(a, b, r) ? 1 : sign_of_difference(r, n->a, n->b);
  if (!sign) return dyd_leaf_free(x, r, DYD_OP_CONST, NULL, self);
  dyd_fraction_set(x, (sign > 0) == (n->op == DYD_OP_MAX) ? a : b, r);
  return true;
}

static bool normal_power(dyd_fraction *x, dyd_ring *r, const dyd_form *n, uint32_t self) {
  const dyd_fraction *a = dyd_ring_fraction(r, n->a);
  if (!a) return false;
  if (n->exponent > MOST_EXPONENT || n->exponent < -MOST_EXPONENT) return dyd_leaf_free(x, r, DYD_OP_CONST, NULL, self);
  dyd_fraction_set(x, a, r);
  return dyd_fraction_power(x, n->exponent, r);
}

/* x = exp(u), a leaf for one of u and -u. */
static bool normal_exponential(dyd_fraction *x, dyd_ring *r, const dyd_fraction *u) {
  dyd_fraction key;
  bool negative = dyd_fraction_leads_negative(u);
  fmpz_mpoly_init(key.num, r->ctx);
  fmpz_mpoly_init(key.den, r->ctx);
  dyd_fraction_set(&key, u, r);
  if (negative) fmpz_mpoly_neg(key.num, key.num, r->ctx);
  bool fits = true;
  if (fmpz_mpoly_is_zero(u->num, r->ctx)) {
    fmpz_mpoly_one(x->num, r->ctx);
    fmpz_mpoly_one(x->den, r->ctx);
  } else {
    fits = dyd_leaf_free(x, r, DYD_OP_EXP, &key, DYD_NONE) && (!negative || dyd_fraction_power(x, -1, r));
  }
  fmpz_mpoly_clear(key.den, r->ctx);
  fmpz_mpoly_clear(key.num, r->ctx);
  return fits;
}

/* sinh = (p - q) / 2, cosh = (p + q) / 2, tanh = (p - q) / (p + q) for p = exp(u), q = 1 / p. */
static bool normal_hyperbolic(dyd_fraction *x, dyd_ring *r, dyd_op op, const dyd_fraction *u) {
  dyd_fraction *p = dyd_fraction_new(r), *q = dyd_fraction_new(r);
  bool fits = p && q && normal_exponential(p, r, u);
  if (fits) {
    dyd_fraction_set(q, p, r);
    fits = dyd_fraction_power(q, -1, r);
  }
  if (fits) {
    dyd_fraction_set(x, p, r);
    fits = dyd_fraction_apply(x, op == DYD_OP_COSH ? DYD_OP_ADD : DYD_OP_SUB, q, r);
  }
  if (fits && op == DYD_OP_TANH) {
    fits = dyd_fraction_apply(p, DYD_OP_ADD, q, r) && dyd_fraction_apply(x, DYD_OP_DIV, p, r);
  } else if (fits) {
    fmpz_mpoly_scalar_mul_ui(x->den, x->den, 2, r->ctx);
    dyd_fraction_lowest(x, r);
  }
  dyd_fraction_free(q, r);
  dyd_fraction_free(p, r);
  return fits;
}

static bool normal_tangent(dyd_fraction *x, dyd_ring *r, const dyd_fraction *u) {
  dyd_fraction *c = dyd_fraction_new(r);
  /* both are examined, so that the order of the cycle grows at once */
  bool cosine = c && dyd_leaf_cosine(c, r, DYD_OP_COS, u), sine = dyd_leaf_cosine(x, r, DYD_OP_SIN, u);
  bool fits = cosine && sine && dyd_fraction_apply(x, DYD_OP_DIV, c, r);
  dyd_fraction_free(c, r);
  return fits;
}

/* Of an operation that is not listed, no more is known than that each form is one number. */
static bool normal_function(dyd_fraction *x, dyd_ring *r, const dyd_form *n, uint32_t self) {
  const dyd_fraction *u = dyd_ring_fraction(r, n->a);
  dyd_op op = (dyd_op)n->op;
  if (!u) return false;
  switch (n->op) {
  case DYD_FORM_CLAIM:
    dyd_fraction_set(x, u, r);
    return true;
  case DYD_OP_NEG:
    dyd_fraction_set(x, u, r);
    fmpz_mpoly_neg(x->num, x->num, r->ctx);
    return true;
  case DYD_OP_SQRT:
  case DYD_OP_CBRT:
    return dyd_leaf_radical(x, r, op, u);
  case DYD_OP_COS:
  case DYD_OP_SIN:
    return dyd_leaf_cosine(x, r, op, u);
  case DYD_OP_TAN:
    return normal_tangent(x, r, u);
  case DYD_OP_EXP:
    return normal_exponential(x, r, u);
  case DYD_OP_SINH:
  case DYD_OP_COSH:
  case DYD_OP_TANH:
    return normal_hyperbolic(x, r, op, u);
  case DYD_OP_LOG:
  case DYD_OP_ASIN:
  case DYD_OP_ACOS:
  case DYD_OP_ATAN:
    return dyd_leaf_free(x, r, op, u, DYD_NONE);
  default:
    return dyd_leaf_free(x, r, DYD_OP_CONST, NULL, self);
  }
}

static void normal_number(dyd_fraction *x, const dyd_ring *r, mpq_srcptr q) {
  DYD_LOCAL_NUMBERS(fmpz, num, den);
  fmpz_set_mpz(num, mpq_numref(q));
  fmpz_set_mpz(den, mpq_denref(q));
  dyd_fraction_set_number(x, num, den, r);
}

/* x = e, exp of 1. */
static bool normal_e(dyd_fraction *x, dyd_ring *r) {
  dyd_fraction *one = dyd_fraction_new(r);
  if (!one) return false;
  fmpz_mpoly_one(one->num, r->ctx);
  bool fits = normal_exponential(x, r, one);
  dyd_fraction_free(one, r);
  return fits;
}

static bool normal_make(dyd_fraction *x, dyd_ring *r, uint32_t self) {
  const dyd_form n = r->forms->node[self];
  switch (n.op) {
  case DYD_OP_CONST:
    normal_number(x, r, dyd_form_number(r->forms, self));
    return true;
  case DYD_OP_PI:
    return dyd_leaf_free(x, r, DYD_OP_PI, NULL, DYD_NONE);
  case DYD_OP_E:
    return normal_e(x, r);
  case DYD_FORM_ROOT:
    return dyd_leaf_root(x, r, self);
  case DYD_FORM_OPAQUE:
    return dyd_leaf_free(x, r, DYD_OP_CONST, NULL, self);
  case DYD_OP_POW:
    return normal_power(x, r, &n, self);
  case DYD_OP_ABS:
    return normal_absolute(x, r, &n);
  case DYD_OP_MIN:
  case DYD_OP_MAX:
    return normal_extreme(x, r, &n, self);
  case DYD_OP_ADD:
  case DYD_OP_SUB:
  case DYD_OP_MUL:
  case DYD_OP_DIV:
    return normal_arithmetic(x, r, &n);
  default:
    return normal_function(x, r, &n, self);
  }
}

static dyd_fraction *normal_form(dyd_ring *r, uint32_t n) {
  dyd_fraction *x = dyd_fraction_new(r);
  if (!x || normal_make(x, r, n)) return x;
  dyd_fraction_free(x, r);
  return NULL;
}

const dyd_fraction *dyd_ring_fraction(dyd_ring *r, uint32_t n) {
  if (dyd_flag_is_set(r->forms->stop)) {
    r->stale = true;
    return NULL;
  }
  if (!dyd_ring_hold(r)) {
    r->failed = true;
    return NULL;
  }
  if (!r->frac[n]) {
    dyd_fraction *made = normal_form(r, n);
    r->frac[n] = made ? made : r->none;
  }
  return r->frac[n] == r->none ? NULL : r->frac[n];
}

/* Room, base and order grow, each a few times at most. */
dyd_status dyd_ring_settle(dyd_ring *r, const uint32_t *node, size_t count) {
  enum { PASSES = 24 };
  for (int pass = 0; pass < PASSES; pass++) {
    r->stale = false;
    for (size_t k = 0; k < count; k++) dyd_ring_fraction(r, node[k]);
    if (r->failed) return DYD_E_NOMEM;
    if (!r->stale || dyd_flag_is_set(r->forms->stop)) return DYD_OK;
    dyd_status st = dyd_ring_renew(r);
    if (st != DYD_OK) return st;
  }
  return DYD_OK;
}

/* Separation bounds [SEP-1].
 *
 * Leaves are algebraic integers with monic relations of degrees d_k, the coefficients polynomials in leaves before. Let
 * D be the product of the d_k of the leaves that P depends on, and U >= 1 a bound of |P| at all D choices of
 * conjugates. The product of T - P(choice) over all choices has integer coefficients, and the last one that is not 0 is
 * the product of all P(choice) that are not 0, up to sign: at least 1. So P = 0 or |P| >= U^-(D - 1).
 *
 * P is not multiplied out: U comes from bounds of its parts. Everything is rounded up. */

/* Facts about a form: its value is P / Q; num and den bound P and Q at all choices; whole: Q as an integer where
 * it is one, else 0; uses: the leaves of P and Q. */
typedef struct form_bounds {
  mag_t num, den;
  fmpz_t whole;
  bool uses[DYD_RING_LEAVES];
} form_bounds;

static void bound_init(form_bounds *p) {
  *p = (form_bounds){.uses = {false}};
  mag_init(p->num);
  mag_init(p->den);
  fmpz_init(p->whole);
}

static void bound_clear(form_bounds *p) {
  fmpz_clear(p->whole);
  mag_clear(p->den);
  mag_clear(p->num);
}

static void note_leaves(form_bounds *p, const dyd_ring *r, const fmpz_mpoly_t f) {
  slong degree[DYD_RING_LEAVES];
  if (fmpz_mpoly_is_zero(f, r->ctx)) return;
  fmpz_mpoly_degrees_si(degree, f, r->ctx);
  for (slong k = 0; k < r->leaves; k++) p->uses[k] = p->uses[k] || degree[dyd_ring_var(r, k)] > 0;
}

/* From the polynomials themselves. */
static bool part_of_fraction(form_bounds *p, const dyd_ring *r, const dyd_fraction *x) {
  if (!dyd_ring_is_whole(r, x->num) || !dyd_ring_is_whole(r, x->den)) return false;
  dyd_ring_bound(p->num, r, x->num);
  dyd_ring_bound(p->den, r, x->den);
  note_leaves(p, r, x->num);
  note_leaves(p, r, x->den);
  if (fmpz_mpoly_is_fmpz(x->den, r->ctx)) fmpz_set(p->whole, x->den->coeffs);
  return true;
}

static void part_multiply(form_bounds *p, const form_bounds *q) {
  mag_mul(p->num, p->num, q->num);
  mag_mul(p->den, p->den, q->den);
  fmpz_mul(p->whole, p->whole, q->whole);
}

/* Brings both to one denominator, the least one for integers, and adds. */
static void part_add(form_bounds *p, const form_bounds *q) {
  DYD_LOCAL_NUMBERS(mag, t);
  if (!fmpz_is_zero(p->whole) && !fmpz_is_zero(q->whole)) {
    DYD_LOCAL_NUMBERS(fmpz, g);
    fmpz_gcd(g, p->whole, q->whole);
    fmpz_divexact(g, q->whole, g); /* by which p is extended */
    mag_mul_fmpz(p->num, p->num, g);
    fmpz_mul(p->whole, p->whole, g);
    fmpz_divexact(g, p->whole, q->whole);
    mag_mul_fmpz(t, q->num, g);
    mag_set_fmpz(p->den, p->whole);
  } else {
    mag_mul(p->num, p->num, q->den);
    mag_mul(t, q->num, p->den);
    mag_mul(p->den, p->den, q->den);
    fmpz_zero(p->whole);
  }
  mag_add(p->num, p->num, t);
}

static bool part_of_form(form_bounds *p, dyd_ring *r, uint32_t n);

static bool part_of_operation(form_bounds *p, dyd_ring *r, const dyd_form *n) {
  form_bounds q;
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
static bool part_of_form(form_bounds *p, dyd_ring *r, uint32_t n) {
  const dyd_form form = r->forms->node[n];
  bool made = n < r->frac_cap && r->frac[n];
  bool open = form.op == DYD_OP_ADD || form.op == DYD_OP_SUB || form.op == DYD_OP_MUL;
  if (!made && open) return part_of_operation(p, r, &form);
  const dyd_fraction *x = dyd_ring_fraction(r, n);
  return x && part_of_fraction(p, r, x);
}

/* Leaves come after the ones in their relations. */
static bool degree_of_tower(slong *degree, form_bounds *p, const dyd_ring *r) {
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
  DYD_LOCAL_NUMBERS(arb, x, two);
  DYD_LOCAL_NUMBERS(arf, upper);
  arf_set_mag(arb_midref(x), u);
  if (arf_cmp_si(arb_midref(x), 1) < 0) arb_one(x);
  arb_const_log2(two, 64);
  arb_log(x, x, 64);
  arb_div(x, x, two, 64);
  arb_mul_si(x, x, degree - 1, 64);
  arb_get_ubound_arf(upper, x, 64);
  bool small = arf_cmp_si(upper, most) <= 0;
  *out = small ? arf_get_si(upper, ARF_RND_CEIL) : most;
  return small;
}

/* s->den is initialised. false: there is no such bound, or it is beyond `most` bits. */
static bool separation_find(dyd_separation *s, dyd_ring *r, uint32_t n, slong most) {
  form_bounds p;
  bound_init(&p);
  bool known = part_of_form(&p, r, n) && degree_of_tower(&s->degree, &p, r);
  known = known && bits_of_bound(&s->bits, p.num, s->degree, most);
  mag_set(s->den, p.den);
  bound_clear(&p);
  return known;
}

enum { FIRST_BITS = DYD_ZERO_FIRST_BITS, FEW_BITS = 4096 };

dyd_status dyd_algebra_open(dyd_algebra *a, int64_t most_bits, const volatile int *cancel) {
  *a = (dyd_algebra){.most = (slong)most_bits, .cancel = cancel};
  dyd_forms_init(&a->forms);
  a->forms.stop = cancel;
  return dyd_ring_init(&a->ring, &a->forms);
}

void dyd_algebra_close(dyd_algebra *a) {
  dyd_ring_clear(&a->ring);
  dyd_forms_clear(&a->forms);
}

dyd_status dyd_algebra_settle(dyd_algebra *a, const uint32_t *node, size_t count) {
  dyd_status st = dyd_ring_settle(&a->ring, node, count);
  a->settled = st == DYD_OK && !a->ring.stale;
  return st;
}

/* The value to `prec` bits: is 0 excluded? */
static bool zero_is_excluded(dyd_algebra *a, uint32_t n, slong prec) {
  arb_srcptr x = dyd_forms_value(&a->forms, n, prec);
  if (prec > a->count.bits) a->count.bits = prec;
  if (arb_contains_zero(x)) return false;
  a->shown = prec;
  return true;
}

/* |P| = |value| |Q| < 2^-bits: then P = 0. */
static bool is_below_separation(dyd_algebra *a, uint32_t n, slong prec, const dyd_separation *s) {
  DYD_LOCAL_NUMBERS(mag, m);
  arb_get_mag(m, dyd_forms_value(&a->forms, n, prec));
  mag_mul(m, m, s->den);
  return mag_cmp_2exp_si(m, -s->bits) < 0;
}

/* Room for the values of all forms to `prec` bits, and for what functions compute with. */
static bool zero_has_room(const dyd_algebra *a, slong prec) {
  enum { FUNCTION = 32 };
  uint64_t bytes = dyd_bytes_times(a->forms.count + FUNCTION, (uint64_t)prec / 8);
  return !a->memory || dyd_memory_has(a->memory, bytes, "the proof of a tie");
}

/* Doubles the precision until the bound decides. Digits before the point are computed, too: twice the bits will do,
 * where the operations do not cancel much. */
static dyd_zero separate_from_zero(dyd_algebra *a, uint32_t n, const dyd_separation *s) {
  slong last = 2 * s->bits + 8 * FIRST_BITS;
  if (last > a->most + 8 * FIRST_BITS) last = a->most + 8 * FIRST_BITS;
  for (slong prec = FIRST_BITS; prec <= 2 * last; prec *= 2) {
    slong now = prec < last ? prec : last;
    if (dyd_flag_is_set(a->cancel) || !zero_has_room(a, now)) return DYD_ZERO_UNKNOWN;
    if (zero_is_excluded(a, n, now)) return DYD_ZERO_REFUTED;
    if (is_below_separation(a, n, now, s)) return DYD_ZERO_PROVED;
  }
  return DYD_ZERO_UNKNOWN;
}

static dyd_zero test_by_bound(dyd_algebra *a, uint32_t n, slong most) {
  dyd_separation s = {.degree = 0};
  dyd_zero zero = DYD_ZERO_UNKNOWN;
  mag_init(s.den);
  if (most > a->most) most = a->most;
  if (separation_find(&s, &a->ring, n, most)) {
    zero = separate_from_zero(a, n, &s);
    if (s.degree > a->count.degree) a->count.degree = s.degree;
    a->count.by_bound += zero == DYD_ZERO_PROVED;
  }
  mag_clear(s.den);
  return zero;
}

static dyd_zero test_by_identity(dyd_algebra *a, uint32_t n) {
  const dyd_fraction *x = dyd_ring_fraction(&a->ring, n);
  if (!x || !fmpz_mpoly_is_zero(x->num, a->ring.ctx)) return DYD_ZERO_UNKNOWN;
  a->count.by_identity++;
  return DYD_ZERO_PROVED;
}

bool dyd_algebra_is_refuted(dyd_algebra *a, uint32_t n) {
  if (n == DYD_NONE || !zero_is_excluded(a, n, FIRST_BITS)) return false;
  a->count.tests++;
  a->count.nonzero++;
  return true;
}

bool dyd_algebra_is_nonzero(dyd_algebra *a, uint32_t n) {
  for (slong prec = FIRST_BITS; n != DYD_NONE && prec <= FEW_BITS && prec <= a->most; prec *= 2)
    if (zero_is_excluded(a, n, prec)) return true;
  return false;
}

int64_t dyd_algebra_smallness(dyd_algebra *a, uint32_t n, slong prec) {
  int64_t e = INT64_MAX;
  if (n == DYD_NONE) return e;
  DYD_LOCAL_NUMBERS(arf, least);
  arb_get_abs_lbound_arf(least, dyd_forms_value(&a->forms, n, prec), prec);
  /* balls have exponents of limited size (dyd_ball_check) */
  if (arf_is_finite(least) && arf_sgn(least) > 0) e = 1 - (int64_t)fmpz_get_si(ARF_EXPREF(least));
  return e;
}

dyd_zero dyd_algebra_test(dyd_algebra *a, uint32_t n) {
  dyd_zero zero = DYD_ZERO_UNKNOWN;
  a->count.tests++;
  if (n != DYD_NONE && zero_is_excluded(a, n, FIRST_BITS)) zero = DYD_ZERO_REFUTED;
  if (n != DYD_NONE && a->settled) {
    if (!zero) zero = test_by_bound(a, n, FEW_BITS);
    if (!zero) zero = test_by_identity(a, n);
    if (!zero) zero = test_by_bound(a, n, a->most);
  }
  /* without a bound the value may still show that it is not 0 */
  if (!zero && dyd_algebra_is_nonzero(a, n)) zero = DYD_ZERO_REFUTED;
  a->count.nonzero += zero == DYD_ZERO_REFUTED;
  a->count.unknown += zero == DYD_ZERO_UNKNOWN;
  return zero;
}
