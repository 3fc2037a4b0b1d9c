/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How the library is called from Python, how failures become exceptions, and memory that Python reads. */
#include "module.h"

#include <stdlib.h>

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

int dydpy_guard_prepare(void) {
  OWNED *function = dydpy_import("threading", "main_thread");
  OWNED *thread = function ? PyObject_CallNoArgs(function) : NULL;
  OWNED *ident = thread ? PyObject_GetAttrString(thread, "ident") : NULL;
  if (ident) main_thread = PyLong_AsUnsignedLong(ident);
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

/* Replaces the handler of the signal if it is a function of Python; returns true then. */
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
  OWNED *module = PyImport_ImportModule(package);
  return module ? PyObject_GetAttrString(module, name) : NULL;
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
  OWNED *type = dydpy_import("dyadel._errors", "Error");
  if (!type) return NULL;
  return PyObject_CallFunction(type, "ssNNNN", told ? err->message : dyd_status_text(status), code_name(status),
                               number_or_none(point, point ? err->point : 0),
                               number_or_none(point, point ? err->stage : 0),
                               number_or_none(told && err->line, told ? err->line : 0),
                               number_or_none(told && err->column, told ? err->column : 0));
}

PyObject *dydpy_raise(const dyd_error *err, dyd_status status) {
  if (PyErr_Occurred()) return NULL;
  if (status == DYD_E_NOMEM && !(err && err->message[0])) return PyErr_NoMemory();
  if (status == DYD_E_NOMEM) return PyErr_Format(PyExc_MemoryError, "%s", err->message);
  OWNED *error = error_new(err, status);
  if (error) PyErr_SetObject((PyObject *)Py_TYPE(error), error);
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

/* Enters the engine. Returns false with RuntimeError if another call is at work, or the engine has no result. */
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

bool dydpy_end(dydpy_call *c, dyd_status st) {
  if (c->thread) PyEval_RestoreThread(c->thread);
  if (c->self) c->self->busy = false;
  if (c->how & (DYDPY_CANCELS | DYDPY_REFINES)) dydpy_guard_end(&c->guard);
  if (st != DYD_OK) dydpy_raise(&c->err, st);
  return !PyErr_Occurred();
}

PyObject *dydpy_end_none(dydpy_call *c, dyd_status st) {
  return dydpy_end(c, st) ? Py_NewRef(Py_None) : NULL;
}

/* ---- texts ---- */

bool dydpy_text_open(dydpy_text *t) {
  *t = (dydpy_text){0};
  t->file = open_memstream(&t->bytes, &t->size);
  if (!t->file) PyErr_NoMemory();
  return t->file != NULL;
}

PyObject *dydpy_text_close(dydpy_text *t, bool good) {
  bool whole = fclose(t->file) == 0;
  PyObject *bytes = NULL;
  if (good && !whole) PyErr_NoMemory();
  if (good && whole) bytes = PyBytes_FromStringAndSize(t->bytes, (Py_ssize_t)t->size);
  free(t->bytes);
  return bytes;
}
