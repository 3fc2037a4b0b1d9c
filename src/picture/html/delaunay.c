/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages of the triangulation; its layers differ by what is seen first. */
#include "picture/html/file.h"
#include "picture/html/html.h"
#include "picture/html/scene.h"

#include "io/parts.h"

/* Up to which motion of all points nothing changes at all. */
static void html_whole(const dyd_html_scene *s) {
  double lo, hi;
  if (!s->r->tolerance) return;
  dyd_tolerance_whole(&lo, &hi, s->r->tolerance);
  fputs("\"tolerance\": ", s->out);
  dyd_json_decimals(s->out, lo, hi);
  fputs(",\n", s->out);
}

static dyd_status html_triangulation(FILE *to, const dyd_output *o, const char *layer) {
  dyd_html_scene s;
  dyd_status st = dyd_html_scene_init(&s, to, o->what, o->err);
  if (st == DYD_OK) st = dyd_html_scene_head(&s, "delaunay", layer);
  if (st == DYD_OK) html_whole(&s);
  if (st == DYD_OK) st = dyd_html_scene_body(&s);
  fputs("}\n", to);
  dyd_html_scene_clear(&s);
  return st;
}

dyd_status dyd_html_pairs(const dyd_output *o) {
  return dyd_html_write(o, html_triangulation, "pairs");
}

dyd_status dyd_html_points(const dyd_output *o) {
  return dyd_html_write(o, html_triangulation, "points");
}

dyd_status dyd_html_triangles(const dyd_output *o) {
  return dyd_html_write(o, html_triangulation, "triangles");
}
