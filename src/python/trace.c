/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Traces of runs: each answer of a point is in its file before the next one is asked for. */
#include "module.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Raises OSError with the name as the user gave it. */
static FILE *file_open(const char *path, const char *mode, const char *given) {
  FILE *file = fopen(path, mode);
  PyObject *name = file ? NULL : PyUnicode_DecodeFSDefault(given);
  if (name) PyErr_SetFromErrnoWithFilenameObject(PyExc_OSError, name);
  Py_XDECREF(name);
  return file;
}

enum { SYNC_SECONDS = 5 };

/* Begins the trace in a file beside its place, with the answers of an earlier one, and puts it there. What is there and
 * no regular file is written as it is. */
static dyd_status trace_place(dydpy_engine *self, const char *path, const char *beside, const dyd_engine_options *o,
                              const dyd_converge_options *converge, dyd_error *err) {
  struct stat info;
  const bool direct = stat(path, &info) == 0 && !S_ISREG(info.st_mode);
  self->trace_file = file_open(direct ? path : beside, "w", path);
  if (!self->trace_file) return DYD_E_IO;
  setvbuf(self->trace_file, NULL, _IOLBF, BUFSIZ);
  dyd_status st = dyd_trace_new(&self->trace, self->trace_file, self->engine, NULL, o, converge, err);
  if (st == DYD_OK) st = dyd_trace_sync(self->trace, SYNC_SECONDS, err);
  if (st == DYD_OK && !direct && rename(beside, path) != 0) st = dyd_error_set(err, DYD_E_IO, strerror(errno));
  if (st == DYD_OK) return st;
  dyd_error unused;
  dydpy_trace_close(self, &unused);
  if (!direct) unlink(beside);
  return st;
}

/* With the engine entered. converge: None, or a window and whether bounds of the diagram are left out. */
static dyd_status trace_open(dydpy_engine *self, const char *path, const dyd_engine_options *o,
                             const dyd_converge_options *converge, dyd_error *err) {
  const size_t size = strlen(path) + sizeof ".new";
  char *beside = malloc(size);
  if (!beside) return dyd_error_set(err, DYD_E_NOMEM, dyd_status_text(DYD_E_NOMEM));
  snprintf(beside, size, "%s.new", path);
  dyd_status st = trace_place(self, path, beside, o, converge, err);
  free(beside);
  return st;
}

/* trace_begin(path, options, (window, no_voronoi) or None) */
PyObject *dydpy_trace_begin(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  const char *path;
  PyObject *dict, *converge, *window = Py_None, *done = NULL;
  int no_voronoi = 0;
  bool windowed = false;
  dydpy_options o;
  dyd_rect view;
  dyd_error err;
  dyd_error_clear(&err);
  if (!PyArg_ParseTuple(args, "yO!O", &path, &PyDict_Type, &dict, &converge)) return NULL;
  if (converge != Py_None && !PyArg_ParseTuple(converge, "Op", &window, &no_voronoi)) return NULL;
  if (dydpy_options_init(&o, self, dict) < 0) return NULL;
  dyd_rect_init(&view);
  if (dydpy_window(&view, &windowed, window) == 0 && dydpy_enter(self)) {
    const dyd_converge_options c = {DYD_SIZED(dyd_converge_options), .window = windowed ? &view : NULL,
                                    .no_voronoi = no_voronoi};
    done = dydpy_done(self, trace_open(self, path, &o.o, converge != Py_None ? &c : NULL, &err), &err);
  }
  dyd_rect_clear(&view);
  dydpy_options_clear(&o);
  return done;
}

dyd_status dydpy_trace_close(dydpy_engine *self, dyd_error *err) {
  FILE *file = self->trace_file;
  dyd_status st = self->trace ? dyd_trace_end(self->trace, dyd_engine_outcome(self->engine), err) : DYD_OK;
  self->trace = NULL;
  self->trace_file = NULL;
  if (file && fclose(file) != 0 && st == DYD_OK) st = dyd_error_set(err, DYD_E_IO, "the trace cannot be written");
  return st;
}

PyObject *dydpy_trace_end(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_error err;
  (void)none;
  dyd_error_clear(&err);
  return dydpy_enter(self) ? dydpy_done(self, dydpy_trace_close(self, &err), &err) : NULL;
}

/* recall(path) -> answers taken */
PyObject *dydpy_recall(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_recall_report report = {DYD_SIZED(dyd_recall_report)};
  const char *path;
  dyd_error err;
  if (!PyArg_ParseTuple(args, "y", &path)) return NULL;
  FILE *in = file_open(path, "r", path);
  if (!in) return NULL;
  dyd_status st = DYD_E_ARG;
  bool entered = dydpy_enter(self);
  if (entered) st = dyd_trace_recall(&report, self->engine, in, NULL, &err);
  fclose(in);
  if (!entered) return NULL;
  dydpy_leave(self);
  return st == DYD_OK ? PyLong_FromSize_t(report.answers) : dydpy_raise(&err, st);
}

/* replay(path) -> (outcome, csv, svg) */
PyObject *dydpy_replay(PyObject *module, PyObject *args) {
  dyd_convergence table = {DYD_SIZED(dyd_convergence)};
  const char *path;
  dyd_error err;
  (void)module;
  if (!PyArg_ParseTuple(args, "y", &path)) return NULL;
  FILE *in = file_open(path, "r", path);
  if (!in) return NULL;
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_trace_replay(&table, in, NULL, &err);
  PyEval_RestoreThread(thread);
  fclose(in);
  PyObject *found = st == DYD_OK ? dydpy_convergence(&table, false) : dydpy_raise(&err, st);
  dyd_convergence_clear(&table);
  return found;
}
