/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Upper bounds in doubles that spare the exact work for pairs that do not count.
 *
 * Squared distances are bounded as in [FLT-DST]; square roots, sums, products and quotients of those carry at most 12
 * relative errors u = 2^-53, and the factor 1 + 32 u covers them. Quotients below are taken only of denominators of at
 * least 2^-300, so that underflow cannot make a bound too small by more than DYD_TINY, which is added. */
#include "metric/voronoi_filter.h"

#define SAFE (1 + 32 * 0x1p-53)

static dyd_bbox box_of_dyadic_point(const dyd_point *z) {
  return (dyd_bbox){{dyd_dyadic_get_d(&z->x, DYD_DOWN), dyd_dyadic_get_d(&z->x, DYD_UP),
                     dyd_dyadic_get_d(&z->y, DYD_DOWN), dyd_dyadic_get_d(&z->y, DYD_UP)}};
}

double dyd_filter_reach_of_shape(const dyd_shape *s, const double box[4]) {
  dyd_bbox own = {{box[0], box[1], box[2], box[3]}};
  double most = -1;
  if (s->in_doubles) {
    for (uint32_t k = 0; k < s->outer_count; k++) {
      dyd_bbox c = {{s->outer[k].x, s->outer[k].x, s->outer[k].y, s->outer[k].y}};
      most = dyd_max(most, dyd_dl2_upper(&c, &own));
    }
    return most < 0 ? most : sqrt(most) * SAFE;
  }
  for (size_t p = 0; p < s->outer_exact.count; p++)
    for (size_t k = 0; k < s->outer_exact.item[p].count; k++) {
      dyd_bbox c = box_of_dyadic_point(&s->outer_exact.item[p].vertex[k]);
      double d = dyd_dl2_upper(&c, &own);
      most = d <= DBL_MAX ? dyd_max(most, d) : HUGE_VAL;
    }
  return most < 0 ? most : sqrt(most) * SAFE;
}

static double box_diameter_upper(const double a[4]) {
  double x = a[1] - a[0], y = a[3] - a[2];
  return sqrt(dyd_upper(x * x + y * y)) * SAFE;
}

double dyd_filter_voronoi_pair(const double a[4], const double b[4], double ra, double rb) {
  dyd_bbox p = {{a[0], a[1], a[2], a[3]}}, q = {{b[0], b[1], b[2], b[3]}};
  double gap = dyd_ds2_lower(&p, &q); /* over centres in p: the distance of the boxes */
  if (!(gap >= 0x1p-600)) return HUGE_VAL;
  double value = (box_diameter_upper(a) + box_diameter_upper(b)) * (ra + rb) / (2 * sqrt(gap)) * SAFE + DYD_TINY;
  return value <= DBL_MAX ? value : HUGE_VAL;
}

double dyd_filter_extent(bool *disjoint, const dyd_sites *s, const dyd_rect *window) {
  double all[4], most_lo[2] = {-HUGE_VAL, -HUGE_VAL}, least_hi[2] = {HUGE_VAL, HUGE_VAL};
  dyd_interval_get_d(&all[0], &all[1], &window->x);
  dyd_interval_get_d(&all[2], &all[3], &window->y);
  size_t n = dyd_sites_count(s);
  for (size_t i = 0; i < n; i++) {
    double b[4];
    dyd_sites_get_d(b, s, i);
    for (int axis = 0; axis < 2; axis++) {
      all[2 * axis] = dyd_min(all[2 * axis], b[2 * axis]);
      all[2 * axis + 1] = dyd_max(all[2 * axis + 1], b[2 * axis + 1]);
      most_lo[axis] = dyd_max(most_lo[axis], b[2 * axis]);
      least_hi[axis] = dyd_min(least_hi[axis], b[2 * axis + 1]);
    }
  }
  *disjoint = most_lo[0] > least_hi[0] || most_lo[1] > least_hi[1];
  return box_diameter_upper(all);
}
