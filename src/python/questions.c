/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Questions that take a while: nearest points, tolerances, plans, convergence, the harness. */
#include "module.h"

#include <stdlib.h>
#include <string.h>

/* ---- nearest ---- */

static PyObject *nearest_found(const dyd_index_list *found, bool sure, bool tied, dyd_outcome outcome,
                               const dyd_rect *at) {
  void *copy = malloc((found->count + 1) * sizeof *found->item);
  if (!copy) return PyErr_NoMemory();
  if (found->count) memcpy(copy, found->item, found->count * sizeof *found->item);
  return Py_BuildValue("NNNsN", dydpy_buffer_new(copy, found->count * sizeof *found->item), PyBool_FromLong(sure),
                       PyBool_FromLong(tied), dyd_outcome_text(outcome), dydpy_rect_ends(at));
}

static PyObject *engine_nearest_of(dydpy_engine *self, dyd_stream *at, const dyd_engine_options *o) {
  dyd_index_list found = {0};
  bool sure = false;
  dyd_outcome outcome;
  dyd_error err;
  dydpy_guard guard;
  dydpy_guard_begin(&guard, self->engine, NULL);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_engine_nearest(&found, &sure, &outcome, self->engine, at, o, &err);
  PyEval_RestoreThread(thread);
  dydpy_leave(self);
  int raised = dydpy_guard_end(&guard);
  PyObject *answer = NULL;
  if (st != DYD_OK)
    dydpy_raise(&err, st);
  else if (raised == 0)
    answer = nearest_found(&found, sure, dyd_engine_nearest_tied(self->engine), outcome, dyd_stream_rect(at));
  dyd_index_list_clear(&found);
  return answer;
}

PyObject *dydpy_nearest(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  PyObject *point, *dict, *answer = NULL;
  dydpy_options o;
  dyd_stream *at = NULL;
  if (!PyArg_ParseTuple(args, "OO!", &point, &PyDict_Type, &dict) || dydpy_stream(&at, point, NULL) < 0) return NULL;
  if (dydpy_options_init(&o, self, dict) == 0) {
    if (dydpy_enter_result(self)) answer = engine_nearest_of(self, at, &o.o);
    dydpy_options_clear(&o);
  }
  dyd_stream_free(at);
  return answer;
}

/* ---- tolerance ---- */

static PyObject *copied(const void *from, size_t size) {
  void *to = malloc(size + 1);
  if (!to) return PyErr_NoMemory();
  memcpy(to, from, size);
  return dydpy_buffer_new(to, size);
}

static PyObject *tolerance_found(const dyd_tolerance *t, size_t points) {
  const dyd_tolerance_row *row;
  double lo, hi;
  size_t rows = dyd_tolerance_rows(&row, t);
  const double *radius = dyd_tolerance_points(t);
  dyd_tolerance_whole(&lo, &hi, t);
  return Py_BuildValue("N(dd)N", copied(row, rows * sizeof *row), lo, hi,
                       radius ? copied(radius, points * sizeof *radius) : Py_NewRef(Py_None));
}

static PyObject *tolerance_asked(dydpy_engine *self, const dyd_delaunay *pd, dyd_tolerance_options *o) {
  volatile int cancel = 0;
  dyd_tolerance *t = NULL;
  dyd_error err;
  dydpy_guard guard;
  o->cancel = &cancel;
  dydpy_guard_begin(&guard, NULL, &cancel);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_tolerance_new(&t, pd, o, &err);
  PyEval_RestoreThread(thread);
  int raised = dydpy_guard_end(&guard);
  PyObject *found = NULL;
  if (raised == 0) found = st == DYD_OK ? tolerance_found(t, dyd_engine_count(self->engine)) : dydpy_raise(&err, st);
  dyd_tolerance_free(t);
  return found;
}

PyObject *dydpy_tolerance(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  PyObject *up_to, *found = NULL;
  int points;
  Py_ssize_t max_pairs;
  mpq_t most;
  if (!PyArg_ParseTuple(args, "Opn", &up_to, &points, &max_pairs)) return NULL;
  dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .points = points, .max_pairs = (size_t)max_pairs};
  mpq_init(most);
  if (up_to != Py_None) o.up_to = most;
  if (up_to == Py_None || dydpy_rational(most, up_to) == 0) {
    const dyd_delaunay *pd = dydpy_enter_result(self);
    if (pd) found = tolerance_asked(self, pd, &o);
    if (pd) dydpy_leave(self);
  }
  mpq_clear(most);
  return found;
}

/* ---- plan ---- */

