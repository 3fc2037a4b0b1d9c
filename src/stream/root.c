/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Computable reals that are roots of polynomials with rational coefficients.
 *
 * [ROOT-2] The square-free factors f_i of p with p = c prod f_i^i: where p changes its sign, the product g of the
 * f_i with odd i changes it too, and conversely; g has simple roots only. So g replaces p from then on. */
#include "stream/root.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/local.h"
#include "base/parallel.h"
#include "stream/ball.h"
#include "stream/real.h"

#include <flint/fmpq.h>
#include <flint/fmpz_poly.h>
#include <flint/fmpz_poly_factor.h>
#include <stdlib.h>

/* Roots as values: made, copied, freed. */

void dyd_root_free(dyd_root *r) {
  if (!r) return;
  fmpz_poly_clear(r->poly);
  mpz_clear(r->slot);
  mpq_clears(r->lo, r->hi, NULL);
  free(r);
}

/* Of the polynomial p; to be freed. NULL: memory is exhausted. */
static dyd_root *root_alloc(const fmpz_poly_t p) {
  dyd_root *r = dyd_alloc(1, sizeof *r);
  if (!r) return NULL;
  *r = (dyd_root){.jump = 2};
  mpq_inits(r->lo, r->hi, NULL);
  mpz_init(r->slot);
  fmpz_poly_init(r->poly);
  fmpz_poly_set(r->poly, p);
  return r;
}

dyd_status dyd_root_copy(dyd_root **out, const dyd_root *r) {
  dyd_root *c = root_alloc(r->poly);
  if (!c) return DYD_E_NOMEM;
  mpq_set(c->lo, r->lo);
  mpq_set(c->hi, r->hi);
  mpz_set(c->slot, r->slot);
  c->on_grid = r->on_grid;
  c->exact = r->exact;
  c->isolated = r->isolated;
  c->sign_left = r->sign_left;
  c->s = r->s;
  c->jump = r->jump;
  *out = c;
  return DYD_OK;
}

/* Narrowing the bracket of a root by exact signs.
 *
 * [ROOT-1] Every bracket has opposite signs at its ends, so it holds a root (intermediate values). Signs come
 * from ball arithmetic at a precision that is doubled until the ball excludes 0 or is the exact number, so they
 * are exact. Three phases, of which the first two do not depend on the width asked for, so that it is always the
 * same root that is found:
 *   1. from the given ends to a slot (c, c+1) 2^-s;
 *   2. bisection until the derivative has no zero on the slot: exactly one, simple root is left;
 *   3. quadratic interval refinement (Abbott 2006): the secant through the ends proposes one of 2^j parts, two
 *      signs confirm or refute it; j doubles with each success and halves with each failure. */

static slong start_precision(mpz_srcptr m) {
  return 64 + (slong)mpz_sizeinbase(m, 2);
}

/* The exact sign at m 2^-s. */
static int root_sign_at(const dyd_root *r, mpz_srcptr m, int64_t s) {
  DYD_LOCAL_NUMBERS(arb, x, y);
  dyd_ball_set_z_2exp(x, m, (slong)-s);
  for (slong prec = start_precision(m);; prec *= 2) {
    arb_fmpz_poly_evaluate_arb(y, r->poly, x, prec);
    if (!arb_contains_zero(y) || arb_is_exact(y)) break;
  }
  return arf_sgn(arb_midref(y));
}

/* Makes m 2^-s the exact root when sign says so. */
static bool root_hit(dyd_root *r, int sign, mpz_srcptr m, int64_t s) {
  if (sign) return false;
  mpz_set(r->slot, m);
  r->s = s;
  r->on_grid = r->exact = true;
  return true;
}

/* q = floor or ceiling of x 2^s. */
static void to_grid(mpz_ptr q, mpq_srcptr x, int64_t s, dyd_round dir) {
  DYD_LOCAL_NUMBERS(mpq, t);
  if (s >= 0) {
    mpq_mul_2exp(t, x, (mp_bitcnt_t)s);
  } else {
    mpq_div_2exp(t, x, (mp_bitcnt_t)-s);
  }
  if (dir == DYD_UP) {
    mpz_cdiv_q(q, mpq_numref(t), mpq_denref(t));
  } else {
    mpz_fdiv_q(q, mpq_numref(t), mpq_denref(t));
  }
}

