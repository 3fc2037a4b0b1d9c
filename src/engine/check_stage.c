/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the harness compares after each stage. Only exact comparisons; random numbers choose what to look at. */
#include "engine/check.h"

#include "engine/aliases.h"
#include "engine/ties.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "rect/rect.h"
#include "stream/stream.h"
#include "voronoi/exact_cell.h"
#include <stdarg.h>
#include <stdio.h>

/* What stops a triangulation at once: the deadline where there is one. */
static const volatile int *check_flag(const dyd_check_state *s) {
  return s->o->cancel && !(s->o->seconds > 0) ? s->o->cancel : &s->e->stop;
}

bool dyd_check_is_over(const dyd_check_state *s) {
  return dyd_flag_get(&s->e->stop) || (s->o->cancel && dyd_flag_get(s->o->cancel));
}

/* splitmix64 */
uint64_t dyd_check_below(uint64_t *random, uint64_t n) {
  uint64_t z = *random += UINT64_C(0x9E3779B97F4A7C15);
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return (z ^ (z >> 31)) % n;
}

dyd_status dyd_check_found(dyd_check_state *s, dyd_check_fault fault, const char *format, ...) {
  va_list list;
  if (s->report->fault != DYD_CHECK_FINE) return DYD_OK;
  s->report->fault = fault;
  va_start(list, format);
  vsnprintf(s->report->message, sizeof s->report->message, format, list);
  va_end(list);
  return DYD_OK;
}

static bool fault_found(const dyd_check_state *s) {
  return s->report->fault != DYD_CHECK_FINE;
}

/* ---- streams ---- */

dyd_status dyd_check_narrow(dyd_check_state *s, uint32_t point, int64_t bits) {
  const dyd_refinable *found = dyd_engine_find(s->e, point);
  dyd_error err;
  uint64_t calls = 0;
  dyd_error_clear(&err);
  if (dyd_check_is_over(s)) return DYD_CANCELLED;
  if (!found || found->final) return DYD_OK;
  dyd_refinable *p = &s->e->point[found - s->e->point];
  dyd_status st = dyd_engine_narrow(p, &calls, s->e, bits, s->o->max_bits, &err);
  if (st == DYD_E_NOMEM || st == DYD_CANCELLED) return st;
  if (st != DYD_OK)
    return dyd_check_found(s, DYD_CHECK_STREAM, "point %u, asked for %lld bits: %s", (unsigned)point, (long long)bits,
                           err.message);
  if (!dyd_reserve((void **)&s->changed, &s->change_cap, s->changes + 1, sizeof *s->changed)) return DYD_E_NOMEM;
  s->changed[s->changes++] = point;
  if (p->final) return DYD_OK;
  dyd_rect r;
  dyd_rect_init(&r);
  st = dyd_sites_get(&r, s->e->sites, point);
  int64_t least = bits - s->o->slack_bits;
  if (st == DYD_OK && !(p->stream ? dyd_stream_reaches(p->stream, &r, least) : dyd_rect_bits(&r) >= least))
    dyd_check_found(s, DYD_CHECK_RATE, "point %u, asked for %lld bits, is only within 2^%lld", (unsigned)point,
                    (long long)bits, -(long long)dyd_rect_bits(&r));
  dyd_rect_clear(&r);
  return st;
}

/* ---- statuses ---- */

static bool is_alias(const dyd_delaunay *pd, uint32_t i) {
  return dyd_delaunay_alias(pd, i) != i;
}

static const char *pair_word(dyd_pair_status st) {
  static const char *const text[] = {"illegal", "tie", "indeterminate", "legal"};
  return text[st];
}

/* What is said of one pair before and now. */
typedef void (*pair_visit)(dyd_check_state *s, const dyd_pair *pair, dyd_pair_status before, dyd_pair_status now);

/* Merges two sorted lists. */
static void pairs_compare_lists(dyd_check_state *s, const dyd_pair_list *before, const dyd_pair_list *now,
                                pair_visit visit) {
  size_t a = 0, b = 0;
  while ((a < before->count || b < now->count) && !fault_found(s)) {
    int c = a == before->count ? 1 : b == now->count ? -1 : dyd_compare_two(&before->item[a], &now->item[b]);
    const dyd_pair *pair = c <= 0 ? &before->item[a] : &now->item[b];
    visit(s, pair, c <= 0 ? before->item[a].status : DYD_ILLEGAL, c >= 0 ? now->item[b].status : DYD_ILLEGAL);
    a += c <= 0;
    b += c >= 0;
    s->report->pairs++;
  }
}

static void not_retracted(dyd_check_state *s, const dyd_pair *p, dyd_pair_status before, dyd_pair_status now) {
  if (is_alias(s->pd, p->i) || is_alias(s->pd, p->j)) return; /* became one exact point with another */
  bool settled = before == DYD_LEGAL || (before == DYD_TIE && !s->o->no_ties);
  if (before == DYD_ILLEGAL || (settled && now != before))
    dyd_check_found(s, DYD_CHECK_RETRACT, "pair %u %u was %s and is %s", (unsigned)p->i, (unsigned)p->j,
                    pair_word(before), pair_word(now));
}

