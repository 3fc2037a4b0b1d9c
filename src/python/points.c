/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points into an engine: arrays as they lie in memory, values of any kind, functions, texts. */
#include "module.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Numbers of Python, exactly: int, float, str, and all that has a numerator and denominator or as_integer_ratio().
 * Others (mpmath, sympy, python-flint) become one of these, a text or a pair of ends in dyadel._values. */

/* ---- rational values ---- */

/* An int, or a value that converts to one (__index__, as numpy's and gmpy2's, or int()). */
static int integer_of(mpz_t out, PyObject *value) {
  int overflow;
  PyObject *whole = PyLong_Check(value) ? Py_NewRef(value) : PyNumber_Index(value);
  if (!whole) {
    PyErr_Clear();
    whole = PyNumber_Long(value);
  }
  if (!whole) return -1;
  long small = PyLong_AsLongAndOverflow(whole, &overflow);
  if (!overflow) {
    mpz_set_si(out, small);
    Py_DECREF(whole);
    return small == -1 && PyErr_Occurred() ? -1 : 0;
  }
  PyObject *digits = PyNumber_ToBase(whole, 16); /* "0x1f", "-0x1f" */
  const char *text = digits ? PyUnicode_AsUTF8AndSize(digits, NULL) : NULL;
  if (text) mpz_set_str(out, text + (*text == '-' ? 3 : 2), 16);
  if (text && *text == '-') mpz_neg(out, out);
  Py_XDECREF(digits);
  Py_DECREF(whole);
  return text ? 0 : -1;
}

static int quotient_of(mpq_t out, PyObject *numerator, PyObject *denominator) {
  if (integer_of(mpq_numref(out), numerator) < 0 || integer_of(mpq_denref(out), denominator) < 0) return -1;
  if (mpz_sgn(mpq_denref(out)) == 0) {
    PyErr_SetString(PyExc_ZeroDivisionError, "a fraction with denominator 0");
    return -1;
  }
  mpq_canonicalize(out);
  return 0;
}

static int double_of(mpq_t out, double value) {
  if (!isfinite(value)) {
    PyErr_Format(PyExc_ValueError, "%s is not a coordinate; coordinates are finite numbers",
                 isnan(value) ? "nan"
                 : value > 0  ? "inf"
                              : "-inf");
    return -1;
  }
  mpq_set_d(out, value);
  return 0;
}

static int exact_text_of(mpq_t out, PyObject *text) {
  Py_ssize_t length;
  const char *bytes = PyUnicode_AsUTF8AndSize(text, &length);
  if (!bytes) return -1;
  dyd_status st = dyd_real_parse_exact(out, bytes, (size_t)length);
  if (st == DYD_OK) return 0;
  PyErr_Format(PyExc_ValueError, "%R is not an exact number: %s", text, dyd_status_text(st));
  return -1;
}

/* The attribute, NULL without an exception where there is none. */
static PyObject *attribute_of(PyObject *value, const char *name) {
  PyObject *found = PyObject_GetAttrString(value, name);
  if (!found && PyErr_ExceptionMatches(PyExc_AttributeError)) PyErr_Clear();
  return found;
}

/* 1: done, 0: it has no such parts, -1: an exception is set. */
static int parts_of(mpq_t out, PyObject *value) {
  OWNED *numerator = attribute_of(value, "numerator");
  OWNED *denominator = numerator ? attribute_of(value, "denominator") : NULL;
  int found = PyErr_Occurred() ? -1 : 0;
  if (denominator && !PyCallable_Check(denominator)) found = quotient_of(out, numerator, denominator) < 0 ? -1 : 1;
  return found;
}

