/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dyadics as text: without loss, and with the place of what cannot be read. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "dyadic/numeral.h"
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
  } row[] = {{"0", 0, 0},         {"-0", 0, 0},       {"0*2^99", 0, 0},    {"0e999999999999999999", 0, 0},
             {"17", 17, 0},       {"+17", 17, 0},     {"-24", -3, 3},      {" \t5\n", 5, 0},
             {"5*2^-20", 5, -20}, {"1.5*2^3", 3, 2},  {"25e-2*2^4", 1, 2}, {"0x10*2^-4", 1, 0},
             {"-6*2^+4", -3, 5},  {"0.125", 1, -3},   {"-1.5e0", -3, -1},  {"25e-2", 1, -2},
             {"1e3", 125, 3},     {".5", 1, -1},      {"3.", 3, 0},        {"0x1.8p-3", 3, -4},
             {"-0X.8P+1", -1, 0}, {"0xffp0", 255, 0}, {"0xA", 5, 1},       {"1*2^-1048576", 1, -1048576}};
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
             {"   ", DYD_E_PARSE, 1},
             {"x", DYD_E_PARSE, 1},
             {"-", DYD_E_PARSE, 2},
             {"12a", DYD_E_PARSE, 3},
             {"1 2", DYD_E_PARSE, 2},
             {"1..2", DYD_E_PARSE, 3},
             {"1e", DYD_E_PARSE, 2},
             {"1e+", DYD_E_PARSE, 2},
             {"5*3^2", DYD_E_PARSE, 2},
             {"5*", DYD_E_PARSE, 2},
             {"5*2", DYD_E_PARSE, 2},
             {"5*2^", DYD_E_PARSE, 5},
             {"1/2", DYD_E_PARSE, 2},
             {"0x", DYD_E_PARSE, 2},
             {"0x1p", DYD_E_PARSE, 4},
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

/* What each form admits, where reading ends without it, and the digits as one number. */
static void test_forms(void **state) {
  (void)state;
  static const struct {
    const char *text;
    unsigned forms;
    size_t end; /* of the text: all of it is a number */
    uint64_t man;
  } row[] = {{"12", 0, 2, 12},
             {"000000000000000000000012", 0, 24, 12},
             {"-12", 0, 0, 0},
             {"-12", DYD_NUMBER_PLUS, 0, 0},
             {"+12", DYD_NUMBER_MINUS, 0, 0},
             {"+12", DYD_NUMBER_SIGNS, 3, 12},
             {"--1", DYD_NUMBER_ANY, 1, 0},
             {" 12", DYD_NUMBER_INDENT, 3, 12},
             {"12 ", DYD_NUMBER_INDENT, 2, 12},
             {" 12 ", DYD_NUMBER_BLANKS, 3, 12},
             {"1.5", DYD_NUMBER_EXPONENT, 1, 1},
             {"1.5", DYD_NUMBER_POINT, 3, 15},
             {".5", DYD_NUMBER_POINT, 2, 5},
             {".", DYD_NUMBER_ANY, 0, 0},
             {"1e5", DYD_NUMBER_POINT, 1, 1},
             {"1e5", DYD_NUMBER_EXPONENT, 3, 1},
             {"1e+", DYD_NUMBER_EXPONENT, 1, 1},
             {"0x1f", DYD_NUMBER_DECIMAL, 1, 0},
             {"0x1f", DYD_NUMBER_HEX, 4, 31},
             {"0xg", DYD_NUMBER_HEX, 1, 0},
             {"0x1.8p-3", DYD_NUMBER_LITERAL, 8, 24},
             {"0x1e5", DYD_NUMBER_LITERAL, 5, 0x1e5},
             {"0xfffffffffffffff", DYD_NUMBER_HEX, 17, UINT64_C(0xfffffffffffffff)},
             {"22/7", DYD_NUMBER_DECIMAL, 2, 22},
             {"22/7", DYD_NUMBER_QUOTIENT, 4, 22},
             {"22/-7", DYD_NUMBER_ANY, 3, 22},
             {"2.5/7", DYD_NUMBER_ANY, 3, 25},
             {"5*2^-3", DYD_NUMBER_QUOTIENT, 1, 5},
             {"5*2^-3", DYD_NUMBER_TWOS, 6, 5},
             {"5*2^x", DYD_NUMBER_TWOS, 4, 5},
             {"5*3^2", DYD_NUMBER_TWOS, 1, 5},
             {"999999999999999999", 0, 18, UINT64_C(999999999999999999)},
             {"1,5", DYD_NUMBER_ANY, 1, 1},
             {"1_000", DYD_NUMBER_ANY, 1, 1}};
  for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
    dyd_numeral n;
    const size_t length = strlen(row[k].text), blanks = row[k].forms == DYD_NUMBER_BLANKS;
    const bool whole = dyd_numeral_scan(&n, row[k].text, length, row[k].forms);
    if (whole != (row[k].end + blanks == length) || n.end != row[k].end || n.man != row[k].man || !n.few)
      fail_msg("%s: %d, %zu", row[k].text, whole, n.end);
  }
}

static void test_integers(void **state) {
  (void)state;
  int64_t x;
  assert_true(dyd_integer_scan(&x, "-00000000000000000000000000007", 30, DYD_NUMBER_SIGNS, -7, 7) && x == -7);
  assert_true(dyd_integer_scan(&x, "999999999999999999", 18, 0, 0, INT64_MAX) && x == 999999999999999999);
  assert_false(dyd_integer_scan(&x, "1000000000000000000", 19, 0, 0, INT64_MAX));
  assert_false(dyd_integer_scan(&x, "8", 1, 0, -7, 7));
  assert_false(dyd_integer_scan(&x, "-8", 2, DYD_NUMBER_SIGNS, -7, 7));
  assert_false(dyd_integer_scan(&x, "1.", 2, DYD_NUMBER_SIGNS, -7, 7));
  assert_false(dyd_integer_scan(&x, "5\0006", 3, 0, 0, 99));
  assert_false(dyd_integer_scan(&x, NULL, 0, DYD_NUMBER_ANY, 0, 99));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_round_trip), cmocka_unit_test(test_accepted),
                                     cmocka_unit_test(test_refused), cmocka_unit_test(test_forms),
                                     cmocka_unit_test(test_integers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
