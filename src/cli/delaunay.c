/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel delaunay FILE: read, run, write. A window is what pictures show. */
#include "cli.h"

static dyd_status delaunay_write(FILE *out, const void *engine, const cli_options *o, dyd_error *err) {
  const dyd_delaunay_output how = {DYD_SIZED(dyd_delaunay_output), o->view, o->content, o->epsg};
  return dyd_write_delaunay_as(out, engine, &how, o->format, err);
}

int cli_delaunay(const cli_options *o) {
  cli_options own = *o; /* with the window read */
  dyd_rect window;
  dyd_rect_init(&window);
  int status = 0;
  if (o->window) {
    own.view = &window;
    status = cli_window_read(&window, o->window) ? 0 : CLI_USAGE;
  }
  if (!status) status = cli_session_all(&own, delaunay_write);
  dyd_rect_clear(&window);
  return status;
}
