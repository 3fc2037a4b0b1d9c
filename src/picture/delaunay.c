/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pictures of edges: the triangulation, with rectangles, edges and partial edges by status and certain triangles;
 * graphs; tolerances, edges coloured by the motion that they survive. And the table of pictures. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "base/local.h"
#include "io/decimal.h"
#include "picture/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TIED = DYD_KIND_TIE, OPEN = DYD_KIND_OPEN, LEGAL = DYD_KIND_LEGAL };
#define CLOSE 12.0 /* neighbours so close have rectangles that hide each other */
#define WIDE 50.0  /* room around the frame, in points, for lines and dashes that begin outside */
#define FAR 1e13   /* lengths on the page beyond which doubles do not give positions to a hundredth */

/* wide: the frame of the view with some room. */
typedef struct delaunay_drawing {
  const dyd_result *r;
  dyd_view view;
  dyd_triangle_list triangles;
  double wide[4];
  size_t sites;    /* rectangles that meet the frame */
  double (*at)[2]; /* the middle of each rectangle on the page; owned */
  bool any_wide;   /* some rectangle is more than a dot */
  dyd_sites_shown marks;
  dyd_pairs_shown pairs;
  dyd_picture picture;
} delaunay_drawing;

/* Returns true if the rectangle is more than a dot. */
static bool is_wide_box(const delaunay_drawing *d, const double b[4]) {
  return fmax(b[1] - b[0], b[3] - b[2]) * d->view.scale >= 2 * d->view.dot;
}

static bool find_middles(delaunay_drawing *d) {
  d->at = dyd_alloc(d->r->count, sizeof *d->at);
  for (size_t i = 0; d->at && i < d->r->count; i++) {
    double b[4];
    dyd_sites_get_d(b, d->r->sites, i);
    dyd_view_middle(d->at[i], &d->view, b);
    d->any_wide = d->any_wide || is_wide_box(d, b);
  }
  return d->at;
}

/* Places are prefetched for what comes so many steps later, since they lie anywhere in memory. */
enum { AHEAD = 16 };

static void fetch_line(const delaunay_drawing *d, size_t p) {
  if (p + AHEAD < d->r->pairs.count) __builtin_prefetch(d->at[d->r->pairs.item[p + AHEAD].j]);
}

static void fetch_triangle(const delaunay_drawing *d, size_t k) {
  for (int corner = 0; corner < 3 && k + AHEAD < d->triangles.count; corner++)
    __builtin_prefetch(d->at[d->triangles.item[k + AHEAD].v[corner]]);
}

static bool line_of(double z[2][2], const delaunay_drawing *d, const dyd_pair *pair, const double frame[4]) {
  memcpy(z[0], d->at[pair->i], sizeof z[0]);
  memcpy(z[1], d->at[pair->j], sizeof z[1]);
  return dyd_clip_segment(z, frame);
}

/* Returns true if full squares cover n places and all between them. */
static bool is_covered(const dyd_density *by, double z[][2], int n) {
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  if (!by->count) return false;
  for (int k = 0; k < 2 * n; k++) {
    double at = z[k / 2][k & 1], *side = box + 2 * (k & 1);
    if (at < side[0]) side[0] = at;
    if (at > side[1]) side[1] = at;
  }
  return dyd_density_covers(by, box);
}

static bool polygon_path(dyd_canvas *c, const delaunay_drawing *d, double z[DYD_CLIP_MOST][2], int n) {
  n = dyd_clip_convex(z, n, d->wide);
  for (int k = 0; k < n; k++)
    if (k)
      dyd_canvas_line(c, z[k][0], z[k][1]);
    else
      dyd_canvas_move(c, z[k][0], z[k][1]);
  if (n) dyd_canvas_close(c);
  return n > 0;
}

static bool has_names(const delaunay_drawing *d) {
  return d->triangles.count + d->r->pairs.count <= DYD_PICTURE_NAMES;
}

static void name_triangle(dyd_canvas *c, const dyd_engine *e, const uint32_t v[3], const char *what) {
  size_t row[3];
  for (int corner = 0; corner < 3; corner++) row[corner] = dyd_engine_row(e, v[corner]);
  char id[80], title[80];
  snprintf(id, sizeof id, "triangle-%zu-%zu-%zu", row[0], row[1], row[2]);
  snprintf(title, sizeof title, "%s %zu, %zu, %zu", what, row[0], row[1], row[2]);
  dyd_canvas_name(c, id, title);
}

