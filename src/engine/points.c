/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The points of an engine: asking one to narrow, measuring one again, and records of both.
 *
 * A fixed site is an entry of the table of sites and nothing else. A site that can be narrowed has a record besides,
 * and holds the whole plane in the table until it is first asked. [NEST-1] is kept by dyd_sites_narrow, for sources and
 * streams alike: the table alone remembers former answers. A rectangle measured again is narrower than that: the
 * answers of such a point are intersected with it. */
#include "engine/points.h"

#include "base/alloc.h"
#include "base/digest.h"
#include "base/error.h"
#include "base/index.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "delaunay/state.h"
#include "engine/record.h"
#include "rect/rect.h"
#include "rect/sites_table.h"
#include "stream/real.h"
#include "stream/stream.h"

#include <string.h>

void dyd_shared_source_free(dyd_shared_source *s) {
  if (!s || --s->refs) return;
  if (s->source.release) s->source.release(s->source.user);
  free(s);
}

void dyd_engine_clear_points(dyd_engine *e) {
  for (size_t k = 0; k < e->points; k++) dyd_stream_free(e->point[k].stream);
  for (size_t k = 0; k < e->sources; k++) {
    const dyd_source *s = &e->source[k].source;
    if (e->source[k].shared)
      dyd_shared_source_free(e->source[k].shared);
    else if (s->release)
      s->release(s->user);
  }
  dyd_free_all(e->point, e->source);
}

const dyd_refinable *dyd_engine_find(const dyd_engine *e, uint32_t site) {
  return dyd_find_index(&site, e->point, e->points, sizeof *e->point);
}

/* ---- asking ---- */

dyd_status dyd_engine_request(dyd_request *out, const dyd_refinable *p, const dyd_engine *e, int64_t bits,
                              int64_t max_bits, dyd_error *err) {
  dyd_status st = dyd_request_make(out, p->site - e->source[p->source].first, bits, max_bits, err);
  out->stop = &e->stop;
  return st;
}

/* Asks the source of p. *r comes in as the rectangle so far and goes out as the answer, checked to be one; *final:
 * no call can narrow it further. */
static dyd_status point_ask_source(dyd_rect *r, bool *final, const dyd_refinable *p, const dyd_engine *e, int64_t bits,
                                   int64_t max_bits, dyd_error *err) {
  const dyd_source_use *use = &e->source[p->source];
  dyd_request request;
  dyd_error own;
  dyd_error_clear(&own);
  dyd_status st = dyd_engine_request(&request, p, e, bits, max_bits, err);
  if (st != DYD_OK) return st;
  st = use->source.narrow(r, use->source.user, &request, &own);
  *final = st == DYD_FIXED;
  if (st == DYD_CANCELLED && dyd_flag_get(&e->stop)) return st;
  if (st != DYD_OK && st != DYD_FIXED) return dyd_callback_fail(err, &own, st, p->site, p->calls);
  st = dyd_rect_check_set(r, p->site, p->calls, err);
  if (st != DYD_OK) return st;
  if (!dyd_interval_is_valid(&r->x) || !dyd_interval_is_valid(&r->y)) {
    return dyd_fail(err, DYD_E_STREAM, "the source gave no valid rectangle; fill it with dyd_interval_set_ends");
  }
  return DYD_OK;
}

/* stop: NULL, or when to give up. */
static dyd_status point_ask_stream(dyd_rect *r, bool *final, const dyd_refinable *p, int64_t bits, int64_t max_bits,
                                   const volatile int *stop, dyd_error *err) {
  dyd_status st = dyd_stream_narrow_until(p->stream, bits, max_bits, stop, err);
  if (dyd_narrow_ended(st)) return st;
  const dyd_rect *now = dyd_stream_rect(p->stream);
  if (!now) return dyd_fail(err, DYD_E_STREAM, "the stream has no rectangle after it was narrowed");
  if (r) dyd_rect_set(r, now);
  *final = dyd_stream_is_final(p->stream);
  return DYD_OK;
}

