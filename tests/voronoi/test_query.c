/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Nearest sites of computable points: outcomes, answers against all distances [NEAR-3], ties [NEAR-4]. */
#include "predicate/circle.h"
#include "voronoi/streams.h"

#include <dyadel/predicate.h>
#include <flint/flint.h>

static test_random shared;

static dyd_outcome nearest(dyd_index_list *out, bool *sure, dyd_engine *e, const char *x, const char *y,
                           const dyd_engine_options *o) {
  dyd_stream *at = text_stream(x, y);
  dyd_outcome outcome;
  dyd_error err;
  dyd_status st = dyd_engine_nearest(out, sure, &outcome, e, at, o, &err);
  assert_true((st < 0) == (outcome == DYD_OUTCOME_ERROR));
  dyd_stream_free(at);
  return outcome;
}

static void test_nearest(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  dyd_index_list l = {0};
  dyd_outcome outcome;
  bool sure;
  dyd_engine_add_stream(e, text_stream("0", "0"), NULL);
  dyd_engine_add_stream(e, text_stream("2*sqrt(2)", "0"), NULL);
  dyd_engine_add_stream(e, text_stream("0", "10"), NULL);
  dyd_engine_add_stream(e, text_stream("10", "10"), NULL);
  dyd_engine_add_stream(e, text_stream("[29,30]", "[4,5]"), NULL);
  assert_int_equal(nearest(&l, &sure, e, "1", "1", NULL), DYD_OUTCOME_ERROR); /* no result yet */
  run(e, DYD_OUTCOME_DECIDED);
  assert_int_equal(nearest(&l, &sure, e, "1", "1", NULL), DYD_OUTCOME_DECIDED);
  assert_true(sure && l.count == 1 && l.item[0] == 0);
  assert_false(dyd_engine_nearest_tied(e));
  assert_int_equal(nearest(&l, &sure, e, "sqrt(2)", "-sqrt(3)", NULL), DYD_OUTCOME_FIXPOINT); /* equal reals */
  assert_true(dyd_engine_nearest_tied(e));
  assert_true(!sure && l.count == 2 && l.item[0] == 0 && l.item[1] == 1);
  assert_int_equal(nearest(&l, &sure, e, "sqrt(2)+2^-1000", "-sqrt(3)", NULL), DYD_OUTCOME_DECIDED);
  assert_true(sure && l.count == 1 && l.item[0] == 1);
  assert_int_equal(nearest(&l, &sure, e, "5", "123/7", NULL), DYD_OUTCOME_FIXPOINT); /* an exact tie */
  assert_true(!sure && l.count == 2 && l.item[0] == 2 && l.item[1] == 3 && dyd_engine_nearest_tied(e));
  assert_int_equal(nearest(&l, &sure, e, "20+sqrt(5)/4", "sqrt(7)", NULL), DYD_OUTCOME_DECIDED);
  assert_int_equal(nearest(&l, &sure, e, "[4,6]", "123/7", NULL), DYD_OUTCOME_FIXPOINT); /* a fixed rectangle */
  assert_true(!sure && l.count == 2 && !dyd_engine_nearest_tied(e));
  assert_int_equal(nearest(&l, &sure, e, "[0,20]", "3", NULL), DYD_OUTCOME_BUDGET); /* site 1 is never exact */
  assert_true(!sure && l.count == 4);
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.max_calls = 1;
  assert_int_equal(nearest(&l, &sure, e, "sqrt(2)+2^-1000", "-sqrt(3)", &o), DYD_OUTCOME_BUDGET);
  o.max_calls = 0;
  o.max_bits = 900;
  assert_int_equal(nearest(&l, &sure, e, "sqrt(2)+2^-1000", "-sqrt(3)", &o), DYD_OUTCOME_BUDGET);
  o.seconds = -1;
  assert_int_equal(nearest(&l, &sure, e, "0", "0", &o), DYD_OUTCOME_ERROR);
  assert_int_equal(nearest(&l, &sure, e, "log(sqrt(2)-sqrt(2))", "0", NULL), DYD_OUTCOME_ERROR);
  assert_false(dyd_engine_nearest_tied(e));
  dyd_engine_cancel(e);
  assert_int_equal(nearest(&l, &sure, e, "sqrt(2)", "0", NULL), DYD_OUTCOME_CANCELLED);
  assert_true(!sure && l.count == 2);
  assert_int_equal(nearest(&l, &sure, e, "1", "1", NULL), DYD_OUTCOME_DECIDED);
  assert_int_equal(dyd_engine_run(&outcome, e, NULL, NULL), DYD_OK); /* brings the points narrowed into the result */
  assert_int_equal(outcome, DYD_OUTCOME_DECIDED);
  dyd_index_list_clear(&l);
  dyd_engine_free(e);
}

