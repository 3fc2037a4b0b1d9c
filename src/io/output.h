/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a writer is given, and the writers of a format.
 *
 * The table of formats is a layer above, in src/format: it calls a writer, fills err where the writer did not, and sees
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
  dyd_content content;      /* for writers of several */
  const dyd_engine *engine; /* whose rows and identifiers name sites; NULL: their numbers do */
  const dyd_sphere *sphere; /* coordinates are degrees on it; NULL: a plane */
  unsigned epsg;            /* the reference system of the coordinates; 0: none is claimed */
  FILE *comments;           /* of csv; NULL: none are written */
  bool lengths, clip;       /* as in dyd_write_options */
  const char *name;
  dyd_write_style style;
} dyd_output;

typedef dyd_status dyd_writer(const dyd_output *o);
/* The writers of a format are an array by content, NULL where it cannot hold that: dyd_NAME_writers, in the file that
 * writes it. Layers have none, they are rows (table.h). */
enum { DYD_CONTENTS = DYD_CONTENT_TRIALS + 1 };

/* `what` by content: dyd_diagram (diagram.h) of a Voronoi diagram of the plane and its layers; dyd_stage_table,
 * dyd_convergence, dyd_check_report, dyd_trials_output, dyd_disc_output, dyd_bisector_output, dyd_nearest_output; of
 * all others a dyd_result (result.h). */
typedef struct dyd_trials_output {
  const dyd_survey_trial *trial;
  size_t count;
  uint64_t seed;
} dyd_trials_output;

typedef struct dyd_stage_table {
  const dyd_convergence *stages;
  bool times;
  const struct dyd_result *result; /* with its history (result.h), for html; NULL: none */
  const char *label;               /* well-formed, or NULL */
  bool no_header;
  bool modulus; /* for each m from .. to, as dyd_write_options says */
  int64_t from, to;
} dyd_stage_table;
/* Is it a column of such a table? */
bool dyd_is_stage_column(const char *name, size_t length);

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
  size_t count;             /* of places */
  dyd_outcome outcome;      /* of all */
  const dyd_sphere *sphere; /* NULL: of the plane */
} dyd_nearest_output;
/* Returns true if the places have identifiers. */
bool dyd_nearest_named(const dyd_nearest_output *n);

/* Writers that such arrays take from other files. */
dyd_writer dyd_convergence_json, dyd_check_json, dyd_disc_json, dyd_bisector_json, dyd_nearest_json;

/* The end of a file: DYD_E_IO with a message unless everything went out. */
dyd_status dyd_output_end(FILE *out, dyd_error *err);

#endif
