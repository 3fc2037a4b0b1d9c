/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Wants: which points to narrow, and how far.
 *
 * Every want asks for more than its point was asked for before, and for max_bits at most: a loop that carries out wants
 * until one is empty ends. Growth is geometric, so a run asks for at most about twice the bits it needs; with step_bits
 * it is that step instead, for tables of convergence. */
#include "engine/wants.h"

#include "base/alloc.h"
#include "base/index.h"
#include "base/local.h"
#include "dyadic/raw.h"
#include "engine/points.h"
#include "engine/record.h"
#include "stream/stream.h"

void dyd_wants_init(dyd_wants *p, const dyd_engine *e, const dyd_engine_options *o, const dyd_refinable *guest,
                    size_t guests) {
  *p = (dyd_wants){.e = e, .o = o, .guest = guest, .guests = guests};
  p->slot = calloc(e->points + guests + 1, sizeof *p->slot);
  if (!p->slot) p->failed = DYD_E_NOMEM;
}

void dyd_wants_clear(dyd_wants *p) {
  dyd_free_all(p->item, p->slot);
}

void dyd_wants_empty(dyd_wants *p) {
  for (size_t k = 0; k < p->count; k++) p->slot[p->item[k].point] = 0;
  free(p->item);
  p->item = NULL;
  p->count = p->cap = 0;
  p->blocked = p->again = false;
}

static int wants_compare(const void *a, const void *b) {
  const dyd_want *v = a, *w = b;
  return (v->point > w->point) - (v->point < w->point);
}

void dyd_wants_sort(dyd_wants *p) {
  size_t k = 1;
  while (k < p->count && p->item[k - 1].point < p->item[k].point) k++;
  if (k < p->count) qsort(p->item, p->count, sizeof *p->item, wants_compare);
}

/* ---- growth ---- */

/* The precision of the first stage. Where none is given it is 64, or what doubles give, if that is worth a stage: most
 * points need no more. Points that need more continue as if they had been asked for 64. */
#define FIRST_BITS 64

#define FIRST_IN_DOUBLES 24

int64_t dyd_bits_raised(int64_t b, int64_t by, int64_t max) {
  return b > max - by ? max : b + by;
}

int64_t dyd_bits_grown(int64_t b, const dyd_engine_options *o) {
  if (o->step_bits) return dyd_bits_raised(b, o->step_bits, o->max_bits);
  if (!o->start_bits && b < FIRST_BITS) b = FIRST_BITS;
  int64_t size = b < 0 ? -b : b;
  return b + (size < 16 ? 16 : size);
}

int64_t dyd_bits_first(const dyd_engine_options *o) {
  int64_t bits = o->start_bits ? o->start_bits : FIRST_BITS;
  return bits < o->max_bits ? bits : o->max_bits;
}

static int64_t want_first_bits(const dyd_refinable *point, const dyd_engine_options *o) {
  if (o->start_bits || !point->stream || o->schedule != DYD_SCHEDULE_ADAPTIVE) return dyd_bits_first(o);
  int64_t bits = dyd_stream_glance_bits(point->stream);
  return bits >= FIRST_IN_DOUBLES && bits < FIRST_BITS ? bits : FIRST_BITS;
}

/* ---- wants ---- */

static size_t wants_number(const dyd_wants *p, const dyd_refinable *point) {
  size_t sites = dyd_sites_count(p->e->sites);
  return point->site < sites ? p->guests + (size_t)(point - p->e->point) : point->site - sites;
}

const dyd_refinable *dyd_wants_point(const dyd_wants *p, const dyd_want *w) {
  return w->point < p->guests ? &p->guest[w->point] : &p->e->point[w->point - p->guests];
}

bool dyd_wants_can_narrow(dyd_wants *p, const dyd_refinable *point) {
  if (!point || point->final) return false;
  if (!point->asked || point->bits < p->o->max_bits) return true;
  p->blocked = true;
  return false;
}

