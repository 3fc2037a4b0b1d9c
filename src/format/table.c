/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of formats, and dyd_write, which prepares the content; the table does the rest.
 *
 * A new format: its constant in dyadel/io.h; its row here; its encoder in io/table.c where it holds layers, or a file
 * of writers for the contents that it holds. The command's options, help, manual page and completion follow. */
#include "io/table.h"
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "base/local.h"
#include "base/memory.h"
#include "delaunay/memory.h"
#include "dyadic/raw.h"
#include "io/decimal.h"
#include "io/diagram.h"
#include "picture/canvas.h"

#include <inttypes.h>
#include <string.h>
#include <strings.h>

typedef dyd_writer *const format_writers[DYD_CONTENTS];
extern format_writers dyd_csv_writers, dyd_json_writers, dyd_obj_writers, dyd_vtk_writers, dyd_picture_writers,
    dyd_html_writers, dyd_pgf_writers;

enum { BYTES = sizeof(dyd_format_facts), USUAL_WIDTH = 1120 };

static const struct {
  dyd_format_facts facts;
  dyd_writer *const *write; /* by content; NULL: none but layers */
  enum { NO_LAYERS, ALL_LAYERS, GEOGRAPHIC } layers;
  bool (*there)(void); /* NULL: always; else it may be missing from this library */
  struct bytes {
    uint32_t page, site, pair;
  } plain, diagram; /* what writing takes, as measured; of the diagram, beside what its writers ask for */
} formats[] = {
    [DYD_FORMAT_CSV] = {{BYTES, "csv",
                         "a table: of delaunay one line for each pair that is possible (i,j,status), of converge "
                         "one for each stage"},
                        dyd_csv_writers,
                        ALL_LAYERS,
                        .plain = {0, 0, 20}},
    [DYD_FORMAT_JSON] = {{BYTES, "json",
                          "everything: rectangles reached, statuses or exact arcs, outcome, bounds, counters"},
                         dyd_json_writers,
                         .plain = {0, 0, 48}},
    [DYD_FORMAT_WKT] = {{BYTES, "wkt", "a CSV table with a geometry per line, as QGIS and ogr2ogr read it", "csv"},
                        NULL,
                        GEOGRAPHIC,
                        .plain = {0, 55, 20}},
    [DYD_FORMAT_GEOJSON] = {{BYTES, "geojson", "a FeatureCollection", "json"}, NULL, GEOGRAPHIC, .plain = {0, 55, 20}},
    [DYD_FORMAT_OBJ] = {{BYTES, "obj", "vertices, legal edges, certain triangles"},
                        dyd_obj_writers,
                        .plain = {0, 110, 20}},
    [DYD_FORMAT_SVG] = {{BYTES, "svg", "a picture with legend and scale"},
                        dyd_picture_writers,
                        .plain = {0, 630, 36},
                        .diagram = {0, 150, 0}},
    [DYD_FORMAT_VTK] = {{BYTES, "vtk", "legacy VTK text, as ParaView reads it"},
                        dyd_vtk_writers,
                        .plain = {0, 200, 25}},
    [DYD_FORMAT_PDF] = {{BYTES, "pdf", "the same picture", NULL, true},
                        dyd_picture_writers,
                        .there = dyd_cairo_is_there,
                        .plain = {0, 2900, 36},
                        .diagram = {0, 5000, 0}},
    [DYD_FORMAT_PNG] = {{BYTES, "png", "the same picture", NULL, true},
                        dyd_picture_writers,
                        .there = dyd_cairo_is_there,
                        .plain = {20000000, 5500, 36},
                        .diagram = {20000000, 300, 0}},
    [DYD_FORMAT_HTML] =
        {{BYTES, "html",
          "a page to move about in, with all statements about each point, stage by stage; one file that asks "
          "for nothing"},
         dyd_html_writers,
         .plain = {0, 400, 50},
         .diagram = {0, 1500, 0}},
    [DYD_FORMAT_TIKZ] = {{BYTES, "tikz", "the same picture as a tikzpicture, for \\input in a LaTeX document"},
                         dyd_picture_writers,
                         .plain = {0, 630, 36},
                         .diagram = {0, 150, 0}},
    [DYD_FORMAT_PGF] = {{BYTES, "pgf",
                         "of converge the curves as an axis of pgfplots, for \\input in a LaTeX document"},
                        dyd_pgf_writers},
};
enum { FORMATS = sizeof formats / sizeof *formats };

