/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The vtk format of the Voronoi diagram: legacy polygon data, each line and polygon with its site and kind. */
#include "base/alloc.h"
#include "io/diagram.h"
#include "io/dual.h"

/* What a line or polygon is; the numbers are those in the file. */
typedef enum figure_kind { FIGURE_INNER, FIGURE_OUTER, FIGURE_VERTEX, FIGURE_REGION, FIGURE_EDGE } figure_kind;

/* Its corners are at[first .. first + count - 1]. */
typedef struct figure {
  figure_kind kind;
  uint32_t site; /* of an edge, vertex, region: the lowest of its sites */
  size_t first, count;
} figure;

/* All that is written, gathered before the sections are. */
typedef struct gathered {
  const dyd_diagram *d;
  double (*at)[2];
  figure *item;
  size_t points, points_cap, count, cap;
} gathered;

/* With what reserving takes while it copies. */
static bool figures_have_room(const gathered *g, size_t corners) {
  uint64_t points = dyd_bytes_times(g->points + corners, 5 * sizeof *g->at / 2);
  uint64_t items = dyd_bytes_times(g->count + 1, 5 * sizeof *g->item / 2);
  return dyd_room_has(g->d->room, dyd_bytes_add(points, items), "the figures of the diagram");
}

static dyd_status gather_figure(gathered *g, figure_kind kind, uint32_t site, size_t corners) {
  if (!figures_have_room(g, corners)) return DYD_E_NOMEM;
  if (!dyd_reserve((void **)&g->item, &g->cap, g->count + 1, sizeof *g->item) ||
      !dyd_reserve((void **)&g->at, &g->points_cap, g->points + corners, sizeof *g->at))
    return DYD_E_NOMEM;
  g->item[g->count++] = (figure){kind, site, g->points, corners};
  g->points += corners;
  return DYD_OK;
}

static dyd_status gather_polygon(gathered *g, const dyd_polygon *p, uint32_t site, figure_kind kind) {
  if (p->count < 3) return DYD_OK;
  dyd_status st = gather_figure(g, kind, site, p->count);
  double(*at)[2] = st == DYD_OK ? g->at + g->points - p->count : NULL;
  for (size_t v = 0; st == DYD_OK && v < p->count; v++) {
    at[v][0] = dyd_dyadic_get_d(&p->vertex[v].x, DYD_DOWN);
    at[v][1] = dyd_dyadic_get_d(&p->vertex[v].y, DYD_DOWN);
  }
  return st;
}

static dyd_status gather_cell(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  (void)row;
  gathered *g = context;
  dyd_polygon inner = {0};
  dyd_polygon_list outer = {0};
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK) st = gather_polygon(g, &inner, i, FIGURE_INNER);
  if (st == DYD_OK) st = dyd_shape_outer(&outer, shape);
  for (size_t k = 0; k < outer.count && st == DYD_OK; k++) st = gather_polygon(g, &outer.item[k], i, FIGURE_OUTER);
  dyd_polygon_list_clear(&outer);
  dyd_polygon_clear(&inner);
  return st;
}

static dyd_status gather_box(gathered *g, figure_kind kind, uint32_t site, const double b[4]) {
  if (!dyd_box_is_finite(b)) return DYD_OK;
  dyd_status st = gather_figure(g, kind, site, 4);
  for (int c = 0; st == DYD_OK && c < 4; c++) {
    double *at = g->at[g->points - 4 + (size_t)c];
    at[0] = b[c == 1 || c == 2];
    at[1] = b[c < 2 ? 2 : 3];
  }
  return st;
}

static dyd_status gather_region(void *context, size_t face, const double box[4]) {
  gathered *g = context;
  dyd_index_list sites = {0};
  bool outer;
  if (!box) return DYD_OK;
  dyd_status st = dyd_delaunay_face(&sites, &outer, g->d->pd, face);
  if (st == DYD_OK) st = gather_box(g, FIGURE_REGION, sites.count ? sites.item[0] : 0, box);
  dyd_index_list_clear(&sites);
  return st;
}

