/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The writers of the library: each makes what is to be written ready, and the table of formats does the rest. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "delaunay/memory.h"
#include "format/table.h"
#include "io/diagram.h"
#include "io/result.h"
#include <inttypes.h>
#include <string.h>

/* The result of e; NULL with *err filled when there is none. */
static const dyd_delaunay *result_of(const dyd_engine *e, dyd_error *err) {
  if (err) dyd_error_clear(err);
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  if (!pd) dyd_fail(err, DYD_E_ARG, "there is no result yet");
  return pd;
}

static void result_sites(dyd_result *r) {
  r->sites = dyd_delaunay_sites(r->pd);
  r->count = dyd_sites_count(r->sites);
}

dyd_status dyd_write_delaunay(FILE *out, const dyd_engine *e, dyd_format format, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  return dyd_write_delaunay_window(out, e, NULL, format, err);
}

dyd_status dyd_write_delaunay_window(FILE *out, const dyd_engine *e, const dyd_rect *window, dyd_format format,
                                     dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  const dyd_delaunay_output o = {DYD_SIZED(dyd_delaunay_output), .window = window};
  return dyd_write_delaunay_as(out, e, &o, format, err);
}

/* What is written: the layer asked for, which is one of `of`. */
static dyd_content layer_of(dyd_content layer, dyd_content of) {
  return layer == DYD_CONTENT_NONE ? of : layer;
}

static dyd_status refuse_layer(dyd_content layer, dyd_content of, dyd_error *err) {
  dyd_content found;
  for (size_t k = 0; dyd_layer_name(of, k); k++)
    if (dyd_layer_from_name(&found, of, dyd_layer_name(of, k)) && found == layer_of(layer, of)) return DYD_OK;
  return dyd_fail(err, DYD_E_ARG, "content number %d is no layer of this", (int)layer);
}

static const struct {
  dyd_content layer;
  dyd_graph graph;
  const char *name;
} graph_layers[] = {{DYD_CONTENT_GRAPH_NEAREST, DYD_GRAPH_NEAREST, "nearest neighbours"},
                    {DYD_CONTENT_GRAPH_GABRIEL, DYD_GRAPH_GABRIEL, "Gabriel graph"},
                    {DYD_CONTENT_GRAPH_MST, DYD_GRAPH_MST, "minimum spanning tree"}};
enum { GRAPH_LAYERS = sizeof graph_layers / sizeof *graph_layers };

/* The edges as pairs, for pictures: each once, legal where it is sure, from one end at least. */
static dyd_status pairs_of_graph(dyd_result *r) {
  dyd_pair *item = dyd_alloc(r->graph.count, sizeof *item);
  if (!item) return DYD_E_NOMEM;
  r->pairs = (dyd_pair_list){0, item};
  for (size_t k = 0; k < r->graph.count; k++) {
    const dyd_graph_edge *e = &r->graph.item[k], back = {e->j, e->i, false};
    const dyd_graph_edge *same = bsearch(&back, r->graph.item, r->graph.count, sizeof back, dyd_compare_two);
    if (same && e->i > e->j) continue;
    bool sure = e->sure || (same && same->sure);
    item[r->pairs.count++] =
        (dyd_pair){e->i < e->j ? e->i : e->j, e->i < e->j ? e->j : e->i, sure ? DYD_LEGAL : DYD_INDETERMINATE};
  }
  return DYD_OK;
}

/* What is written in place of the pairs, if the layer is a graph. */
static dyd_status result_graph(bool *graph, dyd_result *r, const dyd_delaunay_output *o, dyd_error *err) {
  size_t k = 0;
  while (k < GRAPH_LAYERS && graph_layers[k].layer != o->layer) k++;
  *graph = k < GRAPH_LAYERS;
  if (!*graph) return DYD_OK;
  r->graph_name = graph_layers[k].name;
  dyd_status st = dyd_graph_edges(&r->graph, r->pd, graph_layers[k].graph, o->cancel, err);
  return st == DYD_OK ? pairs_of_graph(r) : st;
}