static void triangles_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const delaunay_drawing *d = p->what;
  for (size_t k = 0; k < d->triangles.count; k++) {
    const uint32_t *v = d->triangles.item[k].v;
    double z[DYD_CLIP_MOST][2];
    fetch_triangle(d, k);
    for (int corner = 0; corner < 3; corner++) memcpy(z[corner], d->at[v[corner]], sizeof z[corner]);
    if (is_covered(&d->pairs.dense[LEGAL], z, 3) || !polygon_path(p->canvas, d, z, 3) || !has_names(d)) continue;
    name_triangle(p->canvas, d->r->engine, v, l->text);
    dyd_picture_paint(p, l);
  }
}

static double page_turn(const double p[2], const double q[2], const double r[2]) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

static int compare_xy(const void *a, const void *b) {
  const double *p = a, *q = b;
  if (p[0] != q[0]) return p[0] < q[0] ? -1 : 1;
  return (p[1] > q[1]) - (p[1] < q[1]);
}

/* The corners of a rectangle, or of the octagon around the disc in it, on the page. */
static int site_corners(double z[8][2], const dyd_view *v, const double box[4]) {
  const double x[2] = {dyd_view_x(v, box[0]), dyd_view_x(v, box[1])};
  const double y[2] = {dyd_view_y(v, box[2]), dyd_view_y(v, box[3])};
  const double cut = v->discs ? 1 - sqrt(0.5) : 0; /* of a side, at each end */
  int n = 0;
  for (int k = 0; k < 4; k++) {
    int right = k & 1, top = k >> 1;
    z[n][0] = x[right] + (x[!right] - x[right]) * cut, z[n++][1] = y[top];
    if (cut > 0) z[n][0] = x[right], z[n++][1] = y[top] + (y[!top] - y[top]) * cut;
  }
  return n;
}

/* Ed(a,b) as a path: the hull of all corners, by monotone chains. */
static bool pair_path(dyd_canvas *c, const delaunay_drawing *d, const double a[4], const double b[4],
                      const dyd_density *by) {
  double z[16][2], chain[DYD_CLIP_MOST][2];
  int corners = site_corners(z, &d->view, a), n = 0;
  corners += site_corners(z + corners, &d->view, b);
  if (is_covered(by, z, corners)) return false;
  qsort(z, (size_t)corners, sizeof z[0], compare_xy);
  for (int pass = 0; pass < 2; pass++) {
    int floor = n;
    for (int k = 0; k < corners; k++) {
      const double *p = z[pass ? corners - 1 - k : k];
      while (n >= floor + 2 && page_turn(chain[n - 2], chain[n - 1], p) <= 0) n--;
      chain[n][0] = p[0], chain[n][1] = p[1];
      n++;
    }
    n--;
  }
  return polygon_path(c, d, chain, n);
}

static void areas_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const delaunay_drawing *d = p->what;
  for (size_t k = 0; k < d->r->pairs.count && d->any_wide && !d->pairs.crowded; k++) {
    const dyd_pair *pair = &d->r->pairs.item[k];
    double a[4], b[4];
    if (dyd_pairs_kind(p, k) != l->kind) continue;
    dyd_sites_get_d(a, d->r->sites, pair->i);
    dyd_sites_get_d(b, d->r->sites, pair->j);
    if (is_wide_box(d, a) || is_wide_box(d, b)) pair_path(p->canvas, d, a, b, &d->pairs.dense[l->kind]);
  }
}

static bool edge_path(dyd_picture *p, size_t k) {
  const delaunay_drawing *d = p->what;
  double z[2][2];
  fetch_line(d, k);
  if (!line_of(z, d, &d->r->pairs.item[k], d->wide) || is_covered(&d->pairs.dense[dyd_pairs_kind(p, k)], z, 2))
    return false;
  dyd_canvas_segment(p->canvas, z);
  return true;
}

