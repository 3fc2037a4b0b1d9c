/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The cost meter: CPU time, and the resident peak of a stretch of the program.
 *
 * Writing 5 to /proc/self/clear_refs sets the high-water mark VmHWM back to the present VmRSS; free heap memory is
 * given back first, so that neither contestant profits from what the other one left. */
#include "harness.h"

#include <malloc.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double seconds_of(clockid_t clock) {
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* A "Name:   123 kB" line of /proc/self/status, in bytes; -1 when there is none. */
static double status_bytes(const char *name) {
  FILE *f = fopen("/proc/self/status", "r");
  char line[256];
  double bytes = -1;
  while (f && fgets(line, sizeof line, f))
    if (!strncmp(line, name, strlen(name))) bytes = 1024 * strtod(line + strlen(name), NULL);
  if (f) fclose(f);
  return bytes;
}

static bool reset_peak(void) {
  FILE *f = fopen("/proc/self/clear_refs", "w");
  if (!f) return false;
  bool ok = fputs("5\n", f) >= 0;
  return fclose(f) == 0 && ok;
}

bench_meter bench_start(void) {
  malloc_trim(0);
  bench_meter m = {0, 0, reset_peak() ? status_bytes("VmRSS:") : -1};
  m.wall = seconds_of(CLOCK_MONOTONIC);
  m.seconds = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
  return m;
}

bench_cost bench_stop(const bench_meter *m) {
  bench_cost c = {seconds_of(CLOCK_PROCESS_CPUTIME_ID) - m->seconds, seconds_of(CLOCK_MONOTONIC) - m->wall, -1};
  double peak = status_bytes("VmHWM:");
  if (m->bytes >= 0 && peak >= m->bytes) c.bytes = peak - m->bytes;
  return c;
}

void bench_series_add(bench_series *s, bench_cost c) {
  if (s->count == BENCH_MAX_RUNS) return;
  s->seconds[s->count] = c.seconds;
  s->wall[s->count] = c.wall;
  s->bytes[s->count++] = c.bytes;
}

static int compare_doubles(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double median(const double *x, size_t count) {
  double copy[BENCH_MAX_RUNS];
  memcpy(copy, x, count * sizeof *x);
  qsort(copy, count, sizeof *copy, compare_doubles);
  return (copy[(count - 1) / 2] + copy[count / 2]) / 2;
}

bench_cost bench_series_median(const bench_series *s) {
  if (s->count == 0) return (bench_cost){0, 0, 0};
  return (bench_cost){median(s->seconds, s->count), median(s->wall, s->count), median(s->bytes, s->count)};
}