/* Corners of the n-gon about (sqrt(2), 1/3), of radius sqrt(3), corner `moved` by the text; and points outside. */
static dyd_engine *round_gon(int n, int moved, const char *by) {
  dyd_engine *e = engine_new();
  for (int k = 0; k < n; k++) {
    char x[200], y[200];
    snprintf(x, sizeof x, "sqrt(2)+(sqrt(3)%s)*cos(2*pi*%d/%d)", k == moved ? by : "", k, n);
    snprintf(y, sizeof y, "1/3+(sqrt(3)%s)*sin(2*pi*%d/%d)", k == moved ? by : "", k, n);
    dyd_engine_add_stream(e, text_stream(x, y), NULL);
  }
  dyd_engine_add_stream(e, text_stream("9", "sqrt(5)"), NULL);
  dyd_engine_add_stream(e, text_stream("-9", "1"), NULL);
  dyd_outcome outcome;
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.max_stages = 1; /* so that queries have to refine */
  assert_int_equal(dyd_engine_run(&outcome, e, &o, NULL), DYD_OK);
  return e;
}

static void expect_near(dyd_engine *e, const char *x, const dyd_engine_options *o, dyd_outcome outcome, size_t count,
                        bool tied) {
  dyd_index_list l = {0};
  bool sure;
  dyd_outcome found = nearest(&l, &sure, e, x, "1/3", o);
  if (found != outcome) fail_msg("%s: %s, %zu listed", x, dyd_outcome_text(found), l.count);
  assert_int_equal(l.count, count);
  assert_int_equal(sure, count == 1);
  assert_int_equal(dyd_engine_nearest_tied(e), tied);
  dyd_index_list_clear(&l);
}

/* The centre of a regular polygon is as far from all its corners, and that is seen at once; next to it, or with one
 * corner moved, one corner is nearest, or all others. */
static void test_ties(void **state) {
  (void)state;
  for (int n = 3; n <= 20; n++) {
    dyd_engine *e = round_gon(n, -1, "");
    dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
    assert_int_equal(dyd_engine_get_counters(&c, e, NULL), DYD_OK);
    uint64_t calls = c.calls;
    expect_near(e, "sqrt(2)", NULL, DYD_OUTCOME_FIXPOINT, (size_t)n, true);
    assert_int_equal(dyd_engine_get_counters(&c, e, NULL), DYD_OK);
    assert_int_equal(c.calls, calls);
    expect_near(e, "2/sqrt(2)+2^-900", NULL, DYD_OUTCOME_DECIDED, 1, false);
    expect_near(e, "[1.4,1.5]", NULL, DYD_OUTCOME_BUDGET, (size_t)n, false);
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.max_bits = 100;
    o.no_ties = true;
    expect_near(e, "sqrt(2)", &o, DYD_OUTCOME_BUDGET, (size_t)n, false);
    dyd_engine_free(e);
    e = round_gon(n, n / 2, "-2^-2000");
    expect_near(e, "sqrt(2)", NULL, DYD_OUTCOME_DECIDED, 1, false);
    dyd_engine_free(e);
    o.max_bits = 1000;
    o.no_ties = false;
    e = round_gon(n, n / 2, "+2^-2000"); /* all are listed at first: nothing is claimed of them */
    expect_near(e, "sqrt(2)", &o, DYD_OUTCOME_BUDGET, (size_t)n, false);
    expect_near(e, "sqrt(2)", NULL, DYD_OUTCOME_FIXPOINT, (size_t)n - 1, true);
    dyd_engine_free(e);
  }
}