/* DYD_E_NESTING with the sides that are not nested. */
static dyd_status point_nesting_fail(dyd_error *err, const dyd_engine *e, const dyd_refinable *p, const dyd_rect *r) {
  DYD_LOCAL(dyd_rect, old);
  dyd_status st = dyd_sites_get(&old, e->sites, p->site);
  if (st != DYD_OK)
    dyd_fail(err, st, "%s", dyd_status_text(st));
  else if (!dyd_interval_contains(&old.x, &r->x))
    st = dyd_nesting_fail(err, "x side", &old.x, &r->x);
  else
    st = dyd_nesting_fail(err, "y side", &old.y, &r->y);
  return st;
}

/* DYD_E_CONTRADICTION with both rectangles. */
static dyd_status site_contradiction(dyd_error *err, uint32_t site, const char *told, const dyd_rect *r,
                                     const dyd_rect *known) {
  double a[4], b[4];
  dyd_rect_get_d(a, r);
  dyd_rect_get_d(b, known);
  if (err) err->point = site;
  return dyd_fail(err, DYD_E_CONTRADICTION,
                  "%s [%.17g, %.17g] x [%.17g, %.17g] (ends rounded outward) for point %lu, which is known to lie in "
                  "[%.17g, %.17g] x [%.17g, %.17g]; they have nothing in common, one of them is wrong",
                  told, a[0], a[1], a[2], a[3], (unsigned long)site, b[0], b[1], b[2], b[3]);
}

/* Intersects *r with the rectangle of a site; `told`: name of r in messages. */
static dyd_status site_meet(dyd_rect *r, const dyd_engine *e, uint32_t site, const char *told, dyd_error *err) {
  DYD_LOCAL(dyd_rect, known, both);
  dyd_status st = dyd_sites_get(&known, e->sites, site);
  if (st == DYD_OK) st = dyd_interval_intersect(&both.x, &known.x, &r->x);
  if (st == DYD_OK) st = dyd_interval_intersect(&both.y, &known.y, &r->y);
  if (st == DYD_OK)
    dyd_rect_swap(r, &both);
  else if (st == DYD_E_ARG)
    st = site_contradiction(err, site, told, r, &known);
  else
    dyd_fail(err, st, "%s", dyd_status_text(st));
  return st;
}

/* Puts the answer for p into the table, which checks that it is nested. */
static dyd_status point_put(const dyd_refinable *p, const dyd_engine *e, dyd_rect *r, dyd_error *err) {
  dyd_status st = p->measured ? site_meet(r, e, p->site, "its stream gives", err) : DYD_OK;
  if (st != DYD_OK) return st;
  st = dyd_sites_narrow(e->sites, p->site, r);
  if (st == DYD_E_NESTING && !p->asked) {
    return dyd_fail(err, DYD_E_RANGE, "the rectangle given leaves the exponent range");
  }
  if (st == DYD_E_NESTING) return point_nesting_fail(err, e, p, r);
  return st != DYD_OK ? dyd_fail(err, st, "%s", dyd_status_text(st)) : st;
}

/* Fills in what the engine knows about a failure at p. */
static dyd_status point_blame(const dyd_refinable *p, dyd_status st, dyd_error *err) {
  err->code = st;
  err->point = p->site;
  err->stage = p->calls;
  if (!err->message[0]) dyd_fail(err, st, "%s", dyd_status_text(st));
  return st;
}

void dyd_engine_set_glance(dyd_engine *e, dyd_glance_fn fn) {
  e->source[e->sources - 1].glance = fn;
}

static bool point_glance(double box[4], const dyd_refinable *p, const dyd_engine *e, int64_t bits) {
  const dyd_source_use *use = p->stream ? NULL : &e->source[p->source];
  if (use) return use->glance && use->glance(box, use->source.user, p->site - use->first, bits);
  dyd_double_span side[2];
  if (!dyd_stream_glance(side, p->stream, bits)) return false;
  box[0] = side[0].lo, box[1] = side[0].hi, box[2] = side[1].lo, box[3] = side[1].hi;
  return true;
}

