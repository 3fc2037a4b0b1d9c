/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The time that --timeout gives the whole command, from its first byte read to its last byte written.
 *
 * A thread waits for the end of it and raises a flag, at which the engine and the writers come to an end with what is
 * known. What does not look at the flag (an input that does not come, one huge root) is ended with the process, a grace
 * later, with a line that says what was cut; the file begun is removed. */
#include "cli.h"
#include <errno.h>
#include <math.h>
#include <stdatomic.h>
#include <time.h>
#include <unistd.h>

#define LONGEST 1e9 /* about thirty years; longer limits are none */
static double ends = INFINITY, grace;
static volatile int late;
static _Atomic(const char *) phase = "starting";
static atomic_int written = -1;

double cli_clock(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static struct timespec deadline_time(double at) {
  return (struct timespec){.tv_sec = (time_t)at, .tv_nsec = (long)(1e9 * (at - floor(at)))};
}

static void deadline_wait(double at) {
  struct timespec t = deadline_time(at);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, NULL) == EINTR) continue;
}

static void *deadline_watch(void *unused) {
  (void)unused;
  deadline_wait(ends);
  __atomic_store_n(&late, 1, __ATOMIC_SEQ_CST);
  cli_signals_stop();
  deadline_wait(ends + grace);
  int status = atomic_load(&written);
  if (status >= 0) _exit(status);
  cli_complain("budget: the time is used up, and %s does not end: nothing of it is known; raise --timeout",
               atomic_load(&phase));
  cli_signals_unlink();
  _exit(CLI_BUDGET);
}

void cli_deadline_start(double seconds) {
  pthread_t thread;
  if (!(seconds > 0 && seconds < LONGEST)) return;
  ends = cli_clock() + seconds;
  grace = fmax(0.9, 0.09 * seconds);
  if (cli_signals_spare(&thread, deadline_watch, NULL)) pthread_detach(thread);
}

void cli_deadline_phase(const char *what) {
  atomic_store(&phase, what);
}

void cli_deadline_written(int status) {
  atomic_store(&written, status);
}

double cli_deadline_left(double share) {
  if (!isfinite(ends)) return 0;
  return fmax(share * (ends - cli_clock()), 0x1p-20);
}

const volatile int *cli_deadline_flag(void) {
  return &late;
}

/* The engine has a clock of its own, which may be read before the thread here wakes up. */
bool cli_deadline_passed(void) {
  return __atomic_load_n(&late, __ATOMIC_SEQ_CST) || cli_clock() >= ends;
}
