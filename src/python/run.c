/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Runs: their options, the functions of Python that they call, their traces and tables; the harness. */
#include "module.h"

#include <errno.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- progress ---- */

static void progress_told(void *user, const dyd_progress *p) {
  const dydpy_progress_user *u = user;
  if (u->trace) dyd_trace_stage(u->trace, p);
  if (!u->function || u->function == Py_None) return;
  PyGILState_STATE gil = PyGILState_Ensure();
  PyObject *done = NULL;
  if (!PyErr_Occurred())
    done = PyObject_CallFunction(u->function, "{s:K,s:L,s:n,s:n,s:n,s:n,s:n,s:d}", "stage",
                                 (unsigned long long)p->stage, "bits", (long long)p->bits, "points",
                                 (Py_ssize_t)p->sites, "legal", (Py_ssize_t)p->count[DYD_LEGAL], "indeterminate",
                                 (Py_ssize_t)p->count[DYD_INDETERMINATE], "ties", (Py_ssize_t)p->count[DYD_TIE],
                                 "undecided_faces", (Py_ssize_t)p->undecided_faces, "seconds", p->seconds);
  if (!done) dyd_engine_cancel(u->engine);
  Py_XDECREF(done);
  PyGILState_Release(gil);
}

/* ---- traces: each answer of a point is in its file before the next request ---- */

/* Raises OSError with the name as the user gave it. */
static FILE *file_open(const char *path, const char *mode, const char *given) {
  FILE *file = fopen(path, mode);
  OWNED *name = file ? NULL : PyUnicode_DecodeFSDefault(given);
  if (name) PyErr_SetFromErrnoWithFilenameObject(PyExc_OSError, name);
  return file;
}

enum { SYNC_SECONDS = 5 };

/* Begins the trace in a file beside its place, with the answers of an earlier one, and puts it there. A device or
 * a pipe is written in place. */
static dyd_status trace_place(dydpy_engine *self, const char *path, const char *beside, const dyd_engine_options *o,
                              const dyd_converge_options *converge, dyd_error *err) {
  struct stat info;
  const bool direct = stat(path, &info) == 0 && !S_ISREG(info.st_mode);
  self->trace_file = file_open(direct ? path : beside, "w", path);
  if (!self->trace_file) return DYD_E_IO;
  setvbuf(self->trace_file, NULL, _IOLBF, BUFSIZ);
  dyd_status st = dyd_trace_new(&self->trace, self->trace_file, self->engine, NULL, o, converge, err);
  if (st == DYD_OK) st = dyd_trace_sync(self->trace, SYNC_SECONDS, err);
  if (st == DYD_OK && !direct && rename(beside, path) != 0) st = dyd_error_set(err, DYD_E_IO, strerror(errno));
  if (st == DYD_OK) return st;
  dyd_error unused;
  dydpy_trace_close(self, &unused);
  if (!direct) unlink(beside);
  return st;
}

/* With the engine entered. converge: None, or a window and whether to omit bounds of the diagram. */
static dyd_status trace_open(dydpy_engine *self, const char *path, const dyd_engine_options *o,
                             const dyd_converge_options *converge, dyd_error *err) {
  const size_t length = strlen(path);
  FREED char *beside = malloc(length + sizeof ".new");
  if (!beside) return dyd_error_set(err, DYD_E_NOMEM, dyd_status_text(DYD_E_NOMEM));
  memcpy(beside, path, length);
  memcpy(beside + length, ".new", sizeof ".new");
  return trace_place(self, path, beside, o, converge, err);
}

/* trace_begin(path, options, (window, of) or None) */
PyObject *dydpy_trace_begin(PyObject *object, PyObject *args) {
  dydpy_engine *self = (dydpy_engine *)object;
  const char *path;
  PyObject *dict, *converge, *window = Py_None;
  unsigned of = 0;
  bool windowed = false;
  dydpy_call call;
  if (!PyArg_ParseTuple(args, "yO!O", &path, &PyDict_Type, &dict, &converge)) return NULL;
  if (converge != Py_None && !PyArg_ParseTuple(converge, "OI", &window, &of)) return NULL;
  SCOPED(dydpy_options) o;
  LOCAL(dyd_rect, view);
  if (dydpy_options_init(&o, self, dict) < 0 || dydpy_window_take(&view, &windowed, window) < 0 ||
      !dydpy_begin(&call, object, DYDPY_HOLDS))
    return NULL;
  const dyd_converge_options c = {DYD_SIZED(dyd_converge_options), .window = windowed ? &view : NULL,
                                  .of = (dyd_converge_of)of};
  return dydpy_end_none(&call, trace_open(self, path, &o.o, converge != Py_None ? &c : NULL, &call.err));
}