/* The first call, where doubles hold its answer. */
static bool point_narrow_in_doubles(dyd_refinable *p, uint64_t *calls, dyd_engine *e, int64_t bits) {
  double box[4];
  if (p->asked || e->recall || !point_glance(box, p, e, bits)) return false;
  if (dyd_sites_narrow_d(e->sites, p->site, box) < 0) return false;
  ++*calls;
  p->calls++;
  p->bits = bits;
  p->final = box[0] == box[1] && box[2] == box[3];
  p->asked = true;
  return true;
}

struct dyd_recalled {
  uint32_t site, number; /* the number-th answer given */
  int64_t bits;
  bool final, used;
  dyd_rect rect;
};

struct dyd_recall {
  dyd_recalled *item;
  size_t count, cap;
  bool sorted;
};

/* That answer has been given: it and those before it are used up. */
static void recall_use(dyd_recall *m, const dyd_recalled *a) {
  for (dyd_recalled *to = m->item + (a - m->item); to >= m->item && to->site == a->site; to--) to->used = true;
}

/* The rectangle it was narrowed to; *final: no call can narrow it further. */
static void recalled_get(dyd_rect *r, bool *final, const dyd_recalled *a) {
  dyd_rect_set(r, &a->rect);
  *final = a->final;
}

/* Asks the holder of p: an earlier run, its stream, its source. A recalled rectangle is intersected with later answers,
 * since the stream does not know that it has answered before. */
static dyd_status point_ask(dyd_rect *r, bool *final, dyd_refinable *p, const dyd_engine *e, int64_t bits,
                            int64_t max_bits, dyd_error *err) {
  const dyd_recalled *known = dyd_recall_next(e->recall, p->site, bits);
  if (!known && p->stream) return point_ask_stream(r, final, p, bits, max_bits, &e->stop, err);
  if (!known) return point_ask_source(r, final, p, e, bits, max_bits, err);
  recalled_get(r, final, known);
  recall_use(e->recall, known);
  p->measured = true;
  return DYD_OK;
}

/* A guest has no place in the table, and counts what its stream was asked. Its first answer is waited for: no question
 * about it can be asked before. */
static dyd_status guest_narrow(dyd_refinable *p, uint64_t *calls, const dyd_engine *e, int64_t bits, int64_t max_bits,
                               dyd_error *err) {
  uint64_t before = dyd_stream_stage(p->stream);
  dyd_status st = point_ask_stream(NULL, &p->final, p, bits, max_bits, p->asked ? &e->stop : NULL, err);
  if (st == DYD_CANCELLED) return st;
  *calls += dyd_stream_stage(p->stream) - before;
  p->bits = bits;
  p->asked = true;
  return st;
}

dyd_status dyd_engine_narrow(dyd_refinable *p, uint64_t *calls, dyd_engine *e, int64_t bits, int64_t max_bits,
                             dyd_error *err) {
  bool final = p->final;
  if (p->site >= dyd_sites_count(e->sites)) return guest_narrow(p, calls, e, bits, max_bits, err);
  if (point_narrow_in_doubles(p, calls, e, bits)) return DYD_OK;
  dyd_error_clear(err);
  DYD_LOCAL(dyd_rect, r);
  if (!p->asked) dyd_rect_unset(&r);
  dyd_status st = p->asked ? dyd_sites_get(&r, e->sites, p->site) : DYD_OK;
  if (st == DYD_OK && !(p->asked && dyd_rect_bits(&r) >= bits)) {
    ++*calls;
    st = point_ask(&r, &final, p, e, bits, max_bits, err);
    if (st == DYD_OK) st = point_put(p, e, &r, err);
    final |= dyd_rect_is_point(&r);
    if (st == DYD_OK) p->calls++;
  }
  if (st == DYD_OK) {
    p->bits = bits;
    p->final = final;
    p->asked = true;
    if (final) st = dyd_sites_set_kind(e->sites, p->site, 1, DYD_SITE_ANY);
  }
  return st == DYD_OK || st == DYD_CANCELLED ? st : point_blame(p, st, err);
}

