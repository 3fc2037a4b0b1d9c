/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The harness of monotone refinement over points of Python. */
#include "module.h"

#include <stdlib.h>

/* make: a function without arguments that returns a new Engine; kept: all of them, as they own the functions that their
 * engines call. */
typedef struct harness_user {
  PyObject *make, *kept, *progress;
  volatile int cancel;
} harness_user;

/* Takes the library's engine out of the object that make() returned. */
static dyd_status harness_take(dyd_engine **out, harness_user *u) {
  PyObject *made = PyErr_Occurred() ? NULL : PyObject_CallNoArgs(u->make);
  if (!made) return DYD_E_STREAM;
  dydpy_engine *self = (dydpy_engine *)made;
  *out = self->engine;
  self->engine = NULL;
  int status = PyList_Append(u->kept, made);
  Py_DECREF(made);
  return status < 0 ? DYD_E_NOMEM : DYD_OK;
}

static dyd_status harness_open(dyd_engine **out, void *user, dyd_error *err) {
  PyGILState_STATE gil = PyGILState_Ensure();
  dyd_status st = harness_take(out, user);
  if (st != DYD_OK) dyd_error_set(err, st, "the points cannot be made");
  PyGILState_Release(gil);
  return st;
}

static void harness_progress(void *user, unsigned schedule, unsigned of) {
  harness_user *u = user;
  PyGILState_STATE gil = PyGILState_Ensure();
  bool fine = !PyErr_Occurred() && PyErr_CheckSignals() == 0;
  PyObject *done = fine && u->progress != Py_None ? PyObject_CallFunction(u->progress, "II", schedule, of) : NULL;
  if (PyErr_Occurred()) u->cancel = 1;
  Py_XDECREF(done);
  PyGILState_Release(gil);
}

/* ---- what comes in, what goes out ---- */

/* [(stage, point, bits), ...]; NULL with an exception set, or for None. */
static dyd_check_move *moves_of(size_t *count, PyObject *list) {
  *count = 0;
  if (list == Py_None) return NULL;
  Py_ssize_t size = PyList_Size(list);
  dyd_check_move *move = size < 0 ? NULL : calloc((size_t)size + 1, sizeof *move);
  if (!move && size >= 0) PyErr_NoMemory();
  for (Py_ssize_t k = 0; move && k < size; k++) {
    long long bits;
    Py_ssize_t stage, point;
    bool good = PyArg_ParseTuple(PyList_GetItem(list, k), "nnL", &stage, &point, &bits);
    if (good && (stage < 1 || point < 0 || stage > UINT32_MAX || point > UINT32_MAX))
      PyErr_SetString(PyExc_ValueError, "a move is (stage, point, bits), stages from 1, points from 0");
    if (PyErr_Occurred()) {
      free(move);
      return NULL;
    }
    move[k] = (dyd_check_move){(uint32_t)stage, (uint32_t)point, bits};
  }
  *count = size < 0 ? 0 : (size_t)size;
  return move;
}

static PyObject *moves_new(const dyd_check_report *r) {
  PyObject *list = PyList_New(0);
  for (size_t k = 0; list && k < r->moves; k++) {
    PyObject *move = Py_BuildValue("IIL", r->move[k].stage, r->move[k].point, (long long)r->move[k].bits);
    if (!move || PyList_Append(list, move) < 0) Py_CLEAR(list);
    Py_XDECREF(move);
  }
  return list;
}

static PyObject *harness_found(const dyd_check_report *r) {
  const dydpy_entry entry[] = {
      {"fault", PyUnicode_FromString(dyd_check_fault_text(r->fault))},
      {"message", PyUnicode_FromString(r->message)},
      {"seed", PyLong_FromUnsignedLongLong(r->seed)},
      {"base_bits", PyLong_FromLongLong(r->base_bits)},
      {"moves", moves_new(r)},
      {"schedules", PyLong_FromUnsignedLongLong(r->schedules)},
      {"stages", PyLong_FromUnsignedLongLong(r->stages)},
      {"pairs", PyLong_FromUnsignedLongLong(r->pairs)},
      {"cells", PyLong_FromUnsignedLongLong(r->cells)},
  };
  return dydpy_dict(entry, sizeof entry / sizeof *entry);
}

static PyObject *harness_run(harness_user *u, dyd_check_options *o, const dyd_check_move *move, size_t moves) {
  dyd_check_report report = {DYD_SIZED(dyd_check_report)};
  dyd_error err;
  dydpy_guard guard;
  dyd_error_clear(&err);
  o->cancel = &u->cancel;
  o->progress = harness_progress;
  o->progress_user = u;
  dydpy_guard_begin(&guard, NULL, &u->cancel);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = move ? dyd_check_replay(&report, harness_open, u, move, moves, o, &err)
                       : dyd_check_run(&report, harness_open, u, o, &err);
  PyEval_RestoreThread(thread);
  int raised = dydpy_guard_end(&guard);
  PyObject *found = NULL;
  if (st < 0)
    dydpy_raise(&err, st);
  else if (raised == 0)
    found = harness_found(&report);
  dyd_check_report_clear(&report);
  return found;
}

PyObject *dydpy_check(PyObject *module, PyObject *args) {
  harness_user u = {.progress = Py_None};
  dyd_check_options o = {DYD_SIZED(dyd_check_options)};
  unsigned long long seed;
  long long base_bits, max_bits, slack_bits;
  PyObject *list;
  size_t count;
  (void)module;
  if (!PyArg_ParseTuple(args, "OKIILLLdOO", &u.make, &seed, &o.schedules, &o.stages, &base_bits, &max_bits, &slack_bits,
                        &o.seconds, &list, &u.progress))
    return NULL;
  o.seed = seed;
  o.base_bits = base_bits;
  o.max_bits = max_bits;
  o.slack_bits = slack_bits;
  dyd_check_move *move = moves_of(&count, list);
  if (PyErr_Occurred()) return NULL;
  u.kept = PyList_New(0);
  PyObject *found = u.kept ? harness_run(&u, &o, move, count) : NULL;
  Py_XDECREF(u.kept);
  free(move);
  return found;
}