static void delaunay_notes(dyd_legend *legend, const dyd_picture *p) {
  const delaunay_drawing *d = p->what;
  char text[300], points[100];
  dyd_points_text(points, sizeof points, d->sites, d->r->count, d->r->window);
  snprintf(text, sizeof text, "%s, outcome %s%s; positions rounded by at most 0.01 of a pixel", points,
           dyd_outcome_text(dyd_engine_outcome(d->r->engine)),
           dyd_delaunay_is_capped(d->r->pd) ? ", not all possible pairs are shown" : "");
  dyd_legend_text(legend, text);
  if (d->pairs.full)
    dyd_legend_text(legend, "squares of legal pairs and ties hide the lines, triangles and points that are in them");
  dyd_legend_crowd(legend, p->sites);
}

/* What a triangulation and a graph share. */
#define SQUARES(kind, levels, place, name)                                                                             \
  { dyd_squares_walk, kind, DYD_STYLE_SQUARES(levels), DYD_KEY_SQUARES, place, name, dyd_squares_entry }
#define EDGES(kind, rgb, lines, on, off, place, name)                                                                  \
  { dyd_lines_walk, kind, DYD_STYLE_LINE(rgb, lines, on, off), DYD_KEY_LINE, place, name, dyd_pairs_entry }
#define SITES(place) DYD_SITES_LAYERS(dyd_sites_walk, dyd_sites_entry, DYD_RGB_BAND, 0xf2c766, place)
#define AREAS(kind, rgb, place, text)                                                                                  \
  { areas_walk, kind, DYD_STYLE_FILL(rgb), DYD_KEY_PATCH, place, text, NULL }
#define EDGES_OPEN(name) EDGES(OPEN, DYD_RGB_INDETERMINATE, 1, 4, 2.5, 2, name)
#define EDGES_LEGAL(name) EDGES(LEGAL, DYD_RGB_LEGAL, 1.2, 0, 0, 1, name)

static const dyd_picture_layer delaunay_rows[] = {
    {triangles_walk, 0, DYD_STYLE_FILL(DYD_RGB_TRIANGLE), DYD_KEY_PATCH, 7, "certain triangle", NULL},
    AREAS(LEGAL, DYD_RGB_LEGAL_AREA, 9, "where a legal edge is"),
    AREAS(OPEN, DYD_RGB_INDETERMINATE_AREA, 10, "where an indeterminate edge may be"),
    AREAS(TIED, DYD_RGB_TIE_AREA, 11, "where a tie may be"),
    SQUARES(LEGAL, &dyd_density_full, 4, "legal"),
    SQUARES(TIED, &dyd_density_full_grey, 6, "tie"),
    SQUARES(OPEN, &dyd_density_all, 5, "indeterminate"),
    EDGES(TIED, DYD_RGB_TIE, 1, 0.2, 2.2, 3, "tie"),
    EDGES_OPEN("indeterminate"),
    EDGES_LEGAL("legal"),
    SITES(8)};

/* Pairs of graphs are certain or possible. */
static const dyd_picture_layer graph_rows[] = {
    AREAS(LEGAL, DYD_RGB_LEGAL_AREA, 6, "where a certain edge is"),
    AREAS(OPEN, DYD_RGB_INDETERMINATE_AREA, 7, "where a possible edge may be"),
    SQUARES(LEGAL, &dyd_density_full, 3, "certain"),
    SQUARES(OPEN, &dyd_density_all, 4, "possible"),
    EDGES_OPEN("possible"),
    EDGES_LEGAL("certain"),
    SITES(5)};

const dyd_picture_table dyd_delaunay_layers = DYD_PICTURE_TABLE(delaunay_rows, delaunay_notes),
                        dyd_graph_layers = DYD_PICTURE_TABLE(graph_rows, delaunay_notes);

/* ---- the part shown ---- */

/* A box on the page; false when it is too far outside. */
static bool place_box(double out[4], const dyd_view *v, const double box[4]) {
  out[0] = dyd_view_x(v, box[0]);
  out[1] = dyd_view_x(v, box[1]);
  out[2] = dyd_view_y(v, box[3]);
  out[3] = dyd_view_y(v, box[2]);
  bool good = true;
  for (int k = 0; k < 4; k++) good = good && fabs(out[k]) < FAR && fabs(box[k]) * v->scale < FAR;
  return good;
}

static dyd_status too_near(dyd_error *err) {
  return dyd_fail(err, DYD_E_RANGE, "the window is too small for a picture of these points; give a larger one");
}

