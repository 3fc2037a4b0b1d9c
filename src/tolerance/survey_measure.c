/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sites are measured one by one in a triangulation of all; what each row of a plan decides after the rows before. A
 * pair whose status changes has an end at the site or at a possible neighbour of it [LOC-4]: only these are looked at.
 */
#include "base/alloc.h"
#include "base/invariant.h"
#include "tolerance/survey.h"

#include <stdlib.h>

dyd_status dyd_measuring_begin(dyd_measuring *m, dyd_survey *s) {
  *m = (dyd_measuring){.s = s};
  m->open = calloc(s->target.count + 1, sizeof *m->open);
  m->degree = calloc(s->sites + 1, sizeof *m->degree);
  if (!m->open || !m->degree) return DYD_E_NOMEM;
  dyd_status st = dyd_survey_triangulate(&m->now, &m->sites, s, false);
  for (size_t k = 0; k < s->target.count && st == DYD_OK; k++) {
    const dyd_pair *p = &s->target.item[k];
    m->open[k] = dyd_survey_is_open(m->now, p);
    if (m->open[k]) m->left++, m->degree[p->i]++, m->degree[p->j]++;
  }
  return st;
}

void dyd_measuring_end(dyd_measuring *m) {
  dyd_delaunay_free(m->now);
  dyd_sites_free(m->sites);
  free(m->open);
  free(m->degree);
}

static void note_decided(dyd_measuring *m, uint32_t i) {
  const dyd_survey *s = m->s;
  for (size_t q = s->first[i]; q < s->first[i + 1] && m->degree[i]; q++) {
    const dyd_pair *p = &s->target.item[s->at[q]];
    if (!m->open[s->at[q]] || dyd_survey_is_open(m->now, p)) continue;
    m->open[s->at[q]] = false;
    m->left--, m->degree[p->i]--, m->degree[p->j]--;
  }
}

/* Where there are more open pairs than can be stored, neighbours are not all listed. */
static void note_decided_near(dyd_measuring *m, uint32_t i, const dyd_index_list *near) {
  note_decided(m, i);
  for (size_t k = 0; k < near->count; k++) note_decided(m, near->item[k]);
  for (uint32_t k = 0; k < m->s->sites && dyd_delaunay_is_capped(m->now); k++) note_decided(m, k);
}

dyd_status dyd_measuring_site(size_t *decided, dyd_measuring *m, uint32_t i) {
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = m->s->options.cancel};
  dyd_index_list near = {0};
  size_t before = m->left;
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = dyd_survey_rect(&r, m->s, i, true);
  if (st == DYD_OK) st = dyd_delaunay_neighbours(&near, m->now, i, DYD_TIE);
  if (st == DYD_OK) st = dyd_sites_narrow(m->sites, i, &r);
  if (st == DYD_OK) st = dyd_delaunay_update(m->now, &i, 1, &o, m->s->err);
  if (st == DYD_CAPPED) st = DYD_OK;
  if (st == DYD_OK) note_decided_near(m, i, &near);
  *decided = before - m->left;
  dyd_index_list_clear(&near);
  dyd_rect_clear(&r);
  return st;
}

dyd_status dyd_measuring_draft(size_t *decided, dyd_measuring *m, uint32_t i) {
  dyd_survey *s = m->s;
  dyd_status st = dyd_measuring_site(decided, m, i);
  if (st != DYD_OK) return st;
  if (!dyd_reserve((void **)&s->draft.row, &s->draft_cap, s->draft.count + 1, sizeof *s->draft.row)) return DYD_E_NOMEM;
  s->draft.row[s->draft.count++] =
      (dyd_survey_row){i, dyd_survey_now(s, i), dyd_survey_needed(s, i), *decided, m->left};
  return DYD_OK;
}

dyd_status dyd_survey_count_left(dyd_survey *s) {
  dyd_measuring m;
  if (!s->rows) return DYD_OK;
  for (size_t k = 0; k < s->rows; k++) s->site[s->row[k].site].chosen = false;
  dyd_status st = dyd_measuring_begin(&m, s);
  for (size_t k = 0; k < s->rows && st == DYD_OK; k++) {
    st = dyd_measuring_site(&s->row[k].decided, &m, s->row[k].site);
    s->row[k].left = m.left;
  }
  DYD_INVARIANT(st != DYD_OK || m.left == s->left);
  for (size_t k = 0; k < s->rows; k++) s->site[s->row[k].site].chosen = true;
  dyd_measuring_end(&m);
  return st;
}
