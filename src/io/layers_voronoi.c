/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The layers of Voronoi diagrams: cells, vertices, regions, edges of the plane; cells as cyclic lists of vertices,
 * vertices in boxes of degrees, and undecided regions by their sites, of a sphere. */
#include "base/alloc.h"
#include "base/local.h"
#include "io/diagram.h"
#include "io/geodesic.h"
#include "io/table.h"
#include <float.h>
#include <inttypes.h>
#include <math.h>

/* ---- comments of csv ---- */

static void put_bound(FILE *out, const char *name, const dyd_dyadic *bound) {
  fprintf(out, "# %s,", name);
  dyd_decimal_put(out, bound ? dyd_dyadic_get_d(bound, DYD_UP) : INFINITY, DYD_UP, "");
  fputs("\n", out);
}

/* The bounds are known. */
static dyd_status put_bounds(const dyd_output *o) {
  const dyd_diagram *d = o->what;
  dyd_csv_aliases(o->out, d->engine, NULL);
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

dyd_status dyd_diagram_comments(dyd_table *t, const dyd_output *o) {
  (void)t;
  dyd_status st = dyd_diagram_visit(o->what, keep_row, NULL);
  return st == DYD_OK ? put_bounds(o) : st;
}

/* Formats without comments find the bounds as well, since the caller receives them. */
static dyd_status find_bounds(const dyd_table *t, const dyd_diagram *d) {
  return t->drawn ? dyd_diagram_visit(d, keep_row, NULL) : DYD_OK;
}

/* ---- cells ---- */

static void cell_values(dyd_table *t, size_t i, const dyd_cell_row *row) {
  dyd_row_own(t, i);
  dyd_row_box(t, row->box);
  dyd_row_decimal(t, row->area[0], DYD_DOWN);
  dyd_row_decimal(t, row->area[1], DYD_UP);
  dyd_row_decimal(t, dyd_cell_undetermined(row), DYD_UP);
  dyd_row_end(t);
}

/* Cells give the bounds, which come first. */
dyd_status dyd_cell_comments(dyd_table *t, const dyd_output *o) {
  const dyd_diagram *d = o->what;
  uint64_t bytes = dyd_bytes_times(d->count, sizeof(dyd_cell_row));
  if (dyd_memory_has(d->memory, bytes, "the rows of the cells"))
    t->kept = calloc(d->count ? d->count : 1, sizeof(dyd_cell_row));
  d->memory->beside += bytes;
  dyd_status st = t->kept ? dyd_diagram_visit(d, keep_row, t->kept) : DYD_E_NOMEM;
  return st == DYD_OK ? put_bounds(o) : st;
}

static void cell_polygon(dyd_table *t, const char *kind, uint32_t i, const dyd_polygon *p, const dyd_cell_row *row) {
  if (p->count < 3) return;
  dyd_row_begin(t);
  for (size_t k = 0; k <= p->count; k++) {
    const dyd_point *z = &p->vertex[k % p->count];
    dyd_short_place place;
    dyd_short_place_set(&place, (const double[]){dyd_dyadic_get_d(&z->x, DYD_DOWN), dyd_dyadic_get_d(&z->x, DYD_UP),
                                                 dyd_dyadic_get_d(&z->y, DYD_DOWN), dyd_dyadic_get_d(&z->y, DYD_UP)});
    if (row->rounding > 0) place.error = nextafter(place.error + row->rounding, INFINITY);
    dyd_row_place(t, &place);
  }
  dyd_row_word(t, kind);
  cell_values(t, i, row);
}

static dyd_status cell_polygons(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  dyd_table *t = context;
  DYD_SCOPED(dyd_polygon) inner = {0};
  DYD_SCOPED(dyd_polygon_list) outer = {0};
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK && !row->exact) st = dyd_shape_outer(&outer, shape);
  if (st == DYD_OK) cell_polygon(t, row->exact ? "exact" : "certain", i, &inner, row);
  for (size_t k = 0; st == DYD_OK && k < outer.count; k++) cell_polygon(t, "possible", i, &outer.item[k], row);
  return st;
}

/* A line for each cell in csv; polygons in wkt and geojson. */
dyd_status dyd_cell_rows(dyd_table *t, const dyd_output *o) {
  const dyd_diagram *d = o->what;
  const dyd_cell_row *rows = t->kept;
  if (t->drawn) return dyd_diagram_visit(d, cell_polygons, t);
  for (size_t i = 0; i < d->count; i++) {
    if (!rows[i].present) continue;
    dyd_row_begin(t);
    cell_values(t, i, &rows[i]);
  }
  return DYD_OK;
}

/* ---- tiles ---- */

