/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Layers: tables with a row for each feature, as csv, as wkt (csv with a column WKT) or as geojson.
 *
 * A layer is a row of the table in layers.c: its name, columns and kind of geometry, and a function that writes its
 * rows; an encoder (table.c) writes any layer. Columns are plain (numbers and texts), and all rows have the same kind
 * of geometry, so that programs that know one kind a table (Shapefile, GeoPackage) take them. A row is written from
 * left to right:
 *
 *     dyd_row_begin(t);
 *     dyd_row_spot(t, i);                             its geometry; csv has none
 *     dyd_row_site(t, i); dyd_row_word(t, "legal");   one value for each column
 *     dyd_row_end(t);
 *
 * wkt and geojson have one more column, max_coordinate_error: the largest distance of a coordinate of the geometry from
 * the exact one, rounded up. */
#ifndef DYD_IO_TABLE_H
#define DYD_IO_TABLE_H

#include "io/decimal.h"
#include "io/output.h"

/* Short decimals that represent a box. Invariant: every point of the box is within `error` of it in x and in y. */
typedef struct dyd_short_place {
  char x[DYD_DECIMAL_SIZE], y[DYD_DECIMAL_SIZE];
  double error;
  unsigned char length[2]; /* of x, of y */
} dyd_short_place;

/* Of a box with finite ends: x lower, x upper, y lower, y upper. */
void dyd_short_place_set(dyd_short_place *out, const double box[4]);

typedef enum dyd_geometry {
  DYD_GEOMETRY_POINT,
  DYD_GEOMETRY_LINE,
  DYD_GEOMETRY_POLYGON,
  DYD_GEOMETRY_LINES, /* any number of parts, see dyd_row_part */
  DYD_GEOMETRY_POLYGONS
} dyd_geometry;

typedef struct dyd_table dyd_table;
/* Part of a layer; the table is begun for rows, not for comments. */
typedef dyd_status dyd_layer_part(dyd_table *t, const dyd_output *o);

typedef struct dyd_layer {
  dyd_content content;
  const char *name; /* by which commands know it; NULL: `of` has a single layer */
  dyd_content of;   /* whose layer it is */
  bool geographic;  /* wkt and geojson hold it, too */
  bool sites;       /* features are drawn at sites, see dyd_row_spot */
  bool large;       /* much larger, or slower to find, than the default one */
  dyd_geometry geometry;
  dyd_layer_part *comments; /* writes the lines of csv before the header; NULL: there are none */
  dyd_layer_part *rows;
  /* Separated by commas. Columns that begin with "id" exist if points have identifiers. Columns with "?" before their
   * name exist in wkt and geojson only; of tolerances, if chances are known; of pairs, if lengths are wanted. "*" means
   * the columns that points carry. */
  const char *columns;
} dyd_layer;

/* The k-th layer, and that of a content; NULL where there is none. The order is that in which the layers of a command
 * are listed. */
const dyd_layer *dyd_layer_at(size_t k);
const dyd_layer *dyd_layer_of(dyd_content content);
/* Writes o->content, which is a layer, in csv, wkt or geojson. */
dyd_writer dyd_layer_write;
/* The parts of layers in other files than layers.c. */
dyd_layer_part dyd_cell_comments, dyd_vertex_comments, dyd_diagram_comments, dyd_globe_vertex_comments;
dyd_layer_part dyd_disc_comments, dyd_bisector_comments, dyd_nearest_comments;
dyd_layer_part dyd_tile_comments, dyd_tile_rows;
dyd_layer_part dyd_cell_rows, dyd_vertex_rows, dyd_region_rows, dyd_edge_rows;
dyd_layer_part dyd_globe_cell_rows, dyd_globe_vertex_rows, dyd_globe_region_rows;
dyd_layer_part dyd_check_rows, dyd_disc_rows, dyd_con_rows, dyd_bisector_rows, dyd_nearest_rows, dyd_place_rows;

/* A piece that all rows have, put together once. */
typedef struct dyd_table_lead {
  size_t length;
  char text[80];
} dyd_table_lead;
enum { DYD_TABLE_COLUMNS = 32 };

