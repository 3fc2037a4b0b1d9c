/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of convergence: the state after each stage of a run.
 *
 * Widths are compared and kept as t 2^e with 2^63 <= t < 2^64, rounded up: rounding is monotone, so the largest and the
 * median of the rounded widths are the rounded largest and median. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/index.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "engine/ask.h"
#include "engine/record.h"
#include "metric/bounds.h"
#include "rect/rect.h"
#include "stream/stream.h"

#include <dyadel/converge.h>
#include <dyadel/metric.h>
#include <dyadel/predicate.h>
#include <dyadel/tolerance.h>
#include <math.h>

/* The best choice in hindsight: the least sum of bits by which a goal holds.
 *
 * With b bits a point is known as its rectangle, rounded outward to multiples of 2^-(b + 2): these rectangles are
 * nested, so that the vectors of bits for which the goal holds are closed upward. The search goes through the points in
 * turn. With the first k given, the least bits that each other point needs while all the rest are at the top bound the
 * sum from below; where these together suffice they are the best completion. */

/* Invariant: bits[k], of refinable points alone, from `first` to `top`; sum > best is of no use. */
typedef struct hindsight {
  const dyd_engine *e;
  const dyd_engine_options *o;
  dyd_rect *rect; /* of all sites, narrow */
  int64_t *bits, *least, first, top;
  uint32_t *site; /* of these points, ascending */
  size_t points;
  uint64_t best, left;
  bool known; /* false: the budget is spent */
} hindsight;

/* r rounded outward, unless it is a point. */
static dyd_status hindsight_round(dyd_interval *out, const dyd_interval *r, int64_t bits) {
  if (dyd_interval_is_point(r)) {
    dyd_interval_set(out, r);
    return DYD_OK;
  }
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_interval_get_q(lo, hi, r);
  return dyd_interval_set_outward(out, lo, hi, -bits - 2);
}

/* A site at h->bits. */
static dyd_status hindsight_rect(dyd_rect *out, const void *user, size_t i) {
  const hindsight *h = user;
  const uint32_t *at = dyd_find_index(&(uint32_t){(uint32_t)i}, h->site, h->points, sizeof *h->site);
  dyd_rect_set(out, &h->rect[i]);
  if (!at) return DYD_OK;
  const int64_t bits = h->bits[at - h->site];
  dyd_status st = hindsight_round(&out->x, &h->rect[i].x, bits);
  return st == DYD_OK ? hindsight_round(&out->y, &h->rect[i].y, bits) : st;
}

/* Does the goal hold at h->bits? */
static dyd_status hindsight_holds(bool *out, hindsight *h) {
  DYD_OWNED(dyd_delaunay) *pd = NULL;
  *out = false;
  if (!h->left || dyd_flag_get(&h->e->cancelled)) {
    h->known = false;
    return DYD_OK;
  }
  h->left--;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = h->o->no_filter};
  dyd_status st = dyd_delaunay_made(&pd, dyd_sites_count(h->e->sites), hindsight_rect, h, &o, NULL);
  if (st == DYD_OK) {
    DYD_SCOPED(dyd_measure) m;
    dyd_measure_init(&m, dyd_delaunay_sites(pd));
    st = dyd_goal_of_pairs_holds(out, &m, pd, h->o);
  }
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* The least bits of point k that suffice with the others as they are; h->bits[k] does, and stays. */
static dyd_status hindsight_least(int64_t *out, hindsight *h, size_t k) {
  const int64_t kept = h->bits[k];
  int64_t low = h->first, high = kept;
  dyd_status st = DYD_OK;
  while (low < high && st == DYD_OK && h->known) {
    bool holds;
    h->bits[k] = low + (high - low) / 2;
    st = hindsight_holds(&holds, h);
    if (holds)
      high = h->bits[k];
    else
      low = h->bits[k] + 1;
  }
  h->bits[k] = kept;
  *out = high;
  return st;
}

/* With the bits of points before k given, those of the others at the top, for which the goal holds. Lowers h->best. */
static dyd_status hindsight_search(hindsight *h, size_t k, uint64_t spent) {
  int64_t *least = h->least + k * h->points;
  uint64_t sum = spent;
  bool holds;
  dyd_status st = DYD_OK;
  for (size_t j = k; j < h->points && st == DYD_OK; j++) {
    st = hindsight_least(&least[j], h, j);
    sum += (uint64_t)least[j];
  }
  if (st != DYD_OK || !h->known || sum >= h->best) return st;
  for (size_t j = k; j < h->points; j++) h->bits[j] = least[j];
  st = hindsight_holds(&holds, h);
  if (holds) h->best = sum;
  for (size_t j = k; j < h->points; j++) h->bits[j] = h->top;
  for (int64_t b = least[k]; st == DYD_OK && h->known && !holds && b <= h->top && sum < h->best; b++, sum++) {
    h->bits[k] = b;
    st = hindsight_search(h, k + 1, spent + (uint64_t)b);
  }
  h->bits[k] = h->top;
  return st;
}

