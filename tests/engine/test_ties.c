/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* [TIE-3] [TIE-4] Ties and aliases of computable points: all of them, for good, and none that is false. */
#include "engine/help.h"

#include <stdio.h>
#include <string.h>

/* legal, indeterminate and tied pairs after a run, and its outcome. */
static void expect_counts(dyd_engine *e, const dyd_engine_options *o, dyd_outcome outcome, size_t legal, size_t open,
                          size_t tie) {
  size_t count[4];
  engine_run(e, o, outcome);
  engine_count(count, e);
  assert_int_equal(count[DYD_LEGAL], legal);
  assert_int_equal(count[DYD_INDETERMINATE], open);
  assert_int_equal(count[DYD_TIE], tie);
  dyd_engine_free(e);
}

/* Corner k of the n-gon of radius r, moved outward by the text `more`. */
static void add_corner(dyd_engine *e, const char *r, int k, int n, const char *more) {
  char x[300], y[300];
  snprintf(x, sizeof x, "(%s%s)*cos(2*pi*%d/%d)", r, more, k, n);
  snprintf(y, sizeof y, "(%s%s)*sin(2*pi*%d/%d)", r, more, k, n);
  engine_add_text(e, x, y);
}

static dyd_engine *gon(const char *r, int n, int moved, const char *more) {
  dyd_engine *e = engine_new();
  for (int k = 0; k < n; k++) add_corner(e, r, k, n, k == moved ? more : "");
  return e;
}

static dyd_engine_options ties_off(void) {
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.max_bits = 100;
  o.no_ties = true;
  return o;
}

static void test_polygons(void **state) {
  (void)state;
  for (int n = 4; n <= 24; n++)
    expect_counts(gon("sqrt(3)", n, -1, ""), NULL, DYD_OUTCOME_FIXPOINT, (size_t)n, 0, (size_t)(n * (n - 3) / 2));
  dyd_engine_options off = ties_off();
  expect_counts(gon("sqrt(3)", 7, -1, ""), &off, DYD_OUTCOME_BUDGET, 7, 14, 0);
}

/* A corner moved by as little as 2^-3000, in or out: everything is decided, and nothing is a tie. */
static void test_moved(void **state) {
  static const int bits[] = {10, 60, 64, 65, 127, 128, 129, 500, 1100, 3000};
  (void)state;
  for (size_t k = 0; k < 2 * sizeof bits / sizeof *bits; k++) {
    char more[40];
    int n = 5 + (int)(k % 4);
    snprintf(more, sizeof more, "%c2^-%d", k % 2 ? '+' : '-', bits[k / 2]);
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.max_bits = 8192;
    dyd_engine *e = gon("1", n, (int)(k % (size_t)n), more);
    size_t count[4];
    dyd_outcome outcome = DYD_OUTCOME_NONE;
    assert_int_equal(dyd_engine_run(&outcome, e, &o, NULL), DYD_OK);
    engine_count(count, e);
    /* outward: the corner sees two neighbours and the others are a polygon of one corner less */
    assert_int_equal(count[DYD_INDETERMINATE], 0);
    size_t rest = (size_t)(n - 1), tied = rest * (rest - 3) / 2;
    if (k % 2 && rest < 4) tied = 0;
    if (k % 2) assert_int_equal(count[DYD_TIE], tied);
    if (!(k % 2)) assert_true(count[DYD_TIE] < (size_t)(n * (n - 3) / 2));
    for (uint32_t j = 0; j < (uint32_t)n; j++)
      if (j != k % (size_t)n)
        assert_true(dyd_delaunay_status(dyd_engine_delaunay(e), (uint32_t)(k % (size_t)n), j) != DYD_TIE);
    dyd_engine_free(e);
  }
}

