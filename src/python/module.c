/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The module dyadel._dyadel: its types and its functions. */
#include "module.h"

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

/* The slots and the specification of a type over a dydpy_engine. */
#define TYPE(type, title, doc)                                                                                         \
  static PyType_Slot type##_slots[] = {                                                                                \
      {Py_tp_new, type##_new},                                                                                         \
      {Py_tp_dealloc, object_dealloc},                                                                                 \
      {Py_tp_traverse, object_traverse},                                                                               \
      {Py_tp_clear, object_clear},                                                                                     \
      {Py_tp_methods, type##_methods},                                                                                 \
      {Py_tp_doc, doc},                                                                                                \
      {0, NULL},                                                                                                       \
  };                                                                                                                   \
  static PyType_Spec type##_spec = {                                                                                   \
      .name = "dyadel._dyadel." title,                                                                                 \
      .basicsize = sizeof(dydpy_engine),                                                                               \
      .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_HAVE_GC | Py_TPFLAGS_IMMUTABLETYPE,                                     \
      .slots = type##_slots,                                                                                           \
  }

#define ROW(name, how, doc) {#name, dydpy_##name, METH_##how, doc},
#define NO_ROW(name, how, doc)

static PyMethodDef engine_methods[] = {
#define ENGINE ROW
#define BOTH ROW
#define SPHERE NO_ROW
#define MODULE NO_ROW
#include "methods.def"
    {NULL, NULL, 0, NULL},
};

TYPE(engine, "Engine", "An engine of the library. Use dyadel.delaunay.");

/* Borrowed; NULL with an exception set. */
static PyTypeObject *engine_type(void) {
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
  if (!PyType_IsSubtype(Py_TYPE(places), engine_type())) return PyErr_Format(PyExc_TypeError, "places are an Engine");
  dydpy_engine *self = (dydpy_engine *)PyType_GenericAlloc(type, 0);
  if (!self) return NULL;
  if (!dydpy_begin(&c, places, 0) || !dydpy_end(&c, dyd_sphere_new(&self->sphere, c.self->engine, &o, &c.err))) {
    Py_DECREF(self);
    return NULL;
  }
  self->engine = dyd_sphere_images(self->sphere);
  self->places = Py_NewRef(places);
  return (PyObject *)self;
}

static PyMethodDef globe_methods[] = {
#undef ENGINE
#define ENGINE NO_ROW
#undef SPHERE
#define SPHERE ROW
#include "methods.def"
    {NULL, NULL, 0, NULL},
};

TYPE(globe, "Sphere", "A sphere of the library. Use dyadel.delaunay(..., sphere=True).");

/* ---- the module ---- */

static PyMethodDef module_functions[] = {
#undef SPHERE
#define SPHERE NO_ROW
#undef BOTH
#define BOTH NO_ROW
#undef MODULE
#define MODULE ROW
#include "methods.def"
    {NULL, NULL, 0, NULL},
};

static PyModuleDef module_definition = {
    PyModuleDef_HEAD_INIT, .m_name = "dyadel._dyadel",    .m_doc = "What dyadel does in C; use the package dyadel.",
    .m_size = -1,          .m_methods = module_functions,
};

static int add_types(PyObject *module) {
  PyTypeObject *engine = engine_type();
  OWNED *sphere = engine ? PyType_FromSpec(&globe_spec) : NULL;
  int status = sphere ? PyModule_AddObjectRef(module, "Engine", (PyObject *)engine) : -1;
  return status == 0 ? PyModule_AddObjectRef(module, "Sphere", sphere) : status;
}

PyMODINIT_FUNC PyInit__dyadel(void); /* for the import of Python alone */

PyMODINIT_FUNC PyInit__dyadel(void) {
  if (PyInterpreterState_GetID(PyInterpreterState_Get()) != 0) {
    PyErr_SetString(PyExc_ImportError, "dyadel and NumPy run in the main interpreter; use processes instead of others");
    return NULL;
  }
  PyObject *module = PyModule_Create(&module_definition);
  if (!module) return NULL;
  if (dydpy_guard_prepare() < 0 || add_types(module) < 0 ||
      PyModule_AddStringConstant(module, "version", dyd_version()) < 0)
    Py_CLEAR(module);
  return module;
}
