/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The formats of the command, in memory; certificates and their check. */
#include "module.h"

#include <stdlib.h>

bool dydpy_text_open(dydpy_text *t) {
  *t = (dydpy_text){0};
  t->file = open_memstream(&t->bytes, &t->size);
  if (!t->file) PyErr_NoMemory();
  return t->file != NULL;
}

PyObject *dydpy_text_close(dydpy_text *t, const dyd_error *err, dyd_status status) {
  bool whole = fclose(t->file) == 0;
  PyObject *bytes = NULL;
  if (status < 0)
    dydpy_raise(err, status);
  else if (!whole)
    PyErr_NoMemory();
  else if (!PyErr_Occurred())
    bytes = PyBytes_FromStringAndSize(t->bytes, (Py_ssize_t)t->size);
  free(t->bytes);
  return bytes;
}

PyObject *dydpy_formats(PyObject *module, PyObject *none) {
  PyObject *list = PyList_New(0);
  (void)module, (void)none;
  for (int k = 0; list && dyd_format_name((dyd_format)k); k++) {
    PyObject *row = Py_BuildValue("ssN", dyd_format_name((dyd_format)k), dyd_format_about((dyd_format)k),
                                  PyBool_FromLong(dyd_format_is_binary((dyd_format)k)));
    if (!row || PyList_Append(list, row) < 0) Py_CLEAR(list);
    Py_XDECREF(row);
  }
  return list;
}

bool dydpy_form(dyd_format *format, dyd_content *layer, dyd_content of, const char *name, const char *layer_name) {
  *layer = of;
  if (!dyd_format_from_name(format, name)) {
    PyErr_Format(PyExc_ValueError, "there is no format \"%s\"; see dyadel.formats()", name);
    return false;
  }
  if (!layer_name || dyd_layer_from_name(layer, of, layer_name)) return true;
  PyErr_Format(PyExc_ValueError, "there is no layer \"%s\"", layer_name);
  return false;
}

/* What a writer takes, from the arguments of Python. */
typedef struct text_order {
  dyd_format format;
  dyd_content layer;
  dyd_rect window;
  bool windowed;
  unsigned epsg;
  dydpy_text text;
} text_order;

/* Begins a text about the result; false with an exception set and nothing to end. */
static bool order_begin(text_order *t, dydpy_engine *self, PyObject *window) {
  dyd_rect_init(&t->window);
  if (dydpy_window(&t->window, &t->windowed, window) == 0 && dydpy_enter_result(self)) {
    if (dydpy_text_open(&t->text)) return true;
    dydpy_leave(self);
  }
  dyd_rect_clear(&t->window);
  return false;
}

static PyObject *order_end(text_order *t, dydpy_engine *self, const dyd_error *err, dyd_status st) {
  dydpy_leave(self);
  dyd_rect_clear(&t->window);
  return dydpy_text_close(&t->text, err, st);
}

PyObject *dydpy_write(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  const char *format, *layer;
  PyObject *window;
  text_order t;
  dyd_error err;
  if (!PyArg_ParseTuple(args, "szOI", &format, &layer, &window, &t.epsg)) return NULL;
  if (!dydpy_form(&t.format, &t.layer, DYD_CONTENT_DELAUNAY, format, layer) || !order_begin(&t, self, window))
    return NULL;
  const dyd_write_options o = {DYD_SIZED(dyd_write_options), .window = t.windowed ? &t.window : NULL, .epsg = t.epsg};
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_write(t.text.file, self->engine, t.layer, t.format, &o, &err);
  PyEval_RestoreThread(thread);
  return order_end(&t, self, &err, st);
}

PyObject *dydpy_write_voronoi(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  const char *format, *layer;
  PyObject *window, *bits;
  text_order t;
  dyd_error err;
  volatile int cancel = 0;
  dydpy_guard guard;
  if (!PyArg_ParseTuple(args, "szOOI", &format, &layer, &window, &bits, &t.epsg)) return NULL;
  dyd_write_options o = {DYD_SIZED(dyd_write_options), .cancel = &cancel, .flatten_set = bits != Py_None};
  if (o.flatten_set) o.flatten_bits = PyLong_AsLongLong(bits);
  if (PyErr_Occurred() || !dydpy_form(&t.format, &t.layer, DYD_CONTENT_VORONOI, format, layer) ||
      !order_begin(&t, self, window))
    return NULL;
  o.window = t.windowed ? &t.window : NULL;
  o.epsg = t.epsg;
  dydpy_guard_begin(&guard, NULL, &cancel);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_write(t.text.file, self->engine, t.layer, t.format, &o, &err);
  PyEval_RestoreThread(thread);
  dydpy_guard_end(&guard);
  return order_end(&t, self, &err, st == DYD_CAPPED ? DYD_E_ARG : st);
}

