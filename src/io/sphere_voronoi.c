/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The diagram of a sphere: cells as cyclic lists of vertices, vertices in boxes of degrees, undecided regions by their
 * sites. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/geodesic.h"
#include "io/label_text.h"
#include "io/parts.h"
#include "io/result.h"
#include "io/sphere_cells.h"
#include <math.h>

static dyd_table_head sphere_diagram_head(const dyd_output *o, const char *const *column, dyd_geometry geometry) {
  const dyd_sphere_result *r = o->what;
  return (dyd_table_head){o->out, o->format, column, geometry, r->epsg, dyd_sphere_places(r->sphere), r->sphere};
}

/* The vertices of a cell: "3 7 9", with `gap` before those that an undecided region comes before. */
static void put_nodes(FILE *out, const dyd_sphere_cells *c, size_t i, const char *between, const char *gap) {
  for (size_t k = c->first[i]; k < c->first[i + 1]; k++) {
    const char *before = k > c->first[i] ? between : "";
    if (c->gap[k]) fprintf(out, "%s%s", before, gap);
    fprintf(out, "%s%lu", c->gap[k] ? between : before, (unsigned long)c->of[k]);
  }
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
  if (t->bare || !c->closed[i]) return DYD_OK;
  dyd_side *side = dyd_alloc(n + 1, sizeof *side);
  if (!side) return DYD_E_NOMEM;
  for (size_t k = 0; k < n; k++) side[k] = dyd_sphere_cell_side(c, i, k);
  n += dyd_sphere_cell_is_half(&side[n], c, t->head->sphere, i);
  dyd_status st = dyd_row_around(t, side, n, most);
  for (size_t k = c->first[i]; k < c->first[i + 1]; k++) error = fmax(error, node_error(&c->node[c->of[k]]));
  t->error += error;
  free(side);
  return st;
}

/* The list as one value; blanks between numbers need no quotes. */
static dyd_status cell_row(dyd_table *t, const dyd_sphere_cells *c, double most, uint32_t i) {
  char *text = NULL;
  size_t length = 0;
  FILE *list = open_memstream(&text, &length);
  if (!list) return DYD_E_NOMEM;
  put_nodes(list, c, i, " ", "*");
  bool good = fclose(list) == 0;
  dyd_row_begin(t);
  dyd_status st = good ? cell_outline(t, c, most, i) : DYD_E_NOMEM;
  dyd_row_site(t, i);
  dyd_row_id(t, i);
  dyd_row_text(t, c->closed[i] ? "yes" : "no");
  dyd_row_text(t, good ? text : "");
  dyd_row_end(t);
  free(text);
  return st;
}

dyd_status dyd_sphere_layer_cells(const dyd_output *o) {
  static const char *const column[] = {"i", "id", "complete", "vertices", NULL};
  const dyd_sphere_result *r = o->what;
  const dyd_table_head head = sphere_diagram_head(o, column, DYD_GEOMETRY_POLYGONS);
  dyd_sphere_cells c = {0};
  dyd_table t;
  dyd_status st = dyd_sphere_cells_find(&c, r->sphere, o->err);
  if (st == DYD_OK) {
    if (o->format == DYD_FORMAT_CSV) dyd_csv_sphere_aliases(o->out, r->sphere);
    dyd_table_begin(&t, &head);
    for (uint32_t i = 0; i < c.places && st == DYD_OK; i++)
      if (dyd_sphere_alias(r->sphere, i) == i) st = cell_row(&t, &c, r->max_arc, i);
    dyd_table_end(&t);
  }
  dyd_sphere_cells_clear(&c);
  return st;
}

dyd_status dyd_sphere_layer_vertices(const dyd_output *o) {
  static const char *const column[] = {"i", "j", "k", "id_i", "id_j", "id_k", "xlo", "xhi", "ylo", "yhi", NULL};
  const dyd_sphere_result *r = o->what;
  const dyd_table_head head = sphere_diagram_head(o, column, DYD_GEOMETRY_POINT);
  dyd_sphere_cells c = {0};
  dyd_table t;
  dyd_status st = dyd_sphere_cells_find(&c, r->sphere, o->err);
  if (st == DYD_OK) {
    if (o->format == DYD_FORMAT_CSV) {
      dyd_csv_sphere_aliases(o->out, r->sphere);
      fputs("# rounding: lo down, hi up\n", o->out);
    }
    dyd_table_begin(&t, &head);
    for (size_t k = 0; k < c.nodes; k++) {
      dyd_row_begin(&t);
      dyd_row_at(&t, c.node[k].box);
      for (int l = 0; l < 3; l++) dyd_row_site(&t, c.node[k].of.v[l]);
      for (int l = 0; l < 3; l++) dyd_row_id(&t, c.node[k].of.v[l]);
      dyd_row_box(&t, c.node[k].box);
      dyd_row_end(&t);
    }
    dyd_table_end(&t);
  }
  dyd_sphere_cells_clear(&c);
  return st;
}