/* May what an output takes be made? pairs: those to be written; NULL: all. */
static dyd_status grant_output(const dyd_delaunay *pd, dyd_format format, bool diagram, const dyd_pair_list *pairs,
                               dyd_pair_status least, dyd_error *err) {
  if (!dyd_delaunay_is_bounded(pd)) return DYD_OK;
  uint64_t count = pairs ? pairs->count : dyd_pairs_bytes(pd, least) / sizeof(dyd_pair);
  uint64_t bytes = dyd_format_bytes(format, diagram, dyd_sites_count(dyd_delaunay_sites(pd)), count);
  return dyd_delaunay_grant(pd, bytes, "this output", err);
}

/* Graphs, and other formats, tell of more than what discs decide. */
static bool holds_discs(dyd_content layer, dyd_format format) {
  bool pairs = layer == DYD_CONTENT_NONE || layer == DYD_CONTENT_DELAUNAY;
  bool known = layer == DYD_CONTENT_POINTS || layer == DYD_CONTENT_TRIANGLES || layer == DYD_CONTENT_ALIASES;
  return (pairs || known) && format != DYD_FORMAT_JSON && format != DYD_FORMAT_OBJ && format != DYD_FORMAT_VTK;
}

/* Are ties found while rows of pairs are written, so that no list of them is made? */
static bool rows_hold_ties(const dyd_result *r, dyd_content layer, dyd_format format, const dyd_delaunay_output *o) {
  size_t count[4];
  dyd_delaunay_count(count, r->pd);
  bool rows = format == DYD_FORMAT_CSV || format == DYD_FORMAT_WKT || format == DYD_FORMAT_GEOJSON;
  return rows && layer == DYD_CONTENT_DELAUNAY && !o->pairs && o->ties == DYD_LIST_TIES_PAIRS && count[DYD_TIE];
}

dyd_status dyd_write_delaunay_as(FILE *out, const dyd_engine *e, const dyd_delaunay_output *options, dyd_format format,
                                 dyd_error *err) {
  if (err) dyd_error_clear(err);
  dyd_delaunay_output o;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_delaunay_output", err) != DYD_OK) return DYD_E_ARG;
  if (refuse_layer(o.layer, DYD_CONTENT_DELAUNAY, err) != DYD_OK) return DYD_E_ARG;
  dyd_result r = {.out = out,
                  .engine = e,
                  .pd = result_of(e, err),
                  .window = o.window,
                  .epsg = o.epsg,
                  .discs = o.pairs,
                  .history = o.history,
                  .tolerance = o.tolerance};
  if (!r.pd) return DYD_E_ARG;
  if (o.pairs && !holds_discs(o.layer, format))
    return dyd_fail(
        err, DYD_E_ARG,
        "statuses of discs are written as pairs, points or triangles: in csv, wkt, geojson, or pairs in svg, pdf, "
        "png or html");
  bool graph;
  dyd_content layer = layer_of(o.layer, DYD_CONTENT_DELAUNAY);
  if (o.ties == DYD_LIST_TIES_GROUPS && layer == DYD_CONTENT_DELAUNAY && format == DYD_FORMAT_CSV)
    layer = DYD_CONTENT_TIES;
  result_sites(&r);
  r.ties_apart = rows_hold_ties(&r, layer, format, &o);
  dyd_pair_status least = o.ties || r.ties_apart || layer == DYD_CONTENT_POINTS ? DYD_INDETERMINATE : DYD_TIE;
  dyd_status st = grant_output(r.pd, format, false, o.pairs, least, err);
  if (st != DYD_OK) return st;
  st = result_graph(&graph, &r, &o, err);
  if (graph) r.history = NULL, r.tolerance = NULL; /* they tell of the triangulation */
  bool pairs = !graph && !o.pairs && layer != DYD_CONTENT_TIES && layer != DYD_CONTENT_ALIASES;
  if (st == DYD_OK && pairs) st = dyd_pairs_take(&r.pairs, r.pd, least);
  if (o.pairs) r.pairs = *o.pairs;
  if (st == DYD_OK)
    st = dyd_format_write(out, format, layer, &r, err);
  else if (!err || err->code != st)
    dyd_fail(err, st, "%s", dyd_status_text(st));
  if (!o.pairs) dyd_pair_list_clear(&r.pairs);
  dyd_graph_list_clear(&r.graph);
  return st;
}

