/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Formats of the Voronoi diagram for geographic programs: wkt, geojson. Polygons and boxes, with how far at most a
 * coordinate is from the exact one. */
#include "io/diagram.h"
#include "io/label_text.h"
#include "io/parts.h"
#include <math.h>

/* Rounding of a decimal made of a double, or of the double made of a dyadic, never exceeds this share of the
 * coordinate. */
#define ROUNDING 0x1p-51

typedef struct layer {
  const dyd_diagram *d;
  bool geojson, any;
} layer;

static void layer_xy(const layer *l, double x, double y) {
  if (l->geojson) fputs("[", l->d->out);
  dyd_decimal_put_near(l->d->out, x);
  fputs(l->geojson ? ", " : " ", l->d->out);
  dyd_decimal_put_near(l->d->out, y);
  if (l->geojson) fputs("]", l->d->out);
}

static void begin_feature(layer *l, const char *kind, const char *geometry) {
  if (l->geojson)
    fprintf(l->d->out, "%s\n{\"type\": \"Feature\", \"properties\": {\"kind\": \"%s\"", l->any ? "," : "", kind);
  else
    fprintf(l->d->out, "\"%s ", geometry);
  l->any = true;
}

static void layer_ring(const layer *l, const dyd_polygon *p) {
  FILE *out = l->d->out;
  fputs(l->geojson ? "[" : "(", out);
  for (size_t k = 0; k <= p->count; k++) {
    const dyd_point *z = &p->vertex[k % p->count];
    if (k) fputs(", ", out);
    layer_xy(l, dyd_dyadic_get_d(&z->x, DYD_DOWN), dyd_dyadic_get_d(&z->y, DYD_DOWN));
  }
  fputs(l->geojson ? "]" : ")", out);
}

static void layer_polygon(layer *l, const char *kind, uint32_t i, const dyd_polygon *p, const double area[2]) {
  FILE *out = l->d->out;
  if (p->count < 3) return;
  begin_feature(l, kind, "POLYGON");
  if (l->geojson) {
    fprintf(out, ", \"i\": %zu", dyd_engine_row(l->d->engine, i));
    dyd_json_ids(out, l->d->engine, &i, 0);
    fputs(", \"cell_area\": ", out);
    dyd_json_decimals(out, area[0], area[1]);
    fputs("}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\": [", out);
    layer_ring(l, p);
    fputs("]}}", out);
  } else {
    fputs("(", out);
    layer_ring(l, p);
    fprintf(out, ")\",%s,%zu,,", kind, dyd_engine_row(l->d->engine, i));
    dyd_csv_row_end(l->d->out, l->d->engine, &i, 1);
  }
}

static dyd_status layer_cell(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  layer *l = context;
  dyd_polygon inner = {0};
  dyd_polygon_list outer = {0};
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK) st = dyd_shape_outer(&outer, shape);
  if (st == DYD_OK) layer_polygon(l, "surely nearest", i, &inner, row->area);
  for (size_t k = 0; st == DYD_OK && k < outer.count; k++)
    layer_polygon(l, "possibly nearest", i, &outer.item[k], row->area);
  dyd_polygon_list_clear(&outer);
  dyd_polygon_clear(&inner);
  return st;
}

static void layer_box(layer *l, const char *kind, const double b[4], const uint32_t v[3]) {
  FILE *out = l->d->out;
  for (int k = 0; k < 4; k++)
    if (!isfinite(b[k])) return;
  begin_feature(l, kind, "POLYGON");
  if (l->geojson && v)
    fprintf(out, ", \"sites\": [%zu, %zu, %zu]", dyd_engine_row(l->d->engine, v[0]), dyd_engine_row(l->d->engine, v[1]),
            dyd_engine_row(l->d->engine, v[2]));
  if (l->geojson && v) dyd_json_ids(out, l->d->engine, v, 3);
  if (l->geojson) fputs("}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\": [[", out);
  if (!l->geojson) fputs("((", out);
  for (int k = 0; k < 5; k++) {
    if (k) fputs(", ", out);
    layer_xy(l, b[k == 1 || k == 2], b[2 + (k == 2 || k == 3)]);
  }
  if (l->geojson)
    fputs("]]}}", out);
  else if (v)
    fprintf(out, "))\",%s,%zu,%zu,%zu", kind, dyd_engine_row(l->d->engine, v[0]), dyd_engine_row(l->d->engine, v[1]),
            dyd_engine_row(l->d->engine, v[2]));
  else
    fprintf(out, "))\",%s,,,", kind);
  if (!l->geojson) dyd_csv_row_end(l->d->out, l->d->engine, v, v ? 3 : 0);
}

static dyd_status layer_region(void *context, size_t face, const double box[4]) {
  (void)face;
  if (box) layer_box(context, "undecided region", box, NULL);
  return DYD_OK;
}

static dyd_status layer_all(layer *l) {
  dyd_status st = dyd_diagram_visit(l->d, layer_cell, l);
  for (size_t k = 0; st == DYD_OK && k < l->d->triangles.count; k++) {
    double box[4];
    if (dyd_diagram_vertex_in_window(box, l->d, k)) layer_box(l, "vertex", box, l->d->triangles.item[k].v);
  }
  return st == DYD_OK ? dyd_diagram_regions(l->d, layer_region, l) : st;
}

/* An upper bound of the rounding of any coordinate in the window. */
static void layer_rounding(const dyd_diagram *d) {
  double w[4], most = 0;
  char text[DYD_DECIMAL_SIZE];
  dyd_rect_get_d(w, &d->window);
  for (int k = 0; k < 4; k++) most = fmax(most, fabs(w[k]));
  dyd_decimal_directed(text, most * (2 * ROUNDING), 2, DYD_UP);
  fputs(text, d->out);
}

dyd_status dyd_voronoi_wkt(const dyd_output *o) {
  layer l = {.d = o->what};
  fprintf(o->out, "WKT,kind,i,j,k%s\n", dyd_csv_id_head(l.d->engine, 3));
  return layer_all(&l);
}

dyd_status dyd_voronoi_geojson(const dyd_output *o) {
  layer l = {.d = o->what, .geojson = true};
  fputs("{\"type\": \"FeatureCollection\",\n\"rounding\": \"coordinates differ from the exact ones by at most "
        "max_coordinate_error; cell_area is rounded outward\",\n\"max_coordinate_error\": ",
        o->out);
  layer_rounding(l.d);
  fprintf(o->out, ",\n\"outcome\": \"%s\",\n\"features\": [", dyd_outcome_text(dyd_engine_outcome(l.d->engine)));
  dyd_status st = layer_all(&l);
  fputs("\n]}\n", o->out);
  return st;
}
