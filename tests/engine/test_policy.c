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

static dyd_status gamble(dyd_wants *wants, void *user, const dyd_engine *e, const dyd_request *request, size_t count,
                         dyd_error *err) {
  gambler *g = user;
  test_random *r = g->random;
  assert_int_equal(0, dyd_wants_count(wants));
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
    assert_int_equal(DYD_OK, dyd_wants_add(wants, site, bits));
  }
  if (g->beyond && g->calls >= g->at) dyd_wants_add(wants, (uint32_t)dyd_engine_count(e) - 1 + g->beyond, 9);
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
  for (size_t k = 0; k < test_cases(30); k++) {
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

/* ---- hindsight: the best plan is the one that a literal search finds ---- */

enum { FEW = 4 };

/* Is the triangulation decided when point k is known to bits[k]? */
static bool is_decided(char text[FEW][2][40], const int64_t bits[FEW]) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_rect r;
  mpq_t lo, hi;
  size_t count[4];
  mpq_inits(lo, hi, NULL);
  dyd_rect_init(&r);
  assert_int_equal(DYD_OK, dyd_sites_new(&sites));
  for (int k = 0; k < FEW; k++) {
    for (int a = 0; a < 2; a++) {
      dyd_real *x = NULL;
      assert_int_equal(DYD_OK, dyd_real_parse(&x, text[k][a], strlen(text[k][a]), NULL));
      assert_true(dyd_real_narrow(x, 200, 200, NULL) >= 0);
      dyd_interval_get_q(lo, hi, dyd_real_interval(x));
      assert_int_equal(DYD_OK, dyd_interval_set_outward(a ? &r.y : &r.x, lo, hi, -bits[k] - 2));
      dyd_real_free(x);
    }
    assert_int_equal(DYD_OK, dyd_sites_add_rect(sites, &r));
  }
  assert_int_equal(DYD_OK, dyd_delaunay_new(&pd, sites, NULL, NULL));
  dyd_delaunay_count(count, pd);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  dyd_rect_clear(&r);
  mpq_clears(lo, hi, NULL);
  return count[DYD_INDETERMINATE] + count[DYD_TIE] == 0;
}

static uint64_t best_of_all(char text[FEW][2][40], int64_t first, int64_t top) {
  int64_t bits[FEW] = {first, first, first, first};
  uint64_t best = UINT64_MAX;
  for (;;) {
    uint64_t sum = 0;
    int k = 0;
    for (int j = 0; j < FEW; j++) sum += (uint64_t)bits[j];
    if (sum < best && is_decided(text, bits)) best = sum;
    while (k < FEW && ++bits[k] > top) bits[k++] = first;
    if (k == FEW) return best;
  }
}

static void test_hindsight(void **state) {
  (void)state;
  test_random r = test_random_start("hindsight");
  size_t compared = 0;
  for (size_t tries = 0; compared < 4 && tries < 400; tries++) {
    char text[FEW][2][40];
    dyd_engine *e = engine_new();
    for (int k = 0; k < FEW; k++) {
      int radius = 20 + (int)test_below(&r, 3), angle = 1 + 7 * k + (int)test_below(&r, 7);
      for (int a = 0; a < 2; a++)
        snprintf(text[k][a], sizeof text[k][a], "%d/16*%s(%d/4)", radius, a ? "sin" : "cos", angle);
      engine_add_text(e, text[k][0], text[k][1]);
    }
    dyd_engine_options o;
    dyd_engine_options_init(&o);
    o.start_bits = o.step_bits = 1;
    o.max_bits = 40;
    const dyd_converge_options how = {DYD_SIZED(dyd_converge_options), .hindsight = 1000000};
    dyd_convergence table = {DYD_SIZED(dyd_convergence)};
    assert_int_equal(DYD_OK, dyd_converge_run(&table, e, &o, &how, NULL));
    int64_t most = table.count ? table.row[table.count - 1]->bits_most : 0;
    if (table.outcome == DYD_OUTCOME_DECIDED && most >= 2 && most <= 4) {
      assert_int_equal(best_of_all(text, 1, 2 * most), table.best_bits);
      compared++;
    }
    dyd_convergence_clear(&table);
    dyd_engine_free(e);
  }
  assert_int_equal(4, compared);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_no_false_statement), cmocka_unit_test(test_bad_answers),
                                     cmocka_unit_test(test_programs), cmocka_unit_test(test_hindsight)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
