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

typedef unsigned (*site_colour)(const void *context, size_t i);

/* Draws n rectangles, those of the first sites of e, and their numbers or identifiers, of which the first ones have the
 * choice where they stand. over: the first ones are drawn over the others. */
static void draw_called(dyd_canvas *c, const dyd_view *v, const dyd_engine *e, const dyd_rect *const *r, size_t n,
                        bool over, site_colour colour, const void *context) {
  DYD_SCOPED(dyd_numbers) labels;
  double b[4];
  bool numbers = dyd_numbers_init(&labels, v);
  for (size_t k = 0; k < n; k++) {
    size_t i = over ? n - 1 - k : k;
    dyd_rect_get_d(b, r[i]);
    dyd_picture_marked(c, v, b, e, i, colour(context, i));
    if (numbers) dyd_numbers_keep_off(&labels, b);
  }
  for (size_t i = 0; i < n && numbers; i++) {
    dyd_rect_get_d(b, r[i]);
    dyd_numbers_put(&labels, c, b, 18, e, i);
  }
}

/* ---- a partial disc ---- */

enum { CIRCLES = 6, ONCE = 3, WHITE = 0xffffff };

#define TRIPLE 0x777777
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

static unsigned con_colour(dyd_sure con) {
  return con == DYD_SURE_PLUS ? CURVE : con == DYD_SURE_MINUS ? WHITE : 0xd55e00;
}

static unsigned disc_colour(const void *context, size_t i) {
  const disc_drawing *g = context;
  return i < 3 ? TRIPLE : con_colour(dyd_partial_disc_con(g->d, g->r[i]));
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
  if (g->d->known) dyd_legend_patch(&l, INSIDE, "certainly inside");
  if (g->d->known) dyd_legend_patch(&l, WHITE, "certainly outside");
  dyd_legend_patch(&l, DYD_PICTURE_BAND, "undecided");
  dyd_legend_patch(&l, TRIPLE, "the three points");
  if (has_con(g, DYD_SURE_PLUS)) dyd_legend_patch(&l, con_colour(DYD_SURE_PLUS), "point certainly inside");
  if (has_con(g, DYD_SURE_MINUS)) dyd_legend_patch(&l, con_colour(DYD_SURE_MINUS), "point certainly outside");
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
  draw_called(c, &g->view, g->engine, g->r, g->n, true, disc_colour, g);
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

/* ---- a partial bisector ---- */

static const unsigned tint[2] = {0xcfe4f3, 0xd9eccf}, body[2] = {0x6aaed6, 0x8cc27a};

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
static void fill_left(dyd_canvas *c, const bisector_drawing *d, const dyd_chain *chain, unsigned rgb) {
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
  dyd_picture_fill(c, rgb);
}

static void draw_arc(dyd_canvas *c, const bisector_drawing *d, const dyd_arc *a, int curve, size_t number) {
  drawn_arc p = piece_of(d, a);
  char id[48], title[120];
  snprintf(id, sizeof id, "arc-%d-%zu", curve, number);
  snprintf(title, sizeof title, "%s: the bound of the region certainly nearer to %d, piece %zu",
           p.curved ? "parabola" : "line", curve, number);
  dyd_canvas_name(c, id, title);
  piece_path(c, &d->view, &p);
  dyd_picture_stroke(c, CURVE, 1.8, p.curved ? 4 : 0, p.curved ? 2.5 : 0);
}

static void bisector_mark(dyd_canvas *c, double x, double y, dyd_end_kind kind) {
  dyd_picture_dot(c, x, y, 3.5, kind == DYD_END_AXIS ? CURVE : 0xffffff, CURVE);
}

static void draw_ends(dyd_canvas *c, const bisector_drawing *d, const dyd_chain *chain) {
  double limit = 2 * d->reach, at[2];
  for (size_t k = 1; k < chain->count; k++) {
    dyd_exact_middle(at, &chain->arc[k].begin.at);
    if (!(fabs(at[0] - d->view.left) < limit && fabs(at[1] - d->view.top) < limit)) continue;
    bisector_mark(c, dyd_view_x(&d->view, at[0]), dyd_view_y(&d->view, at[1]), chain->arc[k].begin.kind);
  }
}

static void draw_curves(dyd_canvas *c, const bisector_drawing *d) {
  const dyd_chain *chain[2] = {d->curve[0].chain, d->curve[1].chain};
  dyd_view_frame_path(c, &d->view);
  dyd_picture_fill(c, DYD_PICTURE_BAND);
  for (int k = 0; k < 2; k++)
    if (d->curve[k].count) fill_left(c, d, chain[k], tint[k]);
  for (int k = 0; k < 2; k++)
    for (size_t a = 0; d->curve[k].count && a < chain[k]->count; a++) draw_arc(c, d, &chain[k]->arc[a], k, a);
  for (int k = 0; k < 2; k++)
    if (d->curve[k].count) draw_ends(c, d, chain[k]);
}

/* Which kinds of arcs, and of joints, there are. */
static void bisector_kinds(bool arcs[2], bool joints[2], const bisector_drawing *d) {
  for (int k = 0; k < 2; k++)
    for (size_t a = 0; d->curve[k].count && a < d->curve[k].chain->count; a++) {
      const dyd_arc *arc = &d->curve[k].chain->arc[a];
      arcs[arc->kind == DYD_ARC_PARABOLA] = true;
      if (a > 0) joints[arc->begin.kind == DYD_END_AXIS] = true;
    }
}

static void bisector_legend(dyd_canvas *c, void *context) {
  const bisector_drawing *d = context;
  bool arcs[2] = {false, false}, joints[2] = {false, false};
  dyd_legend l;
  dyd_legend_begin(&l, c, &d->view);
  bisector_kinds(arcs, joints, d);
  if (d->curve[0].count) dyd_legend_patch(&l, tint[0], "certainly nearer to 0");
  if (d->curve[1].count) dyd_legend_patch(&l, tint[1], "certainly nearer to 1");
  dyd_legend_patch(&l, DYD_PICTURE_BAND, "undecided");
  if (arcs[0]) dyd_legend_line(&l, CURVE, 0, 0, "line");
  if (arcs[1]) dyd_legend_line(&l, CURVE, 4, 2.5, "parabola");
  if (joints[1]) dyd_legend_dot(&l, CURVE, CURVE, "from here on another corner of the one rectangle is farthest");
  if (joints[0]) dyd_legend_dot(&l, 0xffffff, CURVE, "another corner or side of the other is closest");
  if (!d->curve[0].count) dyd_legend_text(&l, "the rectangles meet: no place is certainly nearer to one of them");
}

static unsigned bisector_colour(const void *context, size_t i) {
  (void)context;
  return body[i];
}

static void bisector_inside(dyd_canvas *c, void *context) {
  const bisector_drawing *d = context;
  draw_curves(c, d);
  draw_called(c, &d->view, d->engine, d->r, 2, false, bisector_colour, NULL);
}

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
  return dyd_view_write(o, &d.view, "partial bisector", bisector_inside, bisector_legend, &d);
}

