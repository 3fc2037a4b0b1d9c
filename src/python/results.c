/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What an engine or a sphere has found, as numbers, as memory that numpy reads, and in the formats of the command;
 * questions that take a while; certificates and their check. Numbers of a sphere's points are those of its places. */
#include "module.h"

#include <stdlib.h>
#include <string.h>

/* ---- single answers ---- */

PyObject *dydpy_count(PyObject *self, PyObject *Py_UNUSED(none)) {
  return PyLong_FromSize_t(dydpy_points((dydpy_engine *)self));
}

PyObject *dydpy_outcome(PyObject *self, PyObject *Py_UNUSED(none)) {
  dydpy_call c;
  if (!dydpy_begin(&c, self, DYDPY_HOLDS)) return NULL;
  dyd_outcome outcome = c.self->sphere ? dyd_sphere_outcome(c.self->sphere) : dyd_engine_outcome(c.self->engine);
  return dydpy_end(&c, DYD_OK) ? PyUnicode_FromString(dyd_outcome_text(outcome)) : NULL;
}

static PyObject *spent_name(dyd_budget spent) {
  static const char *const name[] = {"bits", "stages", "calls", "pairs", "seconds"};
  size_t k = (size_t)spent - 1;
  if (k >= sizeof name / sizeof *name) Py_RETURN_NONE;
  return PyUnicode_FromString(name[k]);
}

PyObject *dydpy_counters(PyObject *object, PyObject *Py_UNUSED(none)) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dydpy_call call;
  if (!dydpy_begin(&call, object, 0) || !dydpy_end(&call, dyd_engine_get_counters(&c, call.self->engine, &call.err)))
    return NULL;
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

PyObject *dydpy_counts(PyObject *self, PyObject *Py_UNUSED(none)) {
  size_t count[4];
  dydpy_call c;
  if (!dydpy_begin(&c, self, DYDPY_RESULT | DYDPY_HOLDS)) return NULL;
  dyd_delaunay_count(count, c.pd);
  if (!dydpy_end(&c, DYD_OK)) return NULL;
  return Py_BuildValue("nnn", (Py_ssize_t)count[DYD_LEGAL], (Py_ssize_t)count[DYD_INDETERMINATE],
                       (Py_ssize_t)count[DYD_TIE]);
}

PyObject *dydpy_pair_status(PyObject *self, PyObject *args) {
  Py_ssize_t i, j;
  uint32_t first, second;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "nn", &i, &j) || !dydpy_site(&first, (dydpy_engine *)self, i) ||
      !dydpy_site(&second, (dydpy_engine *)self, j) || !dydpy_begin(&c, self, DYDPY_RESULT | DYDPY_HOLDS))
    return NULL;
  dyd_pair_status status = dyd_delaunay_status(c.pd, first, second);
  return dydpy_end(&c, DYD_OK) ? PyLong_FromLong(status) : NULL;
}

PyObject *dydpy_bounds(PyObject *object, PyObject *Py_UNUSED(none)) {
  dydpy_call c;
  LOCAL(dyd_dyadic, area);
  LOCAL(dyd_dyadic, hausdorff);
  if (!dydpy_begin(&c, object, DYDPY_RESULT) || !dydpy_end(&c, dyd_engine_bounds(&area, &hausdorff, c.self->engine)))
    return NULL;
  return Py_BuildValue("NN", dydpy_dyadic(&area), dydpy_dyadic(&hausdorff));
}

PyObject *dydpy_rect(PyObject *object, PyObject *site) {
  Py_ssize_t number = PyLong_AsSsize_t(site);
  uint32_t i;
  dydpy_call c;
  if (PyErr_Occurred() || !dydpy_site(&i, (dydpy_engine *)object, number) || !dydpy_begin(&c, object, 0)) return NULL;
  LOCAL(dyd_rect, r);
  bool known = c.self->sphere || dyd_engine_knows(c.self->engine, i);
  dyd_status st = !known           ? DYD_OK
                  : c.self->sphere ? dyd_sphere_rect(&r, c.self->sphere, i)
                                   : dyd_sites_get(&r, dyd_engine_sites(c.self->engine), i);
  if (dydpy_end(&c, st) && known) return dydpy_rect_ends(&r);
  if (!known) PyErr_Format(PyExc_RuntimeError, "point %zd has not been asked yet; call refine()", number);
  return NULL;
}

PyObject *dydpy_window(PyObject *object, PyObject *Py_UNUSED(none)) {
  dydpy_call c;
  LOCAL(dyd_rect, r);
  if (!dydpy_begin(&c, object, DYDPY_RESULT)) return NULL;
  return dydpy_end(&c, dyd_voronoi_window(&r, dyd_delaunay_sites(c.pd))) ? dydpy_rect_ends(&r) : NULL;
}

