/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Ctrl-C, a connection that is lost, a request to end: the first one cancels the run, so that what is known is written;
 * the next one ends the process. Other signals end it at once. No file begun is left.
 *
 * Handlers touch only lock-free objects, dyd_engine_cancel (async-signal-safe by contract) and unlink. */
#include "cli.h"
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <unistd.h>

static _Atomic(dyd_engine *) to_cancel;
/* The results begun: one, and the trace of the run that makes it, and one to spare. */
enum { MOST_FILES = 4 };
static _Atomic(const char *) to_remove[MOST_FILES];
static volatile int stop;

void cli_signals_unlink(void) {
  for (int k = 0; k < MOST_FILES; k++) {
    const char *name = atomic_load(&to_remove[k]);
    if (name) unlink(name);
  }
}

void cli_signals_stop(void) {
  __atomic_store_n(&stop, 1, __ATOMIC_SEQ_CST);
}

const volatile int *cli_signals_flag(void) {
  return &stop;
}

static void signal_end(int number) {
  cli_signals_unlink();
  signal(number, SIG_DFL);
  raise(number);
}

static void signal_cancel(int number) {
  dyd_engine *e = atomic_exchange(&to_cancel, NULL);
  if (!e) {
    signal_end(number);
    return;
  }
  dyd_engine_cancel(e);
  cli_signals_stop();
}

static void signal_install(int number, void (*handler)(int)) {
  struct sigaction old, action = {.sa_handler = handler, .sa_flags = SA_RESTART};
  sigemptyset(&action.sa_mask);
  /* A parent that has us ignore the signal (nohup) means it. */
  if (sigaction(number, NULL, &old) == 0 && old.sa_handler == SIG_IGN) return;
  sigaction(number, &action, NULL);
}

static void signals_install(void) {
  static const int cancel[] = {SIGINT, SIGTERM, SIGHUP}, end[] = {SIGQUIT, SIGXCPU, SIGABRT};
  for (size_t k = 0; k < sizeof cancel / sizeof *cancel; k++) signal_install(cancel[k], signal_cancel);
  for (size_t k = 0; k < sizeof end / sizeof *end; k++) signal_install(end[k], signal_end);
}

void cli_signals_cancel(dyd_engine *e) {
  atomic_store(&to_cancel, e);
  signals_install();
}

static void signals_exchange(const char *before, const char *now) {
  for (int k = 0; k < MOST_FILES; k++) {
    const char *expected = before;
    if (atomic_compare_exchange_strong(&to_remove[k], &expected, now)) return;
  }
}

void cli_signals_remove(const char *temporary) {
  signals_exchange(NULL, temporary);
  signals_install();
}

void cli_signals_keep(const char *temporary) {
  signals_exchange(temporary, NULL);
}

void cli_signals_hold(sigset_t *before) {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, before);
}

void cli_signals_release(const sigset_t *before) {
  pthread_sigmask(SIG_SETMASK, before, NULL);
}

bool cli_signals_spare(pthread_t *out, void *(*work)(void *), void *user) {
  sigset_t before;
  cli_signals_hold(&before);
  bool done = pthread_create(out, NULL, work, user) == 0;
  cli_signals_release(&before);
  return done;
}
