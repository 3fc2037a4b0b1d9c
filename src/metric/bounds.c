/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certified upper bounds on what the partial triangulation leaves open (mathematics: section 8).
 *
 * Fix a choice p, let G be its Delaunay graph as the union of the segments p_i p_j of its Delaunay edges, and
 * U the union of the partial edges Ed(R_i,R_j) over the possible pairs. Every Delaunay edge of p is a possible pair
 * [POS-1] and its segment lies in the convex hull Ed(R_i,R_j), so G is inside U.
 *
 * [AREA-T] The measure of U is at most the sum of the areas of its members.
 *
 * [HAUS-T] As G is inside U, the Hausdorff distance of the two is the supremum over z in U of dist(z, G). Let z be
 * in Ed(R_i,R_j): R_i and R_j are convex, so z = (1-t) a + t b with a in R_i, b in R_j, 0 <= t <= 1.
 *   Legal pair: p_i p_j is an edge of G whatever the choice, and the point (1-t) p_i + t p_j of it is at distance
 *   |(1-t)(a - p_i) + t (b - p_j)| <= max(diam R_i, diam R_j) from z.
 *   Any possible pair: let t <= 1/2, otherwise exchange the two. Then |z - a| = t |b - a| <= L/2, where L is the
 *   largest distance of a point of R_i to one of R_j, and |a - p_i| <= diam R_i, so p_i is within
 *   L/2 + max(diam R_i, diam R_j) of z. And p_i is in G: if q is the nearest of the chosen points that are not p_i,
 *   the disc with diameter p_i q has no chosen point but these two, so p_i q is a Delaunay edge. (If all chosen
 *   points coincide, G is that point: an edge between coinciding points is the point.)
 * Ties count as any possible pair: a choice of diagonals in a cocircular set may leave such an edge out.
 *
 * Fewer than two sites, aliases not counted: there is no edge, G and U are both empty, and both bounds are 0.
 *
 * Rounding: terms are rounded up by at most 2^-80 of themselves. A sum of fewer than 2^40 non-negative terms at 128
 * bits adds at most 2^-87 of itself, a maximum nothing, and the last rounding, to 64 bits, 2^-63. Bounds so
 * small that 64 bits would reach below 2^-DYD_EXP_LIMIT are rounded up to a multiple of that instead. */
#include "metric/bounds.h"

dyd_status dyd_bound_area(mpfr_ptr out, dyd_measure *m, const dyd_pair_list *pairs) {
  dyd_status st = DYD_OK;
  mpfr_t term;
  mpfr_init2(term, DYD_MEASURE_PREC);
  mpfr_set_zero(out, 1);
  for (size_t k = 0; k < pairs->count && st == DYD_OK; k++) {
    st = dyd_measure_area(term, m, pairs->item[k].i, pairs->item[k].j);
    mpfr_add(out, out, term, MPFR_RNDU);
  }
  mpfr_clear(term);
  return st;
}

dyd_status dyd_bound_pair_hausdorff(mpfr_ptr out, dyd_measure *m, const dyd_pair *pair) {
  if (pair->status != DYD_LEGAL) return dyd_measure_reach(out, m, pair->i, pair->j);
  dyd_status st = dyd_measure_diameter(out, m, pair->i);
  if (st != DYD_OK) return st;
  mpfr_t other;
  mpfr_init2(other, DYD_MEASURE_PREC);
  st = dyd_measure_diameter(other, m, pair->j);
  mpfr_max(out, out, other, MPFR_RNDU);
  mpfr_clear(other);
  return st;
}

dyd_status dyd_bound_hausdorff(mpfr_ptr out, dyd_measure *m, const dyd_pair_list *pairs) {
  dyd_status st = DYD_OK;
  mpfr_t term;
  mpfr_init2(term, DYD_MEASURE_PREC);
  mpfr_set_zero(out, 1);
  for (size_t k = 0; k < pairs->count && st == DYD_OK; k++) {
    st = dyd_bound_pair_hausdorff(term, m, &pairs->item[k]);
    mpfr_max(out, out, term, MPFR_RNDU);
  }
  mpfr_clear(term);
  return st;
}

dyd_status dyd_bound_to_dyadic(dyd_dyadic *out, mpfr_srcptr x) {
  if (mpfr_zero_p(x)) return dyd_dyadic_set_si_2exp(out, 0, 0);
  if (!mpfr_regular_p(x)) return DYD_E_RANGE;
  if (mpfr_cmp_ui_2exp(x, 1, -(mpfr_exp_t)DYD_EXP_LIMIT) <= 0) return dyd_dyadic_set_si_2exp(out, 1, -DYD_EXP_LIMIT);
  mpfr_t short_x;
  mpz_t man;
  mpz_init(man);
  mpfr_init2(short_x, 64);
  mpfr_set(short_x, x, MPFR_RNDU);
  mpfr_exp_t exp = mpfr_get_z_2exp(man, short_x);
  if (exp < -DYD_EXP_LIMIT) {
    mpz_cdiv_q_2exp(man, man, (mp_bitcnt_t)(-DYD_EXP_LIMIT - exp));
    exp = -DYD_EXP_LIMIT;
  }
  dyd_status st = dyd_dyadic_set_z_2exp(out, man, exp);
  mpfr_clear(short_x);
  mpz_clear(man);
  return st;
}

/* Where all are exact points and nothing is open every term of both bounds is zero. */
static bool bounds_are_zero(const dyd_delaunay *pd) {
  const dyd_sites *sites = dyd_delaunay_sites(pd);
  size_t count[4];
  dyd_delaunay_count(count, pd);
  bool zero = count[DYD_INDETERMINATE] == 0 && count[DYD_TIE] == 0;
  for (size_t i = 0; zero && i < dyd_sites_count(sites); i++) zero = dyd_sites_is_point(sites, i);
  return zero;
}

typedef dyd_status (*bound_fn)(mpfr_ptr out, dyd_measure *m, const dyd_pair_list *pairs);

static dyd_status metric_bound(dyd_dyadic *out, const dyd_delaunay *pd, bound_fn f) {
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  if (bounds_are_zero(pd)) return dyd_dyadic_set_si_2exp(out, 0, 0);
  dyd_pair_list pairs = {0};
  dyd_measure m;
  mpfr_t x;
  dyd_status st = dyd_delaunay_pairs(&pairs, pd);
  if (st == DYD_OK) {
    dyd_measure_init(&m, dyd_delaunay_sites(pd));
    mpfr_init2(x, DYD_MEASURE_PREC);
    st = f(x, &m, &pairs);
    if (st == DYD_OK) st = dyd_bound_to_dyadic(out, x);
    mpfr_clear(x);
    dyd_measure_clear(&m);
  }
  dyd_pair_list_clear(&pairs);
  return st;
}

dyd_status dyd_metric_area(dyd_dyadic *out, const dyd_delaunay *pd) {
  if (!pd) return DYD_E_ARG;
  return metric_bound(out, pd, dyd_bound_area);
}

dyd_status dyd_metric_hausdorff(dyd_dyadic *out, const dyd_delaunay *pd) {
  if (!pd) return DYD_E_ARG;
  return metric_bound(out, pd, dyd_bound_hausdorff);
}
