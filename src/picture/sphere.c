/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pictures of plans, with the points to measure by their ranks, and pairs by the points that decide them; and of a
 * sphere: longitude to the right, latitude upwards, a degree of both alike, with a graticule; sides are great circles.
 * What spans more than half of the globe is shown on all of it. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "base/local.h"
#include "io/geodesic.h"
#include "picture/picture.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- plans ---- */

/* Classes of pairs: decided by the first quarter of the rows of a plan, and so on; not by it; legal already. */
enum { QUARTERS = 4, LEFT = QUARTERS, LEGAL, CLASSES };

/* A plan in a picture. shown: pairs drawn of each class. */
typedef struct plan_dress {
  const dyd_survey *plan;
  const dyd_survey_pair *pair;
  size_t pairs, shown[CLASSES];
  dyd_plan_marks marks;
} plan_dress;

/* By quarters of the ranks, then pairs that stay undecided, then decided ones; distinct for all kinds of sight, and in
 * grey. */
static const struct {
  unsigned rgb;
  double on, off, width;
} dress[CLASSES] = {{0xd55e00, 0, 0, 1.8}, {0xe69f00, 7, 2, 1.6},   {0x56b4e9, 3, 2, 1.6},
                    {0x004c80, 1, 2, 1.6}, {0x333333, 0.2, 2.2, 1}, {0xc8c8c8, 0, 0, 0.7}};

/* The quarter of row k, from 0. */
static int quarter_of(const plan_dress *d, size_t k) {
  return (int)(QUARTERS * k / d->marks.rows);
}

static dyd_status plan_dress_init(plan_dress *d, const dyd_survey *plan, size_t sites) {
  *d = (plan_dress){.plan = plan};
  if (!DYD_ZEROED(d->marks.rank, sites + 1) || !DYD_NEW(d->marks.rgb, sites)) return DYD_E_NOMEM;
  d->marks.rows = dyd_survey_rows(&d->marks.row, plan);
  d->pairs = dyd_survey_pairs(&d->pair, plan);
  for (size_t i = 0; i < sites; i++) d->marks.rgb[i] = 0xd8d8d8;
  for (size_t k = 0; k < d->marks.rows; k++) {
    d->marks.rank[d->marks.row[k].site] = k + 1;
    d->marks.rgb[d->marks.row[k].site] = dress[quarter_of(d, k)].rgb;
  }
  return DYD_OK;
}

static void plan_dress_clear(plan_dress *d) {
  dyd_free_all(d->marks.rank, d->marks.rgb);
}

static const dyd_survey_pair *plan_pair(const plan_dress *d, const dyd_pair *p) {
  return dyd_find_two(p, d->pair, d->pairs, sizeof *d->pair);
}

static int plan_class(const plan_dress *d, const dyd_pair *p) {
  if (p->status == DYD_LEGAL) return LEGAL;
  const dyd_survey_pair *found = plan_pair(d, p);
  return found && found->row < d->marks.rows ? quarter_of(d, found->row) : LEFT;
}

/* Names and strokes the line of a pair of sites of e, which is the path. */
static void plan_stroke(dyd_canvas *c, const plan_dress *d, const dyd_view *v, const dyd_engine *e, const dyd_pair *p) {
  char text[80] = "legal";
  const int class = plan_class(d, p);
  if (class < QUARTERS)
    snprintf(text, sizeof text, "decided by point %zu of the plan", plan_pair(d, p)->row + 1);
  else if (class == LEFT)
    snprintf(text, sizeof text, "not decided by the plan");
  dyd_picture_name_pair(c, e, p->i, p->j, text);
  dyd_picture_stroke(c, dress[class].rgb, v->line * dress[class].width, dress[class].on, dress[class].off);
}

/* The ranks of a quarter: first to last; false: none. */
static bool quarter_ranks(size_t *first, size_t *last, const plan_dress *d, int quarter) {
  *first = *last = 0;
  for (size_t k = 0; k < d->marks.rows; k++)
    if (quarter_of(d, k) == quarter) *first = *first ? *first : k + 1, *last = k + 1;
  return *first;
}