static dyd_status delaunay_see(delaunay_drawing *d, const dyd_output *o) {
  const dyd_result *r = d->r;
  double *f = d->view.frame, b[4], z[4], line[2][2];
  dyd_status st = dyd_view_of(&d->view, o, r->graph_name || r->discs ? NULL : &r->pairs);
  if (st != DYD_OK) return st;
  if (r->window) dyd_rect_get_d(b, r->window);
  if (r->window && !place_box(f, &d->view, b)) return too_near(o->err);
  for (int k = 0; k < 4; k++) d->wide[k] = f[k] + (k & 1 ? WIDE : -WIDE);
  for (size_t i = 0; r->window && i < r->count; i++) {
    st = dyd_result_box(b, r, i, o->err);
    if (st != DYD_OK) return st;
    if (!place_box(z, &d->view, b)) return too_near(o->err);
    d->sites += z[0] <= f[1] && f[0] <= z[1] && z[2] <= f[3] && f[2] <= z[3];
  }
  if (!find_middles(d)) return DYD_E_NOMEM;
  for (size_t p = 0; p < r->pairs.count; p++)
    d->pairs.shown[dyd_pairs_kind(&d->picture, p)] += !r->window || line_of(line, d, &r->pairs.item[p], f);
  return DYD_OK;
}

/* Returns true if the rectangles would hide most of the frame. */
static bool are_rectangles_a_mass(const delaunay_drawing *d) {
  const double *f = d->view.frame;
  double area = 0, z[4];
  for (size_t i = 0; i < d->r->count; i++) {
    if (!d->marks.box(z, d->marks.context, i) || !dyd_view_sees(&d->view, z)) continue;
    double w = (z[1] - z[0]) * d->view.scale, h = (z[3] - z[2]) * d->view.scale;
    area += fmin(w, f[1] - f[0]) * fmin(h, f[3] - f[2]);
  }
  return area > (f[1] - f[0]) * (f[3] - f[2]) / 4;
}

/* Where lines are too many to be named, full squares are drawn instead of them. */
static dyd_status find_density(delaunay_drawing *d) {
  const dyd_picture_table *table = d->picture.table;
  for (const dyd_picture_layer *l = table->row; l < table->row + table->count; l++)
    if (l->style.levels && (l->kind == OPEN || !has_names(d)) &&
        !dyd_density_init(&d->pairs.dense[l->kind], &d->view, l->style.levels))
      return DYD_E_NOMEM;
  for (size_t p = 0; p < d->r->pairs.count; p++) {
    double z[2][2];
    int k = dyd_pairs_kind(&d->picture, p);
    fetch_line(d, p);
    if (!d->pairs.dense[k].count) continue;
    dyd_density_begin(&d->pairs.dense[k]);
    if (line_of(z, d, &d->r->pairs.item[p], d->view.frame)) dyd_density_add(&d->pairs.dense[k], z);
  }
  dyd_pairs_settle(&d->pairs);
  d->view.dots = d->pairs.crowded && (d->view.apart < CLOSE || are_rectangles_a_mass(d));
  if (d->pairs.dense[LEGAL].count) d->marks.under = &d->pairs.dense[LEGAL];
  return DYD_OK;
}

dyd_status dyd_delaunay_picture(const dyd_output *o) {
  const dyd_result *r = o->what;
  const char *graph = r->graph_name;
  delaunay_drawing d = {.r = r,
                        .marks = dyd_sites_shown_of(r->pd, r->engine),
                        .pairs = {.list = &r->pairs, .engine = r->engine},
                        .picture = {graph ? &dyd_graph_layers : &dyd_delaunay_layers,
                                    graph ? graph : "partial Delaunay triangulation",
                                    .lines = {r->pairs.count, NULL, edge_path, NULL}}};
  d.picture.view = &d.view, d.picture.what = &d, d.picture.sites = &d.marks, d.picture.pairs = &d.pairs;
  dyd_status st = delaunay_see(&d, o);
  if (st == DYD_OK && !graph) st = dyd_delaunay_triangles(&d.triangles, NULL, r->pd, 0);
  if (st == DYD_OK) st = find_density(&d);
  if (has_names(&d)) d.picture.lines.name = dyd_pairs_name;
  if (st == DYD_OK) st = dyd_picture_write(&d.picture, o);
  dyd_triangle_list_clear(&d.triangles);
  for (int k = 0; k < 3; k++) dyd_density_clear(&d.pairs.dense[k]);
  free(d.at);
  return st;
}