/* ---- what the table says ---- */

bool dyd_format_from_name(dyd_format *out, const char *name) {
  size_t k = 0;
  while (k < FORMATS && strcmp(formats[k].facts.name, name) != 0) k++;
  if (k < FORMATS) *out = (dyd_format)k;
  return k < FORMATS;
}

bool dyd_format_from_file(dyd_format *out, const char *file) {
  const char *dot = strrchr(file, '.');
  size_t k = 0;
  while (dot && k < FORMATS && strcasecmp(formats[k].facts.name, dot + 1) != 0) k++;
  if (dot && k < FORMATS) *out = (dyd_format)k;
  return dot && k < FORMATS;
}

const dyd_format_facts *dyd_format_get(dyd_format format) {
  return (size_t)format < FORMATS ? &formats[format].facts : NULL;
}

const char *dyd_layer_name(dyd_content *layer, bool *large, dyd_content of, size_t k) {
  const dyd_layer *l;
  for (size_t at = 0; (l = dyd_layer_at(at)) && (!l->name || l->of != of || k-- > 0);) at++;
  if (l && layer) *layer = l->content;
  if (l && large) *large = l->large;
  return l ? l->name : NULL;
}

bool dyd_layer_from_name(dyd_content *out, dyd_content of, const char *name) {
  const dyd_layer *layer;
  for (size_t l = 0; (layer = dyd_layer_at(l)); l++)
    if (layer->name && layer->of == of && strcmp(layer->name, name) == 0) {
      *out = layer->content;
      return true;
    }
  return false;
}

static bool format_is_missing(dyd_format format) {
  return formats[format].there && !formats[format].there();
}

/* NULL: the format cannot hold that. */
static dyd_writer *writer_of(dyd_format format, dyd_content content) {
  if ((size_t)format >= FORMATS || (size_t)content >= DYD_CONTENTS || format_is_missing(format)) return NULL;
  const dyd_layer *layer = formats[format].layers == NO_LAYERS ? NULL : dyd_layer_of(content);
  if (layer && (layer->geographic || formats[format].layers == ALL_LAYERS)) return dyd_layer_write;
  return formats[format].write ? formats[format].write[content] : NULL;
}

/* Other layers and formats state more than discs decide. */
static bool states_discs(dyd_format format, dyd_content layer) {
  bool known = layer == DYD_CONTENT_DELAUNAY || layer == DYD_CONTENT_POINTS || layer == DYD_CONTENT_TRIANGLES ||
               layer == DYD_CONTENT_ALIASES || (layer >= DYD_CONTENT_GRAPH_NEAREST && layer <= DYD_CONTENT_GRAPH_MST);
  return known && format != DYD_FORMAT_JSON && format != DYD_FORMAT_OBJ && format != DYD_FORMAT_VTK;
}

bool dyd_format_holds(dyd_format format, dyd_content content, bool discs) {
  return writer_of(format, content) && (!discs || states_discs(format, content));
}

/* Estimated memory, in bytes, for writing a result with these numbers of sites and pairs; for its diagram, without what
 * its writers request themselves. */
static uint64_t format_bytes(const dyd_output *o, bool diagram, uint64_t sites, uint64_t pairs) {
  if ((size_t)o->format >= FORMATS) return 0;
  const struct bytes *b = diagram ? &formats[o->format].diagram : &formats[o->format].plain;
  const double wide = o->style.width > USUAL_WIDTH ? o->style.width / USUAL_WIDTH : 1;
  return dyd_bytes_add((uint64_t)(b->page * wide * wide),
                       dyd_bytes_add(dyd_bytes_times(sites, b->site), dyd_bytes_times(pairs, b->pair)));
}

/* ---- writing ---- */