void dyd_engine_note_change(dyd_engine *e, uint32_t site) {
  if (e->former && site < e->former->sk.n) {
    dyd_delaunay_free(e->former);
    e->former = NULL;
  }
  if (e->pd) e->changed[e->changes++] = site;
}

/* ---- measuring again ---- */

/* Puts *r, what site i and its new measurement have in common, into the table. */
static dyd_status site_put_measured(dyd_engine *e, uint32_t i, const dyd_rect *r) {
  dyd_refinable *p = (dyd_refinable *)dyd_find_index(&i, e->point, e->points, sizeof *e->point);
  if (!DYD_GROW(e->changed, e->change_cap, e->changes + 1)) return DYD_E_NOMEM;
  DYD_LOCAL(dyd_rect, before);
  dyd_status st = dyd_sites_get(&before, e->sites, i);
  bool news = st == DYD_OK && !dyd_rect_equal(&before, r);
  if (!news) return st;
  st = dyd_sites_narrow(e->sites, i, r);
  if (st == DYD_OK && p) {
    p->measured = true;
    p->final = p->final || dyd_rect_is_point(r);
    st = dyd_sites_set_kind(e->sites, i, 1, p->final ? DYD_SITE_ANY : DYD_SITE_BARE);
  }
  if (st == DYD_OK) dyd_engine_note_change(e, i);
  return st;
}

static dyd_status site_measure(dyd_engine *e, uint32_t i, const dyd_rect *r, dyd_error *err) {
  if (dyd_engine_is_busy(e))
    return dyd_fail(err, DYD_E_ARG,
                    "the engine is at work: no callback of it, and no other thread, may measure points");
  if (i >= dyd_sites_count(e->sites))
    return dyd_fail(err, DYD_E_ARG, "there is no point %lu: there are %zu, numbered from 0", (unsigned long)i,
                    dyd_sites_count(e->sites));
  if (!dyd_interval_is_valid(&r->x) || !dyd_interval_is_valid(&r->y))
    return dyd_fail(err, DYD_E_ARG, "the rectangle measured is not valid; fill it with dyd_interval_set_ends");
  DYD_LOCAL(dyd_rect, both);
  dyd_rect_set(&both, r);
  dyd_status st = site_meet(&both, e, i, "a measurement gives", err);
  if (st == DYD_OK) {
    st = site_put_measured(e, i, &both);
    if (st != DYD_OK) dyd_fail(err, st, "%s", dyd_status_text(st));
  }
  return st;
}

dyd_status dyd_engine_remeasure(dyd_engine *e, uint32_t i, const dyd_rect *r, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  if (err) dyd_error_clear(err);
  return site_measure(e, i, r, err);
}

/* ---- records: answers of an earlier run, sorted by site at the first search, the answers of a site in the order
 * given; a digest of all statuses; the statuses after each stage ---- */

static uint64_t digest_word(uint64_t digest, uint32_t word) {
  const unsigned char byte[4] = {word & 255, word >> 8 & 255, word >> 16 & 255, word >> 24};
  return dyd_digest(digest, byte, sizeof byte);
}

uint64_t dyd_digest_list(const dyd_pair_list *pairs) {
  uint64_t digest = DYD_DIGEST_BEGIN;
  for (size_t k = 0; k < pairs->count; k++) {
    digest = digest_word(digest, pairs->item[k].i);
    digest = digest_word(digest, pairs->item[k].j);
    digest = digest_word(digest, (uint32_t)pairs->item[k].status);
  }
  return digest;
}

