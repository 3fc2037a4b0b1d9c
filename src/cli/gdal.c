/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reads and writes files for the command by GDAL.
 *
 * Points come from it as a table: x and y, in the hexadecimal digits of their doubles, then the attributes. So all
 * options of reading hold. Results go to it as they are written in wkt (csv where there is no geometry), a feature for
 * each row. */
#define _GNU_SOURCE /* realpath, mkdtemp */
#include "cli.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <errno.h>
#include <fenv.h>
#include <gdal.h>
#include <math.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- text that grows ---- */

/* Invariant: text[0 .. used) is in use. failed: memory is exhausted. */
typedef struct growing {
  char *text;
  size_t used, cap;
  bool failed;
} growing;

static void grow_put(growing *g, const char *text, size_t count) {
  if (g->cap - g->used < count) {
    size_t cap = 2 * g->cap + count + 256;
    char *more = realloc(g->text, cap);
    g->failed |= !more;
    if (!more) return;
    g->text = more;
    g->cap = cap;
  }
  memcpy(g->text + g->used, text, count);
  g->used += count;
}

static void grow_text(growing *g, const char *text) {
  grow_put(g, text, strlen(text));
}

/* A field of csv. */
static void grow_field(growing *g, const char *text) {
  grow_text(g, "\"");
  for (const char *quote; (quote = strchr(text, '"')); text = quote + 1) {
    grow_put(g, text, (size_t)(quote - text));
    grow_text(g, "\"\"");
  }
  grow_text(g, text);
  grow_text(g, "\"");
}

/* ---- reading ---- */

/* Invariant: made.text[given .. used) waits to be read. */
typedef struct feature_source {
  GDALDatasetH set;
  OGRLayerH layer;
  int fields;
  bool shape, swap; /* the first columns are the geometry; y comes first in it */
  growing made;
  size_t given, features;
  char fault[512];
} feature_source;

enum { MOST_FIELDS = 256 };

/* The fields of the points file, for columns that points carry. */
static struct {
  char name[64];
  OGRFieldType type;
} carried[MOST_FIELDS];

static feature_source *source_open; /* of the file that is read: callbacks of FILE cannot be asked for theirs */

static void put_double(growing *g, double x) {
  char text[40];
  snprintf(text, sizeof text, "%a", x);
  grow_text(g, isfinite(x) ? text : "");
}

/* The shortest decimal that is read as x. */
static void put_shortest(growing *g, double x) {
  char text[40];
  for (int digits = 15; digits <= 17; digits++) {
    snprintf(text, sizeof text, "%.*g", digits, x);
    if (strtod(text, NULL) == x) break;
  }
  grow_text(g, isfinite(x) ? text : "");
}

static void put_feature_field(growing *g, OGRFeatureH f, int k) {
  if (!OGR_F_IsFieldSetAndNotNull(f, k)) return;
  if (OGR_Fld_GetType(OGR_F_GetFieldDefnRef(f, k)) == OFTReal)
    put_shortest(g, OGR_F_GetFieldAsDouble(f, k));
  else
    grow_field(g, OGR_F_GetFieldAsString(f, k));
}

/* The only point of the geometry; NULL: it is another one. */
static OGRGeometryH single_point(OGRGeometryH g) {
  OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(g));
  if (type == wkbPoint) return g;
  return type == wkbMultiPoint && OGR_G_GetGeometryCount(g) == 1 ? OGR_G_GetGeometryRef(g, 0) : NULL;
}

static bool put_feature_point(feature_source *s, OGRFeatureH f) {
  OGRGeometryH g = OGR_F_GetGeometryRef(f), point = g ? single_point(g) : NULL;
  if (g && !point && !OGR_G_IsEmpty(g)) {
    bool many = wkbFlatten(OGR_G_GetGeometryType(g)) == wkbMultiPoint;
    snprintf(s->fault, sizeof s->fault, "feature %zu is a %s, not a point; %s", s->features, OGR_G_GetGeometryName(g),
             many ? "split it first: ogr2ogr -explodecollections points.gpkg FILE"
                  : "take points of it first, such as centroids: ogr2ogr -dialect SQLite -sql \"SELECT "
                    "ST_Centroid(geometry), * FROM layer\" points.gpkg FILE");
    return false;
  }
  bool none = !point || OGR_G_IsEmpty(point);
  double x = none ? NAN : OGR_G_GetX(point, 0), y = none ? NAN : OGR_G_GetY(point, 0);
  put_double(&s->made, s->swap ? y : x);
  grow_text(&s->made, ",");
  put_double(&s->made, s->swap ? x : y);
  return true;
}

