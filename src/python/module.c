/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The module dyadel._dyadel: its types and its functions. */
#include "module.h"

/* ---- the end of engines and spheres; their part in garbage collection ---- */

static int object_traverse(PyObject *self, visitproc visit, void *arg) {
  Py_VISIT(Py_TYPE(self));
  Py_VISIT(((dydpy_engine *)self)->functions);
  Py_VISIT(((dydpy_engine *)self)->places);
  return 0;
}

/* The engine first: it calls the functions. The engine of a sphere belongs to the sphere. */
static int object_clear(PyObject *object) {
  dydpy_engine *self = (dydpy_engine *)object;
  dydpy_trace_close(self, NULL);
  if (!self->sphere) dyd_engine_free(self->engine);
  dyd_sphere_free(self->sphere);
  self->engine = NULL;
  self->sphere = NULL;
  Py_CLEAR(self->places);
  Py_CLEAR(self->functions);
  return 0;
}

static void object_dealloc(PyObject *self) {
  PyTypeObject *type = Py_TYPE(self);
  PyObject_GC_UnTrack(self);
  object_clear(self);
  PyObject_GC_Del(self);
  Py_DECREF(type);
}

/* ---- the type Engine; the other files have its methods ---- */

static PyObject *engine_new(PyTypeObject *type, PyObject *args, PyObject *kwargs) {
  (void)args, (void)kwargs;
  dydpy_engine *self = (dydpy_engine *)PyType_GenericAlloc(type, 0);
  if (!self) return NULL;
  self->functions = PyList_New(0);
  if (!self->functions || dyd_engine_new(&self->engine) != DYD_OK) {
    Py_DECREF(self);
    return PyErr_Occurred() ? NULL : PyErr_NoMemory();
  }
  return (PyObject *)self;
}

