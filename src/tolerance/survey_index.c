/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* In which faces and targets a site is, so that nobody looks through all of them. */
#include "base/alloc.h"
#include "base/index.h"
#include "tolerance/survey.h"

#include <stdlib.h>

dyd_status dyd_survey_index_targets(dyd_survey *s) {
  dyd_pair_list *t = &s->target;
  s->first = calloc(s->sites + 1, sizeof *s->first);
  if (!s->first) return DYD_E_NOMEM;
  for (size_t k = 0; k < t->count; k++) {
    dyd_pair p = t->item[k];
    if (p.i > p.j) t->item[k] = (dyd_pair){p.j, p.i, p.status};
  }
  if (t->count) qsort(t->item, t->count, sizeof *t->item, dyd_compare_two);
  for (size_t k = 0; k < t->count; k++) s->first[t->item[k].i + 1]++;
  for (size_t i = 0; i < s->sites; i++) s->first[i + 1] += s->first[i];
  return DYD_OK;
}

/* open.start: counts of faces first, then places that move to the end of each site's faces, then back to their start.
 */
static dyd_status index_sites(dyd_survey_faces *open, size_t sites) {
  size_t total = 0;
  for (size_t f = 0; f < open->count; f++) total += open->face[f].count;
  open->start = calloc(sites + 1, sizeof *open->start);
  open->of = dyd_alloc(total, sizeof *open->of);
  if (!open->start || !open->of) return DYD_E_NOMEM;
  for (size_t f = 0; f < open->count; f++)
    for (size_t k = 0; k < open->face[f].count; k++) open->start[open->face[f].item[k] + 1]++;
  for (size_t i = 0; i < sites; i++) open->start[i + 1] += open->start[i];
  for (size_t f = 0; f < open->count; f++)
    for (size_t k = 0; k < open->face[f].count; k++) open->of[open->start[open->face[f].item[k]]++] = (uint32_t)f;
  for (size_t i = sites; i > 0; i--) open->start[i] = open->start[i - 1];
  open->start[0] = 0;
  return DYD_OK;
}

dyd_status dyd_survey_index_faces(dyd_survey *s, const dyd_delaunay *pd) {
  dyd_survey_faces *open = &s->open;
  bool outer;
  dyd_status st = DYD_OK;
  open->count = dyd_delaunay_undecided_faces(pd);
  open->face = calloc(open->count + 1, sizeof *open->face);
  if (!open->face) return DYD_E_NOMEM;
  for (size_t f = 0; f < open->count && st == DYD_OK; f++) st = dyd_delaunay_face(&open->face[f], &outer, pd, f);
  return st == DYD_OK ? index_sites(open, s->sites) : st;
}

void dyd_survey_index_clear(dyd_survey *s) {
  for (size_t f = 0; s->open.face && f < s->open.count; f++) dyd_index_list_clear(&s->open.face[f]);
  free(s->open.face);
  free(s->open.start);
  free(s->open.of);
  free(s->first);
}