dyd_status dyd_digest_pairs(uint64_t *out, const dyd_delaunay *pd) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = dyd_pairs_list(&pairs, pd, DYD_TIE);
  if (st == DYD_OK) *out = dyd_digest_list(&pairs);
  return st;
}

/* What every stage of a run knew. Possible pairs come sorted, so that changes are found by going along two lists. */

dyd_status dyd_history_new(dyd_history **out) {
  dyd_history *h = calloc(1, sizeof *h);
  if (!h) return DYD_E_NOMEM;
  *out = h;
  return DYD_OK;
}

void dyd_history_free(dyd_history *h) {
  if (!h) return;
  dyd_pair_list_clear(&h->last);
  dyd_free_all(h->change_begin, h->box_begin, h->change, h->box, h->last_box, h);
}

/* ---- pairs ---- */

bool dyd_pairs_next(dyd_pair_change *out, size_t at[2], const dyd_pair_list *before, const dyd_pair_list *now) {
  const dyd_pair *a = at[0] < before->count ? &before->item[at[0]] : NULL;
  const dyd_pair *b = at[1] < now->count ? &now->item[at[1]] : NULL;
  if (!a && !b) return false;
  int order = !a ? 1 : !b ? -1 : dyd_compare_two(a, b);
  *out = (dyd_pair_change){order < 0 ? *a : *b, order <= 0 ? a->status : DYD_ILLEGAL};
  if (order < 0) out->pair.status = DYD_ILLEGAL;
  at[0] += order <= 0;
  at[1] += order >= 0;
  return true;
}

static bool history_add_changes(dyd_history *h, const dyd_pair_list *now) {
  dyd_pair_change p;
  for (size_t at[2] = {0, 0}; dyd_pairs_next(&p, at, &h->last, now);) {
    if (p.before == p.pair.status) continue;
    if (!DYD_GROW(h->change, h->change_cap, h->changes + 1)) return false;
    h->change[h->changes++] = p.pair;
  }
  return true;
}

/* ---- boxes ---- */

/* Before the first stage: no site has a box. */
static dyd_status history_begin(dyd_history *h, size_t sites) {
  if (h->last_box) return h->sites == sites ? DYD_OK : DYD_E_ARG;
  h->last_box = dyd_alloc(sites, sizeof *h->last_box);
  if (!h->last_box) return DYD_E_NOMEM;
  for (size_t i = 0; i < sites; i++) h->last_box[i] = DYD_HISTORY_NO_BOX;
  h->sites = sites;
  return DYD_OK;
}

static bool history_add_boxes(dyd_history *h, const dyd_delaunay *pd) {
  const dyd_sites *sites = dyd_delaunay_sites(pd);
  for (size_t i = 0; i < h->sites; i++) {
    dyd_history_box b = {.site = (uint32_t)i};
    if (dyd_delaunay_alias(pd, (uint32_t)i) != i) continue;
    dyd_sites_get_d(b.box, sites, i);
    size_t last = h->last_box[i];
    if (last != DYD_HISTORY_NO_BOX && memcmp(h->box[last].box, b.box, sizeof b.box) == 0) continue;
    if (!DYD_GROW(h->box, h->box_cap, h->boxes + 1)) return false;
    h->box[h->boxes++] = b;
  }
  return true;
}

/* ---- a stage ---- */

static bool history_reserve_stage(dyd_history *h) {
  return DYD_GROW(h->change_begin, h->stage_cap, h->stages + 1) &&
         DYD_GROW(h->box_begin, h->box_stage_cap, h->stages + 1);
}