/* The next row; false at the end, or with s->fault. */
static bool source_next(feature_source *s) {
  CPLErrorReset();
  OGRFeatureH f = OGR_L_GetNextFeature(s->layer);
  if (!f && CPLGetLastErrorType() >= CE_Failure)
    snprintf(s->fault, sizeof s->fault, "GDAL cannot read feature %zu: %s", s->features, CPLGetLastErrorMsg());
  if (!f) return false;
  bool good = !s->shape || put_feature_point(s, f);
  for (int k = 0; k < s->fields && good; k++) {
    if (k || s->shape) grow_text(&s->made, ",");
    put_feature_field(&s->made, f, k);
  }
  grow_text(&s->made, "\n");
  s->features++;
  OGR_F_Destroy(f);
  if (s->made.failed) snprintf(s->fault, sizeof s->fault, "memory is exhausted; close other programs");
  return good && !s->made.failed;
}

static bool source_get(size_t *got, void *user, char *bytes, size_t room) {
  feature_source *s = user;
  if (s->given == s->made.used) {
    s->given = s->made.used = 0;
    while (s->made.used < room && source_next(s)) {
    }
  }
  if (s->fault[0]) return false;
  *got = s->made.used - s->given < room ? s->made.used - s->given : room;
  memcpy(bytes, s->made.text + s->given, *got);
  s->given += *got;
  return true;
}

static void source_header(feature_source *s) {
  OGRFeatureDefnH d = OGR_L_GetLayerDefn(s->layer);
  s->fields = OGR_FD_GetFieldCount(d);
  if (s->shape) grow_text(&s->made, "geometry x,geometry y");
  for (int k = 0; k < s->fields; k++) {
    if (k || s->shape) grow_text(&s->made, ",");
    OGRFieldDefnH field = OGR_FD_GetFieldDefn(d, k);
    grow_field(&s->made, OGR_Fld_GetNameRef(field));
    if (k >= MOST_FIELDS) continue;
    snprintf(carried[k].name, sizeof carried[k].name, "%s", OGR_Fld_GetNameRef(field));
    carried[k].type = OGR_Fld_GetType(field);
  }
  grow_text(&s->made, "\n");
}

static bool may_hold_points(OGRLayerH layer) {
  OGRwkbGeometryType type = wkbFlatten(OGR_L_GetGeomType(layer));
  return type == wkbPoint || type == wkbMultiPoint || type == wkbUnknown || type == wkbGeometryCollection;
}

/* Lists the layers of the file, up to the size of `out`. */
static void list_layers(char *out, size_t size, GDALDatasetH set) {
  size_t used = 0;
  for (int k = 0; k < GDALDatasetGetLayerCount(set) && used < size; k++) {
    OGRLayerH layer = GDALDatasetGetLayer(set, k);
    used += (size_t)snprintf(out + used, size - used, "%s%s (%s)", k ? ", " : "", OGR_L_GetName(layer),
                             OGRGeometryTypeToName(OGR_L_GetGeomType(layer)));
  }
}

/* The layer named; else the only one that may hold points and is not empty. NULL after a message. */
static OGRLayerH choose_layer(GDALDatasetH set, const char *name, const cli_options *o) {
  char list[1024] = "no layer";
  OGRLayerH found = o->in_layer ? GDALDatasetGetLayerByName(set, o->in_layer) : NULL;
  int count = GDALDatasetGetLayerCount(set), fit = 0;
  if (found) return found;
  list_layers(list, sizeof list, set);
  if (o->in_layer) return cli_complain("%s: no layer is called \"%s\"; it has %s", name, o->in_layer, list), NULL;
  for (int k = 0; k < count; k++) {
    OGRLayerH layer = GDALDatasetGetLayer(set, k);
    bool table = o->read.columns && count == 1;
    if (!table && (!may_hold_points(layer) || (count > 1 && OGR_L_GetFeatureCount(layer, TRUE) == 0))) continue;
    if (!fit++) found = layer;
  }
  if (fit == 1) return found;
  if (fit)
    cli_complain("%s: several layers have points; name one: --in-layer NAME; it has %s", name, list);
  else
    cli_complain(
        "%s: no layer has points; take points of one, such as centroids: ogr2ogr -dialect SQLite -sql \"SELECT "
        "ST_Centroid(geometry), * FROM layer\" points.gpkg %s; or name the columns of a table by --in-layer and "
        "--columns; it has %s",
        name, name, list);
  return NULL;
}

