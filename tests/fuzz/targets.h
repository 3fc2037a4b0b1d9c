/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Fuzz targets. Each target is a program of its own, with FUZZ_TARGET the name of its function:
 * with replay.c, which runs files and changes of them, or with libFuzzer. */
#ifndef DYD_TESTS_FUZZ_TARGETS_H
#define DYD_TESTS_FUZZ_TARGETS_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#endif
