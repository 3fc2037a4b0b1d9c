/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exhausted memory and late cancelling: the k-th allocation fails, for every k. A failed call returns its code, leaks
 * nothing (run under a leak checker), leaves *out NULL or the old statements in force, and can be repeated. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include "delaunay/state.h"
#include "support/failing_memory.h"
#include <cmocka.h>
#include <pthread.h>
#include <time.h>

static harness shared;

/* dyd_delaunay_new with every allocation failing once. It may do without (a rung of a filter is skipped). */
static bool new_fails_well(char *message, const dyd_sites *s) {
  for (size_t k = 1;; k++) {
    dyd_delaunay *pd = NULL;
    dyd_error err;
    dyd_error_clear(&err);
    countdown = k;
    dyd_status status = dyd_delaunay_new(&pd, s, NULL, &err);
    bool over = countdown > 0;
    countdown = 0;
    bool good = status == DYD_OK ? pd != NULL : !over && status == DYD_E_NOMEM && !pd && err.code == DYD_E_NOMEM;
    dyd_delaunay_free(pd);
    if (!good) return wrong(message, "allocation %zu fails: status %d, code %d, object %d", k, status, err.code, !!pd);
    if (over) return true;
  }
}

static bool queries_fail_well(char *message, const dyd_delaunay *pd) {
  for (size_t which = 0; which < 9; which++) {
    dyd_status status = DYD_E_NOMEM;
    for (size_t k = 1; status == DYD_E_NOMEM; k++) {
      dyd_pair_list pairs = {0};
      dyd_triangle_list triangles = {0};
      dyd_triangle_list beyond = {0};
      dyd_index_list list = {0};
      dyd_hull corners = {.pairs = {0}};
      countdown = k;
      if (which == 5) status = dyd_delaunay_partial_hull(&corners, pd, true);
      if (which == 6) status = dyd_delaunay_partial_hull(&corners, pd, false);
      if (which == 7) status = dyd_delaunay_triangles(&triangles, &beyond, pd, 0);
      if (which == 0) status = dyd_delaunay_pairs(&pairs, pd);
      if (which == 1) status = dyd_delaunay_triangles(&triangles, NULL, pd, 0);
      if (which == 2) status = dyd_delaunay_hull(&list, pd);
      if (which == 3) status = dyd_delaunay_neighbours(&list, pd, 0, DYD_TIE);
      const double places[] = {0, 0, 1e9, -1e9, 0.5, 0.25};
      dyd_triangle at[3];
      dyd_truth in[3];
      if (which == 8) status = dyd_delaunay_locate(at, in, pd, places, 3, NULL);
      bool outer = false;
      if (which == 4) status = dyd_delaunay_undecided_faces(pd) ? dyd_delaunay_face(&list, &outer, pd, 0) : DYD_OK;
      bool failed = countdown == 0, empty = !pairs.item && !triangles.item && !list.item && !beyond.item;
      countdown = 0;
      dyd_hull_clear(&corners);
      dyd_triangle_list_clear(&beyond);
      dyd_pair_list_clear(&pairs);
      dyd_triangle_list_clear(&triangles);
      dyd_index_list_clear(&list);
      if (failed ? status != DYD_E_NOMEM || !empty : status != DYD_OK)
        return wrong(message, "query %zu, allocation %zu fails: status %d", which, k, status);
    }
  }
  return true;
}

static bool narrow_some(char *message, harness *h, dyd_sites *s, orc_case *now, const orc_case *target,
                        uint32_t *changed, size_t *count) {
  dyd_rect r;
  bool good = true;
  dyd_rect_init(&r);
  *count = 0;
  for (uint32_t i = 0; i < now->n && good; i++) {
    if (test_chance(&h->random, 2)) continue;
    orc_narrow(&now->rect[i], &h->random, &target->rect[i], test_chance(&h->random, 3));
    harness_rect(&r, &now->rect[i]);
    good = dyd_sites_narrow(s, i, &r) == DYD_OK || wrong(message, "dyd_sites_narrow fails");
    changed[(*count)++] = i;
  }
  dyd_rect_clear(&r);
  return good;
}