/* ---- reference systems ---- */

/* Returns true if files of this kind imply degrees. */
static bool degrees_are_implied(const char *name, GDALDatasetH set) {
  const char *driver = GDALGetDriverShortName(GDALGetDatasetDriver(set));
  char text[4096];
  if (strcmp(driver, "GPX") == 0 || strstr(driver, "KML")) return true;
  if (strncmp(driver, "GeoJSON", 7) != 0) return false;
  FILE *in = fopen(name, "rb");
  size_t count = in ? fread(text, 1, sizeof text - 1, in) : 0;
  if (in) fclose(in);
  text[count] = 0;
  return !strstr(text, "\"crs\"");
}

/* By its first axis. */
static bool latitude_is_first(OGRSpatialReferenceH crs) {
  int count = 0;
  OGRAxisOrientation first = OAO_Other;
  const int *axis = OSRGetDataAxisToSRSAxisMapping(crs, &count);
  OSRGetAxis(crs, NULL, 0, &first);
  return count >= 2 && axis[0] == 1 && first == OAO_North;
}

static int refuse_system(const char *name, const char *crs, bool degrees) {
  if (degrees)
    return cli_usage("%s: the coordinates are longitude and latitude in degrees (%s); for neighbours on the globe give "
                     "--sphere (delaunay, voronoi), to take degrees as coordinates of a plane --plane",
                     name, crs);
  return cli_usage("%s: the coordinates are not degrees (%s); remove --sphere, or turn them into degrees: ogr2ogr "
                   "-t_srs EPSG:4326 degrees.gpkg %s",
                   name, crs, name);
}

/* Takes over the reference system of the layer. */
static int take_system(feature_source *s, const char *name, cli_options *o) {
  OGRSpatialReferenceH crs = s->shape ? OGR_L_GetSpatialRef(s->layer) : NULL;
  if (!crs) return 0;
  const char *authority = OSRGetAuthorityName(crs, NULL), *code = OSRGetAuthorityCode(crs, NULL);
  unsigned epsg = authority && code && strcmp(authority, "EPSG") == 0 ? (unsigned)atoi(code) : 0;
  const char *called = OSRGetName(crs);
  bool degrees = OSRIsGeographic(crs), implied = degrees && degrees_are_implied(name, s->set);
  s->swap = degrees && latitude_is_first(crs);
  if (o->epsg && epsg && o->epsg != epsg)
    return cli_usage("%s: the reference system of the file is EPSG:%u; remove --crs EPSG:%u", name, epsg, o->epsg);
  if (o->sphere ? !degrees && OSRIsProjected(crs) : degrees && !o->plane && !implied)
    return refuse_system(name, called ? called : "no name", degrees);
  if (degrees && !o->sphere && !o->plane)
    cli_note(
        o,
        "%s: longitude and latitude are taken as coordinates in a plane; for neighbours on the globe give delaunay "
        "or voronoi --sphere; --plane says that the plane is meant",
        name);
  if (!o->epsg) o->epsg = epsg;
  if (!o->crs) OSRExportToWktEx(crs, &o->crs, (const char *[]){"FORMAT=WKT2_2019", NULL});
  return 0;
}

static void source_free(feature_source *s) {
  if (s->set) GDALClose(s->set);
  free(s->made.text);
  free(s);
}

