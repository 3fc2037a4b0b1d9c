/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The harness of monotone refinement: the comparisons after each stage; random schedules, given ones, and reducing a
 * failing one to the moves that matter. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/local.h"
#include "base/random.h"
#include "engine/ask.h"
#include "engine/points.h"
#include "engine/record.h"
#include "engine/ties.h"
#include "predicate/circle.h"
#include "rect/rect.h"
#include "rect/sites_table.h"
#include "stream/stream.h"
#include "voronoi/exact_cell.h"

#include <dyadel/check.h>
#include <dyadel/metric.h>
#include <dyadel/voronoi.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* A site whose polygons of the last stage are kept. */
typedef struct watched_cell {
  uint32_t site;
  dyd_polygon_list inner, outer;
} watched_cell;

/* One schedule under way. */
typedef struct check_state {
  dyd_engine *e;
  dyd_delaunay *pd;     /* NULL before the first stage */
  dyd_pair_list before; /* pairs after the last stage */
  watched_cell *watched;
  size_t watch_count;
  dyd_rect window;
  bool windowed;
  uint64_t random;
  dyd_watch watch;            /* raises e->stop at the deadline */
  const dyd_check_options *o; /* defaults filled in */
  dyd_check_report *report;   /* counters; fault and message when one is found */
  uint32_t *changed;
  size_t changes, change_cap;
} check_state;

/* What the harness compares after each stage. Only exact comparisons; random numbers choose the tests. */

/* What stops a triangulation at once: the deadline where there is one. */
static const volatile int *check_flag(const check_state *s) {
  return s->o->cancel && !(s->o->seconds > 0) ? s->o->cancel : &s->e->stop;
}

/* Returns true if the time is over, or the check was cancelled. */
static bool check_is_over(const check_state *s) {
  return dyd_flag_get(&s->e->stop) || (s->o->cancel && dyd_flag_get(s->o->cancel));
}

/* Uniform in 0 .. n-1, n > 0. */
static uint64_t check_below(uint64_t *random, uint64_t n) {
  return dyd_random(*random += DYD_RANDOM_STEP, 0) % n;
}

/* Notes a fault; returns DYD_OK. */
static dyd_status check_found(check_state *s, dyd_check_fault fault, const char *format, ...) {
  va_list list;
  if (s->report->fault != DYD_CHECK_FINE) return DYD_OK;
  s->report->fault = fault;
  va_start(list, format);
  vsnprintf(s->report->message, sizeof s->report->message, format, list);
  va_end(list);
  return DYD_OK;
}

static bool fault_found(const check_state *s) {
  return s->report->fault != DYD_CHECK_FINE;
}

/* ---- streams ---- */

/* Narrows a point to `bits` and checks the stream. */
static dyd_status check_narrow(check_state *s, uint32_t point, int64_t bits) {
  const dyd_refinable *found = dyd_engine_find(s->e, point);
  dyd_error err;
  uint64_t calls = 0;
  dyd_error_clear(&err);
  if (check_is_over(s)) return DYD_CANCELLED;
  if (!found || found->final) return DYD_OK;
  dyd_refinable *p = &s->e->point[found - s->e->point];
  dyd_status st = dyd_engine_narrow(p, &calls, s->e, bits, s->o->max_bits, &err);
  if (st == DYD_E_NOMEM || st == DYD_CANCELLED) return st;
  if (st != DYD_OK)
    return check_found(s, DYD_CHECK_STREAM, "point %u, asked for %lld bits: %s", (unsigned)point, (long long)bits,
                       err.message);
  if (!DYD_GROW(s->changed, s->change_cap, s->changes + 1)) return DYD_E_NOMEM;
  s->changed[s->changes++] = point;
  if (p->final) return DYD_OK;
  DYD_LOCAL(dyd_rect, r);
  st = dyd_sites_get(&r, s->e->sites, point);
  int64_t least = bits - s->o->slack_bits;
  if (st == DYD_OK && !(p->stream ? dyd_stream_reaches(p->stream, &r, least) : dyd_rect_bits(&r) >= least))
    check_found(s, DYD_CHECK_RATE, "point %u, asked for %lld bits, is only within 2^%lld", (unsigned)point,
                (long long)bits, -(long long)dyd_rect_bits(&r));
  return st;
}

