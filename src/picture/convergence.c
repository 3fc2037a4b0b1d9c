/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The plot of a table of convergence: bounds and counts against stages, logarithmic, as svg, pdf or png. */
#include "io/decimal.h"
#include "io/output.h"
#include "picture/canvas.h"
#include "picture/picture.h"

#include <dyadel/converge.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

/* A row of the table of a panel: one curve, which number of a stage it shows, how it is drawn and called in the key;
 * distinguished by colour, by dash and by marker, so that grey does as well. */
typedef struct plot_series {
  size_t number;
  const char *name;
  unsigned rgb;
  double dash;   /* length; 0: a full line */
  unsigned mark; /* sides of the marker: 0 (a ring) or 3, 4, 5 */
} plot_series;

/* Invariant: low < high; zero is drawn on the bottom line, below low. */
typedef struct plot_panel {
  double x, y, width, height; /* of the frame */
  double low, high;           /* on its scale */
  const char *id, *title;
  const plot_series *series;
  size_t count;
  /* A number of the row, on the panel's scale; NAN where it is not known, -INFINITY for zero. */
  double (*value)(const dyd_stage_row *r, size_t number);
} plot_panel;

static const double turn = 6.283185307179586;

static double panel_value(const plot_panel *p, const plot_series *s, const dyd_stage_row *r) {
  return p->value(r, s->number);
}

/* Sets low and high from the values. */
static void panel_fit(plot_panel *p, const dyd_convergence *c) {
  double low = INFINITY, high = -INFINITY;
  for (size_t s = 0; s < p->count; s++)
    for (size_t k = 0; k < c->count; k++) {
      double v = panel_value(p, &p->series[s], c->row[k]);
      if (isfinite(v)) low = fmin(low, v), high = fmax(high, v);
    }
  bool any = low <= high;
  p->low = any ? floor(low) : 0;
  p->high = any ? fmax(ceil(high), p->low + 1) : 1;
}

static double panel_x(const plot_panel *p, const dyd_convergence *c, size_t row) {
  double inner = p->width - 40;
  return p->x + 20 + (c->count < 2 ? inner / 2 : inner * (double)row / (double)(c->count - 1));
}

/* The lowest 18 points belong to zero. */
static double panel_y(const plot_panel *p, double value) {
  if (value == -INFINITY) return p->y + p->height - 6;
  return p->y + p->height - 18 - (p->height - 26) * (value - p->low) / (p->high - p->low);
}

/* ---- ticks ---- */

/* The least step of a series 1, 2, 4, 8 .. (base 2) or 1, 2, 3 .. that gives at most eight ticks, fewer of large text.
 */
static double tick_step(const plot_panel *p, int base, double text) {
  double step = 1;
  while ((p->high - p->low) / step > 8 / text) step = base == 2 ? 2 * step : step + 1;
  return step;
}

static void grid_line(dyd_canvas *on, double x0, double y0, double x1, double y1) {
  double z[2][2] = {{x0, y0}, {x1, y1}};
  dyd_picture_line(on, z, 0xdbdbdb, 0.6, 0, 0);
}

static void draw_levels(dyd_canvas *on, const plot_panel *p, int base) {
  char label[40];
  double zero = panel_y(p, -INFINITY), step = tick_step(p, base, on->text);
  for (double v = ceil(p->low / step) * step; v <= p->high; v += step) {
    double y = panel_y(p, v);
    grid_line(on, p->x, y, p->x + p->width, y);
    if (base == 10 && v < 7)
      snprintf(label, sizeof label, "%.0f", pow(10, v));
    else
      snprintf(label, sizeof label, "%d^%.0f", base, v);
    if (zero - y >= 11 * on->text) dyd_canvas_text(on, p->x - 6, y + 3.5 * on->text, 1, 10, false, label);
  }
  dyd_canvas_text(on, p->x - 6, zero + 3.5 * on->text, 1, 10, false, "0");
}