/* Three points of a line, the middle one off it by 10^-90 and 10^-900. */
static void test_nearly_collinear(void **state) {
  (void)state;
  for (int digits = 90; digits <= 900; digits += 810) {
    char y[60];
    dyd_engine *e = engine_new();
    snprintf(y, sizeof y, "2*sqrt(3)+1+10^-%d", digits);
    engine_add_text(e, "sqrt(2)", "2*sqrt(2)+1");
    engine_add_text(e, "sqrt(3)", y);
    engine_add_text(e, "sqrt(5)", "2*sqrt(5)+1");
    engine_add_text(e, "0", "20");
    engine_add_text(e, "5", "-20");
    size_t count[4];
    engine_run(e, NULL, DYD_OUTCOME_DECIDED);
    engine_count(count, e);
    assert_int_equal(count[DYD_TIE] + count[DYD_INDETERMINATE], 0);
    dyd_engine_free(e);
  }
}

/* Near ties, with all statuses and the most bits requested for a point by a run of at most the given stages: a
 * chain on the hull, whose middle is off by 10^-900; one corner of a 9-gon; two points next to one another. */
static dyd_engine *near_tie(int k) {
  dyd_engine *e = k == 1 ? gon("sqrt(2)", 9, 4, "-2^-2900") : engine_new();
  if (k == 0) {
    engine_add_text(e, "sqrt(2)", "2*sqrt(2)+1");
    engine_add_text(e, "sqrt(3)", "2*sqrt(3)+1+10^-900");
    engine_add_text(e, "sqrt(5)", "2*sqrt(5)+1");
    engine_add_text(e, "0", "20");
  }
  for (int c = 0; k == 2 && c < 5; c++)
    engine_add_text(e, (const char *[]){"sqrt(27)/3", "sqrt(3)+2^-2950", "1", "-3", "4"}[c],
                    c < 2   ? "sqrt(2)"
                    : c & 1 ? "7"
                            : "-5");
  return e;
}

/* A test for a tie sees at which bit there is none, and the points go there at once: two stages, where doubling takes
 * seven or more, hardly more bits than that, and the same answers as without a test. */
static void test_bits_that_show(void **state) {
  (void)state;
  for (int k = 0; k < 3; k++) {
    dyd_engine *e = near_tie(k), *plain = near_tie(k);
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    engine_run(e, &o, DYD_OUTCOME_DECIDED);
    o.no_ties = true;
    engine_run(plain, &o, DYD_OUTCOME_DECIDED);
    dyd_engine_counters now = engine_counters(e), before = engine_counters(plain);
    assert_int_equal(now.stages, 2);
    assert_in_range(now.bits_most, 2900, 3070);
    if (k != 1) assert_true(before.stages >= 7 && before.bits_most == 4096); /* there probes learn it, too */
    assert_true(now.bits_total < before.bits_total);
    for (uint32_t i = 0; i < dyd_engine_count(e); i++)
      for (uint32_t j = 0; j < i; j++)
        assert_int_equal(dyd_delaunay_status(dyd_engine_delaunay(e), i, j),
                         dyd_delaunay_status(dyd_engine_delaunay(plain), i, j));
    dyd_engine_free(plain);
    dyd_engine_free(e);
  }
}

/* Points of a vertical line, with no other points: three of them; and two that are so near that it is known to be a
 * line long before they are apart. Neighbours on the line do not tie. */
static void test_lines(void **state) {
  static const char *const y[4][4] = {{"sqrt(5)", "sqrt(3)", "sqrt(2)"},
                                      {"sqrt(3)", "sqrt(2)", "sqrt(2)+2^-900"},
                                      {"sqrt(3)", "sqrt(2)", "sqrt(3)-2^-900"},
                                      {"sqrt(5)", "sqrt(3)", "sqrt(2)", "sqrt(2)+2^-900"}};
  (void)state;
  for (size_t k = 0; k < 4; k++) {
    dyd_engine *e = engine_new();
    for (size_t i = 0; i < 4 && y[k][i]; i++) engine_add_text(e, "1", y[k][i]);
    expect_counts(e, NULL, DYD_OUTCOME_FIXPOINT, k < 3 ? 2 : 3, 0, k < 3 ? 1 : 3);
  }
}

