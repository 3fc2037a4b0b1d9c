/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the writers share: the result to be written and the places where sites are drawn. */
#ifndef DYD_IO_RESULT_H
#define DYD_IO_RESULT_H

#include "io/output.h"
#include "io/place.h"

/* All borrowed but pairs and graph. */
typedef struct dyd_result {
  FILE *out;
  const dyd_engine *engine;
  const dyd_delaunay *pd;
  const dyd_sites *sites;
  size_t count; /* sites, aliases included */
  dyd_pair_list pairs;
  bool ties_apart;        /* rows of pairs hold ties, which `pairs` does not */
  const char *graph_name; /* what is written in place of the triangulation, whose edges `pairs` are; NULL: nothing */
  dyd_graph_list graph;   /* its edges; owned, too */
  const dyd_rect *window; /* what pictures show; NULL: everything */
  unsigned epsg;          /* the reference system of the coordinates; 0: not known */
  bool discs;             /* pairs are those of discs */
  const dyd_history *history;     /* ends with pairs; NULL: not known */
  const dyd_tolerance *tolerance; /* NULL: not known */
} dyd_result;

/* What is known of a site. */
typedef struct dyd_site_row {
  size_t partners[4]; /* by dyd_pair_status; entry DYD_ILLEGAL is 0 */
  const char *hull;   /* is it a corner of the hull: "surely", "possibly" (or on its boundary), "not" */
} dyd_site_row;

/* The coordinates of a vector in space, rounded. */
typedef struct dyd_vector_text {
  char at[3][DYD_DECIMAL_SIZE];
} dyd_vector_text;

/* "legal", "indeterminate", "tie", "illegal". */
const char *dyd_pair_status_text(dyd_pair_status status);
/* "circle", "chain", "pair". */
const char *dyd_group_text(dyd_group_kind kind);
/* The box of site i; DYD_E_RANGE with a message that names the site when it is not finite in doubles. */
dyd_status dyd_result_box(double box[4], const dyd_result *r, size_t i, dyd_error *err);
/* The places of all sites; *out is released with free(). `bound` is the largest error among them, two digits rounded
 * up. */
dyd_status dyd_result_places(dyd_place **out, char bound[DYD_DECIMAL_SIZE], const dyd_result *r, dyd_error *err);

/* Of every site; aliases as the site they stand for. *out is released with free(). */
dyd_status dyd_result_sites(dyd_site_row **out, const dyd_result *r);

/* Of every place of a sphere, on which no point is on the hull; and its vector. Released with free(); bound as above.
 */
dyd_status dyd_sphere_sites(dyd_site_row **out, const dyd_sphere_result *r);
dyd_status dyd_sphere_vectors(dyd_vector_text **out, char bound[DYD_DECIMAL_SIZE], const dyd_sphere_result *r,
                              dyd_error *err);
/* Where each place may be, in degrees. Released with free(). */
typedef struct dyd_degree_box {
  double end[4];
} dyd_degree_box;
dyd_status dyd_sphere_boxes(dyd_degree_box **out, const dyd_sphere *s);
/* What meshes take from it: pairs, borrowed, and the engine of places. */
dyd_result dyd_sphere_mesh(const dyd_output *o);

/* "NAME": [{"i": .., "j": .., "status": ..}, ..]; "triangles": [[i, j, k], ..]; "counters": {..}: numbers are rows. */
void dyd_json_pairs(FILE *out, const dyd_engine *e, const char *name, const dyd_pair_list *pairs);
void dyd_json_triangles(FILE *out, const dyd_engine *e, const dyd_triangle_list *list);
void dyd_json_counters(FILE *out, const dyd_engine *e);

/* The rows of sites: "3, 7, 9". */
void dyd_put_rows(FILE *out, const dyd_engine *e, const dyd_index_list *list, const char *between);
/* The sites of each undecided face, behind `first` or `next`, before `end`. */
dyd_status dyd_result_faces(const dyd_result *r, const char *first, const char *next, const char *between,
                            const char *end);

#endif
