/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where a point on the sphere may be. */
#include "sphere/spot.h"

#include "rect/rect.h"
#include "stream/ball.h"

void dyd_spot_init(dyd_spot *s) {
  mpq_inits(s->mid[0], s->mid[1], s->half[0], s->half[1], s->angle, NULL);
  s->stays = false;
}

void dyd_spot_clear(dyd_spot *s) {
  mpq_clears(s->mid[0], s->mid[1], s->half[0], s->half[1], s->angle, NULL);
}

static void spot_set_side(dyd_spot *s, int a, mpq_t lo, mpq_t hi) {
  mpq_set_ui(s->half[a], 0, 1);
  mpq_set(s->mid[a], lo);
  if (mpq_equal(lo, hi)) return;
  mpq_add(s->mid[a], lo, hi);
  mpq_div_2exp(s->mid[a], s->mid[a], 1);
  mpq_sub(s->half[a], hi, s->mid[a]);
}

/* Latitudes beyond a pole are cut off, and the longitude is any. */
static bool spot_cut_poles(dyd_spot *s, mpq_t lo, mpq_t hi) {
  bool beyond = mpq_cmp_si(hi, 90, 1) > 0 || mpq_cmp_si(lo, -90, 1) < 0;
  if (mpq_cmp_si(hi, -90, 1) < 0 || mpq_cmp_si(lo, 90, 1) > 0) return false;
  if (beyond && mpq_equal(lo, hi)) return false;
  if (mpq_cmp_si(hi, 90, 1) > 0) mpq_set_si(hi, 90, 1);
  if (mpq_cmp_si(lo, -90, 1) < 0) mpq_set_si(lo, -90, 1);
  spot_set_side(s, 1, lo, hi);
  bool pole = mpq_equal(lo, hi) && (mpq_cmp_si(hi, 90, 1) == 0 || mpq_cmp_si(lo, -90, 1) == 0);
  if (beyond || pole) {
    mpq_set_si(s->mid[0], 0, 1);
    mpq_set_si(s->half[0], pole ? 0 : 180, 1);
  }
  return true;
}

/* x becomes the number equal to it modulo 360 that is in [-180, 180). */
static void reduce_longitude(mpq_t x) {
  mpz_t turns, unit;
  if (mpq_cmp_si(x, 180, 1) < 0 && mpq_cmp_si(x, -180, 1) >= 0) return;
  mpz_inits(turns, unit, NULL);
  mpz_mul_ui(unit, mpq_denref(x), 180);
  mpz_add(turns, mpq_numref(x), unit);
  mpz_mul_2exp(unit, unit, 1);
  mpz_fdiv_r(turns, turns, unit);
  mpz_tdiv_q_2exp(unit, unit, 1);
  mpz_sub(mpq_numref(x), turns, unit);
  mpq_canonicalize(x);
  mpz_clears(turns, unit, NULL);
}

bool dyd_spot_set(dyd_spot *s, const dyd_rect *r, mpq_srcptr more) {
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  mpq_set_ui(s->angle, 0, 1);
  dyd_interval_get_q(lo, hi, &r->x);
  spot_set_side(s, 0, lo, hi);
  reduce_longitude(s->mid[0]);
  dyd_interval_get_q(lo, hi, &r->y);
  if (mpq_sgn(more)) {
    mpq_add(s->half[0], s->half[0], more);
    mpq_sub(lo, lo, more);
    mpq_add(hi, hi, more);
  }
  bool good = spot_cut_poles(s, lo, hi);
  mpq_clears(lo, hi, NULL);
  return good;
}

bool dyd_spot_is_exact(const dyd_spot *s) {
  return mpq_sgn(s->half[0]) == 0 && mpq_sgn(s->half[1]) == 0 && mpq_sgn(s->angle) == 0;
}

/* out = an upper bound of x degrees, x in radians. */
static void degrees_above(mpq_t out, arb_t x) {
  arb_t pi;
  arf_t up;
  arb_init(pi);
  arf_init(up);
  arb_const_pi(pi, 64);
  arb_mul_ui(x, x, 180, 64);
  arb_div(x, x, pi, 64);
  arb_get_ubound_arf(up, x, 53);
  if (arf_is_finite(up) && arf_cmp_si(up, 180) < 0)
    mpq_set_d(out, arf_get_d(up, ARF_RND_CEIL));
  else
    mpq_set_si(out, 180, 1);
  arf_clear(up);
  arb_clear(pi);
}

/* The cap about (l, f) of an angle a holds longitudes up to asin(sin a / cos f) from l, while f + a < 90 degrees. */
void dyd_spot_box(dyd_spot *s) {
  arb_t a, f;
  mpq_t lo, hi, more;
  if (mpq_sgn(s->angle) == 0) return;
  arb_init(a);
  arb_init(f);
  mpq_inits(lo, hi, more, NULL);
  mpq_sub(lo, s->mid[1], s->half[1]);
  mpq_add(hi, s->mid[1], s->half[1]);
  mpq_neg(more, lo);
  dyd_ball_set_q(f, mpq_cmp(more, hi) > 0 ? more : hi, 64); /* the widest is about the highest latitude */
  arb_div_ui(f, f, 180, 64);
  arb_cos_pi(f, f, 64);
  dyd_ball_set_q(a, s->angle, 64);
  arb_sin(a, a, 64);
  arb_div(a, a, f, 64);
  arb_asin(a, a, 64);
  degrees_above(more, a);
  mpq_add(s->half[0], s->half[0], more);
  dyd_ball_set_q(a, s->angle, 64);
  degrees_above(more, a);
  mpq_sub(lo, lo, more);
  mpq_add(hi, hi, more);
  spot_cut_poles(s, lo, hi);
  mpq_set_ui(s->angle, 0, 1);
  mpq_clears(lo, hi, more, NULL);
  arb_clear(f);
  arb_clear(a);
}

/* The next double at or below x (side < 0), or at or above. */
static double rounded_to(mpq_srcptr x, int side, mpq_t exact) {
  double d = mpq_get_d(x); /* towards 0 */
  mpq_set_d(exact, d);
  int beyond = mpq_cmp(x, exact);
  return beyond * side > 0 ? nextafter(d, side * HUGE_VAL) : d;
}

void dyd_spot_get_d(dyd_spot_d *out, const dyd_spot *s) {
  mpq_t end, exact;
  mpq_inits(end, exact, NULL);
  for (int a = 0; a < 2; a++) {
    mpq_sub(end, s->mid[a], s->half[a]);
    out->box[2 * a] = rounded_to(end, -1, exact);
    mpq_add(end, s->mid[a], s->half[a]);
    out->box[2 * a + 1] = rounded_to(end, 1, exact);
  }
  out->angle = rounded_to(s->angle, 1, exact);
  mpq_clears(end, exact, NULL);
}
