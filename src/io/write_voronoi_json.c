/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The json format of the Voronoi diagram: exact arcs and polygons of the cells, vertices, edges, rays, regions, bounds.
 */
#include "io/arc_json.h"
#include "io/diagram.h"
#include "io/dual.h"
#include "io/label_text.h"
#include "io/parts.h"
#include "io/result.h"
#include "voronoi/exact_cell.h"
#include <inttypes.h>
#include <stdlib.h>

/* ---- cells ---- */

static dyd_status exact_point_json(FILE *out, const dyd_point *z) {
  char *x = dyd_dyadic_get_str(&z->x), *y = dyd_dyadic_get_str(&z->y);
  dyd_status st = x && y ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) fprintf(out, "[\"%s\", \"%s\"]", x, y);
  free(x);
  free(y);
  return st;
}

static dyd_status polygon_json(FILE *out, const dyd_polygon *p) {
  dyd_status st = DYD_OK;
  fputs("[", out);
  for (size_t k = 0; k < p->count && st == DYD_OK; k++) {
    if (k) fputs(", ", out);
    st = exact_point_json(out, &p->vertex[k]);
  }
  fputs("]", out);
  return st;
}

/* What is known of an exact cell. */
static dyd_status exact_json(const dyd_diagram *d, uint32_t i, const dyd_cell_row *row) {
  mpq_t area;
  bool exact = false;
  if (!row->exact) return DYD_OK;
  mpq_init(area);
  dyd_status st = dyd_voronoi_exact_area(area, &exact, d->pd, i, &d->window);
  if (st == DYD_OK && exact) {
    fputs("\"exact_area\": \"", d->out);
    mpq_out_str(d->out, 10, area);
    fputs("\", \"vertex_error\": ", d->out);
    dyd_decimal_put(d->out, row->rounding, DYD_UP, "null");
    fputs(", ", d->out);
  }
  mpq_clear(area);
  return st;
}

static dyd_status polygons_json(FILE *out, const dyd_shape *shape) {
  dyd_polygon inner = {0};
  dyd_polygon_list outer = {0};
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK) st = dyd_shape_outer(&outer, shape);
  fputs("\"inner\": ", out);
  if (st == DYD_OK) st = polygon_json(out, &inner);
  fputs(",\n\"outer\": [", out);
  for (size_t k = 0; k < outer.count && st == DYD_OK; k++) {
    if (k) fputs(",\n", out);
    st = polygon_json(out, &outer.item[k]);
  }
  fputs("]", out);
  dyd_polygon_list_clear(&outer);
  dyd_polygon_clear(&inner);
  return st;
}

typedef struct cells {
  const dyd_diagram *d;
  bool any;
  dyd_point_texts texts;
} cells;

static dyd_status region_boundary_json(cells *c, uint32_t i, bool outer) {
  dyd_boundary boundary = {0};
  dyd_status st = dyd_cell_region(&boundary, c->d->pd, i, outer, NULL, c->d->room, c->d->cancel);
  if (st == DYD_CANCELLED) {
    fputs("null", c->d->out);
    st = DYD_OK;
  } else if (st == DYD_OK) {
    st = dyd_boundary_json(c->d->out, &boundary, &c->texts);
  }
  dyd_boundary_clear(&boundary);
  return st;
}

static dyd_status cell_json(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  cells *c = context;
  FILE *out = c->d->out;
  fprintf(out, "%s\n{\"i\": %zu", c->any ? "," : "", dyd_engine_row(c->d->engine, i));
  dyd_json_ids(out, c->d->engine, &i, 0);
  fputs(", \"area\": ", out);
  c->any = true;
  dyd_json_decimals(out, row->area[0], row->area[1]);
  fputs(", \"undetermined\": ", out);
  dyd_decimal_put(out, dyd_cell_undetermined(row), DYD_UP, "null");
  fputs(", ", out);
  if (row->present)
    dyd_json_box(out, "", row->box);
  else
    fputs("\"x\": null, \"y\": null", out);
  fputs(",\n", out);
  dyd_status st = exact_json(c->d, i, row);
  if (st == DYD_OK) st = polygons_json(out, shape);
  fputs(",\n\"int\": ", out);
  if (st == DYD_OK) st = region_boundary_json(c, i, false);
  fputs(",\n\"pos\": ", out);
  if (st == DYD_OK) st = region_boundary_json(c, i, true);
  fputs("}", out);
  return st;
}

/* ---- vertices, edges, regions ---- */

static dyd_status exact_box_json(const dyd_diagram *d, size_t k) {
  char *text[4];
  dyd_status st = dyd_diagram_vertex(text, d, k);
  if (st == DYD_OK)
    fprintf(d->out, ", \"x_exact\": [\"%s\", \"%s\"], \"y_exact\": [\"%s\", \"%s\"]", text[0], text[1], text[2],
            text[3]);
  for (int m = 0; m < 4; m++) free(text[m]);
  return st;
}

