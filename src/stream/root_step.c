/* SPDX-License-Identifier: LGPL-3.0-or-later */
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
#include "stream/ball.h"
#include "stream/root.h"

#include "base/error.h"
#include "base/flag.h"
#include "base/parallel.h"
#include <stdlib.h>

static void root_load(fmpz_poly_t p, const dyd_root *r) {
  fmpz_t c;
  fmpz_init(c);
  for (size_t k = r->count; k-- > 0;) {
    fmpz_set_mpz(c, r->coeff[k]);
    fmpz_poly_set_coeff_fmpz(p, (slong)k, c);
  }
  fmpz_clear(c);
}

static slong start_precision(mpz_srcptr m) {
  return 64 + (slong)mpz_sizeinbase(m, 2);
}

/* The exact sign at m 2^-s. */
static int root_sign_at(const fmpz_poly_t p, mpz_srcptr m, int64_t s) {
  arb_t x, y;
  arb_init(x);
  arb_init(y);
  dyd_ball_set_z_2exp(x, m, (slong)-s);
  for (slong prec = start_precision(m);; prec *= 2) {
    arb_fmpz_poly_evaluate_arb(y, p, x, prec);
    if (!arb_contains_zero(y) || arb_is_exact(y)) break;
  }
  int sign = arf_sgn(arb_midref(y));
  arb_clear(y);
  arb_clear(x);
  return sign;
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
  mpq_t t;
  mpq_init(t);
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
  mpq_clear(t);
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
  mpq_t w;
  mpq_init(w);
  mpq_sub(w, r->hi, r->lo);
  int64_t s = (int64_t)mpz_sizeinbase(mpq_denref(w), 2) - (int64_t)mpz_sizeinbase(mpq_numref(w), 2) + 3;
  mpq_clear(w);
  return s;
}

/* Between the grid points first < last lies the sign change: bisects the slots. */
static void root_choose_slot(dyd_root *r, const fmpz_poly_t p, mpz_ptr first, mpz_ptr last, int64_t s) {
  mpz_t middle;
  mpz_init(middle);
  for (;;) {
    mpz_add(middle, first, last);
    mpz_fdiv_q_2exp(middle, middle, 1);
    if (mpz_cmp(middle, first) == 0) break;
    int sign = root_sign_at(p, middle, s);
    if (root_hit(r, sign, middle, s)) break;
    mpz_set(sign == r->sign_left ? first : last, middle);
  }
  if (!r->exact) {
    mpz_set(r->slot, first);
    r->s = s;
    r->on_grid = true;
  }
  mpz_clear(middle);
}

/* Phase 1. The bracket (lo,hi) has inner grid points first <= last; the sign change is left of first, right of last,
 * or between them. In the first two cases the bracket becomes four times narrower at least. */
static dyd_status root_enter_grid(dyd_root *r, const fmpz_poly_t p, dyd_error *err) {
  int64_t s = grid_for(r);
  if (s > DYD_EXP_LIMIT) {
    return dyd_fail(err, DYD_E_RANGE, "the root lies too close to an end of its interval; give another interval");
  }
  mpz_t first, last;
  mpz_inits(first, last, NULL);
  to_grid(first, r->lo, s, DYD_UP);
  to_grid(last, r->hi, s, DYD_DOWN);
  int left = root_sign_at(p, first, s), right = root_sign_at(p, last, s);
  bool done = root_hit(r, left, first, s) || root_hit(r, right, last, s);
  if (!done && left != r->sign_left) {
    from_grid(r->hi, first, s);
  } else if (!done && right == r->sign_left) {
    from_grid(r->lo, last, s);
  } else if (!done) {
    root_choose_slot(r, p, first, last, s);
  }
  mpz_clears(first, last, NULL);
  return DYD_OK;
}

/* Does p' have no zero on the slot? */
static bool is_isolated(const dyd_root *r, const fmpz_poly_t p) {
  fmpz_poly_t d;
  arb_t x, y;
  fmpz_poly_init(d);
  arb_init(x);
  arb_init(y);
  fmpz_poly_derivative(d, p);
  arf_set_mpz(arb_midref(x), r->slot);
  arb_mul_2exp_si(x, x, 1);
  arb_add_ui(x, x, 1, ARF_PREC_EXACT);
  mag_one(arb_radref(x));
  arb_mul_2exp_si(x, x, (slong)-r->s - 1);
  arb_fmpz_poly_evaluate_arb_horner(y, d, x, start_precision(r->slot));
  bool result = !arb_contains_zero(y);
  arb_clear(y);
  arb_clear(x);
  fmpz_poly_clear(d);
  return result;
}

static void root_bisect(dyd_root *r, const fmpz_poly_t p) {
  mpz_t middle;
  mpz_init(middle);
  mpz_mul_2exp(middle, r->slot, 1);
  mpz_add_ui(middle, middle, 1);
  int sign = root_sign_at(p, middle, r->s + 1);
  if (!root_hit(r, sign, middle, r->s + 1)) {
    mpz_sub_ui(r->slot, middle, sign == r->sign_left ? 0 : 1);
    r->s++;
  }
  mpz_clear(middle);
}