PyObject *dydpy_centre(PyObject *self, PyObject *Py_UNUSED(none)) {
  uint32_t centre = dyd_sphere_centre(((dydpy_engine *)self)->sphere);
  if (centre == DYD_NO_PLACE) Py_RETURN_NONE;
  return PyLong_FromUnsignedLong(centre);
}

/* ---- arrays ---- */

/* An array of the library, which is taken out of its place. */
static PyObject *array_taken(void *place, size_t size) {
  void *bytes;
  memcpy(&bytes, place, sizeof bytes);
  memset(place, 0, sizeof bytes);
  return dydpy_buffer_new(bytes, size);
}
#define TAKEN(array, count) array_taken((void *)&(array), (count) * sizeof *(array))

static PyObject *copied(const void *from, size_t size) {
  void *to = malloc(size + 1);
  if (!to) return PyErr_NoMemory();
  if (size) memcpy(to, from, size);
  return dydpy_buffer_new(to, size);
}

PyObject *dydpy_pairs(PyObject *self, PyObject *Py_UNUSED(none)) {
  SCOPED(dyd_pair_list) list = {0};
  dydpy_call c;
  if (!dydpy_begin(&c, self, DYDPY_RESULT)) return NULL;
  dyd_status st = c.self->sphere ? dyd_sphere_pairs(&list, c.self->sphere) : dyd_delaunay_pairs(&list, c.pd);
  return dydpy_end(&c, st) ? TAKEN(list.item, list.count) : NULL;
}

PyObject *dydpy_discs(PyObject *self, PyObject *Py_UNUSED(none)) {
  SCOPED(dyd_pair_list) list = {0};
  dydpy_call c;
  if (!dydpy_begin(&c, self, DYDPY_RESULT)) return NULL;
  return dydpy_end(&c, dyd_disc_pairs(&list, c.pd, NULL, &c.err)) ? TAKEN(list.item, list.count) : NULL;
}

/* On a sphere corners only; neighbours are found in Python. */
PyObject *dydpy_triangles(PyObject *self, PyObject *Py_UNUSED(none)) {
  SCOPED(dyd_triangle_list) list = {0}, beyond = {0};
  dydpy_call c;
  if (!dydpy_begin(&c, self, DYDPY_RESULT)) return NULL;
  dyd_status st = c.self->sphere ? dyd_sphere_triangles(&list, c.self->sphere)
                                 : dyd_delaunay_triangles(&list, &beyond, c.pd, DYD_TRIANGLES_AS_FOUND);
  if (!dydpy_end(&c, st)) return NULL;
  return Py_BuildValue("NN", TAKEN(list.item, list.count), TAKEN(beyond.item, beyond.count));
}

PyObject *dydpy_aliases(PyObject *self, PyObject *Py_UNUSED(none)) {
  dydpy_call c;
  const dyd_sphere *sphere = ((dydpy_engine *)self)->sphere;
  if (!dydpy_begin(&c, self, sphere ? 0 : DYDPY_RESULT)) return NULL;
  size_t n = dydpy_points(c.self);
  FREED uint32_t *alias = malloc((n + 1) * sizeof *alias);
  for (uint32_t i = 0; alias && i < n; i++)
    alias[i] = sphere ? dyd_sphere_alias(sphere, i) : dyd_delaunay_alias(c.pd, i);
  return dydpy_end(&c, alias ? DYD_OK : DYD_E_NOMEM) ? TAKEN(alias, n) : NULL;
}

PyObject *dydpy_hull(PyObject *self, PyObject *Py_UNUSED(none)) {
  SCOPED(dyd_hull) hull = {0};
  dyd_index_list *sure = &hull.sure_vertices, *possible = &hull.possible_vertices;
  dydpy_call c;
  if (!dydpy_begin(&c, self, DYDPY_RESULT) || !dydpy_end(&c, dyd_delaunay_partial_hull(&hull, c.pd, false)))
    return NULL;
  return Py_BuildValue("NN", TAKEN(sure->item, sure->count), TAKEN(possible->item, possible->count));
}

/* In degrees, of places. */
static dyd_status boxes_of_places(double *box, const dyd_sphere *sphere, size_t n) {
  dyd_status st = DYD_OK;
  LOCAL(dyd_rect, r);
  for (uint32_t i = 0; i < n && st == DYD_OK; i++) {
    st = dyd_sphere_rect(&r, sphere, i);
    if (st == DYD_OK) dyd_rect_get_d(box + 4 * (size_t)i, &r);
  }
  return st;
}