static int ratio_of(mpq_t out, PyObject *value) {
  OWNED *method = attribute_of(value, "as_integer_ratio");
  if (!method) return PyErr_Occurred() ? -1 : 0;
  OWNED *ratio = PyObject_CallNoArgs(method), *numerator = NULL, *denominator = NULL;
  if (!ratio) return -1;
  numerator = PySequence_GetItem(ratio, 0);
  denominator = numerator ? PySequence_GetItem(ratio, 1) : NULL;
  return denominator && quotient_of(out, numerator, denominator) == 0 ? 1 : -1;
}

/* What needs no other module: 1, 0 or -1 as above. */
static int plain_rational(mpq_t out, PyObject *value) {
  if (PyLong_Check(value)) {
    mpz_set_ui(mpq_denref(out), 1);
    return integer_of(mpq_numref(out), value) < 0 ? -1 : 1;
  }
  if (PyFloat_Check(value)) return double_of(out, PyFloat_AsDouble(value)) < 0 ? -1 : 1;
  if (PyUnicode_Check(value) || PyTuple_Check(value) || PyList_Check(value)) return 0;
  int found = parts_of(out, value);
  return found ? found : ratio_of(out, value);
}

/* The int, text or pair that dyadel._values makes of it. */
static PyObject *simplified(PyObject *value) {
  OWNED *function = dydpy_import("dyadel._values", "simplify");
  return function ? PyObject_CallFunctionObjArgs(function, value, NULL) : NULL;
}

int dydpy_rational(mpq_t out, PyObject *value) {
  int found = plain_rational(out, value);
  if (found) return found < 0 ? -1 : 0;
  OWNED *simple = PyUnicode_Check(value) ? Py_NewRef(value) : simplified(value);
  if (!simple) return -1;
  if (PyUnicode_Check(simple)) {
    found = exact_text_of(out, simple) < 0 ? -1 : 1;
  } else {
    found = plain_rational(out, simple);
    if (!found) PyErr_Format(PyExc_TypeError, "expected one exact number, not the interval %R", value);
  }
  return found > 0 ? 0 : -1;
}

/* ---- coordinates ---- */

static int ends_of(mpq_t lo, mpq_t hi, PyObject *pair) {
  int found = -1;
  OWNED *low = PySequence_GetItem(pair, 0), *high = low ? PySequence_GetItem(pair, 1) : NULL;
  if (high) found = dydpy_rational(lo, low) < 0 || dydpy_rational(hi, high) < 0 ? -1 : 0;
  if (!found && mpq_cmp(lo, hi) > 0) {
    PyErr_Format(PyExc_ValueError, "the lower end of %R is above the upper end (exchange them)", pair);
    found = -1;
  }
  return found;
}

static bool is_pair(PyObject *value) {
  return (PyTuple_Check(value) || PyList_Check(value)) && PySequence_Size(value) == 2;
}

/* An exact number or an interval: 1, 0 for a text, or -1. */
static int interval_of(mpq_t lo, mpq_t hi, PyObject *value) {
  int found = plain_rational(lo, value);
  if (found > 0) mpq_set(hi, lo);
  if (found || PyUnicode_Check(value)) return found;
  if (is_pair(value)) return ends_of(lo, hi, value) < 0 ? -1 : 1;
  OWNED *simple = simplified(value);
  if (!simple) return -1;
  found = is_pair(simple) ? (ends_of(lo, hi, simple) < 0 ? -1 : 1) : plain_rational(lo, simple);
  if (found > 0 && !is_pair(simple)) mpq_set(hi, lo);
  return found;
}

static int real_of_text(dyd_real **out, PyObject *value) {
  Py_ssize_t length;
  dyd_error err;
  OWNED *simple = PyUnicode_Check(value) ? Py_NewRef(value) : simplified(value);
  const char *text = simple ? PyUnicode_AsUTF8AndSize(simple, &length) : NULL;
  dyd_error_clear(&err);
  dyd_status st = text ? dyd_real_parse(out, text, (size_t)length, &err) : DYD_OK;
  if (st != DYD_OK) dydpy_raise(&err, st);
  return text && st == DYD_OK ? 0 : -1;
}

