/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The json format: everything that is stated of a triangulation, a Voronoi diagram, tolerances; of a plane or a sphere.
 * It is written piece by piece, so that memory stays small. */
#include "base/local.h"
#include "delaunay/memory.h"
#include "io/diagram.h"
#include "io/geodesic.h"
#include "io/json.h"
#include "io/output.h"
#include "voronoi/exact_cell.h"
#include "voronoi/shape.h"
#include <stdlib.h>

static void json_count(dyd_json *j, size_t sites, const size_t count[4]) {
  dyd_json_object(j, "count", DYD_JSON_FLAT);
  dyd_json_index(j, "sites", sites);
  dyd_json_index(j, "legal", count[DYD_LEGAL]);
  dyd_json_index(j, "indeterminate", count[DYD_INDETERMINATE]);
  dyd_json_index(j, "tie", count[DYD_TIE]);
  dyd_json_close(j, 1);
}

/* ---- sites ---- */

static bool same_words(const dyd_words *a, const dyd_words *b) {
  return a->man == b->man && a->den == b->den && a->exp == b->exp;
}

/* What dyd_json_sides writes, where the rectangle is of single words; else false, and nothing. */
static bool json_short_sides(dyd_json *j, const dyd_result *r, size_t i) {
  dyd_words end[4];
  char text[4][DYD_WORDS_SIZE], *stop[4];
  if (r->sphere || !dyd_sites_get_words(end, r->sites, i)) return false;
  for (int k = 0; k < 4; k++) {
    bool again = k & 1 && same_words(&end[k], &end[k - 1]);
    stop[k] = again ? stop[k - 1] - text[k - 1] + text[k] : dyd_words_put(text[k], &end[k]);
    if (!stop[k]) return false;
    if (again) memcpy(text[k], text[k - 1], DYD_WORDS_SIZE);
  }
  for (int k = 0; k < 4; k++) {
    if (k % 2 == 0) dyd_json_name(j, k ? "y" : "x");
    dyd_sink_text(&j->to, k & 1 ? "\", \"" : "[\"");
    dyd_sink_put(&j->to, text[k], (size_t)(stop[k] - text[k]));
    if (k & 1) dyd_sink_put(&j->to, "\"]", 2);
  }
  return true;
}

/* On a sphere nothing is counted. */
static void json_site(dyd_json *j, const dyd_result *r, uint32_t i, const dyd_site_row *row, dyd_rect *rect) {
  double box[4];
  dyd_json_object(j, NULL, DYD_JSON_FLAT);
  dyd_json_site(j, "i", r->engine, i);
  if (json_short_sides(j, r, i)) {
    dyd_sites_get_d(box, r->sites, i);
  } else if (dyd_json_good(j, r->sphere ? dyd_sphere_rect(rect, r->sphere, i) : dyd_sites_get(rect, r->sites, i))) {
    dyd_json_sides(j, rect);
    dyd_rect_get_d(box, rect);
  }
  if (j->st == DYD_OK) dyd_json_box(j, true, box);
  dyd_json_ids(j, r->engine, &i, 0);
  dyd_json_carried(j, r->engine, i);
  if (row) {
    dyd_json_index(j, "legal", row->partners[DYD_LEGAL]);
    dyd_json_index(j, "indeterminate", row->partners[DYD_INDETERMINATE]);
    dyd_json_index(j, "tie", row->partners[DYD_TIE]);
    dyd_json_word(j, "hull", row->hull);
  }
  dyd_json_close(j, 1);
}

static void json_sites(dyd_json *j, const dyd_result *r) {
  DYD_FREED dyd_site_row *rows = NULL;
  DYD_LOCAL(dyd_rect, rect);
  if (!r->sphere) dyd_json_good(j, dyd_result_sites(&rows, r));
  dyd_json_array(j, "sites", DYD_JSON_LIST);
  for (uint32_t i = 0; i < r->count && j->st == DYD_OK; i++) json_site(j, r, i, rows ? &rows[i] : NULL, &rect);
  dyd_json_close(j, 1);
}

/* ---- the triangulation ---- */

/* Ties as groups, each in the order of its circle or line. */
typedef struct json_groups {
  dyd_json *j;
  const dyd_engine *e;
} json_groups;

