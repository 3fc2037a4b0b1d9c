/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What cairo draws: pdf and png; and how wide texts are. */
#include "base/error.h"
#include "picture/canvas.h"
#include <cairo-pdf.h>
#include <errno.h>
#include <math.h>
#include <string.h>

#define SCALE_OF_PNG 2

bool dyd_cairo_is_there(void) {
  return true;
}

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

static void cairo_put_text(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text) {
  x -= align * dyd_cairo_width(c, size, text);
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

static void cairo_clip_path(dyd_canvas *c) {
  cairo_save(c->cr);
  cairo_path(c);
  cairo_clip(c->cr);
}

static void cairo_unclip(dyd_canvas *c) {
  cairo_restore(c->cr);
}

double dyd_cairo_width(dyd_canvas *c, double size, const char *text) {
  cairo_text_extents_t e;
  cairo_set_font_size(c->cr, size);
  cairo_text_extents(c->cr, text, &e);
  return e.x_advance;
}

/* ---- pages ---- */

static cairo_status_t canvas_put(void *closure, const unsigned char *data, unsigned length) {
  dyd_canvas *c = closure;
  if (fwrite(data, 1, length, c->out) == length) return CAIRO_STATUS_SUCCESS;
  if (!c->error) c->error = errno ? errno : EIO;
  return CAIRO_STATUS_WRITE_ERROR;
}

static cairo_surface_t *new_surface(dyd_canvas *c, double width, double height) {
  if (c->format == DYD_FORMAT_PDF) return cairo_pdf_surface_create_for_stream(canvas_put, c, width, height);
  if (c->format != DYD_FORMAT_PNG) return cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)ceil(width * SCALE_OF_PNG),
                                    (int)ceil(height * SCALE_OF_PNG));
}

const dyd_canvas_kind dyd_canvas_cairo = {
    .paint = cairo_paint_path, .clip = cairo_clip_path, .unclip = cairo_unclip, .text = cairo_put_text};

void dyd_cairo_begin(dyd_canvas *c) {
  const double *b = c->box, scale = c->scale * (c->format == DYD_FORMAT_PNG ? SCALE_OF_PNG : 1);
  cairo_surface_t *surface = new_surface(c, (b[1] - b[0]) * c->scale, (b[3] - b[2]) * c->scale);
  c->cr = cairo_create(surface);
  cairo_surface_destroy(surface); /* cr holds it */
  cairo_select_font_face(c->cr, c->font ? c->font : "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_line_cap(c->cr, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(c->cr, CAIRO_LINE_JOIN_ROUND);
  if (c->kind != &dyd_canvas_cairo) return; /* texts are measured in the lengths of the page */
  cairo_colour(c->cr, 0xffffff, 1);
  if (c->format == DYD_FORMAT_PNG) cairo_paint(c->cr); /* pixels that the page covers in part, too */
  cairo_scale(c->cr, scale, scale);
  cairo_translate(c->cr, -b[0], -b[2]);
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

dyd_status dyd_cairo_end(dyd_canvas *c, dyd_status st, dyd_error *err) {
  cairo_status_t status = end_surface(c);
  if (c->failed || status == CAIRO_STATUS_NO_MEMORY)
    st = DYD_E_NOMEM;
  else if (c->error)
    st = dyd_fail(err, DYD_E_IO, "cannot write: %s", strerror(c->error));
  else if (status != CAIRO_STATUS_SUCCESS)
    st = dyd_fail(err, DYD_E_IO, "cannot write the picture: %s", cairo_status_to_string(status));
  cairo_destroy(c->cr);
  return st;
}
