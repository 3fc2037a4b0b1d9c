/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The plot of a table of convergence: bounds and counts against stages, logarithmic, as svg, pdf or png. */
#include "io/parts.h"
#include "picture/panel.h"
#include "picture/picture.h"
#include <math.h>

enum { WIDTH = 860, HEIGHT = 640 };

/* ---- values; a picture shows them to the width of a line ---- */

static double log2_of(const dyd_dyadic *x) {
  if (dyd_dyadic_sgn(x) == 0) return -INFINITY;
  long e;
  double m = mpz_get_d_2exp(&e, x->man);
  return log2(m) + (double)e + (double)x->exp;
}

static double log10_of(size_t n) {
  return n ? log10((double)n) : -INFINITY;
}

static double plot_width_largest(const dyd_stage_row *r) {
  return log2_of(&r->width_largest);
}

static double plot_width_median(const dyd_stage_row *r) {
  return log2_of(&r->width_median);
}

static double plot_area(const dyd_stage_row *r) {
  return r->bounded ? log2_of(&r->area) : (double)NAN;
}

static double plot_hausdorff(const dyd_stage_row *r) {
  return r->bounded ? log2_of(&r->hausdorff) : (double)NAN;
}

static double plot_v_area(const dyd_stage_row *r) {
  return r->voronoi ? log2_of(&r->v_area) : (double)NAN;
}

static double plot_v_hausdorff(const dyd_stage_row *r) {
  return r->voronoi ? log2_of(&r->v_hausdorff) : (double)NAN;
}

static double plot_legal(const dyd_stage_row *r) {
  return log10_of(r->count[DYD_LEGAL]);
}

static double plot_possible(const dyd_stage_row *r) {
  return log10_of(r->count[DYD_LEGAL] + r->count[DYD_INDETERMINATE] + r->count[DYD_TIE]);
}

static double plot_indeterminate(const dyd_stage_row *r) {
  return log10_of(r->count[DYD_INDETERMINATE]);
}

static double plot_tie(const dyd_stage_row *r) {
  return log10_of(r->count[DYD_TIE]);
}

static double plot_faces(const dyd_stage_row *r) {
  return log10_of(r->undecided_faces);
}

/* Colours after Okabe and Ito, told apart by all kinds of sight. */
static const dyd_series bounds[] = {{"T: area", 0, 0.45, 0.70, 0, 0, plot_area},
                                    {"T: Hausdorff distance", 0.84, 0.37, 0, 0, 3, plot_hausdorff},
                                    {"V: area", 0.34, 0.71, 0.91, 6, 0, plot_v_area},
                                    {"V: Hausdorff distance", 0.90, 0.62, 0, 6, 3, plot_v_hausdorff},
                                    {"largest width", 0.3, 0.3, 0.3, 2, 4, plot_width_largest},
                                    {"median width", 0.6, 0.6, 0.6, 2, 5, plot_width_median}};
static const dyd_series counts[] = {{"possible pairs", 0, 0, 0, 0, 0, plot_possible},
                                    {"legal", 0, 0.62, 0.45, 0, 4, plot_legal},
                                    {"indeterminate", 0.84, 0.37, 0, 0, 3, plot_indeterminate},
                                    {"ties", 0.80, 0.47, 0.65, 6, 5, plot_tie},
                                    {"faces undecided", 0, 0.45, 0.70, 2, 0, plot_faces}};

/* ---- the page ---- */

static void plot_draw(cairo_t *cr, void *context) {
  const dyd_output *o = context;
  const dyd_convergence *c = o->what;
  dyd_panel top = {
      70, 66, 570, 290, 0, 1, "Upper bounds and widths (powers of 2)", bounds, sizeof bounds / sizeof *bounds};
  dyd_panel bottom = {70, 426, 570, 150, 0, 1, "Pairs and faces", counts, sizeof counts / sizeof *counts};
  char title[120];
  snprintf(title, sizeof title, "dyadel converge: %s schedule, outcome %s", dyd_schedule_text(c->options->schedule),
           dyd_outcome_text(c->outcome));
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_paint(cr);
  cairo_set_source_rgb(cr, 0, 0, 0);
  cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  dyd_picture_text(cr, 70, 32, 0, 15, title);
  dyd_panel_fit(&top, c);
  dyd_panel_fit(&bottom, c);
  dyd_panel_draw(cr, &top, c, 2);
  dyd_panel_draw(cr, &bottom, c, 10);
}

dyd_status dyd_convergence_picture(const dyd_output *o) {
  dyd_output own = *o;
  return dyd_page_write(o, WIDTH, HEIGHT, plot_draw, &own);
}