static void plan_legend(dyd_legend *l, const plan_dress *d) {
  const dyd_survey_result *of = dyd_survey_get(d->plan);
  char text[160];
  for (int k = 0; k < CLASSES; k++) {
    size_t first = 0, last = 0;
    if (k < QUARTERS ? !quarter_ranks(&first, &last, d, k) : !d->shown[k]) continue;
    if (k == LEGAL)
      snprintf(text, sizeof text, "legal already: %zu", d->shown[k]);
    else if (k == LEFT)
      snprintf(text, sizeof text, "not decided by the plan: %zu", d->shown[k]);
    else if (first == last)
      snprintf(text, sizeof text, "point %zu, decides %zu", first, d->shown[k]);
    else
      snprintf(text, sizeof text, "points %zu to %zu, decide %zu", first, last, d->shown[k]);
    dyd_legend_line(l, dress[k].rgb, dress[k].on, dress[k].off, text);
  }
  snprintf(text, sizeof text, "labels: rank: point; %zu points to measure, %zu of %zu undecided pairs stay so%s",
           d->marks.rows, of->left, of->open, of->cut ? "; the plan is not finished" : "");
  dyd_legend_text(l, text);
}

/* ---- spheres ---- */

#define GRATICULE 0xd0d0d0
#define RECTANGLE 0xf2c766
enum { OPEN = 1 };

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
  const dyd_result *r;
  const dyd_sphere_cells *cells;
  double (*box)[4];              /* of places, whose middles are on the map */
  size_t count, sites, shown[4]; /* sites, shown: places and edges in the frame */
  double seam;                   /* the longitude of the left end of the map, of 360 degrees */
  dyd_view view;
  dyd_site_marks marks;
  plan_dress plan;  /* where r holds one */
  dyd_density open; /* of indeterminate edges */
  bool crowded;     /* it is drawn instead of them */
  dyd_canvas *canvas;
  /* The line at hand: where it is on the page; is it in the frame, and of an indeterminate edge? */
  double at[2];
  bool seen, is_open;
  dyd_status failed;
} sphere_drawing;

/* ---- lines ---- */

/* The next place of a line; begin: it begins here. */
typedef void (*arc_step)(sphere_drawing *d, bool begin, double x, double y);

static void arc_draw(sphere_drawing *d, bool begin, double x, double y) {
  if (begin)
    dyd_canvas_move(d->canvas, x, y);
  else
    dyd_canvas_line(d->canvas, x, y);
}

/* Counts the part in the frame. */
static void arc_count(sphere_drawing *d, bool begin, double x, double y) {
  double z[2][2] = {{d->at[0], d->at[1]}, {x, y}};
  if (begin) dyd_density_begin(&d->open);
  if (!begin && dyd_clip_segment(z, d->view.frame)) {
    d->seen = true;
    if (d->is_open) dyd_density_add(&d->open, z);
  }
  d->at[0] = x, d->at[1] = y;
}

static void arc_to(sphere_drawing *d, arc_step step, bool begin, double lon, double lat) {
  step(d, begin, dyd_view_x(&d->view, lon), dyd_view_y(&d->view, lat));
}

static double map_longitude(const sphere_drawing *d, double lon) {
  return lon - 360 * floor((lon - d->seam) / 360);
}

/* Beyond the seam it continues at the other side of the map. */
static void side_follow(sphere_drawing *d, const dyd_side *side, bool whole, arc_step step) {
  DYD_FREED dyd_lon_lat *p = NULL;
  size_t n = 0;
  dyd_status st = dyd_side_places(&p, &n, side, whole);
  for (size_t k = 0; k < n; k++) {
    p[k].lon = map_longitude(d, p[k].lon);
    double turn = !k ? 0 : p[k].lon - p[k - 1].lon > 180 ? 360 : p[k].lon - p[k - 1].lon < -180 ? -360 : 0;
    if (turn != 0) {
      arc_to(d, step, false, p[k].lon - turn, p[k].lat);
      arc_to(d, step, true, p[k - 1].lon + turn, p[k - 1].lat);
    }
    arc_to(d, step, k == 0, p[k].lon, p[k].lat);
  }
  if (st != DYD_OK) d->failed = st;
}

static void arc_follow(sphere_drawing *d, const double *from, const double *to, arc_step step) {
  side_follow(d, &(dyd_side){.from = dyd_lon_lat_of(from), .to = dyd_lon_lat_of(to)}, false, step);
}

static void draw_graticule(sphere_drawing *d) {
  const dyd_view *v = &d->view;
  const double left = v->left, right = left + v->width / v->scale, bottom = v->top - v->height / v->scale;
  double span = fmax(right - left, v->top - bottom);
  int digit, exponent;
  if (!dyd_round_step(&digit, &exponent, span / 6)) return;
  double step = span > 180 ? 30 : digit * pow(10, exponent);
  if (step < 0x1p-40) return; /* 720 degrees have an ulp of 2^-43 */
  for (double x = ceil(left / step) * step; x <= right; x += step) {
    arc_to(d, arc_draw, true, x, fmax(bottom, -90));
    arc_to(d, arc_draw, false, x, fmin(v->top, 90));
  }
  for (double y = ceil(fmax(bottom, -90) / step) * step; y <= fmin(v->top, 90); y += step) {
    arc_to(d, arc_draw, true, left, y);
    arc_to(d, arc_draw, false, right, y);
  }
  dyd_picture_stroke(d->canvas, GRATICULE, 0.5, 0, 0);
}