/* Any coordinate, intervals and expressions included; the caller's. */
static int real_of(dyd_real **out, PyObject *value) {
  LOCAL_Q(lo);
  LOCAL_Q(hi);
  int found = interval_of(lo, hi, value);
  if (found > 0) {
    dyd_status st = dyd_real_from_interval(out, lo, hi);
    if (st != DYD_OK) {
      dydpy_raise(NULL, st);
      found = -1;
    }
  }
  return found == 0 ? real_of_text(out, value) : found < 0 ? -1 : 0;
}

/* ---- where an exception came from ---- */

/* Puts the place in front of the message, and the point on the exception, where it takes them. */
static void blame(size_t point, PyObject *place) {
  PyObject *type, *value, *trace;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  OWNED *number = PyLong_FromSize_t(point), *old = PyObject_GetAttrString(value, "args");
  PyObject *text = old && PyTuple_Size(old) == 1 ? PyTuple_GetItem(old, 0) : NULL;
  OWNED *whole = place && text && PyUnicode_Check(text) ? PyUnicode_FromFormat("%U: %U", place, text) : NULL;
  OWNED *made = whole ? PyTuple_Pack(1, whole) : NULL;
  if (made) PyObject_SetAttrString(value, "args", made);
  if (number) PyObject_SetAttrString(value, "point", number);
  PyErr_Clear();
  Py_XDECREF(place);
  PyErr_Restore(type, value, trace);
}

/* Adds a note to the exception that is set; owns the text. */
static void add_note(PyObject *text) {
  PyObject *type, *value, *trace;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  OWNED *done = text ? PyObject_CallMethod(value, "add_note", "O", text) : NULL;
  PyErr_Clear();
  Py_XDECREF(text);
  PyErr_Restore(type, value, trace);
}

/* ---- answers and windows ---- */

/* Two coordinates as four ends; texts are exact numbers. */
static int sides_of(mpq_t end[4], PyObject *answer) {
  int found = 0;
  for (int k = 0; found >= 0 && k < 2; k++) {
    OWNED *side = PySequence_GetItem(answer, k);
    found = side ? interval_of(end[2 * k], end[2 * k + 1], side) : -1;
    if (side && found == 0) {
      found = dydpy_rational(end[2 * k], side);
      mpq_set(end[2 * k + 1], end[2 * k]);
    }
  }
  return found < 0 ? -1 : 0;
}

static int numbers_of(mpq_t end[4], PyObject *answer) {
  int found = 0;
  for (int k = 0; found >= 0 && k < 4; k++) {
    OWNED *number = PySequence_GetItem(answer, k);
    found = number ? dydpy_rational(end[k], number) : -1;
  }
  return found;
}

/* Returns 1 if there is a fifth element that is true, 0 if not, -1 with an exception set. */
static int answer_is_fixed(PyObject *answer) {
  OWNED *fixed = PySequence_GetItem(answer, 4);
  return fixed ? PyObject_IsTrue(fixed) : -1;
}

dyd_status dydpy_answer(dyd_rect *r, PyObject *answer, dyd_error *err) {
  mpq_t end[4];
  Py_ssize_t count = PyUnicode_Check(answer) ? 0 : PySequence_Size(answer);
  if (count != 2 && count != 4 && count != 5) {
    PyErr_Clear();
    PyErr_Format(PyExc_TypeError,
                 "the function returned %R; return two coordinates, or four numbers xlo, xhi, ylo, yhi, and True after "
                 "them if the rectangle cannot be narrowed further",
                 answer);
    return DYD_E_STREAM;
  }
  for (int k = 0; k < 4; k++) mpq_init(end[k]);
  int fixed = count == 5 ? answer_is_fixed(answer) : 0;
  int found = fixed < 0 ? -1 : count == 2 ? sides_of(end, answer) : numbers_of(end, answer);
  dyd_status st = found < 0 ? DYD_E_STREAM : dyd_rect_narrow_q(r, (const mpq_t *)end, err);
  for (int k = 0; k < 4; k++) mpq_clear(end[k]);
  return st == DYD_OK && fixed ? DYD_FIXED : st;
}

