/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plans: never insufficient, seldom larger than the least that brute force finds; no row without use [SUR-1]. */
#include <setjmp.h>
#include <stdarg.h>

#include "support/random.h"
#include <cmocka.h>
#include <dyadel/survey.h>
#include <dyadel/tolerance.h>
#include <math.h>
#include <string.h>

/* FEW: so many that all sets of them can be tried. */
enum { FEW = 9, MOST = 40 };

typedef struct box_case {
  size_t n;
  double x[MOST], y[MOST], h[MOST];
} box_case;

static void make_boxes_case(box_case *c, test_random *r, size_t n, unsigned side) {
  c->n = n;
  double size = test_unit(r) * 2;
  for (size_t k = 0; k < c->n; k++) {
    c->x[k] = (double)test_below(r, side) + (double)test_below(r, 64) / 64;
    c->y[k] = (double)test_below(r, side) + (double)test_below(r, 64) / 64;
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

/* The least number of points that, measured to within 2^-10, leave nothing open; n + 1: no set does. */
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

/* With the first rows measured, just the pairs that name these are decided. */
static void check_pairs(const box_case *c, const double *half, const dyd_survey *s, size_t rows) {
  const dyd_survey_pair *pair;
  dyd_sites *sites;
  dyd_delaunay *pd = boxes(&sites, c, half);
  const size_t pairs = dyd_survey_pairs(&pair, s);
  assert_int_equal(pairs, dyd_survey_get(s)->open);
  for (size_t k = 0; k < pairs; k++) {
    assert_true(k == 0 || pair[k - 1].i < pair[k].i || (pair[k - 1].i == pair[k].i && pair[k - 1].j < pair[k].j));
    assert_int_equal(is_open(dyd_delaunay_status(pd, pair[k].i, pair[k].j)), pair[k].row >= rows);
  }
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

/* Each row states how many pairs it decides after the rows before. Sets half[] as measured; returns the rest. */
static size_t follow_rows(double *half, const box_case *c, const dyd_survey *s, size_t open) {
  const dyd_survey_row *row;
  size_t rows = dyd_survey_rows(&row, s), left = open;
  memcpy(half, c->h, MOST * sizeof *half);
  for (size_t k = 0; k < rows; k++) {
    assert_true(row[k].site < c->n && row[k].now == c->h[row[k].site] && half[row[k].site] == row[k].now);
    assert_true(row[k].needed > 0 && row[k].needed < row[k].now);
    half[row[k].site] = row[k].needed;
    check_pairs(c, half, s, k + 1);
    assert_int_equal(row[k].left, count_open(c, half));
    assert_int_equal(row[k].decided, left - row[k].left);
    left = row[k].left;
  }
  return left;
}

/* *idle: rows without use. */
static void check_rows(size_t *idle, const box_case *c, const dyd_survey *s, size_t open) {
  const dyd_survey_row *row;
  size_t rows = dyd_survey_rows(&row, s);
  double half[MOST];
  assert_int_equal(follow_rows(half, c, s, open), 0);
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
    size_t open, left;
    make_boxes_case(&c, &r, 4 + test_below(&r, FEW - 3), 16);
    dyd_delaunay *pd = boxes(&sites, &c, c.h);
    assert_int_equal(dyd_survey_new(&s, pd, NULL, &err), DYD_OK);
    open = dyd_survey_get(s)->open, left = dyd_survey_get(s)->left;
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

/* The least number of points whose measurement decides all pairs, chosen with knowledge of the true places; n + 1: no
 * set does. */
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
    make_boxes_case(&c, &r, 4 + test_below(&r, FEW - 3), 16);
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

/* ---- more points than all rows are tried with ---- */

/* How many target pairs of one face, taken alone, are open. */
static size_t count_open_in(const box_case *c, const double *half, const dyd_index_list *face,
                            const dyd_pair_list *target) {
  box_case part = {face->count, {0}, {0}, {0}};
  uint32_t number[MOST];
  dyd_sites *sites;
  size_t open = 0;
  memset(number, 0xff, sizeof number);
  for (size_t k = 0; k < face->count; k++) {
    uint32_t i = face->item[k];
    number[i] = (uint32_t)k;
    part.x[k] = c->x[i], part.y[k] = c->y[i], part.h[k] = half[i];
  }
  dyd_delaunay *pd = boxes(&sites, &part, part.h);
  for (size_t k = 0; k < target->count; k++) {
    uint32_t i = number[target->item[k].i], j = number[target->item[k].j];
    if (i < face->count && j < face->count) open += is_open(dyd_delaunay_status(pd, i, j));
  }
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return open;
}

/* The same summed over all faces with this site, each taken alone. */
static size_t count_open_about(const box_case *c, const double *half, const dyd_delaunay *pd,
                               const dyd_pair_list *target, uint32_t site) {
  size_t open = 0;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd); f++) {
    dyd_index_list face = {0};
    bool outer, has = false;
    assert_int_equal(dyd_delaunay_face(&face, &outer, pd, f), DYD_OK);
    for (size_t k = 0; k < face.count; k++) has = has || face.item[k] == site;
    if (has) open += count_open_in(c, half, &face, target);
    dyd_index_list_clear(&face);
  }
  return open;
}

/* The open pairs, without ties of the centres of the boxes. */
static void find_targets(dyd_pair_list *out, const dyd_delaunay *pd, const box_case *c) {
  static const double none[MOST];
  dyd_sites *points;
  dyd_delaunay *nominal = boxes(&points, c, none);
  size_t n = 0;
  assert_int_equal(dyd_delaunay_pairs(out, pd), DYD_OK);
  for (size_t k = 0; k < out->count; k++) {
    const dyd_pair p = out->item[k];
    if (is_open(p.status) && dyd_delaunay_status(nominal, p.i, p.j) != DYD_TIE) out->item[n++] = p;
  }
  out->count = n;
  dyd_delaunay_free(nominal);
  dyd_sites_free(points);
}

/* Where all is decided: rows that no face needs, or needs so exactly, could not be without all at once. `times`: how
 * much coarser they are tried; 0: as they are without the plan. Returns how many there are. */
static size_t check_faces(const box_case *c, const double *half, const dyd_delaunay *pd, const dyd_survey *s,
                          double times) {
  const dyd_survey_row *row;
  dyd_pair_list target = {0};
  size_t rows = dyd_survey_rows(&row, s), idle = 0;
  double all[MOST], one[MOST];
  memcpy(all, half, sizeof all);
  memcpy(one, half, sizeof one);
  find_targets(&target, pd, c);
  for (size_t k = 0; k < rows; k++) {
    uint32_t i = row[k].site;
    if (times * times * half[i] > c->h[i]) continue;
    one[i] = times > 0 ? times * half[i] : c->h[i];
    size_t about = times > 0 ? count_open_about(c, half, pd, &target, i) : 0;
    if (count_open_about(c, one, pd, &target, i) <= about) all[i] = one[i], idle++;
    one[i] = half[i];
  }
  assert_true(!idle || count_open(c, all) > 0);
  dyd_pair_list_clear(&target);
  return idle;
}

/* An eighth coarser, or as without the plan, all rows leave more open: the common factor is as large as can be. */
static void check_factor(const box_case *c, const double *half, const dyd_survey *s, bool given, size_t left) {
  const dyd_survey_row *row;
  size_t rows = dyd_survey_rows(&row, s);
  double coarse[MOST];
  memcpy(coarse, half, sizeof coarse);
  for (size_t k = 0; k < rows; k++) {
    coarse[row[k].site] = fmin(1.125 * row[k].needed, row[k].now);
    if (!given && coarse[row[k].site] == row[k].now) return;
  }
  assert_true(!rows || count_open(c, coarse) > left);
}

/* Plans of the boxes: pairs left open are reported; if none is, the faces need every row. Returns how many rows. */
static size_t check_large(size_t *idle, const box_case *c, const dyd_survey_options *o) {
  dyd_sites *sites;
  dyd_survey *s;
  const dyd_survey_row *row;
  size_t open, left;
  double half[MOST];
  dyd_delaunay *pd = boxes(&sites, c, c->h);
  assert_int_equal(dyd_survey_new(&s, pd, o, NULL), DYD_OK);
  open = dyd_survey_get(s)->open, left = dyd_survey_get(s)->left;
  assert_int_equal(open, count_open(c, c->h));
  assert_int_equal(left, follow_rows(half, c, s, open));
  check_factor(c, half, s, o->accuracy, left);
  if (!left) *idle += check_faces(c, half, pd, s, 0) + check_faces(c, half, pd, s, 2);
  size_t rows = dyd_survey_rows(&row, s);
  dyd_survey_free(s);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return rows;
}

static void test_large(void **state) {
  (void)state;
  test_random r = test_random_start("plans of more points");
  mpq_t accuracy;
  size_t rows = 0, idle = 0;
  mpq_init(accuracy);
  for (size_t k = 0; k < test_cases_all(60); k++) {
    box_case c;
    make_boxes_case(&c, &r, 16 + test_below(&r, MOST - 15), 30);
    mpq_set_d(accuracy, (1 + (double)test_below(&r, 64)) / 64);
    const dyd_survey_options o = {DYD_SIZED(dyd_survey_options), .accuracy = k % 3 ? NULL : accuracy};
    rows += check_large(&idle, &c, &o);
  }
  print_message("%zu rows, %zu idle\n", rows, idle);
  assert_true(rows > 300);
  mpq_clear(accuracy);
}

/* Four times, in a row: within its face a pair is decided without a site, with the others it is not; so that rows
 * dropped by the faces' count are taken back. */
static void test_taken_back(void **state) {
  (void)state;
  static const double x[] = {1.25, 4, 2.5, 4, 0.75, 0.875, 6, 2.5}, y[] = {10.625, 20, 10.5, 17.5, 4, 7.5, 15, 3},
                      h[] = {0.5, 0, 0, 0, 0, 0.25, 0, 0}, up[] = {0, 5, -9, 3};
  box_case c = {32, {0}, {0}, {0}};
  for (size_t k = 0; k < c.n; k++)
    c.x[k] = x[k % 8] + 64 * (double)(k / 8), c.y[k] = y[k % 8] + up[k / 8], c.h[k] = h[k % 8];
  size_t idle = 0;
  mpq_t accuracy;
  mpq_init(accuracy);
  mpq_set_ui(accuracy, 1, 32);
  const dyd_survey_options o = {DYD_SIZED(dyd_survey_options), .accuracy = accuracy};
  assert_true(check_large(&idle, &c, &o) > 0);
  mpq_clear(accuracy);
}

/* ---- requests ---- */

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
  size_t open[2], left; /* a window, and an accuracy that is not enough */
  for (int part = 0; part < 2; part++) {
    const dyd_survey_options o = {DYD_SIZED(dyd_survey_options), .window = part ? &window : NULL};
    assert_int_equal(dyd_survey_new(&s, pd, &o, &err), DYD_OK);
    open[part] = dyd_survey_get(s)->open, left = dyd_survey_get(s)->left;
    assert_int_equal(left, 0);
    dyd_survey_free(s);
  }
  assert_true(open[1] > 0 && open[1] < open[0]);
  assert_int_equal(
      dyd_survey_new(&s, pd,
                     &(dyd_survey_options){DYD_SIZED(dyd_survey_options), .pairs = &pairs, .accuracy = accuracy}, &err),
      DYD_OK);
  open[0] = dyd_survey_get(s)->open, left = dyd_survey_get(s)->left;
  assert_true(open[0] == 1 && left == 1);
  dyd_survey_free(s);
  mpq_clear(accuracy);
  dyd_rect_clear(&window);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

/* ---- trials, followed step by step ---- */

static uint64_t mixed(uint64_t seed, uint64_t k) {
  uint64_t z = seed + k * UINT64_C(0x9E3779B97F4A7C15);
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return z ^ (z >> 31);
}

/* side[2 * axis + end] of each box; at[axis]: the true place. */
typedef struct true_case {
  size_t n;
  mpq_t side[MOST][4], at[MOST][2], t;
  bool discs;
} true_case;

static bool is_in_disc(const true_case *c, size_t i) {
  double d[2], half = (mpq_get_d(c->side[i][1]) - mpq_get_d(c->side[i][0])) / 2;
  for (int a = 0; a < 2; a++)
    d[a] = mpq_get_d(c->at[i][a]) - (mpq_get_d(c->side[i][2 * a]) + mpq_get_d(c->side[i][2 * a + 1])) / 2;
  return half == 0 || hypot(d[0], d[1]) < half;
}

static void true_begin(true_case *c, const box_case *b, uint64_t seed, bool discs) {
  c->n = b->n;
  c->discs = discs;
  mpq_init(c->t);
  for (size_t i = 0; i < c->n; i++) {
    uint64_t own = mixed(seed, i), k = 0;
    const double end[4] = {b->x[i] - b->h[i], b->x[i] + b->h[i], b->y[i] - b->h[i], b->y[i] + b->h[i]};
    mpq_inits(c->at[i][0], c->at[i][1], NULL);
    for (int e = 0; e < 4; e++) mpq_init(c->side[i][e]), mpq_set_d(c->side[i][e], end[e]);
    do {
      for (int a = 0; a < 2; a++) {
        mpq_set_ui(c->t, (unsigned long)(2 * (mixed(own, k++) >> 11) + 1), 1);
        mpq_div_2exp(c->t, c->t, 54);
        mpq_sub(c->at[i][a], c->side[i][2 * a + 1], c->side[i][2 * a]);
        mpq_mul(c->at[i][a], c->at[i][a], c->t);
        mpq_add(c->at[i][a], c->at[i][a], c->side[i][2 * a]);
      }
    } while (discs && !is_in_disc(c, i));
  }
}

static void true_end(true_case *c) {
  for (size_t i = 0; i < c->n; i++) {
    for (int e = 0; e < 4; e++) mpq_clear(c->side[i][e]);
    mpq_clears(c->at[i][0], c->at[i][1], NULL);
  }
  mpq_clear(c->t);
}

static void true_measure(true_case *c, size_t i, double needed) {
  mpq_t h;
  mpq_init(h);
  mpq_set_d(h, needed);
  for (int a = 0; a < 2; a++) {
    mpq_sub(c->t, c->at[i][a], h);
    if (c->discs || mpq_cmp(c->t, c->side[i][2 * a]) > 0) mpq_set(c->side[i][2 * a], c->t);
    mpq_add(c->t, c->at[i][a], h);
    if (c->discs || mpq_cmp(c->t, c->side[i][2 * a + 1]) < 0) mpq_set(c->side[i][2 * a + 1], c->t);
  }
  mpq_clear(h);
}

static dyd_delaunay *true_now(dyd_sites **sites, const true_case *c) {
  dyd_delaunay *pd;
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(dyd_sites_new(sites), DYD_OK);
  for (size_t i = 0; i < c->n; i++) {
    assert_int_equal(dyd_interval_set_outward(&r.x, c->side[i][0], c->side[i][1], -2048), DYD_OK);
    assert_int_equal(dyd_interval_set_outward(&r.y, c->side[i][2], c->side[i][3], -2048), DYD_OK);
    assert_int_equal(dyd_sites_add_rect(*sites, &r), DYD_OK);
  }
  assert_int_equal(dyd_delaunay_new(&pd, *sites, NULL, NULL), DYD_OK);
  dyd_rect_clear(&r);
  return pd;
}

/* Measures what plans say until one says nothing, or four in a row decided nothing. The pairs open at first are asked
 * for. */
static dyd_survey_trial true_follow(true_case *c, dyd_survey_options o, const dyd_pair_list *asked) {
  dyd_survey_trial found = {.done = true};
  bool measured[MOST] = {0};
  o.pairs = asked;
  size_t fewest = SIZE_MAX, idle = 0;
  for (size_t rows = 1; rows && idle < 4 && found.rounds < 64;) {
    dyd_sites *sites;
    dyd_survey *s;
    const dyd_survey_row *row;
    dyd_delaunay *pd = true_now(&sites, c);
    assert_int_equal(dyd_survey_new(&s, pd, &o, NULL), DYD_OK);
    size_t open = dyd_survey_get(s)->open;
    idle = open < fewest ? 0 : idle + 1;
    if (open < fewest) fewest = open;
    rows = idle < 4 ? dyd_survey_rows(&row, s) : 0;
    for (size_t k = 0; k < rows; k++) {
      true_measure(c, row[k].site, row[k].needed);
      found.points += !measured[row[k].site];
      measured[row[k].site] = true;
    }
    found.rounds += rows > 0;
    found.measurements += rows;
    found.left = dyd_survey_get(s)->left + dyd_survey_get(s)->ties;
    dyd_survey_free(s);
    dyd_delaunay_free(pd);
    dyd_sites_free(sites);
  }
  return found;
}

/* Of squares, or of the discs in them. */
static dyd_pair_list all_open(const dyd_delaunay *pd, bool discs) {
  dyd_pair_list all = {0};
  size_t kept = 0;
  if (discs)
    assert_int_equal(dyd_disc_pairs(&all, pd, NULL, NULL), DYD_OK);
  else
    assert_int_equal(dyd_delaunay_pairs(&all, pd), DYD_OK);
  for (size_t k = 0; k < all.count; k++)
    if (is_open(all.item[k].status)) all.item[kept++] = all.item[k];
  all.count = kept;
  return all;
}

static void check_trials(const box_case *c, dyd_survey_options o, uint64_t seed) {
  enum { TRIALS = 6 };
  dyd_survey_trial out[2][TRIALS];
  dyd_sites *sites;
  dyd_delaunay *pd = boxes(&sites, c, c->h);
  for (unsigned side = 0; side < 2; side++) {
    dyd_delaunay_options how = {DYD_SIZED(dyd_delaunay_options), .threads = side ? 3 : 1};
    assert_int_equal(dyd_delaunay_update(pd, NULL, 0, &how, NULL), DYD_OK);
    assert_int_equal(dyd_survey_simulate(out[side], TRIALS, seed, pd, &o, NULL), DYD_OK);
  }
  assert_memory_equal(out[0], out[1], sizeof out[0]);
  dyd_pair_list asked = all_open(pd, o.discs);
  for (uint64_t k = 0; k < TRIALS; k++) {
    true_case t;
    true_begin(&t, c, mixed(seed, k), o.discs);
    const dyd_survey_trial want = true_follow(&t, o, &asked);
    assert_true(out[0][k].done && out[0][k].rounds == want.rounds && out[0][k].points == want.points);
    assert_true(out[0][k].measurements == want.measurements && out[0][k].left == want.left);
    true_end(&t);
  }
  dyd_pair_list_clear(&asked);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

static void test_trials(void **state) {
  (void)state;
  test_random r = test_random_start("trials of plans");
  mpq_t accuracy;
  mpq_init(accuracy);
  for (size_t k = 0; k < test_cases(24); k++) {
    box_case c;
    make_boxes_case(&c, &r, 4 + test_below(&r, 12), 12);
    mpq_set_ui(accuracy, 1, 4 + test_below(&r, 30));
    const dyd_survey_options o = {DYD_SIZED(dyd_survey_options), .accuracy = k % 3 == 1 ? accuracy : NULL,
                                  .discs = k % 3 == 2};
    check_trials(&c, o, test_below(&r, 1000));
  }
  mpq_clear(accuracy);
}

/* Cancelled before anything: a plan without rows, trials of which none is done; the pairs are counted. */
static void test_cancelled_before(void **state) {
  (void)state;
  const volatile int raised = 1;
  const dyd_survey_options o = {DYD_SIZED(dyd_survey_options), .cancel = &raised};
  box_case c;
  test_random r = test_random_start("cancelled plans");
  dyd_survey_trial out[3];
  dyd_survey *s;
  dyd_sites *sites;
  dyd_error err;
  const dyd_survey_row *row;
  make_boxes_case(&c, &r, 20, 12);
  dyd_delaunay *pd = boxes(&sites, &c, c.h);
  dyd_pair_list open = all_open(pd, false);
  assert_int_equal(dyd_survey_new(&s, pd, &o, &err), DYD_CANCELLED);
  assert_true(s && dyd_survey_get(s)->cut && dyd_survey_rows(&row, s) == 0);
  assert_int_equal(dyd_survey_get(s)->open, open.count);
  assert_int_equal(dyd_survey_get(s)->left, open.count);
  dyd_survey_free(s);
  assert_int_equal(dyd_survey_simulate(out, 3, 1, pd, &o, &err), DYD_CANCELLED);
  for (int k = 0; k < 3; k++) assert_false(out[k].done);
  dyd_pair_list_clear(&open);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_against_brute_force), cmocka_unit_test(test_one_by_one), cmocka_unit_test(test_large),
      cmocka_unit_test(test_taken_back),          cmocka_unit_test(test_parts),      cmocka_unit_test(test_trials),
      cmocka_unit_test(test_cancelled_before)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
