/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Files of geographic information systems. GDAL takes 50 ms to load, so that it is in a program of its own,
 * dyadel-gdal: this command with gdal.c. What needs it is started again there. */
#define _GNU_SOURCE /* memmem */
#include "cli.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/auxv.h>
#endif

/* ---- the kind of a file ---- */

/* By the first bytes; texts after blanks, which hold a word. Neither begins a point. */
static const struct {
  const char *first;
  size_t length;
  const char *within, *kind;
} first_bytes[] = {{"SQLite format 3", 16, "", "GeoPackage"},
                   {"\0\0\x27\x0A", 4, "", "Shapefile"},
                   {"fgb\x03", 4, "", "FlatGeobuf"},
                   {"PAR1", 4, "", "Parquet"},
                   {"{", 1, "\"type\"", "GeoJSON"},
                   {"{", 1, "\"geometryType\"", "JSON of ESRI"},
                   {"<", 1, "<gpx", "GPX"},
                   {"<", 1, "<kml", "KML"},
                   {"<", 1, "<osm", "OpenStreetMap XML"},
                   {"<", 1, "gml", "GML"}};

/* Formats that the first bytes of a file do not show, and names of databases and services. */
static const struct {
  const char *end, *begin, *kind;
} names[] = {{".gdb", NULL, "GDB"},        {".tab", NULL, "MapInfo"},     {".mif", NULL, "MapInfo"},
             {".kmz", NULL, "KMZ"},        {".xlsx", NULL, "XLSX"},       {".ods", NULL, "ODS"},
             {".dbf", NULL, "DBF"},        {NULL, "PG:", "database"},     {NULL, "MySQL:", "database"},
             {NULL, "MSSQL:", "database"}, {NULL, "ODBC:", "database"},   {NULL, "WFS:", "service"},
             {NULL, "/vsi", "GDAL"},       {NULL, "http://", "download"}, {NULL, "https://", "download"}};

static bool has_ends(const char *name, const char *begin, const char *end) {
  size_t n = strlen(name), m = end ? strlen(end) : 0;
  if (begin) return strncasecmp(name, begin, strlen(begin)) == 0;
  return n > m && strcasecmp(name + n - m, end) == 0;
}

const char *cli_spatial_kind(const char *name) {
  struct stat info;
  unsigned char text[4096];
  if (!name || strcmp(name, "-") == 0) return NULL;
  bool there = stat(name, &info) == 0;
  for (size_t k = 0; k < sizeof names / sizeof *names; k++)
    if (there != (names[k].begin != NULL) && has_ends(name, names[k].begin, names[k].end)) return names[k].kind;
  FILE *in = there && S_ISREG(info.st_mode) ? fopen(name, "rb") : NULL;
  if (!in) return NULL;
  size_t count = fread(text, 1, sizeof text, in), at = count >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
  fclose(in);
  while (at < count && isspace(text[at])) at++;
  for (size_t k = 0; k < sizeof first_bytes / sizeof *first_bytes; k++)
    if (count - at >= first_bytes[k].length && memcmp(text + at, first_bytes[k].first, first_bytes[k].length) == 0 &&
        memmem(text + at, count - at, first_bytes[k].within, strlen(first_bytes[k].within)))
      return first_bytes[k].kind;
  return NULL;
}

/* ---- formats that GDAL writes ---- */

static const struct {
  const char *ending, *driver;
  bool layers; /* it holds several */
} written[] = {{"gpkg", "GPKG", true},        {"shp", "ESRI Shapefile", false},
               {"fgb", "FlatGeobuf", false},  {"kml", "KML", true},
               {"gml", "GML", true},          {"sqlite", "SQLite", true},
               {"parquet", "Parquet", false}, {"geojsonl", "GeoJSONSeq", false},
               {"xlsx", "XLSX", true},        {"ods", "ODS", true}};

const char *cli_spatial_driver(bool *layers, const char *ending) {
  for (size_t k = 0; ending && k < sizeof written / sizeof *written; k++) {
    if (strcasecmp(written[k].ending, ending) != 0) continue;
    *layers = written[k].layers;
    return written[k].driver;
  }
  return NULL;
}

/* ---- the program that has GDAL ---- */

/* What there is to do without GDAL. Of files with a kind, reading says that. */
static int complain_without(const cli_options *o) {
  const char *file = o->file ? o->file : o->points,
             *missing = "this program was built without GDAL, and there is no "
                        "dyadel-gdal (install it, or build it: libgdal-dev, ninja -C build)";
  if (o->driver)
    return cli_usage("-o %s: %s; write geojson and convert it: dyadel %s ... -o out.geojson && ogr2ogr %s out.geojson",
                     o->output, missing, o->command, o->output);
  if (!o->in_layer && (!file || access(file, F_OK) == 0)) return 0;
  return cli_usage("%s: %s; give the points as a table: ogr2ogr -f CSV /vsistdout/ -lco GEOMETRY=AS_XY %s %s | dyadel "
                   "%s --columns X,Y -",
                   file, missing, file, o->in_layer ? o->in_layer : "", o->command);
}

void cli_folder_find(char *path, size_t size) {
  ssize_t length = readlink("/proc/self/exe", path, size);
#ifdef __linux__
  if (length < 0)
    length = snprintf(path, size, "%s", (const char *)getauxval(AT_EXECFN)); /* no /proc, as in a chroot */
#endif
  if (length >= (ssize_t)size) length = 0;
  while (length > 0 && path[length - 1] != '/') length--;
  path[length > 0 ? length : 0] = 0;
}

/* Becomes the program, which is beside this one, or in libexec beside its folder; returns where it is in neither. */
static void become_gdal(char **argv) {
  char path[4096];
  cli_folder_find(path, sizeof path - 64);
  size_t length = strlen(path);
  if (!length) return;
  strcpy(path + length, "dyadel-gdal");
  execv(path, argv);
  if (length > 4 && memcmp(path + length - 4, "bin/", 4) == 0) strcpy(path + length - 4, "libexec/dyadel-gdal");
  execv(path, argv);
}

int cli_spatial_switch(const cli_options *o, char **argv) {
  if (cli_gdal_here || o->help || o->version || !o->command) return 0;
  bool needed = o->driver || o->in_layer || cli_spatial_kind(o->points) || cli_spatial_kind(o->queries);
  if (!needed && (strcmp(o->command, "verify") == 0 || !cli_spatial_kind(o->file))) return 0;
  become_gdal(argv);
  return complain_without(o);
}
