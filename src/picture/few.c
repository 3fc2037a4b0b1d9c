/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pictures of one question about few points: a partial disc, a partial bisector, which points are nearest to a place.
 *
 * A partial disc: the certain inside of the circle of three points is the intersection of the three discs that enclose
 * one rectangle, the certain outside is in none of the three that enclose two; the six critical circles and
 * their centres are drawn, and the other points.
 *
 * A partial bisector: the part certainly nearer to the one point, to the other, and the band between. A parabola v(t)
 * between t0 and t1 is the quadratic Bezier curve whose middle point has t = (t0 + t1) / 2 and lies on the tangent at
 * the first end: v = v(t0) + v'(t0) (t1 - t0) / 2. Arcs with an end at infinity are lines. The part certainly nearer
 * to a point is convex and infinite between the ends of its chain.
 *
 * Nearest points: for a place c in the rectangle Q no point lies nearer than m = min_k ds(Q, R_k), and one lies within
 * M = min_k dl(Q, R_k), where ds and dl are the least and largest distances of points of Q and R_k. So all that is
 * within m of Q is certainly free of points, and the nearest point certainly is within M of Q. Both are discs where Q
 * is a point. */
#include "base/error.h"
#include "base/local.h"
#include "io/decimal.h"
#include "picture/picture.h"
#include "predicate/circle.h"
#include "voronoi/surd_point.h"

#include <math.h>

#define CURVE 0x0072b2
#define INSIDE 0xcfe4f3

#define CALLED(rgb) DYD_STYLE_SHAPE(rgb, 0x222222, 0, 1.5)

/* Draws n rectangles, those of the first sites of e, in the layer as far behind l as `behind` says, and their numbers
 * or identifiers, of which the first ones have the choice where they stand. over: the first ones are drawn over the
 * others. */
static void draw_called(dyd_picture *p, const dyd_picture_layer *l, const dyd_engine *e, const dyd_rect *const *r,
                        size_t n, bool over, int (*behind)(const void *what, size_t i)) {
  DYD_SCOPED(dyd_numbers) labels;
  double b[4];
  bool numbers = dyd_numbers_init(&labels, p->view);
  for (size_t k = 0; k < n; k++) {
    size_t i = over ? n - 1 - k : k;
    dyd_rect_get_d(b, r[i]);
    dyd_picture_marked(p->canvas, p->view, b, e, i);
    dyd_picture_paint(p, l + behind(p->what, i));
    if (numbers) dyd_numbers_keep_off(&labels, b);
  }
  for (size_t i = 0; i < n && numbers; i++) {
    dyd_rect_get_d(b, r[i]);
    dyd_numbers_put(&labels, p->canvas, b, 18, e, i);
  }
}

/* ---- a partial disc ---- */

enum { CIRCLES = 6, ONCE = 3, WHITE = 0xffffff };

#define LARGE 1e5 /* radius in points from where only the part near the picture is drawn */
#define MOST 1e13 /* radius from which doubles do not give the circle to hundredths of a point */

typedef struct disc_drawing {
  const dyd_partial_disc *d;
  const dyd_rect *const *r;
  size_t n;
  const dyd_engine *engine;
  dyd_view view;
  double at[CIRCLES][3]; /* centre, radius */
} disc_drawing;

static void place_circle(double out[3], const dyd_circle *k) {
  double lo, hi;
  DYD_LOCAL(dyd_surd_point, centre, radius2);
  dyd_exact_circle(&centre, &radius2, k);
  dyd_exact_middle(out, &centre);
  dyd_exact_enclose_root(&lo, &hi, &radius2);
  out[2] = lo / 2 + hi / 2;
}

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

static void outside_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const disc_drawing *g = p->what;
  if (!g->d->known) dyd_frame_walk(p, l);
  for (int k = ONCE; k < CIRCLES && g->d->known; k++) {
    circle_path(p->canvas, g, k, true);
    dyd_picture_paint(p, l);
  }
}

