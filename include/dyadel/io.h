/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points files in, results out: the formats of the command. */
#ifndef DYADEL_IO_H
#define DYADEL_IO_H

#include <dyadel/check.h>
#include <dyadel/converge.h>
#include <dyadel/graph.h>
#include <dyadel/metric.h>
#include <dyadel/sphere.h>
#include <dyadel/survey.h>
#include <dyadel/tolerance.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The contents of a file. Begun with DYD_SIZED. A call that fails sets it, too: to the contents read before. */
typedef struct dyd_read_report {
  size_t struct_size;
  size_t rows;    /* lines with a point, or records behind the header; including lines without a point */
  size_t missing; /* rows skipped by skip_missing */
  size_t merged;  /* rows taken as one with an earlier one by merge or merge_by */
  size_t shared;  /* rectangles whose centre is that of another one, which leaves their neighbours undecided */
  bool degrees; /* the columns of x and y are called longitude and latitude: lon, lng, stop_lon, decimalLongitude .. */
  bool swapped; /* the column of x is called latitude or northing, that of y longitude or easting */
  size_t commented; /* lines of a table that begin with # or % and have as many fields as others, so that they may be
                       rows; they are skipped as comments */
  size_t recoded;   /* lines that are not UTF-8 and were read as Windows-1252, which includes Latin-1 */
  /* Set when the file is neither a points file nor a table: the name of its format, a command
   * that makes a table of the file called FILE (NULL: there is none), and the columns of x and y in that table (NULL:
   * it is a points file). Static storage; kind = NULL: the file is read. */
  const char *kind, *make, *make_columns;
  size_t repeated, repeat[2]; /* rows with the identifier of an earlier one, but for merge_by; the first such row,
                                 behind that earlier one, counted from 0 in this text */
  size_t vertices;            /* points that are vertices of lines and polygons in well-known text */
  char zone[2][4];            /* two UTM zones that a column called zone holds, such as 32U and 33U; "": none, or one */
} dyd_read_report;

/* Columns are named as in the header (quoted as in RFC 4180 when they hold commas; capitals count only where names
 * differ by them alone), or by their numbers from 1. Rows skipped or merged: dyd_engine_row, dyd_engine_merged. */
typedef struct dyd_read_options {
  size_t struct_size; /* set by DYD_SIZED */
  const char
      *columns;  /* "NAME,NAME": read separated text with a header (RFC 4180), these are x and y; NULL: points file */
  bool measured; /* read every decimal as a rounded measurement: 47.61 becomes [47.605,47.615] */
  const char *radius;         /* an exact number: widen every point by it on each side; NULL: none */
  const char *radius_columns; /* "NAME" or "NAME,NAME": widen each point by these columns as well, in x and y */
  const char *id;             /* "NAME": the column of identifiers (dyd_engine_id) */
  const char *carry;          /* "all" or "NAME,NAME": columns that layers of points repeat (dyd_engine_carried) */
  const char *delimiter;   /* one character, "tab" or "blank" (runs of blanks); NULL: the one that suits the header */
  bool decimal_comma;      /* 47,61 is 47.61; commas within parentheses and brackets separate all the same */
  bool skip_missing;       /* skip rows in which a coordinate or radius is empty, NA, N/A, #N/A or another error of
                              a spreadsheet, NaN, null, None, - or `missing` */
  bool merge;              /* equal nominal coordinates are one point: with the smaller radius */
  dyd_read_report *report; /* receives counts of the rows; NULL: nowhere */
  /* x and y are longitude and latitude: a latitude beyond 90 degrees is an error with its line and column, columns
   * whose names say the other order are DYD_E_ARG, and so are radii in a column without a unit: "30m", "2 km", that of
   * radius_unit, or that in the column's name ("sde(m)", "s [mm]", "accuracyInMeters"). Lengths do not belong to the
   * rectangle, but kept in metres (DYD_ROW_RADIUS). */
  bool degrees;
  const char *cost_column; /* "NAME": the cost of measuring a point again (DYD_ROW_COST) */
  /* "S", "SX,SY" or "SX,SY,RHO": standard deviations of the normal errors in x and y, and their correlation. Without
   * confidence only "S", which is kept (DYD_ROW_SIGMA). */
  const char *sigma_column;
  bool keep_radii; /* radii in a column do not widen points, but are kept (DYD_ROW_RADIUS) */
  /* "m", "mm", "cm", "km", "ft", "in", "deg", "arcmin" or "arcsec": the unit of radii without one; with `degrees` only,
   * as in the plane radii are in the unit of the coordinates. NULL: none. */
  const char *radius_unit;
  const char *radius_scale; /* an exact number above 0 that all radii are multiplied by; NULL: 1 */
  const char *thousands;    /* separator of groups of three digits: , . ' _ or "blank"; NULL: nothing */
  const char *missing;      /* a further word, or number, that means nothing; NULL: none */
  const char *skip_lines;   /* "N": skip the first N lines; NULL: none */
  bool no_header;           /* the table has no header: columns are named by numbers */
  bool units_row;           /* the row behind the header holds units: no point, but the unit of radii */
  /* "95%" or "0.95", a decimal above 0 and below 1: widens the n points with a standard deviation above 0 by k = sqrt(2
   * ln(n / (1 - confidence))) of them, so that with at least this probability all lie in their regions [CNF-1]. Units
   * and scale as of radii. On the globe lengths in x and y are those of one disc. NULL: none. */
  const char *confidence;
  bool round; /* regions are discs: those of confidence are squares around discs that hold the ellipses of errors */
  /* "id": rows of one identifier (`id`) are one point, which is in the region of each: their rectangles intersect; of
   * discs (`round`), and of radii on the globe, the smallest is taken, which holds the intersection. Rows without an
   * identifier are points of their own. With `confidence`, in the plane: the mean of rows, weighted by inverse
   * variances, whose variance is that for independent errors of these rows. DYD_E_PARSE names two rows that have
   * nothing in common. Numbers that are not rational are merged where their rows are written alike. NULL: nothing is
   * merged. */
  const char *merge_by;
  /* Memory that the points of this text may take while they are read and added, by an estimate within a factor of 2:
   * DYD_E_NOMEM when it is more. 0: no bound. Lines and unpacking (a few megabytes) do not count. */
  uint64_t max_bytes;
} dyd_read_options;

