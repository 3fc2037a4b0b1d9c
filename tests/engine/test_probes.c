/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points that go ahead in crowded faces: how many bits are requested, and that nothing else depends on them. */
#include "engine/help.h"
#include "rect/rect.h"

#include <string.h>

enum { MANY = 40 };

/* Radii that differ by multiples of 2^-bits; 37 has no divisor in common with 40. */
static dyd_engine *near_circle(int n, int bits) {
  dyd_engine *e = engine_new();
  int weight[MANY];
  for (int k = 0; k < n; k++) weight[k] = k * 37 % n;
  engine_add_polygon(e, n, weight, bits);
  return e;
}

static dyd_engine_options options(int64_t max_bits) {
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.max_bits = max_bits;
  return o;
}

/* Decided in a few stages, for little more than the bits that it takes. */
static void test_asks_little(void **state) {
  (void)state;
  static const int apart[] = {90, 100, 127, 129, 200, 270, 520, 1000, 1500, 3000};
  for (size_t k = 0; k < sizeof apart / sizeof *apart; k++) {
    dyd_engine *e = near_circle(MANY, apart[k]);
    dyd_engine_options o = options(8 * apart[k]);
    monotone m;
    monotone_init(&m, e);
    o.progress = monotone_progress;
    o.progress_user = &m;
    engine_run(e, &o, DYD_OUTCOME_DECIDED);
    dyd_engine_counters c = engine_counters(e);
    double need = apart[k] + 10, each = (double)c.bits_total / (MANY - 1); /* (1, 0) is exact */
    assert_true(each <= 1.5 * need && (apart[k] < 1000 || each <= 1.25 * need));
    assert_true(c.stages <= 4);
    monotone_clear(&m);
    dyd_engine_free(e);
  }
}

/* The same statuses at the end with every schedule. */
static void same_as_uniform(dyd_engine *e, dyd_engine *f, int64_t max_bits, dyd_outcome want) {
  dyd_engine_options o = options(max_bits);
  engine_run(e, &o, want);
  o.schedule = DYD_SCHEDULE_UNIFORM;
  engine_run(f, &o, want);
  assert_same_statuses(e, f);
  dyd_engine_free(e);
  dyd_engine_free(f);
}

/* A circle of which one half is a tie, and one with two points 2^-300 apart. */
static dyd_engine *half_tie(void) {
  dyd_engine *e = engine_new();
  for (int k = 0; k < 32; k++) {
    char x[100], y[100], radius[60] = "1";
    if (k >= 16) snprintf(radius, sizeof radius, "(1+%d*2^-90)", k * k % 31);
    snprintf(x, sizeof x, "%s*cos(2*pi*%d/32)", radius, k);
    snprintf(y, sizeof y, "%s*sin(2*pi*%d/32)", radius, k);
    engine_add_hidden(e, x, y);
  }
  return e;
}

static dyd_engine *near_pair(void) {
  dyd_engine *e = near_circle(24, 80);
  engine_add_hidden(e, "cos(1)*(1+2^-300)", "sin(1)");
  engine_add_hidden(e, "cos(1)", "sin(1)");
  return e;
}

static void test_same_statuses(void **state) {
  (void)state;
  for (int bits = 70; bits < 700; bits += 97)
    same_as_uniform(near_circle(30, bits), near_circle(30, bits), 4096, DYD_OUTCOME_DECIDED);
  same_as_uniform(half_tie(), half_tie(), 512, DYD_OUTCOME_BUDGET);
  same_as_uniform(near_pair(), near_pair(), 4096, DYD_OUTCOME_DECIDED);
}

/* Bits that one pair needs are not requested for all points. */
static void test_local(void **state) {
  (void)state;
  dyd_engine *e = near_pair();
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  dyd_engine_counters c = engine_counters(e);
  assert_true(c.bits_most >= 300 && c.bits_total <= 24 * 128 + 2 * 1024);
  dyd_engine_free(e);
}

