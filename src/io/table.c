/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Layers: tables with a row for each feature, as csv, as wkt or as geojson. */
#include "io/table.h"

#include "base/alloc.h"

#include "io/label_text.h"

#include <math.h>
#include <string.h>

/* What programs take for "no reference system". Left out, or null, they take the coordinates for degrees. */
static const char no_system[] =
    "ENGCRS[\\\"Undefined Cartesian SRS\\\",EDATUM[\\\"unknown\\\"],CS[Cartesian,2],"
    "AXIS[\\\"x\\\",unspecified],AXIS[\\\"y\\\",unspecified],LENGTHUNIT[\\\"unknown\\\",1]]";

void dyd_place_set(dyd_place *out, const double box[4]) {
  double error[2];
  out->length[0] = (unsigned char)dyd_decimal_within(out->x, &error[0], box[0], box[1]);
  out->length[1] = (unsigned char)dyd_decimal_within(out->y, &error[1], box[2], box[3]);
  out->error = fmax(error[0], error[1]);
}

static void table_put(dyd_table *t, const char *text) {
  dyd_sink_text(&t->to, text);
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

/* Is there a column of that name? */
static bool has_column(const dyd_table_head *h, const char *name) {
  return strncmp(name, "id", 2) != 0 || dyd_engine_id(h->engine, 0);
}

/* name NULL: of the last column. */
static void table_lead(dyd_table *t, const char *name) {
  dyd_table_lead *l = &t->lead[t->columns];
  const char *between = t->columns ? ", " : "}, \"properties\": {";
  if (t->json)
    l->length = (size_t)snprintf(l->text, sizeof l->text, "%s\"%s\": ", between, name ? name : "max_coordinate_error");
  else
    l->length = (size_t)snprintf(l->text, sizeof l->text, "%s", t->columns ? "," : t->bare ? "" : "\",");
  t->columns++;
}

/* What rows begin with, and what comes before their values, behind the end of the geometry. */
static void table_leads(dyd_table *t) {
  const dyd_table_head *h = t->head;
  const char *name = geometries[h->geometry].name[t->json], *open = geometries[h->geometry].open[t->json];
  t->columns = 0;
  for (size_t k = 0; h->column[k]; k++)
    if (has_column(h, h->column[k])) table_lead(t, h->column[k]);
  table_lead(t, NULL);
  t->begin.length = (size_t)snprintf(t->begin.text, sizeof t->begin.text,
                                     t->json ? ",\n{\"type\": \"Feature\", \"geometry\": {\"type\": \"%s\", "
                                               "\"coordinates\": %s"
                                             : "\"%s %s",
                                     name, open);
}

void dyd_table_begin(dyd_table *t, const dyd_table_head *head) {
  t->head = head;
  t->json = head->format == DYD_FORMAT_GEOJSON;
  t->bare = head->format == DYD_FORMAT_CSV;
  t->rows = 0;
  t->most = 0;
  table_leads(t);
  dyd_sink_begin(&t->to, head->out);
  if (t->json) {
    geojson_head(head);
    return;
  }
  if (!t->bare) table_put(t, "WKT,");
  for (size_t k = 0; head->column[k]; k++) {
    if (!has_column(head, head->column[k])) continue;
    if (k) table_put(t, ",");
    table_put(t, head->column[k]);
  }
  table_put(t, t->bare ? "\n" : ",max_coordinate_error\n");
}

void dyd_table_end(dyd_table *t) {
  char most[DYD_DECIMAL_SIZE];
  if (t->json) {
    dyd_decimal_directed(most, t->most, 2, DYD_UP);
    table_put(t, "\n],\n\"max_coordinate_error\": ");
    table_put(t, most);
    table_put(t, "}\n");
  }
  dyd_sink_flush(&t->to);
}

/* ---- rows ---- */

void dyd_row_begin(dyd_table *t) {
  size_t comma = t->json && !t->rows; /* there is none before the first */
  t->places = t->values = t->parts = 0;
  t->error = 0;
  if (!t->bare) dyd_sink_put(&t->to, t->begin.text + comma, t->begin.length - comma);
}

void dyd_row_part(dyd_table *t) {
  if (t->bare) return;
  table_put(t, (t->parts++ ? geometries[t->head->geometry].next : geometries[t->head->geometry].first)[t->json]);
  t->places = 0;
}

/* What ends the geometry. */
static const char *geometry_end(const dyd_table *t) {
  dyd_geometry g = t->head->geometry;
  return (geometries[g].none[0] && !t->parts ? geometries[g].none : geometries[g].close)[t->json];
}

void dyd_row_place(dyd_table *t, const dyd_place *place) {
  if (t->bare) return;
  char *p = dyd_sink_room(&t->to, 2 * DYD_DECIMAL_SIZE + 8);
  if (t->places++) memcpy(p, ", ", 2), p += 2;
  if (t->json) *p++ = '[';
  memcpy(p, place->x, sizeof place->x);
  p += place->length[0];
  if (t->json) *p++ = ',';
  *p++ = ' ';
  memcpy(p, place->y, sizeof place->y);
  p += place->length[1];
  if (t->json) *p++ = ']';
  t->to.end = p;
  t->error = fmax(t->error, place->error);
}

void dyd_row_at(dyd_table *t, const double box[4]) {
  dyd_place place;
  if (t->bare) return;
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

/* What comes before a value. */
static void value_begin(dyd_table *t) {
  const dyd_table_lead *l = &t->lead[t->values];
  if (!t->values++ && !t->bare) table_put(t, geometry_end(t));
  dyd_sink_put(&t->to, l->text, l->length);
}

void dyd_row_index(dyd_table *t, size_t i) {
  value_begin(t);
  dyd_sink_index(&t->to, i);
}

void dyd_row_site(dyd_table *t, size_t i) {
  dyd_row_index(t, dyd_engine_row(t->head->engine, i));
}

void dyd_row_id(dyd_table *t, size_t i) {
  const char *id = dyd_engine_id(t->head->engine, i);
  if (!id) return;
  value_begin(t);
  if (t->json)
    dyd_sink_json_text(&t->to, id);
  else
    dyd_sink_csv_text(&t->to, id);
}

void dyd_row_text(dyd_table *t, const char *text) {
  value_begin(t);
  if (t->json) table_put(t, "\"");
  table_put(t, text);
  if (t->json) table_put(t, "\"");
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
  value_begin(t);
  if (isfinite(x))
    t->to.end += dyd_decimal_directed(dyd_sink_room(&t->to, DYD_DECIMAL_SIZE), x, digits, dir);
  else
    table_put(t, t->json ? "null" : "");
}

void dyd_row_decimal(dyd_table *t, double x, dyd_round dir) {
  row_number(t, x, 17, dir);
}

void dyd_row_box(dyd_table *t, const double box[4]) {
  for (int k = 0; k < 4; k++) dyd_row_decimal(t, box[k], k & 1 ? DYD_UP : DYD_DOWN);
}

dyd_status dyd_row_sites(dyd_table *t, const dyd_index_list *list) {
  enum { DIGITS = 21 };
  char *text = dyd_alloc(list->count * DIGITS + 1, 1), *end = text;
  if (!text) return DYD_E_NOMEM;
  *end = 0;
  for (size_t k = 0; k < list->count; k++)
    end += snprintf(end, DIGITS + 1, "%s%zu", k ? " " : "", dyd_engine_row(t->head->engine, list->item[k]));
  dyd_row_text(t, text);
  free(text);
  return DYD_OK;
}

void dyd_row_end(dyd_table *t) {
  if (!t->bare) row_number(t, t->error, 2, DYD_UP);
  table_put(t, t->json ? "}}" : "\n");
  t->most = fmax(t->most, t->error);
  t->rows++;
}
