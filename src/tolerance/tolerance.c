/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tolerances: the public calls. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/float_filter.h"
#include "base/local.h"
#include "tolerance/state.h"

const char *dyd_tolerance_event_text(dyd_tolerance_event event) {
  static const char *const text[] = {"death", "birth", "tie"};
  return event <= DYD_EVENT_TIE ? text[event] : NULL;
}

/* ---- making ---- */

static dyd_status fail_at(dyd_error *err, uint32_t i, const char *why) {
  if (err) err->point = i;
  return dyd_fail(err, DYD_E_ARG, "%s", why);
}

static dyd_status check_points(const dyd_tolerance *t, dyd_error *err) {
  const dyd_sites *sites = t->sk->reps.sites;
  bool known = dyd_sites_are_double_points(sites) && dyd_sites_all_in_doubles(sites);
  for (uint32_t i = 0; i < t->sk->n && !known; i++)
    if (!dyd_sites_is_point(sites, i))
      return fail_at(err, i, "tolerances are those of exact points; give this one by plain numbers");
  if (dyd_delaunay_is_capped(t->pd))
    return dyd_fail(err, DYD_CAPPED, "there are more ties than can be stored; raise `max_pairs`");
  if (t->options.up_to && mpq_sgn(t->options.up_to) < 0)
    return dyd_fail(err, DYD_E_ARG, "births up to a negative number: give a positive one");
  if (t->options.weight && t->options.metric == DYD_METRIC_BOX)
    return dyd_fail(err, DYD_E_ARG, "squares that grow by weights are not supported; remove weights, or the metric");
  for (uint32_t i = 0; t->options.weight && i < t->sk->n; i++)
    if (!(t->options.weight[i] >= 0 && t->options.weight[i] <= 0x1p400))
      return fail_at(err, i, "the weight of a point is not a number >= 0, below 2^400; give one such as 0, 1 or 2.5");
  for (uint32_t i = 0; t->options.sigmas && i < t->sk->n; i++)
    if (!(t->options.sigmas[i] > 0 && t->options.sigmas[i] < HUGE_VAL))
      return fail_at(err, i, "the standard deviation of a point is not a number above 0; give one such as 0.01");
  if (!(t->options.sigma >= 0 && t->options.sigma < HUGE_VAL))
    return dyd_fail(err, DYD_E_ARG, "a standard deviation that is no positive number: give one, or 0 for none");
  return DYD_OK;
}

typedef struct tie_rows {
  dyd_tolerance *t;
  dyd_status status;
} tie_rows;

static void add_tie(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  tie_rows *r = context;
  if (status != DYD_LEGAL && r->status == DYD_OK)
    r->status = dyd_row_add(r->t, dyd_row_of(r->t, v, w, DYD_EVENT_TIE, DYD_NONE, DYD_NONE, 0, 0));
}

/* From sites to vertices; of points at one place the largest. */
static dyd_status take_by_vertex(double **out, double *largest, const dyd_skeleton *sk, const double *of_site,
                                 double all) {
  double *of = *out = dyd_alloc(sk->n, sizeof *of);
  if (!of) return DYD_E_NOMEM;
  for (uint32_t v = 0; v < sk->n; v++) of[v] = of_site ? of_site[sk->reps.site[v]] : all;
  for (uint32_t v = 0; v < sk->n; v++) {
    uint32_t rep = dyd_mesh_alias(&sk->mesh, v);
    if (rep != DYD_NONE && of[rep] < of[v]) of[rep] = of[v];
    if (*largest < of[v]) *largest = of[v];
  }
  return DYD_OK;
}

/* Returns true if the work may continue, if only to collect the results so far. */
static bool may_go_on(dyd_status st) {
  return st == DYD_OK || st == DYD_CANCELLED;
}

static void join_status(dyd_status *st, dyd_status next) {
  if (next != DYD_OK) *st = next;
}

/* Rows from number `first` on become those of weights, or in squares. */
static dyd_status move_rows(dyd_tolerance *t, size_t first) {
  if (t->weight) return dyd_weigh(t, first);
  return t->options.metric == DYD_METRIC_BOX ? dyd_square_rows(t, first) : DYD_OK;
}

/* All rows; with DYD_CANCELLED, the rows reached. */
static dyd_status tolerance_rows(dyd_tolerance *t, dyd_error *err) {
  tie_rows ties = {t, DYD_OK};
  const dyd_tolerance_options *o = &t->options;
  bool births = o->up_to && mpq_sgn(o->up_to);
  t->result.births_left = births ? SIZE_MAX : 0;
  dyd_status st = dyd_deaths(t);
  if (may_go_on(st)) dyd_each_pair(t->pd, DYD_TIE, add_tie, &ties);
  if (may_go_on(st)) join_status(&st, ties.status);
  if (may_go_on(st) && o->weight) join_status(&st, take_by_vertex(&t->weight, &t->heaviest, t->sk, o->weight, 1));
  if (may_go_on(st)) join_status(&st, move_rows(t, 0));
  size_t deaths = t->rows;
  if (st == DYD_OK && births) st = dyd_births(t, err);
  if (may_go_on(st) && t->rows > deaths) join_status(&st, move_rows(t, deaths));
  if (st == DYD_CANCELLED) dyd_rows_reached(t);
  return st;
}

/* Radii of points are known when all are. */
static dyd_status tolerance_radii(dyd_tolerance *t) {
  dyd_status st = dyd_points_radius(t);
  if (st == DYD_OK) return st;
  free(t->radius);
  t->radius = NULL;
  return st;
}

