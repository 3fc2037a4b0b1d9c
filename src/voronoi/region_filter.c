/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Boxes round the undecided part of the diagram that belongs to an undecided face, by bisection in doubles [REGION-1].
 *
 * Every vertex of the diagram, for any choice, that is no vertex of a sure triangle is the circumcentre of a triangle
 * ijl of some face with an edge ij that is not legal, so it lies in Pos_i n Pos_j n Pos_l, and l is a possible
 * neighbour of i. For a box of centres Q, site i is left out when some k blocks it: dl_k < ds_i in all of Q, by ranges
 * over Q or, since C_ki is convex, at its four corners, with the bounds of [FLT-DST]. Who is left out blocks nobody
 * whom k does not block, so the list of sites shrinks from box to part, and with it the list of pairs. Q is dropped
 * when no pair or fewer than three sites are left. What is left after bisection is enclosed, and the enclosure bisected
 * again while that pays. */
#include "voronoi/region.h"

#include "base/alloc.h"

#include <string.h>

/* BLOCKERS: how many sites of a box are tried as blockers at corners; leaving some out only makes the box larger. */
enum { COARSE = 3, FINE = 5, BLOCKERS = 64 };

/* Ends as places in site[]. */
typedef struct region_pair {
  uint32_t i, j;
} region_pair;

/* The lists of sites and pairs of nested boxes lie one behind the other in list[] and pair[]. in[]: is a site in the
 * list at hand? All false between uses. */
typedef struct search {
  dyd_bbox *site;
  uint32_t *list;
  region_pair *pair;
  bool *in;
  size_t list_cap, pair_cap;
  dyd_bbox found;
  bool any;
  dyd_status st;
} search;

/* Where the lists of a box begin, and how long they are. */
typedef struct region_lists {
  size_t sites, site_count, pairs, pair_count;
} region_lists;

static bool box_is_within(const dyd_bbox *a, const dyd_bbox *b) {
  return b->e[0] <= a->e[0] && a->e[1] <= b->e[1] && b->e[2] <= a->e[2] && a->e[3] <= b->e[3];
}

static void grow_found(search *s, const dyd_bbox *c) {
  if (!s->any) s->found = *c;
  s->any = true;
  for (int k = 0; k < 4; k += 2) {
    s->found.e[k] = dyd_min(s->found.e[k], c->e[k]);
    s->found.e[k + 1] = dyd_max(s->found.e[k + 1], c->e[k + 1]);
  }
}

/* ---- who is possible in a box ---- */

/* Keeps the sites of list[from .. from+count) that ranges do not exclude; returns how many. */
static size_t region_keep_near(search *s, const dyd_bbox *c, size_t from, size_t count) {
  double least = HUGE_VAL;
  size_t kept = from;
  for (size_t k = from; k < from + count; k++) least = dyd_min(least, dyd_dl2_upper(c, &s->site[s->list[k]]));
  for (size_t k = from; k < from + count; k++)
    if (!(dyd_ds2_lower(c, &s->site[s->list[k]]) > least)) s->list[kept++] = s->list[k];
  return kept - from;
}

static bool is_blocked(double far[BLOCKERS][4], size_t blockers, const double near[4]) {
  for (size_t k = 0; k < blockers; k++)
    if (far[k][0] < near[0] && far[k][1] < near[1] && far[k][2] < near[2] && far[k][3] < near[3]) return true;
  return false;
}

/* Keeps those that nobody blocks at the corners. Nobody blocks himself, as far >= near. */
static size_t region_keep_open(search *s, const dyd_bbox *c, size_t from, size_t count) {
  double far[BLOCKERS][4], near[4];
  dyd_bbox corner[4];
  size_t kept = from, blockers = count < BLOCKERS ? count : BLOCKERS;
  for (int q = 0; q < 4; q++) {
    double x = c->e[q & 1], y = c->e[2 + (q >> 1)];
    corner[q] = (dyd_bbox){{x, x, y, y}};
    for (size_t k = 0; k < blockers; k++) far[k][q] = dyd_dl2_upper(&corner[q], &s->site[s->list[from + k]]);
  }
  for (size_t k = from; k < from + count; k++) {
    for (int q = 0; q < 4; q++) near[q] = dyd_ds2_lower(&corner[q], &s->site[s->list[k]]);
    if (!is_blocked(far, blockers, near)) s->list[kept++] = s->list[k];
  }
  return kept - from;
}

/* Keeps the pairs of pair[from .. from+count) whose ends are in the list. */
static size_t region_keep_pairs(search *s, const region_lists *at) {
  size_t kept = at->pairs;
  for (size_t k = 0; k < at->site_count; k++) s->in[s->list[at->sites + k]] = true;
  for (size_t k = at->pairs; k < at->pairs + at->pair_count; k++)
    if (s->in[s->pair[k].i] && s->in[s->pair[k].j]) s->pair[kept++] = s->pair[k];
  for (size_t k = 0; k < at->site_count; k++) s->in[s->list[at->sites + k]] = false;
  return kept - at->pairs;
}

