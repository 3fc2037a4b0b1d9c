/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The layers of the triangulation: pairs, points, triangles. In wkt and geojson one place stands for each rectangle. */
#include "base/alloc.h"
#include "io/diagram.h"
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

/* A line between two sites. */
static void pair_row(dyd_table *t, const dyd_place *place, uint32_t i, uint32_t j, const char *status) {
  dyd_row_begin(t);
  if (place) {
    dyd_row_place(t, &place[i]);
    dyd_row_place(t, &place[j]);
  }
  dyd_row_pair(t, i, j, status);
  dyd_row_end(t);
}

typedef dyd_status pair_rows(dyd_table *t, const dyd_result *r, const dyd_place *place);

/* The pairs of i and later sites: of those that are not listed from *next on, ties. */
static dyd_status rows_of_site(dyd_table *t, const dyd_result *r, const dyd_place *place, uint32_t i, size_t *next) {
  dyd_index_list near = {0};
  dyd_status st = dyd_delaunay_neighbours(&near, r->pd, i, DYD_TIE);
  for (size_t q = 0; q < near.count; q++) {
    const dyd_pair *p = *next < r->pairs.count ? &r->pairs.item[*next] : NULL;
    bool listed = p && p->i == i && p->j == near.item[q];
    if (near.item[q] < i) continue;
    *next += listed;
    pair_row(t, place, i, near.item[q], dyd_pair_status_text(listed ? p->status : DYD_TIE));
  }
  dyd_index_list_clear(&near);
  return st;
}

/* Places are asked for ahead: those of the second sites lie anywhere. */
static dyd_status rows_of_triangulation(dyd_table *t, const dyd_result *r, const dyd_place *place) {
  enum { AHEAD = 12 };
  size_t next = 0;
  dyd_status st = DYD_OK;
  for (size_t i = 0; r->ties_apart && i < r->count && st == DYD_OK; i++)
    if (dyd_delaunay_alias(r->pd, (uint32_t)i) == i) st = rows_of_site(t, r, place, (uint32_t)i, &next);
  if (r->ties_apart) return st;
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    if (place && k + AHEAD < r->pairs.count) dyd_place_fetch(&place[p[AHEAD].j]);
    pair_row(t, place, p->i, p->j, dyd_pair_status_text(p->status));
  }
  return DYD_OK;
}

static dyd_status rows_of_graph(dyd_table *t, const dyd_result *r, const dyd_place *place) {
  for (size_t k = 0; k < r->graph.count; k++) {
    const dyd_graph_edge *e = &r->graph.item[k];
    pair_row(t, place, e->i, e->j, e->sure ? "sure" : "possible");
  }
  return DYD_OK;
}

static dyd_status layer_of_pairs(const dyd_output *o, pair_rows *rows, dyd_status (*comments)(const dyd_output *)) {
  const dyd_table_head head = layer_head(o, dyd_columns_of_pairs, DYD_GEOMETRY_LINE);
  dyd_place *place = NULL;
  dyd_table t;
  dyd_status st = layer_places(&place, o);
  if (st == DYD_OK) st = comments(o);
  if (st == DYD_OK) {
    dyd_table_begin(&t, &head);
    st = rows(&t, o->what, place);
    dyd_table_end(&t);
  }
  free(place);
  return st;
}

dyd_status dyd_layer_pairs(const dyd_output *o) {
  return layer_of_pairs(o, rows_of_triangulation, layer_comments);
}

static dyd_status graph_comments(const dyd_output *o) {
  if (o->format == DYD_FORMAT_CSV) dyd_csv_aliases(o->out, ((const dyd_result *)o->what)->engine);
  return DYD_OK;
}

dyd_status dyd_layer_graph(const dyd_output *o) {
  return layer_of_pairs(o, rows_of_graph, graph_comments);
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

/* Rows without a point of their own, at the place of the one they have in common. */
dyd_status dyd_layer_aliases(const dyd_output *o) {
  static const char *const column[] = {"i", "of", NULL};
  const dyd_diagram *d = o->content == DYD_CONTENT_VORONOI_ALIASES ? o->what : NULL;
  const dyd_result *r = d ? NULL : o->what;
  const dyd_table_head head = {
      o->out, o->format, column, DYD_GEOMETRY_POINT, d ? d->epsg : r->epsg, d ? d->engine : r->engine, NULL};
  dyd_alias_walk w = {.e = head.engine};
  dyd_table t;
  dyd_table_begin(&t, &head);
  while (dyd_alias_next(&w)) {
    double box[4];
    dyd_sites_get_d(box, d ? d->sites : r->sites, w.site);
    dyd_row_begin(&t);
    if (dyd_box_is_finite(box)) dyd_row_at(&t, box);
    dyd_row_index(&t, w.row);
    dyd_row_index(&t, w.of);
    dyd_row_end(&t);
  }
  dyd_table_end(&t);
  return DYD_OK;
}

/* ---- ties ---- */

const char *dyd_group_text(dyd_group_kind kind) {
  static const char *const text[] = {"circle", "chain", "pair"};
  return text[kind];
}

static dyd_status group_row(void *context, dyd_group_kind kind, const dyd_index_list *sites) {
  dyd_table *t = context;
  dyd_row_begin(t);
  dyd_row_text(t, dyd_group_text(kind));
  dyd_status st = dyd_row_sites(t, sites);
  dyd_row_end(t);
  return st;
}

/* In csv: a row for each group. */
dyd_status dyd_layer_ties(const dyd_output *o) {
  static const char *const column[] = {"kind", "sites", NULL};
  const dyd_table_head head = layer_head(o, column, DYD_GEOMETRY_POINT);
  dyd_table t;
  dyd_table_begin(&t, &head);
  dyd_status st = dyd_delaunay_each_group(((const dyd_result *)o->what)->pd, group_row, &t);
  dyd_table_end(&t);
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
  if (st == DYD_OK && r->discs) st = dyd_disc_triangles(&list, &r->pairs, r->pd);
  if (st == DYD_OK && !r->discs) st = dyd_delaunay_triangles(&list, r->pd);
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