/* ---- tolerances ---- */

/* Of all edges, the quarter that dies first, and so on; distinct for all kinds of sight, and in grey. Then ties. */
/* Of all edges, the quarter that dies first, and so on; distinct for all kinds of sight, and in grey. Then ties. */
enum { CLASSES = 4 };

typedef struct tolerance_drawing {
  const dyd_result *r;
  const dyd_tolerance_row *row;
  size_t rows;
  const dyd_tolerance *t;
  dyd_view view;
  double bound[CLASSES - 1]; /* from where on an edge belongs to the next class */
  dyd_sites_shown marks;
} tolerance_drawing;

static const char *rounded(char out[DYD_DECIMAL_SIZE], double x, int digits, dyd_round to) {
  dyd_decimal_directed(out, x, digits, to);
  return out;
}

/* The least double that is not below x cut to two digits: a double is below it iff it is below these digits. */
static double two_digits(double x) {
  char cut[DYD_DECIMAL_SIZE], again[DYD_DECIMAL_SIZE];
  if (!(x > 0 && isfinite(x))) return x;
  DYD_LOCAL_NUMBERS(mpq, digits);
  /* The point of strtod is that of the caller's locale. */
  dyd_status st = dyd_real_parse_exact(digits, cut, rounded(cut, x, 2, DYD_DOWN) ? strlen(cut) : 0);
  double at = st == DYD_OK ? mpq_get_d(digits) : x;
  return strcmp(rounded(again, at, 2, DYD_DOWN), cut) == 0 ? at : nextafter(at, HUGE_VAL);
}

static dyd_status find_classes(tolerance_drawing *g) {
  DYD_FREED double *death = malloc((g->rows + 1) * sizeof *death);
  size_t count = 0;
  if (!death) return DYD_E_NOMEM;
  for (size_t k = 0; k < g->rows; k++)
    if (g->row[k].event == DYD_EVENT_DEATH) death[count++] = g->row[k].lo;
  qsort(death, count, sizeof *death, dyd_compare_double);
  for (int c = 0; c < CLASSES - 1; c++) g->bound[c] = count ? two_digits(death[count * (size_t)(c + 1) / CLASSES]) : 0;
  return DYD_OK;
}

/* -1: a birth, which is not drawn. */
static int class_of(const dyd_picture *p, size_t k) {
  const tolerance_drawing *g = p->what;
  const dyd_tolerance_row *row = &g->row[k];
  if (row->event == DYD_EVENT_BIRTH) return -1;
  if (row->event == DYD_EVENT_TIE) return CLASSES;
  int c = 0;
  while (c < CLASSES - 1 && row->lo >= g->bound[c]) c++;
  return c;
}

static bool tolerance_path(dyd_picture *p, size_t k) {
  const tolerance_drawing *g = p->what;
  return dyd_picture_join(p, g->r, g->row[k].i, g->row[k].j);
}

/* Of many no line has a name, but each is an element all the same. */
static void tolerance_name(dyd_picture *p, const dyd_picture_layer *l, size_t k) {
  const tolerance_drawing *g = p->what;
  const dyd_tolerance_row *row = &g->row[k];
  char text[80], number[DYD_DECIMAL_SIZE];
  if (g->rows > DYD_PICTURE_NAMES) return;
  if (row->event == DYD_EVENT_TIE)
    snprintf(text, sizeof text, "%s", l->text);
  else if (!isfinite(row->lo))
    snprintf(text, sizeof text, "not lost by any motion");
  else
    snprintf(text, sizeof text, "not lost below %s", rounded(number, row->lo, 3, DYD_DOWN));
  dyd_picture_name_pair(p->canvas, g->r->engine, row->i, row->j, text);
}

/* Bounds are those of their two digits. */
static void class_entry(dyd_legend *legend, const dyd_picture *p, const dyd_picture_layer *l) {
  const tolerance_drawing *g = p->what;
  char text[80], number[DYD_DECIMAL_SIZE];
  if (!dyd_picture_drawn(p, l)) return;
  if (l->kind < CLASSES - 1 && isfinite(g->bound[l->kind]))
    snprintf(text, sizeof text, "less than %s", rounded(number, g->bound[l->kind], 2, DYD_DOWN));
  else if (l->kind && isfinite(g->bound[l->kind - 1]))
    snprintf(text, sizeof text, "%s or more", rounded(number, g->bound[l->kind - 1], 2, DYD_DOWN));
  else
    snprintf(text, sizeof text, "not lost by any motion");
  dyd_legend_put(legend, l, text);
}