/* The centre of three points given by roots, as a stream of its own; a corner that is not proved to be one. */
static void test_tied_centre(void **state) {
  static const char *const at[4][2] = {
      {"sqrt(2)", "sqrt(3)"}, {"-sqrt(3)", "sqrt(2)"}, {"sqrt(5)-1", "-cbrt(7)"}, {"9", "9"}};
  (void)state;
  for (int hidden = 0; hidden < 2; hidden++) {
    dyd_engine *e = engine_new();
    dyd_stream *corner[3], *centre = NULL;
    for (int k = 0; k < 4; k++)
      dyd_engine_add_stream(e, text_stream(at[k][0], hidden && k == 1 ? "tan(atan(sqrt(2)))" : at[k][1]), NULL);
    run(e, DYD_OUTCOME_DECIDED);
    for (uint32_t k = 0; k < 3; k++) corner[k] = text_stream(at[k][0], at[k][1]);
    assert_int_equal(dyd_stream_voronoi_vertex(&centre, corner[0], corner[1], corner[2]), DYD_OK);
    dyd_index_list l = {0};
    dyd_outcome outcome;
    bool sure;
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.max_bits = 300;
    assert_int_equal(dyd_engine_nearest(&l, &sure, &outcome, e, centre, &o, NULL), DYD_OK);
    assert_int_equal(outcome, hidden ? DYD_OUTCOME_BUDGET : DYD_OUTCOME_FIXPOINT);
    assert_true(!sure && l.count == 3);
    assert_int_equal(dyd_engine_nearest_tied(e), !hidden);
    dyd_index_list_clear(&l);
    dyd_stream_free(centre);
    dyd_engine_free(e);
  }
}

/* Random: the answer of the computable point is that of the sites and points known to 2^-300. */
static void test_nearest_random(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  enum { SITES = 60 };
  for (int k = 0; k < SITES; k++) dyd_engine_add_stream(e, random_stream(&shared), NULL);
  run(e, DYD_OUTCOME_DECIDED);
  for (size_t k = test_cases(40); k; k--) {
    dyd_stream *at = random_stream(&shared);
    dyd_index_list l = {0};
    dyd_outcome outcome;
    bool sure;
    assert_int_equal(dyd_engine_nearest(&l, &sure, &outcome, e, at, NULL, NULL), DYD_OK);
    assert_int_equal(outcome, DYD_OUTCOME_DECIDED);
    assert_true(sure && l.count == 1);
    narrow(at, 300);
    const dyd_rect *q = dyd_stream_rect(at);
    bool dyadic = mpz_cmp_ui(q->x.den, 1) == 0 && mpz_cmp_ui(q->y.den, 1) == 0;
    dyd_stream *site[SITES];
    for (uint32_t i = 0; i < SITES; i++) {
      assert_int_equal(dyd_engine_stream(&site[i], e, i), DYD_OK);
      narrow(site[i], 300);
    }
    for (uint32_t i = 0; i < SITES; i++) {
      dyd_point c = {q->x.lo, q->y.lo}; /* borrowed */
      if (dyadic && i != l.item[0])
        assert_true(dyd_compare_distance(&c, dyd_stream_rect(site[l.item[0]]), DYD_CLOSEST, dyd_stream_rect(site[i]),
                                         DYD_FARTHEST) < 0);
    }
    for (uint32_t i = 0; i < SITES; i++) dyd_stream_free(site[i]);
    dyd_index_list_clear(&l);
    dyd_stream_free(at);
  }
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_nearest), cmocka_unit_test(test_nearest_random),
                                     cmocka_unit_test(test_ties), cmocka_unit_test(test_tied_centre)};
  shared = test_random_start("query");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  flint_cleanup();
  return failed;
}