/* "obj cannot hold this; give csv, svg or pdf". */
static dyd_status refuse_format(dyd_format format, dyd_content content, dyd_error *err) {
  char names[100] = "";
  size_t used = 0, left = 0;
  for (size_t k = 0; k < FORMATS; k++) left += dyd_format_holds((dyd_format)k, content, false);
  for (size_t k = 0; k < FORMATS && used < sizeof names; k++) {
    if (!dyd_format_holds((dyd_format)k, content, false)) continue;
    const char *before = !used ? "" : left > 1 ? ", " : " or ";
    used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", before, formats[k].facts.name);
    left--;
  }
  if ((size_t)format >= FORMATS)
    return dyd_fail(err, DYD_E_ARG, "there is no format number %d; give %s", (int)format, names);
  if (format_is_missing(format))
    return dyd_fail(err, DYD_E_ARG, "%s takes cairo, which this library was built without; give %s",
                    formats[format].facts.name, names);
  return dyd_fail(err, DYD_E_ARG, "%s cannot hold this; give %s", formats[format].facts.name, names);
}

/* Writes `what`, of the type that io/output.h says for this content. DYD_E_ARG where the format cannot hold it. err may
 * be NULL. */
static dyd_status write_what(dyd_output *to, const void *what, dyd_error *err) {
  dyd_error own;
  dyd_writer *write = writer_of(to->format, to->content);
  to->what = what;
  to->err = err ? err : &own;
  dyd_error_clear(to->err);
  if (!write) return refuse_format(to->format, to->content, err);
  dyd_status st = write(to);
  if (st == DYD_OK) return dyd_output_end(to->out, err);
  return to->err->message[0] ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

/* Writes a content; `to` says where and what, but for what belongs to the content. */
typedef dyd_status content_writer(dyd_output *to, dyd_write_options *o, dyd_error *err);

static dyd_status fail_status(dyd_status st, dyd_error *err) {
  return dyd_fail(err, st, "%s", dyd_status_text(st));
}

/* ---- the triangulation ---- */

/* The result of the engine. */
static dyd_status result_init(dyd_result *r, dyd_output *to, const dyd_write_options *o, dyd_error *err) {
  if (!to->engine) return dyd_fail_null(err);
  *r = (dyd_result){.out = to->out,
                    .engine = to->engine,
                    .pd = dyd_engine_delaunay(to->engine),
                    .window = o->window,
                    .epsg = o->epsg,
                    .discs = o->pairs,
                    .next = o->next,
                    .history = o->history,
                    .tolerance = o->tolerance,
                    .survey = o->plan};
  if (!r->pd) return dyd_fail(err, DYD_E_ARG, "there is no result yet");
  r->sites = dyd_delaunay_sites(r->pd);
  r->count = dyd_sites_count(r->sites);
  return DYD_OK;
}

static const char *const graph_names[] = {"nearest neighbours", "Gabriel graph", "minimum spanning tree"};

/* The edges as pairs, for pictures: each once, legal where it is certain, from one end at least. */
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

/* The edges, which are written instead of the pairs, if the layer is a graph. */
static dyd_status result_graph(bool *graph, dyd_result *r, dyd_content layer, const dyd_write_options *o,
                               dyd_error *err) {
  *graph = layer >= DYD_CONTENT_GRAPH_NEAREST && layer <= DYD_CONTENT_GRAPH_MST;
  if (!*graph) return DYD_OK;
  const dyd_graph which = (dyd_graph)(layer - DYD_CONTENT_GRAPH_NEAREST);
  r->graph_name = graph_names[which];
  dyd_status st = DYD_OK;
  if (o->graph)
    r->graph = *o->graph;
  else
    st = dyd_graph_edges(&r->graph, r->pd, o->pairs, which, o->cancel, err);
  return st == DYD_OK ? pairs_of_graph(r) : st;
}

/* Checks the budget for the memory of an output. pairs: those to be written; NULL: all. */
static dyd_status grant_output(const dyd_delaunay *pd, const dyd_output *to, bool diagram, const dyd_pair_list *pairs,
                               dyd_pair_status least, dyd_error *err) {
  if (!dyd_delaunay_is_bounded(pd)) return DYD_OK;
  uint64_t count = pairs ? pairs->count : dyd_pairs_bytes(pd, least) / sizeof(dyd_pair);
  uint64_t bytes = format_bytes(to, diagram, dyd_sites_count(dyd_delaunay_sites(pd)), count);
  return dyd_delaunay_grant(pd, bytes, "this output", err);
}

/* Returns true if ties are found while rows of pairs are written, so that no list of them is made. */
static bool rows_hold_ties(const dyd_result *r, const dyd_output *to, const dyd_write_options *o) {
  size_t count[4];
  dyd_delaunay_count(count, r->pd);
  bool rows = to->format == DYD_FORMAT_CSV || to->format == DYD_FORMAT_WKT || to->format == DYD_FORMAT_GEOJSON;
  return rows && to->content == DYD_CONTENT_DELAUNAY && !o->pairs && o->ties == DYD_LIST_TIES_PAIRS && count[DYD_TIE];
}

/* What layers of T as a region need all pairs for. */
static dyd_status result_region(dyd_result *r, const dyd_output *to, const dyd_write_options *o, dyd_error *err) {
  if (to->content != DYD_CONTENT_HULLS && to->content != DYD_CONTENT_EXTERIOR) return DYD_OK;
  if (dyd_delaunay_is_capped(r->pd))
    return dyd_fail(err, DYD_CAPPED, "the cap on stored pairs was met, so edges are missing; raise `max_pairs`");
  dyd_status st = to->content == DYD_CONTENT_EXTERIOR ? dyd_delaunay_exterior(&r->exterior, r->pd, o->cancel) : DYD_OK;
  return st == DYD_OK ? st : fail_status(st, err);
}

static dyd_status write_delaunay(dyd_output *to, dyd_write_options *o, dyd_error *err) {
  dyd_result r;
  bool graph;
  dyd_status st = result_init(&r, to, o, err);
  if (st != DYD_OK) return st;
  if (o->pairs && !dyd_format_holds(to->format, to->content, true))
    return dyd_fail(err, DYD_E_ARG,
                    "statuses of discs are written as pairs, points, triangles or graphs: in csv, wkt, geojson, or "
                    "pairs and graphs "
                    "in svg, pdf, png or html");
  if (o->ties == DYD_LIST_TIES_GROUPS && to->content == DYD_CONTENT_DELAUNAY && to->format == DYD_FORMAT_CSV)
    to->content = DYD_CONTENT_TIES;
  r.ties_apart = rows_hold_ties(&r, to, o);
  dyd_pair_status least = o->ties || r.ties_apart || to->content == DYD_CONTENT_POINTS ? DYD_INDETERMINATE : DYD_TIE;
  st = grant_output(r.pd, to, false, o->pairs, least, err);
  if (st != DYD_OK) return st;
  st = result_region(&r, to, o, err);
  if (st != DYD_OK) return st;
  st = result_graph(&graph, &r, to->content, o, err);
  if (graph) r.history = NULL, r.tolerance = NULL; /* both are about the triangulation */
  bool pairs = !graph && !o->pairs && to->content != DYD_CONTENT_TIES && to->content != DYD_CONTENT_ALIASES;
  if (st == DYD_OK && pairs) st = dyd_pairs_take(&r.pairs, r.pd, least);
  if (o->pairs && !graph) r.pairs = *o->pairs;
  if (st == DYD_OK)
    st = write_what(to, &r, err);
  else if (!err || err->code != st)
    fail_status(st, err);
  if (!o->pairs || graph) dyd_pair_list_clear(&r.pairs);
  if (!o->graph) dyd_graph_list_clear(&r.graph);
  dyd_exterior_clear(&r.exterior);
  return st;
}

static bool is_text_format(dyd_format f) {
  return f == DYD_FORMAT_CSV || f == DYD_FORMAT_WKT || f == DYD_FORMAT_GEOJSON || f == DYD_FORMAT_JSON;
}

/* Tolerances and plans. */
static dyd_status write_motion(dyd_output *to, dyd_write_options *o, dyd_error *err) {
  dyd_result r;
  const dyd_engine *places = o->sphere ? dyd_sphere_places(o->sphere) : NULL;
  dyd_status st = places ? DYD_OK : result_init(&r, to, o, err);
  if (st != DYD_OK) return st;
  if (places) {
    r = (dyd_result){.out = to->out,
                     .engine = places,
                     .sphere = o->sphere,
                     .pd = dyd_engine_delaunay(dyd_sphere_images(o->sphere)),
                     .count = dyd_engine_count(places),
                     .epsg = o->epsg,
                     .next = o->next,
                     .survey = o->plan};
    to->engine = places;
    to->sphere = o->sphere;
  }
  const bool plan = to->content == DYD_CONTENT_PLAN || to->content == DYD_CONTENT_PLAN_PAIRS;
  if (plan ? !o->plan : !o->tolerance) return dyd_fail_null(err);
  if (to->content == DYD_CONTENT_RADII && !dyd_tolerance_get(o->tolerance)->points)
    return dyd_fail(err, DYD_E_ARG, "how far points may be from their places was not asked for");
  /* Pictures and pages of a plan show all pairs. */
  if (plan && !is_text_format(to->format)) {
    if (o->pairs)
      r.pairs = *o->pairs;
    else
      st = places ? dyd_sphere_pairs(&r.pairs, o->sphere) : dyd_pairs_take(&r.pairs, r.pd, DYD_TIE);
  }
  if (st == DYD_OK) st = write_what(to, &r, err);
  if (!o->pairs) dyd_pair_list_clear(&r.pairs);
  return st;
}

/* A plan tried. */
static dyd_status write_trials(dyd_output *to, dyd_write_options *o, dyd_error *err) {
  if (!o->trial) return dyd_fail_null(err);
  return write_what(to, &(dyd_trials_output){o->trial, o->trials, o->seed}, err);
}

static dyd_status write_sphere(dyd_output *to, dyd_write_options *o, dyd_error *err) {
  if (!o->sphere) return dyd_fail_null(err);
  if (!(o->max_arc >= 0 && o->max_arc <= 90))
    return dyd_fail(err, DYD_E_ARG, "max_arc is in degrees, above 0 and at most 90");
  const dyd_engine *places = dyd_sphere_places(o->sphere);
  dyd_result r = {.out = to->out,
                  .engine = places,
                  .sphere = o->sphere,
                  .pd = dyd_engine_delaunay(dyd_sphere_images(o->sphere)),
                  .count = dyd_engine_count(places),
                  .epsg = o->epsg,
                  .window = o->window,
                  .max_arc = o->max_arc > 0 ? o->max_arc : 1};
  if (!r.pd) return dyd_fail(err, DYD_E_ARG, "there is no result yet");
  to->engine = places;
  to->sphere = o->sphere;
  dyd_status st = dyd_sphere_pairs(&r.pairs, o->sphere);
  st = st == DYD_OK ? write_what(to, &r, err) : fail_status(st, err);
  dyd_pair_list_clear(&r.pairs);
  return st;
}

/* ---- the Voronoi diagram ---- */

/* Numbers out of range come from polygons that are too fine; pictures report their own errors. */
static dyd_status tell_fineness(dyd_status st, const dyd_diagram *d, dyd_error *err) {
  if (st != DYD_E_RANGE || !err || strcmp(err->message, dyd_status_text(st)) != 0) return st;
  return dyd_fail(err, st,
                  "polygons within 2^%" PRId64 " of their cells take more points or digits than can be held; give a "
                  "smaller M by `flatten`",
                  -d->bits);
}

/* Layers of cells and regions have no vertices. */
static bool has_vertices(dyd_content layer, dyd_format format) {
  bool layered = format == DYD_FORMAT_CSV || format == DYD_FORMAT_WKT || format == DYD_FORMAT_GEOJSON;
  return !layered || (layer != DYD_CONTENT_VORONOI && layer != DYD_CONTENT_REGIONS && layer != DYD_CONTENT_TILES);
}

/* Where a diagram goes, if it is not written; both are empty before. */
typedef struct diagram_arrays {
  dyd_cells *cells;
  dyd_frame *frame;
} diagram_arrays;

static dyd_status find_arrays(const diagram_arrays *out, const dyd_diagram *d, dyd_error *err) {
  dyd_status st = out->cells ? dyd_diagram_cells(out->cells, d) : dyd_diagram_frame(out->frame, d);
  return st == DYD_OK ? st : fail_status(st, err);
}

/* arrays NULL: writes the content. */
static dyd_status make_diagram(const diagram_arrays *arrays, dyd_output *to, dyd_write_options *o, dyd_error *err) {
  dyd_result r;
  dyd_voronoi_bounds bounds, *wanted = o->bounds;
  size_t cut;
  dyd_status st = o->bounds ? dyd_abi_check(o->bounds, sizeof *o->bounds, "dyd_voronoi_bounds", err) : DYD_OK;
  if (st == DYD_OK) st = result_init(&r, to, o, err);
  if (st != DYD_OK) return st;
  if (dyd_delaunay_is_capped(r.pd))
    return dyd_fail(err, DYD_CAPPED, "the cap on stored pairs was met, so neighbours are missing; raise `max_pairs`");
  st = grant_output(r.pd, to, true, NULL, DYD_LEGAL, err);
  if (st != DYD_OK) return st;
  dyd_memory memory = dyd_delaunay_memory_left(r.pd);
  dyd_voronoi_bounds_init(&bounds);
  o->bounds = &bounds;
  if (!o->cut) o->cut = &cut;
  DYD_SCOPED(dyd_diagram) d;
  st = dyd_diagram_init(&d, to, o, has_vertices(to->content, to->format), &memory, err);
  if (st == DYD_OK) st = tell_fineness(arrays ? find_arrays(arrays, &d, err) : write_what(to, &d, err), &d, err);
  if (st == DYD_E_NOMEM && memory.refused) dyd_fail_memory(err, &memory);
  if (st == DYD_OK && wanted) {
    dyd_dyadic_swap(&wanted->area, &bounds.area);
    dyd_dyadic_swap(&wanted->hausdorff, &bounds.hausdorff);
    wanted->finite = bounds.finite;
  }
  dyd_voronoi_bounds_clear(&bounds);
  return st;
}

static dyd_status write_voronoi(dyd_output *to, dyd_write_options *o, dyd_error *err) {
  if (o->clip_to && to->content != DYD_CONTENT_TILES) return dyd_fail(err, DYD_E_ARG, "`clip_to` is about tiles");
  if (o->clip_to && to->format == DYD_FORMAT_VTK)
    return dyd_fail(err, DYD_E_ARG, "vtk has no polygons with holes, which tiles cut by `clip_to` may have");
  return make_diagram(NULL, to, o, err);
}

static dyd_status make_arrays(const diagram_arrays *arrays, const dyd_engine *e, dyd_content layer,
                              const dyd_write_options *options, dyd_error *err) {
  dyd_write_options o;
  dyd_output to = {.format = DYD_FORMAT_WKT, .content = layer, .engine = e};
  if (err) dyd_error_clear(err);
  if (dyd_abi_take(&o, sizeof o, options, "dyd_write_options", err) != DYD_OK) return DYD_E_ARG;
  return make_diagram(arrays, &to, &o, err);
}

dyd_status dyd_voronoi_cells(dyd_cells *out, const dyd_engine *e, const dyd_write_options *o, dyd_error *err) {
  dyd_cells cells = {0};
  if (!out) return dyd_fail_null(err);
  dyd_status st = make_arrays(&(diagram_arrays){.cells = &cells}, e, DYD_CONTENT_VORONOI, o, err);
  dyd_cells_clear(st == DYD_OK ? out : &cells);
  if (st == DYD_OK) *out = cells;
  return st;
}

dyd_status dyd_voronoi_frame(dyd_frame *out, const dyd_engine *e, const dyd_write_options *o, dyd_error *err) {
  dyd_frame frame = {0};
  if (!out) return dyd_fail_null(err);
  dyd_status st = make_arrays(&(diagram_arrays){.frame = &frame}, e, DYD_CONTENT_VERTICES, o, err);
  dyd_frame_clear(st == DYD_OK ? out : &frame);
  if (st == DYD_OK) *out = frame;
  return st;
}

/* ---- tables ---- */

/* Returns true if the name begins one of the items in list, each up to a comma. */
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
    if (dyd_is_stage_column(item, name)) return false;
    item += length;
    if (!*item) return true;
    if (item_is_listed(item + 1, item - length, name)) return false;
  }
}

