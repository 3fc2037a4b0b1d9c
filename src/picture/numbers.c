/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers or identifiers beside sites, where there is room.
 *
 * The page is divided into small squares; what is drawn takes those that it meets, and a number stands at the first of
 * eight places around its site whose squares are all free. */
#include "io/diagram.h"
#include "io/label_text.h"
#include "picture/picture.h"
#include <math.h>
#include <stdlib.h>

#define SQUARE 3.0
#define ROOMY 28.0 /* neighbours so far apart have room for numbers */

typedef struct squares {
  size_t x0, x1, y0, y1; /* from, up to */
} squares;

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
static squares squares_of(const dyd_numbers *l, const double z[4]) {
  const double *f = l->view->frame;
  squares s = {(size_t)(fmax(z[0], f[0]) / SQUARE), (size_t)(fmax(fmin(z[1], f[1]), 0) / SQUARE) + 1,
               (size_t)(fmax(z[2], f[2]) / SQUARE), (size_t)(fmax(fmin(z[3], f[3]), 0) / SQUARE) + 1};
  return s;
}

static void take_squares(dyd_numbers *l, const double z[4]) {
  squares s = squares_of(l, z);
  for (size_t y = s.y0; y < s.y1; y++)
    for (size_t x = s.x0; x < s.x1; x++) l->taken[y * l->columns + x] = 1;
}

static bool is_free(const dyd_numbers *l, const double z[4]) {
  const double *f = l->view->frame;
  if (!(z[0] > f[0] + 2 && z[1] < f[1] - 2 && z[2] > f[2] + 2 && z[3] < f[3] - 2)) return false;
  squares s = squares_of(l, z);
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

void dyd_numbers_put(dyd_numbers *l, dyd_canvas *c, const double box[4], double size, const dyd_engine *e,
                     size_t site) {
  /* Steps right and down from the box: -1 before, 0 about the middle, 1 behind. */
  static const int place[8][2] = {{1, -1}, {1, 1}, {-1, -1}, {-1, 1}, {1, 0}, {-1, 0}, {0, -1}, {0, 1}};
  char spare[DYD_LABEL_SIZE];
  double b[4], z[4];
  if (!dyd_view_sees(l->view, box)) return;
  const char *text = dyd_label_text(spare, e, site);
  double wide = dyd_canvas_width(c, size, text), high = 0.74 * size, gap = 3;
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

/* ---- all sites ---- */

static bool plane_site_box(double out[4], const void *context, size_t i) {
  const dyd_delaunay *pd = context;
  if (dyd_delaunay_alias(pd, (uint32_t)i) != i) return false;
  dyd_sites_get_d(out, dyd_delaunay_sites(pd), i);
  return dyd_box_is_finite(out);
}

dyd_site_marks dyd_site_marks_of(const dyd_delaunay *pd, const dyd_engine *e, unsigned rgb) {
  return (dyd_site_marks){
      .engine = e, .count = dyd_sites_count(dyd_delaunay_sites(pd)), .box = plane_site_box, .context = pd, .rgb = rgb};
}

/* Is nothing of the mark beside the squares that are drawn in its place? */
static bool is_mark_covered(const dyd_site_marks *m, const dyd_view *v, const double box[4]) {
  double z[4];
  if (!m->under) return false;
  page_box(z, v, box, v->dot);
  return dyd_density_covers(m->under, z);
}

void dyd_site_marks_draw(dyd_site_marks *m, dyd_canvas *c, const dyd_view *v) {
  dyd_numbers labels = {0};
  bool numbers = v->apart >= ROOMY && dyd_numbers_init(&labels, v);
  for (int pass = 0; pass < (numbers ? 2 : 1); pass++)
    for (size_t i = 0; i < m->count; i++) {
      double b[4];
      if (!m->box(b, m->context, i)) continue;
      if (is_mark_covered(m, v, b)) continue;
      if (!pass) m->drawn[dyd_picture_site(c, v, b, m->engine, i, m->rgb)] = true;
      if (!pass && numbers) dyd_numbers_keep_off(&labels, b);
      if (pass) dyd_numbers_put(&labels, c, b, 13, m->engine, i);
    }
  dyd_numbers_clear(&labels);
}
