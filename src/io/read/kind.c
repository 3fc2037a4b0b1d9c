/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which format a file has that is neither a points file nor a table, by its first bytes. */
#define _GNU_SOURCE /* memmem */
#include "io/read/kind.h"

#include "base/error.h"

#include <string.h>

#define TABLE(options) "ogr2ogr -f CSV /vsistdout/ " options " -lco GEOMETRY=AS_XY", "X,Y", NULL
#define GRID "gdal_translate -q -of XYZ FILE /vsistdout/ | cut -d' ' -f1,2", NULL, NULL
#define BYTES(text) text, sizeof(text) - 1

/* The beginning of a file, and another text in its first bytes (NULL: anything). The first row that fits counts. data:
 * any text that is not a table or a points file. */
static const struct kind_row {
  const char *begin;
  size_t length;
  const char *within;
  bool data;
  dyd_file_kind kind;
} kind_rows[] = {
    {BYTES("PK\3\4"), ".shp", false, {"a zip archive with a Shapefile", TABLE("/vsizip/FILE")}},
    {BYTES("PK\3\4"), ".kml", false, {"KML in a zip archive (KMZ)", TABLE("/vsizip/FILE")}},
    {BYTES("PK\3\4"), ".npy", false, {"an archive of NumPy", NULL, NULL, "write x and y as text, by numpy.savetxt"}},
    {BYTES("PK\3\4"), NULL, false, {"a zip archive or a spreadsheet", NULL, NULL, "save it as CSV"}},
    {BYTES("\xD0\xCF\x11\xE0"), NULL, false, {"a spreadsheet", NULL, NULL, "save it as CSV"}},
    {BYTES("BZh"), NULL, false, {"packed by bzip2", NULL, NULL, "unpack it, or pack it by gzip or zstd"}},
    {BYTES("\xFD"
           "7zXZ"),
     NULL,
     false,
     {"packed by xz", NULL, NULL, "unpack it, or pack it by gzip or zstd"}},
    {BYTES("7z\xBC\xAF"), NULL, false, {"packed by 7-Zip", NULL, NULL, "unpack it, or pack it by gzip or zstd"}},
    {BYTES("Rar!"), NULL, false, {"packed by RAR", NULL, NULL, "unpack it, or pack it by gzip or zstd"}},
    {BYTES("\x04\"M\x18"), NULL, false, {"packed by LZ4", NULL, NULL, "unpack it, or pack it by gzip or zstd"}},
    {BYTES("\xFF\xFE\0\0"), NULL, false, {"text in UTF-32", NULL, NULL, "save it as UTF-8"}},
    {BYTES("\xFF\xFE"), NULL, false, {"text in UTF-16", NULL, NULL, "save it as UTF-8"}},
    {BYTES("\xFE\xFF"), NULL, false, {"text in UTF-16", NULL, NULL, "save it as UTF-8"}},
    {BYTES("\0\0\x27\x0A"), NULL, true, {"a Shapefile", TABLE("FILE")}},
    {BYTES("SQLite format 3"), NULL, true, {"an SQLite database, perhaps a GeoPackage", TABLE("FILE")}},
    {BYTES("fgb\3"), NULL, true, {"FlatGeobuf", TABLE("FILE")}},
    {BYTES("PAR1"), NULL, true, {"Parquet", TABLE("FILE")}},
    {BYTES("ARROW1"), NULL, true, {"Arrow or Feather", TABLE("FILE")}},
    {BYTES("\x93NUMPY"),
     NULL,
     true,
     {"an array of NumPy", "python3 -c 'import sys, numpy; numpy.savetxt(sys.stdout, numpy.load(\"FILE\"), \"%r\")'",
      NULL, NULL}},
    {BYTES("\x89PNG"), NULL, false, {"a picture (PNG)", NULL, NULL, "give the table that it was made of"}},
    {BYTES("\xFF\xD8\xFF"),
     NULL,
     false,
     {"a picture (JPEG)", NULL, NULL, "give a table with its coordinates, by exiftool -csv"}},
    {BYTES("\x89HDF"), NULL, true, {"HDF5 or NetCDF", NULL, NULL, "write its coordinates as CSV, by h5dump or xarray"}},
    {BYTES("CDF"), "\1", true, {"NetCDF", NULL, NULL, "write its coordinates as CSV, by ncdump or xarray"}},
    {BYTES("MATLAB "), "MAT-file", true, {"a MAT-file of MATLAB", NULL, NULL, "write x and y as text, by writematrix"}},
    {BYTES("\x80\4\x95"),
     NULL,
     true,
     {"binary, perhaps a pickle of Python", NULL, NULL, "write it as CSV, by to_csv or numpy.savetxt"}},
    {BYTES("ply\n"), NULL, true, {"PLY", "sed '1,/^end_header/d' FILE | cut -d' ' -f1,2", NULL, NULL}},
    {BYTES("0\n"), "SECTION", true, {"DXF", TABLE("FILE")}},
    {BYTES("0\r\n"), "SECTION", true, {"DXF", TABLE("FILE")}},
    {BYTES("AutoCAD Binary DXF"),
     NULL,
     true,
     {"binary DXF", NULL, NULL, "save it as DXF in text, or its points as CSV"}},
    {BYTES("AC10"), "\1", true, {"DWG", NULL, NULL, "save it as DXF, or its points as CSV"}},
    {BYTES("EXP  0"), NULL, true, {"an export of ArcInfo (E00)", TABLE("FILE")}},
    {BYTES("ASTM-E57"), NULL, true, {"E57", NULL, NULL, "write x and y as text, by pdal or CloudCompare"}},
    {BYTES(""), "\nDATA ascii", true, {"PCD", "sed '1,/^DATA/d' FILE | cut -d' ' -f1,2", NULL, NULL}},
    {BYTES(""), "\nDATA binary", true, {"binary PCD", NULL, NULL, "write it as text, by pcl_convert_pcd_ascii_binary"}},
    {BYTES("# vtk DataFile"), NULL, true, {"VTK", NULL, NULL, "write its points as CSV, by ParaView or meshio"}},
    {BYTES("solid "), "facet", true, {"STL", NULL, NULL, "write its points as CSV, by meshio"}},
    {BYTES("$MeshFormat"), NULL, true, {"a mesh of Gmsh", NULL, NULL, "write its nodes as CSV, by meshio"}},
    {BYTES("OFF\n"),
     NULL,
     true,
     {"OFF", "awk 'NR == 2 {n = $1} NR > 2 && NR < n + 3 {print $1, $2}' FILE", NULL, NULL}},
    {BYTES(""), "\nmtllib ", true, {"OBJ", "sed -nE 's/^v +([^ ]+ +[^ ]+).*/\\1/p' FILE", NULL, NULL}},
    {BYTES("ncols"), "cellsize", true, {"a grid of ESRI", GRID}},
    {BYTES("NCOLS"), "CELLSIZE", true, {"a grid of ESRI", GRID}},
    {BYTES("DSAA"), NULL, true, {"a grid of Surfer", GRID}},
    {BYTES("DSBB"), NULL, true, {"a grid of Surfer", GRID}},
    {BYTES("II*\0"), NULL, true, {"a picture or a grid (TIFF)", GRID}},
    {BYTES("structure("),
     NULL,
     true,
     {"code of R (dput)", NULL, NULL, "write it by write.csv(..., row.names = FALSE)"}},
    {BYTES("X\n\0\0"),
     NULL,
     true,
     {"data of R (RDS)", NULL, NULL, "write them by write.csv(readRDS(...), row.names = FALSE)"}},
    {BYTES("RDX"), NULL, true, {"data of R (RData)", NULL, NULL, "write them by write.csv(..., row.names = FALSE)"}},
    {BYTES("$FL"), NULL, true, {"data of SPSS", NULL, NULL, "write them as CSV, by pandas.read_spss"}},
    {BYTES("<stata_dta"), NULL, true, {"data of Stata", NULL, NULL, "write them as CSV, by export delimited"}},
    {BYTES("HEADER RECORD***"), NULL, true, {"data of SAS", NULL, NULL, "write them as CSV, by proc export"}},
    {BYTES("%=SNX"), NULL, true, {"SINEX", NULL, NULL, "write the coordinates of its stations as CSV"}},
    {BYTES("JB,NM"), NULL, true, {"a raw file of Carlson (RW5)", NULL, NULL, "export its points as CSV"}},
    {BYTES("00NM"), NULL, true, {"a DC file of Trimble", NULL, NULL, "export its points as CSV"}},
    {BYTES("11"), "81..", true, {"GSI of Leica", NULL, NULL, "export the points as CSV (words 81 and 82 are x and y)"}},
    {BYTES("*11"),
     "81..",
     true,
     {"GSI of Leica", NULL, NULL, "export the points as CSV (words 81 and 82 are x and y)"}},
    {BYTES("A"),
     "\nHFDTE",
     true,
     {"IGC", "gpsbabel -i igc -f FILE -o unicsv -F /dev/stdout", "Longitude,Latitude", NULL}},
    {BYTES(""),
     "NODE_COORD_SECTION",
     true,
     {"TSPLIB", "sed -nE 's/^ *[0-9]+ +([^ ]+ +[^ ]+) *$/\\1/p' FILE", NULL, NULL}},
    {BYTES(""),
     "RINEX VERSION",
     true,
     {"RINEX, observations without positions", NULL, NULL, "compute positions first, by rnx2rtkp"}},
    {BYTES("LASF"), NULL, true, {"LAS or LAZ", NULL, NULL, "write x and y as text, by las2txt or pdal"}},
    {BYTES("$G"),
     ",",
     true,
     {"NMEA sentences of a receiver", "gpsbabel -i nmea -f FILE -o unicsv -F /dev/stdout", "Longitude,Latitude", NULL}},
    {BYTES("%PDF"), NULL, true, {"PDF", NULL, NULL, "copy its table to a text file"}},
    {BYTES("<"), "<gpx", true, {"GPX", TABLE("FILE waypoints")}},
    {BYTES("<"), "<kml", true, {"KML", TABLE("FILE")}},
    {BYTES("<"),
     "<TrainingCenterDatabase",
     true,
     {"TCX", "gpsbabel -i gtrnctr -f FILE -o unicsv -F /dev/stdout", "Longitude,Latitude", NULL}},
    {BYTES("<"), "<LandXML", true, {"LandXML", NULL, NULL, "export its points as CSV"}},
    {BYTES("<"), "<JOBFile", true, {"JobXML of Trimble", NULL, NULL, "export its points as CSV"}},
    {BYTES("<"), "<osm", true, {"OpenStreetMap XML", TABLE("FILE points")}},
    {BYTES("<"), "<html", true, {"HTML", NULL, NULL, "save its table as CSV"}},
    {BYTES("<"), "gml", true, {"GML", TABLE("FILE")}},
    {BYTES("<"), "<", true, {"XML or HTML", NULL, NULL, "save its table as CSV"}},
    {BYTES("{"),
     "latitudeE7",
     true,
     {"a timeline of Google",
      "jq -r '\"lonE7,latE7,accuracy\", (.. | objects | select(.latitudeE7) | [.longitudeE7, .latitudeE7, .accuracy] | "
      "@csv)' "
      "FILE",
      "lonE7,latE7", NULL}},
    {BYTES("{"), "\"Topology\"", true, {"TopoJSON", TABLE("FILE")}},
    {BYTES("{"), "\"type\"", true, {"GeoJSON", TABLE("FILE")}},
    {BYTES("{"), "\"", true, {"JSON", NULL, NULL, "make a table of it, for instance jq -r '[.x, .y] | @csv' FILE"}},
    {BYTES("[{"),
     NULL,
     true,
     {"JSON", NULL, NULL, "make a table of it, for instance jq -r '.[] | [.x, .y] | @csv' FILE"}},
    {BYTES("[["), ",", true, {"JSON", "jq -r '.[] | @tsv' FILE", NULL, NULL}},
    {BYTES("[["), NULL, true, {"an array as NumPy prints it", "tr -d '[]' < FILE", NULL, NULL}},
};

