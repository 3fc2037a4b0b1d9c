/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cases of thin rectangles, most of whose cells the doubles can do. */
#ifndef DYD_TESTS_THIN_CASE_H
#define DYD_TESTS_THIN_CASE_H

#include "oracle/oracle_case.h"
#include "support/random.h"
#include <string.h>

/* n rectangles of sides 0, 1 or 2 units in the unit square; a unit is 2^-low .. 2^-high. */
static inline void thin_case(orc_case *c, test_random *r, size_t n, int low, int high) {
  unsigned long den = (unsigned long)1 << test_between(r, low, high);
  c->n = 0;
  strcpy(c->kind, "thin");
  for (size_t i = 0; i < n; i++) {
    long x = (long)(test_unit(r) * (double)den), y = (long)(test_unit(r) * (double)den);
    orc_case_add(c, x, x + (long)test_below(r, 3), y, y + (long)test_below(r, 3), den);
  }
}

#endif