/* The comments do not need the tiles. */
dyd_status dyd_tile_comments(dyd_table *t, const dyd_output *o) {
  const dyd_diagram *d = o->what;
  dyd_csv_aliases(o->out, t->engine, NULL);
  fputs("# window ", o->out);
  dyd_status st = dyd_put_window(o->out, &d->window, "", " ");
  fputs("\n# rounding: area, area_hi up, certain_area, area_lo down\n", o->out);
  return st;
}

/* Rings r to end - 1. */
static void row_tile(dyd_table *t, const dyd_tiles *tiles, size_t r, size_t end, double area) {
  dyd_row_begin(t);
  for (size_t q = r; q < end; q++) {
    size_t first = tiles->offset[q], n = tiles->offset[q + 1] - first;
    if (t->geometry == DYD_GEOMETRY_POLYGONS) (q == r || tiles->area[q] > 0 ? dyd_row_part : dyd_row_hole)(t);
    for (size_t k = 0; t->drawn && k <= n; k++) {
      const double *z = &tiles->xy[2 * (first + k % n)];
      dyd_row_at(t, (const double[]){z[0], z[0], z[1], z[1]});
    }
  }
  t->error = nextafter(t->error + tiles->rounding, INFINITY);
  dyd_row_own(t, tiles->site[r]);
  dyd_row_decimal(t, area, DYD_UP);
  dyd_row_decimal(t, tiles->bound[2 * r], DYD_DOWN);
  dyd_row_decimal(t, tiles->bound[2 * r], DYD_DOWN);
  dyd_row_decimal(t, tiles->bound[2 * r + 1], DYD_UP);
  dyd_row_end(t);
}

dyd_status dyd_tile_rows(dyd_table *t, const dyd_output *o) {
  const dyd_diagram *d = o->what;
  DYD_SCOPED(dyd_tiles) tiles = {0};
  dyd_status st = dyd_diagram_tiles(&tiles, d, !t->drawn, o->err);
  for (size_t r = 0, end = 0; r < tiles.count && st == DYD_OK; r = end) {
    double area = dyd_diagram_tile(&end, d, &tiles);
    row_tile(t, &tiles, r, end, area);
  }
  return st;
}

/* ---- vertices ---- */

static dyd_status exact_vertex(dyd_table *t, const dyd_diagram *d, size_t k) {
  char *text[4];
  dyd_status st = dyd_diagram_vertex(text, d, k);
  for (int m = 0; m < 4; m++) {
    if (st == DYD_OK) dyd_row_word(t, text[m]);
    free(text[m]);
  }
  return st;
}

/* All sites of vertices that have more than three. */
dyd_status dyd_vertex_comments(dyd_table *t, const dyd_output *o) {
  const dyd_diagram *d = o->what;
  dyd_status st = dyd_diagram_comments(t, o);
  for (size_t k = d->triangles.count; k < dyd_diagram_vertices(d) && st == DYD_OK; k++) {
    DYD_SCOPED(dyd_index_list) sites = {0};
    st = dyd_diagram_vertex_sites(&sites, d, k);
    if (st != DYD_OK) break;
    fputs("# tie ", o->out);
    dyd_put_rows(o->out, d->engine, &sites, " ");
    fputs("\n", o->out);
  }
  return st;
}

/* The row of vertex k; of a tied one with its first three sites. */
static dyd_status row_vertex(dyd_table *t, const dyd_diagram *d, size_t k, bool exact) {
  DYD_SCOPED(dyd_index_list) sites = {0};
  dyd_status st = dyd_diagram_vertex_sites(&sites, d, k);
  if (st != DYD_OK) return st;
  dyd_row_begin(t);
  dyd_row_at(t, d->vertex[k]);
  dyd_row_three(t, sites.item, false);
  if (exact)
    st = exact_vertex(t, d, k);
  else
    dyd_row_box(t, d->vertex[k]);
  dyd_row_three(t, sites.item, true);
  dyd_row_end(t);
  return st;
}

/* wkt and geojson hold the vertices that can be drawn and whose enclosure meets the window. Where a goal asks for more
 * than decimals of 17 digits show, the enclosures are exact numbers in csv. */
dyd_status dyd_vertex_rows(dyd_table *t, const dyd_output *o) {
  const dyd_diagram *d = o->what;
  bool csv = !t->drawn;
  int64_t goal_bits;
  bool exact = csv && dyd_engine_goal(&goal_bits, d->engine) == DYD_GOAL_VORONOI_HAUSDORFF && goal_bits > 32;
  dyd_status st = find_bounds(t, d);
  for (size_t k = 0; k < dyd_diagram_vertices(d) && st == DYD_OK; k++)
    if (csv || dyd_diagram_vertex_in_window(d, k)) st = row_vertex(t, d, k, exact);
  return st;
}

/* ---- regions ---- */

