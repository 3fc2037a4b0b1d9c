/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The end of engines and spheres, and what the garbage collector asks of them. */
#include "module.h"

int dydpy_object_traverse(PyObject *self, visitproc visit, void *arg) {
  Py_VISIT(Py_TYPE(self));
  Py_VISIT(((dydpy_engine *)self)->functions);
  Py_VISIT(((dydpy_engine *)self)->places);
  return 0;
}

/* The engine first: nobody calls the functions then. That of a sphere is the sphere's. */
int dydpy_object_clear(PyObject *object) {
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

void dydpy_object_dealloc(PyObject *self) {
  PyTypeObject *type = Py_TYPE(self);
  PyObject_GC_UnTrack(self);
  dydpy_object_clear(self);
  PyObject_GC_Del(self);
  Py_DECREF(type);
}
