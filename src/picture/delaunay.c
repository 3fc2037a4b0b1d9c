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

static const struct {
  dyd_pair_status status;
  const char *name;
  unsigned rgb, region;
  double on, off, width;
} style[3] = {{DYD_TIE, "tie", 0x6b6b6b, 0xe4e4e4, 0.2, 2.2, 1.0},
              {DYD_INDETERMINATE, "indeterminate", 0xd55e00, 0xfbe3d1, 4, 2.5, 1.0},
              {DYD_LEGAL, "legal", 0x0072b2, 0xd3e6f2, 0, 0, 1.2}};

enum { TIED, OPEN, LEGAL };
#define TRIANGLE 0xe6f0f7
#define CLOSE 12.0 /* neighbours so close have rectangles that hide each other */
#define WIDE 50.0  /* room around the frame, in points, for lines and dashes that begin outside */
#define FAR 1e13   /* lengths on the page beyond which doubles do not give positions to a hundredth */

/* wide: the frame of the view with some room. */
typedef struct delaunay_drawing {
  const dyd_result *r;
  dyd_view view;
  dyd_triangle_list triangles;
  double wide[4];
  size_t shown[4], sites; /* lines of each status, rectangles that meet the frame */
  double (*at)[2];        /* the middle of each rectangle on the page; owned */
  bool any_wide;          /* some rectangle is more than a dot */
  bool there[3];          /* some pair has this style */
  dyd_density dense[3];   /* of lines of each style: all squares of OPEN, where it is crowded; else full ones */
  bool crowded;           /* those of OPEN are drawn instead of its lines */
  bool triangle, region[4], squares; /* was drawn; full squares */
  dyd_site_marks marks;
} delaunay_drawing;

static int style_of(dyd_pair_status status) {
  return status == DYD_LEGAL ? LEGAL : status == DYD_TIE ? TIED : OPEN;
}

/* What lines of a style are called. */
static const char *style_name(const delaunay_drawing *d, int k) {
  if (!d->r->graph_name) return style[k].name;
  return style[k].status == DYD_LEGAL ? "certain" : "possible";
}

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

