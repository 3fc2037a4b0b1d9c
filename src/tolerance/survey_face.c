/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The plan of one undecided face. What happens in it depends on its own sites alone [LOC-1], so each try is a
 * triangulation of these: greedily the site that leaves fewest of its targets open, then whoever is not needed goes.
 * Whether the plan is enough is seen on all sites in the end. */
#include "base/alloc.h"
#include "base/flag.h"
#include "base/index.h"
#include "tolerance/survey.h"

#include <stdlib.h>
#include <string.h>

/* Sites and targets by their numbers in the face; measured[k]: how it is tried. */
typedef struct face_try {
  dyd_survey *s;
  dyd_index_list sites;
  dyd_pair *target;
  size_t targets;
  bool *measured;
  uint32_t *order; /* those chosen here */
  size_t chosen;
} face_try;

uint32_t dyd_survey_number_in(const dyd_index_list *sites, uint32_t site) {
  const uint32_t *at = bsearch(&site, sites->item, sites->count, sizeof site, dyd_compare_index);
  return at ? (uint32_t)(at - sites->item) : DYD_NONE;
}

/* How many targets are open; open[k] (may be NULL): of how many it is an end. */
static dyd_status try_face(size_t *open_pairs, size_t *open, const face_try *f) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_rect r;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = f->s->options.cancel};
  if (dyd_flag_is_set(o.cancel)) return DYD_CANCELLED;
  dyd_rect_init(&r);
  dyd_status st = dyd_sites_new(&sites);
  for (size_t k = 0; k < f->sites.count && st == DYD_OK; k++) {
    st = dyd_survey_rect(&r, f->s, f->sites.item[k], f->measured[k]);
    if (st == DYD_OK) st = dyd_sites_add_rect(sites, &r);
  }
  if (st == DYD_OK) st = dyd_delaunay_new(&pd, sites, &o, NULL);
  if (st == DYD_CAPPED) st = DYD_OK;
  *open_pairs = 0;
  if (open) memset(open, 0, f->sites.count * sizeof *open);
  for (size_t k = 0; k < f->targets && st == DYD_OK; k++) {
    if (!dyd_survey_is_open(pd, &f->target[k])) continue;
    ++*open_pairs;
    if (open) open[f->target[k].i]++, open[f->target[k].j]++;
  }
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  dyd_rect_clear(&r);
  return st;
}

static bool can_be_measured(const face_try *f, size_t k) {
  return !f->measured[k] && mpq_sgn(f->s->site[f->sites.item[k]].half) > 0;
}

static double cost_of(const face_try *f, size_t k) {
  return f->s->options.cost ? f->s->options.cost[f->sites.item[k]] : 1;
}

/* The site that decides most for its cost; where no single one decides anything, an end of most open pairs. */
static dyd_status best_site(size_t *best, const face_try *f, size_t open_pairs, const size_t *open) {
  double most = 0;
  size_t fallback = f->sites.count;
  *best = f->sites.count;
  for (size_t k = 0; k < f->sites.count; k++) {
    size_t now;
    if (!can_be_measured(f, k)) continue;
    if (fallback == f->sites.count || (double)open[k] * cost_of(f, fallback) > (double)open[fallback] * cost_of(f, k))
      fallback = k;
    f->measured[k] = true;
    dyd_status st = try_face(&now, NULL, f);
    f->measured[k] = false;
    if (st != DYD_OK) return st;
    double gain = ((double)open_pairs - (double)now) / cost_of(f, k);
    if (gain > most) most = gain, *best = k;
  }
  if (*best == f->sites.count) *best = fallback;
  return DYD_OK;
}

static dyd_status choose_sites(face_try *f, size_t *open) {
  size_t open_pairs;
  dyd_status st = try_face(&open_pairs, open, f);
  while (st == DYD_OK && open_pairs) {
    size_t best;
    st = best_site(&best, f, open_pairs, open);
    if (st != DYD_OK || best == f->sites.count) return st;
    f->measured[best] = true;
    f->order[f->chosen++] = (uint32_t)best;
    st = try_face(&open_pairs, open, f);
  }
  return st;
}

/* Those chosen, the dearest first, of equal cost the first chosen, which knew least of the others. */
static void order_to_drop(uint32_t *dear, const face_try *f) {
  for (size_t q = 0; q < f->chosen; q++) {
    size_t at = q;
    for (; at && cost_of(f, dear[at - 1]) < cost_of(f, f->order[q]); at--) dear[at] = dear[at - 1];
    dear[at] = f->order[q];
  }
}

static dyd_status drop_sites(face_try *f) {
  size_t wanted, open_pairs, kept = 0;
  uint32_t *dear = dyd_alloc(f->chosen, sizeof *dear);
  dyd_status st = dear ? try_face(&wanted, NULL, f) : DYD_E_NOMEM;
  if (st == DYD_OK) order_to_drop(dear, f);
  for (size_t q = 0; q < f->chosen && st == DYD_OK; q++) {
    f->measured[dear[q]] = false;
    st = try_face(&open_pairs, NULL, f);
    f->measured[dear[q]] = open_pairs > wanted;
  }
  for (size_t q = 0; q < f->chosen; q++)
    if (f->measured[f->order[q]]) f->order[kept++] = f->order[q];
  f->chosen = kept;
  free(dear);
  return st;
}

