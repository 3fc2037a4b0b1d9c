/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Coordinates as text: exactness, fixed intervals, columns of errors, hostile and random input. */
#include "harness.h"

typedef struct exact_row {
  const char *text, *value;
} exact_row;

static const exact_row exacts[] = {{"0.1", "1/10"},
                                   {"1/10", "1/10"},
                                   {"22/7", "22/7"},
                                   {"(1+2)/3", "1"},
                                   {"5*2^-20", "5/1048576"},
                                   {"0x1.8p-3", "3/16"},
                                   {"-2^2", "-4"},
                                   {"2^-3", "1/8"},
                                   {"2^3^2", "512"},
                                   {"(-2)^3", "-8"},
                                   {"0^0", "1"},
                                   {"1--2", "3"},
                                   {"--2", "2"},
                                   {"1---2", "-1"},
                                   {"root(x-(1-x)/2,0,1)", "1/3"},
                                   {"1 + -2", "-1"},
                                   {"2*-3", "-6"},
                                   {"1/2/2", "1/4"},
                                   {"1-2-3", "-4"},
                                   {"sqrt(9/4)", "3/2"},
                                   {"sqrt(0)", "0"},
                                   {"sqrt(2-sqrt(4))", "0"},
                                   {"cbrt(-27/8)", "-3/2"},
                                   {"abs(-1/3)", "1/3"},
                                   {"min(1/3,0.3,2)", "3/10"},
                                   {"max(1/3,0.3)", "1/3"},
                                   {"exp(0)+log(1)+cos(0)", "2"},
                                   {"sin(0)+tan(0)+asin(0)+acos(1)+atan(0)+sinh(0)+tanh(0)", "0"},
                                   {"cosh(0)", "1"},
                                   {"[0.1,1/10]", "1/10"},
                                   {"0.1+-0", "1/10"},
                                   {"root(3*x-1,0,1)", "1/3"},
                                   {"1+root(x,-1,1)", "1"},
                                   {"-root(3*x-1,0,1)*2", "-2/3"},
                                   {"sqrt( root(x-4, 0, 9) ) + root(x-1,0,2)^2", "3"},
                                   {"root((x-1/3)^3,0,1)", "1/3"},
                                   {"root(x^2-1/9,1/3,1)", "1/3"},
                                   {"root(x^2-1/9,-1,-1/3)", "-1/3"},
                                   {"1^1000000", "1"},
                                   {"(-1)^-1000001", "-1"}};

/* A coordinate whose form is rational is an exact point from the start. */
static void test_exact(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof exacts / sizeof *exacts; i++) {
    dyd_real *x = parsed(exacts[i].text);
    if (!dyd_real_is_final(x) || !is_exactly(dyd_real_interval(x), exacts[i].value)) fail_msg("%s", exacts[i].text);
    assert_int_equal(dyd_real_narrow(x, 100, 100, NULL), DYD_FIXED);
    dyd_real_free(x);
  }
}

/* Ends of a fixed interval are exact. */
static void check_fixed(const char *text, const char *lo, const char *hi) {
  dyd_real *x = parsed(text);
  mpq_t l, h, a, b;
  mpq_inits(l, h, a, b, NULL);
  mpq_set_str(l, lo, 10);
  mpq_set_str(h, hi, 10);
  assert_true(dyd_real_is_final(x));
  dyd_interval_get_q(a, b, dyd_real_interval(x));
  if (!mpq_equal(a, l) || !mpq_equal(b, h)) fail_msg("%s", text);
  mpq_clears(l, h, a, b, NULL);
  dyd_real_free(x);
}

static void test_fixed(void **state) {
  (void)state;
  check_fixed("[1.2,1.3]", "6/5", "13/10");
  check_fixed(" [ 1/3 , 2^-1 ] ", "1/3", "1/2");
  check_fixed("[-1e9,1e-9]", "-1000000000", "1/1000000000");
  check_fixed("[0,1e-30]", "0", "1/1000000000000000000000000000000");
  check_fixed("1.25+-0.01", "31/25", "63/50");
  check_fixed("1.25\xC2\xB1"
              "0.01",
              "31/25", "63/50");
  check_fixed("1.25 +- 1/100", "31/25", "63/50");
  check_fixed("1+-2", "-1", "3");
  check_fixed("(1+2)/3+-(1-1/2)", "1/2", "3/2");
  check_fixed("root(3*x-1,0,1)+-1", "-2/3", "4/3");
}

typedef struct bad_row {
  const char *text;
  dyd_status status;
  size_t column;
} bad_row;