/* ---- statuses ---- */

static bool is_alias(const dyd_delaunay *pd, uint32_t i) {
  return dyd_delaunay_alias(pd, i) != i;
}

/* The statuses of one pair before and now. */
typedef void (*pair_visit)(check_state *s, const dyd_pair *pair, dyd_pair_status before, dyd_pair_status now);

static void pairs_compare_lists(check_state *s, const dyd_pair_list *before, const dyd_pair_list *now,
                                pair_visit visit) {
  dyd_pair_change p;
  for (size_t at[2] = {0, 0}; !fault_found(s) && dyd_pairs_next(&p, at, before, now); s->report->pairs++)
    visit(s, &p.pair, p.before, p.pair.status);
}

static void not_retracted(check_state *s, const dyd_pair *p, dyd_pair_status before, dyd_pair_status now) {
  if (is_alias(s->pd, p->i) || is_alias(s->pd, p->j)) return; /* became one exact point with another */
  bool settled = before == DYD_LEGAL || (before == DYD_TIE && !s->o->no_ties);
  if (before == DYD_ILLEGAL || (settled && now != before))
    check_found(s, DYD_CHECK_RETRACT, "pair %u %u was %s and is %s", (unsigned)p->i, (unsigned)p->j,
                dyd_pair_status_text(before), dyd_pair_status_text(now));
}

static void same_or_floor(check_state *s, const dyd_pair *p, dyd_pair_status before, dyd_pair_status now) {
  bool floor = (before == DYD_LEGAL && now == DYD_INDETERMINATE) || (before == DYD_INDETERMINATE && now == DYD_LEGAL);
  s->report->floors += floor;
  if (before != now && !floor)
    check_found(s, DYD_CHECK_PATH, "pair %u %u is %s, but %s in a fresh run from the same rectangles", (unsigned)p->i,
                (unsigned)p->j, dyd_pair_status_text(before), dyd_pair_status_text(now));
}

static dyd_delaunay_options check_options(const check_state *s) {
  return (dyd_delaunay_options){DYD_SIZED(dyd_delaunay_options), .cancel = check_flag(s),
                                .prove = s->o->no_ties ? NULL : dyd_ties_prove, .prove_user = s->e};
}

