/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Layers: tables with a row for each feature, as csv, as wkt (csv with a column WKT) or as geojson.
 *
 * The one place where columns are put together. Columns are plain (numbers and texts), and all rows have the same kind
 * of geometry, so that programs that know one kind a table (Shapefile, GeoPackage) take them. A row is written from
 * left to right:
 *
 *     dyd_table_begin(&t, &head);
 *     for each feature
 *       dyd_row_begin(&t);
 *       dyd_row_place(&t, ..);                            its geometry; csv leaves it out
 *       dyd_row_site(&t, i); dyd_row_text(&t, "legal");  one value for each column
 *       dyd_row_end(&t);
 *     dyd_table_end(&t);
 *
 * wkt and geojson get a last column by themselves: max_coordinate_error, how far at most a coordinate of the geometry
 * is from what it stands for, rounded up. */
#ifndef DYD_IO_TABLE_H
#define DYD_IO_TABLE_H

#include "io/output.h"
#include "io/place.h"

typedef enum dyd_geometry {
  DYD_GEOMETRY_POINT,
  DYD_GEOMETRY_LINE,
  DYD_GEOMETRY_POLYGON,
  DYD_GEOMETRY_LINES, /* any number of parts, see dyd_row_part */
  DYD_GEOMETRY_POLYGONS
} dyd_geometry;

/* All borrowed while the table is written. */
typedef struct dyd_table_head {
  FILE *out;
  dyd_format format;         /* csv, wkt or geojson */
  const char *const *column; /* names, up to a NULL; those that begin with "id" only where points have identifiers */
  dyd_geometry geometry;
  unsigned epsg; /* the reference system of the coordinates; 0: none is claimed */
  const dyd_engine *engine;
  const dyd_sphere *sphere; /* coordinates are degrees on it, and `engine` is that of its places; NULL: a plane */
} dyd_table_head;

/* A piece that all rows have, put together once. */
typedef struct dyd_table_lead {
  size_t length;
  char text[80];
} dyd_table_lead;
enum { DYD_TABLE_COLUMNS = 16 };

/* Invariant: lead[0 .. columns) are before the values of those columns that there are, and before that of the error. */
typedef struct dyd_table {
  const dyd_table_head *head;
  bool json, bare; /* geojson; csv, without geometry */
  dyd_table_lead begin, lead[DYD_TABLE_COLUMNS];
  size_t columns;
  size_t rows, places, values; /* so far; the latter two of this row, places since the part began */
  size_t parts;                /* of this row */
  double error, most;          /* of the coordinates of this row, of all */
  dyd_sink to;
} dyd_table;

void dyd_table_begin(dyd_table *t, const dyd_table_head *head);
void dyd_table_end(dyd_table *t);

void dyd_row_begin(dyd_table *t);
void dyd_row_end(dyd_table *t);
/* Begins the next part of lines or polygons; without any the geometry is empty. */
void dyd_row_part(dyd_table *t);
/* The next place of the geometry; a polygon repeats its first. */
void dyd_row_place(dyd_table *t, const dyd_place *place);
/* The same for what stands for a box: x lower, x upper, y lower, y upper, finite. */
void dyd_row_at(dyd_table *t, const double box[4]);
/* The four corners of a box, as a polygon. */
void dyd_row_outline(dyd_table *t, const double box[4]);
void dyd_row_index(dyd_table *t, size_t i);
/* The number of a site in its file; its identifier, which is left out where there are none. */
void dyd_row_site(dyd_table *t, size_t i);
void dyd_row_id(dyd_table *t, size_t i);
/* The numbers of the sites in their file, separated by blanks. */
dyd_status dyd_row_sites(dyd_table *t, const dyd_index_list *list);
/* The columns of pairs: i, j, status, id_i, id_j; and what they say of one. */
extern const char *const dyd_columns_of_pairs[];
void dyd_row_pair(dyd_table *t, size_t i, size_t j, const char *status);
/* Our own words and numbers: nothing needs quoting in csv. */
void dyd_row_text(dyd_table *t, const char *text);
/* A decimal rounded in direction dir; none where x is not finite. */
void dyd_row_decimal(dyd_table *t, double x, dyd_round dir);
/* Four of them: the ends of a box, rounded outward. */
void dyd_row_box(dyd_table *t, const double box[4]);

#endif