/* x = m 2^-s. */
static void from_grid(mpq_ptr x, mpz_srcptr m, int64_t s) {
  mpq_set_z(x, m);
  if (s >= 0) {
    mpq_div_2exp(x, x, (mp_bitcnt_t)s);
  } else {
    mpq_mul_2exp(x, x, (mp_bitcnt_t)-s);
  }
}

/* An s with 4 * 2^-s < hi - lo < 16 * 2^-s. */
static int64_t grid_for(const dyd_root *r) {
  DYD_LOCAL_NUMBERS(mpq, w);
  mpq_sub(w, r->hi, r->lo);
  return (int64_t)mpz_sizeinbase(mpq_denref(w), 2) - (int64_t)mpz_sizeinbase(mpq_numref(w), 2) + 3;
}

/* Between the grid points first < last lies the sign change: bisects the slots. */
static void root_choose_slot(dyd_root *r, mpz_ptr first, mpz_ptr last, int64_t s) {
  DYD_LOCAL_NUMBERS(mpz, middle);
  for (;;) {
    mpz_add(middle, first, last);
    mpz_fdiv_q_2exp(middle, middle, 1);
    if (mpz_cmp(middle, first) == 0) break;
    int sign = root_sign_at(r, middle, s);
    if (root_hit(r, sign, middle, s)) break;
    mpz_set(sign == r->sign_left ? first : last, middle);
  }
  if (!r->exact) {
    mpz_set(r->slot, first);
    r->s = s;
    r->on_grid = true;
  }
}

/* Phase 1. The bracket (lo,hi) has inner grid points first <= last; the sign change is left of first, right of last,
 * or between them. In the first two cases the bracket becomes four times narrower at least. */
static dyd_status root_enter_grid(dyd_root *r, dyd_error *err) {
  int64_t s = grid_for(r);
  if (s > DYD_EXP_LIMIT) {
    return dyd_fail(err, DYD_E_RANGE, "the root lies too close to an end of its interval; give another interval");
  }
  DYD_LOCAL_NUMBERS(mpz, first, last);
  to_grid(first, r->lo, s, DYD_UP);
  to_grid(last, r->hi, s, DYD_DOWN);
  int left = root_sign_at(r, first, s), right = root_sign_at(r, last, s);
  bool done = root_hit(r, left, first, s) || root_hit(r, right, last, s);
  if (!done && left != r->sign_left) {
    from_grid(r->hi, first, s);
  } else if (!done && right == r->sign_left) {
    from_grid(r->lo, last, s);
  } else if (!done) {
    root_choose_slot(r, first, last, s);
  }
  return DYD_OK;
}

/* Returns true if p' has no zero on the slot. */
static bool is_isolated(const dyd_root *r) {
  DYD_LOCAL_NUMBERS(fmpz_poly, d);
  DYD_LOCAL_NUMBERS(arb, x, y);
  fmpz_poly_derivative(d, r->poly);
  arf_set_mpz(arb_midref(x), r->slot);
  arb_mul_2exp_si(x, x, 1);
  arb_add_ui(x, x, 1, ARF_PREC_EXACT);
  mag_one(arb_radref(x));
  arb_mul_2exp_si(x, x, (slong)-r->s - 1);
  arb_fmpz_poly_evaluate_arb_horner(y, d, x, start_precision(r->slot));
  return !arb_contains_zero(y);
}

static void root_bisect(dyd_root *r) {
  DYD_LOCAL_NUMBERS(mpz, middle);
  mpz_mul_2exp(middle, r->slot, 1);
  mpz_add_ui(middle, middle, 1);
  int sign = root_sign_at(r, middle, r->s + 1);
  if (!root_hit(r, sign, middle, r->s + 1)) {
    mpz_sub_ui(r->slot, middle, sign == r->sign_left ? 0 : 1);
    r->s++;
  }
}