/* A table without a run is empty. */
static dyd_status write_stages(dyd_output *to, dyd_write_options *o, dyd_error *err) {
  if (!o->stages || !o->stages->options) return dyd_fail(err, DYD_E_ARG, "the table is empty: there was no run");
  if (to->content == DYD_CONTENT_PLOT) return write_what(to, o->stages, err);
  if (o->label && !dyd_label_fits(o->label))
    return dyd_fail(err, DYD_E_ARG, "the label \"%.60s\" is none; give NAME=VALUE,NAME=VALUE", o->label);
  dyd_stage_table table = {.stages = o->stages,
                           .times = o->times,
                           .label = o->label,
                           .no_header = o->no_header,
                           .modulus = o->modulus,
                           .from = o->modulus_from,
                           .to = o->modulus_to};
  if (to->format != DYD_FORMAT_HTML) return write_what(to, &table, err);
  if (!to->engine || !o->history) return dyd_fail(err, DYD_E_ARG, "html shows the points: give engine and history");
  dyd_result r;
  dyd_status st = result_init(&r, to, o, err);
  if (st != DYD_OK) return st;
  table.result = &r;
  st = dyd_delaunay_pairs(&r.pairs, r.pd);
  st = st == DYD_OK ? write_what(to, &table, err) : fail_status(st, err);
  dyd_pair_list_clear(&r.pairs);
  return st;
}

