/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Shared by the files of this folder: the module dyadel._dyadel, the base of the package dyadel (Python).
 *
 * Everything here holds the GIL unless it says otherwise; work of the library is done without it. A callback that
 * raises leaves its exception where Python keeps it, in the thread, and makes the library fail; later callbacks see it
 * and fail at once, and the caller of the library raises it, unchanged. */
#ifndef DYD_PYTHON_MODULE_H
#define DYD_PYTHON_MODULE_H

#define PY_SSIZE_T_CLEAN
#define Py_LIMITED_API 0x030B0000
#include <Python.h>
#include <dyadel/dyadel.h>
#include <signal.h>
#include <stdlib.h>

/* ---- objects that are given back at the end of their block ---- */

/* OWNED *x = ..; a reference, or NULL. FREED char *t = ..; memory. SCOPED(dyd_pair_list) l = {0}; LOCAL(dyd_rect, r)
 * and LOCAL_Q(q), of type mpq_t, initialise, too. Not where the GIL is released before the block ends. */
#define OWNED __attribute__((cleanup(dydpy_drop))) PyObject
#define FREED __attribute__((cleanup(dydpy_drop_memory)))
#define SCOPED(type) __attribute__((cleanup(type##_clear))) type
#define LOCAL(type, x)                                                                                                 \
  SCOPED(type) x;                                                                                                      \
  type##_init(&x)
#define LOCAL_Q(x)                                                                                                     \
  __attribute__((cleanup(dydpy_drop_q))) mpq_t x;                                                                      \
  mpq_init(x)
static inline void dydpy_drop(PyObject **x) {
  Py_XDECREF(*x);
}
static inline void dydpy_drop_memory(void *place) {
  free(*(void **)place);
}
static inline void dydpy_drop_q(mpq_t *q) {
  mpq_clear(*q);
}

/* ---- call.c: exceptions ---- */

/* A reference to package.name, NULL with an exception set. */
PyObject *dydpy_import(const char *package, const char *name);
/* Raises the error of a failed library call: the exception of a callback if there is one, else dyadel.Error with
 * the contents of err, or MemoryError. Returns NULL. */
PyObject *dydpy_raise(const dyd_error *err, dyd_status status);
/* {"NAME": value} of numbers; steals the values. NULL with an exception set. */
typedef struct dydpy_entry {
  const char *name;
  PyObject *value;
} dydpy_entry;
PyObject *dydpy_dict(const dydpy_entry *entry, size_t count);

/* ---- memory of the library as an object that numpy reads without a copy ---- */

/* Takes over `bytes`, released by free(), also on failure. */
PyObject *dydpy_buffer_new(void *bytes, size_t size);

/* ---- Ctrl-C ends library calls in the main thread ---- */

/* Between begin and end SIGINT raises *flag and cancels engine (either may be NULL), then has its former effect. Does
 * nothing in other threads, and where Python does not handle the signal. They nest. */
typedef struct dydpy_guard {
  dyd_engine *engine;
  volatile int *flag;
  struct dydpy_guard *outer;
  volatile sig_atomic_t hit; /* the signal came */
  bool on;
} dydpy_guard;
void dydpy_guard_begin(dydpy_guard *g, dyd_engine *engine, volatile int *flag);
/* -1 with an exception set: that of a callback, or of Python's handler (KeyboardInterrupt). */
int dydpy_guard_end(dydpy_guard *g);
/* Notes the identity of the main thread; -1 with an exception set. */
int dydpy_guard_prepare(void);

/* ---- points.c: numbers of Python ---- */

/* The exact value of an int, float, fraction or anything that dyadel._values knows: 0, or -1 with an exception set. */
int dydpy_rational(mpq_t out, PyObject *value);
/* The answer of a narrow callback: four ends, perhaps "fixed", or two coordinates. *r: as the callback was given it.
 * DYD_OK, DYD_FIXED, or an error with err filled or an exception set. */
dyd_status dydpy_answer(dyd_rect *r, PyObject *answer, dyd_error *err);
/* Four ends, or None: *given = false. r is initialised. 0, or -1 with an exception set. */
int dydpy_window_take(dyd_rect *r, bool *given, PyObject *window);
/* The four ends as (numerator, denominator). */
PyObject *dydpy_rect_ends(const dyd_rect *r);
/* (numerator, denominator). */
PyObject *dydpy_ratio(const mpq_t q);
/* The same; None for NULL. */
PyObject *dydpy_dyadic(const dyd_dyadic *x);