/* Outside is the page. */
static void inside_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const disc_drawing *g = p->what;
  if (!g->d->known) return;
  for (int k = 0; k < ONCE; k++) {
    circle_path(p->canvas, g, k, true);
    dyd_canvas_clip(p->canvas);
  }
  dyd_frame_walk(p, l);
  for (int k = 0; k < ONCE; k++) dyd_canvas_unclip(p->canvas);
  dyd_picture_seen(p, l + 1);
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

/* kind: the first of the three circles. */
static void circles_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const disc_drawing *g = p->what;
  for (int k = l->kind; k < l->kind + ONCE && g->d->known; k++) {
    name_circle(p->canvas, "circle", k);
    circle_path(p->canvas, g, k, false);
    dyd_picture_paint(p, l);
  }
}

static void centres_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const disc_drawing *g = p->what;
  for (int k = l->kind; k < l->kind + ONCE && g->d->known; k++) {
    double x = dyd_view_x(p->view, g->at[k][0]), y = dyd_view_y(p->view, g->at[k][1]);
    dyd_picture_seen(p, l); /* also where it is far away */
    if (!(fabs(x) < LARGE && fabs(y) < LARGE)) continue;
    name_circle(p->canvas, "centre", k);
    dyd_canvas_circle(p->canvas, x, y, 3);
    dyd_picture_paint(p, l);
  }
}

static int disc_behind(const void *what, size_t i) {
  const disc_drawing *g = what;
  if (i < 3) return 0;
  const dyd_sure con = dyd_partial_disc_con(g->d, g->r[i]);
  return con == DYD_SURE_PLUS ? 1 : con == DYD_SURE_MINUS ? 2 : 3;
}

static void disc_sites_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const disc_drawing *g = p->what;
  draw_called(p, l, g->engine, g->r, g->n, true, disc_behind);
}

static void disc_notes(dyd_legend *legend, const dyd_picture *p) {
  if (!((const disc_drawing *)p->what)->d->known)
    dyd_legend_text(legend, "0, 1 and 2 may be on a line: there is no partial disc");
}

static const dyd_picture_layer disc_rows[] = {
    {outside_walk, 0, DYD_STYLE_FILL(DYD_RGB_BAND), DYD_KEY_PATCH, 3, "undecided", NULL},
    {inside_walk, 0, DYD_STYLE_FILL(INSIDE), DYD_KEY_PATCH, 1, "certainly inside", NULL},
    {NULL, 0, DYD_STYLE_FILL(WHITE), DYD_KEY_PATCH, 2, "certainly outside", NULL},
    {circles_walk, 0, DYD_STYLE_PEN(CURVE, 1.5, 0, 0), DYD_KEY_LINE, 8, "circle around one of 0 1 2, touching two",
     NULL},
    {circles_walk, ONCE, DYD_STYLE_PEN(CURVE, 1.5, 4, 2.5), DYD_KEY_LINE, 9, "around two, touching one", NULL},
    {centres_walk, 0, DYD_STYLE_SHAPE(CURVE, CURVE, 0, 1.2), DYD_KEY_DOT, 10, "centre of a full circle", NULL},
    {centres_walk, ONCE, DYD_STYLE_SHAPE(WHITE, CURVE, 0, 1.2), DYD_KEY_DOT, 11, "of a dashed one", NULL},
    {disc_sites_walk, 0, CALLED(0x777777), DYD_KEY_PATCH, 4, "the three points", NULL},
    {NULL, 1, CALLED(CURVE), DYD_KEY_PATCH, 5, "point certainly inside", NULL},
    {NULL, 2, CALLED(WHITE), DYD_KEY_PATCH, 6, "point certainly outside", NULL},
    {NULL, 3, CALLED(0xd55e00), DYD_KEY_PATCH, 7, "point of which it is not known", NULL}};

const dyd_picture_table dyd_disc_layers = DYD_PICTURE_TABLE(disc_rows, disc_notes);

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
  if (st != DYD_OK) return st;
  return dyd_picture_write(&(dyd_picture){&dyd_disc_layers, "partial disc", .view = &g.view, .what = &g}, o);
}