dyd_status dydpy_trace_close(dydpy_engine *self, dyd_error *err) {
  FILE *file = self->trace_file;
  dyd_status st = self->trace ? dyd_trace_end(self->trace, dyd_engine_outcome(self->engine), err) : DYD_OK;
  self->trace = NULL;
  self->trace_file = NULL;
  if (file && fclose(file) != 0 && st == DYD_OK) st = dyd_error_set(err, DYD_E_IO, "the trace cannot be written");
  return st;
}

PyObject *dydpy_trace_end(PyObject *object, PyObject *Py_UNUSED(none)) {
  dydpy_call c;
  return dydpy_begin(&c, object, 0) ? dydpy_end_none(&c, dydpy_trace_close(c.self, &c.err)) : NULL;
}

/* recall(path) -> answers taken */
PyObject *dydpy_recall(PyObject *object, PyObject *args) {
  dyd_recall_report report = {DYD_SIZED(dyd_recall_report)};
  const char *path;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "y", &path)) return NULL;
  FILE *in = file_open(path, "r", path);
  if (!in) return NULL;
  bool good = dydpy_begin(&c, object, 0);
  good = good && dydpy_end(&c, dyd_trace_recall(&report, c.self->engine, in, NULL, &c.err));
  fclose(in);
  return good ? PyLong_FromSize_t(report.answers) : NULL;
}

/* ---- runs stage by stage, as tables ---- */

/* Writes the table, or draws it, whatever the run returned. */
static PyObject *table_text(const dyd_convergence *table, const char *name, bool times, const long long *modulus) {
  dyd_format format;
  dydpy_text text;
  dyd_error err;
  dyd_error_clear(&err);
  if (!dyd_format_from_name(&format, name)) return PyErr_Format(PyExc_ValueError, "there is no format \"%s\"", name);
  if (!dydpy_text_open(&text)) return NULL;
  const dyd_write_options o = {DYD_SIZED(dyd_write_options),
                               .stages = table,
                               .times = times,
                               .modulus = modulus != NULL,
                               .modulus_from = modulus ? modulus[0] : 0,
                               .modulus_to = modulus ? modulus[1] : 0};
  bool rows = dyd_format_holds(format, DYD_CONTENT_CONVERGENCE, false);
  dyd_status st = dyd_write(text.file, NULL, rows ? DYD_CONTENT_CONVERGENCE : DYD_CONTENT_PLOT, format, &o, &err);
  if (st < 0) dydpy_raise(&err, st);
  return dydpy_text_close(&text, st >= 0);
}

/* (outcome, csv, svg) of a table, which is cleared; NULL unless the call that made it went well. */
static PyObject *table_found(bool good, dyd_convergence *table, bool times, const long long *modulus) {
  PyObject *found = NULL;
  if (good)
    found = Py_BuildValue("sNN", dyd_outcome_text(table->outcome), table_text(table, "csv", times, modulus),
                          table_text(table, "svg", times, NULL));
  dyd_convergence_clear(table);
  return found;
}

/* replay(path) -> (outcome, csv, svg) */
PyObject *dydpy_replay(PyObject *Py_UNUSED(module), PyObject *args) {
  dyd_convergence table = {DYD_SIZED(dyd_convergence)};
  const char *path;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "y", &path)) return NULL;
  FILE *in = file_open(path, "r", path);
  if (!in) return NULL;
  bool good = dydpy_begin(&c, NULL, 0) && dydpy_end(&c, dyd_trace_replay(&table, in, NULL, &c.err));
  fclose(in);
  return table_found(good, &table, false, NULL);
}

