/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Interval arithmetic of predicate/interval_filter.h; signs of boxes; roots in intervals. */
#include "legal/witness_filter.c" /* functions are static */
#include "predicate/predicate_filter.c"
#include "vectors.h"

static dyd_iv iv_at(const double *x, int k) {
  return (dyd_iv){x[2 * k], x[2 * k + 1]};
}
static void say_iv(answer *a, dyd_iv y) {
  say_double(a, y.lo);
  say_double(a, y.hi);
}

static void ask_down(answer *a, const double *x) {
  say_double(a, dyd_down(x[0]));
}
static void ask_up(answer *a, const double *x) {
  say_double(a, dyd_up(x[0]));
}
static void ask_iv_point(answer *a, const double *x) {
  say_iv(a, dyd_iv_point(x[0]));
}
static void ask_iv_neg(answer *a, const double *x) {
  say_iv(a, dyd_iv_neg(iv_at(x, 0)));
}
static void ask_iv_add(answer *a, const double *x) {
  say_iv(a, dyd_iv_add(iv_at(x, 0), iv_at(x, 1)));
}
static void ask_iv_sub(answer *a, const double *x) {
  say_iv(a, dyd_iv_sub(iv_at(x, 0), iv_at(x, 1)));
}
static void ask_iv_scale(answer *a, const double *x) {
  say_iv(a, dyd_iv_scale(iv_at(x, 0), x[2]));
}
static void ask_iv_span4(answer *a, const double *x) {
  say_iv(a, dyd_iv_span4(x[0], x[1], x[2], x[3]));
}
static void ask_iv_mul(answer *a, const double *x) {
  say_iv(a, dyd_iv_mul(iv_at(x, 0), iv_at(x, 1)));
}
static void ask_iv_div(answer *a, const double *x) {
  say_iv(a, dyd_iv_div(iv_at(x, 0), iv_at(x, 1)));
}
static void ask_iv_sqr(answer *a, const double *x) {
  say_iv(a, dyd_iv_sqr(iv_at(x, 0)));
}
static void ask_iv_sqrt(answer *a, const double *x) {
  say_iv(a, dyd_iv_sqrt(iv_at(x, 0)));
}
static void ask_iv_sign(answer *a, const double *x) {
  say_integer(a, dyd_iv_sign(iv_at(x, 0)));
}
static void ask_iv_det2(answer *a, const double *x) {
  say_iv(a, iv_det2(iv_at(x, 0), iv_at(x, 1), iv_at(x, 2), iv_at(x, 3)));
}
static void ask_sign_of_boxes(answer *a, const double *x) {
  say_integer(a, sign_of_boxes(x, x + 4, x + 8));
}
static void ask_incircle(answer *a, const double *x) {
  dyd_sure s = dyd_filter_incircle(x, x + 4, x + 8, x + 12);
  say_integer(a, s == DYD_SURE_PLUS ? 1 : s == DYD_SURE_MINUS ? -1 : 0);
}
static void ask_farther_along(answer *a, const double *x) {
  say_double(a, farther_along(iv_at(x, 0), x[2], x[3], x[4], x[5]));
}
static void ask_is_farther(answer *a, const double *x) {
  dyd_bbox c = {{x[0], x[1], x[2], x[3]}}, s = {{x[4], x[5], x[6], x[7]}}, k = {{x[8], x[9], x[10], x[11]}};
  say_integer(a, dyd_filter_is_farther(&c, &s, &k));
}