/* A field of dyd_read_options but struct_size, report and max_bytes, for programs that set fields by name or look at
 * all. */
typedef struct dyd_read_field {
  size_t struct_size; /* set by the library */
  const char *name;   /* "radius_columns" */
  size_t offset;      /* in dyd_read_options: of a bool, or of a const char * that NULL does not set */
  bool flag;          /* it is a bool */
  bool table;         /* needs `columns`: it is about the columns of a table, or their separator */
  bool points;        /* decides which points a text holds: the same text with another value may hold others */
  bool text;          /* says how a text is read: ignored for points from other sources */
} dyd_read_field;
/* Returns field k, from 0; NULL after the last. *value (unless NULL) becomes the value in options: the text, "true" for
 * a bool that is set, NULL for options not set, and for options NULL. Borrowed. O(1) */
DYD_API const dyd_read_field *dyd_read_field_at(const char **value, const dyd_read_options *options, size_t k);

/* A number in the row of a point, next to its coordinates. */
typedef enum dyd_row_number {
  DYD_ROW_COST,   /* of measuring the point again (dyd_read_options.cost_column); 1 where the row has none */
  DYD_ROW_RADIUS, /* that does not widen its rectangle (degrees, keep_radii), rounded up; 0 where the row has none */
  DYD_ROW_SIGMA,  /* the standard deviation of its errors (sigma_column); 0 where the row has none */
  DYD_ROW_NUMBERS
} dyd_row_number;
/* Returns the text in the k-th column that points carry (dyd_read_options.carry) in the row of point i, "" where the
 * point has no row in a file; NULL behind the last column. *name (unless NULL) becomes its name. Borrowed. O(k) */
DYD_API const char *dyd_engine_carried(const char **name, const dyd_engine *e, size_t i, size_t k);
/* With at least this probability all points lie in their regions. */
typedef struct dyd_confidence {
  size_t struct_size;
  char probability[96]; /* "0.95" */
  double k;             /* regions reach this many standard deviations */
  size_t n;             /* points with a standard deviation above 0 */
} dyd_confidence;
/* Sets *out to the confidence with which the points of e were read. Returns false, with *out unchanged, if none was
 * stated. O(1) */
DYD_API bool dyd_engine_confidence(dyd_confidence *out, const dyd_engine *e);
/* States it of points that the caller widens by k standard deviations; out as above, begun with DYD_SIZED. DYD_E_ARG:
 * probability is no such text (dyd_read_options.confidence), or one was stated before. */
DYD_API dyd_status dyd_engine_state_confidence(dyd_confidence *out, dyd_engine *e, const char *probability, size_t n,
                                               dyd_error *err);
/* Returns this number of point i. O(1) */
DYD_API double dyd_engine_number(const dyd_engine *e, size_t i, dyd_row_number which);