/* A rectangle, from ends or a pair of coordinates as a callback returns them; -1 with an exception set. */
static int rect_of(dyd_rect *r, PyObject *ends) {
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status st = dydpy_answer(r, ends, &err);
  if (st < 0) dydpy_raise(&err, st);
  return st < 0 ? -1 : 0;
}

int dydpy_window_take(dyd_rect *r, bool *given, PyObject *window) {
  dyd_error err;
  dyd_error_clear(&err);
  *given = window != Py_None;
  if (!*given) return 0;
  dyd_status st = PySequence_Size(window) == 4 ? dydpy_answer(r, window, &err) : DYD_E_ARG;
  if (st >= 0 && (dyd_interval_round(&r->x, &r->x) != DYD_OK || dyd_interval_round(&r->y, &r->y) != DYD_OK))
    st = DYD_E_RANGE;
  if (st >= 0 && (dyd_dyadic_cmp(&r->x.lo, &r->x.hi) >= 0 || dyd_dyadic_cmp(&r->y.lo, &r->y.hi) >= 0)) st = DYD_E_ARG;
  bool wrong = st < 0 && st != DYD_E_NOMEM;
  if (wrong) {
    PyErr_Clear();
    PyErr_Format(PyExc_ValueError, "window must be (xlo, xhi, ylo, yhi) with xlo < xhi and ylo < yhi, not %R", window);
  } else if (st < 0) {
    dydpy_raise(&err, st);
  }
  return st < 0 ? -1 : 0;
}

/* ---- back ---- */

static PyObject *integer_new(const mpz_t z) {
  char *digits = mpz_get_str(NULL, 16, z);
  PyObject *value = digits ? PyLong_FromString(digits, NULL, 16) : PyErr_NoMemory();
  void (*release)(void *, size_t);
  mp_get_memory_functions(NULL, NULL, &release);
  if (digits) release(digits, strlen(digits) + 1);
  return value;
}

PyObject *dydpy_ratio(const mpq_t q) {
  OWNED *numerator = integer_new(mpq_numref(q)), *denominator = integer_new(mpq_denref(q));
  return numerator && denominator ? PyTuple_Pack(2, numerator, denominator) : NULL;
}

PyObject *dydpy_rect_ends(const dyd_rect *r) {
  mpq_t end[4];
  PyObject *all = PyTuple_New(4);
  for (int k = 0; k < 4; k++) mpq_init(end[k]);
  dyd_interval_get_q(end[0], end[1], &r->x);
  dyd_interval_get_q(end[2], end[3], &r->y);
  for (int k = 0; all && k < 4; k++) {
    PyObject *one = dydpy_ratio(end[k]);
    if (!one || PyTuple_SetItem(all, k, one) < 0) Py_CLEAR(all);
  }
  for (int k = 0; k < 4; k++) mpq_clear(end[k]);
  return all;
}

PyObject *dydpy_dyadic(const dyd_dyadic *x) {
  if (!x) Py_RETURN_NONE;
  LOCAL_Q(q);
  dyd_dyadic_get_q(q, x);
  return dydpy_ratio(q);
}

/* ---- functions of Python that narrow points ---- */

static dyd_status call_narrow(dyd_rect *out, PyObject *narrow, const dyd_request *request, dyd_error *err) {
  const Py_ssize_t point = (Py_ssize_t)request->point;
  const char *place = "point %zd, asked for %lld bits";
  OWNED *answer = PyObject_CallFunction(narrow, "nL", point, (long long)request->bits);
  if (!answer) {
    add_note(PyUnicode_FromFormat(place, point, (long long)request->bits));
    return DYD_E_STREAM;
  }
  dyd_status st = dydpy_answer(out, answer, err);
  if (PyErr_Occurred()) blame(request->point, PyUnicode_FromFormat(place, point, (long long)request->bits));
  return st;
}

