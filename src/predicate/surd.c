/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Comparing (a + b sqrt(c)) / d with the ends and the middle of an interval: [DIST-1] in one coordinate. */
#include "predicate/surd.h"

#include <dyadel/dyadic.h>

int dyd_surd_compare(mpz_ptr t, const dyd_surd *s, mpz_srcptr z) {
  mpz_set(t, s->a);
  mpz_submul(t, z, s->d);
  return dyd_sqrt_sign(t, s->b, s->c);
}

mpz_srcptr dyd_surd_end(mpz_ptr t, mpz_ptr u, const dyd_surd *s, const dyd_irect *r, int axis, dyd_touch touch) {
  mpz_srcptr lo = dyd_irect_end(r, axis, 0), hi = dyd_irect_end(r, axis, 1);
  if (touch == DYD_CLOSEST) {
    if (dyd_surd_compare(t, s, lo) <= 0) return lo;
    return dyd_surd_compare(t, s, hi) >= 0 ? hi : NULL;
  }
  mpz_add(u, lo, hi);
  mpz_mul_2exp(t, s->a, 1);
  mpz_submul(t, u, s->d);
  mpz_mul_2exp(u, s->b, 1);
  return dyd_sqrt_sign(t, u, s->c) <= 0 ? hi : lo;
}

/* p + q sqrt c += d^2 ((a + b sqrt c) / d - z)^2; nothing for z = NULL (the distance along this axis is 0). */
static void surd_add_square(mpz_ptr p, mpz_ptr q, mpz_ptr t, const dyd_surd *s, mpz_srcptr z) {
  if (!z) return;
  mpz_mul(t, s->b, s->b);
  mpz_addmul(p, t, s->c);
  mpz_set(t, s->a);
  mpz_submul(t, z, s->d);
  mpz_addmul(p, t, t);
  mpz_mul_2exp(t, t, 1);
  mpz_addmul(q, t, s->b);
}

void dyd_surd_add_distance2(mpz_ptr p, mpz_ptr q, const dyd_surd xy[2], const dyd_irect *r, dyd_touch touch) {
  mpz_t t, u;
  mpz_inits(t, u, NULL);
  for (int axis = 0; axis < 2; axis++)
    surd_add_square(p, q, t, &xy[axis], dyd_surd_end(t, u, &xy[axis], r, axis, touch));
  mpz_clears(t, u, NULL);
}
