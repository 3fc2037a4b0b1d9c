/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The layers of a sphere: pairs, points, triangles. In wkt and geojson one place stands for where a point may be, and
 * sides are great circles. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/geodesic.h"
#include "io/parts.h"
#include "io/result.h"

/* Where a point may be, in degrees. */
typedef struct degree_box {
  double end[4];
} degree_box;

static dyd_table_head sphere_head(const dyd_output *o, const char *const *column, dyd_geometry geometry) {
  const dyd_sphere_result *r = o->what;
  return (dyd_table_head){o->out, o->format, column, geometry, r->epsg, dyd_sphere_places(r->sphere), r->sphere};
}

static dyd_status sphere_boxes(degree_box **out, const dyd_sphere *s) {
  size_t n = dyd_engine_count(dyd_sphere_places(s));
  degree_box *box = dyd_alloc(n, sizeof *box);
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
  degree_box *box = NULL;
  dyd_table t;
  dyd_status st = o->format == DYD_FORMAT_CSV ? DYD_OK : sphere_boxes(&box, r->sphere);
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

/* How many partners of each status a point has; aliases as the point that they are. */
typedef struct partner_count {
  size_t of[4];
} partner_count;

static dyd_status partners_count(partner_count **out, const dyd_sphere_result *r) {
  size_t n = dyd_engine_count(dyd_sphere_places(r->sphere));
  partner_count *c = calloc(n + 1, sizeof *c);
  if (!c) return DYD_E_NOMEM;
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    c[p->i].of[p->status]++;
    c[p->j].of[p->status]++;
  }
  for (uint32_t i = 0; i < n; i++) c[i] = c[dyd_sphere_alias(r->sphere, i)];
  *out = c;
  return DYD_OK;
}

/* On a sphere there is no hull. */
dyd_status dyd_sphere_layer_points(const dyd_output *o) {
  static const char *const column[] = {"i",   "id",   "xlo", "xhi", "ylo", "yhi", "legal", "indeterminate",
                                       "tie", "hull", NULL};
  const dyd_sphere_result *r = o->what;
  const dyd_table_head head = sphere_head(o, column, DYD_GEOMETRY_POINT);
  degree_box *box = NULL;
  partner_count *partners = NULL;
  dyd_table t;
  dyd_status st = sphere_boxes(&box, r->sphere);
  if (st == DYD_OK) st = partners_count(&partners, r);
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
      dyd_row_index(&t, partners[i].of[DYD_LEGAL]);
      dyd_row_index(&t, partners[i].of[DYD_INDETERMINATE]);
      dyd_row_index(&t, partners[i].of[DYD_TIE]);
      dyd_row_text(&t, "not");
      dyd_row_end(&t);
    }
    dyd_table_end(&t);
  }
  free(partners);
  free(box);
  return st;
}

/* A triangle that is no less than half of the sphere has the other side of its corners on its left. */
static dyd_status triangle_outline(dyd_table *t, const degree_box *box, const uint32_t v[3]) {
  dyd_lon_lat corner[3];
  if (!box) return DYD_OK;
  for (int c = 0; c < 3; c++) corner[c] = dyd_lon_lat_of(box[v[c]].end);
  return dyd_turns_left(corner) ? dyd_row_around(t, corner, 3) : DYD_OK;
}

dyd_status dyd_sphere_layer_triangles(const dyd_output *o) {
  static const char *const column[] = {"i", "j", "k", "id_i", "id_j", "id_k", NULL};
  const dyd_sphere_result *r = o->what;
  const dyd_table_head head = sphere_head(o, column, DYD_GEOMETRY_POLYGONS);
  dyd_triangle_list list = {0};
  degree_box *box = NULL;
  dyd_table t;
  dyd_status st = o->format == DYD_FORMAT_CSV ? DYD_OK : sphere_boxes(&box, r->sphere);
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