/* Invariant: lead[0 .. columns) are the texts before the values of the columns, the error included. */
struct dyd_table {
  const dyd_layer *layer;           /* borrowed, as what follows */
  dyd_geometry geometry;            /* that of the layer, or of tiles that are cut: polygons */
  const struct dyd_encoder *encode; /* table.c */
  const dyd_engine *engine;         /* whose rows and identifiers name sites */
  const dyd_sphere *sphere;         /* coordinates are degrees on it; NULL: a plane */
  bool drawn;                       /* rows have a geometry */
  dyd_short_place *place;           /* of the sites of a plane; NULL: nothing is drawn at them; owned, as */
  double (*box)[4];                 /* of those of a sphere, */
  bool lengths, clip;               /* pairs have them; edges are cut to the window */
  void *kept;                       /* what comments keep for rows */
  dyd_table_lead begin, lead[DYD_TABLE_COLUMNS];
  const char *name[DYD_TABLE_COLUMNS]; /* each up to a comma */
  size_t columns;
  size_t rows, places, values; /* so far; the latter two of this row, places since the part began */
  size_t parts;                /* of this row */
  double error, most;          /* of the coordinates of this row, of all */
  dyd_sink to;
};

/* Whether columns that begin with "?" are there. */
void dyd_table_begin(dyd_table *t, const dyd_output *o, bool optional);
void dyd_table_end(dyd_table *t);
/* Returns true if a format of rows has a geometry. */
bool dyd_format_draws(dyd_format format);

void dyd_row_begin(dyd_table *t);
void dyd_row_end(dyd_table *t);
/* Begins the next part of lines or polygons; without any the geometry is empty. */
void dyd_row_part(dyd_table *t);
/* Begins a hole of this part of polygons. */
void dyd_row_hole(dyd_table *t);
/* The next place of the geometry; a polygon repeats its first. */
void dyd_row_place(dyd_table *t, const dyd_short_place *place);
/* The same for the place of a box: x lower, x upper, y lower, y upper, finite. */
void dyd_row_at(dyd_table *t, const double box[4]);
/* The four corners of a box, as a polygon. */
void dyd_row_outline(dyd_table *t, const double box[4]);
/* Site i as the geometry. */
void dyd_row_spot(dyd_table *t, size_t i);
/* The numbers of the row of a site; its identifier, or nothing if points have none. */
void dyd_row_site(dyd_table *t, size_t i);
void dyd_row_text(dyd_table *t, const char *text);
void dyd_row_id(dyd_table *t, size_t i);
/* Writes the columns that point i carries, if any. */
void dyd_row_carried(dyd_table *t, size_t i);
/* All three: the columns i, id, *. */
void dyd_row_own(dyd_table *t, size_t i);
/* Ends a row by the columns id_i, id_j. */
void dyd_row_end_two(dyd_table *t, size_t i, size_t j);
/* Those of three sites. */
void dyd_row_three(dyd_table *t, const uint32_t site[3], bool ids);
/* The numbers of the sites in their file, separated by blanks. */
void dyd_row_sites(dyd_table *t, const dyd_index_list *list);
void dyd_row_index(dyd_table *t, size_t i);
/* Our own words and numbers: nothing needs quoting in csv. */
void dyd_row_word(dyd_table *t, const char *text);
/* A decimal rounded in direction dir; none where x is not finite. */
void dyd_row_decimal(dyd_table *t, double x, dyd_round dir);
/* To 6 digits, rounded down. decimal: x is nearest to such a number, which is written. */
void dyd_row_brief(dyd_table *t, double x, bool decimal);
/* Four of them: the ends of a box, rounded outward. */
void dyd_row_box(dyd_table *t, const double box[4]);
/* A word that is written to the file, until dyd_row_close. */
FILE *dyd_row_open(dyd_table *t);
void dyd_row_close(dyd_table *t);
/* In csv, a value, or several with commas, that is written to the file. */
FILE *dyd_row_file(dyd_table *t);

#endif
