/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Functions of Python that the library calls: points that are narrowed, and progress. */
#include "module.h"

static dyd_status call_narrow(dyd_rect *out, PyObject *narrow, const dyd_request *request, dyd_error *err) {
  PyObject *answer = PyObject_CallFunction(narrow, "nL", (Py_ssize_t)request->point, (long long)request->bits);
  if (!answer) return DYD_E_STREAM;
  dyd_status st = dydpy_answer(out, answer, err);
  Py_DECREF(answer);
  return st;
}

static dyd_status source_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  PyGILState_STATE gil = PyGILState_Ensure();
  dyd_status st = PyErr_Occurred() ? DYD_E_STREAM : call_narrow(out, user, request, err);
  if (PyErr_Occurred()) st = dyd_error_set(err, DYD_E_STREAM, "the function raised an exception");
  PyGILState_Release(gil);
  return st;
}

bool dydpy_source_new(dyd_source *out, PyObject *narrow) {
  if (!PyCallable_Check(narrow)) {
    PyErr_SetString(PyExc_TypeError, "a source needs a function narrow(point, bits)");
    return false;
  }
  *out = (dyd_source){DYD_SIZED(dyd_source), .narrow = source_narrow, .user = narrow};
  return true;
}

void dydpy_progress(void *user, const dyd_progress *p) {
  const dydpy_progress_user *u = user;
  if (u->trace) dyd_trace_stage(u->trace, p);
  if (!u->function || u->function == Py_None) return;
  PyGILState_STATE gil = PyGILState_Ensure();
  PyObject *done = NULL;
  if (!PyErr_Occurred())
    done = PyObject_CallFunction(u->function, "{s:K,s:L,s:n,s:n,s:n,s:n,s:n,s:d}", "stage",
                                 (unsigned long long)p->stage, "bits", (long long)p->bits, "points",
                                 (Py_ssize_t)p->sites, "legal", (Py_ssize_t)p->count[DYD_LEGAL], "indeterminate",
                                 (Py_ssize_t)p->count[DYD_INDETERMINATE], "ties", (Py_ssize_t)p->count[DYD_TIE],
                                 "undecided_faces", (Py_ssize_t)p->undecided_faces, "seconds", p->seconds);
  if (!done) dyd_engine_cancel(u->engine);
  Py_XDECREF(done);
  PyGILState_Release(gil);
}
