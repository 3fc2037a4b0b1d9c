/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Engines for tests: points by expressions, recording of statuses, sources that misbehave on demand. */
#ifndef DYD_TESTS_ENGINE_HELP_H
#define DYD_TESTS_ENGINE_HELP_H

#include "support/random.h"
#include <dyadel/dyadel.h>

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

dyd_engine *engine_new(void);
/* A point by two expressions. */
void engine_add_text(dyd_engine *e, const char *x, const char *y);
/* The same by callbacks without expressions: no proof about their values is possible. */
void engine_add_hidden(dyd_engine *e, const char *x, const char *y);
/* Hidden: the corners k = 0 .. n-1 of the regular n-gon, with radii 1 + weight[k] 2^-bits (weight = NULL: 1). */
void engine_add_polygon(dyd_engine *e, int n, const int *weight, int bits);
/* n random points (sqrt(a)/b, sqrt(c)/d). */
void engine_add_roots(dyd_engine *e, test_random *r, size_t n);
/* Runs and asserts that the outcome is `want`; o may be NULL. */
void engine_run(dyd_engine *e, const dyd_engine_options *o, dyd_outcome want);
void engine_count(size_t count[4], const dyd_engine *e);
dyd_engine_counters engine_counters(const dyd_engine *e);
/* Do both have results with the same status for every pair (tie and indeterminate apart)? */
void assert_same_statuses(const dyd_engine *e, const dyd_engine *f);

/* Watches runs through the progress callback: statuses may only become definite. Use as progress_user. */
typedef struct monotone {
  const dyd_engine *e;
  size_t n, stages;
  unsigned char *last; /* n * n statuses; DYD_INDETERMINATE at first */
  uint64_t stage;
  int64_t bits;
} monotone;
void monotone_init(monotone *m, const dyd_engine *e);
void monotone_clear(monotone *m);
void monotone_progress(void *user, const dyd_progress *p);
/* Compares with the present result again. */
void monotone_look(monotone *m);

/* A source of n points near (x, y) = (k^2, k^3) / 7, with a fault. All about one point, from one of its calls on. */
typedef enum fault {
  FAULT_NONE,
  FAULT_WIDEN,
  FAULT_DRIFT,
  FAULT_SWAY,
  FAULT_FAIL,
  FAULT_STALL,
  FAULT_JUNK,
  FAULT_SILENT, /* DYD_OK, and out as it was */
  FAULT_HALF,   /* the y side as it was */
  FAULT_UNKNOWN
} fault;
typedef struct faulty {
  fault kind;
  size_t point;
  uint64_t stage; /* how many good answers of this point come first */
  uint64_t seen;  /* answers of this point */
  uint64_t calls; /* of all points */
  int released;
  dyd_engine *cancel; /* cancelled from inside call number cancel_at */
  uint64_t cancel_at;
} faulty;
dyd_source faulty_source(faulty *f);

#endif