/* The rows, in the order chosen, with what each decides in the face. */
static dyd_status write_rows(face_try *f) {
  dyd_survey *s = f->s;
  if (!f->chosen) return DYD_OK;
  if (!dyd_reserve((void **)&s->face, &s->face_cap, s->faces + 1, sizeof *s->face)) return DYD_E_NOMEM;
  dyd_face_rows *rows = &s->face[s->faces++];
  *rows = (dyd_face_rows){.row = dyd_alloc(f->chosen, sizeof *rows->row)};
  if (!rows->row) return DYD_E_NOMEM;
  for (size_t q = 0; q < f->chosen; q++) f->measured[f->order[q]] = false;
  size_t before, after;
  dyd_status st = try_face(&before, NULL, f);
  for (size_t q = 0; q < f->chosen && st == DYD_OK; q++) {
    f->measured[f->order[q]] = true;
    s->site[f->sites.item[f->order[q]]].chosen = true;
    st = try_face(&after, NULL, f);
    rows->row[rows->count++] = (dyd_survey_row){f->sites.item[f->order[q]], 0, 0, before - after, 0};
    before = after;
  }
  return st;
}

/* Room for as many as have an end here. */
static bool make_targets(face_try *f) {
  size_t most = 0;
  for (size_t a = 0; a < f->sites.count; a++) most += f->s->first[f->sites.item[a] + 1] - f->s->first[f->sites.item[a]];
  f->target = dyd_alloc(most, sizeof *f->target);
  return f->target;
}

static void take_targets(face_try *f) {
  const dyd_survey *s = f->s;
  for (size_t a = 0; a < f->sites.count; a++)
    for (size_t k = s->first[f->sites.item[a]]; k < s->first[f->sites.item[a] + 1]; k++) {
      const dyd_pair *p = &s->target.item[s->at[k]];
      uint32_t j = p->i == f->sites.item[a] ? dyd_survey_number_in(&f->sites, p->j) : DYD_NONE;
      if (j != DYD_NONE) f->target[f->targets++] = (dyd_pair){(uint32_t)a, j, p->status};
    }
}

/* Room for n sites; measured as they are chosen now. *open gets room for n numbers. */
static dyd_status face_begin(face_try *f, size_t **open) {
  size_t n = f->sites.count;
  *open = calloc(n + 1, sizeof **open);
  f->measured = dyd_alloc(n, sizeof *f->measured);
  f->order = dyd_alloc(n, sizeof *f->order);
  if (!*open || !make_targets(f) || !f->measured || !f->order) return DYD_E_NOMEM;
  for (size_t k = 0; k < n; k++) f->measured[k] = f->s->site[f->sites.item[k]].chosen;
  take_targets(f);
  return DYD_OK;
}

static void face_end(face_try *f, size_t *open) {
  free(open);
  free(f->target);
  free(f->measured);
  free(f->order);
}

dyd_status dyd_survey_face(dyd_survey *s, const dyd_delaunay *pd, size_t face) {
  face_try f = {.s = s};
  bool outer;
  size_t *open = NULL;
  dyd_status st = dyd_delaunay_face(&f.sites, &outer, pd, face);
  if (st == DYD_OK) st = face_begin(&f, &open);
  if (st == DYD_OK && f.targets) st = choose_sites(&f, open);
  if (st == DYD_OK && f.targets) st = drop_sites(&f);
  if (st == DYD_OK && f.targets) st = write_rows(&f);
  face_end(&f, open);
  dyd_index_list_clear(&f.sites);
  return st;
}

dyd_status dyd_survey_face_needs(bool *needs, dyd_survey *s, const dyd_index_list *sites, uint32_t site) {
  face_try f = {.s = s, .sites = *sites};
  size_t *open = NULL, with, without;
  uint32_t k = dyd_survey_number_in(sites, site);
  *needs = false;
  dyd_status st = face_begin(&f, &open);
  if (st == DYD_OK) st = try_face(&with, NULL, &f);
  if (st == DYD_OK) {
    f.measured[k] = false;
    st = try_face(&without, NULL, &f);
    *needs = st == DYD_OK && without > with;
  }
  face_end(&f, open);
  return st;
}

dyd_status dyd_survey_face_open(size_t *open_pairs, dyd_survey *s, const dyd_index_list *sites) {
  face_try f = {.s = s, .sites = *sites};
  size_t *open = NULL;
  *open_pairs = 0;
  dyd_status st = face_begin(&f, &open);
  if (st == DYD_OK && f.targets) st = try_face(open_pairs, NULL, &f);
  face_end(&f, open);
  return st;
}