/* Narrows the points of e, outside of it. */
static dyd_status hindsight_fetch(hindsight *h, dyd_engine *e, dyd_error *err) {
  enum { FINER = 16 };
  dyd_status st = DYD_OK;
  for (size_t i = 0; st == DYD_OK && i < dyd_sites_count(e->sites); i++) st = dyd_sites_get(&h->rect[i], e->sites, i);
  for (size_t k = 0; st == DYD_OK && k < e->points; k++) {
    const dyd_refinable *p = &e->point[k];
    DYD_OWNED(dyd_stream) *s = NULL;
    if (p->final) continue;
    h->site[h->points] = p->site;
    h->bits[h->points++] = h->top;
    st = dyd_engine_stream(&s, e, p->site);
    if (st == DYD_OK) st = dyd_stream_narrow(s, h->top + FINER, h->top + FINER, err);
    if (st >= 0) dyd_rect_set(&h->rect[p->site], dyd_stream_rect(s));
    if (st > 0) st = DYD_OK;
  }
  return st;
}

/* Sets *bits to the least sum of bits by which the goal of the run that has just ended holds, as
 * dyd_converge_options.hindsight says; 0: the outcome is neither decided nor certified, the goal is about the diagram,
 * or more than `most` triangulations are needed. DYD_CANCELLED is none: then it is not known either. */
static dyd_status dyd_hindsight_find(uint64_t *bits, dyd_engine *e, const dyd_engine_options *o, dyd_outcome outcome,
                                     dyd_stage_row *const *row, size_t rows, uint64_t most, dyd_error *err) {
  const size_t n = dyd_sites_count(e->sites);
  *bits = 0;
  if ((outcome != DYD_OUTCOME_DECIDED && outcome != DYD_OUTCOME_CERTIFIED) || o->goal > DYD_GOAL_HAUSDORFF || !rows ||
      !e->pd)
    return DYD_OK;
  hindsight h = {.e = e,
                 .o = o,
                 .first = row[0]->bits_least,
                 .top = 2 * row[rows - 1]->bits_most,
                 .best = UINT64_MAX,
                 .left = most,
                 .known = true};
  h.rect = dyd_alloc(n, sizeof *h.rect);
  h.bits = dyd_alloc(e->points, sizeof *h.bits);
  h.site = dyd_alloc(e->points, sizeof *h.site);
  h.least = dyd_alloc((e->points + 1) * (e->points + 1), sizeof *h.least);
  dyd_status st = h.rect && h.bits && h.site && h.least ? DYD_OK : DYD_E_NOMEM;
  bool holds = false;
  for (size_t i = 0; h.rect && i < n; i++) dyd_rect_init(&h.rect[i]);
  if (st == DYD_OK) st = hindsight_fetch(&h, e, err);
  if (st == DYD_OK) st = hindsight_holds(&holds, &h);
  if (st == DYD_OK && holds) st = hindsight_search(&h, 0, 0);
  if (st == DYD_OK && holds && h.known) *bits = h.best;
  for (size_t i = 0; h.rect && i < n; i++) dyd_rect_clear(&h.rect[i]);
  dyd_free_all(h.least, h.site, h.bits, h.rect);
  return st == DYD_E_NOMEM ? dyd_fail_nomem(err) : st;
}

/* dyd_dyadic_init, dyd_dyadic_clear for all numbers of a row. */
static void row_for_each(dyd_stage_row *r, void (*act)(dyd_dyadic *)) {
  dyd_dyadic *number[] = {&r->width_largest, &r->width_median, &r->area, &r->hausdorff, &r->v_area, &r->v_hausdorff};
  for (size_t k = 0; k < sizeof number / sizeof *number; k++) act(number[k]);
}

static void row_free(dyd_stage_row *r) {
  row_for_each(r, dyd_dyadic_clear);
  dyd_free_all(r->con, r);
}