/* Numbers out of range come from polygons that are too fine; pictures tell of their own. */
static dyd_status tell_fineness(dyd_status st, const dyd_diagram *d, dyd_error *err) {
  if (st != DYD_E_RANGE || !err || strcmp(err->message, dyd_status_text(st)) != 0) return st;
  return dyd_fail(err, st,
                  "polygons within 2^%" PRId64 " of their cells take more points or digits than can be held; give a "
                  "smaller M by `flatten`",
                  -d->bits);
}

/* Layers of cells and regions tell nothing of vertices. */
static bool has_vertices(dyd_content layer, dyd_format format) {
  bool layered = format == DYD_FORMAT_CSV || format == DYD_FORMAT_WKT || format == DYD_FORMAT_GEOJSON;
  return !layered || (layer != DYD_CONTENT_VORONOI && layer != DYD_CONTENT_REGIONS);
}

dyd_status dyd_write_voronoi(FILE *out, const dyd_engine *e, const dyd_voronoi_options *options, dyd_format format,
                             dyd_error *err) {
  if (err) dyd_error_clear(err);
  dyd_voronoi_options o;
  dyd_status st = dyd_abi_take(&o, sizeof o, options, "dyd_voronoi_options", err);
  if (st == DYD_OK && o.bounds) st = dyd_abi_check(o.bounds, sizeof *o.bounds, "dyd_voronoi_bounds", err);
  if (st != DYD_OK) return st;
  const dyd_delaunay *pd = result_of(e, err);
  if (!pd || refuse_layer(o.layer, DYD_CONTENT_VORONOI, err) != DYD_OK) return DYD_E_ARG;
  if (dyd_delaunay_is_capped(pd))
    return dyd_fail(err, DYD_CAPPED, "the cap on stored pairs was met, so neighbours are missing; raise `max_pairs`");
  st = grant_output(pd, format, true, NULL, DYD_LEGAL, err);
  if (st != DYD_OK) return st;
  dyd_diagram d;
  dyd_room room = dyd_delaunay_room(pd);
  dyd_voronoi_bounds bounds, *wanted = o.bounds;
  size_t cut;
  dyd_voronoi_bounds_init(&bounds);
  o.bounds = &bounds;
  if (!o.cut) o.cut = &cut;
  st = dyd_diagram_init(&d, out, e, &o, has_vertices(layer_of(o.layer, DYD_CONTENT_VORONOI), format), &room, err);
  if (st == DYD_OK)
    st = tell_fineness(dyd_format_write(out, format, layer_of(o.layer, DYD_CONTENT_VORONOI), &d, err), &d, err);
  if (st == DYD_E_NOMEM && room.refused) dyd_fail_room(err, &room);
  if (st == DYD_OK && wanted) {
    dyd_dyadic_swap(&wanted->area, &bounds.area);
    dyd_dyadic_swap(&wanted->hausdorff, &bounds.hausdorff);
    wanted->finite = bounds.finite;
  }
  dyd_diagram_clear(&d);
  dyd_voronoi_bounds_clear(&bounds);
  return st;
}

/* A table without a run has nothing to tell. */
static dyd_status stages_check(const dyd_convergence *c, dyd_error *err) {
  if (err) dyd_error_clear(err);
  return c->options ? DYD_OK : dyd_fail(err, DYD_E_ARG, "the table is empty: there was no run");
}

