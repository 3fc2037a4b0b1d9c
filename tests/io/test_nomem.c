/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Texts read with every allocation failing once: nothing is added then, or all of it, and the same engine reads the
 * text afterwards as it would have before. Tables beside points, areas and stated confidence likewise. Run under a leak
 * checker. */
#define _GNU_SOURCE /* fmemopen */
#include "support/failing_memory.h"

#include <dyadel/dyadel.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define O(...)                                                                                                         \
  { DYD_SIZED(dyd_read_options), __VA_ARGS__ }
#define TABLE .columns = "x,y"
#define LONG_NAME "a_name_of_a_column_that_is_long_enough_to_fill_the_message_of_an_error_if_there_are_several"
#define GZIP                                                                                                           \
  "\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\x33\x50\x30\xe0\x32\x52\x30\xe1\x32\x51\x30\xe4\x02\x00\x26\x80\x3f\xa8"   \
  "\x0c\x00\x00\x00"
#define ZSTD "\x28\xb5\x2f\xfd\x20\x0c\x61\x00\x00\x30\x20\x30\x0a\x32\x20\x34\x0a\x34\x20\x31\x0a"

static const struct {
  dyd_read_options options;
  dyd_status status;
  const char *says; /* where the status is not DYD_OK */
  const char *text;
  size_t size; /* 0: up to its NUL */
} texts[] = {
    {O(0), DYD_OK, "", "0 0\n1.5 2e3 # c\n[1,2] 3+-1\nsqrt(2) 1/3\n0x1p3 5*2^-20\n7 pi\n[1/3,2/3] 1e30\n0.1 0.2\n", 0},
    {O(.measured = true, .radius = "1/3", .merge = true), DYD_OK, "",
     "0 0\n0 0\nsqrt(2) 1\nsqrt(2) 1\n1.25 1/7\n1.25 1/7\n2*2^900 0\n1.5 4\n1.50 4\n", 0},
    {O(.round = true, .radius = "0.5", .merge = true), DYD_OK, "",
     "POINT (1 2)\nMULTIPOINT ((3 4),(5 6))\nPOINT (1 2)\n", 0},
    {O(TABLE, .carry = "all", .id = "id", .cost_column = "c", .radius_columns = "r,r", .skip_missing = true), DYD_OK,
     "", "id,x,y,r,c\na,0,0,1,2\n\"b\nc\",1,1/3,0.5,1/2\nd,NA,1,1,1\n\"e, \"\"f\",sqrt(2),pi,1e-3,7\n", 0},
    {O(TABLE, .cost_column = "c"), DYD_E_PARSE, "the cost is not an exact number above 0", "x,y,c\n0,0,1\n1,1,-1\n", 0},
    {O(TABLE, .cost_column = "c"), DYD_E_PARSE, "the cost is not an exact number above 0", "x,y,c\n0,0,1\n1,1,1e400\n",
     0},
    {O(TABLE, .cost_column = "c"), DYD_E_PARSE, "the cost is not an exact number above 0", "x,y,c\n0,0,1\n1,1,pi\n", 0},
    {O(TABLE, .id = "id", .merge_by = "id", .radius = "1"), DYD_OK, "",
     "id,x,y\na,0,0\nb,5,5\na,0.5,0.5\nb,5+-1/3,5\n,9,9\nc,sqrt(3),1\nc,sqrt(3),1\n", 0},
    {O(TABLE, .id = "id", .merge_by = "id"), DYD_E_PARSE, "", "id,x,y\na,0,0\na,1,0\n", 0},
    {O(TABLE, .id = "id", .merge_by = "id", .sigma_column = "s,s", .confidence = "95%"), DYD_OK, "",
     "id,x,y,s\na,0,0,1\na,1,0,0.5\nb,7,1/3,0\nc,4,4,1/3\n", 0},
    {O(TABLE, .sigma_column = "s,s,h", .confidence = "0.9", .round = true), DYD_OK, "",
     "x,y,s,h\n0,0,1,0.5\n1,9,1/3,-1/4\n", 0},
    {O(TABLE, .sigma_column = "s", .confidence = "0.9"), DYD_E_PARSE, "above the range of doubles",
     "x,y,s\n0,0,1e308\n1,1,1e308\n", 0},
    {O(TABLE, .sigma_column = "s,s,h", .confidence = "0.9", .round = true), DYD_E_PARSE,
     "is above the range of doubles", "x,y,s,h\n0,0,1.7e308,1\n", 0},
    {O(.columns = "lon,lat", .degrees = true, .sigma_column = "s,t", .confidence = "0.9"), DYD_E_PARSE,
     "one standard deviation is a length", "lon,lat,s,t\n1,2,3m,1arcsec\n", 0},
    {O(.degrees = true, .merge = true), DYD_OK, "",
     "8\xc2\xb0"
     "01'E 47\xc2\xb0"
     "36'18.3\"N\n9.1E 48.605N\n1 2\n1 2\n",
     0},
    {O(.columns = "lon,lat", .degrees = true, .radius_columns = "r", .radius_scale = "1/2", .merge = true), DYD_OK, "",
     "lon,lat,r\n1,2,30m\n1,2,20m\n4,1/3,1km\n", 0},
    {O(.columns = "g,g", .carry = "all", .skip_missing = true), DYD_OK, "",
     "id;g\n1;POINT (1 2)\n2;POINT EMPTY\n3;\"POINT(4 1/3)\"\n", 0},
    {O(0), DYD_E_PARSE, "name the columns of x and y", "x;y;name\n1;2;a\n3;4;b\n", 0},
    {O(0), DYD_E_PARSE, "", "1 2\n1 2)\n", 0},
    {O(TABLE, .delimiter = "blank", .thousands = "'", .units_row = true, .missing = "-9", .skip_lines = "1",
       .radius_columns = "r"),
     DYD_OK, "", "about\nx y r\nm m m\n1'000.5 2 1\n-9.5 4 1\n7 1/3 2\n", 0},
    {O(TABLE, .decimal_comma = true), DYD_OK, "", "name;x;y\nD\xfcss;1,5;2\nM\xfcl;3;4,25\n", 0},
    {O(TABLE), DYD_E_PARSE, ", ...",
     "a,b,c_" LONG_NAME ",d_" LONG_NAME ",e_" LONG_NAME ",f_" LONG_NAME "\n1,2,3,4,5,6\n", 0},
    {O(.columns = "x,y,z"), DYD_E_ARG, "give", "x,y\n1,2\n", 0},
    {O(TABLE, .radius_columns = "x,y,z"), DYD_E_ARG, "one or two column names", "x,y\n1,2\n", 0},
    {O(TABLE, .sigma_column = "s,s,s,s", .confidence = "0.9"), DYD_E_ARG, "one, two or three", "x,y,s\n1,2,3\n", 0},
    {O(TABLE, .delimiter = "ab"), DYD_E_ARG, "cannot be a delimiter", "x,y\n1,2\n", 0},
    {O(TABLE), DYD_E_PARSE, "2 columns are called \"x\"; rename", "x,x,y\n1,2,3\n", 0},
    {O(.columns = "X,y"), DYD_E_PARSE, "but for capitals", "x,x,y\n1,2,3\n", 0},
    {O(.columns = "lat,lon", .degrees = true), DYD_E_ARG, "longitude comes first", "lat,lon\n1,2\n", 0},
    {O(TABLE, .carry = "id,\"x\""), DYD_OK, "", "x,y,id\n1,2,a\n3,4,\n", 0},
    {O(TABLE, .carry = "b"), DYD_E_PARSE, "no column is called \"b\"", "x,y,id\n1,2,a\n", 0},
    {O(TABLE, .delimiter = ":"), DYD_E_PARSE, "delimiter", "x:y\n1:2:3\n", 0},
    {O(TABLE, .delimiter = ":"), DYD_OK, "", "x:y\n1:2\n", 0},
    {O(TABLE), DYD_E_PARSE, "quote", "x,y\n1,\"2\n", 0},
    {O(0), DYD_OK, "", GZIP, sizeof GZIP - 1},
    {O(0), DYD_OK, "", ZSTD, sizeof ZSTD - 1},
};
enum { TEXTS = sizeof texts / sizeof *texts };