static dyd_status source_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  PyGILState_STATE gil = PyGILState_Ensure();
  dyd_status st = PyErr_Occurred() ? DYD_E_STREAM : call_narrow(out, user, request, err);
  if (PyErr_Occurred()) st = dyd_error_set(err, DYD_E_STREAM, "the function raised an exception");
  PyGILState_Release(gil);
  return st;
}

bool dydpy_source_new(dyd_source *out, PyObject *narrow) {
  if (!PyCallable_Check(narrow)) {
    PyErr_SetString(PyExc_TypeError, "a source needs a function narrow(point, bits)");
    return false;
  }
  *out = (dyd_source){DYD_SIZED(dyd_source), .narrow = source_narrow, .user = narrow};
  return true;
}

/* ---- points into an engine ---- */

/* Returns true if the view holds doubles, `axes` columns of `rows` (or one row for all). Fills in the columns. */
static bool columns_of(dyd_column out[2], const Py_buffer *view, Py_ssize_t rows) {
  bool doubles = view->itemsize == sizeof(double) && view->format && strcmp(view->format, "d") == 0;
  if (!doubles || view->ndim != 2 || view->shape[1] != 2 || (view->shape[0] != rows && rows >= 0)) {
    PyErr_SetString(PyExc_ValueError, "expected an array of doubles of shape (N, 2)");
    return false;
  }
  for (int a = 0; a < 2; a++)
    out[a] =
        (dyd_column){(const double *)(const void *)((const char *)view->buf + a * view->strides[1]), view->strides[0]};
  return true;
}

PyObject *dydpy_append_array(PyObject *self, PyObject *args) {
  PyObject *points, *radii, *done = NULL;
  Py_buffer xy = {0}, r = {0};
  dyd_column at[2], by[2];
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "OO", &points, &radii)) return NULL;
  if (PyObject_GetBuffer(points, &xy, PyBUF_STRIDED_RO | PyBUF_FORMAT) < 0) return NULL;
  bool with = radii != Py_None, good = !with || PyObject_GetBuffer(radii, &r, PyBUF_STRIDED_RO | PyBUF_FORMAT) == 0;
  good = good && columns_of(at, &xy, -1) && (!with || columns_of(by, &r, xy.shape[0])) && dydpy_begin(&c, self, 0);
  if (good)
    done =
        dydpy_end_none(&c, dyd_engine_add_columns(c.self->engine, (size_t)xy.shape[0], at, with ? by : NULL, &c.err));
  if (r.obj) PyBuffer_Release(&r);
  PyBuffer_Release(&xy);
  return done;
}

/* Four contiguous arrays of doubles. */
PyObject *dydpy_append_boxes(PyObject *self, PyObject *args) {
  const double *end[4];
  Py_ssize_t size[4];
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "y#y#y#y#", &end[0], &size[0], &end[1], &size[1], &end[2], &size[2], &end[3], &size[3]))
    return NULL;
  if (size[1] != size[0] || size[2] != size[0] || size[3] != size[0])
    return PyErr_Format(PyExc_ValueError, "arrays of different lengths");
  if (!dydpy_begin(&c, self, 0)) return NULL;
  size_t count = (size_t)size[0] / sizeof(double);
  return dydpy_end_none(&c, dyd_engine_add_boxes(c.self->engine, count, end[0], end[1], end[2], end[3], &c.err));
}

