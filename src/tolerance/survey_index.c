/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* In which faces and targets a site is, so that nobody looks through all of them. */
#include "base/alloc.h"
#include "base/index.h"
#include "delaunay/index_list.h"
#include "tolerance/survey.h"

#include <stdlib.h>

/* s->at: each target at its lower end and at its upper one. */
static dyd_status index_ends(dyd_survey *s) {
  const dyd_pair_list *t = &s->target;
  s->first = calloc(s->sites + 2, sizeof *s->first);
  s->at = dyd_alloc(2 * t->count, sizeof *s->at);
  if (!s->first || !s->at) return DYD_E_NOMEM;
  size_t *next =
      s->first + 1; /* where the next target of each site goes: when all are there, where those after begin */
  for (size_t k = 0; k < t->count; k++) next[t->item[k].i + 1]++, next[t->item[k].j + 1]++;
  for (size_t i = 0; i < s->sites; i++) next[i + 1] += next[i];
  for (size_t k = 0; k < t->count; k++) s->at[next[t->item[k].i]++] = k, s->at[next[t->item[k].j]++] = k;
  return DYD_OK;
}

dyd_status dyd_survey_index_targets(dyd_survey *s) {
  dyd_pair_list *t = &s->target;
  for (size_t k = 0; k < t->count; k++) {
    dyd_pair p = t->item[k];
    if (p.i > p.j) t->item[k] = (dyd_pair){p.j, p.i, p.status};
  }
  if (t->count) qsort(t->item, t->count, sizeof *t->item, dyd_compare_two);
  return index_ends(s);
}

/* ---- where to look ---- */

static bool is_of_owner(const dyd_survey_faces *open, size_t f, uint32_t site) {
  return open->owner[f] == DYD_NONE || open->owner[f] == site;
}

/* open.start[i + 1]: where the next face of site i goes; when all are there, where those of the next site begin. */
static dyd_status index_sites(dyd_survey_faces *open, size_t sites) {
  size_t total = 0;
  for (size_t f = 0; f < open->count; f++) total += open->face[f].count;
  open->start = calloc(sites + 2, sizeof *open->start);
  open->of = dyd_alloc(total, sizeof *open->of);
  if (!open->start || !open->of) return DYD_E_NOMEM;
  size_t *next = open->start + 1;
  for (size_t f = 0; f < open->count; f++)
    for (size_t k = 0; k < open->face[f].count; k++) {
      uint32_t i = open->face[f].item[k];
      next[i + 1] += is_of_owner(open, f, i);
    }
  for (size_t i = 0; i < sites; i++) next[i + 1] += next[i];
  for (size_t f = 0; f < open->count; f++)
    for (size_t k = 0; k < open->face[f].count; k++) {
      uint32_t i = open->face[f].item[k];
      if (is_of_owner(open, f, i)) open->of[next[i]++] = (uint32_t)f;
    }
  return DYD_OK;
}

/* A site, its possible neighbours without the plan, and the possible neighbours of all these with it: what the site can
 * change has an end among the former [LOC-4], and who can be in the way of that is mostly among the latter. */
static dyd_status find_those_near(dyd_index_list *out, const dyd_delaunay *pd, const dyd_delaunay *planned,
                                  uint32_t site) {
  dyd_index_list near = {0};
  size_t cap = 0;
  dyd_status st = dyd_delaunay_neighbours(&near, pd, site, DYD_TIE);
  if (st == DYD_OK) st = dyd_index_list_add(out, &cap, near.item, near.count);
  if (st == DYD_OK) st = dyd_index_list_add(out, &cap, &site, 1);
  for (size_t k = 0, first = out->count; k < first && st == DYD_OK; k++) {
    st = dyd_delaunay_neighbours(&near, planned, out->item[k], DYD_TIE);
    if (st == DYD_OK) st = dyd_index_list_add(out, &cap, near.item, near.count);
  }
  dyd_index_list_sort(out);
  dyd_index_list_clear(&near);
  return st;
}

/* Faces that are not large; *large, where there are others, and each of their sites. */
static dyd_status add_faces(bool *large, bool *is_in_large, dyd_survey_faces *open, const dyd_delaunay *pd) {
  bool outer;
  dyd_status st = DYD_OK;
  *large = false;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd) && st == DYD_OK; f++) {
    dyd_index_list *face = &open->face[open->count];
    st = dyd_delaunay_face(face, &outer, pd, f);
    if (st == DYD_OK && face->count <= DYD_SURVEY_LARGE) {
      open->owner[open->count++] = DYD_NONE;
      continue;
    }
    *large = true;
    for (size_t k = 0; k < face->count; k++) is_in_large[face->item[k]] = true;
    dyd_index_list_clear(face);
  }
  return st;
}

static dyd_status add_those_in_large(dyd_survey *s, const bool *is_in_large, const dyd_delaunay *pd) {
  dyd_delaunay *planned = NULL;
  dyd_sites *sites = NULL;
  dyd_status st = dyd_survey_triangulate(&planned, &sites, s, false);
  for (uint32_t i = 0; i < s->sites && st == DYD_OK; i++) {
    if (!is_in_large[i] || !s->site[i].chosen) continue;
    s->open.owner[s->open.count] = i;
    st = find_those_near(&s->open.face[s->open.count++], pd, planned, i);
  }
  dyd_delaunay_free(planned);
  dyd_sites_free(sites);
  return st;
}

dyd_status dyd_survey_index_faces(dyd_survey *s, const dyd_delaunay *pd) {
  dyd_survey_faces *open = &s->open;
  size_t most = dyd_delaunay_undecided_faces(pd) + s->sites + 1;
  bool large = false, *is_in_large = calloc(s->sites + 1, sizeof *is_in_large);
  open->face = calloc(most, sizeof *open->face);
  open->owner = dyd_alloc(most, sizeof *open->owner);
  dyd_status st = is_in_large && open->face && open->owner ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) st = add_faces(&large, is_in_large, open, pd);
  if (st == DYD_OK && large) st = add_those_in_large(s, is_in_large, pd);
  if (st == DYD_OK) st = index_sites(open, s->sites);
  free(is_in_large);
  return st;
}

void dyd_survey_index_clear(dyd_survey *s) {
  for (size_t f = 0; s->open.face && f < s->open.count; f++) dyd_index_list_clear(&s->open.face[f]);
  free(s->open.face);
  free(s->open.owner);
  free(s->open.start);
  free(s->open.of);
  free(s->first);
  free(s->at);
}