static int source_begin(feature_source *s, const char *name, cli_options *o) {
  GDALAllRegister();
  CPLSetErrorHandler(CPLQuietErrorHandler);
  s->set = GDALOpenEx(name, GDAL_OF_VECTOR | GDAL_OF_READONLY, NULL, NULL, NULL);
  if (!s->set) {
    const char *kind = cli_spatial_kind(name), *why = CPLGetLastErrorMsg();
    return cli_complain("%s: this is no %s that GDAL reads%s%s; check the file with ogrinfo", name,
                        kind ? kind : "file", *why ? ": " : "", why);
  }
  s->layer = choose_layer(s->set, name, o);
  if (!s->layer) return CLI_FAILED;
  s->shape = !o->read.columns;
  if (s->shape && OGR_L_GetGeomType(s->layer) == wkbNone)
    return cli_usage("%s: layer %s has no geometry; name the columns of its coordinates: --columns X,Y", name,
                     OGR_L_GetName(s->layer));
  if (s->shape && o->read.measured)
    return cli_usage("%s: coordinates in this file are doubles, not decimals; state a --radius instead of --measured",
                     name);
  int status = take_system(s, name, o);
  if (status) return status;
  source_header(s);
  if (s->shape) o->read.columns = "1,2";
  o->read.delimiter = ",";
  OGR_L_ResetReading(s->layer);
  return 0;
}

static int features_open(FILE **out, const char *name, cli_options *o) {
  feature_source *s = source_open = calloc(1, sizeof *s);
  int status = s ? source_begin(s, name, o) : cli_complain_memory();
  if (!status && dyd_file_of_callback(out, NULL, source_get, s, NULL) != DYD_OK) status = cli_complain_memory();
  if (status && s) source_free(s);
  return status;
}

static bool features_close(FILE *in, const char *name) {
  feature_source *s = source_open;
  fclose(in);
  bool good = !s->fault[0];
  if (!good) cli_complain("%s: %s", name, s->fault);
  source_free(s);
  source_open = NULL;
  return good;
}

/* ---- writing ---- */

/* A table on its way to GDAL, record by record: the first one names the fields. */
typedef struct feature_sink {
  GDALDatasetH set;
  OGRLayerH layer; /* NULL before the first feature */
  OGRSpatialReferenceH crs;
  const char *name;
  growing record; /* unquoted fields, a NUL behind each */
  size_t field[MOST_FIELDS], fields, names;
  char *title[MOST_FIELDS];
  bool quoted, drawn, failed;
} feature_sink;

/* Whole numbers and texts among the columns; all others are numbers, rounded down or up as geojson says. */
static bool title_is(const char *list, const char *title) {
  const char *at = list;
  for (size_t n = strlen(title); (at = strstr(at, title)); at += n)
    if ((at == list || at[-1] == ' ') && (at[n] == ' ' || !at[n])) return true;
  return false;
}

/* The number of the carried field of this name; MOST_FIELDS: there is none. */
static size_t carried_find(const char *title) {
  for (size_t k = 0; k < MOST_FIELDS && carried[k].name[0]; k++)
    if (strcmp(carried[k].name, title) == 0) return k;
  return MOST_FIELDS;
}

static OGRFieldType type_of(const char *title) {
  if (title_is("i j k l q of left right rank face legal indeterminate tie pairs_decided pairs_left certain open "
               "vertices far "
               "near complete",
               title))
    return OFTInteger64;
  if (title_is("lo hi xlo xhi ylo yhi area area_lo area_hi certain_area undetermined rho probability half_width_now "
               "half_width_needed length_lo length_hi max_coordinate_error accuracy",
               title))
    return OFTReal;
  size_t k = carried_find(title);
  return k < MOST_FIELDS ? carried[k].type : OFTString;
}

static bool title_is_lower(const char *title) {
  size_t n = strlen(title);
  return (n >= 2 && strcmp(title + n - 2, "lo") == 0) || title_is("rho probability half_width_needed", title);
}

/* The double of a decimal in this direction. */
static double decimal_toward(const char *text, int direction) {
  int before = fegetround();
  fesetround(direction);
  double x = strtod(text, NULL);
  fesetround(before);
  return x;
}

/* What coordinates lose when they become doubles, at most. */
static double geometry_loss(const char *wkt) {
  double most = 0;
  for (const char *p = wkt; *p;) {
    size_t n = strspn(p, "+-0123456789.eE");
    if (n && strspn(p, "eE") == 0) {
      double loss = decimal_toward(p, FE_UPWARD) - decimal_toward(p, FE_DOWNWARD);
      most = loss > most ? loss : most;
    }
    p += n ? n : 1;
  }
  return most;
}

