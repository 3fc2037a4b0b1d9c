/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where a place of the sphere may be, and cosines and sines of degrees. */
#include "checker/region.h"

#include "base/local.h"

/* Precision of the ends of a box about a cap. */
enum { BOX = 128 };

/* ---- cosines and sines ---- */

void dyd_cert_trig_init(dyd_cert_trig *t) {
  dyd_cert_enclosure_init(&t->c);
  dyd_cert_enclosure_init(&t->s);
}

void dyd_cert_trig_clear(dyd_cert_trig *t) {
  dyd_cert_enclosure_clear(&t->c);
  dyd_cert_enclosure_clear(&t->s);
}

void dyd_cert_radians(dyd_cert_enclosure *x, mpq_srcptr q, const dyd_cert_enclosure *pi, long p) {
  DYD_LOCAL_NUMBERS(mpz, den);
  mpz_mul_ui(den, mpq_denref(q), 180);
  dyd_cert_enclosure_set_q(x, mpq_numref(q), den, p);
  dyd_cert_enclosure_mul(x, pi, p);
}

/* q = 90 turns + rest, rest in [-45, 45); returns turns modulo 4. */
static unsigned long quarters(mpq_ptr rest, mpq_srcptr q) {
  DYD_LOCAL_NUMBERS(mpz, turns);
  DYD_LOCAL_NUMBERS(mpq, whole);
  mpq_set_si(rest, 45, 1);
  mpq_add(rest, q, rest);
  mpz_mul_ui(turns, mpq_denref(rest), 90);
  mpz_fdiv_q(turns, mpq_numref(rest), turns);
  mpq_set_z(whole, turns);
  mpz_mul_ui(mpq_numref(whole), mpq_numref(whole), 90);
  mpq_sub(rest, q, whole);
  unsigned long k = mpz_fdiv_ui(turns, 4);
  return k;
}

/* To the angle a quarter of a turn more. */
static void turn_trig(dyd_cert_trig *t) {
  dyd_cert_enclosure_neg(&t->s);
  mpz_swap(t->c.lo, t->s.lo);
  mpz_swap(t->c.hi, t->s.hi);
}

void dyd_cert_trig_of_degrees(dyd_cert_trig *t, mpq_srcptr q, const dyd_cert_enclosure *pi, long p) {
  DYD_LOCAL_NUMBERS(mpq, rest);
  DYD_LOCAL(dyd_cert_enclosure, x);
  unsigned long k = quarters(rest, q);
  dyd_cert_enclosure_set_si(&t->c, 1, p);
  dyd_cert_enclosure_set_si(&t->s, 0, p);
  dyd_cert_radians(&x, rest, pi, p);
  if (mpq_sgn(rest)) dyd_cert_enclosure_cos_sin(&t->c, &t->s, &x, p);
  while (k-- > 0) turn_trig(t);
}

void dyd_cert_trig_of_radians(dyd_cert_trig *t, mpq_srcptr angle, long p) {
  DYD_LOCAL(dyd_cert_enclosure, x);
  dyd_cert_enclosure_set_si(&t->c, 1, p);
  dyd_cert_enclosure_set_si(&t->s, 0, p);
  dyd_cert_enclosure_set_q(&x, mpq_numref(angle), mpq_denref(angle), p);
  if (mpq_sgn(angle)) dyd_cert_enclosure_cos_sin(&t->c, &t->s, &x, p);
}

/* ---- regions ---- */

void dyd_cert_region_init(dyd_cert_region *r) {
  mpq_inits(r->mid[0], r->mid[1], r->half[0], r->half[1], r->angle, NULL);
}

void dyd_cert_region_clear(dyd_cert_region *r) {
  mpq_clears(r->mid[0], r->mid[1], r->half[0], r->half[1], r->angle, NULL);
}

void dyd_cert_exact_to_q(mpq_ptr out, const dyd_exact *num, mpz_srcptr den) {
  mpz_set(mpq_numref(out), num->man);
  if (den)
    mpz_set(mpq_denref(out), den);
  else
    mpz_set_ui(mpq_denref(out), 1);
  mpz_ptr scaled = num->exp > 0 ? mpq_numref(out) : mpq_denref(out);
  mpz_mul_2exp(scaled, scaled, (mp_bitcnt_t)(num->exp > 0 ? num->exp : -num->exp));
  mpq_canonicalize(out);
}

static void region_set_side(dyd_cert_region *r, int axis, mpq_srcptr lo, mpq_srcptr hi) {
  mpq_add(r->mid[axis], lo, hi);
  mpq_div_2exp(r->mid[axis], r->mid[axis], 1);
  mpq_sub(r->half[axis], hi, r->mid[axis]);
}

