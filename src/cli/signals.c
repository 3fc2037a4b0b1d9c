/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Ctrl-C: the first one cancels the run, so that what is known is written; the next one ends the process.
 *
 * Handlers touch only lock-free objects, dyd_engine_cancel (async-signal-safe by contract) and unlink. */
#include "cli.h"
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <unistd.h>

static _Atomic(dyd_engine *) to_cancel;
static _Atomic(const char *) to_remove;
static volatile int stop;

void cli_signals_unlink(void) {
  const char *name = atomic_load(&to_remove);
  if (name) unlink(name);
}

void cli_signals_stop(void) {
  __atomic_store_n(&stop, 1, __ATOMIC_SEQ_CST);
}

const volatile int *cli_signals_flag(void) {
  return &stop;
}

static void signal_handle(int number) {
  dyd_engine *e = atomic_exchange(&to_cancel, NULL);
  if (e) {
    dyd_engine_cancel(e);
    cli_signals_stop();
    return;
  }
  cli_signals_unlink();
  signal(number, SIG_DFL);
  raise(number);
}

static void signal_install(int number) {
  struct sigaction old, action = {.sa_handler = signal_handle, .sa_flags = SA_RESTART};
  sigemptyset(&action.sa_mask);
  /* A parent that has us ignore the signal (nohup) means it. */
  if (sigaction(number, NULL, &old) == 0 && old.sa_handler == SIG_IGN) return;
  sigaction(number, &action, NULL);
}

void cli_signals_cancel(dyd_engine *e) {
  atomic_store(&to_cancel, e);
  signal_install(SIGINT);
  signal_install(SIGTERM);
}

void cli_signals_remove(const char *temporary) {
  atomic_store(&to_remove, temporary);
  atomic_store(&to_cancel, NULL);
  signal_install(SIGINT);
  signal_install(SIGTERM);
}