static dyd_status row_region(void *context, size_t face, const double box[4]) {
  dyd_table *t = context;
  DYD_SCOPED(dyd_index_list) sites = {0};
  bool outer;
  if (!box) return DYD_OK;
  dyd_status st = dyd_delaunay_face(&sites, &outer, dyd_engine_delaunay(t->engine), face);
  if (st == DYD_OK) {
    dyd_row_begin(t);
    dyd_row_outline(t, box);
    dyd_row_index(t, face);
    dyd_row_box(t, box);
    dyd_row_sites(t, &sites);
    dyd_row_end(t);
  }
  return st;
}

dyd_status dyd_region_rows(dyd_table *t, const dyd_output *o) {
  dyd_status st = find_bounds(t, o->what);
  return st == DYD_OK ? dyd_diagram_regions(o->what, row_region, t) : st;
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
  DYD_SCOPED(dyd_index_list) sites = {0};
  dyd_status st = dyd_diagram_vertex_sites(&sites, d, vertex);
  if (st == DYD_OK && sites.count > 3) sites.count = 3;
  if (st == DYD_OK) dyd_row_sites(t, &sites);
  return st;
}

/* The third corner of the certain triangle whose vertex the edge ends at, or what names a tied one; "ray", or "open":
 * in an undecided region. */
static dyd_status edge_value(dyd_table *t, const dyd_diagram *d, const dyd_dual_edge *e, int end) {
  const dyd_dual_end *to = &e->end[end];
  bool vertex = to->kind == DYD_DUAL_VERTEX;
  if (vertex && to->vertex >= d->triangles.count) return tied_value(t, d, to->vertex);
  char text[24] = "open";
  if (to->kind == DYD_DUAL_RAY) snprintf(text, sizeof text, "ray");
  if (vertex)
    snprintf(text, sizeof text, "%zu",
             dyd_engine_row(d->engine, third_corner(&d->triangles.item[to->vertex], e->i, e->j)));
  dyd_row_word(t, text);
  return DYD_OK;
}

/* Where the segment from a, beyond the side of the window, to b, not certainly beyond it, meets the side. */
static void edge_cross(double a[4], const double b[4], int axis, double side) {
  const double *u = a + 2 * axis, *v = b + 2 * axis;
  const bool below = u[1] < side;
  double least = below ? side - u[1] : u[0] - side, most = below ? side - u[0] : u[1] - side;
  double narrow = below ? v[0] - u[1] : u[0] - v[1], wide = below ? v[1] - u[0] : u[1] - v[0];
  const double share[2] = {fmax(least / wide * (1 - 4 * DBL_EPSILON), 0),
                           narrow > 0 ? fmin(most / narrow * (1 + 4 * DBL_EPSILON), 1) : 1};
  double *p = a + 2 * (1 - axis), out[2] = {INFINITY, -INFINITY};
  const double *q = b + 2 * (1 - axis);
  const double slack = 8 * DBL_EPSILON * fmax(fmax(fabs(p[0]), fabs(p[1])), fmax(fabs(q[0]), fabs(q[1])));
  for (int k = 0; k < 2; k++) {
    out[0] = fmin(out[0], (1 - share[k]) * p[0] + share[k] * q[0] - slack);
    out[1] = fmax(out[1], (1 - share[k]) * p[1] + share[k] * q[1] + slack);
  }
  a[2 * axis] = a[2 * axis + 1] = side;
  p[0] = out[0], p[1] = out[1];
}

/* Cuts the segment to the window. Invariant: the ends are inside their boxes. false: all of it is beyond. */
static bool edge_clip(double box[2][4], const double window[4]) {
  for (int k = 0; k < 4; k++) {
    bool beyond[2];
    for (int end = 0; end < 2; end++) beyond[end] = k & 1 ? box[end][k - 1] > window[k] : box[end][k + 1] < window[k];
    if (beyond[0] && beyond[1]) return false;
    for (int end = 0; end < 2; end++)
      if (beyond[end]) edge_cross(box[end], box[1 - end], k / 2, window[k]);
  }
  return true;
}

/* csv lists all; wkt and geojson those with two ends that can be drawn. */
dyd_status dyd_edge_rows(dyd_table *t, const dyd_output *o) {
  const dyd_diagram *d = o->what;
  DYD_FREED dyd_dual_edge *edge = NULL;
  size_t count = 0;
  double window[4];
  dyd_rect_get_d(window, &d->window);
  dyd_status st = find_bounds(t, d);
  if (st == DYD_OK) st = dyd_diagram_edges(&edge, &count, d);
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    double box[2][4];
    bool drawn = dyd_diagram_edge(box, d, &edge[k]);
    if (drawn ? t->clip && !edge_clip(box, window) : t->drawn) continue;
    dyd_row_begin(t);
    for (int end = 0; drawn && end < 2; end++) dyd_row_at(t, box[end]);
    dyd_row_site(t, edge[k].i);
    dyd_row_site(t, edge[k].j);
    for (int end = 0; end < 2 && st == DYD_OK; end++) st = edge_value(t, d, &edge[k], end);
    dyd_row_end_two(t, edge[k].i, edge[k].j);
  }
  return st;
}

