/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of a nearest-site query: the place, which points are surely, possibly and not nearest to it, and the two
 * distances that decide it.
 *
 * For a place c in the rectangle Q no point lies nearer than m = min_k ds(Q, R_k), and one lies within M = min_k dl(Q,
 * R_k), where ds and dl are the least and largest distances of points of Q and R_k. So all that is within m of Q is
 * surely free of points, and the nearest point surely is within M of Q. Both are discs where Q is a point. */
#include "picture/picture.h"
#include <math.h>

#define FREE 0xcfe4f3
#define SURE 0x0072b2
#define POSSIBLE 0xd55e00
#define NOT 0xffffff
/* More sites than these in the view are not numbered, unless they are possibly nearest. */
enum { MOST_NUMBERS = 60 };

typedef struct nearest_drawing {
  const dyd_delaunay *pd;
  const dyd_sites *sites;
  const dyd_nearest_answer *answer;
  dyd_view view;
  double place[4], near, far; /* Q, m, M */
  size_t count;               /* sites that stand for themselves */
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
  double far = g->count ? g->far : 0, spacing = dyd_view_spacing(g->pd, NULL), box[4];
  double reach = fmax(2.2 * far, fmin(1.5 * spacing, 12 * far));
  if (reach == 0) reach = spacing > 0 ? 1.5 * spacing : 1;
  for (int k = 0; k < 4; k++) box[k] = g->place[k] + (k & 1 ? reach : -reach);
  return dyd_view_fit(&g->view, box, spacing, err);
}

/* ---- drawing ---- */

/* What is within `reach` of the place: a rectangle with round corners. */
static void around_path(cairo_t *cr, const nearest_drawing *g, double reach) {
  const double quarter = acos(0.0);
  double r = reach * g->view.scale;
  double x[2] = {dyd_view_x(&g->view, g->place[0]), dyd_view_x(&g->view, g->place[1])};
  double y[2] = {dyd_view_y(&g->view, g->place[3]), dyd_view_y(&g->view, g->place[2])};
  cairo_new_path(cr);
  for (int k = 0; k < 4; k++)
    cairo_arc(cr, x[k == 0 || k == 3], y[k == 0 || k == 1], r, k * quarter, (k + 1) * quarter);
  cairo_close_path(cr);
}

static void nearest_areas(cairo_t *cr, const nearest_drawing *g) {
  around_path(cr, g, g->far);
  dyd_picture_fill(cr, DYD_PICTURE_BAND);
  if (!(g->near > 0)) return;
  around_path(cr, g, g->near);
  dyd_picture_fill(cr, FREE);
}

static void nearest_circles(cairo_t *cr, const nearest_drawing *g) {
  around_path(cr, g, g->far);
  dyd_picture_stroke(cr, 0x222222, 1.5, 0, 0);
  if (!(g->near > 0)) return;
  around_path(cr, g, g->near);
  dyd_picture_stroke(cr, 0x222222, 1.5, 4, 2.5);
}

static bool is_seen(const dyd_view *v, const double b[4]) {
  return b[0] <= v->left + v->width / v->scale && b[1] >= v->left && b[3] >= v->top - v->height / v->scale &&
         b[2] <= v->top;
}

/* The others first, so that those that are possibly nearest lie on top. */
static void nearest_sites(cairo_t *cr, const nearest_drawing *g, bool found) {
  const dyd_index_list *l = g->answer->found; /* ascending */
  size_t seen = 0;
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = 0, at = 0; i < dyd_sites_count(g->sites); i++) {
      double b[4];
      while (at < l->count && l->item[at] < i) at++;
      bool is_found = at < l->count && l->item[at] == i;
      if (dyd_delaunay_alias(g->pd, (uint32_t)i) != i || is_found != found) continue;
      dyd_sites_get_d(b, g->sites, i);
      if (!is_seen(&g->view, b)) continue;
      if (!pass)
        seen++;
      else if (found || seen <= MOST_NUMBERS)
        dyd_picture_numbered(cr, &g->view, b, !found ? NOT : g->answer->sure ? SURE : POSSIBLE, i);
      else
        dyd_picture_marked(cr, &g->view, b, NOT);
    }
}