/* Reads points from `in` up to its end and adds them to e (nothing is added on failure). What gzip or zstd packed is
 * read as it is. options may be NULL.
 * On DYD_E_PARSE err has line, column and a message with the remedy. After a run or question, too: see
 * dyd_engine_add_points. */
DYD_API dyd_status dyd_read_points(dyd_engine *e, FILE *in, const dyd_read_options *options, dyd_error *err);

/* The same from a text in memory, which is copied: one point or a whole file. */
DYD_API dyd_status dyd_engine_add_text(dyd_engine *e, const char *text, size_t length, const dyd_read_options *options,
                                       dyd_error *err);
/* A rectangle from one line of a points file, such as "22/7 [1.2,1.3]"; each coordinate as dyd_interval_set_text has
 * it. On DYD_E_PARSE err has line, column and a message with the remedy. */
DYD_API dyd_status dyd_rect_set_text(dyd_rect *out, const char *text, size_t length, dyd_error *err);

/* ---- tables apart from the points ---- */

/* A record of a table, borrowed for the call. */
typedef struct dyd_record {
  size_t struct_size; /* set by the library */
  size_t fields;      /* above 0 */
  const void *field;  /* for the functions below */
} dyd_record;
/* Takes a record. A result other than DYD_OK, with *err filled, ends the reading. */
typedef dyd_status (*dyd_record_fn)(void *user, const dyd_record *record, dyd_error *err);
/* Reads the records of a text up to its end, packed (gzip, zstd) or not; lines are at most 1048576 bytes long.
 *
 * delimiter  ' ': fields are separated by any number of blanks, tabs, commas and semicolons, and # begins a comment;
 *            another character: separated text (RFC 4180); in both, lines that begin with # or % are comments;
 *            0: of , ; tab and | the first that the first record holds, else ' '
 *
 * Empty lines are skipped, and blanks around fields are removed. Returns what record returned; DYD_E_PARSE with line
 * and column for NUL bytes, longer lines, and quotes that do not pair up; DYD_E_IO; DYD_E_NOMEM. err may be NULL. */
DYD_API dyd_status dyd_read_records(FILE *in, char delimiter, dyd_record_fn record, void *user, dyd_error *err);
/* Returns field k, from 0, which is not terminated; NULL, with *length = 0, where the record ends before. */
DYD_API const char *dyd_record_field(size_t *length, const dyd_record *record, size_t k);
/* Sets err->line and err->column to the begin of field k, or to the end of the record where it ends before. */
DYD_API void dyd_record_place(dyd_error *err, const dyd_record *record, size_t k);