static dyd_status tolerance_work(dyd_tolerance *t, dyd_error *err) {
  const dyd_tolerance_options *o = &t->options;
  dyd_status st = dyd_near_prepare(t);
  if (st == DYD_OK && (o->sigmas || o->sigma > 0))
    st = take_by_vertex(&t->sigma, &t->widest, t->sk, o->sigmas, o->sigma);
  uint64_t pairs = dyd_pairs_bytes(t->pd, DYD_TIE) / sizeof(dyd_pair);
  if (st == DYD_OK && !dyd_rows_have_room(t, pairs, "the tolerances of the edges")) st = DYD_E_NOMEM;
  if (st == DYD_OK) st = tolerance_rows(t, err);
  if (may_go_on(st)) join_status(&st, dyd_whole(t));
  if (st == DYD_OK && o->points) st = tolerance_radii(t);
  if (may_go_on(st)) join_status(&st, dyd_rows_sort(t));
  if (may_go_on(st) && t->sigma) join_status(&st, dyd_chances(t));
  return st;
}

/* Reports how much is missing after a cancelled run. */
static dyd_status tell_left(const dyd_tolerance *t, dyd_error *err) {
  if (!t->result.edges_left && !t->result.births_left)
    return dyd_fail(err, DYD_CANCELLED, "all pairs were reached, but not all radii or probabilities");
  if (t->result.births_left == SIZE_MAX)
    return dyd_fail(err, DYD_CANCELLED, "%zu edges were not reached: they have no row; births were not all looked for",
                    t->result.edges_left);
  return dyd_fail(err, DYD_CANCELLED, "%zu edges and %zu pairs that may be born were not reached: they have no row",
                  t->result.edges_left, t->result.births_left);
}

dyd_status dyd_tolerance_new(dyd_tolerance **out, const dyd_delaunay *pd, const dyd_tolerance_options *options,
                             dyd_error *err) {
  if (!pd) return dyd_fail_null(err);
  *out = NULL;
  if (err) dyd_error_clear(err);
  dyd_status st = dyd_float_check(err);
  dyd_tolerance *t = st == DYD_OK ? calloc(1, sizeof *t) : NULL;
  if (!t) return st == DYD_OK ? dyd_fail_nomem(err) : st;
  t->pd = pd;
  t->sk = &pd->sk;
  t->memory = dyd_delaunay_memory_left(pd);
  dyd_lines_init(&t->lines);
  dyd_summit_init(&t->summit);
  st = dyd_abi_take(&t->options, sizeof t->options, options, "dyd_tolerance_options", err);
  if (st == DYD_OK) st = check_points(t, err);
  if (st == DYD_OK) st = tolerance_work(t, err);
  t->options.up_to = NULL;
  if (st == DYD_E_NOMEM && t->memory.refused) dyd_fail_memory(err, &t->memory);
  if (st == DYD_OK || st == DYD_CANCELLED) {
    *out = t;
    t->result.struct_size = sizeof t->result;
    t->result.metric = t->options.metric;
    t->result.points = t->radius;
    t->result.chances = t->chance;
    return st == DYD_OK ? st : tell_left(t, err);
  }
  dyd_tolerance_free(t);
  return err && err->code == st ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

void dyd_tolerance_free(dyd_tolerance *t) {
  if (!t) return;
  dyd_near_clear(t);
  dyd_summit_clear(&t->summit);
  dyd_lines_clear(&t->lines);
  dyd_free_all(t->ring, t->radius, t->weight, t->sigma, t->chance, t->row);
  dyd_delaunay_free(t->centres);
  free(t);
}

/* ---- answers ---- */

size_t dyd_tolerance_rows(const dyd_tolerance_row **row, const dyd_tolerance *t) {
  if (!t) return 0;
  *row = t->row;
  return t->rows;
}

const dyd_tolerance_result *dyd_tolerance_get(const dyd_tolerance *t) {
  return t ? &t->result : NULL;
}

/* What binds is known: the summit of these lines alone is that of all; a birth is where they cross. */
dyd_status dyd_tolerance_exact(mpq_ptr plus, mpq_ptr minus, const dyd_tolerance *t, size_t row) {
  if (!t) return DYD_E_ARG;
  if (row >= t->rows || t->row[row].lo == HUGE_VAL || t->weight || t->centres) return DYD_E_ARG;
  if (t->options.metric == DYD_METRIC_BOX) return DYD_E_ARG;
  const dyd_tolerance_row *r = &t->row[row];
  const uint32_t *vertex = t->sk->vertex;
  mpq_set_ui(plus, 0, 1);
  mpq_set_ui(minus, 0, 1);
  if (r->event == DYD_EVENT_TIE) return DYD_OK;
  DYD_LOCAL(dyd_lines, l);
  DYD_LOCAL(dyd_summit, s);
  uint32_t others[2] = {vertex[r->k], r->l == DYD_NO_SITE ? DYD_NONE : vertex[r->l]};
  dyd_status st = dyd_lines_load(&l, t->sk, vertex[r->i], vertex[r->j], others, r->l == DYD_NO_SITE ? 1 : 2, false);
  if (st == DYD_OK && r->event == DYD_EVENT_DEATH) dyd_lines_death(&s, &l);
  if (st == DYD_OK && r->event == DYD_EVENT_BIRTH) dyd_lines_birth_by(&s, &l);
  if (st == DYD_OK) {
    mpq_swap(plus, s.plus);
    mpq_swap(minus, s.minus);
  }
  return st;
}
