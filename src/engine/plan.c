/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A plan: which points to narrow, and how far.
 *
 * Every want asks for more than its point was asked for before, and for max_bits at most: a loop that carries out plans
 * until one is empty ends. Growth is geometric, so a run asks for at most about twice the bits it needs; with step_bits
 * it is that step instead, for tables of convergence. */
#include "engine/plan.h"

#include "base/alloc.h"
#include "base/local.h"
#include "engine/points.h"
#include "engine/record.h"
#include "stream/stream.h"

void dyd_plan_init(dyd_plan *p, const dyd_engine *e, const dyd_engine_options *o, const dyd_refinable *guest,
                   size_t guests) {
  *p = (dyd_plan){.e = e, .o = o, .guest = guest, .guests = guests};
  p->slot = calloc(e->points + guests + 1, sizeof *p->slot);
  if (!p->slot) p->failed = DYD_E_NOMEM;
}

void dyd_plan_clear(dyd_plan *p) {
  dyd_free_all(p->item, p->slot);
}

void dyd_plan_empty(dyd_plan *p) {
  for (size_t k = 0; k < p->count; k++) p->slot[p->item[k].point] = 0;
  free(p->item);
  p->item = NULL;
  p->count = p->cap = 0;
  p->blocked = p->again = false;
}

static int plan_compare(const void *a, const void *b) {
  const dyd_want *v = a, *w = b;
  return (v->point > w->point) - (v->point < w->point);
}

void dyd_plan_sort(dyd_plan *p) {
  size_t k = 1;
  while (k < p->count && p->item[k - 1].point < p->item[k].point) k++;
  if (k < p->count) qsort(p->item, p->count, sizeof *p->item, plan_compare);
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

static int64_t plan_first_bits(const dyd_refinable *point, const dyd_engine_options *o) {
  if (o->start_bits || !point->stream || o->schedule != DYD_SCHEDULE_ADAPTIVE) return dyd_bits_first(o);
  int64_t bits = dyd_stream_glance_bits(point->stream);
  return bits >= FIRST_IN_DOUBLES && bits < FIRST_BITS ? bits : FIRST_BITS;
}

/* ---- wants ---- */

static size_t plan_number(const dyd_plan *p, const dyd_refinable *point) {
  size_t sites = dyd_sites_count(p->e->sites);
  return point->site < sites ? p->guests + (size_t)(point - p->e->point) : point->site - sites;
}

const dyd_refinable *dyd_plan_point(const dyd_plan *p, const dyd_want *w) {
  return w->point < p->guests ? &p->guest[w->point] : &p->e->point[w->point - p->guests];
}

bool dyd_plan_can_narrow(dyd_plan *p, const dyd_refinable *point) {
  if (!point || point->final) return false;
  if (!point->asked || point->bits < p->o->max_bits) return true;
  p->blocked = true;
  return false;
}

dyd_want *dyd_plan_find(const dyd_plan *p, const dyd_refinable *point) {
  uint32_t at = p->slot ? p->slot[plan_number(p, point)] : 0;
  return at ? &p->item[at - 1] : NULL;
}

void dyd_plan_mark(dyd_plan *p, const dyd_refinable *point, int64_t bits, dyd_reason reason, uint32_t i, uint32_t j) {
  if (bits > p->o->max_bits) bits = p->o->max_bits;
  dyd_want *w = dyd_plan_find(p, point);
  if (p->failed || (w && w->bits >= bits)) return;
  if (!w && !DYD_GROW(p->item, p->cap, p->count + 1)) {
    p->failed = DYD_E_NOMEM;
    return;
  }
  size_t number = plan_number(p, point);
  if (!w) {
    w = &p->item[p->count++];
    p->slot[number] = (uint32_t)p->count;
  }
  *w = (dyd_want){.point = (uint32_t)number, .bits = bits, .reason = reason, .i = i, .j = j};
}

void dyd_plan_mark_alone(dyd_plan *p, const dyd_refinable *point, int64_t bits, dyd_reason reason) {
  dyd_plan_mark(p, point, bits, reason, point->site, point->site);
}

void dyd_plan_first(dyd_plan *p) {
  for (size_t k = 0; k < p->e->points; k++) {
    const dyd_refinable *point = &p->e->point[k];
    if (!point->asked) dyd_plan_mark_alone(p, point, plan_first_bits(point, p->o), DYD_REASON_FIRST);
  }
}

dyd_status dyd_plan_add(dyd_plan *p, uint32_t site, int64_t bits) {
  if (!p) return DYD_E_ARG;
  size_t sites = dyd_sites_count(p->e->sites);
  if (p->failed) return p->failed;
  if (site >= sites + p->guests) {
    p->missing = site;
    return p->failed = DYD_E_ARG;
  }
  const dyd_refinable *point = site < sites ? dyd_engine_find(p->e, site) : &p->guest[site - sites];
  if (!dyd_plan_can_narrow(p, point)) return DYD_OK;
  if (point->asked && bits <= point->bits) bits = dyd_bits_grown(point->bits, p->o);
  if (bits == DYD_BITS_NEXT) bits = plan_first_bits(point, p->o);
  dyd_plan_mark_alone(p, point, bits, DYD_REASON_QUESTION);
  return p->failed;
}

size_t dyd_plan_count(const dyd_plan *p) {
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
static void announce_source(uint64_t *left, const dyd_plan *plan, size_t first, size_t end) {
  const dyd_engine *e = plan->e;
  const dyd_source *source = &e->source[dyd_plan_point(plan, &plan->item[first])->source].source;
  DYD_FREED dyd_request *list = dyd_alloc(end - first, sizeof *list);
  size_t count = 0;
  DYD_LOCAL(dyd_rect, scratch);
  for (size_t k = first; list && *left && k < end; k++) {
    const dyd_want *w = &plan->item[k];
    const dyd_refinable *p = dyd_plan_point(plan, w);
    if (!announce_is_due(&scratch, p, e, w->bits)) continue;
    --*left;
    if (dyd_engine_request(&list[count], p, e, w->bits, plan->o->max_bits, NULL) == DYD_OK) count++;
  }
  if (count) source->announce(source->user, list, count);
}

void dyd_plan_announce(const dyd_plan *plan, uint64_t most) {
  for (size_t k = 0, end; k < plan->count; k = end) {
    const dyd_refinable *p = dyd_plan_point(plan, &plan->item[k]);
    for (end = k + 1; end < plan->count && !p->stream; end++) {
      const dyd_refinable *next = dyd_plan_point(plan, &plan->item[end]);
      if (next->stream || next->source != p->source) break;
    }
    if (!p->stream && plan->e->source[p->source].source.announce) announce_source(&most, plan, k, end);
  }
}
