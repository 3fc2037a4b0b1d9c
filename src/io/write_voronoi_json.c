/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The json format of the Voronoi diagram: exact arcs and polygons of the cells, vertices, edges, rays, regions, bounds.
 *
 * All texts are our own ASCII words and numbers, so nothing needs escaping. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/arc_json.h"
#include "io/diagram.h"
#include "io/dual.h"
#include "io/json_parts.h"
#include <inttypes.h>

/* ---- cells ---- */

static dyd_status put_point(FILE *out, const dyd_point *z) {
  char *x = dyd_dyadic_get_str(&z->x), *y = dyd_dyadic_get_str(&z->y);
  dyd_status status = x && y ? DYD_OK : DYD_E_NOMEM;
  if (status >= 0) fprintf(out, "[\"%s\", \"%s\"]", x, y);
  free(x);
  free(y);
  return status;
}

static dyd_status put_polygon(FILE *out, const dyd_polygon *p) {
  dyd_status status = DYD_OK;
  fputs("[", out);
  for (size_t k = 0; k < p->count && status >= 0; k++) {
    if (k) fputs(", ", out);
    status = put_point(out, &p->vertex[k]);
  }
  fputs("]", out);
  return status;
}

static dyd_status put_polygons(FILE *out, const dyd_shape *shape) {
  dyd_polygon inner = {0};
  dyd_polygon_list outer = {0};
  dyd_status status = dyd_shape_inner(&inner, shape);
  if (status >= 0) status = dyd_shape_outer(&outer, shape);
  fputs("\"inner\": ", out);
  if (status >= 0) status = put_polygon(out, &inner);
  fputs(",\n\"outer\": [", out);
  for (size_t k = 0; k < outer.count && status >= 0; k++) {
    if (k) fputs(",\n", out);
    status = put_polygon(out, &outer.item[k]);
  }
  fputs("]", out);
  dyd_polygon_list_clear(&outer);
  dyd_polygon_clear(&inner);
  return status;
}

typedef struct cells {
  dyd_diagram *d;
  bool any;
  dyd_point_texts texts;
} cells;

static dyd_status write_cell(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  cells *c = context;
  FILE *out = c->d->out;
  dyd_boundary boundary = {0};
  fprintf(out, "%s\n{\"i\": %u, \"area\": [", c->any ? "," : "", (unsigned)i);
  c->any = true;
  dyd_decimal_json(out, row->area[0], DYD_DOWN);
  fputs(", ", out);
  dyd_decimal_json(out, row->area[1], DYD_UP);
  fputs("],\n", out);
  dyd_status status = put_polygons(out, shape);
  fputs(",\n\"int\": ", out);
  if (status >= 0) status = dyd_voronoi_int(&boundary, c->d->pd, i);
  if (status >= 0) status = dyd_boundary_json(out, &boundary, &c->texts);
  fputs(",\n\"pos\": ", out);
  if (status >= 0) status = dyd_voronoi_pos(&boundary, c->d->pd, i);
  if (status >= 0) status = dyd_boundary_json(out, &boundary, &c->texts);
  fputs("}", out);
  dyd_boundary_clear(&boundary);
  return status;
}

/* ---- vertices, edges, regions ---- */

static void put_box(FILE *out, const double b[4]) {
  for (int k = 0; k < 4; k++) {
    fputs(k == 0 ? "\"x\": [" : k == 2 ? "], \"y\": [" : ", ", out);
    dyd_decimal_json(out, b[k], k & 1 ? DYD_UP : DYD_DOWN);
  }
  fputs("]", out);
}

static dyd_status put_exact_box(const dyd_diagram *d, size_t k) {
  char *text[4];
  dyd_status status = dyd_diagram_vertex(text, d, k);
  if (status >= 0)
    fprintf(d->out, ", \"x_exact\": [\"%s\", \"%s\"], \"y_exact\": [\"%s\", \"%s\"]", text[0], text[1], text[2],
            text[3]);
  for (int m = 0; m < 4; m++) free(text[m]);
  return status;
}

static dyd_status write_vertices(const dyd_diagram *d) {
  dyd_status status = DYD_OK;
  fputs("\"vertices\": [", d->out);
  for (size_t k = 0; k < d->triangles.count && status >= 0; k++) {
    const uint32_t *v = d->triangles.item[k].v;
    fprintf(d->out, "%s\n{\"sites\": [%u, %u, %u], ", k ? "," : "", (unsigned)v[0], (unsigned)v[1], (unsigned)v[2]);
    put_box(d->out, d->vertex[k]);
    status = put_exact_box(d, k);
    fputs("}", d->out);
  }
  fputs("\n],\n", d->out);
  return status;
}