/* ---- a partial bisector ---- */

typedef struct bisector_drawing {
  const dyd_rect *const *r;
  const dyd_boundary *curve;
  const dyd_engine *engine;
  dyd_view view;
  double reach; /* arcs are cut off so far from the rectangles: far outside of the picture */
} bisector_drawing;

/* Corners and the line of an arc in doubles: focus s; corner q, or line of coordinate q[1 - k] along axis k. */
typedef struct locus {
  double s[2], q[2];
  int k;
} locus;

/* An arc as it is drawn: ends at[0], at[2], and, of a parabola, the point where the tangents at the ends meet. */
typedef struct drawn_arc {
  double at[3][2];
  bool curved;
} drawn_arc;

static locus locus_of(const dyd_arc *a, const dyd_rect *const r[2]) {
  double far[4], near[4];
  locus s = {.k = -1};
  dyd_rect_get_d(far, r[a->far_site]);
  dyd_rect_get_d(near, r[a->near_site]);
  s.s[0] = far[a->corner & 1];
  s.s[1] = far[2 + (a->corner >> 1)];
  if (a->kind == DYD_ARC_PARABOLA) {
    s.k = a->feature < DYD_SIDE_Y0 ? 1 : 0;
    s.q[1 - s.k] = near[a->feature - DYD_SIDE_X0];
  } else {
    s.q[0] = near[a->feature & 1];
    s.q[1] = near[2 + (a->feature >> 1)];
  }
  return s;
}

static double on_parabola(const locus *s, double t) {
  double h = s->s[1 - s->k] - s->q[1 - s->k], u = t - s->s[s->k];
  return (u * u / h + s->s[1 - s->k] + s->q[1 - s->k]) / 2;
}

static void parabola_piece(drawn_arc *p, const locus *s, const double begin[2], const double end[2], double reach) {
  double h = s->s[1 - s->k] - s->q[1 - s->k], most = sqrt(2 * fabs(h) * reach), t[3] = {begin[s->k], 0, end[s->k]};
  for (int e = 0; e < 3; e += 2) t[e] = fmax(s->s[s->k] - most, fmin(s->s[s->k] + most, t[e]));
  t[1] = t[0] / 2 + t[2] / 2;
  for (int e = 0; e < 3; e++) p->at[e][s->k] = t[e];
  p->at[0][1 - s->k] = on_parabola(s, t[0]);
  p->at[1][1 - s->k] = p->at[0][1 - s->k] + (t[0] - s->s[s->k]) / h * (t[2] - t[0]) / 2;
  p->at[2][1 - s->k] = on_parabola(s, t[2]);
}

/* The line through the middle of s and q, from `begin` to `end` (NULL: infinite). */
static void line_piece(drawn_arc *p, const locus *s, const double *begin, const double *end, double reach) {
  double n[2] = {s->q[0] - s->s[0], s->q[1] - s->s[1]}, length = hypot(n[0], n[1]);
  double along[2] = {-n[1] / length, n[0] / length}, middle[2], t[2] = {-reach, reach};
  const double *ends[2] = {begin, end};
  for (int a = 0; a < 2; a++) middle[a] = s->q[a] / 2 + s->s[a] / 2;
  for (int e = 0; e < 2; e++) {
    if (ends[e]) t[e] = (ends[e][0] - middle[0]) * along[0] + (ends[e][1] - middle[1]) * along[1];
    t[e] = fmax(-reach, fmin(reach, t[e]));
    for (int a = 0; a < 2; a++) p->at[2 * e][a] = middle[a] + t[e] * along[a];
  }
}