static void draw_stages(dyd_canvas *on, const plot_panel *p, const dyd_convergence *c) {
  size_t step = c->count / 16 + 1;
  char label[40];
  for (size_t k = 0; k < c->count; k += step) {
    double x = panel_x(p, c, k), foot = p->y + p->height;
    grid_line(on, x, p->y, x, foot);
    snprintf(label, sizeof label, "%" PRIu64, c->row[k]->stage);
    dyd_canvas_text(on, x, foot + 3 + 10 * on->text, 0.5, 10, false, label);
    snprintf(label, sizeof label, "%" PRId64, c->row[k]->bits_most);
    dyd_canvas_text(on, x, foot + 3 + 22 * on->text, 0.5, 9, false, label);
  }
  dyd_canvas_text(on, p->x - 6, p->y + p->height + 3 + 10 * on->text, 1, 10, false, "stage");
  dyd_canvas_text(on, p->x - 6, p->y + p->height + 3 + 22 * on->text, 1, 9, false, "bits");
}

/* ---- curves ---- */

/* A title in the size, or in that in which it fits the page. */
static void draw_title(dyd_canvas *on, double x, double y, double size, const char *text) {
  double room = on->box[1] - x - 4, wide = dyd_canvas_width(on, size, text);
  dyd_canvas_text(on, x, y, 0, wide > room ? size * room / wide : size, false, text);
}

static void draw_series_mark(dyd_canvas *on, const plot_series *s, double x, double y) {
  const double radius = 3.4;
  if (s->mark == 0) dyd_canvas_circle(on, x, y, radius);
  for (unsigned k = 0; k < s->mark; k++) {
    double angle = turn * (k / (double)s->mark - 0.25);
    dyd_canvas_line(on, x + radius * cos(angle), y + radius * sin(angle));
  }
  if (s->mark) dyd_canvas_close(on);
  dyd_picture_shape(on, 0xffffff, 1, s->rgb, 1.2);
}

static void stroke_series(dyd_canvas *on, const plot_series *s) {
  dyd_canvas_paint(on, &(dyd_paint){DYD_NO_COLOUR, s->rgb, 1, 1.5, s->dash, s->dash});
}

static void draw_curve(dyd_canvas *on, const plot_panel *p, const plot_series *s, const dyd_convergence *c) {
  char id[48];
  bool gap = true;
  for (size_t k = 0; k < c->count; k++) {
    double v = panel_value(p, s, c->row[k]);
    if (!isnan(v) && gap)
      dyd_canvas_move(on, panel_x(p, c, k), panel_y(p, v));
    else if (!isnan(v))
      dyd_canvas_line(on, panel_x(p, c, k), panel_y(p, v));
    gap = isnan(v);
  }
  snprintf(id, sizeof id, "%s-%zu", p->id, s->number);
  dyd_canvas_name(on, id, s->name);
  stroke_series(on, s);
  for (size_t k = 0; k < c->count; k++) {
    double v = panel_value(p, s, c->row[k]);
    if (isnan(v)) continue;
    char title[80];
    snprintf(id, sizeof id, "%s-%zu-%zu", p->id, s->number, k);
    snprintf(title, sizeof title, "%s, stage %" PRIu64 ", %" PRId64 " bits", s->name, c->row[k]->stage,
             c->row[k]->bits_most);
    dyd_canvas_name(on, id, title);
    draw_series_mark(on, s, panel_x(p, c, k), panel_y(p, v));
  }
}

static bool has_values(const plot_panel *p, const plot_series *s, const dyd_convergence *c) {
  for (size_t k = 0; k < c->count; k++)
    if (!isnan(panel_value(p, s, c->row[k]))) return true;
  return false;
}

static void draw_key(dyd_canvas *on, const plot_series *s, double x, double y) {
  dyd_canvas_move(on, x, y);
  dyd_canvas_line(on, x + 30, y);
  stroke_series(on, s);
  draw_series_mark(on, s, x + 15, y);
  dyd_canvas_text(on, x + 38, y + 3.5 * on->text, 0, 10.5, false, s->name);
}