/* wkt: the first geometry; NULL: there is none. */
static bool sink_begin_layer(feature_sink *s, char *wkt) {
  OGRGeometryH g = NULL;
  if (wkt) OGR_G_CreateFromWkt(&wkt, NULL, &g);
  OGRwkbGeometryType type = g ? OGR_G_GetGeometryType(g) : s->drawn ? wkbUnknown : wkbNone;
  OGR_G_DestroyGeometry(g);
  s->layer = GDALDatasetCreateLayer(s->set, s->name, s->drawn ? s->crs : NULL, type, NULL);
  for (size_t k = s->drawn; k < s->names && s->layer; k++) {
    OGRFieldDefnH d = OGR_Fld_Create(s->title[k], type_of(s->title[k]));
    if (OGR_L_CreateField(s->layer, d, TRUE) != OGRERR_NONE) s->failed = true;
    OGR_Fld_Destroy(d);
  }
  return s->layer && !s->failed;
}

static void set_feature_field(OGRFeatureH f, int at, const char *title, const char *text, double loss) {
  OGRFieldType type = type_of(title);
  if (!*text) return;
  if (type == OFTInteger64)
    OGR_F_SetFieldInteger64(f, at, strtoll(text, NULL, 10));
  else if (type != OFTReal || carried_find(title) < MOST_FIELDS)
    OGR_F_SetFieldString(f, at, text);
  else if (loss > 0 && strcmp(title, "max_coordinate_error") == 0)
    OGR_F_SetFieldDouble(f, at, nextafter(decimal_toward(text, FE_UPWARD) + loss, INFINITY));
  else
    OGR_F_SetFieldDouble(f, at, decimal_toward(text, title_is_lower(title) ? FE_DOWNWARD : FE_UPWARD));
}

static bool sink_feature(feature_sink *s) {
  char *wkt = s->drawn ? s->record.text + s->field[0] : NULL;
  if (!s->layer && !sink_begin_layer(s, wkt)) return false;
  OGRFeatureH f = OGR_F_Create(OGR_L_GetLayerDefn(s->layer));
  double loss = wkt ? geometry_loss(wkt) : 0;
  OGRGeometryH g = NULL;
  bool good = f && s->fields == s->names;
  if (good && wkt) good = OGR_G_CreateFromWkt(&wkt, NULL, &g) == OGRERR_NONE;
  if (good && g) OGR_F_SetGeometryDirectly(f, g);
  for (size_t k = s->drawn; k < s->fields && good; k++)
    set_feature_field(f, (int)(k - s->drawn), s->title[k], s->record.text + s->field[k], loss);
  good = good && OGR_L_CreateFeature(s->layer, f) == OGRERR_NONE;
  if (f) OGR_F_Destroy(f);
  return good;
}

/* The names of the fields; "WKT" is the geometry. */
static bool sink_names(feature_sink *s) {
  s->names = s->fields;
  for (size_t k = 0; k < s->names; k++)
    if (!(s->title[k] = strdup(s->record.text + s->field[k]))) return false;
  s->drawn = strcmp(s->title[0], "WKT") == 0;
  return true;
}

static bool sink_byte(feature_sink *s, char c) {
  if (c == '"') {
    /* A doubled quote leaves and enters: its second half stands. */
    if (!s->quoted && s->record.used > s->field[s->fields - 1] && s->record.text[s->record.used - 1] == '\1')
      s->record.text[s->record.used - 1] = '"';
    else if (s->quoted)
      grow_put(&s->record, "\1", 1);
    s->quoted = !s->quoted;
    return !s->record.failed;
  }
  if (!s->quoted && s->record.used && s->record.text[s->record.used - 1] == '\1') s->record.used--;
  bool end = !s->quoted && (c == ',' || c == '\n');
  grow_put(&s->record, end ? "" : &c, 1);
  if (s->record.failed || s->fields == MOST_FIELDS) return false;
  if (!end) return true;
  if (c == ',') return s->field[s->fields++] = s->record.used, true;
  bool good = s->names ? sink_feature(s) : sink_names(s);
  s->record.used = 0;
  s->fields = 1;
  return good;
}

static bool sink_put(void *user, const char *bytes, size_t count) {
  feature_sink *s = user;
  for (size_t k = 0; k < count && !s->failed; k++) s->failed = !sink_byte(s, bytes[k]);
  return !s->failed;
}