/* One coordinate, widened by a radius (NULL: none). */
static int widened_real(dyd_real **out, PyObject *value, PyObject *radius) {
  if (real_of(out, value) < 0) return -1;
  if (!radius) return 0;
  LOCAL_Q(by);
  int status = dydpy_rational(by, radius);
  if (status < 0 && (PyErr_ExceptionMatches(PyExc_ValueError) || PyErr_ExceptionMatches(PyExc_TypeError)))
    PyErr_Format(PyExc_ValueError, "the radius %R is not a finite number", radius);
  if (status == 0 && mpq_sgn(by) < 0) {
    PyErr_Format(PyExc_ValueError, "the radius %R is negative", radius);
    status = -1;
  }
  dyd_status st = status == 0 ? dyd_real_widen(out, *out, by) : DYD_OK;
  if (status < 0) dyd_real_free(*out);
  if (status < 0 || st != DYD_OK) *out = NULL;
  if (st != DYD_OK) dydpy_raise(NULL, st);
  return status == 0 && st == DYD_OK ? 0 : -1;
}

/* The elements of a sequence of two; false with an exception set. New references, NULL where there is none. */
static bool both_of(PyObject *both[2], PyObject *pair, const char *what) {
  both[0] = both[1] = NULL;
  if (PyUnicode_Check(pair) || PySequence_Size(pair) != 2) {
    PyErr_Clear();
    PyErr_Format(PyExc_ValueError, "%R is not a pair of %s", pair, what);
    return false;
  }
  both[0] = PySequence_GetItem(pair, 0);
  both[1] = both[0] ? PySequence_GetItem(pair, 1) : NULL;
  return both[1] != NULL;
}

int dydpy_stream(dyd_stream **out, PyObject *point, PyObject *radii) {
  PyObject *xy[2] = {NULL, NULL}, *by[2] = {NULL, NULL};
  dyd_real *side[2] = {NULL, NULL};
  bool good = both_of(xy, point, "coordinates") && (!radii || both_of(by, radii, "radii"));
  for (int a = 0; good && a < 2; a++) good = widened_real(&side[a], xy[a], by[a]) == 0;
  for (int a = 0; a < 2; a++) {
    Py_XDECREF(xy[a]);
    Py_XDECREF(by[a]);
    if (!good) dyd_real_free(side[a]);
  }
  if (!good) return -1;
  dyd_status st = dyd_stream_from_reals(out, side[0], side[1]);
  if (st != DYD_OK) dydpy_raise(NULL, st);
  return st == DYD_OK ? 0 : -1;
}

static dyd_status append_streams(dydpy_engine *self, dyd_stream **stream, size_t count, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < count; k++) {
    if (st == DYD_OK)
      st = dyd_engine_add_stream(self->engine, stream[k], err);
    else
      dyd_stream_free(stream[k]);
  }
  return st;
}

/* The points of a list, with a list of pairs of radii (or None): how many could be made; all but for an exception. */
static size_t make_streams(dyd_stream **stream, size_t count, PyObject *list, PyObject *radii) {
  size_t made = 0;
  while (made < count) {
    PyObject *by = radii == Py_None ? NULL : PyList_GetItem(radii, (Py_ssize_t)made);
    if (PyErr_Occurred() || dydpy_stream(&stream[made], PyList_GetItem(list, (Py_ssize_t)made), by) < 0) break;
    made++;
  }
  return made;
}

/* All are understood before the first is added. */
PyObject *dydpy_append_values(PyObject *self, PyObject *args) {
  PyObject *list, *radii;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "O!O", &PyList_Type, &list, &radii)) return NULL;
  size_t count = (size_t)PyList_Size(list);
  dyd_stream **stream = calloc(count + 1, sizeof *stream);
  if (!stream) return PyErr_NoMemory();
  size_t made = make_streams(stream, count, list, radii);
  if (made < count)
    blame(dydpy_points((dydpy_engine *)self) + made, PyUnicode_FromFormat("element %zu of points", made));
  PyObject *done = NULL;
  if (made == count && dydpy_begin(&c, self, 0))
    done = dydpy_end_none(&c, append_streams(c.self, stream, count, &c.err));
  else
    for (size_t k = 0; k < made; k++) dyd_stream_free(stream[k]);
  free(stream);
  return done;
}

