/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of tolerances: edges coloured by how much they bear, from what is lost first to what is lost last. */
#include "base/error.h"
#include "base/index.h"
#include "io/decimal.h"
#include "picture/picture.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
  bool seen[CLASSES + 1];    /* was drawn */
  dyd_site_marks marks;
} tolerance_drawing;

static const char *rounded(char out[DYD_DECIMAL_SIZE], double x, int digits, dyd_round to) {
  dyd_decimal_directed(out, x, digits, to);
  return out;
}

/* The least double that is not below x cut to two digits: a double is below it iff it is below these digits. */
static double two_digits(double x) {
  char cut[DYD_DECIMAL_SIZE], again[DYD_DECIMAL_SIZE];
  if (!(x > 0 && isfinite(x))) return x;
  double at = strtod(rounded(cut, x, 2, DYD_DOWN), NULL);
  return strcmp(rounded(again, at, 2, DYD_DOWN), cut) == 0 ? at : nextafter(at, HUGE_VAL);
}

static dyd_status find_classes(tolerance_drawing *g) {
  double *death = malloc((g->rows + 1) * sizeof *death);
  size_t count = 0;
  if (!death) return DYD_E_NOMEM;
  for (size_t k = 0; k < g->rows; k++)
    if (g->row[k].event == DYD_EVENT_DEATH) death[count++] = g->row[k].lo;
  qsort(death, count, sizeof *death, dyd_compare_double);
  for (int c = 0; c < CLASSES - 1; c++) g->bound[c] = count ? two_digits(death[count * (size_t)(c + 1) / CLASSES]) : 0;
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

static void tolerance_name(dyd_canvas *c, const tolerance_drawing *g, const dyd_tolerance_row *row) {
  char text[80], number[DYD_DECIMAL_SIZE];
  if (row->event == DYD_EVENT_TIE)
    snprintf(text, sizeof text, "tie");
  else if (!isfinite(row->lo))
    snprintf(text, sizeof text, "not lost by any motion");
  else
    snprintf(text, sizeof text, "not lost below %s", rounded(number, row->lo, 3, DYD_DOWN));
  dyd_picture_name_pair(c, g->r->engine, row->i, row->j, text);
}

static void tolerance_edges(dyd_canvas *c, tolerance_drawing *g, int class) {
  for (size_t k = 0; k < g->rows; k++) {
    double b[4], z[2][2];
    if (class_of(g, &g->row[k]) != class) continue;
    for (int e = 0; e < 2; e++) {
      dyd_sites_get_d(b, g->r->sites, e ? g->row[k].j : g->row[k].i);
      dyd_view_middle(z[e], &g->view, b);
    }
    if (!dyd_clip_segment(z, g->view.frame)) continue;
    g->seen[class] = true;
    dyd_canvas_move(c, z[0][0], z[0][1]);
    dyd_canvas_line(c, z[1][0], z[1][1]);
    if (g->rows <= DYD_PICTURE_NAMES) tolerance_name(c, g, &g->row[k]);
    dyd_picture_stroke(c, bearing[class].rgb, g->view.line * bearing[class].width, bearing[class].on,
                       bearing[class].off);
  }
}

static void tolerance_inside(dyd_canvas *c, void *context) {
  tolerance_drawing *g = context;
  for (int k = CLASSES; k >= 0; k--) tolerance_edges(c, g, k);
  dyd_site_marks_draw(&g->marks, c, &g->view);
}

/* Bounds are those of their two digits. */
static void class_text(char *out, size_t size, const tolerance_drawing *g, int class) {
  char number[DYD_DECIMAL_SIZE];
  if (class < CLASSES - 1 && isfinite(g->bound[class]))
    snprintf(out, size, "less than %s", rounded(number, g->bound[class], 2, DYD_DOWN));
  else if (class && isfinite(g->bound[class - 1]))
    snprintf(out, size, "%s or more", rounded(number, g->bound[class - 1], 2, DYD_DOWN));
  else
    snprintf(out, size, "not lost by any motion");
}

static void tolerance_legend(dyd_canvas *c, void *context) {
  const tolerance_drawing *g = context;
  char text[200], number[DYD_DECIMAL_SIZE];
  double lo, hi;
  dyd_legend l;
  dyd_legend_begin(&l, c, &g->view);
  for (int k = 0; k < CLASSES; k++) {
    if (!g->seen[k]) continue;
    class_text(text, sizeof text, g, k);
    dyd_legend_line(&l, bearing[k].rgb, bearing[k].on, bearing[k].off, text);
  }
  if (g->seen[CLASSES]) dyd_legend_line(&l, bearing[CLASSES].rgb, bearing[CLASSES].on, bearing[CLASSES].off, "tie");
  if (g->marks.drawn[DYD_MARK_DOT]) dyd_legend_dot(&l, 0x222222, 0x222222, "point");
  dyd_tolerance_whole(&lo, &hi, g->t);
  snprintf(text, sizeof text, "%zu points; edges by how far all may move%s before they may be lost; %s%s", g->r->count,
           dyd_tolerance_metric(g->t) == DYD_METRIC_BOX ? ", in x and y each," : "",
           isfinite(lo) ? "nothing changes below " : "no motion changes anything",
           isfinite(lo) ? rounded(number, lo, 3, DYD_DOWN) : "");
  dyd_legend_text(&l, text);
  dyd_legend_crowd(&l, &g->marks);
}

static dyd_status tolerance_see(tolerance_drawing *g, dyd_error *err) {
  double box[4];
  if (!g->r->window) return dyd_view_all(&g->view, g->r, NULL, err);
  dyd_rect_get_d(box, g->r->window);
  if (!(box[0] < box[1] && box[2] < box[3])) return dyd_fail(err, DYD_E_ARG, "the window has no area");
  return dyd_view_fit(&g->view, box, dyd_view_spacing(g->r->pd, NULL, box), err);
}

dyd_status dyd_tolerance_picture(const dyd_output *o) {
  const dyd_result *r = o->what;
  tolerance_drawing g = {.r = r, .t = r->tolerance, .marks = dyd_site_marks_of(r->pd, r->engine, DYD_PICTURE_BAND)};
  g.rows = dyd_tolerance_rows(&g.row, g.t);
  dyd_status st = find_classes(&g);
  if (st == DYD_OK) st = tolerance_see(&g, o->err);
  return st == DYD_OK ? dyd_view_write(o, &g.view, "tolerance of the Delaunay triangulation", tolerance_inside,
                                       tolerance_legend, &g)
                      : st;
}
