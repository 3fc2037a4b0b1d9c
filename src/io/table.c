/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Layers: tables with a row for each feature, as csv, as wkt or as geojson. */
#include "io/table.h"

#include "io/json.h"
#include "io/output.h"
#include "io/read/kind.h"
#include <math.h>
#include <string.h>

void dyd_short_place_set(dyd_short_place *out, const double box[4]) {
  double error[2];
  out->length[0] = (unsigned char)dyd_decimal_within(out->x, &error[0], box[0], box[1]);
  out->length[1] = (unsigned char)dyd_decimal_within(out->y, &error[1], box[2], box[3]);
  out->error = fmax(error[0], error[1]);
}

static void table_put(dyd_table *t, const char *text) {
  dyd_sink_text(&t->to, text);
}

/* The same of at most 8 bytes, mostly none or one. */
static inline void table_put_short(dyd_table *t, const char *text) {
  char *p = dyd_sink_room(&t->to, 8);
  while (*text) *p++ = *text++;
  t->to.end = p;
}

/* ---- encoders ---- */

/* How a kind of geometry is written. first, next: how its parts begin; none: the end without any part; hole: how a hole
 * begins. */
typedef struct shape_words {
  const char *name, *open, *close, *first, *next, *none, *hole;
} shape_words;

/* A format of rows. */
typedef struct dyd_encoder {
  const shape_words *shape; /* by dyd_geometry; NULL: rows have no geometry */
  bool brackets;            /* around each place */
  bool named;               /* values come behind their names; else names are in the head */
  size_t comma;             /* bytes of row[0] that the first row skips */
  const char *row[2];       /* before and behind the name of the geometry */
  const char *lead[2];      /* before the first value, and before others */
  const char *end;          /* of a row */
  const char *quote, *none; /* around words; a missing value */
  void (*text)(dyd_sink *to, const char *text);
  void (*head)(dyd_table *t, const dyd_output *o);
  void (*tail)(dyd_table *t);
} dyd_encoder;

/* Returns true if the name is that of a column of the layer. The case of letters makes no difference in databases. */
static bool name_is_taken(const dyd_table *t, const char *name) {
  size_t k = 0, length = strlen(name);
  while (k < t->columns && (length != strcspn(t->name[k], ",") || !dyd_same_name(name, t->name[k], length))) k++;
  return k < t->columns || (length == 3 && dyd_same_name(name, "WKT", length));
}

/* The name of the k-th column that points carry; one that the layer has itself gets "_2". */
static const char *carried_name(char *out, size_t size, const dyd_table *t, size_t k) {
  const char *name;
  if (!dyd_engine_carried(&name, t->engine, 0, k)) return NULL;
  if (!name_is_taken(t, name)) return name;
  snprintf(out, size, "%s_2", name);
  return out;
}

/* Names of all columns. */
static void csv_head(dyd_table *t, const dyd_output *o) {
  (void)o;
  if (t->encode->shape) table_put(t, "WKT,");
  for (size_t k = 0; k + 1 < t->columns; k++) {
    char own[256];
    const char *name;
    if (k) table_put(t, t->encode->lead[1]);
    if (*t->name[k] != '*') dyd_sink_put(&t->to, t->name[k], strcspn(t->name[k], ","));
    for (size_t c = 0; *t->name[k] == '*' && (name = carried_name(own, sizeof own, t, c)); c++) {
      if (c) table_put(t, t->encode->lead[1]);
      t->encode->text(&t->to, name);
    }
  }
  table_put(t, t->encode->shape ? ",max_coordinate_error\n" : "\n");
}

/* How to state "no reference system". Without it, programs assume degrees. */
static const char no_system[] =
    "ENGCRS[\\\"Undefined Cartesian SRS\\\",EDATUM[\\\"unknown\\\"],CS[Cartesian,2],"
    "AXIS[\\\"x\\\",unspecified],AXIS[\\\"y\\\",unspecified],LENGTHUNIT[\\\"unknown\\\",1]]";

