/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Ctrl-C ends what the library does in the main thread.
 *
 * Python's own handler of SIGINT only notes the signal; its exception comes when Python runs again, which is after the
 * run. So while the library works another handler stands before it, which also cancels what is at work. */
#include "module.h"

/* Of the main thread, and changed by it alone; the handler reads it. */
static dydpy_guard *volatile innermost;
static struct sigaction python_action;
static unsigned long main_thread;

int dydpy_guard_prepare(void) {
  PyObject *function = dydpy_import("threading", "main_thread");
  PyObject *thread = function ? PyObject_CallNoArgs(function) : NULL;
  PyObject *ident = thread ? PyObject_GetAttrString(thread, "ident") : NULL;
  if (ident) main_thread = PyLong_AsUnsignedLong(ident);
  Py_XDECREF(ident);
  Py_XDECREF(thread);
  Py_XDECREF(function);
  return PyErr_Occurred() ? -1 : 0;
}

static void on_interrupt(int number, siginfo_t *info, void *context) {
  for (dydpy_guard *g = innermost; g; g = g->outer) {
    g->hit = 1;
    if (g->engine) dyd_engine_cancel(g->engine);
    if (g->flag) __atomic_store_n(g->flag, 1, __ATOMIC_SEQ_CST);
  }
  if (python_action.sa_flags & SA_SIGINFO)
    python_action.sa_sigaction(number, info, context);
  else
    python_action.sa_handler(number);
}

/* Does a function of Python's handle the signal? Then it is replaced. */
static bool install_handler(void) {
  struct sigaction ours = {.sa_sigaction = on_interrupt, .sa_flags = SA_SIGINFO};
  sigemptyset(&ours.sa_mask);
  if (sigaction(SIGINT, NULL, &python_action) != 0) return false;
  if (python_action.sa_handler == SIG_DFL || python_action.sa_handler == SIG_IGN) return false;
  ours.sa_flags |= python_action.sa_flags & (SA_ONSTACK | SA_RESTART);
  return sigaction(SIGINT, &ours, NULL) == 0;
}

void dydpy_guard_begin(dydpy_guard *g, dyd_engine *engine, volatile int *flag) {
  *g = (dydpy_guard){.engine = engine, .flag = flag};
  if (PyThread_get_thread_ident() != main_thread) return;
  if (!innermost && !install_handler()) return;
  g->outer = innermost;
  g->on = true;
  innermost = g;
}

int dydpy_guard_end(dydpy_guard *g) {
  if (g->on) innermost = g->outer;
  if (g->on && !innermost) sigaction(SIGINT, &python_action, NULL);
  return PyErr_Occurred() || PyErr_CheckSignals() < 0 ? -1 : 0;
}
