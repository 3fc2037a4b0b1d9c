/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of a partial disc: what is surely inside of the circle of three points, what surely outside, the
 * undetermined rest, the six critical circles and their centres, the other points.
 *
 * Surely inside is the intersection of the three discs that enclose one rectangle, surely outside what is in none of
 * the three that enclose two. */
#include "base/error.h"
#include "io/exact_text.h"
#include "io/pieces.h"
#include "picture/picture.h"
#include "picture/panel.h"
#include <math.h>

enum { CIRCLES = 6, ONCE = 3, WHITE = 0xffffff };
#define INSIDE 0xcfe4f3
#define CURVE 0x0072b2
#define LARGE 1e5 /* radius in points from where only the part near the picture is drawn */
#define MOST 1e13 /* radius from where doubles do not tell where the circle is, to hundredths of a point */

typedef struct drawing {
  const dyd_partial_disc *d;
  const dyd_rect *const *r;
  size_t n;
  dyd_view view;
  double at[CIRCLES][3]; /* centre, radius */
} drawing;

static void place(double out[3], const dyd_circle *k) {
  dyd_surd_point p;
  double lo, hi;
  dyd_surd_point_init(&p);
  mpz_set(p.ax, k->ax);
  mpz_set(p.bx, k->bx);
  mpz_set(p.ay, k->ay);
  mpz_set(p.by, k->by);
  mpz_set(p.c, k->c);
  mpz_set(p.d, k->d);
  for (int axis = 0; axis < 2; axis++) {
    dyd_exact_enclose(&lo, &hi, &p, axis);
    out[axis] = lo / 2 + hi / 2;
  }
  mpz_set(p.ax, k->ar);
  mpz_set(p.bx, k->br);
  mpz_set(p.d, k->dr);
  dyd_exact_enclose_root(&lo, &hi, &p);
  out[2] = lo / 2 + hi / 2;
  dyd_surd_point_clear(&p);
}

/* ---- circles ---- */

/* A large disc near the picture: a piece of its edge about the point closest to the middle of the picture, and three
 * more sides deep inside (only for filling). All of the picture, or nothing, when the edge does not come near. */
