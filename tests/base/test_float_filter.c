/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Floating point that the filters were not proved for is refused before anything is stated. */
#define _GNU_SOURCE /* feenableexcept */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <fenv.h>
#include <string.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "base/float_filter.h"
#include <dyadel/delaunay.h>
#include <dyadel/engine.h>

/* Two different points with subnormal coordinates, and a third. */
static dyd_sites *subnormal_sites(void) {
  const double x[3] = {0x1p-1074, 0x1p-1073, 1}, y[3] = {0, 0, 1};
  dyd_sites *s;
  assert_int_equal(DYD_OK, dyd_sites_new(&s));
  assert_int_equal(DYD_OK, dyd_sites_add_points(s, 3, x, y));
  return s;
}

/* Everything that makes statements refuses, with words about `what`; afterwards the same calls are right. */
static void expect_refusal(const char *what, void (*set)(int on)) {
  dyd_sites *s = subnormal_sites();
  dyd_delaunay *pd = NULL;
  dyd_engine *e = NULL;
  dyd_outcome outcome;
  dyd_error err;
  const double x[3] = {0, 1, 0}, y[3] = {0, 0, 1};
  assert_int_equal(DYD_OK, dyd_engine_new(&e));
  assert_int_equal(DYD_OK, dyd_engine_add_points(e, 3, x, y, NULL));
  set(1);
  dyd_status made = dyd_delaunay_new(&pd, s, NULL, &err);
  char first[DYD_MESSAGE_SIZE];
  memcpy(first, err.message, sizeof first);
  dyd_status ran = dyd_engine_run(&outcome, e, NULL, &err);
  set(0);
  assert_int_equal(DYD_E_ARG, made);
  assert_null(pd);
  assert_non_null(strstr(first, what));
  assert_int_equal(DYD_E_ARG, ran);
  assert_int_equal(DYD_OUTCOME_ERROR, outcome);
  assert_non_null(strstr(err.message, what));
  assert_int_equal(DYD_OK, dyd_delaunay_new(&pd, s, NULL, &err));
  set(1);
  dyd_status updated = dyd_delaunay_update(pd, NULL, 0, NULL, &err);
  set(0);
  assert_int_equal(DYD_E_ARG, updated);
  for (uint32_t i = 0; i < 3; i++) assert_int_equal(i, dyd_delaunay_alias(pd, i));
  assert_int_equal(DYD_OK, dyd_engine_run(&outcome, e, NULL, &err));
  assert_int_equal(DYD_OUTCOME_DECIDED, outcome);
  dyd_engine_free(e);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
}

#if defined(__SSE2__)
static void set_bits(unsigned bits, int on) {
  _mm_setcsr(on ? _mm_getcsr() | bits : _mm_getcsr() & ~bits);
}
static void set_flush(int on) {
  set_bits(0x8000, on);
}
static void set_denormals_are_zero(int on) {
  set_bits(0x0040, on);
}
static void test_flushing(void **state) {
  (void)state;
  expect_refusal("subnormal", set_flush);
  expect_refusal("subnormal", set_denormals_are_zero);
}
#endif

static void set_up(int on) {
  fesetround(on ? FE_UPWARD : FE_TONEAREST);
}
static void set_down(int on) {
  fesetround(on ? FE_DOWNWARD : FE_TONEAREST);
}
static void set_to_zero(int on) {
  fesetround(on ? FE_TOWARDZERO : FE_TONEAREST);
}
static void test_rounding(void **state) {
  (void)state;
  expect_refusal("round to nearest", set_up);
  expect_refusal("round to nearest", set_down);
  expect_refusal("round to nearest", set_to_zero);
}

#if defined(__GLIBC__)
static void set_some_traps(int on) {
  (on ? feenableexcept : fedisableexcept)(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
}
static void set_all_traps(int on) {
  (on ? feenableexcept : fedisableexcept)(FE_ALL_EXCEPT);
}
/* The process would end by SIGFPE in what the filters compute. */
static void test_traps(void **state) {
  (void)state;
  expect_refusal("unmasked traps", set_some_traps);
  expect_refusal("unmasked traps", set_all_traps);
}
#endif

static void test_default(void **state) {
  (void)state;
  assert_int_equal(DYD_OK, dyd_float_check(NULL));
}

int main(void) {
  const struct CMUnitTest tests[] = {
#if defined(__SSE2__)
    cmocka_unit_test(test_flushing),
#endif
#if defined(__GLIBC__)
    cmocka_unit_test(test_traps),
#endif
    cmocka_unit_test(test_rounding),
    cmocka_unit_test(test_default),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