/* The secant's proposal m, 0 < m < 2^j, for the root at (slot 2^j + m) 2^-(s+j). Only a guess. */
static void root_propose(mpz_ptr m, const dyd_root *r, unsigned j) {
  DYD_LOCAL_NUMBERS(arb, x, a, b);
  slong prec = start_precision(r->slot) + 2 * (slong)j;
  dyd_ball_set_z_2exp(x, r->slot, (slong)-r->s);
  arb_fmpz_poly_evaluate_arb(a, r->poly, x, prec);
  dyd_ball_set_z_2exp(x, r->slot, 0);
  arb_add_ui(x, x, 1, ARF_PREC_EXACT);
  arb_mul_2exp_si(x, x, (slong)-r->s);
  arb_fmpz_poly_evaluate_arb(b, r->poly, x, prec);
  arb_sub(b, a, b, prec);
  arb_div(a, a, b, prec);
  mpz_set_ui(m, 0);
  if (arb_is_finite(a)) {
    DYD_LOCAL_NUMBERS(fmpz, f);
    arf_mul_2exp_si(arb_midref(a), arb_midref(a), (slong)j);
    if (arf_cmpabs_2exp_si(arb_midref(a), (slong)j + 1) < 0) arf_get_fmpz(f, arb_midref(a), ARF_RND_NEAR);
    fmpz_get_mpz(m, f);
  }
}

/* Holds m within 1 .. 2^j - 1. */
static void root_clamp(mpz_ptr m, unsigned j) {
  DYD_LOCAL_NUMBERS(mpz, most);
  mpz_set_ui(most, 1);
  mpz_mul_2exp(most, most, j);
  mpz_sub_ui(most, most, 1);
  if (mpz_sgn(m) <= 0) mpz_set_ui(m, 1);
  if (mpz_cmp(m, most) > 0) mpz_set(m, most);
}

/* Phase 3: tries the part next to the proposal. Returns false if it is refuted; r is unchanged then. */
static bool root_quadratic(dyd_root *r, unsigned j) {
  DYD_LOCAL_NUMBERS(mpz, m, base, other);
  root_propose(m, r, j);
  root_clamp(m, j);
  mpz_mul_2exp(base, r->slot, j);
  mpz_add(m, m, base);
  int64_t s = r->s + j;
  int sign = root_sign_at(r, m, s), next = sign;
  bool found = root_hit(r, sign, m, s);
  if (!found) {
    bool left = sign == r->sign_left; /* the root is to the right of m */
    if (left) {
      mpz_add_ui(other, m, 1);
    } else {
      mpz_sub_ui(other, m, 1);
    }
    next = root_sign_at(r, other, s);
    found = root_hit(r, next, other, s);
    if (!found && next != sign) {
      mpz_set(r->slot, left ? m : other);
      r->s = s;
      found = true;
    }
  }
  return found;
}

static void grid_step(dyd_root *r, int64_t target) {
  if (!r->isolated) {
    r->isolated = is_isolated(r);
    if (!r->isolated) root_bisect(r);
    return;
  }
  unsigned j = r->jump;
  if ((int64_t)j > target - r->s) j = target > r->s ? (unsigned)(target - r->s) : 1;
  if (j < 2) {
    root_bisect(r);
    if (r->jump < 2) r->jump = 2;
  } else if (root_quadratic(r, j)) {
    if (r->jump < 1u << 20) r->jump *= 2;
  } else {
    r->jump = j / 2;
  }
}

bool dyd_root_is_narrow(const dyd_root *r, int64_t bits) {
  if (r->on_grid) return r->exact || r->s >= bits;
  return grid_for(r) >= bits + 5;
}

static dyd_status root_step_now(dyd_root *r, int64_t target, dyd_error *err) {
  if (!r->on_grid) return root_enter_grid(r, err);
  if (!r->exact) grid_step(r, target);
  return DYD_OK;
}

/* ---- steps that may take long ---- */

