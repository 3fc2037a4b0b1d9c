/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Instead of canvas_cairo.c where the library was built without cairo: only svg is drawn. */
#include "picture/canvas.h"

bool dyd_cairo_is_there(void) {
  return false;
}

void dyd_cairo_begin(dyd_canvas *c, double width, double height) {
  (void)c, (void)width, (void)height;
}

dyd_status dyd_cairo_end(dyd_canvas *c, dyd_status st, dyd_error *err) {
  (void)err;
  return c->failed ? DYD_E_NOMEM : st;
}

void dyd_cairo_paint(dyd_canvas *c, const dyd_paint *p) {
  (void)c, (void)p;
}

void dyd_cairo_clip(dyd_canvas *c) {
  (void)c;
}

void dyd_cairo_unclip(dyd_canvas *c) {
  (void)c;
}

/* Of sans-serif letters, which are rarely wider; continuation bytes of UTF-8 are none. */
double dyd_cairo_width(dyd_canvas *c, double size, const char *text) {
  size_t letters = 0;
  (void)c;
  for (; *text; text++) letters += ((unsigned char)*text & 0xc0) != 0x80;
  return 0.58 * size * (double)letters;
}

void dyd_cairo_text(dyd_canvas *c, double x, double y, bool halo, const char *text) {
  (void)c, (void)x, (void)y, (void)halo, (void)text;
}
