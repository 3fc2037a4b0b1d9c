/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Areas in double-double arithmetic, of metric/measure_filter.c. */
#include "metric/measure_filter.c" /* functions are static */
#include "vectors.h"

static dd dd_at(const double *x, int k) {
  return (dd){x[2 * k], x[2 * k + 1]};
}
static void say_dd(answer *a, dd y) {
  say_double(a, y.h);
  say_double(a, y.l);
}

static void ask_two_sum(answer *a, const double *x) {
  say_dd(a, two_sum(x[0], x[1]));
}
static void ask_fast_two_sum(answer *a, const double *x) {
  say_dd(a, fast_two_sum(x[0], x[1]));
}
static void ask_sub_d(answer *a, const double *x) {
  say_dd(a, dd_sub_d(x[0], x[1]));
}
static void ask_dd_add(answer *a, const double *x) {
  say_dd(a, dd_add(dd_at(x, 0), dd_at(x, 1)));
}
static void ask_dd_mul(answer *a, const double *x) {
  say_dd(a, dd_mul(dd_at(x, 0), dd_at(x, 1)));
}
static void ask_inflate(answer *a, const double *x) {
  double out[2];
  dd_inflate(out, dd_at(x, 0));
  say_doubles(a, out, 2);
}
static void ask_lead_in_range(answer *a, const double *x) {
  say_integer(a, dd_lead_in_range(dd_at(x, 0)));
}

/* ---- rectangles ---- */

static void ask_axis(answer *a, const double *x) {
  hull_axis y;
  bool good = area2_axis_set(&y, x, x + 2);
  say_dd(a, y.wa);
  say_dd(a, y.wb);
  say_dd(a, y.low);
  say_dd(a, y.high);
  say_integer(a, y.b_low);
  say_integer(a, y.b_high);
  say_integer(a, good);
}
static void ask_axes(answer *a, const double *x, dd (*of)(const hull_axis *, const hull_axis *)) {
  hull_axis p, q;
  area2_axis_set(&p, x, x + 2);
  area2_axis_set(&q, x + 4, x + 6);
  say_dd(a, of(&p, &q));
}
static void ask_one(answer *a, const double *x) {
  ask_axes(a, x, area2_one);
}
static void ask_corner(answer *a, const double *x) {
  ask_axes(a, x, area2_corner);
}
static void ask_cross(answer *a, const double *x) {
  ask_axes(a, x, area2_cross);
}
static void ask_edge_area2(answer *a, const double *x) {
  double out[2];
  if (dyd_filter_partial_edge_area2(out, x, x + 4))
    say_doubles(a, out, 2);
  else
    say_none(a);
}

/* Two intervals on each axis, in any order of their ends; at the limits of the allowed range, too. */
static void choose_rectangles(double *x, unsigned inputs, const kind *k) {
  static const int bases[] = {0, 0, 0, 10, -30, 399, 400, -399, -400, -401, -1030};
  kind within = *k;
  within.base = bases[test_below(&shared, sizeof bases / sizeof *bases)];
  choose_intervals(x, inputs, &within);
  if (test_chance(&shared, 4)) x[test_below(&shared, inputs)] = x[test_below(&shared, inputs)];
}
static void choose_lead(double *x, unsigned inputs, const kind *k) {
  (void)inputs;
  if (test_chance(&shared, 2))
    x[0] = ldexp(1 + test_unit(&shared) * (double)test_below(&shared, 2), test_chance(&shared, 2) ? 400 : -400);
  if (test_chance(&shared, 4)) x[0] = number(k) * 0;
}

static const function area[] = {{"two_sum", 2, ask_two_sum, NULL, 0, 0},
                                {"fast_two_sum", 2, ask_fast_two_sum, NULL, 0, 0},
                                {"dd_sub_d", 2, ask_sub_d, NULL, 0, 0},
                                {"dd_add", 4, ask_dd_add, NULL, 0, 0},
                                {"dd_mul", 4, ask_dd_mul, NULL, 0, 0},
                                {"dd_inflate", 2, ask_inflate, NULL, 0, 0},
                                {"dd_lead_in_range", 2, ask_lead_in_range, choose_lead, 4, 0},
                                {"area2_axis_set", 4, ask_axis, choose_rectangles, 0, 0},
                                {"area2_one", 8, ask_one, choose_rectangles, 0, 0},
                                {"area2_corner", 8, ask_corner, choose_rectangles, 0, 0},
                                {"area2_cross", 8, ask_cross, choose_rectangles, 0, 0},
                                {"dyd_filter_partial_edge_area2", 8, ask_edge_area2, choose_rectangles, 0, 0}};

void vectors_of_areas(const kind *k) {
  put_vectors(area, sizeof area / sizeof *area, k);
}