/* One layer. */
static dyd_status layer_write(GDALDatasetH set, OGRSpatialReferenceH crs, cli_session *s, cli_print_fn print,
                              const char *name, dyd_error *err) {
  feature_sink sink = {.set = set, .crs = crs, .name = name, .fields = 1};
  FILE *out;
  dyd_status st = dyd_file_of_callback(&out, sink_put, NULL, &sink, err);
  if (st == DYD_OK) {
    st = print(out, s, err);
    bool good = fclose(out) == 0 && !sink.failed;
    if (st == DYD_OK && good && sink.names && !sink.layer) good = sink_begin_layer(&sink, NULL);
    if (!good) st = DYD_E_IO;
  }
  for (size_t k = 0; k < sink.names; k++) free(sink.title[k]);
  free(sink.record.text);
  return st;
}

/* All layers of the content but large ones, or the one of the options. Layers that these points do not allow are
 * omitted. */
static dyd_status layers_write(GDALDatasetH set, OGRSpatialReferenceH crs, cli_session *s, cli_print_fn print,
                               const char *base, dyd_error *err) {
  const dyd_content all = s->o.content;
  const dyd_format format = s->o.format;
  const char *name = s->o.all_layers ? dyd_layer_name(NULL, NULL, all, 0) : NULL;
  dyd_status st = name ? DYD_OK : layer_write(set, crs, s, print, base, err);
  bool large;
  for (size_t k = 0; name && st == DYD_OK && (name = dyd_layer_name(&s->o.content, &large, all, k)); k++) {
    char plain[64];
    snprintf(plain, sizeof plain, "%s", name);
    for (char *c = plain; (c = strchr(c, ':'));) *c = '_';
    if (large) continue;
    s->o.format = dyd_format_holds(DYD_FORMAT_WKT, s->o.content, false) ? DYD_FORMAT_WKT : DYD_FORMAT_CSV;
    st = layer_write(set, crs, s, print, plain, err);
    if (st == DYD_E_ARG && k) st = DYD_OK;
  }
  s->o.content = all;
  s->o.format = format;
  return st;
}

/* Of the options, else of the file, else of the sphere, else of a plane without units. */
static OGRSpatialReferenceH system_of(const cli_options *o) {
  OGRSpatialReferenceH crs = OSRNewSpatialReference(NULL);
  OSRSetAxisMappingStrategy(crs, OAMS_TRADITIONAL_GIS_ORDER);
  unsigned epsg = o->epsg ? o->epsg : !o->crs && o->sphere ? 4326 : 0;
  char plane[] = "ENGCRS[\"Undefined Cartesian SRS\",EDATUM[\"Undefined\"],CS[Cartesian,2],AXIS[\"x\",unspecified],"
                 "AXIS[\"y\",unspecified],LENGTHUNIT[\"unknown\",1]]";
  char *text = o->crs || strcmp(o->driver, "GPKG") != 0 ? o->crs : plane; /* GeoPackage would say degrees */
  if (epsg ? OSRImportFromEPSG(crs, (int)epsg) == OGRERR_NONE : text && OSRImportFromWkt(crs, &text) == OGRERR_NONE)
    return crs;
  OSRDestroySpatialReference(crs);
  return NULL;
}

/* Moves the files of the folder to where the target is, the target last: then it is whole. Sidecars that an earlier
 * Shapefile of the name had, and this one has not, go. */
static bool move_files(const char *folder, const char *target, const char *base) {
  static const char *const stale[] = {".prj", ".cpg", ".qix", ".sbn", ".sbx", ".shx", ".dbf"};
  char **list = VSIReadDir(folder), from[8192], to[8192];
  size_t stem = strlen(target), n = strlen(base);
  bool good = true, shape = n > 4 && strcasecmp(base + n - 4, ".shp") == 0;
  for (size_t k = 0; shape && k < sizeof stale / sizeof *stale; k++) {
    snprintf(to, sizeof to, "%.*s%s", (int)stem - 4, target, stale[k]);
    unlink(to);
  }
  for (int last = 0; last < 2; last++)
    for (char **file = list; file && *file && good; file++) {
      if (strcmp(*file, ".") == 0 || strcmp(*file, "..") == 0 || (strcmp(*file, base) == 0) != last) continue;
      snprintf(from, sizeof from, "%s/%s", folder, *file);
      snprintf(to, sizeof to, "%.*s%s", (int)(stem - n), target, *file);
      good = rename(from, to) == 0;
    }
  CSLDestroy(list);
  return good;
}

