/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The reader against the parser of single coordinates: random files in both layouts, in order, over many blocks. */
#include "rect/rect.h"
#include "stream/number.h"
#include "support/random.h"

#include <dyadel/engine.h>
#include <dyadel/io.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

typedef struct text {
  char *data;
  size_t used, cap;
} text;

static void add(text *t, const char *piece) {
  size_t n = strlen(piece);
  if (t->used + n + 1 > t->cap) t->data = realloc(t->data, t->cap = 2 * (t->used + n + 64));
  assert_non_null(t->data);
  memcpy(t->data + t->used, piece, n + 1);
  t->used += n;
}

static dyd_status read_text(dyd_engine **e, const char *data, size_t length, const dyd_read_options *o,
                            dyd_error *err) {
  assert_int_equal(dyd_engine_new(e), DYD_OK);
  FILE *in = length ? fmemopen((void *)(uintptr_t)data, length, "r") : tmpfile();
  assert_non_null(in);
  dyd_status status = dyd_read_points(*e, in, o, err);
  fclose(in);
  return status;
}

/* A fixed coordinate of some form. */
static void random_coordinate(char out[80], test_random *r) {
  long a = (long)test_between(r, -99999, 99999), b = (long)test_below(r, 1000);
  switch (test_below(r, 13)) {
  case 0:
    sprintf(out, "%ld/%ld", a, b + 1);
    break;
  case 7:
    sprintf(out, "%a", ldexp((double)a + (double)b / 1000, (int)test_between(r, -30, 30)));
    break;
  case 8:
    sprintf(out, "%.17g", (double)a * test_unit(r));
    break;
  case 9:
    sprintf(out, "000.0%03ld%013lld", b, (long long)test_below(r, 10000000000000));
    break;
  case 10:
    sprintf(out, "%ld.%03lde%d", a, b, (int)test_between(r, -50, 50));
    break;
  case 1:
    sprintf(out, "%ld*2^%ld", a, b - 500);
    break;
  case 2:
    sprintf(out, "[%ld,%ld.5]", a, a + 200);
    break;
  case 3:
    sprintf(out, "%ld.25+-0.%03ld", a, b);
    break;
  case 4:
    sprintf(out, "%ld.%ld\xC2\xB1%ld/7", a, b, b);
    break;
  case 5:
    sprintf(out, "%ld%018ld", a, b);
    break;
  case 6:
    sprintf(out, "%ld", a);
    break;
  default:
    sprintf(out, "%ld.%ld", a, b);
    break;
  }
}

static void check_interval(const dyd_interval *got, const char *coordinate) {
  dyd_real *real = NULL;
  assert_int_equal(dyd_real_parse(&real, coordinate, strlen(coordinate), NULL), DYD_OK);
  const dyd_interval *want = dyd_real_interval(real);
  assert_non_null(want);
  assert_true(dyd_interval_contains(got, want) && dyd_interval_contains(want, got));
  dyd_real_free(real);
}

static void check_sites(const dyd_engine *e, char (*coordinate)[80], size_t n) {
  assert_int_equal(dyd_engine_count(e), n);
  dyd_rect rect;
  dyd_rect_init(&rect);
  for (size_t i = 0; i < n; i++) {
    assert_int_equal(dyd_sites_get(&rect, dyd_engine_sites(e), i), DYD_OK);
    check_interval(&rect.x, coordinate[2 * i]);
    check_interval(&rect.y, coordinate[2 * i + 1]);
  }
  dyd_rect_clear(&rect);
}

static void add_csv_line(text *t, const char *x, const char *y, test_random *r) {
  char line[300];
  static const char *const other[] = {"", "plain", "\"quoted, \"\"twice\"\"\"", "\"two\nlines\"", "\xC3\xA9"};
  sprintf(line, "%s,\"%s\",%s,\"%s\"%s", other[test_below(r, 5)], y, other[test_below(r, 5)], x,
          test_chance(r, 2) ? "\r\n" : "\n");
  add(t, line);
}

static void add_points_line(text *t, const char *x, const char *y, test_random *r) {
  static const char *const gap[] = {" ", ",", "\t", " , ", ",   "}, *const end[] = {"\n", "\r\n", " # note\n", "\n\n",
                                                                                    "\t\n"};
  if (test_chance(r, 20)) add(t, "   # only a comment, with commas\n");
  add(t, test_chance(r, 5) ? "  " : "");
  add(t, x);
  add(t, gap[test_below(r, 5)]);
  add(t, y);
  add(t, end[test_below(r, 5)]);
}

static void random_file(test_random *r, bool csv, size_t n) {
  text t = {0};
  char(*coordinate)[80] = malloc(2 * n * sizeof *coordinate + 1);
  assert_non_null(coordinate);
  if (csv) add(&t, "a,\"y\",b,x\n");
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < 2; k++) random_coordinate(coordinate[2 * i + k], r);
    if (csv)
      add_csv_line(&t, coordinate[2 * i], coordinate[2 * i + 1], r);
    else
      add_points_line(&t, coordinate[2 * i], coordinate[2 * i + 1], r);
  }
  dyd_engine *e = NULL;
  dyd_error err;
  dyd_read_options o = {DYD_SIZED(dyd_read_options), .columns = csv ? "x,y" : NULL};
  dyd_status status = read_text(&e, t.data, t.used, &o, &err);
  if (status < 0) fail_msg("%zu:%zu: %s", err.line, err.column, err.message);
  check_sites(e, coordinate, n);
  dyd_engine_free(e);
  free(coordinate);
  free(t.data);
}

