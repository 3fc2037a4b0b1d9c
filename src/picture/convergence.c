/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The plot of a table of convergence: bounds and counts against stages, logarithmic, as svg, pdf or png. */
#include "io/result.h"
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
    {"triangulation: area", 0x0072b2, 0, 0}, {"triangulation: distance", 0xd55e00, 0, 3},
    {"diagram: area", 0x56b4e9, 6, 0},       {"diagram: distance", 0xe69f00, 6, 3},
    {"largest width", 0x4d4d4d, 2, 4},       {"median width", 0x999999, 2, 5}};
static const dyd_series counts[] = {{"possible pairs", 0x000000, 0, 0},
                                    {"legal", 0x009e73, 0, 4},
                                    {"indeterminate", 0xd55e00, 0, 3},
                                    {"ties", 0xcc79a7, 6, 5},
                                    {"faces undecided", 0x0072b2, 2, 0}};

/* ---- the page ---- */

static void plot_draw(dyd_canvas *on, const dyd_convergence *c) {
  dyd_panel top = {70,         66,
                   570,        290,
                   0,          1,
                   "bound",    "Upper bounds and widths (powers of 2, in units of the coordinates)",
                   bounds,     sizeof bounds / sizeof *bounds,
                   plot_bounds};
  dyd_panel bottom = {
      70, 426, 570, 150, 0, 1, "count", "Pairs and faces", counts, sizeof counts / sizeof *counts, plot_counts};
  char title[120];
  snprintf(title, sizeof title, "dyadel converge: %s schedule, outcome %s", dyd_schedule_text(c->options->schedule),
           dyd_outcome_text(c->outcome));
  dyd_canvas_text(on, 70, 32, 0, 15, false, title);
  dyd_panel_fit(&top, c);
  dyd_panel_fit(&bottom, c);
  dyd_panel_draw(on, &top, c, 2);
  dyd_panel_draw(on, &bottom, c, 10);
}

dyd_status dyd_convergence_picture(const dyd_output *o) {
  dyd_canvas *on = dyd_canvas_new(o, WIDTH, HEIGHT, "convergence");
  if (on) plot_draw(on, o->what);
  return dyd_canvas_end(on, DYD_OK, o->err);
}