/* A row behind those of out, not counted yet; NULL: memory is exhausted. */
static dyd_stage_row *row_new(dyd_convergence *out) {
  if (!DYD_GROW(out->row, out->cap, out->count + 1)) return NULL;
  dyd_stage_row *r = malloc(sizeof *r);
  if (!r) return NULL;
  *r = (dyd_stage_row){DYD_SIZED(dyd_stage_row), .rungs = {DYD_SIZED(dyd_delaunay_counters)}};
  row_for_each(r, dyd_dyadic_init);
  r->stage = out->count ? out->row[out->count - 1]->stage + 1 : 1;
  return r;
}

void dyd_convergence_clear(dyd_convergence *c) {
  const dyd_convergence none = {0};
  for (size_t k = 0; k < c->count; k++) row_free(c->row[k]);
  dyd_free_all(c->row, c->options);
  if (c->window) dyd_rect_clear(c->window);
  free(c->window);
  dyd_abi_give(c, &none, sizeof none);
}

/* ---- widths ---- */

/* top * 2^exp. Invariant: top >= 2^63, or top = 0 and exp = INT64_MIN. */
typedef struct width {
  int64_t exp;
  uint64_t top;
} width;

static int compare_width(const void *a, const void *b) {
  const width *v = a, *w = b;
  if (v->exp != w->exp) return v->exp < w->exp ? -1 : 1;
  return (v->top > w->top) - (v->top < w->top);
}

/* The least width >= x; x >= 0 is spoilt. */
static width width_above(dyd_dyadic *x) {
  if (dyd_dyadic_sgn(x) == 0) return (width){INT64_MIN, 0};
  int64_t shift = (int64_t)mpz_sizeinbase(x->man, 2) - 64;
  if (shift <= 0)
    mpz_mul_2exp(x->man, x->man, (mp_bitcnt_t)-shift);
  else
    mpz_cdiv_q_2exp(x->man, x->man, (mp_bitcnt_t)shift);
  if (mpz_sizeinbase(x->man, 2) > 64) { /* rounded up to 2^64 */
    mpz_tdiv_q_2exp(x->man, x->man, 1);
    shift++;
  }
  width w = {x->exp + shift, 0};
  mpz_export(&w.top, NULL, 1, sizeof w.top, 0, 0, x->man);
  return w;
}

static dyd_status width_get(dyd_dyadic *out, width w) {
  DYD_LOCAL_NUMBERS(mpz, top);
  mpz_import(top, 1, 1, sizeof w.top, 0, 0, &w.top);
  return dyd_dyadic_set_z_2exp(out, top, w.top ? w.exp : 0);
}

/* The longer side of r, rounded up. spare is overwritten. */
static dyd_status rect_width(width *out, dyd_dyadic *spare, const dyd_rect *r) {
  *out = (width){INT64_MIN, 0};
  const dyd_interval *side[2] = {&r->x, &r->y};
  for (int a = 0; a < 2; a++) {
    if (dyd_interval_is_point(side[a])) continue;
    dyd_status st = dyd_dyadic_sub(spare, &side[a]->hi, &side[a]->lo);
    if (st != DYD_OK) return st;
    const mp_bitcnt_t more = mpz_cmp_ui(side[a]->den, 1) ? 64 + mpz_sizeinbase(side[a]->den, 2) : 0;
    mpz_mul_2exp(spare->man, spare->man, more);
    mpz_cdiv_q(spare->man, spare->man, side[a]->den);
    spare->exp -= (int64_t)more;
    width w = width_above(spare);
    if (compare_width(&w, out) > 0) *out = w;
  }
  return DYD_OK;
}

/* Of the first n sites. */
static dyd_status measure_widths(dyd_stage_row *row, const dyd_sites *sites, size_t n) {
  DYD_FREED width *w = dyd_alloc(n, sizeof *w);
  if (!w) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_rect, rect);
  DYD_LOCAL(dyd_dyadic, spare);
  for (size_t i = 0; st == DYD_OK && i < n; i++) {
    w[i] = (width){INT64_MIN, 0};
    if (dyd_sites_is_point(sites, i)) continue;
    st = dyd_sites_get(&rect, sites, i);
    if (st == DYD_OK) st = rect_width(&w[i], &spare, &rect);
  }
  if (st == DYD_OK && n) {
    qsort(w, n, sizeof *w, compare_width);
    st = width_get(&row->width_largest, w[n - 1]);
    if (st == DYD_OK) st = width_get(&row->width_median, w[n / 2]);
  }
  return st;
}

