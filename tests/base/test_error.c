/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Error records: fields that are filled in, left alone, cut. Memory: too much, none, in large pages. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/error.h"

static void test_fill(void **state) {
  (void)state;
  dyd_error err;
  dyd_error_clear(&err);
  assert_int_equal(err.code, DYD_OK);
  assert_true(err.point == DYD_NO_POINT);
  err.line = 7;
  assert_int_equal(dyd_fail(&err, DYD_E_ARG, "point %d is bad", 3), DYD_E_ARG);
  assert_int_equal(err.code, DYD_E_ARG);
  assert_string_equal(err.message, "point 3 is bad");
  assert_int_equal(err.line, 7);
  assert_int_equal(dyd_fail(NULL, DYD_E_IO, "nobody listens"), DYD_E_IO);
  assert_int_equal(dyd_fail_nomem(&err), DYD_E_NOMEM);
  assert_string_equal(err.message, dyd_status_text(DYD_E_NOMEM));
}

static void test_cut(void **state) {
  (void)state;
  char text[3 * DYD_MESSAGE_SIZE];
  memset(text, 'x', sizeof text);
  text[sizeof text - 1] = 0;
  dyd_error err;
  dyd_error_clear(&err);
  dyd_fail(&err, DYD_E_ARG, "%s", text);
  assert_int_equal(strlen(err.message), DYD_MESSAGE_SIZE - 1);
}

static void test_texts(void **state) {
  (void)state;
  for (int status = DYD_E_IO; status <= DYD_CANCELLED; status++) {
    assert_string_not_equal(dyd_status_text((dyd_status)status), "unknown status");
  }
  assert_string_equal(dyd_status_text((dyd_status)99), "unknown status");
  assert_true(strlen(dyd_version()) >= 5);
}

static void test_allocation(void **state) {
  (void)state;
  assert_null(dyd_alloc(SIZE_MAX / 2, 3));
  void *p = dyd_alloc(0, 8);
  assert_non_null(p);
  free(p);
  int *array = NULL;
  size_t cap = 0;
  for (int k = 0; k < 1000; k++) {
    assert_true(dyd_reserve((void **)&array, &cap, (size_t)k + 1, sizeof *array));
    array[k] = k;
  }
  for (int k = 0; k < 1000; k++) assert_int_equal(array[k], k);
  int *before = array;
  assert_false(dyd_reserve((void **)&array, &cap, SIZE_MAX / 2, sizeof *array));
  assert_ptr_equal(array, before);
  free(array);
}

/* Whether the system was asked for large pages where p is: 1, 0, or -1 when it does not tell. */
static int large_pages_at(const void *p) {
  FILE *maps = fopen("/proc/self/smaps", "r"), *offered = fopen("/sys/kernel/mm/transparent_hugepage/enabled", "r");
  char line[4096];
  bool there = false;
  int asked = -1;
  while (maps && offered && asked < 0 && fgets(line, sizeof line, maps)) {
    uintmax_t begin, end;
    if (sscanf(line, "%jx-%jx ", &begin, &end) == 2) there = begin <= (uintptr_t)p && (uintptr_t)p < end;
    if (there && !strncmp(line, "VmFlags:", 8)) asked = strstr(line, " hg") != NULL;
  }
  if (maps) fclose(maps);
  if (offered) fclose(offered);
  return asked;
}

static void test_large_pages(void **state) {
  (void)state;
  enum { LARGE = 1 << 26 };
  char *large = dyd_alloc(LARGE, 1), *grown = NULL, small;
  size_t cap = 0;
  assert_true(large && dyd_reserve((void **)&grown, &cap, LARGE, 1));
  int asked[] = {large_pages_at(large + LARGE / 2), large_pages_at(grown + LARGE / 2), large_pages_at(&small)};
  free(large);
  free(grown);
  if (asked[2] < 0) skip();
  assert_int_equal(asked[0], 1);
  assert_int_equal(asked[1], 1);
  assert_int_equal(asked[2], 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_fill), cmocka_unit_test(test_cut),
                                     cmocka_unit_test(test_texts), cmocka_unit_test(test_allocation),
                                     cmocka_unit_test(test_large_pages)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