static dyd_status check_path(check_state *s) {
  DYD_OWNED(dyd_delaunay) *fresh = NULL;
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_delaunay_options options = check_options(s);
  dyd_status st = dyd_delaunay_new(&fresh, s->e->sites, &options, NULL);
  if (st == DYD_OK) st = dyd_delaunay_pairs(&pairs, fresh);
  if (st == DYD_OK) pairs_compare_lists(s, &s->before, &pairs, same_or_floor);
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* ---- choices ---- */

/* A point of an interval: an end, or a multiple of an eighth of the way. */
static void choice_point(mpq_t out, uint64_t *random, const dyd_interval *a) {
  DYD_LOCAL_NUMBERS(mpq, hi);
  dyd_interval_get_q(out, hi, a);
  mpq_sub(hi, hi, out);
  mpz_mul_ui(mpq_numref(hi), mpq_numref(hi), (unsigned long)check_below(random, 9));
  mpz_mul_ui(mpq_denref(hi), mpq_denref(hi), 8);
  mpq_canonicalize(hi);
  mpq_add(out, out, hi);
}

static dyd_status choose_all(dyd_sites *out, check_state *s) {
  DYD_LOCAL(dyd_rect, r, point);
  DYD_LOCAL_NUMBERS(mpq, x, y);
  dyd_status st = DYD_OK;
  for (size_t i = 0; i < dyd_sites_count(s->e->sites) && st == DYD_OK; i++) {
    size_t same = dyd_sites_joined(s->e->sites, i);
    st = same < i ? dyd_sites_get(&r, out, same) : dyd_sites_get(&r, s->e->sites, i);
    if (st != DYD_OK) break;
    choice_point(x, &s->random, &r.x);
    choice_point(y, &s->random, &r.y);
    st = dyd_rect_set_q(&point, x, y);
    if (st == DYD_OK) st = dyd_sites_add_rect(out, &point);
  }
  return st;
}

/* Statuses `exact` of the choice against those of the rectangles: pairs whose points coincide are omitted. */
static void compare_choice(check_state *s, const dyd_delaunay *exact, const dyd_pair_list *pairs) {
  for (size_t k = 0; k < s->before.count && !fault_found(s); k++) {
    const dyd_pair *p = &s->before.item[k];
    if (p->status != DYD_LEGAL || is_alias(exact, p->i) || is_alias(exact, p->j)) continue;
    if (dyd_delaunay_status(exact, p->i, p->j) != DYD_LEGAL)
      check_found(s, DYD_CHECK_CHOICE, "pair %u %u is legal, but not an edge for a choice of points", (unsigned)p->i,
                  (unsigned)p->j);
  }
  for (size_t k = 0; k < pairs->count && !fault_found(s); k++) {
    const dyd_pair *p = &pairs->item[k];
    if (is_alias(s->pd, p->i) || is_alias(s->pd, p->j)) continue;
    if (dyd_delaunay_status(s->pd, p->i, p->j) == DYD_ILLEGAL)
      check_found(s, DYD_CHECK_CHOICE, "pair %u %u is illegal, but an edge for a choice of points", (unsigned)p->i,
                  (unsigned)p->j);
  }
}

static dyd_status check_choice(check_state *s) {
  DYD_OWNED(dyd_sites) *sites = NULL;
  DYD_OWNED(dyd_delaunay) *exact = NULL;
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_delaunay_options options = {DYD_SIZED(dyd_delaunay_options), .cancel = check_flag(s)};
  dyd_status st = dyd_sites_new(&sites);
  if (st == DYD_OK) st = choose_all(sites, s);
  if (st == DYD_OK) st = dyd_delaunay_new(&exact, sites, &options, NULL);
  if (st == DYD_OK) st = dyd_delaunay_pairs(&pairs, exact);
  if (st == DYD_OK) compare_choice(s, exact, &pairs);
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* ---- cells ---- */

static void watched_forget(watched_cell *w) {
  dyd_polygon_list_clear(&w->inner);
  dyd_polygon_list_clear(&w->outer);
}

/* Sets *out to whether both points are in one C_ji for a possible neighbour j. */
static dyd_status edge_is_outside(bool *out, const check_state *s, uint32_t i, const dyd_point *a, const dyd_point *b) {
  DYD_SCOPED(dyd_index_list) list = {0};
  DYD_LOCAL(dyd_rect, own, other);
  dyd_status st = dyd_delaunay_neighbours(&list, s->pd, i, DYD_TIE);
  if (st == DYD_OK) st = dyd_sites_get(&own, s->e->sites, i);
  for (size_t k = 0; k < list.count && st == DYD_OK && !*out; k++) {
    st = dyd_sites_get(&other, s->e->sites, list.item[k]);
    *out = st == DYD_OK && dyd_nearer(a, &other, &own) == DYD_TRUE && dyd_nearer(b, &other, &own) == DYD_TRUE;
  }
  return st;
}

static dyd_status point_is_on_side(bool *out, const check_state *s, uint32_t i, const dyd_point *c, dyd_truth side) {
  dyd_truth truth = DYD_UNKNOWN;
  dyd_status st = dyd_cell_point_side(&truth, s->pd, i, c);
  *out = truth == side;
  return st;
}

/* Not on a side of it, where outer polygons are cut [POLY-3]. */
static bool is_inside_window(const dyd_rect *w, const dyd_point *z) {
  return dyd_dyadic_cmp(&w->x.lo, &z->x) < 0 && dyd_dyadic_cmp(&z->x, &w->x.hi) < 0 &&
         dyd_dyadic_cmp(&w->y.lo, &z->y) < 0 && dyd_dyadic_cmp(&z->y, &w->y.hi) < 0;
}

/* Where the edge was in Ext_i because of a former neighbour, its ends still are; edges that end at the window are not
 * checked. */
static dyd_status outer_edge_holds(bool *out, const check_state *s, uint32_t i, const dyd_point *a,
                                   const dyd_point *b) {
  *out = !is_inside_window(&s->window, a) || !is_inside_window(&s->window, b);
  dyd_status st = *out ? DYD_OK : edge_is_outside(out, s, i, a, b);
  if (st != DYD_OK || *out) return st;
  st = point_is_on_side(out, s, i, a, DYD_FALSE);
  return st == DYD_OK && *out ? point_is_on_side(out, s, i, b, DYD_FALSE) : st;
}

/* The inner vertices are still in Int_i, the outer ones in the window still in Ext_i. */
static dyd_status check_cell(check_state *s, const watched_cell *w) {
  dyd_status st = DYD_OK;
  if (is_alias(s->pd, w->site)) return DYD_OK;
  for (size_t k = 0; w->inner.count && k < w->inner.item->count && st == DYD_OK && !fault_found(s); k++) {
    bool inside;
    st = point_is_on_side(&inside, s, w->site, &w->inner.item->vertex[k], DYD_TRUE);
    if (st == DYD_OK && !inside) check_found(s, DYD_CHECK_CELL, "Int of site %u has lost a point", (unsigned)w->site);
  }
  for (size_t p = 0; p < w->outer.count; p++)
    for (size_t k = 0; k < w->outer.item[p].count && st == DYD_OK && !fault_found(s); k++) {
      const dyd_polygon *g = &w->outer.item[p];
      const dyd_point *a = &g->vertex[k], *b = &g->vertex[(k + 1) % g->count];
      bool outside;
      st = outer_edge_holds(&outside, s, w->site, a, b);
      if (st == DYD_OK && !outside)
        check_found(s, DYD_CHECK_CELL, "Ext of site %u has lost a point", (unsigned)w->site);
    }
  s->report->cells++;
  return st;
}

static dyd_status watched_make(watched_cell *w, check_state *s) {
  size_t n = dyd_sites_count(s->e->sites);
  int64_t bits = dyd_metric_coarseness(s->pd, &s->window) + 6;
  watched_forget(w);
  w->site = dyd_delaunay_alias(s->pd, (uint32_t)check_below(&s->random, n));
  dyd_status st = dyd_voronoi_polygons(&w->inner, s->pd, w->site, DYD_CELL_SURE, &s->window, bits);
  if (st == DYD_OK) st = dyd_voronoi_polygons(&w->outer, s->pd, w->site, DYD_CELL_POSSIBLE, &s->window, bits);
  return st == DYD_E_RANGE ? DYD_OK : st; /* scales too far apart for polygons: nothing to watch */
}

static dyd_status check_cells(check_state *s, bool last) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < s->watch_count && st == DYD_OK; k++) st = check_cell(s, &s->watched[k]);
  if (last || s->o->no_cells || !dyd_sites_count(s->e->sites) || dyd_delaunay_is_capped(s->pd)) return st;
  if (!s->watched) {
    s->watched = calloc(s->o->cells, sizeof *s->watched);
    if (!s->watched) return DYD_E_NOMEM;
    s->windowed = dyd_voronoi_window(&s->window, s->e->sites) == DYD_OK;
    s->watch_count = s->windowed ? s->o->cells : 0;
  }
  for (size_t k = 0; k < s->watch_count && st == DYD_OK; k++) st = watched_make(&s->watched[k], s);
  return st;
}