static dyd_status write_check(dyd_output *to, dyd_write_options *o, dyd_error *err) {
  dyd_check_report r;
  if (!o->report) return dyd_fail_null(err);
  if (dyd_abi_take(&r, sizeof r, o->report, "dyd_check_report", err) != DYD_OK) return DYD_E_ARG;
  return write_what(to, &r, err);
}

/* ---- answers ---- */

static dyd_status write_disc(dyd_output *to, dyd_write_options *o, dyd_error *err) {
  if (o->rects < 3) return dyd_fail(err, DYD_E_ARG, "a disc needs three points");
  DYD_LOCAL(dyd_partial_disc, disc);
  dyd_partial_disc_set(&disc, o->rect[0], o->rect[1], o->rect[2]);
  return write_what(to, &(dyd_disc_output){&disc, o->rect, o->rects, o->outcome, to->engine}, err);
}

/* The curve of (b,a) names its sites 0, 1 for b, a. */
static void swap_names(dyd_boundary *curve) {
  for (size_t m = 0; m < curve->count; m++)
    for (size_t k = 0; k < curve->chain[m].count; k++) {
      curve->chain[m].arc[k].far_site = 1;
      curve->chain[m].arc[k].near_site = 0;
    }
}

static dyd_status write_bisector(dyd_output *to, dyd_write_options *o, dyd_error *err) {
  dyd_boundary curve[2] = {{0}, {0}};
  if (o->rects < 2) return dyd_fail(err, DYD_E_ARG, "a bisector needs two points");
  const dyd_rect *a = o->rect[0], *b = o->rect[1];
  dyd_status st = dyd_bisector(&curve[0], a, b);
  if (st == DYD_OK) st = dyd_bisector(&curve[1], b, a);
  swap_names(&curve[1]);
  st = st == DYD_OK ? write_what(to, &(dyd_bisector_output){{a, b}, curve, o->outcome, to->engine}, err)
                    : fail_status(st, err);
  for (int k = 2; k-- > 0;) dyd_boundary_clear(&curve[k]);
  return st;
}

