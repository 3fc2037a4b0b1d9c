/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What an engine has found, as numbers and as memory that numpy reads. */
#include "module.h"

#include <stdlib.h>

/* ---- single answers ---- */

PyObject *dydpy_count(PyObject *self, PyObject *none) {
  (void)none;
  return PyLong_FromSize_t(dydpy_points((dydpy_engine *)self));
}

PyObject *dydpy_outcome(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  (void)none;
  if (!dydpy_enter(self)) return NULL;
  dyd_outcome outcome = self->sphere ? dyd_sphere_outcome(self->sphere) : dyd_engine_outcome(self->engine);
  dydpy_leave(self);
  return PyUnicode_FromString(dyd_outcome_text(outcome));
}

static PyObject *spent_name(dyd_budget spent) {
  static const char *const name[] = {"bits", "stages", "calls", "pairs", "seconds"};
  size_t k = (size_t)spent - 1;
  if (k >= sizeof name / sizeof *name) Py_RETURN_NONE;
  return PyUnicode_FromString(name[k]);
}

PyObject *dydpy_counters(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_error err;
  (void)none;
  if (!dydpy_enter(self)) return NULL;
  dyd_status st = dyd_engine_get_counters(&c, self->engine, &err);
  dydpy_leave(self);
  if (st != DYD_OK) return dydpy_raise(&err, st);
  const dydpy_entry entry[] = {
      {"stages", PyLong_FromUnsignedLongLong(c.stages)},
      {"calls", PyLong_FromUnsignedLongLong(c.calls)},
      {"bits_least", PyLong_FromLongLong(c.bits_least)},
      {"bits_most", PyLong_FromLongLong(c.bits_most)},
      {"bits_total", PyLong_FromUnsignedLongLong(c.bits_total)},
      {"undecided_faces", PyLong_FromUnsignedLongLong(c.undecided_faces)},
      {"seconds", PyFloat_FromDouble(c.seconds)},
      {"spent", spent_name(c.spent)},
      {"filter", PyLong_FromUnsignedLongLong(c.delaunay.filter)},
      {"integer", PyLong_FromUnsignedLongLong(c.delaunay.integer)},
      {"exact", PyLong_FromUnsignedLongLong(c.delaunay.exact)},
      {"tie_tests", PyLong_FromUnsignedLongLong(c.ties.tests)},
  };
  return dydpy_dict(entry, sizeof entry / sizeof *entry);
}

PyObject *dydpy_counts(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  size_t count[4];
  (void)none;
  const dyd_delaunay *pd = dydpy_enter_result(self);
  if (!pd) return NULL;
  dyd_delaunay_count(count, pd);
  dydpy_leave(self);
  return Py_BuildValue("nnn", (Py_ssize_t)count[DYD_LEGAL], (Py_ssize_t)count[DYD_INDETERMINATE],
                       (Py_ssize_t)count[DYD_TIE]);
}

PyObject *dydpy_pair_status(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  Py_ssize_t i, j;
  uint32_t first, second;
  if (!PyArg_ParseTuple(args, "nn", &i, &j) || !dydpy_site(&first, self, i) || !dydpy_site(&second, self, j))
    return NULL;
  const dyd_delaunay *pd = dydpy_enter_result(self);
  if (!pd) return NULL;
  dyd_pair_status status = dyd_delaunay_status(pd, first, second);
  dydpy_leave(self);
  return PyLong_FromLong(status);
}

PyObject *dydpy_bounds(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_dyadic area, hausdorff;
  PyObject *both = NULL;
  (void)none;
  if (!dydpy_enter_result(self)) return NULL;
  dyd_dyadic_init(&area);
  dyd_dyadic_init(&hausdorff);
  dyd_status st = dyd_engine_bounds(&area, &hausdorff, self->engine);
  dydpy_leave(self);
  if (st == DYD_OK)
    both = Py_BuildValue("NN", dydpy_dyadic(&area), dydpy_dyadic(&hausdorff));
  else
    dydpy_raise(NULL, st);
  dyd_dyadic_clear(&hausdorff);
  dyd_dyadic_clear(&area);
  return both;
}

PyObject *dydpy_rect(PyObject *object, PyObject *site) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_rect r;
  PyObject *ends = NULL;
  Py_ssize_t number = PyLong_AsSsize_t(site);
  uint32_t i;
  if (PyErr_Occurred() || !dydpy_site(&i, self, number) || !dydpy_enter(self)) return NULL;
  dyd_rect_init(&r);
  bool known = dyd_engine_knows(self->engine, i);
  dyd_status st = known ? dyd_sites_get(&r, dyd_engine_sites(self->engine), i) : DYD_E_ARG;
  dydpy_leave(self);
  if (st == DYD_OK)
    ends = dydpy_rect_ends(&r);
  else
    PyErr_Format(PyExc_RuntimeError, "point %zd has not been asked yet; call refine()", number);
  dyd_rect_clear(&r);
  return ends;
}

