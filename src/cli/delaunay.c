/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel delaunay FILE: read, run, write. */
#include "cli.h"

static dyd_status write_delaunay(FILE *out, const dyd_engine *e, const cli_options *o, dyd_error *err) {
  return dyd_write_delaunay(out, e, o->format, err);
}

int cli_delaunay(const cli_options *o) {
  return cli_session_all(o, write_delaunay);
}
