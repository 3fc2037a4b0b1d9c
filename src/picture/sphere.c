/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pictures of a sphere: longitude to the right, latitude upwards, a degree of both alike, with a graticule; sides are
 * great circles. What spans more than half of the globe is shown on all of it. */
#include "base/alloc.h"
#include "io/geodesic.h"
#include "io/sphere_cells.h"
#include "picture/picture.h"
#include <math.h>

#define GRATICULE 0xd0d0d0

static const struct {
  dyd_pair_status status;
  const char *name;
  unsigned rgb;
  double on, off;
} kind[] = {{DYD_TIE, "tie", 0xcc79a7, 1.5, 1.5},
            {DYD_INDETERMINATE, "indeterminate", DYD_PICTURE_BAND, 4, 2},
            {DYD_LEGAL, "legal", 0x0072b2, 0, 0}};

/* cells: of the diagram, NULL: edges are drawn. */
typedef struct sphere_drawing {
  const dyd_sphere_result *r;
  const dyd_sphere_cells *cells;
  double (*box)[4]; /* of places */
  size_t count, shown[4];
  dyd_view view;
  dyd_status failed;
} sphere_drawing;

static void page_line(dyd_canvas *c, const dyd_view *v, bool move, double lon, double lat) {
  double x = dyd_view_x(v, lon), y = dyd_view_y(v, lat);
  if (move)
    dyd_canvas_move(c, x, y);
  else
    dyd_canvas_line(c, x, y);
}

/* Beyond 180 degrees it goes on at the other side of the map. */
static void arc_path(dyd_canvas *c, sphere_drawing *d, dyd_lon_lat a, dyd_lon_lat b) {
  const dyd_lon_lat corner[2] = {a, b};
  dyd_lon_lat *p = NULL;
  size_t n = 0;
  dyd_status st = dyd_great_circles(&p, &n, corner, 2);
  for (size_t k = 0; k < n; k++) {
    double turn = !k ? 0 : p[k].lon - p[k - 1].lon > 180 ? 360 : p[k].lon - p[k - 1].lon < -180 ? -360 : 0;
    if (turn != 0) {
      page_line(c, &d->view, false, p[k].lon - turn, p[k].lat);
      page_line(c, &d->view, true, p[k - 1].lon + turn, p[k - 1].lat);
    }
    page_line(c, &d->view, k == 0, p[k].lon, p[k].lat);
  }
  free(p);
  if (st != DYD_OK) d->failed = st;
}

static void draw_graticule(dyd_canvas *c, const sphere_drawing *d, const double box[4]) {
  int digit, exponent;
  double span = fmax(box[1] - box[0], box[3] - box[2]);
  if (!dyd_round_step(&digit, &exponent, span / 6)) return;
  double step = span > 180 ? 30 : digit * pow(10, exponent);
  for (double x = ceil(box[0] / step) * step; x <= box[1]; x += step) {
    page_line(c, &d->view, true, x, fmax(box[2], -90));
    page_line(c, &d->view, false, x, fmin(box[3], 90));
  }
  for (double y = ceil(fmax(box[2], -90) / step) * step; y <= fmin(box[3], 90); y += step) {
    page_line(c, &d->view, true, box[0], y);
    page_line(c, &d->view, false, box[1], y);
  }
  dyd_picture_stroke(c, GRATICULE, 0.5, 0, 0);
}

static void draw_pairs(dyd_canvas *c, sphere_drawing *d) {
  const dyd_pair_list *l = &d->r->pairs;
  for (int k = 0; k < 3; k++) {
    for (size_t p = 0; p < l->count; p++) {
      if (l->item[p].status != kind[k].status) continue;
      arc_path(c, d, dyd_lon_lat_of(d->box[l->item[p].i]), dyd_lon_lat_of(d->box[l->item[p].j]));
    }
    if (d->shown[kind[k].status]) dyd_picture_stroke(c, kind[k].rgb, d->view.line, kind[k].on, kind[k].off);
  }
}

/* Sides between vertices that follow each other in a cell, each once. */
static void draw_cells(dyd_canvas *c, sphere_drawing *d) {
  const dyd_sphere_cells *g = d->cells;
  size_t drawn = 0;
  for (size_t i = 0; i < g->places; i++)
    for (size_t k = g->first[i]; k < g->first[i + 1]; k++) {
      bool last = k + 1 == g->first[i + 1];
      size_t next = last ? g->first[i] : k + 1;
      if ((last && !g->closed[i]) || g->gap[next] || g->of[k] >= g->of[next]) continue;
      arc_path(c, d, dyd_lon_lat_of(g->node[g->of[k]].box), dyd_lon_lat_of(g->node[g->of[next]].box));
      drawn++;
    }
  if (drawn) dyd_picture_stroke(c, kind[2].rgb, d->view.line, 0, 0);
}

