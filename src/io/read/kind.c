/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which format a file has that is neither a points file nor a table, by its first bytes. */
#define _GNU_SOURCE /* memmem */
#include "io/read/kind.h"

#include "base/error.h"

#include <string.h>

#define TABLE(options) "ogr2ogr -f CSV /vsistdout/ " options " -lco GEOMETRY=AS_XY", "X,Y", NULL
#define GRID "gdal_translate -q -of XYZ FILE /vsistdout/ | cut -d' ' -f1,2", NULL, NULL
#define GPS(format) "gpsbabel -i " format " -f FILE -o unicsv -F /dev/stdout", "Longitude,Latitude", NULL
#define BY(command) command, NULL, NULL
#define SAVE(remedy) NULL, NULL, remedy
#define KIND(text, within, data, ...)                                                                                  \
  {                                                                                                                    \
    text, sizeof(text) - 1, within, data, {                                                                            \
      __VA_ARGS__                                                                                                      \
    }                                                                                                                  \
  }

/* The beginning of a file, and another text in its first bytes (NULL: anything). The first row that fits counts. data:
 * any text that is not a table or a points file. */
static const struct kind_row {
  const char *begin;
  size_t length;
  const char *within;
  bool data;
  dyd_file_kind kind;
} kind_rows[] = {
    KIND("PK\3\4", ".shp", false, "a zip archive with a Shapefile", TABLE("/vsizip/FILE")),
    KIND("PK\3\4", ".kml", false, "KML in a zip archive (KMZ)", TABLE("/vsizip/FILE")),
    KIND("PK\3\4", ".npy", false, "an archive of NumPy", SAVE("write x and y as text, by numpy.savetxt")),
    KIND("PK\3\4", NULL, false, "a zip archive or a spreadsheet", SAVE("save it as CSV")),
    KIND("\xD0\xCF\x11\xE0", NULL, false, "a spreadsheet", SAVE("save it as CSV")),
    KIND("BZh", NULL, false, "packed by bzip2", SAVE("unpack it, or pack it by gzip or zstd")),
    KIND("\3757zXZ", NULL, false, "packed by xz", SAVE("unpack it, or pack it by gzip or zstd")),
    KIND("7z\xBC\xAF", NULL, false, "packed by 7-Zip", SAVE("unpack it, or pack it by gzip or zstd")),
    KIND("Rar!", NULL, false, "packed by RAR", SAVE("unpack it, or pack it by gzip or zstd")),
    KIND("\x04\"M\x18", NULL, false, "packed by LZ4", SAVE("unpack it, or pack it by gzip or zstd")),
    KIND("\xFF\xFE\0\0", NULL, false, "text in UTF-32", SAVE("save it as UTF-8")),
    KIND("\xFF\xFE", NULL, false, "text in UTF-16", SAVE("save it as UTF-8")),
    KIND("\xFE\xFF", NULL, false, "text in UTF-16", SAVE("save it as UTF-8")),
    KIND("\0\0\x27\x0A", NULL, true, "a Shapefile", TABLE("FILE")),
    KIND("SQLite format 3", NULL, true, "an SQLite database, perhaps a GeoPackage", TABLE("FILE")),
    KIND("fgb\3", NULL, true, "FlatGeobuf", TABLE("FILE")),
    KIND("PAR1", NULL, true, "Parquet", TABLE("FILE")),
    KIND("ARROW1", NULL, true, "Arrow or Feather", TABLE("FILE")),
    KIND("\x93NUMPY", NULL, true, "an array of NumPy",
         BY("python3 -c 'import sys, numpy; numpy.savetxt(sys.stdout, numpy.load(\"FILE\"), \"%r\")'")),
    KIND("\x89PNG", NULL, false, "a picture (PNG)", SAVE("give the table that it was made of")),
    KIND("\xFF\xD8\xFF", NULL, false, "a picture (JPEG)", SAVE("give a table with its coordinates, by exiftool -csv")),
    KIND("\x89HDF", NULL, true, "HDF5 or NetCDF", SAVE("write its coordinates as CSV, by h5dump or xarray")),
    KIND("CDF", "\1", true, "NetCDF", SAVE("write its coordinates as CSV, by ncdump or xarray")),
    KIND("MATLAB ", "MAT-file", true, "a MAT-file of MATLAB", SAVE("write x and y as text, by writematrix")),
    KIND("\x80\4\x95", NULL, true, "binary, perhaps a pickle of Python",
         SAVE("write it as CSV, by to_csv or numpy.savetxt")),
    KIND("ply\n", NULL, true, "PLY", BY("sed '1,/^end_header/d' FILE | cut -d' ' -f1,2")),
    KIND("0\n", "SECTION", true, "DXF", TABLE("FILE")),
    KIND("0\r\n", "SECTION", true, "DXF", TABLE("FILE")),
    KIND("AutoCAD Binary DXF", NULL, true, "binary DXF", SAVE("save it as DXF in text, or its points as CSV")),
    KIND("AC10", "\1", true, "DWG", SAVE("save it as DXF, or its points as CSV")),
    KIND("EXP  0", NULL, true, "an export of ArcInfo (E00)", TABLE("FILE")),
    KIND("ASTM-E57", NULL, true, "E57", SAVE("write x and y as text, by pdal or CloudCompare")),
    KIND("", "\nDATA ascii", true, "PCD", BY("sed '1,/^DATA/d' FILE | cut -d' ' -f1,2")),
    KIND("", "\nDATA binary", true, "binary PCD", SAVE("write it as text, by pcl_convert_pcd_ascii_binary")),
    KIND("# vtk DataFile", NULL, true, "VTK", SAVE("write its points as CSV, by ParaView or meshio")),
    KIND("solid ", "facet", true, "STL", SAVE("write its points as CSV, by meshio")),
    KIND("$MeshFormat", NULL, true, "a mesh of Gmsh", SAVE("write its nodes as CSV, by meshio")),
    KIND("OFF\n", NULL, true, "OFF", BY("awk 'NR == 2 {n = $1} NR > 2 && NR < n + 3 {print $1, $2}' FILE")),
    KIND("", "\nmtllib ", true, "OBJ", BY("sed -nE 's/^v +([^ ]+ +[^ ]+).*/\\1/p' FILE")),
    KIND("ncols", "cellsize", true, "a grid of ESRI", GRID),
    KIND("NCOLS", "CELLSIZE", true, "a grid of ESRI", GRID),
    KIND("DSAA", NULL, true, "a grid of Surfer", GRID),
    KIND("DSBB", NULL, true, "a grid of Surfer", GRID),
    KIND("II*\0", NULL, true, "a picture or a grid (TIFF)", GRID),
    KIND("structure(", NULL, true, "code of R (dput)", SAVE("write it by write.csv(..., row.names = FALSE)")),
    KIND("X\n\0\0", NULL, true, "data of R (RDS)", SAVE("write them by write.csv(readRDS(...), row.names = FALSE)")),
    KIND("RDX", NULL, true, "data of R (RData)", SAVE("write them by write.csv(..., row.names = FALSE)")),
    KIND("$FL", NULL, true, "data of SPSS", SAVE("write them as CSV, by pandas.read_spss")),
    KIND("<stata_dta", NULL, true, "data of Stata", SAVE("write them as CSV, by export delimited")),
    KIND("HEADER RECORD***", NULL, true, "data of SAS", SAVE("write them as CSV, by proc export")),
    KIND("%=SNX", NULL, true, "SINEX", SAVE("write the coordinates of its stations as CSV")),
    KIND("JB,NM", NULL, true, "a raw file of Carlson (RW5)", SAVE("export its points as CSV")),
    KIND("00NM", NULL, true, "a DC file of Trimble", SAVE("export its points as CSV")),
    KIND("11", "81..", true, "GSI of Leica", SAVE("export the points as CSV (words 81 and 82 are x and y)")),
    KIND("*11", "81..", true, "GSI of Leica", SAVE("export the points as CSV (words 81 and 82 are x and y)")),
    KIND("A", "\nHFDTE", true, "IGC", GPS("igc")),
    KIND("", "NODE_COORD_SECTION", true, "TSPLIB", BY("sed -nE 's/^ *[0-9]+ +([^ ]+ +[^ ]+) *$/\\1/p' FILE")),
    KIND("", "RINEX VERSION", true, "RINEX, observations without positions",
         SAVE("compute positions first, by rnx2rtkp")),
    KIND("LASF", NULL, true, "LAS or LAZ", SAVE("write x and y as text, by las2txt or pdal")),
    KIND("$G", ",", true, "NMEA sentences of a receiver", GPS("nmea")),
    KIND("%PDF", NULL, true, "PDF", SAVE("copy its table to a text file")),
    KIND("<", "<gpx", true, "GPX", TABLE("FILE waypoints")),
    KIND("<", "<kml", true, "KML", TABLE("FILE")),
    KIND("<", "<TrainingCenterDatabase", true, "TCX", GPS("gtrnctr")),
    KIND("<", "<LandXML", true, "LandXML", SAVE("export its points as CSV")),
    KIND("<", "<JOBFile", true, "JobXML of Trimble", SAVE("export its points as CSV")),
    KIND("<", "<osm", true, "OpenStreetMap XML", TABLE("FILE points")),
    KIND("<", "<html", true, "HTML", SAVE("save its table as CSV")),
    KIND("<", "gml", true, "GML", TABLE("FILE")),
    KIND("<", "<", true, "XML or HTML", SAVE("save its table as CSV")),
    KIND("{", "latitudeE7", true, "a timeline of Google",
         "jq -r '\"lonE7,latE7,accuracy\", (.. | objects | select(.latitudeE7) | [.longitudeE7, .latitudeE7, "
         ".accuracy] | @csv)' FILE",
         "lonE7,latE7", NULL),
    KIND("{", "\"Topology\"", true, "TopoJSON", TABLE("FILE")),
    KIND("{", "\"type\"", true, "GeoJSON", TABLE("FILE")),
    KIND("{", "\"", true, "JSON", SAVE("make a table of it, for instance jq -r '[.x, .y] | @csv' FILE")),
    KIND("[{", NULL, true, "JSON", SAVE("make a table of it, for instance jq -r '.[] | [.x, .y] | @csv' FILE")),
    KIND("[[", ",", true, "JSON", BY("jq -r '.[] | @tsv' FILE")),
    KIND("[[", NULL, true, "an array as NumPy prints it", BY("tr -d '[]' < FILE")),
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
