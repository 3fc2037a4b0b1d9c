/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of formats.
 *
 * A new format: its constant in dyadel/io.h; a file of writers, in that folder's meson.build; its row here. The
 * command's options, help, manual page and completion follow. A format holds the contents that it has writers for. */
#include "format/table.h"

#include "base/error.h"
#include "base/room.h"
#include "io/table.h"
#include "picture/canvas.h"
#include <string.h>
#include <strings.h>

typedef dyd_writer *const writers[DYD_CONTENTS];
extern writers dyd_csv_writers, dyd_json_writers, dyd_obj_writers, dyd_vtk_writers, dyd_picture_writers,
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

uint64_t dyd_format_bytes(const dyd_output *o, bool diagram, uint64_t sites, uint64_t pairs) {
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

dyd_status dyd_format_write(const dyd_output *given, dyd_error *err) {
  dyd_error own;
  dyd_output o = *given;
  dyd_writer *write = writer_of(o.format, o.content);
  o.err = err ? err : &own;
  dyd_error_clear(o.err);
  if (!write) return refuse_format(o.format, o.content, err);
  dyd_status st = write(&o);
  if (st == DYD_OK) return dyd_output_end(o.out, err);
  return o.err->message[0] ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}
