/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Centres are rounded to a step below the widths of the rectangles they were made from, or below their last bits if
 * they are points. */
#include "skeleton/circumcentre.h"

#include <dyadel/predicate.h>

enum { FINER = 8 };

/* Exponent of a step well below the width of a, or below the last bit of a point. */
static int64_t centre_step(const dyd_interval *a) {
  if (!dyd_interval_is_point(a)) return -dyd_interval_bits(a) - FINER;
  return mpz_sgn(a->lo.man) ? a->lo.exp - (int64_t)mpz_sizeinbase(a->den, 2) - FINER : 0;
}

static int64_t centre_least(int64_t a, int64_t b) {
  return a < b ? a : b;
}

/* floor((a / d) / 2^e) 2^e, d > 0 */
static dyd_status centre_floor(dyd_dyadic *out, const mpz_t a, const mpz_t d, int64_t e) {
  mpz_t t, u;
  mpz_inits(t, u, NULL);
  mpz_mul_2exp(t, a, (mp_bitcnt_t)(e < 0 ? -e : 0));
  mpz_mul_2exp(u, d, (mp_bitcnt_t)(e > 0 ? e : 0));
  mpz_fdiv_q(t, t, u);
  dyd_status st = dyd_dyadic_set_z_2exp(out, t, e);
  mpz_clears(t, u, NULL);
  return st;
}

dyd_status dyd_centre_round(dyd_point *c, const mpz_t x, const mpz_t y, const mpz_t d, int64_t e) {
  dyd_status st = centre_floor(&c->x, x, d, e);
  if (st == DYD_OK) st = centre_floor(&c->y, y, d, e);
  return st;
}

dyd_status dyd_circumcentre_round(bool *found, dyd_point *c, const dyd_skeleton *sk, const uint32_t v[3]) {
  static const dyd_touch touch[3] = {DYD_FARTHEST, DYD_CLOSEST, DYD_CLOSEST};
  dyd_rect point[3], r;
  const dyd_rect *const at[3] = {&point[0], &point[1], &point[2]};
  dyd_circle circle;
  int64_t e = INT64_MAX;
  dyd_status st = DYD_OK;
  dyd_rect_init(&r);
  dyd_circle_init(&circle);
  for (int k = 0; k < 3; k++) dyd_rect_init(&point[k]);
  for (int k = 0; k < 3 && st == DYD_OK; k++) {
    st = dyd_reps_get(&point[k], &sk->reps, v[k]);
    if (st == DYD_OK) st = dyd_rects_get(&r, &sk->rects, v[k]);
    if (st == DYD_OK) e = centre_least(e, centre_least(centre_step(&r.x), centre_step(&r.y)));
  }
  *found = st == DYD_OK && dyd_critical_circle(&circle, at, touch) == DYD_OK && mpz_sgn(circle.c) == 0;
  if (*found) st = dyd_centre_round(c, circle.ax, circle.ay, circle.d, e);
  if (st == DYD_E_RANGE) {
    st = DYD_OK;
    *found = false;
  }
  for (int k = 0; k < 3; k++) dyd_rect_clear(&point[k]);
  dyd_circle_clear(&circle);
  dyd_rect_clear(&r);
  return st;
}

dyd_status dyd_circumcentre_between(bool *found, dyd_point *c, const dyd_skeleton *sk, uint32_t i, uint32_t j,
                                    const uint32_t across[2]) {
  dyd_point other;
  dyd_point_init(&other);
  const uint32_t v[2][3] = {{i, j, across[0]}, {i, j, across[1]}};
  dyd_status st = dyd_circumcentre_round(found, c, sk, v[0]);
  if (st == DYD_OK && *found) st = dyd_circumcentre_round(found, &other, sk, v[1]);
  if (st == DYD_OK && *found) st = dyd_dyadic_add(&c->x, &c->x, &other.x);
  if (st == DYD_OK && *found) st = dyd_dyadic_add(&c->y, &c->y, &other.y);
  if (st == DYD_OK && *found) st = dyd_dyadic_mul_2exp(&c->x, &c->x, -1);
  if (st == DYD_OK && *found) st = dyd_dyadic_mul_2exp(&c->y, &c->y, -1);
  dyd_point_clear(&other);
  if (st != DYD_E_RANGE) return st;
  *found = false;
  return DYD_OK;
}
