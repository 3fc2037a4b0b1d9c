/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of a nearest-site query: the place, which points are surely, possibly and not nearest to it, and the two
 * distances that decide it.
 *
 * For a place c in the rectangle Q no point lies nearer than m = min_k ds(Q, R_k), and one lies within M = min_k dl(Q,
 * R_k), where ds and dl are the least and largest distances of points of Q and R_k. So all that is within m of Q is
 * surely free of points, and the nearest point surely is within M of Q. Both are discs where Q is a point. */
#include "io/decimal.h"
#include "picture/picture.h"
#include <math.h>

#define FREE 0xcfe4f3
#define SURE 0x0072b2
#define POSSIBLE 0xd55e00
#define NOT 0xffffff
typedef struct nearest_drawing {
  const dyd_delaunay *pd;
  const dyd_sites *sites;
  const dyd_nearest_answer *answer;
  const dyd_engine *engine;
  dyd_view view;
  double place[4], near, far; /* Q, m, M */
  size_t count;               /* sites that stand for themselves */
  bool others;                /* some that are surely not nearest are drawn */
} nearest_drawing;

/* ---- distances ---- */

static double least_distance(const double a[4], const double b[4]) {
  double x = fmax(fmax(b[0] - a[1], a[0] - b[1]), 0), y = fmax(fmax(b[2] - a[3], a[2] - b[3]), 0);
  return hypot(x, y);
}

static double largest_distance(const double a[4], const double b[4]) {
  return hypot(fmax(b[1] - a[0], a[1] - b[0]), fmax(b[3] - a[2], a[3] - b[2]));
}

static void find_distances(nearest_drawing *g) {
  g->near = g->far = INFINITY;
  for (size_t i = 0; i < dyd_sites_count(g->sites); i++) {
    double b[4];
    if (dyd_delaunay_alias(g->pd, (uint32_t)i) != i) continue;
    dyd_sites_get_d(b, g->sites, i);
    g->near = fmin(g->near, least_distance(g->place, b));
    g->far = fmin(g->far, largest_distance(g->place, b));
    g->count++;
  }
}

/* The larger disc in the middle, with its surroundings: some neighbours, unless that would make it too small. */
static dyd_status nearest_view(nearest_drawing *g, dyd_error *err) {
  double far = g->count ? g->far : 0, spacing = dyd_view_spacing(g->pd, NULL, NULL), box[4];
  double reach = fmax(2.2 * far, fmin(1.5 * spacing, 12 * far));
  if (reach == 0) reach = spacing > 0 ? 1.5 * spacing : 1;
  for (int k = 0; k < 4; k++) box[k] = g->place[k] + (k & 1 ? reach : -reach);
  return dyd_view_fit(&g->view, box, spacing, err);
}

/* ---- drawing ---- */

/* What is within `reach` of the place: a rectangle with round corners. */
static void around_path(dyd_canvas *c, const nearest_drawing *g, double reach) {
  const double quarter = acos(0.0);
  double r = reach * g->view.scale;
  double x[2] = {dyd_view_x(&g->view, g->place[0]), dyd_view_x(&g->view, g->place[1])};
  double y[2] = {dyd_view_y(&g->view, g->place[3]), dyd_view_y(&g->view, g->place[2])};
  for (int k = 0; k < 4; k++)
    dyd_canvas_arc(c, x[k == 0 || k == 3], y[k == 0 || k == 1], r, k * quarter, (k + 1) * quarter);
  dyd_canvas_close(c);
}

static void nearest_areas(dyd_canvas *c, const nearest_drawing *g) {
  around_path(c, g, g->far);
  dyd_picture_fill(c, DYD_PICTURE_BAND);
  if (!(g->near > 0)) return;
  around_path(c, g, g->near);
  dyd_picture_fill(c, FREE);
}

static void nearest_circles(dyd_canvas *c, const nearest_drawing *g) {
  around_path(c, g, g->far);
  dyd_picture_stroke(c, 0x222222, 1.5, 0, 0);
  if (!(g->near > 0)) return;
  around_path(c, g, g->near);
  dyd_picture_stroke(c, 0x222222, 1.5, 4, 2.5);
}

/* Calls for every site that is drawn, those that are possibly nearest last (first: the other way round). */
typedef void (*nearest_visit)(dyd_canvas *c, nearest_drawing *g, dyd_numbers *l, const double box[4], size_t i,
                              bool found);

static void nearest_each(dyd_canvas *c, nearest_drawing *g, dyd_numbers *l, bool first, nearest_visit visit) {
  const dyd_index_list *list = g->answer->found; /* ascending */
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = 0, at = 0; i < dyd_sites_count(g->sites); i++) {
      double b[4];
      while (at < list->count && list->item[at] < i) at++;
      bool found = at < list->count && list->item[at] == i;
      if (dyd_delaunay_alias(g->pd, (uint32_t)i) != i || found != (first ? !pass : pass)) continue;
      dyd_sites_get_d(b, g->sites, i);
      if (dyd_view_sees(&g->view, b)) visit(c, g, l, b, i, found);
    }
}

