/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Comparing (a + b sqrt(c)) / d with the ends and the middle of an interval: [DIST-1] in one coordinate. */
#include "predicate/surd.h"

#include <dyadel/dyadic.h>

static int surd_compare(mpz_ptr t, const dyd_surd *s, mpz_srcptr z) {
  mpz_set(t, s->a);
  mpz_submul(t, z, s->d);
  return dyd_sqrt_sign(t, s->b, s->c);
}

mpz_srcptr dyd_surd_closest(mpz_ptr t, const dyd_surd *s, mpz_srcptr lo, mpz_srcptr hi) {
  if (surd_compare(t, s, lo) <= 0) return lo;
  return surd_compare(t, s, hi) >= 0 ? hi : NULL;
}

mpz_srcptr dyd_surd_farthest(mpz_ptr t, mpz_ptr u, const dyd_surd *s, mpz_srcptr lo, mpz_srcptr hi) {
  mpz_add(u, lo, hi);
  mpz_mul_2exp(t, s->a, 1);
  mpz_submul(t, u, s->d);
  mpz_mul_2exp(u, s->b, 1);
  return dyd_sqrt_sign(t, u, s->c) <= 0 ? hi : lo;
}