/* ---- a stage ---- */

static dyd_status check_triangulate(bool *capped, check_state *s) {
  const dyd_delaunay_options options = check_options(s);
  bool joined = true;
  dyd_status st = DYD_OK;
  while (joined && st == DYD_OK) {
    joined = false;
    st = s->pd ? dyd_delaunay_update(s->pd, s->changed, s->changes, &options, NULL)
               : dyd_delaunay_new(&s->pd, s->e->sites, &options, NULL);
    *capped = st == DYD_CAPPED;
    if (*capped) st = DYD_OK;
    if (st == DYD_OK && options.prove) st = dyd_aliases_find(&joined, s->e, s->pd, NULL);
  }
  s->changes = 0;
  return st;
}

/* Triangulates and checks everything; the last stage also against a fresh run and random choices. */
static dyd_status check_stage(check_state *s, bool last) {
  bool first = !s->pd, capped;
  dyd_pair_list now = {0};
  if (check_is_over(s)) return DYD_CANCELLED;
  dyd_status st = check_triangulate(&capped, s);
  if (st != DYD_OK) return st;
  s->report->stages++;
  st = dyd_delaunay_pairs(&now, s->pd);
  if (st != DYD_OK) return st;
  if (!first && !capped) pairs_compare_lists(s, &s->before, &now, not_retracted);
  dyd_pair_list_clear(&s->before);
  s->before = now;
  if (!fault_found(s) && !capped) st = check_cells(s, last);
  if (st == DYD_OK && last && !fault_found(s) && !capped) st = check_path(s);
  if (st == DYD_OK && last && !fault_found(s) && !capped) st = check_choice(s);
  return st;
}

