/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages: paths, parts common to all kinds, and svg, in which text stays text and elements have names. */
#include "picture/canvas.h"
#include "base/alloc.h"
#include "base/error.h"

#include <math.h>
#include <string.h>

/* ---- svg: pieces ---- */

void dyd_put_length(dyd_sink *to, double x) {
  int64_t n = llround(fmin(fmax(x, -1e12), 1e12) * 100);
  uint64_t size = (uint64_t)(n < 0 ? -n : n), rest = size % 100;
  char *p = dyd_sink_room(to, DYD_INDEX_SIZE + sizeof "-.25");
  if (n < 0) *p++ = '-';
  p = dyd_put_digits(p, size / 100);
  if (rest) *p++ = '.', *p++ = (char)('0' + rest / 10);
  if (rest % 10) *p++ = (char)('0' + rest % 10);
  to->end = p;
}

void dyd_put_lengths(dyd_sink *to, const char *before, const double *x, int count, const char *between) {
  dyd_sink_text(to, before);
  for (int k = 0; k < count; k++) {
    if (k) dyd_sink_text(to, between);
    dyd_put_length(to, x[k]);
  }
}

static void put_lengths(dyd_sink *to, const char *before, const double *x, int count) {
  dyd_put_lengths(to, before, x, count, " ");
}

static void put_attribute(dyd_sink *to, const char *name, double x) {
  dyd_sink_text(to, " ");
  dyd_sink_text(to, name);
  dyd_sink_text(to, "=\"");
  dyd_put_length(to, x);
  dyd_sink_text(to, "\"");
}

static void put_escaped(dyd_sink *to, const char *text) {
  for (; *text; text++) {
    const char *entity = *text == '<' ? "&lt;" : *text == '>' ? "&gt;" : *text == '&' ? "&amp;" : NULL;
    if (*text == '"') entity = "&quot;";
    dyd_sink_put(to, entity ? entity : text, entity ? strlen(entity) : 1);
  }
}

/* An arc to its end; a full circle needs two. */
static void put_arc(dyd_sink *to, const double z[6]) {
  double sweep = z[4] - z[3];
  int parts = sweep > 6 ? 2 : 1;
  for (int k = 1; k <= parts; k++) {
    double turn = z[3] + sweep * k / parts, end[2] = {z[0] + z[2] * cos(turn), z[1] + z[2] * sin(turn)};
    put_lengths(to, "A", (const double[]){z[2], z[2]}, 2);
    put_lengths(to, sweep / parts > 3.1416 ? " 0 1 1 " : " 0 0 1 ", end, 2);
  }
}

static void put_path(dyd_canvas *c) {
  dyd_sink *to = &c->to;
  dyd_sink_text(to, " d=\"");
  for (size_t k = 0; k < c->count; k++) {
    const double *z = c->step[k].z;
    switch (c->step[k].kind) {
    case DYD_STROKE_MOVE:
      put_lengths(to, "M", z, 2);
      break;
    case DYD_STROKE_LINE:
      put_lengths(to, "L", z, 2);
      break;
    case DYD_STROKE_CURVE:
      put_lengths(to, "C", z, 6);
      break;
    case DYD_STROKE_ARC:
      put_lengths(to, k ? "L" : "M", (const double[]){z[0] + z[2] * cos(z[3]), z[1] + z[2] * sin(z[3])}, 2);
      put_arc(to, z);
      break;
    case DYD_STROKE_CLOSE:
      dyd_sink_text(to, "Z");
    }
  }
  dyd_sink_text(to, "\"");
}

/* ---- svg: groups of one paint ---- */

static void put_colour(dyd_sink *to, const char *name, unsigned rgb) {
  char text[] = "#rrggbb";
  snprintf(text + 1, sizeof text - 1, "%06x", rgb & 0xffffff);
  dyd_sink_text(to, " ");
  dyd_sink_text(to, name);
  dyd_sink_text(to, "=\"");
  dyd_sink_text(to, rgb == DYD_NO_COLOUR ? "none" : text);
  dyd_sink_text(to, "\"");
}

static bool same_paint(const dyd_paint *a, const dyd_paint *b) {
  return a->fill == b->fill && a->stroke == b->stroke && a->alpha == b->alpha && a->width == b->width &&
         a->on == b->on && a->off == b->off;
}

bool dyd_canvas_group(dyd_canvas *c, const dyd_paint *p, const char *end) {
  if (c->open && p && same_paint(p, &c->shared)) return false;
  if (c->open) dyd_sink_text(&c->to, end);
  c->open = p;
  if (p) c->shared = *p;
  return true;
}

static void close_group(dyd_canvas *c) {
  dyd_canvas_group(c, NULL, "</g>\n");
}