static void test_random_files(void **state) {
  (void)state;
  test_random r = test_random_start("random files");
  for (size_t k = 0; k < test_cases(60); k++) random_file(&r, test_chance(&r, 2), 1 + test_below(&r, 200));
  random_file(&r, false, 20000);
  random_file(&r, true, 20000);
}

/* measured and radius: the box contains the exact one and is hardly wider. */
static void check_widened(const char *coordinate, bool measured, const char *radius) {
  char line[200];
  sprintf(line, "%s 0.5\n", coordinate);
  dyd_engine *e = NULL;
  dyd_error err;
  dyd_read_options o = {DYD_SIZED(dyd_read_options), .measured = measured, .radius = radius};
  assert_int_equal(read_text(&e, line, strlen(line), &o, &err), DYD_OK);
  dyd_rect rect;
  mpq_t lo, hi, got_lo, got_hi, r;
  dyd_rect_init(&rect);
  mpq_inits(lo, hi, got_lo, got_hi, r, NULL);
  assert_int_equal(dyd_parse_measured(lo, hi, coordinate, strlen(coordinate), NULL), DYD_OK);
  if (!measured) {
    assert_int_equal(dyd_parse_number(lo, coordinate, strlen(coordinate), DYD_NUMBER_ANY, NULL), DYD_OK);
    mpq_set(hi, lo);
  }
  if (radius) assert_int_equal(dyd_parse_number(r, radius, strlen(radius), DYD_NUMBER_ANY, NULL), DYD_OK);
  mpq_sub(lo, lo, r);
  mpq_add(hi, hi, r);
  assert_int_equal(dyd_sites_get(&rect, dyd_engine_sites(e), 0), DYD_OK);
  dyd_interval_get_q(got_lo, got_hi, &rect.x);
  assert_true(mpq_cmp(got_lo, lo) <= 0 && mpq_cmp(hi, got_hi) <= 0);
  mpq_sub(lo, hi, lo);
  mpq_sub(got_lo, got_hi, got_lo);
  mpq_sub(got_lo, got_lo, lo);
  mpq_mul_2exp(got_lo, got_lo, 13);
  assert_true(mpq_cmp(got_lo, lo) <= 0);
  mpq_clears(lo, hi, got_lo, got_hi, r, NULL);
  dyd_rect_clear(&rect);
  dyd_engine_free(e);
}

static void test_widened(void **state) {
  (void)state;
  static const char *const number[] = {"47.61",
                                       "-47.605",
                                       "0",
                                       "12",
                                       "1.2e3",
                                       "123456789.123456789",
                                       "0.1",
                                       "99999999999999999999.5",
                                       "1e-300",
                                       "-5e40",
                                       "3.14159265358979323846"};
  static const char *const radius[] = {NULL, "0.01", "1/3", "1e-15", "1*2^-60", "1e30", "1e-400", "1e400"};
  for (size_t n = 0; n < sizeof number / sizeof *number; n++)
    for (size_t k = 0; k < sizeof radius / sizeof *radius; k++) {
      if (k) check_widened(number[n], false, radius[k]);
      check_widened(number[n], true, radius[k]);
    }
}

/* Bad input: the place, and nothing added. */
static void check_fails(const char *data, const char *columns, size_t line, size_t column) {
  dyd_engine *e = NULL;
  dyd_error err;
  dyd_read_options o = {DYD_SIZED(dyd_read_options), .columns = columns};
  assert_int_equal(read_text(&e, data, strlen(data), &o, &err), DYD_E_PARSE);
  assert_int_equal(err.line, line);
  assert_int_equal(err.column, column);
  assert_true(strlen(err.message) > 10);
  assert_int_equal(dyd_engine_count(e), 0);
  dyd_engine_free(e);
}

static void test_failures(void **state) {
  (void)state;
  check_fails("0 0\n1 1\n2 2 2\n", NULL, 3, 5);
  check_fails("\xEF\xBB\xBF"
              "0 0\n1 q",
              NULL, 2, 3);
  check_fails("\xEF\xBB\xBF"
              "q 1",
              NULL, 1, 1);
  check_fails("sqrt(2) sqrt(3)\n(\xC3\xA9) (\xC3\xA9)", NULL, 2, 2);
  check_fails("a,x,y\n\"1\n2\n3\",4,5\n\"1\n2\",\"4\",5z\n", "x,y", 6, 9);
  check_fails("x,y\n1,\"q\"\n", "x,y", 2, 4);
  char *line = malloc(400000);
  assert_non_null(line);
  memset(line, ' ', 400000);
  strcpy(line + 300000, "1 2\n3");
  check_fails(line, NULL, 2, 2);
  free(line);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_random_files), cmocka_unit_test(test_widened),
                                     cmocka_unit_test(test_failures)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
