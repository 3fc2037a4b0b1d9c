/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of a partial disc: what is surely inside of the circle of three points, what surely outside, the
 * undetermined rest, the six critical circles and their centres, the other points.
 *
 * Surely inside is the intersection of the three discs that enclose one rectangle, surely outside what is in none of
 * the three that enclose two. */
#include "base/error.h"
#include "io/decimal.h"
#include "picture/picture.h"
#include <math.h>

enum { CIRCLES = 6, ONCE = 3, WHITE = 0xffffff };
#define INSIDE 0xcfe4f3
#define CURVE 0x0072b2
#define TRIPLE 0x777777
#define LARGE 1e5 /* radius in points from where only the part near the picture is drawn */
#define MOST 1e13 /* radius from where doubles do not tell where the circle is, to hundredths of a point */

typedef struct disc_drawing {
  const dyd_partial_disc *d;
  const dyd_rect *const *r;
  size_t n;
  const dyd_engine *engine;
  dyd_view view;
  double at[CIRCLES][3]; /* centre, radius */
} disc_drawing;

static void place_circle(double out[3], const dyd_circle *k) {
  dyd_surd_point centre, radius2;
  double lo, hi;
  dyd_surd_point_init(&centre);
  dyd_surd_point_init(&radius2);
  dyd_exact_circle(&centre, &radius2, k);
  dyd_exact_middle(out, &centre);
  dyd_exact_enclose_root(&lo, &hi, &radius2);
  out[2] = lo / 2 + hi / 2;
  dyd_surd_point_clear(&radius2);
  dyd_surd_point_clear(&centre);
}

/* ---- circles ---- */

/* A large disc near the picture: a piece of its edge about the point closest to the middle of the picture, and three
 * more sides deep inside (only for filling). All of the picture, or nothing, when the edge does not come near. */
static void large_circle_path(dyd_canvas *c, const dyd_view *v, double x, double y, double radius, bool closed) {
  enum { STEPS = 64 };
  double mx = dyd_view_x(v, v->left) + v->width / 2, my = dyd_view_y(v, v->top) + v->height / 2;
  double size = v->width + v->height, away = hypot(mx - x, my - y), middle = atan2(my - y, mx - x);
  if (fabs(away - radius) > size) {
    if (closed && away < radius) dyd_view_frame_path(c, v);
    return;
  }
  for (int k = -STEPS; k <= STEPS; k++) {
    double turn = middle + 4 * size / radius * k / STEPS;
    dyd_canvas_line(c, x + radius * cos(turn), y + radius * sin(turn));
  }
  if (!closed) return;
  for (int k = 1; k >= -1; k -= 2) {
    double turn = middle + 4 * size / radius * k;
    dyd_canvas_line(c, x + radius * cos(turn) - 4 * size * cos(middle),
                    y + radius * sin(turn) - 4 * size * sin(middle));
  }
  dyd_canvas_close(c);
}

static void circle_path(dyd_canvas *c, const disc_drawing *g, int k, bool closed) {
  double x = dyd_view_x(&g->view, g->at[k][0]), y = dyd_view_y(&g->view, g->at[k][1]);
  double radius = g->at[k][2] * g->view.scale;
  if (radius < LARGE)
    dyd_canvas_circle(c, x, y, radius);
  else
    large_circle_path(c, &g->view, x, y, radius, closed);
}

static void disc_areas(dyd_canvas *c, const disc_drawing *g) {
  for (int k = ONCE; k < CIRCLES; k++) {
    circle_path(c, g, k, true);
    dyd_picture_fill(c, DYD_PICTURE_BAND);
  }
  for (int k = 0; k < ONCE; k++) {
    circle_path(c, g, k, true);
    dyd_canvas_clip(c);
  }
  dyd_view_frame_path(c, &g->view);
  dyd_picture_fill(c, INSIDE);
  for (int k = 0; k < ONCE; k++) dyd_canvas_unclip(c);
}

/* The rectangles that a circle encloses: number k of three alone, or all but it. */
static void name_circle(dyd_canvas *c, const char *what, int k) {
  char id[48], title[80];
  int a = (k + 1) % 3, b = (k + 2) % 3, one = k % 3;
  if (a > b) a ^= b, b ^= a, a ^= b;
  snprintf(id, sizeof id, "%s-%s-%d", what, k < ONCE ? "around" : "touching", one);
  if (k < ONCE)
    snprintf(title, sizeof title, "%s: around %d, touching %d and %d", what, one, a, b);
  else
    snprintf(title, sizeof title, "%s: around %d and %d, touching %d", what, a, b, one);
  dyd_canvas_name(c, id, title);
}

static void disc_circles(dyd_canvas *c, const disc_drawing *g) {
  for (int k = 0; k < CIRCLES; k++) {
    name_circle(c, "circle", k);
    circle_path(c, g, k, false);
    dyd_picture_stroke(c, CURVE, 1.5, k < ONCE ? 0 : 4, k < ONCE ? 0 : 2.5);
  }
  for (int k = 0; k < CIRCLES; k++) {
    double x = dyd_view_x(&g->view, g->at[k][0]), y = dyd_view_y(&g->view, g->at[k][1]);
    if (!(fabs(x) < LARGE && fabs(y) < LARGE)) continue;
    name_circle(c, "centre", k);
    dyd_picture_dot(c, x, y, 3, k < ONCE ? CURVE : WHITE, CURVE);
  }
}