static void same_or_floor(dyd_check_state *s, const dyd_pair *p, dyd_pair_status before, dyd_pair_status now) {
  bool floor = (before == DYD_LEGAL && now == DYD_INDETERMINATE) || (before == DYD_INDETERMINATE && now == DYD_LEGAL);
  s->report->floors += floor;
  if (before != now && !floor)
    dyd_check_found(s, DYD_CHECK_PATH, "pair %u %u is %s, but %s in a fresh run from the same rectangles",
                    (unsigned)p->i, (unsigned)p->j, pair_word(before), pair_word(now));
}

static dyd_delaunay_options check_options(const dyd_check_state *s) {
  return (dyd_delaunay_options){DYD_SIZED(dyd_delaunay_options), .cancel = check_flag(s),
                                .prove = s->o->no_ties ? NULL : dyd_ties_prove, .prove_user = s->e};
}

static dyd_status check_path(dyd_check_state *s) {
  dyd_delaunay *fresh = NULL;
  dyd_pair_list pairs = {0};
  dyd_delaunay_options options = check_options(s);
  dyd_status st = dyd_delaunay_new(&fresh, s->e->sites, &options, NULL);
  if (st == DYD_OK) st = dyd_delaunay_pairs(&pairs, fresh);
  if (st == DYD_OK) pairs_compare_lists(s, &s->before, &pairs, same_or_floor);
  dyd_pair_list_clear(&pairs);
  dyd_delaunay_free(fresh);
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* ---- choices ---- */

/* A point of an interval: an end, or a multiple of an eighth of the way. */
static void choice_point(mpq_t out, uint64_t *random, const dyd_interval *a) {
  mpq_t hi;
  mpq_init(hi);
  dyd_interval_get_q(out, hi, a);
  mpq_sub(hi, hi, out);
  mpz_mul_ui(mpq_numref(hi), mpq_numref(hi), (unsigned long)dyd_check_below(random, 9));
  mpz_mul_ui(mpq_denref(hi), mpq_denref(hi), 8);
  mpq_canonicalize(hi);
  mpq_add(out, out, hi);
  mpq_clear(hi);
}

static dyd_status choose_all(dyd_sites *out, dyd_check_state *s) {
  dyd_rect r, point;
  mpq_t x, y;
  dyd_rect_init(&r);
  dyd_rect_init(&point);
  mpq_inits(x, y, NULL);
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
  mpq_clears(x, y, NULL);
  dyd_rect_clear(&point);
  dyd_rect_clear(&r);
  return st;
}

/* Statuses `exact` of the choice against those of the rectangles: pairs whose points coincide are left out. */
static void compare_choice(dyd_check_state *s, const dyd_delaunay *exact, const dyd_pair_list *pairs) {
  for (size_t k = 0; k < s->before.count && !fault_found(s); k++) {
    const dyd_pair *p = &s->before.item[k];
    if (p->status != DYD_LEGAL || is_alias(exact, p->i) || is_alias(exact, p->j)) continue;
    if (dyd_delaunay_status(exact, p->i, p->j) != DYD_LEGAL)
      dyd_check_found(s, DYD_CHECK_CHOICE, "pair %u %u is legal, but not an edge for a choice of points",
                      (unsigned)p->i, (unsigned)p->j);
  }
  for (size_t k = 0; k < pairs->count && !fault_found(s); k++) {
    const dyd_pair *p = &pairs->item[k];
    if (is_alias(s->pd, p->i) || is_alias(s->pd, p->j)) continue;
    if (dyd_delaunay_status(s->pd, p->i, p->j) == DYD_ILLEGAL)
      dyd_check_found(s, DYD_CHECK_CHOICE, "pair %u %u is illegal, but an edge for a choice of points", (unsigned)p->i,
                      (unsigned)p->j);
  }
}

static dyd_status check_choice(dyd_check_state *s) {
  dyd_sites *sites = NULL;
  dyd_delaunay *exact = NULL;
  dyd_pair_list pairs = {0};
  dyd_delaunay_options options = {DYD_SIZED(dyd_delaunay_options), .cancel = check_flag(s)};
  dyd_status st = dyd_sites_new(&sites);
  if (st == DYD_OK) st = choose_all(sites, s);
  if (st == DYD_OK) st = dyd_delaunay_new(&exact, sites, &options, NULL);
  if (st == DYD_OK) st = dyd_delaunay_pairs(&pairs, exact);
  if (st == DYD_OK) compare_choice(s, exact, &pairs);
  dyd_pair_list_clear(&pairs);
  dyd_delaunay_free(exact);
  dyd_sites_free(sites);
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* ---- cells ---- */

static void watched_forget(dyd_watched *w) {
  dyd_polygon_clear(&w->inner);
  dyd_polygon_list_clear(&w->outer);
}

/* Are both points in one C_ji for a possible neighbour j? */
static dyd_status edge_is_outside(bool *out, const dyd_check_state *s, uint32_t i, const dyd_point *a,
                                  const dyd_point *b) {
  dyd_index_list list = {0};
  dyd_rect own, other;
  dyd_rect_init(&own);
  dyd_rect_init(&other);
  dyd_status st = dyd_delaunay_neighbours(&list, s->pd, i, DYD_TIE);
  if (st == DYD_OK) st = dyd_sites_get(&own, s->e->sites, i);
  for (size_t k = 0; k < list.count && st == DYD_OK && !*out; k++) {
    st = dyd_sites_get(&other, s->e->sites, list.item[k]);
    *out = st == DYD_OK && dyd_nearer(a, &other, &own) == DYD_TRUE && dyd_nearer(b, &other, &own) == DYD_TRUE;
  }
  dyd_index_list_clear(&list);
  dyd_rect_clear(&other);
  dyd_rect_clear(&own);
  return st;
}

static dyd_status point_is_on_side(bool *out, const dyd_check_state *s, uint32_t i, const dyd_point *c,
                                   dyd_truth side) {
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

/* Where the edge was in Ext_i by a neighbour that is none any more, its ends are at least; of edges that end at the
 * window nothing is stated. */
static dyd_status outer_edge_holds(bool *out, const dyd_check_state *s, uint32_t i, const dyd_point *a,
                                   const dyd_point *b) {
  *out = !is_inside_window(&s->window, a) || !is_inside_window(&s->window, b);
  dyd_status st = *out ? DYD_OK : edge_is_outside(out, s, i, a, b);
  if (st != DYD_OK || *out) return st;
  st = point_is_on_side(out, s, i, a, DYD_FALSE);
  return st == DYD_OK && *out ? point_is_on_side(out, s, i, b, DYD_FALSE) : st;
}

/* The inner vertices are still in Int_i, the outer ones in the window still in Ext_i. */
static dyd_status check_cell(dyd_check_state *s, const dyd_watched *w) {
  dyd_status st = DYD_OK;
  if (is_alias(s->pd, w->site)) return DYD_OK;
  for (size_t k = 0; k < w->inner.count && st == DYD_OK && !fault_found(s); k++) {
    bool inside;
    st = point_is_on_side(&inside, s, w->site, &w->inner.vertex[k], DYD_TRUE);
    if (st == DYD_OK && !inside)
      dyd_check_found(s, DYD_CHECK_CELL, "Int of site %u has lost a point", (unsigned)w->site);
  }
  for (size_t p = 0; p < w->outer.count; p++)
    for (size_t k = 0; k < w->outer.item[p].count && st == DYD_OK && !fault_found(s); k++) {
      const dyd_polygon *g = &w->outer.item[p];
      const dyd_point *a = &g->vertex[k], *b = &g->vertex[(k + 1) % g->count];
      bool outside;
      st = outer_edge_holds(&outside, s, w->site, a, b);
      if (st == DYD_OK && !outside)
        dyd_check_found(s, DYD_CHECK_CELL, "Ext of site %u has lost a point", (unsigned)w->site);
    }
  s->report->cells++;
  return st;
}

static dyd_status watched_make(dyd_watched *w, dyd_check_state *s) {
  size_t n = dyd_sites_count(s->e->sites);
  int64_t bits = dyd_metric_coarseness(s->pd, &s->window) + 6;
  watched_forget(w);
  w->site = dyd_delaunay_alias(s->pd, (uint32_t)dyd_check_below(&s->random, n));
  dyd_status st = dyd_voronoi_inner_polygon(&w->inner, s->pd, w->site, &s->window, bits);
  if (st == DYD_OK) st = dyd_voronoi_outer_polygon(&w->outer, s->pd, w->site, &s->window, bits);
  return st == DYD_E_RANGE ? DYD_OK : st; /* scales too far apart for polygons: nothing to watch */
}

static dyd_status check_cells(dyd_check_state *s, bool last) {
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

static dyd_status check_triangulate(bool *capped, dyd_check_state *s) {
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

dyd_status dyd_check_stage(dyd_check_state *s, bool last) {
  bool first = !s->pd, capped;
  dyd_pair_list now = {0};
  if (dyd_check_is_over(s)) return DYD_CANCELLED;
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

void dyd_check_state_clear(dyd_check_state *s) {
  for (size_t k = 0; s->watched && k < s->o->cells; k++) watched_forget(&s->watched[k]);
  free(s->watched);
  free(s->changed);
  dyd_pair_list_clear(&s->before);
  dyd_delaunay_free(s->pd);
  dyd_engine_free(s->e);
  dyd_rect_clear(&s->window);
}