/* Frame, ticks (labels base^k), curves, legend. */
static void panel_draw(dyd_canvas *on, const plot_panel *p, const dyd_convergence *c, int base, bool bare) {
  draw_title(on, p->x, p->y - 7, 12, p->title);
  draw_levels(on, p, base);
  draw_stages(on, p, c);
  dyd_canvas_box(on, p->x, p->y, p->width, p->height);
  dyd_picture_stroke(on, 0x333333, 0.8, 0, 0);
  double key = p->y + 8;
  for (const plot_series *s = p->series; s < p->series + p->count; s++) {
    if (!has_values(p, s, c)) continue;
    draw_curve(on, p, s, c);
    if (!bare) draw_key(on, s, p->x + p->width + 14, key);
    key += 19 * on->text;
  }
}

enum { WIDTH = 860 };

/* ---- values; a picture shows them to the width of a line ---- */

static double log2_of(const dyd_dyadic *x) {
  if (dyd_dyadic_sgn(x) == 0) return -INFINITY;
  long e;
  double m = mpz_get_d_2exp(&e, x->man);
  return log2(m) + (double)e + (double)x->exp;
}

/* NULL: it is not known. */
static const dyd_dyadic *plot_bound(const dyd_stage_row *r, size_t k) {
  const dyd_dyadic *bound[] = {&r->area,        &r->hausdorff,     &r->v_area,
                               &r->v_hausdorff, &r->width_largest, &r->width_median};
  return k < 4 && !(k < 2 ? r->bounded : r->voronoi) ? NULL : bound[k];
}

static double bound_value(const dyd_stage_row *r, size_t k) {
  return plot_bound(r, k) ? log2_of(plot_bound(r, k)) : (double)NAN;
}

static double count_value(const dyd_stage_row *r, size_t k) {
  size_t legal = r->count[DYD_LEGAL], open = r->count[DYD_INDETERMINATE], tie = r->count[DYD_TIE],
         count[] = {legal + open + tie, legal, open, tie, r->undecided_faces};
  return count[k] ? log10((double)count[k]) : -INFINITY;
}

/* Colours after Okabe and Ito, distinct for all kinds of sight. */
static const plot_series bounds[] = {
    {0, "triangulation: area", 0x0072b2, 0, 0}, {1, "triangulation: distance", 0xd55e00, 0, 3},
    {2, "diagram: area", 0x56b4e9, 6, 0},       {3, "diagram: distance", 0xe69f00, 6, 3},
    {4, "largest width", 0x4d4d4d, 2, 4},       {5, "median width", 0x999999, 2, 5}};

/* Of a disc or bisector. */
static const plot_series piece_bounds[] = {{0, "area", 0x0072b2, 0, 0},
                                           {1, "distance", 0xd55e00, 0, 3},
                                           {4, "largest width", 0x4d4d4d, 2, 4},
                                           {5, "median width", 0x999999, 2, 5}};

static const plot_series counts[] = {{0, "possible pairs", 0x000000, 0, 0},
                                     {1, "legal", 0x009e73, 0, 4},
                                     {2, "indeterminate", 0xd55e00, 0, 3},
                                     {3, "ties", 0xcc79a7, 6, 5},
                                     {4, "faces undecided", 0x0072b2, 2, 0}};

/* The curves of bounds, and how many there are. */
static const plot_series *bounds_of(size_t *count, const dyd_convergence *c) {
  const bool piece = c->of >= DYD_CONVERGE_DISC;
  *count = piece ? sizeof piece_bounds / sizeof *piece_bounds : sizeof bounds / sizeof *bounds;
  return piece ? piece_bounds : bounds;
}

/* ---- the page ---- */