static dyd_status json_group(void *context, dyd_group_kind kind, const dyd_index_list *sites) {
  const json_groups *g = context;
  dyd_json_object(g->j, NULL, DYD_JSON_FLAT);
  dyd_json_word(g->j, "kind", dyd_group_text(kind));
  dyd_json_sites(g->j, "sites", g->e, sites);
  dyd_json_close(g->j, 1);
  return DYD_OK;
}

static void json_ties(dyd_json *j, const dyd_result *r) {
  json_groups g = {j, r->engine};
  dyd_json_array(j, "ties", DYD_JSON_LIST);
  dyd_json_good(j, dyd_delaunay_each_group(r->pd, json_group, &g));
  dyd_json_close(j, 1);
}

/* Only for a capped result: pairs within one of these faces may be possible without being listed. */
static void json_faces(dyd_json *j, const dyd_result *r) {
  DYD_SCOPED(dyd_index_list) face = {0};
  bool outer;
  if (!dyd_delaunay_is_capped(r->pd)) return;
  dyd_json_array(j, "faces", DYD_JSON_ROWS);
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(r->pd); f++) {
    if (!dyd_json_good(j, dyd_delaunay_face(&face, &outer, r->pd, f))) break;
    dyd_json_sites(j, NULL, r->engine, &face);
  }
  dyd_json_close(j, 1);
}

/* The hull: possible pairs as hull edges; "capped" when they are too many to be listed. */
static void json_hull(dyd_json *j, const dyd_result *r) {
  DYD_SCOPED(dyd_hull) hull = {0};
  dyd_status st = dyd_delaunay_partial_hull(&hull, r->pd, true);
  dyd_json_good(j, st == DYD_CAPPED ? DYD_OK : st);
  dyd_json_object(j, "hull", DYD_JSON_LINES);
  dyd_json_bool(j, "capped", st == DYD_CAPPED);
  dyd_json_sites(j, "sure_vertices", r->engine, &hull.sure_vertices);
  dyd_json_sites(j, "possible_vertices", r->engine, &hull.possible_vertices);
  dyd_json_pairs(j, "edges", r->engine, &hull.pairs);
  dyd_json_close(j, 1);
}

/* No bounds exist for a capped result: its pairs are not all known. */
static void json_bounds(dyd_json *j, const dyd_result *r) {
  DYD_LOCAL(dyd_dyadic, area, hausdorff);
  dyd_status st = dyd_engine_bounds(&area, &hausdorff, r->engine);
  if (st == DYD_OK) {
    dyd_json_object(j, "bounds", DYD_JSON_FLAT);
    dyd_json_bound(j, "area", &area);
    dyd_json_bound(j, "hausdorff", &hausdorff);
    dyd_json_close(j, 1);
  } else if (dyd_json_good(j, st == DYD_E_NOMEM ? st : DYD_OK)) {
    dyd_json_raw(j, "bounds", "null");
  }
}

static void json_head(dyd_json *j, const dyd_output *o, const dyd_result *r) {
  size_t count[4];
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, r->engine);
  dyd_json_head(j, r->sphere ? "dyadel sphere 1" : "dyadel delaunay 1", o);
  dyd_json_word(j, "rounding",
                r->sphere ? "x (longitude) and y (latitude) are degrees: exact where both ends are equal, else rounded "
                            "outward; x_decimal and y_decimal are rounded outward: the first down, the second up"
                          : "x, y and exact are exact; x_decimal and y_decimal are rounded outward: the first down, "
                            "the second up; decimal is rounded up; null is beyond the largest double");
  if (r->sphere) dyd_json_word(j, "surface", "sphere");
  dyd_json_word(j, "outcome", dyd_outcome_text(dyd_result_outcome(r)));
  dyd_json_confidence(j, r->engine);
  if (!r->sphere) dyd_json_word(j, "goal", dyd_goal_text(goal));
  if (!r->sphere && goal != DYD_GOAL_DECIDED) dyd_json_signed(j, "goal_bits", bits);
  dyd_json_bool(j, "capped", dyd_delaunay_is_capped(r->pd));
  dyd_result_count(count, r);
  json_count(j, r->count, count);
  if (r->sphere && dyd_sphere_centre(r->sphere) != DYD_NO_PLACE)
    dyd_json_site(j, "projected_from", r->engine, dyd_sphere_centre(r->sphere));
}