dyd_status dyd_write_convergence(FILE *out, const dyd_convergence *c, dyd_format format, bool times, dyd_error *err) {
  const dyd_convergence_output o = {DYD_SIZED(dyd_convergence_output), .times = times};
  return dyd_write_convergence_as(out, c, &o, format, err);
}

/* Does the name begin one of the items in list, each up to a comma? */
static bool item_is_listed(const char *list, const char *name, size_t length) {
  for (const char *at = list; at; at = strchr(at, ','), at = at ? at + 1 : NULL)
    if (strcspn(at, "=,") == length && memcmp(at, name, length) == 0) return true;
  return false;
}

/* Items with a name and one "=" each, and nothing that csv or json would have to escape; no two columns have one
 * name. */
bool dyd_label_fits(const char *label) {
  for (const char *at = label; *at; at++)
    if ((unsigned char)*at < ' ' || *at == '"' || *at == '\\' || *at == 127) return false;
  for (const char *item = label;; item++) {
    size_t name = strcspn(item, "=,"), length = strcspn(item, ",");
    if (name == 0 || name == length || memchr(item + name + 1, '=', length - name - 1)) return false;
    if (item_is_listed(dyd_stage_columns, item, name)) return false;
    item += length;
    if (!*item) return true;
    if (item_is_listed(item + 1, item - length, name)) return false;
  }
}

dyd_status dyd_write_convergence_as(FILE *out, const dyd_convergence *c, const dyd_convergence_output *options,
                                    dyd_format format, dyd_error *err) {
  dyd_convergence_output o;
  if (stages_check(c, err) != DYD_OK) return DYD_E_ARG;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_convergence_output", err) != DYD_OK) return DYD_E_ARG;
  if (o.label && !dyd_label_fits(o.label))
    return dyd_fail(err, DYD_E_ARG, "the label \"%.60s\" is none; give NAME=VALUE,NAME=VALUE", o.label);
  dyd_stage_table table = {.stages = c, .times = o.times, .label = o.label, .no_header = o.no_header};
  if (format != DYD_FORMAT_HTML) return dyd_format_write(out, format, DYD_CONTENT_CONVERGENCE, &table, err);
  if (!o.engine || !o.history) return dyd_fail(err, DYD_E_ARG, "html shows the points: give engine and history");
  dyd_result r = {
      .out = out, .engine = o.engine, .pd = result_of(o.engine, err), .window = o.window, .history = o.history};
  if (!r.pd) return DYD_E_ARG;
  result_sites(&r);
  table.result = &r;
  dyd_status st = dyd_delaunay_pairs(&r.pairs, r.pd);
  if (st != DYD_OK)
    dyd_fail(err, st, "%s", dyd_status_text(st));
  else
    st = dyd_format_write(out, format, DYD_CONTENT_CONVERGENCE, &table, err);
  dyd_pair_list_clear(&r.pairs);
  return st;
}

dyd_status dyd_plot_convergence(FILE *out, const dyd_convergence *c, dyd_format format, dyd_error *err) {
  if (stages_check(c, err) != DYD_OK) return DYD_E_ARG;
  return dyd_format_write(out, format, DYD_CONTENT_PLOT, c, err);
}

dyd_status dyd_write_check(FILE *out, const dyd_check_report *report, dyd_format format, dyd_error *err) {
  if (err) dyd_error_clear(err);
  dyd_check_report r;
  if (dyd_abi_take(&r, sizeof r, report, "dyd_check_report", err) != DYD_OK) return DYD_E_ARG;
  return dyd_format_write(out, format, DYD_CONTENT_CHECK, &r, err);
}

dyd_status dyd_write_disc(FILE *out, const dyd_rect *const *r, size_t n, dyd_outcome outcome, dyd_format format,
                          dyd_error *err) {
  return dyd_write_disc_named(out, NULL, r, n, outcome, format, err);
}