/* Latitudes from lo to hi, which are destroyed; false: none is within 90. */
static bool region_set_latitudes(dyd_cert_region *r, mpq_ptr lo, mpq_ptr hi) {
  bool above = mpq_cmp_si(hi, 90, 1) > 0, below = mpq_cmp_si(lo, -90, 1) < 0;
  if (mpq_cmp_si(lo, 90, 1) > 0 || mpq_cmp_si(hi, -90, 1) < 0) return false;
  if (above) mpq_set_si(hi, 90, 1);
  if (below) mpq_set_si(lo, -90, 1);
  if (above || below) mpq_set_si(r->half[0], 180, 1);
  region_set_side(r, 1, lo, hi);
  if (mpq_equal(lo, hi) && (mpq_cmp_si(lo, 90, 1) == 0 || mpq_cmp_si(lo, -90, 1) == 0)) {
    mpq_set_si(r->mid[0], 0, 1);
    mpq_set_si(r->half[0], 0, 1);
  }
  return true;
}

static void side_to_q(mpq_ptr lo, mpq_ptr hi, const dyd_cert_side *side) {
  dyd_cert_exact_to_q(lo, &side->lo, dyd_cert_den(side));
  dyd_cert_exact_to_q(hi, dyd_cert_high(side), dyd_cert_den(side));
}

bool dyd_cert_region_set(dyd_cert_region *r, const dyd_cert_side side[2], mpq_srcptr degrees, mpq_srcptr angle) {
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  mpq_set(r->angle, angle);
  side_to_q(lo, hi, &side[0]);
  region_set_side(r, 0, lo, hi);
  mpq_add(r->half[0], r->half[0], degrees);
  side_to_q(lo, hi, &side[1]);
  mpq_sub(lo, lo, degrees);
  mpq_add(hi, hi, degrees);
  return region_set_latitudes(r, lo, hi) && mpq_cmp_si(angle, 1, 1) <= 0;
}

bool dyd_cert_region_is_exact(const dyd_cert_region *r) {
  return !mpq_sgn(r->half[0]) && !mpq_sgn(r->half[1]) && !mpq_sgn(r->angle);
}

bool dyd_cert_region_is_same(const dyd_cert_region *a, const dyd_cert_region *b) {
  DYD_LOCAL_NUMBERS(mpq, turns);
  mpq_sub(turns, a->mid[0], b->mid[0]);
  bool turned = mpz_cmp_ui(mpq_denref(turns), 1) == 0 && mpz_divisible_ui_p(mpq_numref(turns), 360);
  return mpq_equal(a->mid[1], b->mid[1]) && turned;
}

/* ---- the box about a region ---- */

/* out = an upper bound of x radians, in degrees, not above 180; x is destroyed. */
static void degrees_at_least(mpq_ptr out, dyd_cert_enclosure *x) {
  DYD_LOCAL(dyd_cert_enclosure, unit);
  dyd_cert_enclosure_pi(&unit, BOX);
  mpz_mul_ui(x->lo, x->lo, 180);
  mpz_mul_ui(x->hi, x->hi, 180);
  dyd_cert_enclosure_div(x, &unit, BOX);
  mpq_set_z(out, x->hi);
  mpq_div_2exp(out, out, BOX);
  if (!x->known || mpq_cmp_si(out, 180, 1) > 0) mpq_set_si(out, 180, 1);
}

/* out = how far in longitude a cap of the angle about a latitude of at most `lat` degrees in absolute value reaches. */
static void longitudes_above(mpq_ptr out, mpq_srcptr lat, mpq_srcptr angle) {
  DYD_LOCAL(dyd_cert_enclosure, pi, one);
  DYD_LOCAL(dyd_cert_trig, place, cap);
  dyd_cert_enclosure_pi(&pi, BOX);
  dyd_cert_enclosure_set_si(&one, 1, BOX);
  dyd_cert_trig_of_degrees(&place, lat, &pi, BOX);
  dyd_cert_trig_of_radians(&cap, angle, BOX);
  dyd_cert_enclosure_div(&cap.s, &place.c, BOX);
  cap.s.known = cap.s.known && mpz_cmp(cap.s.hi, one.lo) < 0;
  if (cap.s.known) dyd_cert_enclosure_asin(&cap.s, BOX);
  degrees_at_least(out, &cap.s);
}

/* A cap of an angle a about (l, f) has longitudes up to asin(sin a / cos f) from l, while |f| + a < 90 degrees. */
void dyd_cert_region_box(dyd_cert_region *r) {
  if (!mpq_sgn(r->angle)) return;
  DYD_LOCAL_NUMBERS(mpq, lo, hi, more);
  DYD_LOCAL(dyd_cert_enclosure, x);
  mpq_sub(lo, r->mid[1], r->half[1]);
  mpq_add(hi, r->mid[1], r->half[1]);
  mpq_neg(more, lo);
  if (mpq_cmp(hi, more) > 0) mpq_set(more, hi);
  longitudes_above(more, more, r->angle);
  mpq_add(r->half[0], r->half[0], more);
  dyd_cert_enclosure_set_q(&x, mpq_numref(r->angle), mpq_denref(r->angle), BOX);
  degrees_at_least(more, &x);
  mpq_sub(lo, lo, more);
  mpq_add(hi, hi, more);
  region_set_latitudes(r, lo, hi);
  mpq_set_ui(r->angle, 0, 1);
}