dyd_status dyd_history_add(dyd_history *h, const dyd_delaunay *pd, dyd_pair_list *pairs) {
  size_t changes = h->changes, boxes = h->boxes;
  dyd_status st = history_begin(h, dyd_sites_count(dyd_delaunay_sites(pd)));
  if (st != DYD_OK) return st;
  if (!history_reserve_stage(h) || !history_add_changes(h, pairs) || !history_add_boxes(h, pd)) {
    h->changes = changes;
    h->boxes = boxes;
    return DYD_E_NOMEM;
  }
  for (size_t k = boxes; k < h->boxes; k++) h->last_box[h->box[k].site] = k;
  h->change_begin[h->stages] = changes;
  h->box_begin[h->stages++] = boxes;
  dyd_pair_list_clear(&h->last);
  h->last = *pairs;
  *pairs = (dyd_pair_list){0};
  return DYD_OK;
}

dyd_status dyd_history_note(dyd_history *h, const dyd_delaunay *pd) {
  if (!h || !pd) return DYD_E_ARG;
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = dyd_pairs_list(&pairs, pd, DYD_TIE);
  return st == DYD_OK ? dyd_history_add(h, pd, &pairs) : st;
}

void dyd_recall_free(dyd_recall *m) {
  if (!m) return;
  for (size_t k = 0; k < m->count; k++) dyd_rect_clear(&m->item[k].rect);
  dyd_free_all(m->item, m);
}

static int recalled_compare(const void *a, const void *b) {
  const dyd_recalled *x = a, *y = b;
  int c = dyd_compare_index(&x->site, &y->site);
  return c ? c : dyd_compare_index(&x->number, &y->number);
}

static void recall_sort(dyd_recall *m) {
  if (!m->sorted && m->count) qsort(m->item, m->count, sizeof *m->item, recalled_compare);
  m->sorted = true;
}

const dyd_recalled *dyd_recall_next(dyd_recall *m, uint32_t site, int64_t bits) {
  if (!m) return NULL;
  recall_sort(m);
  const dyd_recalled *a = dyd_find_index(&site, m->item, m->count, sizeof *m->item), *end = m->item + m->count;
  while (a && a > m->item && a[-1].site == site) a--;
  while (a && a < end && a->site == site && (a->used || a->bits < bits)) a++;
  return a && a < end && a->site == site ? a : NULL;
}

dyd_status dyd_recall_each(const dyd_recall *m, dyd_recalled_fn fn, void *user) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; m && k < m->count && st == DYD_OK; k++) {
    const dyd_recalled *a = &m->item[k];
    st = fn(user, a->site, a->bits, &a->rect, a->final);
  }
  return st;
}

static dyd_status recall_may_take(const dyd_engine *e, uint32_t i, const dyd_rect *r, dyd_error *err) {
  if (e->started) return dyd_fail(err, DYD_E_ARG, "answers are recalled before the first run only");
  if (!dyd_find_index(&i, e->point, e->points, sizeof *e->point))
    return dyd_fail(err, DYD_E_ARG, "point %lu is none that can be narrowed, so it has no answers", (unsigned long)i);
  if (!dyd_interval_is_valid(&r->x) || !dyd_interval_is_valid(&r->y))
    return dyd_fail(err, DYD_E_ARG, "the answer is no valid rectangle; fill it with dyd_interval_set_ends");
  return DYD_OK;
}

dyd_status dyd_engine_recall(dyd_engine *e, uint32_t i, int64_t bits, const dyd_rect *r, bool final, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  if (err) dyd_error_clear(err);
  dyd_status st = recall_may_take(e, i, r, err);
  if (st != DYD_OK) return st;
  if (!e->recall) e->recall = calloc(1, sizeof *e->recall);
  dyd_recall *m = e->recall;
  if (!m || !DYD_GROW(m->item, m->cap, m->count + 1)) return dyd_fail_nomem(err);
  dyd_recalled *a = &m->item[m->count];
  *a = (dyd_recalled){.site = i, .number = (uint32_t)m->count, .bits = bits, .final = final};
  dyd_rect_init(&a->rect);
  dyd_rect_set(&a->rect, r);
  m->count++;
  m->sorted = false;
  return DYD_OK;
}
