/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Runs stage by stage, as tables. */
#include "module.h"

/* Writes the table, or draws it, whatever the run returned. */
static PyObject *table_text(const dyd_convergence *table, const char *name, bool times) {
  dyd_format format;
  dydpy_text text;
  dyd_error err;
  dyd_error_clear(&err);
  if (!dyd_format_from_name(&format, name)) return PyErr_Format(PyExc_ValueError, "there is no format \"%s\"", name);
  if (!dydpy_text_open(&text)) return NULL;
  const dyd_write_options o = {DYD_SIZED(dyd_write_options), .stages = table, .times = times};
  bool rows = dyd_format_holds(format, DYD_CONTENT_CONVERGENCE);
  dyd_status st = dyd_write(text.file, NULL, rows ? DYD_CONTENT_CONVERGENCE : DYD_CONTENT_PLOT, format, &o, &err);
  return dydpy_text_close(&text, &err, st);
}

PyObject *dydpy_convergence(const dyd_convergence *table, bool times) {
  return Py_BuildValue("sNN", dyd_outcome_text(table->outcome), table_text(table, "csv", times),
                       table_text(table, "svg", times));
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
    found = dydpy_convergence(&table, times);
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
