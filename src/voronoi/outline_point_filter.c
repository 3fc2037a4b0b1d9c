/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is asked of points in doubles when a boundary is looked for. */
#include "voronoi/outline_filter.h"

int dyd_outline_order(bool *unsure, dyd_iv a, dyd_iv b) {
  if (a.lo > b.hi) return 1;
  if (a.hi < b.lo) return -1;
  if (!(a.lo == a.hi && b.lo == b.hi)) *unsure = true;
  return 0;
}

bool dyd_outline_taken(bool *doubt, dyd_outline *o, size_t own, const dyd_iv at[2]) {
  dyd_touch fixed = o->outer ? DYD_CLOSEST : DYD_FARTHEST, other = o->outer ? DYD_FARTHEST : DYD_CLOSEST;
  dyd_iv radius = dyd_filter_distance2(at[0], at[1], &o->near[o->count], fixed);
  for (size_t m = 0; m <= o->count; m++) {
    size_t k = m ? m - 1 : o->taker;
    if (k >= o->count || k == own || o->drop[k]) continue;
    dyd_iv d = dyd_filter_distance2(at[0], at[1], &o->near[k], other);
    if (d.hi < radius.lo) return o->taker = k, true;
    if (!(d.lo > radius.hi)) *doubt = true;
  }
  return false;
}
