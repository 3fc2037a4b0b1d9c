/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Formats for geographic and mesh programs: wkt, geojson, obj. One place per site stands for its rectangle; each
 * format says how far at most the rectangle reaches from it. */
#include "io/label_text.h"
#include "io/result.h"
#include "io/sink.h"
#include <stdlib.h>

static void obj_elements(const dyd_result *r, const dyd_triangle_list *triangles) {
  dyd_sink s;
  dyd_sink_begin(&s, r->out);
  dyd_sink_text(&s, "g legal_edges\n");
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    const uint32_t ends[2] = {p->i, p->j};
    if (p->status == DYD_LEGAL) dyd_sink_line(&s, "l", ends, 2, 1);
  }
  dyd_sink_text(&s, "g sure_triangles\n");
  for (size_t k = 0; k < triangles->count; k++) dyd_sink_line(&s, "f", triangles->item[k].v, 3, 1);
  dyd_sink_flush(&s);
}

/* What the next vertex is called, where its place in the file does not tell. */
static void obj_name(const dyd_result *r, uint32_t i) {
  const char *id = dyd_engine_id(r->engine, i);
  if (!id && dyd_engine_row(r->engine, i) == i) return;
  fprintf(r->out, "# row %zu", dyd_engine_row(r->engine, i));
  dyd_json_ids(r->out, r->engine, &i, 0);
  fputs("\n", r->out);
}

/* what: "point of the rectangle". */
static void obj_head(FILE *out, dyd_outcome outcome, const char *what, const char *bound, const size_t count[4]) {
  fprintf(out,
          "# dyadel %s, outcome %s\n# a coordinate differs from every %s it stands for by at most %s\n# not shown: %zu "
          "indeterminate pairs, %zu ties\n",
          dyd_version(), dyd_outcome_text(outcome), what, bound, count[DYD_INDETERMINATE], count[DYD_TIE]);
}

static dyd_status obj_delaunay(const dyd_output *o) {
  const dyd_result *r = o->what;
  dyd_place *place = NULL;
  dyd_triangle_list triangles = {0};
  char bound[DYD_DECIMAL_SIZE];
  size_t count[4];
  dyd_status st = dyd_result_places(&place, bound, r, o->err);
  if (st == DYD_OK) st = dyd_delaunay_triangles(&triangles, r->pd);
  if (st == DYD_OK) {
    dyd_delaunay_count(count, r->pd);
    obj_head(r->out, dyd_engine_outcome(r->engine), "point of the rectangle", bound, count);
    for (uint32_t i = 0; i < r->count; i++) {
      obj_name(r, i);
      fprintf(r->out, "v %s %s 0\n", place[i].x, place[i].y);
    }
    obj_elements(r, &triangles);
  }
  dyd_triangle_list_clear(&triangles);
  free(place);
  return st;
}

/* On the sphere of radius 1. */
static dyd_status obj_sphere(const dyd_output *o) {
  const dyd_sphere *s = ((const dyd_sphere_result *)o->what)->sphere;
  const dyd_result mesh = dyd_sphere_mesh(o);
  dyd_vector_text *v = NULL;
  dyd_triangle_list triangles = {0};
  char bound[DYD_DECIMAL_SIZE];
  size_t count[4] = {0};
  for (size_t k = 0; k < mesh.pairs.count; k++) count[mesh.pairs.item[k].status]++;
  dyd_status st = dyd_sphere_vectors(&v, bound, o->what, o->err);
  if (st == DYD_OK) st = dyd_sphere_triangles(&triangles, s);
  if (st == DYD_OK) {
    obj_head(o->out, dyd_sphere_outcome(s), "place on the sphere of radius 1 that", bound, count);
    for (uint32_t i = 0; i < mesh.count; i++) {
      obj_name(&mesh, i);
      fprintf(o->out, "v %s %s %s\n", v[i].at[0], v[i].at[1], v[i].at[2]);
    }
    obj_elements(&mesh, &triangles);
  }
  dyd_triangle_list_clear(&triangles);
  free(v);
  return st;
}

#define LAYERS                                                                                                         \
  {                                                                                                                    \
    [DYD_CONTENT_DELAUNAY] = dyd_layer_pairs, [DYD_CONTENT_POINTS] = dyd_layer_points,                                 \
    [DYD_CONTENT_ALIASES] = dyd_layer_aliases, [DYD_CONTENT_VORONOI_ALIASES] = dyd_layer_aliases,                      \
    [DYD_CONTENT_TRIANGLES] = dyd_layer_triangles, [DYD_CONTENT_VORONOI] = dyd_layer_cells,                            \
    [DYD_CONTENT_VERTICES] = dyd_layer_vertices, [DYD_CONTENT_REGIONS] = dyd_layer_regions,                            \
    [DYD_CONTENT_EDGES] = dyd_layer_edges, [DYD_CONTENT_TOLERANCE] = dyd_layer_tolerance,                              \
    [DYD_CONTENT_RADII] = dyd_layer_radii, [DYD_CONTENT_PLAN] = dyd_plan_rows,                                         \
    [DYD_CONTENT_GRAPH_NEAREST] = dyd_layer_graph, [DYD_CONTENT_GRAPH_GABRIEL] = dyd_layer_graph,                      \
    [DYD_CONTENT_GRAPH_MST] = dyd_layer_graph, [DYD_CONTENT_SPHERE] = dyd_sphere_layer_pairs,                          \
    [DYD_CONTENT_SPHERE_POINTS] = dyd_sphere_layer_points,                                                             \
    [DYD_CONTENT_SPHERE_TRIANGLES] = dyd_sphere_layer_triangles,                                                       \
    [DYD_CONTENT_SPHERE_VORONOI] = dyd_sphere_layer_cells, [DYD_CONTENT_SPHERE_VERTICES] = dyd_sphere_layer_vertices   \
  }
dyd_writer *const dyd_wkt_writers[DYD_CONTENTS] = LAYERS;
dyd_writer *const dyd_geojson_writers[DYD_CONTENTS] = LAYERS;
dyd_writer *const dyd_obj_writers[DYD_CONTENTS] = {
    [DYD_CONTENT_DELAUNAY] = obj_delaunay, [DYD_CONTENT_SPHERE] = obj_sphere};
