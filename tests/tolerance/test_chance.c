/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Probabilities of edges: never above what samples show, and not far below [TOL-7]. */
#include <setjmp.h>
#include <stdarg.h>

#include "support/random.h"
#include <cmocka.h>
#include <dyadel/tolerance.h>
#include <math.h>
#include <string.h>

enum { MOST = 32, FEW = 7, SAMPLES = 1500 };

typedef struct chance_case {
  uint32_t n;
  double x[MOST], y[MOST], sigma;
  double own[MOST]; /* of each point; 0: sigma, of all */
} chance_case;

static dyd_delaunay *chance_triangulation(dyd_sites **s, const chance_case *c) {
  dyd_delaunay *pd;
  assert_int_equal(dyd_sites_new(s), DYD_OK);
  assert_int_equal(dyd_sites_add_points(*s, c->n, c->x, c->y), DYD_OK);
  assert_int_equal(dyd_delaunay_new(&pd, *s, NULL, NULL), DYD_OK);
  return pd;
}

/* Box and Muller. */
static double normal(test_random *r) {
  return sqrt(-2 * log(1 - test_unit(r))) * cos(6.283185307179586 * test_unit(r));
}

static double sigma_of(const chance_case *c, uint32_t k) {
  return c->own[0] > 0 ? c->own[k] : c->sigma;
}

static void count_edges(size_t seen[MOST][MOST], const chance_case *c, test_random *r) {
  memset(seen, 0, sizeof(size_t[MOST][MOST]));
  for (int q = 0; q < SAMPLES; q++) {
    chance_case p = *c;
    dyd_sites *s;
    for (uint32_t k = 0; k < c->n; k++) p.x[k] += sigma_of(c, k) * normal(r), p.y[k] += sigma_of(c, k) * normal(r);
    dyd_delaunay *pd = chance_triangulation(&s, &p);
    for (uint32_t i = 0; i < c->n; i++)
      for (uint32_t j = i + 1; j < c->n; j++) seen[i][j] += dyd_delaunay_status(pd, i, j) == DYD_LEGAL;
    dyd_delaunay_free(pd);
    dyd_sites_free(s);
  }
}

/* Sums of the bounds and the frequencies of edges. */
static void compare_chances(double sum[2], const chance_case *c, test_random *r) {
  size_t seen[MOST][MOST];
  dyd_sites *s;
  dyd_tolerance *t;
  const dyd_tolerance_row *row;
  const dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .sigma = c->sigma,
                                   .sigmas = c->own[0] > 0 ? c->own : NULL};
  dyd_delaunay *pd = chance_triangulation(&s, c);
  count_edges(seen, c, r);
  assert_int_equal(dyd_tolerance_new(&t, pd, &o, NULL), DYD_OK);
  size_t rows = dyd_tolerance_rows(&row, t);
  const double *chance = dyd_tolerance_get(t)->chances;
  for (size_t k = 0; k < rows; k++) {
    double often = (double)seen[row[k].i][row[k].j] / SAMPLES, p = chance[k];
    assert_true(p >= 0 && p <= 1 && (row[k].event == DYD_EVENT_DEATH || p == 0));
    assert_true(p <= often + 5 * sqrt(p * (1 - p) / SAMPLES) + 3.0 / SAMPLES);
    if (row[k].event == DYD_EVENT_DEATH && row[k].lo > c->sigma) sum[0] += p, sum[1] += often;
  }
  dyd_tolerance_free(t);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

static void test_samples(void **state) {
  (void)state;
  test_random r = test_random_start("probabilities");
  double sum[2] = {0, 0};
  for (size_t k = 0; k < test_cases(30); k++) {
    chance_case c = {.n = 2 + (uint32_t)test_below(&r, FEW - 1), .sigma = pow(10, -3 * test_unit(&r)) * 0.3};
    double far = test_chance(&r, 4) ? 1e6 : 0;
    for (uint32_t i = 0; i < c.n; i++) {
      c.x[i] = far + test_unit(&r), c.y[i] = test_unit(&r);
      if (k % 2) c.own[i] = c.sigma * (0.1 + test_unit(&r));
    }
    compare_chances(sum, &c, &r);
  }
  assert_true(sum[1] > 15 && sum[0] > 0.9 * sum[1]);
}

/* Many around a circle, each of which may come in. */
static void test_crowd(void **state) {
  (void)state;
  test_random r = test_random_start("a crowd around a circle");
  double sum[2] = {0, 0};
  for (int far = 0; far < 2; far++) {
    chance_case c = {.n = MOST, .sigma = 0.01};
    for (uint32_t i = 0; i < c.n; i++) {
      double a = 6.283185307179586 * (i < 2 ? i * 0.5 : test_unit(&r)),
             radius = i < 2 ? 0.99 : 1.005 + 0.01 * test_unit(&r);
      c.x[i] = 1e3 * far + radius * cos(a), c.y[i] = radius * sin(a);
    }
    compare_chances(sum, &c, &r);
  }
}

static void test_sigma_refused(void **state) {
  (void)state;
  const double bad[] = {-1, NAN, INFINITY};
  chance_case c = {.n = 3, .x = {0, 1, 0}, .y = {0, 0, 1}};
  dyd_sites *s;
  dyd_tolerance *t;
  dyd_error err;
  dyd_delaunay *pd = chance_triangulation(&s, &c);
  for (int k = 0; k < 3; k++) {
    const dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .sigma = bad[k]};
    assert_int_equal(dyd_tolerance_new(&t, pd, &o, &err), DYD_E_ARG);
    assert_non_null(strstr(err.message, "standard deviation"));
  }
  assert_int_equal(dyd_tolerance_new(&t, pd, NULL, &err), DYD_OK);
  assert_null(dyd_tolerance_get(t)->chances);
  dyd_tolerance_free(t);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_samples), cmocka_unit_test(test_crowd),
                                     cmocka_unit_test(test_sigma_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