typedef enum dyd_format {
  DYD_FORMAT_CSV = 0,
  DYD_FORMAT_JSON,
  DYD_FORMAT_WKT,
  DYD_FORMAT_GEOJSON,
  DYD_FORMAT_OBJ,
  DYD_FORMAT_SVG,
  DYD_FORMAT_VTK,
  DYD_FORMAT_PDF,
  DYD_FORMAT_PNG,
  DYD_FORMAT_HTML,
  DYD_FORMAT_TIKZ, /* a tikzpicture: what svg shows */
  DYD_FORMAT_PGF   /* an axis of pgfplots: the curves of a table of convergence */
} dyd_format;
/* What dyd_write writes. */
typedef enum dyd_content {
  DYD_CONTENT_NONE = 0, /* no format holds it */
  DYD_CONTENT_DELAUNAY,
  DYD_CONTENT_VORONOI,
  DYD_CONTENT_CONVERGENCE, /* the table */
  DYD_CONTENT_PLOT,        /* and its curves */
  DYD_CONTENT_CHECK,
  DYD_CONTENT_DISC,
  DYD_CONTENT_BISECTOR,
  DYD_CONTENT_NEAREST,
  /* One layer of the triangulation or the diagram, in formats that hold a single kind of things. There
   * DYD_CONTENT_DELAUNAY is the layer of pairs, DYD_CONTENT_VORONOI that of cells. */
  DYD_CONTENT_POINTS,
  DYD_CONTENT_TRIANGLES,
  DYD_CONTENT_VERTICES,
  DYD_CONTENT_REGIONS,
  DYD_CONTENT_EDGES,
  DYD_CONTENT_PLACES,    /* the nearest points of many places */
  DYD_CONTENT_TOLERANCE, /* events of pairs */
  DYD_CONTENT_RADII,     /* and its other layers: how far each point may be from its place; */
  DYD_CONTENT_BARCODE,   /* how many edges are certain at which accuracy */
  DYD_CONTENT_PLAN,      /* what to measure next */
  /* Layers of the triangulation, also as pictures: edges of graphs of neighbours, in the order of
   * dyd_graph (dyadel/graph.h). */
  DYD_CONTENT_GRAPH_NEAREST,
  DYD_CONTENT_GRAPH_GABRIEL,
  DYD_CONTENT_GRAPH_MST,
  DYD_CONTENT_SPHERE, /* the triangulation of a sphere: pairs, and its other layers */
  DYD_CONTENT_SPHERE_POINTS,
  DYD_CONTENT_SPHERE_TRIANGLES,
  DYD_CONTENT_SPHERE_VORONOI, /* its diagram: cells, and other layers */
  DYD_CONTENT_SPHERE_VERTICES,
  DYD_CONTENT_SPHERE_REGIONS,
  DYD_CONTENT_ALIASES,         /* rows that have a point in common with an earlier one: a layer of the triangulation, */
  DYD_CONTENT_VORONOI_ALIASES, /* and of the diagram */
  DYD_CONTENT_TIES,            /* groups of ties */
  DYD_CONTENT_TILES,           /* a partition of the window (dyd_voronoi_tiles): a layer of the diagram */
  DYD_CONTENT_CON,             /* Con of the other rectangles: a layer of the disc, which is circles as csv */
  DYD_CONTENT_HULLS,           /* partial edges and certain partial triangles (dyd_rect_hull), */
  DYD_CONTENT_EXTERIOR,        /* and where certainly no edge is (dyd_delaunay_exterior): layers of the triangulation */
  DYD_CONTENT_PLAN_PAIRS,      /* which pairs each point of a plan decides: a layer of DYD_CONTENT_PLAN */
  DYD_CONTENT_TRIALS,          /* a plan tried on drawn places (dyd_survey_simulate) */
  DYD_CONTENTS                 /* how many there are */
} dyd_content;

/* How ties are listed beside other pairs. */
typedef enum dyd_list_ties {
  DYD_LIST_TIES_PAIRS = 0, /* a row for each pair: k sites of a circle have k (k - 3) / 2 */
  DYD_LIST_TIES_GROUPS,    /* csv: the groups instead of the pairs; json always has the groups, and then only them */
  DYD_LIST_TIES_NONE
} dyd_list_ties;

/* Finds a format by its name ("csv"), or by the ending of a file's name ("a/map.svg", in any case); false when there is
 * none. */
DYD_API bool dyd_format_from_name(dyd_format *out, const char *name);
DYD_API bool dyd_format_from_file(dyd_format *out, const char *file);
/* What there is to know of a format. Texts have static storage. */
typedef struct dyd_format_facts {
  size_t struct_size; /* set by the library */
  const char *name;   /* which is the ending of its files, too */
  const char *about;  /* a description without a full stop */
  const char *also;   /* another ending that suits it: csv for wkt, json for geojson; NULL: none */
  bool binary;        /* it is not text */
} dyd_format_facts;
/* Returns NULL behind the last format, so that counting up from 0 lists them all. */
DYD_API const dyd_format_facts *dyd_format_get(dyd_format format);
/* The layers of DYD_CONTENT_DELAUNAY, _VORONOI, _TOLERANCE, _PLAN, _SPHERE and _SPHERE_VORONOI. Returns the k-th name,
 * the default first, NULL behind the last one, in static storage. Sets *layer to its content, and *large if it is many
 * times as large as the default one, or as slow to find: files of several layers hold it only if it is named. Both may
 * be NULL. */
DYD_API const char *dyd_layer_name(dyd_content *layer, bool *large, dyd_content of, size_t k);
/* Finds the content of a layer by its name ("points"); false when there is none. */
DYD_API bool dyd_layer_from_name(dyd_content *out, dyd_content of, const char *name);
/* Returns true if the format can hold the content; discs: of statuses of discs, which decide less than some layers and
 * formats state. Otherwise dyd_write returns DYD_E_ARG with a message that names the formats that can. */
DYD_API bool dyd_format_holds(dyd_format format, dyd_content content, bool discs);

/* The result of dyd_engine_nearest or dyd_sphere_nearest; all borrowed. Begun with DYD_SIZED. */
typedef struct dyd_nearest_answer {
  size_t struct_size; /* set by DYD_SIZED */
  const dyd_rect *at; /* the rectangle reached of the point asked about */
  const dyd_index_list *found;
  bool sure;
  dyd_outcome outcome;
  bool tied;  /* dyd_engine_nearest_tied */
  bool discs; /* sites are discs: dyd_disc_nearest */
  /* Of many places: the value of `q`, where it is not the number of the answer; an identifier (NULL: none), which all
   * places have if the first has one. */
  bool placed;
  size_t place;
  const char *id;
} dyd_nearest_answer;