static void draw_ways(cairo_t *cr, const nearest_drawing *g) {
  double place[2], site[2];
  dyd_view_middle(place, &g->view, g->place);
  for (size_t k = 0; k < g->answer->found->count; k++) {
    double b[4];
    dyd_sites_get_d(b, g->sites, g->answer->found->item[k]);
    cairo_new_path(cr);
    dyd_view_middle(site, &g->view, b);
    cairo_move_to(cr, place[0], place[1]);
    cairo_line_to(cr, site[0], site[1]);
    dyd_picture_stroke(cr, 0x222222, 1, g->answer->sure ? 0 : 4, g->answer->sure ? 0 : 4);
  }
}

/* A cross; around it the rectangle, where that can be seen. */
static void draw_place(cairo_t *cr, const nearest_drawing *g) {
  const dyd_view *v = &g->view;
  double x0 = dyd_view_x(v, g->place[0]), x1 = dyd_view_x(v, g->place[1]), y0 = dyd_view_y(v, g->place[3]),
         y1 = dyd_view_y(v, g->place[2]), x = x0 / 2 + x1 / 2, y = y0 / 2 + y1 / 2;
  if (fmax(x1 - x0, y1 - y0) > 4) {
    cairo_new_path(cr);
    cairo_rectangle(cr, x0, y0, x1 - x0, y1 - y0);
    dyd_picture_stroke(cr, 0, 1.5, 1, 2);
  }
  for (int halo = 1; halo >= 0; halo--) {
    cairo_new_path(cr);
    for (int k = -1; k <= 1; k += 2) {
      cairo_move_to(cr, x - 8, y - 8 * k);
      cairo_line_to(cr, x + 8, y + 8 * k);
    }
    dyd_picture_stroke(cr, halo ? 0xffffff : 0, halo ? 5 : 2.5, 0, 0);
  }
}

static void nearest_legend(cairo_t *cr, void *context) {
  const nearest_drawing *g = context;
  double y = dyd_view_legend(&g->view), x = 30;
  char text[160];
  if (g->answer->sure)
    dyd_picture_entry(cr, &x, y, SURE, true, 0, 0, "surely nearest to \303\227");
  else
    dyd_picture_entry(cr, &x, y, POSSIBLE, true, 0, 0, "possibly nearest to \303\227");
  dyd_picture_entry(cr, &x, y, NOT, true, 0, 0, "surely not nearest");
  dyd_picture_entry(cr, &x, y, FREE, true, 0, 0, "surely free of points");
  dyd_picture_entry(cr, &x, y, DYD_PICTURE_BAND, true, 0, 0, "the nearest is in here");
  dyd_picture_scale(cr, &g->view, y);
  if (g->answer->sure)
    snprintf(text, sizeof text, "%zu points, number %u is surely nearest", g->count,
             (unsigned)g->answer->found->item[0]);
  else
    snprintf(text, sizeof text, "%zu points, %zu possibly nearest, outcome %s", g->count, g->answer->found->count,
             dyd_outcome_text(g->answer->outcome));
  dyd_picture_text(cr, 30, y + DYD_PICTURE_ROW + 5, 0, 14, g->count ? text : "there are no points");
}

static void nearest_inside(cairo_t *cr, void *context) {
  const nearest_drawing *g = context;
  if (g->count) nearest_areas(cr, g);
  nearest_sites(cr, g, false);
  nearest_sites(cr, g, true);
  if (g->count) nearest_circles(cr, g);
  draw_ways(cr, g);
  draw_place(cr, g);
}

dyd_status dyd_nearest_picture(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  nearest_drawing g = {.pd = n->pd, .sites = dyd_delaunay_sites(n->pd), .answer = n->answer[0]};
  dyd_rect_get_d(g.place, g.answer->at);
  find_distances(&g);
  dyd_status st = nearest_view(&g, o->err);
  return st == DYD_OK ? dyd_view_write(o, &g.view, nearest_inside, nearest_legend, &g) : st;
}