PyObject *dydpy_boxes(PyObject *self, PyObject *Py_UNUSED(none)) {
  dydpy_call c;
  if (!dydpy_begin(&c, self, 0)) return NULL;
  size_t n = dydpy_points(c.self);
  FREED double *box = malloc((4 * n + 1) * sizeof *box);
  dyd_status st = box ? DYD_OK : DYD_E_NOMEM;
  if (box && c.self->sphere) st = boxes_of_places(box, c.self->sphere, n);
  const dyd_sites *sites = c.self->sphere ? NULL : dyd_engine_sites(c.self->engine);
  for (size_t i = 0; box && sites && i < n; i++) dyd_sites_get_d(box + 4 * i, sites, i);
  return dydpy_end(&c, st) ? TAKEN(box, 4 * n) : NULL;
}

/* ---- cells and tiles ---- */

/* Begins a call about the diagram on a window, None: the default one; false with an exception set. */
static bool diagram_begin(dydpy_call *c, dyd_rect *view, PyObject *self, PyObject *window) {
  bool given = false;
  if (dydpy_window_take(view, &given, window) < 0 || !dydpy_begin(c, self, DYDPY_RESULT | DYDPY_CANCELS)) return false;
  dyd_status st = given ? DYD_OK : dyd_voronoi_window(view, dyd_delaunay_sites(c->pd));
  return st == DYD_OK || (dydpy_end(c, st), false);
}

/* Sets o->pairs to the statuses of discs in `list`, which is empty, if `discs` is set. */
static dyd_status take_discs(dyd_write_options *o, dyd_pair_list *list, dydpy_call *c, int discs) {
  if (!discs) return DYD_OK;
  o->pairs = list;
  return dyd_disc_pairs(list, c->pd, &c->cancel, &c->err);
}

PyObject *dydpy_cells(PyObject *self, PyObject *args) {
  PyObject *window, *bits;
  SCOPED(dyd_cells) found = {0};
  SCOPED(dyd_pair_list) pairs = {0};
  LOCAL(dyd_voronoi_bounds, bounds);
  LOCAL(dyd_rect, view);
  int discs;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "OOp", &window, &bits, &discs)) return NULL;
  dyd_write_options o = {DYD_SIZED(dyd_write_options), .bounds = &bounds, .window = &view, .cancel = &c.cancel};
  o.flatten_set = bits != Py_None;
  if (o.flatten_set) o.flatten_bits = PyLong_AsLongLong(bits);
  if (PyErr_Occurred() || !diagram_begin(&c, &view, self, window)) return NULL;
  dyd_status st = take_discs(&o, &pairs, &c, discs);
  if (st == DYD_OK) st = dyd_voronoi_cells(&found, c.self->engine, &o, &c.err);
  if (!dydpy_end(&c, st == DYD_CAPPED ? DYD_E_ARG : st)) return NULL;
  size_t count = found.count, vertices = count ? found.ring[count - 1].end : 0;
  return Py_BuildValue("NNNLNNN", TAKEN(found.ring, count), TAKEN(found.xy, 2 * vertices),
                       TAKEN(found.area, 2 * found.sites), (long long)found.bits, dydpy_dyadic(&bounds.area),
                       dydpy_dyadic(bounds.finite ? &bounds.hausdorff : NULL), dydpy_rect_ends(&view));
}

/* frame(window or None, flatten_bits, discs) */
PyObject *dydpy_frame(PyObject *self, PyObject *args) {
  PyObject *window;
  SCOPED(dyd_frame) f = {0};
  SCOPED(dyd_pair_list) pairs = {0};
  LOCAL(dyd_rect, view);
  long long bits;
  int discs;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "OLp", &window, &bits, &discs) || !diagram_begin(&c, &view, self, window)) return NULL;
  dyd_write_options o = {DYD_SIZED(dyd_write_options), .window = &view, .cancel = &c.cancel, .flatten_set = true,
                         .flatten_bits = bits};
  dyd_status st = take_discs(&o, &pairs, &c, discs);
  if (st == DYD_OK) st = dyd_voronoi_frame(&f, c.self->engine, &o, &c.err);
  if (!dydpy_end(&c, st == DYD_CAPPED ? DYD_E_ARG : st)) return NULL;
  size_t boxes = f.vertices + f.regions, sites = boxes ? f.end[boxes - 1] : 0;
  return Py_BuildValue("nNNNNNN", (Py_ssize_t)f.vertices, TAKEN(f.box, 4 * boxes), TAKEN(f.end, boxes),
                       TAKEN(f.site, sites), TAKEN(f.face, f.regions), TAKEN(f.edge, f.edges), TAKEN(f.ray, f.rays));
}

