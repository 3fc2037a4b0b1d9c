/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Formats of meshes: obj, and legacy vtk polygon data. In a triangulation each site is one place in its rectangle, on a
 * sphere a vector of length 1; the head states the largest distance in the rectangle from it. Of a Voronoi diagram vtk
 * holds lines and polygons with their sites and kinds. */
#include "base/alloc.h"
#include "base/local.h"
#include "io/diagram.h"
#include "io/json.h"
#include "io/output.h"
#include <stdlib.h>
#include <string.h>

/* ---- the mesh of a triangulation ---- */

typedef struct mesh_place {
  char at[3][DYD_DECIMAL_SIZE];
} mesh_place;

typedef struct mesh_writer {
  const dyd_result *r;
  mesh_place *place;
  char bound[DYD_DECIMAL_SIZE]; /* the largest distance of a place from the exact one, in a coordinate */
  dyd_triangle_list triangles;
} mesh_writer;

static void mesh_release(mesh_writer *m) {
  dyd_triangle_list_clear(&m->triangles);
  free(m->place);
}

/* In case of failure, too, mesh_clear comes after it. */
static dyd_status mesh_make(mesh_writer *m, const dyd_output *o) {
  const dyd_result *r = o->what;
  double box[6] = {0}, error, most = 0;
  *m = (mesh_writer){.r = r, .place = dyd_alloc(r->count, sizeof *m->place)};
  dyd_status st = m->place ? DYD_OK : DYD_E_NOMEM;
  for (uint32_t i = 0; i < r->count && st == DYD_OK; i++) {
    st = r->sphere ? dyd_sphere_vector(box, r->sphere, i, o->err) : dyd_result_box(box, r, i, o->err);
    for (int a = 0; a < 3 && st == DYD_OK; a++) {
      dyd_decimal_within(m->place[i].at[a], &error, box[2 * a], box[2 * a + 1]);
      most = error > most ? error : most;
    }
  }
  dyd_decimal_directed(m->bound, most, 2, DYD_UP);
  return st == DYD_OK ? dyd_result_triangles(&m->triangles, r) : st;
}

static void mesh_put(const mesh_writer *m, FILE *out, uint32_t i, const char *word) {
  fprintf(out, "%s%s %s %s\n", word, m->place[i].at[0], m->place[i].at[1], m->place[i].at[2]);
}

/* ---- obj ---- */

