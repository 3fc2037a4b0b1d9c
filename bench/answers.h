/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The answers of rows, as they have been: a bench that has become fast by answering otherwise is no bench. */
#ifndef DYD_BENCH_ANSWERS_H
#define DYD_BENCH_ANSWERS_H

#include "harness.h"

/* Ends the program with a message when the row has been recorded with that many points and other pairs by status; when
 * it has not been recorded and --known was given, too. */
void bench_check(const bench_options *o, const char *row, size_t n, const size_t count[4]);
/* The same for a row that answers with other numbers: what they are is the row's. */
void bench_check_numbers(const bench_options *o, const char *row, size_t n, size_t a, size_t b, size_t c);

#endif