/* Asks memory for the ends of a line to come: those of the second sites lie anywhere. */
static void fetch_line(const delaunay_drawing *d, size_t p) {
  enum { AHEAD = 16 };
  if (p + AHEAD < d->r->pairs.count) __builtin_prefetch(d->at[d->r->pairs.item[p + AHEAD].j]);
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
    side[0] = fmin(side[0], at), side[1] = fmax(side[1], at);
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

static void draw_triangles(dyd_canvas *c, delaunay_drawing *d) {
  bool names = has_names(d);
  for (size_t k = 0; k < d->triangles.count; k++) {
    const uint32_t *v = d->triangles.item[k].v;
    double z[DYD_CLIP_MOST][2];
    for (int corner = 0; corner < 3; corner++) memcpy(z[corner], d->at[v[corner]], sizeof z[corner]);
    if (is_covered(&d->dense[LEGAL], z, 3) || !polygon_path(c, d, z, 3)) continue;
    d->triangle = true;
    if (!names) continue;
    size_t row[3];
    for (int corner = 0; corner < 3; corner++) row[corner] = dyd_engine_row(d->r->engine, v[corner]);
    char id[80], title[80];
    snprintf(id, sizeof id, "triangle-%zu-%zu-%zu", row[0], row[1], row[2]);
    snprintf(title, sizeof title, "certain triangle %zu, %zu, %zu", row[0], row[1], row[2]);
    dyd_canvas_name(c, id, title);
    dyd_picture_fill(c, TRIANGLE);
  }
  if (!names) dyd_picture_fill(c, TRIANGLE);
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

static void draw_regions(dyd_canvas *c, delaunay_drawing *d, int k) {
  if (!d->any_wide || !d->there[k]) return;
  for (size_t p = 0; p < d->r->pairs.count; p++) {
    const dyd_pair *pair = &d->r->pairs.item[p];
    double a[4], b[4];
    if (pair->status != style[k].status) continue;
    dyd_sites_get_d(a, d->r->sites, pair->i);
    dyd_sites_get_d(b, d->r->sites, pair->j);
    if (!is_wide_box(d, a) && !is_wide_box(d, b)) continue;
    if (pair_path(c, d, a, b, &d->dense[k])) d->region[k] = true;
  }
  if (d->region[k]) dyd_picture_fill(c, style[k].region);
}

static void draw_edges(dyd_canvas *c, const delaunay_drawing *d, int k) {
  double width = d->view.line * style[k].width;
  bool names = has_names(d), any = false;
  if (!d->there[k]) return;
  for (size_t p = 0; p < d->r->pairs.count; p++) {
    const dyd_pair *pair = &d->r->pairs.item[p];
    double z[2][2];
    fetch_line(d, p);
    if (pair->status != style[k].status || !line_of(z, d, pair, d->wide) || is_covered(&d->dense[k], z, 2)) continue;
    any = true;
    dyd_canvas_move(c, z[0][0], z[0][1]);
    dyd_canvas_line(c, z[1][0], z[1][1]);
    if (!names) continue;
    dyd_picture_name_pair(c, d->r->engine, pair->i, pair->j, style_name(d, k));
    dyd_picture_stroke(c, style[k].rgb, width, style[k].on, style[k].off);
  }
  if (!names && any) dyd_picture_stroke(c, style[k].rgb, width, style[k].on, style[k].off);
}

static void legend_edges(dyd_legend *l, const delaunay_drawing *d) {
  char text[80];
  for (int k = 2; k >= 0; k--) {
    size_t shown = d->shown[style[k].status];
    if (shown == 0 || (d->crowded && k == OPEN)) continue;
    snprintf(text, sizeof text, "%s: %zu", style_name(d, k), shown);
    dyd_legend_line(l, style[k].rgb, style[k].on, style[k].off, text);
  }
  for (int k = 2; k >= 0; k--) {
    snprintf(text, sizeof text, " of %zu %s pairs across a square", d->shown[style[k].status], style_name(d, k));
    dyd_density_legend(l, &d->dense[k], text);
  }
}

static void delaunay_legend(dyd_canvas *c, void *context) {
  const delaunay_drawing *d = context;
  char text[300], points[100];
  bool graph = d->r->graph_name;
  dyd_legend l;
  dyd_legend_begin(&l, c, &d->view);
  legend_edges(&l, d);
  if (d->triangle) dyd_legend_patch(&l, TRIANGLE, "certain triangle");
  dyd_legend_marks(&l, &d->marks, 0xf2c766);
  if (d->region[2]) dyd_legend_patch(&l, style[2].region, graph ? "where a certain edge is" : "where a legal edge is");
  if (d->region[1])
    dyd_legend_patch(&l, style[1].region,
                     graph ? "where a possible edge may be" : "where an indeterminate edge may be");
  if (d->region[0]) dyd_legend_patch(&l, style[0].region, "where a tie may be");
  dyd_points_text(points, sizeof points, d->sites, d->r->count, d->r->window);
  snprintf(text, sizeof text, "%s, outcome %s%s; positions rounded by at most 0.01 of a pixel", points,
           dyd_outcome_text(dyd_engine_outcome(d->r->engine)),
           dyd_delaunay_is_capped(d->r->pd) ? ", not all possible pairs are shown" : "");
  dyd_legend_text(&l, text);
  if (d->squares)
    dyd_legend_text(&l, "squares of legal pairs and ties hide the lines, triangles and points that are in them");
  dyd_legend_crowd(&l, &d->marks);
}

static void delaunay_inside(dyd_canvas *c, void *context) {
  delaunay_drawing *d = context;
  draw_triangles(c, d);
  for (int k = 2; k >= 0 && !d->crowded; k--) draw_regions(c, d, k);
  d->squares = dyd_density_draw(c, &d->dense[LEGAL], NULL);
  d->squares |= dyd_density_draw(c, &d->dense[TIED], &d->dense[LEGAL]);
  dyd_density_draw(c, &d->dense[OPEN], &d->dense[LEGAL]);
  for (int k = 0; k < 3; k++)
    if (!(d->crowded && k == OPEN)) draw_edges(c, d, k);
  dyd_site_marks_draw(&d->marks, c, &d->view);
}

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
    d->shown[r->pairs.item[p].status] += !r->window || line_of(line, d, &r->pairs.item[p], f);
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
  static const dyd_density_levels *const levels[3] = {&dyd_density_full_grey, &dyd_density_all, &dyd_density_full};
  for (int k = 0; k < 3; k++)
    if ((k == OPEN || !has_names(d)) && !dyd_density_init(&d->dense[k], &d->view, levels[k])) return DYD_E_NOMEM;
  for (size_t p = 0; p < d->r->pairs.count; p++) {
    double z[2][2];
    int k = style_of(d->r->pairs.item[p].status);
    fetch_line(d, p);
    d->there[k] = true;
    if (!d->dense[k].count) continue;
    dyd_density_begin(&d->dense[k]);
    if (line_of(z, d, &d->r->pairs.item[p], d->view.frame)) dyd_density_add(&d->dense[k], z);
  }
  d->crowded = dyd_density_is_crowded(&d->dense[OPEN]);
  if (!d->crowded) dyd_density_clear(&d->dense[OPEN]);
  d->view.dots = d->crowded && (d->view.apart < CLOSE || are_rectangles_a_mass(d));
  if (d->dense[LEGAL].count) d->marks.under = &d->dense[LEGAL];
  return DYD_OK;
}

dyd_status dyd_delaunay_picture(const dyd_output *o) {
  const dyd_result *r = o->what;
  delaunay_drawing d = {.r = r, .marks = dyd_site_marks_of(r->pd, r->engine, DYD_PICTURE_BAND)};
  dyd_status st = delaunay_see(&d, o);
  const char *title = d.r->graph_name ? d.r->graph_name : "partial Delaunay triangulation";
  if (st == DYD_OK && !d.r->graph_name) st = dyd_delaunay_triangles(&d.triangles, NULL, d.r->pd, 0);
  if (st == DYD_OK) st = find_density(&d);
  if (st == DYD_OK) st = dyd_view_write(o, &d.view, title, delaunay_inside, delaunay_legend, &d);
  dyd_triangle_list_clear(&d.triangles);
  for (int k = 0; k < 3; k++) dyd_density_clear(&d.dense[k]);
  free(d.at);
  return st;
}

/* ---- tolerances ---- */

/* Of all edges, the quarter that dies first, and so on; distinct for all kinds of sight, and in grey. Then ties. */
enum { CLASSES = 4 };
static const struct {
  unsigned rgb;
  double on, off, width;
} bearing[CLASSES + 1] = {{0xd55e00, 3, 2, 1.4},
                          {0xe69f00, 6, 2, 1.2},
                          {0x56b4e9, 0, 0, 1.0},
                          {0x004c80, 0, 0, 1.4},
                          {0x6b6b6b, 0.2, 2.2, 1.0}};

typedef struct tolerance_drawing {
  const dyd_result *r;
  const dyd_tolerance_row *row;
  size_t rows;
  const dyd_tolerance *t;
  dyd_view view;
  double bound[CLASSES - 1]; /* from where on an edge belongs to the next class */
  bool seen[CLASSES + 1];    /* was drawn */
  dyd_site_marks marks;
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
static int class_of(const tolerance_drawing *g, const dyd_tolerance_row *row) {
  if (row->event == DYD_EVENT_BIRTH) return -1;
  if (row->event == DYD_EVENT_TIE) return CLASSES;
  int c = 0;
  while (c < CLASSES - 1 && row->lo >= g->bound[c]) c++;
  return c;
}

static void tolerance_name(dyd_canvas *c, const tolerance_drawing *g, const dyd_tolerance_row *row) {
  char text[80], number[DYD_DECIMAL_SIZE];
  if (row->event == DYD_EVENT_TIE)
    snprintf(text, sizeof text, "tie");
  else if (!isfinite(row->lo))
    snprintf(text, sizeof text, "not lost by any motion");
  else
    snprintf(text, sizeof text, "not lost below %s", rounded(number, row->lo, 3, DYD_DOWN));
  dyd_picture_name_pair(c, g->r->engine, row->i, row->j, text);
}

static void tolerance_edges(dyd_canvas *c, tolerance_drawing *g, int class) {
  for (size_t k = 0; k < g->rows; k++) {
    double z[2][2];
    if (class_of(g, &g->row[k]) != class || !dyd_view_line(z, &g->view, g->r, g->row[k].i, g->row[k].j)) continue;
    g->seen[class] = true;
    dyd_canvas_move(c, z[0][0], z[0][1]);
    dyd_canvas_line(c, z[1][0], z[1][1]);
    if (g->rows <= DYD_PICTURE_NAMES) tolerance_name(c, g, &g->row[k]);
    dyd_picture_stroke(c, bearing[class].rgb, g->view.line * bearing[class].width, bearing[class].on,
                       bearing[class].off);
  }
}

static void tolerance_inside(dyd_canvas *c, void *context) {
  tolerance_drawing *g = context;
  for (int k = CLASSES; k >= 0; k--) tolerance_edges(c, g, k);
  dyd_site_marks_draw(&g->marks, c, &g->view);
}

/* Bounds are those of their two digits. */
static void class_text(char *out, size_t size, const tolerance_drawing *g, int class) {
  char number[DYD_DECIMAL_SIZE];
  if (class < CLASSES - 1 && isfinite(g->bound[class]))
    snprintf(out, size, "less than %s", rounded(number, g->bound[class], 2, DYD_DOWN));
  else if (class && isfinite(g->bound[class - 1]))
    snprintf(out, size, "%s or more", rounded(number, g->bound[class - 1], 2, DYD_DOWN));
  else
    snprintf(out, size, "not lost by any motion");
}

static void tolerance_legend(dyd_canvas *c, void *context) {
  const tolerance_drawing *g = context;
  char text[200], number[DYD_DECIMAL_SIZE];
  const dyd_tolerance_result *of = dyd_tolerance_get(g->t);
  dyd_legend l;
  dyd_legend_begin(&l, c, &g->view);
  for (int k = 0; k < CLASSES; k++) {
    if (!g->seen[k]) continue;
    class_text(text, sizeof text, g, k);
    dyd_legend_line(&l, bearing[k].rgb, bearing[k].on, bearing[k].off, text);
  }
  if (g->seen[CLASSES]) dyd_legend_line(&l, bearing[CLASSES].rgb, bearing[CLASSES].on, bearing[CLASSES].off, "tie");
  if (g->marks.drawn[DYD_MARK_DOT]) dyd_legend_dot(&l, 0x222222, 0x222222, "point");
  snprintf(text, sizeof text, "%zu points; edges by how far all may move%s before they may be lost; %s%s", g->r->count,
           of->metric == DYD_METRIC_BOX ? ", in x and y each," : "",
           isfinite(of->lo) ? "nothing changes below " : "no motion changes anything",
           isfinite(of->lo) ? rounded(number, of->lo, 3, DYD_DOWN) : "");
  dyd_legend_text(&l, text);
  dyd_legend_crowd(&l, &g->marks);
}

dyd_status dyd_tolerance_picture(const dyd_output *o) {
  const dyd_result *r = o->what;
  tolerance_drawing g = {.r = r, .t = r->tolerance, .marks = dyd_site_marks_of(r->pd, r->engine, DYD_PICTURE_BAND)};
  g.rows = dyd_tolerance_rows(&g.row, g.t);
  dyd_status st = find_classes(&g);
  if (st == DYD_OK) st = dyd_view_of(&g.view, o, NULL);
  return st == DYD_OK ? dyd_view_write(o, &g.view, "tolerance of the Delaunay triangulation", tolerance_inside,
                                       tolerance_legend, &g)
                      : st;
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
