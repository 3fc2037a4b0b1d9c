/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dyadics as text: without loss, and with the place of what cannot be read. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "dyadic/random_dyadic.h"
#include "dyadic/raw.h"

static void test_round_trip(void **state) {
  (void)state;
  test_random r = test_random_start("dyadic text");
  dyd_dyadic x, y;
  dyd_dyadic_init(&x), dyd_dyadic_init(&y);
  for (size_t n = test_cases(5000); n > 0; n--) {
    random_dyadic(&x, &r);
    char *text = dyd_dyadic_get_str(&x);
    assert_non_null(text);
    assert_int_equal(dyd_dyadic_set_str(&y, text, NULL), DYD_OK);
    assert_int_equal(dyd_dyadic_cmp(&x, &y), 0);
    free(text);
  }
  dyd_dyadic_clear(&y), dyd_dyadic_clear(&x);
}

static void test_accepted(void **state) {
  (void)state;
  static const struct {
    const char *text;
    long man;
    int64_t exp;
  } row[] = {{"0", 0, 0},
             {"-0", 0, 0},
             {"0*2^99", 0, 0},
             {"0e999999999999999999", 0, 0},
             {"17", 17, 0},
             {"+17", 17, 0},
             {"-24", -3, 3},
             {" \t5\n", 5, 0},
             {"5*2^-20", 5, -20},
             {"-6*2^+4", -3, 5},
             {"0.125", 1, -3},
             {"-1.5e0", -3, -1},
             {"25e-2", 1, -2},
             {"1e3", 125, 3},
             {".5", 1, -1},
             {"3.", 3, 0},
             {"0x1.8p-3", 3, -4},
             {"-0X.8P+1", -1, 0},
             {"0xffp0", 255, 0},
             {"0xA", 5, 1},
             {"1*2^-1048576", 1, -1048576}};
  dyd_dyadic x, expected;
  dyd_dyadic_init(&x), dyd_dyadic_init(&expected);
  for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
    dyd_error err;
    assert_int_equal(dyd_dyadic_set_str(&x, row[k].text, &err), DYD_OK);
    assert_int_equal(dyd_dyadic_set_si_2exp(&expected, row[k].man, row[k].exp), DYD_OK);
    assert_true(dyd_dyadic_is_valid(&x));
    assert_int_equal(dyd_dyadic_cmp(&x, &expected), 0);
  }
  dyd_dyadic_clear(&expected), dyd_dyadic_clear(&x);
}

static void test_refused(void **state) {
  (void)state;
  static const struct {
    const char *text;
    dyd_status status;
    size_t column;
  } row[] = {{"", DYD_E_PARSE, 1},
             {"   ", DYD_E_PARSE, 4},
             {"x", DYD_E_PARSE, 1},
             {"-", DYD_E_PARSE, 2},
             {"12a", DYD_E_PARSE, 3},
             {"1 2", DYD_E_PARSE, 3},
             {"1..2", DYD_E_PARSE, 3},
             {"1e", DYD_E_PARSE, 3},
             {"1e+", DYD_E_PARSE, 4},
             {"5*3^2", DYD_E_PARSE, 3},
             {"5*", DYD_E_PARSE, 3},
             {"5*2", DYD_E_PARSE, 4},
             {"5*2^", DYD_E_PARSE, 5},
             {"1.5*2^3", DYD_E_PARSE, 4},
             {"0x", DYD_E_PARSE, 3},
             {"0x1p", DYD_E_PARSE, 5},
             {"--1", DYD_E_PARSE, 2},
             {"nan", DYD_E_PARSE, 1},
             {"inf", DYD_E_PARSE, 1},
             {"0.1", DYD_E_PARSE, 1},
             {"1e-400000000", DYD_E_PARSE, 1},
             {"1e999999999999999999999", DYD_E_RANGE, 1},
             {"1*2^1048576", DYD_E_RANGE, 1},
             {"1*2^-1048577", DYD_E_RANGE, 1},
             {"0x1p99999999999999999999", DYD_E_RANGE, 1}};
  dyd_dyadic x;
  dyd_dyadic_init(&x);
  assert_int_equal(dyd_dyadic_set_si_2exp(&x, 11, 0), DYD_OK);
  for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
    dyd_error err;
    dyd_error_clear(&err);
    assert_int_equal(dyd_dyadic_set_str(&x, row[k].text, &err), row[k].status);
    assert_int_equal(err.code, row[k].status);
    assert_int_equal(err.column, row[k].column);
    assert_int_equal(mpz_get_si(x.man), 11); /* unchanged */
    assert_int_equal(dyd_dyadic_set_str(&x, row[k].text, NULL), row[k].status);
  }
  dyd_dyadic_clear(&x);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_round_trip), cmocka_unit_test(test_accepted),
                                     cmocka_unit_test(test_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
