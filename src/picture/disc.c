/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of a partial disc: what is surely inside of the circle of three points, what surely outside, the
 * undetermined rest, the six critical circles and their centres, the other points.
 *
 * Surely inside is the intersection of the three discs that enclose one rectangle, surely outside what is in none of
 * the three that enclose two. */
#include "base/error.h"
#include "io/exact_text.h"
#include "picture/picture.h"
#include <math.h>

enum { CIRCLES = 6, ONCE = 3, WHITE = 0xffffff };
#define INSIDE 0xcfe4f3
#define CURVE 0x0072b2
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
static void large_circle_path(cairo_t *cr, const dyd_view *v, double x, double y, double radius, bool closed) {
  enum { STEPS = 64 };
  double mx = dyd_view_x(v, v->left) + v->width / 2, my = dyd_view_y(v, v->top) + v->height / 2;
  double size = v->width + v->height, away = hypot(mx - x, my - y), middle = atan2(my - y, mx - x);
  if (fabs(away - radius) > size) {
    if (closed && away < radius) dyd_view_frame_path(cr, v);
    return;
  }
  for (int k = -STEPS; k <= STEPS; k++) {
    double turn = middle + 4 * size / radius * k / STEPS;
    cairo_line_to(cr, x + radius * cos(turn), y + radius * sin(turn));
  }
  if (!closed) return;
  for (int k = 1; k >= -1; k -= 2) {
    double turn = middle + 4 * size / radius * k;
    cairo_line_to(cr, x + radius * cos(turn) - 4 * size * cos(middle), y + radius * sin(turn) - 4 * size * sin(middle));
  }
  cairo_close_path(cr);
}

static void circle_path(cairo_t *cr, const disc_drawing *g, int k, bool closed) {
  double x = dyd_view_x(&g->view, g->at[k][0]), y = dyd_view_y(&g->view, g->at[k][1]);
  double radius = g->at[k][2] * g->view.scale;
  cairo_new_path(cr);
  if (radius < LARGE)
    cairo_arc(cr, x, y, radius, 0, 2 * acos(-1.0));
  else
    large_circle_path(cr, &g->view, x, y, radius, closed);
}

static void disc_areas(cairo_t *cr, const disc_drawing *g) {
  dyd_picture_colour(cr, DYD_PICTURE_BAND);
  for (int k = ONCE; k < CIRCLES; k++) {
    circle_path(cr, g, k, true);
    cairo_fill(cr);
  }
  cairo_save(cr);
  for (int k = 0; k < ONCE; k++) {
    circle_path(cr, g, k, true);
    cairo_clip(cr);
  }
  dyd_picture_colour(cr, INSIDE);
  cairo_paint(cr);
  cairo_restore(cr);
}

static void disc_circles(cairo_t *cr, const disc_drawing *g) {
  for (int k = 0; k < CIRCLES; k++) {
    circle_path(cr, g, k, false);
    dyd_picture_stroke(cr, CURVE, 1.5, k < ONCE ? 0 : 4, k < ONCE ? 0 : 2.5);
  }
  for (int k = 0; k < CIRCLES; k++) {
    double x = dyd_view_x(&g->view, g->at[k][0]), y = dyd_view_y(&g->view, g->at[k][1]);
    if (fabs(x) < LARGE && fabs(y) < LARGE) dyd_picture_dot(cr, x, y, 3, k < ONCE ? CURVE : WHITE, CURVE);
  }
}

/* ---- the rest ---- */

static unsigned con_colour(dyd_sure con) {
  return con == DYD_SURE_PLUS ? CURVE : con == DYD_SURE_MINUS ? WHITE : 0xd55e00;
}

static void disc_sites(cairo_t *cr, const disc_drawing *g) {
  for (size_t i = g->n; i-- > 0;) {
    double b[4];
    dyd_rect_get_d(b, g->r[i]);
    dyd_picture_numbered(cr, &g->view, b, i < 3 ? 0x777777 : con_colour(dyd_partial_disc_con(g->d, g->r[i])),
                         dyd_engine_row(g->engine, i));
  }
}

static void disc_legend(cairo_t *cr, void *context) {
  const disc_drawing *g = context;
  double y = dyd_view_legend(&g->view), x = 30;
  dyd_picture_entry(cr, &x, y, INSIDE, true, 0, 0, "surely inside");
  dyd_picture_entry(cr, &x, y, WHITE, true, 0, 0, "surely outside");
  dyd_picture_entry(cr, &x, y, DYD_PICTURE_BAND, true, 0, 0, "undetermined");
  if (g->n > 3) dyd_picture_text(cr, x, y + 5, 0, 14, "other points: in darker shades of these");
  dyd_picture_scale(cr, &g->view, y);
  if (!g->d->known) {
    dyd_picture_text(cr, 30, y + DYD_PICTURE_ROW + 5, 0, 14, "0, 1 and 2 may be on a line: there is no partial disc");
    return;
  }
  x = 30;
  dyd_picture_entry(cr, &x, y + DYD_PICTURE_ROW, CURVE, false, 0, 0, "circle around one of 0 1 2, touching two");
  dyd_picture_entry(cr, &x, y + DYD_PICTURE_ROW, CURVE, false, 4, 2.5, "around two, touching one");
  dyd_picture_dot(cr, x, y + DYD_PICTURE_ROW, 3, CURVE, CURVE);
  dyd_picture_dot(cr, x + 12, y + DYD_PICTURE_ROW, 3, WHITE, CURVE);
  dyd_picture_text(cr, x + 22, y + DYD_PICTURE_ROW + 5, 0, 14, "their centres");
}

static void disc_inside(cairo_t *cr, void *context) {
  const disc_drawing *g = context;
  if (g->d->known) {
    disc_areas(cr, g);
    disc_circles(cr, g);
  } else {
    dyd_picture_colour(cr, DYD_PICTURE_BAND);
    cairo_paint(cr);
  }
  disc_sites(cr, g);
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
  return st == DYD_OK ? dyd_view_write(o, &g.view, disc_inside, disc_legend, &g) : st;
}