static void check_state_clear(check_state *s) {
  for (size_t k = 0; s->watched && k < s->o->cells; k++) watched_forget(&s->watched[k]);
  dyd_free_all(s->watched, s->changed);
  dyd_pair_list_clear(&s->before);
  dyd_delaunay_free(s->pd);
  dyd_engine_free(s->e);
  dyd_rect_clear(&s->window);
}

const char *dyd_check_fault_text(dyd_check_fault fault) {
  static const char *const text[] = {"fine", "stream", "rate", "retract", "cell", "path", "choice"};
  return (unsigned)fault < sizeof text / sizeof *text ? text[fault] : "unknown";
}

void dyd_check_report_clear(dyd_check_report *r) {
  const dyd_check_report none = {0};
  free(r->move);
  dyd_abi_give(r, &none, sizeof none);
}

/* Fills in *o, and clears the report and the error record. o->seconds becomes the end, by dyd_seconds. */
static dyd_status check_begin(dyd_check_options *o, dyd_check_report *out, const dyd_check_options *given,
                              dyd_error *err) {
  dyd_error_clear(err);
  dyd_status st = dyd_abi_check(out, sizeof *out, "dyd_check_report", err);
  if (st == DYD_OK) st = dyd_abi_take(o, sizeof *o, given, "dyd_check_options", err);
  if (st != DYD_OK) return st;
  dyd_check_report_clear(out);
  if (!o->schedules) o->schedules = 100;
  if (!o->base_bits) o->base_bits = 8;
  if (!o->max_bits) o->max_bits = 192;
  if (!o->slack_bits) o->slack_bits = 16;
  if (!o->stages) o->stages = 6;
  if (!o->cells) o->cells = 6;
  if (!o->tie_bits) o->tie_bits = DYD_TIE_BITS;
  if (o->base_bits > o->max_bits) o->base_bits = o->max_bits;
  if (o->seconds > 0) o->seconds += dyd_seconds();
  return DYD_OK;
}

typedef struct move_list {
  dyd_check_move *item;
  size_t count, cap;
} move_list;

/* ---- one schedule ---- */

/* DYD_E_ARG with the number of the first move that cannot be made. */
static dyd_status schedule_fits(const move_list *m, const dyd_engine *e, dyd_error *err) {
  const size_t points = dyd_sites_count(e->sites);
  for (size_t k = 0; k < m->count; k++) {
    const dyd_check_move *move = &m->item[k];
    const bool early = move->stage < (k ? move[-1].stage : 1);
    if (!early && move->point < points) continue;
    if (err) err->line = k + 1;
    if (early) return dyd_fail(err, DYD_E_ARG, "stage %u is out of order; give stages from 1, ascending", move->stage);
    return dyd_fail(err, DYD_E_ARG, "there is no point %u among these %zu points; give points from 0 on", move->point,
                    points);
  }
  return DYD_OK;
}