static void draw_plan(sphere_drawing *d) {
  for (int class = CLASSES; class --;)
    for (size_t k = 0; k < d->r->pairs.count; k++) {
      const dyd_pair *p = &d->r->pairs.item[k];
      if (plan_class(&d->plan, p) != class) continue;
      d->plan.shown[class]++;
      arc_follow(d, d->box[p->i], d->box[p->j], arc_draw);
      plan_stroke(d->canvas, &d->plan, &d->view, d->r->engine, p);
    }
}

static void draw_pairs(sphere_drawing *d) {
  const dyd_pair_list *l = &d->r->pairs;
  const dyd_engine *places = dyd_sphere_places(d->r->sphere);
  for (int k = 0; k < 3; k++) {
    if (d->crowded && k == OPEN) continue;
    for (size_t p = 0; p < l->count; p++) {
      if (l->item[p].status != kind[k].status) continue;
      arc_follow(d, d->box[l->item[p].i], d->box[l->item[p].j], arc_draw);
      if (l->count > DYD_PICTURE_NAMES) continue;
      dyd_picture_name_pair(d->canvas, places, l->item[p].i, l->item[p].j, kind[k].name);
      dyd_picture_stroke(d->canvas, kind[k].rgb, d->view.line, kind[k].on, kind[k].off);
    }
    if (d->shown[kind[k].status] && l->count > DYD_PICTURE_NAMES)
      dyd_picture_stroke(d->canvas, kind[k].rgb, d->view.line, kind[k].on, kind[k].off);
  }
}

/* Sides between vertices that follow each other in a cell, each once; and the one of two halves. */
static void draw_cells(sphere_drawing *d) {
  const dyd_sphere_cells *g = d->cells;
  size_t drawn = 0;
  dyd_side side;
  for (uint32_t i = 0; i < g->places; i++) {
    if (!drawn && dyd_sphere_cell_is_half(&side, g, d->r->sphere, i)) side_follow(d, &side, true, arc_draw), drawn++;
    for (size_t k = g->first[i]; k < g->first[i + 1]; k++) {
      bool last = k + 1 == g->first[i + 1];
      size_t next = last ? g->first[i] : k + 1;
      if ((last && !g->closed[i]) || g->gap[next] || g->of[k] >= g->of[next]) continue;
      side = dyd_sphere_cell_side(g, i, k - g->first[i]);
      side_follow(d, &side, false, arc_draw);
      drawn++;
    }
  }
  if (drawn) dyd_picture_stroke(d->canvas, kind[2].rgb, d->view.line, 0, 0);
}

static void sphere_inside(dyd_canvas *c, void *context) {
  sphere_drawing *d = context;
  d->canvas = c;
  if (d->crowded && !d->r->survey) dyd_density_draw(c, &d->open, NULL);
  draw_graticule(d);
  if (d->cells)
    draw_cells(d);
  else if (d->r->survey)
    draw_plan(d);
  else
    draw_pairs(d);
  dyd_site_marks_draw(&d->marks, c, &d->view);
}

static void sphere_legend(dyd_canvas *c, void *context) {
  const sphere_drawing *d = context;
  char text[300], points[100];
  dyd_legend l;
  dyd_legend_begin(&l, c, &d->view);
  if (d->r->survey) {
    plan_legend(&l, &d->plan);
    return;
  }
  for (int k = 2; k >= 0 && !d->cells; k--) {
    if (!d->shown[kind[k].status] || (d->crowded && k == OPEN)) continue;
    snprintf(text, sizeof text, "%s: %zu", kind[k].name, d->shown[kind[k].status]);
    dyd_legend_line(&l, kind[k].rgb, kind[k].on, kind[k].off, text);
  }
  if (d->cells) dyd_legend_line(&l, kind[2].rgb, 0, 0, "side of a cell");
  snprintf(text, sizeof text, " of %zu indeterminate pairs across a square", d->shown[DYD_INDETERMINATE]);
  if (d->crowded) dyd_density_legend(&l, &d->open, text);
  dyd_legend_marks(&l, &d->marks, RECTANGLE);
  dyd_legend_line(&l, GRATICULE, 0, 0, "graticule, degrees");
  dyd_points_text(points, sizeof points, d->sites, d->count, d->r->window);
  snprintf(text, sizeof text, "%s on a sphere, outcome %s, %zu undecided faces; great circles on a plate carr\u00e9e",
           points, dyd_outcome_text(dyd_sphere_outcome(d->r->sphere)), dyd_sphere_faces(d->r->sphere));
  dyd_legend_text(&l, text);
  dyd_legend_crowd(&l, &d->marks);
}