static const function interval[] = {{"dyd_down", 1, ask_down, NULL, 0, 0},
                                    {"dyd_up", 1, ask_up, NULL, 0, 0},
                                    {"dyd_iv_point", 1, ask_iv_point, NULL, 0, 0},
                                    {"dyd_iv_neg", 2, ask_iv_neg, choose_intervals, 0, 0},
                                    {"dyd_iv_add", 4, ask_iv_add, choose_intervals, 0, 0},
                                    {"dyd_iv_sub", 4, ask_iv_sub, choose_intervals, 0, 0},
                                    {"dyd_iv_scale", 3, ask_iv_scale, choose_intervals, 0, 0},
                                    {"dyd_iv_span4", 4, ask_iv_span4, NULL, 0, 0},
                                    {"dyd_iv_mul", 4, ask_iv_mul, choose_intervals, 0, 0},
                                    {"dyd_iv_div", 4, ask_iv_div, choose_intervals, 0, 0},
                                    {"dyd_iv_sqr", 2, ask_iv_sqr, choose_intervals, 0, 0},
                                    {"dyd_iv_sqrt", 2, ask_iv_sqrt, choose_intervals, 0, 0},
                                    {"dyd_iv_sign", 2, ask_iv_sign, choose_intervals, 0, 0},
                                    {"iv_det2", 8, ask_iv_det2, choose_intervals, 0, 0},
                                    {"sign_of_boxes", 12, ask_sign_of_boxes, choose_intervals, 4, 0},
                                    {"dyd_filter_incircle", 16, ask_incircle, choose_intervals, 4, 0},
                                    {"farther_along", 6, ask_farther_along, choose_intervals, 0, 0},
                                    {"dyd_filter_is_farther", 12, ask_is_farther, choose_intervals, 4, 0}};

/* ---- roots ---- */

/* Axis k first. */
static void say_roots(answer *a, roots found, int k) {
  if (!found.known) {
    say_none(a);
    return;
  }
  say_integer(a, found.count);
  for (int q = 0; q < found.count; q++)
    for (int e = 0; e < 2; e++) {
      dyd_iv at = found.at[q][e ? 1 - k : k];
      say_double(a, at.lo);
      say_double(a, at.hi);
    }
}

static void ask_two_points(answer *a, const double *x) {
  feature_iv f = {{true, true}, {iv_at(x, 0), iv_at(x, 1)}}, g = {{true, true}, {iv_at(x, 2), iv_at(x, 3)}};
  say_roots(a, iv_two_points(&f, &g), 0);
}
/* x[6]: the axis across the line */
static void ask_point_and_line(answer *a, const double *x) {
  int k = x[6] > 0;
  feature_iv point = {{true, true}, {iv_at(x, k), iv_at(x, 1 - k)}};
  feature_iv line = {{k == 0, k == 1}, {iv_at(x, 2), iv_at(x, 2)}};
  say_roots(a, iv_point_and_line(&point, &line), k);
}
static void ask_parallel_lines(answer *a, const double *x) {
  int k = x[4] > 0;
  feature_iv f = {{k == 0, k == 1}, {iv_at(x, 0), iv_at(x, 0)}}, g = {{k == 0, k == 1}, {iv_at(x, 1), iv_at(x, 1)}};
  say_roots(a, iv_parallel_lines(&f, &g, k), k);
}
static void ask_crossing_lines(answer *a, const double *x) {
  say_roots(a, iv_crossing_lines(iv_at(x, 0), iv_at(x, 1)), 0);
}
/* x[8], x[9]: is there a bound below, above? */
static void ask_outside_slab(answer *a, const double *x) {
  mpz_t some;
  mpz_init(some);
  dyd_slab s = {.lo2 = x[8] > 0 ? some : NULL, .hi2 = x[9] > 0 ? some : NULL, .lo = iv_at(x, 2), .hi = iv_at(x, 3)};
  say_integer(a, outside_slab(iv_at(x, 0), iv_at(x, 1), &s));
  mpz_clear(some);
}

static void choose_axis(double *x, unsigned inputs, const kind *k) {
  choose_intervals(x, inputs, k);
  x[inputs - 1] = (double)test_below(&shared, 2);
}
static void choose_slab(double *x, unsigned inputs, const kind *k) {
  choose_axis(x, inputs, k);
  x[inputs - 2] = (double)test_below(&shared, 2);
}

static const function pane[] = {{"iv_two_points", 8, ask_two_points, choose_intervals, 0, 0},
                                {"iv_point_and_line", 7, ask_point_and_line, choose_axis, 0, 1},
                                {"iv_parallel_lines", 5, ask_parallel_lines, choose_axis, 0, 1},
                                {"iv_crossing_lines", 4, ask_crossing_lines, choose_intervals, 0, 0},
                                {"outside_slab", 10, ask_outside_slab, choose_slab, 3, 2}};

void vectors_of_intervals(const kind *k) {
  put_vectors(pane, sizeof pane / sizeof *pane, k);
  put_vectors(interval, sizeof interval / sizeof *interval, k);
}
