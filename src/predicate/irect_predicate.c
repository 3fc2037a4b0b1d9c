/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact rungs of orientation and Con on integer rectangles.
 *
 * [ORI-1] The determinant is affine in every coordinate, so its extremes over the box of choices are at corners. For
 * fixed q and r it is linear in p with normal (q_y - r_y, r_x - q_x): the signs of these tell the extreme corner of p,
 * and 16 corner choices of q and r remain.
 * [CON-1] With the six critical circles of a surely oriented triple, + iff the three F-once circles enclose r, - iff
 * the three F-twice circles keep away from r. One in-circle sign tells which of the two is left to test. */
#include "predicate/icircle.h"

/* The value of `sign` * det(p,q,r) least over p in a is positive.  */
static bool corners_turn(const dyd_irect *a, mpz_srcptr qx, mpz_srcptr qy, mpz_srcptr rx, mpz_srcptr ry, int sign,
                         mpz_ptr scratch[4]) {
  mpz_ptr nx = scratch[0], ny = scratch[1], s = scratch[2], det = scratch[3];
  mpz_sub(nx, qy, ry);
  mpz_sub(ny, rx, qx);
  mpz_sub(s, sign * mpz_sgn(nx) >= 0 ? a->x0 : a->x1, qx);
  mpz_mul(det, nx, s);
  mpz_sub(s, sign * mpz_sgn(ny) >= 0 ? a->y0 : a->y1, qy);
  mpz_addmul(det, ny, s);
  return sign * mpz_sgn(det) > 0;
}

static bool surely_turns(const dyd_irect *a, const dyd_irect *b, const dyd_irect *c, int sign, mpz_ptr scratch[4]) {
  for (int k = 0; k < 16; k++) {
    if (!corners_turn(a, k & 1 ? b->x1 : b->x0, k & 2 ? b->y1 : b->y0, k & 4 ? c->x1 : c->x0, k & 8 ? c->y1 : c->y0,
                      sign, scratch)) {
      return false;
    }
  }
  return true;
}

dyd_sure dyd_irect_orientation(const dyd_irect *a, const dyd_irect *b, const dyd_irect *c) {
  mpz_t t[4];
  for (int k = 0; k < 4; k++) mpz_init(t[k]);
  mpz_ptr scratch[4] = {t[0], t[1], t[2], t[3]};
  dyd_sure answer = surely_turns(a, b, c, 1, scratch)    ? DYD_SURE_PLUS
                    : surely_turns(a, b, c, -1, scratch) ? DYD_SURE_MINUS
                                                         : DYD_UNSURE;
  for (int k = 4; k-- > 0;) mpz_clear(t[k]);
  return answer;
}

/* The in-circle determinant of the lower left corners, times the orientation of a, b, c: 1 inside, -1 outside. */
static int corner_in_circle(const dyd_irect *r, const dyd_irect *const abc[3], dyd_sure orientation) {
  mpz_t x[3], y[3], n[3], det, t;
  for (int k = 0; k < 3; k++) mpz_inits(x[k], y[k], n[k], NULL);
  mpz_inits(det, t, NULL);
  for (int k = 0; k < 3; k++) {
    mpz_sub(x[k], abc[k]->x0, r->x0);
    mpz_sub(y[k], abc[k]->y0, r->y0);
    mpz_mul(n[k], x[k], x[k]);
    mpz_addmul(n[k], y[k], y[k]);
  }
  for (int k = 0; k < 3; k++) {
    int i = (k + 1) % 3, j = (k + 2) % 3;
    mpz_mul(t, x[i], y[j]);
    mpz_submul(t, x[j], y[i]);
    mpz_addmul(det, t, n[k]);
  }
  int sign = mpz_sgn(det) * (int)orientation;
  mpz_clears(det, t, NULL);
  for (int k = 3; k-- > 0;) mpz_clears(x[k], y[k], n[k], NULL);
  return sign;
}

/* Is r on the side `sign` of the three circles in which one rectangle has the touch `odd` and the others not? */
static bool beyond_critical_circles(const dyd_irect *r, const dyd_irect *const abc[3], dyd_touch odd, int sign) {
  dyd_touch even = odd == DYD_FARTHEST ? DYD_CLOSEST : DYD_FARTHEST;
  dyd_icircle circle;
  dyd_icircle_init(&circle);
  bool beyond = true;
  for (int k = 0; k < 3 && beyond; k++) {
    dyd_touch touch[3] = {even, even, even};
    touch[k] = odd;
    beyond = dyd_icircles(&circle, 1, abc, touch) == 1 && dyd_icircle_side(&circle, r, odd) == sign;
  }
  dyd_icircle_clear(&circle);
  return beyond;
}

dyd_sure dyd_irect_con_oriented(const dyd_irect *r, const dyd_irect *const abc[3], dyd_sure orientation) {
  int sign = corner_in_circle(r, abc, orientation);
  if (sign > 0 && beyond_critical_circles(r, abc, DYD_FARTHEST, -1)) return DYD_SURE_PLUS;
  if (sign < 0 && beyond_critical_circles(r, abc, DYD_CLOSEST, 1)) return DYD_SURE_MINUS;
  return DYD_UNSURE;
}
