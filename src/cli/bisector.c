/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel bisector FILE: the partial bisector of the first two points, narrowed until their rectangles are disjoint. */
#include "pieces.h"

static bool apart(cli_pieces *p) {
  return !dyd_rect_meets(p->rect[0], p->rect[1]);
}

static bool wanted(const cli_pieces *p, size_t i) {
  (void)p, (void)i;
  return true;
}

static dyd_status print(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const cli_pieces *p = what;
  return dyd_write_bisector(out, p->rect[0], p->rect[1], p->outcome, o->format, err);
}

int cli_bisector(const cli_options *o) {
  cli_pieces p;
  int status = cli_pieces_open(&p, o, 2, 2);
  if (!status) status = cli_pieces_run(&p, apart, wanted);
  if (!status) status = cli_write_file(o->output, o, print, &p);
  return cli_pieces_close(&p, status);
}
