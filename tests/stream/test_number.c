/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Plain numbers against literal rational arithmetic: values, half units, columns, refusals, speed. */
#include "harness.h"

#include "stream/number.h"

typedef struct value_row {
  const char *text, *value, *lo, *hi;
} value_row;

static const value_row values[] = {
    {"0", "0", "-1/2", "1/2"},
    {"-0", "0", "-1/2", "1/2"},
    {"12", "12", "23/2", "25/2"},
    {"47.61", "4761/100", "9521/200", "9523/200"},
    {"-47.61", "-4761/100", "-9523/200", "-9521/200"},
    {"1.2e3", "1200", "1150", "1250"},
    {"1.2E+3", "1200", "1150", "1250"},
    {"1e-3", "1/1000", "1/2000", "3/2000"},
    {"+7.", "7", "13/2", "15/2"},
    {".5", "1/2", "9/20", "11/20"},
    {"0.10", "1/10", "19/200", "21/200"},
    {"000123", "123", "245/2", "247/2"},
    {"  8 ", "8", "15/2", "17/2"},
    {"123456789012345678901234567890", "123456789012345678901234567890", "246913578024691357802469135779/2",
     "246913578024691357802469135781/2"},
    {"0.000000000000000000001", "1/1000000000000000000000", "1/2000000000000000000000", "3/2000000000000000000000"},
    {"0e999999999999999999", "0", NULL, NULL},
    {"22/7", "22/7", "22/7", "22/7"},
    {"-6/4", "-3/2", "-3/2", "-3/2"},
    {"0x1.8p-3", "3/16", "3/16", "3/16"},
    {"-0X.8P1", "-1", "-1", "-1"},
    {"0xFf", "255", "255", "255"},
    {"5*2^-20", "5/1048576", "5/1048576", "5/1048576"},
    {"-3*2^+2", "-12", "-12", "-12"},
    {"1.5*2^3", "12", "12", "12"},
    {"0x10*2^-4", "1", "1", "1"},
};

static void assert_rational(mpq_srcptr q, const char *text, const char *of) {
  mpq_t want;
  mpq_init(want);
  mpq_set_str(want, text, 10);
  mpq_canonicalize(want);
  if (!mpq_equal(q, want)) fail_msg("%s: not %s", of, text);
  mpq_clear(want);
}

static void test_values(void **state) {
  (void)state;
  mpq_t q, lo, hi;
  mpq_inits(q, lo, hi, NULL);
  for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
    const value_row *v = &values[i];
    size_t n = strlen(v->text);
    assert_true(dyd_is_plain_number(v->text, n));
    assert_int_equal(dyd_parse_number(q, v->text, n, DYD_NUMBER_ANY, NULL), DYD_OK);
    assert_rational(q, v->value, v->text);
    if (!v->lo) continue;
    assert_int_equal(dyd_parse_measured(lo, hi, v->text, n, NULL), DYD_OK);
    assert_rational(lo, v->lo, v->text);
    assert_rational(hi, v->hi, v->text);
  }
  mpq_clears(q, lo, hi, NULL);
}

typedef struct bad_row {
  const char *text;
  dyd_status status;
  size_t column;
} bad_row;

static const bad_row bads[] = {{"", DYD_E_PARSE, 1},
                               {"  ", DYD_E_PARSE, 1},
                               {"-", DYD_E_PARSE, 2},
                               {"x", DYD_E_PARSE, 1},
                               {"1.2.3", DYD_E_PARSE, 4},
                               {"12a", DYD_E_PARSE, 3},
                               {"1e", DYD_E_PARSE, 2},
                               {"1e+", DYD_E_PARSE, 2},
                               {"--1", DYD_E_PARSE, 2},
                               {"1/", DYD_E_PARSE, 3},
                               {"1/2/3", DYD_E_PARSE, 4},
                               {"1.5/2", DYD_E_PARSE, 4},
                               {"1/-2", DYD_E_PARSE, 3},
                               {"1/2.5", DYD_E_PARSE, 3},
                               {"3*2^", DYD_E_PARSE, 5},
                               {"3*3^2", DYD_E_PARSE, 2},
                               {"0x", DYD_E_PARSE, 2},
                               {"0x1.8p", DYD_E_PARSE, 6},
                               {".", DYD_E_PARSE, 1},
                               {"1 2", DYD_E_PARSE, 2},
                               {"nan", DYD_E_PARSE, 1},
                               {"inf", DYD_E_PARSE, 1},
                               {"1,5", DYD_E_PARSE, 2},
                               {"1/0", DYD_E_DOMAIN, 3},
                               {"1e400000", DYD_E_RANGE, 1},
                               {"1e-400000", DYD_E_RANGE, 1},
                               {"1e99999999999999999999", DYD_E_RANGE, 1},
                               {"0x1p9999999", DYD_E_RANGE, 3},
                               {"1*2^-99999999", DYD_E_RANGE, 1}};

