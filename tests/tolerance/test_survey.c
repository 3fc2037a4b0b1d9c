/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plans: never insufficient, seldom larger than the least that brute force finds; nothing to leave out [SUR-1]. */
#include <setjmp.h>
#include <stdarg.h>

#include "support/random.h"
#include <cmocka.h>
#include <dyadel/survey.h>
#include <math.h>
#include <string.h>

enum { MOST = 9 };

typedef struct box_case {
  size_t n;
  double x[MOST], y[MOST], h[MOST];
} box_case;

static void make_boxes_case(box_case *c, test_random *r) {
  c->n = 4 + test_below(r, MOST - 3);
  double size = test_unit(r) * 2;
  for (size_t k = 0; k < c->n; k++) {
    c->x[k] = (double)test_below(r, 16) + (double)test_below(r, 64) / 64;
    c->y[k] = (double)test_below(r, 16) + (double)test_below(r, 64) / 64;
    c->h[k] = test_chance(r, 4) ? 0 : nearbyint(size * test_unit(r) * 32) / 32;
  }
}

/* half[k]: of the boxes. */
static dyd_delaunay *boxes(dyd_sites **sites, const box_case *c, const double *half) {
  dyd_delaunay *pd;
  assert_int_equal(dyd_sites_new(sites), DYD_OK);
  for (size_t k = 0; k < c->n; k++) {
    const double b[4] = {c->x[k] - half[k], c->x[k] + half[k], c->y[k] - half[k], c->y[k] + half[k]};
    assert_int_equal(dyd_sites_add_boxes(*sites, 1, &b[0], &b[1], &b[2], &b[3]), DYD_OK);
  }
  assert_int_equal(dyd_delaunay_new(&pd, *sites, NULL, NULL), DYD_OK);
  return pd;
}

static bool is_open(dyd_pair_status s) {
  return s == DYD_INDETERMINATE || s == DYD_TIE;
}

/* How many pairs are open, but for ties of the middles. */
static size_t count_open(const box_case *c, const double *half) {
  static const double none[MOST];
  dyd_sites *sites, *points;
  dyd_delaunay *pd = boxes(&sites, c, half), *nominal = boxes(&points, c, none);
  size_t open = 0;
  for (uint32_t i = 0; i < c->n; i++)
    for (uint32_t j = i + 1; j < c->n; j++) {
      bool tie = dyd_delaunay_status(nominal, i, j) == DYD_TIE ||
                 dyd_delaunay_alias(nominal, i) == dyd_delaunay_alias(nominal, j);
      open += !tie && is_open(dyd_delaunay_status(pd, i, j));
    }
  dyd_delaunay_free(nominal);
  dyd_sites_free(points);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return open;
}

/* The least number of points that, measured to 2^-10 of what they are, leave nothing open; n + 1: none do. */
static size_t least_plan(const box_case *c) {
  size_t least = c->n + 1;
  for (unsigned set = 0; set < 1u << c->n; set++) {
    double half[MOST];
    size_t size = 0;
    bool useless = false;
    for (size_t k = 0; k < c->n; k++) {
      bool in = set >> k & 1;
      half[k] = in ? ldexp(c->h[k], -10) : c->h[k];
      useless = useless || (in && c->h[k] == 0);
      size += in;
    }
    if (!useless && size < least && count_open(c, half) == 0) least = size;
  }
  return least;
}

/* *idle: rows that could be left out. */
static void check_rows(size_t *idle, const box_case *c, const dyd_survey *s, size_t open) {
  const dyd_survey_row *row;
  size_t rows = dyd_survey_rows(&row, s), left_before = open;
  double half[MOST];
  memcpy(half, c->h, sizeof half);
  for (size_t k = 0; k < rows; k++) {
    assert_true(row[k].site < c->n && row[k].now == c->h[row[k].site]);
    assert_true(row[k].needed > 0 && row[k].needed < row[k].now && half[row[k].site] == row[k].now);
    assert_true(row[k].left <= left_before);
    left_before = row[k].left;
    half[row[k].site] = row[k].needed;
  }
  assert_int_equal(left_before, 0);
  assert_int_equal(count_open(c, half), 0);
  for (size_t k = 0; k < rows; k++) {
    half[row[k].site] = c->h[row[k].site];
    *idle += count_open(c, half) == 0;
    half[row[k].site] = row[k].needed;
  }
}

