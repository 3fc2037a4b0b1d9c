/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Signs for the partial hull: intervals in doubles first (predicate/interval_filter.h), rationals where they are
 * unsure. */
#include "base/local.h"
#include "delaunay/partial_hull.h"
#include "dyadic/raw.h"

void dyd_extreme_enclose(dyd_extreme *x) {
  for (int n = 0; n < 4; n++) {
    mpq_srcptr q = x->e[n];
    x->d[n].lo = dyd_raw_quotient_get_d(mpq_numref(q), 0, mpq_denref(q), DYD_DOWN);
    x->d[n].hi = dyd_raw_quotient_get_d(mpq_numref(q), 0, mpq_denref(q), DYD_UP);
  }
}

static mpq_srcptr exact(dyd_hull_corner a, int axis) {
  return a.of->e[2 * axis + a.upper];
}
static dyd_iv rough(dyd_hull_corner a, int axis) {
  return a.of->d[2 * axis + a.upper];
}

int dyd_hull_compare(int axis, dyd_hull_corner a, dyd_hull_corner b) {
  dyd_iv x = rough(a, axis), y = rough(b, axis);
  if (x.lo > y.hi) return 1;
  if (x.hi < y.lo) return -1;
  int order = mpq_cmp(exact(a, axis), exact(b, axis));
  return (order > 0) - (order < 0);
}

static int cross_exact(dyd_hull_corner a, dyd_hull_corner b, dyd_hull_corner c, dyd_hull_corner d) {
  DYD_LOCAL_NUMBERS(mpq, s, t, p);
  mpq_sub(s, exact(b, 0), exact(a, 0));
  mpq_sub(t, exact(d, 1), exact(c, 1));
  mpq_mul(p, s, t);
  mpq_sub(s, exact(b, 1), exact(a, 1));
  mpq_sub(t, exact(d, 0), exact(c, 0));
  mpq_mul(s, s, t);
  int order = mpq_cmp(p, s);
  return (order > 0) - (order < 0);
}

int dyd_hull_cross(dyd_hull_corner a, dyd_hull_corner b, dyd_hull_corner c, dyd_hull_corner d) {
  dyd_iv px = dyd_iv_sub(rough(b, 0), rough(a, 0)), py = dyd_iv_sub(rough(b, 1), rough(a, 1));
  dyd_iv qx = dyd_iv_sub(rough(d, 0), rough(c, 0)), qy = dyd_iv_sub(rough(d, 1), rough(c, 1));
  int sign = dyd_iv_sign(dyd_iv_sub(dyd_iv_mul(px, qy), dyd_iv_mul(py, qx)));
  return sign ? sign : cross_exact(a, b, c, d);
}