/* How pictures look, and what json says of the run. Sizes are in points of 1/72 inch, 0 to 5000. DYD_E_ARG for others,
 * and where texts need all of the width. */
typedef struct dyd_write_style {
  size_t struct_size; /* set by DYD_SIZED */
  bool bare;          /* pictures: without legend, scale and coordinates */
  double width;       /* of the whole picture; 0: about 1120 */
  double font_size;   /* 0: 14 on a page of the usual width, less on a smaller one, but not less than 7 */
  const char *font;   /* a family of fonts, in TikZ of LaTeX, as phv; NULL: sans-serif, in TikZ the document's */
  const char *const
      *command_line; /* the words of the program's call, up to a NULL; json repeats them; NULL: it does not */
} dyd_write_style;
/* Input and options of dyd_write; all borrowed. Fields that do not belong to the content are ignored. */
typedef struct dyd_write_options {
  size_t struct_size; /* set by DYD_SIZED */

  const dyd_sphere *sphere; /* for contents of a sphere; of nearest points (dyd_sphere_nearest): distances are those of
                               dyd_sphere_distance, only csv and json; NULL: a plane */
  const dyd_tolerance
      *tolerance; /* tolerances of the result; also for html of the triangulation: with points; NULL: html shows none */
  const dyd_survey *plan;
  const dyd_survey_trial *trial; /* of a plan, `trials` of them, with the seed for json */
  size_t trials;
  uint64_t seed;
  const dyd_convergence *stages; /* for tables of convergence and their plot, of a run */
  const dyd_check_report *report;
  const dyd_rect *const *rect; /* a disc: of the first three, and where the others are; a bisector: of the first */
  size_t rects;                /* two */
  const dyd_nearest_answer *const *answer; /* of one place (DYD_CONTENT_NEAREST), or of places numbered from 0 */
  size_t answers;
  dyd_outcome outcome; /* of discs, bisectors and places: how narrowing ended */

  /* Of the diagram: dyadic ends, positive area; NULL: dyd_voronoi_window. Of others: the extent of pictures and html,
   * in degrees on a sphere, where longitudes are modulo 360, as in [170, 200]; positive area; NULL: everything. */
  const dyd_rect *window;
  unsigned epsg; /* EPSG number of the coordinates' reference system, for geojson and json; 0: none is claimed, on a
                    sphere longitude and latitude (CRS84) in geojson */
  const volatile int *cancel; /* of graphs as in dyd_graph_edges: DYD_CANCELLED. Of the diagram: once it is set the rest
                                 is written quickly, and true all the same: nothing of a cell is certain, all of the
                                 window possible; boundaries are null in json; regions are the window, vertices
                                 unbounded, the distance is not known. NULL: none */
  const dyd_history *history; /* of the run, a stage for each row of `stages`, for html; NULL: only the result is shown.
                                 DYD_E_ARG with pairs, and where it ends with other pairs than the result */

  const dyd_graph_list *graph; /* of a layer that is a graph: its edges (dyd_engine_graph); NULL: they are found */
  const dyd_pair_list *pairs;  /* dyd_disc_pairs of the result. Of the triangulation: written instead of its pairs, in
                                  csv, wkt, geojson and pictures. Of the diagram: cells, bounds and edges are those of
                                  the discs; vertices and regions those of the squares around them, which hold for discs,
                                  too; json has no exact arcs. NULL: none */
  dyd_list_ties ties;

  int64_t flatten_bits;       /* of the diagram: polygons within 2^-flatten_bits of their cells */
  bool flatten_set;           /* false: a choice that suits the mean size of cells */
  dyd_voronoi_bounds *bounds; /* initialised by the caller; receives the bounds that were written; may be NULL */
  size_t *cut;                /* receives how many cells and regions `cancel` befell; may be NULL */
  size_t *coincident;         /* receives dyd_tiles.coincident of the tiles that were written; may be NULL */
  double max_arc; /* sides of cells of a sphere in wkt and geojson are divided into arcs of at most this many degrees;
                     0: 1; not above 90 */

  bool next;  /* of a plan the first row only */
  bool times; /* tables of convergence: seconds, too; without them equal runs give equal bytes */
  /* "NAME=VALUE,NAME=VALUE": columns of that table before the others in csv, "label" in json; no quotes, backslashes
   * and control characters. NULL: none. no_header: csv has rows only, so that tables of several runs are one when they
   * are put behind each other. */
  const char *label;
  bool no_header;
  /* Of that table, instead of its rows (json: in addition): for each m from modulus_from to modulus_to the first stage
   * from which on the bound is at most 2^-m (that of areas where these are the goal, else of the distance; of the
   * diagram where the table is about it), the bits asked of all points and of one until then, and the a priori
   * modulus (dyd_converge_options.rates): bits for every point by which the distance is at most 2^-m, and the stage
   * from which they follow. Empty: not reached, not known. */
  bool modulus;
  int64_t modulus_from, modulus_to;
  /* Receives, before csv is written, lines that begin with "# ": window, bounds, goal, aliases, how numbers are
   * rounded. It may be the file that is written. NULL: none are written. */
  FILE *comments;
  bool lengths;     /* pairs and graphs of the plane: columns length_lo, length_hi, rounded outward */
  bool clip;        /* edges of the diagram: cut to the window, and omitted where they are certainly beyond it */
  const char *name; /* the name of the points, such as their file: the title of html; NULL: none */
  /* Tiles, but in vtk, are cut to it (dyd_tiles_clip), one row for each site. NULL: they are not. */
  const dyd_area *clip_to;
  const dyd_write_style *style; /* NULL: as usual */
} dyd_write_options;
/* Reads an area: all polygons in well-known text, also in a table, or GeoJSON. Coordinates become the nearest doubles.
 * Other geometries, and edges that cross, are DYD_E_PARSE with line and column. *out is replaced; in is borrowed. */