static FILE *file_of(const char *text, size_t size) {
  FILE *in = fmemopen((void *)(uintptr_t)text, size, "r");
  assert_non_null(in);
  return in;
}

/* Reads text k into e, where allocation number `fault` fails. */
static dyd_status read_text(dyd_engine *e, size_t k, size_t fault, dyd_error *err) {
  const size_t size = texts[k].size ? texts[k].size : strlen(texts[k].text);
  FILE *in = file_of(texts[k].text, size);
  countdown = fault;
  dyd_status st = dyd_read_points(e, in, &texts[k].options, err);
  fclose(in);
  return st;
}

/* An engine with a triangle of doubles; with points of other kinds, too; that has run, or not. */
static dyd_engine *begun(int kind) {
  static const char some[] = "sqrt(2) 5\n1/3 [7,8]\n[9,9.1] 1e30\n";
  dyd_engine *e = NULL;
  dyd_error err;
  dyd_outcome outcome;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  if (kind >= 1)
    assert_int_equal(dyd_engine_add_points(e, 3, (double[]){-1, 40, 3}, (double[]){-1, 0, 50}, &err), DYD_OK);
  if (kind >= 2) assert_int_equal(dyd_engine_add_text(e, some, strlen(some), NULL, &err), DYD_OK);
  if (kind % 2) assert_int_equal(dyd_engine_run(&outcome, e, NULL, &err), DYD_OK);
  return e;
}

