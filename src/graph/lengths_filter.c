/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lengths in doubles, bounded as [FLT-DST] has it.
 *
 * Where no step rounds, which the errors of sum and product being 0 shows (Knuth's two-sum; fma), the square is known
 * itself: on grids most lengths are equal, and equal doubles need no integers. */
#include "graph/lengths.h"
#include "rect/sites_table.h"

#include <math.h>

/* *out = x + y; false: that rounds, or may. */
static bool exact_sum(double *out, double x, double y) {
  double s = x + y, t = s - x;
  *out = s;
  return (x - (s - t)) + (y - t) == 0 && fabs(s) < 0x1p500;
}

static bool exact_square(double *out, double x) {
  *out = x * x;
  return fma(x, x, -*out) == 0 && (x == 0 || *out > 0x1p-900);
}

/* The difference of the coordinates along an axis whose square counts. */
static bool exact_side(double *out, const double a[2], const double b[2], bool largest) {
  double d[2];
  bool exact = exact_sum(&d[0], b[0], -a[1]);
  exact = exact_sum(&d[1], a[0], -b[1]) && exact;
  if (largest)
    *out = fmax(-d[0], -d[1]);
  else
    *out = fmax(0, fmax(d[0], d[1]));
  return exact;
}

static bool exact_length2(double *out, const dyd_bbox *a, const dyd_bbox *b, bool largest) {
  double x, y, xx, yy;
  bool exact = exact_side(&x, a->e, b->e, largest) && exact_side(&y, a->e + 2, b->e + 2, largest);
  return exact && exact_square(&xx, x) && exact_square(&yy, y) && exact_sum(out, xx, yy);
}

dyd_length dyd_filter_length(const dyd_graph_work *w, uint32_t pair, bool largest) {
  uint32_t i = w->pairs.item[pair].i, j = w->pairs.item[pair].j;
  const dyd_bbox *a = &w->box[i], *b = &w->box[j];
  dyd_length l = {w, 0, HUGE_VAL, pair, largest};
  if (dyd_sites_is_point(w->sites, i) && dyd_sites_is_point(w->sites, j)) largest = l.largest = false;
  bool held = dyd_sites_in_doubles(w->sites, i) && dyd_sites_in_doubles(w->sites, j);
  if (held && exact_length2(&l.lo, a, b, largest)) {
    l.hi = l.lo;
    return l;
  }
  l.lo = dyd_ds2_lower(a, b);
  l.hi = dyd_dl2_upper(a, b);
  if (held && largest) l.lo = l.hi * (1 - 0x1p-46) - DYD_TINY;
  if (held && !largest && l.lo < DBL_MAX / 8) l.hi = (l.lo + DYD_TINY) * (1 + 0x1p-46) + DYD_TINY;
  if (!(l.lo <= l.hi && l.lo < HUGE_VAL)) l = (dyd_length){w, 0, HUGE_VAL, pair, largest};
  return l;
}
