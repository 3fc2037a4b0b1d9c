/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What each row of a plan decides after the rows before: they are measured one by one in a triangulation of all. Pairs
 * that a site has a say in are in a face with it, as faces are without the plan; only these are looked at again. */
#include "base/alloc.h"
#include "base/index.h"
#include "base/invariant.h"
#include "tolerance/survey.h"

#include <stdlib.h>
#include <string.h>

/* The triangulation so far; open[k]: is target k. */
typedef struct measuring {
  dyd_survey *s;
  dyd_sites *sites;
  dyd_delaunay *now;
  bool *open;
  size_t left;
} measuring;

static dyd_status measuring_begin(measuring *m) {
  dyd_survey *s = m->s;
  m->left = s->target.count;
  m->open = dyd_alloc(m->left, sizeof *m->open);
  if (!m->open) return DYD_E_NOMEM;
  memset(m->open, true, m->left * sizeof *m->open);
  for (size_t k = 0; k < s->rows; k++) s->site[s->row[k].site].chosen = false;
  return dyd_survey_triangulate(&m->now, &m->sites, s, false);
}

static void measuring_end(measuring *m) {
  for (size_t k = 0; k < m->s->rows; k++) m->s->site[m->s->row[k].site].chosen = true;
  dyd_delaunay_free(m->now);
  dyd_sites_free(m->sites);
  free(m->open);
}

static void look_at_face(measuring *m, const dyd_index_list *face) {
  const dyd_survey *s = m->s;
  for (size_t a = 0; a < face->count; a++)
    for (size_t k = s->first[face->item[a]]; k < s->first[face->item[a] + 1]; k++) {
      const dyd_pair *p = &s->target.item[k];
      if (!m->open[k] || dyd_survey_number_in(face, p->j) == DYD_NONE) continue;
      m->open[k] = dyd_survey_is_open(m->now, p);
      m->left -= !m->open[k];
    }
}

static dyd_status measure_site(measuring *m, uint32_t i) {
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = m->s->options.cancel};
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = dyd_survey_rect(&r, m->s, i, true);
  if (st == DYD_OK) st = dyd_sites_narrow(m->sites, i, &r);
  if (st == DYD_OK) st = dyd_delaunay_update(m->now, &i, 1, &o, m->s->err);
  dyd_rect_clear(&r);
  return st == DYD_CAPPED ? DYD_OK : st;
}

dyd_status dyd_survey_count_left(dyd_survey *s) {
  measuring m = {.s = s};
  if (!s->rows) return DYD_OK;
  dyd_status st = measuring_begin(&m);
  for (size_t k = 0; k < s->rows && st == DYD_OK; k++) {
    dyd_survey_row *row = &s->row[k];
    size_t before = m.left;
    st = measure_site(&m, row->site);
    for (size_t q = s->open.start[row->site]; q < s->open.start[row->site + 1] && st == DYD_OK; q++)
      look_at_face(&m, &s->open.face[s->open.of[q]]);
    row->decided = before - m.left;
    row->left = m.left;
  }
  DYD_INVARIANT(st != DYD_OK || m.left == s->left);
  measuring_end(&m);
  return st;
}