/* Such a step is made on a copy, by a thread of its own. */
typedef struct root_errand {
  dyd_root *root;
  int64_t target;
  dyd_error err;
  dyd_status status;
} root_errand;

static void root_errand_run(void *job) {
  root_errand *e = job;
  e->status = root_step_now(e->root, e->target, &e->err);
  flint_cleanup(); /* the caches of this thread */
}

static void root_errand_drop(void *job) {
  root_errand *e = job;
  dyd_root_free(e->root);
  free(e);
}

/* Signs are found with at most as many bits as the degree times those of the place: from a million on, a step may take
 * a tenth of a second. */
static bool root_step_is_long(const dyd_root *r) {
  enum { LONG = 1 << 20 };
  size_t bits = r->jump + mpz_sizeinbase(r->slot, 2);
  if (!r->on_grid) bits = mpz_sizeinbase(mpq_numref(r->hi), 2) + mpz_sizeinbase(mpq_denref(r->hi), 2);
  return (size_t)fmpz_poly_length(r->poly) > LONG / bits;
}

dyd_status dyd_root_step(dyd_root *r, int64_t target, const volatile int *stop, dyd_error *err) {
  if (dyd_flag_is_set(stop)) return DYD_CANCELLED;
  root_errand *e = stop && root_step_is_long(r) ? malloc(sizeof *e) : NULL;
  if (!e) return root_step_now(r, target, err);
  *e = (root_errand){.target = target, .status = DYD_E_NOMEM};
  dyd_error_clear(&e->err);
  if (dyd_root_copy(&e->root, r) != DYD_OK) return free(e), dyd_fail_nomem(err);
  if (!dyd_run_detached(root_errand_run, root_errand_drop, e, stop)) return DYD_CANCELLED;
  dyd_root before = *r;
  dyd_status st = e->status;
  if (st != DYD_OK && err) *err = e->err;
  *r = *e->root;
  *e->root = before;
  root_errand_drop(e);
  return st;
}

static void root_release(void *user) {
  dyd_root_free(user);
}

/* The bracket as an interval. */
static dyd_status root_interval(dyd_interval *out, const dyd_root *r, int64_t bits) {
  if (!r->on_grid) return dyd_interval_set_outward(out, r->lo, r->hi, -bits - 2);
  DYD_LOCAL(dyd_dyadic, lo, hi);
  DYD_LOCAL_NUMBERS(mpz, next);
  mpz_add_ui(next, r->slot, r->exact ? 0 : 1);
  dyd_status st = dyd_dyadic_set_z_2exp(&lo, r->slot, -r->s);
  if (st == DYD_OK) st = dyd_dyadic_set_z_2exp(&hi, next, -r->s);
  return st == DYD_OK ? dyd_interval_set_ends(out, &lo, &hi) : st;
}

static dyd_status root_narrow(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_root *r = user;
  while (!dyd_root_is_narrow(r, request->bits)) {
    dyd_status st = dyd_root_step(r, request->bits, request->stop, err);
    if (st != DYD_OK) return st;
  }
  dyd_status st = root_interval(out, r, request->bits);
  if (st != DYD_OK) return dyd_fail(err, st, "the interval of a root: %s", dyd_status_text(st));
  return r->exact ? DYD_FIXED : DYD_OK;
}

/* p = the polynomial times the least common multiple of its denominators. */
static void integer_polynomial(fmpz_poly_t p, const mpq_t *coeff, size_t count) {
  DYD_LOCAL_NUMBERS(mpz, scale);
  mpz_set_ui(scale, 1);
  DYD_LOCAL_NUMBERS(mpz, c);
  DYD_LOCAL_NUMBERS(fmpz, f);
  for (size_t k = 0; k < count; k++) mpz_lcm(scale, scale, mpq_denref(coeff[k]));
  for (size_t k = count; k-- > 0;) {
    mpz_divexact(c, scale, mpq_denref(coeff[k]));
    mpz_mul(c, c, mpq_numref(coeff[k]));
    fmpz_set_mpz(f, c);
    fmpz_poly_set_coeff_fmpz(p, (slong)k, f);
  }
}