/* What is known of the points of e, and of a further one. */
static size_t statements(dyd_engine *e) {
  dyd_pair_list pairs = {0};
  dyd_error err;
  dyd_outcome outcome;
  size_t known = 0;
  for (int more = 0; more < 2; more++) {
    if (more) assert_int_equal(dyd_engine_add_points(e, 1, (double[]){-7}, (double[]){11}, &err), DYD_OK);
    assert_int_equal(dyd_engine_run(&outcome, e, NULL, &err), DYD_OK);
    assert_int_equal(dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(e)), DYD_OK);
    for (size_t k = 0; k < pairs.count; k++)
      known = 31 * known + pairs.item[k].i + 97 * pairs.item[k].j + 1009 * (size_t)pairs.item[k].status;
  }
  dyd_pair_list_clear(&pairs);
  return known;
}

/* After a failure the points are those that there were, and so is what is known of them. */
static void test_taken_back(void **state) {
  static const char text[] =
      "0 0\n0.5 1.5\n1/3 2/7\n[1/3,2/3] 2\n[4,5] [1,2]\n0.1+-0.05 7\n1e40 3\n7 sqrt(2)\nsqrt(3) 2\n";
  (void)state;
  for (int kind = 0; kind < 4; kind++) {
    dyd_engine *e = begun(kind);
    const size_t want = kind ? statements(e) : 0, count = kind ? 3 + 3 * (kind > 1) : 0;
    dyd_engine_free(e);
    for (size_t fault = 1, met = 1; met; fault++) {
      dyd_error err;
      e = begun(kind);
      FILE *in = file_of(text, strlen(text));
      countdown = fault;
      dyd_status st = dyd_read_points(e, in, NULL, &err);
      met = !countdown;
      countdown = 0;
      fclose(in);
      assert_int_equal(st, met ? DYD_E_NOMEM : DYD_OK);
      assert_int_equal(dyd_engine_count(e), met ? count : count + 9);
      if (kind && met) assert_int_equal(statements(e), want);
      dyd_engine_free(e);
    }
  }
}

static void test_points(void **state) {
  (void)state;
  for (size_t k = 0; k < TEXTS; k++) {
    dyd_error err;
    dyd_engine *e = NULL;
    size_t count = 0;
    for (size_t fault = 0;; fault++) {
      assert_int_equal(dyd_engine_new(&e), DYD_OK);
      dyd_status st = read_text(e, k, fault, &err);
      const bool met = fault && !countdown;
      countdown = 0;
      if (met && st == DYD_E_NOMEM) {
        assert_int_equal(err.code, DYD_E_NOMEM);
        if (dyd_engine_count(e)) fail_msg("text %zu, fault %zu: points are added", k, fault);
        st = read_text(e, k, 0, &err);
      }
      if (st != texts[k].status || (st != DYD_OK && !strstr(err.message, texts[k].says) && !met))
        fail_msg("text %zu, fault %zu: status %d, %zu:%zu: %s", k, fault, st, err.line, err.column, err.message);
      if (!fault) count = dyd_engine_count(e);
      assert_int_equal(dyd_engine_count(e), count);
      dyd_engine_free(e);
      if (fault && !met) break;
    }
    assert_true(count > 0 || texts[k].status != DYD_OK);
  }
}