static PyMethodDef engine_methods[] = {
    {"append_array", dydpy_append_array, METH_VARARGS,
     "append_array(xy, radius): doubles of shape (N, 2) both; radius may be None"},
    {"append_boxes", dydpy_append_boxes, METH_VARARGS,
     "append_boxes(xlo, xhi, ylo, yhi): contiguous arrays of doubles"},
    {"append_values", dydpy_append_values, METH_VARARGS, "append_values([(x, y), ...], [(rx, ry), ...] or None)"},
    {"append_source", dydpy_append_source, METH_VARARGS, "append_source(n, narrow)"},
    {"append_text", dydpy_append_text, METH_VARARGS, "append_text(bytes, options): fields of dyd_read_options by name"},
    {"name", dydpy_name, METH_VARARGS, "name(rows, ids or None): the points added last"},
    {"carried", dydpy_carried, METH_NOARGS, "carried() -> {name: [text of each point]}"},
    {"names", dydpy_names, METH_NOARGS, "names() -> (Buffer of int64 rows, list of ids or None)"},
    {"confidence", dydpy_confidence, METH_VARARGS,
     "confidence(text, n) -> (probability, k, n), stated of n points that come next; (None, 0): the one stated, or "
     "None"},
    {"remeasure", dydpy_remeasure, METH_VARARGS, "remeasure(i, (xlo, xhi, ylo, yhi))"},
    {"recall", dydpy_recall, METH_VARARGS, "recall(path) -> int: answers taken from a trace"},
    {"trace_begin", dydpy_trace_begin, METH_VARARGS, "trace_begin(path, options, (window, of) or None)"},
    {"trace_end", dydpy_trace_end, METH_NOARGS, "trace_end(): nothing where there is no trace"},
    {"run", dydpy_run, METH_O, "run(options)"},
    {"cancel", dydpy_cancel, METH_NOARGS, "cancel(): from any thread"},
    {"count", dydpy_count, METH_NOARGS, "count() -> int: points"},
    {"outcome", dydpy_outcome, METH_NOARGS, "outcome() -> str"},
    {"counters", dydpy_counters, METH_NOARGS, "counters() -> dict"},
    {"counts", dydpy_counts, METH_NOARGS, "counts() -> (legal, indeterminate, tie)"},
    {"pair_status", dydpy_pair_status, METH_VARARGS, "pair_status(i, j) -> int"},
    {"pairs", dydpy_pairs, METH_NOARGS, "pairs() -> Buffer of (uint32 i, uint32 j, int32 status), sorted"},
    {"discs", dydpy_discs, METH_NOARGS, "discs() -> the same of the discs in the squares"},
    {"graph", dydpy_graph, METH_VARARGS,
     "graph(number, options) -> (Buffer of (uint32 i, uint32 j, int32 certain), sorted, outcome)"},
    {"triangles", dydpy_triangles, METH_NOARGS,
     "triangles() -> (Buffer, Buffer) of uint32 (T, 3): corners, neighbours"},
    {"aliases", dydpy_aliases, METH_NOARGS, "aliases() -> Buffer of uint32 (N,)"},
    {"hull", dydpy_hull, METH_NOARGS, "hull() -> (Buffer, Buffer) of uint32: certain, possible"},
    {"bounds", dydpy_bounds, METH_NOARGS, "bounds() -> (area, hausdorff) as (numerator, denominator)"},
    {"boxes", dydpy_boxes, METH_NOARGS, "boxes() -> Buffer of doubles (N, 4): xlo, xhi, ylo, yhi, rounded outward"},
    {"rect", dydpy_rect, METH_O, "rect(i) -> four (numerator, denominator)"},
    {"piece", dydpy_piece, METH_VARARGS, "piece('disc', 'bisector' or 'hull') -> bytes: of the rectangles as they are"},
    {"rects", dydpy_rects, METH_NOARGS, "rects() -> bytes: a line XLO XHI YLO YHI of exact numbers for each point"},
    {"window", dydpy_window_of, METH_NOARGS, "window() -> four (numerator, denominator): the default one of diagrams"},
    {"cells", dydpy_cells, METH_VARARGS,
     "cells(window or None, flatten_bits or None, discs) -> (Buffer of dyd_cell_ring, Buffer of doubles xy, Buffer of "
     "doubles "
     "(N, 2) areas, bits, area, hausdorff or None, window)"},
    {"frame", dydpy_frame, METH_VARARGS,
     "frame(window or None, flatten_bits, discs) -> (vertices, boxes, ends, sites, faces, edges, rays): see dyd_frame"},
    {"tiles", dydpy_tiles, METH_VARARGS,
     "tiles(window or None, flatten_bits) -> (sites, offsets, xy, areas, bounds, rounding): see dyd_tiles"},
    {"exact_area", dydpy_exact_area, METH_VARARGS, "exact_area(i, window or None) -> (numerator, denominator) or None"},
    {"write", dydpy_write, METH_VARARGS, "write(format, layer or None, window or None, epsg) -> bytes"},
    {"write_voronoi", dydpy_write_voronoi, METH_VARARGS,
     "write_voronoi(format, layer or None, window or None, flatten_bits or None, epsg, discs) -> bytes"},
    {"certificate", dydpy_certificate, METH_VARARGS, "certificate(diagram, window or None, discs) -> bytes"},
    {"nearest", dydpy_nearest, METH_VARARGS, "nearest((x, y), options) -> (Buffer of uint32, certain, outcome, at)"},
    {"locate", dydpy_locate, METH_VARARGS,
     "locate(doubles (M, 2)) -> (Buffer of uint32 (M, 3) corners, Buffer of int32 dyd_truth): see dyd_delaunay_locate"},
    {"nearest_places", dydpy_nearest_places, METH_VARARGS,
     "nearest_places(doubles (M, 2)) -> (Buffer of uint32 points, Buffer of int64 ends (M,), Buffer of bool (M,))"},
    {"corners", dydpy_corners, METH_VARARGS,
     "corners(doubles (M, 2)) -> the same of the corners of the triangle around each place, of any choice"},
    {"tolerance", dydpy_tolerance, METH_VARARGS,
     "tolerance(up_to or None, points, max_pairs, sigma, box) -> (rows, (lo, hi), radii or None, chances or None)"},
    {"plan", dydpy_plan, METH_VARARGS,
     "plan(accuracy or None, window or None, site or None) -> (rows, (undecided, ties, left))"},
    {"converge", dydpy_converge, METH_VARARGS,
     "converge(options, window or None, of, times, hindsight, (from, to) or None) -> (outcome, csv, svg)"},
    {NULL, NULL, 0, NULL},
};

static PyType_Slot engine_slots[] = {
    {Py_tp_new, engine_new},
    {Py_tp_dealloc, object_dealloc},
    {Py_tp_traverse, object_traverse},
    {Py_tp_clear, object_clear},
    {Py_tp_methods, engine_methods},
    {Py_tp_doc, "An engine of the library. Use dyadel.delaunay."},
    {0, NULL},
};

static PyType_Spec engine_spec = {
    .name = "dyadel._dyadel.Engine",
    .basicsize = sizeof(dydpy_engine),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_IMMUTABLETYPE,
    .slots = engine_slots,
};

PyTypeObject *dydpy_engine_type(void) {
  static PyTypeObject *type; /* one for the life of the process, as the module */
  if (!type) type = (PyTypeObject *)PyType_FromSpec(&engine_spec);
  return type;
}

/* ---- the type Sphere: an Engine whose points are the images of places on a sphere, which another Engine holds ---- */

/* Sphere(places, radius, radius_unit, radius_scale), each a text or None */
static PyObject *globe_new(PyTypeObject *type, PyObject *args, PyObject *kwargs) {
  dyd_sphere_options o = {DYD_SIZED(dyd_sphere_options)};
  PyObject *places;
  dydpy_call c;
  (void)kwargs;
  if (!PyArg_ParseTuple(args, "Ozzz", &places, &o.radius, &o.radius_unit, &o.radius_scale)) return NULL;
  if (!PyType_IsSubtype(Py_TYPE(places), dydpy_engine_type()))
    return PyErr_Format(PyExc_TypeError, "places are an Engine");
  dydpy_engine *self = (dydpy_engine *)PyType_GenericAlloc(type, 0);
  if (!self) return NULL;
  if (!dydpy_begin(&c, places, 0) || !dydpy_end(&c, dyd_sphere_new(&self->sphere, c.self->engine, &o, &c.err))) {
    Py_DECREF(self);
    return NULL;
  }
  self->engine = dyd_sphere_engine(self->sphere);
  self->places = Py_NewRef(places);
  return (PyObject *)self;
}

