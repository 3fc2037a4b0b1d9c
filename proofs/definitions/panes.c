/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Roots in interval arithmetic, of predicate/predicate_filter.c. */
#include "predicate/predicate_filter.c" /* functions are static */
#include "vectors.h"

static dyd_iv end_at(const double *x, int k) {
  return (dyd_iv){x[2 * k], x[2 * k + 1]};
}

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
  feature f = {{true, true}, {end_at(x, 0), end_at(x, 1)}}, g = {{true, true}, {end_at(x, 2), end_at(x, 3)}};
  say_roots(a, iv_two_points(&f, &g), 0);
}
/* x[6]: the axis across the line */
static void ask_point_and_line(answer *a, const double *x) {
  int k = x[6] > 0;
  feature point = {{true, true}, {end_at(x, k), end_at(x, 1 - k)}};
  feature line = {{k == 0, k == 1}, {end_at(x, 2), end_at(x, 2)}};
  say_roots(a, iv_point_and_line(&point, &line), k);
}
static void ask_parallel_lines(answer *a, const double *x) {
  int k = x[4] > 0;
  feature f = {{k == 0, k == 1}, {end_at(x, 0), end_at(x, 0)}}, g = {{k == 0, k == 1}, {end_at(x, 1), end_at(x, 1)}};
  say_roots(a, iv_parallel_lines(&f, &g, k), k);
}
static void ask_crossing_lines(answer *a, const double *x) {
  say_roots(a, iv_crossing_lines(end_at(x, 0), end_at(x, 1)), 0);
}
/* x[8], x[9]: is there a bound below, above? */
static void ask_outside_slab(answer *a, const double *x) {
  mpz_t some;
  mpz_init(some);
  dyd_slab s = {.lo2 = x[8] > 0 ? some : NULL, .hi2 = x[9] > 0 ? some : NULL, .lo = end_at(x, 2), .hi = end_at(x, 3)};
  say_integer(a, outside_slab(end_at(x, 0), end_at(x, 1), &s));
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

void vectors_of_panes(const kind *k) {
  put_vectors(pane, sizeof pane / sizeof *pane, k);
}