/* ---- a row ---- */

/* Leaves the bounds out, without an error, if the result is capped or no time is left. */
static dyd_status measure_bounds(dyd_stage_row *row, const dyd_delaunay *pd, const dyd_pair_list *discs,
                                 const volatile int *cancel) {
  dyd_status st = dyd_flag_is_set(cancel) ? DYD_CANCELLED : dyd_metric_bound(&row->area, pd, discs, true);
  if (st == DYD_OK) st = dyd_flag_is_set(cancel) ? DYD_CANCELLED : dyd_metric_bound(&row->hausdorff, pd, discs, false);
  row->bounded = st == DYD_OK;
  return st == DYD_CAPPED || st == DYD_CANCELLED ? DYD_OK : st;
}

/* ---- the Voronoi diagram ---- */

/* The window, fixed with the first row; out->window stays NULL where the sites have none. */
static dyd_status convergence_set_window(dyd_convergence *out, const dyd_sites *sites, const dyd_rect *window) {
  if (out->window || out->count) return DYD_OK;
  out->window = malloc(sizeof *out->window);
  if (!out->window) return DYD_E_NOMEM;
  dyd_rect_init(out->window);
  dyd_status st = DYD_OK;
  if (window)
    dyd_rect_set(out->window, window);
  else
    st = dyd_voronoi_window(out->window, sites);
  if (st == DYD_OK) return DYD_OK;
  dyd_rect_clear(out->window);
  free(out->window);
  out->window = NULL;
  return st == DYD_E_NOMEM ? st : DYD_OK;
}

/* Polygons a good deal finer than the rectangles, so that undetermined parts come from these. */
static int64_t row_flattening(const dyd_stage_row *row) {
  enum { FINER = 4, EXACT = 64 };
  const dyd_dyadic *w = &row->width_largest;
  return dyd_dyadic_sgn(w) == 0 ? EXACT : FINER - (w->exp + (int64_t)mpz_sizeinbase(w->man, 2));
}

/* The bounds with polygons within 2^-fine; coarser ones where a step does not halve the area: the rectangles count for
 * more than the polygons then, and arcs could take 2^(fine / 2) points. A step that needs more than CORNERS for one
 * polygon is not taken: scales are far apart. */
static dyd_status find_voronoi(dyd_voronoi_bounds *b, const dyd_delaunay *pd, const dyd_rect *window, int64_t fine,
                               bool discs, const volatile int *cancel) {
  enum { PLAIN = 16, FIRST_STEP = 6, CORNERS = 1 << 14 };
  int64_t bits = dyd_metric_coarseness(pd, window) + PLAIN, step = FIRST_STEP;
  bool helps = true;
  DYD_LOCAL(dyd_dyadic, old);
  dyd_status st = dyd_voronoi_bounds_within(b, pd, window, bits < fine ? bits : fine, CORNERS, discs, cancel);
  DYD_LOCAL(dyd_voronoi_bounds, finer);
  for (; bits < fine && helps && st == DYD_OK; step *= 2) {
    bits = fine - bits < step ? fine : bits + step;
    st = dyd_voronoi_bounds_within(&finer, pd, window, bits, CORNERS, discs, cancel);
    helps = st == DYD_OK;
    if (st == DYD_E_RANGE) st = DYD_OK;
    if (!helps) continue;
    dyd_dyadic_swap(&old, &b->area);
    dyd_dyadic_swap(&b->area, &finer.area);
    dyd_dyadic_swap(&b->hausdorff, &finer.hausdorff);
    b->finite = finer.finite;
    st = dyd_dyadic_mul_2exp(&old, &old, -1);
    helps = st == DYD_OK && dyd_dyadic_cmp(&b->area, &old) < 0;
  }
  return st;
}

/* Bounds that cannot be had (a capped result, rectangles that all meet, numbers out of range, no time) are omitted. */
static dyd_status measure_voronoi(dyd_stage_row *row, const dyd_convergence *out, const dyd_delaunay *pd, bool discs,
                                  const volatile int *cancel) {
  DYD_LOCAL(dyd_voronoi_bounds, b);
  dyd_status st = find_voronoi(&b, pd, out->window, row_flattening(row), discs, cancel);
  row->voronoi = st == DYD_OK && b.finite;
  if (row->voronoi) {
    dyd_dyadic_swap(&row->v_area, &b.area);
    dyd_dyadic_swap(&row->v_hausdorff, &b.hausdorff);
  }
  return st == DYD_E_NOMEM ? st : DYD_OK;
}