/* Cuts the lists down to what is possible in the box: in place. */
static void region_cut(region_lists *at, search *s, const dyd_bbox *c) {
  at->site_count = region_keep_near(s, c, at->sites, at->site_count);
  at->site_count = region_keep_open(s, c, at->sites, at->site_count);
  at->pair_count = at->site_count < 3 ? 0 : region_keep_pairs(s, at);
}

/* ---- bisection ---- */

/* *out = a copy of the lists, behind them. */
static void region_copy_lists(region_lists *out, search *s, const region_lists *at) {
  *out = (region_lists){at->sites + at->site_count, at->site_count, at->pairs + at->pair_count, at->pair_count};
  if (!dyd_reserve((void **)&s->list, &s->list_cap, out->sites + out->site_count, sizeof *s->list) ||
      !dyd_reserve((void **)&s->pair, &s->pair_cap, out->pairs + out->pair_count, sizeof *s->pair)) {
    s->st = DYD_E_NOMEM;
    return;
  }
  if (at->site_count) memcpy(s->list + out->sites, s->list + at->sites, at->site_count * sizeof *s->list);
  if (at->pair_count) memcpy(s->pair + out->pairs, s->pair + at->pairs, at->pair_count * sizeof *s->pair);
}

/* Bisects both sides, depth first; boxes inside the enclosure found so far add nothing. */
static void region_bisect(search *s, const dyd_bbox *c, const region_lists *around, int depth) {
  region_lists own;
  if (s->st != DYD_OK || (s->any && box_is_within(c, &s->found))) return;
  region_copy_lists(&own, s, around);
  if (s->st == DYD_OK) region_cut(&own, s, c);
  if (s->st != DYD_OK || !own.pair_count) return;
  if (depth == 0) {
    grow_found(s, c);
    return;
  }
  double x = c->e[0] / 2 + c->e[1] / 2, y = c->e[2] / 2 + c->e[3] / 2;
  for (int q = 0; q < 4; q++) {
    dyd_bbox part = {{q & 1 ? x : c->e[0], q & 1 ? c->e[1] : x, q & 2 ? y : c->e[2], q & 2 ? c->e[3] : y}};
    region_bisect(s, &part, &own, depth - 1);
  }
}

/* Does one side become a good deal shorter? */
static bool box_shrinks(const dyd_bbox *from, const dyd_bbox *to) {
  return to->e[1] - to->e[0] < 0.75 * (from->e[1] - from->e[0]) ||
         to->e[3] - to->e[2] < 0.75 * (from->e[3] - from->e[2]);
}

/* Coarse rounds as long as they pay, then fine ones; *any = false: nothing is possible in *c. */
static void region_shrink(dyd_bbox *c, search *s, region_lists *all) {
  bool pays = true;
  for (int depth = COARSE; pays || depth == COARSE;) {
    if (!pays) depth = FINE;
    region_cut(all, s, c);
    s->any = false;
    region_bisect(s, c, all, depth);
    if (!s->any || s->st != DYD_OK) break;
    pays = box_shrinks(c, &s->found);
    *c = s->found;
  }
}

/* ---- the lists of a face ---- */

static uint32_t place_in_list(const dyd_index_list *sites, uint32_t site) {
  const uint32_t *found = dyd_find_index(&site, sites->item, sites->count, sizeof site);
  return (uint32_t)(found - sites->item);
}

static void region_load(search *s, const dyd_delaunay *pd, const dyd_pair_list *pairs, const dyd_index_list *sites) {
  for (size_t k = 0; k < sites->count; k++) {
    dyd_sites_get_d(s->site[k].e, pd->sk.rects.sites, sites->item[k]);
    s->list[k] = (uint32_t)k;
    s->in[k] = false;
  }
  for (size_t k = 0; k < pairs->count; k++)
    s->pair[k] = (region_pair){place_in_list(sites, pairs->item[k].i), place_in_list(sites, pairs->item[k].j)};
}

dyd_status dyd_filter_region(dyd_bbox *box, bool *any, const dyd_delaunay *pd, const dyd_pair_list *pairs,
                             const dyd_index_list *sites) {
  search s = {.st = DYD_OK};
  region_lists all = {0, sites->count, 0, pairs->count};
  dyd_bbox c = *box;
  s.site = dyd_alloc(sites->count, sizeof *s.site);
  s.in = dyd_alloc(sites->count, sizeof *s.in);
  if (!s.site || !s.in || !dyd_reserve((void **)&s.list, &s.list_cap, sites->count, sizeof *s.list) ||
      !dyd_reserve((void **)&s.pair, &s.pair_cap, pairs->count, sizeof *s.pair))
    s.st = DYD_E_NOMEM;
  if (s.st == DYD_OK) {
    region_load(&s, pd, pairs, sites);
    region_shrink(&c, &s, &all);
  }
  if (s.st == DYD_OK) {
    *any = s.any;
    if (s.any) *box = c;
  }
  free(s.pair);
  free(s.list);
  free(s.in);
  free(s.site);
  return s.st;
}