static dyd_status delaunay_json(const dyd_output *o) {
  const dyd_result *r = o->what;
  DYD_SCOPED(dyd_triangle_list) triangles = {0};
  dyd_json j;
  dyd_json_begin(&j, o->out);
  json_head(&j, o, r);
  if (!r->sphere) json_bounds(&j, r);
  if (j.st == DYD_OK) json_sites(&j, r);
  dyd_json_aliases(&j, r->engine, r->sphere);
  dyd_json_pairs(&j, "pairs", r->engine, &r->pairs);
  if (!r->sphere && j.st == DYD_OK) json_ties(&j, r);
  if (!r->sphere && j.st == DYD_OK) json_faces(&j, r);
  dyd_json_good(&j, dyd_result_triangles(&triangles, r));
  dyd_json_triangles(&j, r->engine, &triangles);
  if (!r->sphere && j.st == DYD_OK) json_hull(&j, r);
  dyd_json_counters(&j, r->sphere ? dyd_sphere_images(r->sphere) : r->engine);
  return dyd_json_end(&j, "\n}\n");
}

/* ---- cells ---- */

static void polygon_json(dyd_json *j, const char *name, const dyd_polygon *p) {
  dyd_json_array(j, name, DYD_JSON_FLAT);
  for (size_t k = 0; k < p->count && j->st == DYD_OK; k++) {
    dyd_json_array(j, NULL, DYD_JSON_FLAT);
    dyd_json_dyadic(j, NULL, &p->vertex[k].x);
    dyd_json_dyadic(j, NULL, &p->vertex[k].y);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
}

/* Area and rounding of an exact cell. */
static void exact_json(dyd_json *j, const dyd_diagram *d, uint32_t i, const dyd_cell_row *row) {
  bool exact = false;
  if (!row->exact) return;
  DYD_LOCAL_NUMBERS(mpq, area);
  if (dyd_json_good(j, dyd_voronoi_exact_area(area, &exact, d->pd, i, &d->window)) && exact) {
    dyd_json_rational(j, "exact_area", area);
    dyd_json_decimal(j, "vertex_error", row->rounding, DYD_UP);
  }
}

static void polygons_json(dyd_json *j, const dyd_shape *shape) {
  DYD_SCOPED(dyd_polygon) inner = {0};
  DYD_SCOPED(dyd_polygon_list) outer = {0};
  if (dyd_json_good(j, dyd_shape_inner(&inner, shape))) dyd_json_good(j, dyd_shape_outer(&outer, shape));
  polygon_json(j, "inner", &inner);
  dyd_json_break(j, ",\n");
  dyd_json_array(j, "outer", DYD_JSON_LINES);
  for (size_t k = 0; k < outer.count; k++) polygon_json(j, NULL, &outer.item[k]);
  dyd_json_close(j, 1);
}

typedef struct diagram_json {
  const dyd_diagram *d;
  dyd_json j;
  dyd_point_texts texts;
} diagram_json;

static void region_boundary_json(diagram_json *c, uint32_t i, bool outer) {
  DYD_SCOPED(dyd_boundary) boundary = {0};
  const char *name = outer ? "pos" : "int";
  dyd_status st = dyd_cell_region(&boundary, c->d->pd, i, outer, true, NULL, c->d->memory, c->d->cancel);
  dyd_json_break(&c->j, ",\n");
  if (st == DYD_CANCELLED)
    dyd_json_raw(&c->j, name, "null");
  else if (dyd_json_good(&c->j, st))
    dyd_json_boundary(&c->j, name, &boundary, &c->texts);
}

static dyd_status cell_json(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  diagram_json *c = context;
  dyd_json *j = &c->j;
  dyd_json_object(j, NULL, DYD_JSON_FLAT);
  dyd_json_site(j, "i", c->d->engine, i);
  dyd_json_ids(j, c->d->engine, &i, 0);
  dyd_json_carried(j, c->d->engine, i);
  dyd_json_decimals(j, "area", row->area[0], row->area[1]);
  dyd_json_decimal(j, "undetermined", dyd_cell_undetermined(row), DYD_UP);
  dyd_json_box(j, false, row->present ? row->box : NULL);
  dyd_json_break(j, ",\n");
  exact_json(j, c->d, i, row);
  if (j->st == DYD_OK) polygons_json(j, shape);
  for (int outer = 0; outer < 2 && j->st == DYD_OK && !c->d->discs; outer++) region_boundary_json(c, i, outer);
  dyd_json_close(j, 1);
  return j->st;
}

/* ---- vertices, edges, regions ---- */

static void exact_box_json(dyd_json *j, const dyd_diagram *d, size_t k) {
  char *text[4];
  if (dyd_json_good(j, dyd_diagram_vertex(text, d, k)))
    for (int m = 0; m < 4; m++) {
      if (m % 2 == 0) dyd_json_array(j, m ? "y_exact" : "x_exact", DYD_JSON_FLAT);
      dyd_json_word(j, NULL, text[m]);
      if (m & 1) dyd_json_close(j, 1);
    }
  for (int m = 0; m < 4; m++) free(text[m]);
}

static void vertices_json(dyd_json *j, const dyd_diagram *d) {
  dyd_json_array(j, "vertices", DYD_JSON_LIST);
  for (size_t k = 0; k < dyd_diagram_vertices(d) && j->st == DYD_OK; k++) {
    DYD_SCOPED(dyd_index_list) sites = {0};
    dyd_json_good(j, dyd_diagram_vertex_sites(&sites, d, k));
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_sites(j, "sites", d->engine, &sites);
    dyd_json_box(j, false, d->vertex[k]);
    if (j->st == DYD_OK) exact_box_json(j, d, k);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
}

static void dual_end_json(dyd_json *j, const char *name, const dyd_dual_end *end) {
  if (end->kind == DYD_DUAL_VERTEX) {
    dyd_json_index(j, name, end->vertex);
  } else if (end->kind == DYD_DUAL_RAY) {
    dyd_json_object(j, name, DYD_JSON_FLAT);
    dyd_json_object(j, "ray", DYD_JSON_FLAT);
    dyd_json_box(j, false, end->direction);
    dyd_json_close(j, 2);
  } else {
    dyd_json_raw(j, name, "null");
  }
}

static void dual_edges_json(dyd_json *j, const dyd_diagram *d) {
  DYD_FREED dyd_dual_edge *edge = NULL;
  size_t count = 0;
  dyd_json_good(j, dyd_diagram_edges(&edge, &count, d));
  dyd_json_array(j, "edges", DYD_JSON_LIST);
  for (size_t k = 0; k < count; k++) {
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_site(j, "i", d->engine, edge[k].i);
    dyd_json_site(j, "j", d->engine, edge[k].j);
    dual_end_json(j, "from", &edge[k].end[0]);
    dual_end_json(j, "to", &edge[k].end[1]);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
}

static dyd_status region_json(void *context, size_t face, const double box[4]) {
  diagram_json *c = context;
  DYD_SCOPED(dyd_index_list) sites = {0};
  bool outer;
  dyd_status st = dyd_delaunay_face(&sites, &outer, c->d->pd, face);
  dyd_json_object(&c->j, NULL, DYD_JSON_FLAT);
  dyd_json_sites(&c->j, "sites", c->d->engine, &sites);
  dyd_json_box(&c->j, false, box);
  dyd_json_close(&c->j, 1);
  return st;
}

/* ---- the diagram ---- */

static void diagram_head_json(dyd_json *j, const dyd_output *o, const char *format, const char *rounding) {
  const dyd_diagram *d = o->what;
  size_t count[4];
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, d->engine);
  dyd_pairs_count(count, d->discs, d->pd);
  dyd_json_head(j, format, o);
  dyd_json_word(j, "rounding", rounding);
  dyd_json_word(j, "outcome", dyd_outcome_text(dyd_engine_outcome(d->engine)));
  dyd_json_confidence(j, d->engine);
  dyd_json_word(j, "goal", dyd_goal_text(goal));
  dyd_json_signed(j, "goal_bits", bits);
  dyd_json_signed(j, "flatten_bits", d->bits);
  json_count(j, d->count, count);
  if (d->discs) dyd_json_raw(j, "discs", "true");
  dyd_json_rect(j, "window", &d->window);
  dyd_json_aliases(j, d->engine, NULL);
}

static dyd_status voronoi_json(const dyd_output *o) {
  const dyd_diagram *d = o->what;
  diagram_json c = {.d = d, .texts = {.engine = d->engine}};
  dyd_json *j = &c.j;
  dyd_json_begin(j, o->out);
  diagram_head_json(j, o, "dyadel voronoi 1",
                    "texts are exact numbers; pairs of numbers are rounded outward: the first down, the second up; "
                    "null is unbounded or beyond the largest double; inner and outer of a cell with vertex_error are "
                    "that cell, with vertices rounded by at most vertex_error in each coordinate");
  dyd_json_array(j, "cells", DYD_JSON_LIST);
  if (j->st == DYD_OK) dyd_json_good(j, dyd_diagram_visit(d, cell_json, &c));
  dyd_point_texts_clear(&c.texts);
  dyd_json_close(j, 1);
  if (j->st == DYD_OK) vertices_json(j, d);
  if (j->st == DYD_OK) dual_edges_json(j, d);
  dyd_json_array(j, "regions", DYD_JSON_LIST);
  if (j->st == DYD_OK) dyd_json_good(j, dyd_diagram_regions(d, region_json, &c));
  dyd_json_close(j, 1);
  dyd_json_object(j, "bounds", DYD_JSON_FLAT);
  dyd_json_bound(j, "undetermined_area", &d->bounds->area);
  dyd_json_bound(j, "distance_to_true_diagram", d->bounds->finite ? &d->bounds->hausdorff : NULL);
  dyd_json_close(j, 1);
  return dyd_json_end(j, "\n}\n");
}

/* ---- tiles ---- */

static void rings_json(dyd_json *j, const dyd_tiles *t, size_t r, size_t end) {
  char text[DYD_DECIMAL_SIZE];
  double error;
  dyd_json_array(j, "rings", DYD_JSON_FLAT);
  for (; r < end; r++) {
    dyd_json_array(j, NULL, DYD_JSON_FLAT);
    for (size_t k = 2 * t->offset[r]; k < 2 * t->offset[r + 1]; k++) {
      if (k % 2 == 0) dyd_json_array(j, NULL, DYD_JSON_FLAT);
      dyd_decimal_within(text, &error, t->xy[k], t->xy[k]);
      dyd_json_raw(j, NULL, text);
      if (k % 2) dyd_json_close(j, 1);
    }
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
}

static dyd_status tiles_json(const dyd_output *o) {
  const dyd_diagram *d = o->what;
  DYD_SCOPED(dyd_tiles) t = {0};
  dyd_json j;
  dyd_status st = dyd_diagram_tiles(&t, d, false, o->err);
  dyd_json_begin(&j, o->out);
  diagram_head_json(&j, o, "dyadel tiles 1",
                    "tile_area is rounded up, area (of the cell for every choice) outward; rings are doubles, from the "
                    "true polygon of one choice by at most vertex_error in each coordinate, holes clockwise; null is "
                    "beyond the largest double");
  dyd_json_decimal(&j, "vertex_error", t.rounding, DYD_UP);
  dyd_json_array(&j, "tiles", DYD_JSON_LIST);
  for (size_t r = 0, end = 0; r < t.count && j.st == DYD_OK && st == DYD_OK; r = end) {
    dyd_json_object(&j, NULL, DYD_JSON_FLAT);
    dyd_json_site(&j, "i", d->engine, t.site[r]);
    dyd_json_ids(&j, d->engine, &t.site[r], 0);
    dyd_json_carried(&j, d->engine, t.site[r]);
    dyd_json_decimal(&j, "tile_area", dyd_diagram_tile(&end, d, &t), DYD_UP);
    dyd_json_decimals(&j, "area", t.bound[2 * r], t.bound[2 * r + 1]);
    rings_json(&j, &t, r, end);
    dyd_json_close(&j, 1);
  }
  dyd_json_close(&j, 1);
  dyd_status written = dyd_json_end(&j, "\n}\n");
  return st == DYD_OK ? written : st;
}

/* ---- the diagram of a sphere ---- */

static void globe_cells_json(dyd_json *j, const dyd_result *r, const dyd_sphere_cells *c) {
  dyd_json_array(j, "cells", DYD_JSON_LIST);
  for (uint32_t i = 0; i < c->places; i++) {
    if (dyd_sphere_alias(r->sphere, i) != i) continue;
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_site(j, "i", r->engine, i);
    dyd_json_ids(j, r->engine, &i, 0);
    dyd_json_carried(j, r->engine, i);
    dyd_json_bool(j, "complete", c->closed[i]);
    dyd_json_array(j, "vertices", DYD_JSON_FLAT);
    for (size_t k = c->first[i]; k < c->first[i + 1]; k++) {
      if (c->gap[k]) dyd_json_raw(j, NULL, "null");
      dyd_json_index(j, NULL, c->of[k]);
    }
    dyd_json_close(j, 2);
  }
  dyd_json_close(j, 1);
}

static void globe_regions_json(dyd_json *j, const dyd_result *r) {
  DYD_SCOPED(dyd_index_list) sites = {0};
  bool tie;
  dyd_json_array(j, "regions", DYD_JSON_LIST);
  for (size_t f = 0; f < dyd_sphere_faces(r->sphere); f++) {
    if (!dyd_json_good(j, dyd_sphere_face(&sites, &tie, r->sphere, f))) break;
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_index(j, "face", f);
    dyd_json_word(j, "status", tie ? "tie" : "indeterminate");
    dyd_json_sites(j, "sites", r->engine, &sites);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
}

static void globe_diagram_json(dyd_json *j, const dyd_output *o, const dyd_sphere_cells *c) {
  const dyd_result *r = o->what;
  dyd_json_head(j, "dyadel sphere voronoi 1", o);
  dyd_json_word(j, "rounding",
                "x (longitude) and y (latitude) are degrees, rounded outward: the first down, the second up; null "
                "among the vertices of a cell: an undecided region is next");
  dyd_json_word(j, "surface", "sphere");
  dyd_json_word(j, "outcome", dyd_outcome_text(dyd_result_outcome(r)));
  dyd_json_confidence(j, r->engine);
  dyd_json_array(j, "vertices", DYD_JSON_LIST);
  for (size_t k = 0; k < c->nodes; k++) {
    static const char *const name[3] = {"i", "j", "k"};
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    for (int l = 0; l < 3; l++) dyd_json_site(j, name[l], r->engine, c->node[k].of.v[l]);
    dyd_json_box(j, false, c->node[k].box);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
  globe_cells_json(j, r, c);
  globe_regions_json(j, r);
  dyd_json_aliases(j, r->engine, r->sphere);
  dyd_json_counters(j, dyd_sphere_images(r->sphere));
}

static dyd_status globe_voronoi_json(const dyd_output *o) {
  const dyd_result *r = o->what;
  DYD_SCOPED(dyd_sphere_cells) c = {0};
  dyd_json j;
  dyd_status st = dyd_sphere_cells_find(&c, r->sphere, o->err);
  if (st == DYD_OK) {
    dyd_json_begin(&j, o->out);
    globe_diagram_json(&j, o, &c);
    st = dyd_json_end(&j, "\n}\n");
  }
  return st;
}

/* ---- tolerances ---- */

static void site_or_null_json(dyd_json *j, const char *name, const dyd_engine *e, uint32_t k) {
  if (k == DYD_NO_SITE)
    dyd_json_raw(j, name, "null");
  else
    dyd_json_site(j, name, e, k);
}

/* "exact": the squares under both roots of 2 t = |sqrt(plus) - sqrt(minus)|. */
static void event_json(dyd_json *j, const dyd_result *r, size_t number, const dyd_tolerance_row *row, mpq_t q[2]) {
  const double *chance = dyd_tolerance_get(r->tolerance)->chances;
  dyd_json_object(j, NULL, DYD_JSON_FLAT);
  dyd_json_site(j, "i", r->engine, row->i);
  dyd_json_site(j, "j", r->engine, row->j);
  dyd_json_word(j, "event", dyd_tolerance_event_text(row->event));
  dyd_json_decimals(j, "bounds", row->lo, row->hi);
  site_or_null_json(j, "k", r->engine, row->k);
  site_or_null_json(j, "l", r->engine, row->l);
  if (chance) dyd_json_decimal(j, "probability", chance[number], DYD_DOWN);
  dyd_status st = dyd_tolerance_exact(q[0], q[1], r->tolerance, number);
  if (st == DYD_OK) {
    dyd_json_rational(j, "plus", q[0]);
    dyd_json_rational(j, "minus", q[1]);
  } else if (st != DYD_E_ARG) { /* which is: there is no exact form */
    dyd_json_good(j, st);
  }
  dyd_json_close(j, 1);
}

static void events_json(dyd_json *j, const dyd_result *r) {
  const dyd_tolerance_row *row;
  size_t rows = dyd_tolerance_rows(&row, r->tolerance);
  mpq_t q[2];
  mpq_inits(q[0], q[1], NULL);
  dyd_json_array(j, "pairs", DYD_JSON_LIST);
  for (size_t k = 0; k < rows && j->st == DYD_OK; k++) event_json(j, r, k, &row[k], q);
  dyd_json_close(j, 1);
  mpq_clears(q[0], q[1], NULL);
}

static void missing_json(dyd_json *j, const dyd_tolerance *t) {
  size_t edges, births;
  if (!dyd_tolerance_is_cut(&edges, &births, t)) return;
  dyd_json_object(j, "without_row", DYD_JSON_FLAT);
  dyd_json_index(j, "edges", edges);
  if (births == SIZE_MAX)
    dyd_json_raw(j, "births", "null");
  else
    dyd_json_index(j, "births", births);
  dyd_json_close(j, 1);
}

static dyd_status tolerance_json(const dyd_output *o) {
  const dyd_result *r = o->what;
  const double *radius = dyd_tolerance_get(r->tolerance)->points;
  bool box = dyd_tolerance_get(r->tolerance)->metric == DYD_METRIC_BOX;
  double lo, hi;
  dyd_json j;
  dyd_json_begin(&j, o->out);
  dyd_json_head(&j, "dyadel tolerance 1", o);
  if (box) dyd_json_word(&j, "metric", "box");
  dyd_json_word(&j, "rounding",
                box ? "bounds are rounded outward: the first down, the second up, null is infinite; rho and "
                      "probability are rounded down"
                    : "bounds are rounded outward: the first down, the second up, null is infinite; twice the event is "
                      "exactly |sqrt(plus) - sqrt(minus)|; rho and probability are rounded down");
  lo = dyd_tolerance_get(r->tolerance)->lo, hi = dyd_tolerance_get(r->tolerance)->hi;
  dyd_json_decimals(&j, "tolerance", lo, hi);
  missing_json(&j, r->tolerance);
  events_json(&j, r);
  dyd_json_array(&j, "rho", DYD_JSON_FLAT);
  for (size_t i = 0; radius && i < r->count; i++) {
    if (i && i % 8 == 0) dyd_json_break(&j, ",\n");
    dyd_json_decimal(&j, NULL, radius[i], DYD_DOWN);
  }
  dyd_json_close(&j, 1);
  dyd_json_aliases(&j, r->engine, NULL);
  return dyd_json_end(&j, "}\n");
}

/* ---- plans ---- */

static void plan_rows_json(dyd_json *j, const dyd_result *r) {
  const dyd_survey_row *row;
  const size_t rows = dyd_survey_rows(&row, r->survey);
  char text[DYD_DECIMAL_SIZE];
  double error;
  dyd_json_array(j, "points", DYD_JSON_LIST);
  for (size_t k = 0; k < rows && (k == 0 || !r->next); k++) {
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_index(j, "rank", k + 1);
    dyd_json_site(j, "i", r->engine, row[k].site);
    dyd_json_decimal(j, "half_width_now", row[k].now, DYD_UP);
    dyd_decimal_within(text, &error, row[k].needed, row[k].needed);
    dyd_json_raw(j, "half_width_needed", text);
    dyd_json_index(j, "pairs_decided", row[k].decided);
    dyd_json_index(j, "pairs_left", row[k].left);
    dyd_json_ids(j, r->engine, &row[k].site, 0);
    dyd_json_carried(j, r->engine, row[k].site);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
}

static void plan_pairs_json(dyd_json *j, const dyd_result *r) {
  const dyd_survey_pair *pair;
  const size_t pairs = dyd_survey_pairs(&pair, r->survey);
  dyd_json_array(j, "pairs", DYD_JSON_LIST);
  for (size_t k = 0; k < pairs; k++) {
    dyd_json_object(j, NULL, DYD_JSON_FLAT);
    dyd_json_site(j, "i", r->engine, pair[k].i);
    dyd_json_site(j, "j", r->engine, pair[k].j);
    if (pair[k].row == SIZE_MAX)
      dyd_json_raw(j, "rank", "null");
    else
      dyd_json_index(j, "rank", pair[k].row + 1);
    dyd_json_close(j, 1);
  }
  dyd_json_close(j, 1);
}

static dyd_status plan_json(const dyd_output *o) {
  const dyd_result *r = o->what;
  const dyd_survey_result *of = dyd_survey_get(r->survey);
  dyd_json j;
  dyd_json_begin(&j, o->out);
  dyd_json_head(&j, "dyadel plan 1", o);
  dyd_json_word(&j, "unit", r->sphere ? "metres" : "coordinates");
  dyd_json_bool(&j, "finished", !of->cut);
  dyd_json_index(&j, "undecided", of->open);
  dyd_json_index(&j, "ties", of->ties);
  dyd_json_index(&j, "left", of->left);
  plan_rows_json(&j, r);
  plan_pairs_json(&j, r);
  dyd_json_aliases(&j, r->engine, r->sphere);
  return dyd_json_end(&j, "}\n");
}

static dyd_status trials_json(const dyd_output *o) {
  const dyd_trials_output *of = o->what;
  dyd_json j;
  dyd_json_begin(&j, o->out);
  dyd_json_head(&j, "dyadel trials 1", o);
  dyd_json_index(&j, "seed", of->seed);
  dyd_json_index(&j, "asked", of->count);
  dyd_json_array(&j, "trials", DYD_JSON_LIST);
  for (size_t k = 0; k < of->count; k++) {
    const dyd_survey_trial *one = &of->trial[k];
    if (!one->done) continue;
    dyd_json_object(&j, NULL, DYD_JSON_FLAT);
    dyd_json_index(&j, "trial", k);
    dyd_json_index(&j, "rounds", one->rounds);
    dyd_json_index(&j, "points", one->points);
    dyd_json_index(&j, "measurements", one->measurements);
    dyd_json_index(&j, "pairs_left", one->left);
    dyd_json_close(&j, 1);
  }
  dyd_json_close(&j, 1);
  return dyd_json_end(&j, "}\n");
}

dyd_writer *const dyd_json_writers[DYD_CONTENTS] = {[DYD_CONTENT_PLAN] = plan_json,
                                                    [DYD_CONTENT_TRIALS] = trials_json,
                                                    [DYD_CONTENT_DELAUNAY] = delaunay_json,
                                                    [DYD_CONTENT_VORONOI] = voronoi_json,
                                                    [DYD_CONTENT_TILES] = tiles_json,
                                                    [DYD_CONTENT_CONVERGENCE] = dyd_convergence_json,
                                                    [DYD_CONTENT_CHECK] = dyd_check_json,
                                                    [DYD_CONTENT_DISC] = dyd_disc_json,
                                                    [DYD_CONTENT_BISECTOR] = dyd_bisector_json,
                                                    [DYD_CONTENT_NEAREST] = dyd_nearest_json,
                                                    [DYD_CONTENT_PLACES] = dyd_nearest_json,
                                                    [DYD_CONTENT_TOLERANCE] = tolerance_json,
                                                    [DYD_CONTENT_SPHERE] = delaunay_json,
                                                    [DYD_CONTENT_SPHERE_VORONOI] = globe_voronoi_json};