static void put_end(FILE *out, const char *name, const dyd_dual_end *end) {
  fprintf(out, ", \"%s\": ", name);
  if (end->kind == DYD_DUAL_VERTEX) {
    fprintf(out, "%zu", end->vertex);
  } else if (end->kind == DYD_DUAL_RAY) {
    fputs("{\"ray\": {", out);
    put_box(out, end->direction);
    fputs("}}", out);
  } else {
    fputs("null", out);
  }
}

static dyd_status write_edges(const dyd_diagram *d) {
  dyd_dual_edge *edge = NULL;
  size_t count = 0;
  dyd_status status = dyd_dual_edges(&edge, &count, d->pd, &d->triangles);
  fputs("\"edges\": [", d->out);
  for (size_t k = 0; k < count; k++) {
    fprintf(d->out, "%s\n{\"i\": %u, \"j\": %u", k ? "," : "", (unsigned)edge[k].i, (unsigned)edge[k].j);
    put_end(d->out, "from", &edge[k].end[0]);
    put_end(d->out, "to", &edge[k].end[1]);
    fputs("}", d->out);
  }
  fputs("\n],\n", d->out);
  free(edge);
  return status;
}

static dyd_status put_region(void *context, size_t face, const double box[4]) {
  const dyd_diagram *d = context;
  dyd_index_list sites = {0};
  bool outer;
  dyd_status status = dyd_delaunay_face(&sites, &outer, d->pd, face);
  fprintf(d->out, "%s\n{\"sites\": [", face ? "," : "");
  for (size_t k = 0; k < sites.count; k++) fprintf(d->out, "%s%u", k ? ", " : "", (unsigned)sites.item[k]);
  fputs("], ", d->out);
  if (box)
    put_box(d->out, box);
  else
    fputs("\"x\": null, \"y\": null", d->out);
  fputs("}", d->out);
  dyd_index_list_clear(&sites);
  return status;
}

static dyd_status write_regions(dyd_diagram *d) {
  fputs("\"regions\": [", d->out);
  dyd_status status = dyd_diagram_regions(d, put_region, d);
  fputs("\n],\n", d->out);
  return status;
}

/* ---- head and bounds ---- */

static dyd_status write_head(const dyd_diagram *d) {
  size_t count[4];
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, d->engine);
  dyd_delaunay_count(count, d->pd);
  fprintf(
      d->out,
      "{\"format\": \"dyadel voronoi 1\",\n\"version\": \"%s\",\n"
      "\"rounding\": \"texts are exact numbers; pairs of numbers are rounded outward: the first down, the second up; "
      "null is unbounded or beyond the largest double\",\n"
      "\"outcome\": \"%s\",\n\"goal\": \"%s\",\n\"goal_bits\": %" PRId64 ",\n\"flatten_bits\": %" PRId64
      ",\n\"count\": {\"sites\": %zu, \"legal\": %zu, \"indeterminate\": %zu, \"tie\": %zu},\n\"window\": ",
      dyd_version(), dyd_outcome_text(dyd_engine_outcome(d->engine)), dyd_goal_text(goal), bits, d->bits, d->count,
      count[DYD_LEGAL], count[DYD_INDETERMINATE], count[DYD_TIE]);
  dyd_point p;
  p.x = d->window.x.lo; /* borrowed */
  p.y = d->window.x.hi;
  fputs("{\"x\": ", d->out);
  dyd_status status = put_point(d->out, &p);
  p.x = d->window.y.lo;
  p.y = d->window.y.hi;
  fputs(", \"y\": ", d->out);
  if (status >= 0) status = put_point(d->out, &p);
  fputs("},\n", d->out);
  dyd_json_aliases(d->out, d->pd, d->count, ",\n");
  return status;
}

static dyd_status write_bounds(const dyd_diagram *d) {
  fputs("\"bounds\": {", d->out);
  dyd_status status = dyd_json_bound(d->out, "undetermined_area", &d->bounds.area);
  fputs(", ", d->out);
  if (!d->bounds.finite)
    fputs("\"distance_to_true_diagram\": null", d->out);
  else if (status >= 0)
    status = dyd_json_bound(d->out, "distance_to_true_diagram", &d->bounds.hausdorff);
  fputs("}\n}\n", d->out);
  return status;
}

dyd_status dyd_write_voronoi_json(dyd_diagram *d, dyd_error *err) {
  cells c = {.d = d};
  dyd_status status = write_head(d);
  fputs("\"cells\": [", d->out);
  if (status >= 0) status = dyd_diagram_visit(d, write_cell, &c);
  dyd_point_texts_clear(&c.texts);
  fputs("\n],\n", d->out);
  if (status >= 0) {
    status = write_vertices(d);
    if (status >= 0) status = write_edges(d);
  }
  if (status >= 0) status = write_regions(d);
  if (status >= 0) status = write_bounds(d);
  return status < 0 ? dyd_fail(err, status, "%s", dyd_status_text(status)) : DYD_OK;
}