PyObject *dydpy_tiles(PyObject *self, PyObject *args) {
  PyObject *window;
  SCOPED(dyd_tiles) t = {0};
  LOCAL(dyd_rect, view);
  long long bits;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "OL", &window, &bits) || !diagram_begin(&c, &view, self, window) ||
      !dydpy_end(&c, dyd_voronoi_tiles(&t, c.pd, &view, bits, &c.cancel)))
    return NULL;
  size_t n = t.count, vertices = n ? t.offset[n] : 0;
  return Py_BuildValue("NNNNNd", TAKEN(t.site, n), TAKEN(t.offset, n ? n + 1 : 0), TAKEN(t.xy, 2 * vertices),
                       TAKEN(t.area, n), TAKEN(t.bound, 2 * n), t.rounding);
}

PyObject *dydpy_exact_area(PyObject *self, PyObject *args) {
  PyObject *window;
  Py_ssize_t number;
  uint32_t i;
  bool exact = false;
  LOCAL(dyd_rect, view);
  LOCAL_Q(area);
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "nO", &number, &window) || !dydpy_site(&i, (dydpy_engine *)self, number) ||
      !diagram_begin(&c, &view, self, window) || !dydpy_end(&c, dyd_voronoi_exact_area(area, &exact, c.pd, i, &view)))
    return NULL;
  return exact ? dydpy_ratio(area) : Py_NewRef(Py_None);
}

/* ---- nearest ---- */

PyObject *dydpy_nearest(PyObject *self, PyObject *args) {
  PyObject *point, *dict, *answer = NULL;
  SCOPED(dyd_index_list) found = {0};
  dyd_outcome outcome;
  bool sure = false;
  dyd_stream *at = NULL;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "OO!", &point, &PyDict_Type, &dict) || dydpy_stream(&at, point, NULL) < 0) return NULL;
  SCOPED(dydpy_options) o;
  if (dydpy_options_init(&o, (dydpy_engine *)self, dict) == 0 && dydpy_begin(&c, self, DYDPY_RESULT | DYDPY_REFINES) &&
      dydpy_end(&c, dyd_engine_nearest(&found, &sure, &outcome, c.self->engine, at, &o.o, &c.err)))
    answer = Py_BuildValue("NNNsN", copied(found.item, found.count * sizeof *found.item), PyBool_FromLong(sure),
                           PyBool_FromLong(dyd_engine_nearest_tied(c.self->engine)), dyd_outcome_text(outcome),
                           dydpy_rect_ends(dyd_stream_rect(at)));
  dyd_stream_free(at);
  return answer;
}

/* ---- many places ---- */

/* Doubles x, y of places: how many; -1 with an exception set. */
static Py_ssize_t places_of(Py_buffer *xy, PyObject *args) {
  if (!PyArg_ParseTuple(args, "y*", xy)) return -1;
  return xy->len / (Py_ssize_t)(2 * sizeof(double));
}

PyObject *dydpy_locate(PyObject *self, PyObject *args) {
  Py_buffer xy;
  dydpy_call c;
  Py_ssize_t n = places_of(&xy, args);
  if (n < 0) return NULL;
  FREED dyd_triangle *triangle = malloc((size_t)(n + 1) * sizeof *triangle);
  FREED dyd_truth *in = malloc((size_t)(n + 1) * sizeof *in);
  bool good = dydpy_begin(&c, self, DYDPY_RESULT | DYDPY_CANCELS);
  if (good)
    good = dydpy_end(&c, triangle && in ? dyd_delaunay_locate(triangle, in, c.pd, xy.buf, (size_t)n, &c.cancel)
                                        : DYD_E_NOMEM);
  PyBuffer_Release(&xy);
  return good ? Py_BuildValue("NN", TAKEN(triangle, (size_t)n), TAKEN(in, (size_t)n)) : NULL;
}

/* A question about many places. */
typedef dyd_status places_call(dyd_place_list *out, const dyd_delaunay *pd, const double *xy, size_t count,
                               const volatile int *cancel);

static PyObject *places_ask(places_call *ask, PyObject *self, PyObject *args) {
  Py_buffer xy;
  SCOPED(dyd_place_list) l = {0};
  dydpy_call c;
  Py_ssize_t n = places_of(&xy, args);
  if (n < 0) return NULL;
  bool good = dydpy_begin(&c, self, DYDPY_RESULT | DYDPY_CANCELS);
  if (good) good = dydpy_end(&c, ask(&l, c.pd, xy.buf, (size_t)n, &c.cancel));
  PyBuffer_Release(&xy);
  if (!good) return NULL;
  size_t sites = n ? l.end[n - 1] : 0;
  return Py_BuildValue("NNN", TAKEN(l.site, sites), TAKEN(l.end, (size_t)n), TAKEN(l.sure, (size_t)n));
}

PyObject *dydpy_nearest_places(PyObject *self, PyObject *args) {
  return places_ask(dyd_nearest_places, self, args);
}

