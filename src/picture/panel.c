/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One panel of a plot: frame, ticks, curves, legend. */
#include "picture/panel.h"

#include "picture/picture.h"
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

static const double turn = 6.283185307179586;

static double panel_value(const dyd_panel *p, size_t series, const dyd_stage_row *r) {
  double value[DYD_PANEL_MOST];
  p->values(value, r);
  return value[series];
}

void dyd_panel_fit(dyd_panel *p, const dyd_convergence *c) {
  double low = INFINITY, high = -INFINITY;
  for (size_t s = 0; s < p->count; s++)
    for (size_t k = 0; k < c->count; k++) {
      double v = panel_value(p, s, c->row[k]);
      if (isfinite(v)) low = fmin(low, v), high = fmax(high, v);
    }
  bool any = low <= high;
  p->low = any ? floor(low) : 0;
  p->high = any ? fmax(ceil(high), p->low + 1) : 1;
}

static double panel_x(const dyd_panel *p, const dyd_convergence *c, size_t row) {
  double inner = p->width - 40;
  return p->x + 20 + (c->count < 2 ? inner / 2 : inner * (double)row / (double)(c->count - 1));
}

/* The lowest 18 points belong to zero. */
static double panel_y(const dyd_panel *p, double value) {
  if (value == -INFINITY) return p->y + p->height - 6;
  return p->y + p->height - 18 - (p->height - 26) * (value - p->low) / (p->high - p->low);
}

/* ---- ticks ---- */

/* The least step of a series 1, 2, 4, 8 .. (base 2) or 1, 2, 3 .. that gives at most eight ticks. */
static double tick_step(const dyd_panel *p, int base) {
  double step = 1;
  while ((p->high - p->low) / step > 8) step = base == 2 ? 2 * step : step + 1;
  return step;
}

static void grid_line(cairo_t *cr, double x0, double y0, double x1, double y1) {
  cairo_set_source_rgb(cr, 0.86, 0.86, 0.86);
  cairo_set_line_width(cr, 0.6);
  cairo_move_to(cr, x0, y0);
  cairo_line_to(cr, x1, y1);
  cairo_stroke(cr);
  cairo_set_source_rgb(cr, 0.2, 0.2, 0.2);
}

static void draw_levels(cairo_t *cr, const dyd_panel *p, int base) {
  char label[40];
  double step = tick_step(p, base);
  for (double v = ceil(p->low / step) * step; v <= p->high; v += step) {
    double y = panel_y(p, v);
    grid_line(cr, p->x, y, p->x + p->width, y);
    if (base == 10 && v < 7)
      snprintf(label, sizeof label, "%.0f", pow(10, v));
    else
      snprintf(label, sizeof label, "%d^%.0f", base, v);
    dyd_picture_text(cr, p->x - 6, y + 3.5, 1, 10, label);
  }
  double zero = panel_y(p, -INFINITY);
  dyd_picture_text(cr, p->x - 6, zero + 3.5, 1, 10, "0");
}

static void draw_stages(cairo_t *cr, const dyd_panel *p, const dyd_convergence *c) {
  size_t step = c->count / 16 + 1;
  char label[40];
  for (size_t k = 0; k < c->count; k += step) {
    double x = panel_x(p, c, k), foot = p->y + p->height;
    grid_line(cr, x, p->y, x, foot);
    snprintf(label, sizeof label, "%" PRIu64, c->row[k]->stage);
    dyd_picture_text(cr, x, foot + 13, 0.5, 10, label);
    snprintf(label, sizeof label, "%" PRId64, c->row[k]->bits_most);
    dyd_picture_text(cr, x, foot + 25, 0.5, 9, label);
  }
  dyd_picture_text(cr, p->x - 6, p->y + p->height + 13, 1, 10, "stage");
  dyd_picture_text(cr, p->x - 6, p->y + p->height + 25, 1, 9, "bits");
}

/* ---- curves ---- */

static void draw_series_mark(cairo_t *cr, const dyd_series *s, double x, double y) {
  const double radius = 3.4;
  cairo_new_path(cr);
  if (s->mark == 0) cairo_arc(cr, x, y, radius, 0, turn);
  for (unsigned k = 0; k < s->mark; k++) {
    double angle = turn * (k / (double)s->mark - 0.25);
    cairo_line_to(cr, x + radius * cos(angle), y + radius * sin(angle));
  }
  cairo_close_path(cr);
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_fill_preserve(cr);
  cairo_set_source_rgb(cr, s->red, s->green, s->blue);
  cairo_set_line_width(cr, 1.2);
  cairo_stroke(cr);
}

static void set_pen(cairo_t *cr, const dyd_series *s) {
  cairo_set_source_rgb(cr, s->red, s->green, s->blue);
  cairo_set_line_width(cr, 1.5);
  cairo_set_dash(cr, &s->dash, s->dash > 0 ? 1 : 0, 0);
}

static void draw_curve(cairo_t *cr, const dyd_panel *p, size_t s, const dyd_convergence *c) {
  set_pen(cr, &p->series[s]);
  cairo_new_path(cr);
  for (size_t k = 0; k < c->count; k++) {
    double v = panel_value(p, s, c->row[k]);
    if (isnan(v))
      cairo_new_sub_path(cr);
    else
      cairo_line_to(cr, panel_x(p, c, k), panel_y(p, v));
  }
  cairo_stroke(cr);
  cairo_set_dash(cr, NULL, 0, 0);
  for (size_t k = 0; k < c->count; k++) {
    double v = panel_value(p, s, c->row[k]);
    if (!isnan(v)) draw_series_mark(cr, &p->series[s], panel_x(p, c, k), panel_y(p, v));
  }
}

static bool has_values(const dyd_panel *p, size_t s, const dyd_convergence *c) {
  for (size_t k = 0; k < c->count; k++)
    if (!isnan(panel_value(p, s, c->row[k]))) return true;
  return false;
}

static void draw_key(cairo_t *cr, const dyd_series *s, double x, double y) {
  set_pen(cr, s);
  cairo_move_to(cr, x, y);
  cairo_line_to(cr, x + 30, y);
  cairo_stroke(cr);
  cairo_set_dash(cr, NULL, 0, 0);
  draw_series_mark(cr, s, x + 15, y);
  cairo_set_source_rgb(cr, 0, 0, 0);
  dyd_picture_text(cr, x + 38, y + 3.5, 0, 10.5, s->name);
}

void dyd_panel_draw(cairo_t *cr, const dyd_panel *p, const dyd_convergence *c, int base) {
  cairo_set_source_rgb(cr, 0, 0, 0);
  dyd_picture_text(cr, p->x, p->y - 7, 0, 12, p->title);
  draw_levels(cr, p, base);
  draw_stages(cr, p, c);
  cairo_set_source_rgb(cr, 0.2, 0.2, 0.2);
  cairo_set_line_width(cr, 0.8);
  cairo_rectangle(cr, p->x, p->y, p->width, p->height);
  cairo_stroke(cr);
  double key = p->y + 8;
  for (size_t s = 0; s < p->count; s++) {
    if (!has_values(p, s, c)) continue;
    draw_curve(cr, p, s, c);
    draw_key(cr, &p->series[s], p->x + p->width + 14, key);
    key += 19;
  }
}
