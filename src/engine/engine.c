/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Life, counters and results of an engine. */
#include "base/error.h"
#include "base/local.h"
#include "delaunay/extend.h"
#include "engine/points.h"
#include "engine/record.h"
#include "engine/ties.h"

#include <dyadel/io.h>

#include "base/abi.h"
#include "base/alloc.h"
#include "base/invariant.h"
#include "metric/bounds.h"
#include <dyadel/metric.h>

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

void dyd_engine_end_result(dyd_engine *e) {
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

dyd_status dyd_labels_cost(dyd_labels *out, const dyd_engine *e, size_t n, const double *cost) {
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
