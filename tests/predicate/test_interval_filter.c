/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The interval arithmetic under the filters: every operation on members lies in the result, from subnormal to
 * overflowing numbers, infinite ends included; and results are not wider than need be. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <mpfr.h>
#include <string.h>

#include "predicate/interval_filter.h"
#include "support/random.h"

enum { PRECISION = 5000 }; /* sums and products of doubles are exact */

static double random_double(test_random *r) {
  static const double special[] = {0, 1, -1, 0x1p-1074, -0x1p-1074, 0x1p-1022, 0x1.fffffffffffffp1023, -0x1p1023, 3};
  if (test_chance(r, 3)) return special[test_below(r, sizeof special / sizeof *special)];
  if (test_chance(r, 2)) return ldexp(test_unit(r) - 0.5, (int)test_between(r, -5, 5));
  uint64_t word = test_u64(r);
  double d;
  memcpy(&d, &word, sizeof d);
  return isfinite(d) ? d : 0;
}

/* An interval around x, thin or wide, perhaps unbounded. */
static dyd_iv random_around(test_random *r, double x) {
  dyd_iv a = {x, x};
  if (test_chance(r, 2)) return a;
  double y = random_double(r);
  if (y < x) a.lo = y;
  if (y > x) a.hi = y;
  if (test_chance(r, 6)) a.lo = -HUGE_VAL;
  if (test_chance(r, 6)) a.hi = HUGE_VAL;
  return a;
}

/* Every end that is a number bounds v. */
static void check_contains(dyd_iv a, mpfr_t v) {
  assert_false(mpfr_cmp_d(v, a.lo) < 0);
  assert_false(mpfr_cmp_d(v, a.hi) > 0);
}

/* The same for a quotient or root rounded both ways. */
static void check_contains2(dyd_iv a, mpfr_t down, mpfr_t up) {
  assert_false(mpfr_cmp_d(up, a.lo) < 0);
  assert_false(mpfr_cmp_d(down, a.hi) > 0);
}

static void check_operations(dyd_iv a, dyd_iv b, double x, double y) {
  mpfr_t p, q, v, w;
  mpfr_inits2(PRECISION, p, q, v, w, (mpfr_ptr)0);
  mpfr_set_d(p, x, MPFR_RNDN);
  mpfr_set_d(q, y, MPFR_RNDN);
  mpfr_add(v, p, q, MPFR_RNDN);
  check_contains(dyd_iv_add(a, b), v);
  mpfr_sub(v, p, q, MPFR_RNDN);
  check_contains(dyd_iv_sub(a, b), v);
  mpfr_mul(v, p, q, MPFR_RNDN);
  check_contains(dyd_iv_mul(a, b), v);
  mpfr_mul(v, p, p, MPFR_RNDN);
  check_contains(dyd_iv_sqr(a), v);
  mpfr_neg(v, p, MPFR_RNDN);
  check_contains(dyd_iv_neg(a), v);
  mpfr_mul_d(v, p, 0.5, MPFR_RNDN);
  check_contains(dyd_iv_scale(a, 0.5), v);
  if (y != 0) {
    mpfr_div(v, p, q, MPFR_RNDD);
    mpfr_div(w, p, q, MPFR_RNDU);
    check_contains2(dyd_iv_div(a, b), v, w);
  }
  if (x >= 0) {
    mpfr_sqrt(v, p, MPFR_RNDD);
    mpfr_sqrt(w, p, MPFR_RNDU);
    check_contains2(dyd_iv_sqrt(a), v, w);
  }
  mpfr_clears(p, q, v, w, (mpfr_ptr)0);
}

static void test_contains(void **state) {
  (void)state;
  test_random r = test_random_start("interval arithmetic");
  for (size_t n = test_cases(60000); n > 0; n--) {
    double x = random_double(&r), y = random_double(&r);
    dyd_iv a = random_around(&r, x), b = random_around(&r, y);
    check_operations(a, b, x, y);
    if (isfinite(a.lo) && isfinite(b.hi)) check_operations(a, b, a.lo, b.hi);
  }
}

/* Of ordinary points the result is at most four units in the last place wide. */
static void test_tight(void **state) {
  (void)state;
  test_random r = test_random_start("tight intervals");
  for (size_t n = test_cases(20000); n > 0; n--) {
    dyd_iv a = dyd_iv_point(1 + test_unit(&r)), b = dyd_iv_point(3 + test_unit(&r));
    dyd_iv all[] = {dyd_iv_add(a, b), dyd_iv_sub(a, b), dyd_iv_mul(a, b),
                    dyd_iv_div(a, b), dyd_iv_sqrt(a),   dyd_iv_sqr(a)};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
      assert_true(all[k].hi - all[k].lo <= 0x1p-50 * fabs(all[k].lo));
  }
}

static void test_unknown(void **state) {
  (void)state;
  dyd_iv none = DYD_IV_UNKNOWN, zero = {-1, 1}, one = {1, 1}, ray = {1, HUGE_VAL};
  assert_int_equal(dyd_iv_sign(none), 0);
  assert_int_equal(dyd_iv_sign(dyd_iv_div(one, zero)), 0);
  assert_int_equal(dyd_iv_sign(dyd_iv_mul(none, one)), 0);
  assert_int_equal(dyd_iv_sign(dyd_iv_sub(ray, ray)), 0);
  assert_int_equal(dyd_iv_sign(dyd_iv_sqrt((dyd_iv){-2, -1})), 0);
  assert_int_equal(dyd_iv_sign(ray), 1);
  assert_int_equal(dyd_iv_sign(dyd_iv_neg(ray)), -1);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_contains), cmocka_unit_test(test_tight),
                                     cmocka_unit_test(test_unknown)};
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  mpfr_free_cache();
  return failed;
}