static void test_against_brute_force(void **state) {
  (void)state;
  test_random r = test_random_start("plans");
  size_t cases = 0, larger = 0, sum = 0, least_sum = 0, idle = 0;
  for (size_t k = 0; k < test_cases(200); k++) {
    box_case c;
    dyd_sites *sites;
    dyd_survey *s;
    dyd_error err;
    const dyd_survey_row *row;
    size_t open, ties, left;
    make_boxes_case(&c, &r);
    dyd_delaunay *pd = boxes(&sites, &c, c.h);
    assert_int_equal(dyd_survey_new(&s, pd, NULL, &err), DYD_OK);
    dyd_survey_count(&open, &ties, &left, s);
    size_t rows = dyd_survey_rows(&row, s), least = least_plan(&c);
    assert_int_equal(open, count_open(&c, c.h));
    if (least <= c.n && left == 0) {
      check_rows(&idle, &c, s, open);
      cases++;
      larger += rows > least;
      sum += rows;
      least_sum += least;
    } else {
      assert_true(least > c.n || left == 0); /* what brute force decides is decided */
    }
    dyd_survey_free(s);
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
  }
  print_message("%zu cases, %zu larger, %zu points against %zu, %zu idle\n", cases, larger, sum, least_sum, idle);
  assert_true(cases > 30 && larger * 10 <= cases && idle == 0);
}

/* ---- one measurement at a time ---- */

/* Point k turns out to be at its place in `truth`, exactly. */
static void measure(box_case *c, const box_case *truth, size_t k) {
  c->x[k] = truth->x[k];
  c->y[k] = truth->y[k];
  c->h[k] = 0;
}

/* Measures the first point of a plan, then plans anew; how many it takes. */
static size_t ask_one_by_one(box_case c, const box_case *truth) {
  for (size_t asked = 0;; asked++) {
    dyd_sites *sites;
    dyd_survey *s;
    const dyd_survey_row *row;
    dyd_delaunay *pd = boxes(&sites, &c, c.h);
    assert_int_equal(dyd_survey_new(&s, pd, NULL, NULL), DYD_OK);
    size_t rows = dyd_survey_rows(&row, s);
    assert_true(rows == 0 || c.h[row[0].site] > 0);
    if (rows) measure(&c, truth, row[0].site);
    dyd_survey_free(s);
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
    if (!rows) assert_int_equal(count_open(&c, c.h), 0);
    if (!rows) return asked;
  }
}

/* The least number of points by which, had one known what they turn out to be, all is decided; n + 1: by none. */
static size_t hindsight(const box_case *c, const box_case *truth) {
  size_t least = c->n + 1;
  for (unsigned set = 0; set < 1u << c->n; set++) {
    box_case known = *c;
    size_t size = 0;
    bool useless = false;
    for (size_t k = 0; k < c->n; k++) {
      if (!(set >> k & 1)) continue;
      useless = useless || c->h[k] == 0;
      measure(&known, truth, k);
      size++;
    }
    if (!useless && size < least && count_open(&known, known.h) == 0) least = size;
  }
  return least;
}

static void test_one_by_one(void **state) {
  (void)state;
  test_random r = test_random_start("one by one");
  size_t cases = 0, asked = 0, least = 0;
  for (size_t k = 0; k < test_cases(100); k++) {
    box_case c, truth;
    make_boxes_case(&c, &r);
    truth = c;
    for (size_t i = 0; i < c.n; i++) {
      truth.x[i] += c.h[i] * (ldexp((double)test_below(&r, 1 << 20), -19) - 1);
      truth.y[i] += c.h[i] * (ldexp((double)test_below(&r, 1 << 20), -19) - 1);
    }
    size_t best = hindsight(&c, &truth);
    if (best > c.n) continue;
    least += best;
    asked += ask_one_by_one(c, &truth);
    cases++;
  }
  print_message("%zu cases, %zu questions, %zu in hindsight\n", cases, asked, least);
  assert_true(cases > 15 && asked >= least && 4 * asked <= 5 * least);
}

