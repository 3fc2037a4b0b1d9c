/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages: paths, what is common to all kinds, and the kinds that cairo draws. */
#include "base/alloc.h"
#include "base/error.h"
#include "picture/canvas_path.h"
#include <cairo-pdf.h>
#include <errno.h>
#include <math.h>
#include <string.h>

#define SCALE_OF_PNG 2

static const double full_turn = 6.283185307179586;

/* ---- the path ---- */

static void path_add(dyd_canvas *c, dyd_path_step step) {
  if (!dyd_reserve((void **)&c->step, &c->cap, c->count + 1, sizeof *c->step))
    c->failed = true;
  else
    c->step[c->count++] = step;
}

void dyd_canvas_move(dyd_canvas *c, double x, double y) {
  path_add(c, (dyd_path_step){DYD_STROKE_MOVE, {x, y}});
}

void dyd_canvas_line(dyd_canvas *c, double x, double y) {
  path_add(c, (dyd_path_step){c->count ? DYD_STROKE_LINE : DYD_STROKE_MOVE, {x, y}});
}

void dyd_canvas_curve(dyd_canvas *c, double x1, double y1, double x2, double y2, double x, double y) {
  path_add(c, (dyd_path_step){DYD_STROKE_CURVE, {x1, y1, x2, y2, x, y}});
}

void dyd_canvas_arc(dyd_canvas *c, double x, double y, double radius, double from, double to) {
  path_add(c, (dyd_path_step){DYD_STROKE_ARC, {x, y, radius, from, to}});
}

void dyd_canvas_close(dyd_canvas *c) {
  path_add(c, (dyd_path_step){.kind = DYD_STROKE_CLOSE});
}

void dyd_canvas_circle(dyd_canvas *c, double x, double y, double radius) {
  dyd_canvas_move(c, x + radius, y);
  dyd_canvas_arc(c, x, y, radius, 0, full_turn);
  dyd_canvas_close(c);
}

void dyd_canvas_box(dyd_canvas *c, double x, double y, double width, double height) {
  dyd_canvas_move(c, x, y);
  dyd_canvas_line(c, x + width, y);
  dyd_canvas_line(c, x + width, y + height);
  dyd_canvas_line(c, x, y + height);
  dyd_canvas_close(c);
}

/* ---- with cairo ---- */

static void cairo_path(const dyd_canvas *c) {
  cairo_new_path(c->cr);
  for (size_t k = 0; k < c->count; k++) {
    const double *z = c->step[k].z;
    switch (c->step[k].kind) {
    case DYD_STROKE_MOVE:
      cairo_move_to(c->cr, z[0], z[1]);
      break;
    case DYD_STROKE_LINE:
      cairo_line_to(c->cr, z[0], z[1]);
      break;
    case DYD_STROKE_CURVE:
      cairo_curve_to(c->cr, z[0], z[1], z[2], z[3], z[4], z[5]);
      break;
    case DYD_STROKE_ARC:
      cairo_arc(c->cr, z[0], z[1], z[2], z[3], z[4]);
      break;
    case DYD_STROKE_CLOSE:
      cairo_close_path(c->cr);
    }
  }
}