static void plot_draw(dyd_canvas *on, const dyd_convergence *c, bool bare) {
  plot_panel top = {.x = 70,
                    .y = 66,
                    .width = 570,
                    .height = 290,
                    .id = "bound",
                    .title = "Upper bounds and widths (powers of 2, in units of the coordinates)",
                    .value = bound_value},
             bottom = {.x = 70,
                       .y = 356 + 70 * on->text,
                       .width = 570,
                       .height = 150,
                       .id = "count",
                       .title = "Pairs and faces",
                       .series = counts,
                       .count = sizeof counts / sizeof *counts,
                       .value = count_value};
  top.series = bounds_of(&top.count, c);
  char title[120];
  snprintf(title, sizeof title, "dyadel converge: %s, %s schedule, outcome %s", dyd_converge_of_text(c->of),
           dyd_schedule_text(c->options->schedule), dyd_outcome_text(c->outcome));
  if (!bare) draw_title(on, 70, 66 - 34 * on->text, 15, title);
  panel_fit(&top, c);
  panel_draw(on, &top, c, 2, bare);
  if (c->of >= DYD_CONVERGE_DISC) return;
  panel_fit(&bottom, c);
  panel_draw(on, &bottom, c, 10, bare);
}

/* Bare: the curves with their scales, without title and key. */
dyd_status dyd_convergence_picture(const dyd_output *o) {
  dyd_page page;
  dyd_status st = dyd_page_fit(&page, o, o->style.bare ? 580 : 570, o->style.bare ? 70 : WIDTH - 570);
  if (st != DYD_OK) return st;
  const double t = page.text, right = o->style.bare ? 650 : 640 + (WIDTH - 640) * t;
  const double box[4] = {70 * (1 - t), right, o->style.bare ? 66 - 24 * t : 66 * (1 - t), 506 + 134 * t};
  dyd_canvas *on = dyd_canvas_new(o, &page, box, "convergence");
  if (on) plot_draw(on, o->what, o->style.bare);
  return dyd_canvas_end(on, DYD_OK, o->err);
}

/* ---- pgfplots ---- */

/* Zero has no place on a logarithmic scale. */
static bool has_pgf(const dyd_stage_row *r, size_t k) {
  return plot_bound(r, k) && dyd_dyadic_sgn(plot_bound(r, k)) != 0;
}

static void pgf_curve(FILE *out, const dyd_convergence *c, const plot_series *s, bool legend) {
  char text[DYD_DECIMAL_SIZE];
  size_t points = 0;
  for (size_t n = 0; n < c->count; n++) {
    if (!has_pgf(c->row[n], s->number)) continue;
    dyd_decimal_dyadic(text, plot_bound(c->row[n], s->number), 6, DYD_UP);
    fprintf(out, "%s(%" PRId64 ",%s)", points++ ? " " : "\\addplot coordinates {", c->row[n]->bits_most, text);
  }
  if (points) fputs("};\n", out);
  if (points && legend) fprintf(out, "\\addlegendentry{%s}\n", s->name);
}

/* Bounds against the bits asked for, as coordinates of pgfplots. */
static dyd_status convergence_pgf(const dyd_output *o) {
  const dyd_convergence *c = o->what;
  size_t count;
  const plot_series *series = bounds_of(&count, c);
  fprintf(o->out,
          "%% dyadel converge: %s, %s schedule, outcome %s; bounds and widths are rounded up, zeros omitted\n"
          "\\begin{tikzpicture}\n\\begin{axis}[xlabel={bits},ylabel={upper bound},ymode=log,log basis y=2,legend "
          "pos=outer north east]\n",
          dyd_converge_of_text(c->of), dyd_schedule_text(c->options->schedule), dyd_outcome_text(c->outcome));
  for (size_t k = 0; k < count; k++) pgf_curve(o->out, c, &series[k], !o->style.bare);
  fputs("\\end{axis}\n\\end{tikzpicture}\n", o->out);
  return DYD_OK;
}

dyd_writer *const dyd_pgf_writers[DYD_CONTENTS] = {[DYD_CONTENT_PLOT] = convergence_pgf};