static void test_chains(void **state) {
  static const char *const line[] = {"sqrt(2)", "sqrt(3)", "2", "sqrt(5)", "sqrt(6)", "pi", "e+1"};
  enum { N = sizeof line / sizeof *line };
  (void)state;
  for (int above = 0; above < 3; above++) { /* no other point; a point on one side; on both */
    dyd_engine *e = engine_new();
    for (int k = 0; k < N; k++) {
      char y[60];
      snprintf(y, sizeof y, "2*(%s)+1", line[k]);
      engine_add_text(e, line[k], y);
    }
    if (above > 0) engine_add_text(e, "-10", "7");
    if (above > 1) engine_add_text(e, "20", "5");
    size_t pairs = N * (N - 1) / 2, inside = pairs - (N - 1);
    if (above < 2)
      expect_counts(e, NULL, DYD_OUTCOME_FIXPOINT, N - 1 + (above ? N : 0), 0, inside);
    else
      expect_counts(e, NULL, DYD_OUTCOME_DECIDED, N - 1 + 2 * N, 0, 0);
  }
}

/* All on a horizontal line, which rectangles tell. */
static void test_level_line(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_text(e, "sqrt(2)", "0");
  engine_add_text(e, "2", "0");
  engine_add_text(e, "sqrt(3)", "0");
  engine_add_text(e, "5", "0");
  expect_counts(e, NULL, DYD_OUTCOME_FIXPOINT, 3, 0, 3);
}

/* One corner of the 12-gon is known by a callback, an interval, or is another number of the same value without a proof
 * of equality: no tie. */
static void test_undescribed(void **state) {
  static const char *const x[] = {NULL, "[0.9999999,1.0000001]", "tan(atan(1))"};
  (void)state;
  for (int way = 0; way < 3; way++) {
    dyd_engine *e = engine_new();
    for (int k = 1; k < 12; k++) add_corner(e, "1", k, 12, "");
    if (way == 0)
      engine_add_hidden(e, "sqrt(2)^2/2", "sqrt(2)-sqrt(2)");
    else
      engine_add_text(e, x[way], "0");
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.max_bits = 200;
    size_t count[4];
    dyd_outcome outcome;
    assert_int_equal(dyd_engine_run(&outcome, e, &o, NULL), DYD_OK);
    engine_count(count, e);
    assert_int_equal(count[DYD_TIE], 0);
    assert_true(count[DYD_INDETERMINATE] > 0);
    dyd_engine_free(e);
  }
}

/* The same callback is the same number, whatever that is: a rectangle of two callbacks. */
static void test_callbacks(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_stream *corner = NULL, *s = NULL;
  static const char *const side[4][4] = {
      {"1", "0", "0", "1"}, {"-1", "0", "0", "1"}, {"1", "0", "0", "-1"}, {"-1", "0", "0", "-1"}};
  dyd_engine *f = engine_new();
  engine_add_hidden(f, "sqrt(2)", "pi");
  assert_int_equal(dyd_engine_stream(&corner, f, 0), DYD_OK);
  for (int k = 0; k < 4; k++) {
    mpq_t m[6];
    for (int c = 0; c < 6; c++) mpq_init(m[c]);
    mpq_set_str(m[0], side[k][0], 10);
    mpq_set_str(m[1], side[k][1], 10);
    mpq_set_str(m[3], side[k][2], 10);
    mpq_set_str(m[4], side[k][3], 10);
    mpq_set_ui(m[5], 7, 3);
    assert_int_equal(dyd_stream_affine(&s, dyd_stream_ref(corner), (const mpq_t *)m), DYD_OK);
    assert_int_equal(dyd_engine_add_stream(e, s, NULL), DYD_OK);
    for (int c = 0; c < 6; c++) mpq_clear(m[c]);
  }
  dyd_stream_free(corner);
  dyd_engine_free(f);
  expect_counts(e, NULL, DYD_OUTCOME_FIXPOINT, 4, 0, 2);
}