static void geojson_head(dyd_table *t, const dyd_output *o) {
  table_put(t, "{\"type\": \"FeatureCollection\",\n\"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"");
  if (o->epsg) {
    table_put(t, "urn:ogc:def:crs:EPSG::");
    dyd_sink_index(&t->to, o->epsg);
  } else {
    table_put(t, t->sphere ? "urn:ogc:def:crs:OGC:1.3:CRS84" : no_system);
  }
  dyd_outcome outcome = t->sphere ? dyd_sphere_outcome(t->sphere) : dyd_engine_outcome(t->engine);
  table_put(t, "\"}},\n\"rounding\": \"a coordinate differs from every point that it represents by at most "
               "max_coordinate_error; numbers called lo, rho, probability, certain_area or half_width_needed are "
               "rounded down, others "
               "that are not whole up, half_width_now to 6 digits\",\n\"outcome\": \"");
  table_put(t, dyd_outcome_text(outcome));
  table_put(t, "\",\n\"features\": [");
}

static void geojson_tail(dyd_table *t) {
  char most[DYD_DECIMAL_SIZE];
  dyd_decimal_directed(most, t->most, 2, DYD_UP);
  table_put(t, "\n],\n\"max_coordinate_error\": ");
  table_put(t, most);
  table_put(t, "}\n");
}

static const shape_words wkt_shapes[] = {
    [DYD_GEOMETRY_POINT] = {"POINT", "(", ")", NULL, NULL, NULL, NULL},
    [DYD_GEOMETRY_LINE] = {"LINESTRING", "(", ")", NULL, NULL, NULL, NULL},
    [DYD_GEOMETRY_POLYGON] = {"POLYGON", "((", "))", NULL, NULL, NULL, NULL},
    [DYD_GEOMETRY_LINES] = {"MULTILINESTRING", "", "))", "((", "), (", "EMPTY", NULL},
    [DYD_GEOMETRY_POLYGONS] = {"MULTIPOLYGON", "", ")))", "(((", ")), ((", "EMPTY", "), ("},
};

static const shape_words geojson_shapes[] = {
    [DYD_GEOMETRY_POINT] = {"Point", "", "", NULL, NULL, NULL, NULL},
    [DYD_GEOMETRY_LINE] = {"LineString", "[", "]", NULL, NULL, NULL, NULL},
    [DYD_GEOMETRY_POLYGON] = {"Polygon", "[[", "]]", NULL, NULL, NULL, NULL},
    [DYD_GEOMETRY_LINES] = {"MultiLineString", "", "]]", "[[", "], [", "[]", NULL},
    [DYD_GEOMETRY_POLYGONS] = {"MultiPolygon", "", "]]]", "[[[", "]], [[", "[]", "], ["},
};

static const dyd_encoder encoders[] = {
    [DYD_FORMAT_CSV] =
        {.lead = {"", ","}, .end = "\n", .quote = "", .none = "", .text = dyd_sink_csv_text, .head = csv_head},
    [DYD_FORMAT_WKT] = {.shape = wkt_shapes,
                        .row = {"\"", " "},
                        .lead = {"\",", ","},
                        .end = "\n",
                        .quote = "",
                        .none = "",
                        .text = dyd_sink_csv_text,
                        .head = csv_head},
    [DYD_FORMAT_GEOJSON] = {.shape = geojson_shapes,
                            .brackets = true,
                            .named = true,
                            .comma = 1,
                            .row = {",\n{\"type\": \"Feature\", \"geometry\": {\"type\": \"", "\", \"coordinates\": "},
                            .lead = {"}, \"properties\": {", ", "},
                            .end = "}}",
                            .quote = "\"",
                            .none = "null",
                            .text = dyd_sink_json_text,
                            .head = geojson_head,
                            .tail = geojson_tail},
};

/* ---- before and after the rows ---- */

/* The text before the values of a column, behind the end of the geometry. */
static void table_lead(dyd_table *t, const char *name) {
  dyd_table_lead *l = &t->lead[t->columns];
  const char *between = t->encode->lead[t->columns > 0];
  bool named = t->encode->named;
  l->length = (size_t)snprintf(l->text, sizeof l->text, "%s%s%.*s%s", between, named ? "\"" : "",
                               named ? (int)strcspn(name, ",") : 0, name, named ? "\": " : "");
  t->name[t->columns++] = name;
}

void dyd_table_begin(dyd_table *t, const dyd_output *o, bool optional) {
  const dyd_encoder *e = t->encode = &encoders[o->format];
  bool ids = dyd_engine_id(t->engine, 0), carried = dyd_engine_carried(NULL, t->engine, 0, 0);
  t->rows = t->columns = t->begin.length = 0;
  t->most = 0;
  for (const char *name = t->layer->columns; name; name = strchr(name, ','), name += name != NULL)
    if (*name == '*' ? carried : *name == '?' ? optional : ids || strncmp(name, "id", 2) != 0)
      table_lead(t, name + (*name == '?'));
  table_lead(t, "max_coordinate_error");
  if (e->shape) {
    const shape_words *shape = &e->shape[t->geometry];
    t->begin.length = (size_t)snprintf(t->begin.text, sizeof t->begin.text, "%s%s%s%s", e->row[0], shape->name,
                                       e->row[1], shape->open);
  }
  dyd_sink_begin(&t->to, o->out);
  e->head(t, o);
}

bool dyd_format_draws(dyd_format format) {
  return encoders[format].shape;
}

void dyd_table_end(dyd_table *t) {
  if (t->encode->tail) t->encode->tail(t);
  dyd_sink_flush(&t->to);
}

/* ---- rows ---- */

void dyd_row_begin(dyd_table *t) {
  size_t comma = t->rows ? 0 : t->encode->comma;
  t->places = t->values = t->parts = 0;
  t->error = 0;
  if (t->begin.length) dyd_sink_put(&t->to, t->begin.text + comma, t->begin.length - comma);
}

void dyd_row_part(dyd_table *t) {
  if (!t->encode->shape) return;
  const shape_words *shape = &t->encode->shape[t->geometry];
  table_put(t, t->parts++ ? shape->next : shape->first);
  t->places = 0;
}

void dyd_row_hole(dyd_table *t) {
  if (!t->encode->shape) return;
  table_put(t, t->encode->shape[t->geometry].hole);
  t->places = 0;
}

void dyd_row_place(dyd_table *t, const dyd_short_place *place) {
  const dyd_encoder *e = t->encode;
  if (!e->shape) return;
  char *p = dyd_sink_room(&t->to, 2 * DYD_DECIMAL_SIZE + 8);
  if (t->places++) memcpy(p, ", ", 2), p += 2;
  if (e->brackets) *p++ = '[';
  memcpy(p, place->x, sizeof place->x);
  p += place->length[0];
  if (e->brackets) *p++ = ',';
  *p++ = ' ';
  memcpy(p, place->y, sizeof place->y);
  p += place->length[1];
  if (e->brackets) *p++ = ']';
  t->to.end = p;
  t->error = fmax(t->error, place->error);
}

void dyd_row_at(dyd_table *t, const double box[4]) {
  dyd_short_place place;
  if (!t->encode->shape) return;
  dyd_short_place_set(&place, box);
  dyd_row_place(t, &place);
}

void dyd_row_outline(dyd_table *t, const double box[4]) {
  static const int corner[5][2] = {{0, 2}, {1, 2}, {1, 3}, {0, 3}, {0, 2}};
  for (int k = 0; k < 5; k++) {
    double x = box[corner[k][0]], y = box[corner[k][1]];
    dyd_row_at(t, (const double[]){x, x, y, y});
  }
}

void dyd_row_spot(dyd_table *t, size_t i) {
  if (t->box)
    dyd_row_at(t, t->box[i]);
  else if (t->place)
    dyd_row_place(t, &t->place[i]);
}

/* ---- values ---- */

static void end_geometry(dyd_table *t) {
  const shape_words *shape = &t->encode->shape[t->geometry];
  table_put_short(t, shape->none && !t->parts ? shape->none : shape->close);
}

/* The text before a value. */
static void value_begin(dyd_table *t) {
  const dyd_table_lead *l = &t->lead[t->values];
  if (!t->values++ && t->encode->shape) end_geometry(t);
  dyd_sink_put(&t->to, l->text, l->length);
}

void dyd_row_index(dyd_table *t, size_t i) {
  value_begin(t);
  dyd_sink_index(&t->to, i);
}

void dyd_row_site(dyd_table *t, size_t i) {
  dyd_row_index(t, dyd_engine_row(t->engine, i));
}

void dyd_row_text(dyd_table *t, const char *text) {
  value_begin(t);
  t->encode->text(&t->to, text);
}

void dyd_row_id(dyd_table *t, size_t i) {
  const char *id = dyd_engine_id(t->engine, i);
  if (id) dyd_row_text(t, id);
}

void dyd_row_carried(dyd_table *t, size_t i) {
  const dyd_encoder *e = t->encode;
  char own[256];
  const char *name;
  for (size_t k = 0; (name = carried_name(own, sizeof own, t, k)); k++) {
    const char *text = dyd_engine_carried(NULL, t->engine, i, k);
    table_put(t, e->lead[1]);
    if (e->named) e->text(&t->to, name), table_put_short(t, ": ");
    if (e->named && (!*text || dyd_json_is_number(text)))
      table_put(t, *text ? text : e->none);
    else
      e->text(&t->to, text);
    t->values += !k;
  }
}

void dyd_row_own(dyd_table *t, size_t i) {
  dyd_row_site(t, i);
  dyd_row_id(t, i);
  dyd_row_carried(t, i);
}

void dyd_row_end_two(dyd_table *t, size_t i, size_t j) {
  dyd_row_id(t, i);
  dyd_row_id(t, j);
  dyd_row_end(t);
}

void dyd_row_three(dyd_table *t, const uint32_t site[3], bool ids) {
  for (int c = 0; c < 3; c++) (ids ? dyd_row_id : dyd_row_site)(t, site[c]);
}

void dyd_row_word(dyd_table *t, const char *text) {
  value_begin(t);
  table_put_short(t, t->encode->quote);
  table_put(t, text);
  table_put_short(t, t->encode->quote);
}

static void row_number(dyd_table *t, double x, int digits, dyd_round dir) {
  value_begin(t);
  if (isfinite(x))
    t->to.end += dyd_decimal_directed(dyd_sink_room(&t->to, DYD_DECIMAL_SIZE), x, digits, dir);
  else
    table_put(t, t->encode->none);
}

void dyd_row_decimal(dyd_table *t, double x, dyd_round dir) {
  row_number(t, x, 17, dir);
}

void dyd_row_brief(dyd_table *t, double x, bool decimal) {
  char text[DYD_DECIMAL_SIZE];
  double error;
  value_begin(t);
  if (decimal && isfinite(x))
    dyd_decimal_within(text, &error, x, x);
  else
    dyd_decimal_directed(text, x, 6, DYD_DOWN);
  table_put(t, text);
}

void dyd_row_box(dyd_table *t, const double box[4]) {
  for (int k = 0; k < 4; k++) dyd_row_decimal(t, box[k], k & 1 ? DYD_UP : DYD_DOWN);
}

void dyd_row_sites(dyd_table *t, const dyd_index_list *list) {
  value_begin(t);
  table_put_short(t, t->encode->quote);
  for (size_t k = 0; k < list->count; k++) {
    if (k) table_put_short(t, " ");
    dyd_sink_index(&t->to, dyd_engine_row(t->engine, list->item[k]));
  }
  table_put_short(t, t->encode->quote);
}

FILE *dyd_row_open(dyd_table *t) {
  value_begin(t);
  table_put_short(t, t->encode->quote);
  dyd_sink_flush(&t->to);
  return t->to.out;
}

void dyd_row_close(dyd_table *t) {
  table_put_short(t, t->encode->quote);
}

FILE *dyd_row_file(dyd_table *t) {
  value_begin(t);
  dyd_sink_flush(&t->to);
  return t->to.out;
}

void dyd_row_end(dyd_table *t) {
  if (t->encode->shape) row_number(t, t->error, 2, DYD_UP);
  table_put_short(t, t->encode->end);
  t->most = fmax(t->most, t->error);
  t->rows++;
}