/* Where all pairs are legal, edges have the ends of their rectangles, whose diameter is at most sqrt(2) w. */
static dyd_status row_rate(dyd_stage_row *row, const dyd_convergence *out, const dyd_delaunay *pd,
                           const volatile int *cancel) {
  if (out->count && out->row[out->count - 1]->rated) {
    const dyd_stage_row *last = out->row[out->count - 1];
    row->rated = true;
    row->rate = last->rate;
    row->rate_from = last->rate_from;
    return DYD_OK;
  }
  row->rate_from = INT64_MIN;
  row->rate = 1;
  if (out->of == DYD_CONVERGE_DELAUNAY) {
    row->rated = row->count[DYD_INDETERMINATE] + row->count[DYD_TIE] == 0 && !dyd_delaunay_is_capped(pd);
    return DYD_OK;
  }
  if (!out->window || dyd_delaunay_is_capped(pd)) return DYD_OK;
  dyd_status st = dyd_metric_voronoi_rate(&row->rate, &row->rated, pd, out->window, cancel);
  return st == DYD_E_NOMEM ? st : DYD_OK;
}

/* discs: their statuses; NULL: those of rectangles, or those of o->pairs. */
static dyd_status row_measure(dyd_stage_row *row, const dyd_delaunay *pd, const dyd_pair_list *discs,
                              const dyd_converge_options *o) {
  DYD_SCOPED(dyd_pair_list) others = {0};
  const dyd_pair_list *instead = o->pairs ? &others : discs;
  dyd_status st = o->pairs ? o->pairs(&others, o->pairs_user) : DYD_OK;
  dyd_pairs_count(row->count, instead, pd);
  row->undecided_faces = dyd_delaunay_undecided_faces(pd);
  if (instead) row->digest = dyd_digest_list(instead);
  if (st == DYD_OK && !instead) st = dyd_digest_pairs(&row->digest, pd);
  if (st == DYD_OK) st = dyd_delaunay_get_counters(&row->rungs, pd, NULL);
  if (st == DYD_OK) st = measure_widths(row, dyd_delaunay_sites(pd), dyd_sites_count(dyd_delaunay_sites(pd)));
  if (st == DYD_OK && !o->pairs) st = measure_bounds(row, pd, discs, o->cancel);
  return st;
}

/* Statuses of discs that were not reached in time are those of squares, which hold. */
static dyd_status row_discs(dyd_stage_row *row, const dyd_delaunay *pd, const dyd_converge_options *o, dyd_error *err) {
  DYD_SCOPED(dyd_pair_list) discs = {0};
  dyd_status st = dyd_disc_pairs(&discs, pd, o->cancel, err);
  if (st >= 0) st = row_measure(row, pd, &discs, o);
  return st;
}

dyd_status dyd_convergence_add(dyd_stage_row **row, dyd_convergence *out, const dyd_delaunay *pd,
                               const dyd_converge_options *converge, bool discs, dyd_error *err) {
  dyd_converge_options o;
  dyd_status st = dyd_abi_check(out, sizeof *out, "dyd_convergence", err);
  if (st == DYD_OK) st = dyd_abi_take(&o, sizeof o, converge, "dyd_converge_options", err);
  if (st != DYD_OK) return st;
  dyd_stage_row *r = row_new(out);
  if (!r) return dyd_fail_nomem(err);
  out->of = o.of;
  st = discs ? row_discs(r, pd, &o, err) : row_measure(r, pd, NULL, &o);
  if (st == DYD_OK && o.of == DYD_CONVERGE_VORONOI) st = convergence_set_window(out, dyd_delaunay_sites(pd), o.window);
  if (st == DYD_OK && out->window) st = measure_voronoi(r, out, pd, discs, o.cancel);
  if (st == DYD_OK && o.rates && !discs && !o.pairs) st = row_rate(r, out, pd, o.cancel);
  if (st != DYD_OK) {
    row_free(r);
    return err && err->code == st ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
  }
  out->row[out->count++] = *row = r;
  return DYD_OK;
}

/* ---- a run ---- */

/* out->options becomes a copy of o, pointers and callbacks aside. */
static dyd_status note_options(dyd_convergence *out, const dyd_engine_options *o, dyd_error *err) {
  if (!out->options) out->options = malloc(sizeof *out->options);
  if (!out->options) return dyd_fail_nomem(err);
  *out->options = *o;
  out->options->window = NULL;
  out->options->progress = NULL;
  out->options->trace = NULL;
  out->options->progress_user = out->options->trace_user = out->options->policy_user = NULL;
  out->options->policy = NULL;
  out->options->policy_program = NULL;
  return DYD_OK;
}

