/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages: paths, and what is common to all kinds. */
#include "base/alloc.h"
#include "base/error.h"
#include "picture/canvas_path.h"

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

/* ---- all kinds ---- */

static bool is_svg(const dyd_canvas *c) {
  return c->format == DYD_FORMAT_SVG;
}

void dyd_canvas_paint(dyd_canvas *c, const dyd_paint *paint) {
  if (is_svg(c))
    dyd_svg_paint(c, paint);
  else
    dyd_cairo_paint(c, paint);
  c->count = 0;
  c->id[0] = c->title[0] = 0;
}

void dyd_canvas_clip(dyd_canvas *c) {
  if (is_svg(c))
    dyd_svg_clip(c);
  else
    dyd_cairo_clip(c);
  c->count = 0;
}

void dyd_canvas_unclip(dyd_canvas *c) {
  if (is_svg(c))
    dyd_svg_unclip(c);
  else
    dyd_cairo_unclip(c);
}

void dyd_canvas_name(dyd_canvas *c, const char *id, const char *title) {
  snprintf(c->id, sizeof c->id, "%s", id);
  snprintf(c->title, sizeof c->title, "%s", title);
}

double dyd_canvas_width(dyd_canvas *c, double size, const char *text) {
  return dyd_cairo_width(c, size, text);
}

void dyd_canvas_text(dyd_canvas *c, double x, double y, double align, double size, bool halo, const char *text) {
  if (is_svg(c))
    dyd_svg_text(c, x, y, align, size, halo, text);
  else
    dyd_cairo_text(c, x - align * dyd_canvas_width(c, size, text), y, halo, text);
}

/* ---- pages ---- */

dyd_canvas *dyd_canvas_new(const dyd_output *o, double width, double height, const char *title) {
  dyd_canvas *c = calloc(1, sizeof *c);
  if (!c) return NULL;
  c->format = o->format;
  c->out = o->out;
  dyd_cairo_begin(c, width, height);
  if (is_svg(c)) dyd_svg_begin(c, width, height, title);
  dyd_canvas_box(c, 0, 0, width, height);
  dyd_canvas_paint(c, &(dyd_paint){0xffffff, DYD_NO_COLOUR, 1, 0, 0, 0});
  return c;
}

dyd_status dyd_canvas_end(dyd_canvas *c, dyd_status st, dyd_error *err) {
  if (!c) return DYD_E_NOMEM;
  if (is_svg(c)) dyd_svg_end(c);
  st = dyd_cairo_end(c, st, err);
  free(c->step);
  free(c);
  return st;
}
