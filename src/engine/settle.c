/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs that stay indeterminate whatever is refined [SET-1] [SET-2].
 *
 * A side of a rectangle may have a core, an interval that no refinement leaves [SET-3]: all of a fixed side, and what
 * is within the radius of every place that the centre of a side may have. Let no two points of a rectangle that differ
 * along sides without a core be farther apart than eps. A site is firm if both its sides have cores wider than 2 eps.
 * Pairs of firm sites: all sites are triangulated once, the firm ones with their cores less eps on each side, the
 * others with any place along each side without a core. A pair that is neither legal nor illegal there is so wherever
 * these points are. Other pairs: settle_face.c. */
#include "engine/settle.h"

#include "base/alloc.h"
#include "base/index.h"
#include "engine/points.h"

#include <stdlib.h>

/* From so many bits on pairs without a radius are worth a look; how many sites may be looked at in all, for each site
 * and besides. In the armed build coarse points are looked at. */
#ifdef DYD_ARMED
enum { FIRST_BITS = 2 };
#else
enum { FIRST_BITS = 128 };
#endif
enum { WORK_PER_SITE = 4, WORK = 1 << 23 };

void dyd_settled_clear(dyd_settled *s) {
  free(s->item);
  *s = (dyd_settled){0};
}

/* ---- what is known ---- */

static const dyd_settled_pair *settled_find(const dyd_settled *s, uint32_t i, uint32_t j) {
  const dyd_settled_pair key = {.i = i, .j = j};
  return s->count ? bsearch(&key, s->item, s->count, sizeof key, dyd_compare_two) : NULL;
}

bool dyd_is_settled(const dyd_settled *s, const dyd_pair *pair) {
  const dyd_settled_pair *p = settled_find(s, pair->i, pair->j);
  return p && dyd_pair_is_settled(p);
}

/* Pairs from `sorted` on have come: what is known of each, in one place. */
static void settled_sort(dyd_settled *s) {
  size_t kept = 0;
  if (s->count) qsort(s->item, s->count, sizeof *s->item, dyd_compare_two);
  for (size_t k = 0; k < s->count; k++) {
    dyd_settled_pair *last = kept ? &s->item[kept - 1] : NULL;
    if (last && dyd_compare_two(last, &s->item[k]) == 0) {
      last->possible = last->possible || s->item[k].possible;
      last->unsure = last->unsure || s->item[k].unsure;
    } else {
      s->item[kept++] = s->item[k];
    }
  }
  s->count = kept;
}

/* ---- pairs of firm sites ---- */

/* Settles pairs of firm sites, by all sites. */
static dyd_status settle_firm(dyd_settled_pair *pair, size_t pairs, const dyd_plan *plan, const dyd_dyadic *eps) {
  const dyd_engine *e = plan->e;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = plan->o->max_pairs, .cancel = &e->stop,
                                  .threads = plan->o->threads, .no_filter = plan->o->no_filter};
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_status st = dyd_sites_new(&sites);
  for (size_t k = 0; st == DYD_OK && k < dyd_sites_count(e->sites); k++) {
    bool firm;
    st = dyd_firm_add(sites, &firm, e, eps, (uint32_t)k);
  }
  if (st == DYD_OK) st = dyd_delaunay_new(&pd, sites, &o, NULL);
  for (size_t k = 0; st == DYD_OK && k < pairs; k++) {
    dyd_pair_status status = dyd_delaunay_status(pd, pair[k].i, pair[k].j);
    pair[k].possible = pair[k].possible || status != DYD_ILLEGAL;
    pair[k].unsure = pair[k].unsure || status != DYD_LEGAL;
  }
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* ---- faces ---- */

/* Is one of the sites a point that can be narrowed? */
static bool any_can_narrow(const dyd_engine *e, const dyd_index_list *site) {
  for (size_t k = 0; k < site->count; k++) {
    const dyd_refinable *p = dyd_engine_find(e, site->item[k]);
    if (p && !p->final) return true;
  }
  return false;
}

/* Appends the indeterminate pairs of face f that are not settled: those of firm sites, or the others. */
static dyd_status take_pairs(dyd_settled *out, const dyd_settled *known, const dyd_engine *e, const dyd_dyadic *eps,
                             size_t f, bool firm) {
  dyd_pair_list all = {0};
  dyd_status st = dyd_delaunay_face_pairs(&all, e->pd, f);
  if (st == DYD_OK && !dyd_reserve((void **)&out->item, &out->cap, out->count + all.count, sizeof *out->item))
    st = DYD_E_NOMEM;
  for (size_t k = 0; st == DYD_OK && k < all.count; k++) {
    const dyd_pair *pair = &all.item[k];
    const dyd_settled_pair *old = settled_find(known, pair->i, pair->j);
    bool both;
    if (pair->status != DYD_INDETERMINATE || (old && dyd_pair_is_settled(old))) continue;
    st = dyd_pair_is_firm(&both, e, eps, pair);
    if (both == firm) out->item[out->count++] = old ? *old : (dyd_settled_pair){pair->i, pair->j, false, false};
  }
  dyd_pair_list_clear(&all);
  return st;
}