PyObject *dydpy_corners(PyObject *self, PyObject *args) {
  return places_ask(dyd_delaunay_corners, self, args);
}

/* ---- graphs ---- */

/* As three numbers, which numpy reads as it reads pairs. */
static PyObject *graph_found(const dyd_graph_list *list) {
  int32_t *row = malloc((3 * list->count + 1) * sizeof *row);
  for (size_t k = 0; row && k < list->count; k++) {
    const dyd_graph_edge *edge = &list->item[k];
    row[3 * k] = (int32_t)edge->i;
    row[3 * k + 1] = (int32_t)edge->j;
    row[3 * k + 2] = edge->sure;
  }
  return row ? dydpy_buffer_new(row, 3 * list->count * sizeof *row) : PyErr_NoMemory();
}

PyObject *dydpy_graph(PyObject *self, PyObject *args) {
  SCOPED(dyd_graph_list) list = {0};
  dyd_outcome outcome;
  PyObject *dict;
  int graph, discs;
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "iO!p", &graph, &PyDict_Type, &dict, &discs)) return NULL;
  SCOPED(dydpy_options) o;
  if (dydpy_options_init(&o, (dydpy_engine *)self, dict) < 0) return NULL;
  o.o.discs = discs;
  if (!dydpy_begin(&c, self, DYDPY_RESULT | DYDPY_REFINES) ||
      !dydpy_end(&c, dyd_engine_graph(&list, &outcome, c.self->engine, (dyd_graph)graph, &o.o, &c.err)))
    return NULL;
  return Py_BuildValue("Ns", graph_found(&list), dyd_outcome_text(outcome));
}

/* ---- tolerance ---- */

/* Returns None if they were not requested. */
static PyObject *doubles_or_none(const double *value, size_t count) {
  return value ? copied(value, count * sizeof *value) : Py_NewRef(Py_None);
}

static PyObject *tolerance_found(const dyd_tolerance *t, size_t points) {
  const dyd_tolerance_result *r = dyd_tolerance_get(t);
  const dyd_tolerance_row *row;
  size_t rows = dyd_tolerance_rows(&row, t);
  return Py_BuildValue("N(dd)NN", copied(row, rows * sizeof *row), r->lo, r->hi, doubles_or_none(r->points, points),
                       doubles_or_none(r->chances, rows));
}

/* *out becomes the numbers of all points, the caller's. DYD_E_NOMEM. */
static dyd_status row_numbers(double **out, const dyd_engine *e, dyd_row_number which) {
  size_t n = dyd_engine_count(e);
  double *number = malloc((n + 1) * sizeof *number);
  if (!number) return DYD_E_NOMEM;
  for (size_t i = 0; i < n; i++) number[i] = dyd_engine_number(e, i, which);
  *out = number;
  return DYD_OK;
}

/* With the weights and the standard deviations that a text gave. */
static dyd_status tolerance_new(dyd_tolerance **out, dydpy_call *c, dyd_tolerance_options *o) {
  FREED double *weight = NULL, *sigmas = NULL;
  dyd_status st = c->self->weights ? row_numbers(&weight, c->self->engine, DYD_ROW_RADIUS) : DYD_OK;
  if (st == DYD_OK && c->self->sigmas && o->sigma == 0) st = row_numbers(&sigmas, c->self->engine, DYD_ROW_SIGMA);
  o->weight = weight;
  o->sigmas = sigmas;
  dyd_outcome outcome;
  return st == DYD_OK ? dyd_engine_tolerance(out, &outcome, c->self->engine, o, 0, NULL, &c->err) : st;
}

PyObject *dydpy_tolerance(PyObject *self, PyObject *args) {
  PyObject *up_to, *found = NULL;
  int points, box;
  Py_ssize_t max_pairs;
  double sigma;
  dyd_tolerance *t = NULL;
  LOCAL_Q(most);
  dydpy_call c;
  if (!PyArg_ParseTuple(args, "Opndp", &up_to, &points, &max_pairs, &sigma, &box)) return NULL;
  dyd_tolerance_options o = {DYD_SIZED(dyd_tolerance_options),
                             .points = points,
                             .max_pairs = (size_t)max_pairs,
                             .sigma = sigma,
                             .metric = box ? DYD_METRIC_BOX : DYD_METRIC_EUCLID,
                             .up_to = up_to == Py_None ? NULL : most,
                             .cancel = &c.cancel};
  if ((up_to == Py_None || dydpy_rational(most, up_to) == 0) && dydpy_begin(&c, self, DYDPY_REFINES) &&
      dydpy_end(&c, tolerance_new(&t, &c, &o)))
    found = tolerance_found(t, dyd_engine_count(c.self->engine));
  dyd_tolerance_free(t);
  return found;
}

