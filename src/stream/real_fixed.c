/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reals known from the start, and reals widened by a radius. */
#include "stream/real.h"

#include "base/alloc.h"
#include "base/error.h"
#include "stream/number.h"

/* A real of the interval a, just set with status st; a goes. */
static dyd_status real_take_interval(dyd_real **out, dyd_interval *a, dyd_status st) {
  if (st == DYD_OK) st = dyd_real_new_fixed(out, a);
  dyd_interval_clear(a);
  return st;
}

dyd_status dyd_real_from_dyadic(dyd_real **out, const dyd_dyadic *x) {
  dyd_interval a;
  dyd_interval_init(&a);
  return real_take_interval(out, &a, dyd_interval_set_ends(&a, x, x));
}

dyd_status dyd_real_from_q(dyd_real **out, const mpq_t q) {
  dyd_interval a;
  dyd_interval_init(&a);
  return real_take_interval(out, &a, dyd_interval_set_q(&a, q));
}

/* An end of a fixed interval: exact when dyadic, else rounded to a multiple of 2^exp. */
static dyd_status fixed_end(dyd_dyadic *out, const mpq_t q, int64_t exp, dyd_round dir) {
  size_t two = mpz_scan1(mpq_denref(q), 0);
  if (mpz_sizeinbase(mpq_denref(q), 2) == two + 1) return dyd_dyadic_set_z_2exp(out, mpq_numref(q), -(int64_t)two);
  return dyd_dyadic_round_q(out, q, exp, dir);
}

dyd_status dyd_interval_fix(dyd_interval *out, const mpq_t lo, const mpq_t hi) {
  int order = mpq_cmp(lo, hi);
  if (order > 0) return DYD_E_ARG;
  if (order == 0) return dyd_interval_set_q(out, lo);
  mpq_t width;
  dyd_dyadic l, h;
  mpq_init(width);
  dyd_dyadic_init(&l);
  dyd_dyadic_init(&h);
  mpq_sub(width, hi, lo);
  /* 2^(bits(num) - bits(den) - 1) <= width <= 2 max(|lo|,|hi|), hence 65 more places. */
  int64_t exp = (int64_t)mpz_sizeinbase(mpq_numref(width), 2) - (int64_t)mpz_sizeinbase(mpq_denref(width), 2) - 1 - 66;
  dyd_status st = fixed_end(&l, lo, exp, DYD_DOWN);
  if (st == DYD_OK) st = fixed_end(&h, hi, exp, DYD_UP);
  if (st == DYD_OK) st = dyd_interval_set_ends(out, &l, &h);
  dyd_dyadic_clear(&h);
  dyd_dyadic_clear(&l);
  mpq_clear(width);
  return st;
}

dyd_status dyd_real_from_interval(dyd_real **out, const mpq_t lo, const mpq_t hi) {
  dyd_interval a;
  dyd_interval_init(&a);
  return real_take_interval(out, &a, dyd_interval_fix(&a, lo, hi));
}

/* The interval of radius `radius` around x. */
typedef struct widened {
  dyd_real *x;
  mpq_t radius;
} widened;

static void widened_release(void *user) {
  widened *w = user;
  dyd_real_free(w->x);
  mpq_clear(w->radius);
  free(w);
}

/* radius becomes the sum of the radii around x. */
static void real_radius(mpq_t radius, const dyd_real *x);

/* By how much more than the radius an interval of x that is not final is widened, on the grid of 2^exp [DISC-4]. */
static void widened_margin(mpq_t out, const dyd_real *x, const mpq_t lo, const mpq_t hi, int64_t exp) {
  mpq_t radius;
  mpq_init(radius);
  real_radius(radius, x);
  mpq_sub(out, hi, lo);
  mpq_sub(out, out, radius);
  mpq_sub(out, out, radius);
  mpq_div_2exp(out, out, 2);
  mpq_set_ui(radius, 1, 1);
  (exp < 0 ? mpq_div_2exp : mpq_mul_2exp)(radius, radius, (mp_bitcnt_t)(exp < 0 ? -exp : exp));
  mpq_add(out, out, radius);
  mpq_clear(radius);
}

/* out = the interval of w->x, widened; fixed once and for all when x is final, else on the grid of 2^exp. */
static dyd_status widened_interval(dyd_interval *out, const widened *w, int64_t exp) {
  const bool final = dyd_real_is_final(w->x);
  mpq_t lo, hi, more;
  mpq_inits(lo, hi, more, NULL);
  dyd_interval_get_q(lo, hi, dyd_real_interval(w->x));
  if (!final) widened_margin(more, w->x, lo, hi, exp);
  mpq_add(more, more, w->radius);
  mpq_sub(lo, lo, more);
  mpq_add(hi, hi, more);
  dyd_status st = final ? dyd_interval_fix(out, lo, hi) : dyd_interval_set_outward(out, lo, hi, exp);
  mpq_clears(lo, hi, more, NULL);
  return st;
}