DYD_API dyd_status dyd_area_read(dyd_area *out, FILE *in, dyd_error *err);
/* Returns true if this is such a label, and its names differ. */
DYD_API bool dyd_label_fits(const char *label);

/* Writes the content. Numbers are exact, or rounded to a side that the output states. o may be NULL.
 *
 * e: whose current result is written, of the triangulation, the diagram, tolerances, plans and nearest points. Of discs
 * and bisectors: whose first points they are of, so that its rows and identifiers name them; NULL: numbers do. Of
 * tables of convergence: that ran, for html. Ignored for contents of a sphere, the plot and the report.
 *
 * DYD_CONTENT_BISECTOR: the arcs of both curves with exact ends. DYD_CONTENT_DISC: orientation, the six critical
 * circles exactly and enclosed, the box of the partial centre, and Con of the other rectangles. DYD_CONTENT_NEAREST and
 * DYD_CONTENT_PLACES: the points that are possibly, or the one that is certainly nearest, with bounds of their
 * distances. DYD_CONTENT_PLOT: bounds and counts against stages on logarithmic scales. Pictures of tolerances colour
 * edges by the death; those of plans label points with rank and name, and colour open pairs by the ranks that decide
 * them.
 *
 * On a sphere, in wkt and geojson, edges are great circles, a place at every 2 degrees at most, cut where they cross
 * the meridian of 180 degrees; of triangles that hold more than half of the sphere the geometry is empty. Cells that
 * are known all around are valid polygons: one for each part between meridians of 180 degrees; one that holds a pole
 * goes up that meridian, along the pole's parallel and down again. Of one point the cell is the globe, of two they are
 * its halves.
 *
 * DYD_E_ARG when the format does not hold the content, an object that it needs is missing, or has no result, and for
 * options out of range. DYD_CAPPED for diagrams when neighbours are missing since the cap on pairs was met. DYD_E_RANGE
 * when doubles cannot hold a picture, and for html when more than 300000 pairs would be shown. DYD_E_IO when a write
 * fails. err may be NULL. */
DYD_API dyd_status dyd_write(FILE *out, const dyd_engine *e, dyd_content content, dyd_format format,
                             const dyd_write_options *o, dyd_error *err);

/* ---- cells as arrays ---- */

/* CERTAIN: lies in the cell for every choice. POSSIBLE: one of the polygons that together hold it for every choice.
 * EXACT, which is both: of exact points, the cell. */
typedef enum dyd_ring_kind { DYD_RING_CERTAIN = 1, DYD_RING_POSSIBLE = 2, DYD_RING_EXACT = 3 } dyd_ring_kind;
/* A polygon: its vertices are xy[2 k], xy[2 k + 1] for k below `end`, from the end of the ring before on. */
typedef struct dyd_cell_ring {
  uint32_t site;
  uint32_t kind; /* dyd_ring_kind */
  size_t end;
  double rounding; /* the most that a coordinate of a vertex was rounded by, rounded up; 0: none was */
} dyd_cell_ring;
/* The polygons of all cells, in the order of the sites: counter-clockwise, the first vertex not repeated. area[2 i] <=
 * the area of the cell of site i on the window for every choice <= area[2 i + 1]; aliases have that of the site that
 * represents them, and no rings. The polygons are within 2^-bits of their cells. Owned: init with {0}. */
