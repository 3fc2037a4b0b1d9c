/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The layers of a sphere: pairs, points, triangles. In wkt and geojson one place stands for where a point may be, and
 * sides are great circles. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/geodesic.h"
#include "io/parts.h"
#include "io/result.h"

static dyd_table_head sphere_head(const dyd_output *o, const char *const *column, dyd_geometry geometry) {
  const dyd_sphere_result *r = o->what;
  return (dyd_table_head){o->out, o->format, column, geometry, r->epsg, dyd_sphere_places(r->sphere), r->sphere};
}

dyd_status dyd_sphere_boxes(dyd_degree_box **out, const dyd_sphere *s) {
  size_t n = dyd_engine_count(dyd_sphere_places(s));
  dyd_degree_box *box = dyd_alloc(n, sizeof *box);
  dyd_rect r;
  dyd_status st = box ? DYD_OK : DYD_E_NOMEM;
  dyd_rect_init(&r);
  for (uint32_t i = 0; i < n && st == DYD_OK; i++) {
    st = dyd_sphere_rect(&r, s, i);
    if (st == DYD_OK) dyd_rect_get_d(box[i].end, &r);
  }
  dyd_rect_clear(&r);
  if (st == DYD_OK)
    *out = box;
  else
    free(box);
  return st;
}

/* In csv: aliases, from where, and whether pairs are missing. */
static void sphere_comments(const dyd_output *o) {
  const dyd_sphere *s = ((const dyd_sphere_result *)o->what)->sphere;
  if (o->format != DYD_FORMAT_CSV) return;
  dyd_csv_sphere_aliases(o->out, s);
  if (dyd_delaunay_is_capped(dyd_engine_delaunay(dyd_sphere_images(s))))
    fputs("# capped: further pairs may be possible\n", o->out);
}

dyd_status dyd_sphere_layer_pairs(const dyd_output *o) {
  const dyd_sphere_result *r = o->what;
  const dyd_table_head head = sphere_head(o, dyd_columns_of_pairs, DYD_GEOMETRY_LINES);
  dyd_degree_box *box = NULL;
  dyd_table t;
  dyd_status st = o->format == DYD_FORMAT_CSV ? DYD_OK : dyd_sphere_boxes(&box, r->sphere);
  if (st != DYD_OK) return st;
  sphere_comments(o);
  dyd_table_begin(&t, &head);
  for (size_t k = 0; k < r->pairs.count && st == DYD_OK; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    dyd_row_begin(&t);
    if (box) st = dyd_row_arc(&t, box[p->i].end, box[p->j].end);
    dyd_row_pair(&t, p->i, p->j, dyd_pair_status_text(p->status));
    dyd_row_end(&t);
  }
  dyd_table_end(&t);
  free(box);
  return st;
}

/* On a sphere there is no hull. */
dyd_status dyd_sphere_sites(dyd_site_row **out, const dyd_sphere_result *r) {
  size_t n = dyd_engine_count(dyd_sphere_places(r->sphere));
  dyd_site_row *rows = calloc(n + 1, sizeof *rows);
  if (!rows) return DYD_E_NOMEM;
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    rows[p->i].partners[p->status]++;
    rows[p->j].partners[p->status]++;
  }
  for (uint32_t i = 0; i < n; i++) {
    rows[i] = rows[dyd_sphere_alias(r->sphere, i)];
    rows[i].hull = "not";
  }
  *out = rows;
  return DYD_OK;
}

dyd_status dyd_sphere_layer_points(const dyd_output *o) {
  static const char *const column[] = {"i",   "id",   "xlo", "xhi", "ylo", "yhi", "legal", "indeterminate",
                                       "tie", "hull", NULL};
  const dyd_sphere_result *r = o->what;
  const dyd_table_head head = sphere_head(o, column, DYD_GEOMETRY_POINT);
  dyd_degree_box *box = NULL;
  dyd_site_row *rows = NULL;
  dyd_table t;
  dyd_status st = dyd_sphere_boxes(&box, r->sphere);
  if (st == DYD_OK) st = dyd_sphere_sites(&rows, r);
  if (st == DYD_OK) {
    sphere_comments(o);
    if (o->format == DYD_FORMAT_CSV) fputs("# rounding: lo down, hi up\n", o->out);
    dyd_table_begin(&t, &head);
    for (size_t i = 0; i < dyd_engine_count(head.engine); i++) {
      dyd_row_begin(&t);
      dyd_row_at(&t, box[i].end);
      dyd_row_site(&t, i);
      dyd_row_id(&t, i);
      dyd_row_box(&t, box[i].end);
      dyd_row_index(&t, rows[i].partners[DYD_LEGAL]);
      dyd_row_index(&t, rows[i].partners[DYD_INDETERMINATE]);
      dyd_row_index(&t, rows[i].partners[DYD_TIE]);
      dyd_row_text(&t, rows[i].hull);
      dyd_row_end(&t);
    }
    dyd_table_end(&t);
  }
  free(rows);
  free(box);
  return st;
}

