/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of the Voronoi diagram: what is surely nearest to a point, the undetermined rest of the window,
 * rectangles, sure vertices, regions of undecided faces. */
#include "io/diagram.h"
#include "picture/picture.h"
#include <math.h>

/* Blues that neighbours rarely share; light, so that grey copies show the darker band between them. */
static const unsigned tints[4] = {0xdcebf5, 0xe8f2e4, 0xeee9f6, 0xe3f3f3};

/* Of rectangles, so that they are seen on the band. */
#define SITE 0x444444

typedef struct voronoi_drawing {
  const dyd_diagram *d;
  cairo_t *cr;
  dyd_view view;
  dyd_status st;
  double window[4];
} voronoi_drawing;

static void polygon_outline(cairo_t *cr, const dyd_view *v, const dyd_polygon *p) {
  cairo_new_path(cr);
  for (size_t k = 0; k < p->count; k++)
    cairo_line_to(cr, dyd_view_x(v, dyd_dyadic_get_d(&p->vertex[k].x, DYD_DOWN)),
                  dyd_view_y(v, dyd_dyadic_get_d(&p->vertex[k].y, DYD_DOWN)));
  cairo_close_path(cr);
}

static dyd_status voronoi_cell(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  voronoi_drawing *g = context;
  dyd_polygon inner = {0};
  (void)row;
  dyd_status st = dyd_shape_inner(&inner, shape);
  if (st == DYD_OK && inner.count) {
    polygon_outline(g->cr, &g->view, &inner);
    dyd_picture_colour(g->cr, tints[i % 4]);
    cairo_fill_preserve(g->cr);
    dyd_picture_stroke(g->cr, 0x0072b2, g->view.line * 0.6, 0, 0);
  }
  dyd_polygon_clear(&inner);
  return st;
}

static void box_path(cairo_t *cr, const dyd_view *v, const double b[4]) {
  cairo_new_path(cr);
  cairo_rectangle(cr, dyd_view_x(v, b[0]), dyd_view_y(v, b[3]), (b[1] - b[0]) * v->scale, (b[3] - b[2]) * v->scale);
}

static dyd_status voronoi_region(void *context, size_t face, const double box[4]) {
  const voronoi_drawing *g = context;
  (void)face;
  if (!box || (box[1] - box[0] + box[3] - box[2]) * g->view.scale > 60 * g->view.dot)
    return DYD_OK;                              /* a large one would hide what it is about */
  double pad = 2 * g->view.dot / g->view.scale, /* so that it is seen however small */
      show[4] = {box[0] - pad, box[1] + pad, box[2] - pad, box[3] + pad};
  box_path(g->cr, &g->view, show);
  dyd_picture_stroke(g->cr, 0xd55e00, g->view.line, 4, 2.5);
  return DYD_OK;
}

static void voronoi_vertices(const voronoi_drawing *g) {
  for (size_t k = 0; k < g->d->triangles.count; k++) {
    const double *b = g->d->vertex[k], *w = g->window;
    if (!(b[0] <= w[1] && w[0] <= b[1] && b[2] <= w[3] && w[2] <= b[3])) continue;
    if ((b[1] - b[0] + b[3] - b[2]) * g->view.scale > 12 * g->view.dot) continue; /* the band shows it better */
    double side = 1.6 * g->view.dot / g->view.scale, x = b[0] / 2 + b[1] / 2, y = b[2] / 2 + b[3] / 2;
    double wide = fmax(b[1] - b[0], side) / 2, high = fmax(b[3] - b[2], side) / 2,
           show[4] = {x - wide, x + wide, y - high, y + high};
    box_path(g->cr, &g->view, show);
    dyd_picture_stroke(g->cr, 0x0072b2, g->view.line * 0.8, 0, 0);
  }
}

static void bound_text(char *out, size_t size, const dyd_voronoi_bounds *b) {
  char area[DYD_DECIMAL_SIZE], far[DYD_DECIMAL_SIZE] = "unknown";
  dyd_decimal_directed(area, dyd_dyadic_get_d(&b->area, DYD_UP), 3, DYD_UP);
  if (b->finite) dyd_decimal_directed(far, dyd_dyadic_get_d(&b->hausdorff, DYD_UP), 3, DYD_UP);
  snprintf(out, size, "undetermined area at most %s, within %s of the true diagram", area, far);
}

static void voronoi_legend(cairo_t *cr, void *context) {
  const voronoi_drawing *g = context;
  char text[300], bounds[120];
  double y = dyd_view_legend(&g->view), x = 30;
  if (g->st != DYD_OK) return; /* then there are no bounds */
  dyd_picture_entry(cr, &x, y, tints[0], true, 0, 0, "surely nearest to one point");
  dyd_picture_entry(cr, &x, y, DYD_PICTURE_BAND, true, 0, 0, "undetermined");
  dyd_picture_scale(cr, &g->view, y);
  x = 30, y += DYD_PICTURE_ROW;
  dyd_picture_entry(cr, &x, y, 0x9b9b9b, true, 0, 0, "rectangle of a point");
  dyd_picture_entry(cr, &x, y, 0x0072b2, false, 0, 0, "box: a sure vertex is in it");
  dyd_picture_entry(cr, &x, y, 0xd55e00, false, 4, 2.5, "box: undecided vertices");
  bound_text(bounds, sizeof bounds, g->d->bounds);
  snprintf(text, sizeof text, "%zu points, outcome %s; %s", g->d->count,
           dyd_outcome_text(dyd_engine_outcome(g->d->engine)), bounds);
  dyd_picture_text(cr, 30, y + DYD_PICTURE_ROW + 5, 0, 14, text);
}

static void voronoi_inside(cairo_t *cr, void *context) {
  voronoi_drawing *g = context;
  g->cr = cr;
  dyd_picture_colour(cr, DYD_PICTURE_BAND);
  cairo_paint(cr);
  g->st = dyd_diagram_visit(g->d, voronoi_cell, g);
  if (g->st == DYD_OK) g->st = dyd_diagram_regions(g->d, voronoi_region, g);
  voronoi_vertices(g);
  for (size_t i = 0; i < g->d->count; i++) {
    double b[4];
    dyd_sites_get_d(b, g->d->sites, i);
    if (isfinite(b[0]) && isfinite(b[1]) && isfinite(b[2]) && isfinite(b[3]))
      dyd_picture_site(cr, &g->view, b, dyd_sites_is_point(g->d->sites, i), SITE);
  }
}

dyd_status dyd_voronoi_picture(const dyd_output *o) {
  voronoi_drawing g = {.d = o->what};
  dyd_rect_get_d(g.window, &g.d->window);
  dyd_status st = dyd_view_fit(&g.view, g.window, dyd_view_spacing(g.d->pd, g.window), o->err);
  g.view.frame[0] = dyd_view_x(&g.view, g.window[0]), g.view.frame[1] = dyd_view_x(&g.view, g.window[1]);
  g.view.frame[2] = dyd_view_y(&g.view, g.window[3]), g.view.frame[3] = dyd_view_y(&g.view, g.window[2]);
  if (st == DYD_OK) st = dyd_view_write(o, &g.view, voronoi_inside, voronoi_legend, &g);
  return g.st == DYD_OK ? st : g.st;
}
