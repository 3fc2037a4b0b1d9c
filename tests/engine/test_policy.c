/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Policies: whatever one answers, no statement is false, and the run ends as without it. */
#include "engine/help.h"

#include <string.h>

/* A policy that draws its answers; `give` is returned from its call number `at` on. */
typedef struct gambler {
  test_random *random;
  size_t calls, at;
  int give;
  bool enters, cancels;
  uint32_t beyond; /* added to a point's number */
} gambler;

static dyd_status gamble(dyd_plan *plan, void *user, const dyd_engine *e, const dyd_request *request, size_t count,
                         dyd_error *err) {
  gambler *g = user;
  test_random *r = g->random;
  assert_int_equal(0, dyd_plan_count(plan));
  assert_int_equal(0, err->message[0]);
  assert_true(count > 0);
  for (size_t k = 0; k < count; k++) assert_true(dyd_request_at(request, k)->point < dyd_engine_count(e));
  if (++g->calls == 1) assert_null(dyd_engine_delaunay(e));
  if (g->cancels && g->calls == g->at) dyd_engine_cancel((dyd_engine *)(uintptr_t)e);
  if (g->enters) {
    dyd_outcome outcome;
    assert_int_equal(DYD_E_ARG, dyd_engine_run(&outcome, (dyd_engine *)(uintptr_t)e, NULL, NULL));
  }
  for (uint64_t k = test_below(r, 6); k > 0; k--) {
    static const int64_t odd[] = {INT64_MIN, INT64_MAX, -1, 0, -(1 << 20), 5000};
    uint32_t site = (uint32_t)test_below(r, dyd_engine_count(e));
    int64_t bits = test_chance(r, 4) ? odd[test_below(r, 6)] : (int64_t)test_below(r, 90);
    assert_int_equal(DYD_OK, dyd_plan_add(plan, site, bits));
  }
  if (g->beyond && g->calls >= g->at) dyd_plan_add(plan, (uint32_t)dyd_engine_count(e) - 1 + g->beyond, 9);
  return g->calls >= g->at ? (dyd_status)g->give : DYD_OK;
}

static dyd_engine *engine_of_seed(uint64_t seed) {
  test_random r = {seed};
  dyd_engine *e = engine_new();
  char x[80], y[80];
  size_t n = 4 + test_below(&r, 6);
  for (size_t k = 0; k < n; k++) { /* some nearly on one circle, some tied on it */
    int close = (int)test_below(&r, 60);
    snprintf(x, sizeof x, "cos(%zu)*(1+2^-%d)", k, 4 + close);
    snprintf(y, sizeof y, "sin(%zu)*(1+2^-%d)", k, 4 + (test_chance(&r, 3) ? 30 : close));
    engine_add_text(e, x, y);
  }
  return e;
}

static dyd_engine_options policy_options(gambler *g, test_random *r) {
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.policy = gamble;
  o.policy_user = g;
  o.start_bits = 1 + (int64_t)test_below(r, 9);
  o.max_bits = 300;
  if (test_chance(r, 2)) o.step_bits = 1 + (int64_t)test_below(r, 40);
  if (test_chance(r, 3)) o.schedule = DYD_SCHEDULE_UNIFORM;
  return o;
}

static void test_no_false_statement(void **state) {
  (void)state;
  test_random r = test_random_start("policy");
  for (size_t k = 0; k < test_cases(60); k++) {
    uint64_t seed = test_below(&r, 1u << 30);
    dyd_engine *e = engine_of_seed(seed), *f = engine_of_seed(seed);
    gambler g = {.random = &r, .at = SIZE_MAX, .enters = test_chance(&r, 4)};
    dyd_engine_options o = policy_options(&g, &r), plain;
    dyd_outcome outcome, other;
    dyd_engine_options_init(&plain);
    plain.max_bits = 300;
    monotone m;
    monotone_init(&m, e);
    o.progress = monotone_progress;
    o.progress_user = &m;
    assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, &o, NULL));
    assert_int_equal(DYD_OK, dyd_engine_run(&other, f, &plain, NULL));
    assert_int_equal(other, outcome);
    assert_same_statuses(e, f);
    assert_true(g.calls >= 1);
    monotone_clear(&m);
    dyd_engine_free(e);
    dyd_engine_free(f);
  }
}

