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

/* Kinds of pairs: decided by the first quarter of the rows of a plan, and so on; not by it; legal already. */
enum { LEFT = DYD_QUARTERS, LEGAL };

static dyd_status plan_shown_init(dyd_plan_shown *d, const dyd_result *r, size_t sites) {
  *d = (dyd_plan_shown){.r = r};
  if (!DYD_ZEROED(d->rank, sites + 1)) return DYD_E_NOMEM;
  d->rows = dyd_survey_rows(&d->row, r->survey);
  d->pairs = dyd_survey_pairs(&d->pair, r->survey);
  for (size_t k = 0; k < d->rows; k++) d->rank[d->row[k].site] = k + 1;
  return DYD_OK;
}

static const dyd_survey_pair *plan_pair(const dyd_plan_shown *d, const dyd_pair *p) {
  return dyd_find_two(p, d->pair, d->pairs, sizeof *d->pair);
}

static int plan_kind(const dyd_picture *p, size_t k) {
  const dyd_plan_shown *d = p->sites->plan;
  const dyd_pair *pair = &d->r->pairs.item[k];
  if (pair->status == DYD_LEGAL) return LEGAL;
  const dyd_survey_pair *found = plan_pair(d, pair);
  return found && found->row < d->rows ? dyd_plan_quarter(d, found->row) : LEFT;
}

static bool plan_path(dyd_picture *p, size_t k) {
  const dyd_result *r = p->sites->plan->r;
  return dyd_picture_join(p, r, r->pairs.item[k].i, r->pairs.item[k].j);
}

static void plan_name(dyd_picture *p, const dyd_picture_layer *l, size_t k) {
  const dyd_plan_shown *d = p->sites->plan;
  const dyd_pair *pair = &d->r->pairs.item[k];
  char text[80];
  if (l->kind < DYD_QUARTERS)
    snprintf(text, sizeof text, "decided by point %zu of the plan", plan_pair(d, pair)->row + 1);
  else
    snprintf(text, sizeof text, "%s", l->kind == LEGAL ? "legal" : l->text);
  dyd_picture_name_pair(p->canvas, d->r->engine, pair->i, pair->j, text);
}

/* The ranks of a quarter: first to last; false: none. */
static bool quarter_ranks(size_t *first, size_t *last, const dyd_plan_shown *d, int quarter) {
  *first = *last = 0;
  for (size_t k = 0; k < d->rows; k++)
    if (dyd_plan_quarter(d, k) == quarter) *first = *first ? *first : k + 1, *last = k + 1;
  return *first;
}

static void quarter_entry(dyd_legend *legend, const dyd_picture *p, const dyd_picture_layer *l) {
  char text[160];
  size_t first, last, decided = dyd_picture_drawn(p, l);
  if (!quarter_ranks(&first, &last, p->sites->plan, l->kind)) return;
  if (first == last)
    snprintf(text, sizeof text, "point %zu, decides %zu", first, decided);
  else
    snprintf(text, sizeof text, "points %zu to %zu, decide %zu", first, last, decided);
  dyd_legend_put(legend, l, text);
}

static void counted_entry(dyd_legend *legend, const dyd_picture *p, const dyd_picture_layer *l) {
  char text[160];
  snprintf(text, sizeof text, "%s: %zu", l->text, dyd_picture_drawn(p, l));
  if (dyd_picture_drawn(p, l)) dyd_legend_put(legend, l, text);
}

/* ---- spheres ---- */

/* cells: of the diagram, NULL: edges are drawn. */
typedef struct sphere_drawing {
  const dyd_result *r;
  const dyd_sphere_cells *cells;
  double (*box)[4];    /* of places, whose middles are on the map */
  size_t count, sites; /* sites: places in the frame */
  double seam;         /* the longitude of the left end of the map, of 360 degrees */
  dyd_view view;
  dyd_sites_shown marks;
  dyd_plan_shown plan; /* where r holds one */
  dyd_pairs_shown pairs;
  dyd_picture picture;
  /* The line at hand: where it is on the page; is it in the frame, and of an indeterminate edge? */
  double at[2];
  bool seen, is_open;
} sphere_drawing;

/* ---- lines ---- */

/* The next place of a line; begin: it begins here. */
typedef void (*arc_step)(sphere_drawing *d, bool begin, double x, double y);

static void arc_draw(sphere_drawing *d, bool begin, double x, double y) {
  if (begin)
    dyd_canvas_move(d->picture.canvas, x, y);
  else
    dyd_canvas_line(d->picture.canvas, x, y);
}