typedef struct recorder {
  dyd_convergence *out;
  dyd_engine *e;
  const dyd_engine_options *o;
  const dyd_converge_options *converge; /* of this library's size */
  dyd_status failed;                    /* of the table, not of the run */
  double begun;
  dyd_error why;
} recorder;

static dyd_status recorder_add_row(recorder *r, const dyd_progress *p) {
  dyd_stage_row *row;
  const dyd_delaunay *pd = dyd_engine_delaunay(r->e);
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_error_clear(&r->why);
  dyd_status st = dyd_convergence_add(&row, r->out, pd, r->converge, r->o->discs, &r->why);
  if (st == DYD_OK) st = dyd_engine_get_counters(&c, r->e, NULL);
  if (st != DYD_OK) return st;
  row->stage = p->stage;
  row->bits_least = c.bits_least;
  row->bits_most = c.bits_most;
  row->bits_total = c.bits_total;
  row->calls = c.calls;
  row->seconds = dyd_seconds() - r->begun;
  if (r->converge->stage) r->converge->stage(r->converge->stage_user, row, pd);
  return DYD_OK;
}

static void recorder_stage(void *user, const dyd_progress *p) {
  recorder *r = user;
  if (r->o->progress) r->o->progress(r->o->progress_user, p);
  if (r->failed != DYD_OK) return;
  r->failed = recorder_add_row(r, p);
  if (r->failed != DYD_OK) dyd_engine_cancel(r->e);
}

/* Did the run end with its stages, or with nothing left to decide, so that one with another goal can continue? */
static bool converge_goes_on(const dyd_engine *e) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_engine_get_counters(&c, e, NULL);
  return dyd_engine_delaunay(e) && dyd_engine_outcome(e) != DYD_OUTCOME_CANCELLED && c.spent != DYD_BUDGET_SECONDS;
}

/* A run to a Voronoi goal on the default window, which is known after the first stage. */
static dyd_status converge_run_on_default(recorder *r, const dyd_engine_options *options, dyd_error *err) {
  dyd_engine_options o = *options;
  double begun = dyd_seconds();
  DYD_LOCAL(dyd_rect, window);
  o.goal = DYD_GOAL_DECIDED;
  o.max_stages = 1;
  dyd_status st = dyd_engine_run(&r->out->outcome, r->e, &o, err);
  if (st == DYD_OK && converge_goes_on(r->e)) {
    st = dyd_voronoi_window(&window, dyd_delaunay_sites(dyd_engine_delaunay(r->e)));
    if (st != DYD_OK) dyd_fail(err, st, "the points span more than doubles hold; give a window");
    o = *options;
    o.window = &window;
    if (o.seconds > 0) o.seconds = fmax(o.seconds - (dyd_seconds() - begun), 0x1p-20);
    if (o.max_stages) o.max_stages--;
    if (st == DYD_OK && options->max_stages != 1) st = dyd_engine_run(&r->out->outcome, r->e, &o, err);
  }
  return st;
}

/* ---- a disc or bisector ---- */

/* A run as a question: each time it comes a stage is complete, and gets its row. */
typedef struct piece_run {
  recorder *r;
  size_t first, count; /* points that make the piece; points examined */
  dyd_rect *rect;      /* of all these */
  uint64_t steps;      /* narrowings before the last row */
} piece_run;

/* Bits asked of the points of the piece, as the engine counts them for all. */
static uint64_t piece_bits(dyd_stage_row *row, const piece_run *p) {
  uint64_t steps = 0;
  bool any = false;
  for (size_t k = 0; k < p->r->e->points && p->r->e->point[k].site < p->count; k++) {
    const dyd_refinable *point = &p->r->e->point[k];
    if (!point->asked) continue;
    steps += point->calls + 1 + (uint64_t)(point->bits > 0 ? point->bits : 0);
    if (!any || point->bits < row->bits_least) row->bits_least = point->bits;
    if (!any || point->bits > row->bits_most) row->bits_most = point->bits;
    if (point->bits > 0) row->bits_total += (uint64_t)point->bits;
    row->calls += point->calls;
    any = true;
  }
  return steps;
}

