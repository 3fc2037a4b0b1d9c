/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points into an engine: arrays as they lie in memory, values of any kind, functions, texts. */
#include "module.h"

#include <stdlib.h>
#include <string.h>

/* Does the view hold doubles, `axes` columns of `rows` (or one row for all)? Fills in the columns. */
static bool columns_of(dyd_column out[2], const Py_buffer *view, Py_ssize_t rows) {
  bool doubles = view->itemsize == sizeof(double) && view->format && strcmp(view->format, "d") == 0;
  if (!doubles || view->ndim != 2 || view->shape[1] != 2 || (view->shape[0] != rows && rows >= 0)) {
    PyErr_SetString(PyExc_ValueError, "wanted is an array of doubles of shape (N, 2)");
    return false;
  }
  for (int a = 0; a < 2; a++)
    out[a] =
        (dyd_column){(const double *)(const void *)((const char *)view->buf + a * view->strides[1]), view->strides[0]};
  return true;
}

static dyd_status append_views(dydpy_engine *self, const Py_buffer *xy, const dyd_column at[2],
                               const dyd_column *radius, dyd_error *err) {
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_engine_append_columns(self->engine, (size_t)xy->shape[0], at, radius, err);
  PyEval_RestoreThread(thread);
  return st;
}

PyObject *dydpy_append_array(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  PyObject *points, *radii, *done = NULL;
  Py_buffer xy = {0}, r = {0};
  dyd_column at[2], by[2];
  dyd_error err;
  if (!PyArg_ParseTuple(args, "OO", &points, &radii)) return NULL;
  if (PyObject_GetBuffer(points, &xy, PyBUF_STRIDED_RO | PyBUF_FORMAT) < 0) return NULL;
  bool with = radii != Py_None, good = !with || PyObject_GetBuffer(radii, &r, PyBUF_STRIDED_RO | PyBUF_FORMAT) == 0;
  good = good && columns_of(at, &xy, -1) && (!with || columns_of(by, &r, xy.shape[0])) && dydpy_enter(self);
  if (good) {
    dyd_status st = append_views(self, &xy, at, with ? by : NULL, &err);
    done = dydpy_done(self, st, &err);
  }
  if (r.obj) PyBuffer_Release(&r);
  PyBuffer_Release(&xy);
  return done;
}

/* Four contiguous arrays of doubles. */
PyObject *dydpy_append_boxes(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  const double *end[4];
  Py_ssize_t size[4];
  dyd_error err;
  if (!PyArg_ParseTuple(args, "y#y#y#y#", &end[0], &size[0], &end[1], &size[1], &end[2], &size[2], &end[3], &size[3]))
    return NULL;
  if (size[1] != size[0] || size[2] != size[0] || size[3] != size[0])
    return PyErr_Format(PyExc_ValueError, "arrays of different lengths");
  if (!dydpy_enter(self)) return NULL;
  size_t count = (size_t)size[0] / sizeof(double);
  return dydpy_done(self, dyd_engine_append_boxes(self->engine, count, end[0], end[1], end[2], end[3], &err), &err);
}

/* One coordinate, widened by a radius (NULL: none). */
static int widened_real(dyd_real **out, PyObject *value, PyObject *radius) {
  mpq_t by;
  if (dydpy_real(out, value) < 0) return -1;
  if (!radius) return 0;
  mpq_init(by);
  int status = dydpy_rational(by, radius);
  if (status == 0 && mpq_sgn(by) < 0) {
    PyErr_Format(PyExc_ValueError, "the radius %R is negative", radius);
    status = -1;
  }
  dyd_status st = status == 0 ? dyd_real_widen(out, *out, by) : DYD_OK;
  if (status < 0) dyd_real_free(*out);
  if (status < 0 || st != DYD_OK) *out = NULL;
  if (st != DYD_OK) dydpy_raise(NULL, st);
  mpq_clear(by);
  return status == 0 && st == DYD_OK ? 0 : -1;
}

/* The elements of a sequence of two; false with an exception set. New references, NULL where there is none. */
static bool both_of(PyObject *both[2], PyObject *pair, const char *what) {
  both[0] = both[1] = NULL;
  if (PyUnicode_Check(pair) || PySequence_Size(pair) != 2) {
    PyErr_Clear();
    PyErr_Format(PyExc_ValueError, "%R is no %s; give a pair", pair, what);
    return false;
  }
  both[0] = PySequence_GetItem(pair, 0);
  both[1] = both[0] ? PySequence_GetItem(pair, 1) : NULL;
  return both[1] != NULL;
}