PyObject *dydpy_converge(PyObject *self, PyObject *args) {
  PyObject *dict, *window, *range;
  int times;
  unsigned of;
  unsigned long long hindsight;
  long long modulus[2];
  bool windowed = false;
  dyd_convergence table = {DYD_SIZED(dyd_convergence)};
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "O!OIpKO", &PyDict_Type, &dict, &window, &of, &times, &hindsight, &range)) return NULL;
  if (range != Py_None && !PyArg_ParseTuple(range, "LL", &modulus[0], &modulus[1])) return NULL;
  SCOPED(dydpy_options) o;
  if (dydpy_options_init(&o, (dydpy_engine *)self, dict) < 0) return NULL;
  LOCAL(dyd_rect, view);
  bool good = dydpy_window_take(&view, &windowed, window) == 0 && dydpy_begin(&c, self, DYDPY_REFINES);
  const dyd_converge_options how = {DYD_SIZED(dyd_converge_options), .window = windowed ? &view : NULL,
                                    .of = (dyd_converge_of)of, .rates = range != Py_None, .hindsight = hindsight};
  good = good && dydpy_end(&c, dyd_converge_run(&table, c.self->engine, &o.o, &how, &c.err));
  return table_found(good, &table, times, range != Py_None ? modulus : NULL);
}

/* ---- check: the harness of monotone refinement over points of Python ---- */

/* make: a function without arguments that returns a new Engine; kept: all of them, as they own the functions that their
 * engines call. */
typedef struct harness_user {
  PyObject *make, *kept, *progress;
  volatile int *cancel;
} harness_user;

/* Takes the library's engine out of the object that make() returned. */
static dyd_status harness_take(dyd_engine **out, harness_user *u) {
  OWNED *made = PyErr_Occurred() ? NULL : PyObject_CallNoArgs(u->make);
  if (!made) return DYD_E_STREAM;
  dydpy_engine *self = (dydpy_engine *)made;
  *out = self->engine;
  self->engine = NULL;
  int status = PyList_Append(u->kept, made);
  return status < 0 ? DYD_E_NOMEM : DYD_OK;
}

static dyd_status harness_open(dyd_engine **out, void *user, dyd_error *err) {
  PyGILState_STATE gil = PyGILState_Ensure();
  dyd_status st = harness_take(out, user);
  if (st != DYD_OK) dyd_error_set(err, st, "the points cannot be made");
  PyGILState_Release(gil);
  return st;
}

static void harness_progress(void *user, unsigned schedule, unsigned of) {
  harness_user *u = user;
  PyGILState_STATE gil = PyGILState_Ensure();
  bool fine = !PyErr_Occurred() && PyErr_CheckSignals() == 0;
  PyObject *done = fine && u->progress != Py_None ? PyObject_CallFunction(u->progress, "II", schedule, of) : NULL;
  if (PyErr_Occurred()) *u->cancel = 1;
  Py_XDECREF(done);
  PyGILState_Release(gil);
}

/* ---- arguments and results of check ---- */

/* [(stage, point, bits), ...]; NULL with an exception set, or for None. */
static dyd_check_move *moves_of(size_t *count, PyObject *list) {
  *count = 0;
  if (list == Py_None) return NULL;
  Py_ssize_t size = PyList_Size(list);
  dyd_check_move *move = size < 0 ? NULL : calloc((size_t)size + 1, sizeof *move);
  if (!move && size >= 0) PyErr_NoMemory();
  for (Py_ssize_t k = 0; move && k < size; k++) {
    long long bits;
    Py_ssize_t stage, point;
    bool good = PyArg_ParseTuple(PyList_GetItem(list, k), "nnL", &stage, &point, &bits);
    if (good && (stage < 1 || point < 0 || stage > UINT32_MAX || point > UINT32_MAX))
      PyErr_SetString(PyExc_ValueError, "a move is (stage, point, bits), stages from 1, points from 0");
    if (PyErr_Occurred()) {
      free(move);
      return NULL;
    }
    move[k] = (dyd_check_move){(uint32_t)stage, (uint32_t)point, bits};
  }
  *count = size < 0 ? 0 : (size_t)size;
  return move;
}