/* The answers as this library knows them are own[0 .. answers - 1]; taken[] points at them. */
static dyd_status take_answers(dyd_nearest_answer *own, const dyd_nearest_answer **taken, const dyd_write_options *o,
                               dyd_error *err) {
  dyd_status st = own && taken ? DYD_OK : fail_status(DYD_E_NOMEM, err);
  for (size_t q = 0; q < o->answers && st == DYD_OK; q++) {
    st = dyd_abi_take(&own[q], sizeof own[q], o->answer[q], "dyd_nearest_answer", err);
    if (st == DYD_OK && (!own[q].at || !own[q].found))
      st = dyd_fail(err, DYD_E_ARG, "there is no answer to be written");
    taken[q] = &own[q];
  }
  return st;
}

static dyd_status write_nearest(dyd_output *to, dyd_write_options *o, dyd_error *err) {
  if (to->content == DYD_CONTENT_NEAREST && o->answers != 1)
    return dyd_fail(err, DYD_E_ARG, "there is no answer to be written");
  DYD_FREED dyd_nearest_answer *own = dyd_alloc(o->answers, sizeof *own);
  DYD_FREED const dyd_nearest_answer **taken = dyd_alloc(o->answers, sizeof(const dyd_nearest_answer *));
  dyd_result r;
  dyd_status st = take_answers(own, taken, o, err);
  if (st == DYD_OK && o->sphere && to->format != DYD_FORMAT_CSV && to->format != DYD_FORMAT_JSON)
    st = dyd_fail(err, DYD_E_ARG, "on a sphere nearest points are written as csv or json");
  if (o->sphere)
    r = (dyd_result){.engine = to->engine = dyd_sphere_places(o->sphere)};
  else if (st == DYD_OK)
    st = result_init(&r, to, o, err);
  if (st == DYD_OK)
    st = write_what(to, &(dyd_nearest_output){r.engine, r.pd, taken, o->answers, o->outcome, o->sphere}, err);
  return st;
}

