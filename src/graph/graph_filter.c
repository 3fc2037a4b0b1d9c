/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Neighbours in doubles.
 *
 * Distances from a box of centres to a box are bounded as [FLT-DST] has it. "Never" and "sure" hold for all places of
 * the outward boxes; "possible" is shown by one choice of places, which are doubles in boxes that doubles hold. A
 * middle (a + b) / 2 is rounded once (halving is exact, or off by 2^-1075), so it lies between the doubles next to it;
 * half of a diameter, squared, is a quarter of its square, up to underflow, which DYD_TINY covers four times over. */
#include "graph/graph.h"
#include "rect/sites_table.h"

#include <math.h>

/* ---- lengths ---- */

/* Where no step rounds, which the errors of sum and product being 0 shows (Knuth's two-sum; fma), the square is known
 * itself: on grids most lengths are equal, and equal doubles need no integers. */
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

/* ---- discs ---- */

static dyd_iv iv_norm(dyd_iv x, dyd_iv y) {
  return dyd_iv_sqrt(dyd_iv_add(dyd_iv_sqr(x), dyd_iv_sqr(y)));
}

/* The lengths of the pair for all choices in the discs: from lo to hi. */
static dyd_iv ball_lengths(const dyd_graph_work *w, uint32_t i, uint32_t j) {
  const dyd_iv *a = w->ball[i], *b = w->ball[j];
  dyd_iv d = iv_norm(dyd_iv_sub(a[0], b[0]), dyd_iv_sub(a[1], b[1])), r = dyd_iv_add(a[2], b[2]);
  double lo = dyd_iv_sub(d, r).lo, hi = dyd_iv_add(d, r).hi;
  return (dyd_iv){lo > 0 ? lo : 0, hi >= 0 ? hi : HUGE_VAL};
}

dyd_graph_status dyd_filter_ball_nearest(const dyd_graph_work *w, uint32_t i, uint32_t j) {
  dyd_iv own = ball_lengths(w, i, j);
  bool sure = true;
  for (size_t q = 0; q < w->others; q++) {
    if (w->other[q] == j) continue;
    dyd_iv length = ball_lengths(w, i, w->other[q]);
    if (length.hi < own.lo) return DYD_GRAPH_NEVER;
    sure = sure && own.hi < length.lo;
  }
  return sure ? DYD_GRAPH_SURE : DYD_GRAPH_POSSIBLE;
}

/* (p_i - p_k).(p_j - p_k) for all choices [GRD-1]. */
static dyd_iv ball_product(const dyd_iv *i, const dyd_iv *j, const dyd_iv *k) {
  dyd_iv a[2], b[2], product = dyd_iv_point(0), half = dyd_iv_scale(dyd_iv_add(i[2], j[2]), 0.5);
  for (int c = 0; c < 2; c++) {
    a[c] = dyd_iv_sub(i[c], k[c]);
    b[c] = dyd_iv_sub(j[c], k[c]);
    product = dyd_iv_add(product, dyd_iv_mul(a[c], b[c]));
  }
  dyd_iv spread = dyd_iv_mul(k[2], iv_norm(dyd_iv_add(a[0], b[0]), dyd_iv_add(a[1], b[1])));
  spread = dyd_iv_add(spread, dyd_iv_mul(j[2], iv_norm(a[0], a[1])));
  spread = dyd_iv_add(spread, dyd_iv_mul(i[2], iv_norm(b[0], b[1])));
  dyd_iv lo = dyd_iv_sub(dyd_iv_sub(product, spread), dyd_iv_sqr(half));
  return (dyd_iv){lo.lo, dyd_iv_add(dyd_iv_add(product, spread), dyd_iv_sqr(dyd_iv_add(half, k[2]))).hi};
}

dyd_graph_status dyd_filter_ball_gabriel(const dyd_graph_work *w, uint32_t i, uint32_t j) {
  bool sure = true;
  for (size_t q = w->start[i]; q < w->start[i + 1]; q++) {
    if (w->partner[q] == j) continue;
    dyd_iv product = ball_product(w->ball[i], w->ball[j], w->ball[w->partner[q]]);
    if (product.hi < 0) return DYD_GRAPH_NEVER;
    sure = sure && product.lo > 0;
  }
  return sure ? DYD_GRAPH_SURE : DYD_GRAPH_POSSIBLE;
}