static dyd_status vertices_json(const dyd_diagram *d) {
  dyd_status st = DYD_OK;
  fputs("\"vertices\": [", d->out);
  for (size_t k = 0; k < dyd_diagram_vertices(d) && st == DYD_OK; k++) {
    dyd_index_list sites = {0};
    st = dyd_diagram_vertex_sites(&sites, d, k);
    fputs(k ? ",\n{\"sites\": [" : "\n{\"sites\": [", d->out);
    for (size_t q = 0; q < sites.count; q++)
      fprintf(d->out, q ? ", %zu" : "%zu", dyd_engine_row(d->engine, sites.item[q]));
    dyd_index_list_clear(&sites);
    fputs("], ", d->out);
    dyd_json_box(d->out, "", d->vertex[k]);
    if (st == DYD_OK) st = exact_box_json(d, k);
    fputs("}", d->out);
  }
  fputs("\n],\n", d->out);
  return st;
}

static void dual_end_json(FILE *out, const char *name, const dyd_dual_end *end) {
  fprintf(out, ", \"%s\": ", name);
  if (end->kind == DYD_DUAL_VERTEX) {
    fprintf(out, "%zu", end->vertex);
  } else if (end->kind == DYD_DUAL_RAY) {
    fputs("{\"ray\": {", out);
    dyd_json_box(out, "", end->direction);
    fputs("}}", out);
  } else {
    fputs("null", out);
  }
}

static dyd_status dual_edges_json(const dyd_diagram *d) {
  dyd_dual_edge *edge = NULL;
  size_t count = 0;
  dyd_status st = dyd_dual_edges(&edge, &count, d->pd, &d->triangles, d->tied, d->ties, d->room);
  fputs("\"edges\": [", d->out);
  for (size_t k = 0; k < count; k++) {
    fprintf(d->out, "%s\n{\"i\": %zu, \"j\": %zu", k ? "," : "", dyd_engine_row(d->engine, edge[k].i),
            dyd_engine_row(d->engine, edge[k].j));
    dual_end_json(d->out, "from", &edge[k].end[0]);
    dual_end_json(d->out, "to", &edge[k].end[1]);
    fputs("}", d->out);
  }
  fputs("\n],\n", d->out);
  free(edge);
  return st;
}

static dyd_status region_json(void *context, size_t face, const double box[4]) {
  const dyd_diagram *d = *(const dyd_diagram *const *)context;
  dyd_index_list sites = {0};
  bool outer;
  dyd_status st = dyd_delaunay_face(&sites, &outer, d->pd, face);
  fprintf(d->out, "%s\n{\"sites\": [", face ? "," : "");
  dyd_put_rows(d->out, d->engine, &sites, ", ");
  fputs("], ", d->out);
  if (box)
    dyd_json_box(d->out, "", box);
  else
    fputs("\"x\": null, \"y\": null", d->out);
  fputs("}", d->out);
  dyd_index_list_clear(&sites);
  return st;
}

static dyd_status regions_json(const dyd_diagram *d) {
  fputs("\"regions\": [", d->out);
  dyd_status st = dyd_diagram_regions(d, region_json, &d);
  fputs("\n],\n", d->out);
  return st;
}

/* ---- head and bounds ---- */

static dyd_status diagram_head_json(const dyd_diagram *d) {
  size_t count[4];
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, d->engine);
  dyd_delaunay_count(count, d->pd);
  dyd_json_head(d->out, "dyadel voronoi 1");
  dyd_json_crs(d->out, d->epsg);
  fprintf(
      d->out,
      "\"rounding\": \"texts are exact numbers; pairs of numbers are rounded outward: the first down, the second up; "
      "null is unbounded or beyond the largest double; inner and outer of a cell with vertex_error are that cell, with "
      "vertices rounded by at most so much in each coordinate\",\n"
      "\"outcome\": \"%s\",\n\"goal\": \"%s\",\n\"goal_bits\": %" PRId64 ",\n\"flatten_bits\": %" PRId64
      ",\n\"count\": {\"sites\": %zu, \"legal\": %zu, \"indeterminate\": %zu, \"tie\": %zu},\n\"window\": ",
      dyd_outcome_text(dyd_engine_outcome(d->engine)), dyd_goal_text(goal), bits, d->bits, d->count, count[DYD_LEGAL],
      count[DYD_INDETERMINATE], count[DYD_TIE]);
  dyd_status st = dyd_json_rect(d->out, &d->window);
  fputs(",\n", d->out);
  dyd_json_aliases(d->out, d->engine, ",\n");
  return st;
}

static dyd_status diagram_bounds_json(const dyd_diagram *d) {
  fputs("\"bounds\": {", d->out);
  const dyd_voronoi_bounds *b = d->bounds;
  dyd_status st = dyd_json_bound(d->out, "undetermined_area", &b->area);
  fputs(", ", d->out);
  if (st == DYD_OK) st = dyd_json_bound(d->out, "distance_to_true_diagram", b->finite ? &b->hausdorff : NULL);
  fputs("}\n}\n", d->out);
  return st;
}

dyd_status dyd_voronoi_json(const dyd_output *o) {
  const dyd_diagram *d = o->what;
  cells c = {.d = d, .texts = {.engine = d->engine}};
  dyd_status st = diagram_head_json(d);
  fputs("\"cells\": [", d->out);
  if (st == DYD_OK) st = dyd_diagram_visit(d, cell_json, &c);
  dyd_point_texts_clear(&c.texts);
  fputs("\n],\n", d->out);
  if (st == DYD_OK) st = vertices_json(d);
  if (st == DYD_OK) st = dual_edges_json(d);
  if (st == DYD_OK) st = regions_json(d);
  if (st == DYD_OK) st = diagram_bounds_json(d);
  return st;
}
