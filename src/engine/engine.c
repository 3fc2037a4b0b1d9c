/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Life, counters and results of an engine. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/invariant.h"
#include "base/local.h"
#include "delaunay/extend.h"
#include "engine/labels.h"
#include "engine/points.h"
#include "engine/record.h"
#include "engine/state.h"
#include "engine/ties.h"
#include "metric/bounds.h"
#include "rect/columns_filter.h"
#include "rect/rect.h"
#include "rect/sites_table.h"
#include "stream/stream.h"

#include <dyadel/compose.h>
#include <dyadel/io.h>
#include <dyadel/metric.h>

#include <math.h>

const char *dyd_outcome_text(dyd_outcome outcome) {
  static const char *const text[] = {"none", "decided", "certified", "fixpoint", "budget", "cancelled", "error"};
  return (unsigned)outcome < sizeof text / sizeof *text ? text[outcome] : "unknown outcome";
}

const char *dyd_goal_text(dyd_goal goal) {
  static const char *const text[] = {"decided", "area", "hausdorff", "voronoi area", "voronoi hausdorff"};
  return (unsigned)goal < sizeof text / sizeof *text ? text[goal] : "unknown goal";
}

const char *dyd_reason_text(dyd_reason reason) {
  static const char *const text[] = {"first", "end", "blocker", "bound", "uniform", "question", "policy"};
  return (unsigned)reason < sizeof text / sizeof *text ? text[reason] : "unknown reason";
}

dyd_status dyd_engine_new(dyd_engine **out) {
  dyd_engine *e = calloc(1, sizeof *e);
  if (!e) return DYD_E_NOMEM;
  dyd_status st = dyd_sites_new(&e->sites);
  if (st != DYD_OK)
    free(e);
  else
    *out = e;
  return st;
}

void dyd_engine_free(dyd_engine *e) {
  if (!e) return;
  DYD_INVARIANT(!dyd_engine_is_busy(e)); /* its owner waits for the run */
  dyd_delaunay_free(e->former);
  dyd_delaunay_free(e->pd);
  dyd_engine_clear_points(e);
  dyd_labels_clear(&e->labels);
  dyd_ties_free(e->ties);
  dyd_recall_free(e->recall);
  dyd_sites_free(e->sites);
  dyd_free_all(e->changed, e);
}

size_t dyd_engine_count(const dyd_engine *e) {
  if (!e) return 0;
  return dyd_sites_count(e->sites);
}

static void engine_stop(dyd_engine *e) {
  dyd_flag_set(&e->cancelled, 1);
  dyd_flag_set(&e->stop, 1);
}

/* Loads and stores of flags and nothing else: safe in a signal handler. */
void dyd_engine_cancel(dyd_engine *e) {
  if (!e) return;
  engine_stop(e);
  dyd_engine *follower = __atomic_load_n(&e->follower, __ATOMIC_SEQ_CST);
  if (follower) engine_stop(follower);
}

void dyd_engine_follow(dyd_engine *e, dyd_engine *follower) {
  __atomic_store_n(&e->follower, follower, __ATOMIC_SEQ_CST);
  if (follower && dyd_flag_get(&e->cancelled)) engine_stop(follower);
  if (!follower) dyd_flag_set(&e->cancelled, 0); /* heard */
}

dyd_outcome dyd_engine_outcome(const dyd_engine *e) {
  if (!e) return DYD_OUTCOME_NONE;
  return e->outcome;
}

dyd_goal dyd_engine_goal(int64_t *bits, const dyd_engine *e) {
  if (!e) return DYD_GOAL_DECIDED;
  if (bits) *bits = e->goal_bits;
  return e->goal;
}

const dyd_delaunay *dyd_engine_delaunay(const dyd_engine *e) {
  if (!e) return NULL;
  return e->pd;
}

const dyd_sites *dyd_engine_sites(const dyd_engine *e) {
  if (!e) return NULL;
  return e->sites;
}

bool dyd_engine_knows(const dyd_engine *e, uint32_t site) {
  if (!e) return false;
  const dyd_refinable *p = dyd_engine_find(e, site);
  return p ? p->asked || p->measured : site < dyd_sites_count(e->sites);
}

