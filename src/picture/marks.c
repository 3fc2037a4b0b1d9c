/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sites in a view, with their numbers or identifiers where there is room; pairs of them, as lines or as squares.
 *
 * For numbers the page is divided into small squares; a drawn mark takes the squares that it meets, and a number is
 * written at the first of eight places around its site whose squares are all free. */
#include "base/local.h"
#include "io/decimal.h"
#include "io/diagram.h"
#include "io/output.h"
#include "picture/picture.h"

#include <math.h>
#include <stdlib.h>

/* ---- sites ---- */

#define LARGEST_DISC 1e6 /* across, on the page: larger ones are drawn as their squares */

/* "point 7 (Alpha): x 1.5, y in [2,2.25]" when the pointer is on it. */
static void name_site(dyd_canvas *c, const double box[4], const dyd_engine *e, size_t site) {
  char id[40], title[200], called[DYD_LABEL_SIZE + 8] = "", spare[DYD_LABEL_SIZE], text[2][2 * DYD_DECIMAL_SIZE + 8];
  for (int k = 0; k < 2; k++) {
    char lo[DYD_DECIMAL_SIZE], hi[DYD_DECIMAL_SIZE];
    dyd_decimal_directed(lo, box[2 * k], 10, DYD_DOWN);
    dyd_decimal_directed(hi, box[2 * k + 1], 10, DYD_UP);
    if (box[2 * k] == box[2 * k + 1])
      snprintf(text[k], sizeof text[k], "about %s", lo);
    else
      snprintf(text[k], sizeof text[k], "in [%s,%s]", lo, hi);
  }
  size_t number = dyd_engine_row(e, site);
  snprintf(id, sizeof id, "point-%zu", number);
  const char *label = dyd_label_text(spare, e, site);
  if (label != spare) snprintf(called, sizeof called, " (%s)", label);
  snprintf(title, sizeof title, "point %zu%s: x %s, y %s", number, called, text[0], text[1]);
  dyd_canvas_name(c, id, title);
}

void dyd_picture_name_pair(dyd_canvas *c, const dyd_engine *e, size_t i, size_t j, const char *what) {
  char id[80], title[120];
  size_t a = dyd_engine_row(e, i), b = dyd_engine_row(e, j);
  snprintf(id, sizeof id, "pair-%zu-%zu", a, b);
  snprintf(title, sizeof title, "%zu, %zu: %s", a, b, what);
  dyd_canvas_name(c, id, title);
}

static bool is_dot(const dyd_view *v, const double box[4]) {
  return v->dots || fmax(box[1] - box[0], box[3] - box[2]) * v->scale < 2 * v->dot;
}

/* A dot, of the layer behind l, or a rectangle. */
static void draw_site(dyd_picture *p, const dyd_picture_layer *l, const double box[4], size_t site, unsigned rgb) {
  const dyd_view *v = p->view;
  double x0 = dyd_view_x(v, box[0]), x1 = dyd_view_x(v, box[1]), y0 = dyd_view_y(v, box[3]), y1 = dyd_view_y(v, box[2]);
  const double *f = v->frame;
  name_site(p->canvas, box, p->sites->engine, site);
  if (is_dot(v, box)) {
    dyd_canvas_circle(p->canvas, x0 / 2 + x1 / 2, y0 / 2 + y1 / 2, v->dot);
    dyd_picture_paint(p, l + 1);
    return;
  }
  /* Lengths far outside do not fit the numbers of a page. */
  if (v->discs && x1 - x0 < LARGEST_DISC) {
    dyd_canvas_circle(p->canvas, x0 / 2 + x1 / 2, y0 / 2 + y1 / 2, (x1 - x0) / 2);
  } else {
    x0 = fmax(x0, f[0] - 60), x1 = fmin(x1, f[1] + 60), y0 = fmax(y0, f[2] - 60), y1 = fmin(y1, f[3] + 60);
    double least = fmax(v->line, 1);
    dyd_canvas_box(p->canvas, x0, y0, fmax(x1 - x0, least), fmax(y1 - y0, least));
  }
  dyd_picture_shape(p->canvas, rgb, 0.55, (rgb >> 1 & 0x7f7f7f) + (rgb >> 4 & 0x0f0f0f), fmax(v->line * 0.7, 0.5));
  dyd_picture_seen(p, l);
}

void dyd_picture_marked(dyd_canvas *c, const dyd_view *v, const double box[4], const dyd_engine *e, size_t site) {
  double w = fmax((box[1] - box[0]) * v->scale, 7), h = fmax((box[3] - box[2]) * v->scale, 7);
  double z[2];
  dyd_view_middle(z, v, box);
  name_site(c, box, e, site);
  dyd_canvas_box(c, z[0] - w / 2, z[1] - h / 2, w, h);
}

