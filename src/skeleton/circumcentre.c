/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Centres are rounded to a step below the widths of the rectangles they were made from, or below their last bits if
 * they are points. */
#include "skeleton/circumcentre.h"

#include "base/invariant.h"
#include "predicate/circle.h"
#include "rect/rect.h"
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

bool dyd_circumcentre_round(dyd_point *c, const dyd_skeleton *sk, const uint32_t v[3]) {
  static const dyd_touch touch[3] = {DYD_FARTHEST, DYD_CLOSEST, DYD_CLOSEST};
  dyd_rect point[3], r;
  const dyd_rect *const at[3] = {&point[0], &point[1], &point[2]};
  dyd_circle circle;
  int64_t e = INT64_MAX;
  bool found = true;
  dyd_rect_init(&r);
  dyd_circle_init(&circle);
  for (int k = 0; k < 3; k++) {
    dyd_rect_init(&point[k]);
    found = found && dyd_reps_get(&point[k], &sk->reps, v[k]) == DYD_OK;
    dyd_rects_get(&r, &sk->rects, v[k]);
    e = centre_least(e, centre_least(centre_step(&r.x), centre_step(&r.y)));
  }
  found = found && dyd_critical_circle(&circle, at, touch) == DYD_OK && mpz_sgn(circle.c) == 0 &&
          dyd_centre_round(c, circle.ax, circle.ay, circle.d, e) == DYD_OK;
  for (int k = 0; k < 3; k++) dyd_rect_clear(&point[k]);
  dyd_circle_clear(&circle);
  dyd_rect_clear(&r);
  return found;
}

bool dyd_circumcentre_between(dyd_point *c, const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t across[2]) {
  dyd_point other;
  dyd_point_init(&other);
  const uint32_t v[2][3] = {{i, j, across[0]}, {i, j, across[1]}};
  bool found = dyd_circumcentre_round(c, sk, v[0]) && dyd_circumcentre_round(&other, sk, v[1]) &&
               dyd_dyadic_add(&c->x, &c->x, &other.x) == DYD_OK && dyd_dyadic_add(&c->y, &c->y, &other.y) == DYD_OK &&
               dyd_dyadic_mul_2exp(&c->x, &c->x, -1) == DYD_OK && dyd_dyadic_mul_2exp(&c->y, &c->y, -1) == DYD_OK;
  dyd_point_clear(&other);
  return found;
}

void dyd_point_set_xy(dyd_point *c, dyd_xy p) {
  dyd_status x = dyd_dyadic_set_d(&c->x, p.x), y = dyd_dyadic_set_d(&c->y, p.y);
  DYD_INVARIANT(x == DYD_OK && y == DYD_OK);
  (void)x;
  (void)y;
}