/* Circumcentres of triangles of a hexagon: all are its centre. */
static void test_centres(void **state) {
  (void)state;
  dyd_engine *e = engine_new(), *f = gon("sqrt(2)", 7, -1, "");
  dyd_stream *s[3], *c = NULL;
  for (uint32_t k = 0; k < 4; k++) {
    for (uint32_t q = 0; q < 3; q++) assert_int_equal(dyd_engine_stream(&s[q], f, k + q), DYD_OK);
    assert_int_equal(dyd_stream_voronoi_vertex(&c, s[0], s[1], s[2]), DYD_OK);
    assert_int_equal(dyd_engine_add_stream(e, c, NULL), DYD_OK);
  }
  engine_add_text(e, "1", "0");
  engine_add_text(e, "0", "sqrt(2)-1");
  dyd_engine_free(f);
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  for (uint32_t k = 1; k < 4; k++) assert_int_equal(dyd_delaunay_alias(dyd_engine_delaunay(e), k), 0);
  dyd_engine_free(e);
}

static void test_aliases(void **state) {
  static const char *const same[][2] = {{"sqrt(8)", "2*sqrt(2)"},
                                        {"cbrt(2+sqrt(5))+cbrt(2-sqrt(5))", "1"},
                                        {"1", "2*sin(pi/6)"},
                                        {"pi+e", "e+pi"},
                                        {"2", "sqrt(2)*sqrt(2)"}};
  (void)state;
  for (size_t k = 0; k < sizeof same / sizeof *same; k++) {
    dyd_engine *e = engine_new();
    engine_add_text(e, same[k][0], "sqrt(3)");
    engine_add_text(e, "-7", "0");
    engine_add_text(e, same[k][1], "sqrt(27)/3");
    engine_add_text(e, "-3", "-11");
    engine_add_text(e, same[k][1], "sqrt(27)/3+2^-300"); /* not the same */
    engine_run(e, NULL, DYD_OUTCOME_DECIDED);
    const dyd_delaunay *pd = dyd_engine_delaunay(e);
    assert_int_equal(dyd_delaunay_alias(pd, 2), 0);
    assert_int_equal(dyd_delaunay_alias(pd, 4), 4);
    assert_int_equal(dyd_delaunay_status(pd, 0, 4), DYD_LEGAL);
    assert_int_equal(dyd_delaunay_status(pd, 0, 2), DYD_ILLEGAL);
    assert_int_equal(dyd_delaunay_status(pd, 2, 4), DYD_LEGAL);
    dyd_engine_free(e);
  }
}

/* Everything twice, and two points alone. */
static void test_doubles(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  for (int k = 0; k < 24; k++) add_corner(e, k % 2 ? "sqrt(2)" : "2/sqrt(2)", k / 2, 12, "");
  expect_counts(e, NULL, DYD_OUTCOME_FIXPOINT, 12, 0, 54);
  e = engine_new();
  engine_add_text(e, "sqrt(2)", "0");
  engine_add_text(e, "2/sqrt(2)", "0");
  expect_counts(e, NULL, DYD_OUTCOME_DECIDED, 0, 0, 0);
}

/* A proof stays valid when all points are narrowed for a bound, stage by stage. */
static void test_goes_on(void **state) {
  (void)state;
  dyd_engine *e = gon("sqrt(3)", 9, -1, "");
  monotone m;
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  monotone_init(&m, e);
  o.progress = monotone_progress;
  o.progress_user = &m;
  o.start_bits = 8;
  engine_run(e, &o, DYD_OUTCOME_FIXPOINT);
  o.goal = DYD_GOAL_HAUSDORFF;
  for (o.goal_bits = 4; o.goal_bits < 200; o.goal_bits *= 2) {
    dyd_outcome outcome;
    size_t count[4];
    assert_int_equal(dyd_engine_run(&outcome, e, &o, NULL), DYD_OK);
    engine_count(count, e);
    assert_int_equal(count[DYD_TIE], 27);
    assert_int_equal(count[DYD_INDETERMINATE], 0);
  }
  monotone_clear(&m);
  dyd_engine_free(e);
}