static drawn_arc piece_of(const bisector_drawing *d, const dyd_arc *a) {
  locus s = locus_of(a, d->r);
  drawn_arc p = {.curved = a->kind == DYD_ARC_PARABOLA};
  double begin[2], end[2];
  bool first = a->begin.kind != DYD_END_INFINITE, last = a->end.kind != DYD_END_INFINITE;
  if (first) dyd_exact_middle(begin, &a->begin.at);
  if (last) dyd_exact_middle(end, &a->end.at);
  if (p.curved)
    parabola_piece(&p, &s, begin, end, d->reach);
  else
    line_piece(&p, &s, first ? begin : NULL, last ? end : NULL, d->reach);
  return p;
}

static void line_to(dyd_canvas *c, const dyd_view *v, double x, double y) {
  dyd_canvas_line(c, dyd_view_x(v, x), dyd_view_y(v, y));
}

/* Behind the path so far. The cubic curve of a quadratic one has its inner points two thirds of the way to the middle
 * point. */
static void piece_path(dyd_canvas *c, const dyd_view *v, const drawn_arc *p) {
  double inner[2][2];
  line_to(c, v, p->at[0][0], p->at[0][1]);
  if (!p->curved) {
    line_to(c, v, p->at[2][0], p->at[2][1]);
    return;
  }
  for (int e = 0; e < 2; e++)
    for (int a = 0; a < 2; a++) inner[e][a] = p->at[2 * e][a] / 3 + p->at[1][a] * 2 / 3;
  dyd_canvas_curve(c, dyd_view_x(v, inner[0][0]), dyd_view_y(v, inner[0][1]), dyd_view_x(v, inner[1][0]),
                   dyd_view_y(v, inner[1][1]), dyd_view_x(v, p->at[2][0]), dyd_view_y(v, p->at[2][1]));
}

/* The part on the left of the chain, closed far outside of the picture. */
static void left_path(dyd_canvas *c, const bisector_drawing *d, const dyd_chain *chain) {
  drawn_arc p = {0};
  double begin[2] = {0}, *end = p.at[2], n[2];
  for (size_t k = 0; k < chain->count; k++) {
    p = piece_of(d, &chain->arc[k]);
    if (k == 0) begin[0] = p.at[0][0], begin[1] = p.at[0][1];
    piece_path(c, &d->view, &p);
  }
  double across[2] = {end[0] - begin[0], end[1] - begin[1]}, length = hypot(across[0], across[1]);
  n[0] = length > 0 ? -across[1] / length * d->reach : 0;
  n[1] = length > 0 ? across[0] / length * d->reach : 0;
  line_to(c, &d->view, end[0] + n[0], end[1] + n[1]);
  line_to(c, &d->view, begin[0] + n[0], begin[1] + n[1]);
  dyd_canvas_close(c);
}

static void left_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const bisector_drawing *d = p->what;
  if (d->curve[l->kind].count) left_path(p->canvas, d, d->curve[l->kind].chain);
}

/* Parabolas are of the layer behind l. */
static void draw_arc(dyd_picture *page, const dyd_picture_layer *l, const dyd_arc *a, int curve, size_t number) {
  drawn_arc p = piece_of(page->what, a);
  char id[48], title[120];
  snprintf(id, sizeof id, "arc-%d-%zu", curve, number);
  snprintf(title, sizeof title, "%s: the bound of the region certainly nearer to %d, piece %zu",
           p.curved ? "parabola" : "line", curve, number);
  dyd_canvas_name(page->canvas, id, title);
  piece_path(page->canvas, page->view, &p);
  dyd_picture_paint(page, l + p.curved);
}

static void arcs_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const bisector_drawing *d = p->what;
  for (int k = 0; k < 2; k++)
    for (size_t a = 0; d->curve[k].count && a < d->curve[k].chain->count; a++)
      draw_arc(p, l, &d->curve[k].chain->arc[a], k, a);
}

