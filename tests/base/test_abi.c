/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Structs that begin with their size: fields read from and written to callers whose structs are shorter or longer. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "base/abi.h"

typedef struct first {
  size_t struct_size;
  int a;
  uint64_t b;
} first;

/* A later edition. */
typedef struct second {
  size_t struct_size;
  int a;
  uint64_t b, c;
} second;

static void test_take(void **state) {
  (void)state;
  second own;
  dyd_error err;
  const first old = {DYD_SIZED(first), .a = 5, .b = 7};
  assert_int_equal(DYD_OK, dyd_abi_take(&own, sizeof own, NULL, "second", &err));
  assert_true(own.struct_size == sizeof own && !own.a && !own.b && !own.c);
  memset(&own, 0xAA, sizeof own);
  assert_int_equal(DYD_OK, dyd_abi_take(&own, sizeof own, &old, "second", &err));
  assert_true(own.struct_size == sizeof own && own.a == 5 && own.b == 7 && own.c == 0);
}

static void test_take_newer(void **state) {
  (void)state;
  first own;
  dyd_error err;
  second later = {DYD_SIZED(second), .a = 5, .b = 7};
  assert_int_equal(DYD_OK, dyd_abi_take(&own, sizeof own, &later, "first", &err));
  assert_true(own.struct_size == sizeof own && own.a == 5 && own.b == 7);
  for (int bit = 0; bit < 64; bit += 9) {
    memset(&err, 0xAA, sizeof err);
    later.c = (uint64_t)1 << bit;
    assert_int_equal(DYD_E_ARG, dyd_abi_take(&own, sizeof own, &later, "first", &err));
    assert_true(own.struct_size == sizeof own && !own.a && !own.b);
    assert_true(err.code == DYD_E_ARG && err.line == 0 && err.point == DYD_NO_POINT);
    assert_non_null(strstr(err.message, "first has members set that dyadel"));
  }
  assert_int_equal(DYD_E_ARG, dyd_abi_take(&own, sizeof own, &later, "first", NULL));
}

static void test_unset(void **state) {
  (void)state;
  second own, theirs = {DYD_SIZED(second)};
  dyd_error err;
  const size_t sizes[] = {0, 1, sizeof(size_t) - 1, 65537, SIZE_MAX};
  for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
    theirs.struct_size = sizes[k];
    memset(&err, 0xAA, sizeof err);
    assert_int_equal(DYD_E_ARG, dyd_abi_take(&own, sizeof own, &theirs, "second", &err));
    assert_non_null(strstr(err.message, "second s = {DYD_SIZED(second)}"));
    assert_true(err.column == 0 && own.struct_size == sizeof own);
    assert_int_equal(DYD_E_ARG, dyd_abi_check(&theirs, 0, "second", NULL));
  }
  theirs.struct_size = sizeof(first);
  assert_int_equal(DYD_OK, dyd_abi_check(&theirs, sizeof(first), "second", &err));
  assert_int_equal(DYD_E_ARG, dyd_abi_check(&theirs, sizeof(second), "second", &err));
}

/* Structs of every size between guards: no byte beyond is written. */
static void test_give(void **state) {
  (void)state;
  const second own = {DYD_SIZED(second), .a = -1, .b = UINT64_MAX, .c = UINT64_MAX};
  for (size_t size = 0; size <= sizeof own + 16; size++) {
    unsigned char theirs[sizeof own + 32];
    memset(theirs, 0xAA, sizeof theirs);
    memcpy(theirs, &size, sizeof size);
    dyd_abi_give(theirs, &own, sizeof own);
    size_t end = size > sizeof size ? size : sizeof size, known = end < sizeof own ? end : sizeof own;
    assert_memory_equal(theirs, &size, sizeof size);
    assert_memory_equal(theirs + sizeof size, (const char *)&own + sizeof size, known - sizeof size);
    for (size_t k = known; k < sizeof theirs; k++) assert_int_equal(theirs[k], k < end ? 0 : 0xAA);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_take), cmocka_unit_test(test_take_newer),
                                     cmocka_unit_test(test_unset), cmocka_unit_test(test_give)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
