/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The least and the largest distance of points of two rectangles: exact squares, and roots rounded outward.
 *
 * Along an axis the points of [a0,a1] and [b0,b1] are at least max(b0 - a1, a0 - b1, 0) and at most max(b1 - a0, a1 -
 * b0) apart; both are reached for both axes at once, since a rectangle is a product. */
#include <dyadel/rect.h>
#include <mpfr.h>

/* *out += d^2 for d = max(p - q, r - s, 0). */
static void add_apart2(mpq_ptr out, mpq_srcptr p, mpq_srcptr q, mpq_srcptr r, mpq_srcptr s) {
  mpq_t d[2];
  mpq_inits(d[0], d[1], NULL);
  mpq_sub(d[0], p, q);
  mpq_sub(d[1], r, s);
  mpq_ptr more = mpq_cmp(d[0], d[1]) > 0 ? d[0] : d[1];
  if (mpq_sgn(more) > 0) {
    mpq_mul(more, more, more);
    mpq_add(out, out, more);
  }
  mpq_clears(d[0], d[1], NULL);
}

static double root_of(const mpq_t square, mpfr_rnd_t round) {
  mpfr_t root;
  mpfr_init2(root, 128);
  mpfr_set_q(root, square, round);
  mpfr_sqrt(root, root, round);
  double d = mpfr_get_d(root, round);
  mpfr_clear(root);
  return d;
}

void dyd_rect_distance(double *lo, double *hi, const dyd_rect *a, const dyd_rect *b) {
  mpq_t e[2][2], least, largest;
  mpq_inits(e[0][0], e[0][1], e[1][0], e[1][1], least, largest, NULL);
  for (int axis = 0; axis < 2; axis++) {
    dyd_interval_get_q(e[0][0], e[0][1], axis ? &a->y : &a->x);
    dyd_interval_get_q(e[1][0], e[1][1], axis ? &b->y : &b->x);
    add_apart2(least, e[1][0], e[0][1], e[0][0], e[1][1]);
    add_apart2(largest, e[1][1], e[0][0], e[0][1], e[1][0]);
  }
  *lo = root_of(least, MPFR_RNDD);
  *hi = root_of(largest, MPFR_RNDU);
  mpq_clears(e[0][0], e[0][1], e[1][0], e[1][1], least, largest, NULL);
}
