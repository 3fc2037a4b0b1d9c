/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Answers of an earlier run. Sorted by site when they are first looked for, those of a site in the order given. */
#include "engine/recall.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "rect/rect.h"

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
  free(m->item);
  free(m);
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
  if (!m || !dyd_reserve((void **)&m->item, &m->cap, m->count + 1, sizeof *m->item)) return dyd_fail_nomem(err);
  dyd_recalled *a = &m->item[m->count];
  *a = (dyd_recalled){.site = i, .number = (uint32_t)m->count, .bits = bits, .final = final};
  dyd_rect_init(&a->rect);
  dyd_rect_set(&a->rect, r);
  m->count++;
  m->sorted = false;
  return DYD_OK;
}