/* ---- nearest points ---- */

#define POSSIBLE 0xd55e00
#define NOT 0xffffff

typedef struct nearest_drawing {
  const dyd_delaunay *pd;
  const dyd_sites *sites;
  const dyd_nearest_answer *answer;
  const dyd_engine *engine;
  dyd_view view;
  double place[4], near, far; /* Q, m, M */
  size_t count;               /* sites that are no duplicates */
  bool others;                /* some that are certainly not nearest are drawn */
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

static void nearest_areas(dyd_canvas *c, const nearest_drawing *g) {
  around_path(c, g, g->far);
  dyd_picture_fill(c, DYD_PICTURE_BAND);
  if (!(g->near > 0)) return;
  around_path(c, g, g->near);
  dyd_picture_fill(c, INSIDE);
}

static void nearest_circles(dyd_canvas *c, const nearest_drawing *g) {
  around_path(c, g, g->far);
  dyd_picture_stroke(c, 0x222222, 1.5, 0, 0);
  if (!(g->near > 0)) return;
  around_path(c, g, g->near);
  dyd_picture_stroke(c, 0x222222, 1.5, 4, 2.5);
}

/* Calls for every site that is drawn, possibly nearest ones last (first: the other way round). */
typedef void (*nearest_visit)(dyd_canvas *c, nearest_drawing *g, dyd_numbers *l, const double box[4], size_t i,
                              bool found);

static void nearest_each(dyd_canvas *c, nearest_drawing *g, dyd_numbers *l, bool first, nearest_visit visit) {
  const dyd_index_list *list = g->answer->found; /* ascending */
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = 0, at = 0; i < dyd_sites_count(g->sites); i++) {
      double b[4];
      while (at < list->count && list->item[at] < i) at++;
      bool found = at < list->count && list->item[at] == i;
      if (dyd_delaunay_alias(g->pd, (uint32_t)i) != i || found != (first ? !pass : pass)) continue;
      dyd_sites_get_d(b, g->sites, i);
      if (dyd_view_sees(&g->view, b)) visit(c, g, l, b, i, found);
    }
}

static void nearest_mark_site(dyd_canvas *c, nearest_drawing *g, dyd_numbers *l, const double box[4], size_t i,
                              bool found) {
  dyd_picture_marked(c, &g->view, box, g->engine, i, !found ? NOT : g->answer->sure ? CURVE : POSSIBLE);
  g->others = g->others || !found;
  if (l->taken) dyd_numbers_keep_off(l, box);
}