/* Opens the points, starts the clock and asks all points for base_bits. */
static dyd_status schedule_start(check_state *s, dyd_check_open_fn open, void *user, const move_list *m,
                                 dyd_error *err) {
  dyd_status st = open(&s->e, user, err);
  if (st == DYD_OK) st = schedule_fits(m, s->e, err);
  if (st == DYD_OK) s->e->tie_bits = s->o->tie_bits;
  double left = s->o->seconds > 0 ? s->o->seconds - dyd_seconds() : 0;
  if (st == DYD_OK && left < 0) return DYD_CANCELLED;
  if (st == DYD_OK) dyd_watch_start(&s->watch, left, &s->e->stop);
  for (size_t k = 0; st == DYD_OK && k < s->e->points && s->report->fault == DYD_CHECK_FINE; k++)
    st = check_narrow(s, s->e->point[k].site, s->o->base_bits);
  return st;
}

/* Runs a schedule; counters and the fault go to *report. */
static dyd_status schedule_play(dyd_check_report *report, dyd_check_open_fn open, void *user, const move_list *m,
                                uint64_t seed, const dyd_check_options *o, dyd_error *err) {
  DYD_SCOPED(check_state) s = {.o = o, .report = report, .random = seed};
  dyd_rect_init(&s.window);
  dyd_status st = schedule_start(&s, open, user, m, err);
  size_t k = 0;
  if (st == DYD_OK && report->fault == DYD_CHECK_FINE) st = check_stage(&s, m->count == 0);
  while (st == DYD_OK && report->fault == DYD_CHECK_FINE && k < m->count) {
    uint32_t stage = m->item[k].stage;
    for (; k < m->count && m->item[k].stage == stage && st == DYD_OK && report->fault == DYD_CHECK_FINE; k++)
      st = check_narrow(&s, m->item[k].point, m->item[k].bits);
    if (st == DYD_OK && report->fault == DYD_CHECK_FINE) st = check_stage(&s, k == m->count);
  }
  if (s.e) dyd_watch_stop(&s.watch);
  if (st == DYD_E_NOMEM) dyd_fail_nomem(err);
  return st;
}

/* ---- random schedules ---- */

static dyd_status moves_add(move_list *m, uint32_t stage, uint32_t point, int64_t bits) {
  if (!DYD_GROW(m->item, m->cap, m->count + 1)) return DYD_E_NOMEM;
  m->item[m->count++] = (dyd_check_move){stage, point, bits};
  return DYD_OK;
}

/* The points that can be narrowed, and the last precision requested of each. */
typedef struct askable {
  uint32_t *point;
  int64_t *asked;
  size_t count;
} askable;

static dyd_status add_step(move_list *m, uint32_t stage, const askable *p, size_t at, int64_t bits) {
  p->asked[at] = bits;
  return moves_add(m, stage, p->point[at], bits);
}

/* A few points, each by one bit or two more again and again: what drifts is seen where steps are small. */
static dyd_status schedule_add_small_steps(move_list *m, uint32_t stage, uint64_t *random, const askable *p,
                                           int64_t top) {
  dyd_status st = DYD_OK;
  size_t count = 1 + (size_t)check_below(random, 4);
  for (size_t k = 0; k < count; k++) {
    size_t at = (size_t)check_below(random, p->count), steps = 1 + (size_t)check_below(random, 8);
    for (size_t q = 0; q < steps && st == DYD_OK && p->asked[at] < top; q++)
      st = add_step(m, stage, p, at, p->asked[at] + 1 + (int64_t)check_below(random, top - p->asked[at] > 1 ? 2 : 1));
  }
  return st;
}