/* The bisector is the diagram of two sites. */
static dyd_status piece_bisector(dyd_stage_row *row, const piece_run *p) {
  dyd_convergence *out = p->r->out;
  DYD_OWNED(dyd_sites) *two = NULL;
  DYD_OWNED(dyd_delaunay) *pd = NULL;
  row->orientation = dyd_rect_meets(&p->rect[0], &p->rect[1]) ? DYD_UNSURE : DYD_SURE_PLUS;
  dyd_status st = dyd_sites_new(&two);
  for (size_t k = 0; k < 2 && st == DYD_OK; k++) st = dyd_sites_add_rect(two, &p->rect[k]);
  if (st == DYD_OK) st = convergence_set_window(out, two, p->r->o->window ? p->r->o->window : p->r->converge->window);
  if (st == DYD_OK && out->window) st = dyd_delaunay_new(&pd, two, NULL, NULL);
  if (st == DYD_OK && pd) st = measure_voronoi(row, out, pd, false, p->r->converge->cancel);
  if (st == DYD_OK && pd && p->r->converge->rates) st = row_rate(row, out, pd, p->r->converge->cancel);
  row->bounded = row->voronoi;
  row->voronoi = false;
  dyd_dyadic_swap(&row->area, &row->v_area);
  dyd_dyadic_swap(&row->hausdorff, &row->v_hausdorff);
  return st;
}

static dyd_status piece_disc(dyd_stage_row *row, const piece_run *p) {
  const dyd_rect *r = p->rect;
  row->orientation = dyd_orientation(&r[0], &r[1], &r[2]);
  row->con = calloc(p->count, sizeof *row->con);
  if (!row->con) return DYD_E_NOMEM;
  for (row->cons = 0; row->cons < p->count - p->first; row->cons++)
    row->con[row->cons] = dyd_con(&r[p->first + row->cons], &r[0], &r[1], &r[2]);
  DYD_LOCAL(dyd_voronoi_bounds, b);
  dyd_status st = dyd_metric_disc(&b, &r[0], &r[1], &r[2]);
  row->bounded = st == DYD_OK && b.finite;
  dyd_dyadic_swap(&row->area, &b.area);
  dyd_dyadic_swap(&row->hausdorff, &b.hausdorff);
  if (st == DYD_OK && p->r->converge->rates)
    st = dyd_metric_disc_rate(&row->rate, &row->rate_from, &row->rated, &r[0], &r[1], &r[2]);
  return st;
}

/* The row of the stage; the last one where nothing was narrowed since. */
static dyd_status piece_row(dyd_stage_row **row, piece_run *p) {
  dyd_convergence *out = p->r->out;
  dyd_stage_row *r = row_new(out);
  if (!r) return DYD_E_NOMEM;
  uint64_t steps = piece_bits(r, p);
  if (out->count && steps == p->steps) {
    row_free(r);
    *row = out->row[out->count - 1];
    return DYD_OK;
  }
  p->steps = steps;
  dyd_status st = measure_widths(r, dyd_engine_sites(p->r->e), p->first);
  if (st == DYD_OK) st = p->first == 3 ? piece_disc(r, p) : piece_bisector(r, p);
  r->seconds = dyd_seconds() - p->r->begun;
  if (st != DYD_OK) {
    row_free(r);
    return st;
  }
  out->row[out->count++] = *row = r;
  if (p->r->converge->stage) p->r->converge->stage(p->r->converge->stage_user, r, NULL);
  return DYD_OK;
}

static bool piece_goal_holds(const piece_run *p, const dyd_stage_row *row, dyd_dyadic *goal) {
  const dyd_engine_options *o = p->r->o;
  size_t k = 0;
  if (o->goal == DYD_GOAL_DECIDED) {
    while (k < row->cons && row->con[k] != DYD_UNSURE) k++;
    return row->orientation != DYD_UNSURE && k == row->cons;
  }
  const bool area = o->goal == DYD_GOAL_AREA || o->goal == DYD_GOAL_VORONOI_AREA;
  return row->bounded && dyd_dyadic_set_si_2exp(goal, 1, -o->goal_bits) == DYD_OK &&
         dyd_dyadic_cmp(area ? &row->area : &row->hausdorff, goal) <= 0;
}

/* Is the point to be narrower? Before the triple is oriented others help nothing. */
static bool piece_wants(const piece_run *p, const dyd_stage_row *row, size_t i) {
  if (i < p->first || p->r->o->schedule == DYD_SCHEDULE_UNIFORM) return true;
  return p->r->o->goal == DYD_GOAL_DECIDED && row->orientation != DYD_UNSURE && row->con[i - p->first] == DYD_UNSURE;
}