/* ---- numbers ---- */

#define SQUARE 3.0
#define ROOMY 28.0 /* neighbours so far apart have room for numbers */

typedef struct square_range {
  size_t x0, x1, y0, y1; /* from, up to */
} square_range;

bool dyd_numbers_init(dyd_numbers *l, const dyd_view *v) {
  l->view = v;
  l->columns = (size_t)(v->frame[1] / SQUARE) + 2;
  l->rows = (size_t)(v->frame[3] / SQUARE) + 2;
  l->taken = calloc(l->columns * l->rows, 1);
  return l->taken != NULL;
}

void dyd_numbers_clear(dyd_numbers *l) {
  free(l->taken);
}

/* The squares that a box on the page meets, as far as they are in the frame. */
static square_range squares_of(const dyd_numbers *l, const double z[4]) {
  const double *f = l->view->frame;
  return (square_range){(size_t)(fmax(z[0], f[0]) / SQUARE), (size_t)(fmax(fmin(z[1], f[1]), 0) / SQUARE) + 1,
                        (size_t)(fmax(z[2], f[2]) / SQUARE), (size_t)(fmax(fmin(z[3], f[3]), 0) / SQUARE) + 1};
}

static void take_squares(dyd_numbers *l, const double z[4]) {
  square_range s = squares_of(l, z);
  for (size_t y = s.y0; y < s.y1; y++)
    for (size_t x = s.x0; x < s.x1; x++) l->taken[y * l->columns + x] = 1;
}

static bool is_free(const dyd_numbers *l, const double z[4]) {
  const double *f = l->view->frame;
  if (!(z[0] > f[0] + 2 && z[1] < f[1] - 2 && z[2] > f[2] + 2 && z[3] < f[3] - 2)) return false;
  square_range s = squares_of(l, z);
  for (size_t y = s.y0; y < s.y1; y++)
    for (size_t x = s.x0; x < s.x1; x++)
      if (l->taken[y * l->columns + x]) return false;
  return true;
}

/* A box on the page, reaching `least` from its middle. */
static void page_box(double z[4], const dyd_view *v, const double box[4], double least) {
  double at[2];
  dyd_view_middle(at, v, box);
  z[0] = fmin(dyd_view_x(v, box[0]), at[0] - least), z[1] = fmax(dyd_view_x(v, box[1]), at[0] + least);
  z[2] = fmin(dyd_view_y(v, box[3]), at[1] - least), z[3] = fmax(dyd_view_y(v, box[2]), at[1] + least);
}

void dyd_numbers_keep_off(dyd_numbers *l, const double box[4]) {
  double z[4];
  page_box(z, l->view, box, fmax(l->view->dot, 3.5));
  if (dyd_view_sees(l->view, box)) take_squares(l, z);
}

static void put_text(dyd_numbers *l, dyd_canvas *c, const double box[4], double size, const char *text) {
  /* Steps right and down from the box: -1 before, 0 about the middle, 1 behind. */
  static const int place[8][2] = {{1, -1}, {1, 1}, {-1, -1}, {-1, 1}, {1, 0}, {-1, 0}, {0, -1}, {0, 1}};
  double b[4], z[4];
  if (!dyd_view_sees(l->view, box)) return;
  double wide = dyd_canvas_width(c, size, text), high = 0.74 * size * c->text, gap = 3;
  page_box(b, l->view, box, fmax(l->view->dot, 3.5));
  for (int k = 0; k < 8; k++) {
    int across = place[k][0], down = place[k][1];
    z[0] = across > 0 ? b[1] + gap : across < 0 ? b[0] - gap - wide : (b[0] + b[1] - wide) / 2;
    z[2] = down > 0 ? b[3] + gap : down < 0 ? b[2] - gap - high : (b[2] + b[3] - high) / 2;
    z[1] = z[0] + wide, z[3] = z[2] + high;
    if (!is_free(l, z)) continue;
    take_squares(l, z);
    dyd_canvas_text(c, z[0], z[3], 0, size, true, text);
    return;
  }
}

void dyd_numbers_put(dyd_numbers *l, dyd_canvas *c, const double box[4], double size, const dyd_engine *e,
                     size_t site) {
  char spare[DYD_LABEL_SIZE];
  put_text(l, c, box, size, dyd_label_text(spare, e, site));
}

/* ---- all sites ---- */

int dyd_plan_quarter(const dyd_plan_shown *plan, size_t k) {
  return (int)(DYD_QUARTERS * k / plan->rows);
}

static bool plane_site_box(double out[4], const void *context, size_t i) {
  const dyd_delaunay *pd = context;
  if (dyd_delaunay_alias(pd, (uint32_t)i) != i) return false;
  dyd_sites_get_d(out, dyd_delaunay_sites(pd), i);
  return dyd_box_is_finite(out);
}