/* Goes over the undecided faces. */
static dyd_status put_regions(FILE *out, const dyd_sphere *s, const char *form, const char *between, const char *end) {
  dyd_index_list sites = {0};
  dyd_status st = DYD_OK;
  size_t faces = dyd_sphere_faces(s);
  for (size_t f = 0; f < faces && st == DYD_OK; f++) {
    bool tie;
    st = dyd_sphere_face(&sites, &tie, s, f);
    if (st != DYD_OK) break;
    fprintf(out, form, f ? between : "", f, tie ? "tie" : "indeterminate");
    dyd_put_rows(out, dyd_sphere_places(s), &sites, *end == '\n' ? " " : ", ");
    fputs(end, out);
  }
  dyd_index_list_clear(&sites);
  return st;
}

dyd_status dyd_sphere_layer_regions(const dyd_output *o) {
  const dyd_sphere *s = ((const dyd_sphere_result *)o->what)->sphere;
  dyd_csv_sphere_aliases(o->out, s);
  fputs("face,status,sites\n", o->out);
  return put_regions(o->out, s, "%s%zu,%s,", "", "\n");
}

/* ---- json ---- */

static void json_vertices(const dyd_sphere_result *r, const dyd_sphere_cells *c, FILE *out) {
  const dyd_engine *places = dyd_sphere_places(r->sphere);
  fputs("\"vertices\": [", out);
  for (size_t k = 0; k < c->nodes; k++) {
    const uint32_t *v = c->node[k].of.v;
    fprintf(out, "%s\n{\"i\": %zu, \"j\": %zu, \"k\": %zu, ", k ? "," : "", dyd_engine_row(places, v[0]),
            dyd_engine_row(places, v[1]), dyd_engine_row(places, v[2]));
    dyd_json_box(out, "", c->node[k].box);
    fputs("}", out);
  }
  fputs("\n],\n", out);
}

static void json_cells(const dyd_sphere_result *r, const dyd_sphere_cells *c, FILE *out) {
  const dyd_engine *places = dyd_sphere_places(r->sphere);
  const char *before = "";
  fputs("\"cells\": [", out);
  for (uint32_t i = 0; i < c->places; i++) {
    if (dyd_sphere_alias(r->sphere, i) != i) continue;
    fprintf(out, "%s\n{\"i\": %zu", before, dyd_engine_row(places, i));
    dyd_json_ids(out, places, &i, 0);
    fprintf(out, ", \"complete\": %s, \"vertices\": [", c->closed[i] ? "true" : "false");
    put_nodes(out, c, i, ", ", "null");
    fputs("]}", out);
    before = ",";
  }
  fputs("\n],\n", out);
}

dyd_status dyd_sphere_voronoi_json(const dyd_output *o) {
  const dyd_sphere_result *r = o->what;
  const dyd_engine *images = dyd_sphere_images(r->sphere);
  dyd_sphere_cells c = {0};
  dyd_status st = dyd_sphere_cells_find(&c, r->sphere, o->err);
  if (st == DYD_OK) {
    dyd_json_head(o->out, "dyadel sphere voronoi 1");
    dyd_json_crs(o->out, r->epsg);
    fprintf(o->out,
            "\"rounding\": \"x (longitude) and y (latitude) are degrees, rounded outward: the first down, the second "
            "up; null among the vertices of a cell: an undecided region is next\",\n\"surface\": \"sphere\",\n"
            "\"outcome\": \"%s\",\n",
            dyd_outcome_text(dyd_sphere_outcome(r->sphere)));
    json_vertices(r, &c, o->out);
    json_cells(r, &c, o->out);
    fputs("\"regions\": [", o->out);
    st = put_regions(o->out, r->sphere, "%s\n{\"face\": %zu, \"status\": \"%s\", \"sites\": [", ",", "]}");
    fputs("\n],\n", o->out);
    dyd_json_sphere_aliases(o->out, r->sphere, ",\n");
    dyd_json_counters(o->out, images);
    fputs("}\n", o->out);
  }
  dyd_sphere_cells_clear(&c);
  return st;
}