/* ---- certificates ---- */

PyObject *dydpy_certificate(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  int diagram;
  PyObject *window;
  text_order t;
  dyd_error err;
  if (!PyArg_ParseTuple(args, "pO", &diagram, &window) || !order_begin(&t, self, window)) return NULL;
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = diagram
                      ? dyd_write_voronoi_certificate(t.text.file, self->engine, t.windowed ? &t.window : NULL, &err)
                  : self->sphere ? dyd_write_sphere_certificate(t.text.file, self->sphere, &err)
                                 : dyd_write_certificate(t.text.file, self->engine, &err);
  PyEval_RestoreThread(thread);
  return order_end(&t, self, &err, st);
}

static PyObject *report_of(const dyd_certificate_report *r) {
  const dydpy_entry entry[] = {
      {"outcome", PyUnicode_FromString(r->outcome)},
      {"goal", PyUnicode_FromString(r->goal)},
      {"goal_bits", PyLong_FromLongLong(r->goal_bits)},
      {"capped", PyBool_FromLong(r->capped)},
      {"points", PyLong_FromSize_t(r->sites)},
      {"aliases", PyLong_FromSize_t(r->aliases)},
      {"legal", PyLong_FromSize_t(r->legal)},
      {"legal_unproved", PyLong_FromSize_t(r->legal_unproved)},
      {"indeterminate", PyLong_FromSize_t(r->indeterminate)},
      {"ties", PyLong_FromSize_t(r->tie)},
      {"ties_unproved", PyLong_FromSize_t(r->ties_unproved)},
      {"unproved", PyLong_FromUnsignedLongLong(r->unproved)},
      {"triangles", PyLong_FromSize_t(r->triangles)},
      {"diagram", PyBool_FromLong(r->diagram)},
      {"bound", PyBool_FromLong(r->bound)},
      {"unlocated", PyLong_FromSize_t(r->unlocated)},
      {"aliases_unproved", PyLong_FromSize_t(r->aliases_unproved)},
      {"proved", PyBool_FromLong(r->gaps == 0)},
  };
  return dydpy_dict(entry, sizeof entry / sizeof *entry);
}

/* With the engine entered, if there is one. */
static PyObject *verify_with(FILE *in, dydpy_engine *of, const dyd_sphere_options *sphere,
                             const dyd_engine_options *o) {
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  dydpy_guard guard;
  dydpy_guard_begin(&guard, of ? of->engine : NULL, NULL);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = of ? dyd_verify_certificate_on(&report, NULL, in, of->engine, false, sphere, o, &err)
                     : dyd_verify_certificate(&report, in, &err);
  PyEval_RestoreThread(thread);
  if (dydpy_guard_end(&guard) < 0) return NULL;
  return st == DYD_OK ? report_of(&report) : dydpy_raise(&err, st);
}

PyObject *dydpy_verify(PyObject *module, PyObject *args) {
  char *bytes;
  Py_ssize_t length;
  PyObject *of, *dict, *report = NULL;
  dydpy_options o;
  int sphere;
  dyd_sphere_options on = {DYD_SIZED(dyd_sphere_options)};
  (void)module;
  if (!PyArg_ParseTuple(args, "s#OpzzzO!", &bytes, &length, &of, &sphere, &on.radius, &on.radius_unit, &on.radius_scale,
                        &PyDict_Type, &dict))
    return NULL;
  dydpy_engine *self = of == Py_None ? NULL : (dydpy_engine *)of;
  if (dydpy_options_init(&o, self, dict) < 0) return NULL;
  FILE *in = fmemopen(bytes, length ? (size_t)length : 1, "r");
  if (!in)
    PyErr_NoMemory();
  else if (!self || dydpy_enter(self)) {
    report = verify_with(in, self, sphere ? &on : NULL, &o.o);
    if (self) dydpy_leave(self);
  }
  if (in) fclose(in);
  dydpy_options_clear(&o);
  return report;
}