static void counters_add_past(dyd_delaunay_counters *out, const dyd_delaunay_counters *past) {
  out->filter += past->filter;
  out->integer += past->integer;
  out->exact += past->exact;
  out->witness_guess += past->witness_guess;
  out->witness_search += past->witness_search;
  out->cover_walks += past->cover_walks;
  out->faces += past->faces;
  if (past->bytes_most > out->bytes_most) out->bytes_most = past->bytes_most;
}

/* Called after points were added: drops the result and keeps its counters (engine.c). */
static void engine_end_result(dyd_engine *e) {
  dyd_delaunay_counters c = {DYD_SIZED(dyd_delaunay_counters)};
  if (e->pd && dyd_delaunay_get_counters(&c, e->pd, NULL) == DYD_OK) counters_add_past(&e->past, &c);
  if (e->pd && !e->changes && dyd_delaunay_is_extensible(e->pd)) {
    e->former = e->pd;
    e->former->counters = (dyd_delaunay_counters){DYD_SIZED(dyd_delaunay_counters)};
  } else {
    dyd_delaunay_free(e->pd);
  }
  e->pd = NULL;
  e->changes = 0;
  e->outcome = DYD_OUTCOME_NONE;
}

static void counters_add_bits(dyd_engine_counters *out, const dyd_engine *e) {
  bool any = false;
  for (size_t k = 0; k < e->points; k++) {
    const dyd_refinable *p = &e->point[k];
    if (!p->asked) continue;
    if (!any || p->bits < out->bits_least) out->bits_least = p->bits;
    if (!any || p->bits > out->bits_most) out->bits_most = p->bits;
    if (p->bits > 0) out->bits_total += (uint64_t)p->bits;
    any = true;
  }
}

dyd_status dyd_engine_get_counters(dyd_engine_counters *out, const dyd_engine *e, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  dyd_engine_counters c = {.stages = e->stages, .calls = e->calls, .seconds = e->seconds, .spent = e->spent};
  c.delaunay.struct_size = sizeof c.delaunay;
  dyd_status st = dyd_abi_check(out, 0, "dyd_engine_counters", err);
  if (st == DYD_OK && e->pd) st = dyd_delaunay_get_counters(&c.delaunay, e->pd, err);
  if (st != DYD_OK) return st;
  counters_add_past(&c.delaunay, &e->past);
  c.ties = e->tie_counters;
  c.ties.struct_size = sizeof c.ties;
  c.bytes_most = e->bytes_most;
  counters_add_bits(&c, e);
  if (e->pd) c.undecided_faces = dyd_delaunay_undecided_faces(e->pd);
  dyd_abi_give(out, &c, sizeof c);
  return DYD_OK;
}

dyd_status dyd_engine_bounds(dyd_dyadic *area, dyd_dyadic *hausdorff, const dyd_engine *e) {
  if (!e) return DYD_E_ARG;
  if (!e->pd) return DYD_E_ARG;
  DYD_LOCAL(dyd_dyadic, a);
  dyd_status st = dyd_metric_area(&a, e->pd);
  if (st == DYD_OK) st = dyd_metric_hausdorff(hausdorff, e->pd);
  if (st == DYD_OK) dyd_dyadic_swap(area, &a);
  return st;
}

/* What points are called where they were read. Points added in other ways are rows of their own, without identifier. */

void dyd_labels_clear(dyd_labels *l) {
  dyd_free_all(l->row, l->id, l->number, l->text, l->names, l->merged);
  *l = (dyd_labels){0};
}

size_t dyd_labels_bytes(const dyd_labels *l) {
  return l->points * (sizeof *l->row + sizeof *l->id + sizeof *l->number) + l->used + l->merges * sizeof *l->merged;
}