/* g = the part of p where its sign changes [ROOT-2]. */
static void odd_part(fmpz_poly_t g, const fmpz_poly_t p) {
  fmpz_poly_factor_t f;
  fmpz_poly_factor_init(f);
  fmpz_poly_factor_squarefree(f, p);
  fmpz_poly_one(g);
  for (slong i = 0; i < f->num; i++) {
    if (f->exp[i] % 2) fmpz_poly_mul(g, g, f->p + i);
  }
  fmpz_poly_factor_clear(f);
}

/* The exact sign at a rational. */
static int sign_at_q(const fmpz_poly_t p, const mpq_t x) {
  DYD_LOCAL_NUMBERS(fmpq, a, y);
  fmpq_set_mpq(a, x);
  fmpz_poly_evaluate_fmpq(y, p, a);
  return fmpq_sgn(y);
}

static dyd_status root_new(dyd_real **out, const fmpz_poly_t g, const mpq_t lo, const mpq_t hi) {
  dyd_root *r = root_alloc(g);
  if (!r) return DYD_E_NOMEM;
  r->sign_left = sign_at_q(g, lo);
  mpq_set(r->lo, lo);
  mpq_set(r->hi, hi);
  dyd_status st = dyd_real_new_enclosing(out, root_narrow, root_release, r);
  if (st == DYD_OK) dyd_real_set_object(*out, DYD_REAL_ROOT, r);
  return st;
}

/* The root -c0/c1 of a polynomial of degree one. */
static dyd_status linear_root(dyd_real **out, const fmpz_poly_t g) {
  DYD_LOCAL_NUMBERS(fmpq, f);
  DYD_LOCAL_NUMBERS(mpq, q);
  fmpq_set_fmpz_frac(f, fmpz_poly_get_coeff_ptr(g, 0), fmpz_poly_get_coeff_ptr(g, 1));
  fmpq_neg(f, f);
  fmpq_get_mpq(q, f);
  return dyd_real_from_q(out, q);
}

static dyd_status root_of_polynomial(dyd_real **out, const fmpz_poly_t p, const mpq_t lo, const mpq_t hi,
                                     dyd_error *err) {
  int left = sign_at_q(p, lo), right = sign_at_q(p, hi);
  if (!left) return dyd_real_from_q(out, lo);
  if (!right) return dyd_real_from_q(out, hi);
  if (left == right) {
    return dyd_fail(err, DYD_E_ARG,
                    "the polynomial is %s at both ends of the interval; give ends where its signs differ",
                    left < 0 ? "negative" : "positive");
  }
  DYD_LOCAL_NUMBERS(fmpz_poly, g);
  odd_part(g, p);
  return fmpz_poly_degree(g) == 1 ? linear_root(out, g) : root_new(out, g, lo, hi);
}

static size_t bits_of_rational(const mpq_t q) {
  return mpz_sizeinbase(mpq_numref(q), 2) + mpz_sizeinbase(mpq_denref(q), 2);
}

/* The bounds that keep every step cheap. */
static dyd_status root_check_size(const mpq_t *coeff, size_t count, const mpq_t lo, const mpq_t hi, dyd_error *err) {
  size_t most = bits_of_rational(lo) > bits_of_rational(hi) ? bits_of_rational(lo) : bits_of_rational(hi), sum = 0;
  for (size_t k = 0; k < count && k <= DYD_ROOT_DEGREE; k++) sum += bits_of_rational(coeff[k]);
  if (count <= DYD_ROOT_DEGREE + 1 && count * most <= DYD_ROOT_WORK && sum <= DYD_ROOT_WORK) return DYD_OK;
  return dyd_fail(err, DYD_E_RANGE, "the polynomial or its interval is too large: degree at most %zu, %zu bits in all",
                  DYD_ROOT_DEGREE, DYD_ROOT_WORK);
}