/* Counts the part in the frame. */
static void arc_count(sphere_drawing *d, bool begin, double x, double y) {
  double z[2][2] = {{d->at[0], d->at[1]}, {x, y}};
  if (begin) dyd_density_begin(&d->pairs.dense[DYD_KIND_OPEN]);
  if (!begin && dyd_clip_segment(z, d->view.frame)) {
    d->seen = true;
    if (d->is_open) dyd_density_add(&d->pairs.dense[DYD_KIND_OPEN], z);
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
  if (st != DYD_OK) d->picture.st = st;
}

static void arc_follow(sphere_drawing *d, const double *from, const double *to, arc_step step) {
  side_follow(d, &(dyd_side){.from = dyd_lon_lat_of(from), .to = dyd_lon_lat_of(to)}, false, step);
}

/* In the legend even where the map is too small for it. Plans of the plane have none. */
static void graticule_walk(dyd_picture *p, const dyd_picture_layer *l) {
  sphere_drawing *d = p->what;
  if (!d) return;
  const dyd_view *v = &d->view;
  const double left = v->left, right = left + v->width / v->scale, bottom = v->top - v->height / v->scale;
  double span = fmax(right - left, v->top - bottom);
  int digit, exponent;
  dyd_picture_seen(p, l);
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
}

static bool sphere_path(dyd_picture *p, size_t k) {
  sphere_drawing *d = p->what;
  arc_follow(d, d->box[d->r->pairs.item[k].i], d->box[d->r->pairs.item[k].j], arc_draw);
  return true;
}

/* Sides between vertices that follow each other in a cell, each once; and the one of two halves. */
static void sides_walk(dyd_picture *p, const dyd_picture_layer *l) {
  sphere_drawing *d = p->what;
  const dyd_sphere_cells *g = d->cells;
  size_t drawn = 0;
  dyd_side side;
  dyd_picture_seen(p, l);
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
}

static void sphere_notes(dyd_legend *legend, const dyd_picture *p) {
  const sphere_drawing *d = p->what;
  char text[300], points[100];
  dyd_points_text(points, sizeof points, d->sites, d->count, d->r->window);
  snprintf(text, sizeof text, "%s on a sphere, outcome %s, %zu undecided faces; great circles on a plate carr\u00e9e",
           points, dyd_outcome_text(dyd_sphere_outcome(d->r->sphere)), dyd_sphere_faces(d->r->sphere));
  dyd_legend_text(legend, text);
  dyd_legend_crowd(legend, p->sites);
}

#define GRATICULE(key, place)                                                                                          \
  { graticule_walk, 0, DYD_STYLE_PEN(0xd0d0d0, 0.5, 0, 0), key, place, "graticule, degrees", NULL }

#define SITES(place) DYD_SITES_LAYERS(dyd_sites_walk, dyd_sites_entry, 0xf2c766, 0xf2c766, place)
#define EDGES(kind, rgb, on, off, place, name)                                                                         \
  { dyd_lines_walk, kind, DYD_STYLE_LINE(rgb, 1, on, off), DYD_KEY_LINE, place, name, dyd_pairs_entry }

static const dyd_picture_layer sphere_rows[] = {{dyd_squares_walk, DYD_KIND_OPEN, DYD_STYLE_SQUARES(&dyd_density_all),
                                                 DYD_KEY_SQUARES, 4, "indeterminate", dyd_squares_entry},
                                                GRATICULE(DYD_KEY_LINE, 6),
                                                EDGES(DYD_KIND_TIE, 0xcc79a7, 1.5, 1.5, 3, "tie"),
                                                EDGES(DYD_KIND_OPEN, DYD_RGB_BAND, 4, 2, 2, "indeterminate"),
                                                EDGES(DYD_KIND_LEGAL, DYD_RGB_LEGAL, 0, 0, 1, "legal"),
                                                SITES(5)};

static const dyd_picture_layer sphere_cells_rows[] = {
    GRATICULE(DYD_KEY_LINE, 3),
    {sides_walk, 0, DYD_STYLE_LINE(DYD_RGB_LEGAL, 1, 0, 0), DYD_KEY_LINE, 1, "side of a cell", NULL},
    SITES(2)};

const dyd_picture_table dyd_sphere_layers = DYD_PICTURE_TABLE(sphere_rows, sphere_notes),
                        dyd_sphere_cells_layers = DYD_PICTURE_TABLE(sphere_cells_rows, sphere_notes);

static void plan_picture_notes(dyd_legend *legend, const dyd_picture *p) {
  const dyd_survey_result *of = dyd_survey_get(p->sites->plan->r->survey);
  char text[160];
  snprintf(text, sizeof text, "labels: rank: point; %zu points to measure, %zu of %zu undecided pairs stay so%s",
           p->sites->plan->rows, of->left, of->open, of->cut ? "; the plan is not finished" : "");
  dyd_legend_text(legend, text);
  if (!p->what) dyd_legend_crowd(legend, p->sites);
}

/* Distinct for all kinds of sight, and in grey. Sites that are not in the plan are grey. */
#define QUARTER(k, rgb, lines, on, off)                                                                                \
  {                                                                                                                    \
    dyd_lines_walk, k, DYD_STYLE_LINE(rgb, lines, on, off), DYD_KEY_LINE, k + 1, "a quarter of the plan",              \
        quarter_entry                                                                                                  \
  }

static const dyd_picture_layer plan_rows[] = {
    GRATICULE(DYD_KEY_NONE, 0),
    {dyd_lines_walk, LEGAL, DYD_STYLE_LINE(DYD_RGB_DECIDED, 0.7, 0, 0), DYD_KEY_LINE, 6, "legal already",
     counted_entry},
    {dyd_lines_walk, LEFT, DYD_STYLE_LINE(0x333333, 1, 0.2, 2.2), DYD_KEY_LINE, 5, "not decided by the plan",
     counted_entry},
    QUARTER(3, DYD_RGB_PLAN_4, 1.6, 1, 2),
    QUARTER(2, DYD_RGB_PLAN_3, 1.6, 3, 2),
    QUARTER(1, DYD_RGB_PLAN_2, 1.6, 7, 2),
    QUARTER(0, DYD_RGB_PLAN_1, 1.8, 0, 0),
    {dyd_sites_walk, 0, DYD_STYLE_SITES(0xd8d8d8, 0), DYD_KEY_NONE, 0, "rectangle of a point", NULL},
    {NULL, 1, DYD_SITES_DOTS, DYD_KEY_NONE, 0, "point", NULL}};

const dyd_picture_table dyd_plan_layers = DYD_PICTURE_TABLE(plan_rows, plan_picture_notes);

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
  if (!dyd_density_init(&d->pairs.dense[DYD_KIND_OPEN], &d->view, &dyd_density_all)) return DYD_E_NOMEM;
  for (size_t i = 0; i < d->count; i++) d->sites += dyd_view_sees(&d->view, d->box[i]);
  for (size_t p = 0; p < d->r->pairs.count && !d->cells; p++) {
    const dyd_pair *pair = &d->r->pairs.item[p];
    d->is_open = pair->status == DYD_INDETERMINATE;
    d->seen = false;
    arc_follow(d, d->box[pair->i], d->box[pair->j], arc_count);
    d->pairs.shown[dyd_pairs_kind(&d->picture, p)] += d->seen;
  }
  dyd_pairs_settle(&d->pairs);
  return d->picture.st;
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

static dyd_status sphere_draw(const dyd_output *o, const dyd_picture_table *table, const dyd_sphere_cells *cells,
                              const char *title) {
  const dyd_result *r = o->what;
  sphere_drawing d = {.r = r, .cells = cells};
  const dyd_engine *places = dyd_sphere_places(r->sphere);
  d.count = dyd_engine_count(places);
  d.marks = (dyd_sites_shown){.engine = places, .count = d.count, .box = sphere_site_box, .context = &d};
  d.picture = (dyd_picture){table,
                            title,
                            .view = &d.view,
                            .what = &d,
                            .sites = &d.marks,
                            .pairs = &d.pairs,
                            .lines = {r->pairs.count, NULL, sphere_path, dyd_pairs_name}};
  d.pairs = (dyd_pairs_shown){.list = &r->pairs, .engine = places};
  if (r->survey)
    d.picture.lines.kind = plan_kind, d.picture.lines.name = plan_name, d.marks.plan = &d.plan;
  else if (r->pairs.count > DYD_PICTURE_NAMES)
    d.picture.lines.name = NULL;
  dyd_status st = sphere_see(&d, o->err);
  if (r->survey && st == DYD_OK) st = plan_shown_init(&d.plan, r, d.count);
  if (st == DYD_OK) st = dyd_picture_write(&d.picture, o);
  free(d.plan.rank);
  dyd_density_clear(&d.pairs.dense[DYD_KIND_OPEN]);
  free(d.box);
  return st;
}

dyd_status dyd_sphere_picture(const dyd_output *o) {
  if (((const dyd_result *)o->what)->survey) return sphere_draw(o, &dyd_plan_layers, NULL, "plan of measurements");
  return sphere_draw(o, &dyd_sphere_layers, NULL, "partial Delaunay triangulation of a sphere");
}

dyd_status dyd_sphere_voronoi_picture(const dyd_output *o) {
  const dyd_result *r = o->what;
  DYD_SCOPED(dyd_sphere_cells) cells = {0};
  dyd_status st = dyd_sphere_cells_find(&cells, r->sphere, o->err);
  return st == DYD_OK ? sphere_draw(o, &dyd_sphere_cells_layers, &cells, "Voronoi diagram of a sphere") : st;
}

dyd_status dyd_plan_picture(const dyd_output *o) {
  const dyd_result *r = o->what;
  if (r->sphere) return dyd_sphere_picture(o);
  dyd_view view;
  dyd_plan_shown plan;
  dyd_sites_shown sites = dyd_sites_shown_of(r->pd, r->engine);
  sites.plan = &plan;
  dyd_status st = plan_shown_init(&plan, r, r->count);
  if (st == DYD_OK) st = dyd_view_of(&view, o, &r->pairs);
  if (st == DYD_OK)
    st = dyd_picture_write(&(dyd_picture){&dyd_plan_layers, "plan of measurements", .view = &view, .sites = &sites,
                                          .lines = {r->pairs.count, plan_kind, plan_path, plan_name}},
                           o);
  free(plan.rank);
  return st;
}