bool dyd_labels_add(dyd_labels *l, const char *id, size_t length, const dyd_row_numbers *number) {
  if (!DYD_GROW(l->row, l->row_cap, l->points + 1) || !DYD_GROW(l->id, l->id_cap, l->points + 1) ||
      !DYD_GROW(l->number, l->number_cap, l->points + 1) ||
      !dyd_reserve((void **)&l->text, &l->text_cap, l->used + length + 2 * (1 + l->carried), 1))
    return false;
  if (!l->used) { /* place 0 has the empty texts of those without identifier */
    memset(l->text, 0, 1 + l->carried);
    l->used = 1 + l->carried;
  }
  l->row[l->points] = l->rows++;
  l->number[l->points] = *number;
  l->id[l->points++] = id ? l->used : 0;
  if (!id) return true;
  memcpy(l->text + l->used, id, length);
  memset(l->text + l->used + length, 0, 1 + l->carried);
  l->used += length + 1 + l->carried;
  return l->has_ids = true;
}

bool dyd_labels_merge(dyd_labels *l, size_t point) {
  if (!DYD_GROW(l->merged, l->merged_cap, l->merges + 1)) return false;
  l->merged[l->merges++] = (dyd_merged_row){l->rows++, point};
  return true;
}

/* Length of `count` terminated texts, one after another, without the last end. */
static size_t texts_length(const char *text, size_t count) {
  size_t length = 0;
  for (size_t k = 0; k < count; k++) length += strlen(text + length) + 1;
  return length - 1;
}

/* `from`, its points counted on from out->points and its rows from out->rows. */
static bool labels_append(dyd_labels *out, const dyd_labels *from) {
  size_t rows = out->rows, points = out->points;
  bool good = true;
  for (size_t i = 0; good && i < from->points; i++) {
    const char *id = from->has_ids ? from->text + from->id[i] : NULL;
    out->rows = rows + from->row[i];
    good = dyd_labels_add(out, id, id ? texts_length(id, 1 + from->carried) : 0, &from->number[i]);
  }
  for (size_t k = 0; good && k < from->merges; k++) {
    out->rows = rows + from->merged[k].row;
    good = dyd_labels_merge(out, points + from->merged[k].point);
  }
  out->rows = rows + from->rows;
  return good;
}

dyd_status dyd_labels_join(dyd_labels *out, const dyd_engine *e, const dyd_labels *more) {
  const dyd_labels *names = more->names ? more : &e->labels;
  dyd_labels all = {.carried = names->carried,
                    .anonymous = more->anonymous && (e->labels.anonymous || !e->labels.has_ids)};
  size_t length = names->names ? texts_length(names->names, names->carried) + 1 : 0;
  bool good = !length || (all.names = malloc(length));
  if (length && good) memcpy(all.names, names->names, length);
  good = good && labels_append(&all, &e->labels);
  while (good && all.points < dyd_sites_count(e->sites)) good = dyd_labels_add(&all, NULL, 0, &dyd_no_row_numbers);
  good = good && labels_append(&all, more);
  if (good)
    *out = all;
  else
    dyd_labels_clear(&all);
  return good ? DYD_OK : DYD_E_NOMEM;
}

/* *out becomes the labels of e with n points behind that cost so much. DYD_E_NOMEM. */
static dyd_status labels_cost(dyd_labels *out, const dyd_engine *e, size_t n, const double *cost) {
  DYD_SCOPED(dyd_labels) more = {0};
  dyd_row_numbers own = dyd_no_row_numbers;
  bool good = true;
  for (size_t k = 0; good && k < n; k++) {
    own.of[DYD_ROW_COST] = cost[k];
    good = dyd_labels_add(&more, NULL, 0, &own);
  }
  return good ? dyd_labels_join(out, e, &more) : DYD_E_NOMEM;
}

void dyd_labels_give(dyd_engine *e, dyd_labels *l) {
  dyd_labels_clear(&e->labels);
  e->labels = *l;
  *l = (dyd_labels){0};
}