static PyMethodDef globe_methods[] = {
    {"recall", dydpy_recall, METH_VARARGS, "recall(path) -> int: answers of images taken from a trace"},
    {"trace_begin", dydpy_trace_begin, METH_VARARGS, "trace_begin(path, options, None)"},
    {"trace_end", dydpy_trace_end, METH_NOARGS, "trace_end()"},
    {"run", dydpy_run, METH_O, "run(options)"},
    {"cancel", dydpy_cancel, METH_NOARGS, "cancel(): from any thread"},
    {"count", dydpy_count, METH_NOARGS, "count() -> int: points"},
    {"outcome", dydpy_outcome, METH_NOARGS, "outcome() -> str"},
    {"counters", dydpy_counters, METH_NOARGS, "counters() -> dict"},
    {"certificate", dydpy_certificate, METH_VARARGS, "certificate(False, None, False) -> bytes"},
    {"pairs", dydpy_pairs, METH_NOARGS, "pairs() -> Buffer of (uint32 i, uint32 j, int32 status), sorted"},
    {"triangles", dydpy_triangles, METH_NOARGS, "triangles() -> (Buffer of uint32 (T, 3): corners, an empty one)"},
    {"centre", dydpy_centre, METH_NOARGS, "centre() -> int or None: the point projected from"},
    {"aliases", dydpy_aliases, METH_NOARGS, "aliases() -> Buffer of uint32 (N,)"},
    {"rect", dydpy_rect, METH_O, "rect(i) -> four (numerator, denominator), degrees"},
    {"boxes", dydpy_boxes, METH_NOARGS, "boxes() -> Buffer of doubles (N, 4), degrees, rounded outward"},
    {"write", dydpy_write, METH_VARARGS, "write(format, layer or None, None, epsg) -> bytes"},
    {"write_voronoi", dydpy_write_voronoi, METH_VARARGS,
     "write_voronoi(format, layer or None, None, None, epsg) -> bytes"},
    {NULL, NULL, 0, NULL},
};

static PyType_Slot globe_slots[] = {
    {Py_tp_new, globe_new},
    {Py_tp_dealloc, object_dealloc},
    {Py_tp_traverse, object_traverse},
    {Py_tp_clear, object_clear},
    {Py_tp_methods, globe_methods},
    {Py_tp_doc, "A sphere of the library. Use dyadel.delaunay(..., sphere=True)."},
    {0, NULL},
};

static PyType_Spec globe_spec = {
    .name = "dyadel._dyadel.Sphere",
    .basicsize = sizeof(dydpy_engine),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_IMMUTABLETYPE,
    .slots = globe_slots,
};

/* ---- the module ---- */

static PyMethodDef module_functions[] = {
    {"formats", dydpy_formats, METH_NOARGS, "formats() -> [(name, what it is, is it binary), ...]"},
    {"replay", dydpy_replay, METH_VARARGS, "replay(path) -> (outcome, csv, svg)"},
    {"verify", dydpy_verify, METH_VARARGS,
     "verify(certificate, engine or None, sphere, radius, unit, scale, options) -> dict"},
    {"check", dydpy_check, METH_VARARGS,
     "check(make, seed, schedules, stages, base_bits, max_bits, slack_bits, seconds, moves or None, progress or None) "
     "-> dict"},
    {NULL, NULL, 0, NULL},
};

static PyModuleDef module_definition = {
    PyModuleDef_HEAD_INIT, .m_name = "dyadel._dyadel",    .m_doc = "What dyadel does in C; use the package dyadel.",
    .m_size = -1,          .m_methods = module_functions,
};

static int add_types(PyObject *module) {
  PyTypeObject *engine = dydpy_engine_type();
  PyObject *sphere = engine ? PyType_FromSpec(&globe_spec) : NULL;
  int status = sphere ? PyModule_AddObjectRef(module, "Engine", (PyObject *)engine) : -1;
  if (status == 0) status = PyModule_AddObjectRef(module, "Sphere", sphere);
  Py_XDECREF(sphere);
  return status;
}

PyMODINIT_FUNC PyInit__dyadel(void); /* for the import of Python alone */

PyMODINIT_FUNC PyInit__dyadel(void) {
  if (PyInterpreterState_GetID(PyInterpreterState_Get()) != 0) {
    PyErr_SetString(PyExc_ImportError, "dyadel and NumPy run in the main interpreter; use processes instead of others");
    return NULL;
  }
  PyObject *module = PyModule_Create(&module_definition);
  if (!module) return NULL;
  if (dydpy_guard_prepare() < 0 || add_types(module) < 0 ||
      PyModule_AddStringConstant(module, "version", dyd_version()) < 0)
    Py_CLEAR(module);
  return module;
}
