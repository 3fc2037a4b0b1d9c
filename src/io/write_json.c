/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The json format. Of the triangulation everything the engine states, written piece by piece so that memory stays
 * small. */
#include "io/label_text.h"
#include "io/parts.h"
#include "io/result.h"
#include <dyadel/voronoi.h>
#include <inttypes.h>
#include <stdlib.h>

static bool same_words(const dyd_words *a, const dyd_words *b) {
  return a->man == b->man && a->den == b->den && a->exp == b->exp;
}

/* What dyd_json_sides writes, where the rectangle is of single words; else false, and nothing. */
static bool json_short_sides(dyd_sink *s, const dyd_result *r, size_t i) {
  static const char *const before[4] = {"\"x\": [\"", "\", \"", "\"], \"y\": [\"", "\", \""};
  dyd_words end[4];
  char text[4][DYD_WORDS_SIZE], *stop[4];
  if (!dyd_sites_get_words(end, r->sites, i)) return false;
  for (int k = 0; k < 4; k++) {
    bool again = k & 1 && same_words(&end[k], &end[k - 1]);
    stop[k] = again ? stop[k - 1] - text[k - 1] + text[k] : dyd_words_put(text[k], &end[k]);
    if (!stop[k]) return false;
    if (again) memcpy(text[k], text[k - 1], DYD_WORDS_SIZE);
  }
  for (int k = 0; k < 4; k++) {
    dyd_sink_text(s, before[k]);
    dyd_sink_put(s, text[k], (size_t)(stop[k] - text[k]));
  }
  dyd_sink_text(s, "\"]");
  return true;
}

static dyd_status json_sides_of(dyd_sink *s, const dyd_result *r, size_t i, dyd_rect *rect) {
  if (json_short_sides(s, r, i)) return DYD_OK;
  dyd_status st = dyd_sites_get(rect, r->sites, i);
  dyd_sink_flush(s);
  return st == DYD_OK ? dyd_json_sides(r->out, rect, ", ") : st;
}

static dyd_status json_site(dyd_sink *s, const dyd_result *r, size_t i, const dyd_site_row *row, dyd_rect *rect) {
  double box[4];
  dyd_sites_get_d(box, r->sites, i);
  dyd_sink_text(s, i ? ",\n{\"i\": " : "\n{\"i\": ");
  dyd_sink_index(s, dyd_engine_row(r->engine, i));
  dyd_sink_text(s, ", ");
  dyd_status st = json_sides_of(s, r, i, rect);
  dyd_sink_text(s, ", ");
  dyd_sink_json_box(s, "_decimal", box);
  dyd_sink_json_ids(s, r->engine, &(const uint32_t){(uint32_t)i}, 0);
  dyd_sink_text(s, ", \"legal\": ");
  dyd_sink_index(s, row->partners[DYD_LEGAL]);
  dyd_sink_text(s, ", \"indeterminate\": ");
  dyd_sink_index(s, row->partners[DYD_INDETERMINATE]);
  dyd_sink_text(s, ", \"tie\": ");
  dyd_sink_index(s, row->partners[DYD_TIE]);
  dyd_sink_text(s, ", \"hull\": \"");
  dyd_sink_text(s, row->hull);
  dyd_sink_text(s, "\"}");
  return st;
}

static dyd_status json_sites(const dyd_result *r) {
  dyd_sink s;
  dyd_rect rect;
  dyd_site_row *rows = NULL;
  dyd_rect_init(&rect);
  dyd_status st = dyd_result_sites(&rows, r);
  dyd_sink_begin(&s, r->out);
  dyd_sink_text(&s, "\"sites\": [");
  for (size_t i = 0; i < r->count && st == DYD_OK; i++) st = json_site(&s, r, i, &rows[i], &rect);
  free(rows);
  dyd_sink_text(&s, "\n],\n");
  dyd_sink_flush(&s);
  dyd_json_aliases(r->out, r->engine, ",\n");
  dyd_rect_clear(&rect);
  return st;
}

static dyd_status json_triangles(const dyd_result *r) {
  dyd_triangle_list list = {0};
  dyd_status st = dyd_delaunay_triangles(&list, r->pd);
  dyd_json_triangles(r->out, r->engine, &list);
  dyd_triangle_list_clear(&list);
  return st;
}

typedef struct json_groups {
  const dyd_result *r;
  bool any;
} json_groups;

static dyd_status json_group(void *context, dyd_group_kind kind, const dyd_index_list *sites) {
  json_groups *g = context;
  fprintf(g->r->out, "%s\n{\"kind\": \"%s\", \"sites\": [", g->any ? "," : "", dyd_group_text(kind));
  dyd_put_rows(g->r->out, g->r->engine, sites, ", ");
  fputs("]}", g->r->out);
  g->any = true;
  return DYD_OK;
}

/* Ties as groups, each in the order of its circle or line. */
static dyd_status json_ties(const dyd_result *r) {
  json_groups g = {r, false};
  fputs("\"ties\": [", r->out);
  dyd_status st = dyd_delaunay_each_group(r->pd, json_group, &g);
  fputs("\n],\n", r->out);
  return st;
}

