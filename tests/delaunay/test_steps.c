/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sites that become narrower one by one: pairs that are open, against a triangulation made anew [LOC-4]; and wider:
 * edges that stay certain are legal, and what is taken back is as it was. Boxes that overlap, grids, points, thirds. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/steps.h"
#include "support/random.h"
#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 40 };

/* Boxes about c[] / den; half[k] / den wide. */
typedef struct steps_case {
  size_t n;
  long c[MOST][2], half[MOST], den;
} steps_case;

static dyd_status case_rect(dyd_rect *out, const void *user, size_t i) {
  const steps_case *c = user;
  mpq_t end[4];
  for (int k = 0; k < 4; k++) {
    mpq_init(end[k]);
    mpq_set_si(end[k], c->c[i][k / 2] + (k % 2 ? c->half[i] : -c->half[i]), (unsigned long)c->den);
    mpq_canonicalize(end[k]);
  }
  dyd_status st = dyd_interval_set_outward(&out->x, end[0], end[1], -80);
  if (st == DYD_OK) st = dyd_interval_set_outward(&out->y, end[2], end[3], -80);
  for (int k = 0; k < 4; k++) mpq_clear(end[k]);
  return st;
}

static dyd_delaunay *case_build(const steps_case *c) {
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options)};
  dyd_delaunay *pd = NULL;
  assert_int_equal(dyd_delaunay_made(&pd, c->n, case_rect, c, &o, NULL), DYD_OK);
  return pd;
}

static steps_case case_make(test_random *r, size_t k) {
  steps_case c = {.n = 4 + test_below(r, MOST - 4), .den = k % 3 ? 64 : 192};
  const size_t side = k % 4 ? 4 + test_below(r, 40) : 5, step = k % 4 ? 16 : 64;
  const size_t wide = 1 + test_below(r, 100);
  for (size_t i = 0; i < c.n; i++) {
    for (int a = 0; a < 2; a++) c.c[i][a] = (long)(step * test_below(r, side) + (k % 4 > 1 ? test_below(r, step) : 0));
    c.half[i] = test_chance(r, 5) ? 0 : (long)test_below(r, wide);
  }
  return c;
}

/* Pairs of s that are open are those that are so in a triangulation made anew. */
static void check_open(const dyd_steps *s, const steps_case *c) {
  dyd_delaunay *pd = case_build(c);
  const uint32_t *site = s->pd->sk.reps.site;
  size_t count[4], open = 0;
  for (size_t k = 0; k < s->pairs; k++) {
    dyd_pair_status now = dyd_delaunay_status(pd, site[s->pair[k].i], site[s->pair[k].j]);
    assert_int_equal(s->open[k], now == DYD_INDETERMINATE || now == DYD_TIE);
    open += s->open[k];
  }
  dyd_delaunay_count(count, pd);
  assert_int_equal(open, count[DYD_INDETERMINATE] + count[DYD_TIE]);
  dyd_delaunay_free(pd);
}

static void put(const dyd_steps *s, const steps_case *c, uint32_t i) {
  dyd_rect r;
  dyd_rect_init(&r);
  assert_int_equal(case_rect(&r, c, i), DYD_OK);
  assert_int_equal(dyd_sites_replace(s->pd->own, i, &r), DYD_OK);
  dyd_rect_clear(&r);
}

static void test_narrow(void **state) {
  (void)state;
  test_random r = test_random_start("steps");
  size_t steps = 0, anew = 0;
  for (size_t k = 0; k < test_cases_all(80); k++) {
    steps_case c = case_make(&r, k);
    dyd_delaunay *pd = case_build(&c);
    dyd_steps s = {0};
    if (dyd_steps_can(pd)) {
      assert_int_equal(dyd_steps_begin(&s, pd, NULL), DYD_OK);
      bool holds = true;
      for (size_t q = 0; q < c.n && holds; q++) {
        uint32_t i = (uint32_t)test_below(&r, c.n);
        c.half[i] = c.half[i] / 2 / (test_chance(&r, 3) ? 8 : 1);
        put(&s, &c, i);
        assert_int_equal(dyd_steps_narrow(&holds, &s, i), DYD_OK);
        if (holds) check_open(&s, &c);
        steps += holds, anew += !holds;
      }
    }
    dyd_steps_clear(&s);
    dyd_delaunay_free(pd);
  }
  print_message("%zu steps, %zu that move a representative\n", steps, anew);
  assert_true(steps > 200);
}

/* ---- wider ---- */

static bool never(void *user, uint32_t i, uint32_t j) {
  (void)user, (void)i, (void)j;
  return false;
}

static void check_part(const dyd_steps *s, const steps_case *c) {
  dyd_delaunay *pd = case_build(c);
  const dyd_skeleton *sk = &s->pd->sk;
  for (size_t k = 0; k < 3 * s->part.count; k++) {
    const dyd_half_edge h = dyd_edge_of(s->part.item[k / 3], k % 3);
    const uint32_t v = dyd_edge_origin(&sk->mesh, h), w = dyd_edge_target(&sk->mesh, h);
    if (!dyd_edge_is_certain(sk, h) || v == sk->mesh.n || w == sk->mesh.n) continue;
    assert_int_equal(dyd_delaunay_status(pd, sk->reps.site[v], sk->reps.site[w]), DYD_LEGAL);
  }
  dyd_delaunay_free(pd);
}

static void test_widen(void **state) {
  (void)state;
  test_random r = test_random_start("steps back");
  size_t sure = 0, open = 0;
  for (size_t k = 0; k < test_cases_all(80); k++) {
    steps_case c = case_make(&r, k);
    for (size_t i = 0; i < c.n; i++) c.half[i] /= 8;
    dyd_delaunay *pd = case_build(&c);
    dyd_steps s = {0};
    uint8_t before[2 * MOST + 2];
    if (dyd_steps_can(pd)) {
      assert_int_equal(dyd_steps_begin(&s, pd, NULL), DYD_OK);
      for (size_t q = 0; q < c.n; q++) {
        const uint32_t i = (uint32_t)test_below(&r, c.n);
        const long old = c.half[i];
        bool holds;
        if (!old) continue; /* fractions of a point stay with it */
        memcpy(before, pd->sk.certain, pd->sk.mesh.count);
        c.half[i] += (long)test_below(&r, q % 2 ? 40 : 4);
        put(&s, &c, i);
        assert_int_equal(dyd_steps_widen(&holds, &s, i, never, NULL), DYD_OK);
        assert_true(holds);
        check_part(&s, &c);
        sure += dyd_steps_part_is_sure(&s), open += !dyd_steps_part_is_sure(&s);
        if (test_chance(&r, 2)) continue;
        c.half[i] = old;
        put(&s, &c, i);
        dyd_steps_back(&s, i);
        assert_memory_equal(before, pd->sk.certain, pd->sk.mesh.count);
      }
    }
    dyd_steps_clear(&s);
    dyd_delaunay_free(pd);
  }
  print_message("%zu sure, %zu not\n", sure, open);
  assert_true(sure > 10 && open > 100);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_narrow), cmocka_unit_test(test_widen)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
