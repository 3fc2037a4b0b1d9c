/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of the Voronoi diagram: the part certainly nearest to a point, the undetermined rest of the window,
 * rectangles, certain vertices, regions of undecided faces; or its tiles. */
#include "base/local.h"
#include "io/diagram.h"
#include "picture/picture.h"
#include <math.h>

static const unsigned tints[4] = {DYD_RGB_CELL_0, DYD_RGB_CELL_1, DYD_RGB_CELL_2, DYD_RGB_CELL_3};

/* row: whose elements are visited. */
typedef struct voronoi_drawing {
  const dyd_diagram *d;
  dyd_picture picture;
  const dyd_picture_layer *row;
  dyd_view view;
  double window[4];
  dyd_error *err;
  dyd_sites_shown marks;
} voronoi_drawing;

static void polygon_outline(dyd_canvas *c, const dyd_view *v, const dyd_polygon *p) {
  for (size_t k = 0; k < p->count; k++)
    dyd_canvas_line(c, dyd_view_x(v, dyd_dyadic_get_d(&p->vertex[k].x, DYD_DOWN)),
                    dyd_view_y(v, dyd_dyadic_get_d(&p->vertex[k].y, DYD_DOWN)));
  dyd_canvas_close(c);
}

/* "cell-7", "certainly nearest to 7"; or of several sites, separated by minus signs and commas. */
static void name_of(const voronoi_drawing *g, const char *id, const char *title, const uint32_t *site, size_t count) {
  char full_id[80], full_title[160];
  size_t a = (size_t)snprintf(full_id, sizeof full_id, "%s", id);
  size_t b = (size_t)snprintf(full_title, sizeof full_title, "%s", title);
  for (size_t k = 0; k < count && k < 3; k++) {
    a += (size_t)snprintf(full_id + a, sizeof full_id - a, "-%zu", dyd_engine_row(g->d->engine, site[k]));
    b += (size_t)snprintf(full_title + b, sizeof full_title - b, "%s %zu", k ? "," : "",
                          dyd_engine_row(g->d->engine, site[k]));
  }
  dyd_canvas_name(g->picture.canvas, full_id, full_title);
}

static dyd_status voronoi_cell(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  voronoi_drawing *g = context;
  DYD_SCOPED(dyd_polygon) inner = {0};
  (void)row;
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK && inner.count) {
    name_of(g, "cell", "certainly nearest to", &i, 1);
    polygon_outline(g->picture.canvas, &g->view, &inner);
    dyd_picture_tint(&g->picture, g->row, tints[i % 4]);
  }
  return st;
}

static void inner_walk(dyd_picture *p, const dyd_picture_layer *l) {
  voronoi_drawing *g = p->what;
  g->row = l;
  p->st = dyd_diagram_visit(g->d, voronoi_cell, g);
}

static void tiles_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const voronoi_drawing *g = p->what;
  const dyd_diagram *d = g->d;
  DYD_SCOPED(dyd_tiles) tiles = {0};
  dyd_picture_seen(p, l);
  p->st = dyd_diagram_tiles(&tiles, d, false, g->err);
  for (size_t r = 0, end = 0; r < tiles.count && p->st == DYD_OK;) {
    uint32_t site = tiles.site[r];
    name_of(g, "tile", "tile of", &site, 1);
    dyd_diagram_tile(&end, d, &tiles);
    for (; r < end; r++) {
      for (size_t k = tiles.offset[r]; k < tiles.offset[r + 1]; k++)
        (k == tiles.offset[r] ? dyd_canvas_move : dyd_canvas_line)(p->canvas, dyd_view_x(p->view, tiles.xy[2 * k]),
                                                                   dyd_view_y(p->view, tiles.xy[2 * k + 1]));
      dyd_canvas_close(p->canvas);
    }
    dyd_picture_tint(p, l, tints[site % 4]);
  }
}

/* A tied face has one vertex, which is drawn as such. */
static dyd_status voronoi_region(void *context, size_t face, const double box[4]) {
  voronoi_drawing *g = context;
  char id[48], title[80];
  if (dyd_dual_tied(g->d->tied, g->d->ties, face)) return DYD_OK;
  if (!box || (box[1] - box[0] + box[3] - box[2]) * g->view.scale > 60 * g->view.dot)
    return DYD_OK;                              /* a large one would hide its surroundings */
  double pad = 2 * g->view.dot / g->view.scale, /* so that it is seen however small */
      show[4] = {box[0] - pad, box[1] + pad, box[2] - pad, box[3] + pad};
  snprintf(id, sizeof id, "region-%zu", face);
  snprintf(title, sizeof title, "undecided vertices of face %zu", face);
  dyd_canvas_name(g->picture.canvas, id, title);
  dyd_picture_box(g->picture.canvas, &g->view, show);
  dyd_picture_paint(&g->picture, g->row);
  return DYD_OK;
}

static void faces_walk(dyd_picture *p, const dyd_picture_layer *l) {
  voronoi_drawing *g = p->what;
  g->row = l;
  p->st = dyd_diagram_regions(g->d, voronoi_region, g);
}

/* A tied one is named by its first sites. */
static dyd_status name_of_vertex(const voronoi_drawing *g, size_t k) {
  DYD_SCOPED(dyd_index_list) sites = {0};
  dyd_status st = dyd_diagram_vertex_sites(&sites, g->d, k);
  bool tied = sites.count > 3;
  if (st == DYD_OK)
    name_of(g, "vertex", tied ? "holds the vertex of a tie, of" : "holds the vertex of", sites.item, sites.count);
  return st;
}