static dyd_status widened_narrow(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  widened *w = user;
  dyd_status st = dyd_real_narrow_until(w->x, request->bits + 3, request->max_bits + 3, request->stop, err);
  if (dyd_narrow_ended(st)) return st;
  st = widened_interval(out, w, -request->bits - 3);
  if (st != DYD_OK) return dyd_fail(err, st, "the interval around a value: %s", dyd_status_text(st));
  return dyd_real_is_final(w->x) ? DYD_FIXED : DYD_OK;
}

dyd_status dyd_real_widen(dyd_real **out, dyd_real *x, const mpq_t radius) {
  if (!x) return DYD_E_ARG;
  if (mpq_sgn(radius) == 0) {
    *out = x;
    return DYD_OK;
  }
  widened *w = mpq_sgn(radius) > 0 ? dyd_alloc(1, sizeof *w) : NULL;
  if (!w) {
    dyd_real_free(x);
    return mpq_sgn(radius) > 0 ? DYD_E_NOMEM : DYD_E_ARG;
  }
  w->x = x;
  mpq_init(w->radius);
  mpq_set(w->radius, radius);
  if (!dyd_real_is_final(x)) {
    dyd_status st = dyd_real_new_enclosing(out, widened_narrow, widened_release, w);
    if (st == DYD_OK) dyd_real_set_object(*out, DYD_REAL_VAGUE, NULL);
    return st;
  }
  dyd_interval a; /* final already: one fixed interval */
  dyd_interval_init(&a);
  dyd_status st = real_take_interval(out, &a, widened_interval(&a, w, 0));
  widened_release(w);
  return st;
}

static void real_radius(mpq_t radius, const dyd_real *x) {
  mpq_set_ui(radius, 0, 1);
  for (const widened *w; (w = dyd_real_user(x, widened_narrow)); x = w->x) mpq_add(radius, radius, w->radius);
}

bool dyd_real_reaches(const dyd_real *x, const dyd_interval *now, int64_t bits) {
  if (dyd_real_is_final(x)) return true;
  mpq_t lo, hi, most, radius;
  mpq_inits(lo, hi, most, radius, NULL);
  dyd_interval_get_q(lo, hi, now);
  mpq_set_ui(most, 1, 1);
  (bits >= 0 ? mpq_div_2exp : mpq_mul_2exp)(most, most, (mp_bitcnt_t)(bits >= 0 ? bits : -bits));
  real_radius(radius, x);
  mpq_add(most, most, radius);
  mpq_add(most, most, radius);
  mpq_sub(hi, hi, lo);
  bool reaches = mpq_cmp(hi, most) <= 0;
  mpq_clears(lo, hi, most, radius, NULL);
  return reaches;
}

/* [lo,hi] rounded inward by less than a quarter of `slack`; *has: something is left. */
static dyd_status interval_set_inward(dyd_interval *out, bool *has, const mpq_t lo, const mpq_t hi, const mpq_t slack) {
  dyd_dyadic l, h;
  dyd_dyadic_init(&l);
  dyd_dyadic_init(&h);
  int64_t exp = (int64_t)mpz_sizeinbase(mpq_numref(slack), 2) - (int64_t)mpz_sizeinbase(mpq_denref(slack), 2) - 3;
  dyd_status st = fixed_end(&l, lo, exp, DYD_UP);
  if (st == DYD_OK) st = fixed_end(&h, hi, exp, DYD_DOWN);
  *has = st == DYD_OK && dyd_dyadic_cmp(&l, &h) <= 0;
  if (*has) st = dyd_interval_set_ends(out, &l, &h);
  dyd_dyadic_clear(&h);
  dyd_dyadic_clear(&l);
  return st;
}

/* Twice the radius away from each end: every interval of x holds those within the radius of some place, and this
 * place is no nearer to the ends of `now` than the radius [SET-3]. */
static dyd_status widened_core(dyd_interval *core, bool *has, const mpq_t radius, const dyd_interval *now) {
  mpq_t lo, hi, slack;
  dyd_status st = DYD_OK;
  mpq_inits(lo, hi, slack, NULL);
  dyd_interval_get_q(lo, hi, now);
  mpq_sub(slack, hi, lo);
  for (int k = 0; k < 2; k++) {
    mpq_sub(slack, slack, radius);
    mpq_sub(hi, hi, radius);
    mpq_add(lo, lo, radius);
  }
  *has = mpq_sgn(slack) >= 0 && mpq_cmp(hi, lo) <= 0;
  if (mpq_sgn(slack) == 0) mpq_div_2exp(slack, radius, 64);
  if (*has) st = interval_set_inward(core, has, hi, lo, slack);
  mpq_clears(lo, hi, slack, NULL);
  return st;
}

dyd_status dyd_real_core(dyd_interval *core, bool *has, const dyd_real *x, const dyd_interval *now) {
  mpq_t radius;
  *has = dyd_real_is_final(x);
  if (*has) {
    dyd_interval_set(core, dyd_real_interval(x));
    return DYD_OK;
  }
  dyd_status st = DYD_OK;
  mpq_init(radius);
  real_radius(radius, x);
  if (now && mpq_sgn(radius) > 0) st = widened_core(core, has, radius, now);
  mpq_clear(radius);
  return st;
}