/* Those out of sight are in the legend, too. */
static void joints_walk(dyd_picture *p, const dyd_picture_layer *first) {
  const bisector_drawing *d = p->what;
  double limit = 2 * d->reach, at[2];
  for (int k = 0; k < 2; k++)
    for (size_t a = 1; d->curve[k].count && a < d->curve[k].chain->count; a++) {
      const dyd_arc_end *end = &d->curve[k].chain->arc[a].begin;
      const dyd_picture_layer *l = first + (end->kind != DYD_END_AXIS);
      dyd_picture_seen(p, l);
      dyd_exact_middle(at, &end->at);
      if (!(fabs(at[0] - p->view->left) < limit && fabs(at[1] - p->view->top) < limit)) continue;
      dyd_canvas_circle(p->canvas, dyd_view_x(p->view, at[0]), dyd_view_y(p->view, at[1]), 3.5);
      dyd_picture_paint(p, l);
    }
}

static int bisector_behind(const void *what, size_t i) {
  (void)what;
  return (int)i;
}

static void bisector_sites_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const bisector_drawing *d = p->what;
  draw_called(p, l, d->engine, d->r, 2, false, bisector_behind);
}

static void bisector_notes(dyd_legend *legend, const dyd_picture *p) {
  if (!((const bisector_drawing *)p->what)->curve[0].count)
    dyd_legend_text(legend, "the rectangles meet: no place is certainly nearer to one of them");
}

static const dyd_picture_layer bisector_rows[] = {
    {dyd_frame_walk, 0, DYD_STYLE_FILL(DYD_RGB_BAND), DYD_KEY_PATCH, 3, "undecided", NULL},
    {left_walk, 0, DYD_STYLE_FILL(INSIDE), DYD_KEY_PATCH, 1, "certainly nearer to 0", NULL},
    {left_walk, 1, DYD_STYLE_FILL(0xd9eccf), DYD_KEY_PATCH, 2, "certainly nearer to 1", NULL},
    {arcs_walk, 0, DYD_STYLE_PEN(CURVE, 1.8, 0, 0), DYD_KEY_LINE, 4, "line", NULL},
    {NULL, 1, DYD_STYLE_PEN(CURVE, 1.8, 4, 2.5), DYD_KEY_LINE, 5, "parabola", NULL},
    {joints_walk, 0, DYD_STYLE_SHAPE(CURVE, CURVE, 0, 1.2), DYD_KEY_DOT, 6,
     "from here on another corner of the one rectangle is farthest", NULL},
    {NULL, 1, DYD_STYLE_SHAPE(WHITE, CURVE, 0, 1.2), DYD_KEY_DOT, 7, "another corner or side of the other is closest",
     NULL},
    {bisector_sites_walk, 0, CALLED(0x6aaed6), DYD_KEY_NONE, 0, "point 0", NULL},
    {NULL, 1, CALLED(0x8cc27a), DYD_KEY_NONE, 0, "point 1", NULL}};

const dyd_picture_table dyd_bisector_layers = DYD_PICTURE_TABLE(bisector_rows, bisector_notes);

/* *box grows by the ends that are not far out. */
static void see_ends(double box[4], const dyd_boundary *b, double reach) {
  double most[4] = {box[0] - reach, box[1] + reach, box[2] - reach, box[3] + reach}, at[2];
  for (size_t k = 1; b->count && k < b->chain->count; k++) {
    dyd_exact_middle(at, &b->chain->arc[k].begin.at);
    for (int a = 0; a < 2; a++) {
      box[2 * a] = fmin(box[2 * a], fmax(most[2 * a], at[a]));
      box[2 * a + 1] = fmax(box[2 * a + 1], fmin(most[2 * a + 1], at[a]));
    }
  }
}

dyd_status dyd_bisector_picture(const dyd_output *o) {
  const dyd_bisector_output *c = o->what;
  bisector_drawing d = {.r = c->r, .curve = c->curve, .engine = c->engine};
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY}, see[4];
  dyd_status st = DYD_OK;
  for (int k = 0; k < 2 && st == DYD_OK; k++) st = dyd_view_grow(box, d.r[k], o->err);
  if (st != DYD_OK) return st;
  for (int e = 0; e < 4; e++) see[e] = box[e];
  for (int k = 0; k < 2; k++) see_ends(see, &d.curve[k], fmax(box[1] - box[0], box[3] - box[2]));
  dyd_view_pad(see);
  st = dyd_view_fit(&d.view, see, 0, o->err);
  if (st != DYD_OK) return st;
  d.reach = 10 * (d.view.width + d.view.height) / d.view.scale;
  return dyd_picture_write(&(dyd_picture){&dyd_bisector_layers, "partial bisector", .view = &d.view, .what = &d}, o);
}

