/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Questions that take a while: nearest points, graphs, tolerances, plans. */
#include "module.h"

#include <stdlib.h>
#include <string.h>

static PyObject *copied(const void *from, size_t size) {
  void *to = malloc(size + 1);
  if (!to) return PyErr_NoMemory();
  if (size) memcpy(to, from, size);
  return dydpy_buffer_new(to, size);
}

/* ---- nearest ---- */

static PyObject *nearest_found(const dyd_index_list *found, bool sure, bool tied, dyd_outcome outcome,
                               const dyd_rect *at) {
  return Py_BuildValue("NNNsN", copied(found->item, found->count * sizeof *found->item), PyBool_FromLong(sure),
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

/* ---- graphs ---- */

/* As three numbers, which numpy reads as it reads pairs. Takes over the list. */
static PyObject *graph_found(dyd_graph_list *list) {
  int32_t *row = malloc((3 * list->count + 1) * sizeof *row);
  for (size_t k = 0; row && k < list->count; k++) {
    const dyd_graph_edge *edge = &list->item[k];
    row[3 * k] = (int32_t)edge->i;
    row[3 * k + 1] = (int32_t)edge->j;
    row[3 * k + 2] = edge->sure;
  }
  size_t size = 3 * list->count * sizeof *row;
  dyd_graph_list_clear(list);
  return row ? dydpy_buffer_new(row, size) : PyErr_NoMemory();
}

PyObject *dydpy_graph(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_graph_list list = {0};
  volatile int cancel = 0;
  int graph;
  dyd_error err;
  dydpy_guard guard;
  if (!PyArg_ParseTuple(args, "i", &graph)) return NULL;
  const dyd_delaunay *pd = dydpy_enter_result(self);
  if (!pd) return NULL;
  dydpy_guard_begin(&guard, NULL, &cancel);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_graph_edges(&list, pd, (dyd_graph)graph, &cancel, &err);
  PyEval_RestoreThread(thread);
  dydpy_leave(self);
  int raised = dydpy_guard_end(&guard);
  if (raised == 0 && st == DYD_OK) return graph_found(&list);
  dyd_graph_list_clear(&list);
  return raised == 0 ? dydpy_raise(&err, st) : NULL;
}

/* ---- tolerance ---- */

/* None where they were not asked for. */
static PyObject *doubles_or_none(const double *value, size_t count) {
  return value ? copied(value, count * sizeof *value) : Py_NewRef(Py_None);
}

static PyObject *tolerance_found(const dyd_tolerance *t, size_t points) {
  const dyd_tolerance_row *row;
  double lo, hi;
  size_t rows = dyd_tolerance_rows(&row, t);
  dyd_tolerance_whole(&lo, &hi, t);
  return Py_BuildValue("N(dd)NN", copied(row, rows * sizeof *row), lo, hi,
                       doubles_or_none(dyd_tolerance_points(t), points),
                       doubles_or_none(dyd_tolerance_chances(t), rows));
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
  int points, box;
  Py_ssize_t max_pairs;
  double sigma;
  mpq_t most;
  if (!PyArg_ParseTuple(args, "Opndp", &up_to, &points, &max_pairs, &sigma, &box)) return NULL;
  dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options), .points = points, .max_pairs = (size_t)max_pairs,
                             .sigma = sigma, .metric = box ? DYD_METRIC_BOX : DYD_METRIC_EUCLID};
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