PyObject *dydpy_window_of(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_rect r;
  (void)none;
  const dyd_delaunay *pd = dydpy_enter_result(self);
  if (!pd) return NULL;
  dyd_rect_init(&r);
  dyd_status st = dyd_voronoi_window(&r, dyd_delaunay_sites(pd));
  dydpy_leave(self);
  PyObject *ends = st == DYD_OK ? dydpy_rect_ends(&r) : dydpy_raise(NULL, st);
  dyd_rect_clear(&r);
  return ends;
}

/* ---- arrays ---- */

/* Takes over the array. */
static PyObject *array_new(void *item, size_t count, size_t size) {
  return dydpy_buffer_new(item, count * size);
}

typedef dyd_status (*pairs_fn)(dyd_pair_list *out, const dyd_delaunay *pd, dyd_error *err);

static dyd_status pairs_of_boxes(dyd_pair_list *out, const dyd_delaunay *pd, dyd_error *err) {
  (void)err;
  return dyd_delaunay_pairs(out, pd);
}

static PyObject *pairs_found(PyObject *object, pairs_fn find) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_pair_list list = {0};
  dyd_error err;
  const dyd_delaunay *pd = dydpy_enter_result(self);
  if (!pd) return NULL;
  dyd_error_clear(&err);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = find(&list, pd, &err);
  PyEval_RestoreThread(thread);
  dydpy_leave(self);
  if (st == DYD_OK) return array_new(list.item, list.count, sizeof *list.item);
  dyd_pair_list_clear(&list);
  return dydpy_raise(&err, st);
}

PyObject *dydpy_pairs(PyObject *self, PyObject *none) {
  (void)none;
  return pairs_found(self, pairs_of_boxes);
}

PyObject *dydpy_discs(PyObject *self, PyObject *none) {
  (void)none;
  return pairs_found(self, dyd_disc_pairs);
}

PyObject *dydpy_triangles(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_triangle_list list = {0}, beyond = {0};
  (void)none;
  const dyd_delaunay *pd = dydpy_enter_result(self);
  if (!pd) return NULL;
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_delaunay_triangles_as_found(&list, &beyond, pd);
  PyEval_RestoreThread(thread);
  dydpy_leave(self);
  if (st != DYD_OK) return dydpy_raise(NULL, st);
  return Py_BuildValue("NN", array_new(list.item, list.count, sizeof *list.item),
                       array_new(beyond.item, beyond.count, sizeof *beyond.item));
}

PyObject *dydpy_aliases(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  (void)none;
  const dyd_delaunay *pd = dydpy_enter_result(self);
  if (!pd) return NULL;
  size_t n = dyd_sites_count(dyd_delaunay_sites(pd));
  uint32_t *alias = malloc((n + 1) * sizeof *alias);
  for (size_t i = 0; alias && i < n; i++) alias[i] = dyd_delaunay_alias(pd, (uint32_t)i);
  dydpy_leave(self);
  return alias ? array_new(alias, n, sizeof *alias) : PyErr_NoMemory();
}

PyObject *dydpy_hull(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_index_list sure = {0}, possible = {0};
  (void)none;
  const dyd_delaunay *pd = dydpy_enter_result(self);
  if (!pd) return NULL;
  dyd_status st = dyd_delaunay_hull_vertices(&sure, &possible, pd);
  dydpy_leave(self);
  if (st != DYD_OK) return dydpy_raise(NULL, st);
  return Py_BuildValue("NN", array_new(sure.item, sure.count, sizeof *sure.item),
                       array_new(possible.item, possible.count, sizeof *possible.item));
}

PyObject *dydpy_boxes(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  (void)none;
  if (!dydpy_enter(self)) return NULL;
  size_t n = dyd_engine_count(self->engine);
  double *box = malloc((4 * n + 1) * sizeof *box);
  if (box) dyd_sites_copy_d(box, dyd_engine_sites(self->engine), 0, n);
  dydpy_leave(self);
  return box ? array_new(box, 4 * n, sizeof *box) : PyErr_NoMemory();
}

PyObject *dydpy_rects(PyObject *object, PyObject *none) {
  dydpy_engine *self = (dydpy_engine *)object;
  dydpy_text text;
  dyd_error err;
  (void)none;
  dyd_error_clear(&err);
  if (!dydpy_enter(self)) return NULL;
  if (!dydpy_text_open(&text)) {
    dydpy_leave(self);
    return NULL;
  }
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st = dyd_write_rects(text.file, dyd_engine_sites(self->engine), 0, dyd_engine_count(self->engine), &err);
  PyEval_RestoreThread(thread);
  dydpy_leave(self);
  return dydpy_text_close(&text, &err, st);
}
