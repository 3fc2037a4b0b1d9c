/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The layers of the Voronoi diagram: cells, vertices, regions, edges. */
#include "base/alloc.h"
#include "io/diagram.h"
#include "io/dual.h"
#include "io/parts.h"
#include "io/table.h"
#include <math.h>

static dyd_table_head diagram_head(const dyd_output *o, const char *const *column, dyd_geometry geometry) {
  const dyd_diagram *d = o->what;
  return (dyd_table_head){o->out, o->format, column, geometry, d->epsg, d->engine, NULL};
}

/* ---- comments of csv ---- */

static void put_bound(FILE *out, const char *name, const dyd_dyadic *bound) {
  fprintf(out, "# %s,", name);
  dyd_decimal_put(out, bound ? dyd_dyadic_get_d(bound, DYD_UP) : INFINITY, DYD_UP, "");
  fputs("\n", out);
}

/* In csv; the bounds are known. */
static dyd_status diagram_comments(const dyd_output *o) {
  const dyd_diagram *d = o->what;
  if (o->format != DYD_FORMAT_CSV) return DYD_OK;
  dyd_csv_aliases(o->out, d->engine);
  fputs("# window ", o->out);
  dyd_status st = dyd_put_window(o->out, &d->window, "", " ");
  fputs("\n", o->out);
  put_bound(o->out, "undetermined_area", &d->bounds->area);
  put_bound(o->out, "distance_to_true_diagram", d->bounds->finite ? &d->bounds->hausdorff : NULL);
  fputs("# rounding: lo down, hi and undetermined up, bounds up; empty: unbounded or beyond doubles; m*2^e is exact\n",
        o->out);
  return st;
}

static dyd_status keep_row(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  (void)shape;
  dyd_cell_row *rows = context;
  if (rows) rows[i] = *row;
  return DYD_OK;
}

/* Finds the bounds, and writes the comments. */
static dyd_status diagram_begin(const dyd_output *o) {
  dyd_status st = dyd_diagram_visit(o->what, keep_row, NULL);
  return st == DYD_OK ? diagram_comments(o) : st;
}

/* ---- cells ---- */

static void cell_values(dyd_table *t, size_t i, const dyd_cell_row *row) {
  dyd_row_site(t, i);
  dyd_row_id(t, i);
  dyd_row_box(t, row->box);
  dyd_row_decimal(t, row->area[0], DYD_DOWN);
  dyd_row_decimal(t, row->area[1], DYD_UP);
  dyd_row_decimal(t, dyd_cell_undetermined(row), DYD_UP);
  dyd_row_end(t);
}

static dyd_status cells_csv(const dyd_output *o) {
  static const char *const column[] = {"i",   "id",      "xlo",     "xhi",          "ylo",
                                       "yhi", "area_lo", "area_hi", "undetermined", NULL};
  const dyd_diagram *d = o->what;
  const dyd_table_head head = diagram_head(o, column, DYD_GEOMETRY_POLYGON);
  uint64_t bytes = dyd_bytes_times(d->count, sizeof(dyd_cell_row));
  dyd_cell_row *rows = NULL;
  if (dyd_room_has(d->room, bytes, "the rows of the cells")) rows = calloc(d->count ? d->count : 1, sizeof *rows);
  d->room->beside += bytes;
  dyd_table t;
  dyd_status st = rows ? dyd_diagram_visit(d, keep_row, rows) : DYD_E_NOMEM;
  if (st == DYD_OK) st = diagram_comments(o);
  if (st == DYD_OK) {
    dyd_table_begin(&t, &head);
    for (size_t i = 0; i < d->count; i++) {
      if (!rows[i].present) continue;
      dyd_row_begin(&t);
      cell_values(&t, i, &rows[i]);
    }
    dyd_table_end(&t);
  }
  free(rows);
  return st;
}

/* A row of wkt or geojson. */
static void cell_polygon(dyd_table *t, const char *kind, uint32_t i, const dyd_polygon *p, const dyd_cell_row *row) {
  if (p->count < 3) return;
  dyd_row_begin(t);
  for (size_t k = 0; k <= p->count; k++) {
    const dyd_point *z = &p->vertex[k % p->count];
    dyd_place place;
    dyd_place_set(&place, (const double[]){dyd_dyadic_get_d(&z->x, DYD_DOWN), dyd_dyadic_get_d(&z->x, DYD_UP),
                                           dyd_dyadic_get_d(&z->y, DYD_DOWN), dyd_dyadic_get_d(&z->y, DYD_UP)});
    if (row->rounding > 0) place.error = nextafter(place.error + row->rounding, INFINITY);
    dyd_row_place(t, &place);
  }
  dyd_row_text(t, kind);
  cell_values(t, i, row);
}

