/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From balls to intervals with short dyadic ends.
 *
 * [ENC-2] The ends are the floor of the lower and the ceiling of the upper bound on the grid of multiples of
 * 2^exp; the bounds themselves are exact, so the ball lies inside. */
#include "stream/ball.h"

slong dyd_ball_radius_exponent(arb_srcptr x) {
  if (mag_is_zero(arb_radref(x))) return -4 * DYD_BALL_LIMIT;
  if (fmpz_cmp_si(MAG_EXPREF(arb_radref(x)), -4 * DYD_BALL_LIMIT) < 0) return -4 * DYD_BALL_LIMIT;
  return fmpz_get_si(MAG_EXPREF(arb_radref(x))); /* a radius is below 2^its exponent */
}

/* out = x rounded to the grid. */
static dyd_status ball_grid_end(dyd_dyadic *out, arf_t x, int64_t exp, dyd_round dir) {
  fmpz_t f;
  mpz_t z;
  fmpz_init(f);
  mpz_init(z);
  arf_mul_2exp_si(x, x, (slong)-exp);
  arf_get_fmpz(f, x, dir == DYD_DOWN ? ARF_RND_FLOOR : ARF_RND_CEIL);
  fmpz_get_mpz(z, f);
  dyd_status st = dyd_dyadic_set_z_2exp(out, z, exp);
  mpz_clear(z);
  fmpz_clear(f);
  return st;
}

/* The point itself when the ball is exact and within range. */
static dyd_status ball_exact_point(dyd_dyadic *out, arb_srcptr x) {
  fmpz_t man, exp;
  mpz_t z;
  fmpz_init(man);
  fmpz_init(exp);
  mpz_init(z);
  arf_get_fmpz_2exp(man, exp, arb_midref(x));
  fmpz_get_mpz(z, man);
  dyd_status st = fmpz_fits_si(exp) ? dyd_dyadic_set_z_2exp(out, z, (int64_t)fmpz_get_si(exp)) : DYD_E_RANGE;
  mpz_clear(z);
  fmpz_clear(exp);
  fmpz_clear(man);
  return st;
}

dyd_status dyd_ball_interval(dyd_interval *out, arb_srcptr x, int64_t exp) {
  dyd_dyadic lo, hi;
  arf_t end;
  dyd_dyadic_init(&lo);
  dyd_dyadic_init(&hi);
  arf_init(end);
  dyd_status st = DYD_E_RANGE;
  if (arb_is_exact(x)) st = ball_exact_point(&lo, x);
  if (st == DYD_OK) {
    dyd_dyadic_set(&hi, &lo);
  } else {
    arb_get_lbound_arf(end, x, ARF_PREC_EXACT);
    st = ball_grid_end(&lo, end, exp, DYD_DOWN);
    arb_get_ubound_arf(end, x, ARF_PREC_EXACT);
    if (st == DYD_OK) st = ball_grid_end(&hi, end, exp, DYD_UP);
  }
  if (st == DYD_OK) st = dyd_interval_set_ends(out, &lo, &hi);
  arf_clear(end);
  dyd_dyadic_clear(&hi);
  dyd_dyadic_clear(&lo);
  return st;
}