/* ---- areas ---- */

static void test_areas(void **state) {
  static const char *const area[] = {
      "id,shape\n1,\"POLYGON ((0 0, 4 0, 4 4.5, 0 4), (1 1, 2 1, 1 2))\"\n",
      "{\"type\": \"MultiPolygon\", \"coordinates\": [[[[0, 0], [1e3, 0], [0, 1]]], [[[5, 5], [6, 5], [5, 6]]]]}",
      "POLYGON ((0 0, 4 4, 4 0, 0 4))"};
  (void)state;
  for (size_t k = 0; k < 3; k++) {
    dyd_error err;
    dyd_area out = {0};
    for (size_t fault = 0;; fault++) {
      FILE *in = file_of(area[k], strlen(area[k]));
      countdown = fault;
      dyd_status st = dyd_area_read(&out, in, &err);
      const bool met = fault && !countdown;
      countdown = 0;
      fclose(in);
      assert_true(met ? st == DYD_E_NOMEM : st == (k == 2 ? DYD_E_PARSE : DYD_OK));
      assert_int_equal(st == DYD_OK, out.rings == 2);
      dyd_area_clear(&out);
      if (fault && !met) break;
    }
  }
}

/* ---- tables apart from the points ---- */

typedef struct seen {
  char text[200];
  size_t rows, most;
} seen;

/* Writes fields in brackets and, of integers from -9 to 99, their double. */
static dyd_status see_record(void *user, const dyd_record *row, dyd_error *err) {
  seen *s = user;
  size_t used = strlen(s->text), length;
  mpq_t number;
  mpq_init(number);
  for (size_t k = 0; k < row->fields; k++) {
    const char *field = dyd_record_field(&length, row, k);
    const dyd_status st = dyd_parse_number(number, field, length, DYD_NUMBER_MINUS, err);
    if (st == DYD_E_NOMEM) return mpq_clear(number), st;
    if (st == DYD_OK && mpq_cmp_si(number, -9, 1) >= 0 && mpq_cmp_si(number, 99, 1) <= 0)
      used += (size_t)snprintf(s->text + used, sizeof s->text - used, "<%d>", 2 * (int)mpq_get_d(number));
    else
      used += (size_t)snprintf(s->text + used, sizeof s->text - used, "[%.*s]", (int)length, field);
  }
  assert_null(dyd_record_field(&length, row, row->fields));
  assert_int_equal(length, 0);
  mpq_clear(number);
  if (s->rows++ < s->most) return DYD_OK;
  dyd_record_place(err, row, s->rows % 2 ? 1 : row->fields);
  return dyd_error_set(err, DYD_E_PARSE, "too many rows");
}

static const struct {
  char delimiter;
  size_t most;
  dyd_status status;
  size_t line, column;
  const char *text, *want;
} records[] = {
    {0, 9, DYD_OK, 0, 0, "# head\n\n a , 12 ,-9\n\n\"b, \"\"c\"\"\",100,-10\n% x\n1",
     "[a]<24><-18>[b, \"c\"][100][-10]<2>"},
    {0, 9, DYD_OK, 0, 0, "a\t-1 2\n|\t7", "[a][-1 2][|]<14>"},
    {0, 9, DYD_OK, 0, 0, " 1  2 # 3\n", "<2><4>"},
    {' ', 9, DYD_OK, 0, 0, " 1  2;3,4\t5 # 6\n#7\n\"8 9\"\n", "<2><4><6><8><10>[\"8][9\"]"},
    {' ', 9, DYD_OK, 0, 0, "1,2\r\n3 9999999999999999999 -9223372036854775809\n- 1x",
     "<2><4><6>[9999999999999999999][-9223372036854775809][-][1x]"},
    {'|', 9, DYD_OK, 0, 0, "1,2|3\n", "[1,2]<6>"},
    {',', 2, DYD_E_PARSE, 3, 4, "1,2\n3,4\n 5,6\n", "<2><4><6><8><10><12>"},
    {' ', 1, DYD_E_PARSE, 2, 4, "1 2\n3 4\n", "<2><4><6><8>"},
    {',', 9, DYD_E_PARSE, 2, 3, "1,2\n3,\"4\n", "<2><4>"},
    {',', 9, DYD_E_PARSE, 1, 0, "1,\"2\"3\n", ""},
    {0, 9, DYD_E_PARSE, 1, 2, "1\0002\n", ""},
};