static dyd_status cell_polygons(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  dyd_table *t = context;
  dyd_polygon inner = {0};
  dyd_polygon_list outer = {0};
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK && !row->exact) st = dyd_shape_outer(&outer, shape);
  if (st == DYD_OK) cell_polygon(t, row->exact ? "exact" : "surely nearest", i, &inner, row);
  for (size_t k = 0; st == DYD_OK && k < outer.count; k++) cell_polygon(t, "possibly nearest", i, &outer.item[k], row);
  dyd_polygon_list_clear(&outer);
  dyd_polygon_clear(&inner);
  return st;
}

/* A line for each cell in csv; polygons in wkt and geojson. */
dyd_status dyd_layer_cells(const dyd_output *o) {
  static const char *const column[] = {"kind", "i",       "id",      "xlo",          "xhi", "ylo",
                                       "yhi",  "area_lo", "area_hi", "undetermined", NULL};
  const dyd_table_head head = diagram_head(o, column, DYD_GEOMETRY_POLYGON);
  dyd_table t;
  if (o->format == DYD_FORMAT_CSV) return cells_csv(o);
  dyd_table_begin(&t, &head);
  dyd_status st = dyd_diagram_visit(o->what, cell_polygons, &t);
  dyd_table_end(&t);
  return st;
}

/* ---- vertices ---- */

static dyd_status exact_vertex(dyd_table *t, const dyd_diagram *d, size_t k) {
  char *text[4];
  dyd_status st = dyd_diagram_vertex(text, d, k);
  for (int m = 0; m < 4; m++) {
    if (st == DYD_OK) dyd_row_text(t, text[m]);
    free(text[m]);
  }
  return st;
}

/* In csv: all sites of vertices that have more than three. */
static dyd_status tied_comments(const dyd_output *o) {
  const dyd_diagram *d = o->what;
  dyd_status st = DYD_OK;
  if (o->format != DYD_FORMAT_CSV) return st;
  for (size_t k = d->triangles.count; k < dyd_diagram_vertices(d) && st == DYD_OK; k++) {
    dyd_index_list sites = {0};
    st = dyd_diagram_vertex_sites(&sites, d, k);
    if (st == DYD_OK) fputs("# tie", o->out);
    for (size_t q = 0; q < sites.count; q++) fprintf(o->out, " %zu", dyd_engine_row(d->engine, sites.item[q]));
    if (st == DYD_OK) fputs("\n", o->out);
    dyd_index_list_clear(&sites);
  }
  return st;
}

/* The row of vertex k; of a tied one with its first three sites. */
static dyd_status row_vertex(dyd_table *t, const dyd_diagram *d, size_t k, const double box[4], bool exact) {
  dyd_index_list sites = {0};
  dyd_status st = dyd_diagram_vertex_sites(&sites, d, k);
  if (st != DYD_OK) return st;
  dyd_row_begin(t);
  dyd_row_at(t, box);
  for (int c = 0; c < 3; c++) dyd_row_site(t, sites.item[c]);
  if (exact)
    st = exact_vertex(t, d, k);
  else
    dyd_row_box(t, box);
  for (int c = 0; c < 3; c++) dyd_row_id(t, sites.item[c]);
  dyd_row_end(t);
  dyd_index_list_clear(&sites);
  return st;
}

/* wkt and geojson hold those that can be drawn and whose enclosure meets the window. Where a goal asks for more than
 * decimals of 17 digits show, the enclosures are exact numbers in csv. */
dyd_status dyd_layer_vertices(const dyd_output *o) {
  static const char *const column[] = {"i", "j", "k", "xlo", "xhi", "ylo", "yhi", "id_i", "id_j", "id_k", NULL};
  const dyd_diagram *d = o->what;
  const dyd_table_head head = diagram_head(o, column, DYD_GEOMETRY_POINT);
  bool csv = o->format == DYD_FORMAT_CSV;
  int64_t goal_bits;
  bool exact = csv && dyd_engine_goal(&goal_bits, d->engine) == DYD_GOAL_VORONOI_HAUSDORFF && goal_bits > 32;
  dyd_table t;
  dyd_status st = diagram_begin(o);
  if (st == DYD_OK) st = tied_comments(o);
  if (st == DYD_OK) dyd_table_begin(&t, &head);
  for (size_t k = 0; k < dyd_diagram_vertices(d) && st == DYD_OK; k++) {
    if (csv || dyd_diagram_vertex_in_window(d, k)) st = row_vertex(&t, d, k, d->vertex[k], exact);
  }
  if (st == DYD_OK) dyd_table_end(&t);
  return st;
}

