/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* GMP, MPFR and FLINT, which hold the long numbers, cannot tell their caller that memory is exhausted: they end the
 * process. Jansson 2.14 follows a null pointer. Here all of them end it with a message and an exit status of the
 * command, and no file begun is left. */
#include "cli.h"
#include <flint/flint.h>
#include <jansson.h>
#include <stdlib.h>
#include <unistd.h>

static void *memory_found(void *p) {
  if (p) return p;
  cli_complain_memory();
  cli_signals_unlink();
  _exit(CLI_FAILED);
}

static void *memory_take(size_t size) {
  return memory_found(malloc(size ? size : 1));
}

static void *memory_clear(size_t count, size_t size) {
  return memory_found(calloc(count ? count : 1, size ? size : 1));
}

static void *memory_change(void *old, size_t size) {
  return memory_found(realloc(old, size ? size : 1));
}

static void *memory_resize(void *old, size_t before, size_t size) {
  (void)before;
  return memory_change(old, size);
}

static void memory_release(void *old, size_t size) {
  (void)size;
  free(old);
}

/* What else FLINT gives up at, such as exponents beyond its own; it has said so. */
static _Noreturn void memory_abort(void) {
  cli_complain("these numbers are too large to compute with; give smaller ones");
  cli_signals_unlink();
  _exit(CLI_FAILED);
}

void cli_memory_guard(void) {
  mp_set_memory_functions(memory_take, memory_resize, memory_release);
  __flint_set_memory_functions(memory_take, memory_clear, memory_change, free);
  flint_set_abort(memory_abort);
  json_set_alloc_funcs(memory_take, free);
}
