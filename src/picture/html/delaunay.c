/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages of the triangulation, and of graphs of neighbours. */
#include "picture/html/file.h"
#include "picture/html/html.h"
#include "picture/html/scene.h"

#include "io/json.h"

/* Up to which motion of all points nothing changes at all. */
static dyd_status html_whole(FILE *out, const void *result) {
  const dyd_result *r = result;
  double lo, hi;
  dyd_json j;
  if (!r->tolerance) return DYD_OK;
  dyd_tolerance_whole(&lo, &hi, r->tolerance);
  dyd_json_begin(&j, out);
  dyd_json_decimals(&j, "tolerance", lo, hi);
  return dyd_json_end(&j, ",\n");
}

static dyd_status html_pairs_page(FILE *to, const dyd_output *o) {
  return dyd_html_scene_write(o, to, o->what, "delaunay", html_whole, o->what);
}

dyd_status dyd_html_triangulation(const dyd_output *o) {
  return dyd_html_write(o, html_pairs_page);
}