/* append_source(n, narrow) */
PyObject *dydpy_append_source(PyObject *self, PyObject *args) {
  Py_ssize_t count;
  PyObject *narrow;
  dyd_source source;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "nO", &count, &narrow)) return NULL;
  if (count < 0) return PyErr_Format(PyExc_ValueError, "a source cannot have %zd points", count);
  if (!dydpy_source_new(&source, narrow) || PyList_Append(((dydpy_engine *)self)->functions, narrow) < 0) return NULL;
  if (!dydpy_begin(&c, self, 0)) return NULL;
  return dydpy_end_none(&c, dyd_engine_add_source(c.self->engine, (size_t)count, &source, &c.err));
}

/* name(rows, ids): of the points added last; rows: a buffer of size_t; ids: a list of texts, or None */
PyObject *dydpy_name(PyObject *self, PyObject *args) {
  const char *rows;
  Py_ssize_t size;
  PyObject *ids;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "y#O", &rows, &size, &ids)) return NULL;
  size_t count = (size_t)size / sizeof(size_t);
  const char **id = calloc(count + 1, sizeof *id);
  if (!id) return PyErr_NoMemory();
  for (size_t k = 0; ids != Py_None && k < count && !PyErr_Occurred(); k++) {
    PyObject *text = PyList_GetItem(ids, (Py_ssize_t)k);
    id[k] = text ? PyUnicode_AsUTF8AndSize(text, NULL) : NULL;
  }
  PyObject *done = NULL;
  if (!PyErr_Occurred() && dydpy_begin(&c, self, DYDPY_HOLDS))
    done = dydpy_end_none(
        &c, dyd_engine_name(c.self->engine, count, (const size_t *)(const void *)rows, ids == Py_None ? NULL : id));
  free(id);
  return done;
}

/* names() -> (rows, ids or None): of all points */
PyObject *dydpy_names(PyObject *self, PyObject *Py_UNUSED(none)) {
  dydpy_call c;
  if (!dydpy_begin(&c, self, DYDPY_HOLDS)) return NULL;
  const dyd_engine *e = c.self->engine;
  const size_t count = dyd_engine_count(e);
  int64_t *row = malloc((count + 1) * sizeof *row);
  OWNED *ids = dyd_engine_id(e, 0) ? PyList_New((Py_ssize_t)count) : Py_NewRef(Py_None);
  for (size_t i = 0; row && i < count; i++) {
    const char *id = dyd_engine_id(e, i);
    row[i] = (int64_t)dyd_engine_row(e, i);
    if (id && ids) PyList_SetItem(ids, (Py_ssize_t)i, PyUnicode_DecodeUTF8(id, (Py_ssize_t)strlen(id), "replace"));
  }
  OWNED *rows = row ? dydpy_buffer_new(row, count * sizeof *row) : PyErr_NoMemory();
  if (!dydpy_end(&c, DYD_OK)) Py_CLEAR(rows);
  return rows && ids ? PyTuple_Pack(2, rows, ids) : NULL;
}

/* carried() -> {name: [text, ...]}: the columns that points carry */
PyObject *dydpy_carried(PyObject *self, PyObject *Py_UNUSED(none)) {
  dydpy_call c;
  const char *name;
  if (!dydpy_begin(&c, self, DYDPY_HOLDS)) return NULL;
  const dyd_engine *e = c.self->engine;
  const size_t count = dyd_engine_count(e);
  PyObject *all = PyDict_New();
  for (size_t k = 0; all && dyd_engine_carried(&name, e, 0, k); k++) {
    OWNED *column = PyList_New((Py_ssize_t)count);
    for (size_t i = 0; column && i < count; i++) {
      const char *text = dyd_engine_carried(NULL, e, i, k);
      PyList_SetItem(column, (Py_ssize_t)i, PyUnicode_DecodeUTF8(text, (Py_ssize_t)strlen(text), "replace"));
    }
    if (!column || PyErr_Occurred() || PyDict_SetItemString(all, name, column) < 0) Py_CLEAR(all);
  }
  if (!dydpy_end(&c, DYD_OK)) Py_CLEAR(all);
  return all;
}