typedef struct dyd_cells {
  size_t count, sites; /* rings; pairs of areas */
  dyd_cell_ring *ring;
  double *xy, *area;
  int64_t bits;
} dyd_cells;
DYD_API void dyd_cells_clear(dyd_cells *c);
/* Sets *out to the rows that dyd_write gives of DYD_CONTENT_VORONOI in wkt. Of the options it takes window,
 * pairs, flatten_bits, flatten_set, bounds, cut and cancel. Errors and cost are those of dyd_write; on failure *out is
 * unchanged. */
DYD_API dyd_status dyd_voronoi_cells(dyd_cells *out, const dyd_engine *e, const dyd_write_options *o, dyd_error *err);

/* ---- vertices, edges and regions as arrays ---- */

/* A certain edge of the diagram, between the cells of i < j. end[0] is on the left of the way from i to j, end[1] on
 * its right: the number of a vertex; DYD_END_OPEN: in an undecided region; -2 - k: along ray k, without an end. */
typedef struct dyd_frame_edge {
  uint32_t i, j;
  int64_t end[2];
} dyd_frame_edge;
enum { DYD_END_OPEN = -1 };
/* direction: bounds of both components of a vector along the ray, x lower, x upper, y lower, y upper, rounded outward.
 * box: holds a place on it beyond the window; NaN where the other end of its edge is not known. */
typedef struct dyd_frame_ray {
  double direction[4], box[4];
} dyd_frame_ray;
/* box[4 k] to box[4 k + 3]: the enclosure of vertex k for every choice, x lower, x upper, y lower, y upper, rounded
 * outward, infinite where it is not known; behind the vertices the boxes of the regions, which hold all vertices of an
 * undecided face in the window. Their sites are site[end[k - 1]] to site[end[k] - 1]. face: of each region, see
 * dyd_delaunay_face. Owned: init with {0}. */
typedef struct dyd_frame {
  size_t vertices, regions, edges, rays;
  double *box;
  size_t *end;
  uint32_t *site, *face;
  dyd_frame_edge *edge;
  dyd_frame_ray *ray;
} dyd_frame;
DYD_API void dyd_frame_clear(dyd_frame *f);
/* Sets *out to the data that dyd_write writes for DYD_CONTENT_VERTICES, DYD_CONTENT_EDGES and DYD_CONTENT_REGIONS in
 * csv. Of the options it uses window, flatten_bits, flatten_set, cut and cancel. Errors and cost are those of
 * dyd_write; on failure *out is unchanged. */
DYD_API dyd_status dyd_voronoi_frame(dyd_frame *out, const dyd_engine *e, const dyd_write_options *o, dyd_error *err);

/* One line "XLO XHI YLO YHI" for each of `count` sites from `first` on: exact numbers in the forms that
 * dyd_rect_narrow_text and the reader take. DYD_E_ARG when there are fewer sites; DYD_E_IO, DYD_E_NOMEM. */
DYD_API dyd_status dyd_write_rects(FILE *out, const dyd_sites *sites, size_t first, size_t count, dyd_error *err);

/* ---- for languages without FILE ---- */

/* Takes `count` bytes; false: it failed, and is not called again. */
typedef bool (*dyd_put_fn)(void *user, const char *bytes, size_t count);
/* Gives at most `room` bytes and says how many in *got; 0 at the end. false: it failed. */
typedef bool (*dyd_get_fn)(size_t *got, void *user, char *bytes, size_t room);
/* A file for all functions that write one, if there is put, or read one, if there is get; the other is NULL. Output
 * goes to put in pieces of any size, the last ones when the file is closed. Release with fclose, which returns EOF when
 * a call failed. Callbacks come from the thread that uses the file. DYD_E_NOMEM; DYD_E_IO where the C library cannot do
 * this (POSIX lacks it). */
DYD_API dyd_status dyd_file_of_callback(FILE **out, dyd_put_fn put, dyd_get_fn get, void *user, dyd_error *err);

/* ---- traces ---- */