/* Ties that were not looked for, or not with enough bits, are found by the next run. */
static void test_later(void **state) {
  (void)state;
  for (int bits = 0; bits < 2; bits++) {
    dyd_engine *e = gon("sqrt(3)", 9, -1, "");
    engine_add_text(e, "cbrt(2+sqrt(5))+cbrt(2-sqrt(5))", "4");
    engine_add_text(e, "1", "4");
    dyd_engine_options o;
    size_t count[4];
    dyd_engine_options_init(&o);
    o.max_bits = 100;
    o.no_ties = !bits;
    o.tie_bits = 16;
    engine_run(e, &o, DYD_OUTCOME_BUDGET);
    o.no_ties = false;
    o.tie_bits = 0;
    engine_run(e, &o, DYD_OUTCOME_FIXPOINT);
    engine_count(count, e);
    assert_int_equal(count[DYD_TIE], 27);
    assert_int_equal(count[DYD_INDETERMINATE], 0);
    dyd_engine_free(e);
  }
}

/* ---- the harness ---- */

static dyd_status open_tied(dyd_engine **out, void *user, dyd_error *err) {
  (void)err;
  *out = gon("sqrt(3)", 5, -1, "");
  engine_add_text(*out, "sqrt(3)", "0");
  engine_add_text(*out, "4", "sqrt(2)");
  engine_add_text(*out, "5", "2*sqrt(2)-1*sqrt(2)");
  engine_add_text(*out, "6", "sqrt(2)");
  if (*(int *)user) engine_add_text(*out, "9*sqrt(2)", "-8");
  return DYD_OK;
}

static void test_harness(void **state) {
  (void)state;
  for (int more = 0; more < 2; more++) {
    dyd_check_options o = {DYD_SIZED(dyd_check_options), .seed = 5, .schedules = (unsigned)test_cases(4),
                           .max_bits = 80};
    dyd_check_report report = {DYD_SIZED(dyd_check_report)};
    dyd_error err;
    assert_int_equal(dyd_check_run(&report, open_tied, &more, &o, &err), DYD_OK);
    if (report.fault != DYD_CHECK_FINE) fail_msg("%s", report.message);
    dyd_check_report_clear(&report);
  }
}

/* Counters, and bits that do not suffice: then nothing is claimed. */
static void test_bits(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_text(e, "cbrt(2+sqrt(5))+cbrt(2-sqrt(5))", "0");
  engine_add_text(e, "1", "0");
  engine_add_text(e, "3", "4");
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.max_bits = 150;
  o.tie_bits = 16;
  engine_run(e, &o, DYD_OUTCOME_BUDGET);
  assert_int_equal(dyd_delaunay_alias(dyd_engine_delaunay(e), 1), 1);
  assert_int_equal(engine_counters(e).ties.by_bound, 0);
  assert_true(engine_counters(e).ties.unknown > 0);
  o.tie_bits = 0;
  o.max_bits = 300;
  engine_run(e, &o, DYD_OUTCOME_DECIDED);
  assert_int_equal(dyd_delaunay_alias(dyd_engine_delaunay(e), 1), 0);
  assert_int_equal(engine_counters(e).ties.by_bound, 2);
  assert_int_equal(engine_counters(e).ties.degree_most, 18);
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_polygons),
      cmocka_unit_test(test_moved),
      cmocka_unit_test(test_nearly_collinear),
      cmocka_unit_test(test_bits_that_show),
      cmocka_unit_test(test_lines),
      cmocka_unit_test(test_chains),
      cmocka_unit_test(test_level_line),
      cmocka_unit_test(test_undescribed),
      cmocka_unit_test(test_callbacks),
      cmocka_unit_test(test_centres),
      cmocka_unit_test(test_aliases),
      cmocka_unit_test(test_doubles),
      cmocka_unit_test(test_goes_on),
      cmocka_unit_test(test_later),
      cmocka_unit_test(test_harness),
      cmocka_unit_test(test_bits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
