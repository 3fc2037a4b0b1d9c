/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The type Sphere: an Engine whose points are the images of places on a sphere, which another Engine holds. What is
 * said of points here is by the numbers of the places. */
#include "module.h"

#include <stdlib.h>

/* ---- life ---- */

/* With the places entered, and left afterwards. */
static dyd_status globe_make(dydpy_engine *self, dydpy_engine *places, const dyd_sphere_options *o, dyd_error *err) {
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_sphere_new(&self->sphere, places->engine, o, err);
  PyEval_RestoreThread(thread);
  dydpy_leave(places);
  if (st != DYD_OK) return st;
  self->engine = dyd_sphere_engine(self->sphere);
  self->places = Py_NewRef((PyObject *)places);
  return PyErr_Occurred() ? DYD_E_STREAM : DYD_OK;
}

/* Sphere(places, radius, radius_unit, radius_scale), each a text or None */
static PyObject *globe_new(PyTypeObject *type, PyObject *args, PyObject *kwargs) {
  dyd_sphere_options o = {DYD_SIZED(dyd_sphere_options)};
  PyObject *places;
  dyd_error err;
  (void)kwargs;
  if (!PyArg_ParseTuple(args, "Ozzz", &places, &o.radius, &o.radius_unit, &o.radius_scale)) return NULL;
  if (!PyType_IsSubtype(Py_TYPE(places), dydpy_engine_type()))
    return PyErr_Format(PyExc_TypeError, "places are an Engine");
  dydpy_engine *self = (dydpy_engine *)PyType_GenericAlloc(type, 0);
  if (!self) return NULL;
  bool good = dydpy_enter((dydpy_engine *)places);
  dyd_status st = good ? globe_make(self, (dydpy_engine *)places, &o, &err) : DYD_E_ARG;
  if (good && st != DYD_OK) dydpy_raise(&err, st);
  if (st != DYD_OK) Py_CLEAR(self);
  return (PyObject *)self;
}

/* ---- results ---- */

/* Enters; NULL with an exception set when there is no result. */
static const dyd_sphere *globe_enter(PyObject *object) {
  dydpy_engine *self = (dydpy_engine *)object;
  return dydpy_enter_result(self) ? self->sphere : NULL;
}

static PyObject *globe_pairs(PyObject *self, PyObject *none) {
  dyd_pair_list list = {0};
  const dyd_sphere *s = globe_enter(self);
  (void)none;
  if (!s) return NULL;
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_sphere_pairs(&list, s);
  PyEval_RestoreThread(thread);
  dydpy_leave((dydpy_engine *)self);
  return st == DYD_OK ? dydpy_buffer_new(list.item, list.count * sizeof *list.item) : dydpy_raise(NULL, st);
}

/* Corners; who is beyond a side is found in Python. */
static PyObject *globe_triangles(PyObject *self, PyObject *none) {
  dyd_triangle_list list = {0};
  const dyd_sphere *s = globe_enter(self);
  (void)none;
  if (!s) return NULL;
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_sphere_triangles(&list, s);
  PyEval_RestoreThread(thread);
  dydpy_leave((dydpy_engine *)self);
  if (st != DYD_OK) return dydpy_raise(NULL, st);
  return Py_BuildValue("NN", dydpy_buffer_new(list.item, list.count * sizeof *list.item), dydpy_buffer_new(NULL, 0));
}

/* ---- places ---- */

static PyObject *globe_centre(PyObject *self, PyObject *none) {
  uint32_t centre = dyd_sphere_centre(((dydpy_engine *)self)->sphere);
  (void)none;
  if (centre == DYD_NO_PLACE) Py_RETURN_NONE;
  return PyLong_FromUnsignedLong(centre);
}

static PyObject *globe_aliases(PyObject *object, PyObject *none) {
  const dyd_sphere *s = ((dydpy_engine *)object)->sphere;
  size_t n = dyd_engine_count(dyd_sphere_places(s));
  uint32_t *alias = malloc((n + 1) * sizeof *alias);
  (void)none;
  if (!alias) return PyErr_NoMemory();
  for (size_t i = 0; i < n; i++) alias[i] = dyd_sphere_alias(s, (uint32_t)i);
  return dydpy_buffer_new(alias, n * sizeof *alias);
}

static PyObject *globe_rect(PyObject *object, PyObject *site) {
  dydpy_engine *self = (dydpy_engine *)object;
  Py_ssize_t number = PyLong_AsSsize_t(site);
  uint32_t i;
  dyd_rect r;
  if (PyErr_Occurred() || !dydpy_site(&i, self, number) || !dydpy_enter(self)) return NULL;
  dyd_rect_init(&r);
  dyd_status st = dyd_sphere_rect(&r, self->sphere, i);
  dydpy_leave(self);
  PyObject *ends = st == DYD_OK ? dydpy_rect_ends(&r) : dydpy_raise(NULL, st);
  dyd_rect_clear(&r);
  return ends;
}

