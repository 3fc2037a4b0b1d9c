/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages, and what is drawn on them. */
#include "picture/picture.h"

#include "base/error.h"
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <errno.h>
#include <math.h>
#include <string.h>

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

void dyd_picture_stroke(cairo_t *cr, unsigned rgb, double width, double on, double off) {
  dyd_picture_pen(cr, rgb, width, on, off);
  cairo_stroke(cr);
}

void dyd_picture_fill(cairo_t *cr, unsigned rgb) {
  dyd_picture_colour(cr, rgb);
  cairo_fill(cr);
}

void dyd_picture_dot(cairo_t *cr, double x, double y, double radius, unsigned fill, unsigned edge) {
  cairo_new_path(cr);
  cairo_arc(cr, x, y, radius, 0, 2 * acos(-1.0));
  dyd_picture_colour(cr, fill);
  cairo_fill_preserve(cr);
  dyd_picture_stroke(cr, edge, 1.2, 0, 0);
  dyd_picture_colour(cr, 0);
}

void dyd_picture_entry(cairo_t *cr, double *x, double y, unsigned rgb, bool fill, double on, double off,
                       const char *text) {
  cairo_text_extents_t e;
  cairo_new_path(cr);
  if (fill) {
    cairo_rectangle(cr, *x, y - 7, 30, 14);
    dyd_picture_colour(cr, rgb);
    cairo_fill_preserve(cr);
    dyd_picture_stroke(cr, 0x555555, 0.6, 0, 0);
  } else {
    cairo_move_to(cr, *x, y);
    cairo_line_to(cr, *x + 30, y);
    dyd_picture_stroke(cr, rgb, 2, on, off);
  }
  dyd_picture_colour(cr, 0);
  cairo_set_font_size(cr, 14);
  cairo_text_extents(cr, text, &e);
  dyd_picture_text(cr, *x + 36, y + 5, 0, 14, text);
  *x += 60 + e.x_advance;
}