dyd_status dyd_write_disc_named(FILE *out, const dyd_engine *e, const dyd_rect *const *r, size_t n, dyd_outcome outcome,
                                dyd_format format, dyd_error *err) {
  if (n < 3) return dyd_fail(err, DYD_E_ARG, "a disc needs three points");
  dyd_partial_disc disc;
  dyd_partial_disc_init(&disc);
  dyd_partial_disc_set(&disc, r[0], r[1], r[2]);
  dyd_status st = dyd_format_write(out, format, DYD_CONTENT_DISC, &(dyd_disc_output){&disc, r, n, outcome, e}, err);
  dyd_partial_disc_clear(&disc);
  return st;
}

/* The curve of (b,a) names its sites 0, 1 for b, a. */
static void swap_names(dyd_boundary *curve) {
  for (size_t m = 0; m < curve->count; m++)
    for (size_t k = 0; k < curve->chain[m].count; k++) {
      curve->chain[m].arc[k].far_site = 1;
      curve->chain[m].arc[k].near_site = 0;
    }
}

dyd_status dyd_write_bisector(FILE *out, const dyd_rect *a, const dyd_rect *b, dyd_outcome outcome, dyd_format format,
                              dyd_error *err) {
  return dyd_write_bisector_named(out, NULL, a, b, outcome, format, err);
}

dyd_status dyd_write_bisector_named(FILE *out, const dyd_engine *e, const dyd_rect *a, const dyd_rect *b,
                                    dyd_outcome outcome, dyd_format format, dyd_error *err) {
  dyd_boundary curve[2] = {{0}, {0}};
  dyd_status st = dyd_bisector(&curve[0], a, b);
  if (st == DYD_OK) st = dyd_bisector(&curve[1], b, a);
  swap_names(&curve[1]);
  if (st == DYD_OK)
    st = dyd_format_write(out, format, DYD_CONTENT_BISECTOR, &(dyd_bisector_output){{a, b}, curve, outcome, e}, err);
  else
    dyd_fail(err, st, "%s", dyd_status_text(st));
  for (int k = 2; k-- > 0;) dyd_boundary_clear(&curve[k]);
  return st;
}

/* The answers as this library knows them are in own[0 .. count - 1]. */
static dyd_status write_answers(FILE *out, const dyd_engine *e, dyd_nearest_answer *own, dyd_nearest_output *what,
                                dyd_content content, dyd_format format, dyd_error *err) {
  const dyd_nearest_answer *const *given = what->answer;
  const dyd_nearest_answer **taken = dyd_alloc(what->count, sizeof(const dyd_nearest_answer *));
  dyd_status st = taken ? DYD_OK : dyd_fail(err, DYD_E_NOMEM, "%s", dyd_status_text(DYD_E_NOMEM));
  for (size_t q = 0; q < what->count && st == DYD_OK; q++) {
    st = dyd_abi_take(&own[q], sizeof own[q], given[q], "dyd_nearest_answer", err);
    if (st == DYD_OK && (!own[q].at || !own[q].found))
      st = dyd_fail(err, DYD_E_ARG, "there is no answer to be written");
    if (st == DYD_OK) taken[q] = &own[q];
  }
  what->answer = taken;
  what->engine = e;
  if (st == DYD_OK) what->pd = result_of(e, err);
  if (st == DYD_OK) st = what->pd ? dyd_format_write(out, format, content, what, err) : DYD_E_ARG;
  free(taken);
  return st;
}

dyd_status dyd_write_nearest(FILE *out, const dyd_engine *e, const dyd_nearest_answer *answer, dyd_format format,
                             dyd_error *err) {
  if (err) dyd_error_clear(err);
  dyd_nearest_answer own;
  dyd_nearest_output what = {.answer = &answer, .count = 1};
  return write_answers(out, e, &own, &what, DYD_CONTENT_NEAREST, format, err);
}

