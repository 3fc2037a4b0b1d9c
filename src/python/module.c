/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The module dyadel._dyadel: its type and its functions. */
#include "module.h"

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
  PyObject *sphere = engine ? PyType_FromSpec(&dydpy_sphere_spec) : NULL;
  int status = sphere ? PyModule_AddObjectRef(module, "Engine", (PyObject *)engine) : -1;
  if (status == 0) status = PyModule_AddObjectRef(module, "Sphere", sphere);
  Py_XDECREF(sphere);
  return status;
}

PyMODINIT_FUNC PyInit__dyadel(void); /* for the import of Python alone */

PyMODINIT_FUNC PyInit__dyadel(void) {
  PyObject *module = PyModule_Create(&module_definition);
  if (!module) return NULL;
  if (dydpy_guard_prepare() < 0 || add_types(module) < 0 ||
      PyModule_AddStringConstant(module, "version", dyd_version()) < 0)
    Py_CLEAR(module);
  return module;
}
