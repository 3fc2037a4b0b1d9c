/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The plot of a table of convergence: bounds and counts against stages, logarithmic, as svg, pdf or png. */
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

static double width_largest(const dyd_stage_row *r) {
  return log2_of(&r->width_largest);
}

static double width_median(const dyd_stage_row *r) {
  return log2_of(&r->width_median);
}

static double area(const dyd_stage_row *r) {
  return r->bounded ? log2_of(&r->area) : (double)NAN;
}

static double hausdorff(const dyd_stage_row *r) {
  return r->bounded ? log2_of(&r->hausdorff) : (double)NAN;
}

static double v_area(const dyd_stage_row *r) {
  return r->voronoi ? log2_of(&r->v_area) : (double)NAN;
}

static double v_hausdorff(const dyd_stage_row *r) {
  return r->voronoi ? log2_of(&r->v_hausdorff) : (double)NAN;
}

static double legal(const dyd_stage_row *r) {
  return log10_of(r->count[DYD_LEGAL]);
}

static double possible(const dyd_stage_row *r) {
  return log10_of(r->count[DYD_LEGAL] + r->count[DYD_INDETERMINATE] + r->count[DYD_TIE]);
}

static double indeterminate(const dyd_stage_row *r) {
  return log10_of(r->count[DYD_INDETERMINATE]);
}

static double tie(const dyd_stage_row *r) {
  return log10_of(r->count[DYD_TIE]);
}

static double faces(const dyd_stage_row *r) {
  return log10_of(r->undecided_faces);
}

/* Colours after Okabe and Ito, told apart by all kinds of sight. */
static const dyd_series bounds[] = {{"T: area", 0, 0.45, 0.70, 0, 0, area},
                                    {"T: Hausdorff distance", 0.84, 0.37, 0, 0, 3, hausdorff},
                                    {"V: area", 0.34, 0.71, 0.91, 6, 0, v_area},
                                    {"V: Hausdorff distance", 0.90, 0.62, 0, 6, 3, v_hausdorff},
                                    {"largest width", 0.3, 0.3, 0.3, 2, 4, width_largest},
                                    {"median width", 0.6, 0.6, 0.6, 2, 5, width_median}};
static const dyd_series counts[] = {{"possible pairs", 0, 0, 0, 0, 0, possible},
                                    {"legal", 0, 0.62, 0.45, 0, 4, legal},
                                    {"indeterminate", 0.84, 0.37, 0, 0, 3, indeterminate},
                                    {"ties", 0.80, 0.47, 0.65, 6, 5, tie},
                                    {"faces undecided", 0, 0.45, 0.70, 2, 0, faces}};

/* ---- the page ---- */

static void plot_draw(cairo_t *cr, void *context) {
  const dyd_output *o = context;
  const dyd_convergence *c = o->what;
  dyd_panel top = {
      70, 66, 570, 290, 0, 1, "Upper bounds and widths (powers of 2)", bounds, sizeof bounds / sizeof *bounds};
  dyd_panel bottom = {70, 426, 570, 150, 0, 1, "Pairs and faces", counts, sizeof counts / sizeof *counts};
  char title[120];
  snprintf(title, sizeof title, "dyadel converge: %s schedule, outcome %s",
           c->options.schedule == DYD_SCHEDULE_UNIFORM ? "uniform" : "adaptive", dyd_outcome_text(c->outcome));
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