static dyd_status piece_ask(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  piece_run *p = user;
  dyd_status st = DYD_OK;
  bool known = true;
  dyd_stage_row *row = NULL;
  (void)err;
  for (size_t i = 0; st == DYD_OK && i < p->count; i++) {
    if (!dyd_engine_knows(e, (uint32_t)i)) known = false, st = dyd_wants_add(wants, (uint32_t)i, DYD_BITS_NEXT);
    if (st == DYD_OK) st = dyd_sites_get(&p->rect[i], dyd_engine_sites(e), i);
  }
  if (st != DYD_OK || !known) return st;
  DYD_LOCAL(dyd_dyadic, goal);
  st = piece_row(&row, p);
  *answered = st == DYD_OK && piece_goal_holds(p, row, &goal);
  for (size_t i = 0; st == DYD_OK && !*answered && i < p->count; i++)
    if (piece_wants(p, row, i)) st = dyd_wants_add(wants, (uint32_t)i, DYD_BITS_NEXT);
  return st;
}

static dyd_status converge_piece(recorder *r, const dyd_engine_options *options, dyd_error *err) {
  const bool disc = r->converge->of == DYD_CONVERGE_DISC;
  piece_run p = {.r = r, .first = disc ? 3 : 2, .count = disc ? dyd_engine_count(r->e) : 2};
  r->out->of = r->converge->of;
  if (dyd_engine_count(r->e) < p.first)
    return dyd_fail(err, DYD_E_ARG, "%zu points are needed, here are %zu", p.first, dyd_engine_count(r->e));
  p.rect = dyd_alloc(p.count, sizeof *p.rect);
  if (!p.rect) return dyd_fail_nomem(err);
  for (size_t i = 0; i < p.count; i++) dyd_rect_init(&p.rect[i]);
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = piece_ask, .user = &p};
  dyd_status st = dyd_engine_ask(&r->out->outcome, r->e, &question, options, err);
  if (r->out->outcome == DYD_OUTCOME_DECIDED && options->goal != DYD_GOAL_DECIDED)
    r->out->outcome = DYD_OUTCOME_CERTIFIED;
  for (size_t i = p.count; i-- > 0;) dyd_rect_clear(&p.rect[i]);
  free(p.rect);
  return st;
}

const char *dyd_converge_of_text(dyd_converge_of of) {
  static const char *const text[] = {"delaunay", "voronoi", "disc", "bisector"};
  return of >= 0 && (size_t)of < sizeof text / sizeof *text ? text[of] : "unknown";
}

dyd_status dyd_converge_run(dyd_convergence *out, dyd_engine *e, const dyd_engine_options *options,
                            const dyd_converge_options *converge, dyd_error *err) {
  dyd_engine_options defaults, given, o;
  dyd_converge_options c;
  recorder r = {.out = out, .e = e, .o = &given, .converge = &c, .begun = dyd_seconds()};
  dyd_engine_options_init(&defaults);
  dyd_status st = dyd_abi_check(out, sizeof *out, "dyd_convergence", err);
  if (st == DYD_OK) st = dyd_abi_take(&c, sizeof c, converge, "dyd_converge_options", err);
  if (st == DYD_OK) st = dyd_abi_take(&given, sizeof given, options ? options : &defaults, "dyd_engine_options", err);
  if (st == DYD_OK) st = note_options(out, &given, err);
  if (st != DYD_OK) return st;
  if (!c.cancel) c.cancel = &e->stop;
  out->sought = c.hindsight != 0;
  o = given;
  o.progress = recorder_stage;
  o.progress_user = &r;
  if (!o.window) o.window = c.window;
  if (c.of >= DYD_CONVERGE_DISC) return converge_piece(&r, &given, err);
  st = dyd_goal_is_voronoi(o.goal) && !o.window ? converge_run_on_default(&r, &o, err)
                                                : dyd_engine_run(&out->outcome, e, &o, err);
  if (st == DYD_OK && r.failed == DYD_OK && c.hindsight && !given.discs && !c.pairs)
    st = dyd_hindsight_find(&out->best_bits, e, &given, out->outcome, out->row, out->count, c.hindsight, err);
  if (st != DYD_OK || r.failed == DYD_OK) return st;
  if (err && r.why.code == r.failed) *err = r.why;
  return r.why.code == r.failed ? r.failed : dyd_fail(err, r.failed, "%s", dyd_status_text(r.failed));
}
