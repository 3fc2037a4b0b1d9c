/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The layers of the triangulation: pairs, points, triangles. In wkt and geojson one place stands for each rectangle. */
#include "base/alloc.h"
#include "io/parts.h"
#include "io/result.h"
#include "io/table.h"

static dyd_table_head layer_head(const dyd_output *o, const char *const *column, dyd_geometry geometry) {
  const dyd_result *r = o->what;
  return (dyd_table_head){o->out, o->format, column, geometry, r->epsg, r->engine, NULL};
}

/* The places of all sites; none for csv. */
static dyd_status layer_places(dyd_place **out, const dyd_output *o) {
  char bound[DYD_DECIMAL_SIZE];
  return o->format == DYD_FORMAT_CSV ? DYD_OK : dyd_result_places(out, bound, o->what, o->err);
}

/* In csv: aliases, and the faces within which more may be possible than is listed or counted. */
static dyd_status layer_comments(const dyd_output *o) {
  const dyd_result *r = o->what;
  if (o->format != DYD_FORMAT_CSV) return DYD_OK;
  dyd_csv_aliases(o->out, r->engine);
  if (!dyd_delaunay_is_capped(r->pd)) return DYD_OK;
  fputs("# capped: pairs within one of these faces may be possible though they are not listed\n", o->out);
  return dyd_result_faces(r, "# face ", "# face ", " ", "\n");
}

/* A line between two sites, its columns i, j before, id_i, id_j behind what it says. */
static void pair_row_begin(dyd_table *t, const dyd_place *place, uint32_t i, uint32_t j) {
  dyd_row_begin(t);
  if (place) {
    dyd_row_place(t, &place[i]);
    dyd_row_place(t, &place[j]);
  }
  dyd_row_site(t, i);
  dyd_row_site(t, j);
}

static void pair_row_end(dyd_table *t, uint32_t i, uint32_t j) {
  dyd_row_id(t, i);
  dyd_row_id(t, j);
  dyd_row_end(t);
}

dyd_status dyd_layer_pairs(const dyd_output *o) {
  static const char *const column[] = {"i", "j", "status", "id_i", "id_j", NULL};
  const dyd_result *r = o->what;
  const dyd_table_head head = layer_head(o, column, DYD_GEOMETRY_LINE);
  dyd_place *place = NULL;
  dyd_table t;
  dyd_status st = layer_places(&place, o);
  if (st == DYD_OK) st = layer_comments(o);
  if (st == DYD_OK) dyd_table_begin(&t, &head);
  for (size_t k = 0; k < r->pairs.count && st == DYD_OK; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    pair_row_begin(&t, place, p->i, p->j);
    dyd_row_text(&t, dyd_pair_status_text(p->status));
    pair_row_end(&t, p->i, p->j);
  }
  if (st == DYD_OK) dyd_table_end(&t);
  free(place);
  return st;
}

dyd_status dyd_layer_graph(const dyd_output *o) {
  static const char *const column[] = {"i", "j", "status", "id_i", "id_j", NULL};
  const dyd_result *r = o->what;
  const dyd_table_head head = layer_head(o, column, DYD_GEOMETRY_LINE);
  dyd_place *place = NULL;
  dyd_table t;
  dyd_status st = layer_places(&place, o);
  if (st != DYD_OK) return st;
  if (o->format == DYD_FORMAT_CSV) dyd_csv_aliases(o->out, r->engine);
  dyd_table_begin(&t, &head);
  for (size_t k = 0; k < r->graph.count; k++) {
    const dyd_graph_edge *e = &r->graph.item[k];
    pair_row_begin(&t, place, e->i, e->j);
    dyd_row_text(&t, e->sure ? "sure" : "possible");
    pair_row_end(&t, e->i, e->j);
  }
  dyd_table_end(&t);
  free(place);
  return DYD_OK;
}

static void point_row(dyd_table *t, const dyd_result *r, size_t i, const dyd_place *place, const dyd_site_row *row) {
  double box[4];
  dyd_sites_get_d(box, r->sites, i);
  dyd_row_begin(t);
  if (place) dyd_row_place(t, &place[i]);
  dyd_row_site(t, i);
  dyd_row_id(t, i);
  dyd_row_box(t, box);
  dyd_row_index(t, row->partners[DYD_LEGAL]);
  dyd_row_index(t, row->partners[DYD_INDETERMINATE]);
  dyd_row_index(t, row->partners[DYD_TIE]);
  dyd_row_text(t, row->hull);
  dyd_row_end(t);
}

dyd_status dyd_layer_points(const dyd_output *o) {
  static const char *const column[] = {"i",   "id",   "xlo", "xhi", "ylo", "yhi", "legal", "indeterminate",
                                       "tie", "hull", NULL};
  const dyd_result *r = o->what;
  const dyd_table_head head = layer_head(o, column, DYD_GEOMETRY_POINT);
  dyd_place *place = NULL;
  dyd_site_row *rows = NULL;
  dyd_table t;
  dyd_status st = layer_places(&place, o);
  if (st == DYD_OK) st = dyd_result_sites(&rows, r);
  if (st == DYD_OK) st = layer_comments(o);
  if (st == DYD_OK) {
    if (o->format == DYD_FORMAT_CSV) fputs("# rounding: lo down, hi up; empty: beyond doubles\n", o->out);
    dyd_table_begin(&t, &head);
    for (size_t i = 0; i < r->count; i++) point_row(&t, r, i, place, &rows[i]);
    dyd_table_end(&t);
  }
  free(rows);
  free(place);
  return st;
}

dyd_status dyd_layer_triangles(const dyd_output *o) {
  static const char *const column[] = {"i", "j", "k", "id_i", "id_j", "id_k", NULL};
  const dyd_result *r = o->what;
  const dyd_table_head head = layer_head(o, column, DYD_GEOMETRY_POLYGON);
  dyd_triangle_list list = {0};
  dyd_place *place = NULL;
  dyd_table t;
  dyd_status st = layer_places(&place, o);
  if (st == DYD_OK) st = dyd_delaunay_triangles(&list, r->pd);
  if (st == DYD_OK && o->format == DYD_FORMAT_CSV) dyd_csv_aliases(o->out, r->engine);
  if (st == DYD_OK) dyd_table_begin(&t, &head);
  for (size_t k = 0; k < list.count && st == DYD_OK; k++) {
    const uint32_t *v = list.item[k].v;
    dyd_row_begin(&t);
    for (int c = 0; place && c < 4; c++) dyd_row_place(&t, &place[v[c % 3]]);
    for (int c = 0; c < 3; c++) dyd_row_site(&t, v[c]);
    for (int c = 0; c < 3; c++) dyd_row_id(&t, v[c]);
    dyd_row_end(&t);
  }
  if (st == DYD_OK) dyd_table_end(&t);
  dyd_triangle_list_clear(&list);
  free(place);
  return st;
}