static const bad_row bads[] = {{"", DYD_E_PARSE, 1},
                               {"   ", DYD_E_PARSE, 4},
                               {"foo(1)", DYD_E_PARSE, 1},
                               {"1+foo", DYD_E_PARSE, 3},
                               {"nan", DYD_E_PARSE, 1},
                               {"inf", DYD_E_PARSE, 1},
                               {"2pi", DYD_E_PARSE, 2},
                               {"2 pi", DYD_E_PARSE, 3},
                               {"pi pi", DYD_E_PARSE, 4},
                               {"(2 pi)", DYD_E_PARSE, 4},
                               {"1.2.3", DYD_E_PARSE, 4},
                               {"1+", DYD_E_PARSE, 3},
                               {"1+*2", DYD_E_PARSE, 3},
                               {"*2", DYD_E_PARSE, 1},
                               {"(1+2", DYD_E_PARSE, 5},
                               {"1+2)", DYD_E_PARSE, 4},
                               {"()", DYD_E_PARSE, 2},
                               {"sqrt", DYD_E_PARSE, 5},
                               {"sqrt 2", DYD_E_PARSE, 6},
                               {"sqrt()", DYD_E_PARSE, 6},
                               {"sqrt(2", DYD_E_PARSE, 7},
                               {"sqrt(2,3)", DYD_E_PARSE, 7},
                               {"min(1)", DYD_E_PARSE, 6},
                               {"min(1,)", DYD_E_PARSE, 7},
                               {"x+1", DYD_E_PARSE, 1},
                               {"2^0.5", DYD_E_PARSE, 2},
                               {"pi^e", DYD_E_PARSE, 3},
                               {"2^(1/2)", DYD_E_PARSE, 2},
                               {"pi^(sqrt(2))", DYD_E_PARSE, 3},
                               {"1+root(root(x,-1,1)+x,-1,1)", DYD_E_PARSE, 8},
                               {"root(x-1,root(x,0,1),2)+1", DYD_E_PARSE, 10},
                               {"root(x-1,0,2)root(x-1,0,2)", DYD_E_PARSE, 14},
                               {"1+root", DYD_E_PARSE, 7},
                               {"1+root(x^2+1,0,1)", DYD_E_PARSE, 14},
                               {"2*root(x^2-2,1,2", DYD_E_PARSE, 17},
                               {"sqrt(-root(x^2-2,1,2))", DYD_E_DOMAIN, 1},
                               {"2*root(x^900-2,0,1e300000)", DYD_E_RANGE, 16},
                               {"(1+-2)", DYD_E_PARSE, 3},
                               {"pi+-pi", DYD_E_PARSE, 5},
                               {"1+--2", DYD_E_PARSE, 4},
                               {"1+-(-2)", DYD_E_PARSE, 4},
                               {"pi+-", DYD_E_PARSE, 5},
                               {"1+-2+-3", DYD_E_PARSE, 5},
                               {"[1,2", DYD_E_PARSE, 5},
                               {"[1 2]", DYD_E_PARSE, 4},
                               {"[1,2]3", DYD_E_PARSE, 6},
                               {"[2,1]", DYD_E_PARSE, 2},
                               {"[pi,4]", DYD_E_PARSE, 2},
                               {"[3, pi]", DYD_E_PARSE, 5},
                               {"[,1]", DYD_E_PARSE, 2},
                               {"[]", DYD_E_PARSE, 2},
                               {"root(x^2-2)", DYD_E_PARSE, 11},
                               {"root(x^2-2,0)", DYD_E_PARSE, 13},
                               {"root(x^2-2,0,2", DYD_E_PARSE, 15},
                               {"root(x^2-2,2,3)", DYD_E_PARSE, 12},
                               {"root(x^2+1, -1, 1)", DYD_E_PARSE, 13},
                               {"root(x^2-2,2,0)", DYD_E_PARSE, 12},
                               {"root(0*x,0,1)", DYD_E_PARSE, 6},
                               {"root(y-1,0,2)", DYD_E_PARSE, 6},
                               {"root(sin(x),3,4)", DYD_E_PARSE, 6},
                               {"root(pi*x-1,0,1)", DYD_E_PARSE, 6},
                               {"root(1/x-1,0,2)", DYD_E_PARSE, 7},
                               {"root(x^-1,0,2)", DYD_E_PARSE, 7},
                               {"root(x-1,0,pi)", DYD_E_PARSE, 12},
                               {"1\xC2\xB1 -1", DYD_E_PARSE, 3},
                               {"1\xC2\xB1\xC2\xB1", DYD_E_PARSE, 3},
                               {"\xCF\x80+1", DYD_E_PARSE, 1},
                               {"1+2#", DYD_E_PARSE, 4},
                               {"1/0", DYD_E_DOMAIN, 3},
                               {"pi/0", DYD_E_DOMAIN, 3},
                               {"1+pi/(2-2)", DYD_E_DOMAIN, 5},
                               {"1/min(0,pi)", DYD_E_DOMAIN, 2},
                               {"0^-1", DYD_E_DOMAIN, 2},
                               {"1+sqrt(-1)", DYD_E_DOMAIN, 3},
                               {"log(0)", DYD_E_DOMAIN, 1},
                               {"log(-2)", DYD_E_DOMAIN, 1},
                               {"asin(1.0001)", DYD_E_DOMAIN, 1},
                               {"acos(-3)", DYD_E_DOMAIN, 1},
                               {"1+sqrt(3-pi)", DYD_E_DOMAIN, 3},
                               {"log(-pi)", DYD_E_DOMAIN, 1},
                               {"2*asin(pi)", DYD_E_DOMAIN, 3},
                               {"1e400000", DYD_E_RANGE, 1},
                               {"1+1e400000", DYD_E_RANGE, 3},
                               {"2^10000000", DYD_E_RANGE, 2},
                               {"(1/3)^1048577", DYD_E_RANGE, 6},
                               {"1e200000*1e200000", DYD_E_RANGE, 9},
                               {"pi^1000000000", DYD_E_RANGE, 3},
                               {"pi^99999999999999999999999", DYD_E_RANGE, 3},
                               {"1+exp(1e30)", DYD_E_RANGE, 3},
                               {"exp(exp(exp(10)))", DYD_E_RANGE, 1},
                               {"pi^1000000", DYD_E_RANGE, 3},
                               {"cosh(-1e9)", DYD_E_RANGE, 1},
                               {"root(x^100000-2,0,2)", DYD_E_RANGE, 7},
                               {"root((x^100+1)^100-2,0,2)", DYD_E_RANGE, 15},
                               {"root((1e300000*x+1)^900-5,0,1)", DYD_E_RANGE, 20},
                               {"root(x^900-2,0,1e300000)", DYD_E_RANGE, 14}};

