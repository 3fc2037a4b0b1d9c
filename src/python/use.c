/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How an engine is used: one call at a time, a second one, from another thread or from a callback, is refused; and how
 * failures of the library become exceptions. */
#include "module.h"

PyObject *dydpy_import(const char *package, const char *name) {
  PyObject *module = PyImport_ImportModule(package);
  PyObject *found = module ? PyObject_GetAttrString(module, name) : NULL;
  Py_XDECREF(module);
  return found;
}

static const char *code_name(dyd_status status) {
  static const char *const name[] = {"nomem",   "argument", "range", "parse",        "domain",
                                     "nesting", "stream",   "io",    "contradiction"};
  size_t k = (size_t)(-1 - (int)status);
  return status < 0 && k < sizeof name / sizeof *name ? name[k] : status == DYD_CAPPED ? "capped" : "cancelled";
}

/* None for what is not known. */
static PyObject *number_or_none(bool known, unsigned long long number) {
  return known ? PyLong_FromUnsignedLongLong(number) : Py_NewRef(Py_None);
}

/* dyadel.Error(message, code, point, stage, line, column) */
static PyObject *error_new(const dyd_error *err, dyd_status status) {
  bool told = err && err->message[0], point = told && err->point != DYD_NO_POINT;
  PyObject *type = dydpy_import("dyadel._errors", "Error");
  if (!type) return NULL;
  PyObject *error = PyObject_CallFunction(type, "ssNNNN", told ? err->message : dyd_status_text(status),
                                          code_name(status), number_or_none(point, point ? err->point : 0),
                                          number_or_none(point, point ? err->stage : 0),
                                          number_or_none(told && err->line, told ? err->line : 0),
                                          number_or_none(told && err->column, told ? err->column : 0));
  Py_DECREF(type);
  return error;
}

PyObject *dydpy_raise(const dyd_error *err, dyd_status status) {
  if (PyErr_Occurred()) return NULL;
  if (status == DYD_E_NOMEM && !(err && err->message[0])) return PyErr_NoMemory();
  if (status == DYD_E_NOMEM) return PyErr_Format(PyExc_MemoryError, "%s", err->message);
  PyObject *error = error_new(err, status);
  if (error) PyErr_SetObject((PyObject *)Py_TYPE(error), error);
  Py_XDECREF(error);
  return NULL;
}

PyObject *dydpy_dict(const dydpy_entry *entry, size_t count) {
  PyObject *dict = PyDict_New();
  for (size_t k = 0; k < count; k++) {
    if (dict && (!entry[k].value || PyDict_SetItemString(dict, entry[k].name, entry[k].value) < 0)) Py_CLEAR(dict);
    Py_XDECREF(entry[k].value);
  }
  return dict;
}

size_t dydpy_points(const dydpy_engine *self) {
  if (!self->engine) return 0;
  return dyd_engine_count(self->sphere ? dyd_sphere_places(self->sphere) : self->engine);
}

bool dydpy_site(uint32_t *out, dydpy_engine *self, Py_ssize_t number) {
  size_t count = dydpy_points(self);
  bool there = number >= 0 && (size_t)number < count;
  if (there)
    *out = (uint32_t)number;
  else if (!PyErr_Occurred())
    PyErr_Format(PyExc_IndexError, "there is no point %zd; there are %zu, counted from 0", number, count);
  return there;
}

bool dydpy_enter(dydpy_engine *self) {
  if (self->busy || !self->engine) {
    PyErr_SetString(PyExc_RuntimeError,
                    self->busy ? "this triangulation is at work in another call; wait for it, or use one of its own"
                               : "this engine is gone");
    return false;
  }
  self->busy = true;
  return true;
}

void dydpy_leave(dydpy_engine *self) {
  self->busy = false;
}

const dyd_delaunay *dydpy_enter_result(dydpy_engine *self) {
  if (!dydpy_enter(self)) return NULL;
  const dyd_delaunay *pd = dyd_engine_delaunay(self->engine);
  if (pd) return pd;
  dydpy_leave(self);
  PyErr_SetString(PyExc_RuntimeError, "there is no result yet; call refine()");
  return NULL;
}

/* Images are named by their places. */
PyObject *dydpy_done(dydpy_engine *self, dyd_status st, const dyd_error *err) {
  dydpy_leave(self);
  if (st == DYD_OK) Py_RETURN_NONE;
  if (!self->sphere || !err || err->point == DYD_NO_POINT) return dydpy_raise(err, st);
  dyd_error own = *err;
  own.point = dyd_sphere_place(self->sphere, (uint32_t)err->point);
  return dydpy_raise(&own, st);
}