static void tolerance_notes(dyd_legend *legend, const dyd_picture *p) {
  const tolerance_drawing *g = p->what;
  char text[200], number[DYD_DECIMAL_SIZE];
  const dyd_tolerance_result *of = dyd_tolerance_get(g->t);
  snprintf(text, sizeof text, "%zu points; edges by how far all may move%s before they may be lost; %s%s", g->r->count,
           of->metric == DYD_METRIC_BOX ? ", in x and y each," : "",
           isfinite(of->lo) ? "nothing changes below " : "no motion changes anything",
           isfinite(of->lo) ? rounded(number, of->lo, 3, DYD_DOWN) : "");
  dyd_legend_text(legend, text);
  dyd_legend_crowd(legend, p->sites);
}

#define CLASS(k, rgb, lines, on, off)                                                                                  \
  { dyd_lines_walk, k, DYD_STYLE_LINE(rgb, lines, on, off), DYD_KEY_LINE, k + 1, "a quarter of the edges", class_entry }

static const dyd_picture_layer tolerance_rows[] = {
    {dyd_lines_walk, CLASSES, DYD_STYLE_LINE(DYD_RGB_TIE, 1, 0.2, 2.2), DYD_KEY_LINE, CLASSES + 1, "tie", NULL},
    CLASS(3, 0x004c80, 1.4, 0, 0),
    CLASS(2, 0x56b4e9, 1, 0, 0),
    CLASS(1, 0xe69f00, 1.2, 6, 2),
    CLASS(0, 0xd55e00, 1.4, 3, 2),
    {dyd_sites_walk, 0, DYD_STYLE_SITES(DYD_RGB_BAND, 0), DYD_KEY_NONE, 0, "rectangle of a point", NULL},
    {NULL, 1, DYD_SITES_DOTS, DYD_KEY_DOT, CLASSES + 2, "point", NULL}};

const dyd_picture_table dyd_tolerance_layers = DYD_PICTURE_TABLE(tolerance_rows, tolerance_notes);

dyd_status dyd_tolerance_picture(const dyd_output *o) {
  const dyd_result *r = o->what;
  tolerance_drawing g = {.r = r, .t = r->tolerance, .marks = dyd_sites_shown_of(r->pd, r->engine)};
  g.rows = dyd_tolerance_rows(&g.row, g.t);
  dyd_status st = find_classes(&g);
  if (st == DYD_OK) st = dyd_view_of(&g.view, o, NULL);
  if (st != DYD_OK) return st;
  return dyd_picture_write(&(dyd_picture){&dyd_tolerance_layers, "tolerance of the Delaunay triangulation",
                                          .view = &g.view, .what = &g, .sites = &g.marks,
                                          .lines = {g.rows, class_of, tolerance_path, tolerance_name}},
                           o);
}

/* ---- the table of pictures ---- */

dyd_writer *const dyd_picture_writers[DYD_CONTENTS] = {
    [DYD_CONTENT_DELAUNAY] = dyd_delaunay_picture,      [DYD_CONTENT_VORONOI] = dyd_voronoi_picture,
    [DYD_CONTENT_PLOT] = dyd_convergence_picture,       [DYD_CONTENT_DISC] = dyd_disc_picture,
    [DYD_CONTENT_BISECTOR] = dyd_bisector_picture,      [DYD_CONTENT_NEAREST] = dyd_nearest_picture,
    [DYD_CONTENT_TOLERANCE] = dyd_tolerance_picture,    [DYD_CONTENT_PLAN] = dyd_plan_picture,
    [DYD_CONTENT_GRAPH_NEAREST] = dyd_delaunay_picture, [DYD_CONTENT_GRAPH_GABRIEL] = dyd_delaunay_picture,
    [DYD_CONTENT_GRAPH_MST] = dyd_delaunay_picture,     [DYD_CONTENT_TILES] = dyd_voronoi_picture,
    [DYD_CONTENT_SPHERE] = dyd_sphere_picture,          [DYD_CONTENT_SPHERE_VORONOI] = dyd_sphere_voronoi_picture};