static void test_bad(void **state) {
  (void)state;
  double start = seconds();
  for (size_t i = 0; i < sizeof bads / sizeof *bads; i++) {
    dyd_error err;
    dyd_real *x = NULL;
    dyd_status st = parse_text(&x, bads[i].text, &err);
    if (st != bads[i].status || err.column != bads[i].column || x) {
      fail_msg("'%s': status %d, column %zu: %s", bads[i].text, st, err.column, err.message);
    }
    assert_int_equal(err.code, st);
    assert_true(strlen(err.message) > 10);
    assert_int_equal(dyd_real_parse(&x, bads[i].text, strlen(bads[i].text), NULL), st);
  }
  assert_true(seconds() - start < 5);
}

/* Text made of `count` copies of a part between a head and a tail must be dealt with quickly, by any status. */
static dyd_status hostile(const char *head, const char *part, size_t count, const char *tail) {
  size_t n = strlen(head), m = strlen(part), k = strlen(tail);
  char *text = malloc(n + m * count + k);
  assert_non_null(text);
  memcpy(text, head, n);
  for (size_t i = 0; i < count; i++) memcpy(text + n + i * m, part, m);
  memcpy(text + n + m * count, tail, k);
  dyd_real *x = NULL;
  dyd_error err;
  dyd_error_clear(&err);
  double start = seconds();
  dyd_status st = dyd_real_parse(&x, text, n + m * count + k, &err);
  if (!st) {
    st = dyd_real_narrow(x, 64, 256, &err);
    dyd_real_free(x);
  }
  free(text);
  double used = seconds() - start;
  if (used > 8) fail_msg("%s%s...%s: %.1f s", head, part, tail, used);
  return st;
}