dyd_sites_shown dyd_sites_shown_of(const dyd_delaunay *pd, const dyd_engine *e) {
  return (dyd_sites_shown){
      .engine = e, .count = dyd_sites_count(dyd_delaunay_sites(pd)), .box = plane_site_box, .context = pd};
}

/* Returns true if the squares drawn instead of the mark cover all of it. */
static bool is_mark_covered(const dyd_sites_shown *m, const dyd_view *v, const double box[4]) {
  double z[4];
  if (!m->under) return false;
  page_box(z, v, box, v->dot);
  return dyd_density_covers(m->under, z);
}

/* Points of a plan are marked, however small they are. */
static void draw_mark(dyd_picture *p, const dyd_picture_layer *l, const double box[4], size_t i) {
  static const unsigned of_quarter[DYD_QUARTERS] = {DYD_RGB_PLAN_1, DYD_RGB_PLAN_2, DYD_RGB_PLAN_3, DYD_RGB_PLAN_4};
  const dyd_sites_shown *m = p->sites;
  const size_t rank = m->plan ? m->plan->rank[i] : 0;
  const unsigned rgb = rank ? of_quarter[dyd_plan_quarter(m->plan, rank - 1)] : l->style.fill;
  if (!dyd_view_sees(p->view, box)) return;
  if (!rank || !is_dot(p->view, box)) {
    draw_site(p, l, box, i, rgb);
    return;
  }
  dyd_picture_marked(p->canvas, p->view, box, m->engine, i);
  dyd_picture_shape(p->canvas, rgb, 1, 0x222222, 1.5);
}

/* "1: T16": ranks and points, where there is room. */
static void draw_ranks(const dyd_sites_shown *m, dyd_canvas *c, dyd_numbers *labels) {
  for (size_t k = 0; k < m->plan->rows; k++) {
    char spare[DYD_LABEL_SIZE], text[DYD_LABEL_SIZE + 32];
    double box[4];
    if (!m->box(box, m->context, m->plan->row[k].site)) continue;
    snprintf(text, sizeof text, "%zu: %s", k + 1, dyd_label_text(spare, m->engine, m->plan->row[k].site));
    put_text(labels, c, box, 13, text);
  }
}

void dyd_sites_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const dyd_sites_shown *m = p->sites;
  DYD_SCOPED(dyd_numbers) labels = {0};
  bool numbers = (m->plan || p->view->apart >= ROOMY) && dyd_numbers_init(&labels, p->view);
  for (int pass = 0; pass < (numbers && !m->plan ? 2 : 1); pass++)
    for (size_t i = 0; i < m->count; i++) {
      double b[4];
      if (!m->box(b, m->context, i)) continue;
      if (is_mark_covered(m, p->view, b)) continue;
      if (!pass) draw_mark(p, l, b, i);
      if (!pass && numbers && (!m->plan || m->plan->rank[i])) dyd_numbers_keep_off(&labels, b);
      if (pass) dyd_numbers_put(&labels, p->canvas, b, 13, m->engine, i);
    }
  if (numbers && m->plan) draw_ranks(m, p->canvas, &labels);
}

void dyd_sites_entry(dyd_legend *legend, const dyd_picture *p, const dyd_picture_layer *l) {
  char text[80];
  const char *shape = p->view->discs ? "disc" : "rectangle";
  if (!dyd_picture_drawn(p, l)) return;
  if (l->key == DYD_KEY_PATCH)
    snprintf(text, sizeof text, "%s %s", shape, l->text);
  else
    snprintf(text, sizeof text, p->view->dots ? "%s, or the middle of its %s" : "%s, or a %s so small", l->text, shape);
  dyd_legend_put(legend, l, text);
}

/* ---- pairs ---- */

void dyd_pairs_name(dyd_picture *p, const dyd_picture_layer *l, size_t k) {
  const dyd_pair *pair = &p->pairs->list->item[k];
  dyd_picture_name_pair(p->canvas, p->pairs->engine, pair->i, pair->j, l->text);
}

void dyd_pairs_settle(dyd_pairs_shown *pairs) {
  pairs->crowded = dyd_density_is_crowded(&pairs->dense[DYD_KIND_OPEN]);
  if (!pairs->crowded) dyd_density_clear(&pairs->dense[DYD_KIND_OPEN]);
}

void dyd_pairs_entry(dyd_legend *legend, const dyd_picture *p, const dyd_picture_layer *l) {
  char text[80];
  if (!p->pairs->shown[l->kind] || (p->pairs->crowded && l->kind == DYD_KIND_OPEN)) return;
  snprintf(text, sizeof text, "%s: %zu", l->text, p->pairs->shown[l->kind]);
  dyd_legend_put(legend, l, text);
}
