/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The clock of everything that waits or measures. */
#ifndef DYD_BASE_CLOCK_H
#define DYD_BASE_CLOCK_H

#include <time.h>

/* Seconds of a clock that only goes forward. */
static inline double dyd_seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