static void test_hostile(void **state) {
  (void)state;
  assert_int_equal(hostile("", "(", 100000, ""), DYD_E_RANGE);
  assert_int_equal(hostile("", "sqrt(", 100000, "2"), DYD_E_RANGE);
  assert_int_equal(hostile("2", "^2", 100000, ""), DYD_E_RANGE);
  assert_int_equal(hostile("pi", "+pi", 100000, ""), DYD_E_RANGE);
  assert_int_equal(hostile("pi", "+pi", 1000, ""), DYD_OK);
  assert_int_equal(hostile("1", "+1", 100000, ""), DYD_FIXED);
  assert_int_equal(hostile("", "-", 1000000, "1"), DYD_FIXED);
  assert_int_equal(hostile("", "9", 1000000, ""), DYD_E_RANGE);
  assert_int_equal(hostile("0.", "3", 1000000, ""), DYD_E_RANGE);
  assert_int_equal(hostile("1", "*1e20000/3", 3000, ""), DYD_E_RANGE);
  assert_int_equal(hostile("1", "/3^600", 3000, ""), DYD_E_RANGE);
  assert_int_equal(hostile("sqrt(", "sqrt(pi)*", 1000, "1-2)"), DYD_OK);
  assert_int_equal(hostile("log(1", "-exp(-pi)*0.9", 100, "/1e3)"), DYD_E_DOMAIN);
  assert_int_equal(hostile("", "exp(", 150,
                           "1)"
                           ")))))))))))))"),
                   DYD_E_PARSE);
  assert_int_equal(hostile("pi", "*1e300000*1e-300000", 3, ""), DYD_OK);
  assert_int_equal(hostile("pi", "*1e300000*1e-300000", 100, ""), DYD_E_RANGE);
  assert_int_equal(hostile("sin(1e300000", "", 0, ")"), DYD_OK);
  assert_int_equal(hostile("log(exp(-1e30))", "", 0, ""), DYD_E_DOMAIN);
  assert_int_equal(hostile("1/((1/pi)^1000000)", "", 0, ""), DYD_E_RANGE);
  assert_int_equal(hostile("root(x", "*(x+1)", 900, "-3,0,1)"), DYD_OK);
  assert_int_equal(hostile("root((x+1)^999-5,0,1)", "", 0, ""), DYD_OK);
  assert_int_equal(hostile("root(x^2-1e-200000,0,1)", "", 0, ""), DYD_OK);
  assert_int_equal(hostile("0", "+root(x^9-2,0,2)", 64, ""), DYD_OK);
  assert_int_equal(hostile("0", "+root(x^9-2,0,2)", 65, ""), DYD_E_RANGE);
}

/* Undefined up to the budget: the column of the culprit, and the message names the bits. */
static void test_undefined(void **state) {
  (void)state;
  static const bad_row rows[] = {{"sqrt(2-sqrt(2)^2)", DYD_E_DOMAIN, 1}, {"1+sqrt(sqrt(2)^2-2)", DYD_E_DOMAIN, 3},
                                 {"tan(pi/2)", DYD_E_DOMAIN, 1},         {"1/sin(pi)", DYD_E_DOMAIN, 2},
                                 {"2+log(sin(pi))", DYD_E_DOMAIN, 3},    {"asin(sqrt(2)^2/2)", DYD_E_DOMAIN, 1},
                                 {"(sqrt(2)^2-2)^-2", DYD_E_DOMAIN, 14}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    dyd_real *x = parsed(rows[i].text);
    dyd_error err;
    dyd_error_clear(&err);
    assert_null(dyd_real_interval(x));
    dyd_status st = dyd_real_narrow(x, 50, 1000, &err);
    if (st != rows[i].status || err.column != rows[i].column) {
      fail_msg("%s: status %d column %zu", rows[i].text, st, err.column);
    }
    assert_null(dyd_real_interval(x));
    dyd_real_free(x);
  }
}

/* Random strings from the grammar's alphabet: never a crash, and errors always point into the text. */
static void test_random_text(void **state) {
  (void)state;
  static const char *const parts[] = {"1",     "2",    "0.5",   "1e3",  "0x1p2", "pi",       "e", "x",   "(",
                                      ")",     "+",    "-",     "*",    "/",     "^",        ",", "[",   "]",
                                      "sqrt(", "log(", "root(", "min(", "+-",    "\xC2\xB1", " ", "sin("};
  test_random r = test_random_start("random text");
  for (size_t n = test_cases(60000); n > 0; n--) {
    char text[256] = "";
    for (size_t k = test_below(&r, 12); k > 0; k--) strcat(text, parts[test_below(&r, sizeof parts / sizeof *parts)]);
    dyd_real *x = NULL;
    dyd_error err;
    dyd_status st = parse_text(&x, text, &err);
    if (st) {
      assert_null(x);
      assert_true(err.column >= 1 && err.column <= strlen(text) + 1);
      continue;
    }
    dyd_status narrow = dyd_real_narrow(x, 30, 100, &err);
    assert_true(narrow >= 0 || narrow == DYD_E_DOMAIN || narrow == DYD_E_RANGE);
    dyd_real_free(x);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_exact),     cmocka_unit_test(test_fixed),
                                     cmocka_unit_test(test_bad),       cmocka_unit_test(test_hostile),
                                     cmocka_unit_test(test_undefined), cmocka_unit_test(test_random_text)};
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
