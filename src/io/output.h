/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a writer is given, and the writers of a format; the result of a plane or of a sphere, and its words.
 *
 * The table of formats is a layer above, in src/format: it calls a writer, fills err where the writer did not, and sees
 * whether all was written. */
#ifndef DYD_IO_OUTPUT_H
#define DYD_IO_OUTPUT_H

#include "io/decimal.h"
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

/* `what` by content: dyd_diagram (diagram.h) of a Voronoi diagram of the plane and its layers; dyd_stage_table,
 * dyd_convergence, dyd_check_report, dyd_trials_output, dyd_disc_output, dyd_bisector_output, dyd_nearest_output; of
 * all others a dyd_result. */
typedef struct dyd_trials_output {
  const dyd_survey_trial *trial;
  size_t count;
  uint64_t seed;
} dyd_trials_output;

typedef struct dyd_stage_table {
  const dyd_convergence *stages;
  bool times;
  const struct dyd_result *result; /* with its history, for html; NULL: none */
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

/* All borrowed but pairs and graph. */
typedef struct dyd_result {
  FILE *out;
  const dyd_engine *engine; /* whose rows and identifiers name sites; on a sphere that of its places */
  const dyd_sphere *sphere; /* the sites are places of it; NULL: a plane */
  const dyd_delaunay *pd;   /* of the plane, or of the images of the sphere */
  const dyd_sites *sites;   /* of the plane */
  size_t count;             /* sites, aliases included */
  dyd_pair_list pairs;
  bool ties_apart; /* rows of pairs hold ties, which `pairs` does not */
  const char
      *graph_name;      /* the graph that is written instead of the triangulation; `pairs` are its edges; NULL: none */
  dyd_graph_list graph; /* its edges; owned, too */
  const dyd_rect *window;         /* what pictures show; NULL: everything */
  unsigned epsg;                  /* the reference system of the coordinates; 0: not known */
  double max_arc;                 /* longest arc, in degrees, of a side of a cell of a sphere */
  bool discs;                     /* pairs are those of discs */
  bool next;                      /* of a plan the first row only */
  const dyd_history *history;     /* ends with pairs; NULL: not known */
  const dyd_tolerance *tolerance; /* NULL: not known */
  const dyd_survey *survey;       /* the plan, where one is written */
  dyd_exterior exterior;          /* where it is written; owned, too */
} dyd_result;

/* Properties of a site. */
typedef struct dyd_site_row {
  size_t partners[4]; /* by dyd_pair_status; entry DYD_ILLEGAL is 0 */
  const char *hull;   /* is it a corner of the hull: "certain", "possible" (or on its boundary), "no" */
} dyd_site_row;

/* ---- a result of a plane or of a sphere ---- */

dyd_outcome dyd_result_outcome(const dyd_result *r);
/* The certain triangles. */
dyd_status dyd_result_triangles(dyd_triangle_list *out, const dyd_result *r);
/* How many pairs of each status there are. */
void dyd_result_count(size_t count[4], const dyd_result *r);
/* For every site; aliases have the row of their lowest site; on a sphere no point is on the hull. *out is released with
 * free().
 */
dyd_status dyd_result_sites(dyd_site_row **out, const dyd_result *r);
/* Where each place of a sphere may be, in degrees. Released with free(). */
dyd_status dyd_sphere_boxes(double (**out)[4], const dyd_sphere *s);

/* ---- of the plane ---- */

/* The box of site i; DYD_E_RANGE with a message that names the site when it is not finite in doubles. */
dyd_status dyd_result_box(double box[4], const dyd_result *r, size_t i, dyd_error *err);

/* ---- words and texts ---- */

/* "circle", "chain", "pair". */
const char *dyd_group_text(dyd_group_kind kind);
/* "adaptive", "uniform". */
const char *dyd_schedule_text(dyd_schedule schedule);
/* The rows of sites: "3, 7, 9". */
void dyd_put_rows(FILE *out, const dyd_engine *e, const dyd_index_list *list, const char *between);
/* The four ends of a window with dyadic ends, as exact texts, each between `quote`. */
dyd_status dyd_put_window(FILE *out, const dyd_rect *w, const char *quote, const char *between);

/* The number of edges and births without a row, since work was cancelled; births: SIZE_MAX: not searched. false: none
 * is missing. */
bool dyd_tolerance_is_cut(size_t *edges, size_t *births, const dyd_tolerance *t);

/* Goes over the rows that have a point in common with an earlier one, ascending: aliases of the triangulation, and rows
 * that were merged when they were read. Begin with e, and s where it is that of the places of a sphere. */
typedef struct dyd_alias_walk {
  const dyd_engine *e;
  const dyd_sphere *s; /* NULL: of a plane */
  size_t i, merged;    /* where to look on */
  size_t row, of;      /* the row found, and the earlier row; */
  size_t site;         /* of the latter */
} dyd_alias_walk;
/* false: there is no other one. */
bool dyd_alias_next(dyd_alias_walk *w);
/* "# alias 7 3" for each alias or merged row of the result of e, or of the places e of a sphere, a line each. */
void dyd_csv_aliases(FILE *out, const dyd_engine *e, const dyd_sphere *s);
/* What a picture calls a site: its identifier if it is short and printable, else the number, written to spare. */
enum { DYD_LABEL_SIZE = 24 };
const char *dyd_label_text(char spare[DYD_LABEL_SIZE], const dyd_engine *e, size_t site);

/* ---- the end ---- */

/* The end of a file: DYD_E_IO with a message unless everything went out. */
dyd_status dyd_output_end(FILE *out, dyd_error *err);

#endif