static PyObject *moves_new(const dyd_check_report *r) {
  PyObject *list = PyList_New(0);
  for (size_t k = 0; list && k < r->moves; k++) {
    OWNED *move = Py_BuildValue("IIL", r->move[k].stage, r->move[k].point, (long long)r->move[k].bits);
    if (!move || PyList_Append(list, move) < 0) Py_CLEAR(list);
  }
  return list;
}

static PyObject *harness_found(const dyd_check_report *r) {
  const dydpy_entry entry[] = {
      {"fault", PyUnicode_FromString(dyd_check_fault_text(r->fault))},
      {"message", PyUnicode_FromString(r->message)},
      {"seed", PyLong_FromUnsignedLongLong(r->seed)},
      {"base_bits", PyLong_FromLongLong(r->base_bits)},
      {"moves", moves_new(r)},
      {"schedules", PyLong_FromUnsignedLongLong(r->schedules)},
      {"stages", PyLong_FromUnsignedLongLong(r->stages)},
      {"pairs", PyLong_FromUnsignedLongLong(r->pairs)},
      {"cells", PyLong_FromUnsignedLongLong(r->cells)},
  };
  return dydpy_dict(entry, sizeof entry / sizeof *entry);
}

static PyObject *harness_run(harness_user *u, dyd_check_options *o) {
  dyd_check_report report = {DYD_SIZED(dyd_check_report)};
  PyObject *found = NULL;
  dydpy_call c;
  u->cancel = &c.cancel;
  o->cancel = &c.cancel;
  o->progress = harness_progress;
  o->progress_user = u;
  if (!dydpy_begin(&c, NULL, DYDPY_CANCELS)) return NULL;
  dyd_status st = dyd_check_run(&report, harness_open, u, o, &c.err);
  if (dydpy_end(&c, st < 0 ? st : DYD_OK)) found = harness_found(&report);
  dyd_check_report_clear(&report);
  return found;
}

PyObject *dydpy_check(PyObject *Py_UNUSED(module), PyObject *args) {
  harness_user u = {.progress = Py_None};
  dyd_check_options o = {DYD_SIZED(dyd_check_options)};
  unsigned long long seed;
  long long base_bits, max_bits, slack_bits;
  PyObject *list;
  if (!PyArg_ParseTuple(args, "OKIILLLdOO", &u.make, &seed, &o.schedules, &o.stages, &base_bits, &max_bits, &slack_bits,
                        &o.seconds, &list, &u.progress))
    return NULL;
  o.seed = seed;
  o.base_bits = base_bits;
  o.max_bits = max_bits;
  o.slack_bits = slack_bits;
  dyd_check_move *move = moves_of(&o.moves, list);
  if (PyErr_Occurred()) return NULL;
  o.move = move;
  u.kept = PyList_New(0);
  PyObject *found = u.kept ? harness_run(&u, &o) : NULL;
  Py_XDECREF(u.kept);
  free(move);
  return found;
}

typedef enum option_kind {
  OPTION_ENUM,
  OPTION_BITS,
  OPTION_COUNT,
  OPTION_U64,
  OPTION_UNSIGNED,
  OPTION_SECONDS,
  OPTION_BOOL
} option_kind;

static const struct {
  const char *name;
  option_kind kind;
  size_t at;
} option_table[] = {
    {"goal", OPTION_ENUM, offsetof(dyd_engine_options, goal)},
    {"goal_bits", OPTION_BITS, offsetof(dyd_engine_options, goal_bits)},
    {"schedule", OPTION_ENUM, offsetof(dyd_engine_options, schedule)},
    {"start_bits", OPTION_BITS, offsetof(dyd_engine_options, start_bits)},
    {"step_bits", OPTION_BITS, offsetof(dyd_engine_options, step_bits)},
    {"max_bits", OPTION_BITS, offsetof(dyd_engine_options, max_bits)},
    {"max_stages", OPTION_U64, offsetof(dyd_engine_options, max_stages)},
    {"max_calls", OPTION_U64, offsetof(dyd_engine_options, max_calls)},
    {"max_pairs", OPTION_COUNT, offsetof(dyd_engine_options, max_pairs)},
    {"seconds", OPTION_SECONDS, offsetof(dyd_engine_options, seconds)},
    {"threads", OPTION_UNSIGNED, offsetof(dyd_engine_options, threads)},
    {"tie_bits", OPTION_BITS, offsetof(dyd_engine_options, tie_bits)},
    {"no_ties", OPTION_BOOL, offsetof(dyd_engine_options, no_ties)},
    {"max_bytes", OPTION_U64, offsetof(dyd_engine_options, max_bytes)},
};

