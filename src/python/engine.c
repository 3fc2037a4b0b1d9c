/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The type Engine: its life, and its methods, which the other files have. One call at a time: a second one, from
 * another thread or from a callback, is refused. */
#include "module.h"

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

/* ---- the type ---- */

static PyMethodDef engine_methods[] = {
    {"append_array", dydpy_append_array, METH_VARARGS,
     "append_array(xy, radius): doubles of shape (N, 2) both; radius may be None"},
    {"append_boxes", dydpy_append_boxes, METH_VARARGS,
     "append_boxes(xlo, xhi, ylo, yhi): contiguous arrays of doubles"},
    {"append_values", dydpy_append_values, METH_VARARGS, "append_values([(x, y), ...], [(rx, ry), ...] or None)"},
    {"append_source", dydpy_append_source, METH_VARARGS, "append_source(n, narrow)"},
    {"append_text", dydpy_append_text, METH_VARARGS,
     "append_text(bytes, columns, measured, radius, radius_columns, id, delimiter, decimal_comma, skip_missing, "
     "merge, radius_unit, radius_scale, degrees)"},
    {"remeasure", dydpy_remeasure, METH_VARARGS, "remeasure(i, (xlo, xhi, ylo, yhi))"},
    {"recall", dydpy_recall, METH_VARARGS, "recall(path) -> int: answers taken from a trace"},
    {"trace_begin", dydpy_trace_begin, METH_VARARGS, "trace_begin(path, options, (window, no_voronoi) or None)"},
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
    {"graph", dydpy_graph, METH_VARARGS, "graph(number) -> Buffer of (uint32 i, uint32 j, int32 sure), sorted"},
    {"triangles", dydpy_triangles, METH_NOARGS,
     "triangles() -> (Buffer, Buffer) of uint32 (T, 3): corners, neighbours"},
    {"aliases", dydpy_aliases, METH_NOARGS, "aliases() -> Buffer of uint32 (N,)"},
    {"hull", dydpy_hull, METH_NOARGS, "hull() -> (Buffer, Buffer) of uint32: surely, possibly"},
    {"bounds", dydpy_bounds, METH_NOARGS, "bounds() -> (area, hausdorff) as (numerator, denominator)"},
    {"boxes", dydpy_boxes, METH_NOARGS, "boxes() -> Buffer of doubles (N, 4): xlo, xhi, ylo, yhi, rounded outward"},
    {"rect", dydpy_rect, METH_O, "rect(i) -> four (numerator, denominator)"},
    {"rects", dydpy_rects, METH_NOARGS, "rects() -> bytes: a line XLO XHI YLO YHI of exact numbers for each point"},
    {"window", dydpy_window_of, METH_NOARGS, "window() -> four (numerator, denominator): the default one of diagrams"},
    {"write", dydpy_write, METH_VARARGS, "write(format, layer or None, window or None, epsg) -> bytes"},
    {"write_voronoi", dydpy_write_voronoi, METH_VARARGS,
     "write_voronoi(format, layer or None, window or None, flatten_bits or None, epsg) -> bytes"},
    {"certificate", dydpy_certificate, METH_VARARGS, "certificate(diagram, window or None) -> bytes"},
    {"nearest", dydpy_nearest, METH_VARARGS, "nearest((x, y), options) -> (Buffer of uint32, sure, outcome, at)"},
    {"tolerance", dydpy_tolerance, METH_VARARGS,
     "tolerance(up_to or None, points, max_pairs, sigma, box) -> (rows, (lo, hi), radii or None, chances or None)"},
    {"plan", dydpy_plan, METH_VARARGS,
     "plan(accuracy or None, window or None, site or None) -> (rows, (open, ties, left))"},
    {"converge", dydpy_converge, METH_VARARGS,
     "converge(options, window or None, no_voronoi, times) -> (outcome, csv, svg)"},
    {NULL, NULL, 0, NULL},
};

static PyType_Slot engine_slots[] = {
    {Py_tp_new, engine_new},
    {Py_tp_dealloc, dydpy_object_dealloc},
    {Py_tp_traverse, dydpy_object_traverse},
    {Py_tp_clear, dydpy_object_clear},
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
