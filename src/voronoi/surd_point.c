/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points ((ax + bx sqrt(c)) / d, (ay + by sqrt(c)) / d).
 *
 * Distances: the closest or farthest point of a rectangle is found coordinate by coordinate [DIST-1], and the
 * difference of two squared distances is (P + Q sqrt(c)) / d^2, whose sign is exact [SQR-1].
 * Enclosures: floor(x / d) = floor(floor(x) / d) for an integer d > 0, and floor(a + b sqrt(c)) = a + floor(sqrt(b^2
 * c)) for b >= 0, a - ceil(sqrt(b^2 c)) for b < 0; so integer roots decide. */
#include "voronoi/surd_point.h"

#include "base/local.h"
#include "predicate/circle.h"
#include "rect/rect.h"

void dyd_surd_point_init(dyd_surd_point *p) {
  mpz_inits(p->ax, p->bx, p->ay, p->by, p->c, NULL);
  mpz_init_set_ui(p->d, 1);
}

void dyd_surd_point_clear(dyd_surd_point *p) {
  mpz_clears(p->ax, p->bx, p->ay, p->by, p->c, p->d, NULL);
}

void dyd_surd_point_set(dyd_surd_point *out, const dyd_surd_point *p) {
  mpz_set(out->ax, p->ax);
  mpz_set(out->bx, p->bx);
  mpz_set(out->ay, p->ay);
  mpz_set(out->by, p->by);
  mpz_set(out->c, p->c);
  mpz_set(out->d, p->d);
}

static dyd_surd surd_coordinate(const dyd_surd_point *p, int axis) {
  if (axis) return (dyd_surd){p->ay, p->by, p->c, p->d};
  return (dyd_surd){p->ax, p->bx, p->c, p->d};
}

int dyd_surd_point_cmp(const dyd_surd_point *p, const dyd_surd_point *q, int axis) {
  dyd_surd s = surd_coordinate(p, axis), t = surd_coordinate(q, axis);
  DYD_LOCAL_NUMBERS(mpz, a, b, d);
  mpz_mul(a, s.a, t.d);
  mpz_submul(a, t.a, s.d);
  mpz_mul(b, s.b, t.d);
  mpz_mul(d, t.b, s.d);
  mpz_neg(d, d);
  return dyd_sqrt2_sign(a, b, s.c, d, t.c);
}

int dyd_surd_point_cmp_z(const dyd_surd_point *p, int axis, mpz_srcptr z) {
  dyd_surd s = surd_coordinate(p, axis);
  DYD_LOCAL_NUMBERS(mpz, t);
  return dyd_surd_compare(t, &s, z);
}

int dyd_surd_point_side(const dyd_surd_point *p, const dyd_irect *a, dyd_touch ta, const dyd_irect *b, dyd_touch tb) {
  const dyd_surd xy[2] = {surd_coordinate(p, 0), surd_coordinate(p, 1)};
  DYD_LOCAL_NUMBERS(mpz, pa, qa, pb, qb);
  dyd_surd_add_distance2(pa, qa, xy, a, ta);
  dyd_surd_add_distance2(pb, qb, xy, b, tb);
  mpz_sub(pa, pa, pb);
  mpz_sub(qa, qa, qb);
  return dyd_sqrt_sign(pa, qa, p->c);
}

void dyd_surd_point_drop_root(dyd_surd_point *p) {
  mpz_set_ui(p->bx, 0);
  mpz_set_ui(p->by, 0);
  mpz_set_ui(p->c, 0);
}

static void surd_make_rational(dyd_surd_point *p) {
  if (mpz_sgn(p->bx) || mpz_sgn(p->by)) {
    if (!mpz_perfect_square_p(p->c)) return;
    mpz_sqrt(p->c, p->c);
    mpz_addmul(p->ax, p->bx, p->c);
    mpz_addmul(p->ay, p->by, p->c);
  }
  dyd_surd_point_drop_root(p);
}

