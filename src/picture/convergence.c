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

static void plot_bounds(double *out, const dyd_stage_row *r) {
  const dyd_dyadic *bound[] = {r->bounded ? &r->area : NULL,
                               r->bounded ? &r->hausdorff : NULL,
                               r->voronoi ? &r->v_area : NULL,
                               r->voronoi ? &r->v_hausdorff : NULL,
                               &r->width_largest,
                               &r->width_median};
  for (size_t k = 0; k < sizeof bound / sizeof *bound; k++) out[k] = bound[k] ? log2_of(bound[k]) : (double)NAN;
}

static void plot_counts(double *out, const dyd_stage_row *r) {
  size_t legal = r->count[DYD_LEGAL], open = r->count[DYD_INDETERMINATE], tie = r->count[DYD_TIE],
         count[] = {legal + open + tie, legal, open, tie, r->undecided_faces};
  for (size_t k = 0; k < sizeof count / sizeof *count; k++) out[k] = count[k] ? log10((double)count[k]) : -INFINITY;
}

/* Colours after Okabe and Ito, told apart by all kinds of sight. */
static const dyd_series bounds[] = {
    {"T: area", 0, 0.45, 0.70, 0, 0},       {"T: Hausdorff distance", 0.84, 0.37, 0, 0, 3},
    {"V: area", 0.34, 0.71, 0.91, 6, 0},    {"V: Hausdorff distance", 0.90, 0.62, 0, 6, 3},
    {"largest width", 0.3, 0.3, 0.3, 2, 4}, {"median width", 0.6, 0.6, 0.6, 2, 5}};
static const dyd_series counts[] = {{"possible pairs", 0, 0, 0, 0, 0},
                                    {"legal", 0, 0.62, 0.45, 0, 4},
                                    {"indeterminate", 0.84, 0.37, 0, 0, 3},
                                    {"ties", 0.80, 0.47, 0.65, 6, 5},
                                    {"faces undecided", 0, 0.45, 0.70, 2, 0}};

/* ---- the page ---- */

static void plot_draw(cairo_t *cr, void *context) {
  const dyd_output *o = context;
  const dyd_convergence *c = o->what;
  dyd_panel top = {
      70,         66, 570, 290, 0, 1, "Upper bounds and widths (powers of 2)", bounds, sizeof bounds / sizeof *bounds,
      plot_bounds};
  dyd_panel bottom = {70, 426, 570, 150, 0, 1, "Pairs and faces", counts, sizeof counts / sizeof *counts, plot_counts};
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