/* Runs cut short anywhere in a probe continue from there to the same end, and never retract anything. */
static void test_cut(void **state) {
  (void)state;
  dyd_engine *whole = near_circle(20, 400);
  dyd_engine_options o = options(4096);
  engine_run(whole, &o, DYD_OUTCOME_DECIDED);
  for (uint64_t calls = 1; calls <= 7; calls += 3) {
    dyd_engine *e = near_circle(20, 400);
    dyd_outcome outcome = DYD_OUTCOME_NONE;
    monotone m;
    monotone_init(&m, e);
    o = options(4096);
    o.max_calls = calls;
    o.progress = monotone_progress;
    o.progress_user = &m;
    for (int runs = 0; outcome != DYD_OUTCOME_DECIDED; runs++) {
      assert_true(runs < 1000);
      assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
      size_t count[4] = {1, 1, 1, 1};
      assert_true(outcome == DYD_OUTCOME_DECIDED || engine_counters(e).spent == DYD_BUDGET_CALLS);
      if (dyd_engine_delaunay(e)) engine_count(count, e);
      assert_int_equal(outcome == DYD_OUTCOME_DECIDED, count[DYD_INDETERMINATE] + count[DYD_TIE] == 0);
    }
    assert_same_statuses(whole, e);
    monotone_clear(&m);
    dyd_engine_free(e);
  }
  dyd_engine_free(whole);
}

/* Cancelled from the trace at step number `at`. */
typedef struct canceller {
  dyd_engine *e;
  int steps, at;
  int64_t bits[MANY]; /* asked of each site; more each time */
} canceller;

static void cancel_step(void *user, const dyd_step *step) {
  canceller *c = user;
  assert_true(step->rect && dyd_rect_bits(step->rect) >= step->bits);
  assert_true(step->bits > c->bits[step->site]);
  c->bits[step->site] = step->bits;
  if (++c->steps == c->at) dyd_engine_cancel(c->e);
}

static void test_cancel(void **state) {
  (void)state;
  for (int at = 21; at < 70; at += 4) {
    dyd_engine *e = near_circle(20, 400), *f = near_circle(20, 400);
    dyd_engine_options o = options(4096);
    dyd_outcome outcome;
    engine_run(f, &o, DYD_OUTCOME_DECIDED);
    canceller c = {.e = e, .at = at};
    o.trace = cancel_step;
    o.trace_user = &c;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
    if (outcome == DYD_OUTCOME_CANCELLED) engine_run(e, &o, DYD_OUTCOME_DECIDED);
    assert_same_statuses(e, f);
    dyd_engine_free(e);
    dyd_engine_free(f);
  }
}

/* Fails when more than 100 bits are requested. */
static dyd_status shallow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_stream *s = user;
  if (request->bits > 100) {
    snprintf(err->message, sizeof err->message, "no more than 100 bits");
    return DYD_E_STREAM;
  }
  dyd_status status = dyd_stream_narrow(s, request->bits, request->max_bits, err);
  if (status >= 0) dyd_rect_set(out, dyd_stream_rect(s));
  return status;
}

static void release_stream(void *user) {
  dyd_stream_free(user);
}

/* A point that fails in a probe is blamed, and the last result stays. */
static void test_failure(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  for (int k = 0; k < 12; k++) {
    dyd_real *c[2] = {NULL, NULL};
    dyd_stream *s = NULL;
    char text[2][60];
    snprintf(text[0], sizeof *text, "cos(%d/2)", k);
    snprintf(text[1], sizeof *text, "sin(%d/2)*(1+%d*2^-400)", k, k * 5 % 12);
    for (int a = 0; a < 2; a++) assert_int_equal(DYD_OK, dyd_real_parse(&c[a], text[a], strlen(text[a]), NULL));
    assert_int_equal(DYD_OK, dyd_stream_from_reals(&s, c[0], c[1]));
    const dyd_source source = {DYD_SIZED(dyd_source), .narrow = shallow, .release = release_stream, .user = s};
    assert_int_equal(DYD_OK, dyd_engine_add_source(e, 1, &source, NULL));
  }
  dyd_outcome outcome;
  dyd_error err;
  dyd_error_clear(&err);
  assert_int_equal(DYD_E_STREAM, dyd_engine_run(&outcome, e, NULL, &err));
  assert_int_equal(DYD_OUTCOME_ERROR, outcome);
  assert_true(err.point < 12);
  assert_string_equal("no more than 100 bits", err.message);
  assert_non_null(dyd_engine_delaunay(e));
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_asks_little), cmocka_unit_test(test_same_statuses),
                                     cmocka_unit_test(test_local),       cmocka_unit_test(test_cut),
                                     cmocka_unit_test(test_cancel),      cmocka_unit_test(test_failure)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
