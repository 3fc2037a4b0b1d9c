/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What one pair of sites adds to the bounds: area, length and diameter, rounded up.
 *
 * The exact rung forms squares of lengths and twice the area as rationals and rounds up at most four times at
 * DYD_MEASURE_PREC bits (value, square root, sum): the excess is below 8 * 2^-127 of the value. */
#include "metric/measure.h"

#include "metric/measure_filter.h"
#include "rect/sites_table.h"

/* May pairs of site i be measured in doubles? */
static bool measure_in_doubles(const dyd_measure *m, size_t i) {
  return m->filter && dyd_sites_in_doubles(m->sites, i);
}

void dyd_measure_init(dyd_measure *m, const dyd_sites *sites) {
  m->sites = sites;
  m->filter = dyd_filter_measure_usable();
  dyd_rect_init(&m->a);
  dyd_rect_init(&m->b);
  for (size_t k = 0; k < 8; k++) mpq_init(m->end[k]);
  mpq_inits(m->sum, m->term, NULL);
  mpfr_init2(m->t, DYD_MEASURE_PREC);
}

void dyd_measure_clear(dyd_measure *m) {
  mpfr_clear(m->t);
  mpq_clears(m->sum, m->term, NULL);
  for (size_t k = 0; k < 8; k++) mpq_clear(m->end[k]);
  dyd_rect_clear(&m->b);
  dyd_rect_clear(&m->a);
}

static void mpfr_from_dd(mpfr_ptr out, const double dd[2]) {
  mpfr_set_d(out, dd[0], MPFR_RNDU);
  mpfr_add_d(out, out, dd[1], MPFR_RNDU);
}

/* Fetches R_i into a and end[0..3], R_j into b and end[4..7], in the order x lower, x upper, y lower, y upper. */
static dyd_status measure_fetch(dyd_measure *m, size_t i, size_t j) {
  dyd_status st = dyd_sites_get(&m->a, m->sites, i);
  if (st == DYD_OK) st = dyd_sites_get(&m->b, m->sites, j);
  if (st != DYD_OK) return st;
  dyd_interval_get_q(m->end[0], m->end[1], &m->a.x);
  dyd_interval_get_q(m->end[2], m->end[3], &m->a.y);
  dyd_interval_get_q(m->end[4], m->end[5], &m->b.x);
  dyd_interval_get_q(m->end[6], m->end[7], &m->b.y);
  return DYD_OK;
}

/* sum += max(p1 - q0, q1 - p0)^2 for the intervals at end[p] and end[q]. */
static void add_farthest2(dyd_measure *m, size_t p, size_t q) {
  mpq_t other;
  mpq_init(other);
  mpq_sub(m->term, m->end[p + 1], m->end[q]);
  mpq_sub(other, m->end[q + 1], m->end[p]);
  if (mpq_cmp(other, m->term) > 0) mpq_swap(other, m->term);
  mpq_mul(m->term, m->term, m->term);
  mpq_add(m->sum, m->sum, m->term);
  mpq_clear(other);
}

/* out = the largest distance of a point of the rectangle at end[p] to one at end[q]; p = q: the diameter. */
static void measure_farthest(mpfr_ptr out, dyd_measure *m, size_t p, size_t q) {
  mpq_set_ui(m->sum, 0, 1);
  add_farthest2(m, p, q);
  add_farthest2(m, p + 2, q + 2);
  mpfr_set_q(out, m->sum, MPFR_RNDU);
  mpfr_sqrt(out, out, MPFR_RNDU);
}

dyd_status dyd_measure_area(mpfr_ptr out, dyd_measure *m, size_t i, size_t j) {
  mpfr_set_zero(out, 1);
  if (dyd_sites_is_point(m->sites, i) && dyd_sites_is_point(m->sites, j)) return DYD_OK;
  double a[4], b[4], dd[2];
  if (measure_in_doubles(m, i) && measure_in_doubles(m, j)) {
    dyd_sites_get_d(a, m->sites, i);
    dyd_sites_get_d(b, m->sites, j);
    if (dyd_filter_partial_edge_area2(dd, a, b)) {
      mpfr_from_dd(out, dd);
      mpfr_div_2ui(out, out, 1, MPFR_RNDU);
      return DYD_OK;
    }
  }
  dyd_status st = measure_fetch(m, i, j);
  if (st != DYD_OK) return st;
  dyd_partial_edge_area2(m->sum, &m->a, &m->b);
  mpfr_set_q(out, m->sum, MPFR_RNDU);
  mpfr_div_2ui(out, out, 1, MPFR_RNDU);
  return DYD_OK;
}

dyd_status dyd_measure_diameter(mpfr_ptr out, dyd_measure *m, size_t i) {
  mpfr_set_zero(out, 1);
  if (dyd_sites_is_point(m->sites, i)) return DYD_OK;
  double a[4], dd[2];
  if (measure_in_doubles(m, i)) {
    dyd_sites_get_d(a, m->sites, i);
    if (dyd_filter_diameter(dd, a)) {
      mpfr_from_dd(out, dd);
      return DYD_OK;
    }
  }
  dyd_status st = measure_fetch(m, i, i);
  if (st == DYD_OK) measure_farthest(out, m, 0, 0);
  return st;
}

dyd_status dyd_measure_reach(mpfr_ptr out, dyd_measure *m, size_t i, size_t j) {
  double a[4], b[4], dd[2];
  if (measure_in_doubles(m, i) && measure_in_doubles(m, j)) {
    dyd_sites_get_d(a, m->sites, i);
    dyd_sites_get_d(b, m->sites, j);
    if (dyd_filter_reach(dd, a, b)) {
      mpfr_from_dd(out, dd);
      return DYD_OK;
    }
  }
  dyd_status st = measure_fetch(m, i, j);
  if (st != DYD_OK) return st;
  measure_farthest(out, m, 0, 0);
  measure_farthest(m->t, m, 4, 4);
  mpfr_max(m->t, m->t, out, MPFR_RNDU);
  measure_farthest(out, m, 0, 4);
  mpfr_div_2ui(out, out, 1, MPFR_RNDU);
  mpfr_add(out, out, m->t, MPFR_RNDU);
  return DYD_OK;
}

/* sum += the square of the gap between the intervals at end[p] and end[q]. */
static void add_gap2(dyd_measure *m, size_t p, size_t q) {
  mpq_sub(m->term, m->end[q], m->end[p + 1]);
  if (mpq_sgn(m->term) <= 0) mpq_sub(m->term, m->end[p], m->end[q + 1]);
  if (mpq_sgn(m->term) <= 0) return;
  mpq_mul(m->term, m->term, m->term);
  mpq_add(m->sum, m->sum, m->term);
}

dyd_status dyd_measure_gap(mpfr_ptr out, dyd_measure *m, size_t i, size_t j) {
  dyd_status st = measure_fetch(m, i, j);
  if (st != DYD_OK) return st;
  mpq_set_ui(m->sum, 0, 1);
  add_gap2(m, 0, 4);
  add_gap2(m, 2, 6);
  mpfr_set_q(out, m->sum, MPFR_RNDD);
  mpfr_sqrt(out, out, MPFR_RNDD);
  return DYD_OK;
}
