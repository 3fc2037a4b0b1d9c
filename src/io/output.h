/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a writer is given, and the writers of a format.
 *
 * The table of formats stands above, in src/format: it calls a writer, fills err where the writer did not, and sees
 * whether all was written. */
#ifndef DYD_IO_OUTPUT_H
#define DYD_IO_OUTPUT_H

#include <dyadel/arc.h>
#include <dyadel/io.h>

/* All borrowed; err is clear and not NULL. */
typedef struct dyd_output {
  FILE *out;
  dyd_format format;
  const void *what; /* the type that belongs to the content */
  dyd_error *err;
  dyd_content content; /* for writers of several */
} dyd_output;

typedef dyd_status dyd_writer(const dyd_output *o);
/* The writers of a format are an array by content, NULL where it cannot hold that: dyd_NAME_writers, in the file that
 * writes it. */
enum { DYD_CONTENTS = DYD_CONTENT_TIES + 1 };

/* `what` by content: dyd_result (result.h) and dyd_diagram (diagram.h), also of their layers, dyd_stage_table,
 * dyd_convergence, dyd_check_report, dyd_disc_output, dyd_bisector_output, dyd_nearest_output, dyd_tolerance_result,
 * also of its layers, dyd_plan_result, dyd_sphere_result, also of its layers. */
typedef struct dyd_stage_table {
  const dyd_convergence *stages;
  bool times;
  const struct dyd_result *result; /* with its history (result.h), for html; NULL: none */
  const char *label;               /* well-formed, or NULL */
  bool no_header;
} dyd_stage_table;
/* The names of its columns, separated by commas. */
extern const char dyd_stage_columns[];

typedef struct dyd_disc_output {
  const dyd_partial_disc *disc; /* of r[0], r[1], r[2] */
  const dyd_rect *const *r;
  size_t n;
  dyd_outcome outcome;
  const dyd_engine *engine; /* of which they are the first points; NULL: of none */
} dyd_disc_output;

typedef struct dyd_bisector_output {
  const dyd_rect *r[2];
  const dyd_boundary *curve; /* of (r[0],r[1]) and (r[1],r[0]), sites named 0 and 1 in both */
  dyd_outcome outcome;
  const dyd_engine *engine; /* of which they are the first points; NULL: of none */
} dyd_bisector_output;

typedef struct dyd_nearest_output {
  const dyd_engine *engine;
  const dyd_delaunay *pd;
  const dyd_nearest_answer *const *answer;
  size_t count;        /* of places */
  dyd_outcome outcome; /* of all */
} dyd_nearest_output;

typedef struct dyd_tolerance_result {
  struct dyd_result *result; /* of the nominal places (result.h) */
  const dyd_tolerance *tolerance;
} dyd_tolerance_result;

typedef struct dyd_plan_result {
  struct dyd_result *result;
  const dyd_survey *survey;
  bool next;
} dyd_plan_result;

typedef struct dyd_sphere_result {
  const dyd_sphere *sphere;
  dyd_pair_list pairs;
  unsigned epsg;
  const dyd_rect *window; /* what pictures show, in degrees; NULL: everything */
  double max_arc;         /* sides of cells are divided into arcs of so many degrees at most */
} dyd_sphere_result;

/* Writers that such arrays take from other files. */
dyd_writer dyd_layer_pairs, dyd_layer_points, dyd_layer_triangles, dyd_layer_graph;
dyd_writer dyd_layer_aliases, dyd_layer_ties;
dyd_writer dyd_layer_cells, dyd_layer_vertices, dyd_layer_regions, dyd_layer_edges;
dyd_writer dyd_voronoi_json, dyd_voronoi_vtk;
dyd_writer dyd_plan_rows;
dyd_writer dyd_layer_tolerance, dyd_layer_radii, dyd_layer_barcode, dyd_tolerance_json;
dyd_writer dyd_convergence_csv, dyd_convergence_json, dyd_check_csv, dyd_check_json;
dyd_writer dyd_disc_csv, dyd_disc_json, dyd_bisector_csv, dyd_bisector_json, dyd_nearest_csv, dyd_nearest_json;
dyd_writer dyd_sphere_layer_pairs, dyd_sphere_layer_points, dyd_sphere_layer_triangles, dyd_sphere_json;
dyd_writer dyd_sphere_layer_cells, dyd_sphere_layer_vertices, dyd_sphere_layer_regions, dyd_sphere_voronoi_json;
dyd_writer dyd_places_csv, dyd_places_json;

/* The end of a file: DYD_E_IO with a message unless everything went out. */
dyd_status dyd_output_end(FILE *out, dyd_error *err);

#endif