static void remove_folder(const char *folder) {
  char **list = VSIReadDir(folder), path[8192];
  for (char **file = list; file && *file; file++) {
    snprintf(path, sizeof path, "%s/%s", folder, *file);
    unlink(path);
  }
  CSLDestroy(list);
  rmdir(folder);
}

static int complain_writing(const cli_options *o, dyd_status st, const dyd_error *err) {
  const char *why = CPLGetLastErrorMsg();
  if (st == DYD_E_IO || !err->message[0])
    return cli_complain("%s: cannot write: %s; choose another place with -o", o->output, *why ? why : strerror(errno));
  cli_complain_at(o->file, err);
  return st == DYD_CAPPED ? CLI_BUDGET : st == DYD_CANCELLED ? cli_exit_cut() : CLI_FAILED;
}

/* Says which layers there are. */
static void note_layers(const cli_options *o, GDALDatasetH set) {
  char list[1024] = "";
  const char *name, *before = "; not ";
  list_layers(list, sizeof list, set);
  size_t used = strlen(list);
  bool large;
  for (size_t k = 0; o->all_layers && used < sizeof list && (name = dyd_layer_name(NULL, &large, o->content, k)); k++) {
    if (!large) continue;
    used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", before, name);
    before = ", ";
  }
  cli_note(o, "%s (%s) holds %s%s", o->output, o->driver, list,
           *before == ',' ? ", which are large: name one by --layer" : "");
}

/* Writes in the folder, which is next to the target. */
static int write_in(const char *folder, const char *target, cli_session *s, cli_print_fn print) {
  const char *slash = strrchr(target, '/'), *base = target + (slash ? slash + 1 - target : 0);
  char path[8192], name[256];
  dyd_error err;
  dyd_error_clear(&err);
  CPLStrlcpy(path, CPLFormFilename(folder, base, NULL), sizeof path);
  snprintf(name, sizeof name, "%.*s", (int)strcspn(base, "."), base);
  const char *kind = s->o.driver ? s->o.driver : "";
  GDALDriverH driver = GDALGetDriverByName(kind);
  if (!driver) return cli_usage("this GDAL does not write %s; give another ending", kind);
  OGRSpatialReferenceH crs = system_of(&s->o);
  CPLErrorReset();
  GDALDatasetH set = GDALCreate(driver, path, 0, 0, 0, GDT_Unknown, NULL);
  bool stepped = set && GDALDatasetStartTransaction(set, FALSE) == OGRERR_NONE;
  dyd_status st = set ? layers_write(set, crs, s, print, name, &err) : DYD_E_IO;
  if (st == DYD_OK && stepped && GDALDatasetCommitTransaction(set) != OGRERR_NONE) st = DYD_E_IO;
  if (st == DYD_OK) note_layers(&s->o, set), CPLErrorReset();
  if (set) GDALClose(set);
  if (st == DYD_OK && CPLGetLastErrorType() >= CE_Failure) st = DYD_E_IO;
  if (crs) OSRDestroySpatialReference(crs);
  if (st == DYD_OK && !move_files(folder, target, base)) st = DYD_E_IO, CPLErrorReset();
  return st == DYD_OK ? 0 : complain_writing(&s->o, st, &err);
}

static int features_write(cli_session *s, cli_print_fn print) {
  char *target = realpath(s->o.output, NULL), folder[4096 + 16];
  if (!target) target = strdup(s->o.output);
  if (!target) return cli_complain_memory();
  GDALAllRegister();
  CPLSetErrorHandler(CPLQuietErrorHandler);
  const char *slash = strrchr(target, '/');
  /* No ending of the name is in that of the folder: GDAL would look for an archive there. */
  snprintf(folder, sizeof folder, "%.*s.dyadel-XXXXXX", slash ? (int)(slash + 1 - target) : 0, target);
  int status = mkdtemp(folder)
                   ? write_in(folder, target, s, print)
                   : cli_complain("%s: cannot write: %s; choose another place with -o", s->o.output, strerror(errno));
  remove_folder(folder);
  free(target);
  return status;
}

static const cli_gdal functions = {features_open, features_close, features_write};
const cli_gdal *const cli_gdal_here = &functions;
