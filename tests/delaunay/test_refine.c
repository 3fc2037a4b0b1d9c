/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Shrinking never retracts: legal stays legal, illegal stays illegal, and after every update the statuses are those
 * of a fresh run on the same rectangles. At the end all are points and the classical triangulation is reached
 * [LOC-1] [TIE-2]. */
#include <setjmp.h>
#include <stdarg.h>

#include "base/clock.h"
#include "delaunay/harness.h"
#include <cmocka.h>

static harness shared;

/* A legal status carried over where a fresh run gives up is allowed, and counted. */
static bool same_as_fresh(char *message, harness *h, const orc_case *now, const dyd_sites *s, const dyd_delaunay *pd) {
  dyd_delaunay *fresh = harness_engine(message, s, NULL);
  bool good = fresh;
  for (uint32_t i = 0; i < now->n && good; i++)
    for (uint32_t j = i + 1; j < now->n && good; j++) {
      int is = (int)dyd_delaunay_status(pd, i, j), want = (int)dyd_delaunay_status(fresh, i, j);
      bool carried = is == DYD_LEGAL && want == DYD_INDETERMINATE;
      h->carried += carried;
      if (is != want && !carried) good = wrong(message, "pair %u %u: %d after update, %d afresh", i, j, is, want);
    }
  dyd_delaunay_free(fresh);
  return good;
}

static bool right_now(char *message, harness *h, const orc_case *now, const dyd_sites *s, const dyd_delaunay *pd) {
  orc_table t;
  if (!same_as_fresh(message, h, now, s, pd) || !queries_agree(message, now, pd)) return false;
  if (now->n > 7 && !orc_case_all_points(now)) return true;
  orc_statuses(&t, &h->pool, now);
  return same_as_oracle(message, h, now, &t, pd) && witnesses_hold(message, &h->pool, now, pd) &&
         triangles_right(message, &h->pool, now, pd);
}

static bool narrow_site(char *message, harness *h, dyd_sites *s, orc_case *now, const orc_case *target, size_t i,
                        bool final) {
  dyd_rect r;
  dyd_rect_init(&r);
  orc_narrow(&now->rect[i], &h->random, &target->rect[i], final);
  harness_rect(&r, &now->rect[i]);
  dyd_status status = dyd_sites_narrow(s, i, &r);
  dyd_rect_clear(&r);
  return status == DYD_OK || wrong(message, "dyd_sites_narrow gives %d", status);
}

/* Narrows one site, some or all, and lists them, with repeats and with some that have not changed. */
static bool step(char *message, harness *h, dyd_delaunay *pd, dyd_sites *s, orc_case *now, const orc_case *target,
                 bool last) {
  uint32_t changed[3 * ORC_MAX];
  size_t count = 0;
  unsigned one_in = 1 + (unsigned)test_below(&h->random, 4);
  for (size_t i = 0; i < now->n; i++) {
    if (test_chance(&h->random, 8)) changed[count++] = (uint32_t)i;
    if (!last && !test_chance(&h->random, one_in)) continue;
    bool final = last || test_chance(&h->random, 8);
    if (!narrow_site(message, h, s, now, target, i, final)) return false;
    changed[count++] = (uint32_t)i;
    if (test_chance(&h->random, 8)) changed[count++] = (uint32_t)i;
  }
  for (size_t k = count; k > 1; k--) {
    size_t m = (size_t)test_below(&h->random, k);
    uint32_t t = changed[m];
    changed[m] = changed[k - 1], changed[k - 1] = t;
  }
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status status = dyd_delaunay_update(pd, changed, count, NULL, &err);
  return status == DYD_OK || wrong(message, "dyd_delaunay_update gives %d: %s", status, err.message);
}

static bool run_steps(char *message, harness *h, dyd_delaunay *pd, dyd_sites *s, orc_case *now,
                      const orc_case *target) {
  snapshot was;
  size_t steps = 6;
  for (size_t k = 0; k <= steps; k++) {
    char text[MESSAGE_SIZE] = "";
    snapshot_take(was, pd, now->n);
    if (step(text, h, pd, s, now, target, k == steps) && snapshot_kept(text, was, now, pd) &&
        right_now(text, h, now, s, pd))
      continue;
    fprintf(stderr, "at step %zu the rectangles are:\n", k);
    orc_case_print(stderr, now);
    return wrong(message, "step %zu: %s", k, text);
  }
  return true;
}

/* Points with small coordinates inside the rectangles, so that ties and equal points appear in the limit. */
static bool check(char *message, harness *h, const orc_case *c) {
  orc_case now, target;
  orc_case_init(&now);
  orc_case_init(&target);
  orc_case_set(&now, c);
  orc_choose(&target, &h->random, c, test_chance(&h->random, 2) ? 2 : 5);
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  bool good = pd && run_steps(message, h, pd, s, &now, &target);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  orc_case_clear(&target);
  orc_case_clear(&now);
  return good;
}

static void test_small(void **state) {
  (void)state;
  harness_run_kinds(&shared, 7, test_cases(12), check);
}

static void test_larger(void **state) {
  (void)state;
  harness_run_kinds(&shared, 24, test_cases(2), check);
}

/* For DYADEL_SOAK seconds, one seed after the other from DYADEL_TEST_SEED on: what fails fails at once with its seed.
 */
static void test_soak(void **state) {
  (void)state;
  uint64_t seed = test_environment("DYADEL_TEST_SEED", 1);
  double until = dyd_seconds() + (double)test_environment("DYADEL_SOAK", 3);
  do {
    shared.random = test_random_of("soak", seed++);
    harness_run_cases(&shared, 7, 4 * ORC_KINDS, check);
    harness_run_cases(&shared, 16, ORC_KINDS, check);
  } while (dyd_seconds() < until);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_small), cmocka_unit_test(test_larger),
                                     cmocka_unit_test(test_soak)};
  harness_init(&shared, "refine");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