static void vertices_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const voronoi_drawing *g = p->what;
  for (size_t k = 0; k < dyd_diagram_vertices(g->d) && p->st == DYD_OK; k++) {
    const double *b = g->d->vertex[k];
    if (!dyd_diagram_vertex_in_window(g->d, k)) continue;
    if ((b[1] - b[0] + b[3] - b[2]) * g->view.scale > 12 * g->view.dot) continue; /* the band shows it better */
    double side = 1.6 * g->view.dot / g->view.scale, x = b[0] / 2 + b[1] / 2, y = b[2] / 2 + b[3] / 2;
    double wide = fmax(b[1] - b[0], side) / 2, high = fmax(b[3] - b[2], side) / 2,
           show[4] = {x - wide, x + wide, y - high, y + high};
    p->st = name_of_vertex(g, k);
    dyd_picture_box(p->canvas, p->view, show);
    dyd_picture_paint(p, l);
  }
}

static void band_entry(dyd_legend *legend, const dyd_picture *p, const dyd_picture_layer *l) {
  const voronoi_drawing *g = p->what;
  if (dyd_dyadic_sgn(&g->d->bounds->area) > 0) dyd_legend_put(legend, l, l->text);
}

static void bound_text(char *out, size_t size, const dyd_voronoi_bounds *b) {
  char area[DYD_DECIMAL_SIZE] = "unknown", far[DYD_DECIMAL_SIZE] = "unknown";
  double most = dyd_dyadic_get_d(&b->area, DYD_UP);
  if (isfinite(most)) dyd_decimal_directed(area, most, 3, DYD_UP);
  if (b->finite) dyd_decimal_directed(far, dyd_dyadic_get_d(&b->hausdorff, DYD_UP), 3, DYD_UP);
  snprintf(out, size, "undecided area at most %s, within %s of the true diagram", area, far);
}

static void voronoi_notes(dyd_legend *legend, const dyd_picture *p) {
  const voronoi_drawing *g = p->what;
  char text[300], bounds[120];
  bound_text(bounds, sizeof bounds, g->d->bounds);
  snprintf(text, sizeof text, "%zu points, outcome %s; %s", g->d->count,
           dyd_outcome_text(dyd_engine_outcome(g->d->engine)), bounds);
  dyd_legend_text(legend, text);
  dyd_legend_crowd(legend, p->sites);
}

/* Of rectangles, so that they are seen on the band. */
#define SITES(place) DYD_SITES_LAYERS(dyd_sites_walk, dyd_sites_entry, 0x444444, 0x9b9b9b, place)
#define CELL DYD_STYLE_SHAPE(DYD_RGB_CELL_0, DYD_RGB_LEGAL, 0.6, 0)

static const dyd_picture_layer voronoi_rows[] = {
    {dyd_frame_walk, 0, DYD_STYLE_FILL(DYD_RGB_BAND), DYD_KEY_PATCH, 2, "undecided", band_entry},
    {inner_walk, 0, CELL, DYD_KEY_PATCH, 1, "certainly nearest to one point (any light tint)", NULL},
    {faces_walk, 0, DYD_STYLE_LINE(DYD_RGB_INDETERMINATE, 1, 4, 2.5), DYD_KEY_LINE, 5, "box: undecided vertices", NULL},
    {vertices_walk, 0, DYD_STYLE_LINE(DYD_RGB_LEGAL, 0.8, 0, 0), DYD_KEY_LINE, 4, "box: contains a certain vertex",
     NULL},
    SITES(3)};

static const dyd_picture_layer tiles_rows[] = {
    {dyd_frame_walk, 0, DYD_STYLE_FILL(DYD_RGB_BAND), DYD_KEY_NONE, 0, "in no tile", NULL},
    {tiles_walk, 0, CELL, DYD_KEY_PATCH, 1, "tile of one point (any light tint)", NULL},
    SITES(2)};

const dyd_picture_table dyd_voronoi_layers = DYD_PICTURE_TABLE(voronoi_rows, voronoi_notes),
                        dyd_tiles_layers = DYD_PICTURE_TABLE(tiles_rows, voronoi_notes);

dyd_status dyd_voronoi_picture(const dyd_output *o) {
  const dyd_diagram *what = o->what;
  const bool tiles = o->content == DYD_CONTENT_TILES;
  voronoi_drawing g = {.d = what, .err = o->err, .marks = dyd_sites_shown_of(what->pd, what->engine)};
  g.picture = (dyd_picture){tiles ? &dyd_tiles_layers : &dyd_voronoi_layers,
                            tiles ? "Voronoi tiles" : "partial Voronoi diagram", .view = &g.view, .what = &g,
                            .sites = &g.marks};
  dyd_rect_get_d(g.window, &g.d->window);
  dyd_status st = dyd_view_fit(&g.view, g.window, dyd_view_spacing(g.d->pd, NULL, g.window), o->err);
  g.view.frame[0] = dyd_view_x(&g.view, g.window[0]), g.view.frame[1] = dyd_view_x(&g.view, g.window[1]);
  g.view.frame[2] = dyd_view_y(&g.view, g.window[3]), g.view.frame[3] = dyd_view_y(&g.view, g.window[2]);
  g.view.epsg = o->epsg;
  g.view.discs = what->discs;
  return st == DYD_OK ? dyd_picture_write(&g.picture, o) : st;
}
