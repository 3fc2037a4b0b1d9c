/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of the Voronoi diagram: the part certainly nearest to a point, the undetermined rest of the window,
 * rectangles, certain vertices, regions of undecided faces; or its tiles. */
#include "base/local.h"
#include "io/diagram.h"
#include "picture/picture.h"
#include <math.h>

/* Blues that neighbours rarely share; light, so that grey copies show the darker band between them. */
static const unsigned tints[4] = {0xdcebf5, 0xe8f2e4, 0xeee9f6, 0xe3f3f3};

/* Of rectangles, so that they are seen on the band. */
#define SITE 0x444444

typedef struct voronoi_drawing {
  const dyd_diagram *d;
  dyd_canvas *canvas;
  dyd_view view;
  dyd_status st;
  double window[4];
  bool cell, vertex, region; /* was drawn */
  dyd_error *err;
  bool tiles; /* instead of certain parts */
  dyd_site_marks marks;
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
  dyd_canvas_name(g->canvas, full_id, full_title);
}

static dyd_status voronoi_cell(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  voronoi_drawing *g = context;
  DYD_SCOPED(dyd_polygon) inner = {0};
  (void)row;
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK && inner.count) {
    name_of(g, "cell", "certainly nearest to", &i, 1);
    polygon_outline(g->canvas, &g->view, &inner);
    dyd_picture_shape(g->canvas, tints[i % 4], 1, 0x0072b2, g->view.line * 0.6);
    g->cell = true;
  }
  return st;
}

static dyd_status voronoi_tiles(voronoi_drawing *g) {
  const dyd_diagram *d = g->d;
  DYD_SCOPED(dyd_tiles) tiles = {0};
  dyd_status st = dyd_diagram_tiles(&tiles, d, false, g->err);
  for (size_t r = 0, end = 0; r < tiles.count && st == DYD_OK;) {
    uint32_t site = tiles.site[r];
    name_of(g, "tile", "tile of", &site, 1);
    dyd_diagram_tile(&end, d, &tiles);
    for (; r < end; r++) {
      for (size_t k = tiles.offset[r]; k < tiles.offset[r + 1]; k++)
        (k == tiles.offset[r] ? dyd_canvas_move : dyd_canvas_line)(g->canvas, dyd_view_x(&g->view, tiles.xy[2 * k]),
                                                                   dyd_view_y(&g->view, tiles.xy[2 * k + 1]));
      dyd_canvas_close(g->canvas);
    }
    dyd_picture_shape(g->canvas, tints[site % 4], 1, 0x0072b2, g->view.line * 0.6);
  }
  return st;
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
  dyd_canvas_name(g->canvas, id, title);
  dyd_picture_box(g->canvas, &g->view, show);
  dyd_picture_stroke(g->canvas, 0xd55e00, g->view.line, 4, 2.5);
  g->region = true;
  return DYD_OK;
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

static dyd_status voronoi_vertices(voronoi_drawing *g) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < dyd_diagram_vertices(g->d) && st == DYD_OK; k++) {
    const double *b = g->d->vertex[k];
    if (!dyd_diagram_vertex_in_window(g->d, k)) continue;
    if ((b[1] - b[0] + b[3] - b[2]) * g->view.scale > 12 * g->view.dot) continue; /* the band shows it better */
    double side = 1.6 * g->view.dot / g->view.scale, x = b[0] / 2 + b[1] / 2, y = b[2] / 2 + b[3] / 2;
    double wide = fmax(b[1] - b[0], side) / 2, high = fmax(b[3] - b[2], side) / 2,
           show[4] = {x - wide, x + wide, y - high, y + high};
    st = name_of_vertex(g, k);
    dyd_picture_box(g->canvas, &g->view, show);
    dyd_picture_stroke(g->canvas, 0x0072b2, g->view.line * 0.8, 0, 0);
    g->vertex = true;
  }
  return st;
}

static void bound_text(char *out, size_t size, const dyd_voronoi_bounds *b) {
  char area[DYD_DECIMAL_SIZE] = "unknown", far[DYD_DECIMAL_SIZE] = "unknown";
  double most = dyd_dyadic_get_d(&b->area, DYD_UP);
  if (isfinite(most)) dyd_decimal_directed(area, most, 3, DYD_UP);
  if (b->finite) dyd_decimal_directed(far, dyd_dyadic_get_d(&b->hausdorff, DYD_UP), 3, DYD_UP);
  snprintf(out, size, "undecided area at most %s, within %s of the true diagram", area, far);
}

static void voronoi_legend(dyd_canvas *c, void *context) {
  const voronoi_drawing *g = context;
  char text[300], bounds[120];
  dyd_legend l;
  if (g->st != DYD_OK) return; /* then there are no bounds */
  dyd_legend_begin(&l, c, &g->view);
  if (g->tiles) dyd_legend_patch(&l, tints[0], "tile of one point (any light tint)");
  if (g->cell) dyd_legend_patch(&l, tints[0], "certainly nearest to one point (any light tint)");
  if (!g->tiles && dyd_dyadic_sgn(&g->d->bounds->area) > 0) dyd_legend_patch(&l, DYD_PICTURE_BAND, "undecided");
  dyd_legend_marks(&l, &g->marks, 0x9b9b9b);
  if (g->vertex) dyd_legend_line(&l, 0x0072b2, 0, 0, "box: contains a certain vertex");
  if (g->region) dyd_legend_line(&l, 0xd55e00, 4, 2.5, "box: undecided vertices");
  bound_text(bounds, sizeof bounds, g->d->bounds);
  snprintf(text, sizeof text, "%zu points, outcome %s; %s", g->d->count,
           dyd_outcome_text(dyd_engine_outcome(g->d->engine)), bounds);
  dyd_legend_text(&l, text);
  dyd_legend_crowd(&l, &g->marks);
}

static void voronoi_inside(dyd_canvas *c, void *context) {
  voronoi_drawing *g = context;
  g->canvas = c;
  dyd_view_frame_path(c, &g->view);
  dyd_picture_fill(c, DYD_PICTURE_BAND);
  g->st = g->tiles ? voronoi_tiles(g) : dyd_diagram_visit(g->d, voronoi_cell, g);
  if (g->st == DYD_OK && !g->tiles) g->st = dyd_diagram_regions(g->d, voronoi_region, g);
  if (g->st == DYD_OK && !g->tiles) g->st = voronoi_vertices(g);
  dyd_site_marks_draw(&g->marks, c, &g->view);
}

dyd_status dyd_voronoi_picture(const dyd_output *o) {
  const dyd_diagram *what = o->what;
  voronoi_drawing g = {.d = what,
                       .err = o->err,
                       .tiles = o->content == DYD_CONTENT_TILES,
                       .marks = dyd_site_marks_of(what->pd, what->engine, SITE)};
  dyd_rect_get_d(g.window, &g.d->window);
  dyd_status st = dyd_view_fit(&g.view, g.window, dyd_view_spacing(g.d->pd, NULL, g.window), o->err);
  g.view.frame[0] = dyd_view_x(&g.view, g.window[0]), g.view.frame[1] = dyd_view_x(&g.view, g.window[1]);
  g.view.frame[2] = dyd_view_y(&g.view, g.window[3]), g.view.frame[3] = dyd_view_y(&g.view, g.window[2]);
  g.view.epsg = o->epsg;
  g.view.discs = what->discs;
  if (st == DYD_OK)
    st = dyd_view_write(o, &g.view, g.tiles ? "Voronoi tiles" : "partial Voronoi diagram", voronoi_inside,
                        voronoi_legend, &g);
  return g.st == DYD_OK ? st : g.st;
}