static void open_group(dyd_canvas *c, const dyd_paint *p) {
  if (!dyd_canvas_group(c, p, "</g>\n")) return;
  dyd_sink_text(&c->to, "<g");
  put_colour(&c->to, "fill", p->fill);
  if (p->fill != DYD_NO_COLOUR && p->alpha < 1) put_attribute(&c->to, "fill-opacity", p->alpha);
  if (p->stroke != DYD_NO_COLOUR) {
    put_colour(&c->to, "stroke", p->stroke);
    put_attribute(&c->to, "stroke-width", p->width);
    if (p->off > 0) {
      put_lengths(&c->to, " stroke-dasharray=\"", (const double[]){p->on, p->off}, 2);
      dyd_sink_text(&c->to, "\"");
    }
  }
  dyd_sink_text(&c->to, ">\n");
}

/* ---- svg: the page ---- */

/* Points where a width was given, else pixels. */
static void put_extent(dyd_canvas *c, const char *before, double x) {
  put_lengths(&c->to, before, (const double[]){x * c->scale}, 1);
  dyd_sink_text(&c->to, c->scale == 1 ? "\"" : "pt\"");
}

static void svg_begin(dyd_canvas *c, const char *title) {
  const double *b = c->box, view[4] = {b[0], b[2], b[1] - b[0], b[3] - b[2]};
  dyd_sink_text(&c->to, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"");
  put_extent(c, " width=\"", view[2]);
  put_extent(c, " height=\"", view[3]);
  put_lengths(&c->to, " viewBox=\"", view, 4);
  dyd_sink_text(&c->to, "\" font-family=\"");
  put_escaped(&c->to, c->font ? c->font : "sans-serif");
  dyd_sink_text(&c->to, "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>");
  put_escaped(&c->to, title);
  dyd_sink_text(&c->to, "</title>\n");
}

static void svg_end(dyd_canvas *c) {
  close_group(c);
  dyd_sink_text(&c->to, "</svg>\n");
}

static void svg_paint(dyd_canvas *c, const dyd_paint *paint) {
  if (c->count == 0) return;
  open_group(c, paint);
  dyd_sink_text(&c->to, "<path");
  if (c->id[0]) {
    dyd_sink_text(&c->to, " id=\"");
    dyd_sink_text(&c->to, c->id);
    dyd_sink_text(&c->to, "\"");
  }
  put_path(c);
  if (!c->title[0]) {
    dyd_sink_text(&c->to, "/>\n");
    return;
  }
  dyd_sink_text(&c->to, "><title>");
  put_escaped(&c->to, c->title);
  dyd_sink_text(&c->to, "</title></path>\n");
}

static void svg_clip(dyd_canvas *c) {
  close_group(c);
  dyd_sink_text(&c->to, "<clipPath id=\"clip");
  dyd_sink_index(&c->to, ++c->clips);
  dyd_sink_text(&c->to, "\"><path");
  put_path(c);
  dyd_sink_text(&c->to, "/></clipPath>\n<g clip-path=\"url(#clip");
  dyd_sink_index(&c->to, c->clips);
  dyd_sink_text(&c->to, ")\">\n");
}

static void svg_unclip(dyd_canvas *c) {
  close_group(c);
  dyd_sink_text(&c->to, "</g>\n");
}