static void option_set(void *at, option_kind kind, PyObject *value) {
  if (kind == OPTION_ENUM) *(int *)at = (int)PyLong_AsLong(value);
  if (kind == OPTION_BITS) *(int64_t *)at = PyLong_AsLongLong(value);
  if (kind == OPTION_COUNT) *(size_t *)at = PyLong_AsSize_t(value);
  if (kind == OPTION_U64) *(uint64_t *)at = PyLong_AsUnsignedLongLong(value);
  if (kind == OPTION_UNSIGNED) *(unsigned *)at = (unsigned)PyLong_AsUnsignedLong(value);
  if (kind == OPTION_SECONDS) *(double *)at = PyFloat_AsDouble(value);
  if (kind == OPTION_BOOL) *(bool *)at = PyObject_IsTrue(value) > 0;
}

/* A dict of bits by points, or None. */
static dyd_status policy_answer(dyd_wants *wants, PyObject *answer) {
  PyObject *point, *bits;
  Py_ssize_t at = 0;
  if (answer == Py_None) return DYD_OK;
  if (!PyDict_Check(answer))
    PyErr_Format(PyExc_TypeError, "policy returned %R; return a dict of bits by points, or None for the plan", answer);
  while (!PyErr_Occurred() && PyDict_Next(answer, &at, &point, &bits)) {
    Py_ssize_t i = PyNumber_AsSsize_t(point, PyExc_OverflowError);
    long long b = PyLong_AsLongLong(bits);
    if (PyErr_Occurred()) break;
    dyd_status st = dyd_wants_add(wants, i < 0 || i > UINT32_MAX ? UINT32_MAX : (uint32_t)i, b);
    if (st != DYD_OK) return st;
  }
  return PyErr_Occurred() ? DYD_E_STREAM : DYD_OK;
}

/* Calls policy(pairs, plan): a list of undecided pairs, and a dict of bits by points. */
static dyd_status python_policy(dyd_wants *wants, PyObject *policy, const dyd_pair_list *pairs,
                                const dyd_request *request, size_t count) {
  OWNED *list = PyList_New(0), *dict = PyDict_New(), *answer = NULL;
  for (size_t k = 0; list && !PyErr_Occurred() && k < pairs->count; k++) {
    if (pairs->item[k].status != DYD_INDETERMINATE) continue;
    OWNED *pair = Py_BuildValue("II", pairs->item[k].i, pairs->item[k].j);
    if (pair) PyList_Append(list, pair);
  }
  for (size_t k = 0; dict && !PyErr_Occurred() && k < count; k++) {
    const dyd_request *r = dyd_request_at(request, k);
    OWNED *point = PyLong_FromSize_t(r->point), *bits = PyLong_FromLongLong(r->bits);
    if (point && bits) PyDict_SetItem(dict, point, bits);
  }
  if (list && dict && !PyErr_Occurred()) answer = PyObject_CallFunctionObjArgs(policy, list, dict, NULL);
  return answer ? policy_answer(wants, answer) : DYD_E_STREAM;
}

static dyd_status policy_asked(dyd_wants *wants, void *user, const dyd_engine *e, const dyd_request *request,
                               size_t count, dyd_error *err) {
  SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = dyd_engine_delaunay(e) ? dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(e)) : DYD_OK;
  PyGILState_STATE gil = PyGILState_Ensure();
  if (st == DYD_OK) st = PyErr_Occurred() ? DYD_E_STREAM : python_policy(wants, user, &pairs, request, count);
  if (PyErr_Occurred()) st = dyd_error_set(err, DYD_E_STREAM, "the policy raised an exception");
  PyGILState_Release(gil);
  return st;
}