dyd_status dyd_engine_name(dyd_engine *e, size_t n, const size_t *row, const char *const *id) {
  if (!e || (n && !row)) return DYD_E_ARG;
  dyd_labels all = {0}, *old = &e->labels;
  const size_t count = dyd_sites_count(e->sites), first = n < count ? count - n : 0;
  bool good = n <= count && !old->merges;
  for (size_t k = 0; good && k < n; k++)
    good = row[k] >= (k ? row[k - 1] + 1 : first ? dyd_engine_row(e, first - 1) + 1 : 0);
  if (!good) return DYD_E_ARG;
  for (size_t i = 0; good && i < count; i++) {
    const char *own = i < first ? dyd_engine_id(e, i) : id ? id[i - first] : NULL;
    all.rows = i < first ? dyd_engine_row(e, i) : row[i - first];
    good = dyd_labels_add(&all, own, own ? strlen(own) : 0, i < old->points ? &old->number[i] : &dyd_no_row_numbers);
  }
  if (good)
    dyd_labels_give(e, &all);
  else
    dyd_labels_clear(&all);
  return good ? DYD_OK : DYD_E_NOMEM;
}

void dyd_engine_give_confidence(dyd_engine *e, const dyd_confidence *c) {
  e->confidence = *c;
}

bool dyd_engine_confidence(dyd_confidence *out, const dyd_engine *e) {
  if (!e || !e->confidence.probability[0]) return false;
  dyd_abi_give(out, &e->confidence, sizeof e->confidence);
  return true;
}

/* ---- answers ---- */

size_t dyd_engine_row(const dyd_engine *e, size_t i) {
  if (!e) return i;
  const dyd_labels *l = &e->labels;
  return i < l->points ? l->row[i] : l->rows + (i - l->points);
}

const char *dyd_engine_id(const dyd_engine *e, size_t i) {
  if (!e || !e->labels.has_ids || e->labels.anonymous) return NULL;
  const dyd_labels *l = &e->labels;
  return i < l->points ? l->text + l->id[i] : "";
}

const char *dyd_engine_carried(const char **name, const dyd_engine *e, size_t i, size_t k) {
  const dyd_labels *l = e ? &e->labels : NULL;
  if (!l || k >= l->carried) return NULL;
  if (name) *name = l->names + (k ? texts_length(l->names, k) + 1 : 0);
  return i < l->points && l->has_ids ? l->text + l->id[i] + texts_length(l->text + l->id[i], k + 1) + 1 : "";
}

double dyd_engine_number(const dyd_engine *e, size_t i, dyd_row_number which) {
  return (e && i < e->labels.points ? e->labels.number[i] : dyd_no_row_numbers).of[which];
}

bool dyd_engine_merged(size_t *row, size_t *point, const dyd_engine *e, size_t k) {
  if (!e || k >= e->labels.merges) return false;
  *row = e->labels.merged[k].row;
  *point = e->labels.merged[k].point;
  return true;
}

/* ---- adding points ----
 *
 * Statements are about all points, so later points end the result: the next run triangulates anew, from the rectangles
 * reached, or puts exact points into the result that there was. Statements are monotone for the points at hand, not for
 * more of them. */

/* ---- when points may come ---- */

dyd_status dyd_engine_may_add(const dyd_engine *e, dyd_error *err) {
  if (err) dyd_error_clear(err);
  if (!dyd_engine_is_busy(e)) return DYD_OK;
  return dyd_fail(err, DYD_E_ARG, "the engine is at work: no callback of it, and no other thread, may add points");
}

