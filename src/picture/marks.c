/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What stands at a place of a view: sites, their numbers, the scale. */
#include "io/decimal.h"
#include "picture/picture.h"
#include <math.h>

#define EDGE DYD_VIEW_EDGE

void dyd_picture_site(cairo_t *cr, const dyd_view *v, const double box[4], bool fixed_point, unsigned rgb) {
  double x0 = dyd_view_x(v, box[0]), x1 = dyd_view_x(v, box[1]), y0 = dyd_view_y(v, box[3]), y1 = dyd_view_y(v, box[2]);
  bool small = fixed_point || fmax(x1 - x0, y1 - y0) < 2 * v->dot;
  if (!(x1 >= 0 && x0 <= v->width + 2 * EDGE && y1 >= 0 && y0 <= v->height + 2 * EDGE)) return;
  x0 = fmax(x0, -EDGE), x1 = fmin(x1, v->width + 3 * EDGE), y0 = fmax(y0, -EDGE), y1 = fmin(y1, v->height + 3 * EDGE);
  cairo_new_path(cr);
  if (small) {
    dyd_picture_colour(cr, 0x222222);
    cairo_arc(cr, x0 / 2 + x1 / 2, y0 / 2 + y1 / 2, v->dot, 0, 2 * acos(-1.0));
    cairo_fill(cr);
    return;
  }
  double least = fmax(v->line, 1);
  cairo_rectangle(cr, x0, y0, fmax(x1 - x0, least), fmax(y1 - y0, least));
  cairo_set_source_rgba(cr, (rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0, 0.55);
  cairo_fill_preserve(cr);
  dyd_picture_stroke(cr, (rgb >> 1 & 0x7f7f7f) + (rgb >> 4 & 0x0f0f0f), fmax(v->line * 0.7, 0.5), 0, 0);
}

void dyd_picture_marked(cairo_t *cr, const dyd_view *v, const double box[4], unsigned rgb) {
  double w = fmax((box[1] - box[0]) * v->scale, 7), h = fmax((box[3] - box[2]) * v->scale, 7);
  double z[2];
  dyd_view_middle(z, v, box);
  cairo_new_path(cr);
  cairo_rectangle(cr, z[0] - w / 2, z[1] - h / 2, w, h);
  dyd_picture_colour(cr, rgb);
  cairo_fill_preserve(cr);
  dyd_picture_stroke(cr, 0x222222, 1.5, 0, 0);
}

/* The number stands beside the upper right corner, or where the view ends before it. */
void dyd_picture_numbered(cairo_t *cr, const dyd_view *v, const double box[4], unsigned rgb, size_t number) {
  char text[24];
  double z[2];
  cairo_text_extents_t e;
  dyd_picture_marked(cr, v, box, rgb);
  snprintf(text, sizeof text, "%zu", number);
  cairo_set_font_size(cr, 20);
  cairo_text_extents(cr, text, &e);
  dyd_view_middle(z, v, box);
  double x = fmax(dyd_view_x(v, box[1]), z[0] + 3.5) + 5, y = fmin(dyd_view_y(v, box[3]), z[1] - 3.5) - 4;
  cairo_move_to(cr, fmin(x, EDGE + v->width - e.x_advance - 4), fmax(y, EDGE + 20));
  cairo_text_path(cr, text);
  dyd_picture_pen(cr, 0xffffff, 4, 0, 0);
  cairo_stroke_preserve(cr);
  dyd_picture_fill(cr, 0);
}

void dyd_picture_scale(cairo_t *cr, const dyd_view *v, double y) {
  double most = 0.2 * v->width / v->scale, length = pow(10, floor(log10(most)));
  if (5 * length <= most)
    length *= 5;
  else if (2 * length <= most)
    length *= 2;
  if (!isfinite(length) || length <= 0) return;
  double right = EDGE + v->width, left = right - length * v->scale, error;
  char text[DYD_DECIMAL_SIZE];
  dyd_decimal_within(text, &error, length, length);
  cairo_new_path(cr);
  cairo_move_to(cr, left, y - 4);
  cairo_line_to(cr, left, y + 4);
  cairo_move_to(cr, left, y);
  cairo_line_to(cr, right, y);
  cairo_move_to(cr, right, y - 4);
  cairo_line_to(cr, right, y + 4);
  dyd_picture_stroke(cr, 0x222222, 1.5, 0, 0);
  dyd_picture_text(cr, right, y + 20, 1, 14, text);
}
