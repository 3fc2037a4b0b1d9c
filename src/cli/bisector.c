/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel bisector FILE: the partial bisector of the first two points, narrowed until their rectangles are disjoint. */
#include "pieces.h"

static bool bisector_is_answered(const cli_pieces *p) {
  return !dyd_rect_meets(p->rect[0], p->rect[1]);
}

static bool bisector_wants(const cli_pieces *p, size_t i) {
  (void)p, (void)i;
  return true;
}

static dyd_status bisector_print(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const cli_pieces *p = what;
  const dyd_write_options how = {DYD_SIZED(dyd_write_options), .rect = p->rect, .rects = 2, .outcome = p->outcome};
  return dyd_write(out, p->session.engine, o->content, o->format, &how, err);
}

int cli_bisector(const cli_options *o) {
  return cli_pieces_all(o, 2, 2, bisector_is_answered, bisector_wants, bisector_print);
}
