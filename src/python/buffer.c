/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Memory of the library as an object that numpy reads without a copy. */
#include "module.h"

#include <stdlib.h>

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
