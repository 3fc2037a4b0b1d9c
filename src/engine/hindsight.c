/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The best plan in hindsight: the least sum of bits by which a goal holds.
 *
 * With b bits a point is known as its rectangle, rounded outward to multiples of 2^-(b + 2): these rectangles are
 * nested, so that the vectors of bits for which the goal holds are closed upward. The search goes through the points in
 * turn. With the first k given, the least bits that each other point needs while all the rest are at the top bound the
 * sum from below; where these together suffice they are the best completion. */
#include "engine/hindsight.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "delaunay/state.h"
#include "engine/goal_voronoi.h"
#include "engine/points.h"
#include "rect/rect.h"

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
  mpq_t lo, hi;
  if (dyd_interval_is_point(r)) {
    dyd_interval_set(out, r);
    return DYD_OK;
  }
  mpq_inits(lo, hi, NULL);
  dyd_interval_get_q(lo, hi, r);
  dyd_status st = dyd_interval_set_outward(out, lo, hi, -bits - 2);
  mpq_clears(lo, hi, NULL);
  return st;
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
  dyd_delaunay *pd = NULL;
  *out = false;
  if (!h->left || dyd_flag_get(&h->e->cancelled)) {
    h->known = false;
    return DYD_OK;
  }
  h->left--;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .no_filter = h->o->no_filter};
  dyd_status st = dyd_delaunay_made(&pd, dyd_sites_count(h->e->sites), hindsight_rect, h, &o, NULL);
  if (st == DYD_OK) {
    dyd_measure m;
    dyd_measure_init(&m, dyd_delaunay_sites(pd));
    st = dyd_goal_of_pairs_holds(out, &m, pd, h->o);
    dyd_measure_clear(&m);
  }
  dyd_delaunay_free(pd);
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
    dyd_stream *s = NULL;
    if (p->final) continue;
    h->site[h->points] = p->site;
    h->bits[h->points++] = h->top;
    st = dyd_engine_stream(&s, e, p->site);
    if (st == DYD_OK) st = dyd_stream_narrow(s, h->top + FINER, h->top + FINER, err);
    if (st >= 0) dyd_rect_set(&h->rect[p->site], dyd_stream_rect(s));
    if (st > 0) st = DYD_OK;
    dyd_stream_free(s);
  }
  return st;
}

dyd_status dyd_hindsight_find(uint64_t *bits, dyd_engine *e, const dyd_engine_options *o, dyd_outcome outcome,
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