/* ---- nearest points ---- */

enum { NOT, SURE, POSSIBLE };

typedef struct nearest_drawing {
  const dyd_delaunay *pd;
  const dyd_sites *sites;
  const dyd_nearest_answer *answer;
  const dyd_engine *engine;
  dyd_view view;
  double place[4], near, far; /* Q, m, M */
  size_t count;               /* sites that are no duplicates */
  dyd_numbers labels;         /* owned; kept off what is drawn before them */
} nearest_drawing;

static double least_distance(const double a[4], const double b[4]) {
  double x = fmax(fmax(b[0] - a[1], a[0] - b[1]), 0), y = fmax(fmax(b[2] - a[3], a[2] - b[3]), 0);
  return hypot(x, y);
}

static double largest_distance(const double a[4], const double b[4]) {
  return hypot(fmax(b[1] - a[0], a[1] - b[0]), fmax(b[3] - a[2], a[3] - b[2]));
}

static void find_distances(nearest_drawing *g) {
  g->near = g->far = INFINITY;
  for (size_t i = 0; i < dyd_sites_count(g->sites); i++) {
    double b[4];
    if (dyd_delaunay_alias(g->pd, (uint32_t)i) != i) continue;
    dyd_sites_get_d(b, g->sites, i);
    g->near = fmin(g->near, least_distance(g->place, b));
    g->far = fmin(g->far, largest_distance(g->place, b));
    g->count++;
  }
}

/* The larger disc in the middle, with its surroundings: some neighbours, unless that would make it too small. */
static dyd_status nearest_view(nearest_drawing *g, dyd_error *err) {
  double far = g->count ? g->far : 0, spacing = dyd_view_spacing(g->pd, NULL, NULL), box[4];
  double reach = fmax(2.2 * far, fmin(1.5 * spacing, 12 * far));
  if (reach == 0) reach = spacing > 0 ? 1.5 * spacing : 1;
  for (int k = 0; k < 4; k++) box[k] = g->place[k] + (k & 1 ? reach : -reach);
  return dyd_view_fit(&g->view, box, spacing, err);
}

/* All within `reach` of the place: a rectangle with round corners. */
static void around_path(dyd_canvas *c, const nearest_drawing *g, double reach) {
  const double quarter = acos(0.0);
  double r = reach * g->view.scale;
  double x[2] = {dyd_view_x(&g->view, g->place[0]), dyd_view_x(&g->view, g->place[1])};
  double y[2] = {dyd_view_y(&g->view, g->place[3]), dyd_view_y(&g->view, g->place[2])};
  for (int k = 0; k < 4; k++)
    dyd_canvas_arc(c, x[k == 0 || k == 3], y[k == 0 || k == 1], r, k * quarter, (k + 1) * quarter);
  dyd_canvas_close(c);
}

/* kind: true for the inner one, where there is one. */
static void around_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const nearest_drawing *g = p->what;
  if (g->count && (!l->kind || g->near > 0)) around_path(p->canvas, g, l->kind ? g->near : g->far);
}

/* Calls for every site that is drawn, possibly nearest ones last (first: the other way round). */
typedef void (*nearest_visit)(dyd_picture *p, const dyd_picture_layer *l, const double box[4], size_t i, bool found);