/* ---- points.c: functions of Python ---- */

/* A source over a Python function narrow(point, bits), which is borrowed as long as the source is used. false with an
 * exception set. */
bool dydpy_source_new(dyd_source *out, PyObject *narrow);
/* For dyd_engine_options.progress. */
typedef struct dydpy_progress_user {
  PyObject *function; /* NULL or None: none */
  dyd_engine *engine; /* cancelled when the function raises */
  dyd_trace *trace;   /* gets the stage, too; NULL: none */
} dydpy_progress_user;

/* ---- module.c: the types Engine and Sphere ---- */

typedef struct dydpy_engine {
  PyObject_HEAD dyd_engine *engine;
  bool busy;            /* a call is at work, perhaps without the GIL */
  bool weights, sigmas; /* texts gave points weights (keep_radii); standard deviations */
  bool late;            /* an interrupt came too late for the last run: it cancels the next one, which is begun again */
  PyObject *functions;  /* of its sources: a list that owns them, and that the garbage collector sees */
  FILE *trace_file;     /* with trace: of the runs to come; NULL: they leave none */
  dyd_trace *trace;
  dyd_sphere *sphere; /* whose images the engine holds, and owns it; NULL: a plane */
  PyObject *places;   /* the Engine of its places */
} dydpy_engine;

/* A call of the library: begin enters the engine, or raises RuntimeError when another call is at work, and releases the
 * GIL; end takes it again and raises the error. */
typedef struct dydpy_call {
  dydpy_engine *self;     /* NULL: none */
  const dyd_delaunay *pd; /* its result; NULL: none was requested */
  volatile int cancel;    /* Ctrl-C raises it, with DYDPY_CANCELS */
  dyd_error err;
  dydpy_guard guard;
  int how;
  PyThreadState *thread;
} dydpy_call;
/* RESULT: there has to be one. CANCELS: Ctrl-C raises c->cancel; REFINES: it cancels the engine.
 * HOLDS: the GIL is kept. */
enum { DYDPY_RESULT = 1, DYDPY_CANCELS = 2, DYDPY_REFINES = 4, DYDPY_HOLDS = 8 };
/* self: an Engine or a Sphere, or NULL. false with an exception set, and nothing to end. */
bool dydpy_begin(dydpy_call *c, PyObject *self, int how);
/* After the work returned st: false with an exception set unless st is DYD_OK and no callback raised. */
bool dydpy_end(dydpy_call *c, dyd_status st);
/* The same: None, or NULL with an exception set. */
PyObject *dydpy_end_none(dydpy_call *c, dyd_status st);

/* Fills in options from a dict of numbers, a window and costs, which are borrowed until dydpy_options_clear, which
 * follows also where this fails. */
typedef struct dydpy_options {
  dyd_engine_options o;
  dyd_rect window;
  Py_buffer cost;
  dydpy_progress_user progress;
} dydpy_options;
int dydpy_options_init(dydpy_options *out, dydpy_engine *self, PyObject *dict);
void dydpy_options_clear(dydpy_options *o);

/* A point from (x, y), widened by a pair of radii (NULL: none), as a stream; the caller's. 0, or -1 with an exception
 * set.
 */
int dydpy_stream(dyd_stream **out, PyObject *point, PyObject *radii);
/* How many points: of a sphere, places. */
size_t dydpy_points(const dydpy_engine *self);
/* The point of that number; false with IndexError when there is none. */
bool dydpy_site(uint32_t *out, dydpy_engine *self, Py_ssize_t number);

/* The methods and functions. */
#define DYDPY_DECLARE(name, how, doc) PyObject *dydpy_##name(PyObject *self, PyObject *args);
#define ENGINE DYDPY_DECLARE
#define BOTH DYDPY_DECLARE
#define SPHERE DYDPY_DECLARE
#define MODULE DYDPY_DECLARE
#include "methods.def"
#undef ENGINE
#undef BOTH
#undef SPHERE
#undef MODULE

/* Ends the trace, if there is one; err may be NULL. */
dyd_status dydpy_trace_close(dydpy_engine *self, dyd_error *err);

/* ---- call.c: texts ---- */

/* Writes to memory. */
typedef struct dydpy_text {
  FILE *file;
  char *bytes;
  size_t size;
} dydpy_text;
bool dydpy_text_open(dydpy_text *t);
/* bytes; NULL where the text is not good (an exception is set), or with MemoryError. */
PyObject *dydpy_text_close(dydpy_text *t, bool good);

#endif