/* ---- plan ---- */

static PyObject *plan_found(const dyd_survey *s) {
  const dyd_survey_result *r = dyd_survey_get(s);
  const dyd_survey_row *row;
  size_t rows = dyd_survey_rows(&row, s);
  return Py_BuildValue("N(nnn)", copied(row, rows * sizeof *row), (Py_ssize_t)r->open, (Py_ssize_t)r->ties,
                       (Py_ssize_t)r->left);
}

/* The plan, or its trials where `trials` is above 0. */
static PyObject *plan_asked(PyObject *self, PyObject *accuracy, PyObject *window, PyObject *site, int discs,
                            Py_ssize_t trials, uint64_t seed) {
  PyObject *found = NULL;
  dyd_survey *survey = NULL;
  FREED dyd_survey_trial *trial = NULL;
  bool windowed = false;
  uint32_t only = 0;
  dydpy_call c;
  if (site != Py_None && !dydpy_site(&only, (dydpy_engine *)self, PyLong_AsSsize_t(site))) return NULL;
  if (trials && !(trial = calloc((size_t)trials, sizeof *trial))) return PyErr_NoMemory();
  LOCAL_Q(exact);
  LOCAL(dyd_rect, view);
  if (!PyErr_Occurred() && (accuracy == Py_None || dydpy_rational(exact, accuracy) == 0) &&
      dydpy_window_take(&view, &windowed, window) == 0 && dydpy_begin(&c, self, DYDPY_RESULT | DYDPY_CANCELS)) {
    const dyd_survey_options o = {DYD_SIZED(dyd_survey_options),
                                  .window = windowed ? &view : NULL,
                                  .site = site != Py_None ? &only : NULL,
                                  .accuracy = accuracy != Py_None ? exact : NULL,
                                  .cancel = &c.cancel,
                                  .discs = discs};
    const dyd_status st = trials ? dyd_survey_simulate(trial, (size_t)trials, seed, c.pd, &o, &c.err)
                                 : dyd_survey_new(&survey, c.pd, &o, &c.err);
    if (dydpy_end(&c, st)) found = trials ? copied(trial, (size_t)trials * sizeof *trial) : plan_found(survey);
  }
  dyd_survey_free(survey);
  return found;
}

PyObject *dydpy_plan(PyObject *self, PyObject *args) {
  PyObject *accuracy, *window, *site;
  int discs;
  if (!PyArg_ParseTuple(args, "OOOp", &accuracy, &window, &site, &discs)) return NULL;
  return plan_asked(self, accuracy, window, site, discs, 0, 0);
}

PyObject *dydpy_simulate(PyObject *self, PyObject *args) {
  PyObject *accuracy, *window, *site;
  int discs;
  Py_ssize_t trials;
  unsigned long long seed;
  if (!PyArg_ParseTuple(args, "OOOpnK", &accuracy, &window, &site, &discs, &trials, &seed)) return NULL;
  if (trials > 0) return plan_asked(self, accuracy, window, site, discs, trials, seed);
  return PyErr_Format(PyExc_ValueError, "simulate=%zd; give a number of trials above 0", trials);
}

/* ---- texts ---- */

PyObject *dydpy_formats(PyObject *module, PyObject *Py_UNUSED(none)) {
  PyObject *list = PyList_New(0);
  (void)module;
  const dyd_format_facts *f;
  for (int k = 0; list && (f = dyd_format_get((dyd_format)k)); k++) {
    OWNED *row = Py_BuildValue("ssN", f->name, f->about, PyBool_FromLong(f->binary));
    if (!row || PyList_Append(list, row) < 0) Py_CLEAR(list);
  }
  return list;
}

/* A text being written by a call. */
typedef struct text_order {
  dyd_format format;
  dyd_content layer;
  dyd_rect window;
  const dyd_rect *view; /* the window; NULL: none */
  int discs;            /* of a diagram: of the discs in the squares */
  dydpy_text text;
  dydpy_call call;
} text_order;

/* A format and a layer of `of`, by their names (layer_name NULL: none); false with ValueError. */
static bool order_form(text_order *t, dyd_content of, const char *name, const char *layer_name) {
  t->layer = of;
  if (!dyd_format_from_name(&t->format, name)) {
    PyErr_Format(PyExc_ValueError, "there is no format \"%s\"; see dyadel.formats()", name);
    return false;
  }
  if (!layer_name || dyd_layer_from_name(&t->layer, of, layer_name)) return true;
  PyErr_Format(PyExc_ValueError, "there is no layer \"%s\"", layer_name);
  return false;
}

