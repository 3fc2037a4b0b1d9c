/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the writers share: the result to be written, of a plane or of a sphere. */
#ifndef DYD_IO_RESULT_H
#define DYD_IO_RESULT_H

#include "io/decimal.h"
#include "io/output.h"

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

#endif