dyd_want *dyd_wants_find(const dyd_wants *p, const dyd_refinable *point) {
  uint32_t at = p->slot ? p->slot[wants_number(p, point)] : 0;
  return at ? &p->item[at - 1] : NULL;
}

void dyd_wants_mark(dyd_wants *p, const dyd_refinable *point, int64_t bits, dyd_reason reason, uint32_t i, uint32_t j) {
  if (bits > p->o->max_bits) bits = p->o->max_bits;
  dyd_want *w = dyd_wants_find(p, point);
  if (p->failed || (w && w->bits >= bits)) return;
  if (!w && !DYD_GROW(p->item, p->cap, p->count + 1)) {
    p->failed = DYD_E_NOMEM;
    return;
  }
  size_t number = wants_number(p, point);
  if (!w) {
    w = &p->item[p->count++];
    p->slot[number] = (uint32_t)p->count;
  }
  *w = (dyd_want){.point = (uint32_t)number, .bits = bits, .reason = reason, .i = i, .j = j};
}

void dyd_wants_mark_alone(dyd_wants *p, const dyd_refinable *point, int64_t bits, dyd_reason reason) {
  dyd_wants_mark(p, point, bits, reason, point->site, point->site);
}

void dyd_wants_first(dyd_wants *p) {
  for (size_t k = 0; k < p->e->points; k++) {
    const dyd_refinable *point = &p->e->point[k];
    if (!point->asked) dyd_wants_mark_alone(p, point, want_first_bits(point, p->o), DYD_REASON_FIRST);
  }
}

dyd_status dyd_wants_add(dyd_wants *p, uint32_t site, int64_t bits) {
  if (!p) return DYD_E_ARG;
  size_t sites = dyd_sites_count(p->e->sites);
  if (p->failed) return p->failed;
  if (site >= sites + p->guests) {
    p->missing = site;
    return p->failed = DYD_E_ARG;
  }
  const dyd_refinable *point = site < sites ? dyd_engine_find(p->e, site) : &p->guest[site - sites];
  if (!dyd_wants_can_narrow(p, point)) return DYD_OK;
  if (point->asked && bits <= point->bits) bits = dyd_bits_grown(point->bits, p->o);
  if (bits == DYD_BITS_NEXT) bits = want_first_bits(point, p->o);
  dyd_wants_mark_alone(p, point, bits, DYD_REASON_QUESTION);
  return p->failed;
}

size_t dyd_wants_count(const dyd_wants *p) {
  if (!p) return 0;
  return p->count;
}

/* Announces requests to sources, so that slow answers can be computed in parallel. */

/* Returns true if p will be asked for `bits`: it is not that narrow, and the answer is not known. */
static bool announce_is_due(dyd_rect *scratch, const dyd_refinable *p, const dyd_engine *e, int64_t bits) {
  if (dyd_recall_next(e->recall, p->site, bits)) return false;
  if (!p->asked) return true;
  return dyd_sites_get(scratch, e->sites, p->site) != DYD_OK || dyd_rect_bits(scratch) < bits;
}

/* Announces the wants first .. end-1 to their one source; *left is the number of calls still allowed. Wants that do not
 * fit into memory, or are refused, are not announced. */
static void announce_source(uint64_t *left, const dyd_wants *wants, size_t first, size_t end) {
  const dyd_engine *e = wants->e;
  const dyd_source *source = &e->source[dyd_wants_point(wants, &wants->item[first])->source].source;
  DYD_FREED dyd_request *list = dyd_alloc(end - first, sizeof *list);
  size_t count = 0;
  DYD_LOCAL(dyd_rect, scratch);
  for (size_t k = first; list && *left && k < end; k++) {
    const dyd_want *w = &wants->item[k];
    const dyd_refinable *p = dyd_wants_point(wants, w);
    if (!announce_is_due(&scratch, p, e, w->bits)) continue;
    --*left;
    if (dyd_engine_request(&list[count], p, e, w->bits, wants->o->max_bits, NULL) == DYD_OK) count++;
  }
  if (count) source->announce(source->user, list, count);
}