dyd_status dyd_write_places(FILE *out, const dyd_engine *e, const dyd_nearest_answer *const *answer, size_t count,
                            dyd_outcome outcome, dyd_format format, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  if (err) dyd_error_clear(err);
  dyd_nearest_answer *own = dyd_alloc(count, sizeof *own);
  if (!own) return dyd_fail(err, DYD_E_NOMEM, "%s", dyd_status_text(DYD_E_NOMEM));
  dyd_nearest_output what = {.answer = answer, .count = count, .outcome = outcome};
  dyd_status st = write_answers(out, e, own, &what, DYD_CONTENT_PLACES, format, err);
  free(own);
  return st;
}

dyd_status dyd_write_tolerance(FILE *out, const dyd_engine *e, const dyd_tolerance *t,
                               const dyd_tolerance_output *options, dyd_format format, dyd_error *err) {
  if (err) dyd_error_clear(err);
  dyd_tolerance_output o;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_tolerance_output", err) != DYD_OK) return DYD_E_ARG;
  if (refuse_layer(o.layer, DYD_CONTENT_TOLERANCE, err) != DYD_OK) return DYD_E_ARG;
  if (o.layer == DYD_CONTENT_RADII && !dyd_tolerance_points(t))
    return dyd_fail(err, DYD_E_ARG, "how far points may be from their places was not asked for");
  dyd_result r = {.out = out, .engine = e, .pd = result_of(e, err), .window = o.window, .epsg = o.epsg};
  if (!r.pd) return DYD_E_ARG;
  result_sites(&r);
  return dyd_format_write(out, format, layer_of(o.layer, DYD_CONTENT_TOLERANCE), &(dyd_tolerance_result){&r, t}, err);
}

dyd_status dyd_write_sphere(FILE *out, const dyd_sphere *s, const dyd_sphere_output *options, dyd_format format,
                            dyd_error *err) {
  if (err) dyd_error_clear(err);
  dyd_sphere_output o;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_sphere_output", err) != DYD_OK) return DYD_E_ARG;
  if (refuse_layer(o.layer, DYD_CONTENT_SPHERE, err) != DYD_OK &&
      refuse_layer(o.layer, DYD_CONTENT_SPHERE_VORONOI, err) != DYD_OK)
    return DYD_E_ARG;
  if (!result_of(dyd_sphere_images(s), err)) return DYD_E_ARG;
  if (!(o.max_arc >= 0 && o.max_arc <= 90))
    return dyd_fail(err, DYD_E_ARG, "max_arc is in degrees, above 0 and at most 90");
  dyd_sphere_result r = {.sphere = s, .epsg = o.epsg, .window = o.window, .max_arc = o.max_arc > 0 ? o.max_arc : 1};
  dyd_status st = dyd_sphere_pairs(&r.pairs, s);
  if (st == DYD_OK)
    st = dyd_format_write(out, format, layer_of(o.layer, DYD_CONTENT_SPHERE), &r, err);
  else
    dyd_fail(err, st, "%s", dyd_status_text(st));
  dyd_pair_list_clear(&r.pairs);
  return st;
}

dyd_status dyd_write_plan(FILE *out, const dyd_engine *e, const dyd_survey *s, const dyd_plan_output *options,
                          dyd_format format, dyd_error *err) {
  if (err) dyd_error_clear(err);
  dyd_plan_output o;
  if (dyd_abi_take(&o, sizeof o, options, "dyd_plan_output", err) != DYD_OK) return DYD_E_ARG;
  dyd_result r = {.out = out, .engine = e, .pd = result_of(e, err), .epsg = o.epsg};
  if (!r.pd) return DYD_E_ARG;
  result_sites(&r);
  return dyd_format_write(out, format, DYD_CONTENT_PLAN, &(dyd_plan_result){&r, s, o.next}, err);
}