dyd_length dyd_filter_length(const dyd_graph_work *w, uint32_t pair, bool largest) {
  uint32_t i = w->pairs.item[pair].i, j = w->pairs.item[pair].j;
  if (w->discs) {
    dyd_iv length = ball_lengths(w, i, j);
    double end = largest ? length.hi : length.lo;
    return (dyd_length){w, end, end, pair, largest};
  }
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

/* ---- one pair ---- */

static const dyd_graph_verdict unsure = {false, DYD_GRAPH_POSSIBLE};

static dyd_graph_verdict sure_of(dyd_graph_status status) {
  return (dyd_graph_verdict){true, status};
}

void dyd_filter_nearest_few(dyd_graph_work *w, uint32_t i) {
  const uint32_t *partner = &w->partner[w->start[i]];
  size_t count = w->start[i + 1] - w->start[i];
  double least = HUGE_VAL;
  w->others = 0;
  for (size_t k = 0; k < count; k++) least = fmin(least, dyd_dl2_upper(&w->box[i], &w->box[partner[k]]));
  for (size_t k = 0; k < count; k++)
    if (!(dyd_ds2_lower(&w->box[i], &w->box[partner[k]]) > least)) w->other[w->others++] = partner[k];
}

/* The place of a box that is nearest to another place. */
static dyd_bbox nearest_place(const dyd_bbox *b, const dyd_bbox *to) {
  double x = dyd_max(b->e[0], dyd_min(b->e[1], to->e[0])), y = dyd_max(b->e[2], dyd_min(b->e[3], to->e[2]));
  return (dyd_bbox){{x, x, y, y}};
}

/* All k but j are farther than the bound for certain; at least as far for some choice. */
static bool all_beyond(const dyd_graph_work *w, const dyd_bbox *at, double bound2, const uint32_t *k, size_t count,
                       uint32_t j) {
  for (size_t q = 0; q < count; q++)
    if (k[q] != j && !(dyd_ds2_lower(at, &w->box[k[q]]) > bound2)) return false;
  return true;
}

static bool all_may_be_beyond(const dyd_graph_work *w, const dyd_bbox *at, double bound2, const uint32_t *k,
                              size_t count, uint32_t j) {
  for (size_t q = 0; q < count; q++)
    if (k[q] != j && !(dyd_sites_in_doubles(w->sites, k[q]) && dyd_dl2_lower(at, &w->box[k[q]], 0) >= bound2))
      return false;
  return true;
}

static bool both_in_doubles(const dyd_graph_work *w, uint32_t i, uint32_t j) {
  return dyd_sites_in_doubles(w->sites, i) && dyd_sites_in_doubles(w->sites, j);
}

dyd_graph_verdict dyd_filter_nearest(const dyd_graph_work *w, uint32_t i, uint32_t j) {
  const dyd_bbox *a = &w->box[i], *b = &w->box[j];
  bool known = both_in_doubles(w, i, j);
  dyd_bbox at = nearest_place(a, b);
  if (all_beyond(w, a, dyd_dl2_upper(a, b), w->other, w->others, j)) return sure_of(DYD_GRAPH_SURE);
  for (size_t q = 0; q < w->others; q++)
    if (w->other[q] != j && dyd_dl2_upper(a, &w->box[w->other[q]]) < dyd_ds2_lower(a, b))
      return sure_of(DYD_GRAPH_NEVER);
  bool rival = false;
  for (size_t q = 0; q < w->others && known && !rival; q++)
    rival = w->other[q] != j && dyd_sites_in_doubles(w->sites, w->other[q]) &&
            dyd_ds2_upper(&at, &w->box[w->other[q]], 0) <= dyd_dl2_lower(&at, b, 0);
  if (rival && all_may_be_beyond(w, &at, dyd_ds2_upper(&at, b, 0), w->other, w->others, j))
    return sure_of(DYD_GRAPH_POSSIBLE);
  return unsure;
}

/* Around all middles of places of a and b. */
static dyd_bbox middle_box(const dyd_bbox *a, const dyd_bbox *b) {
  dyd_bbox m;
  for (int e = 0; e < 4; e++) m.e[e] = nextafter(0.5 * a->e[e] + 0.5 * b->e[e], e & 1 ? HUGE_VAL : -HUGE_VAL);
  return m;
}

/* The corner of a box that is farthest from a place. */
static dyd_bbox farthest_place(const dyd_bbox *b, const dyd_bbox *from) {
  double x = from->e[0] - b->e[0] > b->e[1] - from->e[0] ? b->e[0] : b->e[1];
  double y = from->e[2] - b->e[2] > b->e[3] - from->e[2] ? b->e[2] : b->e[3];
  return (dyd_bbox){{x, x, y, y}};
}

/* Returns true if a site is in the closed disc for some choice. The choice tried: i and j far apart. */
static bool has_gabriel_rival(const dyd_graph_work *w, uint32_t i, uint32_t j) {
  const uint32_t *k = &w->partner[w->start[i]];
  dyd_bbox q = farthest_place(&w->box[j], &w->box[i]), p = farthest_place(&w->box[i], &q), m = middle_box(&p, &q);
  double radius2 = 0.25 * dyd_dl2_lower(&p, &q, 0);
  for (size_t at = 0; at < w->start[i + 1] - w->start[i]; at++)
    if (k[at] != j && dyd_sites_in_doubles(w->sites, k[at]) && dyd_ds2_upper(&m, &w->box[k[at]], 0) <= radius2)
      return true;
  return false;
}

/* Possible, with i and j near one another, and not certain? */
static dyd_graph_verdict open_gabriel(const dyd_graph_work *w, uint32_t i, uint32_t j) {
  if (!both_in_doubles(w, i, j) || !has_gabriel_rival(w, i, j)) return unsure;
  dyd_bbox q = nearest_place(&w->box[j], &w->box[i]), p = nearest_place(&w->box[i], &q);
  q = nearest_place(&w->box[j], &p);
  dyd_bbox m = middle_box(&p, &q);
  double radius2 = 0.25 * dyd_dl2_upper(&p, &q);
  bool may = all_may_be_beyond(w, &m, radius2, &w->partner[w->start[i]], w->start[i + 1] - w->start[i], j);
  return may ? sure_of(DYD_GRAPH_POSSIBLE) : unsure;
}

dyd_graph_verdict dyd_filter_gabriel(const dyd_graph_work *w, uint32_t i, uint32_t j) {
  const dyd_bbox *a = &w->box[i], *b = &w->box[j];
  const uint32_t *k = &w->partner[w->start[i]];
  size_t count = w->start[i + 1] - w->start[i];
  dyd_bbox m = middle_box(a, b);
  double least = 0.25 * dyd_ds2_lower(a, b), most = 0.25 * dyd_dl2_upper(a, b);
  if (all_beyond(w, &m, most, k, count, j)) return sure_of(DYD_GRAPH_SURE);
  for (size_t q = 0; q < count; q++)
    if (k[q] != j && dyd_dl2_upper(&m, &w->box[k[q]]) < least) return sure_of(DYD_GRAPH_NEVER);
  return open_gabriel(w, i, j);
}