void dyd_wants_announce(const dyd_wants *wants, uint64_t most) {
  for (size_t k = 0, end; k < wants->count; k = end) {
    const dyd_refinable *p = dyd_wants_point(wants, &wants->item[k]);
    for (end = k + 1; end < wants->count && !p->stream; end++) {
      const dyd_refinable *next = dyd_wants_point(wants, &wants->item[end]);
      if (next->stream || next->source != p->source) break;
    }
    if (!p->stream && wants->e->source[p->source].source.announce) announce_source(&most, wants, k, end);
  }
}

/* How coarse the sites of a face are, compared with the distances to their neighbours.
 *
 * Whether a disc through some sites holds another depends on all of them about equally, each relative to its distance
 * from the nearest one. So a pair of points 2^-200 apart has to be known to 200 bits more than the points around it:
 * as long as two rectangles meet, no disc can hold one and avoid the other, and refining the rest is useless.
 *
 * All this only chooses what to refine; the statements do not depend on it. */

/* Number of the sites that follow in the order of x and are examined. */
#define NEXT 4

/* ---- exponents ---- */

/* The exponent of hi - lo for ends of intervals; INT64_MIN unless it is positive. */
static dyd_status exponent_above(int64_t *out, const dyd_interval *low, bool low_end_up, const dyd_interval *high,
                                 bool high_end_up) {
  dyd_status st = DYD_OK;
  *out = INT64_MIN;
  if (mpz_cmp_ui(low->den, 1) == 0 && mpz_cmp_ui(high->den, 1) == 0) {
    DYD_LOCAL(dyd_dyadic, d);
    st = dyd_dyadic_sub(&d, high_end_up ? &high->hi : &high->lo, low_end_up ? &low->hi : &low->lo);
    if (st == DYD_OK && dyd_dyadic_sgn(&d) > 0) *out = d.exp + (int64_t)mpz_sizeinbase(d.man, 2);
    return st;
  }
  DYD_LOCAL_ARRAY(mpq_t, a, [2]);
  DYD_LOCAL_ARRAY(mpq_t, b, [2]);
  dyd_interval_get_q(a[0], a[1], low);
  dyd_interval_get_q(b[0], b[1], high);
  mpq_sub(a[0], b[high_end_up], a[low_end_up]);
  if (mpq_sgn(a[0]) > 0)
    *out = (int64_t)mpz_sizeinbase(mpq_numref(a[0]), 2) - (int64_t)mpz_sizeinbase(mpq_denref(a[0]), 2) + 1;
  return st;
}

/* Raises *out to the exponent of one of the two differences of ends, where it is larger. */
static dyd_status exponent_raise(int64_t *out, const dyd_interval *low, bool low_end_up, const dyd_interval *high,
                                 bool high_end_up) {
  int64_t e;
  dyd_status st = exponent_above(&e, low, low_end_up, high, high_end_up);
  if (st == DYD_OK && e > *out) *out = e;
  return st;
}

static dyd_status precision_find_width(dyd_site_precision *s) {
  s->width = INT64_MIN;
  dyd_status st = exponent_raise(&s->width, &s->rect.x, false, &s->rect.x, true);
  return st != DYD_OK ? st : exponent_raise(&s->width, &s->rect.y, false, &s->rect.y, true);
}

/* Lets two sites know of one another. */
static dyd_status precision_meet(dyd_site_precision *a, dyd_site_precision *b) {
  int64_t e = a->width > b->width ? a->width : b->width;
  const dyd_interval *side[2][2] = {{&a->rect.x, &b->rect.x}, {&a->rect.y, &b->rect.y}};
  dyd_status st = DYD_OK;
  for (int k = 0; st == DYD_OK && k < 2; k++) {
    st = exponent_raise(&e, side[k][0], true, side[k][1], false);
    if (st == DYD_OK) st = exponent_raise(&e, side[k][1], true, side[k][0], false);
  }
  if (st != DYD_OK || e == INT64_MIN) return st;
  if (e < a->scale) a->scale = e;
  if (e < b->scale) b->scale = e;
  return DYD_OK;
}