/* Takes pairs of face f, if a point of it can be narrowed; unless they are of firm sites, looks at them. */
static dyd_status settle_face_pairs(dyd_settled *fresh, dyd_settled *s, size_t *work, const dyd_engine *e,
                                    const dyd_dyadic *eps, size_t f, bool firm) {
  size_t first = fresh->count;
  dyd_index_list face = {0};
  bool outer;
  dyd_status st = dyd_delaunay_face(&face, &outer, e->pd, f);
  if (st == DYD_OK && any_can_narrow(e, &face)) st = take_pairs(fresh, s, e, eps, f, firm);
  if (st == DYD_OK && !firm && fresh->count > first)
    st = dyd_settle_face(&fresh->item[first], &s->random, work, e, fresh->count - first, &face);
  dyd_index_list_clear(&face);
  return st;
}

/* The most bits that a point which can be narrowed was asked for. */
static int64_t most_bits(const dyd_engine *e) {
  int64_t most = INT64_MIN;
  for (size_t k = 0; k < e->points; k++)
    if (e->point[k].asked && !e->point[k].final && e->point[k].bits > most) most = e->point[k].bits;
  return most;
}

static dyd_status settle_pairs(dyd_settled *fresh, dyd_settled *s, const dyd_plan *plan) {
  const dyd_engine *e = plan->e;
  size_t work = WORK + WORK_PER_SITE * dyd_sites_count(e->sites), faces = dyd_delaunay_undecided_faces(e->pd);
  dyd_dyadic eps;
  dyd_dyadic_init(&eps);
  dyd_status st = dyd_firm_eps(&eps, e);
  for (size_t f = 0; st == DYD_OK && f < faces; f++) st = settle_face_pairs(fresh, s, &work, e, &eps, f, true);
  if (st == DYD_OK && fresh->count) st = settle_firm(fresh->item, fresh->count, plan, &eps);
  for (size_t f = 0; st == DYD_OK && work && f < faces; f++) st = settle_face_pairs(fresh, s, &work, e, &eps, f, false);
  dyd_dyadic_clear(&eps);
  return st;
}

static dyd_status settled_append(dyd_settled *s, const dyd_settled *fresh) {
  if (!dyd_reserve((void **)&s->item, &s->cap, s->count + fresh->count, sizeof *s->item)) return DYD_E_NOMEM;
  for (size_t k = 0; k < fresh->count; k++) s->item[s->count++] = fresh->item[k];
  settled_sort(s);
  return DYD_OK;
}

/* Does a point that can be narrowed have a core? */
static dyd_status any_core(bool *out, const dyd_engine *e) {
  dyd_status st = DYD_OK;
  dyd_rect r;
  *out = false;
  dyd_rect_init(&r);
  for (size_t k = 0; st == DYD_OK && !*out && k < e->points; k++) {
    bool core[2];
    if (e->point[k].final) continue;
    st = dyd_site_get_core(&r, core, e, e->point[k].site);
    *out = st == DYD_OK && core[0] && core[1];
  }
  dyd_rect_clear(&r);
  return st;
}

/* From FIRST_BITS on, and when all pairs are looked at for the first time, if radii may be what keeps them open. */
static dyd_status settle_is_due(bool *out, const dyd_settled *s, const dyd_plan *plan, int64_t bits) {
  int64_t due = s->next > FIRST_BITS ? s->next : FIRST_BITS;
  *out = bits >= due || bits >= plan->o->max_bits;
  return *out || s->next ? DYD_OK : any_core(out, plan->e);
}

dyd_status dyd_settle(dyd_settled *s, const dyd_plan *plan) {
  int64_t bits = most_bits(plan->e);
  dyd_settled fresh = {0};
  bool due;
  dyd_status st = settle_is_due(&due, s, plan, bits);
  if (st != DYD_OK || !due) return st;
  s->next = dyd_bits_raised(bits, bits > 0 ? 3 * bits : 0, INT64_MAX);
  st = settle_pairs(&fresh, s, plan);
  if (st == DYD_OK) st = settled_append(s, &fresh);
  dyd_settled_clear(&fresh);
  return st;
}