dyd_status dyd_real_root(dyd_real **out, const mpq_t *coeff, size_t count, const mpq_t lo, const mpq_t hi,
                         dyd_error *err) {
  while (count && !mpq_sgn(coeff[count - 1])) count--;
  if (!count)
    return dyd_fail(err, DYD_E_ARG, "the polynomial is zero everywhere; give one with a coefficient other than 0");
  if (mpq_cmp(lo, hi) > 0) return dyd_fail(err, DYD_E_ARG, "the interval is empty: its ends are in the wrong order");
  dyd_status st = root_check_size(coeff, count, lo, hi, err);
  if (st != DYD_OK) return st;
  DYD_LOCAL_NUMBERS(fmpz_poly, p);
  integer_polynomial(p, coeff, count);
  st = root_of_polynomial(out, p, lo, hi, err);
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (st == DYD_E_RANGE) return dyd_fail(err, st, "the root leaves the range of numbers; scale the input");
  return st;
}

/* Callbacks that are said to be roots of polynomials. */

/* p becomes (1 + x)^n p((lo + hi x) / (1 + x)) times a number: its positive zeros are those of p between lo and hi. */
static void zoom_in(fmpz_poly_t p, const mpq_t lo, const mpq_t hi) {
  slong n = fmpz_poly_degree(p);
  DYD_LOCAL_NUMBERS(mpz, den, z);
  DYD_LOCAL_NUMBERS(fmpz_poly, sum, near, far, power);
  mpz_lcm(den, mpq_denref(lo), mpq_denref(hi));
  for (int k = 0; k < 2; k++) { /* near = (lo + hi x) den, far = (1 + x) den */
    mpz_divexact(z, den, mpq_denref(k ? hi : lo));
    mpz_mul(z, z, mpq_numref(k ? hi : lo));
    DYD_LOCAL_NUMBERS(fmpz, c);
    fmpz_set_mpz(c, z);
    fmpz_poly_set_coeff_fmpz(near, k, c);
    fmpz_set_mpz(c, den);
    fmpz_poly_set_coeff_fmpz(far, k, c);
  }
  fmpz_poly_set_ui(power, 1); /* Horner's rule: the powers of far grow from the highest coefficient down */
  for (slong e = n; e >= 0; e--) {
    fmpz_poly_mul(sum, sum, near);
    fmpz_poly_scalar_addmul_fmpz(sum, power, fmpz_poly_get_coeff_ptr(p, e));
    fmpz_poly_mul(power, power, far);
  }
  fmpz_poly_swap(p, sum);
}

/* Returns true if the root lies alone in (lo, hi). Its polynomial has simple zeros and is not 0 at the ends; positive
 * zeros of q(x) are half the zeros of q(x^2). */
static bool root_is_alone(const dyd_root *r, const mpq_t lo, const mpq_t hi) {
  DYD_LOCAL_NUMBERS(fmpz_poly, p, squared);
  fmpz_poly_set(p, r->poly);
  zoom_in(p, lo, hi);
  fmpz_poly_inflate(squared, p, 2);
  slong roots = fmpz_poly_num_real_roots(squared);
  return roots == 2;
}

dyd_status dyd_real_claim_root(dyd_real *x, const mpq_t *coeff, size_t count, const mpq_t lo, const mpq_t hi,
                               dyd_error *err) {
  const void *object;
  dyd_real *root = NULL;
  if (!x || dyd_real_is_final(x) || dyd_real_object(&object, x) != DYD_REAL_OPAQUE)
    return dyd_fail(err, DYD_E_ARG,
                    "the real is exact, or no callback gives it, or it was claimed before: it cannot be "
                    "claimed to be a root");
  dyd_status st = dyd_real_root(&root, coeff, count, lo, hi, err);
  if (st != DYD_OK) return st;
  if (dyd_real_object(&object, root) == DYD_REAL_ROOT && !root_is_alone(object, lo, hi))
    st = dyd_fail(err, DYD_E_ARG, "the polynomial has several roots in the interval; give a shorter one");
  if (st == DYD_OK) st = dyd_real_set_claim(x, root, err);
  if (st != DYD_OK) dyd_real_free(root);
  return st;
}