/* ---- faces ---- */

static dyd_site_precision *precision_find(const dyd_face_precision *c, uint32_t site) {
  const uint32_t *at = dyd_find_index(&site, c->sites.item, c->sites.count, sizeof site);
  return at ? &c->item[at - c->sites.item] : NULL;
}

static dyd_status precision_fetch(dyd_face_precision *c, const dyd_delaunay *pd, size_t f) {
  bool outer;
  dyd_status st = dyd_delaunay_face(&c->sites, &outer, pd, f);
  if (st != DYD_OK) return st;
  c->item = dyd_alloc(c->sites.count, sizeof *c->item);
  if (!c->item) return DYD_E_NOMEM;
  for (size_t k = 0; k < c->sites.count; k++) {
    dyd_rect_init(&c->item[k].rect);
    c->item[k].scale = INT64_MAX;
  }
  for (size_t k = 0; st == DYD_OK && k < c->sites.count; k++) {
    st = dyd_sites_get(&c->item[k].rect, dyd_delaunay_sites(pd), c->sites.item[k]);
    if (st == DYD_OK) st = precision_find_width(&c->item[k]);
  }
  return st;
}

/* By left ends, then by lower ends; equal ones by their place, so that the order is always the same. */
static int precision_compare_place(const void *a, const void *b) {
  const dyd_site_precision *s = *(dyd_site_precision *const *)a, *t = *(dyd_site_precision *const *)b;
  int c = dyd_raw_cmp(&s->rect.x.lo, t->rect.x.den, &t->rect.x.lo, s->rect.x.den);
  if (c == 0) c = dyd_raw_cmp(&s->rect.y.lo, t->rect.y.den, &t->rect.y.lo, s->rect.y.den);
  return c ? c : (s > t) - (s < t);
}

static dyd_status precision_meet_next(dyd_face_precision *c) {
  dyd_status st = DYD_OK;
  DYD_FREED dyd_site_precision **order = dyd_alloc(c->sites.count, sizeof *order);
  if (!order) return DYD_E_NOMEM;
  for (size_t k = 0; k < c->sites.count; k++) order[k] = &c->item[k];
  qsort(order, c->sites.count, sizeof *order, precision_compare_place);
  for (size_t k = 0; k < c->sites.count; k++)
    for (size_t l = k + 1; st == DYD_OK && l < c->sites.count && l <= k + NEXT; l++)
      st = precision_meet(order[k], order[l]);
  return st;
}

dyd_status dyd_face_precision_set(dyd_face_precision *out, const dyd_delaunay *pd, size_t f,
                                  const dyd_pair_list *pairs) {
  dyd_status st = precision_fetch(out, pd, f);
  for (size_t k = 0; st == DYD_OK && k < pairs->count; k++) {
    dyd_site_precision *a = precision_find(out, pairs->item[k].i), *b = precision_find(out, pairs->item[k].j);
    if (a && b) st = precision_meet(a, b);
  }
  return st != DYD_OK ? st : precision_meet_next(out);
}

void dyd_face_precision_clear(dyd_face_precision *c) {
  for (size_t k = 0; c->item && k < c->sites.count; k++) dyd_rect_clear(&c->item[k].rect);
  free(c->item);
  dyd_index_list_clear(&c->sites);
  *c = (dyd_face_precision){0};
}

int64_t dyd_face_precision_bits(const dyd_face_precision *c, uint32_t site) {
  const dyd_site_precision *s = precision_find(c, site);
  if (!s || s->width == INT64_MIN || s->scale == INT64_MAX) return INT64_MAX;
  return s->scale - s->width;
}
