/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Large faces. To try every site of one, as survey_face.c does, takes as many triangulations as it has sites, for each
 * row; so the ends of most open targets for their cost are measured one after the other, until it has fallen into small
 * faces, which are worked on with care. Whoever was not needed goes afterwards, as everywhere. */
#include "base/alloc.h"
#include "tolerance/survey.h"

#include <stdlib.h>

/* Of the sites that can be measured, one in so many is, before it is looked again at where faces are large. */
enum { SHARE = 16 };

typedef struct crowd_site {
  double worth; /* open targets that end there, for its cost */
  uint32_t site;
} crowd_site;

static int compare_worth(const void *a, const void *b) {
  const crowd_site *x = a, *y = b;
  if (x->worth != y->worth) return x->worth > y->worth ? -1 : 1;
  return (x->site > y->site) - (x->site < y->site);
}

static double worth_of(const dyd_measuring *m, uint32_t i) {
  return (double)m->degree[i] / (m->s->options.cost ? m->s->options.cost[i] : 1);
}

/* Marks sites of large faces at which open targets end and that can be measured. */
static dyd_status mark_crowd(bool *mark, const dyd_measuring *m) {
  dyd_index_list face = {0};
  bool outer;
  dyd_status st = DYD_OK;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(m->now) && st == DYD_OK; f++) {
    st = dyd_delaunay_face(&face, &outer, m->now, f);
    for (size_t k = 0; k < face.count && st == DYD_OK && face.count > DYD_SURVEY_LARGE; k++) {
      const dyd_survey_site *p = &m->s->site[face.item[k]];
      mark[face.item[k]] = m->degree[face.item[k]] && !p->chosen && mpq_sgn(p->half) > 0;
    }
  }
  dyd_index_list_clear(&face);
  return st;
}

/* They are moved to *crowd, and the marks taken away. */
static size_t list_crowd(crowd_site *crowd, bool *mark, const dyd_measuring *m) {
  size_t count = 0;
  for (uint32_t i = 0; i < m->s->sites; i++)
    if (mark[i]) {
      mark[i] = false;
      crowd[count++] = (crowd_site){worth_of(m, i), i};
    }
  if (count) qsort(crowd, count, sizeof *crowd, compare_worth);
  return count;
}

/* Measures the first ones, but for those that are by now worth less than the last of these was: their turn comes. */
static dyd_status measure_first(dyd_face_rows *rows, dyd_measuring *m, const crowd_site *crowd, size_t count) {
  size_t first = count / SHARE + 1 < count ? count / SHARE + 1 : count;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < first && st == DYD_OK; k++) {
    uint32_t i = crowd[k].site;
    if (worth_of(m, i) < crowd[first - 1].worth) continue;
    dyd_survey_row *row = &rows->row[rows->count++];
    *row = (dyd_survey_row){.site = i};
    m->s->site[i].chosen = true;
    st = dyd_measuring_draft(&row->decided, m, i);
  }
  return st;
}

static dyd_status measure_crowds(dyd_face_rows *rows, dyd_measuring *m) {
  const dyd_survey *s = m->s;
  bool *mark = calloc(s->sites + 1, sizeof *mark);
  crowd_site *crowd = dyd_alloc(s->sites, sizeof *crowd);
  rows->row = dyd_alloc(s->sites, sizeof *rows->row);
  dyd_status st = mark && crowd && rows->row ? DYD_OK : DYD_E_NOMEM;
  for (size_t count = 1; count && st == DYD_OK;) {
    st = mark_crowd(mark, m);
    count = list_crowd(crowd, mark, m);
    if (st == DYD_OK) st = measure_first(rows, m, crowd, count);
  }
  free(mark);
  free(crowd);
  return st;
}

dyd_status dyd_survey_crowds(dyd_measuring *m) {
  dyd_survey *s = m->s;
  if (!dyd_reserve((void **)&s->face, &s->face_cap, s->faces + 1, sizeof *s->face)) return DYD_E_NOMEM;
  dyd_face_rows rows = {0};
  dyd_status st = measure_crowds(&rows, m);
  if (rows.count)
    s->face[s->faces++] = rows;
  else
    free(rows.row);
  return st;
}