/* Squares of the primes that scales are made of go from under the root before it. */
static void surd_shrink_root(dyd_surd_point *p) {
  static const unsigned long prime[] = {5, 3};
  if (!mpz_sgn(p->c)) return;
  mp_bitcnt_t twos = mpz_scan1(p->c, 0) / 2;
  mpz_tdiv_q_2exp(p->c, p->c, 2 * twos);
  mpz_mul_2exp(p->bx, p->bx, twos);
  mpz_mul_2exp(p->by, p->by, twos);
  for (int k = 0; k < 2; k++)
    while (mpz_divisible_ui_p(p->c, prime[k] * prime[k])) {
      mpz_divexact_ui(p->c, p->c, prime[k] * prime[k]);
      mpz_mul_ui(p->bx, p->bx, prime[k]);
      mpz_mul_ui(p->by, p->by, prime[k]);
    }
}

void dyd_surd_point_tidy(dyd_surd_point *p) {
  surd_make_rational(p);
  surd_shrink_root(p);
  mpz_ptr part[5] = {p->ax, p->bx, p->ay, p->by, p->d};
  DYD_LOCAL_NUMBERS(mpz, gcd);
  mpz_set(gcd, p->d);
  for (int k = 0; k < 4; k++) mpz_gcd(gcd, gcd, part[k]);
  for (int k = 0; k < 5; k++) mpz_divexact(part[k], part[k], gcd);
}

void dyd_surd_point_unscale(dyd_surd_point *p, mpz_srcptr ox, mpz_srcptr oy, mpz_srcptr man, int64_t exp) {
  mpz_ptr part[4] = {p->ax, p->bx, p->ay, p->by};
  mpz_addmul(p->ax, ox, p->d);
  mpz_addmul(p->ay, oy, p->d);
  mpz_mul(p->d, p->d, man);
  dyd_shift_up(p->d, exp);
  for (int k = 0; k < 4; k++) dyd_shift_up(part[k], -exp);
  dyd_surd_point_tidy(p);
}

void dyd_surd_point_floor(mpz_ptr floor, mpz_ptr ceiling, const dyd_surd_point *p, int axis, int64_t bits) {
  dyd_surd s = surd_coordinate(p, axis);
  DYD_LOCAL_NUMBERS(mpz, root, rest, d);
  mpz_mul(root, s.b, s.b);
  mpz_mul(root, root, s.c);
  dyd_shift_up(root, 2 * bits);
  mpz_sqrtrem(root, rest, root);
  mpz_set(floor, s.a);
  dyd_shift_up(floor, bits);
  mpz_set(d, s.d);
  dyd_shift_up(d, -bits);
  int over = mpz_sgn(rest) != 0;
  if (mpz_sgn(s.b) < 0) {
    mpz_sub(ceiling, floor, root);
    mpz_sub_ui(floor, ceiling, (unsigned long)over);
  } else {
    mpz_add(floor, floor, root);
    mpz_add_ui(ceiling, floor, (unsigned long)over);
  }
  mpz_fdiv_q(floor, floor, d);
  mpz_cdiv_q(ceiling, ceiling, d);
}

static dyd_status surd_enclose_side(dyd_interval *out, const dyd_surd_point *p, int axis, int64_t bits) {
  DYD_LOCAL_NUMBERS(mpz, floor, ceiling);
  DYD_LOCAL(dyd_dyadic, lo, hi);
  dyd_surd_point_floor(floor, ceiling, p, axis, bits);
  dyd_status st = dyd_dyadic_set_z_2exp(&lo, floor, -bits);
  if (st == DYD_OK) st = dyd_dyadic_set_z_2exp(&hi, ceiling, -bits);
  return st == DYD_OK ? dyd_interval_set_ends(out, &lo, &hi) : st;
}

dyd_status dyd_surd_point_enclose(dyd_rect *out, const dyd_surd_point *p, int64_t bits) {
  if (bits > DYD_EXP_LIMIT || bits < -DYD_EXP_LIMIT) return DYD_E_RANGE;
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = surd_enclose_side(&r.x, p, 0, bits);
  if (st == DYD_OK) st = surd_enclose_side(&r.y, p, 1, bits);
  if (st == DYD_OK) dyd_rect_swap(out, &r);
  return st;
}