/* Sets the field to the value in dict under its name, borrowed; *given counts such fields. -1 with an exception set. */
static int read_option_set(dyd_read_options *o, Py_ssize_t *given, const dyd_read_field *field, PyObject *dict) {
  PyObject *value = PyDict_GetItemString(dict, field->name);
  char *at = (char *)o + field->offset;
  if (!value) return 0;
  ++*given;
  if (value == Py_None) return 0;
  if (field->flag) {
    int truth = PyObject_IsTrue(value);
    *(bool *)at = truth > 0;
    return truth < 0 ? -1 : 0;
  }
  if (!PyUnicode_Check(value)) {
    PyErr_Format(PyExc_TypeError, "%s=%R; give a text", field->name, value);
    return -1;
  }
  const char *text = PyUnicode_AsUTF8AndSize(value, NULL);
  memcpy(at, &text, sizeof text);
  return text ? 0 : -1;
}

/* append_text(text, options): the contents of a points file; options has fields of dyd_read_options by name */
PyObject *dydpy_append_text(PyObject *self, PyObject *args) {
  dyd_read_options o = {DYD_SIZED(dyd_read_options)};
  const dyd_read_field *field;
  const char *text;
  Py_ssize_t length, given = 0;
  PyObject *options;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "y#O!", &text, &length, &PyDict_Type, &options)) return NULL;
  for (size_t k = 0; (field = dyd_read_field_at(NULL, NULL, k)); k++)
    if (read_option_set(&o, &given, field, options) < 0) return NULL;
  if (given != PyDict_Size(options))
    return PyErr_Format(PyExc_TypeError, "unknown option of Text in %R; see help(dyadel.Text)", options);
  if (!dydpy_begin(&c, self, 0)) return NULL;
  c.self->weights |= o.keep_radii && o.radius_columns;
  c.self->sigmas |= o.sigma_column != NULL;
  return dydpy_end_none(&c, dyd_engine_add_text(c.self->engine, text, (size_t)length, &o, &c.err));
}

/* confidence(text, n): states it of the next n points; confidence(None, 0): the stated one, or None */
PyObject *dydpy_confidence(PyObject *self, PyObject *args) {
  dyd_confidence stated = {DYD_SIZED(dyd_confidence)};
  const char *text;
  Py_ssize_t n;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "zn", &text, &n) || !dydpy_begin(&c, self, 0)) return NULL;
  bool known = text || dyd_engine_confidence(&stated, c.self->engine);
  dyd_status st = text ? dyd_engine_state_confidence(&stated, c.self->engine, text, (size_t)n, &c.err) : DYD_OK;
  if (!dydpy_end(&c, st)) return NULL;
  if (!known) Py_RETURN_NONE;
  return Py_BuildValue("sdn", stated.probability, stated.k, (Py_ssize_t)stated.n);
}

/* remeasure(i, (xlo, xhi, ylo, yhi)) */
PyObject *dydpy_remeasure(PyObject *self, PyObject *args) {
  Py_ssize_t number;
  uint32_t site;
  PyObject *ends, *done = NULL;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "nO", &number, &ends) || !dydpy_site(&site, (dydpy_engine *)self, number)) return NULL;
  LOCAL(dyd_rect, r);
  if (rect_of(&r, ends) == 0 && dydpy_begin(&c, self, 0))
    done = dydpy_end_none(&c, dyd_engine_remeasure(c.self->engine, site, &r, &c.err));
  return done;
}