static dyd_status gather_edges(gathered *g) {
  dyd_dual_edge *edge = NULL;
  size_t count = 0;
  dyd_status st = dyd_dual_edges(&edge, &count, g->d->pd, &g->d->triangles, g->d->tied, g->d->ties, g->d->room);
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    double box[2][4];
    if (!dyd_diagram_edge(box, g->d, &edge[k])) continue;
    st = gather_figure(g, FIGURE_EDGE, edge[k].i, 2);
    for (int c = 0; st == DYD_OK && c < 4; c++)
      g->at[g->points - 2 + (size_t)(c >> 1)][c & 1] = box[c >> 1][2 * (c & 1)] / 2 + box[c >> 1][2 * (c & 1) + 1] / 2;
  }
  free(edge);
  return st;
}

static dyd_status gather_all(gathered *g) {
  const dyd_diagram *d = g->d;
  dyd_status st = dyd_diagram_visit(d, gather_cell, g);
  for (size_t k = 0; k < dyd_diagram_vertices(d) && st == DYD_OK; k++) {
    dyd_index_list sites = {0};
    st = dyd_diagram_vertex_sites(&sites, d, k);
    if (st == DYD_OK) st = gather_box(g, FIGURE_VERTEX, sites.item[0], d->vertex[k]);
    dyd_index_list_clear(&sites);
  }
  if (st == DYD_OK) st = dyd_diagram_regions(d, gather_region, g);
  return st == DYD_OK ? gather_edges(g) : st;
}

/* A section of those that are edges, or that are not. */
static void vtk_figures(const gathered *g, const char *name, bool edges) {
  FILE *out = g->d->out;
  size_t count = 0, size = 0;
  for (size_t k = 0; k < g->count; k++)
    if ((g->item[k].kind == FIGURE_EDGE) == edges) count++, size += g->item[k].count + 1;
  if (count == 0 && edges) return;
  fprintf(out, "%s %zu %zu\n", name, count, size);
  for (size_t k = 0; k < g->count; k++) {
    const figure *f = &g->item[k];
    if ((f->kind == FIGURE_EDGE) != edges) continue;
    fprintf(out, "%zu", f->count);
    for (size_t v = 0; v < f->count; v++) fprintf(out, " %zu", f->first + v);
    fputs("\n", out);
  }
}

/* One number of each, lines first, as readers number them. */
static void vtk_numbers(const gathered *g, const char *name, bool kind) {
  FILE *out = g->d->out;
  fprintf(out, "SCALARS %s int 1\nLOOKUP_TABLE default\n", name);
  for (int edges = 1; edges >= 0; edges--)
    for (size_t k = 0; k < g->count; k++)
      if ((g->item[k].kind == FIGURE_EDGE) == edges)
        fprintf(out, "%zu\n", kind ? (size_t)g->item[k].kind : dyd_engine_row(g->d->engine, g->item[k].site));
}

dyd_status dyd_voronoi_vtk(const dyd_output *o) {
  gathered g = {.d = o->what};
  dyd_status st = gather_all(&g);
  if (st == DYD_OK) {
    fprintf(o->out,
            "# vtk DataFile Version 3.0\n"
            "dyadel voronoi, outcome %s; kind 0 surely nearest, 1 possibly nearest, 2 box of a vertex, 3 undecided "
            "region, 4 edge; coordinates within 2^-52 of themselves\nASCII\nDATASET POLYDATA\nPOINTS %zu double\n",
            dyd_outcome_text(dyd_engine_outcome(g.d->engine)), g.points);
    for (size_t k = 0; k < g.points; k++) {
      dyd_decimal_put_near(o->out, g.at[k][0]);
      fputs(" ", o->out);
      dyd_decimal_put_near(o->out, g.at[k][1]);
      fputs(" 0\n", o->out);
    }
    vtk_figures(&g, "LINES", true);
    vtk_figures(&g, "POLYGONS", false);
    fprintf(o->out, "CELL_DATA %zu\n", g.count);
    vtk_numbers(&g, "site", false);
    vtk_numbers(&g, "kind", true);
  }
  free(g.at);
  free(g.item);
  return st;
}