static void svg_text(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text) {
  close_group(c);
  dyd_sink_text(&c->to, "<text");
  put_attribute(&c->to, "x", x);
  put_attribute(&c->to, "y", y);
  put_attribute(&c->to, "font-size", size);
  if (align > 0) dyd_sink_text(&c->to, align < 1 ? " text-anchor=\"middle\"" : " text-anchor=\"end\"");
  if (halo) dyd_sink_text(&c->to, " stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"");
  dyd_sink_text(&c->to, ">");
  put_escaped(&c->to, text);
  dyd_sink_text(&c->to, "</text>\n");
}

static const double full_turn = 6.283185307179586;

/* ---- the path ---- */

static void path_add(dyd_canvas *c, dyd_path_step step) {
  if (!DYD_GROW(c->step, c->cap, c->count + 1))
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

/* ---- all kinds ---- */

static const dyd_canvas_kind svg_kind = {svg_begin, svg_end, svg_paint, svg_clip, svg_unclip, svg_text}, nowhere = {0};

/* Lines of a page that is made small stay thick enough to be seen. */
#define THINNEST 0.25

void dyd_canvas_paint(dyd_canvas *c, const dyd_paint *paint) {
  dyd_paint p = *paint;
  if (c->scale < 1) p.width = fmax(p.width, THINNEST / c->scale);
  if (c->kind->paint) c->kind->paint(c, &p);
  c->count = 0;
  c->id[0] = c->title[0] = 0;
}

void dyd_canvas_clip(dyd_canvas *c) {
  if (c->kind->clip) c->kind->clip(c);
  c->count = 0;
}

void dyd_canvas_unclip(dyd_canvas *c) {
  if (c->kind->unclip) c->kind->unclip(c);
}

void dyd_canvas_name(dyd_canvas *c, const char *id, const char *title) {
  snprintf(c->id, sizeof c->id, "%s", id);
  snprintf(c->title, sizeof c->title, "%s", title);
}

double dyd_canvas_width(dyd_canvas *c, double size, const char *text) {
  return dyd_cairo_width(c, size * c->text, text);
}

void dyd_canvas_text(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text) {
  if (c->kind->text) c->kind->text(c, x, y, align, size * c->text, halo, text);
  c->low = fmax(c->low, y);
}

void dyd_picture_stroke(dyd_canvas *c, unsigned rgb, double width, double on, double off) {
  double unit = fmax(width, 0.7);
  dyd_canvas_paint(c, &(dyd_paint){DYD_NO_COLOUR, rgb, 1, width, on * unit, off * unit});
}

void dyd_picture_fill(dyd_canvas *c, unsigned rgb) {
  dyd_canvas_paint(c, &(dyd_paint){rgb, DYD_NO_COLOUR, 1, 0, 0, 0});
}

void dyd_picture_shape(dyd_canvas *c, unsigned fill, double alpha, unsigned edge, double width) {
  dyd_canvas_paint(c, &(dyd_paint){fill, edge, alpha, width, 0, 0});
}

void dyd_picture_line(dyd_canvas *c, double z[2][2], unsigned rgb, double width, double on, double off) {
  dyd_canvas_move(c, z[0][0], z[0][1]);
  dyd_canvas_line(c, z[1][0], z[1][1]);
  dyd_picture_stroke(c, rgb, width, on, off);
}

void dyd_picture_dot(dyd_canvas *c, double x, double y, double radius, unsigned fill, unsigned edge) {
  dyd_canvas_circle(c, x, y, radius);
  dyd_picture_shape(c, fill, 1, edge, 1.2);
}

/* ---- pages ---- */

dyd_status dyd_page_fit(dyd_page *out, const dyd_output *o, double inner, double rim) {
  enum { USUAL = 14, READABLE = 7 };
  double points = o->style.font_size, least = o->style.width / (inner + rim) * USUAL;
  *out = (dyd_page){points > 0 ? points / USUAL : 1, 1};
  if (!(o->style.width > 0)) return DYD_OK;
  if (!(points > 0)) points = fmax(least, READABLE);
  out->text = points * inner / (USUAL * o->style.width - rim * points);
  if (!(out->text > 0 && out->text <= (rim > 0 ? 12 : 60)))
    return dyd_fail(
        o->err, DYD_E_ARG,
        "a picture %g points wide has no room beside texts of %g points; take a larger width, or smaller texts",
        o->style.width, points);
  out->scale = o->style.width / (inner + rim * out->text);
  return DYD_OK;
}

static const dyd_canvas_kind *kind_of(dyd_format f) {
  if (f == DYD_FORMAT_SVG || f == DYD_FORMAT_TIKZ) return f == DYD_FORMAT_SVG ? &svg_kind : &dyd_canvas_tikz;
  return f == DYD_FORMAT_PDF || f == DYD_FORMAT_PNG ? &dyd_canvas_cairo : &nowhere;
}

dyd_canvas *dyd_canvas_new(const dyd_output *o, const dyd_page *page, const double box[4], const char *title) {
  dyd_canvas *c = calloc(1, sizeof *c);
  if (!c) return NULL;
  c->format = o->format;
  c->kind = kind_of(o->format);
  c->font = o->style.font;
  c->text = page->text, c->scale = page->scale;
  memcpy(c->box, box, sizeof c->box);
  c->out = o->out;
  dyd_cairo_begin(c);
  if (c->kind->begin) {
    dyd_sink_begin(&c->to, c->out);
    c->kind->begin(c, title);
  }
  dyd_canvas_box(c, box[0], box[2], box[1] - box[0], box[3] - box[2]);
  dyd_canvas_paint(c, &(dyd_paint){0xffffff, DYD_NO_COLOUR, 1, 0, 0, 0});
  return c;
}

dyd_status dyd_canvas_end(dyd_canvas *c, dyd_status st, dyd_error *err) {
  if (!c) return DYD_E_NOMEM;
  if (c->kind->end) {
    c->kind->end(c);
    dyd_sink_flush(&c->to);
  }
  st = dyd_cairo_end(c, st, err);
  dyd_free_all(c->step, c);
  return st;
}
