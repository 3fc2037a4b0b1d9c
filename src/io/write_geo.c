/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Formats for geographic and mesh programs: wkt, geojson, obj. One place per site stands for its rectangle; each
 * format says how far at most the rectangle reaches from it. */
#include "base/alloc.h"
#include "io/label_text.h"
#include "io/result.h"
#include <math.h>

static dyd_status wkt_delaunay(const dyd_output *o) {
  const dyd_result *r = o->what;
  dyd_place *place = NULL;
  char bound[DYD_DECIMAL_SIZE];
  dyd_status st = dyd_result_places(&place, bound, r, o->err);
  if (st != DYD_OK) return st;
  fprintf(r->out, "WKT,i,j,status%s,max_coordinate_error\n", dyd_csv_id_head(r->engine, 2));
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    const dyd_place *a = &place[p->i], *b = &place[p->j];
    dyd_decimal_directed(bound, fmax(a->error, b->error), 2, DYD_UP);
    fprintf(r->out, "\"LINESTRING (%s %s, %s %s)\",%zu,%zu,%s", a->x, a->y, b->x, b->y, dyd_engine_row(r->engine, p->i),
            dyd_engine_row(r->engine, p->j), dyd_pair_status_text(p->status));
    dyd_csv_ids(r->out, r->engine, (const uint32_t[]){p->i, p->j}, 2);
    fprintf(r->out, ",%s\n", bound);
  }
  free(place);
  return DYD_OK;
}

static dyd_status geojson_delaunay(const dyd_output *o) {
  const dyd_result *r = o->what;
  dyd_place *place = NULL;
  char bound[DYD_DECIMAL_SIZE];
  dyd_status st = dyd_result_places(&place, bound, r, o->err);
  if (st != DYD_OK) return st;
  fprintf(r->out,
          "{\"type\": \"FeatureCollection\",\n\"rounding\": \"a coordinate differs from every point of the "
          "rectangle it stands for by at most max_coordinate_error\",\n\"max_coordinate_error\": %s,\n"
          "\"outcome\": \"%s\",\n\"features\": [",
          bound, dyd_outcome_text(dyd_engine_outcome(r->engine)));
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    const dyd_place *a = &place[p->i], *b = &place[p->j];
    fprintf(r->out,
            "%s\n{\"type\": \"Feature\", \"geometry\": {\"type\": \"LineString\", \"coordinates\": [[%s, %s], "
            "[%s, %s]]}, \"properties\": {\"i\": %zu, \"j\": %zu, \"status\": \"%s\"",
            k ? "," : "", a->x, a->y, b->x, b->y, dyd_engine_row(r->engine, p->i), dyd_engine_row(r->engine, p->j),
            dyd_pair_status_text(p->status));
    dyd_json_ids(r->out, r->engine, (const uint32_t[]){p->i, p->j}, 2);
    fputs("}}", r->out);
  }
  fputs("\n]}\n", r->out);
  free(place);
  return DYD_OK;
}

static void obj_elements(const dyd_result *r, const dyd_triangle_list *triangles) {
  fputs("g legal_edges\n", r->out);
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    if (p->status == DYD_LEGAL) fprintf(r->out, "l %u %u\n", (unsigned)p->i + 1, (unsigned)p->j + 1);
  }
  fputs("g sure_triangles\n", r->out);
  for (size_t k = 0; k < triangles->count; k++) {
    const uint32_t *v = triangles->item[k].v;
    fprintf(r->out, "f %u %u %u\n", (unsigned)v[0] + 1, (unsigned)v[1] + 1, (unsigned)v[2] + 1);
  }
}

/* What the next vertex is called, where its place in the file does not tell. */
static void obj_name(const dyd_result *r, uint32_t i) {
  const char *id = dyd_engine_id(r->engine, i);
  if (!id && dyd_engine_row(r->engine, i) == i) return;
  fprintf(r->out, "# row %zu", dyd_engine_row(r->engine, i));
  dyd_json_ids(r->out, r->engine, &i, 0);
  fputs("\n", r->out);
}

static dyd_status obj_delaunay(const dyd_output *o) {
  const dyd_result *r = o->what;
  dyd_place *place = NULL;
  dyd_triangle_list triangles = {0};
  char bound[DYD_DECIMAL_SIZE];
  size_t count[4];
  dyd_status st = dyd_result_places(&place, bound, r, o->err);
  if (st == DYD_OK) st = dyd_delaunay_triangles(&triangles, r->pd);
  if (st == DYD_OK) {
    dyd_delaunay_count(count, r->pd);
    fprintf(r->out,
            "# dyadel %s, outcome %s\n# a coordinate differs from every point of the rectangle it stands for by at "
            "most %s\n# not shown: %zu indeterminate pairs, %zu ties\n",
            dyd_version(), dyd_outcome_text(dyd_engine_outcome(r->engine)), bound, count[DYD_INDETERMINATE],
            count[DYD_TIE]);
    for (uint32_t i = 0; i < r->count; i++) {
      obj_name(r, i);
      fprintf(r->out, "v %s %s 0\n", place[i].x, place[i].y);
    }
    obj_elements(r, &triangles);
  }
  dyd_triangle_list_clear(&triangles);
  free(place);
  return st;
}

dyd_writer *const dyd_wkt_writers[DYD_CONTENTS] = {
    [DYD_CONTENT_DELAUNAY] = wkt_delaunay, [DYD_CONTENT_VORONOI] = dyd_voronoi_wkt};
dyd_writer *const dyd_geojson_writers[DYD_CONTENTS] = {
    [DYD_CONTENT_DELAUNAY] = geojson_delaunay, [DYD_CONTENT_VORONOI] = dyd_voronoi_geojson};
dyd_writer *const dyd_obj_writers[DYD_CONTENTS] = {[DYD_CONTENT_DELAUNAY] = obj_delaunay};