/* ---- all ---- */

static content_writer *const writers[DYD_CONTENTS] = {
    [DYD_CONTENT_DELAUNAY] = write_delaunay,     [DYD_CONTENT_VORONOI] = write_voronoi,
    [DYD_CONTENT_CONVERGENCE] = write_stages,    [DYD_CONTENT_PLOT] = write_stages,
    [DYD_CONTENT_CHECK] = write_check,           [DYD_CONTENT_DISC] = write_disc,
    [DYD_CONTENT_BISECTOR] = write_bisector,     [DYD_CONTENT_NEAREST] = write_nearest,
    [DYD_CONTENT_PLACES] = write_nearest,        [DYD_CONTENT_PLAN] = write_motion,
    [DYD_CONTENT_TOLERANCE] = write_motion,      [DYD_CONTENT_SPHERE] = write_sphere,
    [DYD_CONTENT_SPHERE_VORONOI] = write_sphere, [DYD_CONTENT_TRIALS] = write_trials,
};

dyd_status dyd_write(FILE *out, const dyd_engine *e, dyd_content content, dyd_format format,
                     const dyd_write_options *options, dyd_error *err) {
  dyd_write_options o;
  if (err) dyd_error_clear(err);
  if (dyd_abi_take(&o, sizeof o, options, "dyd_write_options", err) != DYD_OK) return DYD_E_ARG;
  const dyd_layer *layer = dyd_layer_of(content);
  content_writer *write = layer ? writers[layer->of] : (size_t)content < DYD_CONTENTS ? writers[content] : NULL;
  if (!write) return dyd_fail(err, DYD_E_ARG, "there is no content number %d", (int)content);
  dyd_output to = {.out = out,
                   .format = format,
                   .content = content,
                   .engine = e,
                   .epsg = o.epsg,
                   .comments = o.comments,
                   .lengths = o.lengths,
                   .clip = o.clip,
                   .name = o.name};
  if (dyd_abi_take(&to.style, sizeof to.style, o.style, "dyd_write_style", err) != DYD_OK) return DYD_E_ARG;
  if (!(to.style.width >= 0 && to.style.width <= 5000 && to.style.font_size >= 0 && to.style.font_size <= 5000))
    return dyd_fail(err, DYD_E_ARG, "sizes of pictures are in points, from 0 to 5000");
  return write(&to, &o, err);
}