/* ---- what is asked for ---- */

static void test_parts(void **state) {
  (void)state;
  const box_case c = {8, {0, 10, 5, 5, 100, 110, 105, 105}, {0, 0, 3, -6, 0, 0, 3, -6}, {0, 0, 0.5, 4, 0, 0, 0.5, 4}};
  dyd_sites *sites;
  dyd_survey *s;
  dyd_error err;
  const dyd_survey_row *row;
  dyd_delaunay *pd = boxes(&sites, &c, c.h);
  const uint32_t site = 4;
  dyd_pair pair = {0, 1, DYD_LEGAL};
  const dyd_pair_list pairs = {1, &pair};
  dyd_rect window;
  mpq_t accuracy;
  dyd_rect_init(&window);
  mpq_init(accuracy);
  assert_int_equal(dyd_rect_set_d(&window, -1, 11, -20, 20), DYD_OK);
  mpq_set_d(accuracy, 3.5);
  const double dear[8] = {1, 1, 1, 100, 1, 1, 1, 1}, bad[8] = {1, 1, 1, 0, 1, 1, 1, 1};
  const struct {
    dyd_survey_options o;
    dyd_status st;
    size_t rows, sites; /* the set of sites, as bits, that the rows are among */
  } tries[] = {
      {{DYD_SIZED(dyd_survey_options), .pairs = &pairs}, DYD_OK, 1, 0x8},
      {{DYD_SIZED(dyd_survey_options), .site = &site}, DYD_OK, 1, 0x80},
      {{DYD_SIZED(dyd_survey_options), .pairs = &pairs, .site = &site}, DYD_OK, 0, 0},
      {{DYD_SIZED(dyd_survey_options), .cost = dear, .pairs = &pairs}, DYD_OK, 1, 0x8},
      {{DYD_SIZED(dyd_survey_options), .cost = bad}, DYD_E_ARG, 0, 0},
      {{DYD_SIZED(dyd_survey_options), .site = &(uint32_t){8}}, DYD_E_ARG, 0, 0},
  };
  for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
    assert_int_equal(dyd_survey_new(&s, pd, &tries[k].o, &err), tries[k].st);
    if (tries[k].st != DYD_OK) continue;
    assert_int_equal(dyd_survey_rows(&row, s), tries[k].rows);
    for (size_t q = 0; q < tries[k].rows; q++) assert_true(tries[k].sites >> row[q].site & 1);
    dyd_survey_free(s);
  }
  size_t open[2], ties, left; /* a window, and an accuracy that is not enough */
  for (int part = 0; part < 2; part++) {
    const dyd_survey_options o = {DYD_SIZED(dyd_survey_options), .window = part ? &window : NULL};
    assert_int_equal(dyd_survey_new(&s, pd, &o, &err), DYD_OK);
    dyd_survey_count(&open[part], &ties, &left, s);
    assert_int_equal(left, 0);
    dyd_survey_free(s);
  }
  assert_true(open[1] > 0 && open[1] < open[0]);
  assert_int_equal(
      dyd_survey_new(&s, pd,
                     &(dyd_survey_options){DYD_SIZED(dyd_survey_options), .pairs = &pairs, .accuracy = accuracy}, &err),
      DYD_OK);
  dyd_survey_count(&open[0], &ties, &left, s);
  assert_true(open[0] == 1 && left == 1);
  dyd_survey_free(s);
  mpq_clear(accuracy);
  dyd_rect_clear(&window);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_brute_force), cmocka_unit_test(test_one_by_one),
                                     cmocka_unit_test(test_parts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
