/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Records of a run: answers of an earlier run, sorted by site at the first search, the answers of a site in the order
 * given; a digest of all statuses; the statuses after each stage. */
#include "engine/record.h"

#include "base/alloc.h"
#include "base/digest.h"
#include "base/error.h"
#include "base/index.h"
#include "base/local.h"
#include "delaunay/memory.h"
#include "rect/rect.h"

#include <string.h>

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

void dyd_recall_use(dyd_recall *m, const dyd_recalled *a) {
  for (dyd_recalled *to = m->item + (a - m->item); to >= m->item && to->site == a->site; to--) to->used = true;
}

dyd_status dyd_recall_each(const dyd_recall *m, dyd_recalled_fn fn, void *user) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; m && k < m->count && st == DYD_OK; k++) {
    const dyd_recalled *a = &m->item[k];
    st = fn(user, a->site, a->bits, &a->rect, a->final);
  }
  return st;
}

void dyd_recalled_get(dyd_rect *r, bool *final, const dyd_recalled *a) {
  dyd_rect_set(r, &a->rect);
  *final = a->final;
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