/* The update with every allocation failing once, repeated until it succeeds; then it equals a fresh run. */
static bool update_fails_well(char *message, harness *h, const dyd_sites *s, dyd_delaunay *pd, const orc_case *now,
                              const uint32_t *changed, size_t count) {
  snapshot was;
  snapshot_take(was, pd, now->n);
  dyd_status status = DYD_E_NOMEM;
  for (size_t k = 1; status != DYD_OK; k++) {
    dyd_error err;
    dyd_error_clear(&err);
    countdown = k;
    status = dyd_delaunay_update(pd, changed, count, NULL, &err);
    bool over = countdown > 0;
    countdown = 0;
    if (over ? status != DYD_OK : status != DYD_E_NOMEM && status != DYD_OK)
      return wrong(message, "update, allocation %zu fails: status %d", k, status);
    if (!snapshot_kept(message, was, now, pd)) return false;
  }
  dyd_delaunay *fresh = harness_engine(message, s, NULL);
  bool good = fresh && same_statuses(message, h, now, pd, fresh) && queries_agree(message, now, pd);
  dyd_delaunay_free(fresh);
  return good;
}

static bool check(char *message, harness *h, const orc_case *c) {
  orc_case now, target;
  uint32_t changed[ORC_MAX];
  size_t count = 0;
  orc_case_init(&now);
  orc_case_init(&target);
  orc_case_set(&now, c);
  orc_choose(&target, &h->random, c, 3);
  dyd_sites *s = harness_sites(c);
  bool good = new_fails_well(message, s);
  dyd_delaunay *pd = good ? harness_engine(message, s, NULL) : NULL;
  good = pd && queries_fail_well(message, pd);
  for (size_t step = 0; step < 2 && good; step++)
    good = narrow_some(message, h, s, &now, &target, changed, &count) &&
           update_fails_well(message, h, s, pd, &now, changed, count);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  orc_case_clear(&target);
  orc_case_clear(&now);
  return good;
}

static void test_memory(void **state) {
  (void)state;
  harness_run_kinds(&shared, 9, test_cases(3), check);
}

/* ---- cancelling in the middle ---- */

typedef struct alarm_clock {
  volatile int flag;
  long nanoseconds;
} alarm_clock;

static void *ring(void *context) {
  alarm_clock *a = context;
  struct timespec wait = {0, a->nanoseconds};
  nanosleep(&wait, NULL);
  __atomic_store_n(&a->flag, 1, __ATOMIC_RELAXED);
  return NULL;
}

/* One update that may be cancelled at any moment; statements stay as they were, or are the new ones. */
static bool cancelled_update(char *message, harness *h, const dyd_sites *s, dyd_delaunay *pd, const orc_case *now,
                             const uint32_t *changed, size_t count) {
  snapshot was;
  pthread_t thread;
  alarm_clock a = {0, (long)test_below(&h->random, 2000000)};
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = &a.flag};
  snapshot_take(was, pd, now->n);
  if (pthread_create(&thread, NULL, ring, &a)) return wrong(message, "no thread");
  dyd_status status = dyd_delaunay_update(pd, changed, count, &o, NULL);
  pthread_join(thread, NULL);
  if (status != DYD_OK && status != DYD_CANCELLED) return wrong(message, "cancelled update gives %d", status);
  if (!snapshot_kept(message, was, now, pd)) return false;
  if (status == DYD_CANCELLED) {
    h->carried++;
    status = dyd_delaunay_update(pd, changed, count, NULL, NULL);
    if (status != DYD_OK) return wrong(message, "update after cancelling gives %d", status);
  }
  dyd_delaunay *fresh = harness_engine(message, s, NULL);
  bool good = fresh && same_statuses(message, h, now, pd, fresh);
  dyd_delaunay_free(fresh);
  return good;
}

static bool check_cancel(char *message, harness *h, const orc_case *c) {
  orc_case now, target;
  uint32_t changed[ORC_MAX];
  size_t count = 0;
  orc_case_init(&now);
  orc_case_init(&target);
  orc_case_set(&now, c);
  orc_choose(&target, &h->random, c, 3);
  dyd_sites *s = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  bool good = pd;
  for (size_t step = 0; step < 3 && good; step++)
    good = narrow_some(message, h, s, &now, &target, changed, &count) &&
           cancelled_update(message, h, s, pd, &now, changed, count);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  orc_case_clear(&target);
  orc_case_clear(&now);
  return good;
}

static void test_cancelling(void **state) {
  (void)state;
  harness_run_kinds(&shared, 25, test_cases(4), check_cancel);
  fprintf(stderr, "# %zu updates cancelled in the middle\n", shared.carried);
  shared.carried = 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_memory), cmocka_unit_test(test_cancelling)};
  harness_init(&shared, "nomem");
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  harness_clear(&shared);
  return failed;
}