/* Ends a call that found `before` points; told: *err has the reason of a failure. */
static dyd_status added(dyd_engine *e, size_t before, dyd_status st, bool told, dyd_error *err) {
  if (st == DYD_OK && dyd_sites_count(e->sites) > before) engine_end_result(e);
  return st == DYD_OK || told ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

/* The message about one side of a new point. */
static dyd_status side_fail(dyd_error *err, size_t point, const char *axis, double at) {
  if (err) err->point = point;
  return dyd_fail(err, DYD_E_ARG, "point %zu: %s is %g; coordinates are finite numbers", point, axis, at);
}

/* One side of n boxes (of points, where lo = hi), the first of which would be point `first`. */
static dyd_status side_check(size_t first, size_t n, const double *lo, const double *hi, const char *axis,
                             dyd_error *err) {
  for (size_t k = 0; k < n; k++) {
    if (!isfinite(lo[k]) || !isfinite(hi[k])) return side_fail(err, first + k, axis, isfinite(lo[k]) ? hi[k] : lo[k]);
    if (lo[k] <= hi[k]) continue;
    if (err) err->point = first + k;
    return dyd_fail(err, DYD_E_ARG,
                    "point %zu: the lower end of %s, %.17g, is above the upper one, %.17g; exchange them", first + k,
                    axis, lo[k], hi[k]);
  }
  return DYD_OK;
}

/* ---- doubles ---- */

dyd_status dyd_engine_add_boxes(dyd_engine *e, size_t n, const double *x0, const double *x1, const double *y0,
                                const double *y1, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, err);
  if (st != DYD_OK) return st;
  st = x0 == x1 && y0 == y1 ? dyd_sites_add_points(e->sites, n, x0, y0)
                            : dyd_sites_add_boxes(e->sites, n, x0, x1, y0, y1);
  bool told = st == DYD_E_ARG &&
              (side_check(before, n, x0, x1, "x", err) != DYD_OK || side_check(before, n, y0, y1, "y", err) != DYD_OK);
  return added(e, before, st, told, err);
}

dyd_status dyd_engine_add_points(dyd_engine *e, size_t n, const double *x, const double *y, dyd_error *err) {
  return dyd_engine_add_boxes(e, n, x, x, y, y, err);
}

/* Why column a gives no sides, the first of point `first`. */
static dyd_status column_check(size_t first, size_t n, const dyd_column *x, const dyd_column *radius, const char *axis,
                               dyd_error *err) {
  for (size_t k = 0; k < n; k++) {
    double lo, hi, at = dyd_column_at(x, k), r = radius ? dyd_column_at(radius, k) : 0;
    if (dyd_widen_d(&lo, &hi, at, r)) continue;
    if (!isfinite(at)) return side_fail(err, first + k, axis, at);
    if (err) err->point = first + k;
    return dyd_fail(err, DYD_E_ARG,
                    "point %zu: the radius in %s is %.17g; radii are finite, not negative, and small enough for "
                    "doubles",
                    first + k, axis, r);
  }
  return DYD_OK;
}

dyd_status dyd_engine_add_columns(dyd_engine *e, size_t n, const dyd_column xy[2], const dyd_column *radius,
                                  dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, err);
  if (st != DYD_OK) return st;
  st = dyd_sites_add_columns(e->sites, n, xy, radius);
  bool told = st == DYD_E_ARG && (column_check(before, n, &xy[0], radius, "x", err) != DYD_OK ||
                                  column_check(before, n, &xy[1], radius ? radius + 1 : NULL, "y", err) != DYD_OK);
  return added(e, before, st, told, err);
}

/* ---- exact ones ---- */

dyd_status dyd_engine_add_rect(dyd_engine *e, const dyd_rect *r, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, err);
  return st == DYD_OK ? added(e, before, dyd_sites_add_rect(e->sites, r), false, err) : st;
}

dyd_status dyd_engine_reserve(dyd_engine *e, size_t n) {
  return dyd_sites_reserve(e->sites, n);
}

void dyd_engine_take_back(dyd_engine *e, size_t before) {
  while (e->points && e->point[e->points - 1].site >= before) dyd_stream_free(e->point[--e->points].stream);
  dyd_sites_cut(e->sites, before);
}

dyd_status dyd_engine_add_words(dyd_engine *e, size_t n, const dyd_words *xy, bool boxes, dyd_error *err) {
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, err);
  if (st != DYD_OK) return st;
  st = boxes ? dyd_sites_add_word_boxes(e->sites, n, xy) : dyd_sites_add_words(e->sites, n, xy);
  return added(e, before, st, false, err);
}

/* ---- streams and sources ---- */

/* Appends n sites with records like p; the site number is filled in. Nothing on failure. Answers of sources are known
 * to enclose places. */