/* ---- the rest ---- */

static unsigned con_colour(dyd_sure con) {
  return con == DYD_SURE_PLUS ? CURVE : con == DYD_SURE_MINUS ? WHITE : 0xd55e00;
}

static void disc_sites(dyd_canvas *c, const disc_drawing *g) {
  dyd_numbers labels;
  bool numbers = dyd_numbers_init(&labels, &g->view);
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = g->n; i-- > 0;) {
      double b[4];
      size_t first_first = g->n - 1 - i; /* numbers 0, 1, 2 have the choice */
      dyd_rect_get_d(b, g->r[pass ? first_first : i]);
      if (!pass)
        dyd_picture_marked(c, &g->view, b, g->engine, i,
                           i < 3 ? TRIPLE : con_colour(dyd_partial_disc_con(g->d, g->r[i])));
      if (numbers && !pass) dyd_numbers_keep_off(&labels, b);
      if (numbers && pass) dyd_numbers_put(&labels, c, b, 18, g->engine, first_first);
    }
  dyd_numbers_clear(&labels);
}

/* Which of the others there are: inside, outside, not known. */
static bool has_con(const disc_drawing *g, dyd_sure con) {
  for (size_t i = 3; i < g->n; i++)
    if (dyd_partial_disc_con(g->d, g->r[i]) == con) return true;
  return false;
}

static void disc_legend(dyd_canvas *c, void *context) {
  const disc_drawing *g = context;
  dyd_legend l;
  dyd_legend_begin(&l, c, &g->view);
  if (g->d->known) dyd_legend_patch(&l, INSIDE, "surely inside");
  if (g->d->known) dyd_legend_patch(&l, WHITE, "surely outside");
  dyd_legend_patch(&l, DYD_PICTURE_BAND, "undetermined");
  dyd_legend_patch(&l, TRIPLE, "the three points");
  if (has_con(g, DYD_SURE_PLUS)) dyd_legend_patch(&l, con_colour(DYD_SURE_PLUS), "point surely inside");
  if (has_con(g, DYD_SURE_MINUS)) dyd_legend_patch(&l, con_colour(DYD_SURE_MINUS), "point surely outside");
  if (has_con(g, DYD_UNSURE)) dyd_legend_patch(&l, con_colour(DYD_UNSURE), "point of which it is not known");
  if (!g->d->known) {
    dyd_legend_text(&l, "0, 1 and 2 may be on a line: there is no partial disc");
    return;
  }
  dyd_legend_line(&l, CURVE, 0, 0, "circle around one of 0 1 2, touching two");
  dyd_legend_line(&l, CURVE, 4, 2.5, "around two, touching one");
  dyd_legend_dot(&l, CURVE, CURVE, "centre of a full circle");
  dyd_legend_dot(&l, WHITE, CURVE, "of a dashed one");
}

static void disc_inside(dyd_canvas *c, void *context) {
  const disc_drawing *g = context;
  if (g->d->known) {
    disc_areas(c, g);
    disc_circles(c, g);
  } else {
    dyd_view_frame_path(c, &g->view);
    dyd_picture_fill(c, DYD_PICTURE_BAND);
  }
  disc_sites(c, g);
}

/* The circles, cut at the size of the rectangles around them. */
static void see_circles(double box[4], const double at[CIRCLES][3]) {
  double reach = fmax(box[1] - box[0], box[3] - box[2]);
  double most[4] = {box[0] - reach, box[1] + reach, box[2] - reach, box[3] + reach};
  for (int k = 0; k < CIRCLES; k++)
    for (int e = 0; e < 4; e++) {
      double end = at[k][e >> 1] + (e & 1 ? at[k][2] : -at[k][2]);
      box[e] = e & 1 ? fmax(box[e], fmin(end, most[e])) : fmin(box[e], fmax(end, most[e]));
    }
}

static dyd_status disc_view(disc_drawing *g, dyd_error *err) {
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  dyd_status st = DYD_OK;
  for (size_t i = 0; i < g->n && st == DYD_OK; i++) st = dyd_view_grow(box, g->r[i], err);
  if (st != DYD_OK) return st;
  if (g->d->known) see_circles(box, (const double(*)[3])g->at);
  dyd_view_pad(box);
  st = dyd_view_fit(&g->view, box, 0, err);
  for (int k = 0; k < CIRCLES && g->d->known && st == DYD_OK; k++)
    if (!(g->at[k][2] * g->view.scale < MOST))
      st = dyd_fail(err, DYD_E_RANGE, "the circle is too large for a picture; use csv or json");
  return st;
}

dyd_status dyd_disc_picture(const dyd_output *o) {
  const dyd_disc_output *c = o->what;
  disc_drawing g = {.d = c->disc, .r = c->r, .n = c->n, .engine = c->engine};
  for (int k = 0; k < CIRCLES && g.d->known; k++) place_circle(g.at[k], &g.d->circle[k]);
  dyd_status st = disc_view(&g, o->err);
  return st == DYD_OK ? dyd_view_write(o, &g.view, "partial disc", disc_inside, disc_legend, &g) : st;
}