static void sphere_inside(dyd_canvas *c, void *context) {
  sphere_drawing *d = context;
  const dyd_view *v = &d->view;
  const double box[4] = {v->left, v->left + v->width / v->scale, v->top - v->height / v->scale, v->top};
  draw_graticule(c, d, box);
  if (d->cells)
    draw_cells(c, d);
  else
    draw_pairs(c, d);
  for (size_t i = 0; i < d->count; i++) dyd_picture_site(c, v, d->box[i], dyd_sphere_places(d->r->sphere), i, 0xf2c766);
}

static void sphere_legend(dyd_canvas *c, void *context) {
  const sphere_drawing *d = context;
  char text[200];
  dyd_legend l;
  dyd_legend_begin(&l, c, &d->view);
  for (int k = 2; k >= 0 && !d->cells; k--) {
    if (!d->shown[kind[k].status]) continue;
    snprintf(text, sizeof text, "%s: %zu", kind[k].name, d->shown[kind[k].status]);
    dyd_legend_line(&l, kind[k].rgb, kind[k].on, kind[k].off, text);
  }
  if (d->cells) dyd_legend_line(&l, kind[2].rgb, 0, 0, "side of a cell");
  dyd_legend_dot(&l, 0x222222, 0x222222, "point");
  dyd_legend_line(&l, GRATICULE, 0, 0, "graticule, degrees");
  snprintf(text, sizeof text,
           "%zu points on a sphere, outcome %s, %zu undecided faces; great circles on a plate carr\u00e9e", d->count,
           dyd_outcome_text(dyd_sphere_outcome(d->r->sphere)), dyd_sphere_faces(d->r->sphere));
  dyd_legend_text(&l, text);
}

/* The usual length of an edge on the page, in degrees. */
static double sphere_spacing(const sphere_drawing *d) {
  enum { SAMPLES = 1000 };
  double length[SAMPLES];
  const dyd_pair_list *pairs = &d->r->pairs;
  size_t n = 0, step = pairs->count / SAMPLES + 1;
  for (size_t k = 0; k < pairs->count; k += step) {
    const double *a = d->box[pairs->item[k].i], *b = d->box[pairs->item[k].j];
    double x = fabs(a[0] - b[0]);
    length[n++] = hypot(fmin(x, fabs(360 - x)), a[2] - b[2]);
  }
  return dyd_view_median(length, n);
}

/* The places, and what is shown: their surroundings, or all. */
static dyd_status sphere_see(sphere_drawing *d, dyd_error *err) {
  double all[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  dyd_rect rect;
  dyd_status st = DYD_OK;
  dyd_rect_init(&rect);
  for (uint32_t i = 0; i < d->count && st == DYD_OK; i++) {
    st = dyd_sphere_rect(&rect, d->r->sphere, i);
    if (st != DYD_OK) break;
    dyd_rect_get_d(d->box[i], &rect);
    for (int k = 0; k < 4; k++) all[k] = k & 1 ? fmax(all[k], d->box[i][k]) : fmin(all[k], d->box[i][k]);
  }
  dyd_rect_clear(&rect);
  if (st != DYD_OK) return st;
  if (d->count && all[1] - all[0] < 180) dyd_view_pad(all);
  if (!d->count || !(all[1] - all[0] < 180)) all[0] = -180, all[1] = 180, all[2] = -90, all[3] = 90;
  for (size_t p = 0; p < d->r->pairs.count; p++) d->shown[d->r->pairs.item[p].status]++;
  st = dyd_view_fit(&d->view, all, sphere_spacing(d), err);
  d->view.unit = "degree";
  return st;
}

static dyd_status sphere_draw(const dyd_output *o, const dyd_sphere_cells *cells, const char *title) {
  sphere_drawing d = {.r = o->what, .cells = cells};
  d.count = dyd_engine_count(dyd_sphere_places(d.r->sphere));
  d.box = dyd_alloc(d.count, sizeof *d.box);
  dyd_status st = d.box ? sphere_see(&d, o->err) : DYD_E_NOMEM;
  if (st == DYD_OK) st = dyd_view_write(o, &d.view, title, sphere_inside, sphere_legend, &d);
  free(d.box);
  return st == DYD_OK ? d.failed : st;
}

dyd_status dyd_sphere_picture(const dyd_output *o) {
  return sphere_draw(o, NULL, "partial Delaunay triangulation of a sphere");
}

dyd_status dyd_sphere_voronoi_picture(const dyd_output *o) {
  const dyd_sphere_result *r = o->what;
  dyd_sphere_cells cells = {0};
  dyd_status st = dyd_sphere_cells_find(&cells, r->sphere, o->err);
  if (st == DYD_OK) st = sphere_draw(o, &cells, "Voronoi diagram of a sphere");
  dyd_sphere_cells_clear(&cells);
  return st;
}
