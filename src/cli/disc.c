/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel disc FILE: the partial disc of the first three points and where the others are, narrowed until that is sure.
 */
#include "pieces.h"

enum { TRIPLE = 3 };

static bool disc_is_oriented(const cli_pieces *p) {
  return dyd_orientation(p->rect[0], p->rect[1], p->rect[2]) != DYD_UNSURE;
}

static bool disc_knows(const cli_pieces *p, size_t i) {
  return dyd_con(p->rect[i], p->rect[0], p->rect[1], p->rect[2]) != DYD_UNSURE;
}

static bool disc_is_answered(const cli_pieces *p) {
  size_t i = disc_is_oriented(p) ? TRIPLE : 0;
  while (i >= TRIPLE && i < p->count && disc_knows(p, i)) i++;
  return i == p->count;
}

/* While the orientation is open nothing is gained by the others. */
static bool disc_wants(const cli_pieces *p, size_t i) {
  return i < TRIPLE || (disc_is_oriented(p) && !disc_knows(p, i));
}

static dyd_status disc_print(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const cli_pieces *p = what;
  const dyd_write_options how = {DYD_SIZED(dyd_write_options), .rect = p->rect, .rects = p->count,
                                 .outcome = p->outcome};
  return dyd_write(out, p->session.engine, o->content, o->format, &how, err);
}

int cli_disc(const cli_options *o) {
  return cli_pieces_all(o, TRIPLE, SIZE_MAX, disc_is_answered, disc_wants, disc_print);
}