/* ---- regions ---- */

typedef struct regions {
  dyd_table t;
  const dyd_diagram *d;
} regions;

static dyd_status layer_region(void *context, size_t face, const double box[4]) {
  regions *g = context;
  dyd_index_list sites = {0};
  bool outer;
  if (!box) return DYD_OK;
  dyd_status st = dyd_delaunay_face(&sites, &outer, g->d->pd, face);
  if (st == DYD_OK) {
    dyd_row_begin(&g->t);
    dyd_row_outline(&g->t, box);
    dyd_row_index(&g->t, face);
    dyd_row_box(&g->t, box);
    st = dyd_row_sites(&g->t, &sites);
    dyd_row_end(&g->t);
  }
  dyd_index_list_clear(&sites);
  return st;
}

dyd_status dyd_layer_regions(const dyd_output *o) {
  static const char *const column[] = {"face", "xlo", "xhi", "ylo", "yhi", "sites", NULL};
  const dyd_table_head head = diagram_head(o, column, DYD_GEOMETRY_POLYGON);
  regions g = {.d = o->what};
  dyd_status st = diagram_begin(o);
  if (st != DYD_OK) return st;
  dyd_table_begin(&g.t, &head);
  st = dyd_diagram_regions(g.d, layer_region, &g);
  dyd_table_end(&g.t);
  return st;
}

/* ---- edges ---- */

/* The corner of triangle t that is neither i nor j. */
static uint32_t third_corner(const dyd_triangle *t, uint32_t i, uint32_t j) {
  int k = 0;
  while (k < 2 && (t->v[k] == i || t->v[k] == j)) k++;
  return t->v[k];
}

/* The three sites that name the tied vertex in the layer of vertices. */
static dyd_status tied_value(dyd_table *t, const dyd_diagram *d, size_t vertex) {
  dyd_index_list sites = {0};
  dyd_status st = dyd_diagram_vertex_sites(&sites, d, vertex);
  if (st == DYD_OK && sites.count > 3) sites.count = 3;
  if (st == DYD_OK) st = dyd_row_sites(t, &sites);
  dyd_index_list_clear(&sites);
  return st;
}

/* The third corner of the sure triangle whose vertex the edge ends at, or what names a tied one; "ray", or "open": in
 * an undecided region. */
static dyd_status edge_value(dyd_table *t, const dyd_diagram *d, const dyd_dual_edge *e, int end) {
  const dyd_dual_end *to = &e->end[end];
  bool vertex = to->kind == DYD_DUAL_VERTEX;
  if (vertex && to->vertex >= d->triangles.count) return tied_value(t, d, to->vertex);
  char text[24] = "open";
  if (to->kind == DYD_DUAL_RAY) snprintf(text, sizeof text, "ray");
  if (vertex)
    snprintf(text, sizeof text, "%zu",
             dyd_engine_row(d->engine, third_corner(&d->triangles.item[to->vertex], e->i, e->j)));
  dyd_row_text(t, text);
  return DYD_OK;
}

/* csv lists all; wkt and geojson those with two ends that can be drawn. */
dyd_status dyd_layer_edges(const dyd_output *o) {
  static const char *const column[] = {"i", "j", "left", "right", "id_i", "id_j", NULL};
  const dyd_diagram *d = o->what;
  const dyd_table_head head = diagram_head(o, column, DYD_GEOMETRY_LINE);
  dyd_dual_edge *edge = NULL;
  size_t count = 0;
  dyd_table t;
  dyd_status st = diagram_begin(o);
  if (st == DYD_OK) st = dyd_dual_edges(&edge, &count, d->pd, &d->triangles, d->tied, d->ties, d->room);
  if (st != DYD_OK) return st;
  dyd_table_begin(&t, &head);
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    double box[2][4];
    bool drawn = dyd_diagram_edge(box, d, &edge[k]);
    if (!drawn && o->format != DYD_FORMAT_CSV) continue;
    dyd_row_begin(&t);
    for (int end = 0; drawn && end < 2; end++) dyd_row_at(&t, box[end]);
    dyd_row_site(&t, edge[k].i);
    dyd_row_site(&t, edge[k].j);
    for (int end = 0; end < 2 && st == DYD_OK; end++) st = edge_value(&t, d, &edge[k], end);
    dyd_row_id(&t, edge[k].i);
    dyd_row_id(&t, edge[k].j);
    dyd_row_end(&t);
  }
  dyd_table_end(&t);
  free(edge);
  return st;
}