/* The secant's proposal m, 0 < m < 2^j, for the root at (slot 2^j + m) 2^-(s+j). Only a guess. */
static void root_propose(mpz_ptr m, const dyd_root *r, const fmpz_poly_t p, unsigned j) {
  arb_t x, a, b;
  arb_init(x);
  arb_init(a);
  arb_init(b);
  slong prec = start_precision(r->slot) + 2 * (slong)j;
  dyd_ball_set_z_2exp(x, r->slot, (slong)-r->s);
  arb_fmpz_poly_evaluate_arb(a, p, x, prec);
  dyd_ball_set_z_2exp(x, r->slot, 0);
  arb_add_ui(x, x, 1, ARF_PREC_EXACT);
  arb_mul_2exp_si(x, x, (slong)-r->s);
  arb_fmpz_poly_evaluate_arb(b, p, x, prec);
  arb_sub(b, a, b, prec);
  arb_div(a, a, b, prec);
  mpz_set_ui(m, 0);
  if (arb_is_finite(a)) {
    fmpz_t f;
    fmpz_init(f);
    arf_mul_2exp_si(arb_midref(a), arb_midref(a), (slong)j);
    if (arf_cmpabs_2exp_si(arb_midref(a), (slong)j + 1) < 0) arf_get_fmpz(f, arb_midref(a), ARF_RND_NEAR);
    fmpz_get_mpz(m, f);
    fmpz_clear(f);
  }
  arb_clear(b);
  arb_clear(a);
  arb_clear(x);
}

/* Holds m within 1 .. 2^j - 1. */
static void root_clamp(mpz_ptr m, unsigned j) {
  mpz_t most;
  mpz_init_set_ui(most, 1);
  mpz_mul_2exp(most, most, j);
  mpz_sub_ui(most, most, 1);
  if (mpz_sgn(m) <= 0) mpz_set_ui(m, 1);
  if (mpz_cmp(m, most) > 0) mpz_set(m, most);
  mpz_clear(most);
}

/* Phase 3: tries the part beside the proposal. false: refuted, r unchanged. */
static bool root_quadratic(dyd_root *r, const fmpz_poly_t p, unsigned j) {
  mpz_t m, base, other;
  mpz_inits(m, base, other, NULL);
  root_propose(m, r, p, j);
  root_clamp(m, j);
  mpz_mul_2exp(base, r->slot, j);
  mpz_add(m, m, base);
  int64_t s = r->s + j;
  int sign = root_sign_at(p, m, s), next = sign;
  bool found = root_hit(r, sign, m, s);
  if (!found) {
    bool left = sign == r->sign_left; /* the root is to the right of m */
    if (left) {
      mpz_add_ui(other, m, 1);
    } else {
      mpz_sub_ui(other, m, 1);
    }
    next = root_sign_at(p, other, s);
    found = root_hit(r, next, other, s);
    if (!found && next != sign) {
      mpz_set(r->slot, left ? m : other);
      r->s = s;
      found = true;
    }
  }
  mpz_clears(m, base, other, NULL);
  return found;
}

static void grid_step(dyd_root *r, const fmpz_poly_t p, int64_t target) {
  if (!r->isolated) {
    r->isolated = is_isolated(r, p);
    if (!r->isolated) root_bisect(r, p);
    return;
  }
  unsigned j = r->jump;
  if ((int64_t)j > target - r->s) j = target > r->s ? (unsigned)(target - r->s) : 1;
  if (j < 2) {
    root_bisect(r, p);
    if (r->jump < 2) r->jump = 2;
  } else if (root_quadratic(r, p, j)) {
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
  fmpz_poly_t p;
  dyd_status st = DYD_OK;
  fmpz_poly_init(p);
  root_load(p, r);
  if (!r->on_grid) {
    st = root_enter_grid(r, p, err);
  } else if (!r->exact) {
    grid_step(r, p, target);
  }
  fmpz_poly_clear(p);
  return st;
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

/* Signs are found with at most so many bits as the degree times those of the place: from a million on, a step may take
 * a tenth of a second. */
static bool root_step_is_long(const dyd_root *r) {
  enum { LONG = 1 << 20 };
  size_t bits = r->jump + mpz_sizeinbase(r->slot, 2);
  if (!r->on_grid) bits = mpz_sizeinbase(mpq_numref(r->hi), 2) + mpz_sizeinbase(mpq_denref(r->hi), 2);
  return r->count > LONG / bits;
}

dyd_status dyd_root_step(dyd_root *r, int64_t target, const volatile int *stop, dyd_error *err) {
  if (dyd_flag_is_set(stop)) return DYD_CANCELLED;
  root_errand *e = stop && root_step_is_long(r) ? malloc(sizeof *e) : NULL;
  if (!e) return root_step_now(r, target, err);
  *e = (root_errand){.target = target, .status = DYD_E_NOMEM};
  dyd_error_clear(&e->err);
  if (dyd_root_copy(&e->root, r) != DYD_OK) return free(e), dyd_fail_nomem(err);
  if (!dyd_apart(root_errand_run, root_errand_drop, e, stop)) return DYD_CANCELLED;
  dyd_root before = *r;
  dyd_status st = e->status;
  if (st != DYD_OK && err) *err = e->err;
  *r = *e->root;
  *e->root = before;
  root_errand_drop(e);
  return st;
}