/* The usual length of an edge on the map, in degrees: of edges that begin in the box (NULL: of all). */
static double sphere_spacing(const sphere_drawing *d, const double box[4]) {
  enum { SAMPLES = 1000 };
  double length[SAMPLES];
  const dyd_pair_list *pairs = &d->r->pairs;
  size_t n = 0, step = box ? 1 : pairs->count / SAMPLES + 1;
  for (size_t k = 0; k < pairs->count && n < SAMPLES; k += step) {
    const double *a = d->box[pairs->item[k].i], *b = d->box[pairs->item[k].j];
    double x = fabs(a[0] - b[0]);
    if (box && !(box[0] <= a[0] && a[1] <= box[1] && box[2] <= a[2] && a[3] <= box[3])) continue;
    length[n++] = hypot(fmin(x, fabs(360 - x)), a[2] - b[2]);
  }
  return dyd_view_median(length, n);
}

/* ---- the part shown ---- */

static bool sphere_site_box(double out[4], const void *context, size_t i) {
  const sphere_drawing *d = context;
  for (int k = 0; k < 4; k++) out[k] = d->box[i][k];
  return true;
}

/* In the middle of the widest range of longitudes without a place, where that is more than half of all; else -180. */
static dyd_status find_seam(sphere_drawing *d) {
  DYD_FREED double *lon = dyd_alloc(d->count + 1, sizeof *lon);
  double widest = 180;
  if (!lon) return DYD_E_NOMEM;
  d->seam = -180;
  for (size_t i = 0; i < d->count; i++) lon[i] = map_longitude(d, dyd_lon_lat_of(d->box[i]).lon);
  qsort(lon, d->count, sizeof *lon, dyd_compare_double);
  lon[d->count] = d->count ? lon[0] + 360 : 0;
  for (size_t k = 0; k < d->count; k++)
    if (lon[k + 1] - lon[k] > widest) widest = lon[k + 1] - lon[k], d->seam = lon[k] + widest / 2;
  if (d->seam > 0) d->seam -= 360;
  return DYD_OK;
}

/* The surroundings of the places, or the whole map. */
static void find_surroundings(double all[4], const sphere_drawing *d) {
  all[0] = all[2] = INFINITY, all[1] = all[3] = -INFINITY;
  for (size_t i = 0; i < d->count; i++) dyd_view_hold(all, d->box[i]);
  if (d->count && all[1] - all[0] < 180) {
    dyd_view_pad(all);
    all[2] = fmax(all[2], -90), all[3] = fmin(all[3], 90);
  } else
    all[0] = d->seam, all[1] = d->seam + 360, all[2] = -90, all[3] = 90;
}

static dyd_status find_crowd(sphere_drawing *d) {
  if (!dyd_density_init(&d->open, &d->view, &dyd_density_all)) return DYD_E_NOMEM;
  for (size_t i = 0; i < d->count; i++) d->sites += dyd_view_sees(&d->view, d->box[i]);
  for (size_t p = 0; p < d->r->pairs.count && !d->cells; p++) {
    const dyd_pair *pair = &d->r->pairs.item[p];
    d->is_open = pair->status == DYD_INDETERMINATE;
    d->seen = false;
    arc_follow(d, d->box[pair->i], d->box[pair->j], arc_count);
    d->shown[pair->status] += d->seen;
  }
  d->crowded = dyd_density_is_crowded(&d->open);
  return d->failed;
}

static dyd_status find_window(double all[4], sphere_drawing *d, dyd_error *err) {
  dyd_status st = dyd_view_window(all, d->r->window, err);
  if (st != DYD_OK) return st;
  if (!(all[1] - all[0] <= 360 && fabs(all[0]) <= 720 && all[2] >= -90 && all[3] <= 90))
    return dyd_fail(err, DYD_E_ARG,
                    "a window on a sphere is at most 360 degrees of longitude wide, and within -90 and 90 of latitude");
  d->seam = all[0] / 2 + all[1] / 2 - 180;
  return DYD_OK;
}

