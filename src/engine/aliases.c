/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Joining points that are proved to be the same place.
 *
 * Where the rectangles of two sites meet, a disc that holds one of them and avoids the other does not exist: neither
 * has a legal edge but perhaps one to the other. So, unless there are no others, both are in an undecided face
 * together. */
#include "engine/aliases.h"
#include "delaunay/memory.h"

#include "base/alloc.h"
#include "base/error.h"
#include "engine/points.h"
#include "engine/ties.h"

#include <stdlib.h>

/* A described site, with its box in doubles. */
typedef struct candidate {
  double box[4];
  uint32_t site;
  bool computable; /* not an exact point */
} candidate;

/* Does the engine know what the point is? */
static bool candidate_set(candidate *c, const dyd_engine *e, uint32_t i) {
  const dyd_refinable *p = dyd_engine_find(e, i);
  bool point = dyd_sites_is_point(e->sites, i);
  *c = (candidate){.site = i, .computable = !point};
  dyd_sites_get_d(c->box, e->sites, i);
  return point || (p && p->stream);
}

static int candidate_compare(const void *a, const void *b) {
  const candidate *x = a, *y = b;
  if (x->box[0] != y->box[0]) return x->box[0] < y->box[0] ? -1 : 1;
  return (x->site > y->site) - (x->site < y->site);
}

/* Both rectangles are one point from now on, and the higher number takes part in nothing. */
static dyd_status join_sites(dyd_engine *e, uint32_t i, uint32_t j, dyd_error *err) {
  dyd_status st = dyd_sites_join(e->sites, i, j);
  if (st == DYD_E_NESTING)
    return dyd_fail(err, st, "points %lu and %lu are given by equal numbers, and their rectangles do not meet",
                    (unsigned long)i, (unsigned long)j);
  if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
  for (size_t k = 0; k < e->points; k++) {
    dyd_refinable *p = &e->point[k];
    if (p->site != i && p->site != j) continue;
    p->measured = true;
    p->final = p->final || dyd_sites_joined(e->sites, p->site) != p->site || dyd_sites_is_point(e->sites, p->site);
  }
  return DYD_OK;
}

static dyd_status try_pair(bool *any, dyd_engine *e, const candidate *a, const candidate *b, dyd_error *err) {
  uint32_t two[2] = {a->site < b->site ? a->site : b->site, a->site < b->site ? b->site : a->site};
  bool proved = false;
  if (!a->computable && !b->computable) return DYD_OK;
  if (a->box[2] > b->box[3] || b->box[2] > a->box[3]) return DYD_OK;
  if (dyd_sites_joined(e->sites, two[0]) == dyd_sites_joined(e->sites, two[1])) return DYD_OK;
  dyd_status st = dyd_ties_prove(&proved, e, DYD_COINCIDENT, two, 2, err);
  if (st == DYD_OK && proved) st = join_sites(e, two[0], two[1], err);
  *any = *any || (st == DYD_OK && proved);
  return st;
}

/* A sweep from left to right over those that are described. */
static dyd_status try_group(bool *any, dyd_engine *e, const uint32_t *site, size_t count, dyd_error *err) {
  candidate *c = dyd_alloc(count, sizeof *c);
  size_t n = 0;
  dyd_status st = c ? DYD_OK : dyd_fail_nomem(err);
  for (size_t k = 0; k < count && c; k++) n += candidate_set(&c[n], e, site[k]);
  if (c) qsort(c, n, sizeof *c, candidate_compare);
  for (size_t k = 0; k < n && st == DYD_OK; k++)
    for (size_t l = k + 1; l < n && c[l].box[0] <= c[k].box[1] && st == DYD_OK; l++)
      st = dyd_flag_get(&e->stop) ? DYD_CANCELLED : try_pair(any, e, &c[k], &c[l], err);
  free(c);
  return st;
}

/* Two sites, or two that are no aliases, may be joined by a legal edge and nothing else. */
static dyd_status try_last_pair(bool *any, dyd_engine *e, const dyd_delaunay *pd, dyd_error *err) {
  dyd_pair_list pairs = {0};
  size_t count[4];
  dyd_delaunay_count(count, pd);
  if (count[DYD_LEGAL] != 1) return DYD_OK;
  dyd_status st = dyd_pairs_list(&pairs, pd, DYD_TIE);
  if (st == DYD_OK && pairs.count == 1) st = try_group(any, e, (uint32_t[]){pairs.item->i, pairs.item->j}, 2, err);
  dyd_pair_list_clear(&pairs);
  return st;
}

dyd_status dyd_aliases_find(bool *any, dyd_engine *e, const dyd_delaunay *pd, dyd_error *err) {
  size_t faces = dyd_delaunay_undecided_faces(pd);
  dyd_status st = DYD_OK;
  *any = false;
  if (e->points == 0) return DYD_OK;
  if (faces == 0) return try_last_pair(any, e, pd, err);
  for (size_t f = 0; f < faces && st == DYD_OK; f++) {
    dyd_index_list sites = {0};
    bool outer;
    st = dyd_delaunay_face(&sites, &outer, pd, f);
    if (st == DYD_OK) st = try_group(any, e, sites.item, sites.count, err);
    dyd_index_list_clear(&sites);
  }
  return st;
}
