/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Expressions in double intervals, and rounding them to a grid. */
#include "stream/expr_filter.c" /* functions are static */
#include "stream/span_filter.c"
#include "vectors.h"

static dyd_double_span span_at(const double *x, int k) {
  return (dyd_double_span){x[2 * k], x[2 * k + 1]};
}
static void say_span(answer *a, dyd_double_span y) {
  say_double(a, y.lo);
  say_double(a, y.hi);
}

static void ask_add(answer *a, const double *x) {
  say_span(a, glance_add(span_at(x, 0), span_at(x, 1)));
}
static void ask_negated(answer *a, const double *x) {
  say_span(a, glance_negated(span_at(x, 0)));
}
static void ask_corners(answer *a, const double *x) {
  say_span(a, glance_corners(x[0], x[1], x[2], x[3]));
}
static void ask_multiply(answer *a, const double *x) {
  say_span(a, glance_multiply(span_at(x, 0), span_at(x, 1)));
}
static void ask_divide(answer *a, const double *x) {
  say_span(a, glance_divide(span_at(x, 0), span_at(x, 1)));
}
/* x[2] is 1 where the value is known not to be negative. */
static void ask_square_root(answer *a, const double *x) {
  say_span(a, glance_square_root(span_at(x, 0), (dyd_range){x[2] > 0 ? 0 : -1, 1}));
}
static void ask_absolute(answer *a, const double *x) {
  say_span(a, glance_absolute(span_at(x, 0)));
}
/* x[2]: the exponent */
static void ask_power(answer *a, const double *x) {
  say_span(a, glance_power(span_at(x, 0), (int32_t)x[2]));
}

static void choose_known(double *x, unsigned inputs, const kind *k) {
  choose_intervals(x, inputs, k);
  x[2] = (double)test_below(&shared, 2);
}
static void choose_power(double *x, unsigned inputs, const kind *k) {
  choose_intervals(x, inputs, k);
  x[2] = (double)(test_chance(&shared, 8) ? test_between(&shared, -1100, 1100) : test_between(&shared, -9, 9));
}

/* ---- the grid ---- */

static void ask_bits(answer *a, const double *x) {
  say_integer(a, (long)dyd_filter_bits(span_at(x, 0)));
}
static void ask_power_of_two(answer *a, const double *x) {
  say_double(a, power_of_two((int64_t)x[0]));
}
/* x[2]: bits */
static void ask_round(answer *a, const double *x) {
  dyd_double_span out;
  if (dyd_filter_round(&out, span_at(x, 0), (int64_t)x[2]))
    say_span(a, out);
  else
    say_none(a);
}

static void choose_exponent(double *x, unsigned inputs, const kind *k) {
  (void)inputs;
  (void)k;
  x[0] = (double)test_between(&shared, -1022, 1023);
}
/* Intervals of some width, where a grid is about as fine. */
static void choose_narrow(double *x, unsigned inputs, const kind *k) {
  (void)k;
  int bits = (int)(test_chance(&shared, 4) ? test_between(&shared, -2, 1003) : test_between(&shared, 0, 60));
  if (test_chance(&shared, 8)) bits = (int)test_between(&shared, 998, 1002);
  double width = ldexp(test_chance(&shared, 2) ? 1 : 1 + test_unit(&shared), (int)test_between(&shared, -4, 2) - bits);
  x[0] =
      test_chance(&shared, 8) ? special() : ldexp(test_unit(&shared) - 0.5, (int)test_between(&shared, -4, 70) - bits);
  x[1] = test_chance(&shared, 30) ? special() : x[0] + width;
  if (inputs > 2) x[2] = bits;
}

static const function span[] = {{"glance_add", 4, ask_add, choose_intervals, 0, 0},
                                {"glance_negated", 2, ask_negated, choose_intervals, 0, 0},
                                {"glance_corners", 4, ask_corners, NULL, 0, 0},
                                {"glance_multiply", 4, ask_multiply, choose_intervals, 0, 0},
                                {"glance_divide", 4, ask_divide, choose_intervals, 0, 0},
                                {"glance_square_root", 3, ask_square_root, choose_known, 0, 1},
                                {"glance_absolute", 2, ask_absolute, choose_intervals, 0, 0},
                                {"glance_power", 3, ask_power, choose_power, 0, 1},
                                {"dyd_filter_bits", 2, ask_bits, choose_narrow, 2, 0},
                                {"power_of_two", 1, ask_power_of_two, choose_exponent, 0, 0},
                                {"dyd_filter_round", 3, ask_round, choose_narrow, 0, 1}};

void vectors_of_expressions(const kind *k) {
  put_vectors(span, sizeof span / sizeof *span, k);
}