static dyd_status sphere_see(sphere_drawing *d, dyd_error *err) {
  double all[4];
  dyd_status st = dyd_sphere_boxes(&d->box, d->r->sphere);
  if (st == DYD_OK) st = d->r->window ? find_window(all, d, err) : find_seam(d);
  if (st != DYD_OK) return st;
  for (size_t i = 0; i < d->count; i++) {
    double lon = dyd_lon_lat_of(d->box[i]).lon, turn = map_longitude(d, lon) - lon;
    d->box[i][0] += turn, d->box[i][1] += turn;
  }
  if (!d->r->window) find_surroundings(all, d);
  st = dyd_view_fit(&d->view, all, sphere_spacing(d, d->r->window ? all : NULL), err);
  d->view.unit = "degree";
  return st == DYD_OK ? find_crowd(d) : st;
}

static dyd_status sphere_draw(const dyd_output *o, const dyd_sphere_cells *cells, const char *title) {
  sphere_drawing d = {.r = o->what, .cells = cells};
  const dyd_engine *places = dyd_sphere_places(d.r->sphere);
  d.count = dyd_engine_count(places);
  d.marks =
      (dyd_site_marks){.engine = places, .count = d.count, .box = sphere_site_box, .context = &d, .rgb = RECTANGLE};
  dyd_status st = sphere_see(&d, o->err);
  if (d.r->survey && st == DYD_OK) st = plan_dress_init(&d.plan, d.r->survey, d.count);
  if (d.r->survey) d.marks.plan = &d.plan.marks;
  if (st == DYD_OK) st = dyd_view_write(o, &d.view, title, sphere_inside, sphere_legend, &d);
  plan_dress_clear(&d.plan);
  dyd_density_clear(&d.open);
  free(d.box);
  return st == DYD_OK ? d.failed : st;
}

dyd_status dyd_sphere_picture(const dyd_output *o) {
  const bool plan = ((const dyd_result *)o->what)->survey;
  return sphere_draw(o, NULL, plan ? "plan of measurements" : "partial Delaunay triangulation of a sphere");
}

dyd_status dyd_sphere_voronoi_picture(const dyd_output *o) {
  const dyd_result *r = o->what;
  DYD_SCOPED(dyd_sphere_cells) cells = {0};
  dyd_status st = dyd_sphere_cells_find(&cells, r->sphere, o->err);
  return st == DYD_OK ? sphere_draw(o, &cells, "Voronoi diagram of a sphere") : st;
}

/* ---- plans of the plane ---- */

typedef struct plane_drawing {
  const dyd_result *r;
  dyd_view view;
  plan_dress dress;
  dyd_site_marks marks;
} plane_drawing;

static void plan_inside(dyd_canvas *c, void *context) {
  plane_drawing *g = context;
  for (int class = CLASSES; class --;)
    for (size_t k = 0; k < g->r->pairs.count; k++) {
      const dyd_pair *p = &g->r->pairs.item[k];
      double z[2][2];
      if (plan_class(&g->dress, p) != class || !dyd_view_line(z, &g->view, g->r, p->i, p->j)) continue;
      g->dress.shown[class]++;
      dyd_canvas_move(c, z[0][0], z[0][1]);
      dyd_canvas_line(c, z[1][0], z[1][1]);
      plan_stroke(c, &g->dress, &g->view, g->r->engine, p);
    }
  dyd_site_marks_draw(&g->marks, c, &g->view);
}

static void plane_plan_legend(dyd_canvas *c, void *context) {
  const plane_drawing *g = context;
  dyd_legend l;
  dyd_legend_begin(&l, c, &g->view);
  plan_legend(&l, &g->dress);
  dyd_legend_crowd(&l, &g->marks);
}

dyd_status dyd_plan_picture(const dyd_output *o) {
  const dyd_result *r = o->what;
  if (r->sphere) return dyd_sphere_picture(o);
  plane_drawing g = {.r = r, .marks = dyd_site_marks_of(r->pd, r->engine, DYD_PICTURE_BAND)};
  g.marks.plan = &g.dress.marks;
  dyd_status st = plan_dress_init(&g.dress, r->survey, r->count);
  if (st == DYD_OK) st = dyd_view_of(&g.view, o, &r->pairs);
  if (st == DYD_OK) st = dyd_view_write(o, &g.view, "plan of measurements", plan_inside, plane_plan_legend, &g);
  plan_dress_clear(&g.dress);
  return st;
}