static void nearest_each(dyd_picture *p, const dyd_picture_layer *l, bool first, nearest_visit visit) {
  const nearest_drawing *g = p->what;
  const dyd_index_list *list = g->answer->found; /* ascending */
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = 0, at = 0; i < dyd_sites_count(g->sites); i++) {
      double b[4];
      while (at < list->count && list->item[at] < i) at++;
      bool found = at < list->count && list->item[at] == i;
      if (dyd_delaunay_alias(g->pd, (uint32_t)i) != i || found != (first ? !pass : pass)) continue;
      dyd_sites_get_d(b, g->sites, i);
      if (dyd_view_sees(&g->view, b)) visit(p, l, b, i, found);
    }
}

static void nearest_mark_site(dyd_picture *p, const dyd_picture_layer *l, const double box[4], size_t i, bool found) {
  nearest_drawing *g = p->what;
  dyd_picture_marked(p->canvas, p->view, box, g->engine, i);
  dyd_picture_paint(p, l + (!found ? NOT : g->answer->sure ? SURE : POSSIBLE));
  if (g->labels.taken) dyd_numbers_keep_off(&g->labels, box);
}

static void nearest_sites_walk(dyd_picture *p, const dyd_picture_layer *l) {
  nearest_drawing *g = p->what;
  dyd_numbers_clear(&g->labels);
  g->labels = (dyd_numbers){0};
  if (p->view->apart >= 28) dyd_numbers_init(&g->labels, p->view);
  nearest_each(p, l, false, nearest_mark_site);
}

static void nearest_number(dyd_picture *p, const dyd_picture_layer *l, const double box[4], size_t i, bool found) {
  nearest_drawing *g = p->what;
  (void)l;
  dyd_numbers_put(&g->labels, p->canvas, box, found ? 18 : 14, g->engine, i);
}

static void nearest_numbers_walk(dyd_picture *p, const dyd_picture_layer *l) {
  nearest_drawing *g = p->what;
  if (!g->labels.taken) return;
  dyd_numbers_keep_off(&g->labels, g->place);
  nearest_each(p, l, true, nearest_number);
}

/* Full ones are of the layer behind l. */
static void ways_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const nearest_drawing *g = p->what;
  double z[2][2];
  dyd_view_middle(z[0], p->view, g->place);
  for (size_t k = 0; k < g->answer->found->count; k++) {
    double b[4];
    dyd_sites_get_d(b, g->sites, g->answer->found->item[k]);
    dyd_view_middle(z[1], p->view, b);
    dyd_canvas_segment(p->canvas, z);
    dyd_picture_paint(p, l + g->answer->sure);
  }
}

/* The rectangle of the place, where that can be seen. */
static void place_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const nearest_drawing *g = p->what;
  double wide = dyd_view_x(p->view, g->place[1]) - dyd_view_x(p->view, g->place[0]);
  double y = dyd_view_y(p->view, g->place[3]), high = dyd_view_y(p->view, g->place[2]) - y;
  (void)l;
  if (fmax(wide, high) > 4) dyd_canvas_box(p->canvas, dyd_view_x(p->view, g->place[0]), y, wide, high);
}

/* kind: true for the cross, false for its halo. */
static void cross_walk(dyd_picture *p, const dyd_picture_layer *l) {
  const nearest_drawing *g = p->what;
  const double *b = g->place;
  const double x = dyd_view_x(p->view, b[0]) / 2 + dyd_view_x(p->view, b[1]) / 2;
  const double y = dyd_view_y(p->view, b[3]) / 2 + dyd_view_y(p->view, b[2]) / 2;
  for (int k = -1; k <= 1; k += 2)
    dyd_canvas_segment(p->canvas, (double[2][2]){{x - 8, y - 8 * k}, {x + 8, y + 8 * k}});
  if (l->kind) dyd_canvas_name(p->canvas, "place", l->text);
}

static void found_entry(dyd_legend *legend, const dyd_picture *p, const dyd_picture_layer *l) {
  const dyd_nearest_answer *answer = ((const nearest_drawing *)p->what)->answer;
  if (answer->found->count && answer->sure == (l->kind == SURE)) dyd_legend_put(legend, l, l->text);
}