/* Walks each point from its last precision to `top`: a source that fails at one precision is found. At the default
 * precision steps are of one bit or two; where there are more than MOST_STEPS of them, wider. */
static dyd_status schedule_add_walk(move_list *m, uint32_t stage, uint64_t *random, const askable *p, int64_t top,
                                    int64_t span) {
  enum { MOST_STEPS = 256 };
  const uint64_t step = 2 * (uint64_t)((span + MOST_STEPS - 1) / MOST_STEPS);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < p->count; k++)
    while (st == DYD_OK && p->asked[k] < top) {
      const int64_t next = p->asked[k] + 1 + (int64_t)check_below(random, step);
      st = add_step(m, stage, p, k, next < top ? next : top);
    }
  return st;
}

/* One stage: one point; a few; about a tenth; all at one precision; all unevenly; small steps. Repeats happen. */
static dyd_status schedule_add_stage(move_list *m, uint32_t stage, uint64_t *random, const askable *p,
                                     const dyd_check_options *o) {
  dyd_status st = DYD_OK;
  size_t n = p->count;
  uint64_t mode = check_below(random, 6);
  if (mode == 5) return schedule_add_small_steps(m, stage, random, p, o->max_bits);
  int64_t span = o->max_bits - o->base_bits + 1;
  int64_t top = o->base_bits + span * stage / o->stages,
          level = o->base_bits + (int64_t)check_below(random, (uint64_t)(top - o->base_bits) + 1);
  size_t count = mode == 0 ? 1 : mode == 1 ? 1 + (size_t)check_below(random, 8) : mode == 2 ? n / 10 + 1 : n;
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    size_t at = mode >= 3 ? k : (size_t)check_below(random, n);
    int64_t bits = mode == 3 ? level : o->base_bits + (int64_t)check_below(random, (uint64_t)(top - o->base_bits) + 1);
    st = add_step(m, stage, p, at, bits);
    if (st == DYD_OK && check_below(random, 16) == 0) st = add_step(m, stage, p, at, bits);
  }
  return st;
}

static dyd_status schedule_list_points(askable *out, dyd_check_open_fn open, void *user, dyd_error *err) {
  DYD_OWNED(dyd_engine) *e = NULL;
  dyd_status st = open(&e, user, err);
  if (st != DYD_OK) return st;
  *out = (askable){dyd_alloc(e->points, sizeof *out->point), dyd_alloc(e->points, sizeof *out->asked), e->points};
  if (!out->point || !out->asked) st = dyd_fail_nomem(err);
  for (size_t k = 0; k < e->points && st == DYD_OK; k++) out->point[k] = e->point[k].site;
  return st;
}

/* The first one walks all points up to the cap. */
static dyd_status schedule_make(move_list *m, uint64_t seed, const askable *p, bool first, const dyd_check_options *o) {
  const int64_t span = o->max_bits - o->base_bits;
  uint64_t random = seed;
  dyd_status st = DYD_OK;
  m->count = 0;
  for (size_t k = 0; k < p->count; k++) p->asked[k] = o->base_bits;
  for (uint32_t stage = 1; p->count && stage <= o->stages && st == DYD_OK; stage++)
    st = first ? schedule_add_walk(m, stage, &random, p, o->base_bits + span * stage / o->stages, span)
               : schedule_add_stage(m, stage, &random, p, o);
  return st;
}

/* ---- cutting down ---- */

/* Cuts [from, to) out of m if m still shows the fault without it; sets *cut then. */
static dyd_status schedule_try_without(bool *cut, move_list *m, size_t from, size_t to, dyd_check_fault fault,
                                       dyd_check_open_fn open, void *user, uint64_t seed, const dyd_check_options *o) {
  move_list less = {0};
  DYD_SCOPED(dyd_check_report) report = {0};
  *cut = false;
  less.item = dyd_alloc(m->count, sizeof *less.item);
  if (!less.item) return DYD_E_NOMEM;
  memcpy(less.item, m->item, from * sizeof *less.item);
  memcpy(less.item + from, m->item + to, (m->count - to) * sizeof *less.item);
  less.count = m->count - (to - from);
  dyd_status st = schedule_play(&report, open, user, &less, seed, o, NULL);
  if (st == DYD_OK && report.fault == fault) {
    memcpy(m->item, less.item, less.count * sizeof *less.item);
    m->count = less.count;
    *cut = true;
  }
  free(less.item);
  return st;
}

