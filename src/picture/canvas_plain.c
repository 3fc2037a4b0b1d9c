/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Instead of canvas_cairo.c where the library was built without cairo: only svg and TikZ are drawn. */
#include "picture/canvas.h"

bool dyd_cairo_is_there(void) {
  return false;
}

const dyd_canvas_kind dyd_canvas_cairo = {0};

void dyd_cairo_begin(dyd_canvas *c) {
  (void)c;
}

dyd_status dyd_cairo_end(dyd_canvas *c, dyd_status st, dyd_error *err) {
  (void)err;
  return c->failed ? DYD_E_NOMEM : st;
}

/* Of sans-serif letters, which are rarely wider; continuation bytes of UTF-8 are none. */
double dyd_cairo_width(dyd_canvas *c, double size, const char *text) {
  size_t letters = 0;
  (void)c;
  for (; *text; text++) letters += ((unsigned char)*text & 0xc0) != 0x80;
  return 0.58 * size * (double)letters;
}
