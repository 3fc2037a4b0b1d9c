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
} dyd_output;

typedef dyd_status (*dyd_write_fn)(const dyd_output *o);
/* The writers of a format, by content; NULL: it cannot hold that. A format that has some is an array of these, in the
 * file that writes it, named dyd_NAME_writers. */
enum { DYD_CONTENTS = DYD_CONTENT_NEAREST + 1 };

/* `what` by content: dyd_result (result.h), dyd_diagram (diagram.h), dyd_stage_table, dyd_convergence,
 * dyd_check_report, dyd_disc_output, dyd_bisector_output, dyd_nearest_output. */
typedef struct dyd_stage_table {
  const dyd_convergence *stages;
  bool times;
} dyd_stage_table;

typedef struct dyd_disc_output {
  const dyd_partial_disc *disc; /* of r[0], r[1], r[2] */
  const dyd_rect *const *r;
  size_t n;
  dyd_outcome outcome;
} dyd_disc_output;

typedef struct dyd_bisector_output {
  const dyd_rect *r[2];
  const dyd_boundary *curve; /* of (r[0],r[1]) and (r[1],r[0]), sites named 0 and 1 in both */
  dyd_outcome outcome;
} dyd_bisector_output;

typedef struct dyd_nearest_output {
  const dyd_delaunay *pd;
  const dyd_nearest_answer *answer;
} dyd_nearest_output;

/* Writers of csv and json; their files say what they write. */
dyd_status dyd_voronoi_csv(const dyd_output *o);
dyd_status dyd_voronoi_json(const dyd_output *o);
dyd_status dyd_voronoi_wkt(const dyd_output *o);
dyd_status dyd_voronoi_geojson(const dyd_output *o);
dyd_status dyd_voronoi_vtk(const dyd_output *o);
dyd_status dyd_convergence_csv(const dyd_output *o);
dyd_status dyd_convergence_json(const dyd_output *o);
dyd_status dyd_check_csv(const dyd_output *o);
dyd_status dyd_check_json(const dyd_output *o);
dyd_status dyd_disc_csv(const dyd_output *o);
dyd_status dyd_disc_json(const dyd_output *o);
dyd_status dyd_bisector_csv(const dyd_output *o);
dyd_status dyd_bisector_json(const dyd_output *o);
dyd_status dyd_nearest_csv(const dyd_output *o);
dyd_status dyd_nearest_json(const dyd_output *o);

/* The end of a file: DYD_E_IO with a message unless everything went out. */
dyd_status dyd_output_end(FILE *out, dyd_error *err);

#endif
