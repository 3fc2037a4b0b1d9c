/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The vtk format of the triangulation: legacy polygon data, edges with their status, sure triangles, points with
 * their partners. */
#include "io/result.h"
#include "io/sink.h"
#include <stdlib.h>

static void vtk_number(dyd_sink *s, size_t n) {
  dyd_sink_index(s, n);
  dyd_sink_put(s, "\n", 1);
}

static void vtk_elements(const dyd_result *r, const dyd_triangle_list *triangles) {
  const size_t pairs = r->pairs.count, all = pairs + triangles->count;
  dyd_sink s;
  fprintf(r->out, "LINES %zu %zu\n", pairs, 3 * pairs);
  dyd_sink_begin(&s, r->out);
  for (size_t k = 0; k < pairs; k++) {
    const uint32_t ends[2] = {r->pairs.item[k].i, r->pairs.item[k].j};
    dyd_sink_line(&s, "2", ends, 2, 0);
  }
  dyd_sink_flush(&s);
  fprintf(r->out, "POLYGONS %zu %zu\n", triangles->count, 4 * triangles->count);
  for (size_t k = 0; k < triangles->count; k++) dyd_sink_line(&s, "3", triangles->item[k].v, 3, 0);
  dyd_sink_flush(&s);
  fprintf(r->out, "CELL_DATA %zu\nSCALARS status int 1\nLOOKUP_TABLE default\n", all);
  for (size_t k = 0; k < all; k++) vtk_number(&s, k < pairs ? r->pairs.item[k].status : DYD_LEGAL);
  dyd_sink_flush(&s);
}

/* Of each point: how many partners by status, and the hull. */
static void vtk_points(const dyd_result *r, const dyd_site_row *rows) {
  static const dyd_pair_status statuses[] = {DYD_LEGAL, DYD_INDETERMINATE, DYD_TIE};
  dyd_sink to;
  fprintf(r->out, "POINT_DATA %zu\n", r->count);
  dyd_sink_begin(&to, r->out);
  for (int s = 0; s < 3; s++) {
    fprintf(r->out, "SCALARS %s int 1\nLOOKUP_TABLE default\n", dyd_pair_status_text(statuses[s]));
    for (size_t i = 0; i < r->count; i++) vtk_number(&to, rows[i].partners[statuses[s]]);
    dyd_sink_flush(&to);
  }
  dyd_sink_text(&to, "SCALARS hull int 1\nLOOKUP_TABLE default\n");
  for (size_t i = 0; i < r->count; i++) vtk_number(&to, *rows[i].hull == 's' ? 2 : *rows[i].hull == 'p');
  dyd_sink_flush(&to);
}

/* vtk decodes %HH in texts, which end with the line. */
static void vtk_text(FILE *out, const char *text) {
  for (; *text; text++) {
    unsigned char c = (unsigned char)*text;
    if (c <= ' ' || c == '%' || c == '"' || c > '~')
      fprintf(out, "%%%02X", c);
    else
      fputc(c, out);
  }
  fputc('\n', out);
}

/* Rows and identifiers of the points, where their places in the file do not tell. */
static void vtk_names(const dyd_result *r) {
  bool rows = r->count && dyd_engine_row(r->engine, r->count - 1) != r->count - 1, ids = dyd_engine_id(r->engine, 0);
  if (!rows && !ids) return;
  fprintf(r->out, "FIELD names %d\nrow 1 %zu long\n", 1 + ids, r->count);
  for (size_t i = 0; i < r->count; i++) fprintf(r->out, "%zu\n", dyd_engine_row(r->engine, i));
  if (ids) fprintf(r->out, "id 1 %zu string\n", r->count);
  for (size_t i = 0; ids && i < r->count; i++) vtk_text(r->out, dyd_engine_id(r->engine, i));
}

static dyd_status vtk_delaunay(const dyd_output *o) {
  const dyd_result *r = o->what;
  dyd_place *place = NULL;
  dyd_site_row *rows = NULL;
  dyd_triangle_list triangles = {0};
  char bound[DYD_DECIMAL_SIZE];
  dyd_status st = dyd_result_places(&place, bound, r, o->err);
  if (st == DYD_OK) st = dyd_result_sites(&rows, r);
  if (st == DYD_OK) st = dyd_delaunay_triangles(&triangles, r->pd);
  if (st == DYD_OK) {
    fprintf(r->out,
            "# vtk DataFile Version 3.0\ndyadel delaunay, outcome %s; status 1 tie, 2 indeterminate, 3 legal; "
            "hull 1 possibly, 2 surely; coordinates within %s of their rectangles\nASCII\nDATASET POLYDATA\nPOINTS %zu "
            "double\n",
            dyd_outcome_text(dyd_engine_outcome(r->engine)), bound, r->count);
    for (size_t i = 0; i < r->count; i++) fprintf(r->out, "%s %s 0\n", place[i].x, place[i].y);
    vtk_elements(r, &triangles);
    vtk_points(r, rows);
    vtk_names(r);
  }
  free(rows);
  dyd_triangle_list_clear(&triangles);
  free(place);
  return st;
}

/* On the sphere of radius 1. */
static dyd_status vtk_sphere(const dyd_output *o) {
  const dyd_sphere *s = ((const dyd_sphere_result *)o->what)->sphere;
  const dyd_result mesh = dyd_sphere_mesh(o);
  dyd_vector_text *v = NULL;
  dyd_site_row *rows = NULL;
  dyd_triangle_list triangles = {0};
  char bound[DYD_DECIMAL_SIZE];
  dyd_status st = dyd_sphere_vectors(&v, bound, o->what, o->err);
  if (st == DYD_OK) st = dyd_sphere_sites(&rows, o->what);
  if (st == DYD_OK) st = dyd_sphere_triangles(&triangles, s);
  if (st == DYD_OK) {
    fprintf(
        o->out,
        "# vtk DataFile Version 3.0\ndyadel delaunay, sphere of radius 1, outcome %s; status 1 tie, 2 indeterminate, "
        "3 legal; coordinates within %s of their places\nASCII\nDATASET POLYDATA\nPOINTS %zu double\n",
        dyd_outcome_text(dyd_sphere_outcome(s)), bound, mesh.count);
    for (size_t i = 0; i < mesh.count; i++) fprintf(o->out, "%s %s %s\n", v[i].at[0], v[i].at[1], v[i].at[2]);
    vtk_elements(&mesh, &triangles);
    vtk_points(&mesh, rows);
    vtk_names(&mesh);
  }
  free(rows);
  dyd_triangle_list_clear(&triangles);
  free(v);
  return st;
}

dyd_writer *const dyd_vtk_writers[DYD_CONTENTS] = {
    [DYD_CONTENT_DELAUNAY] = vtk_delaunay, [DYD_CONTENT_VORONOI] = dyd_voronoi_vtk, [DYD_CONTENT_SPHERE] = vtk_sphere};
