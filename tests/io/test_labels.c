/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What points are called when they come from several files and calls: row numbers continue, names stay with their
 * points, and a file that is refused leaves nothing behind. */
#include <dyadel/engine.h>
#include <dyadel/io.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static dyd_read_report add_file(dyd_engine *e, const char *text, const dyd_read_options *options, dyd_status wanted) {
  dyd_read_report report = {DYD_SIZED(dyd_read_report)};
  dyd_read_options o = *options;
  dyd_error err;
  o.report = &report;
  assert_int_equal(dyd_engine_add_text(e, text, strlen(text), &o, &err), wanted);
  return report;
}

/* Rows and identifiers of all points. */
static void check_points(const dyd_engine *e, size_t count, const size_t row[], const char *const id[]) {
  assert_int_equal(dyd_engine_count(e), count);
  for (size_t i = 0; i < count; i++) {
    assert_int_equal(dyd_engine_row(e, i), row[i]);
    if (id)
      assert_string_equal(dyd_engine_id(e, i), id[i]);
    else
      assert_null(dyd_engine_id(e, i));
  }
}

static void test_several_files(void **state) {
  (void)state;
  dyd_engine *e = NULL;
  const dyd_read_options plain = {DYD_SIZED(dyd_read_options)};
  const dyd_read_options named = {DYD_SIZED(dyd_read_options), .columns = "x,y", .id = "n", .skip_missing = true,
                                  .merge = true};
  const double x[] = {50, 60}, y[] = {0, 70};
  size_t row, point;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_engine_add_points(e, 2, x, y, NULL), DYD_OK);
  check_points(e, 2, (const size_t[]){0, 1}, NULL);

  dyd_read_report r = add_file(e, "x,y,n\n1,1,one\nNA,1,gone\n2,1,\n1.0,1,one again\n3,1,three\n", &named, DYD_OK);
  assert_int_equal(r.rows, 5);
  assert_int_equal(r.missing, 1);
  assert_int_equal(r.merged, 1);
  assert_int_equal(r.shared, 0);
  check_points(e, 5, (const size_t[]){0, 1, 2, 4, 6}, (const char *const[]){"", "", "one", "", "three"});
  assert_true(dyd_engine_merged(&row, &point, e, 0));
  assert_int_equal(row, 5);
  assert_int_equal(point, 2);
  assert_false(dyd_engine_merged(&row, &point, e, 1));

  add_file(e, "x,y,n\n9,9,nine\nq,1,bad\n", &named, DYD_E_PARSE);
  check_points(e, 5, (const size_t[]){0, 1, 2, 4, 6}, (const char *const[]){"", "", "one", "", "three"});

  r = add_file(e, "7 7\n8 8\n", &plain, DYD_OK);
  assert_int_equal(r.rows, 2);
  r = add_file(e, "x,y,n\n4,4,four\n4,4,\n5,4,five\n", &named, DYD_OK);
  check_points(e, 9, (const size_t[]){0, 1, 2, 4, 6, 7, 8, 9, 11},
               (const char *const[]){"", "", "one", "", "three", "", "", "four", "five"});
  assert_true(dyd_engine_merged(&row, &point, e, 1));
  assert_int_equal(row, 10);
  assert_int_equal(point, 7);
  assert_int_equal(dyd_engine_row(NULL, 17), 17);
  assert_null(dyd_engine_id(NULL, 17));
  dyd_engine_free(e);
}

static void test_shared_places(void **state) {
  (void)state;
  dyd_engine *e = NULL;
  dyd_read_options o = {DYD_SIZED(dyd_read_options), .radius = "1/8"};
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  dyd_read_report r = add_file(e, "0 0\n1 1\n0.0 0\n2 2\n1e0 2/2\n0 -0\n", &o, DYD_OK);
  assert_int_equal(r.rows, 6);
  assert_int_equal(r.shared, 5);
  dyd_engine_free(e);
}

/* Points of arrays are named by the caller: those before keep their names, and a refused call changes nothing. */
static void test_named_by_caller(void **state) {
  (void)state;
  dyd_engine *e = NULL;
  const double x[] = {1, 2, 3}, y[] = {4, 5, 6};
  const dyd_read_options o = {DYD_SIZED(dyd_read_options)};
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  assert_int_equal(dyd_engine_name(e, 1, (const size_t[]){0}, NULL), DYD_E_ARG);
  assert_int_equal(dyd_engine_name(e, 0, NULL, NULL), DYD_OK);
  add_file(e, "0 0\n1 1\n", &o, DYD_OK);
  assert_int_equal(dyd_engine_add_points(e, 3, x, y, NULL), DYD_OK);
  check_points(e, 5, (const size_t[]){0, 1, 2, 3, 4}, NULL);
  assert_int_equal(dyd_engine_name(e, 3, (const size_t[]){2, 5, 7}, NULL), DYD_OK);
  check_points(e, 5, (const size_t[]){0, 1, 2, 5, 7}, NULL);
  assert_int_equal(dyd_engine_name(e, 3, (const size_t[]){3, 3, 4}, NULL), DYD_E_ARG);
  assert_int_equal(dyd_engine_name(e, 3, (const size_t[]){1, 3, 4}, NULL), DYD_E_ARG);
  assert_int_equal(dyd_engine_name(e, 6, (const size_t[]){0, 1, 2, 3, 4, 5}, NULL), DYD_E_ARG);
  assert_int_equal(dyd_engine_name(e, 2, (const size_t[]){6, 9}, (const char *const[]){"a", NULL}), DYD_OK);
  check_points(e, 5, (const size_t[]){0, 1, 2, 6, 9}, (const char *const[]){"", "", "", "a", ""});
  add_file(e, "7 7\n", &o, DYD_OK);
  check_points(e, 6, (const size_t[]){0, 1, 2, 6, 9, 10}, (const char *const[]){"", "", "", "a", "", ""});
  dyd_engine_free(e);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_named_by_caller), cmocka_unit_test(test_several_files),
                                     cmocka_unit_test(test_shared_places)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
