/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Streams and engines for tests of composition and of queries. */
#ifndef DYD_TESTS_VORONOI_STREAMS_H
#define DYD_TESTS_VORONOI_STREAMS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dyadel/dyadel.h>
#include <string.h>

#include "support/random.h"

static inline dyd_stream *text_stream(const char *x, const char *y) {
  dyd_real *rx = NULL, *ry = NULL;
  dyd_stream *s = NULL;
  assert_int_equal(dyd_real_parse(&rx, x, strlen(x), NULL), DYD_OK);
  assert_int_equal(dyd_real_parse(&ry, y, strlen(y), NULL), DYD_OK);
  assert_int_equal(dyd_stream_from_reals(&s, rx, ry), DYD_OK);
  return s;
}

/* (sqrt(a) + b/7, sqrt(c) - d/5) for random numbers. */
static inline dyd_stream *random_stream(test_random *r) {
  char x[64], y[64];
  snprintf(x, sizeof x, "sqrt(%d)+(%d)/7", (int)test_between(r, 2, 9999), (int)test_between(r, -300, 300));
  snprintf(y, sizeof y, "sqrt(%d)-%d/5", (int)test_between(r, 2, 9999), (int)test_between(r, 0, 300));
  return text_stream(x, y);
}

static inline void narrow(dyd_stream *s, int64_t bits) {
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status st = dyd_stream_narrow(s, bits, 4096, &err);
  if (st < 0) fail_msg("%s", err.message);
}

static inline dyd_engine *engine_new(void) {
  dyd_engine *e = NULL;
  assert_int_equal(dyd_engine_new(&e), DYD_OK);
  return e;
}

static inline void run(dyd_engine *e, dyd_outcome want) {
  dyd_outcome outcome;
  dyd_error err;
  dyd_status st = dyd_engine_run(&outcome, e, NULL, &err);
  if (st < 0) fail_msg("%s", err.message);
  assert_int_equal(outcome, want);
}

#endif