static PyObject *globe_boxes(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_status st = DYD_OK;
  dyd_rect r;
  (void)none;
  if (!dydpy_enter(self)) return NULL;
  size_t n = dyd_engine_count(dyd_sphere_places(self->sphere));
  double *box = malloc((4 * n + 1) * sizeof *box);
  dyd_rect_init(&r);
  for (uint32_t i = 0; box && i < n && st == DYD_OK; i++) {
    st = dyd_sphere_rect(&r, self->sphere, i);
    if (st == DYD_OK) dyd_rect_get_d(box + 4 * i, &r);
  }
  dyd_rect_clear(&r);
  dydpy_leave(self);
  if (box && st == DYD_OK) return dydpy_buffer_new(box, 4 * n * sizeof *box);
  free(box);
  return dydpy_raise(NULL, box ? st : DYD_E_NOMEM);
}

/* ---- formats ---- */

static PyObject *globe_written(PyObject *object, const char *format, const char *layer, dyd_content of, unsigned epsg) {
  dydpy_text text;
  dyd_error err;
  dyd_format form;
  dyd_content content;
  dyd_write_options o = {DYD_SIZED(dyd_write_options), .epsg = epsg};
  if (!dydpy_form(&form, &content, of, format, layer)) return NULL;
  o.sphere = globe_enter(object);
  if (!o.sphere) return NULL;
  dyd_status st = DYD_E_NOMEM;
  bool opened = dydpy_text_open(&text);
  if (opened) {
    PyThreadState *thread = PyEval_SaveThread();
    st = dyd_write(text.file, NULL, content, form, &o, &err);
    PyEval_RestoreThread(thread);
  }
  dydpy_leave((dydpy_engine *)object);
  return opened ? dydpy_text_close(&text, &err, st) : NULL;
}

static PyObject *globe_write(PyObject *self, PyObject *args) {
  const char *format, *layer;
  PyObject *window;
  unsigned epsg;
  if (!PyArg_ParseTuple(args, "szOI", &format, &layer, &window, &epsg)) return NULL;
  if (window != Py_None) return PyErr_Format(PyExc_ValueError, "a window is a part of the plane; leave it away");
  return globe_written(self, format, layer, DYD_CONTENT_SPHERE, epsg);
}

static PyObject *globe_write_voronoi(PyObject *self, PyObject *args) {
  const char *format, *layer;
  unsigned epsg;
  if (!PyArg_ParseTuple(args, "szI", &format, &layer, &epsg)) return NULL;
  return globe_written(self, format, layer, DYD_CONTENT_SPHERE_VORONOI, epsg);
}

/* ---- the type ---- */

static PyMethodDef globe_methods[] = {
    {"recall", dydpy_recall, METH_VARARGS, "recall(path) -> int: answers of images taken from a trace"},
    {"trace_begin", dydpy_trace_begin, METH_VARARGS, "trace_begin(path, options, None)"},
    {"trace_end", dydpy_trace_end, METH_NOARGS, "trace_end()"},
    {"run", dydpy_run, METH_O, "run(options)"},
    {"cancel", dydpy_cancel, METH_NOARGS, "cancel(): from any thread"},
    {"count", dydpy_count, METH_NOARGS, "count() -> int: points"},
    {"outcome", dydpy_outcome, METH_NOARGS, "outcome() -> str"},
    {"counters", dydpy_counters, METH_NOARGS, "counters() -> dict"},
    {"certificate", dydpy_certificate, METH_VARARGS, "certificate(False, None) -> bytes"},
    {"pairs", globe_pairs, METH_NOARGS, "pairs() -> Buffer of (uint32 i, uint32 j, int32 status), sorted"},
    {"triangles", globe_triangles, METH_NOARGS, "triangles() -> (Buffer of uint32 (T, 3): corners, an empty one)"},
    {"centre", globe_centre, METH_NOARGS, "centre() -> int or None: the point projected from"},
    {"aliases", globe_aliases, METH_NOARGS, "aliases() -> Buffer of uint32 (N,)"},
    {"rect", globe_rect, METH_O, "rect(i) -> four (numerator, denominator), degrees"},
    {"boxes", globe_boxes, METH_NOARGS, "boxes() -> Buffer of doubles (N, 4), degrees, rounded outward"},
    {"write", globe_write, METH_VARARGS, "write(format, layer or None, None, epsg) -> bytes"},
    {"write_voronoi", globe_write_voronoi, METH_VARARGS, "write_voronoi(format, layer or None, epsg) -> bytes"},
    {NULL, NULL, 0, NULL},
};

static PyType_Slot globe_slots[] = {
    {Py_tp_new, globe_new},
    {Py_tp_dealloc, dydpy_object_dealloc},
    {Py_tp_traverse, dydpy_object_traverse},
    {Py_tp_clear, dydpy_object_clear},
    {Py_tp_methods, globe_methods},
    {Py_tp_doc, "A sphere of the library. Use dyadel.delaunay(..., sphere=True)."},
    {0, NULL},
};

PyType_Spec dydpy_sphere_spec = {
    .name = "dyadel._dyadel.Sphere",
    .basicsize = sizeof(dydpy_engine),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_IMMUTABLETYPE,
    .slots = globe_slots,
};