/* Omits ever smaller parts while the fault stays, until no single move can be omitted. */
static dyd_status schedule_cut_down(move_list *m, dyd_check_fault fault, dyd_check_open_fn open, void *user,
                                    uint64_t seed, const dyd_check_options *o) {
  dyd_status st = DYD_OK;
  for (size_t size = m->count; size > 0 && st == DYD_OK;) {
    bool any = false;
    for (size_t from = 0; from < m->count && st == DYD_OK;) {
      size_t to = from + size < m->count ? from + size : m->count;
      bool cut;
      st = schedule_try_without(&cut, m, from, to, fault, open, user, seed, o);
      any |= cut;
      if (!cut) from = to;
    }
    if (size > 1)
      size = (size + 1) / 2;
    else if (!any)
      break;
  }
  return st;
}

/* ---- public ---- */

/* Keeps the shortest schedule that shows the fault found by m. */
static dyd_status report_keep_fault(dyd_check_report *out, move_list *m, uint64_t seed, dyd_check_open_fn open,
                                    void *user, const dyd_check_options *o) {
  DYD_SCOPED(dyd_check_report) again = {0};
  out->seed = seed;
  out->base_bits = o->base_bits;
  dyd_status st = schedule_cut_down(m, out->fault, open, user, seed, o);
  if (st == DYD_OK) st = schedule_play(&again, open, user, m, seed, o, NULL);
  if (st == DYD_OK && again.fault == out->fault) memcpy(out->message, again.message, sizeof out->message);
  out->move = m->item;
  out->moves = m->count;
  *m = (move_list){0};
  return st;
}

/* Runs the schedule of the options. */
static dyd_status schedule_replay(dyd_check_report *out, dyd_check_open_fn open, void *user, const dyd_check_options *o,
                                  dyd_error *err) {
  move_list m = {.item = dyd_alloc(o->moves, sizeof *m.item), .count = o->moves};
  if (!m.item) return dyd_fail_nomem(err);
  memcpy(m.item, o->move, o->moves * sizeof *m.item);
  dyd_status st = schedule_play(out, open, user, &m, o->seed, o, err);
  out->schedules = 1;
  out->seed = o->seed;
  out->base_bits = o->base_bits;
  if (st == DYD_OK && out->fault != DYD_CHECK_FINE) {
    out->move = m.item;
    out->moves = m.count;
  } else {
    free(m.item);
  }
  return st;
}

dyd_status dyd_check_run(dyd_check_report *out, dyd_check_open_fn open, void *user, const dyd_check_options *given,
                         dyd_error *err) {
  dyd_check_options o;
  move_list m = {0};
  askable points = {0};
  dyd_error unused;
  if (!err) err = &unused;
  dyd_status st = check_begin(&o, out, given, err);
  if (st == DYD_OK && o.move) return schedule_replay(out, open, user, &o, err);
  if (st == DYD_OK) st = schedule_list_points(&points, open, user, err);
  for (unsigned k = 0; k < o.schedules && st == DYD_OK && out->fault == DYD_CHECK_FINE; k++) {
    uint64_t seed = o.seed + k;
    if (o.progress) o.progress(o.progress_user, k, o.schedules);
    st = schedule_make(&m, seed, &points, k == 0, &o);
    if (st == DYD_OK) st = schedule_play(out, open, user, &m, seed, &o, err);
    if (st == DYD_OK) out->schedules++;
    if (st == DYD_OK && out->fault != DYD_CHECK_FINE) st = report_keep_fault(out, &m, seed, open, user, &o);
  }
  dyd_free_all(m.item, points.point, points.asked);
  return st;
}