/* ---- meshes ---- */

dyd_status dyd_sphere_vectors(dyd_vector_text **out, char bound[DYD_DECIMAL_SIZE], const dyd_sphere_result *r,
                              dyd_error *err) {
  size_t n = dyd_engine_count(dyd_sphere_places(r->sphere));
  dyd_vector_text *v = dyd_alloc(n, sizeof *v);
  dyd_status st = v ? DYD_OK : DYD_E_NOMEM;
  double box[6], error, most = 0;
  for (uint32_t i = 0; i < n && st == DYD_OK; i++) {
    st = dyd_sphere_vector(box, r->sphere, i, err);
    for (int a = 0; a < 3 && st == DYD_OK; a++) {
      dyd_decimal_within(v[i].at[a], &error, box[2 * a], box[2 * a + 1]);
      most = error > most ? error : most;
    }
  }
  dyd_decimal_directed(bound, most, 2, DYD_UP);
  if (st == DYD_OK)
    *out = v;
  else
    free(v);
  return st;
}

dyd_result dyd_sphere_mesh(const dyd_output *o) {
  const dyd_sphere_result *r = o->what;
  const dyd_engine *places = dyd_sphere_places(r->sphere);
  return (dyd_result){.out = o->out, .engine = places, .count = dyd_engine_count(places), .pairs = r->pairs};
}

/* ---- triangles ---- */

enum { TRIANGLE_ARC = 2 }; /* degrees */

/* A triangle that is no less than half of the sphere has the other side of its corners on its left. */
static dyd_status triangle_outline(dyd_table *t, const dyd_degree_box *box, const uint32_t v[3]) {
  dyd_lon_lat corner[3];
  dyd_side side[3];
  if (!box) return DYD_OK;
  for (int c = 0; c < 3; c++) corner[c] = dyd_lon_lat_of(box[v[c]].end);
  for (int c = 0; c < 3; c++) side[c] = (dyd_side){.from = corner[c], .to = corner[(c + 1) % 3]};
  return dyd_turns_left(corner) ? dyd_row_around(t, side, 3, TRIANGLE_ARC) : DYD_OK;
}

dyd_status dyd_sphere_layer_triangles(const dyd_output *o) {
  static const char *const column[] = {"i", "j", "k", "id_i", "id_j", "id_k", NULL};
  const dyd_sphere_result *r = o->what;
  const dyd_table_head head = sphere_head(o, column, DYD_GEOMETRY_POLYGONS);
  dyd_triangle_list list = {0};
  dyd_degree_box *box = NULL;
  dyd_table t;
  dyd_status st = o->format == DYD_FORMAT_CSV ? DYD_OK : dyd_sphere_boxes(&box, r->sphere);
  if (st == DYD_OK) st = dyd_sphere_triangles(&list, r->sphere);
  if (st == DYD_OK && o->format == DYD_FORMAT_CSV) dyd_csv_sphere_aliases(o->out, r->sphere);
  if (st == DYD_OK) dyd_table_begin(&t, &head);
  for (size_t k = 0; k < list.count && st == DYD_OK; k++) {
    const uint32_t *v = list.item[k].v;
    dyd_row_begin(&t);
    st = triangle_outline(&t, box, v);
    for (int c = 0; c < 3; c++) dyd_row_site(&t, v[c]);
    for (int c = 0; c < 3; c++) dyd_row_id(&t, v[c]);
    dyd_row_end(&t);
  }
  if (st == DYD_OK) dyd_table_end(&t);
  dyd_triangle_list_clear(&list);
  free(box);
  return st;
}
