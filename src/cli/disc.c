/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel disc FILE: the partial disc of the first three points and where the others are, narrowed until that is sure.
 */
#include "pieces.h"
#include <stdlib.h>

enum { TRIPLE = 3 };

static bool is_known(const cli_pieces *p, size_t i) {
  return dyd_con(p->rect[i], p->rect[0], p->rect[1], p->rect[2]) != DYD_UNSURE;
}

static bool all_known(cli_pieces *p) {
  if (dyd_orientation(p->rect[0], p->rect[1], p->rect[2]) == DYD_UNSURE) return false;
  for (size_t i = TRIPLE; i < p->count; i++)
    if (!is_known(p, i)) return false;
  return true;
}

/* While the orientation is open nothing is gained by the others. */
static bool wanted(const cli_pieces *p, size_t i) {
  if (i < TRIPLE) return true;
  return dyd_orientation(p->rect[0], p->rect[1], p->rect[2]) != DYD_UNSURE && !is_known(p, i);
}

static dyd_status print(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const cli_pieces *p = what;
  return dyd_write_disc(out, p->rect, p->count, p->outcome, o->format, err);
}

int cli_disc(const cli_options *o) {
  cli_pieces p;
  int status = cli_pieces_open(&p, o, TRIPLE, SIZE_MAX);
  if (!status) status = cli_pieces_run(&p, all_known, wanted);
  if (!status) status = cli_write_file(o->output, o, print, &p);
  return cli_pieces_close(&p, status);
}