static void nearest_number(dyd_canvas *c, nearest_drawing *g, dyd_numbers *l, const double box[4], size_t i,
                           bool found) {
  dyd_numbers_put(l, c, box, found ? 18 : 14, g->engine, i);
}

static void draw_ways(dyd_canvas *c, const nearest_drawing *g) {
  double place[2], site[2];
  dyd_view_middle(place, &g->view, g->place);
  for (size_t k = 0; k < g->answer->found->count; k++) {
    double b[4];
    dyd_sites_get_d(b, g->sites, g->answer->found->item[k]);
    dyd_view_middle(site, &g->view, b);
    dyd_canvas_move(c, place[0], place[1]);
    dyd_canvas_line(c, site[0], site[1]);
    dyd_picture_stroke(c, 0x222222, 1, g->answer->sure ? 0 : 4, g->answer->sure ? 0 : 4);
  }
}

/* A cross; around it the rectangle, where that can be seen. */
static void draw_place(dyd_canvas *c, const nearest_drawing *g) {
  const dyd_view *v = &g->view;
  double x0 = dyd_view_x(v, g->place[0]), x1 = dyd_view_x(v, g->place[1]), y0 = dyd_view_y(v, g->place[3]),
         y1 = dyd_view_y(v, g->place[2]), x = x0 / 2 + x1 / 2, y = y0 / 2 + y1 / 2;
  if (fmax(x1 - x0, y1 - y0) > 4) {
    dyd_canvas_box(c, x0, y0, x1 - x0, y1 - y0);
    dyd_picture_stroke(c, 0, 1.5, 1, 2);
  }
  for (int halo = 1; halo >= 0; halo--) {
    for (int k = -1; k <= 1; k += 2) {
      dyd_canvas_move(c, x - 8, y - 8 * k);
      dyd_canvas_line(c, x + 8, y + 8 * k);
    }
    if (!halo) dyd_canvas_name(c, "place", "the place asked about");
    dyd_picture_stroke(c, halo ? 0xffffff : 0, halo ? 5 : 2.5, 0, 0);
  }
}

static void nearest_legend(dyd_canvas *c, void *context) {
  const nearest_drawing *g = context;
  char text[240], lo[DYD_DECIMAL_SIZE], hi[DYD_DECIMAL_SIZE];
  dyd_legend l;
  dyd_legend_begin(&l, c, &g->view);
  if (g->answer->found->count)
    dyd_legend_patch(&l, g->answer->sure ? CURVE : POSSIBLE,
                     g->answer->sure ? "certainly nearest to \303\227" : "possibly nearest to \303\227");
  if (g->others) dyd_legend_patch(&l, NOT, "certainly not nearest");
  if (g->count && g->near > 0) dyd_legend_patch(&l, INSIDE, "certainly free of points");
  if (g->count && g->near < g->far) dyd_legend_patch(&l, DYD_PICTURE_BAND, "the nearest is in here");
  if (g->count == 0) {
    dyd_legend_text(&l, "there are no points");
    return;
  }
  dyd_decimal_directed(lo, g->near, 6, DYD_DOWN);
  dyd_decimal_directed(hi, g->far, 6, DYD_UP);
  if (g->answer->sure)
    snprintf(text, sizeof text, "%zu points, number %zu is certainly nearest, about %s away (at most %s)", g->count,
             dyd_engine_row(g->engine, g->answer->found->item[0]), lo, hi);
  else
    snprintf(text, sizeof text, "%zu points, %zu possibly nearest, outcome %s; the nearest is about %s to %s away",
             g->count, g->answer->found->count, dyd_outcome_text(g->answer->outcome), lo, hi);
  dyd_legend_text(&l, text);
}

static void nearest_inside(dyd_canvas *c, void *context) {
  nearest_drawing *g = context;
  DYD_SCOPED(dyd_numbers) labels = {0};
  bool numbers = g->view.apart >= 28 && dyd_numbers_init(&labels, &g->view);
  if (g->count) nearest_areas(c, g);
  nearest_each(c, g, &labels, false, nearest_mark_site);
  if (g->count) nearest_circles(c, g);
  draw_ways(c, g);
  draw_place(c, g);
  if (numbers) dyd_numbers_keep_off(&labels, g->place);
  if (numbers) nearest_each(c, g, &labels, true, nearest_number);
}

dyd_status dyd_nearest_picture(const dyd_output *o) {
  const dyd_nearest_output *n = o->what;
  nearest_drawing g = {.pd = n->pd, .sites = dyd_delaunay_sites(n->pd), .answer = n->answer[0], .engine = n->engine};
  dyd_rect_get_d(g.place, g.answer->at);
  find_distances(&g);
  dyd_status st = nearest_view(&g, o->err);
  return st == DYD_OK ? dyd_view_write(o, &g.view, "nearest points", nearest_inside, nearest_legend, &g) : st;
}