static void test_records(void **state) {
  (void)state;
  for (size_t k = 0; k < sizeof records / sizeof *records; k++) {
    for (size_t fault = 0;; fault++) {
      const size_t size = strlen(records[k].text);
      seen s = {.most = records[k].most};
      dyd_error err;
      FILE *in = file_of(records[k].text, size == 1 ? 4 : size);
      countdown = fault;
      dyd_status st = dyd_read_records(in, records[k].delimiter, see_record, &s, &err);
      const bool met = fault && !countdown;
      countdown = 0;
      fclose(in);
      if (met) assert_int_equal(st, DYD_E_NOMEM);
      if (!met &&
          (st != records[k].status || strcmp(s.text, records[k].want) != 0 ||
           (st != DYD_OK && (err.line != records[k].line || (records[k].column && err.column != records[k].column)))))
        fail_msg("records %zu: status %d, %s, line %zu, column %zu, %s", k, st, s.text, err.line, err.column,
                 err.message);
      if (fault && !met) break;
    }
  }
}

/* Without a place for the error; and a quoted field that is longer than any line may be, over many lines. */
static void test_long_record(void **state) {
  enum { LINES = 1100, LONG = 1000 };
  (void)state;
  static char text[LINES * (LONG + 1) + 8];
  memset(text, 'a', sizeof text);
  text[0] = '"';
  for (size_t k = 1; k <= LINES; k++) text[k * (LONG + 1)] = '\n';
  seen s = {.most = 9};
  for (int told = 0; told < 2; told++) {
    dyd_error err;
    FILE *in = file_of(text, sizeof text);
    assert_int_equal(dyd_read_records(in, ',', see_record, &s, told ? &err : NULL), DYD_E_PARSE);
    if (told) assert_non_null(strstr(err.message, "a quoted field is longer than 1048576 bytes"));
    fclose(in);
  }
  assert_int_equal(s.rows, 0);
}

/* ---- confidence of points that a caller widens ---- */

static void test_stated_confidence(void **state) {
  (void)state;
  dyd_engine *e = NULL;
  dyd_error err;
  dyd_confidence out = {DYD_SIZED(dyd_confidence)};
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_engine_state_confidence(&out, NULL, "95%", 1, NULL), DYD_E_ARG);
  assert_int_equal(dyd_engine_state_confidence(&out, e, NULL, 1, &err), DYD_E_ARG);
  for (const char *const *wrong = (const char *const[]){"", "1", "0", "100 %", "-0.5", "1/2", "95%%", NULL}; *wrong;
       wrong++)
    assert_int_equal(dyd_engine_state_confidence(&out, e, *wrong, 1, &err), DYD_E_ARG);
  dyd_confidence odd = {.struct_size = 3};
  assert_int_equal(dyd_engine_state_confidence(&odd, e, "95%", 1, &err), DYD_E_ARG);
  assert_false(dyd_engine_confidence(&out, e));
  assert_int_equal(dyd_engine_state_confidence(&out, e, "95 %", 4, &err), DYD_OK);
  assert_true(out.k >= 2.960414 && out.k < 2.960416 && out.n == 4); /* sqrt(2 ln(4 / 0.05)) */
  assert_string_equal(out.probability, "0.95");
  assert_int_equal(dyd_engine_state_confidence(&out, e, "0.9", 4, &err), DYD_E_ARG);
  assert_non_null(strstr(err.message, "were added before"));
  dyd_engine_free(e);
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_engine_state_confidence(NULL, e, "0.5", 0, &err), DYD_OK);
  assert_true(dyd_engine_confidence(&out, e) && out.k == 0);
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_points),      cmocka_unit_test(test_taken_back),
                                     cmocka_unit_test(test_areas),       cmocka_unit_test(test_records),
                                     cmocka_unit_test(test_long_record), cmocka_unit_test(test_stated_confidence)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