static void obj_elements(FILE *out, const dyd_result *r, const dyd_triangle_list *triangles) {
  dyd_sink s;
  dyd_sink_begin(&s, out);
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

/* Writes the name of the next vertex, unless its place in the file gives it. */
static void obj_name(FILE *out, const dyd_result *r, uint32_t i) {
  const char *id = dyd_engine_id(r->engine, i);
  if (!id && dyd_engine_row(r->engine, i) == i) return;
  dyd_json j;
  fprintf(out, "# row %zu", dyd_engine_row(r->engine, i));
  dyd_json_begin(&j, out);
  dyd_json_break(&j, ", ");
  dyd_json_ids(&j, r->engine, &i, 0);
  dyd_json_end(&j, "\n");
}

static void obj_write(FILE *out, const mesh_writer *m) {
  size_t count[4];
  dyd_result_count(count, m->r);
  fprintf(out,
          "# dyadel %s, outcome %s\n# a coordinate differs from every %s by at most %s\n# not shown: %zu "
          "indeterminate pairs, %zu ties\n",
          dyd_version(), dyd_outcome_text(dyd_result_outcome(m->r)),
          m->r->sphere ? "place of its region on the sphere of radius 1" : "point of its rectangle", m->bound,
          count[DYD_INDETERMINATE], count[DYD_TIE]);
  for (uint32_t i = 0; i < m->r->count; i++) {
    obj_name(out, m->r, i);
    mesh_put(m, out, i, "v ");
  }
  obj_elements(out, m->r, &m->triangles);
}

static dyd_status delaunay_obj(const dyd_output *o) {
  mesh_writer m;
  dyd_status st = mesh_make(&m, o);
  if (st == DYD_OK) obj_write(o->out, &m);
  mesh_release(&m);
  return st;
}

/* ---- vtk ---- */

static void vtk_number(dyd_sink *s, size_t n) {
  dyd_sink_index(s, n);
  dyd_sink_put(s, "\n", 1);
}

static void vtk_elements(FILE *out, const dyd_result *r, const dyd_triangle_list *triangles) {
  const size_t pairs = r->pairs.count, all = pairs + triangles->count;
  dyd_sink s;
  fprintf(out, "LINES %zu %zu\n", pairs, 3 * pairs);
  dyd_sink_begin(&s, out);
  for (size_t k = 0; k < pairs; k++) {
    const uint32_t ends[2] = {r->pairs.item[k].i, r->pairs.item[k].j};
    dyd_sink_line(&s, "2", ends, 2, 0);
  }
  dyd_sink_flush(&s);
  fprintf(out, "POLYGONS %zu %zu\n", triangles->count, 4 * triangles->count);
  for (size_t k = 0; k < triangles->count; k++) dyd_sink_line(&s, "3", triangles->item[k].v, 3, 0);
  dyd_sink_flush(&s);
  fprintf(out, "CELL_DATA %zu\nSCALARS status int 1\nLOOKUP_TABLE default\n", all);
  for (size_t k = 0; k < all; k++) vtk_number(&s, k < pairs ? r->pairs.item[k].status : DYD_LEGAL);
  dyd_sink_flush(&s);
}

/* Of each point: how many partners by status, and the hull. */
static void vtk_points(FILE *out, const dyd_result *r, const dyd_site_row *rows) {
  static const dyd_pair_status statuses[] = {DYD_LEGAL, DYD_INDETERMINATE, DYD_TIE};
  dyd_sink to;
  fprintf(out, "POINT_DATA %zu\n", r->count);
  dyd_sink_begin(&to, out);
  for (int s = 0; s < 3; s++) {
    fprintf(out, "SCALARS %s int 1\nLOOKUP_TABLE default\n", dyd_pair_status_text(statuses[s]));
    for (size_t i = 0; i < r->count; i++) vtk_number(&to, rows[i].partners[statuses[s]]);
    dyd_sink_flush(&to);
  }
  dyd_sink_text(&to, "SCALARS hull int 1\nLOOKUP_TABLE default\n");
  for (size_t i = 0; i < r->count; i++) vtk_number(&to, *rows[i].hull == 'c' ? 2 : *rows[i].hull == 'p');
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

/* Writes rows and identifiers of the points, unless their places in the file give them. */
static void vtk_names(FILE *out, const dyd_result *r) {
  bool rows = r->count && dyd_engine_row(r->engine, r->count - 1) != r->count - 1, ids = dyd_engine_id(r->engine, 0);
  if (!rows && !ids) return;
  fprintf(out, "FIELD names %d\nrow 1 %zu long\n", 1 + ids, r->count);
  for (size_t i = 0; i < r->count; i++) fprintf(out, "%zu\n", dyd_engine_row(r->engine, i));
  if (ids) fprintf(out, "id 1 %zu string\n", r->count);
  for (size_t i = 0; ids && i < r->count; i++) vtk_text(out, dyd_engine_id(r->engine, i));
}

static void vtk_write(FILE *out, const mesh_writer *m, const dyd_site_row *rows) {
  const char *outcome = dyd_outcome_text(dyd_result_outcome(m->r));
  fputs("# vtk DataFile Version 3.0\ndyadel delaunay, ", out);
  if (m->r->sphere)
    fprintf(out, "sphere of radius 1, outcome %s; status 1 tie, 2 indeterminate, 3 legal; ", outcome);
  else
    fprintf(out, "outcome %s; status 1 tie, 2 indeterminate, 3 legal; hull 1 possible, 2 certain; ", outcome);
  fprintf(out, "coordinates within %s of their %s\nASCII\nDATASET POLYDATA\nPOINTS %zu double\n", m->bound,
          m->r->sphere ? "places" : "rectangles", m->r->count);
  for (uint32_t i = 0; i < m->r->count; i++) mesh_put(m, out, i, "");
  vtk_elements(out, m->r, &m->triangles);
  vtk_points(out, m->r, rows);
  vtk_names(out, m->r);
}

static dyd_status delaunay_vtk(const dyd_output *o) {
  DYD_FREED dyd_site_row *rows = NULL;
  mesh_writer m;
  dyd_status st = mesh_make(&m, o);
  if (st == DYD_OK) st = dyd_result_sites(&rows, o->what);
  if (st == DYD_OK) vtk_write(o->out, &m, rows);
  mesh_release(&m);
  return st;
}

/* ---- vtk of a Voronoi diagram ---- */

/* What a line or polygon is; the numbers are those in the file. */
typedef enum figure_kind {
  FIGURE_INNER,
  FIGURE_OUTER,
  FIGURE_VERTEX,
  FIGURE_REGION,
  FIGURE_EDGE,
  FIGURE_TILE
} figure_kind;

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
  return dyd_memory_has(g->d->memory, dyd_bytes_add(points, items), "the figures of the diagram");
}

static dyd_status gather_figure(gathered *g, figure_kind kind, uint32_t site, size_t corners) {
  if (!figures_have_room(g, corners)) return DYD_E_NOMEM;
  if (!DYD_GROW(g->item, g->cap, g->count + 1) || !DYD_GROW(g->at, g->points_cap, g->points + corners))
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
  DYD_SCOPED(dyd_polygon) inner = {0};
  DYD_SCOPED(dyd_polygon_list) outer = {0};
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK) st = gather_polygon(g, &inner, i, FIGURE_INNER);
  if (st == DYD_OK) st = dyd_shape_outer(&outer, shape);
  for (size_t k = 0; k < outer.count && st == DYD_OK; k++) st = gather_polygon(g, &outer.item[k], i, FIGURE_OUTER);
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
  DYD_SCOPED(dyd_index_list) sites = {0};
  bool outer;
  if (!box) return DYD_OK;
  dyd_status st = dyd_delaunay_face(&sites, &outer, g->d->pd, face);
  return st == DYD_OK ? gather_box(g, FIGURE_REGION, sites.count ? sites.item[0] : 0, box) : st;
}

