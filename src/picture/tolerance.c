/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of tolerances: edges coloured by how much they bear, from what is lost first to what is lost last. */
#include "base/error.h"
#include "io/result.h"
#include "picture/picture.h"
#include <math.h>
#include <stdlib.h>

/* Of all edges, the quarter that dies first, and so on; told apart by all kinds of sight, and in grey. Then ties. */
enum { CLASSES = 4 };
static const struct {
  unsigned rgb;
  double on, off, width;
} bearing[CLASSES + 1] = {{0xd55e00, 3, 2, 1.4},
                          {0xe69f00, 6, 2, 1.2},
                          {0x56b4e9, 0, 0, 1.0},
                          {0x004c80, 0, 0, 1.4},
                          {0x6b6b6b, 0.2, 2.2, 1.0}};

typedef struct tolerance_drawing {
  const dyd_result *r;
  const dyd_tolerance_row *row;
  size_t rows;
  const dyd_tolerance *t;
  dyd_view view;
  double bound[CLASSES - 1]; /* from where on an edge belongs to the next class */
} tolerance_drawing;

static int compare_deaths(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static dyd_status find_classes(tolerance_drawing *g) {
  double *death = malloc((g->rows + 1) * sizeof *death);
  size_t count = 0;
  if (!death) return DYD_E_NOMEM;
  for (size_t k = 0; k < g->rows; k++)
    if (g->row[k].event == DYD_EVENT_DEATH) death[count++] = g->row[k].lo;
  qsort(death, count, sizeof *death, compare_deaths);
  for (int c = 0; c < CLASSES - 1; c++) g->bound[c] = count ? death[count * (size_t)(c + 1) / CLASSES] : 0;
  free(death);
  return DYD_OK;
}

/* -1: a birth, which is not drawn. */
static int class_of(const tolerance_drawing *g, const dyd_tolerance_row *row) {
  if (row->event == DYD_EVENT_BIRTH) return -1;
  if (row->event == DYD_EVENT_TIE) return CLASSES;
  int c = 0;
  while (c < CLASSES - 1 && row->lo >= g->bound[c]) c++;
  return c;
}

static void tolerance_edges(dyd_canvas *c, const tolerance_drawing *g, int class) {
  for (size_t k = 0; k < g->rows; k++) {
    double b[4], z[2][2];
    if (class_of(g, &g->row[k]) != class) continue;
    for (int e = 0; e < 2; e++) {
      dyd_sites_get_d(b, g->r->sites, e ? g->row[k].j : g->row[k].i);
      dyd_view_middle(z[e], &g->view, b);
    }
    if (dyd_clip_segment(z, g->view.frame))
      dyd_picture_line(c, z, bearing[class].rgb, g->view.line * bearing[class].width, bearing[class].on,
                       bearing[class].off);
  }
}

static void tolerance_inside(dyd_canvas *c, void *context) {
  const tolerance_drawing *g = context;
  for (int k = CLASSES; k >= 0; k--) tolerance_edges(c, g, k);
  for (size_t i = 0; i < g->r->count; i++) {
    double b[4];
    dyd_sites_get_d(b, g->r->sites, i);
    dyd_picture_site(c, &g->view, b, g->r->engine, i, DYD_PICTURE_BAND);
  }
}

static void tolerance_legend(dyd_canvas *c, void *context) {
  const tolerance_drawing *g = context;
  char text[200];
  double lo, hi;
  dyd_legend l;
  dyd_legend_begin(&l, c, &g->view);
  for (int k = 0; k < CLASSES; k++) {
    if (k == CLASSES - 1)
      snprintf(text, sizeof text, "%.2g or more", g->bound[k - 1]);
    else
      snprintf(text, sizeof text, "less than %.2g", g->bound[k]);
    dyd_legend_line(&l, bearing[k].rgb, bearing[k].on, bearing[k].off, text);
  }
  dyd_legend_line(&l, bearing[CLASSES].rgb, bearing[CLASSES].on, bearing[CLASSES].off, "tie");
  dyd_tolerance_whole(&lo, &hi, g->t);
  snprintf(text, sizeof text,
           "%zu points; edges by how far all may move before they may be lost; nothing changes below %.3g", g->r->count,
           lo);
  dyd_legend_text(&l, text);
}

static dyd_status tolerance_see(tolerance_drawing *g, dyd_error *err) {
  double all[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  if (g->r->window) {
    dyd_rect_get_d(all, g->r->window);
    if (!(all[0] < all[1] && all[2] < all[3])) return dyd_fail(err, DYD_E_ARG, "the window has no area");
  }
  for (size_t i = 0; i < g->r->count && !g->r->window; i++) {
    double b[4];
    dyd_status st = dyd_result_box(b, g->r, i, err);
    if (st != DYD_OK) return st;
    all[0] = fmin(all[0], b[0]), all[1] = fmax(all[1], b[1]);
    all[2] = fmin(all[2], b[2]), all[3] = fmax(all[3], b[3]);
  }
  if (g->r->count == 0) all[0] = all[1] = all[2] = all[3] = 0;
  dyd_status st = dyd_view_fit(&g->view, all, dyd_view_spacing(g->r->pd, g->r->window ? all : NULL), err);
  return st;
}

dyd_status dyd_tolerance_picture(const dyd_output *o) {
  const dyd_tolerance_result *what = o->what;
  tolerance_drawing g = {.r = what->result, .t = what->tolerance};
  g.rows = dyd_tolerance_rows(&g.row, g.t);
  dyd_status st = find_classes(&g);
  if (st == DYD_OK) st = tolerance_see(&g, o->err);
  return st == DYD_OK ? dyd_view_write(o, &g.view, "tolerance of the Delaunay triangulation", tolerance_inside,
                                       tolerance_legend, &g)
                      : st;
}
