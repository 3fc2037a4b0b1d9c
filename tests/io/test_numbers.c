/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The quick decimals of the reader and the directed decimals of the writers, against exact rationals. */
#include "io/decimal.h"
#include "io/plain.h"
#include "stream/number.h"
#include "support/random.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* A decimal of random size; often with few digits, factors of 5, an exponent, odd forms. */
static void random_decimal(char out[64], test_random *r) {
  char *p = out;
  if (test_chance(r, 3)) *p++ = test_chance(r, 4) ? '+' : '-';
  unsigned whole = (unsigned)test_below(r, test_chance(r, 4) ? 20 : 5), part = (unsigned)test_below(r, 12);
  if (whole + part == 0) whole = 1;
  for (unsigned k = 0; k < whole; k++) *p++ = (char)('0' + (test_chance(r, 3) ? 5 : test_below(r, 10)));
  if (part || test_chance(r, 4)) *p++ = '.';
  for (unsigned k = 0; k < part; k++)
    *p++ = (char)('0' + (test_chance(r, 2) ? 5 * test_below(r, 2) : test_below(r, 10)));
  *p = 0;
  if (test_chance(r, 4)) sprintf(p, "%c%d", test_chance(r, 2) ? 'e' : 'E', (int)test_between(r, -30, 30));
}

static void check_plain(const char *text, mpq_t exact, mpq_t other) {
  dyd_plain p;
  if (!dyd_plain_scan(&p, text, strlen(text))) return;
  dyd_plain_get_q(other, p);
  assert_true(mpq_equal(exact, other));
  double value;
  if (dyd_plain_get_exact(&value, p)) {
    mpq_set_d(other, value);
    assert_true(mpq_equal(exact, other));
  } else if (p.man < INT64_C(1) << 50 && p.man > -(INT64_C(1) << 50) && p.exp <= 0) {
    mpq_set_d(other, mpq_get_d(exact));
    assert_false(mpq_equal(exact, other));
  }
  for (int dir = -1; dir <= 1; dir += 2) {
    if (!dyd_plain_get_rounded(&value, p, (dyd_round)dir)) continue;
    mpq_set_d(other, value);
    assert_true(mpq_cmp(other, exact) * dir >= 0);
    mpq_set_d(other, nextafter(value, -INFINITY * dir));
    assert_true(mpq_cmp(other, exact) * dir < 0);
  }
}

static void test_plain(void **state) {
  (void)state;
  test_random r = test_random_start("plain");
  mpq_t exact, other;
  mpq_inits(exact, other, NULL);
  size_t quick = 0, cases = test_cases(100000);
  for (size_t k = 0; k < cases; k++) {
    char text[64];
    dyd_plain p;
    random_decimal(text, &r);
    assert_int_equal(dyd_parse_number(exact, text, strlen(text), NULL), DYD_OK);
    quick += dyd_plain_scan(&p, text, strlen(text));
    check_plain(text, exact, other);
  }
  assert_true(quick > cases / 2);
  mpq_clears(exact, other, NULL);
}

static void test_plain_refuses(void **state) {
  (void)state;
  static const char *const bad[] = {"",
                                    ".",
                                    "-",
                                    "e5",
                                    "1e",
                                    "1e+",
                                    "1 ",
                                    " 1",
                                    "1.2.3",
                                    "1/3",
                                    "0x10",
                                    "inf",
                                    "1e5000",
                                    "1e+-05",
                                    "--1",
                                    "1,5",
                                    "1e5.",
                                    "5*2^3",
                                    "1234567890123456789"};
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    dyd_plain p;
    assert_false(dyd_plain_scan(&p, bad[k], strlen(bad[k])));
  }
}

static double random_double(test_random *r) {
  double sign = test_chance(r, 2) ? -1 : 1;
  switch (test_below(r, 4)) {
  case 0:
    return sign * test_unit(r);
  case 1:
    return sign * (double)test_below(r, 100000) / 1000;
  case 2:
    return sign * ldexp(test_unit(r), (int)test_between(r, -1074, 1023));
  default:
    return sign * ldexp(1, (int)test_between(r, -1074, 1023));
  }
}

/* Any decimal as a rational; scientific form included. */
static void read_decimal(mpq_t out, const char *text) {
  assert_int_equal(dyd_parse_number(out, text, strlen(text), NULL), DYD_OK);
}

static void test_directed(void **state) {
  (void)state;
  test_random r = test_random_start("directed");
  mpq_t value, printed;
  mpq_inits(value, printed, NULL);
  for (size_t k = 0; k < test_cases(20000); k++) {
    double x = random_double(&r);
    int digits = (int)test_between(&r, 2, 17), dir = test_chance(&r, 2) ? 1 : -1;
    char text[DYD_DECIMAL_SIZE];
    dyd_decimal_directed(text, x, digits, (dyd_round)dir);
    mpq_set_d(value, x);
    read_decimal(printed, text);
    assert_true(mpq_cmp(printed, value) * dir >= 0);
    assert_true((strtod(text, NULL) - x) * dir >= 0);
    mpq_sub(printed, printed, value);
    assert_true(fabs(mpq_get_d(printed)) <= fabs(x) * pow(10, 1.001 - digits));
  }
  mpq_clears(value, printed, NULL);
}

static void test_within(void **state) {
  (void)state;
  test_random r = test_random_start("within");
  mpq_t end, place, bound;
  mpq_inits(end, place, bound, NULL);
  for (size_t k = 0; k < test_cases(20000); k++) {
    double box[2], error;
    box[0] = random_double(&r);
    box[1] = test_chance(&r, 2) ? box[0] : test_chance(&r, 2) ? nextafter(box[0], INFINITY) : random_double(&r);
    if (box[1] < box[0]) box[1] = box[0];
    char text[DYD_DECIMAL_SIZE];
    dyd_decimal_within(text, &error, box[0], box[1]);
    read_decimal(place, text);
    if (!isfinite(error)) continue;
    mpq_set_d(bound, error);
    for (int e = 0; e < 2; e++) {
      mpq_set_d(end, box[e]);
      mpq_sub(end, end, place);
      mpq_abs(end, end);
      assert_true(mpq_cmp(end, bound) <= 0);
    }
    assert_true(error <= (box[1] - box[0]) + fmax(fabs(box[0]), fabs(box[1])) * 0x1p-50 + 0x1p-1070);
  }
  mpq_clears(end, place, bound, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_plain), cmocka_unit_test(test_plain_refuses),
                                     cmocka_unit_test(test_directed), cmocka_unit_test(test_within)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
