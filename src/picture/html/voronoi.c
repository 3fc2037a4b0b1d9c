/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages of the diagram: cells as polygons, vertices, regions and edges, beside what all pages tell.
 *
 * Polygons are drawn, so their vertices are rounded to multiples of a unit 2^u, from the lower left corner of the
 * window on: at most a quarter of what the polygons themselves are off their cells, or 2^-44 of the window. The page
 * tells. */
#include "picture/html/file.h"
#include "picture/html/html.h"
#include "picture/html/scene.h"

#include "base/error.h"
#include "io/diagram.h"
#include "io/json.h"
#include "picture/picture.h"
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

typedef struct html_diagram {
  FILE *out;
  const dyd_diagram *d;
  double origin[2], unit;
  bool any; /* is there one in the list that is written? */
} html_diagram;

/* ---- rounded places ---- */

static int diagram_unit(html_diagram *g) {
  enum { FINER = 2, DIGITS = 44, LEAST = -1000 };
  double w[4];
  dyd_rect_get_d(w, &g->d->window);
  int window = ilogb(fmax(w[1] - w[0], w[3] - w[2])) - DIGITS;
  int64_t wanted = -g->d->bits - FINER;
  int unit = wanted < window ? window : wanted > window + DIGITS ? window + DIGITS : (int)wanted;
  if (unit < LEAST) unit = LEAST;
  g->origin[0] = w[0];
  g->origin[1] = w[2];
  g->unit = ldexp(1, unit);
  return unit;
}

/* The number of units; last is that of the place before, and becomes this one. */
static void put_place(html_diagram *g, double x, double y, int64_t last[2], const char *before) {
  int64_t now[2] = {(int64_t)llround((x - g->origin[0]) / g->unit), (int64_t)llround((y - g->origin[1]) / g->unit)};
  fprintf(g->out, "%s%" PRId64 ",%" PRId64, before, now[0] - last[0], now[1] - last[1]);
  last[0] = now[0];
  last[1] = now[1];
}

static void put_polygon(html_diagram *g, const dyd_polygon *p) {
  int64_t last[2] = {0, 0};
  fputc('[', g->out);
  for (size_t k = 0; k < p->count; k++)
    put_place(g, dyd_dyadic_get_d(&p->vertex[k].x, DYD_DOWN), dyd_dyadic_get_d(&p->vertex[k].y, DYD_DOWN), last,
              k ? "," : "");
  fputc(']', g->out);
}

/* ---- cells ---- */

static dyd_status html_cell(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  html_diagram *g = context;
  dyd_polygon inner = {0};
  dyd_polygon_list outer = {0};
  dyd_json j;
  if (!row->present) return DYD_OK;
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK) st = dyd_shape_outer(&outer, shape);
  dyd_json_begin(&j, g->out);
  dyd_json_break(&j, g->any ? ",\n" : "\n");
  dyd_json_object(&j, NULL, DYD_JSON_FLAT);
  dyd_json_site(&j, "i", g->d->engine, i);
  dyd_json_decimals(&j, "area", row->area[0], row->area[1]);
  dyd_json_decimal(&j, "undetermined", dyd_cell_undetermined(row), DYD_UP);
  dyd_json_file(&j, "inner");
  put_polygon(g, &inner);
  fputs(", \"outer\": [", g->out);
  for (size_t k = 0; k < outer.count; k++) {
    if (k) fputc(',', g->out);
    put_polygon(g, &outer.item[k]);
  }
  fputs("]}", g->out);
  g->any = true;
  dyd_polygon_list_clear(&outer);
  dyd_polygon_clear(&inner);
  return st;
}

/* ---- vertices, regions, edges ---- */

static dyd_status html_vertices(html_diagram *g) {
  const dyd_diagram *d = g->d;
  dyd_json j;
  dyd_json_begin(&j, g->out);
  dyd_json_array(&j, "vertices", DYD_JSON_ROWS);
  for (size_t k = 0; k < dyd_diagram_vertices(d) && j.st == DYD_OK; k++) {
    dyd_index_list sites = {0};
    if (!dyd_diagram_vertex_in_window(d, k)) continue;
    dyd_json_good(&j, dyd_diagram_vertex_sites(&sites, d, k));
    dyd_json_object(&j, NULL, DYD_JSON_FLAT);
    dyd_json_sites(&j, "sites", d->engine, &sites);
    dyd_json_box(&j, false, d->vertex[k]);
    dyd_json_close(&j, 1);
    dyd_index_list_clear(&sites);
  }
  return dyd_json_end(&j, "],\n");
}