static PyObject *plan_found(const dyd_survey *s) {
  const dyd_survey_row *row;
  size_t open, ties, left, rows = dyd_survey_rows(&row, s);
  dyd_survey_count(&open, &ties, &left, s);
  return Py_BuildValue("N(nnn)", copied(row, rows * sizeof *row), (Py_ssize_t)open, (Py_ssize_t)ties, (Py_ssize_t)left);
}

static PyObject *plan_asked(const dyd_delaunay *pd, dyd_survey_options *o) {
  volatile int cancel = 0;
  dyd_survey *s = NULL;
  dyd_error err;
  dydpy_guard guard;
  o->cancel = &cancel;
  dydpy_guard_begin(&guard, NULL, &cancel);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_survey_new(&s, pd, o, &err);
  PyEval_RestoreThread(thread);
  int raised = dydpy_guard_end(&guard);
  PyObject *found = NULL;
  if (raised == 0) found = st == DYD_OK ? plan_found(s) : dydpy_raise(&err, st);
  dyd_survey_free(s);
  return found;
}

PyObject *dydpy_plan(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  PyObject *accuracy, *window, *site, *found = NULL;
  dyd_rect view;
  bool windowed = false;
  uint32_t only = 0;
  mpq_t exact;
  if (!PyArg_ParseTuple(args, "OOO", &accuracy, &window, &site)) return NULL;
  if (site != Py_None && !dydpy_site(&only, self, PyLong_AsSsize_t(site))) return NULL;
  mpq_init(exact);
  dyd_rect_init(&view);
  bool good = !PyErr_Occurred() && (accuracy == Py_None || dydpy_rational(exact, accuracy) == 0) &&
              dydpy_window(&view, &windowed, window) == 0;
  const dyd_delaunay *pd = good ? dydpy_enter_result(self) : NULL;
  if (pd) {
    dyd_survey_options o = {DYD_SIZED(dyd_survey_options), .window = windowed ? &view : NULL,
                            .site = site != Py_None ? &only : NULL, .accuracy = accuracy != Py_None ? exact : NULL};
    found = plan_asked(pd, &o);
    dydpy_leave(self);
  }
  dyd_rect_clear(&view);
  mpq_clear(exact);
  return found;
}

/* ---- convergence ---- */

/* Writes the table, or draws it, whatever the run returned. */
static PyObject *table_text(const dyd_convergence *table, const char *name, bool times) {
  dyd_format format;
  dydpy_text text;
  dyd_error err;
  dyd_error_clear(&err);
  if (!dyd_format_from_name(&format, name)) return PyErr_Format(PyExc_ValueError, "there is no format \"%s\"", name);
  if (!dydpy_text_open(&text)) return NULL;
  dyd_status st = dyd_format_holds(format, DYD_CONTENT_CONVERGENCE)
                      ? dyd_write_convergence(text.file, table, format, times, &err)
                      : dyd_plot_convergence(text.file, table, format, &err);
  return dydpy_text_close(&text, &err, st);
}

static PyObject *converge_of(dydpy_engine *self, const dyd_engine_options *o, const dyd_converge_options *c,
                             bool times) {
  dyd_convergence table = {DYD_SIZED(dyd_convergence)};
  dyd_error err;
  dydpy_guard guard;
  dydpy_guard_begin(&guard, self->engine, NULL);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_converge_run(&table, self->engine, o, c, &err);
  PyEval_RestoreThread(thread);
  int raised = dydpy_guard_end(&guard);
  PyObject *found = NULL;
  if (st != DYD_OK)
    dydpy_raise(&err, st);
  else if (raised == 0)
    found = Py_BuildValue("sNN", dyd_outcome_text(table.outcome), table_text(&table, "csv", times),
                          table_text(&table, "svg", times));
  dyd_convergence_clear(&table);
  return found;
}

PyObject *dydpy_converge(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  PyObject *dict, *window, *found = NULL;
  int no_voronoi, times;
  bool windowed = false;
  dydpy_options o;
  dyd_rect view;
  if (!PyArg_ParseTuple(args, "O!Opp", &PyDict_Type, &dict, &window, &no_voronoi, &times)) return NULL;
  if (dydpy_options_init(&o, self, dict) < 0) return NULL;
  dyd_rect_init(&view);
  if (dydpy_window(&view, &windowed, window) == 0 && dydpy_enter(self)) {
    const dyd_converge_options c = {DYD_SIZED(dyd_converge_options), .window = windowed ? &view : NULL,
                                    .no_voronoi = no_voronoi};
    found = converge_of(self, &o.o, &c, times);
    dydpy_leave(self);
  }
  dyd_rect_clear(&view);
  dydpy_options_clear(&o);
  return found;
}
