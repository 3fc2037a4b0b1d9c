/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is asked of points in doubles when a boundary is looked for. */
#include "voronoi/outline_filter.h"

int dyd_outline_order(bool *unsure, dyd_iv a, dyd_iv b) {
  if (a.lo > b.hi) return 1;
  if (a.hi < b.lo) return -1;
  if (!(a.lo == a.hi && b.lo == b.hi)) *unsure = true;
  return 0;
}

/* A lower or upper bound of the squared distance to box k of all points in c. */
static double outline_distance2(const dyd_outline *o, const dyd_bbox *c, size_t k, bool farthest, bool upper) {
  const double *e = o->near[k].outer;
  const dyd_bbox b = {{e[0], e[1], e[2], e[3]}};
  if (farthest) return upper ? dyd_dl2_upper(c, &b) : dyd_dl2_lower(c, &b, o->slack[k]);
  return upper ? dyd_ds2_upper(c, &b, o->slack[k]) : dyd_ds2_lower(c, &b);
}

bool dyd_outline_taken(bool *doubt, dyd_outline *o, size_t own, const dyd_iv at[2]) {
  const dyd_bbox c = {{at[0].lo, at[0].hi, at[1].lo, at[1].hi}};
  double least = outline_distance2(o, &c, o->count, !o->outer, false);
  double most = doubt ? outline_distance2(o, &c, o->count, !o->outer, true) : 0;
  for (size_t m = 0; m <= o->count; m++) {
    size_t k = m ? m - 1 : o->taker;
    if (k >= o->count || k == own || o->drop[k]) continue;
    if (outline_distance2(o, &c, k, o->outer, true) < least) return o->taker = k, true;
    if (doubt && !(outline_distance2(o, &c, k, o->outer, false) > most)) *doubt = true;
  }
  return false;
}