static dyd_status points_add_refinable(dyd_engine *e, size_t n, dyd_refinable p) {
  size_t first = dyd_sites_count(e->sites);
  if (n > DYD_MAX_SITES) return DYD_E_RANGE;
  if (!DYD_GROW(e->point, e->point_cap, e->points + n)) return DYD_E_NOMEM;
  dyd_site_kind kind = p.stream ? dyd_stream_site_kind(p.stream) : DYD_SITE_BARE;
  dyd_status st = dyd_sites_add_planes(e->sites, n, kind);
  if (st != DYD_OK) return st;
  for (size_t k = 0; k < n; k++) {
    p.site = (uint32_t)(first + k);
    e->point[e->points++] = p;
  }
  return DYD_OK;
}

dyd_status dyd_engine_add_stream(dyd_engine *e, dyd_stream *s, dyd_error *err) {
  if (!e || !s) return dyd_stream_free(s), dyd_fail_null(err);
  size_t before = dyd_sites_count(e->sites);
  dyd_status st = dyd_engine_may_add(e, err);
  const dyd_rect *fixed = dyd_stream_is_final(s) ? dyd_stream_rect(s) : NULL;
  if (st == DYD_OK) {
    st = fixed ? dyd_sites_add_rect(e->sites, fixed) : points_add_refinable(e, 1, (dyd_refinable){.stream = s});
    added(e, before, st, false, err);
  }
  if (fixed || st != DYD_OK) dyd_stream_free(s);
  return st;
}

static dyd_status points_add_source(dyd_engine *e, size_t n, const dyd_source *source) {
  if (!DYD_GROW(e->source, e->source_cap, e->sources + 1)) return DYD_E_NOMEM;
  size_t first = dyd_sites_count(e->sites);
  dyd_status st = points_add_refinable(e, n, (dyd_refinable){.source = (uint32_t)e->sources});
  if (st == DYD_OK) e->source[e->sources++] = (dyd_source_use){.source = *source, .first = (uint32_t)first};
  return st;
}

static dyd_status source_check(const dyd_engine *e, size_t n, const dyd_source *source, dyd_error *err) {
  size_t first = dyd_sites_count(e->sites);
  if (!source->narrow) return dyd_fail(err, DYD_E_ARG, "the source has no function `narrow`");
  for (size_t k = 0; source->cost && k < n; k++) {
    if (source->cost[k] > 0 && isfinite(source->cost[k])) continue;
    if (err) err->point = first + k;
    return dyd_fail(err, DYD_E_ARG, "point %zu: its cost is %g; costs are finite numbers above 0", first + k,
                    source->cost[k]);
  }
  return DYD_OK;
}

static dyd_status points_add_source_at_cost(dyd_engine *e, size_t n, const dyd_source *source) {
  dyd_labels labels;
  if (!source->cost) return points_add_source(e, n, source);
  dyd_status st = labels_cost(&labels, e, n, source->cost);
  if (st != DYD_OK) return st;
  st = points_add_source(e, n, source);
  if (st == DYD_OK) dyd_labels_give(e, &labels);
  dyd_labels_clear(&labels);
  return st;
}

dyd_status dyd_engine_add_source(dyd_engine *e, size_t n, const dyd_source *source, dyd_error *err) {
  dyd_source s;
  const size_t before = e ? dyd_sites_count(e->sites) : 0;
  dyd_status st = dyd_abi_take(&s, sizeof s, source, "dyd_source", err);
  if (st != DYD_OK) return st;
  st = e ? dyd_engine_may_add(e, err) : dyd_fail_null(err);
  if (st == DYD_OK) st = source_check(e, n, &s, err);
  if (st == DYD_OK) st = added(e, before, points_add_source_at_cost(e, n, &s), false, err);
  if (st != DYD_OK && s.release) s.release(s.user);
  return st;
}

/* ---- points of an engine as streams that outlive it ----
 *
 * A fixed site is copied. The stream of a site is shared: one more reference. A point of a source becomes a stream of
 * its own, which begins with the rectangle that the engine knows and asks the same callback; the source is counted from
 * then on, and released by the last of its users. So does the stream of a point that was measured again: its answers
 * are intersected with the known rectangle. */

/* One point of a shared source, or (shared = NULL) of a stream. begins: `known` is the rectangle to begin with, not
 * handed on yet; measured: answers are intersected with it. */
