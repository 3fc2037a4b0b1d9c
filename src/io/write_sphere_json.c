/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The json format of a sphere: everything that is stated. */
#include "io/label_text.h"
#include "io/parts.h"
#include "io/result.h"

static void sphere_json_head(const dyd_sphere_result *r, FILE *out) {
  const dyd_engine *places = dyd_sphere_places(r->sphere), *images = dyd_sphere_images(r->sphere);
  size_t count[4] = {0};
  for (size_t k = 0; k < r->pairs.count; k++) count[r->pairs.item[k].status]++;
  dyd_json_head(out, "dyadel sphere 1");
  dyd_json_crs(out, r->epsg);
  fprintf(out,
          "\"rounding\": \"x (longitude) and y (latitude) are degrees: exact where both ends are equal, else rounded "
          "outward; x_decimal and y_decimal are rounded outward: the first down, the second up\",\n"
          "\"surface\": \"sphere\",\n\"outcome\": \"%s\",\n\"capped\": %s,\n",
          dyd_outcome_text(dyd_sphere_outcome(r->sphere)),
          dyd_delaunay_is_capped(dyd_engine_delaunay(images)) ? "true" : "false");
  fprintf(out, "\"count\": {\"sites\": %zu, \"legal\": %zu, \"indeterminate\": %zu, \"tie\": %zu},\n",
          dyd_engine_count(places), count[DYD_LEGAL], count[DYD_INDETERMINATE], count[DYD_TIE]);
  if (dyd_sphere_centre(r->sphere) != DYD_NO_PLACE)
    fprintf(out, "\"projected_from\": %zu,\n", dyd_engine_row(places, dyd_sphere_centre(r->sphere)));
}

static dyd_status sphere_json_sites(const dyd_sphere_result *r, FILE *out) {
  const dyd_engine *places = dyd_sphere_places(r->sphere);
  dyd_rect rect;
  double box[4];
  dyd_status st = DYD_OK;
  dyd_rect_init(&rect);
  fputs("\"sites\": [", out);
  for (uint32_t i = 0; i < dyd_engine_count(places) && st == DYD_OK; i++) {
    st = dyd_sphere_rect(&rect, r->sphere, i);
    if (st != DYD_OK) break;
    fprintf(out, "%s\n{\"i\": %zu, ", i ? "," : "", dyd_engine_row(places, i));
    st = dyd_json_sides(out, &rect, ", ");
    fputs(", ", out);
    dyd_rect_get_d(box, &rect);
    dyd_json_box(out, "_decimal", box);
    dyd_json_ids(out, places, &i, 0);
    fputs("}", out);
  }
  fputs("\n],\n", out);
  dyd_rect_clear(&rect);
  return st;
}

dyd_status dyd_sphere_json(const dyd_output *o) {
  const dyd_sphere_result *r = o->what;
  const dyd_engine *places = dyd_sphere_places(r->sphere);
  dyd_triangle_list triangles = {0};
  sphere_json_head(r, o->out);
  dyd_status st = sphere_json_sites(r, o->out);
  if (st == DYD_OK) st = dyd_sphere_triangles(&triangles, r->sphere);
  if (st == DYD_OK) {
    dyd_json_sphere_aliases(o->out, r->sphere, ",\n");
    dyd_json_pairs(o->out, places, "pairs", &r->pairs);
    fputs(",\n", o->out);
    dyd_json_triangles(o->out, places, &triangles);
    dyd_json_counters(o->out, dyd_sphere_images(r->sphere));
    fputs("}\n", o->out);
  }
  dyd_triangle_list_clear(&triangles);
  return st;
}