static void test_bad(void **state) {
  (void)state;
  mpq_t q, kept;
  mpq_inits(q, kept, NULL);
  mpq_set_si(kept, -7, 3);
  for (size_t i = 0; i < sizeof bads / sizeof *bads; i++) {
    const char *text = bads[i].text;
    dyd_error err;
    dyd_error_clear(&err);
    mpq_set(q, kept);
    dyd_status st = dyd_parse_number(q, text, strlen(text), DYD_NUMBER_ANY, &err);
    if (st != bads[i].status || err.column != bads[i].column) {
      fail_msg("'%s': status %d column %zu (%s)", text, st, err.column, err.message);
    }
    assert_int_equal(err.code, st);
    assert_true(strlen(err.message) > 10);
    assert_true(mpq_equal(q, kept));
    assert_int_equal(dyd_is_plain_number(text, strlen(text)), st != DYD_E_PARSE);
  }
  mpq_clears(q, kept, NULL);
}

/* A random decimal with its literal value: digits as an integer times ten to a power, by GMP alone. */
static void random_decimal(char *text, mpq_t value, mpq_t unit, test_random *r) {
  size_t digits = (size_t)test_between(r, 1, test_chance(r, 4) ? 40 : 19), n = 0;
  size_t point = test_below(r, digits + 1);
  char all[64];
  bool negative = test_chance(r, 2);
  if (negative) text[n++] = '-';
  for (size_t i = 0; i < digits; i++) {
    if (i == point) text[n++] = '.';
    all[i] = (char)('0' + (test_chance(r, 3) ? 0 : test_below(r, 10)));
    text[n++] = all[i];
  }
  all[digits] = 0;
  long ten = point < digits ? -(long)(digits - point) : 0;
  text[n] = 0;
  if (test_chance(r, 2)) {
    long e = (long)test_between(r, -30, 30);
    ten += e;
    sprintf(text + n, "e%ld", e);
  }
  mpq_set_str(value, all, 10);
  mpz_ui_pow_ui(mpq_numref(unit), 10, (unsigned long)(ten < 0 ? -ten : ten));
  mpz_set_ui(mpq_denref(unit), 1);
  if (ten < 0) mpq_inv(unit, unit);
  mpq_mul(value, value, unit);
  if (negative) mpq_neg(value, value);
}

static void test_random_decimals(void **state) {
  (void)state;
  test_random r = test_random_start("decimals");
  mpq_t want, unit, q, lo, hi;
  mpq_inits(want, unit, q, lo, hi, NULL);
  for (size_t n = test_cases(100000); n > 0; n--) {
    char text[128];
    random_decimal(text, want, unit, &r);
    assert_int_equal(dyd_parse_number(q, text, strlen(text), DYD_NUMBER_ANY, NULL), DYD_OK);
    if (!mpq_equal(q, want)) fail_msg("%s", text);
    mpq_canonicalize(want);
    assert_true(mpz_cmp(mpq_denref(q), mpq_denref(want)) == 0);
    assert_int_equal(dyd_parse_measured(lo, hi, text, strlen(text), NULL), DYD_OK);
    mpq_div_2exp(unit, unit, 1);
    mpq_add(q, want, unit);
    if (!mpq_equal(q, hi)) fail_msg("%s: upper", text);
    mpq_sub(q, want, unit);
    if (!mpq_equal(q, lo)) fail_msg("%s: lower", text);
  }
  mpq_clears(want, unit, q, lo, hi, NULL);
}

static void test_speed(void **state) {
  (void)state;
  const size_t count = 1000000;
  static const char *const texts[4] = {"-71.0589", "42.3601", "3.14159265358979", "1e-3"};
  mpq_t q;
  mpq_init(q);
  double start = seconds();
  for (size_t i = 0; i < count; i++)
    assert_true(!dyd_parse_number(q, texts[i & 3], strlen(texts[i & 3]), DYD_NUMBER_ANY, NULL));
  double used = seconds() - start;
  fprintf(stderr, "# one plain decimal: %.0f ns\n", used / (double)count * 1e9);
  assert_true(used < 10);
  mpq_clear(q);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_values), cmocka_unit_test(test_bad),
                                     cmocka_unit_test(test_random_decimals), cmocka_unit_test(test_speed)};
  return cmocka_run_group_tests(tests, NULL, release_caches);
}
