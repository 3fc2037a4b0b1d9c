/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Hulls of two boxes and distances to boxes, in interval arithmetic.
 *
 * Any direction that separates the outer boxes surely, rounded or not, shows that the hulls are disjoint. Conversely
 * [HULL-1] names ten directions that suffice: for exact boxes, where none of them can separate, the hulls meet. The
 * sign of a difference of two doubles is the sign of the rounded difference, subnormals included, so the support
 * corner is the right one. */
#include "predicate/predicate_filter.h"

/* Values of nx x + ny y on box a: enclosures of the least and the largest. */
static void box_support(dyd_iv *least, dyd_iv *largest, dyd_iv nx, dyd_iv ny, const dyd_box *a) {
  int x = nx.lo + nx.hi < 0, y = ny.lo + ny.hi < 0;
  *least = dyd_iv_add(dyd_iv_mul(nx, dyd_iv_point(a->outer[x])), dyd_iv_mul(ny, dyd_iv_point(a->outer[2 + y])));
  *largest = dyd_iv_add(dyd_iv_mul(nx, dyd_iv_point(a->outer[!x])), dyd_iv_mul(ny, dyd_iv_point(a->outer[3 - y])));
}

/* TRUE: surely all of p is below all of q; FALSE: surely not; from the supports. */
static dyd_truth supports_below(const dyd_iv largest[2], const dyd_iv least[2]) {
  bool all = true;
  for (int i = 0; i < 2; i++) {
    for (int j = 0; j < 2; j++) {
      if (largest[i].lo >= least[j].hi) return DYD_FALSE;
      all = all && largest[i].hi < least[j].lo;
    }
  }
  return all ? DYD_TRUE : DYD_UNKNOWN;
}

/* Does the direction separate?  box: p[0], p[1], q[0], q[1]. */
static dyd_truth direction_separates(dyd_iv nx, dyd_iv ny, const dyd_box *const box[4]) {
  dyd_iv least[4], largest[4];
  for (int k = 0; k < 4; k++) box_support(&least[k], &largest[k], nx, ny, box[k]);
  dyd_truth up = supports_below(largest, least + 2);
  if (up == DYD_TRUE) return DYD_TRUE;
  dyd_truth down = supports_below(largest + 2, least);
  if (down == DYD_TRUE) return DYD_TRUE;
  return up == DYD_FALSE && down == DYD_FALSE ? DYD_FALSE : DYD_UNKNOWN;
}

static double lesser_end(double a, double b) {
  return a < b ? a : b;
}
static double larger_end(double a, double b) {
  return a > b ? a : b;
}

static bool axis_separates(const dyd_box *const box[4], int lo, int hi) {
  double p0 = lesser_end(box[0]->outer[lo], box[1]->outer[lo]), p1 = larger_end(box[0]->outer[hi], box[1]->outer[hi]);
  double q0 = lesser_end(box[2]->outer[lo], box[3]->outer[lo]), q1 = larger_end(box[2]->outer[hi], box[3]->outer[hi]);
  return p1 < q0 || q1 < p0;
}

dyd_truth dyd_filter_partial_edges_disjoint(const dyd_box *a, const dyd_box *b, const dyd_box *c, const dyd_box *d) {
  const dyd_box *const box[4] = {a, b, c, d};
  if (axis_separates(box, 0, 1) || axis_separates(box, 2, 3)) return DYD_TRUE;
  bool meet = a->exact && b->exact && c->exact && d->exact;
  for (int join = 0; join < 8; join++) {
    const dyd_box *const *e = join < 4 ? box : box + 2;
    int x = join & 1, y = 2 + (join >> 1 & 1);
    dyd_iv dx = dyd_iv_point(e[1]->outer[x] - e[0]->outer[x]), dy = dyd_iv_point(e[0]->outer[y] - e[1]->outer[y]);
    if (dx.lo == 0 && dy.lo == 0) continue;
    if (meet) {
      dx = (dyd_iv){dx.lo == 0 ? 0 : dyd_down(dx.lo), dx.hi == 0 ? 0 : dyd_up(dx.hi)};
      dy = (dyd_iv){dy.lo == 0 ? 0 : dyd_down(dy.lo), dy.hi == 0 ? 0 : dyd_up(dy.hi)};
    }
    dyd_truth answer = direction_separates(dy, dx, box);
    if (answer == DYD_TRUE) return DYD_TRUE;
    if (answer == DYD_UNKNOWN) meet = false;
  }
  return meet ? DYD_FALSE : DYD_UNKNOWN;
}

/* Squared distance from c to [lo,hi] along one axis. t = max(lo - c, c - hi, 0), or max(c - lo, hi - c). */
static dyd_iv axis_distance2(dyd_iv c, dyd_iv lo, dyd_iv hi, dyd_touch touch) {
  bool far = touch == DYD_FARTHEST;
  dyd_iv s = far ? dyd_iv_sub(c, lo) : dyd_iv_sub(lo, c), t = far ? dyd_iv_sub(hi, c) : dyd_iv_sub(c, hi);
  if (isnan(s.lo + s.hi + t.lo + t.hi)) return DYD_IV_UNKNOWN;
  dyd_iv d = {larger_end(larger_end(s.lo, t.lo), 0), larger_end(larger_end(s.hi, t.hi), 0)};
  return dyd_iv_sqr(d);
}

dyd_iv dyd_filter_distance2(dyd_iv cx, dyd_iv cy, const dyd_box *r, dyd_touch touch) {
  return dyd_iv_add(axis_distance2(cx, r->end[0], r->end[1], touch), axis_distance2(cy, r->end[2], r->end[3], touch));
}