static void large_path(cairo_t *cr, const dyd_view *v, double x, double y, double radius, bool closed) {
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

static void circle_path(cairo_t *cr, const drawing *g, int k, bool closed) {
  double x = dyd_view_x(&g->view, g->at[k][0]), y = dyd_view_y(&g->view, g->at[k][1]);
  double radius = g->at[k][2] * g->view.scale;
  cairo_new_path(cr);
  if (radius < LARGE)
    cairo_arc(cr, x, y, radius, 0, 2 * acos(-1.0));
  else
    large_path(cr, &g->view, x, y, radius, closed);
}

static void draw_areas(cairo_t *cr, const drawing *g) {
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

static void draw_circles(cairo_t *cr, const drawing *g) {
  for (int k = 0; k < CIRCLES; k++) {
    circle_path(cr, g, k, false);
    dyd_picture_pen(cr, CURVE, 1.5, k < ONCE ? 0 : 4, k < ONCE ? 0 : 2.5);
    cairo_stroke(cr);
  }
  for (int k = 0; k < CIRCLES; k++) {
    double x = dyd_view_x(&g->view, g->at[k][0]), y = dyd_view_y(&g->view, g->at[k][1]);
    if (fabs(x) < LARGE && fabs(y) < LARGE) dyd_picture_dot(cr, x, y, 3, k < ONCE ? CURVE : WHITE, CURVE);
  }
}

/* ---- the rest ---- */

static unsigned colour_of(dyd_sure con) {
  return con == DYD_SURE_PLUS ? CURVE : con == DYD_SURE_MINUS ? WHITE : 0xd55e00;
}

static void draw_sites(cairo_t *cr, const drawing *g) {
  for (size_t i = g->n; i-- > 0;) {
    double b[4];
    dyd_interval_get_d(&b[0], &b[1], &g->r[i]->x);
    dyd_interval_get_d(&b[2], &b[3], &g->r[i]->y);
    dyd_picture_numbered(cr, &g->view, b, i < 3 ? 0x777777 : colour_of(dyd_partial_disc_con(g->d, g->r[i])), i);
  }
}

static void draw_legend(cairo_t *cr, const drawing *g) {
  double width, height, y, x = 30;
  dyd_view_page(&width, &height, &y, &g->view);
  dyd_picture_entry(cr, &x, y, INSIDE, true, 0, 0, "surely inside");
  dyd_picture_entry(cr, &x, y, WHITE, true, 0, 0, "surely outside");
  dyd_picture_entry(cr, &x, y, DYD_PICTURE_BAND, true, 0, 0, "undetermined");
  if (g->n > 3) dyd_plot_text(cr, x, y + 5, 0, 14, "other points: in darker shades of these");
  dyd_picture_scale(cr, &g->view, y);
  if (!g->d->known) {
    dyd_plot_text(cr, 30, y + DYD_PICTURE_ROW + 5, 0, 14, "0, 1 and 2 may be on a line: there is no partial disc");
    return;
  }
  x = 30;
  dyd_picture_entry(cr, &x, y + DYD_PICTURE_ROW, CURVE, false, 0, 0, "circle around one of 0 1 2, touching two");
  dyd_picture_entry(cr, &x, y + DYD_PICTURE_ROW, CURVE, false, 4, 2.5, "around two, touching one");
  dyd_picture_dot(cr, x, y + DYD_PICTURE_ROW, 3, CURVE, CURVE);
  dyd_picture_dot(cr, x + 12, y + DYD_PICTURE_ROW, 3, WHITE, CURVE);
  dyd_plot_text(cr, x + 22, y + DYD_PICTURE_ROW + 5, 0, 14, "their centres");
}

static void draw(cairo_t *cr, void *context) {
  const drawing *g = context;
  dyd_picture_begin(cr);
  cairo_save(cr);
  dyd_view_frame_path(cr, &g->view);
  cairo_clip(cr);
  if (g->d->known) {
    draw_areas(cr, g);
    draw_circles(cr, g);
  } else {
    dyd_picture_colour(cr, DYD_PICTURE_BAND);
    cairo_paint(cr);
  }
  draw_sites(cr, g);
  cairo_restore(cr);
  dyd_view_frame_path(cr, &g->view);
  dyd_picture_pen(cr, 0x222222, 1, 0, 0);
  cairo_stroke(cr);
  draw_legend(cr, g);
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

static dyd_status find_view(drawing *g, dyd_error *err) {
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  dyd_status status = DYD_OK;
  for (size_t i = 0; i < g->n && status >= 0; i++) status = dyd_pieces_grow(box, g->r[i], err);
  if (status < 0) return status;
  if (g->d->known) see_circles(box, (const double(*)[3])g->at);
  dyd_pieces_pad(box);
  status = dyd_view_fit(&g->view, box, 0, err);
  for (int k = 0; k < CIRCLES && g->d->known && status >= 0; k++)
    if (!(g->at[k][2] * g->view.scale < MOST))
      status = dyd_fail(err, DYD_E_RANGE, "the circle is too large for a picture; use csv or json");
  return status;
}

dyd_status dyd_picture_disc(FILE *out, dyd_format kind, const dyd_partial_disc *d, const dyd_rect *const *r, size_t n,
                            dyd_error *err) {
  drawing g = {.d = d, .r = r, .n = n};
  double width, height, legend;
  for (int k = 0; k < CIRCLES && d->known; k++) place(g.at[k], &d->circle[k]);
  dyd_status status = find_view(&g, err);
  if (status < 0) return status;
  dyd_view_page(&width, &height, &legend, &g.view);
  return dyd_page_write(out, kind, width, height, draw, &g, err);
}