static void cairo_colour(cairo_t *cr, unsigned rgb, double alpha) {
  cairo_set_source_rgba(cr, (rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0, alpha);
}

static void cairo_paint_path(dyd_canvas *c, const dyd_paint *p) {
  const double dash[2] = {p->on, p->off};
  cairo_path(c);
  if (p->fill != DYD_NO_COLOUR) {
    cairo_colour(c->cr, p->fill, p->alpha);
    cairo_fill_preserve(c->cr);
  }
  if (p->stroke != DYD_NO_COLOUR) {
    cairo_colour(c->cr, p->stroke, 1);
    cairo_set_line_width(c->cr, p->width);
    cairo_set_dash(c->cr, dash, p->off > 0 ? 2 : 0, 0);
    cairo_stroke_preserve(c->cr);
  }
}

static void cairo_put_text(dyd_canvas *c, double x, double y, bool halo, const char *text) {
  cairo_new_path(c->cr);
  cairo_move_to(c->cr, x, y);
  if (halo) {
    cairo_text_path(c->cr, text);
    cairo_colour(c->cr, 0xffffff, 1);
    cairo_set_line_width(c->cr, 3);
    cairo_set_dash(c->cr, NULL, 0, 0);
    cairo_stroke(c->cr);
    cairo_move_to(c->cr, x, y);
  }
  cairo_colour(c->cr, 0, 1);
  cairo_show_text(c->cr, text);
}

/* ---- all kinds ---- */

static bool is_svg(const dyd_canvas *c) {
  return c->format == DYD_FORMAT_SVG;
}

void dyd_canvas_paint(dyd_canvas *c, const dyd_paint *paint) {
  if (is_svg(c))
    dyd_svg_paint(c, paint);
  else
    cairo_paint_path(c, paint);
  c->count = 0;
  c->id[0] = c->title[0] = 0;
}

void dyd_canvas_clip(dyd_canvas *c) {
  if (is_svg(c)) {
    dyd_svg_clip(c);
  } else {
    cairo_save(c->cr);
    cairo_path(c);
    cairo_clip(c->cr);
  }
  c->count = 0;
}

void dyd_canvas_unclip(dyd_canvas *c) {
  if (is_svg(c))
    dyd_svg_unclip(c);
  else
    cairo_restore(c->cr);
}

void dyd_canvas_name(dyd_canvas *c, const char *id, const char *title) {
  snprintf(c->id, sizeof c->id, "%s", id);
  snprintf(c->title, sizeof c->title, "%s", title);
}

double dyd_canvas_width(dyd_canvas *c, double size, const char *text) {
  cairo_text_extents_t e;
  cairo_set_font_size(c->cr, size);
  cairo_text_extents(c->cr, text, &e);
  return e.x_advance;
}

void dyd_canvas_text(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text) {
  if (is_svg(c))
    dyd_svg_text(c, x, y, align, size, halo, text);
  else
    cairo_put_text(c, x - align * dyd_canvas_width(c, size, text), y, halo, text);
}

/* ---- pages ---- */

static cairo_status_t canvas_put(void *closure, const unsigned char *data, unsigned length) {
  dyd_canvas *c = closure;
  if (fwrite(data, 1, length, c->out) == length) return CAIRO_STATUS_SUCCESS;
  if (!c->error) c->error = errno ? errno : EIO;
  return CAIRO_STATUS_WRITE_ERROR;
}

static cairo_surface_t *new_surface(dyd_canvas *c, double width, double height) {
  if (is_svg(c)) return cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  if (c->format == DYD_FORMAT_PDF) return cairo_pdf_surface_create_for_stream(canvas_put, c, width, height);
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)ceil(width * SCALE_OF_PNG),
                                    (int)ceil(height * SCALE_OF_PNG));
}

dyd_canvas *dyd_canvas_new(const dyd_output *o, double width, double height, const char *title) {
  dyd_canvas *c = calloc(1, sizeof *c);
  if (!c) return NULL;
  c->format = o->format;
  c->out = o->out;
  cairo_surface_t *surface = new_surface(c, width, height);
  c->cr = cairo_create(surface);
  cairo_surface_destroy(surface); /* cr holds it */
  cairo_select_font_face(c->cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_line_cap(c->cr, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(c->cr, CAIRO_LINE_JOIN_ROUND);
  if (c->format == DYD_FORMAT_PNG) cairo_scale(c->cr, SCALE_OF_PNG, SCALE_OF_PNG);
  if (is_svg(c)) dyd_svg_begin(c, width, height, title);
  dyd_canvas_box(c, 0, 0, width, height);
  dyd_canvas_paint(c, &(dyd_paint){0xffffff, DYD_NO_COLOUR, 1, 0, 0, 0});
  return c;
}

/* Hands over what cairo has drawn. */
static cairo_status_t end_surface(dyd_canvas *c) {
  cairo_surface_t *surface = cairo_get_target(c->cr);
  cairo_status_t status = cairo_status(c->cr);
  if (c->format == DYD_FORMAT_PNG && status == CAIRO_STATUS_SUCCESS)
    status = cairo_surface_write_to_png_stream(surface, canvas_put, c);
  cairo_surface_finish(surface);
  return status == CAIRO_STATUS_SUCCESS ? cairo_surface_status(surface) : status;
}

dyd_status dyd_canvas_end(dyd_canvas *c, dyd_status st, dyd_error *err) {
  if (!c) return DYD_E_NOMEM;
  if (is_svg(c)) dyd_svg_end(c);
  cairo_status_t status = end_surface(c);
  if (c->failed || status == CAIRO_STATUS_NO_MEMORY)
    st = DYD_E_NOMEM;
  else if (c->error)
    st = dyd_fail(err, DYD_E_IO, "cannot write: %s", strerror(c->error));
  else if (status != CAIRO_STATUS_SUCCESS)
    st = dyd_fail(err, DYD_E_IO, "cannot write the picture: %s", cairo_status_to_string(status));
  cairo_destroy(c->cr);
  free(c->step);
  free(c);
  return st;
}
