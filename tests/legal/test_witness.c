/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The verdicts of the search for witnesses, in doubles and in integers, for all pairs of small sets of boxes: "none" in
 * doubles is "none" in integers [WIT-FLT], doubles find nearly all pairs without a witness, and a rectangle that meets
 * an end excludes all witnesses. */
#include <setjmp.h>
#include <stdarg.h>

#include "dyadic/raw.h"
#include "legal/witness.h"
#include "legal/witness_filter.h"
#include "support/random.h"

#include <cmocka.h>
#include <math.h>

enum { MOST = 9 };

/* Pairs with a witness; of those without one, pairs whose ends are met, and pairs apart for which doubles say so or
 * not. */
typedef struct verdicts {
  size_t some, met, told, untold;
} verdicts;

/* x += k 2^e */
static void add_bits(dyd_dyadic *x, int64_t k, int e) {
  dyd_dyadic more;
  dyd_dyadic_init(&more);
  assert_int_equal(dyd_dyadic_set_d(&more, ldexp((double)k, e)), DYD_OK);
  assert_int_equal(dyd_dyadic_add(x, x, &more), DYD_OK);
  dyd_dyadic_clear(&more);
}

/* out = x + k 2^e */
static void set_end(dyd_dyadic *out, int64_t x, int64_t k, int e) {
  assert_int_equal(dyd_dyadic_set_d(out, (double)x), DYD_OK);
  add_bits(out, k, e);
}

/* Whole numbers up to 16 and sides up to 4: many touch, are on one circle, or leave next to no room. In some sets some
 * ends are off by a few 2^e, which doubles may not hold. */
static dyd_sites *make_boxes(test_random *r, size_t n) {
  dyd_sites *s = NULL;
  dyd_rect box;
  int most = (int)test_between(r, 3, 16), e = -(int)test_between(r, 4, 80);
  bool off = test_chance(r, 2);
  assert_int_equal(dyd_sites_new(&s), DYD_OK);
  dyd_rect_init(&box);
  for (size_t k = 0; k < n; k++) {
    for (int a = 0; a < 2; a++) {
      dyd_interval *side = a ? &box.y : &box.x;
      int64_t at = test_between(r, 0, most), more = off && test_chance(r, 2) ? test_between(r, -3, 3) : 0;
      set_end(&side->lo, at, more, e);
      set_end(&side->hi, at + (test_chance(r, 2) ? 0 : test_between(r, 0, 4)), more, e);
    }
    assert_int_equal(dyd_sites_add_rect(s, &box), DYD_OK);
  }
  dyd_rect_clear(&box);
  return s;
}

/* Returns true if another rectangle meets that of i or j. Exact. */
static bool end_is_met(const dyd_skeleton *sk, uint32_t i, uint32_t j) {
  dyd_rect own, other;
  bool met = false;
  dyd_rect_init(&own);
  dyd_rect_init(&other);
  for (int q = 0; q < 2; q++) {
    dyd_rects_get(&own, &sk->rects, q ? j : i);
    for (uint32_t k = 0; k < sk->n && !met; k++) {
      if (k == i || k == j) continue;
      dyd_rects_get(&other, &sk->rects, k);
      met = dyd_rect_meets(&own, &other);
    }
  }
  dyd_rect_clear(&other);
  dyd_rect_clear(&own);
  return met;
}

static dyd_xy make_guess(test_random *r, const dyd_bbox *a, const dyd_bbox *b) {
  double spread = test_chance(r, 4) ? 64 : 2;
  return (dyd_xy){(a->e[0] + b->e[1]) / 2 + spread * (test_unit(r) - 0.5),
                  (a->e[2] + b->e[3]) / 2 + spread * (test_unit(r) - 0.5)};
}

static void look_at_pair(verdicts *v, dyd_work *w, dyd_skeleton *sk, test_random *r, uint32_t i, uint32_t j) {
  dyd_xy guess = make_guess(r, &sk->rects.box[i], &sk->rects.box[j]), at = guess;
  dyd_truth exact = DYD_UNKNOWN, quick = dyd_filter_witness(&at, w->rects, sk, i, j);
  bool found = true, met = end_is_met(sk, i, j);
  dyd_point c;
  dyd_point_init(&c);
  sk->mesh.no_filter = true;
  assert_int_equal(dyd_witness_decide(&exact, &c, w, sk, i, j, guess, NULL), DYD_OK);
  if (exact == DYD_TRUE) assert_true(dyd_witness_check(w, sk, i, j, &c));
  sk->mesh.no_filter = false;
  if (quick != DYD_UNKNOWN) assert_int_equal(quick, exact); /* [WIT-FLT] */
  if (met) assert_int_equal(exact, DYD_FALSE);
  assert_int_equal(dyd_witness_search(&found, NULL, w, sk, i, j, guess, NULL), DYD_OK);
  assert_int_equal(found, exact == DYD_TRUE);
  *(exact == DYD_TRUE ? &v->some : met ? &v->met : quick == DYD_FALSE ? &v->told : &v->untold) += 1;
  dyd_point_clear(&c);
}

static void test_verdicts(void **state) {
  verdicts v = {0};
  (void)state;
  test_random r = test_random_start("verdicts on witnesses");
  for (size_t k = test_cases(3000); k; k--) {
    dyd_sites *s = make_boxes(&r, (size_t)test_between(&r, 4, MOST));
    const dyd_skeleton_options o = {.threads = 1};
    dyd_skeleton sk;
    dyd_work w;
    assert_int_equal(dyd_skeleton_build(&sk, s, &o), DYD_OK);
    dyd_work_init(&w, &sk, NULL);
    bool good = !sk.all_points && !sk.mesh.collinear;
    for (uint32_t i = 0; i < sk.n; i++) good = good && sk.leaving[i] != DYD_NONE; /* no aliases */
    for (uint32_t j = 0; j < sk.n && good; j++)
      for (uint32_t i = 0; i < j; i++) look_at_pair(&v, &w, &sk, &r, i, j);
    dyd_work_clear(&w);
    dyd_skeleton_clear(&sk);
    dyd_sites_free(s);
  }
  print_message("%zu with a witness, %zu met, %zu none in doubles, %zu not\n", v.some, v.met, v.told, v.untold);
  assert_true(v.some > 1000 && v.met > 1000 && v.told > 1000 &&
              v.untold < v.told / 6); /* antiparallel half-planes are left to integers */
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_verdicts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