static void far_entry(dyd_legend *legend, const dyd_picture *p, const dyd_picture_layer *l) {
  const nearest_drawing *g = p->what;
  if (g->count && g->near < g->far) dyd_legend_put(legend, l, l->text);
}

static void nearest_notes(dyd_legend *legend, const dyd_picture *p) {
  const nearest_drawing *g = p->what;
  char text[240], lo[DYD_DECIMAL_SIZE], hi[DYD_DECIMAL_SIZE];
  dyd_decimal_directed(lo, g->near, 6, DYD_DOWN);
  dyd_decimal_directed(hi, g->far, 6, DYD_UP);
  if (g->count == 0)
    snprintf(text, sizeof text, "there are no points");
  else if (g->answer->sure)
    snprintf(text, sizeof text, "%zu points, number %zu is certainly nearest, about %s away (at most %s)", g->count,
             dyd_engine_row(g->engine, g->answer->found->item[0]), lo, hi);
  else
    snprintf(text, sizeof text, "%zu points, %zu possibly nearest, outcome %s; the nearest is about %s to %s away",
             g->count, g->answer->found->count, dyd_outcome_text(g->answer->outcome), lo, hi);
  dyd_legend_text(legend, text);
}

#define UNLISTED(walk, kind, style, text)                                                                              \
  { walk, kind, style, DYD_KEY_NONE, 0, text, NULL }

static const dyd_picture_layer nearest_rows[] = {
    {around_walk, false, DYD_STYLE_FILL(DYD_RGB_BAND), DYD_KEY_PATCH, 4, "the nearest is in here", far_entry},
    {around_walk, true, DYD_STYLE_FILL(INSIDE), DYD_KEY_PATCH, 3, "certainly free of points", NULL},
    {nearest_sites_walk, NOT, CALLED(WHITE), DYD_KEY_PATCH, 2, "certainly not nearest", NULL},
    {NULL, SURE, CALLED(CURVE), DYD_KEY_PATCH, 1, "certainly nearest to \303\227", found_entry},
    {NULL, POSSIBLE, CALLED(0xd55e00), DYD_KEY_PATCH, 1, "possibly nearest to \303\227", found_entry},
    UNLISTED(around_walk, false, DYD_STYLE_PEN(0x222222, 1.5, 0, 0), "bound of where the nearest is"),
    UNLISTED(around_walk, true, DYD_STYLE_PEN(0x222222, 1.5, 4, 2.5), "bound of the part free of points"),
    UNLISTED(ways_walk, POSSIBLE, DYD_STYLE_PEN(0x222222, 1, 4, 4), "way to a point possibly nearest"),
    UNLISTED(NULL, SURE, DYD_STYLE_PEN(0x222222, 1, 0, 0), "way to the nearest point"),
    UNLISTED(place_walk, 0, DYD_STYLE_PEN(0, 1.5, 1, 2), "the rectangle of the place"),
    UNLISTED(cross_walk, false, DYD_STYLE_PEN(0xffffff, 5, 0, 0), "halo of the cross"),
    UNLISTED(cross_walk, true, DYD_STYLE_PEN(0, 2.5, 0, 0), "the place asked about"),
    UNLISTED(nearest_numbers_walk, 0, DYD_STYLE_FILL(0), "numbers of points")};

const dyd_picture_table dyd_nearest_layers = DYD_PICTURE_TABLE(nearest_rows, nearest_notes);

dyd_status dyd_nearest_picture(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  nearest_drawing g = {.pd = n->pd, .sites = dyd_delaunay_sites(n->pd), .answer = n->answer[0], .engine = n->engine};
  dyd_rect_get_d(g.place, g.answer->at);
  find_distances(&g);
  dyd_status st = nearest_view(&g, o->err);
  if (st == DYD_OK)
    st = dyd_picture_write(&(dyd_picture){&dyd_nearest_layers, "nearest points", .view = &g.view, .what = &g}, o);
  dyd_numbers_clear(&g.labels);
  return st;
}