/* Begins the call; false with an exception set and nothing to end. */
static bool order_begin(text_order *t, PyObject *self, PyObject *window, int how) {
  bool windowed = false;
  dyd_rect_init(&t->window);
  if (dydpy_window_take(&t->window, &windowed, window) == 0 && dydpy_text_open(&t->text)) {
    t->view = windowed ? &t->window : NULL;
    if (dydpy_begin(&t->call, self, how)) return true;
    dydpy_text_close(&t->text, false);
  }
  dyd_rect_clear(&t->window);
  return false;
}

static PyObject *order_end(text_order *t, dyd_status st) {
  bool good = dydpy_end(&t->call, st);
  dyd_rect_clear(&t->window);
  return dydpy_text_close(&t->text, good);
}

/* Writes the content of the order, and ends it. */
static PyObject *order_write(text_order *t, dyd_write_options *o) {
  o->sphere = t->call.self->sphere;
  o->window = t->view;
  o->cancel = &t->call.cancel;
  const dyd_engine *e = o->sphere ? NULL : t->call.self->engine;
  SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = take_discs(o, &pairs, &t->call, t->discs);
  if (st == DYD_OK) st = dyd_write(t->text.file, e, t->layer, t->format, o, &t->call.err);
  return order_end(t, st == DYD_CAPPED ? DYD_E_ARG : st);
}

PyObject *dydpy_write(PyObject *self, PyObject *args) {
  const bool globe = ((dydpy_engine *)self)->sphere;
  dyd_write_options o = {DYD_SIZED(dyd_write_options)};
  const char *format, *layer;
  PyObject *window;
  text_order t = {0};
  if (!PyArg_ParseTuple(args, "szOI", &format, &layer, &window, &o.epsg)) return NULL;
  if (globe && window != Py_None) return PyErr_Format(PyExc_ValueError, "a window is a part of the plane; remove it");
  if (!order_form(&t, globe ? DYD_CONTENT_SPHERE : DYD_CONTENT_DELAUNAY, format, layer) ||
      !order_begin(&t, self, window, DYDPY_RESULT | DYDPY_CANCELS))
    return NULL;
  return order_write(&t, &o);
}

PyObject *dydpy_write_voronoi(PyObject *self, PyObject *args) {
  const bool globe = ((dydpy_engine *)self)->sphere;
  dyd_write_options o = {DYD_SIZED(dyd_write_options)};
  const char *format, *layer;
  PyObject *window, *bits;
  text_order t = {0};
  if (!PyArg_ParseTuple(args, "szOOIp", &format, &layer, &window, &bits, &o.epsg, &t.discs)) return NULL;
  o.flatten_set = bits != Py_None;
  if (o.flatten_set) o.flatten_bits = PyLong_AsLongLong(bits);
  if (PyErr_Occurred() || !order_form(&t, globe ? DYD_CONTENT_SPHERE_VORONOI : DYD_CONTENT_VORONOI, format, layer) ||
      !order_begin(&t, self, window, DYDPY_RESULT | DYDPY_CANCELS))
    return NULL;
  return order_write(&t, &o);
}

/* "disc" and "bisector": of the first rectangles, as json; "hull": of all, at most three, its vertices a line. */
static dyd_status write_piece(text_order *t, const char *name, const dyd_rect *const *r, size_t n) {
  const dyd_write_options o = {DYD_SIZED(dyd_write_options), .rect = r, .rects = n,
                               .outcome = dyd_engine_outcome(t->call.self->engine)};
  dyd_content piece = strcmp(name, "disc") == 0 ? DYD_CONTENT_DISC : DYD_CONTENT_BISECTOR;
  mpq_t xy[24];
  if (strcmp(name, "hull") != 0) return dyd_write(t->text.file, NULL, piece, DYD_FORMAT_JSON, &o, &t->call.err);
  for (int k = 0; k < 24; k++) mpq_init(xy[k]);
  const size_t corners = dyd_rect_hull(xy, r, n);
  for (size_t k = 0; k < corners; k++) gmp_fprintf(t->text.file, "%Qd %Qd\n", xy[2 * k], xy[2 * k + 1]);
  for (int k = 0; k < 24; k++) mpq_clear(xy[k]);
  return DYD_OK;
}

PyObject *dydpy_piece(PyObject *self, PyObject *args) {
  const char *name;
  text_order t;
  if (!PyArg_ParseTuple(args, "s", &name) || !order_begin(&t, self, Py_None, 0)) return NULL;
  const dyd_engine *e = t.call.self->engine;
  size_t n = dyd_engine_count(e);
  FREED dyd_rect *own = malloc((n + 1) * sizeof *own);
  const dyd_rect **r = malloc((n + 1) * sizeof(const dyd_rect *));
  dyd_status st = own && r ? DYD_OK : DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < n; k++) dyd_rect_init(&own[k]), r[k] = &own[k];
  const bool made = st == DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < n; k++) st = dyd_sites_get(&own[k], dyd_engine_sites(e), k);
  if (st == DYD_OK) st = write_piece(&t, name, r, n);
  for (size_t k = 0; made && k < n; k++) dyd_rect_clear(&own[k]);
  free(r);
  return order_end(&t, st);
}

