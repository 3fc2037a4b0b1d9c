/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Layers: tables with a row for each feature, as csv, as wkt or as geojson. */
#include "io/table.h"

#include "io/label_text.h"

#include <math.h>
#include <string.h>

/* What programs take for "no reference system". Left out, or null, they take the coordinates for degrees. */
static const char no_system[] =
    "ENGCRS[\\\"Undefined Cartesian SRS\\\",EDATUM[\\\"unknown\\\"],CS[Cartesian,2],"
    "AXIS[\\\"x\\\",unspecified],AXIS[\\\"y\\\",unspecified],LENGTHUNIT[\\\"unknown\\\",1]]";

void dyd_place_set(dyd_place *out, const double box[4]) {
  double error[2];
  dyd_decimal_within(out->x, &error[0], box[0], box[1]);
  dyd_decimal_within(out->y, &error[1], box[2], box[3]);
  out->error = fmax(error[0], error[1]);
}

/* ---- text, in blocks ---- */

static void table_flush(dyd_table *t) {
  fwrite(t->block, 1, (size_t)(t->end - t->block), t->head->out);
  t->end = t->block;
}

static void table_put(dyd_table *t, const char *text) {
  for (size_t left = strlen(text); left;) {
    size_t room = (size_t)(t->block + DYD_TABLE_BLOCK - t->end), some = left < room ? left : room;
    memcpy(t->end, text, some);
    t->end += some, text += some, left -= some;
    if (some == room) table_flush(t);
  }
}

static bool is_geojson(const dyd_table *t) {
  return t->head->format == DYD_FORMAT_GEOJSON;
}

static bool has_geometry(const dyd_table *t) {
  return t->head->format != DYD_FORMAT_CSV;
}

/* Is there column k? */
static bool has_column(const dyd_table *t, size_t k) {
  return strncmp(t->head->column[k], "id", 2) != 0 || dyd_engine_id(t->head->engine, 0);
}

/* ---- before and after the rows ---- */