/* Words that begin a geometry in WKT. */
static const char *const shapes[] = {"POINT",        "MULTIPOINT",         "LINESTRING", "MULTILINESTRING",   "POLYGON",
                                     "MULTIPOLYGON", "GEOMETRYCOLLECTION", "TRIANGLE",   "POLYHEDRALSURFACE", "TIN"};
static const dyd_file_kind wkb_cells = {"a table with a column of WKB (geometries in hexadecimal digits)",
                                        TABLE("FILE -oo GEOM_POSSIBLE_NAMES=*geom*,*wkb*,*shape*,*point*")},
                           json_cells = {"a table with a column of GeoJSON",
                                         TABLE("FILE -oo GEOM_POSSIBLE_NAMES=*geom*,*json*,*shape*,*point*")};
static const dyd_file_kind wkt_cells = {"a table with a column of WKT (geometries in words)",
                                        TABLE("FILE -oo GEOM_POSSIBLE_NAMES=*geom*,*wkt*,*shape*,*point*")};

/* "SRID=4326; POINT Z (" begins a geometry, "Point,X,Y" does not. */
static bool is_wkt(const char *at, const char *end) {
  static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  const char *semicolon = end - at > 5 && dyd_same_name(at, "SRID=", 5) ? memchr(at, ';', (size_t)(end - at)) : NULL;
  if (semicolon) at = semicolon + 1;
  while (at < end && *at == ' ') at++;
  const char *word = at;
  while (at < end && memchr(letters, *at, sizeof letters - 1)) at++;
  size_t length = (size_t)(at - word);
  while (at < end && memchr(" ZMzm", *at, 5)) at++;
  if (at == end || *at != '(') return false;
  for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++)
    if (strlen(shapes[k]) == length && dyd_same_name(shapes[k], word, length)) return true;
  return false;
}