static dyd_status gather_edges(gathered *g) {
  DYD_FREED dyd_dual_edge *edge = NULL;
  size_t count = 0;
  dyd_status st = dyd_diagram_edges(&edge, &count, g->d);
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    double box[2][4];
    if (!dyd_diagram_edge(box, g->d, &edge[k])) continue;
    st = gather_figure(g, FIGURE_EDGE, edge[k].i, 2);
    for (int c = 0; st == DYD_OK && c < 4; c++)
      g->at[g->points - 2 + (size_t)(c >> 1)][c & 1] = box[c >> 1][2 * (c & 1)] / 2 + box[c >> 1][2 * (c & 1) + 1] / 2;
  }
  return st;
}

/* Tiles, kind 5. */
static dyd_status gather_tiles(gathered *g, dyd_error *err) {
  const dyd_diagram *d = g->d;
  DYD_SCOPED(dyd_tiles) tiles = {0};
  dyd_status st = dyd_diagram_tiles(&tiles, d, false, err);
  for (size_t r = 0; r < tiles.count && st == DYD_OK; r++) {
    size_t first = tiles.offset[r], n = tiles.offset[r + 1] - first;
    st = gather_figure(g, FIGURE_TILE, tiles.site[r], n);
    if (st == DYD_OK) memcpy(g->at[g->points - n], &tiles.xy[2 * first], n * sizeof *g->at);
  }
  return st;
}

static dyd_status gather_all(gathered *g) {
  const dyd_diagram *d = g->d;
  dyd_status st = dyd_diagram_visit(d, gather_cell, g);
  for (size_t k = 0; k < dyd_diagram_vertices(d) && st == DYD_OK; k++) {
    DYD_SCOPED(dyd_index_list) sites = {0};
    st = dyd_diagram_vertex_sites(&sites, d, k);
    if (st == DYD_OK) st = gather_box(g, FIGURE_VERTEX, sites.item[0], d->vertex[k]);
  }
  if (st == DYD_OK) st = dyd_diagram_regions(d, gather_region, g);
  return st == DYD_OK ? gather_edges(g) : st;
}

/* A section of the edges, or of all others. */
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

static dyd_status voronoi_vtk(const dyd_output *o) {
  gathered g = {.d = o->what};
  dyd_status st = o->content == DYD_CONTENT_TILES ? gather_tiles(&g, o->err) : gather_all(&g);
  if (st == DYD_OK) {
    fprintf(
        o->out,
        "# vtk DataFile Version 3.0\n"
        "dyadel voronoi, outcome %s; kind 0 certain, 1 possible, 2 box of a vertex, 3 undecided "
        "region, 4 edge, 5 tile; coordinates within 2^-52 of themselves\nASCII\nDATASET POLYDATA\nPOINTS %zu double\n",
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
  dyd_free_all(g.at, g.item);
  return st;
}

dyd_writer *const dyd_obj_writers[DYD_CONTENTS] = {
    [DYD_CONTENT_DELAUNAY] = delaunay_obj, [DYD_CONTENT_SPHERE] = delaunay_obj};
dyd_writer *const dyd_vtk_writers[DYD_CONTENTS] = {[DYD_CONTENT_DELAUNAY] = delaunay_vtk,
                                                   [DYD_CONTENT_VORONOI] = voronoi_vtk,
                                                   [DYD_CONTENT_TILES] = voronoi_vtk,
                                                   [DYD_CONTENT_SPHERE] = delaunay_vtk};