/* Errors, cancels and points that do not exist end the run; the next one continues. */
static void test_bad_answers(void **state) {
  (void)state;
  test_random r = test_random_start("policy answers");
  static const struct {
    int give;
    uint32_t beyond;
    bool cancels;
    dyd_outcome outcome;
  } row[] = {{DYD_E_STREAM, 0, false, DYD_OUTCOME_ERROR},    {77, 0, false, DYD_OUTCOME_ERROR},
             {DYD_OK, 1, false, DYD_OUTCOME_ERROR},          {DYD_CANCELLED, 0, false, DYD_OUTCOME_CANCELLED},
             {DYD_OK, 0, true, DYD_OUTCOME_CANCELLED},       {DYD_OK, UINT32_MAX - 99, false, DYD_OUTCOME_ERROR},
             {DYD_CANCELLED, 0, true, DYD_OUTCOME_CANCELLED}};
  for (size_t k = 0; k < 2 * sizeof row / sizeof *row; k++) {
    dyd_engine *e = engine_of_seed(3), *f = engine_of_seed(3);
    gambler g = {.random = &r,
                 .at = 1 + k % 2,
                 .give = row[k / 2].give,
                 .beyond = row[k / 2].beyond,
                 .cancels = row[k / 2].cancels};
    dyd_engine_options o = policy_options(&g, &r);
    dyd_outcome outcome;
    dyd_error err;
    dyd_status st = dyd_engine_run(&outcome, e, &o, &err);
    assert_int_equal(row[k / 2].outcome, outcome);
    assert_int_equal(outcome == DYD_OUTCOME_ERROR, st < 0);
    assert_int_equal(st < 0, err.message[0] != 0);
    o.policy = NULL;
    engine_run(e, &o, DYD_OUTCOME_DECIDED);
    engine_run(f, NULL, DYD_OUTCOME_DECIDED);
    assert_same_statuses(e, f);
    dyd_engine_free(e);
    dyd_engine_free(f);
  }
}

/* ---- programs ---- */

#define LOOP "while read w a b c; do case $w in stage) n=$c;; plan) p=\"$a $b\";; choose) "

static dyd_status run_program(dyd_outcome *outcome, dyd_engine *e, const char *program, dyd_error *err) {
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.start_bits = 4;
  o.policy_program = program;
  o.policy_seconds = 5;
  return dyd_engine_run(outcome, e, &o, err);
}

static void test_programs(void **state) {
  (void)state;
  static const char *const good[] = {LOOP "echo go;; esac; done", LOOP "echo refine $p; echo go;; esac; done",
                                     LOOP "echo 'refine 0 -5'; printf 'go\\r\\n';; esac; done"};
  static const struct {
    const char *program, *says;
  } bad[] = {{LOOP "echo refine $n 5; echo go;; esac; done", "asks for point"},
             {LOOP "echo refine 99999999999 5;; esac; done", "the policy program wrote \"refine 99999999999 5\""},
             {LOOP "echo refine 1;; esac; done", "\"refine I B\" or \"go\""},
             {LOOP "echo refine 1 2-3;; esac; done", "\"refine I B\" or \"go\""},
             {LOOP "exit 7;; esac; done", "exit status 7"},
             {"exec no-such-program", "exit status 127"},
             {"sleep 0.1; echo x", "the policy program"}};
  dyd_outcome outcome;
  dyd_error err;
  for (size_t k = 0; k < sizeof good / sizeof *good; k++) {
    dyd_engine *e = engine_of_seed(3), *f = engine_of_seed(3);
    assert_int_equal(DYD_OK, run_program(&outcome, e, good[k], &err));
    engine_run(f, NULL, outcome);
    assert_same_statuses(e, f);
    dyd_engine_free(e);
    dyd_engine_free(f);
  }
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    dyd_engine *e = engine_of_seed(3);
    assert_true(run_program(&outcome, e, bad[k].program, &err) < 0);
    if (!strstr(err.message, bad[k].says)) fail_msg("%s: %s", bad[k].program, err.message);
    dyd_engine_free(e);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_no_false_statement), cmocka_unit_test(test_bad_answers),
                                     cmocka_unit_test(test_programs)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