int dydpy_stream(dyd_stream **out, PyObject *point, PyObject *radii) {
  PyObject *xy[2] = {NULL, NULL}, *by[2] = {NULL, NULL};
  dyd_real *side[2] = {NULL, NULL};
  bool good = both_of(xy, point, "point") && (!radii || both_of(by, radii, "pair of radii"));
  for (int a = 0; good && a < 2; a++) good = widened_real(&side[a], xy[a], by[a]) == 0;
  for (int a = 0; a < 2; a++) {
    Py_XDECREF(xy[a]);
    Py_XDECREF(by[a]);
    if (!good) dyd_real_free(side[a]);
  }
  if (!good) return -1;
  dyd_status st = dyd_stream_from_reals(out, side[0], side[1]);
  if (st != DYD_OK) dydpy_raise(NULL, st);
  return st == DYD_OK ? 0 : -1;
}

/* Says which point it was, where the exception is one that takes it. */
static void name_point(size_t point) {
  PyObject *type, *value, *trace;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  PyObject *number = PyLong_FromSize_t(point);
  if (!number || PyObject_SetAttrString(value, "point", number) < 0) PyErr_Clear();
  Py_XDECREF(number);
  PyErr_Restore(type, value, trace);
}

static dyd_status append_streams(dydpy_engine *self, dyd_stream **stream, size_t count, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < count; k++) {
    if (st == DYD_OK)
      st = dyd_engine_append_stream(self->engine, stream[k], err);
    else
      dyd_stream_free(stream[k]);
  }
  return st;
}

/* The points of a list, with a list of pairs of radii (or None): how many could be made; all but for an exception. */
static size_t make_streams(dyd_stream **stream, size_t count, PyObject *list, PyObject *radii) {
  size_t made = 0;
  while (made < count) {
    PyObject *by = radii == Py_None ? NULL : PyList_GetItem(radii, (Py_ssize_t)made);
    if (PyErr_Occurred() || dydpy_stream(&stream[made], PyList_GetItem(list, (Py_ssize_t)made), by) < 0) break;
    made++;
  }
  return made;
}

/* All are understood before the first is added. */
PyObject *dydpy_append_values(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  PyObject *list, *radii;
  dyd_error err;
  if (!PyArg_ParseTuple(args, "O!O", &PyList_Type, &list, &radii)) return NULL;
  size_t count = (size_t)PyList_Size(list);
  dyd_stream **stream = calloc(count + 1, sizeof *stream);
  if (!stream) return PyErr_NoMemory();
  size_t made = make_streams(stream, count, list, radii);
  if (made < count) name_point(dyd_engine_count(self->engine) + made);
  bool good = made == count && dydpy_enter(self);
  dyd_status st = good ? append_streams(self, stream, count, &err) : DYD_E_ARG;
  for (size_t k = 0; !good && k < made; k++) dyd_stream_free(stream[k]);
  free(stream);
  return good ? dydpy_done(self, st, &err) : NULL;
}

/* append_source(n, narrow) */
PyObject *dydpy_append_source(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  Py_ssize_t count;
  PyObject *narrow;
  dyd_source source;
  dyd_error err;
  if (!PyArg_ParseTuple(args, "nO", &count, &narrow)) return NULL;
  if (count < 0) return PyErr_Format(PyExc_ValueError, "a source of %zd points; give 0 or more", count);
  if (!dydpy_source_new(&source, narrow) || PyList_Append(self->functions, narrow) < 0) return NULL;
  return dydpy_enter(self)
             ? dydpy_done(self, dyd_engine_append_source(self->engine, (size_t)count, &source, &err), &err)
             : NULL;
}

/* append_text(text, options): what a points file holds */
PyObject *dydpy_append_text(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_read_options o = {DYD_SIZED(dyd_read_options)};
  const char *text;
  Py_ssize_t length;
  int measured, decimal_comma, skip_missing, merge, degrees;
  dyd_error err;
  if (!PyArg_ParseTuple(args, "y#zpzzzzpppzzp", &text, &length, &o.columns, &measured, &o.radius, &o.radius_columns,
                        &o.id, &o.delimiter, &decimal_comma, &skip_missing, &merge, &o.radius_unit, &o.radius_scale,
                        &degrees))
    return NULL;
  o.measured = measured;
  o.decimal_comma = decimal_comma;
  o.skip_missing = skip_missing;
  o.merge = merge;
  o.degrees = degrees;
  if (!dydpy_enter(self)) return NULL;
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_engine_append_text(self->engine, text, (size_t)length, &o, &err);
  PyEval_RestoreThread(thread);
  return dydpy_done(self, st, &err);
}

/* remeasure(i, (xlo, xhi, ylo, yhi)) */
PyObject *dydpy_remeasure(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  Py_ssize_t number;
  uint32_t site;
  PyObject *ends, *done = NULL;
  bool given;
  dyd_rect r;
  dyd_error err;
  if (!PyArg_ParseTuple(args, "nO", &number, &ends) || !dydpy_site(&site, self, number)) return NULL;
  dyd_rect_init(&r);
  if (dydpy_window(&r, &given, ends) == 0 && dydpy_enter(self))
    done = dydpy_done(self, dyd_engine_remeasure(self->engine, site, &r, &err), &err);
  dyd_rect_clear(&r);
  return done;
}