PyObject *dydpy_rects(PyObject *self, PyObject *Py_UNUSED(none)) {
  text_order t;
  if (!order_begin(&t, self, Py_None, 0)) return NULL;
  const dyd_engine *e = t.call.self->engine;
  return order_end(&t, dyd_write_rects(t.text.file, dyd_engine_sites(e), 0, dyd_engine_count(e), &t.call.err));
}

/* ---- certificates ---- */

PyObject *dydpy_certificate(PyObject *self, PyObject *args) {
  int diagram, discs;
  PyObject *window;
  SCOPED(dyd_pair_list) pairs = {0};
  text_order t;
  if (!PyArg_ParseTuple(args, "pOp", &diagram, &window, &discs) || !order_begin(&t, self, window, DYDPY_RESULT))
    return NULL;
  const dydpy_engine *of = t.call.self;
  dyd_certificate_parts parts = {DYD_SIZED(dyd_certificate_parts), .diagram = diagram, .window = t.view,
                                 .discs = discs ? &pairs : NULL, .sphere = diagram ? NULL : of->sphere};
  dyd_status st = discs ? dyd_disc_pairs(&pairs, t.call.pd, &t.call.cancel, &t.call.err) : DYD_OK;
  if (st == DYD_OK) st = dyd_write_certificate(t.text.file, of->engine, &parts, &t.call.err);
  return order_end(&t, st);
}

static PyObject *report_of(const dyd_certificate_report *r) {
  const dydpy_entry entry[] = {
      {"outcome", PyUnicode_FromString(r->outcome)},
      {"goal", PyUnicode_FromString(r->goal)},
      {"goal_bits", PyLong_FromLongLong(r->goal_bits)},
      {"capped", PyBool_FromLong(r->capped)},
      {"points", PyLong_FromSize_t(r->sites)},
      {"aliases", PyLong_FromSize_t(r->aliases)},
      {"legal", PyLong_FromSize_t(r->legal)},
      {"legal_unproved", PyLong_FromSize_t(r->legal_unproved)},
      {"indeterminate", PyLong_FromSize_t(r->indeterminate)},
      {"ties", PyLong_FromSize_t(r->tie)},
      {"ties_unproved", PyLong_FromSize_t(r->ties_unproved)},
      {"unproved", PyLong_FromUnsignedLongLong(r->unproved)},
      {"triangles", PyLong_FromSize_t(r->triangles)},
      {"diagram", PyBool_FromLong(r->diagram)},
      {"bound", PyBool_FromLong(r->bound)},
      {"unlocated", PyLong_FromSize_t(r->unlocated)},
      {"aliases_unproved", PyLong_FromSize_t(r->aliases_unproved)},
      {"proved", PyBool_FromLong(r->gaps == 0)},
  };
  return dydpy_dict(entry, sizeof entry / sizeof *entry);
}

/* of: an Engine, or NULL. */
static PyObject *verify_with(FILE *in, PyObject *of, const dyd_sphere_options *sphere, const dyd_engine_options *o) {
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  dydpy_call c;
  if (!dydpy_begin(&c, of, DYDPY_REFINES)) return NULL;
  const dyd_verify_options about = {DYD_SIZED(dyd_verify_options), .engine = of ? c.self->engine : NULL,
                                    .sphere = sphere, .options = o};
  dyd_status st = dyd_verify_certificate(&report, in, &about, &c.err);
  return dydpy_end(&c, st) ? report_of(&report) : NULL;
}

PyObject *dydpy_verify(PyObject *Py_UNUSED(module), PyObject *args) {
  char *bytes;
  Py_ssize_t length;
  PyObject *of, *dict, *report;
  int sphere;
  dyd_sphere_options on = {DYD_SIZED(dyd_sphere_options)};
  if (!PyArg_ParseTuple(args, "s#OpzzzO!", &bytes, &length, &of, &sphere, &on.radius, &on.radius_unit, &on.radius_scale,
                        &PyDict_Type, &dict))
    return NULL;
  if (of == Py_None) of = NULL;
  SCOPED(dydpy_options) o;
  if (dydpy_options_init(&o, (dydpy_engine *)of, dict) < 0) return NULL;
  FILE *in = fmemopen(bytes, length ? (size_t)length : 1, "r");
  if (!in) return PyErr_NoMemory();
  report = verify_with(in, of, sphere ? &on : NULL, &o.o);
  fclose(in);
  return report;
}