static void nearest_mark_site(dyd_canvas *c, nearest_drawing *g, dyd_numbers *l, const double box[4], size_t i,
                              bool found) {
  dyd_picture_marked(c, &g->view, box, g->engine, i, !found ? NOT : g->answer->sure ? SURE : POSSIBLE);
  g->others = g->others || !found;
  if (l->taken) dyd_numbers_keep_off(l, box);
}

static void nearest_number(dyd_canvas *c, nearest_drawing *g, dyd_numbers *l, const double box[4], size_t i,
                           bool found) {
  dyd_numbers_put(l, c, box, found ? 18 : 14, g->engine, i);
}

static void draw_ways(dyd_canvas *c, const nearest_drawing *g) {
  double place[2], site[2];
  dyd_view_middle(place, &g->view, g->place);
  for (size_t k = 0; k < g->answer->found->count; k++) {
    double b[4];
    dyd_sites_get_d(b, g->sites, g->answer->found->item[k]);
    dyd_view_middle(site, &g->view, b);
    dyd_canvas_move(c, place[0], place[1]);
    dyd_canvas_line(c, site[0], site[1]);
    dyd_picture_stroke(c, 0x222222, 1, g->answer->sure ? 0 : 4, g->answer->sure ? 0 : 4);
  }
}

/* A cross; around it the rectangle, where that can be seen. */
static void draw_place(dyd_canvas *c, const nearest_drawing *g) {
  const dyd_view *v = &g->view;
  double x0 = dyd_view_x(v, g->place[0]), x1 = dyd_view_x(v, g->place[1]), y0 = dyd_view_y(v, g->place[3]),
         y1 = dyd_view_y(v, g->place[2]), x = x0 / 2 + x1 / 2, y = y0 / 2 + y1 / 2;
  if (fmax(x1 - x0, y1 - y0) > 4) {
    dyd_canvas_box(c, x0, y0, x1 - x0, y1 - y0);
    dyd_picture_stroke(c, 0, 1.5, 1, 2);
  }
  for (int halo = 1; halo >= 0; halo--) {
    for (int k = -1; k <= 1; k += 2) {
      dyd_canvas_move(c, x - 8, y - 8 * k);
      dyd_canvas_line(c, x + 8, y + 8 * k);
    }
    if (!halo) dyd_canvas_name(c, "place", "the place asked about");
    dyd_picture_stroke(c, halo ? 0xffffff : 0, halo ? 5 : 2.5, 0, 0);
  }
}

static void nearest_legend(dyd_canvas *c, void *context) {
  const nearest_drawing *g = context;
  char text[240], lo[DYD_DECIMAL_SIZE], hi[DYD_DECIMAL_SIZE];
  dyd_legend l;
  dyd_legend_begin(&l, c, &g->view);
  if (g->answer->found->count)
    dyd_legend_patch(&l, g->answer->sure ? SURE : POSSIBLE,
                     g->answer->sure ? "surely nearest to \303\227" : "possibly nearest to \303\227");
  if (g->others) dyd_legend_patch(&l, NOT, "surely not nearest");
  if (g->count && g->near > 0) dyd_legend_patch(&l, FREE, "surely free of points");
  if (g->count && g->near < g->far) dyd_legend_patch(&l, DYD_PICTURE_BAND, "the nearest is in here");
  if (g->count == 0) {
    dyd_legend_text(&l, "there are no points");
    return;
  }
  dyd_decimal_directed(lo, g->near, 6, DYD_DOWN);
  dyd_decimal_directed(hi, g->far, 6, DYD_UP);
  if (g->answer->sure)
    snprintf(text, sizeof text, "%zu points, number %zu is surely nearest, about %s away (at most %s)", g->count,
             dyd_engine_row(g->engine, g->answer->found->item[0]), lo, hi);
  else
    snprintf(text, sizeof text, "%zu points, %zu possibly nearest, outcome %s; the nearest is about %s to %s away",
             g->count, g->answer->found->count, dyd_outcome_text(g->answer->outcome), lo, hi);
  dyd_legend_text(&l, text);
}

static void nearest_inside(dyd_canvas *c, void *context) {
  nearest_drawing *g = context;
  dyd_numbers labels = {0};
  bool numbers = g->view.apart >= 28 && dyd_numbers_init(&labels, &g->view);
  if (g->count) nearest_areas(c, g);
  nearest_each(c, g, &labels, false, nearest_mark_site);
  if (g->count) nearest_circles(c, g);
  draw_ways(c, g);
  draw_place(c, g);
  if (numbers) dyd_numbers_keep_off(&labels, g->place);
  if (numbers) nearest_each(c, g, &labels, true, nearest_number);
  dyd_numbers_clear(&labels);
}

dyd_status dyd_nearest_picture(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  nearest_drawing g = {.pd = n->pd, .sites = dyd_delaunay_sites(n->pd), .answer = n->answer[0], .engine = n->engine};
  dyd_rect_get_d(g.place, g.answer->at);
  find_distances(&g);
  dyd_status st = nearest_view(&g, o->err);
  return st == DYD_OK ? dyd_view_write(o, &g.view, "nearest points", nearest_inside, nearest_legend, &g) : st;
}