/* A trace holds each narrowing of a point, and why; replaying it gives the same statuses without asking a point.
 * It is one JSON object per line, exact numbers are texts "m*2^e" or "p/q":
 *   {"format":"dyadel trace 2","points":N,"input":..,"schedule":...}         first line: the request and its input
 *   {"stage":S,"point":I,"bits":B,"called":C,"final":F,"why":W,"pair":[I,J],"x":[LO,HI],"y":[LO,HI]}
 *                                      point I has been narrowed for stage S; W is a dyd_reason, "pair" is there when
 *                                      it names one; C = false: it was narrow enough before; "final", there when it is
 *                                      true: it cannot be narrowed further
 *   {"stage":1,"point":I,"why":"fixed","x":[LO,HI],"y":[LO,HI]}              a point that cannot be narrowed
 *   {"proved":R,"points":[I,J,...]}    these points are proved to be "coincident" (two), "collinear" or "cocircular"
 *   {"stage":S,"done":true,"legal":..,"indeterminate":..,"tie":..,"statuses":DIGEST}
 *                                      stage S is complete; DIGEST as in dyd_stage_row, in hexadecimal
 *   {"kept":true,"point":I,"bits":B,"final":F,"x":[LO,HI],"y":[LO,HI]}
 *                                      behind the first line: an answer of an earlier trace, which this run was given
 *                                      and may take again; a replay passes it over
 *   {"outcome":O}                                                            last line
 * The last member of each line, "sum", is a digest in hexadecimal (FNV-1a, 64 bits) of the lines so far, each up to
 * that member and without its end: it reveals lines that were changed, moved or removed. It is not a signature: the
 * writer of a trace can write its digests. */
typedef struct dyd_trace dyd_trace;

/* Begins a trace of a run of e (not run before) with these options. `input`, a text of letters, digits and blanks, or
 * NULL, distinguishes inputs (a digest). Answers that e was given by dyd_trace_recall come first, so that this
 * trace alone is enough to continue from. `out` is borrowed until dyd_trace_end; when it is line-buffered, each answer
 * is in the file before the next request. */
DYD_API dyd_status dyd_trace_new(dyd_trace **trace, FILE *out, const dyd_engine *e, const char *input,
                                 const dyd_engine_options *options, const dyd_converge_options *converge,
                                 dyd_error *err);
/* Brings the lines written to the disk (fdatasync), now and, from now on, with the first line that is written `seconds`
 * or more after the last time, and at the end: when the machine fails, the answers of at most this many seconds of the
 * run are lost. Where this is not called, the system decides. DYD_E_ARG for a negative number; DYD_E_IO. */
DYD_API dyd_status dyd_trace_sync(dyd_trace *trace, double seconds, dyd_error *err);
/* For dyd_engine_options.trace and dyd_engine_options.progress; user is the dyd_trace. */
DYD_API void dyd_trace_step(void *trace, const dyd_step *step);
DYD_API void dyd_trace_stage(void *trace, const dyd_progress *p);
/* Writes the last line and frees the trace. DYD_E_IO, DYD_E_NOMEM for whatever failed since it began. */
DYD_API dyd_status dyd_trace_end(dyd_trace *trace, dyd_outcome outcome, dyd_error *err);

/* Puts the rectangles of a trace into a table of sites and triangulates after each stage, as the run did. *out, given
 * cleared, receives a row per stage as dyd_converge_run makes it (seconds 0), and keeps those made before a failure.
 * DYD_E_PARSE with line and message when the trace is not of its form, ends early, names a rectangle that is not inside
 * the one before, or states other statuses than the replay finds. Window and `of` come from the trace; the
 * callback of converge is called; DYD_CANCELLED soon after its flag is set. converge and err may be NULL. */
DYD_API dyd_status dyd_trace_replay(dyd_convergence *out, FILE *in, const dyd_converge_options *converge,
                                    dyd_error *err);

typedef struct dyd_recall_report {
  size_t struct_size; /* set by DYD_SIZED */
  size_t answers;     /* taken from the trace */
  bool cut;           /* its last line was cut short, and skipped */
} dyd_recall_report;
/* Gives e, not run before, the answers of a trace (dyd_engine_recall), so that a run with the same options continues
 * from where the traced one ended, however it did: a trace cut short within a line is taken up to there. `input` as for
 * dyd_trace_new; NULL: not compared. DYD_E_PARSE with line and message when the trace is not of its form, of another
 * number of points, of another input, or names a rectangle that is not inside the one before; answers taken until then
 * stay in e. out and err may be NULL. */
DYD_API dyd_status dyd_trace_recall(dyd_recall_report *out, dyd_engine *e, FILE *in, const char *input, dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
