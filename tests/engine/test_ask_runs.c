/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Questions of users about the triangulation, before and between runs, and with exhausted memory. */
#include "engine/help.h"

#include "support/failing_memory.h"

static dyd_engine_options options(void) {
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  return o;
}

/* Asks whether all pairs are decided, and requests the ends of the others, as a user might. */
static dyd_status ask_pairs(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  unsigned *asked = user;
  dyd_pair_list pairs = {0};
  (void)err;
  assert_non_null(dyd_engine_delaunay(e));
  assert_int_equal(++*asked, engine_counters(e).stages);
  dyd_status st = dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(e));
  *answered = true;
  for (size_t k = 0; st == DYD_OK && k < pairs.count; k++) {
    if (pairs.item[k].status != DYD_INDETERMINATE) continue;
    *answered = false;
    st = dyd_wants_add(wants, pairs.item[k].i, DYD_BITS_NEXT);
    if (st == DYD_OK) st = dyd_wants_add(wants, pairs.item[k].j, DYD_BITS_NEXT);
  }
  dyd_pair_list_clear(&pairs);
  return st;
}

static void count_stage(void *user, const dyd_progress *p) {
  assert_int_equal(++*(uint64_t *)user, p->stage);
}

/* The same statuses as by a run, and budgets of stages and pairs. */
static void test_triangulation(void **state) {
  (void)state;
  const int weight[12] = {3, 17, 5, 40, 1, 22, 9, 31, 12, 2, 27, 14};
  dyd_engine *e = engine_new(), *f = engine_new();
  engine_add_polygon(e, 12, weight, 200);
  engine_add_polygon(f, 12, weight, 200);
  engine_run(f, NULL, DYD_OUTCOME_DECIDED);
  unsigned asked = 0;
  uint64_t stages = 0;
  dyd_outcome outcome;
  dyd_error err;
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = ask_pairs, .user = &asked, .triangulate = true};
  dyd_engine_options o = options();
  o.progress = count_stage;
  o.progress_user = &stages;
  o.max_stages = 1;
  assert_int_equal(DYD_OK, dyd_engine_ask(&outcome, e, &question, &o, &err));
  assert_int_equal(DYD_OUTCOME_BUDGET, outcome);
  assert_int_equal(1, asked);
  assert_int_equal(1, stages);
  asked = 0; /* the next question starts from the same result */
  o.max_stages = 0;
  assert_int_equal(DYD_OK, dyd_engine_ask(&outcome, e, &question, &o, &err));
  assert_int_equal(DYD_OUTCOME_DECIDED, outcome);
  assert_int_equal(asked, stages);
  assert_true(stages >= 3);
  assert_same_statuses(e, f);
  engine_run(e, NULL, DYD_OUTCOME_DECIDED);
  assert_int_equal(stages, engine_counters(e).stages);
  dyd_engine_free(f);
  dyd_engine_free(e);
}

static dyd_status ask_nothing(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  (void)answered, (void)wants, (void)e, (void)user, (void)err;
  return DYD_OK;
}

static void test_pairs(void **state) {
  (void)state;
  dyd_engine *e = engine_new();
  engine_add_polygon(e, 12, NULL, 0);
  dyd_outcome outcome;
  dyd_error err;
  dyd_question question = {DYD_SIZED(dyd_question), .ask = ask_nothing, .triangulate = true};
  dyd_engine_options o = options();
  o.max_pairs = 8;
  assert_int_equal(DYD_OK, dyd_engine_ask(&outcome, e, &question, &o, &err));
  assert_int_equal(DYD_OUTCOME_BUDGET, outcome);
  assert_int_equal(DYD_CAPPED, err.code);
  assert_true(err.message[0] != 0);
  question.triangulate = false;
  assert_int_equal(DYD_OK, dyd_engine_ask(&outcome, e, &question, &o, &err));
  assert_int_equal(DYD_OUTCOME_FIXPOINT, outcome);
  assert_int_equal(DYD_OK, err.code);
  dyd_engine_free(e);
}

/* Wants three sites once. */
typedef struct want {
  uint32_t site[3];
  int64_t bits;
  bool asked;
} want;

static dyd_status ask_once(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  want *q = user;
  dyd_status st = DYD_OK;
  (void)e, (void)err;
  *answered = q->asked;
  q->asked = true;
  for (int k = 0; st == DYD_OK && k < 3; k++) st = dyd_wants_add(wants, q->site[k], q->bits);
  return st;
}

static dyd_status put(dyd_engine *e, want q) {
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = ask_once, .user = &q};
  dyd_status st = dyd_engine_ask(&outcome, e, &question, NULL, NULL);
  assert_int_equal(st == DYD_OK ? DYD_OUTCOME_DECIDED : DYD_OUTCOME_ERROR, outcome);
  return st;
}

/* A question narrows before the first run, and between two: runs continue from there, and end as they would. */
static void test_before_runs(void **state) {
  (void)state;
  test_random r = test_random_start("ask");
  for (int round = 0; round < 20; round++) {
    dyd_engine *e = engine_new(), *f = engine_new();
    test_random copy = r;
    engine_add_roots(e, &r, 30);
    engine_add_roots(f, &copy, 30);
    assert_int_equal(DYD_OK, put(e, (want){.site = {0, 1, 7}, .bits = 150}));
    assert_int_equal(3, engine_counters(e).calls);
    dyd_engine_options o = options();
    o.max_stages = 1;
    dyd_outcome outcome;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
    assert_int_equal(30, engine_counters(e).calls);
    assert_int_equal(DYD_OK, put(e, (want){.site = {0, 1, 8}, .bits = 1000}));
    engine_run(e, NULL, DYD_OUTCOME_DECIDED);
    engine_run(f, NULL, DYD_OUTCOME_DECIDED);
    assert_same_statuses(e, f);
    dyd_engine_free(f);
    dyd_engine_free(e);
  }
}

/* ---- exhausted memory ---- */

static dyd_status ask_and_run(dyd_engine *e) {
  dyd_outcome outcome = DYD_OUTCOME_ERROR;
  dyd_status st = put(e, (want){.site = {0, 1, 3}, .bits = 100});
  if (st == DYD_OK) st = dyd_engine_run(&outcome, e, NULL, NULL);
  assert_int_equal(st != DYD_OK, outcome == DYD_OUTCOME_ERROR);
  return st;
}

/* An allocation fails, for every k or so the k-th: an error code, no leak (under a leak checker), and the engine
 * continues from there. Eight crossing pairs make probes go ahead. */
static void test_memory(void **state) {
  (void)state;
  bool over = false;
  const int weight[12] = {3, 17, 5, 40, 1, 22, 9, 31, 12, 2, 27, 14};
  dyd_engine *whole = engine_new();
  engine_add_polygon(whole, 12, weight, 80);
  assert_int_equal(DYD_OK, ask_and_run(whole));
  for (size_t k = 1; !over; k += 1 + k / 32) {
    dyd_engine *e = engine_new();
    engine_add_polygon(e, 12, weight, 80);
    countdown = k;
    dyd_status st = ask_and_run(e);
    over = countdown > 0;
    countdown = 0;
    assert_true(st == DYD_OK || st == DYD_E_NOMEM);
    engine_run(e, NULL, DYD_OUTCOME_DECIDED);
    assert_same_statuses(whole, e);
    dyd_engine_free(e);
  }
  dyd_engine_free(whole);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_triangulation), cmocka_unit_test(test_pairs),
                                     cmocka_unit_test(test_before_runs), cmocka_unit_test(test_memory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