/* ---- cells of a sphere ---- */

/* The vertices of a cell, "3 7 9", with a star where an undecided region comes first. */
static void row_nodes(dyd_table *t, const dyd_sphere_cells *c, size_t i) {
  FILE *out = dyd_row_open(t);
  for (size_t k = c->first[i]; k < c->first[i + 1]; k++)
    fprintf(out, "%s%s%" PRIu32, k > c->first[i] ? " " : "", c->gap[k] ? "* " : "", c->of[k]);
  dyd_row_close(t);
}

/* How far a vertex may be from where it is shown; at a pole longitudes are one. */
static double node_error(const dyd_sphere_node *v) {
  double lon = v->at.lon + 360 * nearbyint((v->box[0] / 2 + v->box[1] / 2 - v->at.lon) / 360);
  double x = fabs(v->at.lat) == 90 ? 0 : fmax(lon - v->box[0], v->box[1] - lon);
  return fmax(x, fmax(v->at.lat - v->box[2], v->box[3] - v->at.lat));
}

/* The polygon of a cell that is known all around. */
static dyd_status cell_outline(dyd_table *t, const dyd_sphere_cells *c, double most, uint32_t i) {
  size_t n = c->first[i + 1] - c->first[i];
  double error = 0;
  if (!t->drawn || !c->closed[i]) return DYD_OK;
  DYD_FREED dyd_side *side = dyd_alloc(n + 1, sizeof *side);
  if (!side) return DYD_E_NOMEM;
  for (size_t k = 0; k < n; k++) side[k] = dyd_sphere_cell_side(c, i, k);
  n += dyd_sphere_cell_is_half(&side[n], c, t->sphere, i);
  dyd_status st = dyd_row_around(t, side, n, most);
  for (size_t k = c->first[i]; k < c->first[i + 1]; k++) error = fmax(error, node_error(&c->node[c->of[k]]));
  t->error += error;
  return st;
}

static dyd_status row_cell(dyd_table *t, const dyd_sphere_cells *c, double most, uint32_t i) {
  dyd_row_begin(t);
  dyd_status st = cell_outline(t, c, most, i);
  dyd_row_own(t, i);
  dyd_row_word(t, c->closed[i] ? "yes" : "no");
  row_nodes(t, c, i);
  dyd_row_end(t);
  return st;
}

dyd_status dyd_globe_cell_rows(dyd_table *t, const dyd_output *o) {
  const dyd_result *r = o->what;
  DYD_SCOPED(dyd_sphere_cells) c = {0};
  dyd_status st = dyd_sphere_cells_find(&c, r->sphere, o->err);
  for (uint32_t i = 0; i < r->count && st == DYD_OK; i++)
    if (dyd_sphere_alias(r->sphere, i) == i) st = row_cell(t, &c, r->max_arc, i);
  return st;
}

dyd_status dyd_globe_vertex_comments(dyd_table *t, const dyd_output *o) {
  dyd_csv_aliases(o->out, t->engine, t->sphere);
  fputs("# rounding: lo down, hi up\n", o->out);
  return DYD_OK;
}

dyd_status dyd_globe_vertex_rows(dyd_table *t, const dyd_output *o) {
  DYD_SCOPED(dyd_sphere_cells) c = {0};
  dyd_status st = dyd_sphere_cells_find(&c, t->sphere, o->err);
  for (size_t k = 0; k < c.nodes && st == DYD_OK; k++) {
    dyd_row_begin(t);
    dyd_row_at(t, c.node[k].box);
    dyd_row_three(t, c.node[k].of.v, false);
    dyd_row_three(t, c.node[k].of.v, true);
    dyd_row_box(t, c.node[k].box);
    dyd_row_end(t);
  }
  return st;
}

dyd_status dyd_globe_region_rows(dyd_table *t, const dyd_output *o) {
  (void)o;
  DYD_SCOPED(dyd_index_list) sites = {0};
  dyd_status st = DYD_OK;
  for (size_t f = 0; f < dyd_sphere_faces(t->sphere) && st == DYD_OK; f++) {
    bool tie;
    st = dyd_sphere_face(&sites, &tie, t->sphere, f);
    if (st != DYD_OK) break;
    dyd_row_begin(t);
    dyd_row_index(t, f);
    dyd_row_word(t, tie ? "tie" : "indeterminate");
    dyd_row_sites(t, &sites);
    dyd_row_end(t);
  }
  return st;
}