/* ---- exact rectangles as plain text, for programs that cannot read dyd_rect ---- */

static dyd_status put_side(FILE *out, const dyd_interval *a, char behind) {
  DYD_FREED char *lo = dyd_end_text(a, false), *hi = dyd_end_text(a, true);
  dyd_status st = lo && hi ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) fprintf(out, "%s %s%c", lo, hi, behind);
  return st;
}

dyd_status dyd_write_rects(FILE *out, const dyd_sites *sites, size_t first, size_t count, dyd_error *err) {
  if (!sites) return dyd_fail_null(err);
  dyd_status st = DYD_OK;
  if (first > dyd_sites_count(sites) || count > dyd_sites_count(sites) - first)
    return dyd_fail(err, DYD_E_ARG, "there are %zu points; ask for some of them", dyd_sites_count(sites));
  DYD_LOCAL(dyd_rect, r);
  for (size_t i = first; st == DYD_OK && i < first + count; i++) {
    st = dyd_sites_get(&r, sites, i);
    if (st == DYD_OK) st = put_side(out, &r.x, ' ');
    if (st == DYD_OK) st = put_side(out, &r.y, '\n');
  }
  if (st == DYD_OK && ferror(out)) return dyd_fail(err, DYD_E_IO, "writing rectangles failed");
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}