static dyd_status html_region(void *context, size_t face, const double box[4]) {
  html_diagram *g = context;
  dyd_index_list sites = {0};
  bool outer;
  dyd_json j;
  if (!box) return DYD_OK;
  dyd_status st = dyd_delaunay_face(&sites, &outer, g->d->pd, face);
  dyd_json_begin(&j, g->out);
  dyd_json_break(&j, g->any ? ",\n" : "\n");
  dyd_json_object(&j, NULL, DYD_JSON_FLAT);
  dyd_json_sites(&j, "sites", g->d->engine, &sites);
  dyd_json_box(&j, false, box);
  dyd_json_end(&j, "}");
  g->any = true;
  dyd_index_list_clear(&sites);
  return st;
}

/* Those of which both ends are known, as lines between the middles of these. */
static dyd_status html_edges(html_diagram *g) {
  dyd_dual_edge *edge = NULL;
  size_t count = 0;
  double box[2][4];
  dyd_status st = dyd_dual_edges(&edge, &count, g->d->pd, &g->d->triangles, g->d->tied, g->d->ties, g->d->room);
  const char *between = "";
  fputs("\"edges\": [", g->out);
  for (size_t k = 0; k < count; k++) {
    int64_t last[2] = {0, 0};
    double z[2][2], w[4];
    if (!dyd_diagram_edge(box, g->d, &edge[k])) continue;
    for (int c = 0; c < 4; c++) z[c >> 1][c & 1] = box[c >> 1][2 * (c & 1)] / 2 + box[c >> 1][2 * (c & 1) + 1] / 2;
    dyd_rect_get_d(w, &g->d->window);
    if (!dyd_clip_segment(z, w)) continue;
    put_place(g, z[0][0], z[0][1], last, between);
    put_place(g, z[1][0], z[1][1], last, ",");
    between = ",";
  }
  fputs("],\n", g->out);
  free(edge);
  return st;
}

/* ---- the page ---- */

/* Cells come first, as they give the bounds. */
static dyd_status html_diagram_parts(FILE *to, const void *diagram) {
  const dyd_diagram *d = diagram;
  html_diagram g = {.out = to, .d = d};
  int unit = diagram_unit(&g);
  dyd_json j;
  fprintf(to, "\"unit\": %d, \"origin\": [", unit);
  dyd_decimal_put_near(to, g.origin[0]);
  fputs(", ", to);
  dyd_decimal_put_near(to, g.origin[1]);
  fprintf(to, "], \"flatten_bits\": %" PRId64 ",\n\"cells\": [", d->bits);
  dyd_status st = dyd_diagram_visit(d, html_cell, &g);
  fputs("],\n", to);
  dyd_json_begin(&j, to);
  dyd_json_bound(&j, "undetermined_area", &d->bounds->area);
  dyd_json_break(&j, ",\n");
  dyd_json_bound(&j, "distance_to_true_diagram", d->bounds->finite ? &d->bounds->hausdorff : NULL);
  if (st == DYD_OK) st = dyd_json_end(&j, ",\n");
  if (st == DYD_OK) st = html_vertices(&g);
  g.any = false;
  fputs("\"regions\": [", to);
  if (st == DYD_OK) st = dyd_diagram_regions(d, html_region, &g);
  fputs("],\n", to);
  return st == DYD_OK ? html_edges(&g) : st;
}

static dyd_status html_cells_page(FILE *to, const dyd_output *o) {
  const dyd_diagram *d = o->what;
  dyd_result r = {.out = to,
                  .engine = d->engine,
                  .pd = d->pd,
                  .sites = d->sites,
                  .count = d->count,
                  .window = &d->window,
                  .epsg = d->epsg,
                  .history = d->history};
  dyd_status st = dyd_delaunay_pairs(&r.pairs, d->pd);
  if (st == DYD_OK) st = dyd_html_scene_write(o, to, &r, "voronoi", html_diagram_parts, d);
  dyd_pair_list_clear(&r.pairs);
  return st;
}

dyd_status dyd_html_diagram(const dyd_output *o) {
  return dyd_html_write(o, html_cells_page);
}