/* A function, or the text of a command. */
static void option_policy(dyd_engine_options *o, PyObject *policy) {
  if (PyUnicode_Check(policy)) {
    o->policy_program = PyUnicode_AsUTF8AndSize(policy, NULL);
  } else {
    o->policy = policy_asked;
    o->policy_user = policy;
  }
}

/* Doubles, one for each point. */
static void option_costs(dydpy_options *out, dydpy_engine *self, PyObject *cost) {
  if (PyObject_GetBuffer(cost, &out->cost, PyBUF_SIMPLE) < 0) return;
  size_t given = (size_t)out->cost.len / sizeof(double), count = self ? dydpy_points(self) : 0;
  out->o.cost = out->cost.buf;
  if (given != count) PyErr_Format(PyExc_ValueError, "%zu costs of %zu points; give one for each", given, count);
}

int dydpy_options_init(dydpy_options *out, dydpy_engine *self, PyObject *dict) {
  bool given = false;
  dyd_rect_init(&out->window);
  out->cost = (Py_buffer){0};
  dyd_engine_options_init(&out->o);
  out->o.start_bits = 0;
  for (size_t k = 0; k < sizeof option_table / sizeof *option_table; k++) {
    PyObject *value = PyDict_GetItemString(dict, option_table[k].name);
    if (value) option_set((char *)&out->o + option_table[k].at, option_table[k].kind, value);
  }
  PyObject *window = PyDict_GetItemString(dict, "window"), *progress = PyDict_GetItemString(dict, "progress");
  PyObject *cost = PyDict_GetItemString(dict, "cost"), *policy = PyDict_GetItemString(dict, "policy");
  if (!PyErr_Occurred() && cost) option_costs(out, self, cost);
  if (!PyErr_Occurred() && policy) option_policy(&out->o, policy);
  if (!PyErr_Occurred() && window) dydpy_window_take(&out->window, &given, window);
  if (given) out->o.window = &out->window;
  out->progress = (dydpy_progress_user){progress, self ? self->engine : NULL, self ? self->trace : NULL};
  if (self && (self->trace || (progress && progress != Py_None))) {
    out->o.progress = progress_told;
    out->o.progress_user = &out->progress;
    out->o.trace = self->trace ? dyd_trace_step : NULL;
    out->o.trace_user = self->trace;
  }
  return PyErr_Occurred() ? -1 : 0;
}

void dydpy_options_clear(dydpy_options *o) {
  PyBuffer_Release(&o->cost);
  dyd_rect_clear(&o->window);
}

/* One run; *again: an interrupt ended it, and the handler of interrupts raised nothing. */
static dyd_status run_once(bool *again, dydpy_engine *self, const dyd_engine_options *o, dyd_error *err) {
  dyd_outcome outcome;
  dydpy_guard guard;
  dydpy_guard_begin(&guard, self->engine, NULL);
  PyThreadState *thread = PyEval_SaveThread();
  dyd_status st =
      self->sphere ? dyd_sphere_run(&outcome, self->sphere, o, err) : dyd_engine_run(&outcome, self->engine, o, err);
  PyEval_RestoreThread(thread);
  bool cancelled = outcome == DYD_OUTCOME_CANCELLED, ours = guard.hit || self->late;
  int raised = dydpy_guard_end(&guard);
  self->late = guard.hit && !cancelled;
  *again = raised == 0 && cancelled && ours;
  return st;
}

/* run(options) */
PyObject *dydpy_run(PyObject *object, PyObject *dict) {
  dydpy_engine *self = (dydpy_engine *)object;
  dyd_status st = DYD_OK;
  dydpy_call c;
  if (!PyDict_Check(dict)) return PyErr_Format(PyExc_TypeError, "options are a dict");
  SCOPED(dydpy_options) o;
  if (dydpy_options_init(&o, self, dict) < 0) return NULL;
  bool entered = dydpy_begin(&c, object, DYDPY_HOLDS), again = entered;
  while (again) st = run_once(&again, self, &o.o, &c.err);
  return entered ? dydpy_end_none(&c, st) : NULL;
}

PyObject *dydpy_cancel(PyObject *self, PyObject *Py_UNUSED(none)) {
  if (((dydpy_engine *)self)->engine) dyd_engine_cancel(((dydpy_engine *)self)->engine);
  Py_RETURN_NONE;
}
