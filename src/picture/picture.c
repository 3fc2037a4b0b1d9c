/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages, and what is drawn on them. */
#include "picture/picture.h"

#include "base/error.h"
#include "io/decimal.h"
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EDGE DYD_VIEW_EDGE
#define SCALE_OF_PNG 2

/* ---- pages ---- */

/* error: errno of the first write that failed, else 0. */
typedef struct sink {
  FILE *out;
  int error;
} sink;

static cairo_status_t sink_put(void *closure, const unsigned char *data, unsigned length) {
  sink *s = closure;
  if (fwrite(data, 1, length, s->out) == length) return CAIRO_STATUS_SUCCESS;
  if (!s->error) s->error = errno ? errno : EIO;
  return CAIRO_STATUS_WRITE_ERROR;
}

static cairo_surface_t *new_surface(sink *out, dyd_format kind, double width, double height) {
  if (kind == DYD_FORMAT_SVG) return cairo_svg_surface_create_for_stream(sink_put, out, width, height);
  if (kind == DYD_FORMAT_PDF) return cairo_pdf_surface_create_for_stream(sink_put, out, width, height);
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)ceil(width * SCALE_OF_PNG),
                                    (int)ceil(height * SCALE_OF_PNG));
}

dyd_status dyd_page_write(const dyd_output *o, double width, double height, dyd_draw_fn draw, void *context) {
  sink s = {.out = o->out};
  cairo_surface_t *surface = new_surface(&s, o->format, width, height);
  bool png = o->format == DYD_FORMAT_PNG;
  cairo_t *cr = cairo_create(surface);
  if (png) cairo_scale(cr, SCALE_OF_PNG, SCALE_OF_PNG);
  draw(cr, context);
  cairo_status_t status = cairo_status(cr);
  cairo_destroy(cr);
  if (png && status == CAIRO_STATUS_SUCCESS) status = cairo_surface_write_to_png_stream(surface, sink_put, &s);
  cairo_surface_finish(surface);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  if (status == CAIRO_STATUS_NO_MEMORY) return DYD_E_NOMEM;
  if (s.error) return dyd_fail(o->err, DYD_E_IO, "cannot write: %s", strerror(s.error));
  if (status == CAIRO_STATUS_SUCCESS) return DYD_OK;
  return dyd_fail(o->err, DYD_E_IO, "cannot write the picture: %s", cairo_status_to_string(status));
}

/* ---- drawing ---- */

void dyd_picture_begin(cairo_t *cr) {
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_paint(cr);
  cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
}

/* align 0: from x on, 0.5: around x, 1: up to x. */
void dyd_picture_text(cairo_t *cr, double x, double y, double align, double size, const char *text) {
  cairo_text_extents_t e;
  cairo_set_font_size(cr, size);
  cairo_text_extents(cr, text, &e);
  cairo_move_to(cr, x - align * e.x_advance, y);
  cairo_show_text(cr, text);
}

void dyd_picture_colour(cairo_t *cr, unsigned rgb) {
  cairo_set_source_rgb(cr, (rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0);
}

void dyd_picture_pen(cairo_t *cr, unsigned rgb, double width, double on, double off) {
  double unit = fmax(width, 0.7), dash[2] = {on * unit, off * unit};
  dyd_picture_colour(cr, rgb);
  cairo_set_line_width(cr, width);
  cairo_set_dash(cr, dash, off > 0 ? 2 : 0, 0);
}

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
  dyd_picture_pen(cr, (rgb >> 1 & 0x7f7f7f) + (rgb >> 4 & 0x0f0f0f), fmax(v->line * 0.7, 0.5), 0, 0);
  cairo_stroke(cr);
}

void dyd_picture_dot(cairo_t *cr, double x, double y, double radius, unsigned fill, unsigned edge) {
  cairo_new_path(cr);
  cairo_arc(cr, x, y, radius, 0, 2 * acos(-1.0));
  dyd_picture_colour(cr, fill);
  cairo_fill_preserve(cr);
  dyd_picture_pen(cr, edge, 1.2, 0, 0);
  cairo_stroke(cr);
  dyd_picture_colour(cr, 0);
}

void dyd_picture_marked(cairo_t *cr, const dyd_view *v, const double box[4], unsigned rgb) {
  double w = fmax((box[1] - box[0]) * v->scale, 7), h = fmax((box[3] - box[2]) * v->scale, 7);
  double x = dyd_view_x(v, box[0] / 2 + box[1] / 2), y = dyd_view_y(v, box[2] / 2 + box[3] / 2);
  cairo_new_path(cr);
  cairo_rectangle(cr, x - w / 2, y - h / 2, w, h);
  dyd_picture_colour(cr, rgb);
  cairo_fill_preserve(cr);
  dyd_picture_pen(cr, 0x222222, 1.5, 0, 0);
  cairo_stroke(cr);
}

/* Beside the upper right corner, or where the view ends before it. */
void dyd_picture_numbered(cairo_t *cr, const dyd_view *v, const double box[4], unsigned rgb, size_t number) {
  char text[24];
  cairo_text_extents_t e;
  dyd_picture_marked(cr, v, box, rgb);
  snprintf(text, sizeof text, "%zu", number);
  cairo_set_font_size(cr, 20);
  cairo_text_extents(cr, text, &e);
  double x = fmax(dyd_view_x(v, box[1]), dyd_view_x(v, box[0] / 2 + box[1] / 2) + 3.5) + 5,
         y = fmin(dyd_view_y(v, box[3]), dyd_view_y(v, box[2] / 2 + box[3] / 2) - 3.5) - 4;
  cairo_move_to(cr, fmin(x, EDGE + v->width - e.x_advance - 4), fmax(y, EDGE + 20));
  cairo_text_path(cr, text);
  dyd_picture_pen(cr, 0xffffff, 4, 0, 0);
  cairo_stroke_preserve(cr);
  dyd_picture_colour(cr, 0);
  cairo_fill(cr);
}

void dyd_picture_entry(cairo_t *cr, double *x, double y, unsigned rgb, bool fill, double on, double off,
                       const char *text) {
  cairo_text_extents_t e;
  cairo_new_path(cr);
  if (fill) {
    cairo_rectangle(cr, *x, y - 7, 30, 14);
    dyd_picture_colour(cr, rgb);
    cairo_fill_preserve(cr);
    dyd_picture_pen(cr, 0x555555, 0.6, 0, 0);
  } else {
    cairo_move_to(cr, *x, y);
    cairo_line_to(cr, *x + 30, y);
    dyd_picture_pen(cr, rgb, 2, on, off);
  }
  cairo_stroke(cr);
  dyd_picture_colour(cr, 0);
  cairo_set_font_size(cr, 14);
  cairo_text_extents(cr, text, &e);
  dyd_picture_text(cr, *x + 36, y + 5, 0, 14, text);
  *x += 60 + e.x_advance;
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
  dyd_picture_pen(cr, 0x222222, 1.5, 0, 0);
  cairo_stroke(cr);
  dyd_picture_text(cr, right, y + 20, 1, 14, text);
}
