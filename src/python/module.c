/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The module dyadel._dyadel: its types, how the library is called from them, how failures become exceptions. */
#include "module.h"

#include <stdlib.h>

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

/* ---- memory of the library as an object that numpy reads without a copy ---- */

typedef struct buffer {
  PyObject_HEAD void *bytes;
  size_t size;
} buffer;

static void buffer_dealloc(PyObject *self) {
  PyTypeObject *type = Py_TYPE(self);
  free(((buffer *)self)->bytes);
  PyObject_Free(self);
  Py_DECREF(type);
}

static int buffer_get(PyObject *self, Py_buffer *view, int flags) {
  buffer *b = (buffer *)self;
  return PyBuffer_FillInfo(view, self, b->bytes, (Py_ssize_t)b->size, 0, flags);
}

static PyType_Slot buffer_slots[] = {
    {Py_tp_dealloc, buffer_dealloc},
    {Py_bf_getbuffer, buffer_get},
    {Py_tp_doc, "Memory of the library; memoryview and numpy read it without a copy."},
    {0, NULL},
};

static PyType_Spec buffer_spec = {
    .name = "dyadel._dyadel.Buffer",
    .basicsize = sizeof(buffer),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION | Py_TPFLAGS_IMMUTABLETYPE,
    .slots = buffer_slots,
};

static PyTypeObject *buffer_type(void) {
  static PyTypeObject *type; /* one for the life of the process, as the module */
  if (!type) type = (PyTypeObject *)PyType_FromSpec(&buffer_spec);
  return type;
}

PyObject *dydpy_buffer_new(void *bytes, size_t size) {
  PyTypeObject *type = buffer_type();
  buffer *b = type ? PyObject_New(buffer, type) : NULL;
  if (!b) {
    free(bytes);
    return NULL;
  }
  b->bytes = bytes;
  b->size = size;
  return (PyObject *)b;
}

/* ---- Ctrl-C ----
 *
 * Python's own handler of SIGINT only notes the signal; its exception comes when Python runs again, which is after the
 * run. So while the library works another handler stands before it, which also cancels the work. */

/* Of the main thread, and changed by it alone; the handler reads it. */
static dydpy_guard *volatile innermost;

static struct sigaction python_action;

static unsigned long main_thread;

static int guard_prepare(void) {
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

/* ---- calls ----
 *
 * One at a time: a second one, from another thread or from a callback, is refused. */

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

/* None for an unknown number. */
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

/* Enters; false with RuntimeError when another call is at work, or there is no result. */
static bool call_enter(dydpy_call *c) {
  dydpy_engine *self = c->self;
  const bool wants = c->how & DYDPY_RESULT;
  c->pd = wants && !self->busy && self->engine ? dyd_engine_delaunay(self->engine) : NULL;
  if (self->busy)
    PyErr_SetString(PyExc_RuntimeError,
                    "this triangulation is at work in another call; wait for it, or use one of its own");
  else if (!self->engine)
    PyErr_SetString(PyExc_RuntimeError, "this engine is gone");
  else if (wants && !c->pd)
    PyErr_SetString(PyExc_RuntimeError, "there is no result yet; call refine()");
  else
    return self->busy = true;
  return false;
}

bool dydpy_begin(dydpy_call *c, PyObject *self, int how) {
  c->self = (dydpy_engine *)self;
  c->cancel = 0;
  c->how = how;
  dyd_error_clear(&c->err);
  if (self && !call_enter(c)) return false;
  if (how & (DYDPY_CANCELS | DYDPY_REFINES))
    dydpy_guard_begin(&c->guard, self && how & DYDPY_REFINES ? c->self->engine : NULL, &c->cancel);
  c->thread = how & DYDPY_HOLDS ? NULL : PyEval_SaveThread();
  return true;
}

/* Images are named by their places. */
bool dydpy_end(dydpy_call *c, dyd_status st) {
  if (c->thread) PyEval_RestoreThread(c->thread);
  if (c->self) c->self->busy = false;
  if (c->how & (DYDPY_CANCELS | DYDPY_REFINES)) dydpy_guard_end(&c->guard);
  if (c->self && c->self->sphere && c->err.point != DYD_NO_POINT)
    c->err.point = dyd_sphere_place(c->self->sphere, (uint32_t)c->err.point);
  if (st != DYD_OK) dydpy_raise(&c->err, st);
  return !PyErr_Occurred();
}

PyObject *dydpy_end_none(dydpy_call *c, dyd_status st) {
  return dydpy_end(c, st) ? Py_NewRef(Py_None) : NULL;
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
    {"certificate", dydpy_certificate, METH_VARARGS, "certificate(False, None) -> bytes"},
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
  PyObject *module = PyModule_Create(&module_definition);
  if (!module) return NULL;
  if (guard_prepare() < 0 || add_types(module) < 0 || PyModule_AddStringConstant(module, "version", dyd_version()) < 0)
    Py_CLEAR(module);
  return module;
}