static void geojson_head(const dyd_table_head *h) {
  fputs("{\"type\": \"FeatureCollection\",\n\"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"", h->out);
  if (h->epsg)
    fprintf(h->out, "urn:ogc:def:crs:EPSG::%u", h->epsg);
  else if (h->sphere)
    fputs("urn:ogc:def:crs:OGC:1.3:CRS84", h->out);
  else
    fputs(no_system, h->out);
  dyd_outcome outcome = h->sphere ? dyd_sphere_outcome(h->sphere) : dyd_engine_outcome(h->engine);
  fprintf(h->out,
          "\"}},\n\"rounding\": \"a coordinate differs from every point that it stands for by at most "
          "max_coordinate_error; numbers called lo, rho, probability or half_width_needed are rounded down, others "
          "that are not "
          "whole up\",\n"
          "\"outcome\": \"%s\",\n\"features\": [",
          dyd_outcome_text(outcome));
}

void dyd_table_begin(dyd_table *t, const dyd_table_head *head) {
  t->head = head;
  t->rows = 0;
  t->most = 0;
  t->end = t->block;
  if (is_geojson(t)) {
    geojson_head(head);
    return;
  }
  if (has_geometry(t)) table_put(t, "WKT,");
  for (size_t k = 0; head->column[k]; k++) {
    if (!has_column(t, k)) continue;
    if (k) table_put(t, ",");
    table_put(t, head->column[k]);
  }
  table_put(t, has_geometry(t) ? ",max_coordinate_error\n" : "\n");
}

void dyd_table_end(dyd_table *t) {
  char most[DYD_DECIMAL_SIZE];
  if (is_geojson(t)) {
    dyd_decimal_directed(most, t->most, 2, DYD_UP);
    table_put(t, "\n],\n\"max_coordinate_error\": ");
    table_put(t, most);
    table_put(t, "}\n");
  }
  table_flush(t);
}

/* ---- geometry ---- */

/* parts: how they begin, and the end when there are none; open is "" for them, as the first part opens. */
static const struct {
  const char *name[2], *open[2], *close[2]; /* of wkt, of geojson */
  const char *first[2], *next[2], *none[2];
} geometries[] = {[DYD_GEOMETRY_POINT] = {{"POINT", "Point"}, {"(", ""}, {")", ""}, {NULL}, {NULL}, {NULL}},
                  [DYD_GEOMETRY_LINE] = {{"LINESTRING", "LineString"}, {"(", "["}, {")", "]"}, {NULL}, {NULL}, {NULL}},
                  [DYD_GEOMETRY_POLYGON] = {{"POLYGON", "Polygon"}, {"((", "[["}, {"))", "]]"}, {NULL}, {NULL}, {NULL}},
                  [DYD_GEOMETRY_LINES] = {{"MULTILINESTRING", "MultiLineString"},
                                          {"", ""},
                                          {"))", "]]"},
                                          {"((", "[["},
                                          {"), (", "], ["},
                                          {"EMPTY", "[]"}},
                  [DYD_GEOMETRY_POLYGONS] = {{"MULTIPOLYGON", "MultiPolygon"},
                                             {"", ""},
                                             {")))", "]]]"},
                                             {"(((", "[[["},
                                             {")), ((", "]], [["},
                                             {"EMPTY", "[]"}}};

void dyd_row_begin(dyd_table *t) {
  const dyd_table_head *h = t->head;
  t->places = t->values = t->parts = 0;
  t->error = 0;
  if (is_geojson(t)) {
    table_put(t, t->rows ? ",\n{\"type\": \"Feature\", \"geometry\": {\"type\": \""
                         : "\n{\"type\": \"Feature\", \"geometry\": {\"type\": \"");
    table_put(t, geometries[h->geometry].name[1]);
    table_put(t, "\", \"coordinates\": ");
    table_put(t, geometries[h->geometry].open[1]);
  } else if (has_geometry(t)) {
    table_put(t, "\"");
    table_put(t, geometries[h->geometry].name[0]);
    table_put(t, " ");
    table_put(t, geometries[h->geometry].open[0]);
  }
}

void dyd_row_part(dyd_table *t) {
  if (!has_geometry(t)) return;
  table_put(t, (t->parts++ ? geometries[t->head->geometry].next : geometries[t->head->geometry].first)[is_geojson(t)]);
  t->places = 0;
}

/* What ends the geometry. */
static const char *geometry_end(const dyd_table *t) {
  dyd_geometry g = t->head->geometry;
  return (geometries[g].none[0] && !t->parts ? geometries[g].none : geometries[g].close)[is_geojson(t)];
}

void dyd_row_place(dyd_table *t, const dyd_place *place) {
  if (!has_geometry(t)) return;
  bool json = is_geojson(t);
  if (t->places++) table_put(t, ", ");
  if (json) table_put(t, "[");
  table_put(t, place->x);
  table_put(t, json ? ", " : " ");
  table_put(t, place->y);
  if (json) table_put(t, "]");
  t->error = fmax(t->error, place->error);
}

void dyd_row_at(dyd_table *t, const double box[4]) {
  dyd_place place;
  if (!has_geometry(t)) return;
  dyd_place_set(&place, box);
  dyd_row_place(t, &place);
}

void dyd_row_outline(dyd_table *t, const double box[4]) {
  static const int corner[5][2] = {{0, 2}, {1, 2}, {1, 3}, {0, 3}, {0, 2}};
  for (int k = 0; k < 5; k++) {
    double x = box[corner[k][0]], y = box[corner[k][1]];
    dyd_row_at(t, (const double[]){x, x, y, y});
  }
}

/* ---- values ---- */

/* What comes before a value: the end of the geometry before the first, the name of the column in geojson. */
static void value_begin(dyd_table *t) {
  bool first = t->values == 0;
  int json = is_geojson(t);
  while (t->head->column[t->values] && !has_column(t, t->values)) t->values++;
  const char *name = t->head->column[t->values] ? t->head->column[t->values] : "max_coordinate_error";
  t->values++;
  if (first && has_geometry(t)) {
    table_put(t, geometry_end(t));
    table_put(t, json ? "}, \"properties\": {" : "\",");
  } else if (!first) {
    table_put(t, json ? ", " : ",");
  }
  if (!json) return;
  table_put(t, "\"");
  table_put(t, name);
  table_put(t, "\": ");
}

/* By hand: most of the bytes are these. */
void dyd_row_index(dyd_table *t, size_t i) {
  char digits[24], *p = digits + sizeof digits;
  *--p = 0;
  do *--p = (char)('0' + i % 10);
  while (i /= 10);
  value_begin(t);
  table_put(t, p);
}

void dyd_row_site(dyd_table *t, size_t i) {
  dyd_row_index(t, dyd_engine_row(t->head->engine, i));
}

void dyd_row_id(dyd_table *t, size_t i) {
  const char *id = dyd_engine_id(t->head->engine, i);
  if (!id) return;
  value_begin(t);
  table_flush(t);
  if (is_geojson(t))
    dyd_json_text(t->head->out, id);
  else
    dyd_csv_text(t->head->out, id);
}

void dyd_row_text(dyd_table *t, const char *text) {
  value_begin(t);
  if (is_geojson(t)) table_put(t, "\"");
  table_put(t, text);
  if (is_geojson(t)) table_put(t, "\"");
}

const char *const dyd_columns_of_pairs[] = {"i", "j", "status", "id_i", "id_j", NULL};

void dyd_row_pair(dyd_table *t, size_t i, size_t j, const char *status) {
  dyd_row_site(t, i);
  dyd_row_site(t, j);
  dyd_row_text(t, status);
  dyd_row_id(t, i);
  dyd_row_id(t, j);
}

static void row_number(dyd_table *t, double x, int digits, dyd_round dir) {
  char text[DYD_DECIMAL_SIZE];
  value_begin(t);
  if (isfinite(x)) dyd_decimal_directed(text, x, digits, dir);
  table_put(t, isfinite(x) ? text : is_geojson(t) ? "null" : "");
}

void dyd_row_decimal(dyd_table *t, double x, dyd_round dir) {
  row_number(t, x, 17, dir);
}

void dyd_row_box(dyd_table *t, const double box[4]) {
  for (int k = 0; k < 4; k++) dyd_row_decimal(t, box[k], k & 1 ? DYD_UP : DYD_DOWN);
}

void dyd_row_end(dyd_table *t) {
  if (has_geometry(t)) row_number(t, t->error, 2, DYD_UP);
  table_put(t, is_geojson(t) ? "}}" : "\n");
  t->most = fmax(t->most, t->error);
  t->rows++;
}
