/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pictures of plans: the points to measure with their ranks, pairs by the points that decide them. */
#include "base/alloc.h"
#include "base/index.h"
#include "picture/picture.h"

#include <stdlib.h>
#include <string.h>

/* By quarters of the ranks, then pairs that stay undecided, then decided ones; distinct for all kinds of sight, and in
 * grey. */
static const struct {
  unsigned rgb;
  double on, off, width;
} dress[DYD_PLAN_CLASSES] = {{0xd55e00, 0, 0, 1.8}, {0xe69f00, 7, 2, 1.6},   {0x56b4e9, 3, 2, 1.6},
                             {0x004c80, 1, 2, 1.6}, {0x333333, 0.2, 2.2, 1}, {0xc8c8c8, 0, 0, 0.7}};

/* The quarter of row k, from 0. */
static int quarter_of(const dyd_plan_dress *d, size_t k) {
  return (int)(DYD_PLAN_QUARTERS * k / d->rows);
}

dyd_status dyd_plan_dress_init(dyd_plan_dress *d, const dyd_survey *plan, size_t sites) {
  *d = (dyd_plan_dress){.plan = plan};
  if (!DYD_ZEROED(d->rank, sites + 1) || !DYD_NEW(d->rgb, sites)) return DYD_E_NOMEM;
  d->rows = dyd_survey_rows(&d->row, plan);
  d->pairs = dyd_survey_pairs(&d->pair, plan);
  for (size_t i = 0; i < sites; i++) d->rgb[i] = 0xd8d8d8;
  for (size_t k = 0; k < d->rows; k++) {
    d->rank[d->row[k].site] = k + 1;
    d->rgb[d->row[k].site] = dress[quarter_of(d, k)].rgb;
  }
  return DYD_OK;
}

void dyd_plan_dress_clear(dyd_plan_dress *d) {
  dyd_free_all(d->rank, d->rgb);
}

static const dyd_survey_pair *plan_pair(const dyd_plan_dress *d, const dyd_pair *p) {
  return dyd_find_two(p, d->pair, d->pairs, sizeof *d->pair);
}

int dyd_plan_class(const dyd_plan_dress *d, const dyd_pair *p) {
  if (p->status == DYD_LEGAL) return DYD_PLAN_LEGAL;
  const dyd_survey_pair *found = plan_pair(d, p);
  return found && found->row < d->rows ? quarter_of(d, found->row) : DYD_PLAN_LEFT;
}

void dyd_plan_stroke(dyd_canvas *c, const dyd_plan_dress *d, const dyd_view *v, const dyd_engine *e,
                     const dyd_pair *p) {
  char text[80] = "legal";
  const int class = dyd_plan_class(d, p);
  if (class < DYD_PLAN_QUARTERS)
    snprintf(text, sizeof text, "decided by point %zu of the plan", plan_pair(d, p)->row + 1);
  else if (class == DYD_PLAN_LEFT)
    snprintf(text, sizeof text, "not decided by the plan");
  dyd_picture_name_pair(c, e, p->i, p->j, text);
  dyd_picture_stroke(c, dress[class].rgb, v->line * dress[class].width, dress[class].on, dress[class].off);
}

/* The ranks of a quarter: first to last; false: none. */
static bool quarter_ranks(size_t *first, size_t *last, const dyd_plan_dress *d, int quarter) {
  *first = *last = 0;
  for (size_t k = 0; k < d->rows; k++)
    if (quarter_of(d, k) == quarter) *first = *first ? *first : k + 1, *last = k + 1;
  return *first;
}

void dyd_plan_legend(dyd_legend *l, const dyd_plan_dress *d) {
  const dyd_survey_result *of = dyd_survey_get(d->plan);
  char text[160];
  for (int k = 0; k < DYD_PLAN_CLASSES; k++) {
    size_t first = 0, last = 0;
    if (k < DYD_PLAN_QUARTERS ? !quarter_ranks(&first, &last, d, k) : !d->shown[k]) continue;
    if (k == DYD_PLAN_LEGAL)
      snprintf(text, sizeof text, "legal already: %zu", d->shown[k]);
    else if (k == DYD_PLAN_LEFT)
      snprintf(text, sizeof text, "not decided by the plan: %zu", d->shown[k]);
    else if (first == last)
      snprintf(text, sizeof text, "point %zu, decides %zu", first, d->shown[k]);
    else
      snprintf(text, sizeof text, "points %zu to %zu, decide %zu", first, last, d->shown[k]);
    dyd_legend_line(l, dress[k].rgb, dress[k].on, dress[k].off, text);
  }
  snprintf(text, sizeof text, "labels: rank: point; %zu points to measure, %zu of %zu undecided pairs stay so%s",
           d->rows, of->left, of->open, of->cut ? "; the plan is not finished" : "");
  dyd_legend_text(l, text);
}

/* ---- the plane ---- */

typedef struct plan_drawing {
  const dyd_result *r;
  dyd_view view;
  dyd_plan_dress dress;
  dyd_site_marks marks;
} plan_drawing;

static void plan_inside(dyd_canvas *c, void *context) {
  plan_drawing *g = context;
  for (int class = DYD_PLAN_CLASSES; class --;)
    for (size_t k = 0; k < g->r->pairs.count; k++) {
      const dyd_pair *p = &g->r->pairs.item[k];
      double z[2][2];
      if (dyd_plan_class(&g->dress, p) != class || !dyd_view_line(z, &g->view, g->r, p->i, p->j)) continue;
      g->dress.shown[class]++;
      dyd_canvas_move(c, z[0][0], z[0][1]);
      dyd_canvas_line(c, z[1][0], z[1][1]);
      dyd_plan_stroke(c, &g->dress, &g->view, g->r->engine, p);
    }
  dyd_site_marks_draw(&g->marks, c, &g->view);
}

static void plan_legend(dyd_canvas *c, void *context) {
  const plan_drawing *g = context;
  dyd_legend l;
  dyd_legend_begin(&l, c, &g->view);
  dyd_plan_legend(&l, &g->dress);
  dyd_legend_crowd(&l, &g->marks);
}

dyd_status dyd_plan_picture(const dyd_output *o) {
  const dyd_result *r = o->what;
  plan_drawing g = {.r = r, .marks = dyd_site_marks_of(r->pd, r->engine, DYD_PICTURE_BAND)};
  g.marks.plan = &g.dress;
  dyd_status st = dyd_plan_dress_init(&g.dress, r->survey, r->count);
  if (st == DYD_OK) st = dyd_view_of(&g.view, o, &r->pairs);
  if (st == DYD_OK) st = dyd_view_write(o, &g.view, "plan of measurements", plan_inside, plan_legend, &g);
  dyd_plan_dress_clear(&g.dress);
  return st;
}