/* The hull: possible pairs as hull edges; "capped" when they are too many to be listed. */
static dyd_status json_hull(const dyd_result *r) {
  dyd_hull hull = {0};
  dyd_status st = dyd_delaunay_partial_hull(&hull, r->pd);
  bool capped = st == DYD_CAPPED;
  if (capped) st = DYD_OK;
  fprintf(r->out, "\"hull\": {\"capped\": %s,\n\"sure_vertices\": [", capped ? "true" : "false");
  dyd_put_rows(r->out, r->engine, &hull.sure_vertices, ", ");
  fputs("],\n\"possible_vertices\": [", r->out);
  dyd_put_rows(r->out, r->engine, &hull.possible_vertices, ", ");
  fputs("],\n", r->out);
  dyd_json_pairs(r->out, r->engine, "edges", &hull.pairs);
  fputs("},\n", r->out);
  dyd_hull_clear(&hull);
  return st;
}

/* No bounds exist for a capped result: its pairs are not all known. */
static dyd_status json_bounds(const dyd_result *r) {
  dyd_dyadic area, hausdorff;
  dyd_dyadic_init(&area);
  dyd_dyadic_init(&hausdorff);
  dyd_status st = dyd_engine_bounds(&area, &hausdorff, r->engine);
  bool known = st == DYD_OK;
  if (st != DYD_E_NOMEM) st = DYD_OK;
  fputs(known ? "\"bounds\": {" : "\"bounds\": null,\n", r->out);
  if (known) {
    st = dyd_json_bound(r->out, "area", &area);
    fputs(", ", r->out);
    if (st == DYD_OK) st = dyd_json_bound(r->out, "hausdorff", &hausdorff);
    fputs("},\n", r->out);
  }
  dyd_dyadic_clear(&area);
  dyd_dyadic_clear(&hausdorff);
  return st;
}

static void json_head(const dyd_result *r) {
  size_t count[4];
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, r->engine);
  dyd_delaunay_count(count, r->pd);
  dyd_json_head(r->out, "dyadel delaunay 1");
  dyd_json_crs(r->out, r->epsg);
  fprintf(r->out,
          "\"rounding\": \"x, y and exact are exact; x_decimal and y_decimal are rounded outward: the first down, the "
          "second up; decimal is rounded up; null is beyond the largest double\",\n"
          "\"outcome\": \"%s\",\n\"goal\": \"%s\",\n",
          dyd_outcome_text(dyd_engine_outcome(r->engine)), dyd_goal_text(goal));
  if (goal != DYD_GOAL_DECIDED) fprintf(r->out, "\"goal_bits\": %" PRId64 ",\n", bits);
  fprintf(r->out,
          "\"capped\": %s,\n\"count\": {\"sites\": %zu, \"legal\": %zu, \"indeterminate\": %zu, \"tie\": %zu},\n",
          dyd_delaunay_is_capped(r->pd) ? "true" : "false", r->count, count[DYD_LEGAL], count[DYD_INDETERMINATE],
          count[DYD_TIE]);
}

/* Only for a capped result: pairs within one of these faces may be possible without being listed. */
static dyd_status json_faces(const dyd_result *r) {
  if (!dyd_delaunay_is_capped(r->pd)) return DYD_OK;
  fputs("\"faces\": [", r->out);
  dyd_status st = dyd_result_faces(r, "\n[", ",\n[", ", ", "]");
  fputs("],\n", r->out);
  return st;
}

static dyd_status json_delaunay(const dyd_output *o) {
  const dyd_result *r = o->what;
  json_head(r);
  dyd_status st = json_bounds(r);
  if (st == DYD_OK) st = json_sites(r);
  dyd_json_pairs(r->out, r->engine, "pairs", &r->pairs);
  fputs(",\n", r->out);
  if (st == DYD_OK) st = json_ties(r);
  if (st == DYD_OK) st = json_faces(r);
  if (st == DYD_OK) st = json_triangles(r);
  if (st == DYD_OK) st = json_hull(r);
  dyd_json_counters(r->out, r->engine);
  fputs("}\n", r->out);
  return st;
}

dyd_writer *const dyd_json_writers[DYD_CONTENTS] = {[DYD_CONTENT_DELAUNAY] = json_delaunay,
                                                    [DYD_CONTENT_VORONOI] = dyd_voronoi_json,
                                                    [DYD_CONTENT_CONVERGENCE] = dyd_convergence_json,
                                                    [DYD_CONTENT_CHECK] = dyd_check_json,
                                                    [DYD_CONTENT_DISC] = dyd_disc_json,
                                                    [DYD_CONTENT_BISECTOR] = dyd_bisector_json,
                                                    [DYD_CONTENT_NEAREST] = dyd_nearest_json,
                                                    [DYD_CONTENT_PLACES] = dyd_places_json,
                                                    [DYD_CONTENT_TOLERANCE] = dyd_tolerance_json,
                                                    [DYD_CONTENT_SPHERE] = dyd_sphere_json,
                                                    [DYD_CONTENT_SPHERE_VORONOI] = dyd_sphere_voronoi_json};
