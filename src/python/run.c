/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Options from a dict, and runs. */
#include "module.h"

#include <stddef.h>

typedef enum option_kind {
  OPTION_ENUM,
  OPTION_BITS,
  OPTION_COUNT,
  OPTION_U64,
  OPTION_UNSIGNED,
  OPTION_SECONDS,
  OPTION_BOOL
} option_kind;

static const struct {
  const char *name;
  option_kind kind;
  size_t at;
} option_table[] = {
    {"goal", OPTION_ENUM, offsetof(dyd_engine_options, goal)},
    {"goal_bits", OPTION_BITS, offsetof(dyd_engine_options, goal_bits)},
    {"schedule", OPTION_ENUM, offsetof(dyd_engine_options, schedule)},
    {"start_bits", OPTION_BITS, offsetof(dyd_engine_options, start_bits)},
    {"step_bits", OPTION_BITS, offsetof(dyd_engine_options, step_bits)},
    {"max_bits", OPTION_BITS, offsetof(dyd_engine_options, max_bits)},
    {"max_stages", OPTION_U64, offsetof(dyd_engine_options, max_stages)},
    {"max_calls", OPTION_U64, offsetof(dyd_engine_options, max_calls)},
    {"max_pairs", OPTION_COUNT, offsetof(dyd_engine_options, max_pairs)},
    {"seconds", OPTION_SECONDS, offsetof(dyd_engine_options, seconds)},
    {"threads", OPTION_UNSIGNED, offsetof(dyd_engine_options, threads)},
    {"tie_bits", OPTION_BITS, offsetof(dyd_engine_options, tie_bits)},
    {"no_ties", OPTION_BOOL, offsetof(dyd_engine_options, no_ties)},
    {"max_bytes", OPTION_U64, offsetof(dyd_engine_options, max_bytes)},
};

static void option_set(void *at, option_kind kind, PyObject *value) {
  if (kind == OPTION_ENUM) *(int *)at = (int)PyLong_AsLong(value);
  if (kind == OPTION_BITS) *(int64_t *)at = PyLong_AsLongLong(value);
  if (kind == OPTION_COUNT) *(size_t *)at = PyLong_AsSize_t(value);
  if (kind == OPTION_U64) *(uint64_t *)at = PyLong_AsUnsignedLongLong(value);
  if (kind == OPTION_UNSIGNED) *(unsigned *)at = (unsigned)PyLong_AsUnsignedLong(value);
  if (kind == OPTION_SECONDS) *(double *)at = PyFloat_AsDouble(value);
  if (kind == OPTION_BOOL) *(bool *)at = PyObject_IsTrue(value) > 0;
}

/* Doubles, one for each point. */
static void option_costs(dydpy_options *out, dydpy_engine *self, PyObject *cost) {
  if (PyObject_GetBuffer(cost, &out->cost, PyBUF_SIMPLE) < 0) return;
  size_t given = (size_t)out->cost.len / sizeof(double), count = self ? dydpy_points(self) : 0;
  out->o.cost = out->cost.buf;
  if (given != count) PyErr_Format(PyExc_ValueError, "%zu costs of %zu points; give one for each", given, count);
}

int dydpy_options_init(dydpy_options *out, dydpy_engine *self, PyObject *dict) {
  bool given = false;
  dyd_rect_init(&out->window);
  out->cost = (Py_buffer){0};
  dyd_engine_options_init(&out->o);
  out->o.start_bits = 0;
  for (size_t k = 0; k < sizeof option_table / sizeof *option_table; k++) {
    PyObject *value = PyDict_GetItemString(dict, option_table[k].name);
    if (value) option_set((char *)&out->o + option_table[k].at, option_table[k].kind, value);
  }
  PyObject *window = PyDict_GetItemString(dict, "window"), *progress = PyDict_GetItemString(dict, "progress");
  PyObject *cost = PyDict_GetItemString(dict, "cost");
  if (!PyErr_Occurred() && cost) option_costs(out, self, cost);
  if (!PyErr_Occurred() && window) dydpy_window(&out->window, &given, window);
  if (given) out->o.window = &out->window;
  out->progress = (dydpy_progress_user){progress, self ? self->engine : NULL, self ? self->trace : NULL};
  if (self && (self->trace || (progress && progress != Py_None))) {
    out->o.progress = dydpy_progress;
    out->o.progress_user = &out->progress;
    out->o.trace = self->trace ? dyd_trace_step : NULL;
    out->o.trace_user = self->trace;
  }
  if (!PyErr_Occurred()) return 0;
  dydpy_options_clear(out);
  return -1;
}

void dydpy_options_clear(dydpy_options *o) {
  PyBuffer_Release(&o->cost);
  dyd_rect_clear(&o->window);
}

/* One run; *again: an interrupt ended it, and whoever handles interrupts wants to go on. */
static dyd_status run_once(bool *again, dydpy_engine *self, const dyd_engine_options *o, dyd_error *err) {
  dyd_outcome outcome;
  dydpy_guard guard;
  dydpy_guard_begin(&guard, self->engine, NULL);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st =
      self->sphere ? dyd_sphere_run(&outcome, self->sphere, o, err) : dyd_engine_run(&outcome, self->engine, o, err);
  PyEval_RestoreThread(thread);
  bool cancelled = outcome == DYD_OUTCOME_CANCELLED, ours = guard.hit || self->late;
  int raised = dydpy_guard_end(&guard);
  self->late = guard.hit && !cancelled;
  *again = raised == 0 && cancelled && ours;
  return st;
}

/* run(options) */
PyObject *dydpy_run(PyObject *object, PyObject *dict) {
  dydpy_engine *self = (dydpy_engine *)object;
  dydpy_options o;
  dyd_error err;
  dyd_status st = DYD_OK;
  if (!PyDict_Check(dict)) return PyErr_Format(PyExc_TypeError, "options are a dict");
  if (dydpy_options_init(&o, self, dict) < 0) return NULL;
  bool again = dydpy_enter(self), entered = again;
  while (again) st = run_once(&again, self, &o.o, &err);
  dydpy_options_clear(&o);
  if (!entered) return NULL;
  PyObject *done = dydpy_done(self, st, &err);
  if (done && PyErr_Occurred()) Py_CLEAR(done);
  return done;
}

PyObject *dydpy_cancel(PyObject *self, PyObject *none) {
  (void)none;
  if (((dydpy_engine *)self)->engine) dyd_engine_cancel(((dydpy_engine *)self)->engine);
  Py_RETURN_NONE;
}
