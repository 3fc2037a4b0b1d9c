/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Memory that fails when a test says so. For one source file of a program that is linked with --wrap for malloc, calloc
 * and realloc; GMP's own allocations are not touched. */
#ifndef DYD_TESTS_FAILING_MEMORY_H
#define DYD_TESTS_FAILING_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);

/* 0: none fails; k > 0: the k-th allocation from now fails, once; it is 0 when that has happened. With a bell, it is
 * set instead: a deterministic way to stop work in its middle. */
static size_t countdown;
static volatile int *bell;

static bool allocation_fails(void) {
  if (!countdown || --countdown) return false;
  if (bell) *bell = 1;
  return !bell;
}

void *__wrap_malloc(size_t size) {
  return allocation_fails() ? NULL : __real_malloc(size);
}
void *__wrap_calloc(size_t count, size_t size) {
  return allocation_fails() ? NULL : __real_calloc(count, size);
}
void *__wrap_realloc(void *old, size_t size) {
  return allocation_fails() ? NULL : __real_realloc(old, size);
}

#endif