typedef struct taken {
  dyd_shared_source *shared;
  dyd_stream *stream;
  size_t point;
  bool begins, measured;
  dyd_rect known;
} taken;

static void taken_release(void *user) {
  taken *t = user;
  dyd_shared_source_free(t->shared);
  dyd_stream_free(t->stream);
  dyd_rect_clear(&t->known);
  free(t);
}

static dyd_status taken_ask(dyd_rect *out, const taken *t, const dyd_request *request, dyd_error *err) {
  dyd_request own = *request;
  own.point = t->point;
  if (t->shared) return t->shared->source.narrow(out, t->shared->source.user, &own, err);
  dyd_status st = dyd_stream_narrow(t->stream, request->bits, request->max_bits, err);
  if (dyd_failed(st)) return st;
  dyd_rect_set(out, dyd_stream_rect(t->stream));
  return dyd_stream_is_final(t->stream) ? DYD_FIXED : DYD_OK;
}

/* Cuts *out, an answer, to the known rectangle. */
static dyd_status taken_keep(dyd_rect *out, const taken *t) {
  if (t->begins && !t->measured && !dyd_rect_contains(&t->known, out)) return DYD_E_NESTING;
  if (!t->measured) return DYD_OK;
  dyd_status st = dyd_interval_intersect(&out->x, &out->x, &t->known.x);
  if (st == DYD_OK) st = dyd_interval_intersect(&out->y, &out->y, &t->known.y);
  return st == DYD_E_ARG ? DYD_E_CONTRADICTION : st;
}

static dyd_status taken_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  taken *t = user;
  if (t->begins) dyd_rect_set(out, &t->known);
  bool enough = t->begins && dyd_rect_bits(&t->known) >= request->bits;
  dyd_status st = enough ? DYD_OK : taken_ask(out, t, request, err);
  if (st == DYD_OK || st == DYD_FIXED) {
    dyd_status kept = taken_keep(out, t);
    if (kept != DYD_OK) return kept;
    t->begins = false;
  }
  return st;
}

static dyd_status source_share(dyd_source_use *use) {
  if (use->shared) return DYD_OK;
  use->shared = dyd_alloc(1, sizeof *use->shared);
  if (!use->shared) return DYD_E_NOMEM;
  *use->shared = (dyd_shared_source){1, use->source};
  return DYD_OK;
}

static dyd_status taken_new(dyd_stream **out, dyd_engine *e, const dyd_refinable *p) {
  dyd_source_use *use = p->stream ? NULL : &e->source[p->source];
  dyd_status st = use ? source_share(use) : DYD_OK;
  taken *t = st != DYD_OK ? NULL : dyd_alloc(1, sizeof *t);
  if (!t) return DYD_E_NOMEM;
  *t = (taken){.begins = p->asked || p->measured, .measured = p->measured};
  if (use) {
    t->shared = use->shared;
    t->point = p->site - use->first;
    use->shared->refs++;
  } else {
    t->stream = dyd_stream_ref(p->stream);
  }
  dyd_rect_init(&t->known);
  if (t->begins) st = dyd_sites_get(&t->known, e->sites, p->site);
  if (st != DYD_OK) {
    taken_release(t);
    return st;
  }
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = taken_narrow, .release = taken_release, .user = t};
  return dyd_stream_new(out, &source, p->site, NULL);
}

static dyd_status fixed_copy(dyd_stream **out, const dyd_engine *e, uint32_t i) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sites_get(&r, e->sites, i);
  return st == DYD_OK ? dyd_stream_from_rect(out, &r) : st;
}

dyd_status dyd_engine_stream(dyd_stream **out, dyd_engine *e, uint32_t i) {
  if (!e) return DYD_E_ARG;
  if (i >= dyd_sites_count(e->sites)) return DYD_E_ARG;
  const dyd_refinable *p = dyd_engine_find(e, i);
  if (!p || p->final) return fixed_copy(out, e, i);
  if (!p->stream || p->measured) return taken_new(out, e, p);
  *out = dyd_stream_ref(p->stream);
  return DYD_OK;
}
