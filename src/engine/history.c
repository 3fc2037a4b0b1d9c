/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What every stage of a run knew. Possible pairs come sorted, so that changes are found by going along two lists. */
#include "engine/history.h"
#include "delaunay/memory.h"

#include "base/alloc.h"
#include "base/index.h"
#include <string.h>

dyd_status dyd_history_new(dyd_history **out) {
  dyd_history *h = calloc(1, sizeof *h);
  if (!h) return DYD_E_NOMEM;
  *out = h;
  return DYD_OK;
}

void dyd_history_free(dyd_history *h) {
  if (!h) return;
  dyd_pair_list_clear(&h->last);
  free(h->change_begin);
  free(h->box_begin);
  free(h->change);
  free(h->box);
  free(h->last_box);
  free(h);
}

/* ---- pairs ---- */

static bool history_add_change(dyd_history *h, const dyd_pair *p, dyd_pair_status status) {
  if (!dyd_reserve((void **)&h->change, &h->change_cap, h->changes + 1, sizeof *h->change)) return false;
  h->change[h->changes++] = (dyd_pair){p->i, p->j, status};
  return true;
}

/* What is in one of the lists alone, or in both with another status. */
static bool history_add_changes(dyd_history *h, const dyd_pair_list *now) {
  const dyd_pair_list *last = &h->last;
  bool good = true;
  for (size_t a = 0, b = 0; good && (a < last->count || b < now->count);) {
    int order = a == last->count ? 1 : b == now->count ? -1 : dyd_compare_two(&last->item[a], &now->item[b]);
    if (order < 0)
      good = history_add_change(h, &last->item[a], DYD_ILLEGAL);
    else if (order > 0 || last->item[a].status != now->item[b].status)
      good = history_add_change(h, &now->item[b], now->item[b].status);
    a += order <= 0;
    b += order >= 0;
  }
  return good;
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
    if (!dyd_reserve((void **)&h->box, &h->box_cap, h->boxes + 1, sizeof *h->box)) return false;
    h->box[h->boxes++] = b;
  }
  return true;
}

/* ---- a stage ---- */

static bool history_reserve_stage(dyd_history *h) {
  return dyd_reserve((void **)&h->change_begin, &h->stage_cap, h->stages + 1, sizeof *h->change_begin) &&
         dyd_reserve((void **)&h->box_begin, &h->box_stage_cap, h->stages + 1, sizeof *h->box_begin);
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
  dyd_pair_list pairs = {0};
  dyd_status st = dyd_pairs_list(&pairs, pd, DYD_TIE);
  if (st == DYD_OK) st = dyd_history_add(h, pd, &pairs);
  dyd_pair_list_clear(&pairs);
  return st;
}