const dyd_file_kind *dyd_kind_find(const char *first, size_t length, bool data) {
  enum { LOOKED_AT = 4096 };
  const char *at = first, *end = first + (length < LOOKED_AT ? length : LOOKED_AT);
  while (data && at < end && memchr(" \t\r\n", *at, 4)) at++;
  for (size_t k = 0; k < sizeof kind_rows / sizeof *kind_rows; k++) {
    const struct kind_row *r = &kind_rows[k];
    if ((r->data && !data) || (size_t)(end - at) < r->length || memcmp(at, r->begin, r->length) != 0) continue;
    if (!r->within || memmem(at, (size_t)(end - at), r->within, strlen(r->within))) return &r->kind;
  }
  return NULL;
}

const dyd_file_kind *dyd_kind_of_cell(const char *text, size_t length) {
  if (length > 9 && *text == '{' && memmem(text, length, "\"type\"", 6)) return &json_cells;
  size_t hex = 0;
  while (hex < length && memchr("0123456789ABCDEFabcdef", text[hex], 22)) hex++;
  if (hex == length && length > 41 && *text == '0' && (text[1] | 1) == '1') return &wkb_cells;
  return is_wkt(text, text + length) ? &wkt_cells : NULL;
}

dyd_status dyd_kind_fail(dyd_error *err, const dyd_file_kind *kind) {
  if (!kind->make) return dyd_fail(err, DYD_E_PARSE, "the file is %s; %s", kind->name, kind->remedy);
  return dyd_fail(err, DYD_E_PARSE, "the file is %s; make %s of it: %s%s%s", kind->name,
                  kind->columns ? "a table" : "a points file", kind->make, kind->columns ? "; its `columns` are " : "",
                  kind->columns ? kind->columns : "");
}
