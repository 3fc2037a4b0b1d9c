/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The vtk format of the Voronoi diagram: legacy polygon data, each polygon with its site and kind. */
#include "base/alloc.h"
#include "io/diagram.h"

/* Polygons gathered before the sections are written. */
typedef struct gathered {
  dyd_polygon *polygon;
  uint32_t *site;
  uint8_t *kind; /* 0 surely nearest, 1 possibly nearest */
  size_t count, polygon_cap, site_cap, kind_cap, points;
} gathered;

/* Takes over *p. */
static dyd_status gather_polygon(gathered *g, dyd_polygon *p, uint32_t site, uint8_t kind) {
  if (p->count < 3) return DYD_OK;
  if (!dyd_reserve((void **)&g->polygon, &g->polygon_cap, g->count + 1, sizeof *g->polygon) ||
      !dyd_reserve((void **)&g->site, &g->site_cap, g->count + 1, sizeof *g->site) ||
      !dyd_reserve((void **)&g->kind, &g->kind_cap, g->count + 1, sizeof *g->kind))
    return DYD_E_NOMEM;
  g->polygon[g->count] = *p;
  g->site[g->count] = site;
  g->kind[g->count++] = kind;
  g->points += p->count;
  *p = (dyd_polygon){0};
  return DYD_OK;
}

static dyd_status gather_cell(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  (void)row;
  gathered *g = context;
  dyd_polygon inner = {0};
  dyd_polygon_list outer = {0};
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK) st = gather_polygon(g, &inner, i, 0);
  if (st == DYD_OK) st = dyd_shape_outer(&outer, shape);
  for (size_t k = 0; k < outer.count && st == DYD_OK; k++) st = gather_polygon(g, &outer.item[k], i, 1);
  dyd_polygon_list_clear(&outer);
  dyd_polygon_clear(&inner);
  return st;
}

static void vtk_polygons(const dyd_diagram *d, const gathered *g) {
  FILE *out = d->out;
  fprintf(out,
          "# vtk DataFile Version 3.0\n"
          "dyadel voronoi, outcome %s; coordinates to the nearest double, within 2^-52 of themselves\n"
          "ASCII\nDATASET POLYDATA\nPOINTS %zu double\n",
          dyd_outcome_text(dyd_engine_outcome(d->engine)), g->points);
  for (size_t k = 0; k < g->count; k++)
    for (size_t v = 0; v < g->polygon[k].count; v++) {
      dyd_decimal_put_near(out, dyd_dyadic_get_d(&g->polygon[k].vertex[v].x, DYD_DOWN));
      fputs(" ", out);
      dyd_decimal_put_near(out, dyd_dyadic_get_d(&g->polygon[k].vertex[v].y, DYD_DOWN));
      fputs(" 0\n", out);
    }
  fprintf(out, "POLYGONS %zu %zu\n", g->count, g->count + g->points);
  for (size_t k = 0, at = 0; k < g->count; k++) {
    fprintf(out, "%zu", g->polygon[k].count);
    for (size_t v = 0; v < g->polygon[k].count; v++) fprintf(out, " %zu", at++);
    fputs("\n", out);
  }
  fprintf(out, "CELL_DATA %zu\nSCALARS site int 1\nLOOKUP_TABLE default\n", g->count);
  for (size_t k = 0; k < g->count; k++) fprintf(out, "%zu\n", dyd_engine_row(d->engine, g->site[k]));
  fputs("SCALARS possibly int 1\nLOOKUP_TABLE default\n", out);
  for (size_t k = 0; k < g->count; k++) fprintf(out, "%u\n", (unsigned)g->kind[k]);
}

dyd_status dyd_voronoi_vtk(const dyd_output *o) {
  const dyd_diagram *d = o->what;
  gathered g = {0};
  dyd_status st = dyd_diagram_visit(d, gather_cell, &g);
  if (st == DYD_OK) vtk_polygons(d, &g);
  for (size_t k = 0; k < g.count; k++) dyd_polygon_clear(&g.polygon[k]);
  free(g.polygon);
  free(g.site);
  free(g.kind);
  return st;
}
